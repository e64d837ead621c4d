#pragma once

#include <vector>

#include "view/color_maps.h"
#include "view/field_colors.h"
#include "view/samples.h"
#include "view/text.h"

namespace tufted::view {

/// The colour of the path: a red that is stronger than any in the sequential maps.
constexpr Rgb path_color = {214, 30, 40};
/// The colour of the rim along the path: white, which separates it from reds and from dark colours.
constexpr Rgb path_rim_color = {255, 255, 255};

/// Draws the path of a scene, dashed where the surface hides it, with a ring at its beginning and a disc at its end.
/// @param text_size size of the picture's letters in pixels, to which widths are proportional
void drawPath(const SeenScene& seen, double text_size, Canvas& canvas);

/// Draws a ring as at the beginning of a path, which marks a source.
void drawRing(const Eigen::Vector2d& place, double text_size, Canvas& canvas);

/// Draws rings around points, smaller ones where the surface hides them.
void drawSources(const SeenScene& seen, const std::vector<int>& sources, double text_size, Canvas& canvas);

/// Draws the vectors of a field as arrows, at one visible point in each cell of a grid on the screen.
void drawArrows(const SeenScene& seen, const FieldColors& colors, Canvas& canvas);

}  // namespace tufted::view
