// SurfaceDenoising is the core's denoise(), told as a filter of PCL's.
#include "tufted/pcl/surface_denoising.h"

#include <gtest/gtest.h>

#include "pcl/clouds.h"
#include "shapes/shapes.h"

namespace tufted::surface_denoising_test {
namespace {

using namespace pcl_tests;

using Point = pcl::PointXYZRGBNormal;
using Cloud = pcl::PointCloud<Point>;

/// A noisy sphere with a NaN, whose colours say which point is which.
Cloud::Ptr noisySphere() {
  Points points = withNoise(shapes::sphere(4000), 0.01, 7).points;
  points.row(11).setConstant(NAN);
  const Cloud::Ptr cloud = cloudOf<Point>(points);
  cloud->header.frame_id = "scanner";
  for (std::size_t i = 0; i < cloud->size(); ++i) (*cloud)[i].rgba = static_cast<std::uint32_t>(i);
  return cloud;
}

TEST(SurfaceDenoising, IsTheCoresInFloatAndKeepsEverythingElse) {
  const Cloud::Ptr cloud = noisySphere();
  SurfaceDenoising<Point> denoising;
  denoising.setInputCloud(cloud);
  Cloud output;
  denoising.filter(output);
  const DenoisedPoints core = denoise(pointsOf(*cloud));
  EXPECT_TRUE(samePositions(pointsOf(output), rounded(core.positions)));
  EXPECT_EQ(denoising.getReport().moved, core.report.moved);
  EXPECT_GT(core.report.moved, 3900);
  EXPECT_EQ(output.header.frame_id, "scanner");
  EXPECT_FALSE(output.is_dense);
  for (std::size_t i = 0; i < output.size(); ++i) ASSERT_EQ(output[i].rgba, i);
  denoising.filter(*cloud);  // into itself
  EXPECT_TRUE(samePositions(pointsOf(*cloud), pointsOf(output)));
}

TEST(SurfaceDenoising, MovesTheIndicesAlone) {
  const Cloud::Ptr cloud = noisySphere();
  SurfaceDenoising<Point> denoising;
  denoising.setInputCloud(cloud);
  denoising.setIndices(pcl::IndicesPtr(new pcl::Indices{5, 11, 100}));
  Cloud output;
  denoising.filter(output);
  const Points before = pointsOf(*cloud), after = pointsOf(output), all = rounded(denoise(before).positions);
  int moved = 0;
  for (Eigen::Index i = 0; i < 4000; ++i) {
    const bool is_asked = i == 5 || i == 100;
    EXPECT_TRUE(samePositions(after.row(i), is_asked ? all.row(i) : before.row(i))) << i;
    moved += samePositions(after.row(i), before.row(i)) ? 0 : 1;
  }
  EXPECT_EQ(moved, 2);
}

TEST(SurfaceDenoising, MovesThePointsOfADepthImageAlongTheirRays) {
  const shapes::Cloud noisy = withNoise(shapes::sphere(3000), 0.002, 7);
  Points points(3000, 3);
  for (int i = 0; i < 3000; ++i)
    points.row(i) = Eigen::RowVector3d((i % 60 - 30) / 100.0, (i / 60 - 25) / 100.0, 1) * noisy.points.row(i).norm();
  const Cloud::Ptr cloud = cloudOf<Point>(points);
  SurfaceDenoising<Point> denoising;
  denoising.setInputCloud(cloud);
  denoising.setOrganizedSearch(true);
  Cloud output;
  EXPECT_NE(consoleOf([&] { denoising.filter(output); }).find("setOrganizedSearch"), std::string::npos);
  EXPECT_TRUE(output.empty());
  cloud->width = 60;
  cloud->height = 50;
  denoising.filter(output);
  const ScanStructure structure = imageStructure(60, 50);
  const DenoisedPoints core = denoise(pointsOf(*cloud), {.structure = &structure});
  EXPECT_TRUE(samePositions(pointsOf(output), rounded(core.positions)));
  EXPECT_GT(core.report.moved, 2900);
  EXPECT_EQ(denoising.getReport().noise, core.report.noise);
  denoising.setOrganizedSearch(OrganizedSearch::automatic);
  denoising.filter(output);
  EXPECT_TRUE(samePositions(pointsOf(output), rounded(core.positions))) << "recognised";
  denoising.setOrganizedSearch(false);
  denoising.filter(output);
  EXPECT_TRUE(samePositions(pointsOf(output), rounded(denoise(pointsOf(*cloud)).positions)));
  EXPECT_FALSE(samePositions(pointsOf(output), rounded(core.positions)));
}

TEST(SurfaceDenoising, TellsMistakesOnTheConsole) {
  SurfaceDenoising<Point> denoising;
  denoising.setInputCloud(noisySphere());
  denoising.setIndices(pcl::IndicesPtr(new pcl::Indices{5000}));
  Cloud output;
  const std::string said = consoleOf([&] { denoising.filter(output); });
  EXPECT_NE(said.find("SurfaceDenoising"), std::string::npos) << said;
  EXPECT_TRUE(output.empty());
}

}  // namespace
}  // namespace tufted::surface_denoising_test
