// LaplacianSmoothing is the core's smoothing, told as a filter of PCL's.
#include "tufted/pcl/laplacian_smoothing.h"

#include <gtest/gtest.h>
#include <pcl/search/kdtree.h>

#include <cstring>

#include "pcl/clouds.h"
#include "shapes/shapes.h"

namespace tufted::laplacian_smoothing_test {
namespace {

using namespace pcl_tests;

using Point = pcl::PointXYZRGBNormal;
using Cloud = pcl::PointCloud<Point>;
using Smoothing = LaplacianSmoothing<Point>;

/// An organized depth image with NaN, whose every field says something.
Cloud::Ptr depthImage() {
  const shapes::Cloud room = shapes::depthCamera({.width = 80, .height = 60});
  Cloud::Ptr cloud = cloudOf<Point>(room.points);
  cloud->width = 80;
  cloud->height = 60;
  cloud->header.frame_id = "camera";
  cloud->header.seq = 7;
  cloud->header.stamp = 123456789;
  cloud->sensor_origin_ = {1, 2, 3, 0};
  cloud->sensor_orientation_ = Eigen::Quaternionf(0.5, 0.5, 0.5, 0.5);
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    (*cloud)[i].rgba = static_cast<std::uint32_t>(0x80000000 + i);
    (*cloud)[i].curvature = static_cast<float>(i);
    (*cloud)[i].getNormalVector3fMap() = room.normals.row(static_cast<Eigen::Index>(i)).transpose().cast<float>();
  }
  return cloud;
}

/// Everything but the position is the same, bit for bit.
void expectSameFields(const Cloud& a, const Cloud& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.header, b.header);
  EXPECT_EQ(a.sensor_origin_, b.sensor_origin_);
  EXPECT_EQ(a.sensor_orientation_.coeffs(), b.sensor_orientation_.coeffs());
  for (std::size_t i = 0; i < a.size(); ++i) {
    Point point = a[i];
    std::memcpy(point.data, b[i].data, sizeof(point.data));
    ASSERT_EQ(bytesOf(point), bytesOf(b[i])) << i;
    ASSERT_EQ(a[i].data[3], b[i].data[3]) << i;
  }
}

TEST(LaplacianSmoothing, IsTheCoresInFloatAndKeepsEverythingElse) {
  const Cloud::Ptr cloud = depthImage();
  const Points points = pointsOf(*cloud);
  Smoothing smoothing;
  smoothing.setInputCloud(cloud);
  smoothing.setTimeStep(2.5);
  smoothing.setIterations(2);
  smoothing.setKSearch(20);
  Cloud output;
  smoothing.filter(output);
  const Laplacian laplacian = pointCloudLaplacian(points, {.neighbors = 20});
  const Points smoothed = smooth(laplacian, points, {.time_step = 2.5, .iterations = 2});
  EXPECT_TRUE(samePositions(pointsOf(output), rounded(smoothed)));
  expectSameFields(output, *cloud);
  EXPECT_FALSE(output.is_dense);
  EXPECT_TRUE(samePositions(pointsOf(*cloud), points));  // the input is left alone
  EXPECT_EQ(smoothing.getReport().not_finite, laplacian.report.not_finite);
  EXPECT_GT(laplacian.report.not_finite, 0);
}

TEST(LaplacianSmoothing, OfACloudIntoItselfIsTheSame) {
  const Cloud::Ptr cloud = depthImage();
  Smoothing smoothing;
  smoothing.setInputCloud(cloud);
  Cloud apart;
  smoothing.filter(apart);
  const Cloud before = *cloud;
  smoothing.filter(*cloud);
  EXPECT_TRUE(samePositions(pointsOf(*cloud), pointsOf(apart)));
  EXPECT_FALSE(samePositions(pointsOf(*cloud), pointsOf(before)));
  expectSameFields(*cloud, before);
  EXPECT_EQ(cloud->is_dense, apart.is_dense);
}

TEST(LaplacianSmoothing, MovesTheIndicesAndHoldsTheRest) {
  const Cloud::Ptr cloud = depthImage();
  const Points points = pointsOf(*cloud);
  Smoothing smoothing;
  smoothing.setInputCloud(cloud);
  smoothing.setIndices(10, 20, 30, 40);
  smoothing.setTimeStep(10);
  Cloud output;
  smoothing.filter(output);
  std::vector<std::uint8_t> fixed(cloud->size(), 1);
  for (const auto i : *smoothing.getIndices()) fixed[i] = 0;
  const Laplacian laplacian = pointCloudLaplacian(points);
  EXPECT_TRUE(samePositions(pointsOf(output), rounded(smooth(laplacian, points, {.time_step = 10, .fixed = &fixed}))));
  int moved = 0;
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    const bool same = samePositions(pointsOf(output).row(i), points.row(i));
    EXPECT_TRUE(same || fixed[i] == 0) << i;
    moved += same ? 0 : 1;
  }
  EXPECT_GT(moved, 500);
  expectSameFields(output, *cloud);
  EXPECT_TRUE(smoothing.getRemovedIndices()->empty());

  smoothing.setIndices(pcl::IndicesPtr(new pcl::Indices));  // none
  smoothing.filter(output);
  EXPECT_TRUE(samePositions(pointsOf(output), points));
}

TEST(LaplacianSmoothing, WithoutInputLeavesTheOutputUntouched) {
  Smoothing smoothing;
  Cloud output = *depthImage();
  const Cloud before = output;
  EXPECT_NE(consoleOf([&] { smoothing.filter(output); }).find("No input set"), std::string::npos);
  EXPECT_TRUE(samePositions(pointsOf(output), pointsOf(before)));
  expectSameFields(output, before);
}

TEST(LaplacianSmoothing, OfNothingIsNothing) {
  for (const bool search : {false, true}) {
    Smoothing smoothing;
    if (search) smoothing.setSearchMethod(Smoothing::SearchPtr(new pcl::search::KdTree<Point>));
    Cloud output = *depthImage();
    smoothing.setInputCloud(cloudOf<Point>(Points(0, 3)));
    EXPECT_EQ(consoleOf([&] { smoothing.filter(output); }), "");
    EXPECT_TRUE(output.empty());
    EXPECT_TRUE(output.is_dense);

    const Cloud::Ptr odd = cloudOf<Point>(Points::Constant(30, 3, NAN));
    odd->width = 6;
    odd->height = 5;
    smoothing.setInputCloud(odd);
    EXPECT_NE(consoleOf([&] { smoothing.filter(output); }).find("no point is active: 30 not finite"),
              std::string::npos);
    EXPECT_TRUE(samePositions(pointsOf(output), Points::Constant(30, 3, NAN)));
    EXPECT_EQ(output.width, 6U);
    EXPECT_FALSE(output.is_dense);
  }
}

TEST(LaplacianSmoothing, SaysWhetherTheOutputIsDenseWhateverTheInputSays) {
  const Cloud::Ptr cloud = cloudOf<Point>(shapes::sphere(500).points);
  cloud->is_dense = false;
  Smoothing smoothing;
  smoothing.setInputCloud(cloud);
  Cloud output;
  smoothing.filter(output);
  EXPECT_TRUE(output.is_dense);
  (*cloud)[3].z = nan;
  cloud->is_dense = true;
  smoothing.filter(output);
  EXPECT_FALSE(output.is_dense);
  EXPECT_EQ(output[3].x, (*cloud)[3].x);
}

TEST(LaplacianSmoothing, SaysOnPclsConsoleWhatACallerGotWrong) {
  const auto expectSaid = [](const std::string& text, const std::function<void(Smoothing&)>& mistake) {
    const Cloud::Ptr cloud = depthImage();
    Smoothing smoothing;
    smoothing.setInputCloud(cloud);
    mistake(smoothing);
    Cloud output = *cloud;
    const std::string console = consoleOf([&] { smoothing.filter(output); });
    EXPECT_NE(console.find("[tufted::LaplacianSmoothing::applyFilter] " + text), std::string::npos) << console;
    EXPECT_TRUE(output.empty());
    EXPECT_EQ(output.width * output.height, 0U);
  };
  expectSaid("smooth: time_step = -1,", [](auto& s) { s.setTimeStep(-1); });
  expectSaid("smooth: iterations = 0", [](auto& s) { s.setIterations(0); });
  expectSaid("pointCloudLaplacian: neighbors = 1", [](auto& s) { s.setKSearch(1); });
  expectSaid("setIndices: index 4800, must lie in [0, 4800)",
             [](auto& s) { s.setIndices(pcl::IndicesPtr(new pcl::Indices{4800})); });
}

TEST(LaplacianSmoothing, TakesTheNeighboursOfASearch) {
  const Cloud::Ptr cloud = cloudOf<Point>(shapes::sphere(1500, shapes::Sampling::jittered).points);
  Smoothing smoothing;
  smoothing.setInputCloud(cloud);
  Cloud own, searched;
  smoothing.filter(own);
  ASSERT_EQ(smoothing.getReport().grown_stars, 0);  // or the neighbours would differ
  const Smoothing::SearchPtr search(new pcl::search::KdTree<Point>);
  smoothing.setSearchMethod(search);
  smoothing.filter(searched);
  EXPECT_EQ(search->getInputCloud(), cloud);
  EXPECT_TRUE(samePositions(pointsOf(searched), pointsOf(own)));
}

TEST(LaplacianSmoothing, KeepsWhatIsSet) {
  Smoothing smoothing;
  EXPECT_EQ(smoothing.getTimeStep(), 1);
  EXPECT_EQ(smoothing.getIterations(), 1);
  EXPECT_EQ(smoothing.getKSearch(), 30);
  EXPECT_EQ(smoothing.getNumberOfThreads(), 0U);
  EXPECT_EQ(smoothing.getSearchMethod(), nullptr);
  EXPECT_EQ(smoothing.getClassName(), "LaplacianSmoothing");
  smoothing.setNumberOfThreads(1);
  smoothing.setInputCloud(depthImage());
  const pcl::Filter<Point>::Ptr filter(new Smoothing(smoothing));  // one filter among others
  Cloud output;
  filter->filter(output);
  EXPECT_EQ(static_cast<const Smoothing&>(*filter).getReport().threads, 1);
}

}  // namespace
}  // namespace tufted::laplacian_smoothing_test
