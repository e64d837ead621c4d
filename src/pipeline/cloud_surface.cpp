#include "pipeline/cloud_surface.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "base/buffer.h"
#include "base/median.h"
#include "base/power_of_two.h"
#include "denoise/moves.h"
#include "depth_image/image_boundary.h"
#include "depth_image/image_stars.h"
#include "depth_image/ring_columns.h"
#include "neighbors/neighbor_source.h"
#include "stars/boundary.h"

namespace tufted {
namespace {

/// The noise around each point, see CloudSurface::noise; reports how many points move, and the median.
/// @param moves n x 3, or 0 x 3 if no point moves
/// @param deviation deviation(p): standard deviation around a point that moves
template <class Deviation>
RawBuffer<double> noiseOfMoved(const PointBuffer& moves, const Deviation& deviation, int exponent, Report& report) {
  RawBuffer<double> noise(static_cast<std::size_t>(moves.rows()));
  Buffer<double> of_moved;
  for (int p = 0; p < moves.rows(); ++p) {
    noise[p] = moves.row(p).isZero(0) ? 0 : deviation(p);
    if (!moves.row(p).isZero(0)) of_moved.push_back(noise[p]);
  }
  report.denoised = std::ssize(of_moved);
  if (of_moved.empty()) return {};
  report.noise = PowerOfTwo(exponent).times(medianOf(std::move(of_moved)));
  return noise;
}

/// Finds the stars of a depth image, then moves the points along their rays.
CloudSurface imageSurface(PixelGrid grid, RankedCloud& cloud, const CloudOptions& options, const Workers& workers,
                          StageClock& clock, Report& report) {
  const PointBuffer normals = rankedNormals(options.normals, cloud, report);
  report.neighbors = std::min(WindowPixels::count, std::max(0, cloud.size() - 1));
  SurfaceImage surface = surfaceImage(std::move(grid), cloud.points, options.steps.denoise, workers);
  report.unplaced = surface.unplaced;
  report.cut_neighbors = surface.windows.cut;
  RawBuffer<double> noise = noiseOfMoved(
      surface.windows.displacement, [&](int p) { return surface.noiseOf(p, cloud.points); }, cloud.exponent, report);
  clock.finish("windows", surface.bytes());
  const DepthImage image = surface.view(cloud.points);
  BuiltStars built = buildImageStars(image, normals, options, workers, report);
  clock.finish("stars", built.stars.bytes() + built.support.bytes());
  const bool is_whole_cloud = cloud.size() <= WindowPixels::count + 1;
  // Triangles are filtered by their size between moved points.
  CloudSurface result{
      filteredStars(std::move(built), is_whole_cloud, image.moved, options, workers, report), {}, std::move(noise)};
  clock.restart();
  result.boundary = findImageBoundary(result.built.stars, image, workers);
  if (surface.windows.place.rows() > 0) {
    cloud.points = std::move(surface.windows.place);
    cloud.move = std::move(surface.windows.displacement);
  }
  return result;
}

/// Moves the points of the cloud onto the surface and builds their search anew.
/// @returns see CloudSurface::noise
RawBuffer<double> moveOntoSurface(RankedCloud& cloud, NeighborSource& source, const Workers& workers, Report& report) {
  if (source.search == nullptr || source.isWholeCloud(cloud.size())) return {};
  SurfaceMoves moves = surfaceMoves(cloud.points, source.normals, *source.search, workers);
  if (moves.count() == 0) return {};
  RawBuffer<double> noise = noiseOfMoved(
      moves.move, [&](int p) { return std::sqrt(moves.variance[p]); }, cloud.exponent, report);
  workers.forBlocks("noise", cloud.size(), usual_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t p = begin; p < end; ++p) cloud.points.row(p) += moves.move.row(p);
  });
  source.search = std::make_unique<NeighborSearch>(cloud.points, workers);
  cloud.move = std::move(moves.move);
  return noise;
}

}  // namespace

CloudSurface findSurface(RankedCloud& cloud, const CloudOptions& options, const Eigen::Vector3d* viewpoint,
                         const std::vector<PointStatus>& status, const std::vector<int>& representative,
                         const Workers& workers, StageClock& clock, Report& report) {
  if (options.structure != nullptr) {
    RankedScan scan = rankScan(*options.structure, cloud, status, representative);
    if (!options.structure->has_rings) {
      PixelGrid grid = pixelGrid(scan);
      report.sparse_share = sparseShare(grid);
      return imageSurface(std::move(grid), cloud, options, workers, clock, report);
    }
    const auto image = columnsOfRings(std::move(scan), cloud.points, workers);
    if (image) return imageSurface(pixelGrid(image->scan, image->columns), cloud, options, workers, clock, report);
  }
  NeighborSource source = neighborSource(options, cloud, status, representative, workers, report);
  clock.finish("tree", source.bytes());
  RawBuffer<double> noise;
  if (options.steps.denoise) noise = moveOntoSurface(cloud, source, workers, report);
  clock.finish("noise", cloud.move.bytes());
  CloudSurface result{surfaceStars(cloud, source, options, workers, report), {}, std::move(noise)};
  clock.restart();
  result.boundary = findBoundary(result.built, cloud, source, viewpoint, workers);
  return result;
}

}  // namespace tufted
