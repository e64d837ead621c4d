#include "structure.h"

#include <cstdio>

#include "tufted/errors.h"
#include "tufted/io/read.h"
#include "tufted/scan_structure.h"

namespace {

Eigen::Vector3d originOf(const tufted::Geometry& geometry) {
  return {geometry.viewpoint[0], geometry.viewpoint[1], geometry.viewpoint[2]};
}

}  // namespace

Structure structureFor(const tufted::Geometry& geometry) {
  const bool is_seen = !geometry.is_mesh && geometry.height > 1 &&
                       tufted::isDepthImage(geometry.points, geometry.width, geometry.height, originOf(geometry));
  return is_seen ? Structure::image : Structure::none;
}

std::string doubtOf(const tufted::Geometry& geometry, Structure structure) {
  if (structure != Structure::image || structureFor(geometry) == Structure::image) return "";
  const double sparse = tufted::sparseShare(geometry.points, geometry.width, geometry.height, originOf(geometry));
  if (sparse > tufted::most_sparse) return "";  // the build warns of it
  char text[200];
  const auto& at = geometry.viewpoint;
  std::snprintf(text, sizeof text,
                "of no pinhole camera at %.6g, %.6g, %.6g, the viewpoint of the file or 0 without one", at[0], at[1],
                at[2]);
  return text;
}

std::string nameOf(Structure structure) {
  for (const auto& [name, value] : structures)
    if (value == structure) return name;
  return "";
}

std::optional<tufted::ScanStructure> structureOf(const tufted::Geometry& geometry, Structure structure,
                                                 const std::string& name) {
  if (structure == Structure::none) return std::nullopt;
  if (structure == Structure::rings) {
    try {
      return tufted::ringsOf(geometry, name);
    } catch (const tufted::IoError& error) {
      throw tufted::IoError(std::string(error.what()) + " (--structure rings asks for them)");
    }
  }
  if (geometry.height <= 1)
    throw tufted::IoError(name + ": is one row of points, no organized cloud, which --structure image asks for");
  return tufted::imageStructure(geometry.width, geometry.height, originOf(geometry));
}
