#include "denoise/shared_surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "denoise/listed_search.h"
#include "denoise/window_surface.h"

namespace tufted {
namespace {

constexpr int least_shared = 2;        // of Windows::fits: smaller windows hold too few points to be shared
constexpr double least_weight = 0.02;  // of all windows together; 1 is that of a window in its middle
constexpr std::int64_t at_once = 64 * costly_block;  // windows whose surfaces are kept until they are added up

/// What one window says about one point.
struct Vote {
  int point, window;
  float squared_distance;
  double weight;  ///< 0: only that the window is near
  Eigen::Vector3d move;
};

/// The sum of all votes about a point.
struct Sum {
  Eigen::Vector3d move = Eigen::Vector3d::Zero();
  double weight = 0, variance = 0;
};

class SharingWindows {
 public:
  SharingWindows(const PointsView& points, const NeighborSource& source, const Windows& windows,
                 const NoiseLevel& noise, const WindowChoice& choice)
      : points_(points), source_(source), windows_(windows), noise_(noise), choice_(choice) {}

  bool isSmooth(int w) const {
    return choice_.biased[w] == 0 && choice_.window[w] >= least_shared && windows_.split[w] == 0;
  }

  /// The way of p onto the surface of the smooth window w. False where it is too far off.
  bool moveOnto(int w, int p, Eigen::Vector3d& move) const {
    const Eigen::Vector3d d = (points_.row(p) - points_.row(windows_.pointOf(w))).transpose();
    const WindowSurface surface = surfaceAt(windows_, w, choice_.window[w], d);
    move = -surface.height * surface.normal;
    return surface.height * surface.height <=
           std::max(outlier_sigmas * outlier_sigmas * noise_.variance[w],
                    outlier_spacings * outlier_spacings * windows_.spacing(w) * windows_.spacing(w));
  }

  /// The way onto its surface, as moveOnto(), of a point that no window shares. False where it lies outside of window w
  /// or that is not smooth.
  bool moveInside(int w, int p, Eigen::Vector3d& move) const {
    if (!isSmooth(w)) return false;
    const double radius = windows_.fits[w][choice_.window[w]].radius;
    return (points_.row(p) - points_.row(windows_.pointOf(w))).squaredNorm() <= radius * radius && moveOnto(w, p, move);
  }

  /// Whether there is no noise in the window, nor in others around.
  bool isQuiet(int w) const {
    return noise_.noisy[w] == 0 && noise_.outlier[w] == 0 &&
           std::ranges::none_of(windows_.near[w], [&](int other) { return noise_.noisy[other] != 0; });
  }

  /// The votes of the windows [begin, end).
  void vote(int begin, int end, Buffer<Vote>& votes) const {
    Buffer<int> which;
    for (int w = begin; w < end; ++w)
      if (windows_.is_copy[w] == 0) which.push_back(w);
    WindowNeighbors around;
    ListedSearch search(points_, *source_.search, windows_);
    // Three quarters of the window's points.
    const auto count = [&](int w) {
      return isSmooth(w) ? 3 * (windows_.base[w] / 2 << choice_.window[w]) / 4 : windows_.base[w] / 2;
    };
    search.forEach(which, count, [&](int w, std::span<const Neighbor> neighbors) {
      const bool is_smooth = isSmooth(w);
      const int p = windows_.pointOf(w);
      if (is_smooth) around.take(points_, windows_, w, neighbors, {});
      const double farthest = neighbors.back().squared_distance;
      add(w, p, 0, is_smooth ? 1 : 0, votes);
      for (std::size_t i = 0; i < neighbors.size(); ++i) {
        const double share = 1 - neighbors[i].squared_distance / farthest;
        add(w, neighbors[i].index, neighbors[i].squared_distance,
            is_smooth && around.skipped[i] == 0 ? share * share : 0, votes);
      }
    });
  }

 private:
  void add(int w, int p, double squared_distance, double weight, Buffer<Vote>& votes) const {
    Vote vote{p, w, static_cast<float>(squared_distance), weight, {}};
    if (weight > 0 && !moveOnto(w, p, vote.move)) vote.weight = 0;
    votes.push_back(vote);
  }

  PointsView points_;
  const NeighborSource& source_;
  const Windows& windows_;
  const NoiseLevel& noise_;
  const WindowChoice& choice_;
};

}  // namespace

SharedSurfaces shareSurfaces(const PointsView& points, const NeighborSource& source, const Windows& windows,
                             const NoiseLevel& noise, const WindowChoice& choice, const Workers& workers,
                             PointBuffer& move, RawBuffer<double>& variance) {
  const auto n = static_cast<std::size_t>(points.rows());
  SharedSurfaces shared;
  shared.settled.assign(n, 0);
  shared.nearest.resize(n);
  for (std::size_t p = 0; p < n; ++p) shared.nearest[p] = static_cast<int>(p) / windows.stride;
  Buffer<float> nearest(n, std::numeric_limits<float>::infinity());
  Buffer<Sum> sums(n);
  const SharingWindows sharing(points, source, windows, noise, choice);
  Buffer<Buffer<Vote>> votes(at_once / costly_block);
  for (std::int64_t first = 0; first < windows.size(); first += at_once) {
    const std::int64_t count = std::min(at_once, windows.size() - first);
    workers.forBlocks("noise", count, costly_block, [&](std::int64_t begin, std::int64_t end, int) {
      Buffer<Vote>& block = votes[begin / costly_block];
      block.clear();
      sharing.vote(static_cast<int>(first + begin), static_cast<int>(first + end), block);
    });
    // One after the other, so that sums are the same for any number of threads.
    for (std::int64_t begin = 0; begin < count; begin += costly_block) {
      for (const Vote& vote : votes[begin / costly_block]) {
        if (vote.squared_distance < nearest[vote.point]) {
          nearest[vote.point] = vote.squared_distance;
          shared.nearest[vote.point] = vote.window;
        }
        if (!(vote.weight > 0)) continue;
        Sum& sum = sums[vote.point];
        sum.move += vote.weight * vote.move;
        sum.weight += vote.weight;
        sum.variance += vote.weight * noise.variance[vote.window];
      }
    }
  }
  move.setZero(points.rows());
  variance.resize(n);
  workers.forBlocks("noise", points.rows(), usual_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t p = begin; p < end; ++p) {
      const Sum& sum = sums[p];
      const int w = shared.nearest[p];
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
        shared.settled[p] = sharing.isQuiet(w) ? 1 : 0;
      }
    }
  });
  return shared;
}

}  // namespace tufted
