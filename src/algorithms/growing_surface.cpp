#include "algorithms/growing_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "base/cross.h"

namespace tufted {
namespace {

/// Whether x lies within the sector from a counterclockwise to b, of less than pi.
bool isWithin(const Eigen::Vector2f& x, const Eigen::Vector2f& a, const Eigen::Vector2f& b) {
  return cross(a, x) > 0 && cross(x, b) > 0;
}

}  // namespace

GrowingSurface::GrowingSurface(const Frames& frames, const Points& positions, const std::vector<int>& most)
    : frames_(frames), positions_(positions), offset_(most.size() + 1, 0), size_(most.size(), 0) {
  for (std::size_t p = 0; p < most.size(); ++p) offset_[p + 1] = offset_[p] + most[p];
  sectors_.resize(static_cast<std::size_t>(offset_.back()));
}

Eigen::Vector2f GrowingSurface::direction(int from, int to) const {
  const Eigen::RowVector3d offset = positions_.row(to) - positions_.row(from);
  const Eigen::RowVector3d unit = offset / offset.cwiseAbs().maxCoeff();
  const Eigen::RowVector3d normal = frames_.normals.row(from), x = frames_.tangents.row(from);
  return Eigen::Vector2d(x.dot(unit), normal.cross(x).dot(unit)).cast<float>();
}

bool GrowingSurface::fits(int point, const Sector& sector) const {
  if (offset_[point] + size_[point] == offset_[point + 1]) return false;
  const int a = sector.first, b = sector.second;
  int at_a = 0, at_b = 0;  // number of triangles at these edges
  for (const Sector& other : sectorsAt(point)) {
    // Two sectors that both begin or both end at an edge overlap.
    if (other.first == a || other.second == b) return false;
    at_a += other.second == a ? 1 : 0;
    at_b += other.first == b ? 1 : 0;
    if (at_a > 1 || at_b > 1) return false;
    if (other.second != a && isWithin(sector.to_first, other.to_first, other.to_second)) return false;
    if (other.first != b && isWithin(sector.to_second, other.to_first, other.to_second)) return false;
    if (other.first != b && isWithin(other.to_first, sector.to_first, sector.to_second)) return false;
    if (other.second != a && isWithin(other.to_second, sector.to_first, sector.to_second)) return false;
  }
  return true;
}

bool GrowingSurface::add(const std::array<int, 3>& corners) {
  std::array<Sector, 3> sectors;
  for (int k = 0; k < 3; ++k) {
    const int point = corners[k], first = corners[(k + 1) % 3], second = corners[(k + 2) % 3];
    Sector& sector = sectors[k];
    sector = {first, second, direction(point, first), direction(point, second)};
    const float turn = cross(sector.to_first, sector.to_second);
    if (!(turn != 0)) return false;
    if (turn < 0) {
      std::swap(sector.first, sector.second);
      std::swap(sector.to_first, sector.to_second);
    }
    if (!fits(point, sector)) return false;
  }
  for (int k = 0; k < 3; ++k) sectors_[offset_[corners[k]] + size_[corners[k]]++] = sectors[k];
  triangles_.push_back(corners);
  return true;
}

void GrowingSurface::removeLast() {
  for (const int corner : triangles_.back()) --size_[corner];
  triangles_.pop_back();
}

int GrowingSurface::facesAt(int a, int b) const {
  int faces = 0;
  for (const Sector& sector : sectorsAt(a)) faces += sector.first == b || sector.second == b ? 1 : 0;
  return faces;
}

void GrowingSurface::openNeighbors(int point, std::vector<int>& neighbors) const {
  neighbors.clear();
  for (const Sector& sector : sectorsAt(point))
    for (const int other : {sector.first, sector.second})
      if (facesAt(point, other) == 1) neighbors.push_back(other);
  std::sort(neighbors.begin(), neighbors.end());
}

int GrowingSurface::fansAround(int point) const {
  std::vector<std::pair<int, int>> sectors;
  for (const Sector& sector : sectorsAt(point)) sectors.emplace_back(sector.first, sector.second);
  int fans = 0;
  while (!sectors.empty()) {
    ++fans;
    std::vector<int> ends = {sectors.back().first, sectors.back().second};
    sectors.pop_back();
    while (!ends.empty()) {
      const int end = ends.back();
      ends.pop_back();
      const auto next = std::find_if(sectors.begin(), sectors.end(),
                                     [end](const auto& s) { return s.first == end || s.second == end; });
      if (next == sectors.end()) continue;
      ends.push_back(next->first == end ? next->second : next->first);
      sectors.erase(next);
    }
  }
  return fans;
}

}  // namespace tufted
