#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <tufted/pcl/laplacian_estimation.h>
#include <tufted/pcl/laplacian_smoothing.h>

#include <cmath>
#include <cstdio>

namespace {

const double pi = std::acos(-1.0);

using Point = pcl::PointNormal;
using Cloud = pcl::PointCloud<Point>;

/// A sphere along a spiral of the golden angle, every other point a little too far out, in two rows.
Cloud roughSphere(int n) {
  Cloud cloud(static_cast<std::uint32_t>(n / 2), 2);
  for (int i = 0; i < n; ++i) {
    const double z = 1 - (2 * i + 1.0) / n;
    const double angle = i * pi * (3 - std::sqrt(5.0));
    const Eigen::Vector3d normal(std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z);
    cloud[i].getVector3fMap() = ((1 + 0.02 * (i % 2)) * normal).cast<float>();
    cloud[i].getNormalVector3fMap() = normal.cast<float>();
  }
  return cloud;
}

Eigen::ArrayXd radii(const Cloud& cloud) {
  Eigen::ArrayXd found(static_cast<Eigen::Index>(cloud.size()));
  for (Eigen::Index i = 0; i < found.size(); ++i) found[i] = cloud[i].getVector3fMap().norm();
  return found;
}

/// Root mean square of the radii's distance from their mean.
double roughness(const Cloud& cloud) {
  return std::sqrt((radii(cloud) - radii(cloud).mean()).square().mean());
}

bool check(const char* what, double found, double expected, double tolerance) {
  if (std::abs(found - expected) <= tolerance) return true;
  std::fprintf(stderr, "%s: %.9g, expected %.9g\n", what, found, expected);
  return false;
}

}  // namespace

// Writes a cloud to the PCD file it is given, reads it back, smooths it in place and measures it.
int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const Cloud rough = roughSphere(4000);
  const Cloud::Ptr cloud(new Cloud);
  if (pcl::io::savePCDFileBinary(argv[1], rough) != 0 || pcl::io::loadPCDFile(argv[1], *cloud) != 0) return 1;

  tufted::LaplacianSmoothing<Point> smoothing;
  smoothing.setInputCloud(cloud);
  smoothing.setSearchMethod(pcl::search::KdTree<Point>::Ptr(new pcl::search::KdTree<Point>));
  smoothing.setTimeStep(4);
  smoothing.filter(*cloud);

  tufted::LaplacianEstimation<Point> estimation;
  estimation.setInputCloud(cloud);
  tufted::Laplacian laplacian;
  estimation.compute(laplacian);

  const double area = 4 * pi * radii(*cloud).square().mean();
  return check("roughness of the input", roughness(rough), 0.01, 1e-4) &
                 check("roughness of the output", roughness(*cloud), 0, 1e-3) &
                 check("area", laplacian.M.sum(), area, 0.1) & check("rows", cloud->height, 2, 0) &
                 check("normals", (*cloud)[7].normal_z, rough[7].normal_z, 0)
             ? 0
             : 1;
}
