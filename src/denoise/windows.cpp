#include "denoise/windows.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "denoise/listed_search.h"
#include "simd/kernels.h"
#include "stars/neighborhood.h"
#include "stars/sheets.h"
#include "stars/tangent_frame.h"

namespace tufted {
namespace {

/// @param p stands in where there are no neighbours
void spread(int p, std::span<const Neighbor> neighbors, Windows::Pool& pool) {
  const std::size_t count = neighbors.size();
  if (count == 0) return pool.fill(p);
  for (std::size_t i = 0; i < pool.size(); ++i) pool[i] = neighbors[i * count / pool.size()].index;
}

void takePlane(int p, const PrincipalAxes& axes, Windows& windows) {
  windows.normal.row(p) = axes.normal.transpose();
  windows.thickness[p] = axes.variance[1] > 0 ? std::min(1.0, std::max(0.0, axes.variance[0]) / axes.variance[1]) : 1;
  windows.line[p] = liesOnOneLine(axes) ? 1 : 0;
}

/// Fits that wait until there are enough to be solved together.
class FitQueue {
 public:
  explicit FitQueue(Windows& windows) : windows_(windows) {}

  void add(int p, int size, const HeightMoments& moments) {
    slots_.push_back({p, size});
    moments_.push_back(moments);
    if (std::ssize(moments_) == at_once) solve();
  }

  void solve() {
    fits_.resize(moments_.size());
    fitHeights(moments_, fits_);
    for (std::size_t i = 0; i < fits_.size(); ++i)
      static_cast<HeightFit&>(windows_.fits[slots_[i].p][slots_[i].size]) = fits_[i];
    slots_.clear();
    moments_.clear();
  }

 private:
  static constexpr int at_once = 8 * kernel_packet;
  /// Whose fit it is, in the window of which size.
  struct Slot {
    int p, size;
  };

  Windows& windows_;
  Buffer<Slot> slots_;
  Buffer<HeightMoments> moments_;
  Buffer<HeightFit> fits_;
};

}  // namespace

double Windows::spacing(int p) const {
  return radius[p] * std::sqrt(std::numbers::pi / base[p]);
}

void WindowNeighbors::take(const PointsView& points, const Windows& windows, int p, std::span<const Neighbor> neighbors,
                           const Buffer<std::uint8_t>& left_out) {
  all = neighbors;
  offsets.take(points, p, all);
  const int count = static_cast<int>(all.size());
  heights.resize(static_cast<std::size_t>(toPackets(count)));
  const Eigen::Vector3d normal = windows.normal.row(p).transpose();
  const HeightRange range =
      kernels().connectedHeights(offsets.view(), normal.data(), sheet_gap * windows.radius[p], heights.data());
  bool any = false;
  skipped.resize(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool is_out = !left_out.empty() && left_out[all[i].index] != 0;
    skipped[i] = is_out || heights[i] < range.lowest || heights[i] > range.highest ? 1 : 0;
    any |= skipped[i] != 0;
  }
  if (!any) return;
  offsets.fill(count, [&](int i) -> Eigen::RowVector3d {
    if (skipped[i] != 0) return Eigen::RowVector3d::Zero();
    return points.row(all[i].index) - points.row(p);
  });
}

void WindowFitter::start(Windows& windows) const {
  const Eigen::Index n = points_.rows();
  const auto size = static_cast<std::size_t>(n);
  windows.base.assign(size, Windows::first_base);
  windows.normal.resize(n);
  windows.radius.resize(size);
  windows.thickness.resize(size);
  windows.line.resize(size);
  windows.split.resize(size);
  windows.fits.resize(size);
  windows.near.resize(size);
  windows.middle.resize(size);
  windows.far.resize(size);
  CloudOptions options;
  const NeighborhoodFinder finder(points_, source_, options);
  workers_.forBlocks("noise", n, costly_block, [&](std::int64_t begin, std::int64_t end, int) {
    const int first = static_cast<int>(begin), count = static_cast<int>(end - begin);
    Buffer<Neighborhood> neighborhoods(static_cast<std::size_t>(count));
    NeighborhoodScratch scratch;
    std::array<OffsetBuffer, NeighborhoodFinder::most_planes> offsets;
    finder.find(first, count, scratch, neighborhoods.data());
    for (int group = 0; group < count; group += NeighborhoodFinder::most_planes) {
      const int group_size = std::min(count - group, NeighborhoodFinder::most_planes);
      const std::span some(neighborhoods.data() + group, static_cast<std::size_t>(group_size));
      finder.fitPlanes(first + group, some, offsets);
      for (int i = 0; i < group_size; ++i) {
        const int p = first + group + i;
        Neighborhood& around = some[i];
        finder.refine(p, around, offsets[i], scratch);
        while (2 * windows.base[p] <= around.k) windows.base[p] *= 2;  // it has grown on a line
        windows.radius[p] = around.radius;
        windows.split[p] = around.split ? 1 : 0;
        takePlane(p, around.axes, windows);
        spread(p, around.neighbors, windows.near[p]);
      }
    }
  });
}

void WindowFitter::widen(std::span<const int> which, Windows& windows) const {
  for (const int p : which) windows.base[p] *= 2;
  takePlanes(which, windows);
}

void WindowFitter::reset(std::span<const int> which, Windows& windows) const {
  for (const int p : which) windows.base[p] = Windows::first_base;
  takePlanes(which, windows);
}

void WindowFitter::takePlanes(std::span<const int> which, Windows& windows) const {
  workers_.forBlocks("noise", std::ssize(which), costly_block, [&](std::int64_t begin, std::int64_t end, int) {
    ListedSearch search(points_, *source_.search, windows);
    OffsetBuffer offsets;
    std::array<Covariance, costly_block> covariances;
    std::array<PrincipalAxes, costly_block> axes;
    const auto block = which.subspan(begin, end - begin);
    std::size_t i = 0;
    search.forEach(
        block, [&](int p) { return windows.base[p]; },
        [&](int p, std::span<const Neighbor> neighbors) {
          offsets.take(points_, p, neighbors);
          windows.radius[p] = std::sqrt(neighbors.back().squared_distance);
          spread(p, neighbors, windows.near[p]);
          covariances[i++] = covarianceOf(offsets.view(), windows.radius[p]);
        });
    principalAxes(std::span(covariances).first(block.size()), axes);
    for (i = 0; i < block.size(); ++i) takePlane(block[i], axes[i], windows);
  });
}

void WindowFitter::fitNear(std::span<const int> which, const Buffer<std::uint8_t>& left_out, Windows& windows) const {
  fit(which, 2, left_out, windows);
}

void WindowFitter::fitAll(std::span<const int> which, const Buffer<std::uint8_t>& left_out, Windows& windows) const {
  fit(which, Windows::sizes, left_out, windows);
}

void WindowFitter::fit(std::span<const int> which, int sizes, const Buffer<std::uint8_t>& left_out,
                       Windows& windows) const {
  workers_.forBlocks("noise", std::ssize(which), costly_block, [&](std::int64_t begin, std::int64_t end, int) {
    WindowNeighbors around;
    FitQueue queue(windows);
    Buffer<Neighbor> kept;
    ListedSearch search(points_, *source_.search, windows);
    const auto widest = [&](int p) { return windows.base[p] / 2 << (sizes - 1); };
    search.forEach(which.subspan(begin, end - begin), widest, [&](int p, std::span<const Neighbor> neighbors) {
      const int half = windows.base[p] / 2, most = static_cast<int>(neighbors.size());
      around.take(points_, windows, p, neighbors, left_out);
      const Offsets all = around.offsets.view();
      HeightMoments total = {{}, 1, windows.radius[p]};
      int from = 0;
      for (int size = 0; size < Windows::sizes; ++size) {
        windows.fits[p][size] = {};
        const int to = half << size;
        if (size >= sizes || to > most) continue;
        const HeightMoments part = heightMoments({to - from, all.x + from, all.y + from, all.z + from},
                                                 windows.normal.row(p).transpose(), windows.radius[p]);
        for (int i = 0; i < HeightSystems::numbers; ++i) (&total.sums.u)[i] += (&part.sums.u)[i];
        for (; from < to; ++from) total.count += around.skipped[from] == 0 ? 1 : 0;
        windows.fits[p][size].radius = std::sqrt(around.all[to - 1].squared_distance);
        windows.fits[p][size].count = total.count;
        queue.add(p, size, total);
        if (size < 2) continue;
        kept.clear();
        for (int i = 0; i < to; ++i)
          if (around.skipped[i] == 0) kept.push_back(around.all[i]);
        spread(p, kept, size == 2 ? windows.middle[p] : windows.far[p]);
      }
      if (sizes == Windows::sizes && most < 2 * (half << 1)) windows.middle[p] = windows.near[p];
      if (sizes == Windows::sizes && most < 4 * (half << 1)) windows.far[p] = windows.middle[p];
    });
    queue.solve();
  });
}

}  // namespace tufted
