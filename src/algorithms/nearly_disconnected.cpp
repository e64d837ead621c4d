#include "algorithms/nearly_disconnected.h"

#include <algorithm>
#include <cmath>

#include "algorithms/remainder.h"
#include "base/disjoint_sets.h"

namespace tufted {
namespace {

/// Weights below this part of the smaller diagonal do not join, see Components.
constexpr double least_link_share = 1e-14;

struct Link {
  int i, j;
  double weight;
  double share;  ///< weight over the smaller diagonal
};

/// The parts that the weakest link of a maximum spanning forest joins.
/// @param points the caller's index of each number in links; the number after the last stands for a fixed value
std::optional<WeakJoint> weakestOf(std::vector<Link>& links, const std::vector<int>& points) {
  const int count = static_cast<int>(points.size());
  const auto weak =
      std::partition(links.begin(), links.end(), [](const Link& link) { return link.share > weak_share; });
  std::sort(weak, links.end(), [](const Link& a, const Link& b) {
    return a.share != b.share ? a.share > b.share : a.i != b.i ? a.i < b.i : a.j < b.j;
  });
  DisjointSets all(count + 1), before(count + 1);
  auto last = links.begin();
  for (auto link = links.begin(); link != links.end() && link->share > least_link_share; ++link)
    if (all.unite(link->i, link->j)) last = link;
  if (last < weak || last == links.end()) return std::nullopt;
  for (auto link = links.begin(); link != last; ++link) before.unite(link->i, link->j);
  WeakJoint joint;
  const int first = std::min(before.root(last->i), before.root(last->j));
  const int second = std::max(before.root(last->i), before.root(last->j));
  for (int k = 0; k < count; ++k) {
    const int root = before.root(k);
    if (root == first && joint.first_points++ == 0) joint.first = points[k];
    if (root == second && joint.second_points++ == 0) joint.second = points[k];
  }
  for (auto link = weak; link != links.end(); ++link) {
    const int a = before.root(link->i), b = before.root(link->j);
    if ((a == first && b == second) || (a == second && b == first)) joint.weight += link->weight;
  }
  return joint;
}

}  // namespace

PartConstants::PartConstants(const SparseMatrix& L, const std::vector<int>& points, const Components& parts,
                             const std::vector<std::uint8_t>& floating, const Inner& inner)
    : number_(parts.of.size(), -1) {
  std::vector<int> number(floating.size(), -1);
  int count = 0;
  for (std::size_t part = 0; part < floating.size(); ++part)
    if (floating[part] != 0) number[part] = count++;
  for (const int i : parts.points) number_[i] = number[parts.of[i]];
  // 1 on the part; outside of it the small values that its weak weights cause.
  extensions_ = Eigen::MatrixXd::Zero(L.cols(), count);
  for (const int i : parts.points)
    if (number_[i] >= 0) extensions_(i, number_[i]) = 1;
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(L.cols(), count);
  for (int round = 0; round < 2; ++round) {
    const Eigen::MatrixXd left = remainderOfLaplacian(L, points, none, none, extensions_).rest;
    extensions_ += inner(left);
  }
  const Eigen::MatrixXd flux = -sums(remainderOfLaplacian(L, points, none, none, extensions_).rest);
  complement_ = DenseCholesky((flux + flux.transpose()) / 2);
}

Eigen::MatrixXd PartConstants::sums(const Eigen::MatrixXd& values) const {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(extensions_.cols(), values.cols());
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    if (number_[i] >= 0) result.row(number_[i]) += values.row(i);
  return result;
}

Eigen::MatrixXd PartConstants::solve(const SparseMatrix& L, const std::vector<int>& points, const Eigen::MatrixXd& rest,
                                     const Inner& inner) const {
  Eigen::MatrixXd x = inner(rest);
  const Eigen::MatrixXd flux = sums(remainderOfLaplacian(L, points, rest, rest.cwiseAbs(), x).rest);
  x += extensions_ * complement_.solve(flux);
  return x;
}

std::optional<WeakJoint> weakestJoint(const SparseMatrix& L) {
  const VectorXd diagonal = L.diagonal();
  std::vector<int> points(L.cols());
  std::vector<Link> links;
  for (int j = 0; j < L.cols(); ++j) {
    points[j] = j;
    for (SparseMatrix::InnerIterator entry(L, j); entry; ++entry) {
      const int i = static_cast<int>(entry.row());
      const double weight = std::abs(entry.value());
      if (i < j && weight > 0) links.push_back({i, j, weight, weight / std::min(diagonal[i], diagonal[j])});
    }
  }
  return weakestOf(links, points);
}

std::optional<WeakJoint> weakestJoint(const LongMatrix& lower, const std::vector<int>& points) {
  const VectorXd diagonal = lower.diagonal();
  VectorXd beyond = diagonal;  // excess of each diagonal over the other entries of its row
  std::vector<Link> links;
  for (Eigen::Index j = 0; j < lower.cols(); ++j) {
    for (LongMatrix::InnerIterator entry(lower, j); entry; ++entry) {
      const Eigen::Index i = entry.row();
      const double weight = std::abs(entry.value());
      if (i == j || weight == 0) continue;
      beyond[i] -= weight, beyond[j] -= weight;
      links.push_back({static_cast<int>(j), static_cast<int>(i), weight, weight / std::min(diagonal[i], diagonal[j])});
    }
  }
  const int fixed = static_cast<int>(points.size());
  for (int i = 0; i < fixed; ++i)
    if (beyond[i] > 0) links.push_back({i, fixed, beyond[i], beyond[i] / diagonal[i]});
  return weakestOf(links, points);
}

}  // namespace tufted
