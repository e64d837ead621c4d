#include "view/color_maps.h"

#include <algorithm>
#include <cmath>

#include "tufted/errors.h"

namespace tufted {

namespace {

/// Number of colours of a map: more would be equal in 8 bits.
constexpr int table_size = 256;

// Control points as 0xRRGGBB, evenly spaced. Between them colours are interpolated in Oklab.

/// Every seventeenth colour of viridis and magma, by Nathaniel Smith and Stefan van der Walt for Matplotlib (2015),
/// dedicated to the public domain (CC0).
constexpr std::array<std::uint32_t, 16> viridis = {0x440154, 0x481a6c, 0x472f7d, 0x414487, 0x39568c, 0x31688e,
                                                   0x2a788e, 0x23888e, 0x1f988b, 0x22a884, 0x35b779, 0x54c568,
                                                   0x7ad151, 0xa5db36, 0xd2e21b, 0xfde725};
constexpr std::array<std::uint32_t, 16> magma = {0x000004, 0x0b0924, 0x20114b, 0x3b0f70, 0x57157e, 0x721f81,
                                                 0x8c2981, 0xa8327d, 0xc43c75, 0xde4968, 0xf1605d, 0xfa7f5e,
                                                 0xfe9f6d, 0xfebf84, 0xfddea0, 0xfcfdbf};
/// Every seventeenth colour of cividis (Nunez, Anderton and Renslow 2018, "Optimizing colormaps with consideration for
/// color vision deficiency", CC0), made to look the same with red-green colour blindness.
constexpr std::array<std::uint32_t, 16> cividis = {0x00224e, 0x002e6c, 0x1e3a6f, 0x35456c, 0x47516c, 0x575d6d,
                                                   0x666970, 0x757575, 0x848279, 0x948e77, 0xa59c74, 0xb7a96e,
                                                   0xc8b866, 0xdbc75a, 0xeed649, 0xfee838};
/// Computed by the formula of Moreland 2009, "Diverging color maps for scientific visualization", Section 4, between
/// its blue (59, 76, 192) and red (180, 4, 38).
constexpr std::array<std::uint32_t, 17> coolwarm = {0x3b4cc0, 0x4e68d7, 0x6282ea, 0x779af7, 0x8db0fe, 0xa3c2ff,
                                                    0xb8d0f9, 0xccd9ee, 0xdddddd, 0xecd3c6, 0xf5c4ad, 0xf7b194,
                                                    0xf49a7b, 0xec7f63, 0xde614c, 0xcb3e38, 0xb40426};
/// Our own: hues of 315 and 150 degrees in Oklab, with lightness that falls evenly from the middle to both ends.
constexpr std::array<std::uint32_t, 17> purple_green = {0x56246a, 0x6e3585, 0x86499f, 0x9c60b6, 0xb17bc8, 0xc397d7,
                                                        0xd4b5e3, 0xe4d4ec, 0xf3f3f3, 0xcee0d1, 0xaacdb0, 0x88b991,
                                                        0x67a474, 0x4a8f5b, 0x307944, 0x1c6232, 0x0a4c22};
/// Our own: six chosen colours, then each time the colour farthest in Oklab from all before it, from white, from black
/// and from no_value_color.
constexpr std::array<std::uint32_t, 20> labels = {0x306fc8, 0xf08a24, 0x2e9e4f, 0xcc333f, 0x8e5bc0, 0x8a5a44, 0xffa6f9,
                                                  0x00e6e6, 0xc6df59, 0x006059, 0x861360, 0x80b3ff, 0xff8093, 0x998600,
                                                  0x4d4679, 0xffbfa6, 0x00a6b9, 0xbf5393, 0x006600, 0x4dd98c};

Rgb unpack(std::uint32_t color) {
  const auto byte = [color](int shift) { return static_cast<std::uint8_t>((color >> shift) & 0xff); };
  return {byte(16), byte(8), byte(0)};
}

/// Converts a value of sRGB in [0, 1] to linear light (IEC 61966-2-1).
double toLight(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

double fromLight(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

/// The Catmull-Rom spline (1974) through four evenly spaced values, at `share` of the way from b to c.
double spline(double a, double b, double c, double d, double share) {
  return b + 0.5 * share * (c - a + share * (2 * a - 5 * b + 4 * c - d + share * (3 * (b - c) + d - a)));
}

template <std::size_t Count>
ColorMap interpolated(const char* name, MapUse use, const std::array<std::uint32_t, Count>& control_points) {
  std::array<std::array<double, 3>, Count + 2> lab;  // extrapolated linearly by one at each end
  for (std::size_t i = 0; i < Count; ++i) lab[i + 1] = toOklab(unpack(control_points[i]));
  for (int k = 0; k < 3; ++k) {
    lab[0][k] = 2 * lab[1][k] - lab[2][k];
    lab[Count + 1][k] = 2 * lab[Count][k] - lab[Count - 1][k];
  }
  ColorMap map = {name, use, {}};
  for (int i = 0; i < table_size; ++i) {
    const double at = static_cast<double>(i) * (Count - 1) / (table_size - 1);
    const std::size_t j = std::min(static_cast<std::size_t>(at), Count - 2);
    std::array<double, 3> color;
    for (int k = 0; k < 3; ++k)
      color[k] = spline(lab[j][k], lab[j + 1][k], lab[j + 2][k], lab[j + 3][k], at - static_cast<double>(j));
    map.colors.push_back(fromOklab(color));
  }
  return map;
}

std::vector<ColorMap> makeColorMaps() {
  ColorMap categorical = {"labels", MapUse::categorical, {}};
  for (const std::uint32_t color : labels) categorical.colors.push_back(unpack(color));
  return {interpolated("viridis", MapUse::sequential, viridis),
          interpolated("cividis", MapUse::sequential, cividis),
          interpolated("magma", MapUse::sequential, magma),
          interpolated("coolwarm", MapUse::diverging, coolwarm),
          interpolated("purple_green", MapUse::diverging, purple_green),
          categorical};
}

}  // namespace

std::vector<std::string> colorMapNames() {
  std::vector<std::string> names;
  for (const ColorMap& map : colorMaps()) names.push_back(map.name);
  return names;
}

std::string defaultColorMap(FieldKind kind) {
  switch (kind) {
    case FieldKind::diverging:
      return "coolwarm";
    case FieldKind::label:
      return "labels";
    case FieldKind::color:
    case FieldKind::direction:
      return "";
    default:
      return "viridis";
  }
}

const std::vector<ColorMap>& colorMaps() {
  static const std::vector<ColorMap> maps = makeColorMaps();
  return maps;
}

const ColorMap& colorMap(const std::string& name, const char* function) {
  std::string names;
  for (const ColorMap& map : colorMaps()) {
    if (map.name == name) return map;
    names += (names.empty() ? "" : ", ") + map.name;
  }
  throw InvalidInput(std::string(function) + ": color map " + name + ", must be one of " + names);
}

Rgb colorAt(const ColorMap& map, double position) {
  if (std::isnan(position)) return no_value_color;
  const auto last = static_cast<double>(map.colors.size() - 1);
  return map.colors[static_cast<std::size_t>(std::lround(std::clamp(position, 0.0, 1.0) * last))];
}

Rgb labelColor(const ColorMap& map, double label) {
  if (!std::isfinite(label)) return no_value_color;
  if (label < 0) return none_color;
  return map.colors[static_cast<std::size_t>(std::fmod(label, static_cast<double>(map.colors.size())))];
}

Rgb directionColor(const Eigen::Vector3d& direction) {
  const double length = direction.stableNorm();
  if (!std::isfinite(length) || !(length > 0)) return no_value_color;
  Rgb color;
  for (int k = 0; k < 3; ++k)
    color[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(std::lround(127.5 * (1 + direction[k] / length)));
  return color;
}

std::array<double, 3> toOklab(const Rgb& color) {
  const double r = toLight(color[0] / 255.0);
  const double g = toLight(color[1] / 255.0);
  const double b = toLight(color[2] / 255.0);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

Rgb fromOklab(const std::array<double, 3>& lab) {
  const auto cube = [](double x) { return x * x * x; };
  const double l = cube(lab[0] + 0.3963377774 * lab[1] + 0.2158037573 * lab[2]);
  const double m = cube(lab[0] - 0.1055613458 * lab[1] - 0.0638541728 * lab[2]);
  const double s = cube(lab[0] - 0.0894841775 * lab[1] - 1.2914855480 * lab[2]);
  const auto byte = [](double light) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(fromLight(std::max(light, 0.0)), 0.0, 1.0)));
  };
  return {byte(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          byte(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          byte(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

}  // namespace tufted
