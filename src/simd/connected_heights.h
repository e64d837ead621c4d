#pragma once

#include "simd/kernels.h"
#include "simd/packet.h"

namespace tufted {
namespace {

/// Extends the range from 0 up and down over gaps of at most `gap` between heights. Each round reaches as far as one
/// gap, and two reach farther than that, so there are few rounds.
void extendRange(const double* heights, int count, double gap, HeightRange& range) {
  double high = 0, low = 0;
  bool goes_up = range.top > gap, goes_down = -range.bottom > gap;
  while (goes_up || goes_down) {
    Packet next_high = broadcast(high), next_low = broadcast(low);
    for (int i = 0; i < count; i += packet_size) {
      const Packet height = load(heights + i);
      next_high = select(logicalAnd(isAtMost(height - broadcast(high), broadcast(gap)), isLess(next_high, height)),
                         height, next_high);
      next_low = select(logicalAnd(isAtMost(broadcast(low) - height, broadcast(gap)), isLess(height, next_low)), height,
                        next_low);
    }
    const double up = reduceMax(next_high), down = reduceMin(next_low);
    goes_up = up > high && range.top - up > gap;
    goes_down = down < low && down - range.bottom > gap;
    high = up;
    low = down;
  }
  range.highest = range.top - high > gap ? high : range.top;
  range.lowest = low - range.bottom > gap ? low : range.bottom;
}

HeightRange connectedHeights(const Offsets& given, const double* normal, double gap, double* heights) {
  const Offsets offsets = given;  // copied, so that stores below cannot alias it
  const Packet x = broadcast(normal[0]), y = broadcast(normal[1]), z = broadcast(normal[2]);
  Packet top = broadcast(0), bottom = broadcast(0);
  for (int i = 0; i < offsets.count; i += packet_size) {
    const Packet height = load(offsets.x + i) * x + (load(offsets.y + i) * y + load(offsets.z + i) * z);
    store(height, heights + i);
    top = max(top, height);
    bottom = min(bottom, height);
  }
  HeightRange range{0, 0, reduceMin(bottom), reduceMax(top)};
  extendRange(heights, offsets.count, gap, range);
  return range;
}

/// Handles eight normals at once, one per lane, so that no round reduces a packet to its extreme.
void connectedHeightsAlong(const Offsets& given, const Normals& given_normals, double gap, double* heights,
                           HeightRange* range) {
  const Offsets offsets = given;  // copied, so that stores below cannot alias it
  const Packet x = load(given_normals.x), y = load(given_normals.y), z = load(given_normals.z);
  Packet top = broadcast(0), bottom = broadcast(0);
  for (int i = 0; i < offsets.count; ++i) {
    const Packet height = broadcast(offsets.x[i]) * x + (broadcast(offsets.y[i]) * y + broadcast(offsets.z[i]) * z);
    store(height, heights + packet_size * i);
    top = max(top, height);
    bottom = min(bottom, height);
  }
  Packet high = broadcast(0), low = broadcast(0);
  for (bool goes_on = true; goes_on;) {
    Packet next_high = high, next_low = low;
    for (int i = 0; i < offsets.count; ++i) {
      const Packet height = load(heights + packet_size * i);
      next_high =
          select(logicalAnd(isAtMost(height - high, broadcast(gap)), isLess(next_high, height)), height, next_high);
      next_low = select(logicalAnd(isAtMost(low - height, broadcast(gap)), isLess(height, next_low)), height, next_low);
    }
    const Mask goes_up = logicalAnd(isLess(high, next_high), isLess(broadcast(gap), top - next_high));
    const Mask goes_down = logicalAnd(isLess(next_low, low), isLess(broadcast(gap), next_low - bottom));
    goes_on = any(logicalOr(goes_up, goes_down));
    high = next_high;
    low = next_low;
  }
  high = select(isLess(broadcast(gap), top - high), high, top);
  low = select(isLess(broadcast(gap), low - bottom), low, bottom);
  alignas(64) double found[4][packet_size];
  store(low, found[0]);
  store(high, found[1]);
  store(bottom, found[2]);
  store(top, found[3]);
  for (int i = 0; i < packet_size; ++i) range[i] = {found[0][i], found[1][i], found[2][i], found[3][i]};
}

int keepConnected(const Offsets& given, const double* heights, const HeightRange& given_range, double* x, double* y,
                  double* z) {
  const Offsets offsets = given;  // copied, so that stores below cannot alias them
  const Packet lowest = broadcast(given_range.lowest), highest = broadcast(given_range.highest);
  int kept = 0;
  for (int i = 0; i < offsets.count; i += packet_size) {
    const Packet height = load(heights + i);
    const Mask are =
        logicalAnd(firstOf(offsets.count - i), logicalAnd(isAtMost(lowest, height), isAtMost(height, highest)));
    compress(are, load(offsets.x + i), x + kept);
    compress(are, load(offsets.y + i), y + kept);
    compress(are, load(offsets.z + i), z + kept);
    kept += countOf(are);
  }
  for (int i = kept; i % packet_size != 0; ++i) x[i] = y[i] = z[i] = 0;
  return kept;
}

}  // namespace
}  // namespace tufted
