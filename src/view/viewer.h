#pragma once

#include <string_view>

namespace tufted::view {

/// The content of src/view/page/viewer.html, the page without a scene.
extern const std::string_view viewer;

/// The place in `viewer` where the scene is inserted.
constexpr std::string_view scene_mark = "<!--scene-->";

}  // namespace tufted::view
