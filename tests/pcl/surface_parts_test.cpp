// Distances, segments and triangles of PCL clouds are the core's.
#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <cmath>

#include "pcl/clouds.h"
#include "shapes/shapes.h"
#include "tufted/pcl/geodesic_distance.h"
#include "tufted/pcl/laplacian_estimation.h"
#include "tufted/pcl/laplacian_smoothing.h"
#include "tufted/pcl/surface_segmentation.h"
#include "tufted/pcl/surface_triangulation.h"
#include "tufted/tufted.h"

namespace tufted::surface_parts_test {
namespace {

using namespace pcl_tests;

using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;

/// Two spheres, of radius 1 with 1200 points and a NaN, and far away a smaller one.
Cloud::Ptr twoBodies() {
  const Points large = shapes::sphere(1200).points,
               small = 0.5 * shapes::sphere(400, shapes::Sampling::uniform, 2).points;
  Points points(1600, 3);
  points << large, small.rowwise() + Eigen::RowVector3d(9, 0, 0);
  points.row(5).setConstant(NAN);
  return cloudOf(points);
}

std::vector<std::vector<int>> segmentsOf(SurfaceSegmentation<Point>& segmentation) {
  std::vector<pcl::PointIndices> clusters(3);
  segmentation.segment(clusters);
  std::vector<std::vector<int>> lists;
  for (const auto& cluster : clusters) lists.emplace_back(cluster.indices.begin(), cluster.indices.end());
  return lists;
}

TEST(GeodesicDistance, IsTheCores) {
  const Cloud::Ptr cloud = twoBodies();
  cloud->header.frame_id = "map";
  const Laplacian laplacian = pointCloudLaplacian(pointsOf(*cloud));
  const VectorXd core = DistanceSolver(laplacian).query({0, 17});
  GeodesicDistance<Point> distance;
  distance.setInputCloud(cloud);
  distance.setSources({0, 17});
  pcl::PointCloud<pcl::PointXYZI> output;
  distance.compute(output);
  ASSERT_EQ(output.size(), 1600U);
  EXPECT_TRUE(samePositions(pointsOf(output), pointsOf(*cloud)));
  EXPECT_EQ(output.header.frame_id, "map");
  EXPECT_FALSE(output.is_dense);
  for (int i = 0; i < 1600; ++i) {
    ASSERT_TRUE(i == 5 || output[i].intensity == static_cast<float>(core[i])) << i;
  }
  EXPECT_TRUE(std::isnan(output[5].intensity)) << "takes no part";
  EXPECT_TRUE(std::isinf(output[1500].intensity)) << "no path";
}

TEST(GeodesicDistance, KeepsAnOrganizedCloudAndTakesIndicesAndASurface) {
  Cloud::Ptr cloud = cloudOf(shapes::depthCamera({.width = 80, .height = 60}).points);
  cloud->width = 80;
  cloud->height = 60;
  LaplacianEstimation<Point> estimation;
  estimation.setInputCloud(cloud);
  const auto surface = estimation.compute();
  int source = 0;
  while (surface->status[source] != PointStatus::active) ++source;
  GeodesicDistance<Point> distance;
  distance.setInputCloud(cloud);
  distance.setSources({source});
  pcl::PointCloud<pcl::PointXYZI> own, shared, some;
  distance.compute(own);
  EXPECT_EQ(own.width, 80U);
  EXPECT_EQ(own.height, 60U);
  distance.setSurface(surface);
  distance.compute(shared);
  distance.compute(shared);  // with what was prepared before
  const pcl::IndicesPtr indices(new pcl::Indices{4000, source, 17});
  distance.setIndices(indices);
  distance.compute(some);
  for (std::size_t i = 0; i < own.size(); ++i)
    ASSERT_TRUE(own[i].intensity == shared[i].intensity || std::isnan(own[i].intensity)) << i;
  ASSERT_EQ(some.size(), 3U);
  EXPECT_EQ(some[1].intensity, 0);
  EXPECT_EQ(bytesOf(some[0].intensity), bytesOf(own[4000].intensity));
}

TEST(GeodesicDistance, WithinARadiusFindsThePointsThatAreNear) {
  const Cloud::Ptr cloud = twoBodies();
  GeodesicDistance<Point> distance;
  distance.setInputCloud(cloud);
  distance.setSources({0});
  pcl::PointCloud<pcl::PointXYZI> all;
  distance.compute(all);
  pcl::Indices found, expected;
  std::vector<float> distances;
  const int count = distance.radiusSearch(0.5, found, distances);
  EXPECT_EQ(count, static_cast<int>(found.size()));
  for (int i = 0; i < 1600; ++i)
    if (all[i].intensity <= 0.5) expected.push_back(i);
  EXPECT_EQ(found, expected);
  EXPECT_GT(found.size(), 20U);
  ASSERT_EQ(distances.size(), found.size());
  for (std::size_t j = 0; j < found.size(); ++j) EXPECT_EQ(distances[j], all[found[j]].intensity);
  distance.setIndices(pcl::IndicesPtr(new pcl::Indices{found[3], 1500}));
  const pcl::index_t third = found[3];
  EXPECT_EQ(distance.radiusSearch(0.5, found, distances), 1);
  EXPECT_EQ(found, pcl::Indices{third});
}

TEST(GeodesicDistance, SaysMistakesOnTheConsole) {
  GeodesicDistance<Point> distance;
  pcl::PointCloud<pcl::PointXYZI> output(7, 1);
  pcl::Indices found{1};
  std::vector<float> distances;
  EXPECT_NE(consoleOf([&] { distance.compute(output); }).find("No input set"), std::string::npos);
  EXPECT_TRUE(output.empty());
  distance.setInputCloud(twoBodies());
  EXPECT_NE(consoleOf([&] { distance.compute(output); }).find("[tufted::GeodesicDistance::compute] "),
            std::string::npos)
      << "no source";
  distance.setSources({0});
  EXPECT_NE(consoleOf([&] { distance.radiusSearch(-1, found, distances); }).find("radiusSearch] pointsWithin: radius"),
            std::string::npos);
  EXPECT_TRUE(found.empty());
  distance.setSources({1600});
  EXPECT_NE(consoleOf([&] { distance.compute(output); }).find("1600"), std::string::npos);
  EXPECT_TRUE(output.empty());
}

TEST(SurfaceSegmentation, SeparatesComponentsTheLargerFirst) {
  SurfaceSegmentation<Point> segmentation;
  segmentation.setInputCloud(twoBodies());
  const auto lists = segmentsOf(segmentation);
  ASSERT_EQ(lists.size(), 2U);
  EXPECT_EQ(lists[0].size(), 1199U) << "all but the NaN";
  EXPECT_EQ(lists[1].size(), 400U);
  EXPECT_EQ(lists[1].front(), 1200);

  segmentation.setMaxClusterSize(1000);
  EXPECT_EQ(segmentsOf(segmentation), std::vector<std::vector<int>>{lists[1]});
  segmentation.setMinClusterSize(500);
  EXPECT_TRUE(segmentsOf(segmentation).empty());
  segmentation.setMinClusterSize(1);
  segmentation.setIndices(pcl::IndicesPtr(new pcl::Indices{5, 6, 1300, 1299}));
  segmentation.setMaxClusterSize(2);
  EXPECT_EQ(segmentsOf(segmentation), (std::vector<std::vector<int>>{{6}, {1300, 1299}}));
}

TEST(SurfaceSegmentation, PartsAreTheCores) {
  const Cloud::Ptr cloud = twoBodies();
  const auto surface = std::make_shared<Laplacian>(pointCloudLaplacian(pointsOf(*cloud)));
  SurfaceSegmentation<Point> own, shared;
  own.setInputCloud(cloud);
  shared.setInputCloud(cloud);
  shared.setSurface(surface);
  for (const SegmentMethod method : {SegmentMethod::voronoi, SegmentMethod::spectral}) {
    const Segments core = segments(*surface, {.method = method, .count = 6});
    std::vector<std::vector<int>> expected(6);
    for (int i = 0; i < 1600; ++i)
      if (core.labels[i] >= 0) expected[core.labels[i]].push_back(i);
    for (SurfaceSegmentation<Point>* segmentation : {&own, &shared}) {
      segmentation->setNumberOfSegments(6);
      segmentation->setMethod(method);
      EXPECT_EQ(segmentsOf(*segmentation), expected);
    }
  }
  for (SurfaceSegmentation<Point>* segmentation : {&own, &shared}) {
    segmentation->setMethod(SegmentMethod::parts);
    segmentation->setNumberOfSegments(0);
    EXPECT_EQ(segmentsOf(*segmentation).size(), 2U) << "the bodies are convex";
  }
  own.setNumberOfSegments(-2);
  std::vector<std::vector<int>> lists;
  EXPECT_NE(consoleOf([&] { lists = segmentsOf(own); }).find("[tufted::SurfaceSegmentation::segment] "),
            std::string::npos);
  EXPECT_TRUE(lists.empty());
}

TEST(SurfaceTriangulation, IsTheCoresOverTheInput) {
  const Cloud::Ptr cloud = twoBodies();
  const Laplacian laplacian = pointCloudLaplacian(pointsOf(*cloud));
  const Triangles core = surfaceTriangles(laplacian);
  SurfaceTriangulation<Point> triangulation;
  triangulation.setInputCloud(cloud);
  pcl::PolygonMesh mesh;
  triangulation.reconstruct(mesh);
  ASSERT_EQ(static_cast<Eigen::Index>(mesh.polygons.size()), core.rows());
  ASSERT_EQ(core.rows(), 2 * 1199 - 4 + 2 * 400 - 4) << "closed spheres";
  for (Eigen::Index f = 0; f < core.rows(); ++f) {
    for (int corner = 0; corner < 3; ++corner)
      ASSERT_EQ(static_cast<int>(mesh.polygons[f].vertices[corner]), core(f, corner));
  }
  Cloud corners;
  pcl::fromPCLPointCloud2(mesh.cloud, corners);
  EXPECT_TRUE(samePositions(pointsOf(corners), pointsOf(*cloud)));

  // With a surface that was built before, and with indices.
  triangulation.setSurface(std::make_shared<Laplacian>(laplacian));
  std::vector<pcl::Vertices> polygons;
  triangulation.reconstruct(polygons);
  EXPECT_EQ(polygons.size(), mesh.polygons.size());
  const pcl::IndicesPtr small(new pcl::Indices);
  for (int i = 1200; i < 1600; ++i) small->push_back(i);
  triangulation.setIndices(small);
  triangulation.reconstruct(polygons);
  EXPECT_EQ(polygons.size(), 2U * 400 - 4);
}

TEST(SurfaceTriangulation, SaysMistakesOnTheConsole) {
  SurfaceTriangulation<Point> triangulation;
  pcl::PolygonMesh mesh;
  mesh.polygons.resize(3);
  EXPECT_NE(consoleOf([&] { triangulation.reconstruct(mesh); }).find("No input set"), std::string::npos);
  EXPECT_TRUE(mesh.polygons.empty());
  triangulation.setInputCloud(twoBodies());
  triangulation.setKSearch(2);
  EXPECT_NE(consoleOf([&] { triangulation.reconstruct(mesh); }).find("SurfaceTriangulation::reconstruct] pointCloud"),
            std::string::npos);
  EXPECT_TRUE(mesh.polygons.empty());
  EXPECT_TRUE(mesh.cloud.data.empty());
}

TEST(LaplacianSmoothing, TakesASurfaceAndAPreset) {
  const Cloud::Ptr cloud = cloudOf(withNoise(shapes::sphere(1000), 0.01).points);
  const Points points = pointsOf(*cloud);
  const auto clean = std::make_shared<Laplacian>(pointCloudLaplacian(points, cloudOptions(Preset::clean)));
  const Points expected = rounded(smooth(*clean, points));
  LaplacianSmoothing<Point> smoothing;
  smoothing.setInputCloud(cloud);
  Cloud output;
  smoothing.filter(output);
  EXPECT_FALSE(samePositions(pointsOf(output), expected));
  smoothing.setPreset(Preset::clean);
  smoothing.filter(output);
  EXPECT_TRUE(samePositions(pointsOf(output), expected));
  smoothing.setPreset(Preset::scan);
  smoothing.setSurface(clean);
  smoothing.filter(output);
  EXPECT_TRUE(samePositions(pointsOf(output), expected));
}

}  // namespace
}  // namespace tufted::surface_parts_test
