#pragma once

#include "view/color_maps.h"
#include "view/samples.h"
#include "view/text.h"

namespace tufted::view {

/// Red, which the sequential maps do not have in this strength.
constexpr Rgb path_color = {214, 30, 40};
/// White around the red, which tells it from reds and from dark colours.
constexpr Rgb path_rim_color = {255, 255, 255};

/// Draws the path of a scene, dashed where the surface hides it; the beginning is a ring, the end a full circle.
/// @param text_size of the picture's letters in pixels, by which lines are wide
void drawPath(const SeenScene& seen, double text_size, Canvas& canvas);

}  // namespace tufted::view
