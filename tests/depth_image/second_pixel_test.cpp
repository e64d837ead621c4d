// Every second row and column of a depth image: a quarter of the points, nearly the same eigenvalues and signatures,
// and curvatures that are more accurate on large bodies, where noise decides.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "image.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "tufted/curvature.h"
#include "tufted/signatures.h"

namespace tufted::second_pixel_test {
namespace {

constexpr int width = 240, height = 180, pairs = 21;

Points everySecondPixel(const Points& image) {
  Points points(width / 2 * (height / 2), 3);
  for (int i = 0; i < points.rows(); ++i) points.row(i) = image.row(i / (width / 2) * 2 * width + i % (width / 2) * 2);
  return points;
}

TEST(SecondPixel, EigenvaluesAndSignaturesStay) {
  const Points image = shapes::depthCamera({.width = width, .height = height}).points;
  const Laplacian fine = image_tests::imageLaplacian(image, width, height);
  const Laplacian coarse = image_tests::imageLaplacian(everySecondPixel(image), width / 2, height / 2);
  const Spectrum of_fine = spectrum(fine, pairs), of_coarse = spectrum(coarse, pairs);
  ASSERT_EQ(of_fine.report.null_space, of_coarse.report.null_space);
  const VectorXd times = heatTimes(of_fine, 4);
  const Eigen::MatrixXd signature = heatKernelSignature(of_fine, times);
  const Eigen::MatrixXd of_second = heatKernelSignature(of_coarse, times);

  for (int i = of_fine.report.null_space; i < pairs; ++i)
    EXPECT_NEAR(of_coarse.values[i] / of_fine.values[i], 1, 0.05) << i;
  for (int t = 0; t < times.size(); ++t) {
    std::vector<double> errors;
    for (int i = 0; i < of_second.rows(); ++i) {
      const int at = i / (width / 2) * 2 * width + i % (width / 2) * 2;
      if (coarse.status[i] == PointStatus::active && fine.status[at] == PointStatus::active)
        errors.push_back(std::abs(of_second(i, t) / signature(at, t) - 1));
    }
    ASSERT_GT(errors.size(), 8000U);
    std::sort(errors.begin(), errors.end());
    EXPECT_LT(errors[errors.size() / 2], 0.02) << times[t];
    EXPECT_LT(errors[errors.size() * 19 / 20], 0.1) << times[t];
  }
}

/// What a camera with disparities in noisy steps sees of a ball, or of an upright cylinder, at a depth of 1 m.
Points imageOf(double radius, bool is_ball) {
  constexpr double focal = 525.0 * width / 640, disparity = 43.1, step = 0.125, noise = 0.1;
  shapes::Random random(101);
  Points points(width * height, 3);
  for (int i = 0; i < points.rows(); ++i) {
    const Eigen::RowVector3d ray((i % width - (width - 1) / 2.0) / focal, (i / width - (height - 1) / 2.0) / focal, 1);
    const double squared = 1 + ray.x() * ray.x() + (is_ball ? ray.y() * ray.y() : 0);
    const double depth = (1 - std::sqrt(1 - squared * (1 - radius * radius))) / squared;  // NaN beside the body
    points.row(i) = ray * disparity / (step * std::round((disparity / depth + noise * random.normal()) / step));
  }
  return points;
}

/// The larger of the errors of both curvatures, times the radius, at the median pixel of `columns` x `rows`. Pixels
/// near the rims, where the body turns away, are left out.
double curvatureError(const Points& points, int columns, int rows, double radius, bool is_ball) {
  const Laplacian laplacian = image_tests::imageLaplacian(points, columns, rows);
  const Curvatures found = curvatures(laplacian);
  std::vector<double> errors;
  for (int i = 0; i < points.rows(); ++i) {
    const Eigen::RowVector3d point = points.row(i);
    const double aside = is_ball ? point.head<2>().norm() : std::abs(point.x());
    if (laplacian.status[i] != PointStatus::active || aside > 0.7 * radius || std::abs(point.y()) > 0.7 * radius)
      continue;
    const Eigen::RowVector2d exact(1, is_ball ? 1 : 0);
    errors.push_back((found.principal.row(i) * radius - exact).cwiseAbs().maxCoeff());
  }
  if (errors.size() < 150) {
    ADD_FAILURE() << errors.size() << " points";
    return INFINITY;
  }
  std::nth_element(errors.begin(), errors.begin() + std::ssize(errors) / 2, errors.end());
  return errors[errors.size() / 2];
}

TEST(SecondPixel, CurvatureOfLargeBodiesIsMoreAccurate) {
  for (const bool is_ball : {true, false}) {
    constexpr double radius = 0.25;  // 98 pixels across
    const Points image = imageOf(radius, is_ball);
    const double fine = curvatureError(image, width, height, radius, is_ball);
    const double coarse = curvatureError(everySecondPixel(image), width / 2, height / 2, radius, is_ball);
    EXPECT_LE(coarse, 0.015) << is_ball;
    EXPECT_LE(coarse, fine) << is_ball;
  }
}

TEST(SecondPixel, CurvatureOfSmallBodiesIsWithinFourPercent) {
  for (const bool is_ball : {true, false}) {
    constexpr double radius = 0.1;  // 39 pixels across
    const Points second = everySecondPixel(imageOf(radius, is_ball));
    EXPECT_LE(curvatureError(second, width / 2, height / 2, radius, is_ball), 0.04) << is_ball;
  }
}

}  // namespace
}  // namespace tufted::second_pixel_test
