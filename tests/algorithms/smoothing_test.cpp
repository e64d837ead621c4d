// Implicit smoothing: what the heat equation keeps, what it does to a sphere, and what callers may ask for.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "shapes/shapes.h"
#include "support/compare.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::smoothing_test {
namespace {

using Mask = std::vector<std::uint8_t>;

/// Active points of each connected component of L.
std::vector<std::vector<int>> componentsOf(const Laplacian& laplacian) {
  std::vector<std::vector<int>> components;
  std::vector<bool> seen(laplacian.status.size(), false);
  for (int start = 0; start < static_cast<int>(seen.size()); ++start) {
    if (seen[start] || laplacian.status[start] != PointStatus::active) continue;
    std::vector<int>& found = components.emplace_back(1, start);
    seen[start] = true;
    for (std::size_t k = 0; k < found.size(); ++k) {
      for (SparseMatrix::InnerIterator entry(laplacian.L, found[k]); entry; ++entry) {
        const int j = static_cast<int>(entry.row());
        if (!seen[j]) found.push_back(j);
        seen[j] = true;
      }
    }
  }
  return components;
}

std::vector<std::pair<std::string, Points>> differentClouds() {
  shapes::Cloud room = shapes::depthCamera({.width = 160, .height = 120});
  return {{"two spheres", shapes::twoSpheres(0.1)},
          {"depth camera", std::move(room.points)},
          {"noisy torus", shapes::withNoise(shapes::torus(4000), 0.01).points},
          {"disk", shapes::disk(2000).points}};
}

TEST(Smoothing, SolvesTheImplicitStep) {
  const Points points = shapes::torus(4000).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const double t = 5, unit = laplacian.report.mean_squared_edge;
  const Points smoothed = smooth(laplacian, points, {.time_step = t});
  const Points residual = laplacian.M.asDiagonal() * (smoothed - points) + t * unit * (laplacian.L * smoothed);
  EXPECT_LE(residual.cwiseAbs().maxCoeff(), 1e-13 * laplacian.M.maxCoeff());
  EXPECT_GT((smoothed - points).rowwise().norm().maxCoeff(), 0.1 * std::sqrt(unit));
}

TEST(Smoothing, ShrinksASphereAsItsEigenvalueSays) {
  // Linear functions are eigenfunctions of the sphere of radius R with eigenvalue 2 / R^2.
  const double radius = 3;
  const Points points = radius * shapes::sphere(16000).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  for (const double t : {10.0, 1000.0}) {
    for (const int steps : {1, 3}) {
      const double unit = laplacian.report.mean_squared_edge;
      const double factor = std::pow(1 + 2 * t * unit / (radius * radius), -steps);
      const Points smoothed = smooth(laplacian, points, {.time_step = t, .iterations = steps});
      const double scale = smoothed.cwiseProduct(points).sum() / points.squaredNorm();
      EXPECT_NEAR((1 - scale) / (1 - factor), 1, 2e-3) << t << ", " << steps;
    }
  }
}

TEST(Smoothing, KeepsEachCoordinateInTheRangeOfItsComponent) {
  for (const auto& [name, points] : differentClouds()) {
    const Laplacian laplacian = pointCloudLaplacian(points);
    for (const double t : {1.0, 1e4, 1e10}) {
      const Points smoothed = smooth(laplacian, points, {.time_step = t, .iterations = 2});
      for (const std::vector<int>& component : componentsOf(laplacian)) {
        const Points before = points(component, Eigen::all), after = smoothed(component, Eigen::all);
        const Eigen::RowVector3d low = before.colwise().minCoeff(), high = before.colwise().maxCoeff();
        const double rounding = 1e-12 * (high - low).maxCoeff();
        EXPECT_TRUE((after.colwise().minCoeff().array() >= low.array() - rounding).all()) << name << ", " << t;
        EXPECT_TRUE((after.colwise().maxCoeff().array() <= high.array() + rounding).all()) << name << ", " << t;
      }
    }
  }
}

TEST(Smoothing, KeepsTheCentroidOfEachComponent) {
  for (const auto& [name, points] : differentClouds()) {
    const Laplacian laplacian = pointCloudLaplacian(points);
    const Points smoothed = smooth(laplacian, points, {.time_step = 3, .iterations = 3});
    for (const std::vector<int>& component : componentsOf(laplacian)) {
      const VectorXd M = laplacian.M(component);
      const Points before = points(component, Eigen::all), after = smoothed(component, Eigen::all);
      const double moved = (M.transpose() * (after - before)).norm() / M.sum();
      const double extent = (before.colwise().maxCoeff() - before.colwise().minCoeff()).norm();
      EXPECT_LE(moved, 1e-12 * extent) << name << ", " << component.size() << " points";
    }
  }
}

TEST(Smoothing, HoldsForComponentsOfAnyTwoSizes) {
  // The small sphere's mass is lost beside its row of t L: without a least mass the matrix is singular.
  for (const double radius : {1e-6, 1e-9}) {
    const Points points = shapes::twoSpheres(radius);
    const Points smoothed = smooth(pointCloudLaplacian(points), points, {.time_step = 1e6});
    const Points small = points.bottomRows(1000), after = smoothed.bottomRows(1000);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GE(after.col(axis).minCoeff(), small.col(axis).minCoeff() - 4e-15);
      EXPECT_LE(after.col(axis).maxCoeff(), small.col(axis).maxCoeff() + 4e-15);
    }
  }
}

TEST(Smoothing, MeasuresTimeInMeanSquaredEdges) {
  // Sides of 3, 4 and 5 make the unit 50 / 3, not 4^2. Of the two corners held, the second alone pulls along x.
  const Points points{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}};
  const Laplacian laplacian = meshLaplacian(points, Triangles{{0, 1, 2}});
  EXPECT_DOUBLE_EQ(laplacian.report.mean_squared_edge, 50.0 / 3);
  const Mask fixed = {0, 1, 1};
  const double t = 0.25 * 50 / 3;
  const Points smoothed = smooth(laplacian, points, {.time_step = 0.25, .fixed = &fixed});
  const double mass = laplacian.M[0], diagonal = laplacian.L.coeff(0, 0);
  EXPECT_NEAR(smoothed(0, 0), -t * laplacian.L.coeff(0, 1) * 3 / (mass + t * diagonal), 1e-14);
}

TEST(Smoothing, GoesOnWhereAreasUnderflow) {
  const Points points = std::ldexp(1.0, -560) * shapes::torus(500).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  ASSERT_EQ(laplacian.M.maxCoeff(), 0);
  const Points smoothed = smooth(laplacian, points);
  EXPECT_LE(smoothed.cwiseAbs().maxCoeff(), points.cwiseAbs().maxCoeff());
}

TEST(Smoothing, FollowsTheCloudWhereverItLies) {
  // Coordinates are multiples of 2^-20, so moving and doubling are exact.
  const Points points = shapes::ellipsoid(4000).points;
  const auto smoothed = [](const Points& cloud) {
    return smooth(pointCloudLaplacian(cloud), cloud, {.time_step = 4, .iterations = 2});
  };
  const Points reference = smoothed(points);
  const Eigen::RowVector3d offset(500000, 4000000, 100);
  const Points moved = smoothed(points.rowwise() + offset);
  EXPECT_LE((moved - (reference.rowwise() + offset)).cwiseAbs().maxCoeff(), 1e-9);  // a step of doubles at 4e6
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  EXPECT_LE((smoothed(points * turn.transpose()) - reference * turn.transpose()).cwiseAbs().maxCoeff(), 1e-11);
  for (const double scale : {std::ldexp(1.0, 60), std::ldexp(1.0, -60)}) {
    EXPECT_EQ(smoothed(scale * points), scale * reference);
  }
}

TEST(Smoothing, ForNoTimeChangesNothing) {
  const Points points = shapes::sphere(1000).points;
  EXPECT_EQ(smooth(pointCloudLaplacian(points), points, {.time_step = 0, .iterations = 5}), points);
}

TEST(Smoothing, InSeveralStepsIsOneStepAfterTheOther) {
  const Points points = shapes::withNoise(shapes::torus(2000), 0.02).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  Points one_by_one = points;
  for (int step = 0; step < 3; ++step) one_by_one = smooth(laplacian, one_by_one);
  EXPECT_LE((smooth(laplacian, points, {.iterations = 3}) - one_by_one).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(Smoothing, LeavesFixedPointsWhereTheyAre) {
  // With its rim held, a flat disk stays flat and a bump in it goes down, at last to the plane.
  const Points flat = shapes::disk(2000, shapes::Sampling::jittered, shapes::Rim::included).points;
  Points bump = flat;
  bump.col(2) = 0.2 * (1 - flat.rowwise().squaredNorm().array());
  const Laplacian laplacian = pointCloudLaplacian(bump);
  Mask rim(2000, 0);
  for (int i = 0; i < 2000; ++i) rim[i] = flat.row(i).norm() > 1 - 1e-6 ? 1 : 0;
  ASSERT_GT(std::count(rim.begin(), rim.end(), 1), 100);
  const Points smoothed = smooth(laplacian, bump, {.time_step = 1e9, .fixed = &rim});
  for (int i = 0; i < 2000; ++i) {
    EXPECT_TRUE(rim[i] == 0 || smoothed.row(i) == bump.row(i)) << i;
    EXPECT_NEAR(smoothed(i, 2), 0, 1e-5) << i;
  }
  EXPECT_GT(smoothed.rowwise().norm().maxCoeff(), 0.99);
}

TEST(Smoothing, LeavesOddPointsAndMovesCopiesTogether) {
  Points points = shapes::torus(1003).points;
  points.row(7).setConstant(NAN);
  points.row(1000) = points.row(5);          // a copy of a free point
  points.row(1001) = points.row(9);          // a copy that is fixed
  points.row(1002) << 1e90, 1e90, INFINITY;  // nowhere
  const Laplacian laplacian = pointCloudLaplacian(points);
  Mask fixed(1003, 0);
  fixed[1001] = 1;
  const Points smoothed = smooth(laplacian, points, {.fixed = &fixed});
  EXPECT_TRUE(smoothed.row(7).array().isNaN().all());
  EXPECT_NE(smoothed.row(5), points.row(5));
  EXPECT_EQ(smoothed.row(1000), smoothed.row(5));
  EXPECT_EQ(smoothed.row(9), points.row(9));
  EXPECT_EQ(smoothed.row(1001), points.row(9));
  EXPECT_EQ(smoothed.row(1002), points.row(1002));

  const Points line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}};
  EXPECT_EQ(smooth(pointCloudLaplacian(line), line), line);
  EXPECT_EQ(smooth(pointCloudLaplacian(Points(0, 3)), Points(0, 3)).rows(), 0);
}

TEST(Smoothing, TakesMeshes) {
  const shapes::Mesh ball = shapes::icosphere(4);
  const Laplacian laplacian = meshLaplacian(ball.points, ball.triangles);
  const Points smoothed = smooth(laplacian, ball.points, {.time_step = 10});
  const double unit = laplacian.report.mean_squared_edge;
  EXPECT_NEAR(smoothed.rowwise().norm().mean(), 1 / (1 + 2 * 10 * unit), 2e-3);
}

TEST(Smoothing, NamesWhatACallerGotWrong) {
  const Points points = shapes::sphere(500).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const Mask short_mask(499, 0);
  Points odd = points;
  odd(3, 1) = NAN;
  const auto refusal = [&](const Points& cloud, const SmoothingOptions& options) {
    return support::refusal([&] { smooth(laplacian, cloud, options); });
  };
  EXPECT_EQ(refusal(points, {.time_step = -1}), "smooth: time_step = -1, must be finite and at least 0");
  EXPECT_NE(refusal(points, {.time_step = NAN}), "accepted");
  EXPECT_NE(refusal(points, {.time_step = INFINITY}), "accepted");
  // Masses would be lost beside t L, and with them the centre where all points come together.
  EXPECT_EQ(refusal(points, {.time_step = 1e300}), "smooth: time_step = 1e+300, must be at most 1e+10");
  const Points together = smooth(laplacian, points, {.time_step = 1e10});
  const Eigen::RowVector3d centre = laplacian.M.transpose() * points / laplacian.M.sum();
  EXPECT_LT((together.rowwise() - centre).rowwise().norm().maxCoeff(), 1e-5);
  EXPECT_EQ(refusal(points, {.iterations = 0}), "smooth: iterations = 0, must be at least 1");
  EXPECT_EQ(refusal(points, {.solver = {.threads = -1}}), "smooth: threads = -1, must be >= 0");
  EXPECT_EQ(refusal(points, {.fixed = &short_mask}),
            "smooth: fixed has 499 rows, must have 500, one per point of the Laplacian");
  EXPECT_EQ(refusal(points.topRows(10), {}),
            "smooth: points has 10 rows, must have 500, one per point of the Laplacian");
  EXPECT_EQ(refusal(odd, {}), "smooth: point 3 is not finite, must be: the Laplacian has it active");
}

TEST(Smoothing, OfValuesIsThatOfPositions) {
  const Points points = shapes::torus(1000).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  for (const SmoothingMethod method : {SmoothingMethod::implicit, SmoothingMethod::taubin}) {
    const SmoothingOptions options{.method = method, .iterations = 2};
    EXPECT_EQ(Points(smoothValues(laplacian, points, options)), smooth(laplacian, points, options));
    Eigen::MatrixXd single = points.col(1);
    EXPECT_LE((smoothValues(laplacian, single, options) - smooth(laplacian, points, options).col(1)).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace tufted::smoothing_test
