#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/file_text.h"
#include "io/record_layout.h"

namespace tufted::io {

/// A binary file of points that is read in batches, as often as needed.
class RecordFile {
 public:
  static constexpr std::size_t usual_bytes = std::size_t{1} << 21;  ///< stay in the cache

  /// @param batch_bytes bytes that a batch takes in the file, at most, but it has a point at least
  /// @return null for a file without RecordLayout, which must be read as a whole
  /// @throws IoError as InputFile and recordLayout()
  static std::shared_ptr<RecordFile> open(const std::filesystem::path& path, std::size_t batch_bytes = usual_bytes);

  RecordFile(InputFile file, RecordLayout layout, std::size_t batch_bytes);

  const RecordLayout& layout() const { return layout_; }
  /// Bytes of memory that a batch takes, with its points twice.
  double batchMemory() const;
  /// What read() would note: bytes behind the last record.
  std::vector<std::string> notes() const;

  /// Calls visit(batch, number of its first point) for batches of all points, in order. A batch is what read() returns
  /// for these points, without a grid.
  /// @throws IoError naming the byte if the file is not as it was in the first call; as read() for bad records
  void forBatches(const std::function<void(const Geometry& batch, std::int64_t first)>& visit);

 private:
  std::int64_t batches() const { return static_cast<std::int64_t>(sums_.size()); }
  std::int64_t firstOf(std::int64_t batch) const { return layout_.points * batch / batches(); }
  std::string bytesOf(std::int64_t batch) const;
  Geometry parseBatch(std::string_view bytes) const;

  InputFile file_;
  RecordLayout layout_;
  std::vector<std::optional<std::size_t>> sums_;  ///< hash of the bytes of each batch, once they were read
};

}  // namespace tufted::io
