#include "denoise/shared_surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "denoise/neighbor_lists.h"
#include "denoise/pooling.h"
#include "denoise/shared_windows.h"
#include "denoise/window_surface.h"

namespace tufted {
namespace {

constexpr double least_weight = 0.02;  // of all windows together; 1 is that of a window in its middle
constexpr int blocks_per_thread = 2;   // of windows whose votes are kept until they are added up
constexpr double lifted_within = 0.6;  // of the radius of a window: how far its surface lifts others
/// Noise draws fits towards the centre of curvature: by 2.5 times its variance times the mean curvature where it is
/// alike in all directions, by 3.5 times where it is along the normal. So many times of that are taken back.
constexpr double taken_back = 1;
constexpr int more_where_bent = 2;  // times as many base windows as others: they hold half as many points

/// What one window says about one point.
struct Vote {
  int point, window;
  float squared_distance;
  double weight;  ///< 0: only that the window is near
  Eigen::Vector3d move;
};

/// The ways of points onto the surface of one window; memory of one worker.
struct Ways {
  OffsetBuffer offsets;  ///< from the middle
  Buffer<double> squared;
  Buffer<double> height, x, y, z;
};

/// The sum of all votes about a point, and the window nearest to it.
struct Sum {
  Eigen::Vector3d move = Eigen::Vector3d::Zero();
  double weight = 0, variance = 0;
  float squared_distance = std::numeric_limits<float>::infinity();
  int nearest = 0;
};

/// Windows whose surfaces are shared, all or some.
class SharingWindows {
 public:
  /// All arguments are borrowed.
  /// @param variance of the noise, by window
  /// @param shared which of Windows::fits is shared, by window; -1 where none is
  SharingWindows(const PointsView& points, const NeighborLists& lists, const Windows& windows,
                 const RawBuffer<double>& variance, const Buffer<std::int8_t>& shared)
      : points_(points), lists_(lists), windows_(windows), variance_(variance), shared_(shared) {}

  /// Lifts surfaces through middles, each to the mean of those around at its own middle: their errors partly cancel.
  void lift(const Workers& workers) {
    RawBuffer<PlaneQuadratic> quadratics(windows_.base.size());
    forEachPoint(windows_, workers, [&](int w) {
      if (isThroughMiddles(w)) quadratics[w] = quadraticOf(windows_, w, shared_[w]);
    });
    RawBuffer<double> lifts(windows_.base.size());
    forEachPoint(windows_, workers, [&](int w) { lifts[w] = isThroughMiddles(w) ? liftOf(w, quadratics) : 0; });
    lift_ = std::move(lifts);
  }

  double variance(int w) const { return variance_[w]; }

  /// The way onto its surface of a point that no window shares. False where it lies outside of window w or that is not
  /// shared.
  bool moveInside(int w, int p, Eigen::Vector3d& move) const {
    if (shared_[w] < 0) return false;
    const double radius = windows_.fits[w][shared_[w]].radius;
    return (points_.row(p) - points_.row(windows_.pointOf(w))).squaredNorm() <= radius * radius && moveOnto(w, p, move);
  }

  /// Calls visit(vote) for the votes of some windows, one window after the other.
  template <class Visit>
  void vote(std::span<const int> which, Ways& ways, const Visit& visit) const {
    for (const int w : which) {
      const std::span<const int> neighbors = sharing(w);
      const std::span<const std::uint8_t> skipped = lists_.skippedOf(w);
      const bool is_shared = shared_[w] >= 0;
      const double most = is_shared ? farthestMoved(w) : 0;
      takeOffsets(w, neighbors, ways);
      if (is_shared) findWays(w, ways);
      const double farthest = ways.squared[neighbors.size()];
      const auto add = [&](std::size_t i, int p, double weight) {
        Vote vote{p, w, static_cast<float>(ways.squared[i]), weight, Eigen::Vector3d::Zero()};
        if (weight > 0) {
          vote.move = {ways.x[i], ways.y[i], ways.z[i]};
          if (!(ways.height[i] * ways.height[i] <= most)) vote.weight = 0;
        }
        visit(vote);
      };
      add(0, windows_.pointOf(w), is_shared ? 1 : 0);
      for (std::size_t i = 0; i < neighbors.size(); ++i) {
        const double share = 1 - ways.squared[i + 1] / farthest;
        add(i + 1, neighbors[i], is_shared && skipped[i] == 0 ? share : 0);
      }
    }
  }

 private:
  bool isThroughMiddles(int w) const { return shared_[w] >= Windows::searched && windows_.is_copy[w] == 0; }

  double liftOf(int w, const RawBuffer<PlaneQuadratic>& quadratics) const {
    const int p = windows_.pointOf(w);
    const Eigen::RowVector3d normal = windows_.normal.row(w);
    const double own = windows_.fits[w][shared_[w]].height;
    double weight = 1, sum = own;
    forEachPooled(w, windows_.far[w], [&](int q, int) {
      if (q == w || !isThroughMiddles(q)) return;
      const double radius = lifted_within * windows_.fits[q][shared_[q]].radius;
      const Eigen::Vector3d d = (points_.row(p) - points_.row(windows_.pointOf(q))).transpose();
      const double share = 1 - d.squaredNorm() / (radius * radius);
      if (!(share > 0)) return;
      const WindowSurface surface = surfaceAt(quadratics[q], d);
      weight += share * share;
      sum -= share * share * surface.height * normal.dot(surface.normal.transpose());
    });
    return sum / weight - own;
  }

  /// How high over the surface of the shared window w points move to.
  double up(int w) const {
    const auto& c = windows_.fits[w][shared_[w]].coefficient;
    return (lift_.empty() ? 0 : lift_[w]) - taken_back * variance_[w] * (c[3] + c[5]) / windows_.radius[w];
  }

  /// The squared distance from the surface of window w within which points belong to it.
  double farthestMoved(int w) const {
    return std::max(outlier_sigmas * outlier_sigmas * variance_[w],
                    outlier_spacings * outlier_spacings * windows_.spacing(w) * windows_.spacing(w));
  }

  /// The way of p onto the surface of the shared window w. False where it is too far off.
  bool moveOnto(int w, int p, Eigen::Vector3d& move) const {
    const Eigen::Vector3d d = (points_.row(p) - points_.row(windows_.pointOf(w))).transpose();
    const WindowSurface surface = surfaceAt(windows_, w, shared_[w], d);
    move = (up(w) - surface.height) * surface.normal;
    return surface.height * surface.height <= farthestMoved(w);
  }

  /// The neighbours that a window is shared with: three quarters of its own, if it is of middles those of the widest
  /// one of neighbours.
  std::span<const int> sharing(int w) const {
    const int half = windows_.base[w] / 2;
    const int most = shared_[w] < 0 ? half : 3 * (half << std::min<int>(shared_[w], windows_.fitted - 1)) / 4;
    const std::span<const int> all = lists_.of(w);
    return all.first(std::min(all.size(), static_cast<std::size_t>(most)));
  }

  /// The offsets of the middle of window w, and then of its neighbours.
  void takeOffsets(int w, std::span<const int> neighbors, Ways& ways) const {
    const int p = windows_.pointOf(w), count = static_cast<int>(neighbors.size()) + 1;
    ways.offsets.fill(count, [&](int i) -> Eigen::RowVector3d {
      return points_.row(i == 0 ? p : neighbors[i - 1]) - points_.row(p);
    });
    const Offsets all = ways.offsets.view();
    for (Buffer<double>* const each : {&ways.squared, &ways.height, &ways.x, &ways.y, &ways.z})
      each->resize(static_cast<std::size_t>(toPackets(count)));
    for (int i = 0; i < count; ++i) ways.squared[i] = all.x[i] * all.x[i] + all.y[i] * all.y[i] + all.z[i] * all.z[i];
  }

  void findWays(int w, Ways& ways) const {
    kernels().moveOnto(ways.offsets.view(), quadraticOf(windows_, w, shared_[w]), up(w), ways.height.data(),
                       ways.x.data(), ways.y.data(), ways.z.data());
  }

  PointsView points_;
  const NeighborLists& lists_;
  const Windows& windows_;
  const RawBuffer<double>& variance_;
  const Buffer<std::int8_t>& shared_;
  RawBuffer<double> lift_;  ///< of each window's surface; empty: none is lifted
};

/// Visits the votes of some windows, one after the other, so that sums are the same for any number of threads.
template <class Visit>
void forEachVote(const SharingWindows& sharing, const Buffer<int>& which, const Workers& workers, const Visit& visit) {
  if (workers.count() == 1) {
    Ways ways;
    return workers.forBlocks("noise", std::ssize(which), costly_block, [&](std::int64_t begin, std::int64_t end, int) {
      sharing.vote(std::span(which).subspan(begin, end - begin), ways, visit);
    });
  }
  const std::int64_t blocks = std::int64_t{blocks_per_thread} * workers.count(), at_once = blocks * costly_block;
  Buffer<Buffer<Vote>> votes(static_cast<std::size_t>(blocks));
  for (std::int64_t first = 0; first < std::ssize(which); first += at_once) {
    const std::int64_t count = std::min<std::int64_t>(at_once, std::ssize(which) - first);
    workers.forBlocks("noise", count, costly_block, [&](std::int64_t begin, std::int64_t end, int) {
      Ways ways;
      Buffer<Vote>& block = votes[begin / costly_block];
      block.clear();
      sharing.vote(std::span(which).subspan(first + begin, end - begin), ways,
                   [&](const Vote& vote) { block.push_back(vote); });
    });
    for (std::int64_t begin = 0; begin < count; begin += costly_block)
      for (const Vote& vote : votes[begin / costly_block]) visit(vote);
  }
}

/// Base windows around every few points where the surface bends.
struct BentWindows {
  int stride;
  Windows windows;
  NeighborLists lists;
  RawBuffer<double> variance;
  Buffer<std::int8_t> shared;
  Buffer<int> which;

  /// @param coarse windows around every so many points
  /// @param bent those where the surface bends
  BentWindows(int n, const WindowFitter& fitter, const Windows& coarse, const NoiseLevel& noise,
              std::span<const int> bent)
      : stride((coarse.stride + more_where_bent - 1) / more_where_bent), lists(bent.empty() ? 0 : n / stride + 1) {
    if (bent.empty()) return;
    windows.resize(n, stride);
    windows.fitted = Windows::base_size + 1;
    variance.resize(windows.base.size());
    shared.assign(windows.base.size(), -1);
    Buffer<int> fitted;
    const auto firstFrom = [&](int p) { return (p + windows.stride - 1) / windows.stride; };
    for (const int w : bent)
      for (int fine = firstFrom(coarse.pointOf(w)); fine < std::min(firstFrom(coarse.pointOf(w + 1)), windows.size());
           ++fine) {
        variance[fine] = noise.variance[w];
        fitted.push_back(fine);
      }
    fitter.take(fitted, windows, &lists);
    for (const int fine : fitted) {
      if (!(windows.fits[fine][Windows::base_size].variance < explained * variance[fine]) || windows.split[fine] != 0)
        continue;
      shared[fine] = Windows::base_size;
      which.push_back(fine);
    }
  }
};

/// Whether there is no noise in a window, nor in others around.
bool isQuiet(const Windows& windows, const NoiseLevel& noise, int w) {
  return noise.noisy[w] == 0 && noise.outlier[w] == 0 &&
         std::ranges::none_of(windows.near[w], [&](int other) { return noise.noisy[other] != 0; });
}

}  // namespace

SharedSurfaces shareSurfaces(const PointsView& points, const NeighborSource& source, const NeighborLists& lists,
                             const Windows& windows, const NoiseLevel& noise, const WindowChoice& choice,
                             const Workers& workers, PointBuffer& move, RawBuffer<double>& variance) {
  const auto n = static_cast<std::size_t>(points.rows());
  SharedSurfaces shared;
  shared.settled.assign(n, 0);
  shared.nearest.resize(n);
  Buffer<Sum> sums(n);
  for (std::size_t p = 0; p < n; ++p) sums[p].nearest = static_cast<int>(p) / windows.stride;
  const auto addTo = [](Sum& sum, const SharingWindows& sharing, const Vote& vote) {
    if (!(vote.weight > 0)) return;
    sum.move += vote.weight * vote.move;
    sum.weight += vote.weight;
    sum.variance += vote.weight * sharing.variance(vote.window);
  };

  Buffer<std::int8_t> smooth = sharedWindows(windows, noise, choice, workers);
  Buffer<int> bends;
  for (int w = 0; w < windows.size(); ++w) {
    if (smooth[w] != Windows::base_size) continue;
    bends.push_back(w);
    smooth[w] = -1;
  }
  SharingWindows sharing(points, lists, windows, noise.variance, smooth);
  sharing.lift(workers);
  const Buffer<int> voters =
      numbersWhere("noise", windows.size(), workers, [&](int w) { return windows.is_copy[w] == 0; });
  forEachVote(sharing, voters, workers, [&](const Vote& vote) {
    Sum& sum = sums[vote.point];
    if (vote.squared_distance < sum.squared_distance) {
      sum.squared_distance = vote.squared_distance;
      sum.nearest = vote.window;
    }
    addTo(sum, sharing, vote);
  });
  const BentWindows bent(static_cast<int>(n), WindowFitter(points, source, workers), windows, noise, bends);
  const SharingWindows sharing_bent(points, bent.lists, bent.windows, bent.variance, bent.shared);
  forEachVote(sharing_bent, bent.which, workers,
              [&](const Vote& vote) { addTo(sums[vote.point], sharing_bent, vote); });

  move.setZero(points.rows());
  variance.resize(n);
  workers.forBlocks("noise", points.rows(), usual_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t p = begin; p < end; ++p) {
      const Sum& sum = sums[p];
      const int w = sum.nearest;
      shared.nearest[p] = w;
      if (sum.weight >= least_weight) {
        shared.settled[p] = 1;
        move.row(p) = (sum.move / sum.weight).transpose();
        variance[p] = sum.variance / sum.weight;
        continue;
      }
      variance[p] = noise.variance[w];
      Eigen::Vector3d alone;
      if (sharing.moveInside(w, static_cast<int>(p), alone)) {
        shared.settled[p] = 1;
        move.row(p) = alone.transpose();
      } else {
        shared.settled[p] = isQuiet(windows, noise, w) ? 1 : 0;
      }
    }
  });
  return shared;
}

}  // namespace tufted
