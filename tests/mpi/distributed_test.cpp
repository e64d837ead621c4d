// To be run by mpirun on several processes: each makes the whole cloud and builds its L and M alone, as what the
// processes share must be.
#include <gtest/gtest.h>
#include <slepc.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "../support/refusal.h"
#include "tufted/components.h"
#include "tufted/distance.h"
#include "tufted/errors.h"
#include "tufted/interpolation.h"
#include "tufted/laplacian.h"
#include "tufted/mpi/solves.h"
#include "tufted/spectrum.h"

namespace tufted {
namespace {

using support::refusal;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

int processNumber() {
  int number = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &number);
  return number;
}
int processCount() {
  int count = 0;
  MPI_Comm_size(PETSC_COMM_WORLD, &count);
  return count;
}

CloudOptions clean() {
  CloudOptions options = cloudOptions(Preset::clean);
  options.threads = 1;
  return options;
}

Points sphere(int n, int seed, const Eigen::RowVector3d& center = {0, 0, 0}, double noise = 0) {
  std::mt19937_64 random(static_cast<unsigned>(seed));
  std::normal_distribution<double> normal;
  Points points(n, 3);
  for (int i = 0; i < n; ++i) {
    const Eigen::RowVector3d direction(normal(random), normal(random), normal(random));
    points.row(i) = center + direction.normalized() * (1 + noise * normal(random));
  }
  return points;
}

/// A wavy sheet in rows of unequal spacing, a cluster of few points far away, copies and points that are not finite.
Points oddTerrain(int n) {
  std::mt19937_64 random(102);
  std::uniform_real_distribution<double> uniform(0, 1);
  Points points(n, 3);
  for (int i = 0; i < n; ++i) {
    const double x = 10 * uniform(random), y = std::round(40 * uniform(random)) / 4;
    points.row(i) << x, y, .3 * std::sin(x) * std::cos(y);
  }
  for (int i = 0; i < 12; ++i) points.row(17 * i + 3) << 200 + uniform(random), 300 + uniform(random), 50;
  for (int i = 0; i < 40; ++i) points.row(n - 1 - 7 * i) = points.row(31 * i);
  points(5, 1) = nan;
  points(n / 2, 0) = std::numeric_limits<double>::infinity();
  return points;
}

/// All points, and those of this process.
struct Cloud {
  Points all, own;
};

Cloud spread(const Points& points) {
  const Eigen::Index first = points.rows() * processNumber() / processCount();
  const Eigen::Index last = points.rows() * (processNumber() + 1) / processCount();
  return {points, points.middleRows(first, last - first)};
}

DistributedLaplacian build(const Points& own, int tiles = 0, bool faces = false) {
  TileOptions options;
  options.cloud = clean();
  options.faces = faces;
  options.tiles = tiles;
  return distributedLaplacian(PETSC_COMM_WORLD, sourceOf(PETSC_COMM_WORLD, own), options);
}

/// A vector's values by point of the source, all of them in every process.
std::vector<double> everywhere(Vec by_point) {
  Vec all = nullptr;
  VecScatter scatter = nullptr;
  VecScatterCreateToAll(by_point, &scatter, &all);
  VecScatterBegin(scatter, by_point, all, INSERT_VALUES, SCATTER_FORWARD);
  VecScatterEnd(scatter, by_point, all, INSERT_VALUES, SCATTER_FORWARD);
  PetscInt size = 0;
  const PetscScalar* values = nullptr;
  VecGetSize(all, &size);
  VecGetArrayRead(all, &values);
  std::vector<double> result(values, values + size);
  VecRestoreArrayRead(all, &values);
  VecScatterDestroy(&scatter);
  VecDestroy(&all);
  return result;
}

Eigen::VectorXd byPoint(const DistributedLaplacian& laplacian, const PetscVector& values) {
  const std::vector<double> all = everywhere(valuesByPoint(laplacian, values.get()).get());
  return Eigen::Map<const Eigen::VectorXd>(all.data(), std::ssize(all));
}

/// One value per row, by a function of the point.
template <class Value>
PetscVector byRow(const DistributedLaplacian& laplacian, Value value) {
  PetscVector result;
  VecDuplicate(laplacian.M.get(), result.make());
  PetscScalar* values = nullptr;
  VecGetArray(result.get(), &values);
  for (std::size_t i = 0; i < laplacian.point.size(); ++i) values[i] = value(laplacian.point[i]);
  VecRestoreArray(result.get(), &values);
  return result;
}

void expectRowsOf(const Laplacian& whole, const DistributedLaplacian& laplacian) {
  const std::vector<double> row_of = everywhere(laplacian.row.get());
  std::map<PetscInt, int> point_of;
  for (std::size_t p = 0; p < row_of.size(); ++p) {
    EXPECT_EQ(row_of[p] >= 0, whole.status[p] == PointStatus::active) << p;
    if (row_of[p] >= 0) point_of[static_cast<PetscInt>(row_of[p])] = static_cast<int>(p);
  }
  EXPECT_EQ(laplacian.report.active, whole.report.active);
  EXPECT_EQ(laplacian.report.nonzeros, whole.report.nonzeros);
  EXPECT_GE(laplacian.report.margin, 0);
  EXPECT_NEAR(laplacian.report.area, whole.M.sum(), 1e-12 * whole.M.sum());
  PetscInt first = 0, last = 0;
  MatGetOwnershipRange(laplacian.L.get(), &first, &last);
  const VectorXd diagonal = whole.L.diagonal();
  const PetscScalar* masses = nullptr;
  VecGetArrayRead(laplacian.M.get(), &masses);
  for (PetscInt row = first; row < last; ++row) {
    const int p = point_of.at(row);
    ASSERT_EQ(laplacian.point[row - first], p);
    EXPECT_EQ(laplacian.boundary[row - first], whole.boundary[p]);
    EXPECT_NEAR(std::abs(laplacian.normals.row(row - first).dot(whole.frames.normals.row(p))), 1, 1e-12);
    EXPECT_NEAR(masses[row - first], whole.M[p], 1e-12 * whole.M[p]);
    PetscInt count = 0;
    const PetscInt* columns = nullptr;
    const PetscScalar* values = nullptr;
    MatGetRow(laplacian.L.get(), row, &count, &columns, &values);
    for (PetscInt e = 0; e < count; ++e) {
      const int q = point_of.at(columns[e]);
      EXPECT_NEAR(values[e], whole.L.coeff(p, q), 1e-12 * std::max(diagonal[p], diagonal[q])) << p << ' ' << q;
    }
    MatRestoreRow(laplacian.L.get(), row, &count, &columns, &values);
  }
  VecRestoreArrayRead(laplacian.M.get(), &masses);
}

TEST(DistributedLaplacian, HasTheRowsOfTheWhole) {
  for (const Points& points : {sphere(4000, 101), sphere(4000, 103, {0, 0, 0}, .02), oddTerrain(6000)}) {
    const Laplacian whole = pointCloudLaplacian(points, clean());
    for (const int tiles : {0, 5}) expectRowsOf(whole, build(spread(points).own, tiles));
  }
}

TEST(DistributedLaplacian, IsTheSameWhicheverProcessHasThePoints) {
  const Points points = oddTerrain(3000);
  const Points none(0, 3);
  expectRowsOf(pointCloudLaplacian(points, clean()), build(processNumber() == processCount() - 1 ? points : none));
}

TEST(DistributedLaplacian, OfFewOrNoPointsHasFewOrNoRows) {
  for (const int n : {0, 1, 7}) {
    const Points points = sphere(n, 101);
    expectRowsOf(pointCloudLaplacian(points, clean()), build(spread(points).own));
  }
}

TEST(DistributedLaplacian, HasTheComponentsOfTheWhole) {
  Points points(7000, 3);
  points << sphere(1000, 101, {5, 0, 0}), sphere(4000, 102), .5 * sphere(2000, 103, {0, 20, 0});
  const Laplacian whole = pointCloudLaplacian(points, clean());
  const DistributedLaplacian laplacian = build(spread(points).own);
  EXPECT_EQ(laplacian.components, whole.report.components);
  const Eigen::VectorXd component = byPoint(laplacian, byRow(laplacian, [&, i = 0](std::int64_t) mutable {
                                              return static_cast<double>(laplacian.component[i++]);
                                            }));
  // Larger areas first: two of radius 1, which differ little, then one of radius 1/2.
  EXPECT_EQ(component[6000], laplacian.components - 1);
  std::map<int, double> name;
  for (int p = 0; p < 7000; ++p) EXPECT_EQ(name.emplace(whole.component[p], component[p]).first->second, component[p]);
}

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

TEST(DistributedLaplacian, OfMorePointsThanPetscCountsIsRefused) {
  if (sizeof(PetscInt) > 4) GTEST_SKIP() << "indices have 64 bits";
  const PointSource large = {std::int64_t{1} << 31, [](const auto&) { FAIL() << "nothing is to be read"; }};
  TileOptions options;
  options.cloud = clean();
  EXPECT_EQ(refusal([&] { distributedLaplacian(PETSC_COMM_WORLD, large, options); }),
            "distributedLaplacian: 2147483648 points, must be at most 2147483647: PETSc with 64-bit indices takes more "
            "(libpetsc64-real-dev)");
}

}  // namespace
}  // namespace tufted

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (SlepcInitialize(&argc, &argv, nullptr, nullptr) != 0) return 1;
  // Process 0 alone says what it has done; the others say what fails.
  testing::GTEST_FLAG(color) = "no";
  auto& listeners = testing::UnitTest::GetInstance()->listeners();
  if (tufted::processNumber() != 0) delete listeners.Release(listeners.default_result_printer());
  PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
  const int failed = RUN_ALL_TESTS();
  SlepcFinalize();
  return failed;
}
