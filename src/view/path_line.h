#pragma once

#include "view/color_maps.h"
#include "view/samples.h"
#include "view/text.h"

namespace tufted::view {

/// Red, which few colour maps have, with a white rim: seen on light and on dark colours.
constexpr Rgb path_color = {214, 30, 40};
constexpr Rgb path_rim_color = {255, 255, 255};

/// Draws the path of a scene, dashed where the surface hides it; the beginning is a ring, the end a full circle.
/// @param text_size of the picture's letters in pixels, by which lines are wide
void drawPath(const SeenScene& seen, double text_size, Canvas& canvas);

}  // namespace tufted::view
