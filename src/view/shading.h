#pragma once

#include "tufted/view/picture.h"
#include "view/field_colors.h"
#include "view/samples.h"

namespace tufted::view {

/// Colours all samples and averages 2 x 2 of them into each pixel.
Picture shade(const SeenScene& seen, const FieldColors& colors, const PictureOptions& options);

/// Samples along each side of a pixel: 2 smooth edges, at four times the work of 1.
constexpr int samples_per_pixel = 2;

/// Red, green, blue and alpha of the background.
std::array<std::uint8_t, 4> backgroundColor(Background background);

}  // namespace tufted::view
