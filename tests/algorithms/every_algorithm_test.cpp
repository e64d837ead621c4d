// What holds for every algorithm on clouds: bits on any number of threads, units, and points that take no part.
#include <gtest/gtest.h>

#include <cmath>

#include "shapes/shapes.h"
#include "support/algorithms.h"
#include "support/compare.h"
#include "support/defined_values.h"

namespace tufted::every_algorithm_test {
namespace {

using Eigen::MatrixXd;
using support::Algorithm;

TEST(EveryAlgorithm, HasTheSameBitsOnAnyNumberOfThreads) {
  // More stars and faces than one block of the loops that run in parallel.
  const Points points = shapes::withNoise(shapes::torus(9000), 0.01).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const std::vector<Algorithm> single = support::algorithms(1), many = support::algorithms(3);
  for (std::size_t k = 0; k < single.size(); ++k) {
    const MatrixXd one = single[k].run(laplacian, points), three = many[k].run(laplacian, points);
    ASSERT_EQ(one.rows(), three.rows()) << single[k].name;
    EXPECT_TRUE(support::sameBits(one.data(), three.data(), static_cast<std::size_t>(one.size()))) << single[k].name;
  }
}

TEST(EveryAlgorithm, DoesNotDependOnTheUnit) {
  const Points points = shapes::withNoise(shapes::torus(1500), 0.01).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const std::vector<Algorithm> plain = support::algorithms();
  for (const int exponent : {-300, 300}) {
    const double unit = std::ldexp(1, exponent);
    const Points scaled_points = unit * points;
    const Laplacian scaled = pointCloudLaplacian(scaled_points);
    const std::vector<Algorithm> algorithms = support::algorithms(0, unit);
    for (std::size_t k = 0; k < plain.size(); ++k) {
      const MatrixXd found = algorithms[k].run(scaled, scaled_points) * std::ldexp(1, -exponent * plain[k].power);
      const MatrixXd expected = plain[k].run(laplacian, points);
      ASSERT_EQ(found.rows(), expected.rows()) << plain[k].name;
      EXPECT_LE(support::difference(found, expected), 1e-9) << plain[k].name << ", 2^" << exponent;
    }
  }
}

TEST(EveryAlgorithm, DefinesValuesAtOddPoints) {
  Points points(1003, 3);
  points.topRows(1000) = shapes::sphere(1000).points;
  points.row(1000) = points.row(8);
  points.row(1001).setConstant(NAN);
  points.row(1002) << 1e6, 0, 0;
  const Laplacian laplacian = pointCloudLaplacian(points);
  for (const Algorithm& algorithm : support::algorithms()) {
    SCOPED_TRACE(algorithm.name);
    const MatrixXd values = algorithm.run(laplacian, points);
    if (values.rows() != points.rows()) continue;  // none per point
    support::expectCopies(laplacian, values);
    EXPECT_TRUE(values.topRows(1001).allFinite());
    for (const int odd : {1001, 1002})
      for (const double value : values.row(odd))
        EXPECT_TRUE(!algorithm.elsewhere || value == *algorithm.elsewhere ||
                    (std::isnan(value) && std::isnan(*algorithm.elsewhere)))
            << value;
  }
}

}  // namespace
}  // namespace tufted::every_algorithm_test
