#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <optional>

#include "base/number_text.h"
#include "base/point_buffer.h"
#include "cloud/boundary.h"
#include "cloud/morton.h"
#include "cloud/neighbor_source.h"
#include "cloud/surface_stars.h"
#include "cloud/tangent_frame.h"
#include "intrinsic/star_areas.h"
#include "intrinsic/star_triangles.h"
#include "operators/build.h"
#include "operators/face_scale.h"
#include "operators/pipeline.h"
#include "operators/star_laplacian.h"

namespace tufted {
namespace {

constexpr std::int64_t block_size = 4096;
constexpr const char* function_name = "pointCloudLaplacian";

void checkOptions(const Points& points, const CloudOptions& options) {
  const auto name = [] { return std::string(function_name); };
  checkCommon(function_name, options);
  if (options.neighbors < 3) {
    throw InvalidInput(name() + ": neighbors = " + std::to_string(options.neighbors) + ", must be at least 3");
  }
  const auto checkRows = [&](const char* what, Eigen::Index rows) {
    if (rows != points.rows()) {
      throw InvalidInput(name() + ": " + what + " has " + std::to_string(rows) + " rows, must have " +
                         std::to_string(points.rows()) + ", one per point");
    }
  };
  if (options.viewpoint != nullptr && !options.viewpoint->allFinite()) {
    const Eigen::Vector3d& v = *options.viewpoint;
    throw InvalidInput(name() + ": viewpoint = " + numberText(v.x()) + " " + numberText(v.y()) + " " +
                       numberText(v.z()) + ", must be finite");
  }
  if (options.normals != nullptr) checkRows("normals", options.normals->rows());
  if (options.structure != nullptr && options.neighborhoods != nullptr) {
    throw InvalidInput(name() + ": structure and neighborhoods are both given, must be one at most");
  }
  if (options.neighborhoods != nullptr) checkRows("neighborhoods", options.neighborhoods->rows());
#ifndef TUFTED_WITH_GPL
  if (options.delaunay == Delaunay::cgal) {
    throw InvalidInput(name() + ": delaunay = cgal, must be star: this library was built without TUFTED_WITH_GPL");
  }
#endif
}

/// Of the links of all stars; somewhat fewer than triangles that have numbers, since flips keep some in reserve.
constexpr std::int64_t most_entries = most_triangles - most_triangles / 64;

[[noreturn]] void tooMany(std::int64_t points, std::int64_t entries) {
  throw InvalidInput(std::string(function_name) + ": " + std::to_string(points) + " points with " +
                     std::to_string(entries) + " neighbours in their stars, must be at most " +
                     std::to_string(most_entries) + " neighbours (about 58 million points)");
}

/// The union of all stars, front and back of every copy of a triangle. With `Gluing::star` the two faces of a star that
/// share a spoke are glued to each other here, front to front and back to back.
void addStars(const Stars& stars, Gluing gluing, IntrinsicTriangulation& cover, const Workers& workers) {
  const int n = stars.size();
  const Buffer<int> first = firstTriangles(stars);
  resizeCover(cover, n, first[n]);
  workers.forBlocks("union", n, block_size, [&](std::int64_t begin, std::int64_t end, int) {
    for (int p = static_cast<int>(begin); p < end; ++p) {
      int t = first[p];
      for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i)
        if (stars.hasTriangle(i)) addTriangle(cover, t++, p, stars.link[i], stars.link[stars.after(p, i)]);
      if (gluing == Gluing::star) glueSpokes(stars, p, first[p], cover);
    }
  });
}

/// Boundary tags and normals in the caller's order; coincident points take the normal of their representative.
void describePoints(const Stars& stars, const Buffer<Boundary>& boundary, const RankedCloud& cloud,
                    const Workers& workers, Laplacian& result) {
  const auto n = static_cast<Eigen::Index>(result.status.size());
  result.boundary.assign(result.status.size(), Boundary::none);
  result.frames.normals.resize(n, 3);
  workers.forBlocks("boundary", stars.size(), block_size, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t p = begin; p < end; ++p) {
      const int i = cloud.caller[p];
      result.boundary[i] = boundary[p];
      result.frames.normals.row(i) = stars.normals.row(p);
    }
  });
  for (Eigen::Index i = 0; i < n; ++i) {
    if (result.status[i] == PointStatus::coincident) {
      result.frames.normals.row(i) = result.frames.normals.row(result.representative[i]);
    } else if (result.status[i] == PointStatus::not_finite) {
      result.frames.normals.row(i).setZero();
    }
  }
}

/// Zero where the normal is.
void takeTangents(const Workers& workers, Laplacian& result) {
  Frames& frames = result.frames;
  frames.tangents.resize(frames.normals.rows(), 3);
  workers.forBlocks("assemble", frames.normals.rows(), block_size, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t i = begin; i < end; ++i) {
      const Eigen::Vector3d normal = frames.normals.row(i);
      frames.tangents.row(i) = normal.isZero(0) ? normal : tangentOf(normal);
    }
  });
}

/// Makes the stars' own areas M where they are positive and the point has a row.
void takeAreas(const OwnAreas& own, const Buffer<int>& caller, int exponent, Laplacian& result) {
  const PowerOfTwo area_unit(2 * exponent);
  for (std::size_t p = 0; p < caller.size(); ++p) {
    const int i = caller[p];
    if (result.status[i] != PointStatus::active) continue;
    if (own.area[p] > 0) result.M[i] = area_unit.times(own.area[p]);
    ++(own.area[p] > 0 ? result.report.star_masses : result.report.cover_masses);
  }
  result.report.bounded_masses = own.bounded;
  result.report.area = result.M.sum();
}

/// Algorithm 3 by the whole cover.
void finishFromCover(Stars stars, const RankedCloud& cloud, const CloudOptions& options, const Workers& workers,
                     StageClock& clock, Laplacian& result) {
  const PointBuffer move = std::move(stars.move);
  release(stars.radius);
  std::shared_ptr<IntrinsicTriangulation> cover = takeCover(result);
  addStars(stars, options.gluing, *cover, workers);
  stars = {};
  glueEdges(*cover, cloud.points, {options.order, options.seed}, workers);
  clock.finish("cover", bytesOfCover(*cover));
  finishLaplacian(std::move(cover), cloud.points, move, cloud.caller, cloud.exponent, faceScale(result.kind), options,
                  workers, clock, result);
}

}  // namespace

Laplacian pointCloudLaplacian(const Points& points, const CloudOptions& options) {
  Laplacian result;
  buildCloudLaplacian(points, options, CloudBuild::automatic, result);
  return result;
}

void buildCloudLaplacian(const Points& points, const CloudOptions& options, CloudBuild build, Laplacian& result) {
  checkOptions(points, options);
  if (points.rows() > INT32_MAX) tooMany(points.rows(), 6 * points.rows());
  const Workers workers(options.threads, options.progress);
  const Eigen::Vector3d* viewpoint = options.viewpoint;
  if (viewpoint == nullptr && options.structure != nullptr) viewpoint = &options.structure->origin;
  restart(result, Kind::cloud, points.rows(), workers);
  Report& report = result.report;
  StageClock clock(report);

  RankedCloud cloud = rankPoints(points, result.status, result.representative, workers);
  if (cloud.size() > most_entries / 6) tooMany(cloud.size(), 6 * static_cast<std::int64_t>(cloud.size()));
  clock.finish("order", static_cast<std::size_t>(cloud.size()) * (3 * sizeof(double) + sizeof(int)));

  NeighborSource source = neighborSource(options, cloud, result.status, result.representative, workers, report);
  clock.finish("tree", source.bytes());

  Stars stars = surfaceStars(cloud, source, options, workers, report);
  clock.restart();  // surfaceStars books its own stages

  describePoints(stars, findBoundary(stars, cloud, source, viewpoint, workers), cloud, workers, result);
  source = {};
  stars.normals = {};
  release(stars.reach);
  clock.finish("boundary", 0);

  const bool has_own_areas = options.steps.mass == Mass::star;
  const Buffer<int> caller = has_own_areas ? cloud.caller : Buffer<int>();
  const int exponent = cloud.exponent;
  if (std::ssize(stars.link) > most_entries) tooMany(stars.size(), std::ssize(stars.link));
  OwnAreas own;
  const bool stars_agree = options.gluing == Gluing::star && options.order == FaceOrder::angle;
  if (stars_agree && build == CloudBuild::automatic) {
    result.stored_cover.reset();
    own = finishFromStars(std::move(stars), std::move(cloud), options, workers, clock, result);
  } else {
    if (has_own_areas) own = ownAreas(stars, cloud.points, workers);
    clock.finish("mass", 0);
    finishFromCover(std::move(stars), cloud, options, workers, clock, result);
  }
  if (has_own_areas) takeAreas(own, caller, exponent, result);
  takeTangents(workers, result);
  clock.finish("tangents", static_cast<std::size_t>(result.frames.tangents.size()) * sizeof(double));
  workers.report("done", 1);
}

CloudSteps cloudSteps(Preset preset) {
  CloudSteps steps;
  if (preset == Preset::clean) {
    steps = {.growth = Growth::line,
             .split_sheets = false,
             .star_search = StarSearch::once,
             .isolate_outliers = false,
             .filter = Filter::radius,
             .lengths = Lengths::points,
             .mass = Mass::cover};
  } else if (preset == Preset::lidar) {
    steps.growth = Growth::uneven;
    steps.split_sheets = false;
  }
  return steps;
}

CloudOptions cloudOptions(Preset preset) {
  return {.steps = cloudSteps(preset)};
}

const IntrinsicTriangulation& Laplacian::cover() const {
  if (stored_cover) return *stored_cover;
  if (cover_source) return cover_source->cover();
  throw InvalidInput("Laplacian::cover: keep_cover = false, must be true to ask for the cover");
}

}  // namespace tufted
