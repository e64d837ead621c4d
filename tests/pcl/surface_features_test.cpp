// The features of PCL clouds hold what the core computes, in float, under the conventions of pcl::Feature.
#include <gtest/gtest.h>
#include <pcl/search/kdtree.h>

#include <algorithm>
#include <cmath>

#include "pcl/clouds.h"
#include "pcl/values.h"
#include "shapes/shapes.h"
#include "tufted/pcl/laplacian_estimation.h"
#include "tufted/pcl/oriented_normal_estimation.h"
#include "tufted/pcl/principal_curvature_estimation.h"
#include "tufted/pcl/spectral_signature_estimation.h"
#include "tufted/pcl/surface_boundary_estimation.h"
#include "tufted/tufted.h"

namespace tufted::surface_features_test {
namespace {

using namespace pcl_tests;

using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
/// What the core computes, NaN where a point takes no part.
PointValues coreNormals(const Laplacian& laplacian, const Eigen::Vector3d* viewpoint = nullptr) {
  const Frames frames = orientedFrames(laplacian, {.viewpoint = viewpoint});
  PointValues values(laplacian.M.size(), 4);
  values << frames.normals.cast<float>(), curvatures(laplacian, frames).mean.cast<float>();
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    if (laplacian.status[laplacian.representative[i]] != PointStatus::active) values.row(i).setConstant(nan);
  return values;
}

template <class Feature>
PointValues computed(Feature& feature) {
  typename Feature::PointCloudOut output;
  feature.compute(output);
  return valuesOf(output);
}

/// An organized depth image with NaN.
Cloud::Ptr depthImage() {
  Cloud::Ptr cloud = cloudOf(shapes::depthCamera({.width = 80, .height = 60}).points);
  cloud->width = 80;
  cloud->height = 60;
  cloud->header.frame_id = "camera";
  return cloud;
}

/// A sphere with a NaN, a copy of a point, and a far point that no surface reaches.
Cloud::Ptr oddSphere() {
  Cloud::Ptr cloud = cloudOf(shapes::sphere(2000).points);
  (*cloud)[3].y = nan;
  (*cloud)[10] = (*cloud)[7];
  (*cloud)[20] = Point(90, 0, 0);
  return cloud;
}

TEST(SurfaceFeatures, NormalsAndCurvatureOfASphereAreTheCores) {
  const Cloud::Ptr cloud = cloudOf(shapes::sphere(3000).points);
  OrientedNormalEstimation<Point> normals;
  normals.setInputCloud(cloud);
  const PointValues values = computed(normals);
  EXPECT_TRUE(same(values, coreNormals(pointCloudLaplacian(pointsOf(*cloud)))));
  EXPECT_GT((values.leftCols(3).cast<double>().cwiseProduct(pointsOf(*cloud))).rowwise().sum().minCoeff(), 0.99)
      << "outwards";
  EXPECT_NEAR(values.col(3).mean(), 1, 0.01);
}

TEST(SurfaceFeatures, PrincipalCurvaturesOfATorusAreTheCores) {
  const Cloud::Ptr cloud = cloudOf(shapes::torus(3000).points);
  PrincipalCurvatureEstimation<Point> estimation;
  estimation.setInputCloud(cloud);
  const PointValues values = computed(estimation);
  const Laplacian laplacian = pointCloudLaplacian(pointsOf(*cloud));
  const Curvatures core = curvatures(laplacian, orientedFrames(laplacian));
  PointValues expected(3000, 5);
  expected << core.first.cast<float>(), core.principal.cast<float>();
  EXPECT_TRUE(same(values, expected));
  EXPECT_NEAR(values.col(3).mean(), 2.5, 0.05) << "1 / 0.4 around the tube";

  OrientedNormalEstimation<Point> normals;
  normals.setInputCloud(cloud);
  const PointValues mean = (values.col(3) + values.col(4)) / 2;
  EXPECT_LT((computed(normals).col(3) - mean).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(SurfaceFeatures, KeepAnOrganizedCloudAndItsNaN) {
  const Cloud::Ptr cloud = depthImage();
  const ScanStructure pixels = imageStructure(80, 60);
  const Laplacian laplacian = pointCloudLaplacian(pointsOf(*cloud), {.structure = &pixels});
  ASSERT_GT(laplacian.report.not_finite, 0);
  const Eigen::Vector3d sensor(0, 0, 0);
  OrientedNormalEstimation<Point> normals;
  normals.setInputCloud(cloud);
  pcl::PointCloud<pcl::Normal> output;
  normals.compute(output);
  EXPECT_EQ(output.width, 80U);
  EXPECT_EQ(output.height, 60U);
  EXPECT_EQ(output.header.frame_id, "camera");
  EXPECT_FALSE(output.is_dense);
  EXPECT_TRUE(same(valuesOf(output), coreNormals(laplacian, &sensor)))
      << "pixels are recognised, normals face the sensor";
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    const bool is_there = laplacian.status[i] == PointStatus::active;
    ASSERT_EQ(std::isfinite(output[i].normal_x), is_there) << i;
    ASSERT_TRUE(!is_there || output[i].getNormalVector3fMap().dot((*cloud)[i].getVector3fMap()) < 1e-5) << i;
    ASSERT_EQ(normals.getSurface()->status[i], laplacian.status[i]);
  }
}

TEST(SurfaceFeatures, FaceTheViewPoint) {
  const Cloud::Ptr cloud = cloudOf(shapes::sphere(1500).points);
  OrientedNormalEstimation<Point> normals;
  normals.setInputCloud(cloud);
  normals.setViewPoint(0, 0, 0);  // in the centre
  EXPECT_LT((computed(normals).leftCols(3).cast<double>().cwiseProduct(pointsOf(*cloud))).rowwise().sum().maxCoeff(),
            -0.99);
}

TEST(SurfaceFeatures, APointThatTakesNoPartIsNaN) {
  const Cloud::Ptr cloud = oddSphere();
  OrientedNormalEstimation<Point> normals;
  normals.setInputCloud(cloud);
  pcl::PointCloud<pcl::Normal> output;
  normals.compute(output);
  EXPECT_FALSE(output.is_dense);
  for (const int absent : {3, 20}) EXPECT_TRUE(valuesOf(output).row(absent).array().isNaN().all()) << absent;
  EXPECT_EQ(normals.getSurface()->status[3], PointStatus::not_finite);
  EXPECT_EQ(normals.getSurface()->status[20], PointStatus::isolated);
  EXPECT_TRUE(same(valuesOf(output).row(10), valuesOf(output).row(7))) << "coincident";
  EXPECT_EQ(valuesOf(output).array().isNaN().count(), 8);

  SurfaceBoundaryEstimation<Point> boundary;
  boundary.setInputCloud(cloud);
  pcl::PointCloud<pcl::Boundary> kinds;
  boundary.compute(kinds);
  EXPECT_EQ(kinds[3].boundary_point, 0);
  EXPECT_FALSE(kinds.is_dense);
}

TEST(SurfaceFeatures, PointNormalsHaveThePositionToo) {
  const Cloud::Ptr cloud = oddSphere();
  OrientedNormalEstimation<Point, pcl::PointNormal> normals;
  normals.setInputCloud(cloud);
  pcl::PointCloud<pcl::PointNormal> output;
  normals.compute(output);
  EXPECT_TRUE(samePositions(pointsOf(output), pointsOf(*cloud)));
  OrientedNormalEstimation<Point> alone;
  alone.setInputCloud(cloud);
  pcl::PointCloud<pcl::Normal> expected;
  alone.compute(expected);
  for (std::size_t i = 0; i < output.size(); ++i) {
    if (!std::isfinite(expected[i].curvature)) continue;
    ASSERT_EQ(output[i].getNormalVector3fMap(), expected[i].getNormalVector3fMap()) << i;
    ASSERT_EQ(output[i].curvature, expected[i].curvature) << i;
  }
}

TEST(SurfaceFeatures, WithoutCurvatureTheFieldIsNaN) {
  OrientedNormalEstimation<Point> normals;
  normals.setInputCloud(cloudOf(shapes::sphere(500).points));
  const PointValues with = computed(normals);
  normals.setComputeCurvature(false);
  pcl::PointCloud<pcl::Normal> output;
  normals.compute(output);
  EXPECT_TRUE(same(valuesOf(output).leftCols(3), with.leftCols(3)));
  EXPECT_TRUE(valuesOf(output).col(3).array().isNaN().all());
  EXPECT_TRUE(output.is_dense) << "every point has a normal";
}

TEST(SurfaceFeatures, BoundaryTellsTheKinds) {
  const Cloud::Ptr cloud = depthImage();
  const ScanStructure pixels = imageStructure(80, 60);
  const Laplacian laplacian = pointCloudLaplacian(pointsOf(*cloud), {.structure = &pixels});
  SurfaceBoundaryEstimation<Point> boundary;
  boundary.setInputCloud(cloud);
  const PointValues kinds = computed(boundary);
  for (int i = 0; i < 4800; ++i) ASSERT_EQ(kinds(i, 0), static_cast<float>(laplacian.boundary[i])) << i;
  for (const Boundary kind : {Boundary::none, Boundary::rim, Boundary::jump})
    EXPECT_GT((kinds.array() == static_cast<float>(kind)).count(), 0);

  boundary.setInputCloud(cloudOf(shapes::sphere(1500).points));
  EXPECT_EQ(computed(boundary).maxCoeff(), 0) << "a sphere has no boundary";
}

TEST(SurfaceFeatures, SignaturesAreTheCores) {
  const Cloud::Ptr cloud = oddSphere();
  const Laplacian laplacian = pointCloudLaplacian(pointsOf(*cloud));
  const Spectrum pairs = spectrum(laplacian, 40, {.null_space = false});
  const VectorXd times = heatTimes(pairs, 16), energies = waveEnergies(pairs, 16);
  PointValues heat = heatKernelSignature(laplacian, pairs, times).cast<float>();
  PointValues wave = waveKernelSignature(pairs, 16).cast<float>();
  for (const int absent : {3, 20}) {
    heat.row(absent).setConstant(nan);
    wave.row(absent).setConstant(nan);
  }
  SpectralSignatureEstimation<Point> signature;
  signature.setInputCloud(cloud);
  signature.setEigenpairs(40);
  EXPECT_TRUE(same(computed(signature), heat));
  EXPECT_EQ(signature.getSamples(), std::vector<double>(times.begin(), times.end()));
  signature.setSignature(Signature::wave);
  EXPECT_TRUE(same(computed(signature), wave));
  EXPECT_EQ(signature.getSamples(), std::vector<double>(energies.begin(), energies.end()));

  // Times that the caller gives are used as they are.
  signature.setSignature(Signature::heat);
  std::vector<double> later(times.begin(), times.end());
  for (double& time : later) time *= 2;
  signature.setSamples(later);
  const VectorXd late = 2 * times;
  const PointValues expected = heatKernelSignature(laplacian, pairs, late).cast<float>();
  EXPECT_TRUE(same(computed(signature).row(0), expected.row(0)));
}

TEST(SurfaceFeatures, MoreEigenpairsThanThereAreMeansAll) {
  const Cloud::Ptr cloud = cloudOf(shapes::sphere(60).points);
  SpectralSignatureEstimation<Point> all, many;
  all.setInputCloud(cloud);
  all.setEigenpairs(59);
  many.setInputCloud(cloud);
  EXPECT_EQ(many.getEigenpairs(), 100);
  EXPECT_TRUE(same(computed(many), computed(all)));
}

template <class Feature>
void expectRowsOfIndices(Feature& feature, const Cloud::Ptr& cloud) {
  feature.setInputCloud(cloud);
  const PointValues all = computed(feature);
  const pcl::IndicesPtr some(new pcl::Indices{100, 3, 7, 7, 1999});
  feature.setIndices(some);
  typename Feature::PointCloudOut output;
  feature.compute(output);
  EXPECT_EQ(output.width, 5U);
  EXPECT_EQ(output.height, 1U);
  EXPECT_TRUE(same(valuesOf(output), all(*some, Eigen::all)));

  // A surface that was built before gives the same.
  LaplacianEstimation<Point> estimation;
  estimation.setInputCloud(cloud);
  const auto surface = estimation.compute();
  feature.setSurface(surface);
  EXPECT_TRUE(same(computed(feature), all(*some, Eigen::all)));
  EXPECT_EQ(feature.getSurface(), surface);
}

TEST(SurfaceFeatures, HaveOneRowPerIndexAndTakeASurface) {
  OrientedNormalEstimation<Point> normals;
  expectRowsOfIndices(normals, oddSphere());
  PrincipalCurvatureEstimation<Point> principal;
  expectRowsOfIndices(principal, oddSphere());
  SurfaceBoundaryEstimation<Point> boundary;
  expectRowsOfIndices(boundary, cloudOf(shapes::square(2000).points));
  SpectralSignatureEstimation<Point> signature;
  signature.setEigenpairs(20);
  expectRowsOfIndices(signature, oddSphere());
}

TEST(SurfaceFeatures, TakeNeighboursSearchAndThreadsFromTheBase) {
  const Cloud::Ptr cloud = cloudOf(shapes::sphere(1500, shapes::Sampling::jittered).points);
  const Points points = pointsOf(*cloud);
  const Laplacian few = pointCloudLaplacian(points, {.neighbors = 12});
  OrientedNormalEstimation<Point> normals;
  normals.setInputCloud(cloud);
  normals.setNumberOfThreads(1);
  pcl::Feature<Point, pcl::Normal>& base = normals;  // as a node may know it
  base.setKSearch(12);
  pcl::PointCloud<pcl::Normal> output;
  base.compute(output);
  EXPECT_TRUE(same(valuesOf(output), coreNormals(few)));
  EXPECT_EQ(normals.getSurface()->report.threads, 1);
  normals.setOptions({.neighbors = 20});
  EXPECT_TRUE(same(computed(normals), coreNormals(few))) << "setKSearch decides";
  base.setKSearch(0);
  EXPECT_TRUE(same(computed(normals), coreNormals(pointCloudLaplacian(points, {.neighbors = 20}))));

  base.setKSearch(30);
  const Laplacian many = pointCloudLaplacian(points);
  ASSERT_EQ(many.report.grown_stars + many.report.grown_neighborhoods, 0) << "or the neighbours would differ";
  const pcl::search::KdTree<Point>::Ptr tree(new pcl::search::KdTree<Point>);
  base.setSearchMethod(tree);
  EXPECT_TRUE(same(computed(normals), coreNormals(many)));
  EXPECT_EQ(tree->getInputCloud(), cloud);
}

TEST(SurfaceFeatures, SayOnPclsConsoleWhatACallerGotWrong) {
  const auto expectSaid = [](const std::string& text,
                             const std::function<void(SpectralSignatureEstimation<Point>&)>& mistake) {
    SpectralSignatureEstimation<Point> feature;
    feature.setInputCloud(cloudOf(shapes::sphere(200).points));
    mistake(feature);
    pcl::PointCloud<pcl::Histogram<16>> output(7, 1);
    const std::string console = consoleOf([&] { feature.compute(output); });
    EXPECT_NE(console.find("[tufted::SpectralSignatureEstimation::compute] " + text), std::string::npos) << console;
    EXPECT_TRUE(output.empty());
    EXPECT_EQ(output.width * output.height, 0U);
  };
  expectSaid("pointCloudLaplacian: neighbors = 2", [](auto& f) { f.setKSearch(2); });
  expectSaid("setRadiusSearch: radius = 0.5", [](auto& f) { f.setRadiusSearch(0.5); });
  expectSaid("setSearchSurface: is another cloud",
             [](auto& f) { f.setSearchSurface(cloudOf(shapes::sphere(100).points)); });
  expectSaid("setIndices: index 200", [](auto& f) { f.setIndices(pcl::IndicesPtr(new pcl::Indices{200})); });
  expectSaid("setSurface: the Laplacian has 100 rows, must have 200", [](auto& f) {
    f.setSurface(std::make_shared<Laplacian>(pointCloudLaplacian(shapes::sphere(100).points)));
  });
  expectSaid("setEigenpairs: count = 1", [](auto& f) { f.setEigenpairs(1); });
  expectSaid("setSamples: 3 values, must be 16", [](auto& f) { f.setSamples({1, 2, 3}); });
}

TEST(SurfaceFeatures, WithoutInputOrPointsAreEmpty) {
  OrientedNormalEstimation<Point> normals;
  pcl::PointCloud<pcl::Normal> output(7, 1);
  EXPECT_NE(consoleOf([&] { normals.compute(output); }).find("No input set"), std::string::npos);
  EXPECT_TRUE(output.empty());
  output.resize(7);
  normals.setInputCloud(cloudOf(Points(0, 3)));
  EXPECT_EQ(consoleOf([&] { normals.compute(output); }), "");
  EXPECT_TRUE(output.empty());

  const Cloud::Ptr nowhere = cloudOf(Points::Constant(50, 3, NAN));
  SpectralSignatureEstimation<Point> signature;
  for (pcl::PCLBase<Point>* feature : std::initializer_list<pcl::PCLBase<Point>*>{&normals, &signature})
    feature->setInputCloud(nowhere);
  const std::string console = consoleOf([&] {
    EXPECT_TRUE(computed(normals).array().isNaN().all());
    EXPECT_TRUE(computed(signature).array().isNaN().all());
  });
  EXPECT_NE(console.find("no point is active: 50 not finite"), std::string::npos) << console;
  EXPECT_EQ(console.find("ERROR"), std::string::npos) << console;
}

}  // namespace
}  // namespace tufted::surface_features_test
