#pragma once

#include "tufted/view/picture.h"
#include "view/field_colors.h"
#include "view/projection.h"
#include "view/text.h"

namespace tufted::view {

/// Where title, scene and legend are, in pixels.
struct Layout {
  double text_size = 0;
  int top = 0;    ///< the scene begins below
  int right = 0;  ///< and ends before
  bool has_legend = false;
};

Layout layoutOf(const Scene& scene, const FieldColors& colors, const PictureOptions& options);

/// Draws the title, and the legend: a bar with ticks, or a box for each label.
void drawLegend(const Scene& scene, const FieldColors& colors, const PictureOptions& options, const Layout& layout,
                Canvas& canvas);

}  // namespace tufted::view
