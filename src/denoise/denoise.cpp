#include "tufted/denoise.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/median.h"
#include "base/power_of_two.h"
#include "base/stage_clock.h"
#include "denoise/moves.h"
#include "depth_image/image_stars.h"
#include "neighbors/morton.h"
#include "neighbors/neighbors.h"
#include "neighbors/scan/ranked_scan.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

constexpr const char* denoise_name = "denoise";

void check(const PointsRef& points, const DenoiseOptions& options) {
  if (options.threads < 0)
    throw InvalidInput(std::string(denoise_name) + ": threads is " + std::to_string(options.threads) +
                       ", must be at least 0");
  if (points.rows() > INT32_MAX)
    throw InvalidInput(std::string(denoise_name) + ": " + std::to_string(points.rows()) +
                       " points, must be less than 2^31");
  if (options.structure != nullptr && options.structure->has_rings)
    throw InvalidInput(std::string(denoise_name) + ": structure has rings, must be that of a depth image");
}

/// Moves the points of `denoised`, which are the caller's, and reports it.
/// @param moves n x 3, or 0 x 3 if no point moves
/// @param deviation deviation(p): standard deviation of the noise around a point that moves
template <class Deviation>
void apply(const PointBuffer& moves, const Deviation& deviation, const RankedCloud& cloud, DenoisedPoints& denoised) {
  const PowerOfTwo unit(cloud.exponent);
  DenoiseReport& report = denoised.report;
  Buffer<double> noise;
  double way = 0;
  for (int p = 0; p < moves.rows(); ++p) {
    const Eigen::RowVector3d move = moves.row(p);
    if (move.isZero(0)) continue;
    const int i = cloud.input_index[p];
    for (int axis = 0; axis < 3; ++axis) unit.addTo(denoised.positions(i, axis), move[axis]);
    denoised.noise[i] = unit.times(deviation(p));
    noise.push_back(denoised.noise[i]);
    const double length = unit.times(move.norm());
    way += length;
    report.farthest_move = std::max(report.farthest_move, length);
  }
  report.moved = std::ssize(noise);
  if (report.moved > 0) report.mean_move = way / static_cast<double>(report.moved);
  report.noise = medianOf(std::move(noise));
}

void moveOntoSurface(const RankedCloud& cloud, const Workers& workers, DenoisedPoints& denoised) {
  const SurfaceMoves moves = surfaceMoves(cloud.points, {}, NeighborSearch(cloud.points, workers), workers);
  apply(
      moves.move, [&](int p) { return std::sqrt(moves.variance[p]); }, cloud, denoised);
  denoised.report.no_surface = moves.no_surface;
  denoised.report.outliers = std::count(moves.outlier.begin(), moves.outlier.end(), 1);
}

void moveAlongRays(const RankedScan& scan, const RankedCloud& cloud, const Workers& workers, DenoisedPoints& denoised) {
  PixelGrid grid = pixelGrid(scan);
  denoised.report.sparse_share = sparseShare(grid);
  const SurfaceImage image = surfaceImage(std::move(grid), cloud.points, true, workers);
  const auto noiseOf = [&](int p) { return image.noiseOf(p, cloud.points); };
  apply(image.windows.displacement, noiseOf, cloud, denoised);
  denoised.report.unplaced = image.unplaced;
  const Buffer<std::uint64_t>& around = image.windows.around;
  denoised.report.outliers = std::count(around.begin(), around.end(), 0) - image.unplaced;
}

}  // namespace

DenoisedPoints denoise(const PointsRef& points, const DenoiseOptions& options) {
  const Stopwatch watch;
  check(points, options);
  const Workers workers(options.threads, options.progress);
  DenoisedPoints denoised{.positions = points, .noise = VectorXd::Zero(points.rows()), .report = {}};
  std::vector<PointStatus> status;
  std::vector<int> representative;
  const RankedCloud cloud = rankPoints(points, status, representative, workers);

  if (options.structure != nullptr) {
    moveAlongRays(rankScan(*options.structure, cloud, status, representative, denoise_name), cloud, workers, denoised);
  } else {
    moveOntoSurface(cloud, workers, denoised);
  }

  denoised.report.points = points.rows();
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    if (status[i] == PointStatus::not_finite) ++denoised.report.not_finite;
    if (status[i] != PointStatus::coincident) continue;
    ++denoised.report.coincident;
    denoised.positions.row(i) = denoised.positions.row(representative[i]);
    denoised.noise[i] = denoised.noise[representative[i]];
  }
  workers.report("done", 1);
  denoised.report.seconds = watch.seconds();
  return denoised;
}

}  // namespace tufted
