// Medians of coordinates and of the spread, beside those of sorted values.
#include "base/scaling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "shapes/random.h"

namespace tufted::scaling_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

double sortedMedian(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// The finite points.
Points finite(const Points& points) {
  Points kept(points.rows(), 3);
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    if (points.row(i).allFinite()) kept.row(count++) = points.row(i);
  return kept.topRows(count);
}

void expectMedians(const Points& points) {
  const Points usable = finite(points);
  const Progress silent;
  for (const int threads : {1, 3}) {
    std::vector<PointStatus> status;
    const Scaling scaling = measureScaling(points, status, Workers(threads, silent));
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(scaling.center[axis], sortedMedian({usable.col(axis).begin(), usable.col(axis).end()})) << axis;
      EXPECT_EQ(scaling.lowest[axis], usable.col(axis).minCoeff()) << axis;
    }
    std::vector<double> spreads;
    for (Eigen::Index i = 0; i < usable.rows(); ++i) {
      const double spread = (usable.row(i) - scaling.center.transpose()).cwiseAbs().maxCoeff();
      if (spread > 0) spreads.push_back(spread);
    }
    int exponent = 0;
    if (!spreads.empty()) std::frexp(sortedMedian(spreads), &exponent);
    EXPECT_EQ(scaling.exponent, exponent);
  }
}

Points randomPoints(int count, std::uint64_t seed) {
  shapes::Random random(seed);
  Points points(count, 3);
  for (double& x : points.reshaped()) x = random.normal() * std::exp(random.normal());
  return points;
}

TEST(Scaling, HasTheMediansOfAllPoints) {
  for (const int count : {1, 2, 7, 1000, 2047, 50000}) expectMedians(randomPoints(count, 101));
}

TEST(Scaling, LeavesOutPointsThatAreNotFinite) {
  Points points = randomPoints(40000, 102);
  for (int i = 0; i < 40000; i += 3) points(i, i % 2) = nan;
  expectMedians(points);
}

// Points at regular intervals, such as those it looks at first, lie elsewhere than all others.
TEST(Scaling, IsThatOfAllPointsWhereTheFirstOnesSeenAreUnlikeThem) {
  for (const int interval : {4, 19, 20}) {
    for (const double away : {-1000, 1000}) {
      Points points = randomPoints(2048 * interval, 103);
      for (int i = 0; i < points.rows(); i += interval) points.row(i).array() += away;
      expectMedians(points);
    }
  }
}

TEST(Scaling, IsThatOfAllPointsWhereHalfAreOneOrFarAway) {
  Points points = randomPoints(30000, 104);
  points.topRows(15000).setConstant(0.5);
  expectMedians(points);
  points = randomPoints(30000, 105);
  for (int i = 0; i < 30000; i += 7) points(i, i % 3) = i % 2 == 0 ? 1e60 : -1e60;
  expectMedians(points);
}

TEST(Scaling, OfNoPointsIsThatOfTheUnit) {
  const Progress silent;
  for (const Points& points : {Points(0, 3), Points(Points::Constant(30000, 3, nan))}) {
    std::vector<PointStatus> status;
    const Scaling scaling = measureScaling(points, status, Workers(2, silent));
    EXPECT_EQ(scaling.center, Eigen::Vector3d::Zero());
    EXPECT_EQ(scaling.exponent, 0);
  }
}

TEST(Scaling, OfPointsThatAreOneIsThere) {
  std::vector<PointStatus> status;
  const Progress silent;
  const Scaling scaling = measureScaling(Points::Constant(30000, 3, 7), status, Workers(2, silent));
  EXPECT_EQ(scaling.center, Eigen::Vector3d::Constant(7));
  EXPECT_EQ(scaling.exponent, 0);
  EXPECT_EQ((scaling.lowest - 7).abs().maxCoeff(), 0);
}

}  // namespace
}  // namespace tufted::scaling_test
