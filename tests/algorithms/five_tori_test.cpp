// Every algorithm on a cloud with five components, a tenth of it duplicates and a fifth of it NaN.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "shapes/random.h"
#include "shapes/shapes.h"
#include "support/defined_values.h"
#include "tufted/tufted.h"

namespace tufted::five_tori_test {
namespace {

/// Five tori of 1000 points, apart; 10 % of all rows are copies of others, 20 % have a NaN, in random order.
class FiveTori : public testing::Test {
 protected:
  static constexpr int n = 7000;

  static void SetUpTestSuite() {
    shapes::Random random(3);
    shapes::Cloud cloud;
    cloud.points.resize(n, 3);
    cloud.normals = Points::Zero(n, 3);
    cloud.labels.assign(n, -1);
    for (int k = 0; k < 5; ++k) {
      cloud.points.middleRows(1000 * k, 1000) =
          shapes::torus(1000, shapes::Sampling::uniform, static_cast<std::uint64_t>(k + 1)).points.rowwise() +
          Eigen::RowVector3d(5 * k, 0, 0);
      std::fill_n(cloud.labels.begin() + 1000 * k, 1000, k);
    }
    for (int i = 5000; i < n; ++i) {
      const int source = static_cast<int>(random.uniform(0, 5000));
      cloud.points.row(i) = cloud.points.row(source);
      cloud.labels[i] = cloud.labels[source];
      if (i >= 5600) cloud.points(i, i % 3) = i % 2 == 0 ? NAN : INFINITY;
    }
    cloud = shapes::shuffled(std::move(cloud));
    points = new Points(cloud.points);
    torus = new std::vector<int>(cloud.labels);
    laplacian = new Laplacian(pointCloudLaplacian(*points));
    ASSERT_EQ(laplacian->report.components, 5);
    ASSERT_EQ(laplacian->report.coincident, 600);
    ASSERT_EQ(laplacian->report.not_finite, 1400);
  }
  static void TearDownTestSuite() { delete points, delete torus, delete laplacian; }

  static int firstOf(int label) {
    for (int i = 0; i < n; ++i) {
      if ((*torus)[i] == label && laplacian->status[i] == PointStatus::active) return i;
    }
    return -1;
  }
  static bool isNowhere(int i) { return laplacian->status[i] == PointStatus::not_finite; }
  static void expectCopies(const Eigen::MatrixXd& values) { support::expectCopies(*laplacian, values); }

  static Points* points;
  static std::vector<int>* torus;
  static Laplacian* laplacian;
};
Points* FiveTori::points = nullptr;
std::vector<int>* FiveTori::torus = nullptr;
Laplacian* FiveTori::laplacian = nullptr;

TEST_F(FiveTori, HaveDistancesWhereSourcesAre) {
  const VectorXd distance = DistanceSolver(*laplacian).query({firstOf(0), firstOf(3)});
  for (int i = 0; i < n; ++i) {
    const bool reached = !isNowhere(i) && ((*torus)[i] == 0 || (*torus)[i] == 3);
    ASSERT_EQ(std::isfinite(distance[i]), reached) << i;
    ASSERT_TRUE(reached ? distance[i] >= 0 && distance[i] < 6 : distance[i] == INFINITY) << i;
  }
  expectCopies(distance);
}

TEST_F(FiveTori, AreInterpolatedWherePinsAre) {
  const Pins pins{{firstOf(1), firstOf(4)}, Eigen::VectorXd{{1, 2}}};
  for (const Eigen::MatrixXd& u : {harmonic(*laplacian, pins), biharmonic(*laplacian, pins),
                                   poisson(*laplacian, Eigen::MatrixXd::Zero(n, 1), pins)}) {
    for (int i = 0; i < n; ++i) {
      const bool reached = !isNowhere(i) && ((*torus)[i] == 1 || (*torus)[i] == 4);
      ASSERT_EQ(std::isfinite(u(i, 0)), reached) << i;
      if (reached && (*torus)[i] == 1) {
        ASSERT_NEAR(u(i, 0), 1, 1e-12) << i;
      }
    }
    expectCopies(u);
  }
}

TEST_F(FiveTori, HaveGreensFunctionsAndPoissonSolutionsByComponent) {
  const Eigen::MatrixXd g = greensFunction(*laplacian, {firstOf(2)});
  const Eigen::MatrixXd u = poisson(*laplacian, Eigen::MatrixXd::Constant(n, 1, 5));
  for (int i = 0; i < n; ++i) {
    ASSERT_EQ(std::isnan(g(i, 0)), isNowhere(i)) << i;
    ASSERT_EQ(std::isnan(u(i, 0)), isNowhere(i)) << i;
    if (isNowhere(i)) continue;
    if ((*torus)[i] != 2) {
      ASSERT_EQ(g(i, 0), 0) << i;
    }
    ASSERT_NEAR(u(i, 0), 0, 1e-12) << i;  // a constant has no part that could be solved for
  }
  expectCopies(g);
}

TEST_F(FiveTori, HaveMeansByComponent) {
  Eigen::MatrixXd values(n, 2);
  for (int i = 0; i < n; ++i) values.row(i) << (isNowhere(i) ? NAN : (*torus)[i]), i;
  const Eigen::MatrixXd means = componentMeans(*laplacian, values);
  double moment = 0, area = 0;
  for (int i = 0; i < n; ++i) {
    ASSERT_NEAR(means(i, 0), isNowhere(i) ? 0 : (*torus)[i], 1e-12) << i;
    if ((*torus)[i] != 2 || isNowhere(i)) continue;
    moment += laplacian->M[i] * i;
    area += laplacian->M[i];
  }
  EXPECT_NEAR(means(firstOf(2), 1), moment / area, 1e-9 * n);
  expectCopies(means);
}

TEST_F(FiveTori, HaveGradients) {
  const Gradients operators = gradients(*laplacian, *points);
  ASSERT_TRUE(operators.X.coeffs().allFinite() && operators.Y.coeffs().allFinite());
  const VectorXd ones = VectorXd::Ones(n);
  EXPECT_LE((operators.X * ones).cwiseAbs().maxCoeff(), 1e-11 * operators.X.coeffs().abs().maxCoeff());
  const int nearest = nearestPoint(*laplacian, *points, {5, 0, 10});
  EXPECT_EQ((*torus)[nearest], 1);
}

}  // namespace
}  // namespace tufted::five_tori_test
