#include "denoise/middle_windows.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "denoise/listed_search.h"
#include "denoise/pooling.h"
#include "simd/kernels.h"
#include "stars/sheets.h"

namespace tufted {
namespace {

/// How many middles the windows hold, where these are as far apart as usual.
constexpr std::array<int, Windows::sizes - Windows::searched> middles_in = {24, 40};
constexpr int in_moving = 2;  // of Windows::fits: the widest that a middle moves onto

/// A middle where its own window says that the surface is.
struct MovedMiddle {
  Eigen::RowVector3d position;
  double leverage;  ///< of the fit it has moved onto
};

/// The middle of window w, moved onto a fit through its neighbours.
MovedMiddle movedMiddle(const PointsView& points, const Windows& windows, int w) {
  const Eigen::RowVector3d at = points.row(windows.pointOf(w));
  for (int size = in_moving; size > 0; --size) {
    const WindowFit& fit = windows.fits[w][size];
    if (fit.is_valid) return {at + fit.height * windows.normal.row(w), fit.leverage};
  }
  return {at, 1};
}

/// Which middles serve a window: those of every 2^step-th window, and `times` as many of them as usual.
struct Spread {
  int step, times;
};

/// A base window of twice as many neighbours stands for twice as many points. Where it is not around a point that has
/// such windows, or there are more windows than usual, it takes more middles instead.
Spread spreadOf(const Windows& windows, int w) {
  const int widened = std::countr_zero(static_cast<unsigned>(windows.base[w] / Windows::first_base));
  const int step = w == 0 ? widened : std::min(widened, std::countr_zero(static_cast<unsigned>(w)));
  return {step, (Windows::widest_stride / windows.stride) << (widened - step)};
}

/// The middles of every 2^step-th window.
struct Middles {
  int step;
  PointBuffer positions;

  Middles(const PointsView& points, const Windows& windows, int of_step) : step(of_step) {
    positions.resize(((windows.size() - 1) >> step) + 1);
    for (int i = 0; i < positions.rows(); ++i) positions.row(i) = points.row(windows.pointOf(windowOf(i)));
  }
  int windowOf(int middle) const { return middle << step; }
};

/// Fits the windows of one block; memory of one worker.
class MiddleFitter {
 public:
  MiddleFitter(const PointsView& points, const RawBuffer<MovedMiddle>& moved, const Middles& middles,
               const NeighborSearch& search, Windows& windows)
      : points_(points), moved_(moved), middles_(middles), search_(middles.positions, search), windows_(windows) {}

  void take(std::span<const int> which) {
    const auto rank = [&](int w) { return w >> middles_.step; };
    const auto count = [&](int w) { return middles_in.back() * spreadOf(windows_, w).times; };
    search_.forEach(which, rank, count, [&](int w, std::span<const Neighbor> neighbors) { sum(w, neighbors); });
    solve(which);
  }

 private:
  /// Finds what the fit around window w is made from.
  void sum(int w, std::span<const Neighbor> neighbors) {
    const int count = static_cast<int>(neighbors.size());
    const Eigen::Vector3d normal = windows_.normal.row(w).transpose();
    offsets_.fill(count, [&](int i) -> Eigen::RowVector3d {
      return moved_[middles_.windowOf(neighbors[i].index)].position - moved_[w].position;
    });
    heights_.resize(static_cast<std::size_t>(toPackets(count)));
    const HeightRange range =
        kernels().connectedHeights(offsets_.view(), normal.data(), sheet_gap * windows_.radius[w], heights_.data());
    kept_.resize(neighbors.size());
    for (int i = 0; i < count; ++i) {
      const bool is_connected = heights_[i] >= range.lowest && heights_[i] <= range.highest;
      kept_[i] = is_connected && windows_.is_copy[middles_.windowOf(neighbors[i].index)] == 0 ? 1 : 0;
      if (kept_[i] == 0) offsets_.clear(i);
    }
    const Offsets all = offsets_.view();
    double leverage = moved_[w].leverage;
    int from = 0, kept = 1;
    for (std::size_t size = 0; size < middles_in.size(); ++size) {
      const int to = std::min(count, middles_in[size] * spreadOf(windows_, w).times);
      HeightMoments moments = heightMoments({to, all.x, all.y, all.z}, normal, windows_.radius[w]);
      for (; from < to; ++from) {
        if (kept_[from] == 0) continue;
        ++kept;
        leverage += moved_[middles_.windowOf(neighbors[from].index)].leverage;
      }
      moments.count = kept;
      WindowFit& fit = windows_.fits[w][Windows::searched + size];
      fit.radius = to > 0 ? std::sqrt(neighbors[to - 1].squared_distance) : 0;
      fit.count = kept;
      moments_.push_back(moments);
      unit_.push_back(leverage / kept);
    }
  }

  void solve(std::span<const int> which) {
    fits_.resize(moments_.size());
    fitHeights(moments_, fits_);
    for (std::size_t i = 0; i < fits_.size(); ++i) {
      const int w = which[i / middles_in.size()];
      HeightFit& fit = fits_[i];
      // From where the middle has moved to back to where it was.
      const double up = (moved_[w].position - points_.row(windows_.pointOf(w))).dot(windows_.normal.row(w));
      fit.coefficient[0] += up / windows_.radius[w];
      fit.height += up;
      // Leverage and variance become those of a fit through all points that the middles stand for.
      fit.leverage /= windows_.stride << middles_.step;
      fit.variance /= unit_[i];
      static_cast<HeightFit&>(windows_.fits[w][Windows::searched + i % middles_in.size()]) = fit;
    }
  }

  PointsView points_;
  const RawBuffer<MovedMiddle>& moved_;
  const Middles& middles_;
  ListedSearch search_;
  Windows& windows_;
  Buffer<std::uint8_t> kept_;
  Buffer<double> heights_, unit_;
  OffsetBuffer offsets_;
  Buffer<HeightMoments> moments_;
  Buffer<HeightFit> fits_;
};

}  // namespace

void fitThroughMiddles(const PointsView& points, const Workers& workers, Windows& windows) {
  RawBuffer<MovedMiddle> moved(windows.base.size());
  forEachPoint(windows, workers, [&](int w) { moved[w] = movedMiddle(points, windows, w); });
  Buffer<int> left = numbersWhere("noise", windows.size(), workers, [&](int w) { return windows.is_copy[w] == 0; });
  for (int step = 0; !left.empty(); ++step) {
    const Buffer<int> here = listedWhere(left, workers, [&](int w) { return spreadOf(windows, w).step == step; });
    if (here.empty()) continue;
    left = listedWhere(left, workers, [&](int w) { return spreadOf(windows, w).step != step; });
    const Middles middles(points, windows, step);
    const NeighborSearch search(middles.positions, workers);
    workers.forBlocks("noise", std::ssize(here), costly_block, [&](std::int64_t begin, std::int64_t end, int) {
      MiddleFitter(points, moved, middles, search, windows).take(std::span(here).subspan(begin, end - begin));
    });
  }
  forEachPoint(windows, workers, [&](int w) {
    if (windows.is_copy[w] == 0) return;
    const auto& fits = windows.fits[windows.copied(w)];
    std::copy(fits.begin() + Windows::searched, fits.end(), windows.fits[w].begin() + Windows::searched);
  });
}

}  // namespace tufted
