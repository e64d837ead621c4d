#pragma once

#include <filesystem>
#include <string>

#include "tufted/view/camera.h"
#include "tufted/view/scene.h"
#include "tufted/view/whole_file.h"

namespace tufted {

/// What a page shows when it is opened. All of it can be changed there.
struct PageOptions {
  int field = 0;               ///< the field shown first, counted from 0; -1: none
  int column = 0;              ///< and its column, counted from 0
  std::string color_map = {};  ///< its colour map, one of colorMapNames(); empty: that of its kind
  Camera camera = {};          ///< from which direction it is seen and how near; the page looks at the middle
};

/// One HTML page that shows a scene in any browser with WebGL 2. It is complete: it loads nothing, works from disk and
/// without a network, and sends nothing.
///
/// Positions, vectors and scalar values are stored with 16 bits each, normals with 16 bits together. The step of a
/// column is its range divided by 65534, so a value is off by at most half of that. The range runs from least to
/// greatest, but no farther than six times the distance of the 1st and the 99th percentile beyond these; values farther
/// out are stored whole, so that few outliers cost the others no digits. Labels are stored whole, colours with 8 bits.
/// Points keep their order: the page counts them from 0 as the caller does.
/// @param scene its texts may hold any bytes; what is not UTF-8 is shown as U+FFFD
/// @throws InvalidInput as checkScene() does, for a field or column that there is not, an unknown colour map, or a
///         direction that is not finite
std::string pageOf(const Scene& scene, const PageOptions& options = {});

/// Writes pageOf() to a file. It appears whole or not at all: it is written beside `path` under another name, which is
/// then changed. A file of that name, or behind that link, is replaced; a pipe or a device is refused.
/// @param path the name of the file, in a directory that exists
/// @throws InvalidInput as pageOf()
/// @throws IoError naming `path`
void writePage(const std::filesystem::path& path, const Scene& scene, const PageOptions& options = {});

/// Makes the file of writePage(), which gets its name only by giveName(); without that nothing of it is left.
/// @throws as writePage()
WholeFile preparePage(const std::filesystem::path& path, const Scene& scene, const PageOptions& options = {});

}  // namespace tufted
