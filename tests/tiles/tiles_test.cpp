#include "tufted/tiles.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/scaling.h"
#include "operators/distinct_faces.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "tiles/passes_scaling.h"
#include "tufted/errors.h"
#include "tufted/laplacian.h"

namespace tufted {
namespace {

struct Collected {
  Laplacian laplacian;
  TileReport report;
};

/// The rows of all tiles, put together.
Collected byTiles(const Points& points, const CloudOptions& options, int tiles, double memory = 4e9) {
  const auto n = static_cast<std::size_t>(points.rows());
  Collected result;
  Laplacian& laplacian = result.laplacian;
  laplacian.M.setZero(points.rows());
  laplacian.status.assign(n, PointStatus::not_finite);
  laplacian.boundary.assign(n, Boundary::none);
  laplacian.representative.resize(n);
  for (std::size_t i = 0; i < n; ++i) laplacian.representative[i] = static_cast<int>(i);
  laplacian.frames.normals.setZero(points.rows(), 3);
  std::vector<std::vector<std::pair<int, double>>> entries(n);
  result.report = laplacianByTiles(
      sourceOf(points),
      {.cloud = options, .memory = memory, .tiles = tiles, .folder = std::filesystem::temp_directory_path()},
      [&](const TileRows& rows) {
        for (std::size_t r = 0; r < rows.point.size(); ++r) {
          const auto i = static_cast<std::size_t>(rows.point[r]);
          laplacian.M[i] = rows.M[r];
          laplacian.status[i] = rows.status[r];
          laplacian.boundary[i] = rows.boundary[r];
          laplacian.representative[i] = static_cast<int>(rows.representative[r]);
          laplacian.frames.normals.row(i) = rows.normals.row(r);
          entries[i].clear();
          for (auto e = rows.begin[r]; e < rows.begin[r + 1]; ++e)
            entries[i].emplace_back(static_cast<int>(rows.column[e]), rows.value[e]);
        }
      });
  std::vector<Eigen::Triplet<double>> all;
  for (std::size_t i = 0; i < n; ++i)
    for (const auto& [j, value] : entries[i]) all.emplace_back(j, static_cast<int>(i), value);
  laplacian.L.resize(points.rows(), points.rows());
  laplacian.L.setFromTriplets(all.begin(), all.end());
  return result;
}

void expectSame(const Laplacian& part, const Laplacian& whole) {
  ASSERT_EQ(part.status, whole.status);
  ASSERT_EQ(part.boundary, whole.boundary);
  ASSERT_EQ(part.representative, whole.representative);
  for (int i = 0; i < whole.L.cols(); ++i) {
    ASSERT_NEAR(part.M[i], whole.M[i], 1e-12 * whole.M[i]) << i;
    ASSERT_EQ(part.L.col(i).nonZeros(), whole.L.col(i).nonZeros()) << i;
    SparseMatrix::InnerIterator a(part.L, i), b(whole.L, i);
    for (; b; ++a, ++b) {
      ASSERT_EQ(a.row(), b.row()) << i;
      const double larger = std::max(whole.L.coeff(i, i), whole.L.coeff(b.row(), b.row()));
      ASSERT_NEAR(a.value(), b.value(), 1e-12 * larger) << i << " " << b.row();
    }
    if (whole.status[i] == PointStatus::active) {
      ASSERT_NEAR(std::abs(part.frames.normals.row(i).dot(whole.frames.normals.row(i))), 1, 1e-12) << i;
    }
  }
}

CloudOptions one(Preset preset) {
  CloudOptions options = cloudOptions(preset);
  options.threads = 1;
  return options;
}

/// Compares the rows of 3 and 8 tiles with those of the whole. @returns the report of 8 tiles
TileReport expectSameByTiles(const Points& points, const CloudOptions& options = one(Preset::clean)) {
  const Laplacian whole = pointCloudLaplacian(points, options);
  TileReport report;
  for (const int tiles : {3, 8}) {
    SCOPED_TRACE(tiles);
    const Collected part = byTiles(points, options, tiles);
    expectSame(part.laplacian, whole);
    report = part.report;
    EXPECT_EQ(report.tiles, tiles);
    EXPECT_EQ(report.points, whole.report.points);
    EXPECT_EQ(report.active, whole.report.active);
    EXPECT_EQ(report.not_finite, whole.report.not_finite);
    EXPECT_EQ(report.coincident, whole.report.coincident);
    EXPECT_EQ(report.isolated, whole.report.isolated);
    EXPECT_EQ(report.nonzeros, whole.L.nonZeros());
    EXPECT_NEAR(report.area, whole.M.sum(), 1e-12 * whole.M.sum());
  }
  return report;
}

Points noisySphere(int n, double spacings) {
  return shapes::withNoise(shapes::sphere(n), spacings * std::sqrt(4 * M_PI / n), 2).points;
}

/// Heights of a terrain over a lattice, in whole steps, so that there are many ties.
Points steppedTerrain(int side) {
  Points points = shapes::squareLattice(side).points;
  for (auto point : points.rowwise()) point.z() = std::round(16 * std::sin(3 * point.x()) * point.y()) / 64;
  return points;
}

/// A terrain with noise, and points above and below it.
Points roughTerrain(int n) {
  shapes::Random random(3);
  Points points(n, 3);
  for (auto point : points.rowwise()) {
    point.x() = random.uniform(0, 2);
    point.y() = random.uniform(0, 1);
    point.z() = 0.2 * std::sin(4 * point.x()) * std::cos(5 * point.y()) + 1e-4 * random.normal();
    if (random.uniform() < 2e-4) point.z() += random.uniform(-0.1, 0.1);
  }
  return points;
}

CloudOptions scan() {
  CloudOptions options = one(Preset::scan);
  options.steps.denoise = false;
  return options;
}

TEST(Tiles, OfASphereAreThoseOfTheWhole) {
  const TileReport report = expectSameByTiles(shapes::sphere(30000).points);
  EXPECT_LT(report.most_points, 30000);
}

TEST(Tiles, OfANoisySphereAreThoseOfTheWhole) {
  expectSameByTiles(noisySphere(20000, 0.3));
  expectSameByTiles(noisySphere(20000, 0.3), scan());
}

TEST(Tiles, OfSteppedHeightsAreThoseOfTheWhole) {
  expectSameByTiles(steppedTerrain(150));
  const TileReport report = expectSameByTiles(steppedTerrain(150), scan());
  EXPECT_LT(report.most_points, 22500);
}

TEST(Tiles, OfLinesAreThoseOfTheWhole) {
  expectSameByTiles(shapes::torus(20000, shapes::Sampling::scanLines(6)).points);
}

TEST(Tiles, OfATerrainWithOutliersAreThoseOfTheWhole) {
  expectSameByTiles(roughTerrain(20000));
  expectSameByTiles(roughTerrain(20000), scan());
}

TEST(Tiles, OfDuplicatesAndMissingPointsAreThoseOfTheWhole) {
  const Points once = shapes::sphere(15000).points;
  Points points(20000, 3);
  points << once, once.topRows(5000);
  points.middleRows(2000, 100).setConstant(NAN);
  points.row(7) << 1e300, 0, 0;
  expectSameByTiles(points);
}

// The point above one quarter of a lattice belongs to the tile of another quarter, which does not hold its neighbours.
TEST(Tiles, AreBuiltAgainWithAWiderMarginWhereASearchReachesFar) {
  Points points(22501, 3);
  points << shapes::squareLattice(150).points, Eigen::RowVector3d(0.3, 0.3, 2.5);
  const Laplacian whole = pointCloudLaplacian(points, one(Preset::clean));
  const Collected part = byTiles(points, one(Preset::clean), 4);
  expectSame(part.laplacian, whole);
  EXPECT_GT(part.report.builds, part.report.tiles);
}

// The cells around a small and far part are not held, however many rings of cells are taken.
TEST(Tiles, OfAPartThatHasFewerPointsThanASearchAreThoseOfTheWhole) {
  const Points large = shapes::sphere(12000).points;
  Points points(12300, 3);
  points << large, large.topRows(300) * 0.1 + Points::Constant(300, 3, 20);
  expectSame(byTiles(points, one(Preset::clean), 40).laplacian, pointCloudLaplacian(points, one(Preset::clean)));
}

TEST(Tiles, ThatAreTooLargeAreBuiltInParts) {
  const Points points = roughTerrain(20000);
  const Collected part = byTiles(points, one(Preset::clean), 2, 250e6 + 700 * 12000);
  expectSame(part.laplacian, pointCloudLaplacian(points, one(Preset::clean)));
  EXPECT_LE(part.report.most_points, 12000);
}

TEST(Tiles, TooLargeForTheMemoryAreRefused) {
  const Points points = shapes::sphere(2000).points;
  EXPECT_THROW(byTiles(points, one(Preset::clean), 1, 250e6 + 700 * 100), InvalidInput);
  EXPECT_EQ(byTiles(points, one(Preset::clean), 0, 1e30).report.tiles, 1);
}

// A build of a tile is not begun, nor a batch of points read, after progress has returned false.
TEST(Tiles, StopWhenProgressSaysSo) {
  const Points points = shapes::sphere(2000).points;
  for (const std::string_view last : {"sort", "tiles"}) {
    int calls_after = 0;
    bool is_stopped = false;
    const Progress stop = [&](std::string_view stage, double) {
      calls_after += is_stopped ? 1 : 0;
      is_stopped = is_stopped || stage == last;
      return !is_stopped;
    };
    EXPECT_THROW(laplacianByTiles(
                     sourceOf(points),
                     {.cloud = one(Preset::clean), .folder = std::filesystem::temp_directory_path(), .progress = stop},
                     [](const TileRows&) {}),
                 Cancelled);
    EXPECT_TRUE(is_stopped);
    EXPECT_EQ(calls_after, 0);
  }
}

TEST(Tiles, ReportAShareThatNeverFalls) {
  const Points points = shapes::sphere(20000).points;
  double share = 0;
  int calls = 0;
  const auto follow = [&](std::string_view stage, double fraction) {
    if (stage != "tiles") return true;
    ++calls;
    EXPECT_GE(fraction, share);
    share = fraction;
    return true;
  };
  const TileReport report = laplacianByTiles(
      sourceOf(points),
      {.cloud = one(Preset::clean), .tiles = 5, .folder = std::filesystem::temp_directory_path(), .progress = follow},
      [](const TileRows&) {});
  EXPECT_GT(calls, 2 * report.tiles);  // during builds as well
  EXPECT_GT(share, 0.9);
}

// Cells are as large as suits dense parts, so that triangles of others reach past many cells.
TEST(Tiles, OfUnevenDensityAreThoseOfTheWhole) {
  expectSameByTiles(shapes::square(20000, shapes::Sampling::densityStep(400)).points);
}

// There stars show that the searches of others were too narrow, across the borders of tiles and along rims.
TEST(Tiles, OfStepsOfDensityAreThoseOfTheWhole) {
  expectSameByTiles(shapes::square(8000, shapes::Sampling::densityStep(100)).points, scan());
  expectSameByTiles(shapes::torus(8000, shapes::Sampling::densityStep(16)).points, scan());
}

/// Faces around a point by their corners: how many there are, and the sums of their sides. Copies whose sides differ in
/// their last bits are one.
using FacesAround = std::map<std::array<int, 3>, Eigen::Vector4d>;

void addFace(const DistinctFace& face, FacesAround& around) {
  const auto& [a, b, c] = face.opposite;
  around.try_emplace(face.corners, Eigen::Vector4d::Zero()).first->second += face.copies * Eigen::Vector4d(1, a, b, c);
}

TEST(Tiles, FacesAreThoseOfTheWholeCover) {
  const Points points = noisySphere(3000, 0.1);
  const Laplacian whole = pointCloudLaplacian(points, one(Preset::clean));
  std::vector<FacesAround> expected(3000), found(3000);
  for (const DistinctFace& face : distinctFaces(*whole.cover_source, 3000, Workers(1, {})))
    for (const int corner : std::set<int>(face.corners.begin(), face.corners.end())) addFace(face, expected[corner]);
  laplacianByTiles(
      sourceOf(points),
      {.cloud = one(Preset::clean), .faces = true, .tiles = 3, .folder = std::filesystem::temp_directory_path()},
      [&](const TileRows& rows) {
        for (std::size_t r = 0; r < rows.point.size(); ++r) {
          found[rows.point[r]].clear();
          for (auto f = rows.face_begin[r]; f < rows.face_begin[r + 1]; ++f) {
            const auto& [a, b, c] = rows.faces[f].corners;
            DistinctFace face =
                distinctFace({static_cast<int>(a), static_cast<int>(b), static_cast<int>(c)}, rows.faces[f].opposite);
            face.copies = rows.faces[f].copies;
            addFace(face, found[rows.point[r]]);
          }
        }
      });
  for (int i = 0; i < 3000; ++i) {
    ASSERT_EQ(found[i].size(), expected[i].size()) << i;
    for (const auto& [corners, sums] : expected[i]) {
      ASSERT_EQ(found[i].count(corners), 1u) << i;
      ASSERT_EQ(found[i][corners][0], sums[0]) << i;
      ASSERT_LT((found[i][corners] - sums).norm(), 1e-12) << i;
    }
  }
}

TEST(Tiles, OfFewPointsAreThoseOfTheWhole) {
  for (const int n : {0, 1, 2, 3, 4, 31, 40, 1000}) {
    SCOPED_TRACE(n);
    const Points points = shapes::sphere(1000).points.topRows(n);
    const Collected part = byTiles(points, one(Preset::clean), 5);
    expectSame(part.laplacian, pointCloudLaplacian(points, one(Preset::clean)));
  }
  const Points missing = Points::Constant(10, 3, NAN), equal = Points::Constant(10, 3, 0.1);
  for (const Points& points : {missing, equal})
    expectSame(byTiles(points, one(Preset::clean), 5).laplacian, pointCloudLaplacian(points, one(Preset::clean)));
}

TEST(Tiles, RefuseWhatTheyCannotBuild) {
  const Points points = shapes::sphere(1000).points;
  const auto build = [&](const TileOptions& options) {
    laplacianByTiles(sourceOf(points), options, [](const TileRows&) {});
  };
  const auto folder = std::filesystem::temp_directory_path();
  TileOptions denoised;  // Preset::scan moves noisy points
  denoised.folder = folder;
  EXPECT_THROW(build(denoised), InvalidInput);
  EXPECT_THROW(build({.cloud = one(Preset::clean), .tiles = -1, .folder = folder}), InvalidInput);
  EXPECT_THROW(build({.cloud = one(Preset::clean), .memory = 1e6, .folder = folder}), InvalidInput);
  EXPECT_THROW(build({.cloud = one(Preset::clean), .folder = folder / "missing"}), IoError);
  CloudOptions seen = one(Preset::clean);
  const Eigen::Vector3d viewpoint(0, 0, 9);
  seen.viewpoint = &viewpoint;
  EXPECT_THROW(build({.cloud = seen, .folder = folder}), InvalidInput);
  EXPECT_THROW(build({.cloud = one(Preset::clean), .folder = folder, .progress = [](auto...) { return false; }}),
               Cancelled);
}

TEST(PassesScaling, IsThatOfPointsInMemory) {
  shapes::Random random(1);
  Points odd(200000, 3);
  for (auto point : odd.rowwise()) point << random.normal(), std::round(2 * random.normal()), 1e9 + random.uniform();
  odd.middleRows(100, 50).setConstant(NAN);
  odd.row(7) << 1e200, 0, 0;
  for (const Points& points : {odd, Points(odd.topRows(9)), Points(0, 3), Points(Points::Zero(5, 3))}) {
    std::vector<PointStatus> status;
    const Progress silent;
    const Scaling whole = measureScaling(points, status, Workers(1, silent));
    const PointSource in_batches = {points.rows(), [&](const auto& take) {
                                      for (Eigen::Index i = 0; i < points.rows(); i += 1000)
                                        take(points.middleRows(i, std::min<Eigen::Index>(1000, points.rows() - i)));
                                    }};
    const Scaling passes = measureScaling(in_batches);
    EXPECT_EQ(passes.center, whole.center);
    EXPECT_EQ(passes.exponent, whole.exponent);
    EXPECT_TRUE((passes.lowest == whole.lowest).all());
  }
}

}  // namespace
}  // namespace tufted
