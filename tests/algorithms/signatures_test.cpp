// Signatures, embeddings and filters: against the sphere's own, and unchanged wherever the cloud lies.
#include "tufted/signatures.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numeric>
#include <string>

#include "shapes/shapes.h"
#include "support/compare.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::spectral_test {
namespace {

using Eigen::MatrixXd;

double largestRelativeDifference(const MatrixXd& a, const MatrixXd& b) {
  return ((a - b).array().abs() / b.array().abs().maxCoeff()).maxCoeff();
}

TEST(HeatKernelSignature, OfTheSphereIsTheAnalyticOneWithinAPercent) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::sphere(32000).points);
  const Spectrum found = spectrum(laplacian, 121);  // degrees 0 to 10
  const VectorXd times{{0.1, 0.2, 0.5, 1, 3}};
  const MatrixXd signature = heatKernelSignature(found, times);
  for (int t = 0; t < times.size(); ++t) {
    double expected = 0;
    for (int l = 0; l <= 30; ++l) expected += (2 * l + 1) / (4 * M_PI) * std::exp(-l * (l + 1) * times[t]);
    EXPECT_NEAR(signature.col(t).mean(), expected, 2e-3 * expected) << times[t];
    const VectorXd error = (signature.col(t).array() / expected - 1).abs();
    EXPECT_LE(error.maxCoeff(), 1e-2) << times[t];
  }
}

TEST(HeatKernelSignature, IsTheSameWhereverTheCloudLies) {
  const shapes::Cloud cloud = shapes::ellipsoid(3000);
  const auto signatures = [](const Points& points) {
    const Spectrum found = spectrum(pointCloudLaplacian(points), 40);
    MatrixXd both(points.rows(), 36);
    both << heatKernelSignature(found, heatTimes(found)), waveKernelSignature(found, 20);
    return both;
  };
  const MatrixXd reference = signatures(cloud.points);
  const Eigen::RowVector3d offset(500000, 4000000, 100);
  EXPECT_LE(largestRelativeDifference(signatures(cloud.points.rowwise() + offset), reference), 1e-9);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  EXPECT_LE(largestRelativeDifference(signatures(cloud.points * turn.transpose()), reference), 1e-8);
  std::vector<int> order(3000);
  std::iota(order.begin(), order.end(), 0);
  std::rotate(order.begin(), order.begin() + 1234, order.end());
  for (std::size_t i = 0; i + 7 < order.size(); i += 3) std::swap(order[i], order[i + 7]);
  EXPECT_LE(largestRelativeDifference(signatures(support::permuted(cloud.points, order)), reference(order, Eigen::all)),
            1e-9);
  // Twice as large: lambda and so the heat left per area are a quarter.
  EXPECT_LE(largestRelativeDifference(4 * signatures(2 * cloud.points), reference), 1e-9);
}

TEST(HeatKernelSignature, AtTimesBetweenTheEndsOfTheSpectrum) {
  const Spectrum found = spectrum(pointCloudLaplacian(shapes::sphere(2000).points), 30);
  const VectorXd times = heatTimes(found, 5);
  EXPECT_NEAR(times[0] * found.values[29], 4 * std::log(10), 1e-12);
  EXPECT_NEAR(times[4] * found.values[1], 4 * std::log(10), 1e-12);
  EXPECT_NEAR(times[1] / times[0], times[4] / times[3], 1e-12);
  EXPECT_NEAR(heatTimes(found, 1)[0], times[2], 1e-12);
}

TEST(WaveKernelSignature, OfAHomogeneousSurfaceIsOneOverItsArea) {
  // phi^2 summed over a degree of spherical harmonics is the same everywhere; widths mix whole degrees.
  const Spectrum found = spectrum(pointCloudLaplacian(shapes::sphere(16000).points), 81);
  const MatrixXd signature = waveKernelSignature(found, VectorXd{{std::log(2.0), std::log(6.0), std::log(30.0)}}, 0.05);
  EXPECT_LE((signature.array() * 4 * M_PI - 1).abs().maxCoeff(), 2.3e-2);
  EXPECT_EQ(waveKernelSignature(found).cols(), 100);
}

TEST(SpectralEmbedding, HasCommuteAndBiharmonicDistances) {
  // With all pairs: |x_i - x_j|^2 is (L^+)_ii - 2 (L^+)_ij + (L^+)_jj, the commute time but for the area.
  const Laplacian laplacian = pointCloudLaplacian(shapes::torus(200).points);
  const Spectrum all = spectrum(laplacian, 199);
  const MatrixXd commute = spectralEmbedding(all), biharmonic = spectralEmbedding(all, Embedding::biharmonic);
  EXPECT_EQ(commute.cols(), 198);
  const Solver solver = Solver::laplacian(laplacian);
  const MatrixXd difference = VectorXd::Unit(200, 3) - VectorXd::Unit(200, 77);
  const VectorXd potential = solver.solve(difference);
  EXPECT_NEAR((commute.row(3) - commute.row(77)).squaredNorm(), potential[3] - potential[77], 2e-3 * potential[3]);
  EXPECT_NEAR((biharmonic.row(3) - biharmonic.row(77)).squaredNorm(),
              potential.dot(laplacian.M.cwiseProduct(potential)), 1e-4 * potential.squaredNorm());
}

TEST(FilterSignals, KeepsLowFrequenciesAndTakesOutHighOnes) {
  const Points points = shapes::sphere(8000).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const Spectrum found = spectrum(laplacian, 16);
  // Combinations of the first pairs lose nothing, and filtering twice is as filtering once.
  const MatrixXd low = found.vectors * MatrixXd{{1, -2}}.replicate(16, 1);
  EXPECT_LE((filterSignals(laplacian, found, low) - low).cwiseAbs().maxCoeff(), 1e-11);
  // z is of degree 1 and z^2 - 1/3 of degree 2; degree 8 lies beyond.
  const VectorXd z = points.col(2), z2 = z.array().square() - 1.0 / 3;
  EXPECT_LE((filterSignals(laplacian, found, z + z2) - (z + z2)).cwiseAbs().maxCoeff(), 0.02);
  const VectorXd z8 = z.unaryExpr([](double x) { return std::legendre(8u, x); });
  EXPECT_LE(filterSignals(laplacian, found, z8).cwiseAbs().maxCoeff(), 0.05);
  // Heat: degree 1 falls by exp(-2 t).
  const MatrixXd heat = filterSignals(laplacian, found, z, [](double lambda) { return std::exp(-0.3 * lambda); });
  EXPECT_LE((heat - std::exp(-0.6) * z).cwiseAbs().maxCoeff(), 0.01);
}

TEST(FilterSignals, IsTheSameInAnyUnit) {
  // Areas, and products of areas and signals, are far beyond doubles in some of these units.
  const Points points = shapes::ellipsoid(1000).points;
  const auto filtered = [&](double unit, double signal) {
    const Points cloud = unit * points;
    const Laplacian laplacian = pointCloudLaplacian(cloud);
    return filterSignals(laplacian, spectrum(laplacian, 30), signal * points);
  };
  const MatrixXd expected = filtered(1, 1);
  for (const double unit : {1e-140, 1e-110, 1e110, 1e140})
    for (const double signal : {1e-290, 1.0, unit, 1e290}) {
      const MatrixXd found = filtered(unit, signal) / signal;
      ASSERT_TRUE(found.allFinite()) << unit << ' ' << signal;
      EXPECT_LT(largestRelativeDifference(found, expected), 1e-9) << unit << ' ' << signal;
    }
}

TEST(FilterSignals, RefusesWhatDoesNotFitADouble) {
  const Points points = shapes::sphere(500).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const Spectrum found = spectrum(laplacian, 12);
  EXPECT_THROW(filterSignals(laplacian, found, 1e308 * points, [](double) { return 2; }), SolverFailure);
  EXPECT_EQ(support::refusal([&] {
              filterSignals(laplacian, found, points, [](double) { return INFINITY; });
            }).find("filterSignals: gain is inf at the eigenvalue "),
            0u);
}

TEST(FilterSignals, LeavesOddPointsAndMovesCopiesTogether) {
  Points points = shapes::torus(1003).points;
  points.row(7).setConstant(NAN);
  points.row(1000) = points.row(5);
  points.row(1002) << 1e90, 1e90, 1e90;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const Spectrum found = spectrum(laplacian, 20);
  const MatrixXd smooth = filterSignals(laplacian, found, points);
  EXPECT_TRUE(smooth.row(7).array().isNaN().all());
  EXPECT_EQ(smooth.row(1002), points.row(1002));
  EXPECT_EQ(smooth.row(1000), smooth.row(5));
  EXPECT_TRUE(smooth(Eigen::seq(8, 999), Eigen::all).allFinite());
  EXPECT_TRUE(heatKernelSignature(found, heatTimes(found)).row(7).isZero(0));
  EXPECT_EQ(spectralEmbedding(found).row(1000), spectralEmbedding(found).row(5));
}

TEST(WaveKernelSignature, OfEqualEigenvaluesIsTheMeanOfAll) {
  // The three positive eigenvalues of a regular tetrahedron are equal, and the squares of vectors have the mean 1 / M
  // less that of the constant.
  const shapes::Mesh mesh = shapes::tetrahedron();
  const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
  const Spectrum found = spectrum(laplacian, 3, {.null_space = false});
  const MatrixXd expected =
      ((laplacian.M.cwiseInverse().array() - 1 / laplacian.M.sum()) / 3).matrix().replicate(1, 100);
  EXPECT_TRUE(waveKernelSignature(found).isApprox(expected, 1e-9));
  const Spectrum one = spectrum(laplacian, 1, {.null_space = false});
  EXPECT_TRUE(waveKernelSignature(one).isApprox(one.vectors.cwiseAbs2().replicate(1, 100), 1e-12));
}

TEST(Spectral, NamesWhatACallerGotWrong) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::sphere(500).points);
  const Spectrum found = spectrum(laplacian, 5), constant = spectrum(laplacian, 1);
  using support::refusal;
  EXPECT_EQ(refusal([&] { heatTimes(found, 0); }), "heatTimes: count = 0, must be at least 1");
  EXPECT_EQ(refusal([&] { heatTimes(constant); }), "heatTimes: spectrum has no positive eigenvalue, must have one");
  EXPECT_EQ(refusal([&] {
              heatKernelSignature(found, VectorXd{{1, -1}});
            }),
            "heatKernelSignature: a time is -1, must be finite and at least 0");
  EXPECT_NE(refusal([&] { heatKernelSignature(found, VectorXd{{NAN}}); }), "accepted");
  EXPECT_EQ(refusal([&] { waveEnergies(found, 1); }), "waveEnergies: count = 1, must be at least 2");
  EXPECT_NE(refusal([&] { waveKernelSignature(constant); }), "accepted");
  EXPECT_NE(refusal([&] { waveKernelSignature(found, VectorXd{{1}}, 0); }), "accepted");
  EXPECT_NE(refusal([&] { waveKernelSignature(found, VectorXd{{INFINITY}}, 1); }), "accepted");
  EXPECT_EQ(refusal([&] { filterSignals(laplacian, found, VectorXd(499)); }),
            "filterSignals: signals has 499 rows, must have 500, one per point of the Laplacian");
  EXPECT_EQ(refusal([&] { filterSignals(laplacian, found, VectorXd::Constant(500, NAN)); }),
            "filterSignals: signals of point 0 are not finite, must be");
  EXPECT_EQ(spectralEmbedding(constant).cols(), 0);
}

}  // namespace
}  // namespace tufted::spectral_test
