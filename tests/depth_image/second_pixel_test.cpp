// Every second row and column of a depth image: a quarter of the points, and nearly the same eigenvalues and
// signatures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "image.h"
#include "shapes/shapes.h"
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

}  // namespace
}  // namespace tufted::second_pixel_test
