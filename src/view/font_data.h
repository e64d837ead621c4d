#pragma once

#include <cstddef>

namespace tufted::view {

/// The bytes of fonts/labels.ttf, which src/view/CMakeLists.txt turns into a source file.
extern const unsigned char font_data[];
extern const std::size_t font_size;

}  // namespace tufted::view
