#include "algorithms/dense_pairs.h"

#include <algorithm>
#include <cmath>

#include "base/dense_solvers.h"
#include "base/symmetric_eigen.h"

namespace tufted {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// The entries of L in some rows and columns, as a dense matrix.
MatrixXd denseBlock(const SparseMatrix& L, const std::vector<int>& rows, const std::vector<int>& columns) {
  std::vector<Index> place(static_cast<std::size_t>(L.rows()), -1);
  for (Index i = 0; i < std::ssize(rows); ++i) place[rows[i]] = i;
  MatrixXd block = MatrixXd::Zero(std::ssize(rows), std::ssize(columns));
  for (Index j = 0; j < block.cols(); ++j) {
    for (SparseMatrix::InnerIterator entry(L, columns[j]); entry; ++entry)
      if (place[entry.row()] >= 0) block(place[entry.row()], j) = entry.value();
  }
  return block;
}

}  // namespace

std::optional<Eigenpairs> densePairs(const Eigenproblem& problem, Index wanted) {
  const SparseMatrix& L = problem.L;
  const VectorXd scaled = L.diagonal().cwiseQuotient(problem.mass);
  std::vector<int> points;
  for (const int i : problem.components.points)
    if (problem.mass[i] > 0) points.push_back(i);
  // The largest entries come first, so that reduction to a tridiagonal matrix keeps the digits of the small ones.
  std::stable_sort(points.begin(), points.end(), [&](int a, int b) { return scaled[a] > scaled[b]; });
  MatrixXd S = denseBlock(L, points, points);
  if (!problem.massless.empty()) {
    const MatrixXd across = denseBlock(L, problem.massless, points);
    S -= across.transpose() * DenseCholesky(denseBlock(L, problem.massless, problem.massless)).solve(across);
  }
  const VectorXd scale = problem.mass(points).cwiseSqrt().cwiseInverse();
  S = scale.asDiagonal() * S * scale.asDiagonal();
  if (!S.allFinite()) return std::nullopt;
  const auto solver = symmetricEigen(S);
  if (solver.info() != Eigen::Success) return std::nullopt;
  S.resize(0, 0);
  Eigenpairs pairs{solver.eigenvalues().segment(problem.nulls(), wanted), MatrixXd::Zero(L.rows(), wanted), {}};
  pairs.vectors(points, Eigen::all) = scale.asDiagonal() * solver.eigenvectors().middleCols(problem.nulls(), wanted);
  problem.fillMassless(pairs.vectors);
  return pairs;
}

}  // namespace tufted
