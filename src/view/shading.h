#pragma once

#include "tufted/view/picture.h"
#include "view/field_colors.h"
#include "view/samples.h"

namespace tufted::view {

/// Colours all samples and averages 2 x 2 of them into each pixel.
Picture shade(const SeenScene& seen, const FieldColors& colors, const PictureOptions& options);

/// Samples on each side of a pixel: edges without steps at four times the work.
constexpr int samples_per_pixel = 2;

/// Red, green, blue and alpha of what lies behind the scene.
std::array<std::uint8_t, 4> backgroundColor(Background background);

}  // namespace tufted::view
