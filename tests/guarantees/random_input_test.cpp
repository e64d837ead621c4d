// The guarantees hold on input that no scanner makes: points on tiny lattices, on lines, in clusters of very different
// size, far from the origin, of extreme magnitude, and triangles between any of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "guarantees/guarantees.h"
#include "tufted/check.h"

namespace tufted::guarantees::random_input_test {
namespace {

using testing::IsEmpty;

class RandomInput : public testing::TestWithParam<int> {
 protected:
  int below(int n) { return static_cast<int>(random_() % static_cast<std::uint64_t>(n)); }
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  /// A number of any magnitude between 2^-exponents and 2^exponents.
  double anyMagnitude(int exponents) { return std::ldexp(2 * unit() - 1, below(2 * exponents + 1) - exponents); }

  /// Every run picks one recipe per axis, so planes, lines and single points come up as well.
  Points oddPoints(int n) {
    Points points(n, 3);
    for (int axis = 0; axis < 3; ++axis) {
      const int recipe = below(9);
      const double offset = below(4) == 0 ? std::ldexp(1.0, below(60)) : 0;
      for (int i = 0; i < n; ++i) {
        double& x = points(i, axis);
        switch (recipe) {
          case 0:
            x = 0;
            break;
          case 1:
            x = below(3);
            break;  // a tiny lattice
          case 2:
            x = below(40);
            break;  // a lattice
          case 3:
            x = unit();
            break;  // anywhere
          case 4:
            x = unit() * 1e-9;
            break;  // flat
          case 5:
            x = below(5) + unit() * 1e-13;
            break;  // clusters
          case 6:
            x = anyMagnitude(40);
            break;  // all scales at once
          case 7:
            x = i;
            break;  // a line
          default:
            x = std::ldexp(unit(), -1020 * (1 + below(2)) / 2);
            break;  // near and below the smallest double
        }
        x += offset;
      }
    }
    if (below(3) == 0) {
      constexpr double inf = std::numeric_limits<double>::infinity();
      constexpr double largest = std::numeric_limits<double>::max();
      const double specials[] = {NAN, inf, -inf, largest, -largest, 1e200, 1e-320, -0.0};
      for (int i = 0; i < 1 + n / 10; ++i) points(below(n), below(3)) = specials[below(8)];
    }
    return points;
  }

  Triangles oddTriangles(int vertices, int faces) {
    Triangles triangles(faces, 3);
    const int reach = below(2) == 0 ? vertices : std::min(vertices, 5);  // few vertices: many faces at every edge
    for (int f = 0; f < faces; ++f) {
      for (int s = 0; s < 3; ++s) triangles(f, s) = below(reach);
    }
    return triangles;
  }

 private:
  std::mt19937_64 random_{static_cast<std::uint64_t>(GetParam())};
};

TEST_P(RandomInput, Cloud) {
  for (int round = 0; round < 50; ++round) {
    const int n = 1 + below(round % 2 == 0 ? 12 : 400);
    const Points points = oddPoints(n);
    CloudOptions options = cloudOptions(static_cast<Preset>(below(3)));
    options.neighbors = 3 + below(40);
    options.paper.gluing = below(2) == 0 ? Gluing::star : Gluing::vertex_pair;
    options.paper.order = static_cast<FaceOrder>(below(3));
    SCOPED_TRACE("round " + std::to_string(round) + ", " + std::to_string(n) + " points");
    const Laplacian l = pointCloudLaplacian(points, options);
    ASSERT_THAT(brokenGuarantees(l, points), IsEmpty());
    EXPECT_THAT(validate(l).faults, IsEmpty());
  }
}

TEST_P(RandomInput, Mesh) {
  for (int round = 0; round < 50; ++round) {
    const int n = 1 + below(round % 2 == 0 ? 12 : 200);
    const Points points = oddPoints(n);
    const Triangles triangles = oddTriangles(n, below(3 * n + 5));
    const MeshOptions options{.paper = {.order = static_cast<FaceOrder>(below(3))}};
    SCOPED_TRACE("round " + std::to_string(round) + ", " + std::to_string(n) + " points");
    const Laplacian l = meshLaplacian(points, triangles, options);
    ASSERT_THAT(brokenGuarantees(l, points), IsEmpty());
    EXPECT_THAT(validate(l).faults, IsEmpty());
  }
}

#ifdef TUFTED_SANITIZED
constexpr int past_seeds = 105;
#else
constexpr int past_seeds = 130;
#endif
INSTANTIATE_TEST_SUITE_P(Seeds, RandomInput, testing::Range(100, past_seeds));

}  // namespace
}  // namespace tufted::guarantees::random_input_test
