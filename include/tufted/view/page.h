#pragma once

#include <filesystem>
#include <string>

#include "tufted/view/scene.h"
#include "tufted/view/whole_file.h"

namespace tufted {

/// What a page shows when it is opened. The user can change all of it there.
struct PageOptions {
  int field = 0;               ///< the field shown first, counted from 0; -1: none
  int column = 0;              ///< the column of that field, counted from 0
  std::string color_map = {};  ///< the colour map, one of colorMapNames(); empty: the default of the field's kind
  Camera camera = {};          ///< direction and zoom at first; the page looks at the middle of the scene
  /// A cloud of more points is thinned evenly to about so many, and the page says so; meshes are not. 0: all points.
  /// A million points take some 12 MB with one field, and browsers open them in a few seconds.
  Eigen::Index most_points = 1'000'000;
};

/// Makes one HTML page that shows a scene in any browser with WebGL 2. It is complete: it loads nothing, works from
/// disk and without a network, and sends nothing.
///
/// Positions, vectors and scalar values are stored with 16 bits each, normals with 16 bits together. The step of a
/// column is its range divided by 65534, so a value is off by at most half of that. The range extends from the least to
/// the greatest value, but beyond the 1st and the 99th percentile by at most six times their distance; values outside
/// are stored in full, so that a few outliers do not cost the others digits. Labels are stored in full, colours with 8
/// bits. Points keep their order: the page counts them from 0 as the caller does.
/// @param scene its texts may hold any bytes; what is not UTF-8 is shown as U+FFFD
/// @return the text of the page
/// @throws InvalidInput for the same reasons as checkScene(), and for a field, column or colour map that does not
/// exist, or a camera that is not finite or out of range
std::string pageOf(const Scene& scene, const PageOptions& options = {});

/// Writes pageOf() to a file, completely or not at all: it is written under another name beside `path` and then
/// renamed. An existing file of that name, or behind that link, is replaced; a pipe or a device is refused.
/// @param path name of the file, in a directory that exists
/// @throws InvalidInput for the same reasons as pageOf()
/// @throws IoError naming `path`
void writePage(const std::filesystem::path& path, const Scene& scene, const PageOptions& options = {});

/// Makes the file of writePage() without its name, which WholeFile::giveName() sets; otherwise nothing of it remains.
/// @throws InvalidInput and IoError for the same reasons as writePage()
WholeFile preparePage(const std::filesystem::path& path, const Scene& scene, const PageOptions& options = {});

}  // namespace tufted
