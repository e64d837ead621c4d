// Harmonic, biharmonic and Poisson problems and Green's functions: bounds, analytic solutions, odd input.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "oracles/oracles.h"
#include "oracles/planar.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "support/odd_cloud.h"
#include "support/overshoot.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::interpolation_test {
namespace {

using support::overshoot;

Pins randomPins(const Laplacian& laplacian, int count, std::uint64_t seed) {
  shapes::Random random(seed);
  Pins pins{{}, Eigen::MatrixXd(count, 2)};
  while (static_cast<int>(pins.points.size()) < count) {
    const auto i = static_cast<int>(random.uniform(0, static_cast<double>(laplacian.status.size())));
    if (laplacian.status[i] == PointStatus::active) pins.points.push_back(i);
  }
  for (double& value : pins.values.reshaped()) value = random.uniform(-1, 3);
  return pins;
}

/// The cotan Laplacian of the triangles as they are, negative weights kept.
Laplacian cotan(const Points& points, const Triangles& triangles) {
  Laplacian laplacian = meshLaplacian(points, triangles);
  const oracles::Operators operators = oracles::cotanLaplacian(points, triangles);
  laplacian.L = operators.L;
  laplacian.M = operators.M;
  return laplacian;
}

TEST(Harmonic, StaysWithinItsPinsWhateverTheSurface) {
  shapes::Cloud room = shapes::depthCamera({.width = 120, .height = 90});
  for (const Points& points :
       {shapes::withNoise(shapes::torus(4000), 0.02).points, room.points, shapes::disk(3000).points,
        shapes::sphere(3000, shapes::Sampling::densityStep(100)).points}) {
    const Laplacian laplacian = pointCloudLaplacian(points);
    for (const int count : {2, 7, 300}) {
      const Pins pins = randomPins(laplacian, count, static_cast<std::uint64_t>(count));
      EXPECT_LE(overshoot(laplacian, harmonic(laplacian, pins), pins), 1e-12) << count;
    }
  }
  for (const shapes::Mesh& mesh : shapes::allMeshes()) {
    const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
    const Pins pins = randomPins(laplacian, 5, 3);
    EXPECT_LE(overshoot(laplacian, harmonic(laplacian, pins), pins), 1e-12) << mesh.name;
  }
}

TEST(Harmonic, StaysWithinItsPinsAtAnObtuseBoundaryWhereOthersDoNot) {
  // Figure 15: no flip mends the angles opposite the long boundary edges.
  int cotan_outside = 0, delaunay_outside = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const oracles::PlanarMesh given = oracles::obtuseSquare(200, 8, seed),
                              delaunay = oracles::obtuseSquare(200, 1, seed);
    const Laplacian ours = meshLaplacian(given.points, given.triangles);
    const auto [pinned, values] = oracles::pinsAtObtuseCorners(given);
    const Pins pins{pinned, values};
    EXPECT_LE(overshoot(ours, harmonic(ours, pins), pins), 1e-12) << seed;
    const Laplacian plain = cotan(given.points, given.triangles), flipped = cotan(delaunay.points, delaunay.triangles);
    cotan_outside += overshoot(plain, harmonic(plain, pins), pins) > 0.01 ? 1 : 0;
    delaunay_outside += overshoot(flipped, harmonic(flipped, pins), pins) > 1e-3 ? 1 : 0;
  }
  EXPECT_GE(cotan_outside, 5);
  EXPECT_GE(delaunay_outside, 5);
}

TEST(Harmonic, IsLinearOnAPlaneWithALinearRim) {
  const shapes::Mesh square = shapes::gridSquare(40);
  const Laplacian laplacian = meshLaplacian(square.points, square.triangles);
  Pins pins;
  for (int i = 0; i < square.points.rows(); ++i) {
    if (laplacian.boundary[i] == Boundary::rim) pins.points.push_back(i);
  }
  pins.values = square.points(pins.points, Eigen::all);
  EXPECT_LE((harmonic(laplacian, pins) - square.points).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(Overshoot, IsInfiniteWhereAValueIsDueAndNotANumber) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::twoSpheres(1));
  const Pins pins{{0, 500}, Eigen::VectorXd{{1, 2}}};
  Eigen::MatrixXd u = harmonic(laplacian, pins);
  ASSERT_TRUE(u.bottomRows(1000).array().isNaN().all());  // no pin is there
  EXPECT_LE(overshoot(laplacian, u, pins), 1e-12);
  u(17, 0) = NAN;
  EXPECT_EQ(overshoot(laplacian, u, pins), HUGE_VAL);
}

TEST(Harmonic, WithOnePinIsConstant) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::torus(5000).points);
  const Eigen::MatrixXd u = harmonic(laplacian, {{17}, Eigen::MatrixXd::Constant(1, 1, 0.1)});
  EXPECT_EQ(u.minCoeff(), 0.1);
  EXPECT_EQ(u.maxCoeff(), 0.1);
}

TEST(Harmonic, StaysWithinItsPinsThoughTheyAreFarFromZero) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::torus(3000).points);
  Pins pins = randomPins(laplacian, 20, 5);
  pins.values = pins.values.array() * 1e-3 + 1e6;
  const Eigen::MatrixXd u = harmonic(laplacian, pins);
  for (int c = 0; c < 2; ++c) {
    EXPECT_LE(u.col(c).maxCoeff(), std::nextafter(pins.values.col(c).maxCoeff(), HUGE_VAL));
    EXPECT_GE(u.col(c).minCoeff(), std::nextafter(pins.values.col(c).minCoeff(), -HUGE_VAL));
  }
  // What a component has beside another one's pins of 10^12 times the range, it has alone.
  const Laplacian two = pointCloudLaplacian(shapes::twoSpheres(1));
  const Pins both{{0, 500, 1000, 1500}, Eigen::VectorXd{{1, 2, -1e12, 1e12}}};
  for (const SolverMethod method : {SolverMethod::cholesky, SolverMethod::multigrid}) {
    const VectorXd all = harmonic(two, both, {.method = method});
    const VectorXd alone = harmonic(two, {{0, 500}, Eigen::VectorXd{{1, 2}}}, {.method = method});
    EXPECT_LE((all - alone).head(1000).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(Harmonic, IsRefinedWhateverTheToleranceAndReportsWhatIsMissingInTheEnd) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::torus(3000).points);
  const Pins pins = randomPins(laplacian, 20, 5);
  SolveReport factored, loose;
  const Eigen::MatrixXd exact = harmonic(laplacian, pins, {}, &factored);
  const Eigen::MatrixXd found =
      harmonic(laplacian, pins, {.method = SolverMethod::multigrid, .tolerance = 0.9}, &loose);
  EXPECT_LE((found - exact).cwiseAbs().maxCoeff(), 1e-12 * 4);
  EXPECT_LE(overshoot(laplacian, found, pins), 1e-12);
  EXPECT_LE(factored.residual, 1e-14);
  EXPECT_LE(loose.residual, 1e-14);
  EXPECT_EQ(factored.iterations, 0);
  EXPECT_GT(loose.iterations, 10);
}

TEST(Interpolation, IsNotANumberWhereNoPinIsAndCopiesFollow) {
  const Laplacian laplacian = pointCloudLaplacian(support::oddCloud());
  const Pins pins{{5, 2000, 700, 2002}, Eigen::VectorXd{{1, 3, 0, 7}}};
  for (const Eigen::MatrixXd& u : {harmonic(laplacian, pins), biharmonic(laplacian, pins),
                                   poisson(laplacian, Eigen::MatrixXd::Constant(2004, 1, 0.1), pins)}) {
    EXPECT_TRUE(u.topRows(1000).allFinite());
    EXPECT_TRUE(u.middleRows(1000, 1000).array().isNaN().all());
    EXPECT_EQ(u(5, 0), 2);  // two pins at one place
    EXPECT_EQ(u(2000, 0), 2);
    EXPECT_EQ(u(700, 0), 0);
    EXPECT_EQ(u(2001, 0), u(8, 0));
    EXPECT_EQ(u(2002, 0), 7);
    EXPECT_TRUE(std::isnan(u(2003, 0)));
  }
}

TEST(Biharmonic, IsSmoothAtItsPinsAndSolvesItsEquation) {
  const Points points = shapes::sphere(4000).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const Pins pins{{0, 1000, 2000, 3000}, Eigen::VectorXd{{0, 1, 0, 2}}};
  const VectorXd u = biharmonic(laplacian, pins);
  VectorXd bending = laplacian.L * VectorXd((laplacian.L * u).cwiseQuotient(laplacian.M));
  const double scale = (laplacian.L * u).cwiseQuotient(laplacian.M).cwiseAbs().maxCoeff();
  for (const int i : pins.points) bending[i] = 0;
  EXPECT_LE(bending.cwiseAbs().maxCoeff(), 1e-9 * scale);
  for (int k = 0; k < 4; ++k) EXPECT_EQ(u[pins.points[k]], pins.values(k, 0));
  // A harmonic function stands out at a pin from its neighbours, this one hardly.
  const auto peak = [&](const VectorXd& v) {
    return std::abs((laplacian.L * v)[3000]) / laplacian.L.coeff(3000, 3000);
  };
  EXPECT_LE(peak(u), peak(harmonic(laplacian, pins)) / 10);
}

TEST(Poisson, FindsAnEigenfunctionOfTheSphere) {
  const Points points = shapes::sphere(8000).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  SolveReport report;
  const Eigen::MatrixXd u = poisson(laplacian, points, {}, &report);  // coordinates have eigenvalue 2
  EXPECT_LE(report.residual, 1e-12);
  EXPECT_LE((2 * u - points).norm() / points.norm(), 5e-3);
  EXPECT_LE((laplacian.M.transpose() * u).cwiseAbs().maxCoeff(), 1e-12);
  // With pins of the truth the truth is found as well.
  const Pins pins{{0, 50}, points({0, 50}, Eigen::all) / 2};
  EXPECT_LE((2 * poisson(laplacian, points, pins) - points).norm() / points.norm(), 0.01);
}

TEST(GreensFunction, IsThatOfTheSphere) {
  const int n = 16000;
  const Points points = shapes::sphere(n).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const double edge = std::sqrt(laplacian.report.mean_squared_edge);
  const std::vector<int> sources = {0, 5000};
  const Eigen::MatrixXd g = greensFunction(laplacian, sources);
  for (int k = 0; k < 2; ++k) {
    double square = 0;
    for (int i = 0; i < n; ++i) {
      const double chord = (points.row(i) - points.row(sources[k])).norm();
      if (chord < 4 * edge) continue;
      const double exact = -(std::log(chord * chord / 4) + 1) / (4 * M_PI);  // 1 - cos = chord^2 / 2
      square += laplacian.M[i] * (g(i, k) - exact) * (g(i, k) - exact);
    }
    EXPECT_LE(std::sqrt(square), 2e-3);
  }
  EXPECT_NEAR(g(5000, 0), g(0, 1), 1e-12);  // symmetric
  EXPECT_LE((laplacian.M.transpose() * g).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Interpolation, NamesWhatACallerGotWrong) {
  Points points = shapes::sphere(500).points;
  points.row(3).setConstant(NAN);
  const Laplacian laplacian = pointCloudLaplacian(points);
  using support::refusal;
  const auto pinned = [&](const Pins& pins) { return refusal([&] { harmonic(laplacian, pins); }); };
  const Eigen::MatrixXd one = Eigen::MatrixXd::Ones(1, 1);
  EXPECT_EQ(pinned({{500}, one}), "harmonic: pins.points has 500, must lie in [0, 500)");
  EXPECT_EQ(pinned({{-1}, one}), "harmonic: pins.points has -1, must lie in [0, 500)");
  EXPECT_EQ(pinned({{1, 2}, one}), "harmonic: pins.values has 1 rows, must have 2, one per point pinned");
  EXPECT_EQ(pinned({{3}, one}),
            "harmonic: pins.points has no point on a component, must have at least one active point: point 3 is not "
            "finite");
  EXPECT_EQ(pinned({{}, Eigen::MatrixXd(0, 1)}),
            "harmonic: pins.points has no point on a component, must have at least one active point");
  EXPECT_EQ(pinned({{1}, NAN * one}), "harmonic: pins.values of point 1 are not finite, must be");
  EXPECT_EQ(pinned({{1}, Eigen::MatrixXd(1, 0)}), "harmonic: pins.values has no column, must have at least one");
  EXPECT_EQ(refusal([&] { biharmonic(laplacian, {{500}, one}); }).find("biharmonic: pins.points"), 0);
  EXPECT_EQ(refusal([&] { poisson(laplacian, one); }),
            "poisson: f has 1 rows, must have 500, one per point of the Laplacian");
  Eigen::MatrixXd f = Eigen::MatrixXd::Ones(500, 1);
  f(3) = NAN;
  EXPECT_EQ(refusal([&] { poisson(laplacian, f); }), "accepted");
  f(4) = NAN;
  EXPECT_EQ(refusal([&] { poisson(laplacian, f); }), "poisson: f of point 4 is not finite, must be");
  EXPECT_EQ(refusal([&] { greensFunction(laplacian, {}); }), "greensFunction: points is empty, must name at least one");
  EXPECT_EQ(refusal([&] { greensFunction(laplacian, {500}); }), "greensFunction: point 500, must lie in [0, 500)");
  EXPECT_EQ(refusal([&] { greensFunction(laplacian, {3}); }),
            "greensFunction: point 3 is not finite, lies on no component, must be active");
}

TEST(Interpolation, FailsTypedWhenSumsOverflow) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::sphere(500).points);
  EXPECT_THROW(harmonic(laplacian, {{0, 50}, Eigen::VectorXd{{1.7e308, 1.7e308}}}), SolverFailure);
  const Pins large{{0, 50}, Eigen::VectorXd{{8e307, -8e307}}};
  EXPECT_LE(overshoot(laplacian, harmonic(laplacian, large), large), 1e-12);
}

}  // namespace
}  // namespace tufted::interpolation_test
