#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "tufted/laplacian.h"

// Depth images whose surfaces are known.

namespace tufted::bench {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();  ///< where no ray meets a body
/// A seed determines the noise, the offset of disparity steps, and a rotation of the camera by less than a pixel.
constexpr std::uint64_t first_view_seed = 101, last_view_seed = 103;
constexpr double view_seeds = 1 + last_view_seed - first_view_seed;

/// The exact image of a scene by a pinhole camera of 640 x 480 pixels.
struct View {
  std::string name;
  double focal = 525;
  int width = 640, height = 480;
  Points points;
  Points normals;
  std::vector<int> bodies;
  int body_count = 0;
  /// Area seen of each body in each patch, between the middles of the outer pixels of the image, see areaOf().
  std::vector<double> areas;

  static constexpr int patch = 16;  ///< width and height of a patch in pixels
  int patchesInRow() const { return (width + patch - 1) / patch; }
  int patches() const { return patchesInRow() * ((height + patch - 1) / patch); }
  /// Index into `areas` of a body in the patch of a pixel.
  std::size_t areaOf(int pixel, int body) const {
    const int at = pixel / width / patch * patchesInRow() + pixel % width / patch;
    return static_cast<std::size_t>(at) * body_count + body;
  }
};

/// Whether a pixel is at least this many pixels from the edges of its body and of the image.
bool isInside(const View& view, int pixel, int pixels);

/// Reorders the values. `nothing` if there are none.
double quantile(std::vector<double>& values, double share);

/// A room, things on a table, a ball, a corner, walls and a floor. In the room the seed does not rotate the camera.
std::vector<View> views(std::uint64_t seed);

View ballView(std::uint64_t seed);
/// A mug, a ball, a pole, a table and a wall, numbered so.
View nearView(std::uint64_t seed);
constexpr double mug_radius = 0.04;                    // m
constexpr double ball_depth = 1.2, ball_radius = 0.4;  // m

/// Noise of a camera that measures disparities, or times of flight.
struct CameraNoise {
  std::string name;
  double step, sigma;   ///< step and standard deviation of the disparity, pixels
  double of_range = 0;  ///< standard deviation of the range, m
};

inline const std::vector<CameraNoise> camera_noises = {{"exact", 0, 0},
                                                       {"steps of 1/8 px", 0.125, 0},
                                                       {"steps of 1/8, noise .1 px", 0.125, 0.1},
                                                       {"noise .25 px", 0, 0.25},
                                                       {"timed light, noise 5 mm", 0, 0, 0.005}};

/// The points of a view with the noise of a camera. Without noise the seed determines the offset of disparity steps.
Points seenBy(const View& view, const CameraNoise& noise, std::uint64_t seed);

}  // namespace tufted::bench
