#include "neighbors/scan/ring_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shapes/random.h"
#include "shapes/shapes.h"
#include "tufted/errors.h"

namespace tufted::ring_search_test {
namespace {

/// A cloud with its ranks and the search by its structure.
struct Scan {
  explicit Scan(const Points& points, const ScanStructure& structure)
      : cloud(rankPoints(points, status, representative)),
        ranked(rankScan(structure, cloud, status, representative)),
        search(ranked, cloud) {}

  /// The caller's indices of the neighbours of a point of the caller.
  std::vector<int> around(int point, int k) const {
    Buffer<Neighbor> found;
    search.nearest(rank(point), k, found);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    std::vector<int> points;
    for (const Neighbor& q : found) points.push_back(cloud.input_index[q.index]);
    return points;
  }

  int rank(int point) const {
    return static_cast<int>(std::find(cloud.input_index.begin(), cloud.input_index.end(), point) -
                            cloud.input_index.begin());
  }

  std::vector<PointStatus> status;
  std::vector<int> representative;
  RankedCloud cloud;
  RankedScan ranked;
  RingSearch search;
};

TEST(RingSearch, ReachesTheRingsBesideHoweverFarApartTheyAre) {
  // Rings of 3600 points on a cylinder, 100 times as far apart as the points on them.
  constexpr int rings = 7, steps = 3600;
  Points points(rings * steps, 3);
  std::vector<int> ring(points.rows());
  for (int i = 0; i < points.rows(); ++i) {
    const double angle = 2 * std::numbers::pi * (i % steps + 0.3) / steps;
    ring[i] = 10 * (i / steps);  // numbers need not be consecutive
    points.row(i) << std::cos(angle), std::sin(angle), 0.1 * 2 * std::numbers::pi * (i / steps - 3) / 3.6;
  }
  const Scan scan(points, ringStructure(points, ring));
  for (const int column : {0, 1, 17, 3599}) {
    const int p = 3 * steps + column;
    const std::vector<int> found = scan.around(p, 30);
    const auto has = [&](int row, int at) {
      return std::find(found.begin(), found.end(), row * steps + (at + steps) % steps) != found.end();
    };
    for (const int row : {2, 3, 4}) {
      for (const int step : {-2, -1, 1, 2}) EXPECT_TRUE(has(row, column + step)) << row << ' ' << column << ' ' << step;
    }
    EXPECT_TRUE(has(2, column) && has(4, column));
    EXPECT_LT(found.size(), 150U);
    EXPECT_EQ(std::count_if(found.begin(), found.end(), [&](int q) { return q / steps < 1 || q / steps > 5; }), 0);
  }
}

TEST(RingStructure, NumbersTheRingsByTheirElevations) {
  const auto scan = shapes::lidar({.rings = 16, .azimuth_step = 2, .noise = 0.02}, 4);
  EXPECT_EQ(findRings(scan.points).row, imageStructure(scan.width, scan.height).row);
  const Eigen::RowVector3d origin(100, -50, 7);
  const ScanStructure moved = findRings(scan.points.rowwise() + origin, origin.transpose());
  EXPECT_EQ(moved.row, imageStructure(scan.width, scan.height).row);
}

TEST(RingStructure, RefusesACloudWithoutRings) {
  EXPECT_THROW(findRings(shapes::torus(2000).points), InvalidInput);
  EXPECT_THROW(findRings(shapes::sphere(2000).points), InvalidInput);
  EXPECT_THROW(findRings(shapes::lidar({.azimuth_step = 2}).points, {1, 2, 0.5}), InvalidInput);
}

TEST(RingStructure, RefusesARandomCloudHoweverItsGapsFall) {
  // Somewhere among the smallest of so many gaps one is four times the next: in a quarter of such clouds.
  for (const int n : {30, 64, 400, 4000}) {
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
      EXPECT_THROW(findRings(shapes::sphere(n, shapes::Sampling::uniform, seed).points), InvalidInput) << n;
      const Points square = shapes::square(n, shapes::Sampling::uniform, shapes::Rim::none, seed).points;
      EXPECT_THROW(findRings(square, {0.5, 0.5, -0.3}), InvalidInput) << n;
    }
  }
}

TEST(RingStructure, FindsTheRingsOfNoisyScansWithMissingPoints) {
  for (const int rings : {16, 32, 64}) {
    for (const double noise : {0.02, 0.05}) {
      for (const double missing : {0.3, 0.9}) {
        shapes::Cloud scan = shapes::lidar({.rings = rings, .azimuth_step = 1, .noise = noise}, 101);
        scan.points = scan.points.cast<float>().cast<double>().eval();  // as files have them
        std::vector<int> row = imageStructure(scan.width, scan.height).row;
        shapes::Random random(102);
        for (std::size_t i = 0; i < row.size(); ++i) {
          if (random.uniform() >= missing) continue;
          scan.points.row(static_cast<Eigen::Index>(i)).setConstant(std::nan(""));
          row[i] = -1;
        }
        EXPECT_EQ(findRings(scan.points).row, row) << rings << ' ' << noise << ' ' << missing;
      }
    }
  }
}

TEST(RingStructure, LeavesOutPointsWithoutADirection) {
  auto scan = shapes::lidar({.rings = 16, .azimuth_step = 2});
  scan.points.row(5).setZero();
  scan.points.row(6).setConstant(std::nan(""));
  const ScanStructure structure = findRings(scan.points);
  EXPECT_EQ(structure.row[5], -1);
  EXPECT_EQ(structure.row[6], -1);
  const Scan found(scan.points, structure);
  EXPECT_EQ(std::count(found.ranked.row.begin(), found.ranked.row.end(), -1), 1);  // the other one is no point
}

TEST(ScanStructure, OfTheWrongSizeIsNamed) {
  constexpr int width = 6, height = 5;
  const Points points = Points::Random(width * height, 3);
  EXPECT_THROW(imageStructure(-1, 3), InvalidInput);
  EXPECT_THROW(imageStructure(1 << 20, 1 << 20), InvalidInput);
  EXPECT_THROW(ringStructure(points, std::vector<int>{1, 2, 3}), InvalidInput);
  EXPECT_THROW(findRings(points, {0, 0, std::nan("")}), InvalidInput);
  EXPECT_THROW(Scan(points, imageStructure(width, height - 1)), InvalidInput);
  ScanStructure structure = imageStructure(width, height);
  for (const double column : {0.5, -1.0, 3e9}) {
    structure.position[7] = column;
    EXPECT_THROW(Scan(points, structure), InvalidInput);
  }
}

}  // namespace
}  // namespace tufted::ring_search_test
