#include "depth_image/image_stars.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "base/power_of_two.h"
#include "depth_image/depth_noise.h"
#include "depth_image/pixel_frame.h"
#include "stars/blocks_in_order.h"
#include "stars/star_wrapping.h"

namespace tufted {
namespace {

/// Rings of the first window for the plane and the star: its 24 pixels decide most stars.
constexpr int first_rings = 2;
/// A window with fewer points than this, half of 5 x 5, is widened.
constexpr int enough = 12;
/// Rings of the widest window: 2,401 pixels hold `enough` points if one in 200 has a point.
constexpr int widest_rings = 24;
/// Rings up to which a window grows in an exact image if a circle reaches beyond it. Around moved points this would
/// take up to 80 % longer.
constexpr int most_certain_rings = 12;
/// If the cosine of the angle between sight and normal is below this, windows grow to `widest_rings`: an exact ball
/// then misses 0.4 % of its area instead of 4.2 %. With 0.1 it misses 3.7 %, with 0.2 five people take 0.2 us more per
/// point.
constexpr double low_angle = 0.15;

constexpr std::uint64_t first_window = WindowPixels::rings(first_rings);
static_assert(WindowPixels::inRings(first_rings) == pixels_around && WindowPixels::inRings(1) == pixels_beside);

struct PixelWorker {
  PixelWindow window;
  StarMemory memory;
  PixelsAround around{};
  PixelStars pixel_stars{};
  std::int64_t grown_neighborhoods = 0, grown_stars = 0;
};

class ImageStarBuilder {
 public:
  ImageStarBuilder(const DepthImage& image, const PointBuffer& normals, const CloudOptions& options, BuiltStars& built)
      : image_(image),
        normals_(normals),
        wrapping_(options.paper.delaunay),
        by_packets_(normals.rows() == 0 && options.paper.delaunay == Delaunay::star),
        is_exact_(image.windows.moved == 0),
        is_stretched_(image.grid.goes_round && is_exact_),
        rings_of_whole_(image.grid.goes_round && !is_exact_ ? WindowPixels::reach : first_rings),
        stars_(built.stars),
        support_(built.support) {
    for (int i = 0; i < pixels_around; ++i)
      shift_[i] = std::ptrdiff_t{around_row[i]} * image.grid.columns + around_column[i];
  }

  void build(std::int64_t begin, std::int64_t end, PixelWorker& state) const {
    state.memory.block.reserve(end - begin);
    for (auto p = static_cast<int>(begin); p < static_cast<int>(end); p += kernel_packet)
      buildSome(p, std::min(p + kernel_packet, static_cast<int>(end)), state);
  }

 private:
  /// Builds the stars of at most a packet of points. If windows are whole, planes and stars are found for all lanes at
  /// once; stars that reach beyond the eight pixels beside p, and all others, are built one by one.
  void buildSome(int begin, int end, PixelWorker& state) const {
    const PixelStars& found = state.pixel_stars;
    const unsigned is_whole = by_packets_ ? wrapWhole(begin, end, state) : 0;
    for (int p = begin; p < end; ++p) {
      const int lane = p - begin;
      if ((is_whole & found.is_certain) >> lane & 1U) {
        takeCertain(p, lane, found, state.memory.star);
        store(p, frameOfLane(found, lane), 1, state.memory);
      } else if ((is_whole & found.is_found) >> lane & 1U) {
        state.window.take(image_, p, rings_of_whole_);
        buildOne(p, frameOfLane(found, lane), state);
      } else {
        buildOne(p, findFrame(p, state), state);
      }
    }
  }

  /// Finds the stars with a whole window; returns their lanes.
  unsigned wrapWhole(int begin, int end, PixelWorker& state) const {
    PixelsAround& around = state.around;
    around.is_stretched = is_stretched_;
    unsigned is_whole = 0;
    for (int p = begin; p < end; ++p) {
      if ((image_.windows.around[p] & first_window) != first_window) continue;
      const int lane = p - begin;
      is_whole |= 1U << lane;
      const int* const rank = image_.grid.rank.data() + image_.grid.pixel[p];
      const double* const places = image_.moved.data();
      const double* const here = places + 3 * std::ptrdiff_t{p};
      for (int i = 0; i < pixels_around; ++i) {
        const double* const there = places + 3 * std::ptrdiff_t{rank[shift_[i]]};
        around.x[i][lane] = there[0] - here[0];
        around.y[i][lane] = there[1] - here[1];
        around.z[i][lane] = there[2] - here[2];
      }
      const Eigen::RowVector3d sight = image_.points.row(p) - image_.grid.origin;
      around.sight_x[lane] = sight[0];
      around.sight_y[lane] = sight[1];
      around.sight_z[lane] = sight[2];
    }
    if (is_whole != 0) kernels().wrapPixels(around, state.pixel_stars);
    return is_whole;
  }

  static PixelFrame frameOfLane(const PixelStars& found, int lane) {
    return {{found.normal_x[lane], found.normal_y[lane], found.normal_z[lane]}, found.fit_radius[lane]};
  }

  void takeCertain(int p, int lane, const PixelStars& found, DelaunayStar& star) const {
    const int* const rank = image_.grid.rank.data() + image_.grid.pixel[p];
    star.link.clear();
    star.radius.clear();
    star.closed = true;
    for (int i = 0; i < pixels_beside; ++i) {
      const bool is_corner = i % 2 == 1;
      if (is_corner && (found.has_corner[i / 2] >> lane & 1U) == 0) continue;
      star.link.push_back({0, 0, rank[shift_[i]]});
      star.radius.push_back(found.radius[i][lane]);
    }
    if ((found.is_mirrored >> lane & 1U) == 0) return;
    // radius[i] belongs to link vertices i and i + 1.
    std::reverse(star.link.begin(), star.link.end());
    std::reverse(star.radius.begin(), star.radius.end() - 1);
  }

  void buildOne(int p, const std::optional<PixelFrame>& frame, PixelWorker& state) const {
    state.memory.star.link.clear();
    state.memory.star.radius.clear();
    state.memory.star.closed = false;
    // A power of two near the size of the window, so that the predicates get numbers near 1.
    const double unit = frame ? 1 / magnitudeOf(frame->radius) : 1;
    if (frame) findStar(p, *frame, unit, state);
    store(p, frame.value_or(PixelFrame{Eigen::Vector3d::UnitZ()}), unit, state.memory);
  }

  /// Takes the window, widened if it has few points, and fits the plane to it.
  std::optional<PixelFrame> findFrame(int p, PixelWorker& state) const {
    if (image_.grid.pixel[p] < 0) return std::nullopt;
    PixelWindow& window = state.window;
    int rings = first_rings;
    window.take(image_, p, rings);
    while (window.count() < enough && widened(rings) <= widest_rings) {
      widen(p, rings, window);
      ++state.grown_neighborhoods;
    }
    std::optional<PixelFrame> frame = fitFrame(image_, window, p);
    if (frame && normals_.rows() > 0 && !normals_.row(p).isZero(0))
      frame = frameOf(normals_.row(p).transpose(), window);
    return frame;
  }

  static int widened(int rings) { return rings < WindowPixels::reach ? WindowPixels::reach : 2 * rings; }
  void widen(int p, int& rings, PixelWindow& window) const {
    rings = widened(rings);
    if (rings <= WindowPixels::reach) {
      window.take(image_, p, rings);
    } else {
      window.widen(image_, p, rings);
    }
  }

  /// Finds the star in the window, widened until no point beyond can change it.
  void findStar(int p, const PixelFrame& frame, double unit, PixelWorker& state) const {
    PixelWindow& window = state.window;
    const DelaunayStar& star = state.memory.star;
    for (int rings = window.rings();; ++state.grown_stars) {
      wrapping_.wrap(p, frame.normal, unit, window.offsets(), window.neighbors(), state.memory);
      if (star.closed && isCertain(star, window, unit)) break;
      if (widened(rings) > WindowPixels::reach && widened(rings) > mostRingsOfStar(p, frame)) break;
      widen(p, rings, window);
    }
  }

  /// The greatest number of rings for a star. In a noisy image points far away are noisy too, so windows stay within 7
  /// x 7. But along the rim of a body that curves away from the sensor, neighbours in space are many pixels apart. Such
  /// a surface is seen at a low angle, and its points are farther apart than the noise, or the angle might be due to
  /// noise.
  int mostRingsOfStar(int p, const PixelFrame& frame) const {
    if (image_.grid.goes_round) return WindowPixels::reach;
    const Eigen::Vector3d sight = (image_.points.row(p) - image_.grid.origin).transpose();
    const bool is_low = std::abs(sight.dot(frame.normal)) < low_angle * sight.norm();
    const double noise = image_.test.tolerance.atRange(sight.norm(), image_.grid.depthOf(image_.points.row(p)));
    if (is_low && noise <= frame.radius) return widest_rings;
    return is_exact_ ? most_certain_rings : WindowPixels::reach;
  }

  /// Whether no pixel beyond the window can lie in a circle of the star, if the next ring is one step farther away.
  /// Points of an exact ring lie close together on a line, so that a circle reaches only between two of them: then only
  /// the next rows count.
  bool isCertain(const DelaunayStar& star, const PixelWindow& window, double unit) const {
    const double nearest = is_stretched_ ? window.nearestInLastRows() : window.nearestInLastRing();
    const double rings = window.rings(), next = (rings + 1) / rings * std::sqrt(nearest) * unit;
    return 2 * star.largestCircumradius() <= next;
  }

  void store(int p, const PixelFrame& frame, double unit, StarMemory& memory) const {
    support_.normals.row(p) = frame.normal;
    support_.fit_radius[p] = frame.radius;
    support_.isolated[p] = 0;
    const auto isOneSurface = [this](int a, int b) { return image_.isOneSurface(a, b); };
    storeStar(p, 1 / unit, isOneSurface, memory, stars_);
  }

  const DepthImage& image_;
  const PointBuffer& normals_;
  StarWrapping wrapping_;
  bool by_packets_;                                    ///< whether whole windows are handled eight at once
  bool is_exact_;                                      ///< whether no point moves
  bool is_stretched_;                                  ///< whether only rows bound the distance of the next ring
  int rings_of_whole_;                                 ///< rings of a whole window whose star is more than ring 1
  std::array<std::ptrdiff_t, pixels_around> shift_{};  ///< from a pixel to those around
  Stars& stars_;
  StarSupport& support_;
};

}  // namespace

SurfaceImage surfaceImage(PixelGrid grid, const PointsView& points, bool smooths, const Workers& workers) {
  SurfaceImage image;
  image.grid = std::move(grid);
  findAxis(points, workers, image.grid);
  image.unplaced = std::count(image.grid.pixel.begin(), image.grid.pixel.end(), -1);
  image.noise = rangeNoise(image.grid, points, workers);
  image.windows = findSurfaceWindows(image.grid, points, image.noise, smooths, workers);
  return image;
}

BuiltStars buildImageStars(const DepthImage& image, const PointBuffer& normals, const CloudOptions& options,
                           const Workers& workers, Report& report) {
  const int n = static_cast<int>(image.points.rows());
  BuiltStars built;
  makeRoom(n, built);
  const std::int64_t blocks = (n + star_block - 1) / star_block;
  Buffer<PixelWorker> states(workers.count());
  const ImageStarBuilder builder(image, normals, options, built);
  BlocksInOrder in_order(blocks, built);
  workers.forBlocks("stars", n, star_block, [&](std::int64_t begin, std::int64_t end, int worker) {
    builder.build(begin, end, states[worker]);
    in_order.take(begin / star_block, states[worker].memory.block);
  });
  finishOffsets(built.stars);
  for (const PixelWorker& state : states) {
    report.grown_neighborhoods += state.grown_neighborhoods;
    report.grown_stars += state.grown_stars;
    report.open_stars += state.memory.open_stars;
    report.dropped_triangles += state.memory.unusable_triangles;
  }
  return built;
}

}  // namespace tufted
