#pragma once

#include <string_view>

namespace tufted::view {

/// The file src/view/page/viewer.html: the page without a scene.
extern const std::string_view viewer;

/// Where in it the scene goes.
constexpr std::string_view scene_mark = "<!--scene-->";

}  // namespace tufted::view
