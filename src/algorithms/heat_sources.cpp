#include "algorithms/heat_sources.h"

#include <Eigen/Geometry>

#include "tufted/errors.h"

namespace tufted {
namespace {

/// A vector whose projection into the tangent plane is shorter than this part of it has no direction there.
constexpr double least_tangential = 1e-6;

}  // namespace

void checkSources(const char* function, const std::vector<int>& sources, const char* what,
                  const Eigen::Ref<const Eigen::MatrixXd>& values) {
  const std::string name = std::string(function) + ": ";
  if (sources.empty()) throw InvalidInput(name + "sources is empty, must name at least one");
  if (values.rows() != std::ssize(sources))
    throw InvalidInput(name + what + " has " + std::to_string(values.rows()) + " rows, must have " +
                       std::to_string(sources.size()) + ", one per source");
  for (Eigen::Index s = 0; s < values.rows(); ++s)
    if (!values.row(s).allFinite())
      throw InvalidInput(name + "row " + std::to_string(s) + " of " + what + " is not finite, must be");
}

void checkHeat(const char* function, const FieldHeat& heat, const std::vector<int>& sources, const HeatFields& start) {
  if ((start.scalars.col(0).array() > 0).any()) return;
  throw InvalidInput(std::string(function) + ": no source lies on a component, must be at least one active point: " +
                     heat.whyIgnored(sources[0]));
}

Eigen::Vector2d inTangentPlane(const std::string& name, const Frames& frames, int point,
                               const Eigen::RowVector3d& vector) {
  const double length = vector.stableNorm();
  if (length == 0) return Eigen::Vector2d::Zero();
  const Eigen::RowVector3d normal = frames.normals.row(point), x = frames.tangents.row(point);
  const Eigen::RowVector3d direction = vector / length;
  const Eigen::Vector2d tangential(x.dot(direction), normal.cross(x).dot(direction));
  if (!(tangential.norm() > least_tangential))
    throw InvalidInput(name + " stands on the tangent plane, must have a direction in it");
  return length * tangential;
}

}  // namespace tufted
