#include <memory>
#include <string>
#include <utility>

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "base/stage_clock.h"
#include "cover/cover.h"
#include "direct/star_areas.h"
#include "neighbors/morton.h"
#include "pipeline/build.h"
#include "pipeline/cloud_options.h"
#include "pipeline/cloud_surface.h"
#include "pipeline/from_cover.h"
#include "pipeline/from_stars.h"
#include "pipeline/point_results.h"
#include "pipeline/result.h"
#include "pipeline/union_cover.h"
#include "stars/surface_stars.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

constexpr const char* point_cloud_laplacian_name = "pointCloudLaplacian";

/// Greatest number of link entries of all stars: somewhat less than the greatest number of triangles, since flips
/// reserve some.
constexpr std::int64_t most_entries = most_triangles - most_triangles / 64;

[[noreturn]] void tooMany(std::int64_t points, std::int64_t entries) {
  throw InvalidInput(std::string(point_cloud_laplacian_name) + ": " + std::to_string(points) + " points with " +
                     std::to_string(entries) + " neighbours in their stars, must be at most " +
                     std::to_string(most_entries) + " neighbours (about 58 million points)");
}

/// Algorithms 1 to 3 on the whole cover.
void finishFromWholeCover(SurfaceStars built, const RankedCloud& cloud, const CloudOptions& options,
                          const Workers& workers, StageClock& clock, Laplacian& result) {
  release(built.support.radius);
  std::shared_ptr<StoredCover> stored = takeCover(result);
  IntrinsicTriangulation& cover = stored->triangulation;
  addStars(built.stars, options.paper.gluing, cover, workers);
  built = {};
  glueEdges(cover, cloud.points, {options.paper.order, options.paper.seed}, workers);
  clock.finish("cover", bytesOfCover(cover));
  finishFromCover(std::move(stored), {cloud.points, cloud.input_index, cloud.exponent}, options.mollify,
                  options.keep_cover, workers, clock, result);
}

}  // namespace

Laplacian pointCloudLaplacian(const PointsRef& points, const CloudOptions& options) {
  Laplacian result;
  buildCloudLaplacian(points, options, CloudBuild::automatic, result);
  return result;
}

void buildCloudLaplacian(const PointsRef& points, const CloudOptions& options, CloudBuild build, Laplacian& result,
                         CloudPart* part) {
  checkCloudOptions(point_cloud_laplacian_name, points, options);
  if (points.rows() > INT32_MAX) tooMany(points.rows(), 6 * points.rows());
  const Workers workers(options.threads, options.progress);
  restart(result, Kind::cloud, points.rows(), workers);
  StageClock clock(result.report);

  // Equal points become one, the others are scaled and sorted along a curve, so that near points are close in memory.
  RankedCloud cloud =
      rankPoints(points, result.status, result.representative, workers, part != nullptr ? &part->scaling() : nullptr);
  if (cloud.size() > most_entries / 6) tooMany(cloud.size(), 6 * static_cast<std::int64_t>(cloud.size()));
  clock.finish("order", static_cast<std::size_t>(cloud.size()) * (3 * sizeof(double) + sizeof(int)));

  // The local Delaunay triangulation of each point (Section 5.7), and where the surface ends.
  const Eigen::Vector3d* viewpoint = options.viewpoint;
  if (viewpoint == nullptr && options.structure != nullptr) viewpoint = &options.structure->origin;
  CloudSurface surface =
      findSurface(cloud, options, viewpoint, result.status, result.representative, workers, clock, result.report);
  SurfaceStars built = std::move(surface.built);
  if (part != nullptr) part->takeStars(built, cloud);
  release(built.support.reach);
  release(built.support.boundary_reach);
  if (std::ssize(built.stars.link) > most_entries) tooMany(cloud.size(), std::ssize(built.stars.link));

  // Normals, their orientation, and the positions between which lengths are measured.
  setBoundaryAndNormals(surface.boundary, built.support.normals, cloud, workers, result);
  release(surface.boundary);
  setPositions(points, cloud, workers, result);
  setNoise(surface.noise, cloud, result);
  release(surface.noise);
  cloud.move = {};
  result.frames.orientation = options.normals != nullptr ? Orientation::given : Orientation::arbitrary;
  if (options.normals == nullptr && viewpoint != nullptr) faceViewpoint(*viewpoint, workers, result);
  built.support.normals = {};
  release(built.support.fit_radius);
  release(built.support.isolated);
  clock.finish("boundary", 0);

  // The union of all stars, glued to its tufted cover (Algorithm 1), measured and mollified (Section 4.5), flipped to
  // intrinsic Delaunay (Algorithm 2), and L and M (Algorithm 3): straight from the stars where these agree.
  const int exponent = cloud.exponent;
  Buffer<int> input_index;
  RawBuffer<double> own;
  if (options.steps.mass == Mass::star) {
    input_index = cloud.input_index;
    own = ownAreas(built.stars, cloud.points, workers);
  }
  clock.finish("mass", bytesOf(own));
  if (options.paper.gluing == Gluing::star && options.paper.order == FaceOrder::angle &&
      build == CloudBuild::automatic) {
    result.cover_source.reset();
    // Flat triangles and endless flips are so rare that starting again costs less than keeping the stars.
    if (!finishFromStars(std::move(built), std::move(cloud), options, workers, clock, result))
      return buildCloudLaplacian(points, options, CloudBuild::whole_cover, result, part);
  } else {
    finishFromWholeCover(std::move(built), cloud, options, workers, clock, result);
  }
  setOwnAreas(own, input_index, exponent, result);
  setTangents(workers, result);
  clock.finish("tangents", static_cast<std::size_t>(result.frames.tangents.size()) * sizeof(double));
  workers.report("done", 1);
}

}  // namespace tufted
