#pragma once

#include <gtest/gtest.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <string_view>

#include "tufted/types.h"

/// Clouds of PCL for the tests, and back.
namespace tufted::pcl_tests {

inline constexpr float nan = std::numeric_limits<float>::quiet_NaN();

template <typename PointT = pcl::PointXYZ>
typename pcl::PointCloud<PointT>::Ptr cloudOf(const Points& points) {
  typename pcl::PointCloud<PointT>::Ptr cloud(new pcl::PointCloud<PointT>);
  cloud->resize(static_cast<std::size_t>(points.rows()));
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    (*cloud)[i].getVector3fMap() = points.row(static_cast<Eigen::Index>(i)).transpose().cast<float>();
  }
  cloud->is_dense = points.allFinite();
  return cloud;
}

/// Positions as the cloud holds them: of all points, in double.
template <typename PointT>
Points pointsOf(const pcl::PointCloud<PointT>& cloud) {
  Points points(static_cast<Eigen::Index>(cloud.size()), 3);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    points.row(static_cast<Eigen::Index>(i)) = cloud[i].getVector3fMap().transpose().template cast<double>();
  }
  return points;
}

/// Equal values, NaN where the other is NaN.
inline bool samePositions(const Points& a, const Points& b) {
  return a.rows() == b.rows() && ((a.array() == b.array()) || (a.array().isNaN() && b.array().isNaN())).all();
}

/// The bytes of a value, to tell apart what == does not.
template <typename T>
std::string_view bytesOf(const T& value) {
  return {reinterpret_cast<const char*>(&value), sizeof(value)};
}

/// The positions of a PCL cloud that hold these numbers.
inline Points rounded(const Points& points) {
  return points.cast<float>().cast<double>();
}

/// What is written to PCL's console.
inline std::string consoleOf(const std::function<void()>& call) {
  testing::internal::CaptureStderr();
  call();
  return testing::internal::GetCapturedStderr();
}

}  // namespace tufted::pcl_tests
