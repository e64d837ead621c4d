#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tufted/view/camera.h"
#include "tufted/view/scene.h"
#include "tufted/view/whole_file.h"

namespace tufted {

/// What is seen where there is no surface.
enum class Background : std::uint8_t { white, dark, transparent };

/// How a picture is drawn.
struct PictureOptions {
  int width = 1200;            ///< pixels, from 16 to 8192
  int height = 900;            ///< pixels, from 16 to 8192
  int field = 0;               ///< the field shown, counted from 0; -1: none
  int column = 0;              ///< and its column, counted from 0
  std::string color_map = {};  ///< one of colorMapNames(); empty: that of the field's kind
  /// The values at both ends of the colour map; by default the least and the greatest. Outliers have the colour of an
  /// end: values beyond the 1st and the 99th percentile, if they are also farther beyond the quartiles than three times
  /// the distance of these. Values around 0 have the same range on both sides, lengths begin at 0.
  std::optional<std::array<double, 2>> range = {};
  Background background = Background::white;  ///< where there is no surface
  bool light = true;                          ///< shades the surface; false: colours are exactly those of the map
  std::optional<bool> isolines = {};          ///< lines of equal values; by default for distances
  bool legend = true;                         ///< title, and the colours with their values
  Camera camera = {};                         ///< from where it is seen
  int threads = 0;  ///< at most this many; 0: one per processor. The picture has the same bits for any number.
};

/// Pixels.
struct Picture {
  int width = 0;                     ///< columns
  int height = 0;                    ///< rows
  std::vector<std::uint8_t> pixels;  ///< red, green, blue and alpha, rows from the top
};

/// Draws a scene without a screen or a graphics card: triangles, and points that are no corner as discs as wide as
/// their neighbours are apart. Scenes without normals are shaded by depth (eye-dome lighting, Boucheny 2009). Values
/// that are not finite, and all points without a field, are grey.
/// @throws InvalidInput as checkScene(), for a field or column that there is not, a size, zoom, range or direction out
///         of range, or an unknown colour map
Picture drawPicture(const Scene& scene, const PictureOptions& options = {});

/// Writes drawPicture() as a PNG file, whole or not at all, as writePage() does. A file of that name is replaced.
/// @throws InvalidInput as drawPicture(); IoError naming `path`
void writePicture(const std::filesystem::path& path, const Scene& scene, const PictureOptions& options = {});

/// Makes the file of writePicture(), which gets its name only by giveName(); without that nothing of it is left.
/// @throws as writePicture()
WholeFile preparePicture(const std::filesystem::path& path, const Scene& scene, const PictureOptions& options = {});

}  // namespace tufted
