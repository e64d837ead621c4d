#pragma once

#include <cstdint>

#include "base/parallel.h"
#include "denoise/noise_level.h"
#include "denoise/window_choice.h"
#include "denoise/windows.h"

namespace tufted {

/// Which of Windows::fits has the surface that counts for the points around each window; -1 where none has. Where the
/// surface bends that is the window chosen, if it is wide enough to be shared, or the next wider one, if it is noise
/// that bends it. The base window counts only where more of them are made, since it is small.
Buffer<std::int8_t> sharedWindows(const Windows& windows, const NoiseLevel& noise, const WindowChoice& choice,
                                  const Workers& workers);

}  // namespace tufted
