#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tufted/view/picture.h"
#include "tufted/view/scene.h"

namespace tufted {

/// The colours that drawPicture() gives the points, without light: red, green and blue of each.
/// @param options field, column, color_map and range count
/// @throws InvalidInput as drawPicture()
std::vector<std::array<std::uint8_t, 3>> pointColors(const Scene& scene, const PictureOptions& options = {});

}  // namespace tufted
