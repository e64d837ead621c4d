#include "bench/pcl_rivals.h"

#include <pcl/features/integral_image_normal.h>
#include <pcl/features/normal_3d.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/mls.h>

#include <cmath>

#include "base/stage_clock.h"

namespace tufted::bench {
namespace {

pcl::PointCloud<pcl::PointXYZ>::Ptr cloudOf(const Points& points) {
  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  cloud->resize(static_cast<std::size_t>(points.rows()));
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    (*cloud)[static_cast<std::size_t>(i)].getVector3fMap() = points.row(i).transpose().cast<float>();
  return cloud;
}

}  // namespace

Points movedByLeastSquares(const Points& points, double radius, int order) {
  const auto cloud = cloudOf(points);
  pcl::MovingLeastSquares<pcl::PointXYZ, pcl::PointXYZ> mls;
  mls.setInputCloud(cloud);
  mls.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  mls.setSearchRadius(radius);
  mls.setPolynomialOrder(order);
  pcl::PointCloud<pcl::PointXYZ> moved;
  mls.process(moved);
  Points result(static_cast<Eigen::Index>(moved.size()), 3);
  for (Eigen::Index i = 0; i < result.rows(); ++i)
    result.row(i) = moved[static_cast<std::size_t>(i)].getVector3fMap().transpose().cast<double>();
  return result;
}

NormalSeconds pclNormalSeconds(const Points& points, int width, int height) {
  const auto cloud = cloudOf(points);
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
