#include "algorithms/connected.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/disjoint_sets.h"

namespace tufted {
namespace {

/// Weights below this part of the smaller diagonal do not join, see Components.
constexpr double least_weight = 1e-14;

/// The components of points joined by weights above `least_share` of the smaller diagonal.
Components joinedAbove(double least_share, const Laplacian& laplacian) {
  const SparseMatrix& L = laplacian.L;
  const VectorXd diagonal = L.diagonal();
  DisjointSets sets(L.cols());
  for (int j = 0; j < L.cols(); ++j) {
    for (SparseMatrix::InnerIterator entry(L, j); entry; ++entry) {
      const int i = static_cast<int>(entry.row());
      if (i < j && std::abs(entry.value()) > least_share * std::min(diagonal[i], diagonal[j])) sets.unite(i, j);
    }
  }
  Components components;
  components.of.assign(laplacian.status.size(), -1);
  for (int i = 0; i < static_cast<int>(laplacian.status.size()); ++i) {
    if (laplacian.status[i] != PointStatus::active) continue;
    components.points.push_back(i);
    const int root = sets.root(i);  // the first point of the set
    components.of[i] = root == i ? components.count++ : components.of[root];
  }
  return components;
}

}  // namespace

int Components::largest() const {
  Eigen::Index place = -1;
  if (count > 0) sums(VectorXd::Ones(std::ssize(of))).maxCoeff(&place);
  return static_cast<int>(place);
}

VectorXd Components::sums(const VectorXd& values) const {
  VectorXd result = VectorXd::Zero(count);
  for (const int i : points) result[of[i]] += values[i];
  return result;
}

VectorXd Components::weights(const VectorXd& M) const {
  const VectorXd mass = sums(M);
  VectorXd result = VectorXd::Zero(M.size());
  const VectorXd size = sums(VectorXd::Ones(M.size()));
  for (const int i : points) {
    const int c = of[i];
    result[i] = mass[c] > 0 ? M[i] / mass[c] : 1 / size[c];
  }
  return result;
}

Eigen::MatrixXd Components::normalise(Eigen::Ref<Eigen::MatrixXd> values) const {
  Eigen::MatrixXd top = Eigen::MatrixXd::Zero(count, values.cols());
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    for (const int i : points) top(of[i], c) = std::max(top(of[i], c), std::abs(values(i, c)));
  }
  top = (top.array() > 0).select(top, 1);
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    for (const int i : points) values(i, c) /= top(of[i], c);
  }
  return top;
}

void Components::multiply(Eigen::Ref<Eigen::MatrixXd> values, const Eigen::MatrixXd& factors) const {
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    for (const int i : points) values(i, c) *= factors(of[i], c);
  }
}

std::string whyOnNone(const std::string& what, int point, PointStatus status) {
  return what + " " + std::to_string(point) + (status == PointStatus::not_finite ? " is not finite" : " is isolated");
}

Components findComponents(const Laplacian& laplacian) {
  return joinedAbove(least_weight, laplacian);
}

Components findParts(const Laplacian& laplacian) {
  double share = weak_share;
  Components parts = joinedAbove(share, laplacian);
  if (parts.count <= most_floating_parts) return parts;
  const int components = findComponents(laplacian).count;
  while (parts.count > components + most_floating_parts)
    parts = joinedAbove(share = std::max(share / 10, least_weight), laplacian);
  return parts;
}

}  // namespace tufted
