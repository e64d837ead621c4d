#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace tufted {

/// A step from one pixel to another.
struct PixelStep {
  int row = 0, column = 0;

  /// The number of the ring around the first pixel that the second is on.
  constexpr int ring() const {
    const int rows = row < 0 ? -row : row, columns = column < 0 ? -column : column;
    return rows > columns ? rows : columns;
  }
};

/// The 48 pixels around one in a 7 x 7 window as steps, ring by ring and in each ring by distance in the image. A set
/// of them is a word in which bit i stands for step i.
struct WindowPixels {
  static constexpr int reach = 3;   ///< number of rings: 7 x 7 pixels fit the bits of a word
  static constexpr int count = 48;  ///< pixels of 7 x 7 without the middle one

  static constexpr int side() { return 2 * reach + 1; }

  std::array<PixelStep, count> step{};

  static constexpr int inRings(int rings) { return (2 * rings + 1) * (2 * rings + 1) - 1; }
  /// The set of all pixels of the first `number` rings.
  static constexpr std::uint64_t rings(int number) { return (std::uint64_t{1} << inRings(number)) - 1; }

  constexpr WindowPixels() {
    int size = 0;
    for (int ring = 1; ring <= reach; ++ring) {
      for (int square = 1; square <= 2 * reach * reach; ++square) {
        for (int row = -ring; row <= ring; ++row) {
          for (int column = -ring; column <= ring; ++column) {
            const PixelStep next{row, column};
            if (next.ring() == ring && row * row + column * column == square) step[size++] = next;
          }
        }
      }
    }
  }

  /// The index of a step, which must be in the window.
  constexpr int numberOf(const PixelStep& wanted) const {
    int i = 0;
    while (step[i].row != wanted.row || step[i].column != wanted.column) ++i;
    return i;
  }
};

inline constexpr WindowPixels window_pixels;

/// Calls visit(i) for every bit of the set, ascending.
template <class Visit>
void forEachPixel(std::uint64_t set, const Visit& visit) {
  for (; set != 0; set &= set - 1) visit(std::countr_zero(set));
}

}  // namespace tufted
