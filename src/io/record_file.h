#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tufted/io/read.h"

namespace tufted::io {

/// How a binary file holds its points: as records of one size. Consecutive records are a file of their own, behind a
/// header that counts no others, so the reader of the format reads a large file in parts.
struct RecordLayout {
  FileFormat format = FileFormat::automatic;
  std::int64_t points = 0;
  std::size_t record_bytes = 0;     ///< bytes of a point, or of one of its values if the file has `columns`
  std::size_t begin = 0;            ///< byte at which the records begin
  std::size_t end = 0;              ///< byte before which the file announces nothing but records
  std::int64_t columns = 1;         ///< if not 1, all first values of points come first, then all second ones, ...
  bool is_organized = false;        ///< whether the points are a grid of more than one row
  bool has_faces = false;           ///< whether faces follow
  bool is_named_by_values = false;  ///< whether names of fields depend on all values
  /// Makes the header of a file of so many of the points, without grid and faces.
  std::function<std::string(std::int64_t points)> header = {};
};

/// The layout of a LAS, binary PLY, binary PCD or NPY file.
/// @param bytes at least the header
/// @param size bytes of the whole file
/// @return nullopt for files of other formats or without points, compressed ones, PLY with lists or elements before the
/// points, and grids of NPY in Fortran's order
/// @throws IoError if the header is not valid, or counts more than the file holds
std::optional<RecordLayout> recordLayout(const std::filesystem::path& path, std::string_view bytes, std::size_t size);

/// A binary file of points that is read in batches, as often as needed.
class RecordFile {
 public:
  /// @param batch_bytes most bytes of a batch in the file, though it has a point at least; the default stays in the
  /// cache
  /// @return null for a file without RecordLayout, or that cannot be opened; read() says why
  /// @throws IoError as recordLayout()
  static std::shared_ptr<RecordFile> open(const std::filesystem::path& path, std::size_t batch_bytes = 1 << 21);

  const RecordLayout& layout() const { return layout_; }
  /// What read() would note: bytes behind the last record.
  std::vector<std::string> notes();

  /// Calls visit(batch, number of its first point) for batches of all points, in order. A batch is what read() returns
  /// for these points, without a grid.
  /// @throws IoError naming the byte if the file is not as it was in the first call; as read() for bad records
  void forBatches(const std::function<void(const Geometry& batch, std::int64_t first)>& visit);

 private:
  /// Appends bytes of the file.
  void read(std::size_t begin, std::size_t count, std::string& bytes);

  std::filesystem::path path_;
  std::ifstream file_;
  RecordLayout layout_;
  std::vector<std::optional<std::size_t>> sums_;  ///< hash of the bytes of each batch, once they were read
};

}  // namespace tufted::io
