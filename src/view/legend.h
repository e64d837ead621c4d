#pragma once

#include "tufted/view/picture.h"
#include "view/field_colors.h"
#include "view/projection.h"
#include "view/text.h"

namespace tufted::view {

/// Places of title, scene and legend in a picture, in pixels.
struct Layout {
  double text_size = 0;
  int top = 0;    ///< first row of the scene
  int right = 0;  ///< column at which the scene ends
  bool has_legend = false;
};

Layout layoutOf(const Scene& scene, const FieldColors& colors, const PictureOptions& options);

/// Draws the title, and the legend: a bar with ticks, or a box for each label.
void drawLegend(const Scene& scene, const FieldColors& colors, const PictureOptions& options, const Layout& layout,
                Canvas& canvas);

}  // namespace tufted::view
