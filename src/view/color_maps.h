#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "tufted/view/scene.h"

namespace tufted {

/// Red, green and blue of sRGB.
using Rgb = std::array<std::uint8_t, 3>;

/// What values a colour map is for.
enum class MapUse : std::uint8_t {
  sequential,   ///< from the least to the greatest
  diverging,    ///< around a middle
  categorical,  ///< integers that name things
};

/// A named table of colours. Sequential and diverging maps have 256, which differ evenly to the eye.
struct ColorMap {
  std::string name;
  MapUse use = MapUse::sequential;
  std::vector<Rgb> colors;
};

/// The colour of values that are not finite, of negative labels and of points without a value: grey, darker than the
/// middle of diverging maps.
constexpr Rgb no_value_color = {150, 150, 150};

/// All maps, in the order of colorMapNames().
const std::vector<ColorMap>& colorMaps();

/// The map of a name.
/// @param function what the caller called, for the message
/// @throws InvalidInput where there is none
const ColorMap& colorMap(const std::string& name, const char* function);

/// The colour at `position` of a sequential or diverging map, from 0 to 1; beyond that of the end. NaN is
/// no_value_color.
Rgb colorAt(const ColorMap& map, double position);

/// The colour of an integer by a categorical map, which begins again where it ends. Negative and infinite values and
/// NaN are no_value_color.
Rgb labelColor(const ColorMap& map, double label);

/// A colour of sRGB in Oklab (Ottosson 2020, "A perceptual color space for image processing"): lightness from 0 to 1,
/// green to red, blue to yellow. Distances in it are differences to the eye.
std::array<double, 3> toOklab(const Rgb& color);
/// The nearest colour of sRGB.
Rgb fromOklab(const std::array<double, 3>& lab);

}  // namespace tufted
