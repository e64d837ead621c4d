#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/scaling.h"
#include "tiles/cells.h"
#include "tufted/tiles.h"

namespace tufted {

/// A point in the file that SortedPoints writes.
struct StoredPoint {
  double position[3];   ///< in the caller's unit
  std::int64_t number;  ///< among all points
};

/// The points that take part, on disk, sorted by cells, so that a tile reads few parts of a file. The file has no name,
/// so nothing is left of it whatever ends the process.
class SortedPoints {
 public:
  /// Reads the source in two passes. @throws IoError naming `folder` if the file cannot be written
  SortedPoints(const PointSource& source, const Scaling& scaling, const std::filesystem::path& folder);

  const Cells& cells() const { return cells_; }
  /// Appends the points of the cells [first, last), those of each cell in the order of the source.
  void read(int first, int last, std::vector<StoredPoint>& points) const;

 private:
  /// A file without a name.
  class File {
   public:
    explicit File(const std::filesystem::path& folder);
    ~File();
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    int number() const { return number_; }

   private:
    int number_;
  };

  Cells write(const PointSource& source, const Scaling& scaling);

  std::filesystem::path folder_;
  File file_;
  Cells cells_;
};

}  // namespace tufted
