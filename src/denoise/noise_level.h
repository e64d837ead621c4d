#pragma once

#include "base/parallel.h"
#include "denoise/windows.h"

namespace tufted {

/// What the two smaller windows say about noise.
struct NoiseLevel {
  RawBuffer<double> variance;    ///< n, of the noise around a point, in length^2
  Buffer<std::uint8_t> outlier;  ///< n, far off the surface of its neighbours
  Buffer<std::uint8_t> noisy;    ///< n, whether there is noise that can be told from the shape of the surface
};

/// Below this part of the spacing noise does nothing to a Laplacian.
constexpr double least_noise = 0.01;

/// A fit in a base window with more leverage passes through its point and says nothing about it. Inside a surface the
/// leverage is about .2, at a corner .7.
constexpr double most_leverage = 0.9;

/// The least variance of noise that matters around a point.
double leastVariance(const Windows& windows, int p);

/// Makes base windows, wider where the points are as thick as wide, fits the two smaller windows, and decides where
/// there is noise.
NoiseLevel findNoise(const WindowFitter& fitter, const Workers& workers, Windows& windows);

}  // namespace tufted
