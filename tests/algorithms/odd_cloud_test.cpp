// A cloud of five components, a tenth of it copies and a fifth NaN: every algorithm gives a defined result.
#include <gtest/gtest.h>

#include <cmath>

#include "shapes/shapes.h"
#include "support/defined_values.h"
#include "tufted/tufted.h"

namespace tufted {
namespace {

using Eigen::MatrixXd;

/// Spheres, tori and a disk side by side, of 1000 points each; of ten points two are NaN and one is a copy.
Points oddCloud() {
  const Points parts[] = {shapes::sphere(1000).points, shapes::torus(1000).points, shapes::disk(1000).points,
                          0.5 * shapes::sphere(1000).points, 2 * shapes::torus(1000).points};
  Points points(5000, 3);
  for (int p = 0; p < 5; ++p)
    points.middleRows(1000 * p, 1000) = parts[p].rowwise() + Eigen::RowVector3d(8.0 * p, 0, 0);
  for (int i = 0; i < 5000; i += 10) {
    points.row(i + 3).setConstant(NAN);
    points(i + 6, 1) = NAN;
    points.row(i + 9) = points.row(i + 1);
  }
  return points;
}

class OddlyBuiltCloud : public testing::Test {
 protected:
  static void SetUpTestSuite() { laplacian_ = new Laplacian(pointCloudLaplacian(oddCloud())); }
  static void TearDownTestSuite() { delete laplacian_; }

  static void expectDefined(const MatrixXd& values) { support::expectDefined(*laplacian_, values, 0); }

  static const Laplacian* laplacian_;
};
const Laplacian* OddlyBuiltCloud::laplacian_ = nullptr;

TEST_F(OddlyBuiltCloud, HasWhatItIsSaidToHave) {
  EXPECT_EQ(laplacian_->report.components, 5);
  EXPECT_EQ(laplacian_->report.coincident, 500);
  EXPECT_EQ(laplacian_->report.not_finite, 1000);
}

TEST_F(OddlyBuiltCloud, HasASpectrum) {
  const Spectrum found = spectrum(*laplacian_, 40);
  EXPECT_EQ(found.report.null_space, 5);
  EXPECT_LE(found.report.residual, 1e-8);
  EXPECT_LE(found.report.orthogonality, 1e-10);
  expectDefined(found.vectors);
  // The largest torus is twice the other one: its first eigenvalues are a quarter, and there are both.
  EXPECT_GT(found.values[5], 0);
  EXPECT_TRUE(found.vectors.col(0).segment(4000, 1000).cwiseAbs().maxCoeff() > 0);
}

TEST_F(OddlyBuiltCloud, HasSignaturesAndAnEmbedding) {
  const Spectrum found = spectrum(*laplacian_, 40);
  expectDefined(heatKernelSignature(found, heatTimes(found)));
  expectDefined(waveKernelSignature(found));
  expectDefined(spectralEmbedding(found));
  expectDefined(spectralEmbedding(found, Embedding::biharmonic));
}

TEST_F(OddlyBuiltCloud, IsFilteredPartByPart) {
  const Spectrum constants = spectrum(*laplacian_, 5);
  MatrixXd part(5000, 1);
  for (int i = 0; i < 5000; ++i) part(i, 0) = i / 1000;
  const MatrixXd kept = filterSignals(*laplacian_, constants, part);
  for (int i = 0; i < 5000; ++i) EXPECT_NEAR(kept(i, 0), i / 1000, 1e-12);  // NaN points keep their value
  Points points = oddCloud();
  const MatrixXd filtered = filterSignals(*laplacian_, spectrum(*laplacian_, 60), points);
  for (int i = 0; i < 5000; ++i) EXPECT_EQ(filtered.row(i).allFinite(), points.row(i).allFinite()) << i;
}

TEST_F(OddlyBuiltCloud, IsSolvedPartByPart) {
  MatrixXd f = MatrixXd::Zero(5000, 2);
  f(1000, 0) = 1;  // heat in one part alone
  f(3, 1) = NAN;   // of no consequence
  SolveReport report;
  const MatrixXd x = Solver::laplacian(*laplacian_).solve(f, &report);
  EXPECT_LE(report.residual, 1e-10);
  EXPECT_TRUE(x.col(1).isZero(0));
  EXPECT_GT(x.col(0).segment(1000, 1000).cwiseAbs().maxCoeff(), 0.1);
  EXPECT_TRUE(x.col(0).head(1000).isZero(1e-12) && x.col(0).tail(3000).isZero(1e-12));
}

TEST_F(OddlyBuiltCloud, IsSmoothed) {
  const Points points = oddCloud(), smoothed = smooth(*laplacian_, points);
  for (int i = 0; i < 5000; ++i) EXPECT_EQ(smoothed.row(i).allFinite(), points.row(i).allFinite()) << i;
}

}  // namespace
}  // namespace tufted
