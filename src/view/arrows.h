#pragma once

#include "view/field_colors.h"
#include "view/samples.h"
#include "view/text.h"

namespace tufted::view {

/// Draws the vectors of a field as arrows, at one visible point in each cell of a grid on the screen.
void drawArrows(const SeenScene& seen, const FieldColors& colors, Canvas& canvas);

}  // namespace tufted::view
