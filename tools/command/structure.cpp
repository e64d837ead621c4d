#include "structure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "tufted/errors.h"

namespace {

constexpr double slack = 1.001;  // of a turn, for rounding and for the points that the last firing added

const tufted::Field* fieldNamed(const tufted::Geometry& geometry, const char* name) {
  const auto field = std::find_if(geometry.fields.begin(), geometry.fields.end(),
                                  [name](const tufted::Field& f) { return f.name == name && f.count == 1; });
  return field == geometry.fields.end() ? nullptr : &*field;
}

/// The number of a ring; negative if the value is not one.
int ringAt(const tufted::Field& field, std::size_t i) {
  const double value = tufted::valueOf(field, i);
  return value >= 0 && value < (1 << 30) ? static_cast<int>(value) : -1;
}

/// Azimuths in radians. Files do not state the unit; drivers use radians, degrees and hundredths of degrees, and the
/// first of these whose full turn covers all values is taken. A narrow sector may be taken for another unit; its points
/// keep their order around the axis, which suffices, and so with any zero and sense of turning.
std::vector<double> azimuthsOf(const tufted::Field& field, const tufted::Points& points, const std::string& name) {
  std::vector<double> azimuth(static_cast<std::size_t>(points.rows()));
  double largest = 0;
  for (std::size_t i = 0; i < azimuth.size(); ++i) {
    azimuth[i] = tufted::valueOf(field, i);
    const bool counts = points.row(static_cast<Eigen::Index>(i)).allFinite() && std::isfinite(azimuth[i]);
    if (counts) largest = std::max(largest, std::abs(azimuth[i]));
  }
  constexpr double radians = 2 * std::numbers::pi;
  for (const double turn : {radians, 360.0, 36000.0}) {
    if (largest > slack * turn) continue;
    for (double& angle : azimuth) angle *= radians / turn;
    return azimuth;
  }
  throw tufted::IoError(name + ": has a field `azimuth` up to " + std::to_string(largest) +
                        ", must be radians, degrees or hundredths of degrees for --structure rings");
}

tufted::ScanStructure ringsOf(const tufted::Geometry& geometry, const std::string& name) {
  const auto& pose = geometry.viewpoint;
  const Eigen::Vector3d origin(pose[0], pose[1], pose[2]);
  Eigen::Quaterniond turn(pose[3], pose[4], pose[5], pose[6]);
  turn.coeffs() /= turn.coeffs().cwiseAbs().maxCoeff();  // the square of its length neither over- nor underflows
  // The scanner's frame, whose z axis it turns around.
  const tufted::Points seen = (geometry.points.rowwise() - origin.transpose()) * turn.normalized().toRotationMatrix();
  const auto byElevation = [&] {
    try {
      return tufted::findRings(seen);
    } catch (const tufted::InvalidInput& error) {
      throw tufted::IoError(name +
                            ": has no field `ring`, and its elevations show no rings, which --structure rings "
                            "asks for: " +
                            error.what());
    }
  };
  const auto byField = [&](const tufted::Field& field) {
    std::vector<int> ring(static_cast<std::size_t>(geometry.points.rows()));
    for (std::size_t i = 0; i < ring.size(); ++i) ring[i] = ringAt(field, i);
    return tufted::ringStructure(seen, std::move(ring));
  };
  const tufted::Field* rings = fieldNamed(geometry, "ring");
  tufted::ScanStructure structure = rings == nullptr ? byElevation() : byField(*rings);
  const tufted::Field* azimuths = fieldNamed(geometry, "azimuth");
  if (azimuths != nullptr) structure.position = azimuthsOf(*azimuths, geometry.points, name);
  return structure;
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
