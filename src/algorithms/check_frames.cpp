#include "algorithms/check_frames.h"

#include <string>

#include "tufted/check.h"
#include "tufted/errors.h"

namespace tufted {

void checkFrames(const char* function, const Laplacian& laplacian, const Frames& frames) {
  checkSizes(function, laplacian);
  const std::string name = std::string(function) + ": ";
  const auto n = static_cast<Eigen::Index>(laplacian.status.size());
  const auto check = [&](const char* what, Eigen::Index rows, const char* hint) {
    if (rows == n) return;
    throw InvalidInput(name + what + " has " + std::to_string(rows) + " rows, must have " + std::to_string(n) + hint);
  };
  check("frames.normals", frames.normals.rows(), "; meshes have meshFrames()");
  check("frames.tangents", frames.tangents.rows(), ", one per point of the Laplacian");
  check("Laplacian::positions", laplacian.positions.rows(), ", one per point");
  for (Eigen::Index i = 0; i < n; ++i) {
    if (laplacian.status[i] != PointStatus::active) continue;
    if (!laplacian.positions.row(i).allFinite() || !frames.normals.row(i).allFinite() ||
        !frames.tangents.row(i).allFinite())
      throw InvalidInput(name + "the position or frame of point " + std::to_string(i) +
                         " is not finite, must be: the Laplacian has it active");
  }
}

}  // namespace tufted
