// What callers may bring along: neighbourhoods, normals, a progress callback.
#include <gtest/gtest.h>

#include <set>
#include <thread>

#include "neighbors/morton.h"
#include "neighbors/neighbors.h"
#include "shapes/shapes.h"
#include "support/compare.h"
#include "tufted/tufted.h"

namespace tufted::caller_test {
namespace {

/// The k nearest by brute force, as a caller would hand them over.
Neighborhoods bruteForce(const Points& points, int k) {
  Neighborhoods lists(points.rows(), k);
  for (int p = 0; p < points.rows(); ++p) {
    std::vector<std::pair<double, int>> all;
    for (int q = 0; q < points.rows(); ++q) {
      if (q != p) all.emplace_back((points.row(q) - points.row(p)).squaredNorm(), q);
    }
    std::partial_sort(all.begin(), all.begin() + k, all.end());
    for (int j = 0; j < k; ++j) lists(p, j) = all[j].second;
  }
  return lists;
}

TEST(CallersNeighborhoods, AreUsedInsteadOfTheTree) {
  const Points points = shapes::sphere(1500, shapes::Sampling::jittered).points;
  const Neighborhoods lists = bruteForce(points, 30);
  const Laplacian own = pointCloudLaplacian(points), given = pointCloudLaplacian(points, {.neighborhoods = &lists});
  ASSERT_EQ(own.report.grown_stars + own.report.grown_neighborhoods, 0);  // or the lists would differ
  EXPECT_TRUE(support::sameBits(own.L, given.L));
}

TEST(CallersNeighborhoods, AreCheckedAndNeverGrown) {
  const Points points = shapes::sphere(500).points;
  Neighborhoods lists(500, 34);
  lists.leftCols(30) = bruteForce(points, 30);
  for (int p = 0; p < 500; ++p) lists.row(p).tail(4) << p, lists(p, 0), -1, lists(p, 3);  // itself, twice, padding
  const Neighborhoods clean = lists.leftCols(30);
  const Laplacian a = pointCloudLaplacian(points, {.neighborhoods = &lists});
  const Laplacian b = pointCloudLaplacian(points, {.neighborhoods = &clean});
  EXPECT_EQ(a.report.rejected_neighbors, 3 * 500);
  EXPECT_EQ(a.report.grown_stars, 0);
  EXPECT_TRUE(support::sameBits(a.L, b.L));
}

TEST(CallersNormals, AreUsedAtAnyLengthAndSign) {
  const auto sphere = shapes::sphere(2000);
  const Points scaled = -1e-30 * sphere.normals;
  const Laplacian a = pointCloudLaplacian(sphere.points, {.normals = &sphere.normals});
  const Laplacian b = pointCloudLaplacian(sphere.points, {.normals = &scaled});
  EXPECT_LE((a.frames.normals - sphere.normals).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_LE(support::largestDifference(a.L, b.L), 1e-12);
  EXPECT_EQ(a.report.rejected_normals, 0);
}

TEST(CallersNormals, ThatAreUselessAreReplaced) {
  const auto sphere = shapes::sphere(2000);
  Points normals = sphere.normals;
  normals.row(3).setZero();
  normals.row(5).setConstant(NAN);
  const Laplacian laplacian = pointCloudLaplacian(sphere.points, {.normals = &normals});
  EXPECT_EQ(laplacian.report.rejected_normals, 2);
  EXPECT_NEAR(std::abs(laplacian.frames.normals.row(3).dot(sphere.normals.row(3))), 1, 1e-2);
}

TEST(Frames, AreOrthonormalAndTangent) {
  const auto torus = shapes::torus(8000);
  const Frames frames = pointCloudLaplacian(torus.points).frames;
  for (int i = 0; i < 8000; ++i) {
    EXPECT_NEAR(frames.normals.row(i).norm(), 1, 1e-14);
    EXPECT_NEAR(frames.tangents.row(i).norm(), 1, 1e-14);
    EXPECT_NEAR(frames.normals.row(i).dot(frames.tangents.row(i)), 0, 1e-14);
    EXPECT_GT(std::abs(frames.normals.row(i).dot(torus.normals.row(i))), 0.98);
  }
}

TEST(CallersProgress, IsToldEveryStageFromItsOwnThread) {
  std::set<std::string> stages;
  const auto self = std::this_thread::get_id();
  pointCloudLaplacian(shapes::sphere(20000).points,
                      {.threads = 2, .progress = [&](std::string_view stage, double part) {
                         EXPECT_EQ(std::this_thread::get_id(), self);
                         EXPECT_GE(part, 0);
                         EXPECT_LE(part, 1);
                         stages.emplace(stage);
                         return true;
                       }});
  for (const char* stage : {"order", "tree", "stars", "filter", "glue", "flips", "assemble", "done"}) {
    EXPECT_EQ(stages.count(stage), 1U) << stage;
  }
}

TEST(CallersProgress, CancelsAtEveryStage) {
  const Points points = shapes::sphere(1500).points;
  int calls = 0;
  const auto buildUntil = [&](int stop) {  // on one thread, so that every build makes the same calls
    calls = 0;
    pointCloudLaplacian(points, {.threads = 1, .progress = [&](std::string_view, double) { return ++calls < stop; }});
  };
  buildUntil(INT32_MAX);
  const int all = calls;
  for (int stop = 1; stop <= all; ++stop) EXPECT_THROW(buildUntil(stop), Cancelled) << stop << " of " << all;
  const shapes::Mesh mesh = shapes::icosphere(2);
  EXPECT_THROW(meshLaplacian(mesh.points, mesh.triangles, {.progress = [](auto, double) { return false; }}), Cancelled);
}

}  // namespace
}  // namespace tufted::caller_test
