// Thin parts: where normals are given, the two sides are not neighbours.
#include <gtest/gtest.h>

#include <cmath>

#include "shapes/random.h"
#include "shapes/shapes.h"
#include "tufted/tufted.h"

namespace tufted::own_side_test {
namespace {

/// Two square sheets, one above the other, with normals that point apart. Points of even index are on the lower one.
struct Plate {
  Points points, normals;
  double area;  ///< of both
};

/// @param gap,noise in spacings, the root of the area per point
Plate plate(int n, double gap, double noise, std::uint64_t seed) {
  shapes::Random random(seed);
  const double side = std::sqrt(n / 2.0);
  Plate made{Points(n, 3), Points(n, 3), 2 * side * side};
  for (int i = 0; i < n; ++i) {
    const bool is_upper = i % 2 != 0;
    const double x = side * random.uniform(), y = side * random.uniform();
    made.points.row(i) << x, y, (is_upper ? gap : 0) + noise * random.normal();
    made.normals.row(i) << 0, 0, is_upper ? 1 : -1;
  }
  return made;
}

int edgesAcross(const Laplacian& laplacian) {
  int across = 0;
  for (Eigen::Index column = 0; column < laplacian.L.cols(); ++column)
    for (SparseMatrix::InnerIterator entry(laplacian.L, column); entry; ++entry)
      across += entry.value() != 0 && (entry.row() + entry.col()) % 2 != 0 ? 1 : 0;
  return across / 2;
}

TEST(OpposedNormals, KeepTheSidesOfAThinPlateApart) {
  struct Case {
    double gap, noise;
  };
  for (const Preset preset : {Preset::clean, Preset::scan}) {
    for (const auto& [gap, noise] : {Case{1, 0}, {1.5, 0.1}, {2, 0.1}}) {
      SCOPED_TRACE(std::to_string(gap) + " spacings, preset " + std::to_string(static_cast<int>(preset)));
      const Plate thin = plate(4000, gap, noise, 101);
      CloudOptions options = cloudOptions(preset);
      const Laplacian without = pointCloudLaplacian(thin.points, options);
      options.normals = &thin.normals;
      const Laplacian with = pointCloudLaplacian(thin.points, options);
      EXPECT_GT(edgesAcross(without), 100);
      EXPECT_EQ(edgesAcross(with), 0);
      // Stars on the rim do not reach it.
      EXPECT_NEAR(with.M.sum(), thin.area, 0.05 * thin.area);
    }
  }
}

TEST(OpposedNormals, KeepASharpEdgeTogether) {
  // Two squares that meet at an edge, one turned about it. Points of even index are on the flat one.
  constexpr int n = 4000;
  for (const double degrees : {58.0, 30.0, 15.0}) {
    const double angle = degrees * M_PI / 180, side = std::sqrt(n / 2.0);
    shapes::Random random(101);
    Points points(n, 3), normals(n, 3);
    for (int i = 0; i < n; ++i) {
      const double turn = i % 2 != 0 ? angle : 0, sign = i % 2 != 0 ? 1 : -1;
      const double x = side * random.uniform(), y = side * random.uniform();
      points.row(i) << x * std::cos(turn), y, x * std::sin(turn);
      normals.row(i) << -sign * std::sin(turn), 0, sign * std::cos(turn);
    }
    for (const Preset preset : {Preset::clean, Preset::scan}) {
      CloudOptions options = cloudOptions(preset);
      options.normals = &normals;
      const Laplacian laplacian = pointCloudLaplacian(points, options);
      EXPECT_EQ(componentSizes(componentLabels(laplacian)).size(), 1u) << degrees;
      EXPECT_GT(edgesAcross(laplacian), 200) << degrees;
    }
  }
}

TEST(OpposedNormals, OfArbitrarySignsChangeNothingOnASphere) {
  const shapes::Cloud ball = shapes::sphere(2000);
  shapes::Random random(101);
  const Points outwards = ball.points;
  Points arbitrary = outwards;
  for (int i = 0; i < arbitrary.rows(); ++i)
    if (random.uniform() < 0.5) arbitrary.row(i) *= -1;
  for (const Preset preset : {Preset::clean, Preset::scan}) {
    CloudOptions options = cloudOptions(preset);
    options.normals = &outwards;
    const Laplacian expected = pointCloudLaplacian(ball.points, options);
    options.normals = &arbitrary;
    const Laplacian found = pointCloudLaplacian(ball.points, options);
    const SparseMatrix difference = found.L - expected.L;
    EXPECT_LE(difference.coeffs().cwiseAbs().maxCoeff(), 1e-12 * expected.L.diagonal().maxCoeff());
  }
}

}  // namespace
}  // namespace tufted::own_side_test
