#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "tufted/errors.h"
#include "tufted/options.h"

namespace tufted::io {

/// To be called for each of `size` points in turn: reports the progress of a stage at every 2^16-th, often enough for
/// Ctrl-C and seldom enough to cost nothing.
/// @throws Cancelled when `progress` returns false
inline void reportStep(const Progress& progress, std::string_view stage, std::size_t point, std::size_t size) {
  if (point % (1 << 16) == 0 && progress && !progress(stage, static_cast<double>(point) / static_cast<double>(size)))
    throw Cancelled("cancelled during " + std::string(stage));
}

}  // namespace tufted::io
