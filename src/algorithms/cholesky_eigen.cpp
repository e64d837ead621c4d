#include <Eigen/SparseCholesky>
#include <new>

#include "algorithms/linear_backend.h"

namespace tufted {
namespace {

class Factor : public Eigen::SimplicialLDLT<LongMatrix> {
 public:
  /// Computes the numeric factor. False if the matrix is not positive definite.
  bool compute(const LongMatrix& lower) {
    factorize(lower);
    return info() == Eigen::Success && vectorD().minCoeff() > 0;
  }
  /// Number of entries of the factor below the diagonal; known after the analysis.
  std::int64_t nonzeros() const { return m_matrix.outerIndexPtr()[m_matrix.outerSize()]; }
};

class EigenBackend : public LinearBackend {
 public:
  explicit EigenBackend(std::unique_ptr<Factor> factor) : factor_(std::move(factor)) {}
  int solve(Eigen::Ref<Eigen::MatrixXd> x, const Tick& /*tick*/) const override {
    for (Eigen::Index c = 0; c < x.cols(); ++c) x.col(c) = factor_->solve(x.col(c)).eval();
    return 0;
  }
  bool refactor(const LongMatrix& lower) override { return factor_->compute(lower); }

 private:
  std::unique_ptr<Factor> factor_;
};

}  // namespace

struct Cholesky::Analysis {
  explicit Analysis(const LongMatrix& matrix) : lower(matrix) {}

  const LongMatrix& lower;
  std::unique_ptr<Factor> factor = std::make_unique<Factor>();
};

Cholesky::Cholesky(const LongMatrix& lower, std::size_t /*limit*/) : analysis_(std::make_unique<Analysis>(lower)) {
  analysis_->factor->analyzePattern(lower);
}

Cholesky::~Cholesky() = default;

std::size_t Cholesky::bytes() const {
  return static_cast<std::size_t>(analysis_->factor->nonzeros()) * (sizeof(double) + sizeof(std::int64_t)) +
         static_cast<std::size_t>(analysis_->lower.rows()) * 4 * sizeof(std::int64_t);
}

std::unique_ptr<LinearBackend> Cholesky::factor() {
  Factor& factor = *analysis_->factor;
  if (!factor.compute(analysis_->lower)) return nullptr;
  const std::int64_t nonzeros = factor.nonzeros() + analysis_->lower.rows();
  auto backend = std::make_unique<EigenBackend>(std::move(analysis_->factor));
  backend->name = "Cholesky (Eigen, AMD)";
  backend->nonzeros = nonzeros;
  return backend;
}

}  // namespace tufted
