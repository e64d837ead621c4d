// LaplacianEstimation is the core's Laplacian, told in PCL's terms.
#include "tufted/pcl/laplacian_estimation.h"

#include <gtest/gtest.h>
#include <pcl/search/brute_force.h>
#include <pcl/search/kdtree.h>
#include <pcl/search/octree.h>

#include <numeric>

#include "pcl/clouds.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "support/compare.h"

namespace tufted::laplacian_estimation_test {
namespace {

using namespace pcl_tests;
using support::sameBits;

using Estimation = LaplacianEstimation<pcl::PointXYZ>;

Laplacian computed(Estimation& estimation) {
  Laplacian result;
  estimation.compute(result);
  return result;
}

bool isEmpty(const Laplacian& laplacian) {
  return laplacian.L.rows() == 0 && laplacian.M.size() == 0 && laplacian.status.empty() &&
         laplacian.report.points == 0 && !laplacian.hasCover();
}

pcl::IndicesPtr indicesOf(const std::vector<int>& list) {
  return pcl::IndicesPtr(new pcl::Indices(list.begin(), list.end()));
}

TEST(LaplacianEstimation, IsTheCoresLaplacianOfTheSameFloats) {
  auto cloud = cloudOf(shapes::torus(3000).points);
  (*cloud)[17].y = nan;  // is_dense still says that there is none
  (*cloud)[20] = (*cloud)[10];
  Estimation estimation;
  estimation.setInputCloud(cloud);
  const Laplacian result = computed(estimation), core = pointCloudLaplacian(pointsOf(*cloud));
  EXPECT_TRUE(sameBits(result.L, core.L));
  EXPECT_TRUE(sameBits(result.M, core.M));
  EXPECT_EQ(result.status, core.status);
  EXPECT_EQ(result.representative, core.representative);
  EXPECT_EQ(result.cover().faces, core.cover().faces);
  EXPECT_EQ(result.status[17], PointStatus::not_finite);
  EXPECT_EQ(result.status[20], PointStatus::coincident);
}

TEST(LaplacianEstimation, LooksForJumpsFromTheSensorOfAnOrganizedCloud) {
  const Eigen::RowVector3d sensor(1, 2, 3);
  auto cloud = cloudOf(shapes::depthCamera({.width = 80, .height = 60}).points.rowwise() + sensor);
  cloud->sensor_origin_ = {1, 2, 3, 0};
  Estimation estimation;
  estimation.setInputCloud(cloud);
  estimation.setOrganizedSearch(false);
  const Points points = pointsOf(*cloud);
  const Eigen::Vector3d viewpoint = sensor;
  const Laplacian seen = pointCloudLaplacian(points, {.viewpoint = &viewpoint}), unseen = pointCloudLaplacian(points);
  ASSERT_NE(seen.boundary, unseen.boundary);
  EXPECT_EQ(computed(estimation).boundary, unseen.boundary);
  cloud->width = 80;
  cloud->height = 60;
  EXPECT_EQ(computed(estimation).boundary, seen.boundary);
  const Eigen::Vector3d elsewhere(-50, 80, 3);
  const auto expected = pointCloudLaplacian(points, {.viewpoint = &elsewhere}).boundary;
  ASSERT_NE(expected, seen.boundary);
  estimation.setOptions({.viewpoint = &elsewhere});
  EXPECT_EQ(computed(estimation).boundary, expected);
  estimation.setOptions({});
  EXPECT_EQ(computed(estimation).boundary, seen.boundary);
  estimation.setViewPoint(-50, 80, 3);
  EXPECT_EQ(computed(estimation).boundary, expected);
}

TEST(LaplacianEstimation, ASensorThatIsNowhereIsAMistake) {
  auto cloud = cloudOf(shapes::depthCamera({.width = 40, .height = 30}).points);
  cloud->width = 40;
  cloud->height = 30;
  Estimation estimation;
  estimation.setInputCloud(cloud);
  EXPECT_EQ(computed(estimation).kind, Kind::cloud);
  cloud->sensor_origin_ = {0, nan, 0, 0};
  for (const bool organized : {false, true}) {
    estimation.setOrganizedSearch(organized);
    Laplacian result;
    const std::string console = consoleOf([&] { estimation.compute(result); });
    EXPECT_NE(console.find("finite"), std::string::npos) << console;
    EXPECT_TRUE(isEmpty(result));
  }
}

TEST(LaplacianEstimation, ByPixelsIsTheCoresByTheImage) {
  const auto scan = shapes::depthCamera({.width = 64, .height = 48}, 3);
  auto cloud = cloudOf(scan.points);
  cloud->width = 64;
  cloud->height = 48;
  const Points points = pointsOf(*cloud);
  Estimation estimation;
  estimation.setInputCloud(cloud);
  const ScanStructure whole = imageStructure(64, 48);
  const CloudOptions options{.structure = &whole};
  const Laplacian by_image = pointCloudLaplacian(points, options), in_space = pointCloudLaplacian(points);
  ASSERT_FALSE(sameBits(by_image.L, in_space.L));
  EXPECT_EQ(estimation.getOrganizedSearch(), OrganizedSearch::automatic);
  EXPECT_TRUE(sameBits(computed(estimation).L, by_image.L)) << "recognised";
  estimation.setOrganizedSearch(false);
  EXPECT_TRUE(sameBits(computed(estimation).L, in_space.L));
  // The image of another camera is not recognised, but may be declared.
  cloud->sensor_origin_ = {1, 2, 3, 0};
  estimation.setOrganizedSearch(OrganizedSearch::automatic);
  EXPECT_TRUE(sameBits(computed(estimation).L, in_space.L));
  cloud->sensor_origin_ = {0, 0, 0, 0};
  estimation.setOrganizedSearch(true);
  EXPECT_EQ(estimation.getOrganizedSearch(), OrganizedSearch::on);
  EXPECT_TRUE(sameBits(computed(estimation).L, by_image.L));

  // With indices, the structure holds the pixels that they name.
  std::vector<int> some;
  ScanStructure structure;
  Points chosen(64 * 48 / 2, 3);
  for (int i = 0; i < 64 * 48 / 2; ++i) {
    some.push_back(2 * i);
    structure.row.push_back(2 * i / 64);
    structure.position.push_back(2 * i % 64);
    chosen.row(i) = points.row(2 * i);
  }
  estimation.setIndices(indicesOf(some));
  const CloudOptions of_some{.structure = &structure};
  for (const OrganizedSearch organized : {OrganizedSearch::on, OrganizedSearch::automatic}) {
    estimation.setOrganizedSearch(organized);
    EXPECT_TRUE(sameBits(computed(estimation).L, pointCloudLaplacian(chosen, of_some).L));
  }
}

TEST(LaplacianEstimation, ByPixelsOfAnUnorganizedCloudIsAMistake) {
  Estimation estimation;
  estimation.setInputCloud(cloudOf(shapes::sphere(100).points));
  estimation.setOrganizedSearch(true);
  Laplacian result;
  const std::string console = consoleOf([&] { estimation.compute(result); });
  EXPECT_NE(console.find("setOrganizedSearch"), std::string::npos) << console;
  EXPECT_TRUE(isEmpty(result));
}

TEST(LaplacianEstimation, OfIndicesIsThatOfTheirPointsAlone) {
  const Points points = shapes::sphere(2000).points;
  const auto cloud = cloudOf(points);
  std::vector<int> half = shapes::Random(5).permutation(2000);
  half.resize(1000);
  half.push_back(half[3]);  // named twice
  Estimation estimation;
  estimation.setInputCloud(cloud);
  estimation.setIndices(indicesOf(half));
  const Laplacian result = computed(estimation);
  const Laplacian core = pointCloudLaplacian(pointsOf(*cloud)(half, Eigen::all));
  EXPECT_TRUE(sameBits(result.L, core.L));
  EXPECT_TRUE(sameBits(result.M, core.M));
  EXPECT_EQ(result.representative[1000], 3);
  EXPECT_EQ(result.L.rows(), 1001);
}

TEST(LaplacianEstimation, WithoutInputLeavesNothing) {
  Estimation estimation;
  Laplacian result = pointCloudLaplacian(shapes::sphere(100).points);
  EXPECT_NE(consoleOf([&] { estimation.compute(result); }).find("No input set"), std::string::npos);
  EXPECT_TRUE(isEmpty(result));
}

TEST(LaplacianEstimation, OfNothingIsEmpty) {
  for (const bool search : {false, true}) {
    Estimation estimation;
    estimation.setInputCloud(cloudOf(Points(0, 3)));
    if (search) estimation.setSearchMethod(Estimation::SearchPtr(new pcl::search::KdTree<pcl::PointXYZ>));
    Laplacian result = pointCloudLaplacian(shapes::sphere(100).points);
    EXPECT_EQ(consoleOf([&] { estimation.compute(result); }), "");
    EXPECT_EQ(result.L.rows(), 0);

    estimation.setInputCloud(cloudOf(Points::Constant(50, 3, NAN)));
    EXPECT_NE(consoleOf([&] { estimation.compute(result); }).find("no point is active: 50 not finite"),
              std::string::npos);
    EXPECT_EQ(result.L.rows(), 50);
    EXPECT_EQ(result.L.nonZeros(), 0);
    EXPECT_EQ(result.report.not_finite, 50);
  }
}

TEST(LaplacianEstimation, TakesAnotherCloudAfterTheFirst) {
  Estimation estimation;
  for (const int n : {1000, 400, 700}) {
    const auto cloud = cloudOf(shapes::sphere(n).points);
    estimation.setInputCloud(cloud);
    EXPECT_TRUE(sameBits(computed(estimation).L, pointCloudLaplacian(pointsOf(*cloud)).L)) << n;
  }
}

template <typename Search>
void expectSameWithSearch(Search* search) {
  // Jittered, so that the core finds its k neighbours enough and looks no further.
  const auto cloud = cloudOf(shapes::sphere(1500, shapes::Sampling::jittered).points);
  cloud->push_back({nan, nan, nan});
  std::vector<int> indices(1501);
  std::iota(indices.rbegin(), indices.rend(), 0);  // places differ from points
  Estimation estimation;
  estimation.setInputCloud(cloud);
  estimation.setIndices(indicesOf(indices));
  const Laplacian own = computed(estimation);
  ASSERT_EQ(own.report.grown_stars + own.report.grown_neighborhoods, 0);
  estimation.setSearchMethod(Estimation::SearchPtr(search));
  const Laplacian searched = computed(estimation);
  EXPECT_EQ(searched.report.rejected_neighbors, 0);
  EXPECT_EQ(searched.report.neighbors, 30);
  EXPECT_TRUE(sameBits(searched.L, own.L));
}

TEST(LaplacianEstimation, TakesTheNeighboursOfAnySearch) {
  expectSameWithSearch(new pcl::search::KdTree<pcl::PointXYZ>);
  expectSameWithSearch(new pcl::search::BruteForce<pcl::PointXYZ>);
  expectSameWithSearch(new pcl::search::Octree<pcl::PointXYZ>(0.1));
}

/// Finds the three points that follow, however near they are.
class Followers : public pcl::search::Search<pcl::PointXYZ> {
 public:
  int nearestKSearch(const pcl::PointXYZ& point, int, pcl::Indices& found, std::vector<float>& squared) const override {
    const auto start = static_cast<pcl::index_t>(&point - input_->data());
    const auto size = static_cast<pcl::index_t>(input_->size());
    found = {start, (start + 1) % size, (start + 2) % size, (start + 3) % size};
    squared.assign(4, 0);
    return 4;
  }
  int radiusSearch(const pcl::PointXYZ&, double, pcl::Indices&, std::vector<float>&, unsigned int) const override {
    return 0;
  }
};

TEST(LaplacianEstimation, BelievesTheSearchItIsGiven) {
  const auto cloud = cloudOf(shapes::sphere(500).points);
  Neighborhoods followers(500, 3);
  for (int i = 0; i < 500; ++i) followers.row(i) << (i + 1) % 500, (i + 2) % 500, (i + 3) % 500;
  Estimation estimation;
  estimation.setInputCloud(cloud);
  estimation.setSearchMethod(Estimation::SearchPtr(new Followers));
  const Laplacian core = pointCloudLaplacian(pointsOf(*cloud), {.neighborhoods = &followers});
  EXPECT_TRUE(sameBits(computed(estimation).L, core.L));
}

TEST(LaplacianEstimation, SaysOnPclsConsoleWhatACallerGotWrong) {
  const auto refusal = [](const std::function<void(Estimation&)>& mistake) {
    Estimation estimation;
    estimation.setInputCloud(cloudOf(shapes::sphere(100).points));
    mistake(estimation);
    Laplacian result = pointCloudLaplacian(shapes::sphere(100).points);
    std::string console = consoleOf([&] { estimation.compute(result); });
    EXPECT_TRUE(isEmpty(result));
    return console;
  };
  const auto expectSaid = [&](const std::string& text, const std::function<void(Estimation&)>& mistake) {
    const std::string console = refusal(mistake);
    EXPECT_NE(console.find("[tufted::LaplacianEstimation::compute] " + text), std::string::npos) << console;
  };
  expectSaid("pointCloudLaplacian: neighbors = 2, must be at least 3", [](auto& e) { e.setKSearch(2); });
  expectSaid("pointCloudLaplacian: neighbors = -5, must be at least 3", [](auto& e) {
    e.setKSearch(-5);
    e.setSearchMethod(Estimation::SearchPtr(new pcl::search::KdTree<pcl::PointXYZ>));
  });
  expectSaid("setIndices: index 100, must lie in [0, 100)", [](auto& e) { e.setIndices(indicesOf({0, 100, 1})); });
  expectSaid("setIndices: index -1, must lie in [0, 100)", [](auto& e) { e.setIndices(indicesOf({-1})); });
  expectSaid("pointCloudLaplacian: mollify = -1", [](auto& e) { e.setOptions({.mollify = -1}); });
  expectSaid("cancelled during", [](auto& e) { e.setOptions({.progress = [](auto, double) { return false; }}); });
}

TEST(LaplacianEstimation, KeepsWhatIsSet) {
  Estimation estimation;
  EXPECT_EQ(estimation.getKSearch(), 30);
  EXPECT_EQ(estimation.getNumberOfThreads(), 0U);
  EXPECT_EQ(estimation.getSearchMethod(), nullptr);
  estimation.setOptions({.neighbors = 12, .paper = {.gluing = Gluing::vertex_pair}});
  estimation.setKSearch(20);
  estimation.setNumberOfThreads(1);
  EXPECT_EQ(estimation.getKSearch(), 20);
  EXPECT_EQ(estimation.getNumberOfThreads(), 1U);
  EXPECT_EQ(estimation.getOptions().paper.gluing, Gluing::vertex_pair);
  EXPECT_EQ(estimation.getClassName(), "LaplacianEstimation");
  const Estimation::ConstPtr shared(new Estimation(estimation));
  EXPECT_EQ(shared->getKSearch(), 20);

  const auto cloud = cloudOf(shapes::sphere(1000).points);
  estimation.setInputCloud(cloud);
  const Laplacian result = computed(estimation);
  EXPECT_EQ(result.report.threads, 1);
  EXPECT_TRUE(sameBits(
      result.L, pointCloudLaplacian(pointsOf(*cloud), {.neighbors = 20, .paper = {.gluing = Gluing::vertex_pair}}).L));
}

}  // namespace
}  // namespace tufted::laplacian_estimation_test
