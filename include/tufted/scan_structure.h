#pragma once

#include <Eigen/Core>
#include <vector>

#include "tufted/memory_layout.h"
#include "tufted/types.h"

namespace tufted {

/// How a scanner took the points of a cloud: in rows, each point at a place along its row. Rows are those of an image
/// or the rings of a spinning scanner; consecutive rows were taken side by side. With the rings of a scanner neighbours
/// are found without a tree, however far apart the rings are. In a depth image the pixels around each point take the
/// place of its neighbours, CloudOptions::neighbors counts for nothing, and noise is told along the line of sight. The
/// part of an image that holds points must have at most 2^24 pixels or 64 per entry; where several points share a pixel
/// all but one have no place. Rings are such an image, too, where they lie close together, as those of scanners with 64
/// of them: in the median at most 0.75 degrees and 4.5 steps of the azimuth apart, in even steps with few gaps. See
/// imageStructure(), ringStructure() and findRings().
struct ScanStructure {
  std::vector<int> row;          ///< N; row of the image or number of the ring; negative: the point has no place
  std::vector<double> position;  ///< N; column of the image, or azimuth in radians; not finite: the point has no place
  bool has_rings = false;        ///< rows are rings, closed around 2 pi; otherwise positions are whole columns >= 0
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< position of the sensor, in the points' unit
};

/// The pixels of an organized cloud, row-major as in PCL.
/// @param width,height columns and rows, at least 0 each; the cloud has width x height points
/// @throws InvalidInput for negative sizes or more than 2^31 - 1 pixels
ScanStructure imageStructure(int width, int height, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

/// Whether the points of an organized cloud are where a pinhole camera at `origin` saw them, pixel by pixel, however it
/// was turned: for imageStructure(). Clouds that were moved without `origin`, or are no depth image, are not.
/// @param points width x height rows, row-major; those that are not finite are skipped
/// @returns false as well where fewer than 100 points are finite, or rows and columns are fewer than 8
bool isDepthImage(const Points& points, int width, int height, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

/// The rings of a spinning scanner, as its driver numbered them.
/// @param points N x 3; azimuths are their directions around the z axis through `origin`
/// @param ring N; in the order of elevation (up or down), negative where unknown
/// @throws InvalidInput for arrays of different sizes or an origin that is not finite
ScanStructure ringStructure(const Points& points, std::vector<int> ring,
                            const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

/// Finds the rings of a spinning scanner without ring numbers: they are the clusters of the points' elevations seen
/// from the origin. Points that are not finite, or at the origin, have no place.
/// @param points N x 3, in the scanner's frame: it turns around the z axis through `origin`
/// @throws InvalidInput for an origin that is not finite, and where the elevations do not cluster: there are fewer than
/// 4 rings, or fewer than 16 points per ring in the mean, or a ring is wider than the narrowest gap between two, or
/// within a ring there is a gap of more than a quarter of that between two
ScanStructure findRings(const Points& points, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

}  // namespace tufted
