#include "neighbors/run_boxes.h"

#include <gtest/gtest.h>

#include <vector>

#include "shapes/shapes.h"

namespace tufted::run_boxes_test {
namespace {

std::vector<int> pointsIn(const std::vector<Ball>& balls, const Points& points) {
  const Progress silent;
  std::vector<int> found;
  RunBoxes(points, Workers(2, silent)).visitBalls(balls, [&found](int p) { found.push_back(p); });
  return found;
}

std::vector<int> pointsInByAllDistances(const std::vector<Ball>& balls, const Points& places) {
  std::vector<int> found;
  for (int p = 0; p < places.rows(); ++p) {
    bool is_in = false;
    for (const Ball& ball : balls) is_in |= (places.row(p).transpose() - ball.center).norm() <= ball.radius;
    if (is_in) found.push_back(p);
  }
  return found;
}

TEST(RunBoxes, FindThePointsOfAllBallsOnce) {
  for (const int n : {1, 255, 256, 257, 3000}) {
    const Points points = shapes::sphere(n).points;
    for (const double radius : {0.0, 0.05, 0.7, 100.0}) {
      const std::vector<Ball> balls = {{points.row(0), radius}, {points.row(n / 2), 2 * radius}};
      EXPECT_EQ(pointsIn(balls, points), pointsInByAllDistances(balls, points)) << n << " " << radius;
    }
  }
  EXPECT_TRUE(pointsIn({{{0, 0, 0}, 1}}, Points(0, 3)).empty());
}

}  // namespace
}  // namespace tufted::run_boxes_test
