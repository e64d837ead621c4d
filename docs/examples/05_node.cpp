// 05_node FOLDER [STRIDE] [THREADS]: takes the PCD files of a folder, in the order of their names, as a subscriber
// takes messages, and prints the milliseconds of each step and the frames per second. A depth camera at 10 Hz leaves
// 100 ms. Every STRIDE-th row and column of an organized cloud is used (3); THREADS 0: one per processor (0).
#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>
#include <tufted/pcl/geodesic_distance.h>
#include <tufted/pcl/laplacian_estimation.h>
#include <tufted/pcl/oriented_normal_estimation.h>
#include <tufted/pcl/surface_boundary_estimation.h>
#include <tufted/pcl/surface_segmentation.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <vector>

namespace {

using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
constexpr double reach = 0.25;  // in the unit of the cloud, here the length of a gripper in metres

/// Milliseconds that a call takes.
template <class Call>
double milliseconds(const Call& call) {
  const auto start = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// Every stride-th row and column: what a pinhole camera with fewer pixels would see, so it is still recognised as a
/// depth image.
Cloud::Ptr thinned(const Cloud& cloud, std::uint32_t stride) {
  if (cloud.height == 1) return cloud.makeShared();
  Cloud::Ptr thin(new Cloud(cloud.width / stride, cloud.height / stride));
  for (std::uint32_t row = 0; row < thin->height; ++row)
    for (std::uint32_t column = 0; column < thin->width; ++column)
      thin->at(column, row) = cloud.at(column * stride, row * stride);
  thin->header = cloud.header;
  thin->sensor_origin_ = cloud.sensor_origin_;
  thin->is_dense = cloud.is_dense;
  return thin;
}

/// What a node has as members: the classes, which keep their memory from frame to frame.
class Node {
 public:
  explicit Node(unsigned int threads) {
    estimation_.setNumberOfThreads(threads);
    normal_estimation_.setNumberOfThreads(threads);
    normal_estimation_.setComputeCurvature(false);
    segmentation_.setMinClusterSize(100);
  }

  /// The callback of a subscriber.
  /// @return milliseconds of all steps
  double frame(const Cloud::ConstPtr& cloud) {
    std::shared_ptr<const tufted::Laplacian> surface;
    const double build = milliseconds([&] {
      estimation_.setInputCloud(cloud);
      surface = estimation_.compute();
    });
    const double normals = milliseconds([&] {
      normal_estimation_.setInputCloud(cloud);
      normal_estimation_.setSurface(surface);
      normal_estimation_.compute(normals_);
    });
    const double boundary = milliseconds([&] {
      boundary_estimation_.setInputCloud(cloud);
      boundary_estimation_.setSurface(surface);
      boundary_estimation_.compute(boundary_);
    });
    const double segments = milliseconds([&] {
      segmentation_.setInputCloud(cloud);
      segmentation_.setSurface(surface);
      segmentation_.segment(segments_);
    });
    const double near = milliseconds([&] {
      near_.clear();
      if (segments_.empty()) return;
      const pcl::Indices& largest = segments_[0].indices;
      distance_.setInputCloud(cloud);
      distance_.setSurface(surface);
      distance_.setSources({largest[largest.size() / 2]});  // where a robot might stand
      distance_.radiusSearch(reach, near_, near_distances_);
    });
    const double total = build + normals + boundary + segments + near;
    std::printf("%7zu %8.1f %8.1f %8.1f %8.1f %8.1f %8.1f %9zu %7zu\n", cloud->size(), build, normals, boundary,
                segments, near, total, segments_.size(), near_.size());
    return total;
  }

 private:
  tufted::LaplacianEstimation<Point> estimation_;
  tufted::OrientedNormalEstimation<Point> normal_estimation_;
  tufted::SurfaceBoundaryEstimation<Point> boundary_estimation_;
  tufted::SurfaceSegmentation<Point> segmentation_;
  tufted::GeodesicDistance<Point> distance_;
  pcl::PointCloud<pcl::Normal> normals_;
  pcl::PointCloud<pcl::Boundary> boundary_;
  std::vector<pcl::PointIndices> segments_;
  pcl::Indices near_;
  std::vector<float> near_distances_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || !std::filesystem::is_directory(argv[1])) {
    std::fprintf(stderr, "usage: 05_node FOLDER [STRIDE] [THREADS]\n");
    return 2;
  }
  const int stride = argc > 2 ? std::max(1, std::atoi(argv[2])) : 3;
  const int threads = argc > 3 ? std::max(0, std::atoi(argv[3])) : 0;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(argv[1]))
    if (entry.path().extension() == ".pcd") files.push_back(entry.path());
  std::sort(files.begin(), files.end());

  pcl::console::setVerbosityLevel(pcl::console::L_ERROR);  // warnings about a frame would stand between its figures
  Node node(static_cast<unsigned int>(threads));
  std::printf(" points    build  normals boundary segments   within    total  segments  points within reach\n");
  int frames = 0;
  double total = 0;
  for (const std::filesystem::path& file : files) {
    Cloud cloud;
    if (pcl::io::loadPCDFile(file.string(), cloud) != 0) continue;
    total += node.frame(thinned(cloud, static_cast<std::uint32_t>(stride)));
    ++frames;
  }
  if (frames == 0) {
    std::fprintf(stderr, "%s has no PCD file that can be read\n", argv[1]);
    return 1;
  }
  std::printf("%d frames, %.1f frames a second, without reading the files\n", frames, 1000 * frames / total);
}
