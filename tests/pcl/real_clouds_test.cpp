// Depth images and laser scans, read by PCL: the same results as the core's, and every promise to users of PCL.
#include <gtest/gtest.h>
#include <pcl/common/point_tests.h>
#include <pcl/io/pcd_io.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "pcl/clouds.h"
#include "support/compare.h"
#include "tufted/pcl/laplacian_estimation.h"
#include "tufted/pcl/laplacian_smoothing.h"
#include "tufted/pcl/surface_segmentation.h"

namespace tufted::real_clouds_test {
namespace {

namespace fs = std::filesystem;
using namespace pcl_tests;
using Point = pcl::PointXYZRGB;
using Cloud = pcl::PointCloud<Point>;

class RealClouds : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    const fs::path path = fs::path(TUFTED_DATA_DIR) / "clouds" / (std::string(GetParam()) + ".pcd");
    if (!fs::is_regular_file(path)) GTEST_SKIP() << path << " is absent";
    int code = 0;
    consoleOf([&] { code = pcl::io::loadPCDFile(path.string(), *cloud_); });  // names the fields a file lacks
    ASSERT_EQ(code, 0);
    points_ = pointsOf(*cloud_);
  }

  /// The pixels of a depth image, the other clouds have none.
  std::optional<ScanStructure> pixels() const {
    const int width = static_cast<int>(cloud_->width), height = static_cast<int>(cloud_->height);
    if (!isDepthImage(points_, width, height)) return std::nullopt;
    return imageStructure(width, height);
  }

  /// An eighth of the cloud in its midst: a window of an image, else a run of a scan.
  pcl::IndicesPtr window() const {
    pcl::IndicesPtr indices(new pcl::Indices);
    const std::uint32_t columns = cloud_->width, rows = cloud_->height;
    for (std::uint32_t row = rows / 4; row < std::max(rows / 2, 1U); ++row) {
      for (std::uint32_t column = columns / 4; column < columns / 2; ++column) {
        indices->push_back(static_cast<pcl::index_t>(row * columns + column));
      }
    }
    return indices;
  }

  Cloud::Ptr cloud_{new Cloud};
  Points points_;
};

TEST_P(RealClouds, HaveTheCoresLaplacian) {
  LaplacianEstimation<Point> estimation;
  estimation.setInputCloud(cloud_);
  Laplacian result;
  estimation.compute(result);
  const std::optional<ScanStructure> structure = pixels();
  const Laplacian core = pointCloudLaplacian(points_, {.structure = structure ? &*structure : nullptr});
  EXPECT_TRUE(support::sameBits(result.L, core.L));
  EXPECT_TRUE(support::sameBits(result.M, core.M));
  EXPECT_EQ(result.status, core.status);
  EXPECT_GT(result.report.active, 0);
}

/// For each label above 0 the largest intersection with a list, divided by the union.
std::vector<double> overlaps(const pcl::PointCloud<pcl::PointXYZL>& cloud,
                             const std::vector<pcl::PointIndices>& lists) {
  std::map<std::uint32_t, double> points, best;
  for (const pcl::PointXYZL& p : cloud)
    if (pcl::isFinite(p) && p.label > 0) ++points[p.label];
  for (const pcl::PointIndices& list : lists) {
    std::map<std::uint32_t, double> shared;
    double labelled = 0;
    for (const auto i : list.indices)
      if (cloud[i].label > 0) ++shared[cloud[i].label], ++labelled;
    for (const auto& [label, count] : shared)
      best[label] = std::max(best[label], count / (points[label] + labelled - count));
  }
  std::vector<double> result;
  for (const auto& [label, count] : points) result.push_back(best[label]);
  return result;
}

using LabelledImages = RealClouds;  // depth images with the field label

TEST_P(LabelledImages, HaveTheThingsThatAPersonLabelledAsParts) {
  const pcl::PointCloud<pcl::PointXYZL>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZL>);
  ASSERT_EQ(pcl::io::loadPCDFile((fs::path(TUFTED_DATA_DIR) / "clouds" / (std::string(GetParam()) + ".pcd")).string(),
                                 *cloud),
            0);
  SurfaceSegmentation<pcl::PointXYZL> segmentation;
  segmentation.setInputCloud(cloud);
  segmentation.setMethod(SegmentMethod::parts);
  std::vector<pcl::PointIndices> lists;
  segmentation.segment(lists);
  const std::vector<double> overlap = overlaps(*cloud, lists);
  EXPECT_EQ(overlap.size(), 3U) << "a table and two things";
  for (const double share : overlap) EXPECT_GT(share, 0.97);
}

TEST_P(RealClouds, HaveTheCoresLaplacianInAWindow) {
  const pcl::IndicesPtr indices = window();
  LaplacianEstimation<Point> estimation;
  estimation.setInputCloud(cloud_);
  estimation.setIndices(indices);
  estimation.setOrganizedSearch(false);
  Laplacian result;
  estimation.compute(result);
  const Laplacian core = pointCloudLaplacian(points_(*indices, Eigen::all));
  EXPECT_TRUE(support::sameBits(result.L, core.L));
  EXPECT_TRUE(support::sameBits(result.M, core.M));
  EXPECT_GT(result.report.active, 0);
}

TEST_P(RealClouds, AreSmoothedInPlaceAsByTheCore) {
  const Cloud before = *cloud_;
  const std::optional<ScanStructure> structure = pixels();
  const Laplacian laplacian =
      pointCloudLaplacian(points_, {.keep_cover = false, .structure = structure ? &*structure : nullptr});
  const Points smoothed = smooth(laplacian, points_, {.time_step = 4});
  LaplacianSmoothing<Point> smoothing;
  smoothing.setInputCloud(cloud_);
  smoothing.setTimeStep(4);
  smoothing.filter(*cloud_);
  EXPECT_TRUE(samePositions(pointsOf(*cloud_), rounded(smoothed)));
  EXPECT_EQ(cloud_->width, before.width);
  EXPECT_EQ(cloud_->height, before.height);
  EXPECT_EQ(cloud_->is_dense, points_.allFinite());
  for (std::size_t i = 0; i < before.size(); ++i) ASSERT_EQ((*cloud_)[i].rgba, before[i].rgba) << i;
}

TEST_P(RealClouds, MoveInAWindowAndNowhereElse) {
  const pcl::IndicesPtr indices = window();
  LaplacianSmoothing<Point> smoothing;
  smoothing.setInputCloud(cloud_);
  smoothing.setIndices(indices);
  Cloud output;
  smoothing.filter(output);
  std::vector<bool> inside(cloud_->size(), false);
  for (const pcl::index_t i : *indices) inside[i] = true;
  int moved = 0;
  for (std::size_t i = 0; i < cloud_->size(); ++i) {
    const bool same = bytesOf(output[i].data) == bytesOf((*cloud_)[i].data);
    ASSERT_TRUE(same || inside[i]) << i;
    moved += same ? 0 : 1;
  }
  EXPECT_GT(moved, 0);
}

std::string testName(const testing::TestParamInfo<const char*>& info) {
  return info.param;
}

INSTANTIATE_TEST_SUITE_P(Tables, LabelledImages, testing::Values("mosd_learn0", "mosd_learn1"), testName);
INSTANTIATE_TEST_SUITE_P(Scans, RealClouds, testing::Values("office1", "cturtle"), testName);

}  // namespace
}  // namespace tufted::real_clouds_test
