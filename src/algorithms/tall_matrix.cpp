#include "algorithms/tall_matrix.h"

#include <algorithm>
#include <vector>

#include "algorithms/serial_blas.h"
#include "base/dense_solvers.h"

namespace tufted {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

using Block = Eigen::Ref<MatrixXd>;
using ConstBlock = Eigen::Ref<const MatrixXd>;

#ifdef TUFTED_WITH_GPL
// The BLAS that CHOLMOD uses, several times faster than Eigen, which is compiled for the oldest processors.
// NOLINTNEXTLINE(readability-identifier-naming): its name
extern "C" void dgemm_(const char* transpose_a, const char* transpose_b, const int* m, const int* n, const int* k,
                       const double* alpha, const double* a, const int* lda, const double* b, const int* ldb,
                       const double* beta, double* c, const int* ldc);

/// Computes C = beta C + alpha A^T B if `transpose`, otherwise C = beta C + alpha A B.
void multiply(bool transpose, double alpha, const ConstBlock& A, const ConstBlock& B, double beta, Block C) {
  const int m = static_cast<int>(C.rows()), n = static_cast<int>(C.cols());
  const int k = static_cast<int>(B.rows());
  if (m == 0 || n == 0) return;
  if (k == 0) {  // BLAS rejects the leading dimension of an empty matrix
    if (beta == 0) C.setZero();
    return;
  }
  const int lda = static_cast<int>(A.outerStride()), ldb = static_cast<int>(B.outerStride()),
            ldc = static_cast<int>(C.outerStride());
  dgemm_(transpose ? "T" : "N", "N", &m, &n, &k, &alpha, A.data(), &lda, B.data(), &ldb, &beta, C.data(), &ldc);
}
#else
void multiply(bool transpose, double alpha, const ConstBlock& A, const ConstBlock& B, double beta, Block C) {
  if (beta == 0) C.setZero();
  if (transpose)
    C.noalias() += alpha * (A.transpose() * B);
  else
    C.noalias() += alpha * (A * B);
}
#endif

/// Rows of a block, which fit into a core's cache together with the columns that they are multiplied by.
constexpr std::int64_t rows_per_block = 1024;

}  // namespace

MatrixXd innerProducts(const Eigen::Ref<const MatrixXd>& X, const Eigen::VectorXd& weights,
                       const Eigen::Ref<const MatrixXd>& Y, const Workers& workers) {
  const SerialBlas serial;
  // One sum per this many rows, because sums per worker would depend on the number of threads.
  constexpr std::int64_t rows_per_sum = 16 * rows_per_block;
  std::vector<MatrixXd> sums(static_cast<std::size_t>((X.rows() + rows_per_sum - 1) / rows_per_sum));
  workers.forBlocks("products", X.rows(), rows_per_sum, [&](std::int64_t first, std::int64_t last, int) {
    MatrixXd& sum = sums[first / rows_per_sum];
    sum = MatrixXd::Zero(X.cols(), Y.cols());
    for (std::int64_t begin = first; begin < last; begin += rows_per_block) {
      const Index size = std::min(rows_per_block, last - begin);
      const MatrixXd weighted = weights.segment(begin, size).asDiagonal() * Y.middleRows(begin, size);
      multiply(true, 1, X.middleRows(begin, size), weighted, 1, sum);
    }
  });
  MatrixXd total = MatrixXd::Zero(X.cols(), Y.cols());
  for (const MatrixXd& sum : sums) total += sum;
  return total;
}

void subtractProduct(Eigen::Ref<MatrixXd> Y, const Eigen::Ref<const MatrixXd>& X, const MatrixXd& C,
                     const Workers& workers) {
  const SerialBlas serial;
  workers.forBlocks("products", X.rows(), rows_per_block, [&](std::int64_t begin, std::int64_t end, int) {
    multiply(false, -1, X.middleRows(begin, end - begin), C, 1, Y.middleRows(begin, end - begin));
  });
}

void multiplyInto(const Eigen::Ref<const MatrixXd>& X, const MatrixXd& C, Eigen::Ref<MatrixXd> Y,
                  const Workers& workers) {
  const SerialBlas serial;
  workers.forBlocks("products", X.rows(), rows_per_block, [&](std::int64_t begin, std::int64_t end, int) {
    MatrixXd product(end - begin, C.cols());
    multiply(false, 1, X.middleRows(begin, end - begin), C, 0, product);
    Y.middleRows(begin, end - begin) = product;
  });
}

void multiplyInPlace(Eigen::Ref<MatrixXd> X, const MatrixXd& C, const Workers& workers) {
  multiplyInto(X, C, X.leftCols(C.cols()), workers);
}

bool orthonormalize(const Eigen::VectorXd& mass, const Workers& workers, Eigen::Ref<MatrixXd> X) {
  const DenseCholesky gram(innerProducts(X, mass, X, workers));
  if (!gram.isDefinite()) return false;
  multiplyInPlace(X, gram.inverseOfUpper(), workers);
  return true;
}

}  // namespace tufted
