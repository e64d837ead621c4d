#include "io/matrix_writers.h"
#include "io/npz_archive.h"

namespace tufted::io {

void writeNpz(const OutputPath& to, const SparseMatrix& matrix) {
  static_assert(sizeof(SparseMatrix::StorageIndex) == 4 && !SparseMatrix::IsRowMajor);
  const std::int64_t shape[2] = {matrix.rows(), matrix.cols()};
  NpzArchive archive(to);
  archive.add("indices.npy", "<i4", {matrix.nonZeros()}, matrix.innerIndexPtr(), matrix.nonZeros() * sizeof(int));
  archive.add("indptr.npy", "<i4", {matrix.cols() + 1}, matrix.outerIndexPtr(), (matrix.cols() + 1) * sizeof(int));
  archive.add("format.npy", "|S3", {}, "csc", 3);
  archive.add("shape.npy", "<i8", {2}, shape, sizeof(shape));
  archive.add("data.npy", "<f8", {matrix.nonZeros()}, matrix.valuePtr(), matrix.nonZeros() * sizeof(double));
  archive.close();
}

}  // namespace tufted::io
