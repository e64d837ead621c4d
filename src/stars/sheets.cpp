#include "stars/sheets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>

#include "stars/neighborhood.h"

namespace tufted {
namespace {

/// The plane of the nearest 8, or 13, is used if its flatness is below this share of that of all.
constexpr std::array<double, few_neighbors.size()> flatter = {0.1, 0.5};
/// The smallest variance of such a plane must also be below this share of the second. Not varied since the first
/// design.
constexpr double plane_of_few = 0.05;
/// Cuts along the plane of the rest at most. Not varied since the first design.
constexpr int most_cuts = 3;
/// Numbers of remaining points, p included: with up to `least_sheet` p is isolated; a plane needs `least_plane`, as
/// many as a quadratic fit does.
constexpr int least_sheet = 3, least_plane = 9;
/// The remaining points are a plane if their smallest variance is below this share of the second, or below `flat_few`
/// if the plane was found from two neighbours.
constexpr double flat_sheet = 0.1, flat_few = 0.05;
/// The flatness of an accepted plane must be below this share of the former one; a cut that helps less has cut a curved
/// surface.
constexpr double far_flatter = 0.25;
/// Number of nearest neighbours whose pairs give, with p, planes to cut along: six planes, one packet.
constexpr int plane_neighbors = 4;
/// Two neighbours whose angle at p has a smaller sine are nearly collinear with p and give no plane.
constexpr double least_sine = 0.3;

/// Where a neighbourhood reaches around a thin part, neighbours higher over or deeper under the plane of the nearest
/// few than this many times their distance along it are left out: 1 loses area at the tips of fingers, 2 keeps folds of
/// cables 8 spacings around. Chosen on half of the real shapes with seed 1.
constexpr double steepest = 1.5;

double flatness(const PrincipalAxes& axes) {
  return axes.variance[1] > 0 ? axes.variance[0] / axes.variance[1] : 0;
}

/// Whether p has its nearest 13 neighbours in two opposite directions, as on a scan line far from others. Their plane
/// is that of the bend of the line, and says nothing about sheets.
bool isAlongOneLine(const Offsets& neighbors) {
  Covariance directions;
  directions.extent = 1;
  for (int i = 0; i < few_neighbors.back(); ++i) {
    const Eigen::Vector3d d = Eigen::Vector3d(neighbors.x[i], neighbors.y[i], neighbors.z[i]).normalized();
    directions.xx += d.x() * d.x(), directions.xy += d.x() * d.y(), directions.xz += d.x() * d.z();
    directions.yy += d.y() * d.y(), directions.yz += d.y() * d.z(), directions.zz += d.z() * d.z();
  }
  PrincipalAxes axes;
  principalAxes({&directions, 1}, {&axes, 1});
  return liesOnOneLine(axes);
}

/// Whether the remaining neighbours are a plane: flatter than `flat`, and far flatter than before.
bool isSheet(int neighbors, const PrincipalAxes& axes, const PrincipalAxes& before, double flat) {
  return neighbors + 1 >= least_plane && !liesOnOneLine(axes) && flatness(axes) < flat &&
         flatness(axes) < far_flatter * flatness(before);
}

/// Whether all neighbours are reached from p along `normal`. Stores their heights and the reached range in `scratch`.
bool isOneSheet(const Offsets& neighbors, const Eigen::Vector3d& normal, double fit_radius, SheetScratch& scratch) {
  scratch.heights.resize(static_cast<std::size_t>(toPackets(neighbors.count)));
  scratch.range = kernels().connectedHeights(neighbors, normal.data(), sheet_gap * fit_radius, scratch.heights.data());
  return isWhole(scratch.range);
}

/// Keeps the neighbours in the range that isOneSheet() has stored.
void takeReached(Neighborhood& neighborhood, OffsetBuffer& offsets, const SheetScratch& scratch) {
  Buffer<Neighbor>& neighbors = neighborhood.neighbors;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < neighbors.size(); ++i) {
    neighbors[kept] = neighbors[i];
    kept += scratch.heights[i] >= scratch.range.lowest && scratch.heights[i] <= scratch.range.highest ? 1 : 0;
  }
  neighbors.resize(kept);
  offsets.takeConnected(offsets.view(), scratch.heights.data(), scratch.range);
}

/// keepSheet() that stores all neighbours before the first cut, because they are restored if no sheet is found.
bool keepSheetOfAll(const Eigen::Vector3d& normal, Neighborhood& neighborhood, OffsetBuffer& offsets,
                    SheetScratch& scratch) {
  if (neighborhood.neighbors.empty() || isOneSheet(offsets.view(), normal, neighborhood.fit_radius, scratch))
    return false;
  if (scratch.all.empty()) {
    scratch.all = neighborhood.neighbors;
    scratch.offsets_of_all = offsets;
  }
  takeReached(neighborhood, offsets, scratch);
  return true;
}

/// The planes through p and two of its nearest four neighbours not nearly collinear with p. Returns their number.
int planesThroughNearest(const Offsets& neighbors, Normals& planes) {
  const auto offset = [&](int i) { return Eigen::Vector3d(neighbors.x[i], neighbors.y[i], neighbors.z[i]); };
  int count = 0;
  for (int i = 1; i < std::min(neighbors.count, plane_neighbors); ++i) {
    for (int j = 0; j < i; ++j) {
      const Eigen::Vector3d u = offset(i), v = offset(j), normal = u.cross(v);
      const double length = normal.norm();
      if (!(length > least_sine * u.norm() * v.norm())) continue;
      planes.x[count] = normal.x() / length;
      planes.y[count] = normal.y() / length;
      planes.z[count++] = normal.z() / length;
    }
  }
  return count;
}

/// Cuts the neighbourhood along each of these planes; keeps the cuts that removed points and left enough.
std::span<TriedSheet> trySheets(const OffsetBuffer& all, double fit_radius, SheetScratch& scratch) {
  Normals planes{};
  const int plane_count = planesThroughNearest(all.view(), planes);
  std::array<HeightRange, kernel_packet> range;
  scratch.heights.resize(static_cast<std::size_t>(toPackets(all.count())));
  scratch.heights_along.resize(static_cast<std::size_t>(kernel_packet) * all.count());
  kernels().connectedHeightsAlong(all.view(), planes, sheet_gap * fit_radius, scratch.heights_along.data(),
                                  range.data());
  std::size_t count = 0;
  for (int i = 0; i < plane_count; ++i) {
    if (isWhole(range[i])) continue;
    for (int j = 0; j < all.count(); ++j) scratch.heights[j] = scratch.heights_along[kernel_packet * j + i];
    TriedSheet& sheet = scratch.tried[count];
    sheet.offsets.takeConnected(all.view(), scratch.heights.data(), range[i]);
    if (sheet.offsets.count() + 1 < least_plane) continue;
    sheet.first_normal = {planes.x[i], planes.y[i], planes.z[i]};
    ++count;
  }
  return std::span(scratch.tried).first(count);
}

/// Fits a plane to each sheet, several at once.
void fitPlanes(std::span<TriedSheet* const> sheets, double radius) {
  std::array<Covariance, SheetScratch::most_tried> covariances;
  std::array<PrincipalAxes, SheetScratch::most_tried> axes;
  for (std::size_t i = 0; i < sheets.size(); ++i) covariances[i] = covarianceOf(sheets[i]->offsets.view(), radius);
  principalAxes(std::span(covariances).first(sheets.size()), axes);
  for (std::size_t i = 0; i < sheets.size(); ++i) sheets[i]->axes = axes[i];
}

/// Cuts each sheet once more, along its own plane, and fits a plane to the rest.
void cutAlongOwnPlanes(std::span<TriedSheet> sheets, const Neighborhood& neighborhood, SheetScratch& scratch) {
  std::array<TriedSheet*, SheetScratch::most_tried> listed;
  std::size_t count = 0;
  for (TriedSheet& sheet : sheets) listed[count++] = &sheet;
  fitPlanes(std::span(listed).first(count), neighborhood.radius);
  count = 0;
  for (TriedSheet& sheet : sheets) {
    sheet.second_normal = sheet.axes.normal;
    if (isOneSheet(sheet.offsets.view(), sheet.second_normal, neighborhood.fit_radius, scratch)) continue;
    sheet.offsets.takeConnected(sheet.offsets.view(), scratch.heights.data(), scratch.range);
    listed[count++] = &sheet;
  }
  fitPlanes(std::span(listed).first(count), neighborhood.radius);
}

/// Whether at least 3 of the nearest 8 neighbours of p are on the sheet. On a cable of nine points around, rings are
/// planes that hold two of them.
bool holdsNearest(const Offsets& all, const Offsets& sheet) {
  constexpr int nearest = few_neighbors[0];
  const auto distance = [](const Offsets& of, int i) { return std::hypot(of.x[i], of.y[i], of.z[i]); };
  return distance(sheet, 2) <= distance(all, nearest - 1);
}

/// The sheet with the most points, the first of equal ones; null if none is a plane.
const TriedSheet* largestSheet(std::span<const TriedSheet> tried, const Offsets& all, const PrincipalAxes& before) {
  const TriedSheet* largest = nullptr;
  for (const TriedSheet& sheet : tried) {
    if (!isSheet(sheet.offsets.count(), sheet.axes, before, flat_few)) continue;
    if (!holdsNearest(all, sheet.offsets.view())) continue;
    if (largest == nullptr || sheet.offsets.count() > largest->offsets.count()) largest = &sheet;
  }
  return largest;
}

/// Step 4 in section 4 of docs/algorithm.md: keeps the largest sheet along a plane through p and two of its nearest
/// four neighbours. Returns false and the whole neighbourhood if there is none.
bool findSheet(const PrincipalAxes& before, Neighborhood& neighborhood, OffsetBuffer& offsets, SheetScratch& scratch) {
  if (!scratch.all.empty()) {
    neighborhood.neighbors = scratch.all;
    offsets = scratch.offsets_of_all;
    neighborhood.axes = before;
  }
  const std::span<TriedSheet> tried = trySheets(offsets, neighborhood.fit_radius, scratch);
  cutAlongOwnPlanes(tried, neighborhood, scratch);
  const TriedSheet* const sheet = largestSheet(tried, offsets.view(), before);
  if (sheet == nullptr) return false;
  keepSheet(sheet->first_normal, neighborhood, offsets, scratch);
  keepSheet(sheet->second_normal, neighborhood, offsets, scratch);
  neighborhood.axes = sheet->axes;
  return true;
}

/// Steps 1 and 2: cuts along the plane of the nearest few, if that is far flatter than the plane of all, then along the
/// planes of the remaining neighbours.
void cutAlongPlanes(const PrincipalAxes& before, Neighborhood& neighborhood, OffsetBuffer& offsets,
                    SheetScratch& scratch) {
  const bool is_along_line = offsets.count() > few_neighbors.back() && liesOnOneLine(neighborhood.axes_of_few.back()) &&
                             isAlongOneLine(offsets.view());
  for (std::size_t j = 0; !is_along_line && j < few_neighbors.size(); ++j) {
    if (std::ssize(neighborhood.neighbors) <= few_neighbors[j]) break;
    const PrincipalAxes& axes = neighborhood.axes_of_few[j];
    if (!(flatness(axes) < flatter[j] * flatness(before) && axes.variance[0] < plane_of_few * axes.variance[1]))
      continue;
    if (!keepSheetOfAll(axes.normal, neighborhood, offsets, scratch)) continue;
    neighborhood.axes = principalAxes(offsets.view());
    break;
  }
  for (int i = 0; i < most_cuts; ++i) {
    if (!keepSheetOfAll(neighborhood.axes.normal, neighborhood, offsets, scratch)) break;
    neighborhood.axes = principalAxes(offsets.view());
  }
}

/// Step 5: takes the plane of the nearest 13, or else 8, and leaves out what is steep over it. Returns whether it did.
bool unwrap(Neighborhood& neighborhood, OffsetBuffer& offsets, SheetScratch& scratch) {
  for (std::size_t j = few_neighbors.size(); j-- > 0;) {
    const PrincipalAxes& few = neighborhood.axes_of_few[j];
    const bool is_flatter = few.variance[0] < far_flatter * flatness(neighborhood.axes) * few.variance[1];
    if (neighborhood.k <= few_neighbors[j] || liesOnOneLine(few) || !is_flatter) continue;
    neighborhood.axes = few;
    leaveOutSteep(few.normal, neighborhood, offsets, scratch);
    return true;
  }
  return false;
}

}  // namespace

void leaveOutSteep(const Eigen::Vector3d& normal, Neighborhood& neighborhood, OffsetBuffer& offsets,
                   SheetScratch& scratch) {
  const Offsets all = offsets.view();
  scratch.heights.resize(static_cast<std::size_t>(toPackets(all.count)));
  for (int i = 0; i < all.count; ++i) {
    const Eigen::Vector3d offset(all.x[i], all.y[i], all.z[i]);
    scratch.heights[i] = std::abs(offset.dot(normal)) - steepest * offset.cross(normal).norm();
  }
  scratch.range = {-HUGE_VAL, 0, -HUGE_VAL, HUGE_VAL};
  takeReached(neighborhood, offsets, scratch);
}

bool keepSheet(const Eigen::Vector3d& normal, Neighborhood& neighborhood, OffsetBuffer& offsets,
               SheetScratch& scratch) {
  if (neighborhood.neighbors.empty() || isOneSheet(offsets.view(), normal, neighborhood.fit_radius, scratch))
    return false;
  takeReached(neighborhood, offsets, scratch);
  return true;
}

void splitSheets(Neighborhood& neighborhood, OffsetBuffer& offsets, SheetScratch& scratch) {
  if (neighborhood.neighbors.empty()) return;
  const PrincipalAxes before = neighborhood.axes;
  scratch.all.clear();
  cutAlongPlanes(before, neighborhood, offsets, scratch);
  const auto left = static_cast<int>(neighborhood.neighbors.size());
  if (scratch.all.empty()) {
    neighborhood.split = flatness(before) > flat_sheet && findSheet(before, neighborhood, offsets, scratch);
    neighborhood.wrapped = neighborhood.thick && !neighborhood.split && unwrap(neighborhood, offsets, scratch);
  } else if (left + 1 <= least_sheet) {
    neighborhood.isolated = true;
  } else if (isSheet(left, neighborhood.axes, before, flat_sheet) ||
             findSheet(before, neighborhood, offsets, scratch)) {
    neighborhood.split = true;
  } else {
    neighborhood.restored = true;
  }
}

}  // namespace tufted
