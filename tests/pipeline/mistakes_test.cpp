// A caller's mistake is named, or does no harm.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "shapes/shapes.h"
#include "tufted/tufted.h"

namespace tufted::mistakes_test {
namespace {

TEST(Mistake, NamesFunctionValueAndRule) {
  const Points points = shapes::sphere(100).points;
  const auto message = [&](const CloudOptions& options) -> std::string {
    try {
      pointCloudLaplacian(points, options);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "no error";
  };
  for (const int k : {1, 2, 0, -1}) {
    EXPECT_EQ(message({.neighbors = k}),
              "pointCloudLaplacian: neighbors = " + std::to_string(k) + ", must be at least 3");
  }
  EXPECT_EQ(message({.threads = -2}), "pointCloudLaplacian: threads = -2, must be >= 0");
  EXPECT_NE(message({.mollify = -1}).find("mollify = -1"), std::string::npos);
  EXPECT_NE(message({.mollify = std::nan("")}).find("must lie in [0, 1]"), std::string::npos);
  const Points normals = Points::Ones(99, 3);
  EXPECT_EQ(message({.normals = &normals}), "pointCloudLaplacian: normals has 99 rows, must have 100, one per point");
  Neighborhoods lists = Neighborhoods::Zero(100, 3);
  lists(7, 2) = 100;
  EXPECT_NE(message({.neighborhoods = &lists}).find("neighborhoods(7, 2) = 100"), std::string::npos);
  EXPECT_THROW(pointCloudLaplacian(points, {.keep_cover = false}).cover(), InvalidInput);
}

TEST(Mistake, MoreThreadsThanHelpAreNotStarted) {
  EXPECT_LE(pointCloudLaplacian(shapes::sphere(100).points, {.threads = INT32_MAX}).report.threads, 4096);
}

TEST(Mistake, TooManyNeighboursAreClampedAndReported) {
  for (const int k : {100, 1000000, INT32_MAX}) {
    const Report report = pointCloudLaplacian(shapes::sphere(100).points, {.neighbors = k}).report;
    EXPECT_TRUE(report.neighbors_clamped);
    EXPECT_EQ(report.neighbors, 99);
  }
}

}  // namespace
}  // namespace tufted::mistakes_test
