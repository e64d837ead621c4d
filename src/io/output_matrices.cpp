#include "io/output_matrices.h"

#include "tufted/dummy_values.h"

namespace tufted::io {

OutputMatrices::OutputMatrices(const Laplacian& laplacian, const WriteOptions& options) : laplacian_(laplacian) {
  if (options.dummy) {
    L_ = laplacian.L;
    M_ = laplacian.M;
    setDummyValues(*L_, *M_, laplacian.status);
  }
  if (options.sign == Sign::igl || !matrix().isCompressed()) {
    if (!L_) L_ = laplacian.L;
    L_->makeCompressed();
    if (options.sign == Sign::igl) L_->coeffs() = -L_->coeffs();
  }
}

}  // namespace tufted::io
