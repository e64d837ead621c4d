#pragma once

#include "simd/kernels.h"
#include "simd/packet.h"

namespace tufted {
namespace {

TUFTED_INLINE Part differenceOf(const double* values, int shift, int at) {
  return loadPart(values + shift + at) - loadPart(values + at);
}

/// See JumpTest in depth_image/surface_windows.h.
void joinPixels(const PixelPoints& pixels, const PixelSteps& steps, double of_inverse, double of_depth,
                std::uint64_t* joined) {
  const PixelPoints given = pixels;  // copied, so that stores below cannot alias it
  for (int s = 0; s < steps.count; ++s) joined[s] = 0;
  for (int at = 0; at < pixels_in_word; at += part_size) {
    const Part range = loadPart(given.range + at), allowed = broadcastPart(of_inverse) * range;
    for (int s = 0; s < steps.count; ++s) {
      const int shift = steps.shift[s];
      const Part x = differenceOf(given.x, shift, at), y = differenceOf(given.y, shift, at),
                 z = differenceOf(given.z, shift, at);
      const Part there = loadPart(given.range + shift + at), along = absolute(range - there);
      const Part more = along - allowed * there - broadcastPart(of_depth);
      const Part across = x * x + y * y + z * z - along * along;
      const unsigned are_near = bitsOf(isAtMost(more, broadcastPart(0)));
      const unsigned are_flat = bitsOf(isAtMost(more * more, broadcastPart(steps.most[s]) * across));
      joined[s] |= std::uint64_t{are_near | are_flat} << at;
    }
  }
}

void spacingsOf(const PixelPoints& pixels, const double* inverse_depth, const int* shift, const unsigned char* beside,
                double* squared) {
  for (int at = 0; at < packet_size; at += part_size) {
    const Part zero = broadcastPart(0), one = broadcastPart(1);
    Part across = zero, count = zero;
    for (int i = 0; i < pixels_beside; ++i) {
      const PartMask is_beside = maskOf(beside[i] >> at);
      const Part x = differenceOf(pixels.x, shift[i], at), y = differenceOf(pixels.y, shift[i], at),
                 z = differenceOf(pixels.z, shift[i], at), along = differenceOf(pixels.range, shift[i], at);
      across = across + select(is_beside, x * x + y * y + z * z - along * along, zero);
      count = count + select(is_beside, one, zero);
    }
    // A step d along the ray changes the inverse depth by the share d / range.
    const Part change = loadPart(inverse_depth + at) / loadPart(pixels.range + at);
    store(select(isLess(zero, count), across / count * change * change, zero), squared + at);
  }
}

unsigned squaresWithin(const double* values, const std::ptrdiff_t* shift, const double* slope, const double* tolerance,
                       unsigned wanted, unsigned char* within) {
  // Rings of 8, 16 and 24 pixels.
  const auto compare = [&](int part, const auto& take) {
    const Part middle = loadPart(values + part), rise = loadPart(slope + part), rest = loadPart(tolerance + part);
    for (int ring = 1, i = 0; ring <= 3; ++ring) {
      const Part most = broadcastPart(ring) * rise + rest;
      for (const int end = i + 8 * ring; i < end; ++i)
        take(i, isAtMost(absolute(loadPart(values + shift[i] + part) - middle), most));
    }
  };
  unsigned lanes = 0;
  for (int part = 0; part < packet_size; part += part_size) {
    PartMask are_within = maskOf(~0U);
    compare(part, [&](int, PartMask mask) { are_within = logicalAnd(are_within, mask); });
    lanes |= bitsOf(are_within) << part;
  }
  if ((wanted & ~lanes) == 0) return lanes;
  for (int i = 0; i < pixels_of_window; ++i) within[i] = 0;
  for (int part = 0; part < packet_size; part += part_size)
    compare(part,
            [&](int i, PartMask mask) { within[i] = static_cast<unsigned char>(within[i] | bitsOf(mask) << part); });
  return lanes;
}

}  // namespace
}  // namespace tufted
