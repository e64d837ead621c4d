// 02_features FILE: computes four features of a PCD file from one surface, and counts what they find.
#include <pcl/io/pcd_io.h>
#include <tufted/pcl/laplacian_estimation.h>
#include <tufted/pcl/oriented_normal_estimation.h>
#include <tufted/pcl/principal_curvature_estimation.h>
#include <tufted/pcl/spectral_signature_estimation.h>
#include <tufted/pcl/surface_boundary_estimation.h>

#include <cmath>
#include <iostream>

using Point = pcl::PointXYZ;

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: 02_features FILE\n";
    return 2;
  }
  const pcl::PointCloud<Point>::Ptr cloud(new pcl::PointCloud<Point>);
  if (pcl::io::loadPCDFile(argv[1], *cloud) != 0) return 1;

  // The surface is built once. A feature without setSurface() would build its own.
  tufted::LaplacianEstimation<Point> estimation;
  estimation.setInputCloud(cloud);
  const auto surface = estimation.compute();

  // Each feature is a pcl::Feature, whose output has the width and height of the input. Points that take no part are
  // NaN.
  tufted::OrientedNormalEstimation<Point> normal_estimation;
  normal_estimation.setInputCloud(cloud);
  normal_estimation.setSurface(surface);
  normal_estimation.setComputeCurvature(false);  // as the principal curvatures are computed below
  pcl::PointCloud<pcl::Normal> normals;
  normal_estimation.compute(normals);

  tufted::PrincipalCurvatureEstimation<Point> curvature_estimation;
  curvature_estimation.setInputCloud(cloud);
  curvature_estimation.setSurface(surface);
  pcl::PointCloud<pcl::PrincipalCurvatures> curvatures;
  curvature_estimation.compute(curvatures);

  tufted::SurfaceBoundaryEstimation<Point> boundary_estimation;
  boundary_estimation.setInputCloud(cloud);
  boundary_estimation.setSurface(surface);
  pcl::PointCloud<pcl::Boundary> boundary;
  boundary_estimation.compute(boundary);

  // Signatures need eigenvalues, which take seconds on large clouds. Twenty suffice to tell coarse shapes apart.
  tufted::SpectralSignatureEstimation<Point> signature_estimation;
  signature_estimation.setInputCloud(cloud);
  signature_estimation.setSurface(surface);
  signature_estimation.setEigenpairs(20);
  pcl::PointCloud<pcl::Histogram<16>> signatures;
  signature_estimation.compute(signatures);

  // After a mistake, which PCL's console shows, an output is empty.
  if (normals.size() != cloud->size() || curvatures.size() != cloud->size() || boundary.size() != cloud->size())
    return 1;
  int found = 0, convex = 0, rims = 0, jumps = 0;
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    found += std::isfinite(normals[i].normal_x) ? 1 : 0;
    convex += curvatures[i].pc2 > 0 ? 1 : 0;
    rims += boundary[i].boundary_point == static_cast<int>(tufted::Boundary::rim) ? 1 : 0;
    jumps += boundary[i].boundary_point == static_cast<int>(tufted::Boundary::jump) ? 1 : 0;
  }
  std::cout << "normals " << found << ", convex " << convex << ", at a rim " << rims << ", at a jump " << jumps
            << "\nsignatures " << signatures.size() << "\n";
}
