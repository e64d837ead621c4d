#include "algorithms/inertia.h"

#include <Eigen/SparseCholesky>
#include <cmath>
#include <cstdint>
#include <new>

#include "operators/lower_triangle.h"

namespace tufted {
namespace {

class LongFactor : public Eigen::SimplicialLDLT<LongMatrix> {
 public:
  /// Bytes of the factor; known after the analysis.
  std::size_t bytes() const {
    return static_cast<std::size_t>(m_matrix.outerIndexPtr()[m_matrix.outerSize()]) *
           (sizeof(double) + sizeof(std::int64_t));
  }
};

}  // namespace

std::optional<Eigen::Index> eigenvaluesBelow(const SparseMatrix& L, const VectorXd& mass, double bound,
                                             const std::vector<int>& points, std::size_t memory_limit) try {
  NumberedPoints selection(static_cast<std::size_t>(L.cols()));
  for (const int i : points) selection.add(i);
  const LongMatrix lower =
      lowerTriangle(L, selection, [&](int i, int j, double value) { return i == j ? value - bound * mass[i] : value; });
  // Eigen's factor, as CHOLMOD's supernodal one is for positive definite matrices only.
  LongFactor factor;
  factor.analyzePattern(lower);
  if (factor.bytes() > memory_limit) return std::nullopt;
  factor.factorize(lower);
  if (factor.info() != Eigen::Success || !factor.vectorD().allFinite()) return std::nullopt;
  return (factor.vectorD().array() < 0).count();
} catch (const std::bad_alloc&) {
  return std::nullopt;
}

}  // namespace tufted
