// Lanczos' method on operators whose eigenvalues are known, and its products of tall matrices.
#include "algorithms/block_lanczos.h"

#include <gtest/gtest.h>

#include <cmath>

#include "algorithms/tall_matrix.h"
#include "tufted/tufted.h"

namespace tufted::block_lanczos_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

const Progress silent;

/// The diagonal operator of these values, turned by a reflection so that no axis is an eigenvector.
LanczosProblem turned(const VectorXd& values, Index wanted) {
  const Index n = values.size();
  const VectorXd normal = VectorXd::LinSpaced(n, 1, 2).normalized();
  const auto reflect = [normal](const MatrixXd& x) { return MatrixXd(x - 2 * normal * (normal.transpose() * x)); };
  return {.apply = [values,
                    reflect](const Eigen::Ref<const MatrixXd>& x) { return reflect(values.asDiagonal() * reflect(x)); },
          .deflate = [](Eigen::Ref<MatrixXd>) {},
          .mass = VectorXd::Ones(n),
          .dimension = n,
          .wanted = wanted,
          .is_complete = {}};
}

void expectLargest(const LanczosProblem& problem, const VectorXd& values, double tolerance) {
  const Workers workers(1, silent);
  const LanczosResult found = largestEigenpairs(problem, {.tolerance = tolerance, .max_iterations = 500}, workers);
  ASSERT_TRUE(found.converged);
  EXPECT_LE((found.values - values.head(problem.wanted)).cwiseAbs().maxCoeff(), 1e-9 * values[0]);
  const MatrixXd rest = problem.apply(found.vectors) - found.vectors * found.values.asDiagonal();
  for (Index i = 0; i < problem.wanted; ++i) EXPECT_LE(rest.col(i).norm(), 2 * tolerance * found.values[i]) << i;
  const MatrixXd gram = found.vectors.transpose() * found.vectors;
  EXPECT_LE((gram - MatrixXd::Identity(problem.wanted, problem.wanted)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(BlockLanczos, FindsAllCopiesBeyondItsBlock) {
  for (const Index copies : {8, 9, 30}) {
    VectorXd values(600);
    for (Index i = 0; i < 600; ++i)
      values[i] = 1 / (1 + std::floor(static_cast<double>(i) / static_cast<double>(copies)));
    expectLargest(turned(values, 2 * copies - 1), values, 1e-8);
  }
}

TEST(BlockLanczos, FindsOneEigenvalueOfManyCopies) {
  expectLargest(turned(VectorXd::Ones(300), 77), VectorXd::Ones(300), 1e-10);
}

TEST(BlockLanczos, TakesNoLongerWhereTheWantedEndWithinACluster) {
  // Those of a sphere, the copies apart by 1e-4: the first 99 are nine whole clusters, the next has 21.
  VectorXd values(1300);
  for (Index i = 0, degree = 1; i < values.size(); ++degree)
    for (Index copy = 0; copy <= 2 * degree && i < values.size(); ++copy, ++i)
      values[i] = (1 - 1e-4 * static_cast<double>(copy) / static_cast<double>(2 * degree)) /
                  static_cast<double>(degree * (degree + 1));
  const auto iterations = [&](Index wanted) {
    const Workers workers(1, silent);
    const LanczosProblem problem = turned(values, wanted);
    const LanczosResult found = largestEigenpairs(problem, {.tolerance = 1e-10, .max_iterations = 2000}, workers);
    EXPECT_TRUE(found.converged) << wanted;
    if (found.converged) {
      EXPECT_LE((found.values - values.head(wanted)).cwiseAbs().maxCoeff(), 1e-12) << wanted;
    }
    return found.iterations;
  };
  const int whole = iterations(99);
  for (const Index wanted : {100, 104, 110, 119}) EXPECT_LE(iterations(wanted), 1.5 * whole) << wanted;
}

TEST(BlockLanczos, TakesAnyPartOfASmallSpace) {
  for (Index n = 2; n <= 20; ++n) {
    const VectorXd values = VectorXd::LinSpaced(n, 2, 1);
    for (Index wanted = 1; wanted < n; ++wanted) expectLargest(turned(values, wanted), values, 1e-10);
  }
}

TEST(BlockLanczos, SearchesUntilNothingIsMissingAndStaysExact) {
  // Close eigenvalues behind the wanted ones have not converged when the search begins.
  VectorXd values = VectorXd::LinSpaced(2000, 1, 0.1);
  for (const std::optional<bool> first : {std::optional<bool>(false), std::optional<bool>()}) {
    LanczosProblem problem = turned(values, 10);
    int calls = 0;
    problem.is_complete = [&](const Eigen::VectorXd&) { return calls++ == 0 ? first : std::optional(true); };
    expectLargest(problem, values, 1e-6);
    EXPECT_EQ(calls, 1);
  }
}

TEST(BlockLanczos, FindsWhatIsSmallBesideAFewHugeEigenvalues) {
  for (const double huge : {1e5, 1e8, 1e11}) {
    VectorXd values = VectorXd::LinSpaced(400, 1, 0.1);
    values.head(2) << 3 * huge, huge;
    const LanczosProblem problem = turned(values, 12);
    const Workers workers(1, silent);
    const LanczosResult found = largestEigenpairs(problem, {.tolerance = 1e-10, .max_iterations = 200}, workers);
    ASSERT_TRUE(found.converged) << huge;
    for (Index i = 0; i < 12; ++i)
      EXPECT_NEAR(found.values[i] / values[i], 1, std::max(1e-9, 1e-15 * huge)) << huge << ", " << i;
  }
}

TEST(BlockLanczos, DoesNotClaimPairsOfASpaceThatIsUsedUp) {
  // No operator that is not self-adjoint has orthonormal eigenvectors; the projection on the whole space seems to.
  LanczosProblem problem = turned(VectorXd::LinSpaced(40, 2, 1), 39);
  problem.apply = [symmetric = problem.apply](const Eigen::Ref<const MatrixXd>& x) {
    MatrixXd image = symmetric(x);
    image.row(0) += 1e-3 * x.row(1);
    return image;
  };
  const Workers workers(1, silent);
  const LanczosResult found = largestEigenpairs(problem, {.tolerance = 1e-10, .max_iterations = 500}, workers);
  EXPECT_FALSE(found.converged);
  EXPECT_GE(found.residuals.maxCoeff(), 1e-5);
}

TEST(TallMatrix, TakesProductsOverNothing) {
  // OpenBLAS would bear their leading dimension of 0, the reference BLAS ends the program.
  const Workers workers(1, silent);
  const MatrixXd none(5, 0), C(0, 3);
  MatrixXd Y = MatrixXd::Constant(5, 3, 7);
  subtractProduct(Y, none, C, workers);
  EXPECT_TRUE((Y.array() == 7).all());
  multiplyInto(none, C, Y, workers);
  EXPECT_TRUE(Y.isZero(0));
  EXPECT_EQ(innerProducts(none, VectorXd::Ones(5), Y, workers).size(), 0);
  EXPECT_TRUE(innerProducts(MatrixXd(0, 2), VectorXd(0), MatrixXd(0, 3), workers).isZero(0));
}

}  // namespace
}  // namespace tufted::block_lanczos_test
