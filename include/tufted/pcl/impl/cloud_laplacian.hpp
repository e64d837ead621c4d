#pragma once

#include <pcl/console/print.h>
#include <pcl/point_cloud.h>
#include <pcl/search/search.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tufted/errors.h"
#include "tufted/laplacian.h"

/// Conversions between the types of PCL and of the core, for all PCL classes.
namespace tufted::detail {

/// Checks that indices lie in the cloud.
/// @param name of the caller, for the message
/// @throws InvalidInput for an index out of range
template <typename PointT>
void checkIndices(const char* name, const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices) {
  for (const pcl::index_t i : indices) {
    if (i < 0 || static_cast<std::size_t>(i) >= cloud.size()) {
      throw InvalidInput(std::string(name) + ": index " + std::to_string(i) + ", must lie in [0, " +
                         std::to_string(cloud.size()) + ")");
    }
  }
}

/// Converts the points that `indices` name to double, before anything is computed; row r is point indices[r].
template <typename PointT>
Points toPoints(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices) {
  Points points(static_cast<Eigen::Index>(indices.size()), 3);
  for (std::size_t r = 0; r < indices.size(); ++r) {
    const PointT& point = cloud[indices[r]];
    points.row(static_cast<Eigen::Index>(r)) << point.x, point.y, point.z;
  }
  return points;
}

/// Finds the k points nearest to each of `points`, itself excluded, with a search of PCL.
/// @param search gets the finite points as input, each once
/// @return row numbers of `points`; missing ones are -1
template <typename PointT>
Neighborhoods nearestNeighbors(pcl::search::Search<PointT>& search,
                               const typename pcl::PointCloud<PointT>::ConstPtr& cloud, const pcl::Indices& indices,
                               const Points& points, int k) {
  std::vector<int> row(cloud->size(), -1);
  const pcl::IndicesPtr finite(new pcl::Indices);
  for (std::size_t r = 0; r < indices.size(); ++r) {
    const pcl::index_t i = indices[r];
    if (row[i] >= 0 || !points.row(static_cast<Eigen::Index>(r)).allFinite()) continue;
    row[i] = static_cast<int>(r);
    finite->push_back(i);
  }
  const int others = std::max(0, static_cast<int>(finite->size()) - 1);
  Neighborhoods neighborhoods = Neighborhoods::Constant(points.rows(), std::clamp(k, 0, others), -1);
  if (neighborhoods.cols() == 0) return neighborhoods;  // PCL's trees complain about no points

  search.setInputCloud(cloud, finite);
  pcl::Indices found;
  std::vector<float> squared_distances;
  for (const pcl::index_t i : *finite) {
    const int count =
        search.nearestKSearch((*cloud)[i], static_cast<int>(neighborhoods.cols()) + 1, found, squared_distances);
    int column = 0;
    for (int j = 0; j < count && column < neighborhoods.cols(); ++j) {
      if (found[j] != i) neighborhoods(row[i], column++) = row.at(found[j]);
    }
  }
  return neighborhoods;
}

/// The structure of the points that `indices` name in an organized cloud, with the origin of its sensor.
/// @throws InvalidInput for a cloud that is not organized
template <typename PointT>
ScanStructure pixelsOf(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices) {
  if (!cloud.isOrganized()) {
    throw InvalidInput("setOrganizedSearch: the input has height " + std::to_string(cloud.height) +
                       ", must be more than 1 for an organized cloud");
  }
  const ScanStructure whole = imageStructure(static_cast<int>(cloud.width), static_cast<int>(cloud.height));
  ScanStructure structure;
  structure.origin = cloud.sensor_origin_.template head<3>().template cast<double>();
  for (const pcl::index_t i : indices) {
    structure.row.push_back(whole.row.at(i));
    structure.position.push_back(whole.position.at(i));
  }
  return structure;
}

/// Builds the Laplacian of the points that `indices` name. Errors are those of pointCloudLaplacian().
/// @param search finds the neighbours; null: the core does
/// @param organized whether the pixels of the cloud replace a search
template <typename PointT>
Laplacian cloudLaplacian(const typename pcl::PointCloud<PointT>::ConstPtr& cloud, const pcl::Indices& indices,
                         const Points& points, const typename pcl::search::Search<PointT>::Ptr& search, bool organized,
                         CloudOptions options) {
  Neighborhoods neighborhoods;
  ScanStructure structure;
  if (search) {
    neighborhoods = nearestNeighbors<PointT>(*search, cloud, indices, points, options.neighbors);
    options.neighborhoods = &neighborhoods;
    options.structure = nullptr;
  } else if (organized) {
    structure = pixelsOf(*cloud, indices);
    options.structure = &structure;
    options.neighborhoods = nullptr;
  }
  return pointCloudLaplacian(points, options);
}

/// Prints the warnings of a build or of denoise() on PCL's console.
/// @param report of a build or of denoise()
template <class AnyReport>
void sayWarnings(const std::string& class_name, const AnyReport& report) {
  if (report.points == 0) return;
  for (const std::string& sentence : warnings(report))
    PCL_WARN("[tufted::%s] %s\n", class_name.c_str(), sentence.c_str());
}

}  // namespace tufted::detail
