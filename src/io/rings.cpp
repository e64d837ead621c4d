#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "tufted/errors.h"
#include "tufted/io/read.h"

namespace tufted {
namespace {

constexpr double slack = 1.001;  // azimuths may exceed a turn by this factor: rounding, the last firing

const Field* fieldNamed(const Geometry& geometry, const char* name) {
  const auto field = std::find_if(geometry.fields.begin(), geometry.fields.end(),
                                  [name](const Field& f) { return f.name == name && f.count == 1; });
  return field == geometry.fields.end() ? nullptr : &*field;
}

/// The ring number of a point; negative if the value is none.
int ringAt(const Field& field, std::size_t i) {
  const double value = valueOf(field, i);
  return value >= 0 && value < (1 << 30) ? static_cast<int>(value) : -1;
}

/// Azimuths in radians. Files do not state the unit: drivers use radians, degrees and hundredths of degrees. The first
/// of these whose full turn covers all values is assumed. It may be wrong for a narrow sector, but only the order of
/// points around the axis matters, from any zero and in either direction.
std::vector<double> azimuthsOf(const Field& field, const Points& points, const std::string& name) {
  std::vector<double> azimuth(static_cast<std::size_t>(points.rows()));
  double largest = 0;
  for (std::size_t i = 0; i < azimuth.size(); ++i) {
    azimuth[i] = valueOf(field, i);
    const bool counts = points.row(static_cast<Eigen::Index>(i)).allFinite() && std::isfinite(azimuth[i]);
    if (counts) largest = std::max(largest, std::abs(azimuth[i]));
  }
  const double radians = 2 * std::numbers::pi;
  for (const double turn : {radians, 360.0, 36000.0}) {
    if (largest > slack * turn) continue;
    for (double& angle : azimuth) angle *= radians / turn;
    return azimuth;
  }
  throw IoError(name + ": has a field `azimuth` up to " + std::to_string(largest) +
                ", must be radians, degrees or hundredths of degrees");
}

}  // namespace

ScanStructure ringsOf(const Geometry& geometry, const std::string& name) {
  const auto& pose = geometry.viewpoint;
  const Eigen::Vector3d origin(pose[0], pose[1], pose[2]);
  Eigen::Quaterniond turn(pose[3], pose[4], pose[5], pose[6]);
  turn.coeffs() /= turn.coeffs().cwiseAbs().maxCoeff();  // so that squares neither overflow nor underflow
  // Points in the frame of the scanner, which turns around the z axis.
  const Points seen = (geometry.points.rowwise() - origin.transpose()) * turn.normalized().toRotationMatrix();
  const auto byElevation = [&] {
    try {
      return findRings(seen);
    } catch (const InvalidInput& error) {
      std::string why = error.what();
      why.erase(0, why.find(": ") + 2);  // removes the name of the function, which users of files do not know
      throw IoError(name + ": has no field `ring`, and its elevations show no rings: " + why);
    }
  };
  const auto byField = [&](const Field& field) {
    std::vector<int> ring(static_cast<std::size_t>(geometry.points.rows()));
    for (std::size_t i = 0; i < ring.size(); ++i) ring[i] = ringAt(field, i);
    return ringStructure(seen, std::move(ring));
  };
  const Field* rings = fieldNamed(geometry, "ring");
  ScanStructure structure = rings == nullptr ? byElevation() : byField(*rings);
  structure.origin = origin;
  const Field* azimuths = fieldNamed(geometry, "azimuth");
  if (azimuths != nullptr) structure.position = azimuthsOf(*azimuths, geometry.points, name);
  return structure;
}

}  // namespace tufted
