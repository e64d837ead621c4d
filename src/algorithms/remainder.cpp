#include "algorithms/remainder.h"

#include <cmath>

#include "algorithms/greater.h"
#include "base/sort_unique.h"

namespace tufted {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Values of x below these, relative to the largest of their column and absolute, have lost digits near underflow.
constexpr double least_part = 1e-290, least_value = 1e-300;
/// Maximum number of sweeps of relaxation; more cost as much as a correction by the factor.
constexpr int most_sweeps = 30;
/// Relaxation ends if it would affect more rows than this, and more than a tenth of all; the factor then corrects.
constexpr std::size_t many_rows = 100;

using Column = Eigen::Ref<const VectorXd>;

/// Added to |x| so that values near underflow do not count.
double leastOf(const Column& x) {
  return least_value + (x.size() > 0 ? least_part * x.cwiseAbs().maxCoeff() : 0);
}

double ratio(double rest, double size) {
  return rest == 0 ? 0 : std::abs(rest) / size;
}

double normOf(const Column& values) {
  const double norm = values.norm();
  return norm > 0 && std::isfinite(norm) ? norm : values.stableNorm();
}

/// Fills in the residual and the backward error of column c.
/// @param ratios backward errors by row
void finish(const Column& b, const Column& ratios, Index c, Remainder& result) {
  result.backward_error[c] = ratios.size() > 0 ? ratios.maxCoeff<Eigen::PropagateNaN>() : 0;
  const double right = normOf(b);
  if (right > 0) result.residual[c] = normOf(result.rest.col(c)) / right;
}

/// The rows that a change at one of `rows` affects, `rows` included, ascending.
std::vector<int> neighborsOf(const SparseMatrix& L, const std::vector<int>& rows) {
  std::vector<int> result;
  for (const int i : rows)
    for (SparseMatrix::InnerIterator entry(L, i); entry; ++entry) result.push_back(static_cast<int>(entry.row()));
  sortUnique(result);
  return result;
}

/// Computes a column of a Laplacian's remainder row by row.
class LaplacianColumn {
 public:
  LaplacianColumn(const SparseMatrix& L, const Column& b, const Column& size, const Column& x,
                  Eigen::Ref<VectorXd> rest)
      : L_(L), b_(b), size_(size), x_(x), rest_(rest), ratios_(VectorXd::Zero(b.size())), least_(leastOf(x)) {}

  /// Measures row i; false if it is worse than `bound`.
  bool measure(int i, double bound) {
    double missing = b_[i], size = size_[i];
    const double here = x_[i];
    for (SparseMatrix::InnerIterator entry(L_, i); entry; ++entry) {
      const double there = x_[entry.row()];
      missing -= entry.value() * (there - here);
      size += std::abs(entry.value()) * (std::abs(there) + least_);
    }
    rest_[i] = missing;
    ratios_[i] = ratio(missing, size);
    return !(ratios_[i] > bound);
  }

  const VectorXd& ratios() const { return ratios_; }

 private:
  const SparseMatrix& L_;
  const Column b_, size_, x_;
  Eigen::Ref<VectorXd> rest_;
  VectorXd ratios_;
  double least_;
};

}  // namespace

Remainder remainderOfLaplacian(const SparseMatrix& L, const std::vector<int>& points, const MatrixXd& b,
                               const MatrixXd& size, const MatrixXd& x) {
  Remainder result(MatrixXd::Zero(b.rows(), b.cols()));
  for (Index c = 0; c < b.cols(); ++c) {
    LaplacianColumn column(L, b.col(c), size.col(c), x.col(c), result.rest.col(c));
    for (const int i : points) column.measure(i, HUGE_VAL);
    finish(size.col(c), column.ratios(), c, result);
  }
  return result;
}

Remainder relaxLaplacian(const SparseMatrix& L, const std::vector<int>& points, const MatrixXd& b, const MatrixXd& size,
                         double bound, MatrixXd& x) {
  Remainder result(MatrixXd::Zero(b.rows(), b.cols()));
  for (Index c = 0; c < b.cols(); ++c) {
    LaplacianColumn column(L, b.col(c), size.col(c), x.col(c), result.rest.col(c));
    std::vector<int> worse;
    for (const int i : points)
      if (!column.measure(i, bound)) worse.push_back(i);
    for (int sweep = 0; sweep < most_sweeps && !worse.empty(); ++sweep) {
      const std::vector<int> rows = neighborsOf(L, worse);
      if (rows.size() > many_rows && rows.size() > points.size() / 10) break;
      for (const int i : worse) {
        column.measure(i, bound);
        x(i, c) += result.rest(i, c) / L.coeff(i, i);
      }
      worse.clear();
      for (const int i : rows)
        if (!column.measure(i, bound)) worse.push_back(i);
    }
    finish(size.col(c), column.ratios(), c, result);
  }
  return result;
}

Remainder remainderOf(const LongMatrix& lower, const MatrixXd& b, const MatrixXd& x) {
  Remainder result(b);
  for (Index c = 0; c < b.cols(); ++c) {
    auto rest = result.rest.col(c);
    VectorXd sizes = rest.cwiseAbs();
    const double least = leastOf(x.col(c));
    for (Index j = 0; j < lower.cols(); ++j) {
      const double here = x(j, c), here_size = std::abs(here) + least;
      double missing = rest[j], size = sizes[j];
      for (LongMatrix::InnerIterator entry(lower, j); entry; ++entry) {
        const Index i = entry.row();
        const double value = entry.value(), there = x(i, c);
        missing -= value * there;
        size += std::abs(value) * (std::abs(there) + least);
        if (i == j) continue;
        rest[i] -= value * here;
        sizes[i] += std::abs(value) * here_size;
      }
      rest[j] = missing;
      sizes[j] = ratio(missing, size);  // later columns add nothing to row j
    }
    finish(b.col(c), sizes, c, result);
  }
  return result;
}

double backwardError(const SparseMatrix& A, const MatrixXd& rest, const MatrixXd& b, const MatrixXd& x) {
  double greatest = 0;
  const MatrixXd sizes = x.array().isNaN().select(0, x.array().abs());
  Eigen::RowVectorXd least = Eigen::RowVectorXd::Constant(x.cols(), least_value);
  if (x.rows() > 0) least += least_part * sizes.colwise().maxCoeff();
  for (int i = 0; i < A.cols(); ++i) {
    if (rest.row(i).isZero(0)) continue;
    Eigen::RowVectorXd sum = b.row(i).cwiseAbs();
    for (SparseMatrix::InnerIterator entry(A, i); entry; ++entry)
      sum += std::abs(entry.value()) * (sizes.row(entry.row()) + least);
    for (Index c = 0; c < x.cols(); ++c) greatest = greater(greatest, ratio(rest(i, c), sum[c]));
  }
  return greatest;
}

}  // namespace tufted
