#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "tufted/io/read.h"
#include "tufted/types.h"

namespace tufted {

/// Which points of a cloud select() keeps: those that satisfy all of these conditions.
struct Selection {
  /// Comparisons of fields, all of which must hold: "classification=2,6", "return_number=number_of_returns".
  ///   FIELD = LIST, FIELD != LIST    the value is one of the list, or none of it
  ///   FIELD < VALUE, and <=, >, >=
  /// VALUE is a number or the name of a field, LIST one or several of VALUE or LOW..HIGH (both included), separated by
  /// commas; == means =. findField() finds the names of fields. Further names are x, y, z; nx, ny, nz if there are
  /// normals; NAME_0, NAME_1, ... for a field of several values; and red, green, blue for packed colours. Values are
  /// compared as doubles. NaN satisfies no comparison, not even !=.
  std::vector<std::string> where = {};
  /// Box in the unit of the file; points on its sides are kept. Corners may be infinite.
  std::optional<Eigen::AlignedBox3d> crop = {};
  /// Corners of a polygon in x and y, in the unit of the file; the last one is joined to the first. Empty: no polygon.
  /// A point is inside if a ray from it towards larger x crosses the edges an odd number of times (even-odd rule, so
  /// the overlap of a polygon that crosses itself is outside). A ray crosses an edge if it passes the lower end or
  /// above it, but below the upper end, with the edge to the right of the point. So points on left and lower sides are
  /// inside, those on right and upper sides outside, and of two polygons with a common edge just one has a point on it.
  std::vector<Eigen::Vector2d> polygon = {};
  double thin = 0;  ///< spacing of thinPoints(), which thins what the other conditions keep; 0: no thinning

  /// Whether all points are kept.
  bool isEmpty() const { return where.empty() && !crop && polygon.empty() && thin == 0; }
};

/// The field that select() adds. writeLaplacian(), writeResults() and writeOperators() repeat it as file_row.npy.
inline constexpr const char* file_row = "file_row";

/// Removes an older field `file_row`, whose rows are those of another file than the one that was read.
void removeFileRow(Geometry& geometry);

/// Drops all points of a cloud that a selection does not keep. The others keep their order, and a field `file_row`
/// (int32) says which point of the cloud each was, counted from 0; it replaces an older field of that name. Writers
/// also write that field as file_row.npy.
///
/// An organized cloud keeps its grid and gets no such field: a dropped pixel becomes a missing one, with coordinates
/// and normal NaN.
/// @return indices of the kept points in the cloud as it was, ascending
/// @throws InvalidInput for a mesh, a comparison that cannot be parsed or names no field, a box whose lower corner
/// exceeds the upper one, a polygon of one or two corners or of coordinates beyond 1e150, a spacing that
/// thinPoints() refuses, or if none of the points is kept
/// @throws Cancelled when `progress` returns false; the geometry is then unchanged
std::vector<int> select(Geometry& geometry, const Selection& selection, const Progress& progress = {});

/// Thins points to a Poisson disk sample: no two of the chosen points are closer than `spacing`, and every other point
/// is closer than that to a chosen one. Points are visited in an order that depends on their coordinates alone, and
/// each is chosen unless an earlier one is too close. So the same positions are chosen in whatever order the points are
/// given. Takes O(N) memory and one thread.
/// @param spacing in the unit of the points, in [1e-150, 1e150]
/// @return indices of the chosen points, ascending; of equal points the first, and none that is not finite
/// @throws InvalidInput for another spacing
/// @throws Cancelled when `progress` returns false
std::vector<int> thinPoints(const Points& points, double spacing, const Progress& progress = {});

}  // namespace tufted
