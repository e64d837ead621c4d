#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tufted/view/picture.h"
#include "tufted/view/scene.h"

namespace tufted {

/// Computes the colours that drawPicture() gives the points, before shading.
/// @param options only field, column, color_map and range are used
/// @return N x (red, green, blue)
/// @throws InvalidInput for the same reasons as drawPicture()
std::vector<std::array<std::uint8_t, 3>> pointColors(const Scene& scene, const PictureOptions& options = {});

}  // namespace tufted
