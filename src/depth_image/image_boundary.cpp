#include "depth_image/image_boundary.h"

#include <algorithm>
#include <cmath>

#include "stars/gaps.h"

namespace tufted {
namespace {

constexpr int least_reach = 3;  // least reach of the search for pixels in gaps: that of a window
/// Greatest reach: that of the largest star of an exact image.
constexpr int most_reach = 12;

/// Classifies what lies in the gaps of a star.
class ImageBoundaryFinder {
 public:
  ImageBoundaryFinder(const Stars& stars, const DepthImage& image) : stars_(stars), image_(image) {}

  Boundary find(int p, Buffer<Gap>& gaps) const {
    if (stars_.ends[p] == 0) return Boundary::none;
    if (!hasTriangles(stars_, p)) return Boundary::lost;
    const bool is_mirrored = isMirrored(p);
    const auto direction = [&](int q) { return directionOf(stepTo(p, q), is_mirrored); };
    findGaps(stars_, p, direction, gaps);
    const int longest = static_cast<int>(std::ceil(farthest_beyond * std::sqrt(longestStep(p))));
    const int reach = std::clamp(longest, least_reach, most_reach);
    bool is_rim = false;
    for (const Gap& gap : gaps) {
      switch (lookInto(gap, p, reach, is_mirrored)) {
        case Boundary::jump:
          return Boundary::jump;
        case Boundary::rim:
          is_rim = true;
          break;
        default:
          break;
      }
    }
    return is_rim ? Boundary::rim : Boundary::lost;
  }

 private:
  PixelStep stepTo(int p, int q) const { return image_.grid.stepBetween(p, q); }

  static double directionOf(const PixelStep& step, bool is_mirrored) {
    return std::atan2(is_mirrored ? -step.row : step.row, step.column);
  }

  /// Whether triangles that run counterclockwise around the normal run clockwise in the image.
  bool isMirrored(int p) const {
    double twice_area = 0;
    forEachPairOfSteps(p, [&](const PixelStep& a, const PixelStep& b) {
      twice_area += static_cast<double>(a.column) * b.row - static_cast<double>(a.row) * b.column;
    });
    return twice_area < 0;
  }

  double longestStep(int p) const {
    double longest = 0;
    const auto square = [](const PixelStep& s) {
      return static_cast<double>(s.row) * s.row + static_cast<double>(s.column) * s.column;
    };
    forEachPairOfSteps(p, [&](const PixelStep& a, const PixelStep& b) {
      longest = std::max({longest, square(a), square(b)});
    });
    return longest;
  }

  /// Calls visit(step to a, step to b) for every triangle (p, a, b).
  template <class Visit>
  void forEachPairOfSteps(int p, const Visit& visit) const {
    forEachTriangle(stars_, p, [&](int a, int b) { visit(stepTo(p, a), stepTo(p, b)); });
  }

  bool isOneSurface(int p, int q, const PixelStep& step) const {
    if (step.ring() > WindowPixels::reach) return image_.isOneSurface(p, q);
    return (image_.windows.around[p] >> window_pixels.numberOf(step) & 1) != 0;
  }

  Boundary lookInto(const Gap& gap, int p, int reach, bool is_mirrored) const {
    const PixelGrid& grid = image_.grid;
    const int row = grid.rowOf(p), column = grid.columnOf(p);
    Boundary found = Boundary::rim;
    const int first = grid.goes_round ? column - reach : std::max(0, column - reach);
    const int last = grid.goes_round ? column + reach : std::min(grid.columns - 1, column + reach);
    for (int r = std::max(0, row - reach); r <= std::min(grid.rows - 1, row + reach); ++r) {
      for (int c = first; c <= last; ++c) {
        const int q = grid.rankAt(r, c);
        const PixelStep step{r - row, c - column};
        if (q < 0 || q == p || step.row * step.row + step.column * step.column > reach * reach) continue;
        if (!gap.holdsInTheMiddle(directionOf(step, is_mirrored)) || !hasTriangles(stars_, q)) continue;
        if (!isOneSurface(p, q, step)) return Boundary::jump;
        found = Boundary::lost;
      }
    }
    return found;
  }

  const Stars& stars_;
  const DepthImage& image_;
};

}  // namespace

Buffer<Boundary> findImageBoundary(const Stars& stars, const DepthImage& image, const Workers& workers) {
  Buffer<Boundary> boundary(stars.size(), Boundary::none);
  const ImageBoundaryFinder finder(stars, image);
  Buffer<Buffer<Gap>> gaps(workers.count());
  workers.forBlocks("boundary", stars.size(), usual_block, [&](std::int64_t begin, std::int64_t end, int worker) {
    for (int p = static_cast<int>(begin); p < static_cast<int>(end); ++p) boundary[p] = finder.find(p, gaps[worker]);
  });
  return boundary;
}

}  // namespace tufted
