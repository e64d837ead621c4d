// Meshes much longer than wide, whose triangles have corners nearly on a line, as solid modellers write them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "oracles/oracles.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "support/compare.h"
#include "tufted/tufted.h"

namespace tufted::thin_mesh_test {
namespace {

/// Collects points and triangles.
class Builder {
 public:
  int point(double x, double y, double z) {
    points_.push_back({x, y, z});
    return static_cast<int>(points_.size()) - 1;
  }
  void triangle(int a, int b, int c) { triangles_.push_back({a, b, c}); }
  /// All triangles that have corner `from` and an edge of the path.
  void fan(int from, const std::vector<int>& path) {
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
      if (path[i] != from && path[i + 1] != from) triangle(from, path[i], path[i + 1]);
  }

  Points points() const {
    Points all(points_.size(), 3);
    for (std::size_t i = 0; i < points_.size(); ++i) all.row(i) << points_[i][0], points_[i][1], points_[i][2];
    return all;
  }
  Triangles triangles() const {
    Triangles all(triangles_.size(), 3);
    for (std::size_t i = 0; i < triangles_.size(); ++i)
      all.row(i) << triangles_[i][0], triangles_[i][1], triangles_[i][2];
    return all;
  }

 private:
  std::vector<std::array<double, 3>> points_;
  std::vector<std::array<int, 3>> triangles_;
};

enum class Kind { fan_from_near, fan_from_far, both_ends, strip };

/// A rectangle of length 1 and height 1 / aspect in a plane that is not one of the axes', with points along its long
/// sides. Nearly all triangles of a fan from a corner of the side with the points have their corners on a line.
Builder plate(Kind kind, double aspect, std::uint64_t seed) {
  constexpr int cuts = 61;
  shapes::Random random(seed);
  Builder mesh;
  const double c = 0.8, s = 0.6, height = 1 / aspect;
  const auto at = [&](double x, double y) { return mesh.point(c * x, s * x, y); };
  std::vector<double> places;
  for (int i = 1; i <= cuts; ++i) places.push_back((i + random.uniform(-0.4, 0.4)) / (cuts + 1));
  std::vector<int> bottom = {at(0, 0)}, top = {at(0, height)};
  for (const double x : places) bottom.push_back(at(x, 0));
  bottom.push_back(at(1, 0));
  if (kind == Kind::strip)
    for (const double x : places) top.push_back(at(x * x, height));
  top.push_back(at(1, height));
  switch (kind) {
    case Kind::fan_from_near: {
      std::vector<int> around(bottom.begin() + 1, bottom.end());
      around.push_back(top.back());
      around.push_back(top.front());
      mesh.fan(bottom.front(), around);
      break;
    }
    case Kind::fan_from_far:
      mesh.fan(top.front(), bottom);
      mesh.triangle(top.front(), bottom.back(), top.back());
      break;
    case Kind::both_ends: {  // flat fans from both ends, which meet in the middle
      const std::size_t middle = bottom.size() / 2;
      mesh.fan(bottom.front(), {bottom.begin() + 1, bottom.begin() + middle + 1});
      mesh.fan(bottom.back(), {bottom.begin() + middle, bottom.end() - 1});
      mesh.triangle(bottom.front(), bottom[middle], top.front());
      mesh.triangle(top.front(), bottom[middle], top.back());
      mesh.triangle(bottom[middle], bottom.back(), top.back());
      break;
    }
    case Kind::strip:  // one long fan after the other
      mesh.fan(top.front(), bottom);
      mesh.fan(bottom.back(), {top.rbegin(), top.rend()});
      break;
  }
  return mesh;
}

class ThinPlate : public testing::TestWithParam<Kind> {};

TEST_P(ThinPlate, HasItsAreaAndItsFrequenciesUpToTheAspectThatDoublesAllow) {
  for (const double aspect : {1.0, 1e2, 4500.0, 5e4, 1e6, 4e6}) {
    for (const int seed : {101, 102, 103}) {
      const Builder mesh = plate(GetParam(), aspect, seed);
      const Laplacian laplacian = meshLaplacian(mesh.points(), mesh.triangles());
      const double area = 1 / aspect, tolerance = aspect <= 5e4 ? 1e-6 : aspect <= 1e6 ? 1e-4 : 1e-2;
      EXPECT_NEAR(laplacian.M.sum(), area, tolerance * area) << aspect << " " << seed;
      EXPECT_NEAR(laplacian.report.area_added, laplacian.M.sum() - area, 1e-9 * area + 1e-15);
      EXPECT_EQ(laplacian.report.flip_failures, 0);
      EXPECT_TRUE(validate(laplacian).ok()) << aspect << " " << seed;
      EXPECT_EQ(warnings(laplacian.report).empty(), std::abs(laplacian.report.area_added) <= 1e-3 * area);
      if (aspect < 100) continue;  // 64 vertices say little of a square's modes
      const Spectrum modes = spectrum(laplacian, 4);
      for (int k = 1; k < 4; ++k) {
        const double exact = std::pow(k * M_PI, 2);  // of a line, by linear elements on some 60 pieces
        EXPECT_NEAR(modes.values[k], exact, 0.01 * exact) << aspect << " " << seed << " " << k;
      }
    }
  }
}

TEST_P(ThinPlate, IsFlattenedInItsOwnSize) {
  for (const double aspect : {1.0, 1e2, 4500.0}) {
    const Builder mesh = plate(GetParam(), aspect, 101);
    const Laplacian laplacian = meshLaplacian(mesh.points(), mesh.triangles());
    const Eigen::MatrixX2d uv = parameterize(laplacian, mesh.triangles());
    // The ends of the side with 61 points: the first one, and that after the second corner and these.
    const double length = (mesh.points().row(63) - mesh.points().row(0)).norm();
    EXPECT_NEAR((uv.row(63) - uv.row(0)).norm(), length, 0.01 * length) << aspect;
  }
}

TEST_P(ThinPlate, HasOneNormal) {
  for (const double aspect : {1.0, 4500.0, 1e6}) {
    const Builder mesh = plate(GetParam(), aspect, 101);
    const Points normals = meshFrames(mesh.points(), mesh.triangles()).normals;
    const VectorXd cosine = (normals * Eigen::Vector3d(0.6, -0.8, 0)).cwiseAbs();
    EXPECT_NEAR(cosine.minCoeff(), 1, 1e-6) << aspect;
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, ThinPlate,
                         testing::Values(Kind::fan_from_near, Kind::fan_from_far, Kind::both_ends, Kind::strip));

TEST(ThinMesh, BeyondDoublesKeepsTheGuaranteesAndWarns) {
  int warned = 0;
  for (const double aspect : {1e8, 1e10, 1e13}) {
    const Builder mesh = plate(Kind::fan_from_near, aspect, 101);
    const Laplacian laplacian = meshLaplacian(mesh.points(), mesh.triangles());
    EXPECT_TRUE(validate(laplacian).ok()) << aspect;
    warned += warnings(laplacian.report).empty() ? 0 : 1;
    if (warnings(laplacian.report).empty()) {
      EXPECT_NEAR(laplacian.M.sum(), 1 / aspect, 1e-3 / aspect);
    }
  }
  EXPECT_GT(warned, 0);
}

TEST(ThinMesh, FlatTrianglesChangeNothingElsewhere) {
  // A sheet with a flat triangle sewn into one of its edges: rows two edges away change by rounding alone.
  shapes::Mesh grid = shapes::gridSquare(12);
  const Laplacian before = meshLaplacian(grid.points, grid.triangles);
  const int a = grid.triangles(0, 0), b = grid.triangles(0, 1), apex = static_cast<int>(grid.points.rows());
  Points points(apex + 1, 3);
  points << grid.points, (0.7 * grid.points.row(a) + 0.3 * grid.points.row(b));
  Triangles triangles(grid.triangles.rows() + 1, 3);
  triangles << grid.triangles, Eigen::RowVector3i(a, b, apex);
  const Laplacian after = meshLaplacian(points, triangles);
  EXPECT_TRUE(validate(after).ok());
  int same = 0;
  for (int i = 0; i < apex; ++i) {
    const bool is_far = before.L.coeff(i, a) == 0 && before.L.coeff(i, b) == 0;
    if (!is_far) continue;
    for (int j = 0; j < apex; ++j) EXPECT_NEAR(after.L.coeff(i, j), before.L.coeff(i, j), 1e-14);
    EXPECT_NEAR(after.M[i], before.M[i], 1e-14 * before.M[i]);
    ++same;
  }
  EXPECT_GT(same, apex / 2);
}

TEST(ThinMesh, CoincidentVerticesOfAThinPlateCostNoArea) {
  for (const double aspect : {10.0, 4500.0}) {
    Builder mesh = plate(Kind::fan_from_near, aspect, 101);
    const Points points = mesh.points();
    Triangles triangles = mesh.triangles();
    // Every third point of the long side twice, with triangles without area in between.
    Builder doubled;
    for (int i = 0; i < points.rows(); ++i) doubled.point(points(i, 0), points(i, 1), points(i, 2));
    for (int t = 0; t < triangles.rows(); ++t) {
      if (t % 3 == 0) {
        const int old = triangles(t, 1), twin = doubled.point(points(old, 0), points(old, 1), points(old, 2));
        doubled.triangle(triangles(t, 0), old, twin);
        triangles(t, 1) = twin;
      }
      doubled.triangle(triangles(t, 0), triangles(t, 1), triangles(t, 2));
    }
    const Laplacian laplacian = meshLaplacian(doubled.points(), doubled.triangles());
    EXPECT_TRUE(validate(laplacian).ok());
    EXPECT_GT(laplacian.report.lengthened_edges, 0);
    EXPECT_NEAR(laplacian.M.sum(), 1 / aspect, 1e-4 / aspect);
    EXPECT_GT(laplacian.M.minCoeff(), 0);
  }
}

/// A closed bar with eight sides, along which each side is triangulated by fans over `reach` stations.
Builder longBar(double length, int stations, int reach) {
  constexpr int sides = 8;
  Builder mesh;
  std::vector<std::vector<int>> line(sides);
  for (int k = 0; k < sides; ++k)
    for (int i = 0; i < stations; ++i)
      line[k].push_back(mesh.point(length * i / (stations - 1), std::cos(M_PI * k / 4), std::sin(M_PI * k / 4)));
  for (int k = 0; k < sides; ++k) {
    const std::vector<int>&one = line[k], &other = line[(k + 1) % sides];
    for (int i = 0; i + 1 < stations; i += reach) {
      const int end = std::min(i + reach, stations - 1);
      mesh.fan(one[i], {other.rend() - end - 1, other.rend() - i});
      mesh.fan(other[end], {one.begin() + i, one.begin() + end + 1});
    }
  }
  for (const int i : {0, stations - 1}) {
    const int middle = mesh.point(length * i / (stations - 1), 0, 0);
    for (int k = 0; k < sides; ++k) {
      const int one = line[k][i], other = line[(k + 1) % sides][i];
      mesh.triangle(middle, i == 0 ? one : other, i == 0 ? other : one);
    }
  }
  return mesh;
}

TEST(ThinMesh, FlipsOfALongBarWithLongFansEnd) {
  const Builder fans = longBar(9400, 729, 100), even = longBar(9400, 729, 1);
  const Laplacian laplacian = meshLaplacian(fans.points(), fans.triangles());
  EXPECT_EQ(laplacian.report.flip_failures, 0);
  EXPECT_TRUE(warnings(laplacian.report).empty());
  EXPECT_TRUE(validate(laplacian).ok());
  const double exact = std::pow(M_PI / 9400, 2);
  EXPECT_NEAR(spectrum(laplacian, 2).values[1], exact, 1e-3 * exact);
  const Laplacian short_fans = meshLaplacian(even.points(), even.triangles());
  EXPECT_LE(support::largestDifference(laplacian.L, short_fans.L), 1e-6 * support::largestEntry(short_fans.L));
  const oracles::Operators plain = oracles::flippedLaplacian(fans.points(), fans.triangles());
  EXPECT_LE(support::largestDifference(laplacian.L, plain.L), 1e-6 * support::largestEntry(plain.L));
  EXPECT_NEAR(laplacian.M.sum(), plain.M.sum(), 1e-9 * plain.M.sum());
}

TEST(ThinMesh, FlipsAreThoseOfAPlainFlipper) {
  shapes::Random random(104);
  for (const int reach : {1, 7, 30, 100}) {
    Builder bar = longBar(random.uniform(100, 3000), 301, reach);
    const Laplacian laplacian = meshLaplacian(bar.points(), bar.triangles());
    const oracles::Operators plain = oracles::flippedLaplacian(bar.points(), bar.triangles());
    EXPECT_EQ(laplacian.report.flip_failures, 0);
    EXPECT_LE(support::largestDifference(laplacian.L, plain.L), 1e-6 * support::largestEntry(plain.L)) << reach;
    EXPECT_NEAR(laplacian.M.sum(), plain.M.sum(), 1e-9 * plain.M.sum()) << reach;  // cocircular corners share it freely
  }
}

}  // namespace
}  // namespace tufted::thin_mesh_test
