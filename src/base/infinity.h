#pragma once

#include <limits>

namespace tufted {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace tufted
