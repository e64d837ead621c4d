// Odd data has a defined result and is counted.
#include <gtest/gtest.h>

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "guarantees/guarantees.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "tufted/tufted.h"

namespace tufted::odd_clouds_test {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Builds, and checks everything that L and M promise.
Laplacian build(const Points& points, const CloudOptions& options = {}) {
  Laplacian laplacian = pointCloudLaplacian(points, options);
  for (const std::string& broken : guarantees::brokenGuarantees(laplacian, points)) ADD_FAILURE() << broken;
  return laplacian;
}

Points sphere(int n) {
  return shapes::sphere(n, shapes::Sampling::uniform, 5).points;
}

Points stack(const Points& a, const Points& b) {
  Points both(a.rows() + b.rows(), 3);
  both << a, b;
  return both;
}

TEST(OddCloud, FewPointsUseAllTheyHave) {
  for (const int n : {0, 1, 2, 3, 10, 31}) {
    const Report report = build(sphere(n)).report;
    EXPECT_EQ(report.points, n);
    EXPECT_EQ(report.active, n < 3 ? 0 : n);
    EXPECT_EQ(report.isolated, n < 3 ? n : 0);
    EXPECT_EQ(report.neighbors, std::min(30, std::max(0, n - 1)));
    EXPECT_EQ(report.neighbors_clamped, n <= 30);
    EXPECT_EQ(report.dropped_triangles, 0);
  }
}

TEST(OddCloud, AFewPointsOfASphereAreActiveInAllPresets) {
  for (const Preset preset : {Preset::clean, Preset::scan, Preset::lidar}) {
    for (int n = 4; n <= 31; ++n) {
      for (std::uint64_t seed = 101; seed <= 109; ++seed) {
        const Points points = shapes::sphere(n, shapes::Sampling::uniform, seed).points;
        EXPECT_EQ(build(points, cloudOptions(preset)).report.active, n) << n << " points, seed " << seed;
      }
    }
  }
}

/// Even permutations of these coordinates, with all signs.
Points corners(const std::vector<Eigen::Vector3d>& some) {
  std::vector<Eigen::Vector3d> all;
  for (const Eigen::Vector3d& corner : some) {
    for (int turn = 0; turn < 3; ++turn) {
      for (int signs = 0; signs < 8; ++signs) {
        Eigen::Vector3d next(corner[turn], corner[(turn + 1) % 3], corner[(turn + 2) % 3]);
        for (int axis = 0; axis < 3; ++axis) next[axis] *= (signs >> axis & 1) != 0 ? -1 : 1;
        if (std::find(all.begin(), all.end(), next) == all.end()) all.push_back(next);
      }
    }
  }
  Points points(std::ssize(all), 3);
  for (Eigen::Index i = 0; i < points.rows(); ++i) points.row(i) = all[i];
  return points;
}

TEST(OddCloud, TheCornersOfRegularSolidsAreActiveInAllPresets) {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  const Points octahedron = corners({{1, 0, 0}}), cube = corners({{1, 1, 1}}), icosahedron = corners({{0, 1, golden}}),
               dodecahedron = corners({{1, 1, 1}, {0, 1 / golden, golden}});
  Points tetrahedron(4, 3);
  tetrahedron << 1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1;
  const std::vector<Points> solids = {tetrahedron, octahedron, cube, icosahedron, dodecahedron};
  const std::vector<int> sizes = {4, 6, 8, 12, 20};
  for (std::size_t s = 0; s < solids.size(); ++s) {
    ASSERT_EQ(solids[s].rows(), sizes[s]);
    for (const Preset preset : {Preset::clean, Preset::scan, Preset::lidar})
      EXPECT_EQ(build(solids[s], cloudOptions(preset)).report.active, sizes[s]);
  }
}

TEST(OddCloud, ThreePointsAreTheTriangleTheySpan) {
  Points points(3, 3);
  points << 0, 0, 0, 3, 0, 0, 0, 4, 0;
  const Laplacian laplacian = build(points);
  EXPECT_NEAR(laplacian.M.sum(), 6, 1e-12);
  // Cotangents 0, 3/4 and 4/3 opposite the sides of length 5, 3 and 4; weights are half of them.
  EXPECT_NEAR(laplacian.L.coeff(0, 1), -2.0 / 3, 1e-12);
  EXPECT_NEAR(laplacian.L.coeff(0, 2), -3.0 / 8, 1e-12);
  EXPECT_NEAR(laplacian.L.coeff(1, 2), 0, 1e-12);
}

TEST(OddCloud, CopiesOfOnePointAreOneIsolatedPoint) {
  const Laplacian laplacian = build(Points::Constant(40, 3, 0.7));
  EXPECT_EQ(laplacian.report.coincident, 39);
  EXPECT_EQ(laplacian.report.isolated, 1);
  EXPECT_EQ(laplacian.L.nonZeros(), 0);
  EXPECT_EQ(laplacian.representative, std::vector<int>(40, 0));
}

TEST(OddCloud, EveryPointTwiceIsTheCloudOnce) {
  const Points once = sphere(2000);
  const Laplacian single = build(once), twice = build(stack(once, once));
  EXPECT_EQ(twice.report.coincident, 2000);
  EXPECT_EQ(twice.L.nonZeros(), single.L.nonZeros());
  EXPECT_EQ(twice.M.head(2000), single.M);
  EXPECT_TRUE(twice.M.tail(2000).isZero(0));
  for (int i = 0; i < 2000; ++i) {
    EXPECT_EQ(twice.representative[2000 + i], i);
    EXPECT_EQ(twice.status[2000 + i], PointStatus::coincident);
  }
}

TEST(OddCloud, FortyCopiesOfAPointDoNotCrowdOutItsNeighbours) {
  const Points once = sphere(2000);
  const Laplacian laplacian = build(stack(Points(once.row(17).replicate(40, 1)), once));
  EXPECT_EQ(laplacian.report.coincident, 40);
  EXPECT_EQ(laplacian.representative[40 + 17], 0);
  EXPECT_NEAR(laplacian.M.sum(), build(once).M.sum(), 1e-12);
}

TEST(OddCloud, CollinearPointsHaveNoTriangles) {
  Points points(100, 3);
  for (int i = 0; i < 100; ++i) points.row(i) << i, 2 * i, -i;
  const Laplacian laplacian = build(points);
  EXPECT_EQ(laplacian.report.isolated, 100);
  EXPECT_EQ(laplacian.L.nonZeros(), 0);
}

TEST(OddCloud, PointsThatAreNotFiniteKeepTheirIndex) {
  const Points clean = sphere(3000);
  for (const double part : {1.0 / 3000, 0.3, 1.0}) {
    Points points = clean;
    shapes::Random random(3);
    int odd = 0;
    for (int i = 0; i < 3000; ++i) {
      if (i > 0 && random.uniform() >= part) continue;
      points(i, i % 3) = i % 2 == 0 ? not_a_number : INFINITY;
      ++odd;
    }
    const Laplacian laplacian = build(points);
    EXPECT_EQ(laplacian.report.not_finite, odd);
    EXPECT_EQ(laplacian.report.active, 3000 - odd);
    EXPECT_EQ(laplacian.status[0], PointStatus::not_finite);
    EXPECT_NEAR(laplacian.M.sum(), odd < 3000 ? 4 * M_PI : 0, 0.1);
  }
}

TEST(OddCloud, ASentinelDoesNotFlattenTheRest) {
  const Points clean = sphere(3000);
  const Laplacian reference = build(clean);
  for (const double sentinel : {FLT_MAX * 1.0, 1e150, DBL_MAX}) {
    const Laplacian laplacian = build(stack(clean, Points::Constant(1, 3, sentinel)));
    EXPECT_NE(laplacian.status[3000], PointStatus::active) << sentinel;
    EXPECT_NEAR(laplacian.M.sum(), reference.M.sum(), 1e-9) << sentinel;
  }
}

TEST(OddCloud, AnOutlierChangesNothingAwayFromIt) {
  const Points clean = sphere(3000);
  const Laplacian reference = build(clean);
  const Laplacian laplacian = build(stack(clean, Eigen::RowVector3d(1e6, 0, 0)));
  EXPECT_EQ(laplacian.M[3000], 0);
  EXPECT_EQ(laplacian.status[3000], PointStatus::isolated);
  EXPECT_LE((laplacian.M.head(3000) - reference.M).cwiseAbs().maxCoeff(), 1e-9 * reference.M.maxCoeff());
}

TEST(OddCloud, TwoClustersFarApartAreTwoComponents) {
  const Points one = sphere(2000);
  const Laplacian reference = build(one);
  const Laplacian laplacian = build(stack(one, Points(one.rowwise() + Eigen::RowVector3d(1e6, 0, 0))));
  EXPECT_EQ(laplacian.report.components, 2);
  EXPECT_NEAR(laplacian.M.head(2000).sum(), reference.M.sum(), 1e-9);
  EXPECT_NEAR(laplacian.M.tail(2000).sum(), reference.M.sum(), 1e-6);
}

TEST(OddCloud, TinyAndHugeScalesChangeOnlyTheUnit) {
  const Points points = sphere(2000);
  const Laplacian reference = build(points);
  for (const double scale : {1e-150, 1e150}) {
    const Laplacian laplacian = build(scale * points);
    EXPECT_EQ(laplacian.report.active, 2000) << scale;
    EXPECT_LE((laplacian.M / scale / scale - reference.M).cwiseAbs().maxCoeff(), 1e-9 * reference.M.maxCoeff());
    EXPECT_LE(SparseMatrix(laplacian.L - reference.L).norm(), 1e-9 * reference.L.norm()) << scale;
  }
}

TEST(OddCloud, PiecesOfAnyScaleAreTreatedAlike) {
  // Noise has triangles that the votes condemn. L and the areas of the cover are not compared: where copies of one
  // triangle end a star, the order that they are glued in goes by rank.
  Points points = shapes::withNoise(shapes::square(2000), 0.02).points;
  points.array() += 1;
  const auto n = points.rows();
  CloudOptions options{.mollify = 0};
  options.steps.denoise = false;  // which points are looked at first goes by rank as well
  const Laplacian one = build(points, options);
  EXPECT_GT(one.report.dropped_triangles, 0);
  for (const double scale : {0x1p-20, 0x1p-190, 0x1p190}) {
    const Laplacian both = build(stack(points, scale * points), options);
    EXPECT_EQ(both.report.components, 2) << scale;
    EXPECT_EQ(both.report.dropped_triangles, 2 * one.report.dropped_triangles) << scale;
    for (int v = 0; v < 3; ++v) EXPECT_EQ(both.report.votes[v], 2 * one.report.votes[v]) << scale;
    for (Eigen::Index i = 0; i < n; ++i) {
      EXPECT_EQ(both.boundary[i], one.boundary[i]) << scale;
      if (one.boundary[i] == Boundary::none) continue;
      EXPECT_NEAR(both.M[i], one.M[i], 1e-12 * one.M[i]) << scale;
      EXPECT_NEAR(both.M[n + i] / (scale * scale), one.M[i], 1e-12 * one.M[i]) << scale;
    }
  }
}

TEST(OddCloud, AllOddAtOnce) {
  Points points = stack(sphere(1000), Points(sphere(1000) * 1e-3));
  points = stack(points, Points(points.topRows(200)));
  for (int i = 0; i < 500; ++i) points.row(3 * i).setConstant(not_a_number);
  const Report report = build(points).report;
  EXPECT_EQ(report.points, report.active + report.not_finite + report.coincident + report.isolated);
}

}  // namespace
}  // namespace tufted::odd_clouds_test
