#include "structure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>
#include <vector>

#include "tufted/errors.h"

namespace {

/// Negative where the value is no number of a ring.
int ringAt(const tufted::Field& field, std::size_t i) {
  const double value = tufted::valueOf(field, i);
  return value >= 0 && value < (1 << 30) ? static_cast<int>(value) : -1;
}

tufted::ScanStructure ringsOf(const tufted::Geometry& geometry, const std::string& name) {
  const auto& pose = geometry.viewpoint;
  const Eigen::Vector3d origin(pose[0], pose[1], pose[2]);
  const Eigen::Quaterniond turn(pose[3], pose[4], pose[5], pose[6]);
  // In the scanner's frame, whose z axis it turns around.
  const tufted::Points seen = (geometry.points.rowwise() - origin.transpose()) * turn.normalized().toRotationMatrix();
  const auto field = std::find_if(geometry.fields.begin(), geometry.fields.end(),
                                  [](const tufted::Field& f) { return f.name == "ring" && f.count == 1; });
  try {
    if (field == geometry.fields.end()) return tufted::findRings(seen);
    std::vector<int> ring(static_cast<std::size_t>(geometry.points.rows()));
    for (std::size_t i = 0; i < ring.size(); ++i) ring[i] = ringAt(*field, i);
    return tufted::ringStructure(seen, std::move(ring));
  } catch (const tufted::InvalidInput& error) {
    throw tufted::IoError(name +
                          ": has no field `ring`, and its elevations show no rings, which --structure rings "
                          "asks for: " +
                          error.what());
  }
}

}  // namespace

std::optional<tufted::ScanStructure> structureOf(const tufted::Geometry& geometry, Structure structure,
                                                 const std::string& name) {
  if (structure == Structure::none) return std::nullopt;
  if (structure == Structure::rings) return ringsOf(geometry, name);
  if (geometry.height <= 1)
    throw tufted::IoError(name + ": is one row of points, no organized cloud, which --structure image asks for");
  return tufted::imageStructure(geometry.width, geometry.height,
                                {geometry.viewpoint[0], geometry.viewpoint[1], geometry.viewpoint[2]});
}
