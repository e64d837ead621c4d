#pragma once

#include <filesystem>

#include "io/npz_reader.h"
#include "tufted/types.h"

namespace tufted::io {

/// A square matrix in a .npz file of scipy, by columns or rows. What it says of its size is known at once and to be
/// compared with other files, before its entries are read.
class MatrixFile {
 public:
  /// @throws IoError for what is no such file, and where the arrays do not fit each other
  explicit MatrixFile(const std::filesystem::path& path);

  int rows() const { return rows_; }

  /// To be called once. Entries that stand several times, in any order within a column, are summed as scipy does.
  /// @throws IoError
  SparseMatrix read();

 private:
  std::vector<int> readStarts();

  std::filesystem::path path_;
  NpzReader archive_;
  bool by_rows_ = false;
  int rows_ = 0;
  NpzArray starts_, indices_, values_;
};

}  // namespace tufted::io
