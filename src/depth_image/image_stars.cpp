#include "depth_image/image_stars.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/median.h"
#include "base/power_of_two.h"
#include "depth_image/depth_noise.h"
#include "depth_image/pixel_frame.h"
#include "stars/blocks_in_order.h"
#include "stars/star_wrapping.h"

namespace tufted {
namespace {

constexpr std::size_t usual_degree = 7;
constexpr int first_rings = 2;  // of the window that the plane is fitted to and the star is looked for in
constexpr int enough = 12;      // points in a window; where there are fewer it is widened
constexpr int most_rings = 24;
constexpr int most_certain_rings = 12;

struct WorkerState {
  PixelWindow window;
  StarMemory memory;
  std::int64_t grown_neighborhoods = 0, grown_stars = 0;
};

class ImageStarBuilder {
 public:
  ImageStarBuilder(const DepthImage& image, const PointBuffer& normals, const CloudOptions& options, BuiltStars& built)
      : image_(image), normals_(normals), wrapping_(options.delaunay), stars_(built.stars), support_(built.support) {}

  void build(std::int64_t begin, std::int64_t end, WorkerState& state) const {
    const std::size_t count = usual_degree * static_cast<std::size_t>(end - begin);
    state.memory.block.link.reserve(count);
    state.memory.block.triangle.reserve(count);
    state.memory.block.radius.reserve(count);
    for (int p = static_cast<int>(begin); p < static_cast<int>(end); ++p) {
      state.memory.star.link.clear();
      state.memory.star.radius.clear();
      state.memory.star.closed = false;
      const std::optional<PixelFrame> frame = findFrame(p, state);
      // A power of two near the size of the window, so that the predicates meet numbers near 1.
      const double unit = frame ? 1 / magnitudeOf(frame->radius) : 1;
      if (frame) findStar(p, *frame, unit, state);
      store(p, frame.value_or(PixelFrame{Eigen::Vector3d::UnitZ()}), unit, state);
    }
  }

 private:
  /// Fills the window, wider where it holds few points, and fits the plane to it.
  std::optional<PixelFrame> findFrame(int p, WorkerState& state) const {
    if (image_.grid.pixel[p] < 0) return std::nullopt;
    PixelWindow& window = state.window;
    int rings = first_rings;
    window.take(image_, p, rings);
    while (window.count() < enough && widened(rings) <= most_rings) {
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

  /// The star among the points of the window, and of wider ones until no point beyond can change it. Where ranges are
  /// noise, so are points far away, and the window of SurfaceWindows is the widest.
  void findStar(int p, const PixelFrame& frame, double unit, WorkerState& state) const {
    PixelWindow& window = state.window;
    const DelaunayStar& star = state.memory.star;
    for (int rings = window.rings();; ++state.grown_stars) {
      wrapping_.wrap(p, frame.normal, unit, window.offsets(), window.neighbors(), state.memory);
      if (star.closed && isCertain(star, window, unit)) break;
      const bool is_exact = star.closed && !image_.isMoved(p);
      if (widened(rings) > (is_exact ? most_certain_rings : WindowPixels::reach)) break;
      widen(p, rings, window);
    }
  }

  /// Whether no pixel beyond the window lies in a circle of the star: on a smooth surface the next ring is one step
  /// farther away.
  static bool isCertain(const DelaunayStar& star, const PixelWindow& window, double unit) {
    const double rings = window.rings(), next = (rings + 1) / rings * std::sqrt(window.nearestInLastRing()) * unit;
    return 2 * star.largestCircumradius() <= next;
  }

  void store(int p, const PixelFrame& frame, double unit, WorkerState& state) const {
    support_.normals.row(p) = frame.normal;
    support_.fit_radius[p] = frame.radius;
    support_.isolated[p] = 0;
    stars_.flat[p] = frame.is_flat ? 1 : 0;
    const auto isOneSurface = [this](int a, int b) { return image_.isOneSurface(a, b); };
    storeStar(p, 1 / unit, isOneSurface, state.memory, stars_);
  }

  const DepthImage& image_;
  const PointBuffer& normals_;
  StarWrapping wrapping_;
  Stars& stars_;
  StarSupport& support_;
};

}  // namespace

double SurfaceImage::noiseOfMoved() const {
  Buffer<double> values;
  values.reserve(static_cast<std::size_t>(windows.moved));
  for (Eigen::Index p = 0; p < windows.displacement.rows(); ++p)
    if (!windows.displacement.row(p).isZero(0)) values.push_back(noiseOf(static_cast<int>(p)));
  return medianOf(std::move(values));
}

SurfaceImage surfaceImage(const RankedScan& scan, const PointsView& points, bool smooths, const Workers& workers) {
  SurfaceImage image;
  image.grid = pixelGrid(scan);
  image.unplaced = std::count(image.grid.pixel.begin(), image.grid.pixel.end(), -1);
  image.noise = inverseRangeNoise(image.grid, points);
  image.windows = findSurfaceWindows(image.grid, points, image.noise, smooths, workers);
  return image;
}

BuiltStars buildImageStars(const DepthImage& image, const PointBuffer& normals, const CloudOptions& options,
                           const Workers& workers, Report& report) {
  const int n = static_cast<int>(image.points.rows());
  BuiltStars built;
  makeRoom(n, built);
  const std::int64_t blocks = (n + star_block - 1) / star_block;
  Buffer<WorkerState> states(workers.count());
  const ImageStarBuilder builder(image, normals, options, built);
  BlocksInOrder in_order(blocks, built);
  workers.forBlocks("stars", n, star_block, [&](std::int64_t begin, std::int64_t end, int worker) {
    builder.build(begin, end, states[worker]);
    in_order.take(begin / star_block, states[worker].memory.block);
  });
  finishOffsets(built.stars);
  for (const WorkerState& state : states) {
    report.grown_neighborhoods += state.grown_neighborhoods;
    report.grown_stars += state.grown_stars;
    report.open_stars += state.memory.open_stars;
    report.dropped_triangles += state.memory.unusable_triangles;
  }
  return built;
}

}  // namespace tufted
