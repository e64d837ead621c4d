// 03_parts FILE MESH: finds segments, distances along the largest one and triangles, and writes these as a PLY file.
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <tufted/pcl/geodesic_distance.h>
#include <tufted/pcl/laplacian_estimation.h>
#include <tufted/pcl/surface_denoising.h>
#include <tufted/pcl/surface_segmentation.h>
#include <tufted/pcl/surface_triangulation.h>

#include <algorithm>
#include <cmath>
#include <iostream>

using Point = pcl::PointXYZ;

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: 03_parts FILE MESH\n";
    return 2;
  }
  const pcl::PointCloud<Point>::Ptr cloud(new pcl::PointCloud<Point>);
  if (pcl::io::loadPCDFile(argv[1], *cloud) != 0) return 1;

  // The triangles have the points of the cloud as corners, so the noise is removed first.
  tufted::SurfaceDenoising<Point> denoising;
  denoising.setInputCloud(cloud);
  denoising.filter(*cloud);

  tufted::LaplacianEstimation<Point> estimation;
  estimation.setInputCloud(cloud);
  const auto surface = estimation.compute();

  tufted::SurfaceSegmentation<Point> segmentation;  // connected components, unless a number of segments is set
  segmentation.setInputCloud(cloud);
  segmentation.setSurface(surface);
  segmentation.setMinClusterSize(100);
  std::vector<pcl::PointIndices> segments;
  segmentation.segment(segments);
  if (segments.empty()) return 1;

  tufted::GeodesicDistance<Point> distance;
  distance.setInputCloud(cloud);
  distance.setSurface(surface);
  distance.setSources({segments[0].indices[0]});
  pcl::PointCloud<pcl::PointXYZI> distances;  // infinite on other components, NaN where there is no surface
  distance.compute(distances);
  float farthest = 0;
  for (const pcl::PointXYZI& point : distances)
    if (std::isfinite(point.intensity)) farthest = std::max(farthest, point.intensity);
  pcl::Indices near;
  std::vector<float> near_distances;
  distance.radiusSearch(farthest / 4, near, near_distances);

  tufted::SurfaceTriangulation<Point> triangulation;
  triangulation.setInputCloud(cloud);
  triangulation.setSurface(surface);
  pcl::PolygonMesh mesh;
  triangulation.reconstruct(mesh);
  std::cout << "segments " << segments.size() << ", the largest of " << segments[0].indices.size() << " points\n"
            << "farthest " << farthest << ", within a quarter of that " << near.size() << "\n"
            << "triangles " << mesh.polygons.size() << "\n";
  return pcl::io::savePLYFileBinary(argv[2], mesh) == 0 ? 0 : 1;
}
