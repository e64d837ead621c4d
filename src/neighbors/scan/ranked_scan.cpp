#include "neighbors/scan/ranked_scan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <tuple>

#include "base/buffer.h"
#include "base/number_text.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// Start of an error message; a string only where an error is thrown, as a frame must not allocate from the heap.
std::string nameIn(const char* function, const char* member) {
  return std::string(function) + ": structure." + member;
}

void checkSize(const char* function, const char* member, std::size_t size, std::size_t points) {
  if (size == points) return;
  throw InvalidInput(nameIn(function, member) + " has " + std::to_string(size) + " entries, must have " +
                     std::to_string(points) + ", one per point");
}

/// The azimuth in [0, 2 pi), or the column as it is.
double positionOf(const ScanStructure& structure, std::size_t i, const char* function) {
  const double position = structure.position[i];
  if (!structure.has_rings) {
    if (position >= 0 && position < INT32_MAX && position == std::floor(position)) return position;
    throw InvalidInput(nameIn(function, "position[") + std::to_string(i) + "] = " + numberText(position) +
                       ", must be a whole column >= 0 in an image");
  }
  constexpr double turn = 2 * std::numbers::pi;
  const double within = std::fmod(position, turn);
  const double positive = within < 0 ? within + turn : within;
  return positive < turn ? positive : 0;
}

}  // namespace

RankedScan rankScan(const ScanStructure& structure, const RankedCloud& cloud, const std::vector<PointStatus>& status,
                    const std::vector<int>& representative, const char* function) {
  checkSize(function, "row", structure.row.size(), status.size());
  checkSize(function, "position", structure.position.size(), status.size());
  if (!structure.origin.allFinite()) throw InvalidInput(nameIn(function, "origin") + " is not finite, must be");
  Buffer<int> rank(status.size(), -1);
  for (int r = 0; r < cloud.size(); ++r) rank[cloud.input_index[r]] = r;
  RankedScan scan{Buffer<int>(cloud.size(), -1), Buffer<double>(cloud.size(), 0), {}, std::ssize(status), function};
  for (int axis = 0; axis < 3; ++axis) scan.origin[axis] = std::ldexp(structure.origin[axis], -cloud.exponent);
  for (std::size_t i = 0; i < status.size(); ++i) {
    const int p = rank[representative[i]];
    if (p < 0 || structure.row[i] < 0 || !std::isfinite(structure.position[i])) continue;
    const double position = positionOf(structure, i, function);
    if (scan.row[p] >= 0 && std::tie(scan.row[p], scan.position[p]) <= std::tie(structure.row[i], position)) continue;
    scan.row[p] = structure.row[i];
    scan.position[p] = position;
  }
  return scan;
}

}  // namespace tufted
