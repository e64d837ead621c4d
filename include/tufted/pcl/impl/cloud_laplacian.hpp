#pragma once

#include <pcl/point_cloud.h>
#include <pcl/search/search.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tufted/errors.h"
#include "tufted/laplacian.h"
#include "tufted/pcl/build_settings.h"
#include "tufted/pcl/impl/say_warnings.hpp"

/// Conversions between the types of PCL and of the core, for all PCL classes.
namespace tufted::detail {

/// Converts a cloud to double, before anything is computed.
/// @throws InvalidInput for an index out of range
template <typename PointT>
CloudInput inputOf(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices) {
  for (const pcl::index_t i : indices) {
    if (i < 0 || static_cast<std::size_t>(i) >= cloud.size()) {
      throw InvalidInput("setIndices: index " + std::to_string(i) + ", must lie in [0, " +
                         std::to_string(cloud.size()) + ")");
    }
  }
  CloudInput input{.points = Points(static_cast<Eigen::Index>(cloud.size()), 3),
                   .width = static_cast<int>(cloud.width),
                   .height = static_cast<int>(cloud.height),
                   .sensor = cloud.sensor_origin_.template head<3>().template cast<double>()};
  for (std::size_t i = 0; i < cloud.size(); ++i)
    input.points.row(static_cast<Eigen::Index>(i)) << cloud[i].x, cloud[i].y, cloud[i].z;
  return input;
}

/// Finds the k points nearest to each point of `indices`, itself excluded, with a search of PCL.
/// @param search gets the finite points as input, each once
/// @param input of the same cloud
/// @return places in `indices`; missing ones are -1
template <typename PointT>
Neighborhoods nearestNeighbors(pcl::search::Search<PointT>& search,
                               const typename pcl::PointCloud<PointT>::ConstPtr& cloud, const pcl::Indices& indices,
                               const CloudInput& input, int k) {
  std::vector<int> row(cloud->size(), -1);
  const pcl::IndicesPtr finite(new pcl::Indices);
  for (std::size_t r = 0; r < indices.size(); ++r) {
    const pcl::index_t i = indices[r];
    if (row[i] >= 0 || !input.points.row(i).allFinite()) continue;
    row[i] = static_cast<int>(r);
    finite->push_back(i);
  }
  const int others = std::max(0, static_cast<int>(finite->size()) - 1);
  Neighborhoods neighborhoods =
      Neighborhoods::Constant(static_cast<Eigen::Index>(indices.size()), std::clamp(k, 0, others), -1);
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

/// inputOf() for a class that builds from all points of its input, with the neighbours that a search finds.
/// @param search null: the core searches
template <typename PointT>
CloudInput wholeInput(const typename pcl::PointCloud<PointT>::ConstPtr& cloud, const pcl::Indices& indices,
                      const typename pcl::search::Search<PointT>::Ptr& search, int k) {
  CloudInput input = inputOf<PointT>(*cloud, indices);
  if (!search) return input;
  pcl::Indices all(cloud->size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<pcl::index_t>(i);
  input.neighborhoods = nearestNeighbors<PointT>(*search, cloud, all, input, k);
  return input;
}

}  // namespace tufted::detail
