// 06_things_on_a_table FILE: segments an organized PCD file whose field `label` numbers things (1: the table, more:
// what stands on it, 0: no label) by the parts of tufted and by three classes of PCL, and prints how well each finds
// the things. A way of PCL has one parameter with several values, of which the one with the best result counts.
#include <pcl/common/io.h>
#include <pcl/console/print.h>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/io/pcd_io.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/conditional_euclidean_clustering.h>
#include <pcl/segmentation/lccp_segmentation.h>
#include <pcl/segmentation/region_growing.h>
#include <pcl/segmentation/supervoxel_clustering.h>
#include <tufted/pcl/surface_segmentation.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace {

using Labelled = pcl::PointCloud<pcl::PointXYZL>;
constexpr int k = 30;
constexpr int fewest = 100;  // points of a segment that counts

/// How well segments find the things: for each label the best ratio of the intersection with a segment to the union.
struct Score {
  double worst = 1, mean = 0;
  int things = 0, found = 0, segments = 0;  // found: with a ratio above 0.9

  Score(const Labelled& cloud, const std::vector<std::uint32_t>& segment) {
    std::map<std::uint32_t, std::size_t> of_segment, of_label;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> of_both;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (!pcl::isFinite(cloud[i]) || cloud[i].label == 0) continue;
      ++of_label[cloud[i].label];
      if (segment[i] == 0) continue;
      ++of_segment[segment[i]];
      ++of_both[{cloud[i].label, segment[i]}];
    }
    for (const auto& [label, points] : of_label) {
      double best = 0;
      for (const auto& [both, shared] : of_both)
        if (both.first == label)
          best = std::max(best,
                          static_cast<double>(shared) / static_cast<double>(points + of_segment[both.second] - shared));
      ++things;
      worst = std::min(worst, best);
      mean += best;
      found += best > 0.9 ? 1 : 0;
    }
    mean /= std::max(things, 1);
    segments = static_cast<int>(
        std::count_if(of_segment.begin(), of_segment.end(), [](const auto& s) { return s.second >= fewest; }));
  }
};

std::vector<std::uint32_t> numbered(std::size_t points, const std::vector<pcl::PointIndices>& lists) {
  std::vector<std::uint32_t> segment(points, 0);
  for (std::size_t s = 0; s < lists.size(); ++s)
    for (const auto i : lists[s].indices) segment[i] = static_cast<std::uint32_t>(s + 1);
  return segment;
}

using Way = std::function<std::vector<std::uint32_t>(double)>;

/// Prints the best result over the values of the parameter, and the processor time of one run.
void report(const Labelled& cloud, const std::string& name, const std::vector<double>& values, const Way& way) {
  double best_value = 0, seconds = 0;
  Score best(cloud, std::vector<std::uint32_t>(cloud.size(), 0));
  for (const double value : values) {
    const std::clock_t start = std::clock();
    const Score score(cloud, way(value));
    if (value != values.front() && score.mean <= best.mean) continue;
    best = score;
    best_value = value;
    seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  }
  std::printf("  %-34s %7.3g %4d of %d %8.3f %8.3f %9d %8.2f\n", name.c_str(), best_value, best.found, best.things,
              best.mean, best.worst, best.segments, seconds);
}

/// By regions of smooth normals or, with a condition, of neighbours whose normals are nearly equal or meet convexly.
void normalsOfPcl(const Labelled::Ptr& cloud, const pcl::IndicesPtr& finite) {
  using Oriented = pcl::PointXYZLNormal;
  const pcl::search::KdTree<pcl::PointXYZL>::Ptr tree(new pcl::search::KdTree<pcl::PointXYZL>);
  const pcl::PointCloud<pcl::Normal>::Ptr normals(new pcl::PointCloud<pcl::Normal>);
  const auto findNormals = [&] {
    pcl::NormalEstimationOMP<pcl::PointXYZL, pcl::Normal> estimation(1);
    estimation.setInputCloud(cloud);
    estimation.setSearchMethod(tree);
    estimation.setKSearch(k);
    estimation.compute(*normals);
  };
  report(*cloud, "pcl::RegionGrowing, degrees", {1, 2, 4, 8}, [&](double degrees) {
    findNormals();
    pcl::RegionGrowing<pcl::PointXYZL, pcl::Normal> growing;
    growing.setInputCloud(cloud);
    growing.setIndices(finite);
    growing.setInputNormals(normals);
    growing.setSearchMethod(tree);
    growing.setNumberOfNeighbours(k);
    growing.setMinClusterSize(fewest);
    growing.setSmoothnessThreshold(static_cast<float>(degrees * M_PI / 180));
    growing.setCurvatureThreshold(0.05F);
    std::vector<pcl::PointIndices> lists;
    growing.extract(lists);
    return numbered(cloud->size(), lists);
  });
  report(*cloud, "pcl::ConditionalEuclidean..., m", {0.004, 0.008, 0.016}, [&](double radius) {
    findNormals();
    const pcl::PointCloud<Oriented>::Ptr oriented(new pcl::PointCloud<Oriented>);
    pcl::concatenateFields(*cloud, *normals, *oriented);
    pcl::ConditionalEuclideanClustering<Oriented> clustering;
    clustering.setInputCloud(oriented);
    clustering.setIndices(finite);
    clustering.setClusterTolerance(static_cast<float>(radius));
    clustering.setMinClusterSize(fewest);
    const std::function<bool(const Oriented&, const Oriented&, float)> condition = [](auto& a, auto& b, float) {
      const Eigen::Vector3f na = a.getNormalVector3fMap(), nb = b.getNormalVector3fMap();
      const bool is_convex = (na - nb).dot(a.getVector3fMap() - b.getVector3fMap()) > 0;
      return is_convex || na.dot(nb) > std::cos(10 * static_cast<float>(M_PI) / 180);
    };
    clustering.setConditionFunction(condition);
    pcl::IndicesClusters lists;
    clustering.segment(lists);
    return numbered(cloud->size(), lists);
  });
}

/// Supervoxels that meet convexly; with the extension also where a common neighbour shows it.
void lccp(const Labelled::Ptr& cloud, bool is_extended) {
  const pcl::PointCloud<pcl::PointXYZRGBA>::Ptr colored(new pcl::PointCloud<pcl::PointXYZRGBA>);
  pcl::copyPointCloud(*cloud, *colored);
  const char* const name = is_extended ? "pcl::LCCPSegmentation, extended, m" : "pcl::LCCPSegmentation, m";
  report(*cloud, name, {0.01, 0.02, 0.03, 0.04}, [&](double seed) {
    const float seed_size = static_cast<float>(seed), voxel = seed_size / 4;
    pcl::SupervoxelClustering<pcl::PointXYZRGBA> super(voxel, seed_size);
    super.setInputCloud(colored);
    super.setColorImportance(0);
    super.setSpatialImportance(1);
    super.setNormalImportance(4);
    std::map<std::uint32_t, pcl::Supervoxel<pcl::PointXYZRGBA>::Ptr> voxels;
    super.extract(voxels);
    std::multimap<std::uint32_t, std::uint32_t> adjacency;
    super.getSupervoxelAdjacency(adjacency);
    pcl::LCCPSegmentation<pcl::PointXYZRGBA> segmentation;
    segmentation.setConcavityToleranceThreshold(10);
    segmentation.setSmoothnessCheck(true, voxel, seed_size, 0.1F);
    segmentation.setKFactor(is_extended ? 1 : 0);
    segmentation.setSanityCheck(is_extended);
    segmentation.setInputSupervoxels(voxels, adjacency);
    segmentation.segment();
    const pcl::PointCloud<pcl::PointXYZL>::Ptr labels = super.getLabeledCloud();
    segmentation.relabelCloud(*labels);
    std::vector<std::uint32_t> segment(cloud->size(), 0);
    for (std::size_t i = 0; i < std::min(labels->size(), segment.size()); ++i) segment[i] = (*labels)[i].label;
    return segment;
  });
}

}  // namespace

int main(int argc, char** argv) {
  const Labelled::Ptr cloud(new Labelled);
  if (argc < 2) {
    std::fprintf(stderr, "usage: 06_things_on_a_table FILE\n");
    return 2;
  }
  pcl::console::setVerbosityLevel(pcl::console::L_ERROR);
  if (pcl::io::loadPCDFile(argv[1], *cloud) != 0) return 1;
  const pcl::IndicesPtr finite(new pcl::Indices);
  for (std::size_t i = 0; i < cloud->size(); ++i)
    if (pcl::isFinite((*cloud)[i])) finite->push_back(static_cast<int>(i));

  std::printf(
      "%zu points\n\n  way                                 value    found     mean    worst  segments  seconds\n",
      finite->size());
  report(*cloud, "tufted::SurfaceSegmentation, rad", {tufted::SegmentOptions().crease}, [&](double crease) {
    tufted::SurfaceSegmentation<pcl::PointXYZL> segmentation;
    segmentation.setInputCloud(cloud);
    segmentation.setNumberOfThreads(1);
    segmentation.setMethod(tufted::SegmentMethod::parts);
    segmentation.setCrease(crease);
    std::vector<pcl::PointIndices> lists;
    segmentation.segment(lists);
    return numbered(cloud->size(), lists);
  });
  normalsOfPcl(cloud, finite);
  lccp(cloud, false);
  lccp(cloud, true);
}
