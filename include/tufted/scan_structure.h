#pragma once

#include <Eigen/Core>
#include <vector>

#include "tufted/detail/memory_layout.h"
#include "tufted/types.h"

namespace tufted {

/// The order in which a scanner took the points of a cloud: in rows of an image or rings of a spinning scanner, each
/// point at a place along its row. Consecutive rows were taken side by side. See imageStructure(), ringStructure() and
/// findRings().
///
/// With rings, neighbours are found without a tree, however far apart the rings are; azimuths must be those of the
/// points. In a depth image the pixels around a point are its neighbours, CloudOptions::neighbors has no effect, and
/// noise is measured along the line of sight. The rectangle of pixels that holds points may have at most 2^24 pixels or
/// 64 per entry. Of several points in a pixel one has a place. Rings that lie close together, as those of scanners with
/// 64 of them, are treated as a depth image: in the median at most 0.75 degrees and 4.5 azimuth steps apart, in even
/// steps with few gaps.
struct ScanStructure {
  std::vector<int> row;          ///< N; row of the image or number of the ring; negative: the point has no place
  std::vector<double> position;  ///< N; column of the image, or azimuth in radians; not finite: the point has no place
  bool has_rings = false;        ///< true: rows are rings, closed around 2 pi; false: positions are whole columns >= 0
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< position of the sensor, in the unit of the points
};

/// The structure of an organized cloud, whose points are stored row by row as in PCL.
/// @param width,height columns and rows, >= 0; the cloud has width x height points
/// @param origin position of the sensor, in the unit of the points
/// @throws InvalidInput for negative sizes or more than 2^31 - 1 pixels
ScanStructure imageStructure(int width, int height, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

/// Whether an organized cloud is a depth image, for which imageStructure() is meant: every point lies where a pinhole
/// camera at `origin`, turned in any way, saw its pixel. A cloud that was moved without `origin` is not.
/// @param points width x height rows, row by row; points that are not finite are skipped
/// @param origin position of the sensor, in the unit of the points
/// @return also false for fewer than 100 finite points, fewer than 8 rows or columns, or a sparseShare() above
/// most_sparse
bool isDepthImage(const Points& points, int width, int height, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

/// The structure of a spinning scanner's cloud whose ring numbers are known.
/// @param points N x 3; azimuths are their directions around the z axis through `origin`
/// @param ring N ring numbers in the order of elevation (up or down); negative where unknown
/// @param origin position of the sensor, in the unit of the points
/// @throws InvalidInput for arrays of different sizes or an origin that is not finite
ScanStructure ringStructure(const Points& points, std::vector<int> ring,
                            const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

/// Finds the rings of a spinning scanner without ring numbers, as clusters of the elevations of points seen from the
/// origin. Points that are not finite, or at the origin, have no place.
/// @param points N x 3, in the frame of the scanner, which turns around the z axis through `origin`
/// @throws InvalidInput for an origin that is not finite, or elevations that do not cluster: fewer than 4 rings, fewer
/// than 16 points per ring on average, a ring wider than the narrowest gap between two, or a gap within a ring of more
/// than a quarter of that
ScanStructure findRings(const Points& points, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

/// The share of an organized cloud's surface that is sparse: around which fewer than half of the other 24 of 5 x 5
/// pixels hold points. Rims of holes hardly count, however large the holes. If half of the pixels are missing at
/// random, in all of the image or in a part of it, about half of the surface there is sparse. Rows and columns without
/// any point are left out, as in a build, unless the rows that remain are more than 12 times as far apart as the
/// columns, or the other way round. Points at the origin count as missing.
/// @param points width x height rows, row by row
/// @param origin position of the sensor, in the unit of the points
/// @return in [0, 1]; 0 without a point or if `points` has another number of rows
double sparseShare(const Points& points, int width, int height,
                   const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

/// A depth image with a greater sparseShare() is built better from neighbours in space, because windows of pixels hold
/// too little of the surface to find noise and jumps. isDepthImage() returns false for it. Ten real images have 0.004
/// at most.
inline constexpr double most_sparse = 0.03;

}  // namespace tufted
