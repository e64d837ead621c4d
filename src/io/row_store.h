#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "tufted/tiles.h"

namespace tufted::io {

/// Rows of tiles on disk, until all are there and can be written in the order of their points. The files have no names,
/// so nothing is left of them whatever ends the process.
class RowStore {
 public:
  /// @param points number of all points
  /// @throws IoError naming `folder`, here and below, if a file cannot be written or read
  RowStore(std::filesystem::path folder, std::int64_t points);

  /// Adds the rows of a tile. They replace earlier rows of the same points.
  void add(const TileRows& rows);

  /// Calls visit(rows) for consecutive blocks of all points, in order; points without a row are
  /// PointStatus::not_finite.
  void forBlocks(const std::function<void(const TileRows& rows)>& visit);

 private:
  using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
  void write(std::FILE* file, const void* bytes, std::size_t size) const;
  std::vector<char> readBlock(std::FILE* file) const;

  std::filesystem::path folder_;
  std::int64_t points_;
  std::int64_t block_points_;  ///< consecutive points per file
  std::vector<File> blocks_;   ///< of consecutive points each
};

}  // namespace tufted::io
