#include "denoise/moves.h"

#include <algorithm>

#include "denoise/crease_moves.h"
#include "denoise/listed_search.h"
#include "denoise/window_choice.h"
#include "stars/displacements.h"
#include "stars/tangent_frame.h"

namespace tufted {
namespace {

/// Fits in all windows of the noisy points, and of those that their decisions are averaged over.
void fitNoisy(const WindowFitter& fitter, const NoiseLevel& noise, const Workers& workers, Windows& windows) {
  const int n = windows.size();
  const Buffer<int> noisy = numbersWhere("noise", n, workers, [&](int p) { return noise.noisy[p] != 0; });
  fitter.fitAll(noisy, noise.outlier, windows);
  Buffer<std::uint8_t> asked(windows.base.size(), 0);
  for (const int p : noisy)
    for (const Windows::Pool* const pool : {&windows.near[p], &windows.middle[p], &windows.far[p]})
      for (const int q : *pool) asked[q] = 1;
  const Buffer<int> others =
      numbersWhere("noise", n, workers, [&](int p) { return asked[p] != 0 && noise.noisy[p] == 0; });
  fitter.fitAll(others, noise.outlier, windows);
}

/// Moves points once more, by their windows as before, onto the surface through where their neighbours are by now.
void moveAgain(const PointsView& points, const NeighborSource& source, const Windows& windows, const NoiseLevel& noise,
               std::span<const int> which, const WindowChoice& choice, const Workers& workers, PointBuffer& move) {
  const PointBuffer before = move;
  workers.forBlocks("noise", std::ssize(which), costly_block, [&](std::int64_t begin, std::int64_t end, int) {
    WindowNeighbors around;
    Buffer<int> kept;
    OffsetBuffer offsets;
    const auto windowOf = [&](int p) { return windows.base[p] / 2 << choice.window[p]; };
    const auto count = [&](int p) { return std::max(windows.base[p], windowOf(p)); };
    ListedSearch search(points, *source.search, windows);
    search.forEach(which.subspan(begin, end - begin), count, [&](int p, std::span<const Neighbor> neighbors) {
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

}  // namespace

SurfaceMoves surfaceMoves(const PointsView& points, const NeighborSource& source, const Workers& workers) {
  SurfaceMoves result;
  const auto n = static_cast<int>(points.rows());
  result.move.setZero(n);
  if (n <= Windows::first_base) return result;
  const WindowFitter fitter(points, source, workers);
  Windows windows;
  result.noise = findNoise(fitter, workers, windows);
  const NoiseLevel& noise = result.noise;
  if (std::ranges::find(noise.noisy, 1) == noise.noisy.end()) return result;

  fitNoisy(fitter, noise, workers, windows);
  const WindowChoice choice = chooseWindows(windows, noise, workers);
  for (int p = 0; p < n; ++p)
    if (choice.window[p] >= 0) result.move.row(p) = windows.fits[p][choice.window[p]].height * windows.normal.row(p);
  const Buffer<std::uint8_t> next_to_crease =
      moveNextToCreases(points, source, windows, noise, choice, workers, result.move);
  for (int p = 0; p < n; ++p)
    if (next_to_crease[p] != 0) result.noise.outlier[p] = 0;  // it only looked like one next to a crease
  const Buffer<int> again =
      numbersWhere("noise", n, workers, [&](int p) { return choice.window[p] >= 1 && next_to_crease[p] == 0; });
  moveAgain(points, source, windows, noise, again, choice, workers, result.move);
  return result;
}

}  // namespace tufted
