#include "tufted/tiles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "shapes/random.h"
#include "shapes/shapes.h"
#include "tufted/laplacian.h"

namespace tufted {
namespace {

struct Collected {
  Laplacian laplacian;
  TileReport report;
};

/// The rows of all tiles, put together.
Collected byTiles(const Points& points, const CloudOptions& options, int tiles) {
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
  result.report = laplacianByTiles(sourceOf(points), {.cloud = options, .tiles = tiles, .folder = "/tmp"},
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

/// Entries of L that differ in more than the last bits, and in any bit.
void expectSame(const Laplacian& part, const Laplacian& whole) {
  ASSERT_EQ(part.status, whole.status);
  ASSERT_EQ(part.boundary, whole.boundary);
  ASSERT_EQ(part.representative, whole.representative);
  double worst = 0, worst_mass = 0;
  for (int i = 0; i < whole.L.cols(); ++i) {
    ASSERT_NEAR(part.M[i], whole.M[i], 1e-12 * whole.M[i]) << i;
    worst_mass = std::max(worst_mass, std::abs(part.M[i] - whole.M[i]) / std::max(whole.M[i], 1e-300));
    SparseMatrix::InnerIterator a(part.L, i), b(whole.L, i);
    for (; a && b; ++a, ++b) {
      ASSERT_EQ(a.row(), b.row()) << i;
      const double larger = std::max(whole.L.coeff(i, i), whole.L.coeff(b.row(), b.row()));
      ASSERT_NEAR(a.value(), b.value(), 1e-12 * larger) << i << " " << b.row();
      worst = std::max(worst, std::abs(a.value() - b.value()) / larger);
    }
    ASSERT_EQ(static_cast<bool>(a), static_cast<bool>(b)) << i;
    if (whole.status[i] == PointStatus::active) {
      ASSERT_NEAR(std::abs(part.frames.normals.row(i).dot(whole.frames.normals.row(i))), 1, 1e-12);
    }
  }
  printf("worst %g mass %g\n", worst, worst_mass);
}

CloudOptions one(Preset preset) {
  CloudOptions options = cloudOptions(preset);
  options.threads = 1;
  return options;
}

void expectSameByTiles(const Points& points, const CloudOptions& options = one(Preset::clean)) {
  const Laplacian whole = pointCloudLaplacian(points, options);
  for (const int tiles : {2, 3, 8}) {
    const Collected part = byTiles(points, options, tiles);
    SCOPED_TRACE(tiles);
    printf("tiles %d builds %d cells %d held %d margin %g\n", part.report.tiles, part.report.builds,
           (int)part.report.cells, (int)part.report.most_points, part.report.margin);
    expectSame(part.laplacian, whole);
    EXPECT_EQ(part.report.tiles, tiles);
    EXPECT_LT(part.report.most_points, points.rows());
    EXPECT_EQ(part.report.active, whole.report.active);
  }
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

/// Points as a scanner sees a terrain: a third of them missing by chance, some below and above.
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
  expectSameByTiles(shapes::sphere(40000).points);
}

TEST(Tiles, OfANoisySphereAreThoseOfTheWhole) {
  expectSameByTiles(noisySphere(40000, 0.3));
  expectSameByTiles(noisySphere(60000, 0.3), scan());
}

TEST(Tiles, OfALatticeAreThoseOfTheWhole) {
  expectSameByTiles(steppedTerrain(200));
  expectSameByTiles(steppedTerrain(200), scan());
}

TEST(Tiles, OfLinesAreThoseOfTheWhole) {
  expectSameByTiles(shapes::torus(30000, shapes::Sampling::scanLines(6)).points);
}

TEST(Tiles, OfATerrainWithOutliersAreThoseOfTheWhole) {
  expectSameByTiles(roughTerrain(40000));
  expectSameByTiles(roughTerrain(60000), scan());
}

TEST(Tiles, OfDuplicatesAndMissingPointsAreThoseOfTheWhole) {
  const Points once = shapes::sphere(30000).points;
  Points points(40000, 3);
  points << once, once.topRows(10000);
  points.middleRows(5000, 100).setConstant(NAN);
  points.row(7) << 1e300, 0, 0;
  expectSameByTiles(points);
}

}  // namespace
}  // namespace tufted
