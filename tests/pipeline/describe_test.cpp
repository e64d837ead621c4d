#include "tufted/describe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "shapes/shapes.h"
#include "tufted/errors.h"

namespace tufted::describe_test {
namespace {

Points joined(const Points& a, const Points& b) {
  Points both(a.rows() + b.rows(), 3);
  both << a, b;
  return both;
}

TEST(DescribeCloud, ALatticeHasItsSpacingAndNothingOdd) {
  const CloudDescription description = describeCloud(shapes::squareLattice(60, 0.015625).points);
  EXPECT_EQ(description.points, 3600);
  EXPECT_EQ(description.spacing, 0.015625);
  EXPECT_EQ(description.spacing_low, 0.015625);
  EXPECT_EQ(description.spacing_high, 0.015625);
  EXPECT_NEAR((description.highest - description.lowest).maxCoeff(), 59 * 0.015625, 1e-12);
  EXPECT_EQ(description.not_finite + description.coincident + description.outliers + description.on_lines, 0);
  EXPECT_EQ(description.components, 1);
  EXPECT_EQ(description.neighbors, 30);
}

TEST(DescribeCloud, RandomPointsHaveTheSpacingOfAPoissonProcess) {
  // The distance to the nearest of n points on a sphere of area 4 pi has the median sqrt(4 ln 2 / n).
  const int n = 16000;
  const CloudDescription description = describeCloud(shapes::sphere(n).points);
  EXPECT_NEAR(description.spacing / std::sqrt(4 * std::log(2.0) / n), 1, 0.03);
  EXPECT_EQ(description.outliers, 0);
}

TEST(DescribeCloud, WhatTakesNoPartIsCounted) {
  Points points = shapes::sphere(1000).points;
  points.row(3).setConstant(std::numeric_limits<double>::quiet_NaN());
  points.row(5) = points.row(4);
  points.row(7) = points.row(4);
  const CloudDescription description = describeCloud(points);
  EXPECT_EQ(description.not_finite, 1);
  EXPECT_EQ(description.coincident, 2);
}

TEST(DescribeCloud, PlantedOutliersAreFound) {
  Points far(3, 3);
  far << 3, 0, 0, 0, 4, 0, 0, 0, -5;
  EXPECT_EQ(describeCloud(joined(shapes::sphere(4000).points, far)).outliers, 3);
}

TEST(DescribeCloud, PiecesApartAreComponents) {
  const Points sphere = shapes::sphere(500).points;
  Points moved = sphere;
  moved.rowwise() += Eigen::RowVector3d(10, 0, 0);
  EXPECT_EQ(describeCloud(joined(sphere, moved)).components, 2);
}

TEST(DescribeCloud, PointsOfRingsLieOnLines) {
  // Eight rings of a radius of 10 whose points are 200 times as near to each other as the rings are.
  Points rings(8 * 4000, 3);
  for (int i = 0; i < rings.rows(); ++i) {
    const double angle = 2 * M_PI * (i % 4000) / 4000;
    rings.row(i) << 10 * std::cos(angle), 10 * std::sin(angle), 3.0 * (i / 4000);
  }
  EXPECT_EQ(describeCloud(rings).on_lines, rings.rows());
}

TEST(DescribeCloud, FloatsAreCoarseFarFromTheOrigin) {
  Points points = shapes::sphere(1000).points;
  EXPECT_LE(describeCloud(points).float_step, 0x1p-23);
  points.rowwise() += Eigen::RowVector3d(500000, 5400000, 0);
  const CloudDescription far = describeCloud(points);
  EXPECT_EQ(far.float_step, 0.5);  // 5.4e6 lies between 2^22 and 2^23
  EXPECT_NEAR(far.spacing, describeCloud(shapes::sphere(1000).points).spacing, 1e-8);
  EXPECT_EQ(describeCloud(0x1p130 * points).float_step, std::numeric_limits<double>::infinity());
}

TEST(DescribeCloud, TheUnitOfLengthIsTheCallers) {
  const Points points = shapes::sphere(1000).points;
  EXPECT_EQ(describeCloud(0x1p40 * points).spacing, 0x1p40 * describeCloud(points).spacing);
}

TEST(DescribeCloud, FewPointsAreDescribedToo) {
  for (int n = 0; n <= 4; ++n) {
    Points points(n, 3);
    for (int i = 0; i < n; ++i) points.row(i) << i, 0, 0;
    const CloudDescription description = describeCloud(points);
    EXPECT_EQ(description.points, n);
    EXPECT_EQ(description.components, n > 0 ? 1 : 0);
    EXPECT_EQ(description.spacing, n > 1 ? 1 : 0);
  }
}

TEST(DescribeCloud, MistakesAreNamed) {
  EXPECT_THROW(describeCloud(Points(), {.neighbors = 2}), InvalidInput);
  EXPECT_THROW(describeCloud(Points(), {.threads = -1}), InvalidInput);
  EXPECT_THROW(describeCloud(shapes::sphere(100).points, {.progress = [](std::string_view, double) { return false; }}),
               Cancelled);
}

/// A square of random points in random order.
Points square(int n) {
  Points points(n, 3);
  std::mt19937_64 random(1);
  const auto unit = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  for (int i = 0; i < n; ++i) points.row(i) = Eigen::RowVector3d(unit(), unit(), 0);
  return points;
}

TEST(SampleRegions, HaveTheSpacingOfTheWhole) {
  const int n = 100000;
  const Points points = square(n);
  const std::vector<int> sample = sampleRegions(points, 8000);
  EXPECT_LE(sample.size(), 8000u);
  EXPECT_GE(sample.size(), 6000u);  // balls may overlap
  const CloudDescription part = describeSample(points, sample), whole = describeCloud(points);
  EXPECT_NEAR(part.spacing / whole.spacing, 1, 0.05);
  EXPECT_EQ(part.points, n);
  EXPECT_EQ(part.sampled, std::ssize(sample));
  EXPECT_EQ(part.lowest, whole.lowest);
  EXPECT_EQ(part.highest, whole.highest);
}

TEST(SampleRegions, MoveWithThePoints) {
  const Points points = square(20000);
  for (const double scale : {0x1p20, 0x1p-560, 0x1p500})  // also where squares of distances do not fit a double
    EXPECT_EQ(sampleRegions(scale * points, 2000), sampleRegions(points, 2000)) << scale;
}

TEST(SampleRegions, OfOddCloudsAreSmall) {
  Points points = square(20000);
  EXPECT_EQ(sampleRegions(points, 20000).size(), 20000u);
  points.topRows(19990).setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_LE(sampleRegions(points, 1000).size(), 10u);
  points.setConstant(3);
  EXPECT_LE(sampleRegions(points, 1000).size(), 1000u);
  points.setConstant(std::numeric_limits<double>::infinity());
  EXPECT_TRUE(sampleRegions(points, 1000).empty());
  EXPECT_EQ(describeSample(points, {}).not_finite, 20000);
  EXPECT_THROW(sampleRegions(points, 999), InvalidInput);
  EXPECT_THROW(describeSample(points, {20000}), InvalidInput);
}

}  // namespace
}  // namespace tufted::describe_test
