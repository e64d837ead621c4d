#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tufted/view/scene.h"

namespace tufted {

/// Red, green and blue of sRGB.
using Rgb = std::array<std::uint8_t, 3>;

/// Kind of values that a colour map is made for.
enum class MapUse : std::uint8_t {
  sequential,   ///< values from the least to the greatest
  diverging,    ///< values around a middle
  categorical,  ///< integers that name things
};

/// A named table of colours. Sequential and diverging maps have 256, perceptually uniform.
struct ColorMap {
  std::string name;
  MapUse use = MapUse::sequential;
  std::vector<Rgb> colors;
};

/// The colour of values that are not finite: a grey darker than the middle of diverging maps.
constexpr Rgb no_value_color = {150, 150, 150};
/// The colour of negative labels, and of surfaces that show no field: a grey that differs from no_value_color.
constexpr Rgb none_color = {205, 205, 205};

/// All maps, in the order of colorMapNames().
const std::vector<ColorMap>& colorMaps();

/// Finds a map by its name.
/// @param function name of the public function, for the message
/// @throws InvalidInput if there is none
const ColorMap& colorMap(const std::string& name, const char* function);

/// The colour at `position` in [0, 1] of a sequential or diverging map; beyond it that of the end, for NaN
/// no_value_color.
Rgb colorAt(const ColorMap& map, double position);

/// The colour of an integer in a categorical map, whose colours repeat; none_color for negative values, no_value_color
/// for infinite ones and NaN.
Rgb labelColor(const ColorMap& map, double label);

/// The colour of a direction of any length: red, green and blue grow with its parts along x, y and z, as in the normal
/// maps of computer graphics. no_value_color for 0 and for values that are not finite.
Rgb directionColor(const Eigen::Vector3d& direction);

/// Converts a colour of sRGB to Oklab (Ottosson 2020, "A perceptual color space for image processing"): lightness from
/// 0 to 1, green to red, blue to yellow. Distances in it are perceived differences.
std::array<double, 3> toOklab(const Rgb& color);
/// The nearest colour of sRGB.
Rgb fromOklab(const std::array<double, 3>& lab);

}  // namespace tufted
