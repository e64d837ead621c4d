#pragma once

#include "simd/kernels.h"
#include "simd/lanes.h"

namespace tufted {
namespace {

/// How far one comes from 0, up and down, over gaps of at most `gap` between the heights. Each round goes as far as one
/// gap reaches, and two go farther than that: there are few.
void reachFarthest(const double* heights, int count, double gap, Reached& reached) {
  double high = 0, low = 0;
  bool goes_up = reached.top > gap, goes_down = -reached.bottom > gap;
  while (goes_up || goes_down) {
    Lane next_high = all(high), next_low = all(low);
    for (int i = 0; i < count; i += lane_size) {
      const Lane height = load(heights + i);
      next_high = select(both(isAtMost(height - all(high), all(gap)), isLess(next_high, height)), height, next_high);
      next_low = select(both(isAtMost(all(low) - height, all(gap)), isLess(height, next_low)), height, next_low);
    }
    const double up = most(next_high), down = least(next_low);
    goes_up = up > high && reached.top - up > gap;
    goes_down = down < low && down - reached.bottom > gap;
    high = up;
    low = down;
  }
  reached.highest = reached.top - high > gap ? high : reached.top;
  reached.lowest = low - reached.bottom > gap ? low : reached.bottom;
}

Reached reachHeights(const Offsets& given, const double* normal, double gap, double* heights) {
  const Offsets offsets = given;  // a copy, which what is written below cannot change
  const Lane x = all(normal[0]), y = all(normal[1]), z = all(normal[2]);
  Lane top = all(0), bottom = all(0);
  for (int i = 0; i < offsets.count; i += lane_size) {
    const Lane height = load(offsets.x + i) * x + (load(offsets.y + i) * y + load(offsets.z + i) * z);
    store(height, heights + i);
    top = most(top, height);
    bottom = least(bottom, height);
  }
  Reached reached{0, 0, least(bottom), most(top)};
  reachFarthest(heights, offsets.count, gap, reached);
  return reached;
}

/// Eight normals at once, so that a round takes no search for the farthest among the numbers of a lane.
void reachAlong(const Offsets& given, const Normals& given_normals, double gap, double* heights, Reached* reached) {
  const Offsets offsets = given;  // a copy, which what is written below cannot change
  const Lane x = load(given_normals.x), y = load(given_normals.y), z = load(given_normals.z);
  Lane top = all(0), bottom = all(0);
  for (int i = 0; i < offsets.count; ++i) {
    const Lane height = all(offsets.x[i]) * x + (all(offsets.y[i]) * y + all(offsets.z[i]) * z);
    store(height, heights + lane_size * i);
    top = most(top, height);
    bottom = least(bottom, height);
  }
  Lane high = all(0), low = all(0);
  for (bool goes_on = true; goes_on;) {
    Lane next_high = high, next_low = low;
    for (int i = 0; i < offsets.count; ++i) {
      const Lane height = load(heights + lane_size * i);
      next_high = select(both(isAtMost(height - high, all(gap)), isLess(next_high, height)), height, next_high);
      next_low = select(both(isAtMost(low - height, all(gap)), isLess(height, next_low)), height, next_low);
    }
    const Mask goes_up = both(isLess(high, next_high), isLess(all(gap), top - next_high));
    const Mask goes_down = both(isLess(next_low, low), isLess(all(gap), next_low - bottom));
    goes_on = any(either(goes_up, goes_down));
    high = next_high;
    low = next_low;
  }
  high = select(isLess(all(gap), top - high), high, top);
  low = select(isLess(all(gap), low - bottom), low, bottom);
  alignas(64) double found[4][lane_size];
  store(low, found[0]);
  store(high, found[1]);
  store(bottom, found[2]);
  store(top, found[3]);
  for (int i = 0; i < lane_size; ++i) reached[i] = {found[0][i], found[1][i], found[2][i], found[3][i]};
}

int keepReached(const Offsets& given, const double* heights, const Reached& given_reached, double* x, double* y,
                double* z) {
  const Offsets offsets = given;  // copies, which what is written below cannot change
  const Lane lowest = all(given_reached.lowest), highest = all(given_reached.highest);
  int kept = 0;
  for (int i = 0; i < offsets.count; i += lane_size) {
    const Lane height = load(heights + i);
    const Mask are = both(firstOf(offsets.count - i), both(isAtMost(lowest, height), isAtMost(height, highest)));
    squeeze(are, load(offsets.x + i), x + kept);
    squeeze(are, load(offsets.y + i), y + kept);
    squeeze(are, load(offsets.z + i), z + kept);
    kept += countOf(are);
  }
  for (int i = kept; i % lane_size != 0; ++i) x[i] = y[i] = z[i] = 0;
  return kept;
}

}  // namespace
}  // namespace tufted
