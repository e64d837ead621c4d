#include "bench/pcl_normals.h"

#include <pcl/features/integral_image_normal.h>
#include <pcl/features/normal_3d.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include <cmath>

#include "base/stage_clock.h"

namespace tufted::bench {

NormalSeconds pclNormalSeconds(const Points& points, int width, int height) {
  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  cloud->resize(static_cast<std::size_t>(points.rows()));
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    pcl::PointXYZ& p = (*cloud)[static_cast<std::size_t>(i)];
    p.getVector3fMap() = points.row(i).transpose().cast<float>();
  }
  cloud->width = static_cast<std::uint32_t>(width);
  cloud->height = static_cast<std::uint32_t>(height);
  cloud->is_dense = false;
  pcl::PointCloud<pcl::Normal> normals;
  NormalSeconds seconds{NAN, NAN};
  Stopwatch watch;
  if (height > 1) {
    pcl::IntegralImageNormalEstimation<pcl::PointXYZ, pcl::Normal> by_integrals;
    by_integrals.setNormalEstimationMethod(by_integrals.AVERAGE_3D_GRADIENT);
    by_integrals.setInputCloud(cloud);
    by_integrals.compute(normals);
    seconds.by_integrals = watch.restart();
  }

  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> by_neighbors;
  by_neighbors.setInputCloud(cloud);
  by_neighbors.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  by_neighbors.setKSearch(30);
  by_neighbors.compute(normals);
  seconds.by_neighbors = watch.restart();
  return seconds;
}

}  // namespace tufted::bench
