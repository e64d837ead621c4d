#include "pipeline/result.h"

#include <atomic>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/cover_source.h"
#include "base/number_text.h"
#include "base/power_of_two.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

void countBoundary(Boundary boundary, Report& report) {
  report.rim_points += boundary == Boundary::rim ? 1 : 0;
  report.jump_points += boundary == Boundary::jump ? 1 : 0;
  report.lost_points += boundary == Boundary::lost ? 1 : 0;
}

/// Frees arrays that have another number of rows. If Eigen finds no memory for a new size, its array still points to
/// the memory of the old one, which is freed already, and frees it again in the end.
template <class... Arrays>
void freeUnlessSized(Eigen::Index rows, Arrays&... arrays) {
  const auto freeOne = [rows](auto& array) {
    if (array.rows() != rows) array.resize(0, array.cols());
  };
  (freeOne(arrays), ...);
}

}  // namespace

void checkBuild(const char* function, double mollify, int threads) {
  if (!(mollify >= 0 && mollify <= 1))
    throw InvalidInput(std::string(function) + ": mollify = " + numberText(mollify) + ", must lie in [0, 1]");
  if (threads < 0)
    throw InvalidInput(std::string(function) + ": threads = " + std::to_string(threads) + ", must be >= 0");
}

void restart(Laplacian& result, Kind kind, std::int64_t points, const Workers& workers) {
  result.kind = kind;
  if (result.hasCover() && result.cover_source->stored() == nullptr) result.cover_source.reset();
  result.component.clear();
  freeUnlessSized(points, result.M, result.cover_areas, result.frames.normals, result.frames.tangents, result.positions,
                  result.noise);
  std::vector<StageCost> stages = std::move(result.report.stages);
  stages.clear();
  result.report = {};
  result.report.stages = std::move(stages);
  result.report.points = points;
  result.report.threads = workers.count();
}

std::shared_ptr<StoredCover> takeCover(Laplacian& result) {
  const auto source = std::exchange(result.cover_source, nullptr);
  if (source == nullptr || source->stored() == nullptr || source.use_count() != 1)
    return std::make_shared<StoredCover>(IntrinsicTriangulation());
  std::atomic_thread_fence(std::memory_order_acquire);  // synchronises with the last other owner
  return std::const_pointer_cast<StoredCover>(std::static_pointer_cast<const StoredCover>(source));
}

void finishResult(const BuildFigures& figures, int exponent, Laplacian& result) {
  Report& report = result.report;

  // Exact conversion from units of 2^exponent.
  const PowerOfTwo area_unit(2 * exponent);
  for (double& mass : result.M) mass = area_unit.times(mass);
  result.cover_areas = result.M;
  report.area = report.cover_area = result.M.sum();
  if (result.component.size() != result.status.size()) result.component.assign(result.status.size(), -1);
  for (std::size_t i = 0; i < result.status.size(); ++i) {
    const bool has_row = result.L.outerIndexPtr()[i] != result.L.outerIndexPtr()[i + 1];
    if (result.status[i] == PointStatus::active && !has_row) result.status[i] = PointStatus::isolated;
    // A representative comes before its coincident points, so its values are final.
    if (result.status[i] == PointStatus::coincident) {
      result.boundary[i] = result.boundary[result.representative[i]];
      result.component[i] = result.component[result.representative[i]];
    } else if (result.status[i] != PointStatus::active) {
      result.boundary[i] = Boundary::none;
    } else {
      countBoundary(result.boundary[i], report);
    }
    report.active += result.status[i] == PointStatus::active ? 1 : 0;
    report.not_finite += result.status[i] == PointStatus::not_finite ? 1 : 0;
    report.coincident += result.status[i] == PointStatus::coincident ? 1 : 0;
    report.isolated += result.status[i] == PointStatus::isolated ? 1 : 0;
  }
  report.triangles = figures.triangles;
  report.mean_edge = std::ldexp(figures.mean.length, exponent);
  report.mean_squared_edge = std::ldexp(figures.mean.square, 2 * exponent);
  report.lengthened_edges = figures.lengthened_edges;
  report.area_added = area_unit.times(figures.area_added);
  result.component_edges.assign(figures.by_component.begin(), figures.by_component.end());
  if (report.components == 1)
    result.component_edges = {{3 * figures.triangles, figures.mean.length, figures.mean.square}};
  for (ComponentEdges& edges : result.component_edges) {
    edges.mean = std::ldexp(edges.mean, exponent);
    edges.mean_square = std::ldexp(edges.mean_square, 2 * exponent);
  }
  report.flips = figures.flips.flips;
  report.flip_failures = figures.flips.failures;
}

std::size_t bytesOfMatrices(const Laplacian& result) {
  return static_cast<std::size_t>(result.L.nonZeros()) * (sizeof(double) + sizeof(int)) +
         result.status.size() * (sizeof(int) + sizeof(double));
}

const IntrinsicTriangulation& Laplacian::cover() const {
  if (cover_source) return cover_source->cover();
  throw InvalidInput("Laplacian::cover: keep_cover = false, must be true to ask for the cover");
}

void Laplacian::setCover(IntrinsicTriangulation cover) {
  cover_source = std::make_shared<StoredCover>(std::move(cover));
}

}  // namespace tufted
