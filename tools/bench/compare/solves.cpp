#include "bench/compare/solves.h"

#if defined(__GNUC__) && !defined(__clang__)
// GCC 12 and later see a use after free in the destructors of Spectra's Schur form, where there is none.
#pragma GCC diagnostic ignored "-Wuse-after-free"
#endif
#include <Spectra/GenEigsSolver.h>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/stage_clock.h"
#include "tufted/errors.h"
#include "tufted/spectrum.h"

namespace tufted::bench {
namespace {

using LU = Eigen::SparseLU<SparseMatrix>;

/// The rows and columns of a matrix for which place[i] >= 0.
SparseMatrix partOf(const SparseMatrix& A, const std::vector<int>& row_place, const std::vector<int>& column_place,
                    int rows, int columns) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = 0; column < A.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(A, column); entry; ++entry)
      if (row_place[entry.row()] >= 0 && column_place[column] >= 0)
        entries.emplace_back(row_place[entry.row()], column_place[column], entry.value());
  SparseMatrix part(rows, columns);
  part.setFromTriplets(entries.begin(), entries.end());
  return part;
}

/// y -> M^1/2 (L - shift M)^-1 M^1/2 y, with the eigenvalues 1 / (lambda - shift).
class Inverted {
 public:
  using Scalar = double;
  Inverted(const SparseMatrix& L, const VectorXd& M, double shift) : root_(M.cwiseSqrt()) {
    SparseMatrix shifted = L;
    for (Eigen::Index i = 0; i < L.rows(); ++i) shifted.coeffRef(i, i) -= shift * M[i];
    lu_.compute(shifted);
    if (lu_.info() != Eigen::Success) throw std::runtime_error("no factor");
  }
  Eigen::Index rows() const { return root_.size(); }
  Eigen::Index cols() const { return root_.size(); }
  void perform_op(const double* in, double* out) const {
    const VectorXd right = root_.cwiseProduct(Eigen::Map<const VectorXd>(in, rows()));
    Eigen::Map<VectorXd>(out, rows()) = root_.cwiseProduct(VectorXd(lu_.solve(right)));
  }

 private:
  LU lu_;
  VectorXd root_;
};

/// The eigenvalues nearest to `shift` of a matrix whose points are all connected. Arnoldi's iteration finds exactly
/// multiple ones once, but random points have none apart from the zeros of several components.
std::vector<std::complex<double>> eigenvaluesNear(double shift, const SparseMatrix& L, const VectorXd& M, int count) {
  const int subspace = 3 * count;
  Eigen::VectorXcd found;
  if (L.rows() <= subspace) {
    const VectorXd root = M.cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd dense = root.asDiagonal() * Eigen::MatrixXd(L) * root.asDiagonal();
    found = dense.eigenvalues();
  } else {
    const Inverted op(L, M, shift);
    Spectra::GenEigsSolver<const Inverted> solver(op, count, subspace);
    solver.init();
    solver.compute(Spectra::SortRule::LargestMagn, 300, 1e-9);
    if (solver.info() != Spectra::CompInfo::Successful) throw std::runtime_error("not converged");
    found = shift + solver.eigenvalues().cwiseInverse().array();
  }
  return {found.begin(), found.end()};
}

/// The label of the connected component of each point, from 0, and their number.
std::pair<std::vector<int>, int> componentsOf(const SparseMatrix& L) {
  DisjointSets sets(L.rows());
  for (int column = 0; column < L.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(L, column); entry; ++entry)
      if (entry.value() != 0) sets.unite(static_cast<int>(entry.row()), column);
  std::vector<int> label(L.rows(), -1);
  int count = 0;
  for (int i = 0; i < L.rows(); ++i) label[i] = sets.root(i) == i ? count++ : label[sets.root(i)];
  return {label, count};
}

Eigenvalues generalEigenvalues(const SparseMatrix& L, const VectorXd& M, int count) {
  if (M.size() == 0) throw std::runtime_error("no point has a row");
  const double shift = -1 / M.sum();  // below 0 by less than the first positive eigenvalue, and L - shift M is regular
  const auto [label, components] = componentsOf(L);
  std::vector<std::complex<double>> found;
  for (int c = 0; c < components; ++c) {
    std::vector<int> place(label.size(), -1), members;
    for (int i = 0; i < L.rows(); ++i) {
      if (label[i] != c) continue;
      place[i] = static_cast<int>(members.size());
      members.push_back(i);
    }
    const int n = static_cast<int>(members.size());
    const auto more = eigenvaluesNear(shift, partOf(L, place, place, n, n), M(members), count);
    found.insert(found.end(), more.begin(), more.end());
  }
  std::sort(found.begin(), found.end(),
            [&](const auto& a, const auto& b) { return std::abs(a - shift) < std::abs(b - shift); });
  found.resize(std::min(found.size(), static_cast<std::size_t>(count)));
  Eigenvalues result{VectorXd(static_cast<Eigen::Index>(found.size())), 0, 0};
  const double rounding = 1e-7 * std::abs(found.back());
  for (std::size_t i = 0; i < found.size(); ++i) {
    result.values[static_cast<Eigen::Index>(i)] = found[i].real();
    result.complex += std::abs(found[i].imag()) > rounding ? 1 : 0;
    result.negative += found[i].real() < -rounding ? 1 : 0;
  }
  std::sort(result.values.begin(), result.values.end());
  return result;
}

Laplacian asLaplacian(const SparseMatrix& L, const VectorXd& M) {
  Laplacian laplacian;
  laplacian.kind = Kind::cloud;
  laplacian.L = L;
  laplacian.M = M;
  laplacian.status.assign(M.size(), PointStatus::active);
  laplacian.boundary.assign(M.size(), Boundary::none);
  for (int i = 0; i < M.size(); ++i) laplacian.representative.push_back(i);
  return laplacian;
}

}  // namespace

Eigenvalues eigenvaluesOf(const Operators& operators, bool symmetric, int count) {
  std::vector<int> place(operators.M.size(), -1), active;
  for (int i = 0; i < operators.M.size(); ++i) {
    if (operators.L.coeff(i, i) == 0 || !(operators.M[i] > 0)) continue;
    place[i] = static_cast<int>(active.size());
    active.push_back(i);
  }
  const int n = static_cast<int>(active.size());
  const SparseMatrix L = partOf(operators.L, place, place, n, n);
  const VectorXd M = operators.M(active);
  if (symmetric) {
    try {
      return {spectrum(asLaplacian(L, M), count, {.threads = 1}).values, 0, 0};
    } catch (const SolverFailure&) {  // L is not semidefinite
    }
  }
  return generalEigenvalues(L, M, count);
}

std::optional<Eigen::MatrixXd> solvePinned(const SparseMatrix& L, bool symmetric, const Eigen::MatrixXd& f,
                                           const Pinned& pins, std::array<double, 2>* seconds) {
  const auto n = static_cast<int>(L.rows());
  const auto [label, components] = componentsOf(L);
  std::vector<bool> reached(components, false);
  for (const int point : pins.points) reached[label[point]] = true;
  std::vector<int> free, free_place(n, -1), pin_place(n, -1);
  for (std::size_t i = 0; i < pins.points.size(); ++i) pin_place[pins.points[i]] = static_cast<int>(i);
  for (int i = 0; i < n; ++i) {
    if (pin_place[i] >= 0 || !reached[label[i]]) continue;
    free_place[i] = static_cast<int>(free.size());
    free.push_back(i);
  }
  const int m = static_cast<int>(free.size()), pinned = static_cast<int>(pins.points.size());
  const Eigen::MatrixXd right = f(free, Eigen::all) - partOf(L, free_place, pin_place, m, pinned) * pins.values;
  const SparseMatrix A = partOf(L, free_place, free_place, m, m);
  Eigen::MatrixXd u = Eigen::MatrixXd::Constant(n, pins.values.cols(), NAN), solved;
  u(pins.points, Eigen::all) = pins.values;
  if (m == 0) return u;
  const auto solveWith = [&](auto&& factor) {
    Stopwatch watch;
    factor.compute(A);
    if (factor.info() != Eigen::Success) return false;
    if (seconds != nullptr) (*seconds)[0] = watch.seconds();
    const Stopwatch solving;
    solved = factor.solve(right);
    if (seconds != nullptr) (*seconds)[1] = solving.seconds();
    constexpr double most_residual = 1e-8;
    return (A * solved - right).norm() <= most_residual * right.norm();
  };
  // LDL^T does not pivot, so an indefinite matrix may need LU.
  const bool done = (symmetric && solveWith(Eigen::SimplicialLDLT<SparseMatrix>())) || solveWith(LU());
  if (!done) return std::nullopt;
  u(free, Eigen::all) = solved;
  return u;
}

double positiveShare(const SparseMatrix& L) {
  constexpr double rounding = 1e-12;  // of the larger diagonal: oracles and rivals do not clamp weights
  const VectorXd diagonal = L.diagonal().cwiseAbs();
  std::int64_t positive = 0, all = 0;
  for (int column = 0; column < L.outerSize(); ++column) {
    for (SparseMatrix::InnerIterator entry(L, column); entry; ++entry) {
      if (entry.row() == column || entry.value() == 0) continue;
      ++all;
      if (entry.value() > rounding * std::max(diagonal[column], diagonal[entry.row()])) ++positive;
    }
  }
  return all > 0 ? static_cast<double>(positive) / static_cast<double>(all) : 0;
}

}  // namespace tufted::bench
