#pragma once

#include <optional>

#include "tufted/io/write.h"
#include "tufted/laplacian.h"

namespace tufted::io {

/// L and M as they are written to files: compressed, with the sign and the dummy values of the options. Only what is
/// changed is copied; the rest is borrowed.
class OutputMatrices {
 public:
  OutputMatrices(const Laplacian& laplacian, const WriteOptions& options);

  const SparseMatrix& matrix() const { return L_ ? *L_ : laplacian_.L; }
  const VectorXd& masses() const { return M_ ? *M_ : laplacian_.M; }

 private:
  const Laplacian& laplacian_;
  std::optional<SparseMatrix> L_;
  std::optional<VectorXd> M_;
};

}  // namespace tufted::io
