// Solvers that are factored once and queried often: the bits of the free functions, and no second factor.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "algorithms/linear_system.h"
#include "shapes/shapes.h"
#include "support/compare.h"
#include "support/joined_grids.h"
#include "support/odd_cloud.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::kept_factors_test {
namespace {

using Eigen::MatrixXd;
using support::refusal;
using Mask = std::vector<std::uint8_t>;
using Shared = std::shared_ptr<const Laplacian>;

Shared oddCloud() {
  return std::make_shared<const Laplacian>(pointCloudLaplacian(support::oddCloud()));
}

Shared torus(int n = 3000) {
  return std::make_shared<const Laplacian>(pointCloudLaplacian(shapes::torus(n).points));
}

bool sameBits(const MatrixXd& a, const MatrixXd& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && support::sameBits(a.data(), b.data(), a.size());
}

/// What progress was told about.
class Stages {
 public:
  Progress progress() {
    return [this](std::string_view stage, double) {
      names_.emplace(stage);
      return true;
    };
  }
  /// Whether a matrix was analysed or factored.
  bool haveFactors() const { return names_.contains("analyse") || names_.contains("factor"); }
  bool empty() const { return names_.empty(); }

 private:
  std::set<std::string> names_;
};

/// Columns of values of `pins`, different for each `which`.
MatrixXd valuesOf(Eigen::Index pins, int which, Eigen::Index columns = 2) {
  MatrixXd values(pins, columns);
  for (Eigen::Index c = 0; c < columns; ++c)
    for (Eigen::Index k = 0; k < pins; ++k) values(k, c) = std::sin(1.7 * static_cast<double>(k + c) + which);
  return values;
}

using Free = MatrixXd (*)(const Laplacian&, const Pins&, const SolverOptions&, SolveReport*);

struct Kind {
  Interpolation kind;
  Free free;
};

class EachKind : public testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Interpolation, EachKind,
                         testing::Values(Kind{Interpolation::harmonic, &harmonic},
                                         Kind{Interpolation::biharmonic, &biharmonic}),
                         [](const auto& tested) { return tested.index == 0 ? "harmonic" : "biharmonic"; });

TEST_P(EachKind, HasTheBitsOfTheFreeFunctionAndFactorsOnce) {
  for (const Shared& laplacian : {torus(), oddCloud()}) {
    const std::vector<int> points = {3, 700, 2000, 5, 5, 41};
    Stages made, queried, free;
    const InterpolationSolver solver(*laplacian, points, GetParam().kind, {.progress = made.progress()});
    EXPECT_TRUE(made.haveFactors());
    EXPECT_GT(solver.report().nonzeros, 0);
    for (int which = 0; which < 3; ++which) {
      const MatrixXd values = valuesOf(6, which, 1 + which);
      SolveReport report, expected;
      const MatrixXd u = solver.query(values, &report, queried.progress());
      EXPECT_TRUE(sameBits(u, GetParam().free(*laplacian, {points, values}, {.progress = free.progress()}, &expected)));
      EXPECT_EQ(report.method, expected.method);
      EXPECT_EQ(report.residual, expected.residual);
      EXPECT_EQ(report.backward_error, expected.backward_error);
    }
    EXPECT_TRUE(free.haveFactors());
    EXPECT_FALSE(queried.empty());
    EXPECT_FALSE(queried.haveFactors());
  }
}

TEST_P(EachKind, IsQueriedByThreadsSideBySide) {
  const InterpolationSolver solver(*torus(1000), {3, 700, 41}, GetParam().kind);
  std::vector<MatrixXd> expected, found(4);
  for (int which = 0; which < 4; ++which) expected.push_back(solver.query(valuesOf(3, which)));
  std::vector<std::thread> threads;
  for (int which = 0; which < 4; ++which)
    threads.emplace_back([&, which] { found[which] = solver.query(valuesOf(3, which)); });
  for (std::thread& thread : threads) thread.join();
  for (int which = 0; which < 4; ++which) EXPECT_TRUE(sameBits(found[which], expected[which])) << which;
}

TEST_P(EachKind, NamesWhatACallerGotWrong) {
  const Shared laplacian = oddCloud();
  const auto made = [&](const Shared& of, std::vector<int> points) {
    return refusal([&] { InterpolationSolver(*of, std::move(points), GetParam().kind); });
  };
  EXPECT_EQ(made(laplacian, {2004}), "InterpolationSolver: pins.points has 2004, must lie in [0, 2004)");
  EXPECT_EQ(made(laplacian, {-1}), "InterpolationSolver: pins.points has -1, must lie in [0, 2004)");
  const std::string nowhere =
      "InterpolationSolver: pins.points has no point on a component, must have at least one active point";
  EXPECT_EQ(made(laplacian, {}), nowhere);
  EXPECT_EQ(made(laplacian, {2002, 2003}), nowhere + ": point 2002 is not finite");
  EXPECT_EQ(made(laplacian, {2003}), nowhere + ": point 2003 is isolated");
  const std::string name = GetParam().kind == Interpolation::harmonic ? "harmonic" : "biharmonic";
  const InterpolationSolver solver(*laplacian, {1, 2}, GetParam().kind);
  const auto asked = [&](const MatrixXd& values) { return refusal([&] { solver.query(values); }); };
  EXPECT_EQ(asked(MatrixXd::Ones(1, 1)), name + ": pins.values has 1 rows, must have 2, one per point pinned");
  EXPECT_EQ(asked(MatrixXd(2, 0)), name + ": pins.values has no column, must have at least one");
  EXPECT_EQ(asked(MatrixXd::Constant(2, 1, NAN)), name + ": pins.values of point 1 are not finite, must be");
  if (GetParam().kind == Interpolation::harmonic) {
    Laplacian negative = *laplacian;
    negative.L *= -1;
    EXPECT_THROW(InterpolationSolver(negative, {0, 1}), SolverFailure);
  } else {
    EXPECT_THROW(InterpolationSolver(*laplacian, {0, 1}, Interpolation::biharmonic, {.memory_limit = 1}),
                 SolverFailure);
  }
  EXPECT_THROW(solver.query(MatrixXd::Constant(2, 1, 1.7e308)), SolverFailure);
}

TEST_P(EachKind, CancelsWhileItIsMadeAndWhileItIsAsked) {
  const Shared laplacian = torus(1000);
  const Progress stop = [](std::string_view, double) { return false; };
  EXPECT_THROW(InterpolationSolver(*laplacian, {0, 9}, GetParam().kind, {.progress = stop}), Cancelled);
  const InterpolationSolver solver(*laplacian, {0, 9}, GetParam().kind);
  EXPECT_THROW(solver.query(valuesOf(2, 0), nullptr, stop), Cancelled);
  EXPECT_TRUE(solver.query(valuesOf(2, 0)).allFinite());
}

TEST(InterpolationSolver, SolvesPoissonWithPinsAsTheFreeFunctionDoes) {
  const Shared laplacian = oddCloud();
  const std::vector<int> points = {3, 700, 2000, 1500};
  const InterpolationSolver solver(*laplacian, points);
  Stages queried;
  for (int which = 0; which < 2; ++which) {
    const MatrixXd f = valuesOf(2004, which + 7), values = valuesOf(4, which);
    EXPECT_TRUE(sameBits(solver.queryPoisson(f, values, nullptr, queried.progress()),
                         poisson(*laplacian, f, {points, values})));
  }
  EXPECT_FALSE(queried.haveFactors());
  EXPECT_EQ(refusal([&] { solver.queryPoisson(valuesOf(9, 0), valuesOf(4, 0)); }),
            "poisson: f has 9 rows, must have 2004, one per point of the Laplacian");
  EXPECT_EQ(refusal([&] { solver.queryPoisson(valuesOf(2004, 0, 1), valuesOf(4, 0)); }),
            "poisson: f has 1 columns, must have 2, as pins.values");
}

TEST(InterpolationSolver, ByBendingFindsTheFunctionOfALaplacian) {
  // Of all functions with the pins' values, one has the Laplacian f itself.
  const Shared laplacian = torus();
  const std::vector<int> points = {0, 70, 200};
  const MatrixXd u = laplacian->positions, f = laplacian->M.cwiseInverse().asDiagonal() * (laplacian->L * u);
  const InterpolationSolver bending(*laplacian, points, Interpolation::biharmonic);
  EXPECT_LE((bending.queryPoisson(f, u(points, Eigen::all)) - u).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(InterpolationSolver, ByMultigridAndOverWeakJointsIsTheSame) {
  // Three parts, two of them without a pin: their constants are found by themselves.
  const auto joined = std::make_shared<const Laplacian>(support::joinedGrids(12, {1e-9, 1e-7}));
  for (const SolverMethod method : {SolverMethod::cholesky, SolverMethod::multigrid}) {
    for (const Shared& laplacian : {joined, torus()}) {
      const std::vector<int> points = {0, 70};
      const InterpolationSolver solver(*laplacian, points, Interpolation::harmonic, {.method = method});
      EXPECT_EQ(solver.report().iterative, method == SolverMethod::multigrid);
      for (int which = 0; which < 2; ++which) {
        const MatrixXd values = valuesOf(2, which);
        EXPECT_TRUE(sameBits(solver.query(values), harmonic(*laplacian, {points, values}, {.method = method})));
      }
    }
  }
  EXPECT_THROW(InterpolationSolver(*torus(), {0, 9}, Interpolation::biharmonic, {.method = SolverMethod::multigrid}),
               SolverFailure);
}

TEST(PoissonSolver, HasTheBitsOfTheFreeFunctionsAndFactorsOnce) {
  for (const Shared& laplacian : {torus(), oddCloud()}) {
    Stages made, queried;
    const PoissonSolver solver(*laplacian, {.progress = made.progress()});
    EXPECT_TRUE(made.haveFactors());
    for (int which = 0; which < 2; ++which) {
      const MatrixXd f = valuesOf(std::ssize(laplacian->status), which);
      EXPECT_TRUE(sameBits(solver.query(f, nullptr, queried.progress()), poisson(*laplacian, f)));
      const std::vector<int> points = {5, 17 + which};
      EXPECT_TRUE(sameBits(solver.queryGreen(points, nullptr, queried.progress()), greensFunction(*laplacian, points)));
    }
    EXPECT_FALSE(queried.empty());
    EXPECT_FALSE(queried.haveFactors());
    EXPECT_EQ(solver.report().components, laplacian->report.components);
  }
}

TEST(PoissonSolver, NamesWhatACallerGotWrong) {
  const Shared laplacian = oddCloud();
  EXPECT_NE(refusal([&] { PoissonSolver(*laplacian, {.tolerance = 2}); }), "accepted");
  const PoissonSolver solver(*laplacian);
  EXPECT_EQ(refusal([&] { solver.query(valuesOf(9, 0)); }),
            "poisson: f has 9 rows, must have 2004, one per point of the Laplacian");
  EXPECT_EQ(refusal([&] { solver.queryGreen({}); }), "greensFunction: points is empty, must name at least one");
  Laplacian negative = *laplacian;
  negative.L *= -1;
  EXPECT_THROW(PoissonSolver{negative}, SolverFailure);
  const Progress stop = [](std::string_view, double) { return false; };
  EXPECT_THROW(PoissonSolver(*laplacian, {.progress = stop}), Cancelled);
  EXPECT_THROW(solver.queryGreen({0}, nullptr, stop), Cancelled);
}

TEST(PoissonSolver, StaysUsableWhereItIsMovedTo) {
  const Shared laplacian = torus(1000);
  PoissonSolver first(*laplacian);
  const MatrixXd expected = first.queryGreen({3});
  PoissonSolver second(std::move(first));
  EXPECT_TRUE(sameBits(second.queryGreen({3}), expected));
  first = std::move(second);
  EXPECT_TRUE(sameBits(first.queryGreen({3}), expected));
}

TEST(SmoothingSolver, HasTheBitsOfTheFreeFunctionAndFactorsOnce) {
  const Points points = shapes::withNoise(shapes::torus(2000), 0.02).points;
  const auto laplacian = std::make_shared<const Laplacian>(pointCloudLaplacian(points));
  Mask fixed(2000, 0);
  for (int i = 0; i < 2000; i += 7) fixed[i] = 1;
  for (const Mask* held : {static_cast<const Mask*>(nullptr), static_cast<const Mask*>(&fixed)}) {
    Stages made, queried;
    const SmoothingSolver solver(*laplacian, {.time_step = 3, .fixed = held, .solver = {.progress = made.progress()}});
    EXPECT_TRUE(made.haveFactors());
    EXPECT_EQ(solver.report().unknowns, held == nullptr ? 2000 : 2000 - 286);
    for (const int steps : {1, 3}) {
      for (const double scale : {1.0, 2.0}) {
        const Points given = scale * points;
        const Points found = solver.query(given, steps, queried.progress());
        const Points expected = smooth(*laplacian, given, {.time_step = 3, .iterations = steps, .fixed = held});
        EXPECT_TRUE(support::sameBits(found.data(), expected.data(), found.size()));
        EXPECT_NE(found, given);
      }
    }
    EXPECT_FALSE(queried.empty());
    EXPECT_FALSE(queried.haveFactors());
  }
}

TEST(SmoothingSolver, LeavesAllPointsWhereNothingMoves) {
  const Points points = shapes::sphere(500).points;
  const auto laplacian = std::make_shared<const Laplacian>(pointCloudLaplacian(points));
  const Mask all(500, 1);
  EXPECT_EQ(SmoothingSolver(*laplacian, {.time_step = 0}).query(points, 4), points);
  const SmoothingSolver held(*laplacian, {.fixed = &all});
  EXPECT_EQ(held.query(points), points);
  EXPECT_EQ(held.report().method, "");
}

TEST(SmoothingSolver, NamesWhatACallerGotWrong) {
  const Points points = shapes::sphere(500).points;
  const auto laplacian = std::make_shared<const Laplacian>(pointCloudLaplacian(points));
  const Mask short_mask(499, 0);
  EXPECT_EQ(refusal([&] { SmoothingSolver(*laplacian, {.method = SmoothingMethod::taubin}); }),
            "SmoothingSolver: method = taubin, must be implicit: there is nothing to factorise");
  const Triangles none(0, 3);
  EXPECT_EQ(refusal([&] { SmoothingSolver(*laplacian, {.volume_of = &none}); }),
            "SmoothingSolver: volume_of is given, must not be");
  EXPECT_EQ(refusal([&] { SmoothingSolver(*laplacian, {.time_step = -1}); }),
            "SmoothingSolver: time_step = -1, must be finite and at least 0");
  EXPECT_NE(refusal([&] { SmoothingSolver(*laplacian, {.time_step = NAN}); }), "accepted");
  EXPECT_EQ(refusal([&] { SmoothingSolver(*laplacian, {.fixed = &short_mask}); }),
            "SmoothingSolver: fixed has 499 rows, must have 500, one per point of the Laplacian");
  EXPECT_EQ(refusal([&] { SmoothingSolver(*laplacian, {.solver = {.threads = -1}}); }),
            "SmoothingSolver: threads = -1, must be >= 0");
  const SmoothingSolver solver(*laplacian);
  EXPECT_EQ(refusal([&] { solver.query(points, 0); }), "smooth: iterations = 0, must be at least 1");
  Laplacian negative = *laplacian;
  negative.L *= -10;
  EXPECT_THROW(SmoothingSolver{negative}, SolverFailure);
  const Progress stop = [](std::string_view, double) { return false; };
  EXPECT_THROW(SmoothingSolver(*laplacian, {.solver = {.progress = stop}}), Cancelled);
  EXPECT_THROW(solver.query(points, 1, stop), Cancelled);
}

TEST(SmoothingSolver, TakesMemoryThatSomebodyElseHolds) {
  const Points points = shapes::sphere(500).points;
  const auto laplacian = std::make_shared<const Laplacian>(pointCloudLaplacian(points));
  const SmoothingSolver solver(*laplacian);
  const std::vector<double> memory(points.data(), points.data() + points.size());
  EXPECT_EQ(solver.query(Eigen::Map<const Points>(memory.data(), 500, 3)), solver.query(points));
}

TEST(LinearSystem, WithAnotherDiagonalIsAsOneMadeWithIt) {
  const auto laplacian = torus();
  const Eigen::Index n = laplacian->L.cols();
  const auto matrixOf = [&](const VectorXd& added) {
    SparseMatrix matrix = laplacian->L;
    matrix.diagonal() += added;
    return matrix;
  };
  const VectorXd first = VectorXd::Ones(n), second = VectorXd::LinSpaced(n, 0.1, 10);
  const MatrixXd right = laplacian->positions.leftCols(2);
  const SystemNames names = {.function = "test", .matrix = "L + D"};
  LinearSystem system = LinearSystem::positiveDefinite(names, matrixOf(first), {});
  const LinearSystem expected = LinearSystem::positiveDefinite(names, matrixOf(second), {});
  system.setDiagonal(laplacian->L.diagonal() + second);
  EXPECT_TRUE(sameBits(system.solve("test", right, nullptr, {}), expected.solve("test", right, nullptr, {})));

  EXPECT_THROW(system.setDiagonal(-second), SolverFailure);
  VectorXd odd = second;
  odd[3] = NAN;
  EXPECT_THROW(system.setDiagonal(odd), SolverFailure);
}

}  // namespace
}  // namespace tufted::kept_factors_test
