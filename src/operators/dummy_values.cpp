#include "tufted/dummy_values.h"

#include <algorithm>
#include <limits>
#include <string>

#include "tufted/errors.h"

namespace tufted {

void setDummyValues(SparseMatrix& L, VectorXd& M, const std::vector<PointStatus>& status) {
  const auto n = static_cast<Eigen::Index>(status.size());
  if (L.rows() != n || L.cols() != n || M.size() != n) {
    throw InvalidInput("setDummyValues: L is " + std::to_string(L.rows()) + " x " + std::to_string(L.cols()) +
                       " and M has " + std::to_string(M.size()) + " values, must be for " + std::to_string(n) +
                       " points, as status");
  }
  std::vector<Eigen::Triplet<double>> entries;
  const double mass = dummyMass(M);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (status[i] == PointStatus::active) continue;
    entries.emplace_back(static_cast<int>(i), static_cast<int>(i), 1);
    M[i] = mass;
  }
  if (entries.empty()) return;
  SparseMatrix diagonal(n, n);
  diagonal.setFromTriplets(entries.begin(), entries.end());
  L = SparseMatrix(L + diagonal);  // rows and columns of these points are empty, so no entry changes
}

double dummyMass(const VectorXd& M) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const double mass : M)
    if (mass > 0) smallest = std::min(smallest, mass);
  if (smallest == std::numeric_limits<double>::infinity()) return 1;
  return std::max(1e-3 * smallest, std::numeric_limits<double>::min());
}

}  // namespace tufted
