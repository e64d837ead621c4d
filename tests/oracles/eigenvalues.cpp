#include <Spectra/SymEigsSolver.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "oracles/oracles.h"

namespace tufted::oracles {
namespace {

using Factor = Eigen::SimplicialLDLT<SparseMatrix>;

SparseMatrix shifted(const SparseMatrix& L, const VectorXd& M, double shift) {
  SparseMatrix matrix = L;
  for (Eigen::Index i = 0; i < L.rows(); ++i) matrix.coeffRef(i, i) -= shift * M[i];
  return matrix;
}

// y -> M^1/2 (L - shift M)^-1 M^1/2 y, orthogonal to the eigenvectors already found: symmetric, with the eigenvalues
// 1 / (lambda - shift). Unlike M^-1/2 L M^-1/2 it allows masses of 0.
class InvertedOperator {
 public:
  using Scalar = double;
  InvertedOperator(const Factor& factor, const VectorXd& root_mass, const Eigen::MatrixXd& found)
      : factor_(factor), root_mass_(root_mass), found_(found) {}
  Eigen::Index rows() const { return root_mass_.size(); }
  Eigen::Index cols() const { return root_mass_.size(); }
  void perform_op(const double* in, double* out) const {
    const VectorXd x = deflate(Eigen::Map<const VectorXd>(in, rows()));
    const VectorXd y = factor_.solve(root_mass_.cwiseProduct(x));
    Eigen::Map<VectorXd>(out, rows()) = deflate(root_mass_.cwiseProduct(y));
  }

 private:
  VectorXd deflate(const VectorXd& x) const {
    if (found_.cols() == 0) return x;
    return x - found_ * (found_.transpose() * x);
  }
  const Factor& factor_;
  const VectorXd& root_mass_;
  const Eigen::MatrixXd& found_;
};

// The number of eigenvalues below a bound: that of negative pivots of L - bound M (Sylvester's law of inertia).
Eigen::Index countBelow(const SparseMatrix& L, const VectorXd& M, double bound) {
  const Factor factor(shifted(L, M, bound));
  return (factor.vectorD().array() < 0).count();
}

class Problem {
 public:
  Problem(const SparseMatrix& L, const VectorXd& M)
      : L_(L), M_(M), root_mass_(M.cwiseSqrt()), shift_(-1 / M.sum()), factor_(shifted(L, M, shift_)) {
    if (factor_.info() != Eigen::Success) throw std::runtime_error("smallestEigenpairs: factorisation failed");
    found_.resize(L.rows(), 0);
  }

  void findMore(Eigen::Index count) {
    const Eigen::Index n = L_.rows();
    InvertedOperator op(factor_, root_mass_, found_);
    const Eigen::Index subspace = std::min(n, std::max(2 * count + 1, count + 20));
    Spectra::SymEigsSolver<InvertedOperator> solver(op, count, subspace);
    solver.init();
    solver.compute(Spectra::SortRule::LargestAlge, 1000, 1e-11);
    if (solver.info() != Spectra::CompInfo::Successful) throw std::runtime_error("smallestEigenpairs: not converged");
    Eigen::MatrixXd vectors(n, found_.cols() + count);
    vectors << found_, solver.eigenvectors();
    VectorXd values(vectors.cols());
    values << values_, shift_ + solver.eigenvalues().cwiseInverse().array();
    std::vector<Eigen::Index> order(values.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) { return values[a] < values[b]; });
    values_ = values(order);
    found_ = vectors(Eigen::all, order);
  }

  // The number of eigenvalues missing among the first k. Counts those below a bound in the widest gap after the k-th,
  // or after all that were found if there is no gap, so that the bound is not close to an eigenvalue.
  Eigen::Index missing(Eigen::Index k) const {
    const double margin = 1e-6 * (values_[values_.size() - 1] + 1 / M_.sum());
    Eigen::Index below = values_.size();
    double bound = values_[below - 1] + margin, widest = 2 * margin;
    for (Eigen::Index i = k; i < values_.size(); ++i) {
      if (values_[i] - values_[i - 1] <= widest) continue;
      widest = values_[i] - values_[i - 1];
      below = i;
      bound = (values_[i] + values_[i - 1]) / 2;
    }
    return std::max<Eigen::Index>(0, countBelow(L_, M_, bound) - below);
  }

  Spectrum result(Eigen::Index k) const {
    Spectrum spectrum{values_.head(k), Eigen::MatrixXd(L_.rows(), k)};
    const double scale = std::max(std::abs(values_[k - 1]), 1 / M_.sum());
    for (Eigen::Index i = 0; i < k; ++i) {
      // y = M^1/2 x; one more solve gives x also where the mass is 0.
      VectorXd x = factor_.solve(root_mass_.cwiseProduct(found_.col(i)));
      x /= std::sqrt(x.dot(M_.cwiseProduct(x)));
      const VectorXd residual = L_ * x - values_[i] * M_.cwiseProduct(x);
      if (!(residual.cwiseAbs().sum() <= 1e-6 * scale * std::sqrt(M_.sum()))) {
        throw std::runtime_error("smallestEigenpairs: residual of eigenvalue " + std::to_string(i));
      }
      spectrum.vectors.col(i) = x;
    }
    return spectrum;
  }

  const VectorXd& values() const { return values_; }

 private:
  const SparseMatrix& L_;
  const VectorXd& M_;
  VectorXd root_mass_;
  double shift_;
  Factor factor_;
  VectorXd values_;
  Eigen::MatrixXd found_;  // orthonormal columns y = M^1/2 x
};

}  // namespace

Spectrum smallestEigenpairs(const SparseMatrix& L, const VectorXd& M, int k) {
  std::vector<int> active, place(M.size(), -1);
  for (int i = 0; i < M.size(); ++i) {
    if (M[i] == 0 && L.coeff(i, i) == 0) continue;
    place[i] = static_cast<int>(active.size());
    active.push_back(i);
  }
  const auto n = static_cast<Eigen::Index>(active.size());
  if (k < 1 || k >= n) throw std::runtime_error("smallestEigenpairs: k must lie between 1 and the active points");
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index column = 0; column < L.outerSize(); ++column) {
    for (SparseMatrix::InnerIterator entry(L, column); entry; ++entry) {
      if (place[entry.row()] < 0 || place[column] < 0) continue;
      entries.emplace_back(place[entry.row()], place[column], entry.value());
    }
  }
  SparseMatrix L_of_active(n, n);
  L_of_active.setFromTriplets(entries.begin(), entries.end());
  const VectorXd M_of_active = M(active);

  Problem problem(L_of_active, M_of_active);
  problem.findMore(std::min<Eigen::Index>(k + 4, n - 1));
  for (int round = 0;; ++round) {
    const Eigen::Index missing = problem.missing(k);
    if (missing == 0) break;
    if (round == 10) throw std::runtime_error("smallestEigenpairs: eigenvalues missing");
    problem.findMore(std::min(missing + 2, n - 1 - problem.values().size()));
  }
  const Spectrum part = problem.result(k);
  Spectrum spectrum{part.values, Eigen::MatrixXd::Zero(M.size(), k)};
  for (Eigen::Index i = 0; i < n; ++i) spectrum.vectors.row(active[i]) = part.vectors.row(i);
  return spectrum;
}

VectorXd smallestEigenvalues(const SparseMatrix& L, const VectorXd& M, int k) {
  return smallestEigenpairs(L, M, k).values;
}

double meanRelativeError(const VectorXd& computed, const VectorXd& analytic) {
  double sum = 0;
  int count = 0;
  for (Eigen::Index i = 0; i < std::min(computed.size(), analytic.size()); ++i) {
    if (analytic[i] == 0) continue;
    sum += std::abs(computed[i] - analytic[i]) / analytic[i];
    ++count;
  }
  return sum / count;
}

}  // namespace tufted::oracles
