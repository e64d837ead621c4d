#pragma once

#include <filesystem>

#include "io/npz_reader.h"
#include "tufted/types.h"

namespace tufted::io {

/// A square sparse matrix in a .npz file of scipy, csc or csr. The constructor reads its size, which callers must
/// compare with other files before they read the entries.
class MatrixFile {
 public:
  /// Opens the file.
  /// @throws IoError for a file that is not such a matrix, or whose arrays do not fit each other
  explicit MatrixFile(const std::filesystem::path& path);

  int rows() const { return rows_; }

  /// Reads the entries. To be called once. Entries of a column may be in any order; repeated ones are summed, as in
  /// scipy.
  /// @throws IoError naming the file
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
