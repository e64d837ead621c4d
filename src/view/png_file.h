#pragma once

#include <filesystem>
#include <string>

#include "tufted/view/picture.h"

namespace tufted::view {

/// A picture as a file of PNG: red, green and blue, and alpha where a pixel is not opaque.
std::string pngOf(const Picture& picture);

}  // namespace tufted::view
