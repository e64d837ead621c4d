#pragma once

#include <string>
#include <vector>

#include "tufted/view/scene.h"

namespace tufted {

/// The names of the colour maps that pages and pictures accept: viridis, cividis and magma are sequential, coolwarm and
/// purple_green diverging, and labels has a colour for each of many integers.
std::vector<std::string> colorMapNames();

/// The name of the default colour map of a kind; empty for FieldKind::color, whose values are colours themselves.
std::string defaultColorMap(FieldKind kind);

}  // namespace tufted
