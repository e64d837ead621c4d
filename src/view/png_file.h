#pragma once

#include <filesystem>
#include <string>

#include "tufted/view/picture.h"

namespace tufted::view {

/// The bytes of a PNG file: red, green and blue, and alpha if some pixel is not opaque.
std::string pngOf(const Picture& picture);

}  // namespace tufted::view
