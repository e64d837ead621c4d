#pragma once

#include <filesystem>

#include "io/npz_reader.h"
#include "tufted/types.h"

namespace tufted::io {

/// A square matrix in a .npz file of scipy, by columns or rows. Its size is known at once and must be compared with
/// other files before its entries are read.
class MatrixFile {
 public:
  /// Opens the file.
  /// @throws IoError for a file that is not such a matrix, or whose arrays do not fit each other
  explicit MatrixFile(const std::filesystem::path& path);

  int rows() const { return rows_; }

  /// Reads the entries; to be called once. Entries that occur several times, in any order within a column, are summed
  /// as scipy does.
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
