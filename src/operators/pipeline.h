#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/buffer.h"
#include "base/number_text.h"
#include "base/parallel.h"
#include "base/point_buffer.h"
#include "base/power_of_two.h"
#include "base/stage_clock.h"
#include "intrinsic/cover.h"
#include "operators/assemble.h"
#include "tufted/errors.h"
#include "tufted/laplacian.h"

namespace tufted {

// What the cloud and the mesh pipeline have in common.

template <class Triangulation>
std::size_t bytesOfCover(const Triangulation& cover) {
  // By size: arrays of an earlier frame may have room for more.
  const auto bytes = [](const auto& values) { return values.size() * sizeof(values[0]); };
  return bytes(cover.faces) + bytes(cover.glue) + bytes(cover.length);
}

/// @throws InvalidInput for options that both entry points share
template <class Options>
void checkCommon(const char* function, const Options& options) {
  if (!(options.mollify >= 0 && options.mollify <= 1)) {
    throw InvalidInput(std::string(function) + ": mollify = " + numberText(options.mollify) + ", must lie in [0, 1]");
  }
  if (options.threads < 0) {
    throw InvalidInput(std::string(function) + ": threads = " + std::to_string(options.threads) + ", must be >= 0");
  }
}

inline void countBoundary(Boundary boundary, Report& report) {
  report.rim_points += boundary == Boundary::rim ? 1 : 0;
  report.jump_points += boundary == Boundary::jump ? 1 : 0;
  report.lost_points += boundary == Boundary::lost ? 1 : 0;
}

/// Forgets the result of another frame, but for the memory of its arrays.
inline void restart(Laplacian& result, Kind kind, std::int64_t points, const Workers& workers) {
  result.kind = kind;
  result.cover_source.reset();
  std::vector<StageCost> stages = std::move(result.report.stages);
  stages.clear();
  result.report = {};
  result.report.stages = std::move(stages);
  result.report.points = points;
  result.report.threads = workers.count();
}

/// The cover of another frame, if nobody else has it, or a new one.
inline std::shared_ptr<IntrinsicTriangulation> takeCover(Laplacian& result) {
  const auto stored = std::exchange(result.stored_cover, nullptr);
  if (stored.use_count() != 1) return std::make_shared<IntrinsicTriangulation>();
  std::atomic_thread_fence(std::memory_order_acquire);  // after all that the last other owner did with it
  return std::const_pointer_cast<IntrinsicTriangulation>(stored);
}

/// What a build knows beside L and M, in units of the points that it worked on.
struct BuildFigures {
  MeanLengths mean = {};
  double mollify_length = 0;
  double mollify_area = 0;
  FlipCounts flips = {};
  std::int64_t triangles = 0;
};

/// Completes the result, which has L and M, in the caller's unit.
/// @param exponent the build's unit is 2^exponent of the caller's
inline void finishResult(const BuildFigures& figures, int exponent, Laplacian& result) {
  Report& report = result.report;

  // Back from units of 2^exponent, which is exact.
  const PowerOfTwo area_unit(2 * exponent);
  for (double& mass : result.M) mass = area_unit.times(mass);
  result.cover_areas = result.M;
  report.area = report.cover_area = result.M.sum();
  for (std::size_t i = 0; i < result.status.size(); ++i) {
    const bool has_row = result.L.outerIndexPtr()[i] != result.L.outerIndexPtr()[i + 1];
    if (result.status[i] == PointStatus::active && !has_row) result.status[i] = PointStatus::isolated;
    // Surfaces end at points of surfaces; a representative comes before the points it stands for.
    if (result.status[i] == PointStatus::coincident)
      result.boundary[i] = result.boundary[result.representative[i]];
    else if (result.status[i] != PointStatus::active)
      result.boundary[i] = Boundary::none;
    else
      countBoundary(result.boundary[i], report);
    report.active += result.status[i] == PointStatus::active ? 1 : 0;
    report.not_finite += result.status[i] == PointStatus::not_finite ? 1 : 0;
    report.coincident += result.status[i] == PointStatus::coincident ? 1 : 0;
    report.isolated += result.status[i] == PointStatus::isolated ? 1 : 0;
  }
  report.triangles = figures.triangles;
  report.mean_edge = std::ldexp(figures.mean.length, exponent);
  report.mean_squared_edge = std::ldexp(figures.mean.square, 2 * exponent);
  report.mollify_length = std::ldexp(figures.mollify_length, exponent);
  report.mollify_area = std::ldexp(figures.mollify_area, 2 * exponent);
  report.flips = figures.flips.flips;
  report.flip_failures = figures.flips.failures;
}

/// Brings a cover into the caller's numbering and unit.
inline void toCaller(IntrinsicTriangulation& cover, const Buffer<int>& caller, int size, int exponent) {
  cover.vertices = size;
  for (auto& face : cover.faces) {
    for (int& corner : face) corner = caller[corner];
  }
  const PowerOfTwo unit(exponent);
  for (double& length : cover.length) length = unit.times(length);
}

inline std::size_t bytesOfMatrices(const Laplacian& result) {
  return static_cast<std::size_t>(result.L.nonZeros()) * (sizeof(double) + sizeof(int)) +
         result.status.size() * (sizeof(int) + sizeof(double));
}

/// Algorithm 3 from the glued cover on: lengths, mollification, flips, matrices, and the cover in the caller's
/// numbering and unit.
/// @param points by vertex of the cover, in units of 2^exponent of the caller's
/// @param move by vertex, from the points to where lengths are measured; 0 x 3: no vertex moves
/// @param caller the caller's index of each vertex
/// @param scale 1/2 for the two sheets, times 1/3 where every triangle comes thrice
template <class Options>
void finishLaplacian(std::shared_ptr<IntrinsicTriangulation> cover, const PointsView& points, const PointsView& move,
                     const Buffer<int>& caller, int exponent, double scale, const Options& options,
                     const Workers& workers, StageClock& clock, Laplacian& result) {
  BuildFigures figures{.mean = measureLengths(*cover, points, move, workers)};
  const Mollification mollified = mollify(*cover, options.mollify * figures.mean.length, workers);
  figures.mollify_length = mollified.length;
  figures.mollify_area = scale * mollified.area;
  figures.triangles = cover->size() / 2;
  clock.finish("lengths", 0);

  figures.flips = flipToDelaunay(*cover, workers);
  clock.finish("flips", 0);

  const int size = static_cast<int>(result.status.size());
  assembleLaplacian(*cover, caller, size, scale, workers, result);
  finishResult(figures, exponent, result);
  if (options.keep_cover) {
    toCaller(*cover, caller, size, exponent);
    result.stored_cover = std::move(cover);
  }
  clock.finish("matrices", bytesOfMatrices(result));
}

}  // namespace tufted
