// What the spectrum and Poisson's equation are worth on large spheres, and how fast they get better.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "oracles/oracles.h"
#include "shapes/shapes.h"
#include "shapes/spectra.h"
#include "tufted/tufted.h"

namespace tufted::spectrum_accuracy_test {
namespace {

TEST(SphereEigenpairs, Of64kPointsAreWithin08PermilleAndExact) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::sphere(64000).points, cloudOptions(Preset::clean));
  const Spectrum found = spectrum(laplacian, 49);
  EXPECT_LE(oracles::meanRelativeError(found.values, shapes::sphereSpectrum(49)), 8e-4);
  // Degree l comes 2 l + 1 times: far gaps between degrees, narrow ones within.
  int first = 1;
  for (int l = 1; l <= 6; ++l) {
    const int count = 2 * l + 1;
    EXPECT_NEAR(found.values[first], l * (l + 1), 5e-3 * l * (l + 1)) << l;
    EXPECT_LE(found.values[first + count - 1] - found.values[first], 5e-3 * l * (l + 1)) << l;
    first += count;
  }
  const Eigen::MatrixXd gram = found.vectors.transpose() * laplacian.M.asDiagonal() * found.vectors;
  EXPECT_LE((gram - Eigen::MatrixXd::Identity(49, 49)).cwiseAbs().maxCoeff(), 1e-10);
  for (int c = 1; c < 49; ++c) {
    const VectorXd weighted = laplacian.M.cwiseProduct(found.vectors.col(c));
    EXPECT_LE((laplacian.L * found.vectors.col(c) - found.values[c] * weighted).norm(),
              1e-8 * found.values[c] * weighted.norm())
        << c;
  }
}

/// Minus the slope of log(error) over log(points) by least squares.
double orderOf(const std::vector<int>& sizes, const std::vector<double>& errors) {
  const auto count = static_cast<Eigen::Index>(sizes.size());
  Eigen::ArrayXd x = Eigen::Map<const Eigen::VectorXi>(sizes.data(), count).cast<double>().array().log();
  const Eigen::ArrayXd y = Eigen::Map<const VectorXd>(errors.data(), count).array().log();
  x -= x.mean();
  return -(x * y).sum() / x.square().sum();
}

TEST(Convergence, OfEigenvaluesAndPoissonIsOfFirstOrderInThePoints) {
  // Random points, three samples a size. Poisson: relative error in L2.
  const std::vector<int> sizes = {1000, 4000, 16000};
  constexpr int samples = 3;
  std::vector<double> eigenvalues, poisson;
  for (const int n : sizes) {
    double eigenvalue_error = 0, poisson_error = 0;
    for (int seed = 1; seed <= samples; ++seed) {
      const Points points = shapes::sphere(n, shapes::Sampling::uniform, seed).points;
      const Laplacian laplacian = pointCloudLaplacian(points, cloudOptions(Preset::clean));
      eigenvalue_error +=
          oracles::meanRelativeError(spectrum(laplacian, 49).values, shapes::sphereSpectrum(49)) / samples;
      const auto [u, f] = shapes::spherePoisson(points);
      const VectorXd solution = Solver::laplacian(laplacian).solve(laplacian.M.cwiseProduct(f));
      const double mean = laplacian.M.dot(u) / laplacian.M.sum();
      const VectorXd exact = u.array() - mean;
      poisson_error +=
          std::sqrt(laplacian.M.dot((solution - exact).cwiseAbs2()) / laplacian.M.dot(exact.cwiseAbs2())) / samples;
    }
    eigenvalues.push_back(eigenvalue_error);
    poisson.push_back(poisson_error);
  }
  EXPECT_GE(orderOf(sizes, eigenvalues), 0.95);
  EXPECT_GE(orderOf(sizes, poisson), 0.95) << poisson[0] << ' ' << poisson[1] << ' ' << poisson[2];
}

}  // namespace
}  // namespace tufted::spectrum_accuracy_test
