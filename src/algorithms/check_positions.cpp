#include "algorithms/check_positions.h"

#include "tufted/check.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

void requireRows(const std::string& what, Eigen::Index rows, const Laplacian& laplacian, const char* hint) {
  const auto n = std::ssize(laplacian.status);
  if (rows == n) return;
  throw InvalidInput(what + " has " + std::to_string(rows) + " rows, must have " + std::to_string(n) + hint);
}

template <class IsFinite>
void requireFinite(const std::string& what, const Laplacian& laplacian, const IsFinite& isFinite) {
  for (Eigen::Index i = 0; i < std::ssize(laplacian.status); ++i)
    if (laplacian.status[i] == PointStatus::active && !isFinite(i))
      throw InvalidInput(what + " of point " + std::to_string(i) +
                         " is not finite, must be: the Laplacian has it active");
}

}  // namespace

void checkPositions(const std::string& function, const Laplacian& laplacian) {
  checkSizes(function, laplacian);
  requireRows(function + ": Laplacian::positions", laplacian.positions.rows(), laplacian, ", one per point");
  requireFinite(function + ": the position", laplacian, [&](auto i) { return laplacian.positions.row(i).allFinite(); });
}

void checkFrames(const std::string& function, const Laplacian& laplacian, const Frames& frames) {
  checkSizes(function, laplacian);
  requireRows(function + ": frames.normals", frames.normals.rows(), laplacian, "; meshes have meshFrames()");
  requireRows(function + ": frames.tangents", frames.tangents.rows(), laplacian, ", one per point of the Laplacian");
  requireRows(function + ": Laplacian::positions", laplacian.positions.rows(), laplacian, ", one per point");
  requireFinite(function + ": the position or frame", laplacian, [&](auto i) {
    return laplacian.positions.row(i).allFinite() && frames.normals.row(i).allFinite() &&
           frames.tangents.row(i).allFinite();
  });
}

}  // namespace tufted
