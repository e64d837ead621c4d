#include "algorithms/refine_pairs.h"

#include <cmath>

#include "algorithms/tall_matrix.h"
#include "base/symmetric_eigen.h"

namespace tufted {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Pairs with eigenvalues up to this many times the smallest one are refined by the inverse, whose error is about 1e-12
/// there.
constexpr double range_of_inverse = 1e4;
/// Eigenvalues that differ by less than this part of themselves count as equal and are refined in the same way.
constexpr double equal_values = 1e-6;

/// Number of pairs to refine by the inverse.
Index countLow(const VectorXd& values) {
  const double bound = range_of_inverse * values[0];
  Index low = 1;
  while (low < values.size() && (values[low] <= bound || values[low] - values[low - 1] <= equal_values * values[low]))
    ++low;
  return low;
}

/// Eigenpairs of a matrix that is symmetric up to rounding.
Eigen::SelfAdjointEigenSolver<MatrixXd> decompose(const MatrixXd& products) {
  return symmetricEigen(MatrixXd((products + products.transpose()) / 2));
}

}  // namespace

bool refinePairs(const Eigenproblem& problem, const InverseTimes& inverse, bool mixed, const Workers& workers,
                 Eigenpairs& pairs) {
  const Index count = pairs.values.size(), low = countLow(pairs.values);
  auto x = pairs.vectors.leftCols(low);
  auto y = pairs.vectors.rightCols(count - low);
  // A step of the inverse removes high frequencies that come from rounding, and sets the values at points without mass.
  MatrixXd image = pairs.images.cols() > 0 ? MatrixXd(pairs.images.leftCols(low)) : inverse(x);
  if (pairs.images.cols() > 0) y = pairs.images.rightCols(count - low) * pairs.values.tail(count - low).asDiagonal();
  pairs.images.resize(0, 0);
  if (mixed) {
    const auto inverted = decompose(innerProducts(x, problem.mass, image, workers));
    pairs.values.head(low) = inverted.eigenvalues().reverse().cwiseInverse();
    multiplyInPlace(image, inverted.eigenvectors().rowwise().reverse(), workers);
  }
  x = image * pairs.values.head(low).asDiagonal();
  if (!orthonormalize(problem.mass, workers, x)) return false;
  if (low == count) return true;

  problem.fillMassless(y);
  problem.deflate(y);
  subtractProduct(y, x, innerProducts(x, problem.mass, y, workers), workers);
  if (!orthonormalize(problem.mass, workers, y)) return false;
  const auto direct = decompose(innerProducts(y, VectorXd::Ones(y.rows()), problem.L * y, workers));
  pairs.values.tail(count - low) = direct.eigenvalues();
  multiplyInPlace(y, direct.eigenvectors(), workers);
  return true;
}

}  // namespace tufted
