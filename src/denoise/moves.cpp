#include "denoise/moves.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <utility>

#include "denoise/crease_moves.h"
#include "denoise/middle_windows.h"
#include "denoise/neighbor_lists.h"
#include "denoise/pooling.h"
#include "denoise/quadratic_fit.h"
#include "denoise/rim_moves.h"
#include "denoise/shared_surfaces.h"
#include "denoise/window_choice.h"
#include "denoise/window_surface.h"
#include "stars/tangent_frame.h"

namespace tufted {
namespace {

constexpr int points_per_stride = 500;  // of small clouds every point has windows
constexpr int fitted_near = 3;          // windows of a settled point next to others; it is in no wider window of theirs
enum : std::uint8_t { reached_near = 1, reached_far = 2 };  // among the neighbours of points alone

/// Moves points once more, by their windows as before, onto the surface through where their neighbours are by now.
void moveAgain(const PointsView& points, const NeighborLists& lists, const Windows& windows, const NoiseLevel& noise,
               std::span<const int> which, const WindowChoice& choice, const Workers& workers, PointBuffer& move) {
  const PointBuffer before = move;
  workers.forBlocks("noise", std::ssize(which), costly_block, [&](std::int64_t begin, std::int64_t end, int) {
    WindowNeighbors around;
    Buffer<int> kept;
    OffsetBuffer offsets;
    const auto windowOf = [&](int p) { return windows.base[p] / 2 << choice.window[p]; };
    const auto count = [&](int p) { return std::max(windows.base[p], windowOf(p)); };
    lists.forEach(points, windows, which.subspan(begin, end - begin), count, [&](int p, auto neighbors) {
      const int base = windows.base[p], window = windowOf(p);
      around.take(points, windows, p, neighbors, noise.outlier);
      kept.clear();
      std::size_t in_base = 0, in_window = 0;
      for (int j = 0; j < std::ssize(around.all); ++j) {
        if (around.skipped[j] == 0) kept.push_back(around.all[j].index);
        if (j + 1 == base) in_base = kept.size();
        if (j + 1 == window) in_window = kept.size();
      }
      takeMoved(points, before, p, std::span(kept).first(in_base), offsets);
      const Eigen::Vector3d normal = principalAxes(offsets.view()).normal;
      takeMoved(points, before, p, std::span(kept).first(in_window), offsets);
      const HeightMoments moments = heightMoments(offsets.view(), normal, windows.radius[p]);
      HeightFit fit;
      fitHeights({&moments, 1}, {&fit, 1});
      if (fit.is_valid) move.row(p) += fit.height * normal.transpose();
    });
  });
}

/// Marks the neighbours of some points.
/// @returns n, reached_near or reached_far, or 0
Buffer<std::uint8_t> reachedFrom(std::span<const int> from, const NeighborLists& lists, const Windows& windows,
                                 const Workers& workers) {
  Buffer<std::uint8_t> reached(windows.base.size(), 0);
  workers.forBlocks("noise", std::ssize(from), usual_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (const int p : from.subspan(begin, end - begin)) {
      const std::span<const int> all = lists.of(p);
      const auto near = std::min<std::size_t>(all.size(), windows.base[p] / 2 << (fitted_near - 1));
      for (const int q : all.first(near)) std::atomic_ref(reached[q]).fetch_or(reached_near, std::memory_order_relaxed);
      for (const int q : all.subspan(near))
        std::atomic_ref(reached[q]).fetch_or(reached_far, std::memory_order_relaxed);
    }
  });
  for (std::uint8_t& how : reached)
    if ((how & reached_near) != 0) how = reached_near;
  return reached;
}

/// The normals of the surface around points, of the windows that were chosen.
void findNormals(std::span<const int> which, const Windows& windows, const WindowChoice& choice, const Workers& workers,
                 PointBuffer& normals) {
  workers.forBlocks("noise", std::ssize(which), star_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (const int p : which.subspan(begin, end - begin)) {
      const int window = std::max(choice.window[p], Windows::base_size);
      normals.row(p) = surfaceAt(windows, p, window, Eigen::Vector3d::Zero()).normal.transpose();
    }
  });
}

/// Moves the points that the shared surfaces have not settled, each by windows of its own.
void moveAlone(const PointsView& points, const WindowFitter& fitter, const Windows& around_some,
               const NoiseLevel& noise_of_some, const SharedSurfaces& shared, const Workers& workers,
               SurfaceMoves& result) {
  const auto n = static_cast<int>(points.rows());
  const Buffer<int> alone = numbersWhere("noise", n, workers, [&](int p) { return shared.settled[p] == 0; });
  if (alone.empty()) return;
  Windows windows;
  windows.resize(n, 1);
  NoiseLevel noise;
  noise.variance = std::move(result.variance);
  noise.outlier = std::move(result.outlier);
  noise.noisy.resize(shared.settled.size());
  for (int p = 0; p < n; ++p) {
    windows.base[p] = around_some.base[shared.nearest[p]];
    noise.noisy[p] = noise_of_some.noisy[shared.nearest[p]];
  }
  NeighborLists lists(n);
  fitter.take(alone, windows, &lists);
  const Buffer<std::uint8_t> reached = reachedFrom(alone, lists, windows, workers);
  const auto settledWhere = [&](std::uint8_t how) {
    return numbersWhere("noise", n, workers, [&](int p) { return reached[p] == how && shared.settled[p] != 0; });
  };
  const Buffer<int> near = settledWhere(reached_near), far = settledWhere(reached_far);
  for (const int p : far) windows.fits[p] = {};
  windows.fitted = fitted_near;
  fitter.take(near, windows, &lists);
  windows.fitted = Windows::searched;
  const Buffer<int> asked =
      numbersWhere("noise", n, workers, [&](int p) { return reached[p] == reached_near || shared.settled[p] == 0; });
  findOutliers(fitter, asked, lists, workers, windows, noise);
  fitter.spreadPools(alone, lists, windows);

  WindowChoice choice = chooseWindows(windows, noise, alone, workers);
  for (const Buffer<int>* const others : {&near, &far})
    for (const int p : *others)
      choice.window[p] = noise.noisy[p] != 0 ? Windows::base_size : -1;  // the surface is smooth there
  for (const int p : alone)
    if (choice.window[p] >= 0) result.move.row(p) = windows.fits[p][choice.window[p]].height * windows.normal.row(p);
  PointBuffer normals(n);
  findNormals(asked, windows, choice, workers, normals);
  workers.forBlocks("noise", std::ssize(far), star_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (const int p : std::span(far).subspan(begin, end - begin)) {
      const int w = shared.nearest[p];
      const Eigen::Vector3d d = (points.row(p) - points.row(around_some.pointOf(w))).transpose();
      normals.row(p) = surfaceAt(around_some, w, Windows::base_size, d).normal.transpose();
    }
  });
  const Buffer<int> all =
      numbersWhere("noise", n, workers, [&](int p) { return reached[p] != 0 || shared.settled[p] == 0; });
  const Buffer<std::uint8_t> next_to_crease =
      moveNextToCreases(points, lists, windows, noise, choice, alone, all, workers, normals, result.move);
  for (const int p : alone)
    if (next_to_crease[p] != 0) noise.outlier[p] = 0;  // it only looked like one next to a crease
  const Buffer<int> again = listedWhere(alone, workers, [&](int p) {
    return choice.window[p] >= Windows::base_size && choice.biased[p] == 0 && next_to_crease[p] == 0;
  });
  moveAgain(points, lists, windows, noise, again, choice, workers, result.move);
  result.variance = std::move(noise.variance);
  result.outlier = std::move(noise.outlier);
}

}  // namespace

NeighborSource windowSource(std::unique_ptr<NeighborSearch> search, int n) {
  NeighborSource source;
  source.k = std::min(Windows::first_base, std::max(0, n - 1));
  source.search = std::move(search);
  return source;
}

SurfaceMoves surfaceMoves(const PointsView& points, const NeighborSource& source, const Workers& workers) {
  SurfaceMoves result;
  const auto n = static_cast<int>(points.rows());
  result.move.setZero(n);
  result.variance.resize(static_cast<std::size_t>(n));
  result.outlier.assign(static_cast<std::size_t>(n), 0);
  if (n <= Windows::first_base) return result;
  const WindowFitter fitter(points, source, workers);
  Windows windows;
  const int stride = std::clamp(n / points_per_stride, 1, Windows::widest_stride);
  windows.resize(n, static_cast<int>(std::bit_floor(static_cast<unsigned>(stride))));
  NeighborLists lists(windows.size());
  const NoiseLevel noise = findNoise(fitter, workers, windows, lists);
  const auto countStaying = [&] {
    for (int p = 0; p < n; ++p)
      result.no_surface += noise.no_surface[p / windows.stride] != 0 && result.move.row(p).isZero(0) ? 1 : 0;
  };
  if (std::ranges::find(noise.noisy, 1) == noise.noisy.end()) {
    countStaying();
    return result;
  }

  if (windows.stride > 1) fitThroughMiddles(points, workers, windows);
  const WindowChoice choice = chooseWindows(windows, noise, allOf(windows), workers);
  const SharedSurfaces shared =
      shareSurfaces(points, source, lists, windows, noise, choice, workers, result.move, result.variance);
  moveAlone(points, fitter, windows, noise, shared, workers, result);
  moveOntoRims(points, source, windows, noise, choice, workers, result.move);
  countStaying();
  return result;
}

std::int64_t SurfaceMoves::count() const {
  std::int64_t moved = 0;
  for (int p = 0; p < move.rows(); ++p) moved += move.row(p).isZero(0) ? 0 : 1;
  return moved;
}

}  // namespace tufted
