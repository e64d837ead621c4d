#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <vector>

#include "oracles/oracles.h"

namespace tufted::oracles {
namespace {

/// The active points with mass, or those without.
std::vector<int> pointsWhere(const SparseMatrix& L, const VectorXd& M, bool with_mass) {
  std::vector<int> points;
  for (int i = 0; i < M.size(); ++i)
    if (M[i] > 0 ? with_mass : !with_mass && L.coeff(i, i) != 0) points.push_back(i);
  return points;
}

template <class Scalar>
VectorXd eigenvalues(const SparseMatrix& L, const VectorXd& M) {
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  const std::vector<int> points = pointsWhere(L, M, true), massless = pointsWhere(L, M, false);
  const Matrix dense = Eigen::MatrixXd(L).cast<Scalar>();
  Matrix S = dense(points, points);
  if (!massless.empty()) {
    const Eigen::LLT<Matrix> factor(Matrix(dense(massless, massless)));
    S -= dense(points, massless) * factor.solve(Matrix(dense(massless, points)));
  }
  const auto scale = M(points).cast<Scalar>().cwiseSqrt().cwiseInverse().eval();
  S = scale.asDiagonal() * S * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Matrix>(S, Eigen::EigenvaluesOnly).eigenvalues().template cast<double>();
}

}  // namespace

VectorXd denseEigenvalues(const SparseMatrix& L, const VectorXd& M, Precision precision) {
  return precision == Precision::extended ? eigenvalues<long double>(L, M) : eigenvalues<double>(L, M);
}

}  // namespace tufted::oracles
