#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tufted/view/scene.h"
#include "tufted/view/whole_file.h"

namespace tufted {

/// Colour of a picture where there is no surface.
enum class Background : std::uint8_t { white, dark, transparent };

/// How a picture is drawn.
struct PictureOptions {
  int width = 1200;            ///< pixels, from 16 to 8192
  int height = 900;            ///< pixels, from 16 to 8192
  int field = 0;               ///< the field shown, counted from 0; -1: none
  int column = 0;              ///< the column of that field, counted from 0
  std::string color_map = {};  ///< one of colorMapNames(); empty: the default of the field's kind
  /// The values at both ends of the colour map; empty: the least and the greatest value except outliers, which have the
  /// colour of an end. Outliers are values beyond the 1st or the 99th percentile that are also farther beyond the
  /// quartiles than three times the distance between these. By default the range of diverging values is symmetric about
  /// 0, and lengths begin at 0.
  std::optional<std::array<double, 2>> range = {};
  Background background = Background::white;  ///< colour where there is no surface
  bool light = true;                          ///< whether to shade the surface; false: colours exactly as in the map
  std::optional<bool> isolines = {};          ///< whether to draw lines of equal values; empty: for distances only
  bool legend = true;                         ///< whether to draw the title and a legend of the colours
  Camera camera = {};                         ///< position and direction of the eye
  int threads = 0;  ///< at most this many threads; 0: one per processor. The picture has the same bits for any number.
};

/// The pixels of a picture.
struct Picture {
  int width = 0;                     ///< columns
  int height = 0;                    ///< rows
  std::vector<std::uint8_t> pixels;  ///< red, green, blue and alpha, rows from the top
};

/// Draws a scene without a screen or a graphics card: triangles, and points that are no corner of one as discs as wide
/// as the distance to their neighbours. Discs of sparse points do not hide dense ones. Light and depth (eye-dome
/// lighting, Boucheny 2009) shade the surface; where a cloud has no normals, planes through nearby points give them.
/// Points whose distance, or logarithmic map, is exactly 0 are marked as sources, up to 64 of them. Values that are not
/// finite are grey; negative labels and all points without a field are light grey.
/// @throws InvalidInput for the same reasons as checkScene(), and for a field, column or colour map that does not
/// exist, or a size, camera or range out of range
Picture drawPicture(const Scene& scene, const PictureOptions& options = {});

/// The bytes of a PNG file: red, green and blue, and alpha if some pixel is not opaque.
std::string pngOf(const Picture& picture);

/// Writes drawPicture() to a PNG file, completely or not at all, as writePage() does.
/// @param path name of the file, in a directory that exists
/// @throws InvalidInput for the same reasons as drawPicture()
/// @throws IoError naming `path`
void writePicture(const std::filesystem::path& path, const Scene& scene, const PictureOptions& options = {});

/// Makes the file of writePicture() without its name, which WholeFile::giveName() sets; otherwise nothing of it
/// remains.
/// @throws InvalidInput and IoError for the same reasons as writePicture()
WholeFile preparePicture(const std::filesystem::path& path, const Scene& scene, const PictureOptions& options = {});

/// Computes the colours that drawPicture() gives the points, before shading.
/// @param options only field, column, color_map and range are used
/// @return N x (red, green, blue)
/// @throws InvalidInput for the same reasons as drawPicture()
std::vector<std::array<std::uint8_t, 3>> pointColors(const Scene& scene, const PictureOptions& options = {});

}  // namespace tufted
