#pragma once

#include <span>

#include "base/parallel.h"
#include "denoise/noise_level.h"
#include "denoise/windows.h"

namespace tufted {

/// The window whose fit each point moves by.
struct WindowChoice {
  Buffer<std::int8_t> window;   ///< n, of Windows::fits; -1: none
  Buffer<std::uint8_t> biased;  ///< n, whether a wider one would have been taken, had the surface not bent
};

/// As wide as needed, and only as wide as the surface is a quadratic: up while the estimate stays within its variance
/// (Lepski's rule), pooled over the points around.
/// @param which whose window is chosen; others have none
WindowChoice chooseWindows(const Windows& windows, const NoiseLevel& noise, std::span<const int> which,
                           const Workers& workers);

}  // namespace tufted
