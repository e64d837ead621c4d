#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <string>

#include "shapes/shapes.h"
#include "shapes/spectra.h"

namespace tufted::shapes::clouds_test {
namespace {

using Eigen::RowVector3d;
constexpr double pi = std::numbers::pi;

const std::vector<Cloud>& clouds() {
  static const std::vector<Cloud> all = allClouds(1000);
  return all;
}

bool same(const Points& a, const Points& b) {
  return a.rows() == b.rows() && (a.array() == b.array() || (a.array().isNaN() && b.array().isNaN())).all();
}

// Signed residual of a surface's equation; 0 on the surface.
double offSurface(const std::string& shape, const RowVector3d& p) {
  const double x = p.x(), y = p.y(), z = p.z();
  if (shape == "sphere") return p.norm() - 1;
  if (shape == "ellipsoid") return x * x / 2.25 + y * y / 1.5625 + z * z - 1;
  if (shape == "torus") return std::hypot(std::hypot(x, y) - 1, z) - 0.4;
  if (shape == "cylinder_patch") return std::hypot(x, y) - 1;
  if (shape == "saddle") return z - (x * x - y * y) / 2;
  if (shape == "square" || shape == "disk") return z;
  if (shape == "crossing_planes") return y * z;
  if (shape == "two_sheets") return z * (z - 0.1);
  if (shape == "cube") return std::max({std::abs(x - 0.5), std::abs(y - 0.5), std::abs(z - 0.5)}) - 0.5;
  if (shape == "prism") {
    const double side = std::sqrt(0.75) * x - 0.5 * y, other = std::sqrt(0.75) * (1 - x) - 0.5 * y;
    return std::min({z, 1.5 - z, y, side, other});
  }
  return 0;  // rooms are tested in scanners_test.cpp
}

class EveryCloud : public testing::TestWithParam<int> {
 protected:
  const Cloud& cloud() const { return clouds()[GetParam()]; }
};

class EverySurface : public EveryCloud {};

std::vector<int> indicesOf(bool (*wanted)(const Cloud&)) {
  std::vector<int> indices;
  for (std::size_t i = 0; i < clouds().size(); ++i) {
    if (wanted(clouds()[i])) indices.push_back(static_cast<int>(i));
  }
  return indices;
}

std::string nameOf(const testing::TestParamInfo<int>& param_info) {
  return clouds()[param_info.param].name;
}

TEST_P(EverySurface, HoldsItsPoints) {
  const double tolerance = cloud().shape == "ellipsoid" ? 0x1p-19 : 1e-12;
  for (Eigen::Index i = 0; i < cloud().points.rows(); ++i) {
    EXPECT_NEAR(offSurface(cloud().shape, cloud().points.row(i)), 0, tolerance) << i;
  }
}

TEST_P(EverySurface, HasNormalsAlongTheGradientOfItsEquation) {
  EXPECT_LT((cloud().normals.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-12);
  // Where sheets meet, the equation has no gradient; small steps keep nearly all points off such places.
  const double h = cloud().shape == "saddle" || cloud().shape == "ellipsoid" ? 1e-5 : 1e-7;
  for (Eigen::Index i = 0; i < cloud().points.rows(); ++i) {
    RowVector3d gradient;
    for (int axis = 0; axis < 3; ++axis) {
      const RowVector3d step = h * RowVector3d::Unit(axis), p = cloud().points.row(i);
      gradient[axis] = offSurface(cloud().shape, p + step) - offSurface(cloud().shape, p - step);
    }
    EXPECT_NEAR(std::abs(gradient.normalized().dot(cloud().normals.row(i))), 1, 1e-6) << i;
  }
}

TEST_P(EveryCloud, HasConsistentSizes) {
  const Eigen::Index n = cloud().points.rows();
  EXPECT_EQ(cloud().normals.rows(), n);
  EXPECT_TRUE(cloud().labels.empty() || static_cast<Eigen::Index>(cloud().labels.size()) == n);
  if (cloud().width > 0) {
    EXPECT_EQ(cloud().width * cloud().height, n);
  }
  EXPECT_GT(n, 480);
  EXPECT_LT(n, 1200);
  EXPECT_TRUE(std::is_sorted(cloud().eigenvalues.begin(), cloud().eigenvalues.end()));
}

INSTANTIATE_TEST_SUITE_P(Shapes, EveryCloud, testing::ValuesIn(indicesOf([](const Cloud&) { return true; })), nameOf);
INSTANTIATE_TEST_SUITE_P(Shapes, EverySurface, testing::ValuesIn(indicesOf([](const Cloud& cloud) {
                           return cloud.noise == 0 && cloud.outliers == 0 && cloud.shape != "room";
                         })),
                         nameOf);

TEST(Clouds, CountIsExactExceptForLattices) {
  for (const Sampling sampling : {Sampling::uniform, Sampling::jittered, Sampling::nonuniform, Sampling::scanLines(10),
                                  Sampling::densityStep(16)}) {
    EXPECT_EQ(sphere(1234, sampling).points.rows(), 1234);
    EXPECT_EQ(cylinderPatch(1234, sampling).points.rows(), 1234);
  }
}

// Uniform per area: mean of z^2 over the surface, whose integral is known, and the share of a part of known area.
TEST(Clouds, UniformSamplingIsUniformPerArea) {
  constexpr int n = 100000;
  const auto mean = [](const Cloud& cloud, const std::function<double(RowVector3d)>& f) {
    double sum = 0;
    for (Eigen::Index i = 0; i < cloud.points.rows(); ++i) sum += f(cloud.points.row(i));
    return sum / static_cast<double>(cloud.points.rows());
  };
  const auto z2 = [](const RowVector3d& p) { return p.z() * p.z(); };
  EXPECT_NEAR(mean(sphere(n), z2), 1.0 / 3, 5e-3);
  EXPECT_NEAR(mean(torus(n), z2), 0.16 / 2, 1e-3);
  EXPECT_NEAR(mean(torus(n), [](const RowVector3d& p) { return std::hypot(p.x(), p.y()); }), 1 + 0.16 / 2, 2e-3);
  EXPECT_NEAR(mean(disk(n), [](const RowVector3d& p) { return p.squaredNorm(); }), 0.5, 5e-3);
  EXPECT_NEAR(mean(cylinderPatch(n, Sampling::uniform, Rim::none), z2), 4.0 / 3, 2e-2);
  EXPECT_NEAR(mean(cubeSurface(n), [](const RowVector3d& p) { return p.x() == 1; }), 1.0 / 6, 5e-3);
  EXPECT_NEAR(mean(prismSurface(n), [](const RowVector3d& p) { return p.z() == 0; }),
              0.25 * std::sqrt(3.0) / prismSurface(10).area, 5e-3);
  // The integral of z^2 over dA is the integral over (x, y) of z^2 / |normal_z|.
  const Cloud s = saddle(n);
  double inverse = 0;
  for (Eigen::Index i = 0; i < n; ++i) inverse += s.normals(i, 2);
  EXPECT_NEAR(s.area * inverse / n, 4, 2e-2);  // the area of its projection
  const Cloud e = ellipsoid(n);
  double volume = 0;
  for (Eigen::Index i = 0; i < n; ++i) volume += e.points.row(i).dot(e.normals.row(i));
  EXPECT_NEAR(e.area * volume / n / 3, 4.0 / 3 * pi * 1.5 * 1.25, 5e-2);  // divergence theorem
}

TEST(Clouds, AreasByIntegrationMatchClosedForms) {
  // Ellipsoid of the fixture by Knud Thomsen's formula (relative error below 1.1 %).
  const double p = 1.6075, a = std::pow(1.5, p), b = std::pow(1.25, p);
  EXPECT_NEAR(ellipsoid(1).area, 4 * pi * std::pow((a * b + a + b) / 3, 1 / p), 0.2);
  // Integral of sqrt(1 + x^2 + y^2) over [-1, 1]^2.
  const double closed = 4 * std::sqrt(3.0) / 3 + 16.0 / 3 * std::asinh(1 / std::sqrt(2.0)) - 2 * pi / 9;
  EXPECT_NEAR(saddle(500).area, closed, 1e-9);
}

TEST(Clouds, EllipsoidCoordinatesAreDyadicAndDistinct) {
  const Cloud cloud = ellipsoid(20000);
  for (int axis = 0; axis < 3; ++axis) {
    std::set<double> values;
    for (Eigen::Index i = 0; i < cloud.points.rows(); ++i) {
      const double scaled = cloud.points(i, axis) * 0x1p20;
      EXPECT_EQ(scaled, std::round(scaled));
      EXPECT_TRUE(values.insert(scaled).second);
    }
  }
}

TEST(Clouds, LatticeStepsAreExact) {
  const Cloud cloud = squareLattice(60, 0.015625);
  ASSERT_EQ(cloud.points.rows(), 3600);
  for (int i = 0; i < 3600; ++i) {
    EXPECT_EQ(cloud.points(i, 0), i % 60 * 0.015625);
    EXPECT_EQ(cloud.points(i, 1), i / 60 * 0.015625);
  }
  const Points mixed = shuffled(cloud).points;
  const auto rows = [](const Points& points) {
    std::set<std::pair<double, double>> set;
    for (Eigen::Index i = 0; i < points.rows(); ++i) set.emplace(points(i, 0), points(i, 1));
    return set;
  };
  EXPECT_EQ(rows(mixed), rows(cloud.points));
  EXPECT_FALSE(same(mixed, cloud.points));
}

TEST(Clouds, ScanLinesHaveTheirAnisotropy) {
  for (const double anisotropy : {4.0, 10.0, 20.0, 40.0, 80.0}) {
    const Cloud cloud = sphere(64000, Sampling::scanLines(anisotropy));
    std::set<double> heights;
    for (Eigen::Index i = 0; i < cloud.points.rows(); ++i) heights.insert(cloud.points(i, 2));
    const double line = pi / static_cast<double>(heights.size());
    EXPECT_NEAR(line / (4 * pi / 64000 / line), anisotropy, 0.05 * anisotropy);
  }
}

TEST(Clouds, RimsCarryPoints) {
  const auto onRim = [](const Cloud& cloud, const std::function<bool(RowVector3d)>& rim) {
    int count = 0;
    for (Eigen::Index i = 0; i < cloud.points.rows(); ++i) count += rim(cloud.points.row(i));
    return count;
  };
  const auto squareRim = [](const RowVector3d& p) { return p.x() == 0 || p.x() == 1 || p.y() == 0 || p.y() == 1; };
  EXPECT_EQ(onRim(square(1600, Sampling::uniform, Rim::included), squareRim), 4 * 40);
  EXPECT_EQ(onRim(square(1600), squareRim), 0);
  const auto circle = [](const RowVector3d& p) { return std::abs(p.norm() - 1) < 1e-12; };
  EXPECT_NEAR(onRim(disk(1600, Sampling::uniform, Rim::included), circle), 2 * pi / std::sqrt(pi / 1600), 1);
  const auto ends = [](const RowVector3d& p) { return p.z() == 0 || p.z() == 2; };
  EXPECT_GT(onRim(cylinderPatch(1600), ends), 90);
}

TEST(Clouds, RimPointsAreCountedAndComeFirst) {
  EXPECT_EQ(square(1600).rim_points, 0);
  EXPECT_EQ(sphere(1600).rim_points, 0);
  const Cloud cloud = square(1600, Sampling::uniform, Rim::included);
  ASSERT_EQ(cloud.rim_points, 4 * 40);
  for (int i = 0; i < 1600; ++i) {
    EXPECT_EQ((cloud.points.row(i).head(2).array() - 0.5).abs().maxCoeff() == 0.5, i < cloud.rim_points) << i;
  }
}

TEST(Clouds, DensityStepsHaveTheirRatioOnEquallyLargeHalves) {
  for (const double ratio : {16.0, 100.0}) {
    const Cloud cloud = sphere(100000, Sampling::densityStep(ratio));
    const double sparse = static_cast<double>((cloud.points.col(2).array() < 0).count());
    // The sparse half is a binomial count; three of its standard deviations.
    EXPECT_NEAR(sparse, 100000 / (ratio + 1), 3 * std::sqrt(100000 / (ratio + 1)));
  }
}

TEST(Clouds, NearOutliersAreTwoToSixSpacingsOffOnEitherSide) {
  const Cloud cloud = withOutliers(sphere(10000), Outliers::near, 0.01);
  ASSERT_EQ(cloud.outliers, 100);
  ASSERT_EQ(cloud.points.rows(), 10100);
  const double spacing = std::sqrt(4 * pi / 10000);
  const Eigen::ArrayXd off = (cloud.points.bottomRows(100).rowwise().norm().array() - 1) / spacing;
  EXPECT_GE(off.abs().minCoeff(), 2 - 1e-9);
  EXPECT_LE(off.abs().maxCoeff(), 6 + 1e-9);
  EXPECT_LT(off.minCoeff(), -5);
  EXPECT_GT(off.maxCoeff(), 5);
  EXPECT_TRUE(same(cloud.points.topRows(10000), sphere(10000).points));
}

TEST(Clouds, FarOutliersFillTheEnlargedBox) {
  const Cloud cloud = withOutliers(sphere(10000), Outliers::far, 0.1);
  ASSERT_EQ(cloud.outliers, 1000);
  const Eigen::ArrayX3d far = cloud.points.bottomRows(1000);
  EXPECT_LE(far.abs().maxCoeff(), 1.5);
  EXPECT_GT(far.colwise().maxCoeff().minCoeff(), 1.4);
  EXPECT_LT(far.colwise().minCoeff().maxCoeff(), -1.4);
}

TEST(Spectra, MatchKnownValues) {
  EXPECT_EQ(sphereSpectrum(10).tail(6), (VectorXd(6) << 6, 6, 6, 6, 6, 12).finished());
  const VectorXd disk = diskSpectrum(100);
  ASSERT_EQ(disk.size(), 100);
  // j'_{1,1}, j'_{2,1}, j'_{0,2} of Abramowitz and Stegun, table 9.5.
  EXPECT_NEAR(std::sqrt(disk[1]), 1.84118, 1e-5);
  EXPECT_NEAR(std::sqrt(disk[2]), 1.84118, 1e-5);
  EXPECT_NEAR(std::sqrt(disk[3]), 3.05424, 1e-5);
  EXPECT_NEAR(std::sqrt(disk[5]), 3.83170597, 1e-7);
  // Weyl's law with the boundary's term holds for the counting function.
  EXPECT_NEAR(disk[99] / 4 + std::sqrt(disk[99]) / 2, 100, 4);
  // The first eigenvalues of a thin torus are those of a circle.
  const VectorXd torus = torusSpectrum(1, 1e-3, 5);
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(torus[i], ((i + 1) / 2) * ((i + 1) / 2), 1e-5);
  // Two pages are one rectangle of twice the width.
  EXPECT_LT((bookSpectrum(2, 0.5, 1, 50) - rectangleSpectrum(1, 1, 50)).cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace tufted::shapes::clouds_test
