// Settings of a build: what is copied, what has precedence, and the memory that stays for the next frame.
#include "tufted/pcl/build_settings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "pcl/clouds.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "support/compare.h"
#include "tufted/pcl/geodesic_distance.h"
#include "tufted/pcl/laplacian_estimation.h"
#include "tufted/pcl/laplacian_smoothing.h"
#include "tufted/pcl/oriented_normal_estimation.h"
#include "tufted/pcl/surface_denoising.h"
#include "tufted/pcl/surface_segmentation.h"
#include "tufted/pcl/surface_triangulation.h"

namespace tufted::build_settings_test {
namespace {

using namespace pcl_tests;
using support::sameBits;

using Estimation = LaplacianEstimation<pcl::PointXYZ>;

Laplacian computed(Estimation& estimation) {
  Laplacian result;
  estimation.compute(result);
  return result;
}

TEST(BuildSettings, OwnsWhatOptionsBorrow) {
  const auto cloud = cloudOf(shapes::sphere(500).points);
  const Points points = pointsOf(*cloud);
  Neighborhoods followers(500, 3);
  for (int i = 0; i < 500; ++i) followers.row(i) << (i + 1) % 500, (i + 2) % 500, (i + 3) % 500;
  Points normals = -points;
  const Laplacian core = pointCloudLaplacian(points, {.normals = &normals, .neighborhoods = &followers});
  Estimation estimation;
  estimation.setInputCloud(cloud);
  estimation.setOptions({.normals = &normals, .neighborhoods = &followers});
  normals.setConstant(NAN);
  followers.setConstant(-7);
  Estimation copy = estimation;
  estimation.setOptions({});
  const Laplacian result = computed(copy);
  EXPECT_TRUE(sameBits(result.L, core.L));
  EXPECT_EQ(result.frames.normals, core.frames.normals);
  copy.setOptions(copy.getOptions());  // which borrow from the object itself
  EXPECT_TRUE(sameBits(computed(copy).L, core.L));
  EXPECT_TRUE(sameBits(computed(estimation).L, pointCloudLaplacian(points).L));
}

TEST(BuildSettings, GivenAStructureDoesNotRecogniseAnother) {
  const auto cloud = cloudOf(shapes::depthCamera({.width = 64, .height = 48}, 3).points);
  cloud->width = 64;
  cloud->height = 48;
  ScanStructure upper = imageStructure(64, 48);
  std::fill(upper.row.begin() + 64 * 24, upper.row.end(), -1);
  const Eigen::Vector3d sensor(0, 0, 0);
  Estimation estimation;
  estimation.setInputCloud(cloud);
  estimation.setOptions({.structure = &upper});
  const Laplacian core = pointCloudLaplacian(pointsOf(*cloud), {.structure = &upper, .viewpoint = &sensor});
  EXPECT_TRUE(sameBits(computed(estimation).L, core.L));
}

TEST(BuildSettings, OptionsDoNotUndoSetters) {
  for (const bool options_first : {true, false}) {
    Estimation estimation;
    const CloudOptions options{.neighbors = 12, .mollify = 0.5, .threads = 3};
    if (options_first) {
      estimation.setOptions(options);
      EXPECT_EQ(estimation.getKSearch(), 12);
      EXPECT_EQ(estimation.getNumberOfThreads(), 3U);
    }
    estimation.setKSearch(20);
    estimation.setNumberOfThreads(1);
    if (!options_first) estimation.setOptions(options);
    EXPECT_EQ(estimation.getKSearch(), 20);
    EXPECT_EQ(estimation.getOptions().neighbors, 20);
    EXPECT_EQ(estimation.getNumberOfThreads(), 1U);
    EXPECT_EQ(estimation.getOptions().threads, 1);
    EXPECT_EQ(estimation.getOptions().mollify, 0.5);
  }
}

TEST(BuildSettings, TakesThePresetsSteps) {
  const auto cloud = cloudOf(withNoise(shapes::sphere(2000), 0.01).points);
  const Points points = pointsOf(*cloud);
  const Laplacian clean = pointCloudLaplacian(points, cloudOptions(Preset::clean));
  ASSERT_FALSE(sameBits(clean.L, pointCloudLaplacian(points).L));
  Estimation estimation;
  estimation.setInputCloud(cloud);
  estimation.setPreset(Preset::clean);
  EXPECT_TRUE(sameBits(computed(estimation).L, clean.L));
}

TEST(BuildSettings, KeepsMemoryForTheNextFrameAndResultsThatAreHeld) {
  const auto sphere = cloudOf(shapes::sphere(800).points), torus = cloudOf(shapes::torus(800).points);
  Estimation estimation;
  estimation.setInputCloud(sphere);
  std::shared_ptr<const Laplacian> first = estimation.compute();
  const Laplacian copy = *first;
  EXPECT_TRUE(sameBits(copy.L, pointCloudLaplacian(pointsOf(*sphere)).L));
  estimation.setInputCloud(torus);
  const std::shared_ptr<const Laplacian> second = estimation.compute();
  EXPECT_NE(second, first);
  EXPECT_TRUE(sameBits(first->L, copy.L)) << "the first frame is still held";
  EXPECT_TRUE(sameBits(second->L, pointCloudLaplacian(pointsOf(*torus)).L));
  // Nobody holds the first frame any more, so its memory serves the third.
  const Laplacian* const memory = first.get();
  first.reset();
  estimation.setInputCloud(sphere);
  const std::shared_ptr<const Laplacian> third = estimation.compute();
  EXPECT_EQ(third.get(), memory);
  EXPECT_TRUE(sameBits(third->L, copy.L));
}

TEST(BuildSettings, AfterAMistakeReturnsAnEmptyLaplacian) {
  Estimation estimation;
  estimation.setInputCloud(cloudOf(shapes::sphere(100).points));
  estimation.setKSearch(2);
  std::shared_ptr<const Laplacian> result;
  EXPECT_NE(consoleOf([&] { result = estimation.compute(); }).find("neighbors = 2"), std::string::npos);
  ASSERT_NE(result, nullptr);
  EXPECT_EQ(result->M.size(), 0);
  EXPECT_EQ(result->L.rows(), 0);
}

TEST(BuildSettings, EveryClassSaysOnPclsConsoleWhatMustBeKnownOfTheSurface) {
  shapes::Random random(103);
  Points volume(600, 3);
  for (double& x : volume.reshaped()) x = random.uniform();
  const auto cloud = cloudOf(volume);
  const auto expectWarning = [&](const std::string& name, auto& object, const auto& compute) {
    object.setInputCloud(cloud);
    const std::string console = consoleOf([&] { compute(); });
    EXPECT_NE(console.find("[tufted::" + name + "] the neighbourhoods of "), std::string::npos) << console;
    EXPECT_NE(console.find("as thick as wide"), std::string::npos) << console;
  };
  Estimation estimation;
  expectWarning("LaplacianEstimation", estimation, [&] { estimation.compute(); });
  LaplacianSmoothing<pcl::PointXYZ> smoothing;
  pcl::PointCloud<pcl::PointXYZ> smoothed;
  expectWarning("LaplacianSmoothing", smoothing, [&] { smoothing.filter(smoothed); });
  GeodesicDistance<pcl::PointXYZ> distance;
  pcl::PointCloud<pcl::PointXYZI> distances;
  distance.setSources({0});
  expectWarning("GeodesicDistance", distance, [&] { distance.compute(distances); });
  SurfaceSegmentation<pcl::PointXYZ> segmentation;
  std::vector<pcl::PointIndices> segments;
  expectWarning("SurfaceSegmentation", segmentation, [&] { segmentation.segment(segments); });
  OrientedNormalEstimation<pcl::PointXYZ, pcl::Normal> normals;
  pcl::PointCloud<pcl::Normal> computed_normals;
  expectWarning("OrientedNormalEstimation", normals, [&] { normals.compute(computed_normals); });
  SurfaceTriangulation<pcl::PointXYZ> triangulation;
  std::vector<pcl::Vertices> triangles;
  expectWarning("SurfaceTriangulation", triangulation, [&] { triangulation.reconstruct(triangles); });
}

TEST(BuildSettings, FiltersSayOnPclsConsoleThatPixelsAreMissing) {
  shapes::Random random(104);
  Points points(80 * 60, 3);
  for (int i = 0; i < points.rows(); ++i) {
    points.row(i) << (i % 80 - 40) / 50., (i / 80 - 30) / 50., 1;
    if (random.uniform() < 0.6) points.row(i).setConstant(nan);
  }
  const auto cloud = cloudOf(points);
  cloud->width = 80;
  cloud->height = 60;
  pcl::PointCloud<pcl::PointXYZ> output;
  const auto expectWarning = [&](auto& filter) {
    filter.setInputCloud(cloud);
    filter.setOrganizedSearch(true);
    const std::string console = consoleOf([&] { filter.filter(output); });
    EXPECT_NE(console.find("fewer than half of the pixels hold points"), std::string::npos) << console;
  };
  LaplacianSmoothing<pcl::PointXYZ> smoothing;
  expectWarning(smoothing);
  SurfaceDenoising<pcl::PointXYZ> denoising;
  expectWarning(denoising);
}

}  // namespace
}  // namespace tufted::build_settings_test
