#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tufted/view/scene.h"

namespace tufted {

/// From where a picture is seen, in perspective: its height is seen under 0.62 radians. What is left out is chosen:
/// flat scenes are seen from above at an angle, or in front where they stand upright, all others at their broad side;
/// the distance is such that the scene fits, without the few points far from all others.
struct Camera {
  /// The direction in which the eye lies, of any length; 0: chosen.
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();
  /// The direction that is up in the picture, of any length; 0: chosen.
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  /// In degrees around `up`, in place of `eye`; 0 is the axis that follows up: x where z is up, z where y is up.
  std::optional<double> azimuth = {};
  /// In degrees above the plane to which `up` is normal, from -90 to 90, in place of `eye`.
  std::optional<double> elevation = {};
  double zoom = 1;  ///< 2: twice as near, positive
  /// The position of the eye, in place of `eye` and `zoom`.
  std::optional<Eigen::Vector3d> viewpoint = {};
  /// The position in the middle of the picture.
  std::optional<Eigen::Vector3d> look_at = {};
};

/// What is seen where there is no surface.
enum class Background : std::uint8_t { white, dark, transparent };

/// How a picture is drawn.
struct PictureOptions {
  int width = 1200;            ///< pixels, from 16 to 8192
  int height = 900;            ///< pixels, from 16 to 8192
  int field = 0;               ///< the field shown, counted from 0; -1: none
  int column = 0;              ///< and its column, counted from 0
  std::string color_map = {};  ///< one of colorMapNames(); empty: that of the field's kind
  /// The values at both ends of the colour map; by default the least and the greatest, but no farther than half the
  /// distance of the 1st and the 99th percentile beyond these. Values around 0 have the same range on both sides.
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

/// Writes drawPicture() as a PNG file, which appears whole or not at all. A file of that name is replaced.
/// @throws InvalidInput as drawPicture(); IoError naming `path`
void writePicture(const std::filesystem::path& path, const Scene& scene, const PictureOptions& options = {});

}  // namespace tufted
