#include "denoise/windows.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include "denoise/listed_search.h"
#include "denoise/neighbor_lists.h"
#include "simd/kernels.h"
#include "stars/neighborhood.h"
#include "stars/sheets.h"
#include "stars/tangent_frame.h"

namespace tufted {
namespace {

/// Windows spread over those of a list.
/// @param own the window that stands in where there is no other
void spreadOver(std::span<const int> list, int own, Windows::Pool& pool) {
  if (list.empty()) return pool.fill(own);
  for (std::size_t i = 0; i < pool.size(); ++i) pool[i] = list[i * list.size() / pool.size()];
}

/// Spreads all pools of a window.
/// @param ranks of its neighbours
/// @param kept memory
void spreadAll(int w, std::span<const int> ranks, std::span<const std::uint8_t> skipped, Buffer<int>& kept,
               Windows& windows) {
  kept.clear();
  // A base window holds few middles of windows that lie around every eighth point.
  const int near = windows.stride == 1 ? windows.base[w] : 2 * windows.base[w];
  const auto most = static_cast<int>(ranks.size());
  const int step = std::countr_zero(static_cast<unsigned>(windows.stride)), within = windows.stride - 1;
  int from = 0;
  const auto pool = [&](int count, Windows::Pool& to) {
    for (; from < std::min(count, most); ++from)
      if (skipped[from] == 0 && (ranks[from] & within) == 0) kept.push_back(ranks[from] >> step);
    spreadOver(kept, w, to);
  };
  pool(near, windows.near[w]);
  pool(2 * windows.base[w], windows.middle[w]);
  pool(4 * windows.base[w], windows.far[w]);
}

void takePlane(int w, const PrincipalAxes& axes, Windows& windows) {
  windows.normal.row(w) = axes.normal.transpose();
  windows.thickness[w] = axes.variance[1] > 0 ? std::min(1.0, std::max(0.0, axes.variance[0]) / axes.variance[1]) : 1;
  windows.line[w] = liesOnOneLine(axes) ? 1 : 0;
}

/// Fits that wait until there are enough to be solved together.
class FitQueue {
 public:
  explicit FitQueue(Windows& windows) : windows_(windows) {}

  void add(int window, int size, const HeightMoments& moments) {
    slots_.push_back({window, size});
    moments_.push_back(moments);
    if (std::ssize(moments_) == at_once) solve();
  }

  void solve() {
    fits_.resize(moments_.size());
    fitHeights(moments_, fits_);
    for (std::size_t i = 0; i < fits_.size(); ++i)
      static_cast<HeightFit&>(windows_.fits[slots_[i].window][slots_[i].size]) = fits_[i];
    slots_.clear();
    moments_.clear();
  }

 private:
  static constexpr int at_once = 8 * kernel_packet;
  struct Slot {
    int window, size;
  };

  Windows& windows_;
  Buffer<Slot> slots_;
  Buffer<HeightMoments> moments_;
  Buffer<HeightFit> fits_;
};

/// Makes planes and fits for the windows of one block; memory of one worker.
class BlockFitter {
 public:
  BlockFitter(const PointsView& points, const NeighborSource& source, Windows& windows)
      : points_(points),
        windows_(windows),
        finder_(points, source, options_),
        search_(points, *source.search),
        queue_(windows) {}

  /// @param lists null, or where block `block` gets the neighbours
  void take(std::span<const int> which, NeighborLists* lists, int block) {
    const auto fitAndKeep = [&](int w, std::span<const Neighbor> neighbors) {
      fit(w, neighbors, {});
      if (lists != nullptr) lists->put(block, w, neighbors, around_.skipped);
    };
    const auto rank = [&](int w) { return windows_.pointOf(w); };
    const auto count = [&](int w) { return widest(w); };
    again_.clear();
    if (lists != nullptr && !which.empty())
      lists->reserve(block, which.size() * static_cast<std::size_t>(widest(which[0])));
    search_.forEachGroup(which, rank, count, [&](std::span<const int> group, const auto& neighborsOf) {
      const int searched = widest(group[0]);
      fitPlanes(group, neighborsOf);
      for (std::size_t i = 0; i < group.size(); ++i) {
        if (widest(group[i]) == searched)
          fitAndKeep(group[i], neighborsOf(i));
        else
          again_.push_back(group[i]);  // it has grown along a line
      }
    });
    search_.forEach(again_, rank, count, fitAndKeep);
    queue_.solve();
  }

  void refit(std::span<const int> which, NeighborLists& lists, const Buffer<std::uint8_t>& left_out) {
    lists.forEach(
        points_, windows_, which, [&](int w) { return widest(w); },
        [&](int w, std::span<const Neighbor> neighbors) {
          fit(w, neighbors, left_out);
          lists.skip(w, around_.skipped);
        });
    queue_.solve();
  }

 private:
  int widest(int w) const { return windows_.base[w] / 2 << (windows_.fitted - 1); }

  /// Fits planes to base windows of one size, which double along a line, and finds their radius.
  template <class NeighborsOf>
  void fitPlanes(std::span<const int> group, const NeighborsOf& neighborsOf) {
    const auto base = static_cast<std::size_t>(windows_.base[group[0]]);
    const auto inside = [&](std::size_t i) {
      const std::span<const Neighbor> all = neighborsOf(i);
      return all.first(std::min(all.size(), base));
    };
    if (base > Windows::first_base) return fitWidenedPlanes(group, inside);
    for (std::size_t first = 0; first < group.size(); first += neighborhoods_.size()) {
      const std::size_t count = std::min(neighborhoods_.size(), group.size() - first);
      fitFirstPlanes(group.subspan(first, count), [&](std::size_t i) { return inside(first + i); });
    }
  }

  template <class Inside>
  void fitWidenedPlanes(std::span<const int> group, const Inside& inside) {
    std::array<Covariance, ListedSearch::most_together> covariances;
    std::array<PrincipalAxes, ListedSearch::most_together> axes;
    OffsetBuffer& offsets = plane_offsets_.front();
    for (std::size_t i = 0; i < group.size(); ++i) {
      const int w = group[i];
      windows_.radius[w] = std::sqrt(inside(i).back().squared_distance);
      windows_.split[w] = 0;
      offsets.take(points_, windows_.pointOf(w), inside(i));
      covariances[i] = covarianceOf(offsets.view(), windows_.radius[w]);
    }
    principalAxes(std::span(covariances).first(group.size()), axes);
    for (std::size_t i = 0; i < group.size(); ++i) takePlane(group[i], axes[i], windows_);
  }

  /// @param group at most as many as there are neighborhoods_
  template <class Inside>
  void fitFirstPlanes(std::span<const int> group, const Inside& inside) {
    for (std::size_t i = 0; i < group.size(); ++i) {
      finder_.start(inside(i), neighborhoods_[i]);
      plane_offsets_[i].take(points_, windows_.pointOf(group[i]), inside(i));
    }
    finder_.fitPlanes(std::span(neighborhoods_).first(group.size()), plane_offsets_);
    for (std::size_t i = 0; i < group.size(); ++i) {
      const int w = group[i];
      Neighborhood& neighborhood = neighborhoods_[i];
      finder_.refine(windows_.pointOf(w), neighborhood, plane_offsets_[i], plane_scratch_);
      while (2 * windows_.base[w] <= neighborhood.k) windows_.base[w] *= 2;
      windows_.radius[w] = neighborhood.radius;
      windows_.split[w] = neighborhood.split ? 1 : 0;
      takePlane(w, neighborhood.axes, windows_);
    }
  }

  void fit(int w, std::span<const Neighbor> neighbors, const Buffer<std::uint8_t>& left_out) {
    const int half = windows_.base[w] / 2, most = static_cast<int>(neighbors.size());
    around_.take(points_, windows_, w, neighbors, left_out);
    const Offsets all = around_.offsets.view();
    HeightMoments total = {{}, 1, windows_.radius[w]};
    windows_.one_sided[w] = 0;
    int from = 0;
    windows_.fits[w] = {};
    for (int size = 0; size < windows_.fitted; ++size) {
      const int to = half << size;
      if (to > most) continue;
      const HeightMoments part = heightMoments({to - from, all.x + from, all.y + from, all.z + from},
                                               windows_.normal.row(w).transpose(), windows_.radius[w]);
      for (int i = 0; i < HeightSystems::numbers; ++i) (&total.sums.u)[i] += (&part.sums.u)[i];
      for (; from < to; ++from) total.count += around_.skipped[from] == 0 ? 1 : 0;
      windows_.fits[w][size].radius = std::sqrt(neighbors[to - 1].squared_distance);
      windows_.fits[w][size].count = total.count;
      if (size > Windows::base_size) {
        const double side =
            std::hypot(total.sums.u, total.sums.v) / total.count * windows_.radius[w] / windows_.fits[w][size].radius;
        windows_.one_sided[w] = size == Windows::base_size + 1 ? side : std::min(windows_.one_sided[w], side);
      }
      queue_.add(w, size, total);
    }
  }

  PointsView points_;
  Windows& windows_;
  CloudOptions options_;
  NeighborhoodFinder finder_;
  ListedSearch search_;
  FitQueue queue_;
  std::array<Neighborhood, NeighborhoodFinder::most_planes> neighborhoods_;
  std::array<OffsetBuffer, NeighborhoodFinder::most_planes> plane_offsets_;
  NeighborhoodScratch plane_scratch_;
  WindowNeighbors around_;
  Buffer<int> again_;
};

}  // namespace

void Windows::resize(Eigen::Index n, int by) {
  stride = by;
  const auto size = static_cast<std::size_t>((n + by - 1) / by);
  base.assign(size, first_base);
  is_copy.assign(size, 0);
  normal.resize(static_cast<Eigen::Index>(size));
  radius.resize(size);
  thickness.resize(size);
  line.resize(size);
  split.resize(size);
  one_sided.resize(size);
  fits.resize(size);
  near.resize(size);
  middle.resize(size);
  far.resize(size);
}

void Windows::copy(int other, int w) {
  is_copy[w] = 1;
  base[w] = base[other];
  normal.row(w) = normal.row(other);
  radius[w] = radius[other];
  thickness[w] = thickness[other];
  line[w] = line[other];
  split[w] = split[other];
  one_sided[w] = one_sided[other];
  fits[w] = fits[other];
  near[w] = near[other];
  middle[w] = middle[other];
  far[w] = far[other];
}

double Windows::spacing(int w) const {
  return radius[w] * std::sqrt(std::numbers::pi / base[w]);
}

void WindowNeighbors::take(const PointsView& points, const Windows& windows, int w, std::span<const Neighbor> neighbors,
                           const Buffer<std::uint8_t>& left_out) {
  all = neighbors;
  const int p = windows.pointOf(w);
  offsets.take(points, p, all);
  const int count = static_cast<int>(all.size());
  heights.resize(static_cast<std::size_t>(toPackets(count)));
  const Eigen::Vector3d normal = windows.normal.row(w).transpose();
  const HeightRange range =
      kernels().connectedHeights(offsets.view(), normal.data(), sheet_gap * windows.radius[w], heights.data());
  skipped.resize(all.size());
  for (int i = 0; i < count; ++i) {
    const bool is_out = !left_out.empty() && left_out[all[i].index] != 0;
    skipped[i] = is_out || heights[i] < range.lowest || heights[i] > range.highest ? 1 : 0;
    if (skipped[i] != 0) offsets.clear(i);
  }
}

void WindowFitter::take(std::span<const int> which, Windows& windows, NeighborLists* lists) const {
  const int first = lists == nullptr ? 0 : lists->addBlocks((std::ssize(which) + costly_block - 1) / costly_block);
  workers_.forBlocks("noise", std::ssize(which), costly_block, [&](std::int64_t begin, std::int64_t end, int) {
    BlockFitter(points_, source_, windows)
        .take(which.subspan(begin, end - begin), lists, first + static_cast<int>(begin / costly_block));
  });
}

void WindowFitter::refit(std::span<const int> which, NeighborLists& lists, const Buffer<std::uint8_t>& left_out,
                         Windows& windows) const {
  workers_.forBlocks("noise", std::ssize(which), costly_block, [&](std::int64_t begin, std::int64_t end, int) {
    BlockFitter(points_, source_, windows).refit(which.subspan(begin, end - begin), lists, left_out);
  });
}

void WindowFitter::spreadPools(std::span<const int> which, const NeighborLists& lists, Windows& windows) const {
  workers_.forBlocks("noise", std::ssize(which), costly_block, [&](std::int64_t begin, std::int64_t end, int) {
    Buffer<int> kept;
    for (const int w : which.subspan(begin, end - begin)) spreadAll(w, lists.of(w), lists.skippedOf(w), kept, windows);
  });
}

}  // namespace tufted
