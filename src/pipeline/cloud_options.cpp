#include "pipeline/cloud_options.h"

#include <string>

#include "base/number_text.h"
#include "pipeline/result.h"
#include "tufted/errors.h"

namespace tufted {

void checkCloudOptions(const char* function, const PointsRef& points, const CloudOptions& options) {
  const auto name = [&] { return std::string(function); };
  checkBuild(function, options.mollify, options.threads);
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
  if (options.paper.delaunay == Delaunay::cgal) {
    throw InvalidInput(name() + ": delaunay = cgal, must be star: this library was built without TUFTED_WITH_GPL");
  }
#endif
}

CloudSteps cloudSteps(Preset preset) {
  CloudSteps steps;
  if (preset == Preset::clean) {
    steps = {.growth = Growth::line,
             .split_sheets = false,
             .star_search = StarSearch::once,
             .isolate_outliers = false,
             .filter = Filter::radius,
             .settle_diagonals = false,
             .denoise = false,
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

}  // namespace tufted
