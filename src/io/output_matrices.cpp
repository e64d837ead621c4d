#include "io/output_matrices.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace tufted::io {
namespace {

/// A diagonal matrix with `diagonal` for each point that is not active.
SparseMatrix dummyDiagonal(const Laplacian& laplacian, double diagonal) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < laplacian.status.size(); ++i)
    if (laplacian.status[i] != PointStatus::active)
      entries.emplace_back(static_cast<int>(i), static_cast<int>(i), diagonal);
  SparseMatrix matrix(laplacian.L.rows(), laplacian.L.cols());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

OutputMatrices::OutputMatrices(const Laplacian& laplacian, const WriteOptions& options) : laplacian_(laplacian) {
  if (options.dummy) {
    // The rows and columns of these points are empty, so the sum adds no two numbers.
    L_ = laplacian.L + dummyDiagonal(laplacian, 1);
    M_ = laplacian.M;
    const double mass = dummyMass(laplacian);
    for (std::size_t i = 0; i < laplacian.status.size(); ++i)
      if (laplacian.status[i] != PointStatus::active) (*M_)(static_cast<Eigen::Index>(i)) = mass;
  }
  if (options.sign == Sign::igl || !matrix().isCompressed()) {
    if (!L_) L_ = laplacian.L;
    L_->makeCompressed();
    if (options.sign == Sign::igl) L_->coeffs() = -L_->coeffs();
  }
}

double dummyMass(const Laplacian& laplacian) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const double mass : laplacian.M)
    if (mass > 0) smallest = std::min(smallest, mass);
  if (smallest == std::numeric_limits<double>::infinity()) return 1;
  return std::max(1e-3 * smallest, std::numeric_limits<double>::min());
}

}  // namespace tufted::io
