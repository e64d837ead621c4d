// What a user must know of a build, and what must not be said of good ones.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "shapes/random.h"
#include "shapes/shapes.h"
#include "tufted/tufted.h"

namespace tufted::warnings_test {
namespace {

/// The only warning, or nothing; else all are shown.
std::string onlyOf(const std::vector<std::string>& all) {
  EXPECT_LE(all.size(), 1u) << testing::PrintToString(all);
  return all.empty() ? "" : all.front();
}

bool has(const std::string& text, const char* word) {
  return text.find(word) != std::string::npos;
}

/// Random points on a cylinder as long as 300 of its turns have points.
/// @param around how many spacings it is around, where the area per point is a spacing squared
Points cable(double around, std::uint64_t seed) {
  constexpr int n = 3000;
  shapes::Random random(seed);
  Points points(n, 3);
  const double radius = around / (2 * std::numbers::pi);
  for (int i = 0; i < n; ++i) {
    const double turn = random.uniform(0, 2 * std::numbers::pi);
    points.row(i) << radius * std::cos(turn), radius * std::sin(turn), random.uniform(0, n / around);
  }
  return points;
}

TEST(Warnings, TellOfCablesThatNeighbourhoodsWrapAround) {
  for (const int seed : {101, 102}) {
    for (const double around : {3., 4., 5., 6., 8.}) {
      const Report report = pointCloudLaplacian(cable(around, seed)).report;
      EXPECT_GT(report.thick_neighborhoods, 1000) << around;  // of 3,000; a third of three around lie along lines
      EXPECT_TRUE(has(onlyOf(warnings(report)), "as thick as wide")) << around;
    }
    // With fewer neighbours, and for thicker cables, there is nothing to be said, and areas are right.
    CloudOptions few;
    few.neighbors = 12;
    const Laplacian thin = pointCloudLaplacian(cable(8, seed), few), wide = pointCloudLaplacian(cable(14, seed));
    for (const Laplacian* laplacian : {&thin, &wide}) {
      EXPECT_EQ(onlyOf(warnings(laplacian->report)), "");
      EXPECT_NEAR(laplacian->M.sum(), 3000, 0.06 * 3000);
    }
  }
}

TEST(Warnings, TellOfVolumesAndNotOfCreasesNorNoise) {
  shapes::Random random(103);
  Points volume(3000, 3);
  for (double& x : volume.reshaped()) x = random.uniform();
  EXPECT_TRUE(has(onlyOf(warnings(pointCloudLaplacian(volume).report)), "as thick as wide"));
  EXPECT_EQ(onlyOf(warnings(pointCloudLaplacian(shapes::cubeSurface(600).points).report)), "");
  Points noisy = shapes::sphere(3000).points;
  for (double& x : noisy.reshaped()) x += 0.5 * std::sqrt(4 * std::numbers::pi / 3000) * random.normal();
  EXPECT_EQ(onlyOf(warnings(pointCloudLaplacian(noisy).report)), "");
}

TEST(Warnings, TellOfImagesWhosePixelsAreMissing) {
  constexpr int width = 80, height = 60;
  shapes::Random random(104);
  for (const double missing : {0., 0.2, 0.6, 0.8}) {
    Points points(width * height, 3);
    for (int i = 0; i < points.rows(); ++i) {
      if (random.uniform() < missing)
        points.row(i).setConstant(NAN);
      else
        points.row(i) << (i % width - 40) / 50., (i / width - 30) / 50., 1;
    }
    const ScanStructure image = imageStructure(width, height);
    CloudOptions options;
    options.structure = &image;
    const Report report = pointCloudLaplacian(points, options).report;
    const DenoiseReport denoised = denoise(points, {.structure = &image}).report;
    EXPECT_EQ(denoised.sparse_share, report.sparse_share);
    EXPECT_EQ(sparseShare(points, width, height), report.sparse_share);
    for (const std::string& said : {onlyOf(warnings(report)), onlyOf(warnings(denoised))}) {
      EXPECT_EQ(said.empty(), missing < 0.3) << missing;
      EXPECT_EQ(has(said, "fewer than half of the pixels hold points"), missing > 0.3) << missing;
    }
  }
}

}  // namespace
}  // namespace tufted::warnings_test
