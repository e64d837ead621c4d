#include "bench/moving_least_squares.h"

#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/mls.h>

namespace tufted::bench {

Points movedByLeastSquares(const Points& points, double radius, int order) {
  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const auto& p : points.rowwise())
    cloud->push_back({static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
  pcl::MovingLeastSquares<pcl::PointXYZ, pcl::PointXYZ> mls;
  mls.setInputCloud(cloud);
  mls.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  mls.setSearchRadius(radius);
  mls.setPolynomialOrder(order);
  pcl::PointCloud<pcl::PointXYZ> moved;
  mls.process(moved);
  Points result(static_cast<Eigen::Index>(moved.size()), 3);
  for (Eigen::Index i = 0; i < result.rows(); ++i) {
    const pcl::PointXYZ& p = moved[static_cast<std::size_t>(i)];
    result.row(i) << p.x, p.y, p.z;
  }
  return result;
}

}  // namespace tufted::bench
