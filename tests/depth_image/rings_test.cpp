// Spinning scanners whose rings lie close together are images that go round.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "depth_image/image.h"
#include "depth_image/inverse_slope.h"
#include "depth_image/ring_columns.h"
#include "shapes/random.h"
#include "shapes/shapes.h"

namespace tufted::rings_test {
namespace {

using namespace image_tests;

constexpr int rings = 40, columns = 720;
constexpr double degree = std::numbers::pi / 180, azimuth_step = 2 * std::numbers::pi / columns;

/// What a scanner sees whose ray of a ring and a column is `range(elevation, azimuth)` long; NaN where it is negative.
Points scanOf(const std::function<double(double, double)>& range, double lowest, double ring_step) {
  Points points(rings * columns, 3);
  for (int i = 0; i < points.rows(); ++i) {
    const double elevation = lowest + i / columns * ring_step, azimuth = i % columns * azimuth_step;
    const double r = range(elevation, azimuth);
    points.row(i) = Eigen::RowVector3d(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                       std::sin(elevation)) *
                    (r < 0 ? std::nan("") : r);
  }
  return points;
}

ScanStructure ringsOf(const Points& points, int per_ring = columns) {
  std::vector<int> ring;
  for (int i = 0; i < points.rows(); ++i) ring.push_back(i / per_ring);
  return ringStructure(points, std::move(ring));
}

/// A round room of radius 5.
double roundRoom(double elevation, double) {
  return 5 / std::cos(elevation);
}

class Rings {
 public:
  explicit Rings(const Points& points) : Rings(points, ringsOf(points)) {}
  Rings(const Points& points, const ScanStructure& structure) : cloud_(rankPoints(points, status_, representative_)) {
    const Progress silent;
    const Workers workers(2, silent);
    image_ = columnsOfRings(rankScan(structure, cloud_, status_, representative_), cloud_.points, workers);
    if (!image_) return;
    surface_.grid = pixelGrid(image_->scan, image_->columns);
    surface_.windows = findSurfaceWindows(surface_.grid, cloud_.points, {}, false, workers);
  }

  bool areImage() const { return image_.has_value(); }
  int columnOf(int rank) const { return static_cast<int>(image_->scan.position[rank]); }
  int pointOf(int rank) const { return cloud_.input_index[rank]; }
  int size() const { return cloud_.size(); }
  const SurfaceImage& surface() const { return surface_; }
  DepthImage view() const { return surface_.view(cloud_.points); }

 private:
  std::vector<PointStatus> status_;
  std::vector<int> representative_;
  RankedCloud cloud_;
  std::optional<RingImage> image_;
  SurfaceImage surface_;
};

TEST(ColumnsOfRings, AreThoseOfTheAzimuths) {
  const Rings found(scanOf(roundRoom, -10 * degree, 0.5 * degree));
  ASSERT_TRUE(found.areImage());
  for (int p = 0; p < found.size(); ++p) EXPECT_EQ(found.columnOf(p), found.pointOf(p) % columns);
}

TEST(ColumnsOfRings, KeepTheOrderOfPointsHalfwayBetweenTwo) {
  const Points points = scanOf(roundRoom, -10 * degree, 0.5 * degree);
  ScanStructure structure = ringsOf(points);
  shapes::Random random(1);
  for (double& azimuth : structure.position) azimuth += (0.5 + 0.2 * (random.uniform() - 0.5)) * azimuth_step;
  const Rings found(points, structure);
  ASSERT_TRUE(found.areImage());
  // At most the last one has no column of its own before the first.
  std::vector<int> column(rings * columns);
  for (int p = 0; p < found.size(); ++p) column[found.pointOf(p)] = found.columnOf(p);
  for (int ring = 0; ring < rings; ++ring) {
    auto own = std::vector<int>(column.begin() + ring * columns, column.begin() + (ring + 1) * columns);
    std::sort(own.begin(), own.end());
    EXPECT_EQ(std::adjacent_find(own.begin(), own.end()), own.end());
    EXPECT_LE(own.back() - own.front(), columns);
  }
}

TEST(ColumnsOfRings, AreNoneWherePixelsWouldNotDo) {
  EXPECT_FALSE(Rings(scanOf(roundRoom, -16 * degree, 0.8 * degree)).areImage());  // rings far apart
  EXPECT_FALSE(Rings(Points::Constant(1, 3, 1), ringsOf(Points::Constant(1, 3, 1))).areImage());
  EXPECT_FALSE(Rings(Points(0, 3), ringsOf(Points(0, 3))).areImage());

  const Points points = scanOf(roundRoom, -10 * degree, 0.5 * degree);
  shapes::Random random(2);
  Points thinned = points;
  for (int i = 0; i < points.rows(); ++i)
    if (random.uniform() < 0.3) thinned.row(i).setConstant(std::nan(""));
  EXPECT_FALSE(Rings(thinned).areImage());
  thinned = points;
  for (int i = 0; i < points.rows(); ++i)
    if (random.uniform() < 0.05) thinned.row(i).setConstant(std::nan(""));
  EXPECT_TRUE(Rings(thinned).areImage());

  ScanStructure uneven = ringsOf(points);
  for (double& azimuth : uneven.position) azimuth = 2 * std::numbers::pi * random.uniform();
  EXPECT_FALSE(Rings(points, uneven).areImage());
  ScanStructure far_rows = ringsOf(points);
  for (int& row : far_rows.row) row *= 1 << 20;
  EXPECT_FALSE(Rings(points, far_rows).areImage());
}

TEST(RingImage, HasNoSeam) {
  const Points points = scanOf(roundRoom, -10 * degree, 0.5 * degree);
  const Rings found(points);
  const int around = std::popcount(WindowPixels::rings(WindowPixels::reach));
  for (int p = 0; p < found.size(); ++p) {
    const int ring = found.pointOf(p) / columns;
    if (ring < WindowPixels::reach || ring >= rings - WindowPixels::reach) continue;
    EXPECT_EQ(std::popcount(found.surface().windows.around[p]), around);
  }
  const ScanStructure structure = ringsOf(points);
  CloudOptions options = cloudOptions(Preset::lidar);
  options.structure = &structure;
  const Laplacian laplacian = pointCloudLaplacian(points, options);
  EXPECT_EQ(laplacian.report.neighbors, WindowPixels::count);
  EXPECT_EQ(std::count(laplacian.boundary.begin() + columns, laplacian.boundary.end() - columns, Boundary::none),
            (rings - 2) * columns);
  double room = 0;
  for (int ring = 0; ring + 1 < rings; ++ring)
    room += 5 * (std::tan((-10 + 0.5 * (ring + 1)) * degree) - std::tan((-10 + 0.5 * ring) * degree));
  EXPECT_NEAR(laplacian.M.sum(), 2 * std::numbers::pi * 5 * room, 0.01 * laplacian.M.sum());
}

TEST(RingImage, OfASectorIsNotClosed) {
  const auto sector = [](double elevation, double azimuth) {
    return azimuth < 2 || (azimuth > 3 && azimuth < 4) ? roundRoom(elevation, azimuth) : -1;
  };
  const Points points = scanOf(sector, -10 * degree, 0.5 * degree);
  ASSERT_TRUE(Rings(points).areImage());
  const ScanStructure structure = ringsOf(points);
  CloudOptions options = cloudOptions(Preset::lidar);
  options.structure = &structure;
  const Laplacian laplacian = pointCloudLaplacian(points, options);
  EXPECT_EQ(laplacian.report.components, 2);
  EXPECT_EQ(laplacian.report.jump_points, 0);
  const auto columns_seen = static_cast<int>(laplacian.report.active) / rings;
  EXPECT_EQ(laplacian.report.rim_points, 2 * columns_seen + 4 * (rings - 2));
}

TEST(RingImage, HasTheSameWindowsPixelByPixel) {
  // Two rooms, one behind the other, beyond doors.
  const auto rooms = [](double elevation, double azimuth) {
    return (std::fmod(azimuth, 1) < 0.3 && elevation < -0.05 ? 7 : 5) / std::cos(elevation);
  };
  const Rings found(scanOf(rooms, -10 * degree, 0.5 * degree));
  PixelWindow taken, widened;
  const auto ranksOf = [](const PixelWindow& window) {
    std::vector<int> ranks;
    for (const Neighbor& q : window.neighbors()) ranks.push_back(q.index);
    std::sort(ranks.begin(), ranks.end());
    return ranks;
  };
  for (int p = 0; p < found.size(); p += 7) {
    taken.take(found.view(), p, WindowPixels::reach);
    widened.widen(found.view(), p, WindowPixels::reach);
    EXPECT_EQ(ranksOf(taken), ranksOf(widened));
  }
}

TEST(RingImage, IsOneSurfaceAtLowAngles) {
  // A floor that is seen at 7.5 down to 1.65 degrees: steps between rings go along the line of sight.
  const Points points =
      scanOf([](double elevation, double) { return 1.8 / std::sin(-elevation); }, -7.5 * degree, 0.15 * degree);
  const ScanStructure structure = ringsOf(points);
  CloudOptions options = cloudOptions(Preset::lidar);
  options.structure = &structure;
  const Laplacian laplacian = pointCloudLaplacian(points, options);
  EXPECT_EQ(std::count(laplacian.boundary.begin() + columns, laplacian.boundary.end() - columns, Boundary::none),
            (rings - 2) * columns);
  EXPECT_EQ(laplacian.report.components, 1);
}

TEST(RingImage, EndsAtJumps) {
  // The inner room is 3 m high; what is seen above it is the wall behind, 1.5 m farther.
  const Points points =
      scanOf([](double elevation, double) { return (elevation < 0.001 ? 5 : 6.5) / std::cos(elevation); }, -10 * degree,
             0.5 * degree);
  const ScanStructure structure = ringsOf(points);
  CloudOptions options = cloudOptions(Preset::lidar);
  options.structure = &structure;
  const Laplacian laplacian = pointCloudLaplacian(points, options);
  EXPECT_EQ(laplacian.report.components, 2);
  EXPECT_EQ(laplacian.report.jump_points, 2 * columns);
}

TEST(RingImage, HasTheSameBitsForAnyNumberOfThreads) {
  const shapes::Cloud room = shapes::lidar({.rings = 64, .azimuth_step = 1, .noise = 0.02}, 3);
  const ScanStructure structure = ringsOf(room.points, room.width);
  CloudOptions options = cloudOptions(Preset::lidar);
  options.structure = &structure;
  options.threads = 1;
  const Laplacian one = pointCloudLaplacian(room.points, options);
  EXPECT_EQ(one.report.neighbors, WindowPixels::count);
  options.threads = 3;
  const Laplacian three = pointCloudLaplacian(room.points, options);
  EXPECT_EQ(one.M, three.M);
  ASSERT_EQ(one.L.nonZeros(), three.L.nonZeros());
  EXPECT_TRUE(std::equal(one.L.valuePtr(), one.L.valuePtr() + one.L.nonZeros(), three.L.valuePtr()));
}

TEST(CommonSlope, IsThatOfTheSurface) {
  EXPECT_EQ(commonSlope(0.1, 0.2, 1), 0.1);
  EXPECT_EQ(commonSlope(-0.3, -0.2, 1), -0.2);
  EXPECT_EQ(commonSlope(0.1, -0.2, 1), 0);
  EXPECT_EQ(commonSlope(0.1, std::nan(""), 1), 0);
  EXPECT_EQ(commonSlope(0.3, 0.4, 0.2), 0);
}

TEST(RiseBetween, HoldsBothSlopesAndWhatIsBetween) {
  const Rise rise = riseBetween({0.1, -0.2}, {0.3, 0.4}, {2, -1});
  EXPECT_DOUBLE_EQ(rise.least, 0.2 - 0.4);
  EXPECT_DOUBLE_EQ(rise.most, 0.6 + 0.2);
}

}  // namespace
}  // namespace tufted::rings_test
