// Systems and eigenpairs on several processes, to be run by mpirun.
#include "tufted/mpi/solves.h"

#include <gtest/gtest.h>

#include "distributed.h"
#include "tufted/distance.h"
#include "tufted/errors.h"
#include "tufted/interpolation.h"
#include "tufted/laplacian.h"
#include "tufted/spectrum.h"

namespace tufted {
namespace {

TEST(DistributedSolves, PoissonIsThatOfTheWhole) {
  Points points(4000, 3);
  points << sphere(2500, 101), sphere(1500, 102, {0, 9, 0});
  points.row(77) = points.row(4);  // coincident: both have the value of one
  points(9, 0) = nan;
  const Laplacian whole = pointCloudLaplacian(points, clean());
  const DistributedLaplacian laplacian = build(spread(points).own);
  const auto f = [&](std::int64_t p) { return points(p, 1) + std::exp(points(p, 2)); };
  DistributedSolve report;
  const Eigen::VectorXd u = byPoint(laplacian, poisson(laplacian, byRow(laplacian, f).get(), &report));
  Eigen::VectorXd given(4000);
  for (int p = 0; p < 4000; ++p) given[p] = whole.status[p] == PointStatus::active ? f(p) : 0;
  const Eigen::MatrixXd expected = poisson(whole, given);
  for (int p = 0; p < 4000; ++p) {
    if (p == 9)
      EXPECT_TRUE(std::isnan(u[p]));
    else
      EXPECT_NEAR(u[p], expected(p, 0), 1e-7 * expected.cwiseAbs().maxCoeff()) << p;
  }
  EXPECT_LE(report.residual, 1e-8);
  EXPECT_LE(report.iterations, 25);
}

TEST(DistributedSolves, PoissonIsTheSameInAnyUnit) {
  const Points points = sphere(900, 101);
  std::vector<Eigen::VectorXd> solved;
  for (const double unit : {1.0, 1e-100, 1e100}) {
    const Points scaled = unit * points;
    const DistributedLaplacian laplacian = build(spread(scaled).own);
    const PetscVector z = byRow(laplacian, [&](std::int64_t p) { return points(p, 2); });
    solved.push_back(byPoint(laplacian, poisson(laplacian, z.get())) / (unit * unit));
    EXPECT_LT((solved.back() - solved[0]).cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST(DistributedSolves, PoissonOfAConstantIsZero) {
  const DistributedLaplacian laplacian = build(spread(sphere(900, 101)).own);
  for (const double value : {0.0, 0.1, 5.3}) {
    const PetscVector f = byRow(laplacian, [&](std::int64_t) { return value; });
    EXPECT_EQ(byPoint(laplacian, poisson(laplacian, f.get())).cwiseAbs().maxCoeff(), 0);
  }
}

// From some 100,000 points on, rounding would add constants to what conjugate gradients look for.
TEST(DistributedSolves, PoissonOfManyPointsConverges) {
  const Points points = sphere(200000, 101);
  const DistributedLaplacian laplacian = build(spread(points).own);
  DistributedSolve report;
  const PetscVector z = byRow(laplacian, [&](std::int64_t p) { return points(p, 2); });
  PetscVector u = poisson(laplacian, z.get(), &report);
  EXPECT_LE(report.iterations, 25);
  PetscReal norm = 0, error = 0;
  VecNorm(z.get(), NORM_2, &norm);
  VecAXPY(u.get(), -0.5, z.get());
  VecNorm(u.get(), NORM_2, &error);
  EXPECT_LT(error, 1e-4 * norm / 2);
}

TEST(DistributedSolves, HarmonicIsThatOfTheWhole) {
  Points points(4000, 3);
  points << sphere(2500, 101), sphere(1500, 102, {0, 9, 0});
  const Laplacian whole = pointCloudLaplacian(points, clean());
  const DistributedLaplacian laplacian = build(spread(points).own);
  // The second sphere has no pin. The last process alone gives them.
  const bool gives = processNumber() == processCount() - 1;
  // Of two values at a point the mean counts.
  const std::vector<std::int64_t> pins =
      gives ? std::vector<std::int64_t>{3, 500, 2000, 3} : std::vector<std::int64_t>();
  const std::vector<PetscInt> rows = rowsOf(laplacian, pins);
  const PetscVector made = harmonic(laplacian, rows, gives ? std::vector<double>{2, -2, .5, 0} : std::vector<double>());
  const Eigen::VectorXd u = byPoint(laplacian, made);
  const Eigen::MatrixXd expected = harmonic(whole, {{3, 500, 2000}, Eigen::Vector3d(1, -2, .5)});
  for (int p = 0; p < 4000; ++p) {
    if (p >= 2500)
      EXPECT_TRUE(std::isnan(u[p]) && std::isnan(expected(p, 0))) << p;
    else
      EXPECT_NEAR(u[p], expected(p, 0), 1e-6) << p;
  }
}

// Sources in the last process alone, a copy among them; a component without one; a surface with boundary and gaps, many
// edges long.
TEST(DistributedSolves, DistanceIsThatOfTheWhole) {
  Points spheres(4000, 3);
  spheres << sphere(2500, 101), sphere(1500, 102, {0, 9, 0});
  spheres.row(77) = spheres.row(4);
  spheres(9, 0) = nan;
  DistanceOptions options;
  options.method = DistanceMethod::heat;
  options.solver.threads = 1;
  for (const Points& points : {spheres, oddTerrain(6000)}) {
    const Laplacian whole = pointCloudLaplacian(points, clean());
    const std::vector<int> sources = {77, 1000};
    const Eigen::VectorXd expected = DistanceSolver(whole, options).query(sources);
    const double largest = (expected.array() < 1e300).select(expected, 0).maxCoeff();
    const DistributedLaplacian laplacian = build(spread(points).own, 4, true);
    const bool gives = processNumber() == processCount() - 1;
    const std::vector<std::int64_t> given = gives ? std::vector<std::int64_t>{77, 1000} : std::vector<std::int64_t>();
    DistributedSolve report;
    const PetscVector made = distance(laplacian, rowsOf(laplacian, given), &report);
    const std::vector<double> found =
        everywhere(valuesByPoint(laplacian, made.get(), std::numeric_limits<double>::infinity()).get());
    for (std::size_t p = 0; p < found.size(); ++p) {
      if (std::isinf(expected[static_cast<Eigen::Index>(p)]))
        EXPECT_TRUE(std::isinf(found[p])) << p;
      else
        EXPECT_NEAR(found[p], expected[static_cast<Eigen::Index>(p)], 1e-6 * largest) << p;
    }
    EXPECT_LE(report.residual, 1e-8);
  }
}

TEST(DistributedSolves, DistanceIsTheSameInAnyUnit) {
  const Points points = sphere(900, 101);
  std::vector<Eigen::VectorXd> solved;
  for (const double unit : {1.0, 1e-100, 1e100}) {
    const Points scaled = unit * points;
    const DistributedLaplacian laplacian = build(spread(scaled).own, 0, true);
    solved.push_back(byPoint(laplacian, distance(laplacian, rowsOf(laplacian, {3}))) / unit);
    EXPECT_LT((solved.back() - solved[0]).cwiseAbs().maxCoeff(), 1e-7);
  }
}

TEST(DistributedSolves, DistanceOnASmallComponentIsAsAccurate) {
  constexpr double radius = 1e-5;
  Points points(1500, 3);
  points << sphere(1000, 101), (radius * sphere(500, 102)).rowwise() + Eigen::RowVector3d(0, 4, 0);
  const std::vector<int> sources = {3, 1200};
  const Eigen::VectorXd expected =
      DistanceSolver(pointCloudLaplacian(points, clean()), {.method = DistanceMethod::heat}).query(sources);
  const DistributedLaplacian laplacian = build(spread(points).own, 0, true);
  const bool gives = processNumber() == 0;
  const std::vector<std::int64_t> given = gives ? std::vector<std::int64_t>{3, 1200} : std::vector<std::int64_t>();
  const Eigen::VectorXd found = byPoint(laplacian, distance(laplacian, rowsOf(laplacian, given)));
  EXPECT_LT((found - expected).head(1000).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((found - expected).tail(500).cwiseAbs().maxCoeff(), 1e-6 * radius);
}

TEST(DistributedSolves, SpectrumIsThatOfTheWhole) {
  Points points(1500, 3);
  points << sphere(1000, 101), .7 * sphere(500, 102, {0, 9, 0});
  SpectrumOptions options;
  options.null_space = false;
  options.threads = 1;
  const Spectrum expected = spectrum(pointCloudLaplacian(points, clean()), 6, options);
  const DistributedLaplacian laplacian = build(spread(points).own);
  const DistributedSpectrum found = spectrum(laplacian, 6);
  ASSERT_EQ(found.values.size(), 6u);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(found.values[i], expected.values[i], 1e-7 * expected.values[i]) << i;
  EXPECT_LE(found.report.residual, 1e-8);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j <= i; ++j) {
      PetscVector product = byRow(laplacian, [](std::int64_t) { return 0; });
      VecPointwiseMult(product.get(), laplacian.M.get(), found.vectors[i].get());
      PetscScalar dot = 0;
      VecDot(product.get(), found.vectors[j].get(), &dot);
      EXPECT_NEAR(dot, i == j ? 1 : 0, 1e-7);
    }
}

TEST(DistributedSolves, RefuseMistakesInEveryProcess) {
  const DistributedLaplacian laplacian = build(spread(sphere(900, 101)).own);
  EXPECT_EQ(refusal([&] { spectrum(laplacian, 0); }), "spectrum: k = 0, must be in [1, 300], a third of the points");
  EXPECT_EQ(refusal([&] { spectrum(laplacian, 4, 1); }), "spectrum: tolerance = 1, must be in (0, 1)");
  EXPECT_EQ(refusal([&] { harmonic(laplacian, {900}, {1}); }), "harmonic: row 900, must be in [0, 900)");
  EXPECT_EQ(refusal([&] { harmonic(laplacian, {}, {}); }), "harmonic: no row has a given value, must be at least one");
  EXPECT_EQ(refusal([&] { distance(laplacian, {3}); }),
            "distance: laplacian has no faces, must be built with TileOptions::faces");
  const DistributedLaplacian with_faces = build(spread(sphere(900, 101)).own, 0, true);
  EXPECT_EQ(refusal([&] { distance(with_faces, {900}); }), "distance: row 900, must be in [0, 900)");
  EXPECT_EQ(refusal([&] { distance(with_faces, {}); }), "distance: no row is a source, must be at least one");
  for (const int odd : {3, 700}) {
    const auto f = [odd](std::int64_t p) { return p == odd ? nan : 1; };
    EXPECT_EQ(refusal([&] { poisson(laplacian, byRow(laplacian, f).get()); }), "poisson: f must be finite");
  }
  EXPECT_EQ(refusal([&] { rowsOf(laplacian, {900}); }), "rowsOf: point 900, must be in [0, 900)");
  TileOptions options;
  options.cloud = cloudOptions(Preset::scan);
  const Points own = spread(sphere(900, 101)).own;
  EXPECT_EQ(refusal([&] { distributedLaplacian(PETSC_COMM_WORLD, sourceOf(PETSC_COMM_WORLD, own), options); }),
            "laplacianByTiles: denoise = true, must be false: noise is not yet found by tiles");
}

}  // namespace
}  // namespace tufted
