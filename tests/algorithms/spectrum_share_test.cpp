// Eigenpairs where most of the space is wanted, by both methods, against dense matrices; and pairs that nothing finds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/number_text.h"
#include "oracles/oracles.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "support/joined_grids.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::spectrum_share_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

enum class Kind { cloud, clean_cloud, mesh };
constexpr Kind kinds[] = {Kind::cloud, Kind::clean_cloud, Kind::mesh};

/// Random points on spheres of different size, n points in all.
Laplacian spheres(Kind kind, int parts, int n, std::uint64_t seed) {
  Points points(n, 3);
  Triangles triangles(0, 3);
  for (int part = 0; part < parts; ++part) {
    const int first = part * n / parts, count = (part + 1) * n / parts - first;
    const Points sphere = shapes::sphere(count, shapes::Sampling::uniform, 10 * seed + part).points;
    points.middleRows(first, count) = ((1 + part) * sphere).rowwise() + Eigen::RowVector3d(9 * part, 0, 0);
    if (kind != Kind::mesh) continue;
    const Triangles hull = oracles::convexHullMesh(sphere);
    triangles.conservativeResize(triangles.rows() + hull.rows(), 3);
    triangles.bottomRows(hull.rows()) = hull.array() + first;
  }
  if (kind == Kind::mesh) return meshLaplacian(points, triangles);
  return pointCloudLaplacian(points, cloudOptions(kind == Kind::cloud ? Preset::scan : Preset::clean));
}

/// The residuals are measured here once more.
void expectPairs(const Laplacian& laplacian, const Spectrum& found, const VectorXd& expected, const std::string& name) {
  const Index k = found.values.size();
  double residual = 0, error = 0;
  for (Index c = found.report.null_space; c < k; ++c) {
    const VectorXd weighted = found.values[c] * laplacian.M.cwiseProduct(found.vectors.col(c));
    residual = std::max(residual, (laplacian.L * found.vectors.col(c) - weighted).norm() / weighted.norm());
    error = std::max(error, std::abs(found.values[c] - expected[c]) / expected[c]);
    EXPECT_GE(found.values[c], found.values[std::max<Index>(c - 1, 0)]) << name << ", " << c;
  }
  EXPECT_LE(residual, 1e-9) << name;
  EXPECT_LE(error, 1e-8) << name;
  EXPECT_NEAR(found.report.residual, residual, 1e-12) << name;
  const MatrixXd gram = found.vectors.transpose() * laplacian.M.asDiagonal() * found.vectors;
  EXPECT_LE((gram - MatrixXd::Identity(k, k)).cwiseAbs().maxCoeff(), 1e-10) << name;
  EXPECT_TRUE(found.values.head(found.report.null_space).isZero(0)) << name;
}

void expectMostOf(const Laplacian& laplacian, const std::vector<int>& dense_limits, const std::string& name) {
  const VectorXd expected = oracles::denseEigenvalues(laplacian.L, laplacian.M);
  const int n = static_cast<int>(expected.size());
  for (const int k : {n / 2, 2 * n / 3, n - 1}) {
    for (const int dense_limit : dense_limits) {
      const Spectrum found = spectrum(laplacian, k, {.dense_limit = dense_limit});
      EXPECT_EQ(found.report.method, dense_limit > 0 ? "dense" : "block Lanczos");
      EXPECT_EQ(found.report.iterations == 0, dense_limit > 0);
      EXPECT_TRUE(found.report.counted) << name;
      expectPairs(laplacian, found, expected, name + ", " + found.report.method + ", k = " + std::to_string(k));
    }
  }
}

const int by_default = SpectrumOptions().dense_limit;

TEST(SpectrumOfMost, IsThatOfDenseMatricesByBothMethods) {
  for (const int n : {50, 300}) {
    for (const Kind kind : kinds) {
      for (const int parts : {1, 3}) {
        expectMostOf(spheres(kind, parts, n, 1), {by_default, 0},
                     std::to_string(n) + " points, " + std::to_string(parts) + " parts, kind " +
                         std::to_string(static_cast<int>(kind)));
      }
    }
  }
}

TEST(SpectrumOfMost, TakesCopiesAndPointsThatNothingJoins) {
  Points points(303, 3);
  points.topRows(300) = shapes::torus(300).points;
  points.row(300) = points.row(7);
  points.row(301).setConstant(NAN);
  points.row(302) << 1e90, 0, 0;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const int most = mostEigenpairs(laplacian);
  EXPECT_GE(most, 290);
  for (const int dense_limit : {by_default, 0}) {
    const Spectrum found = spectrum(laplacian, most, {.dense_limit = dense_limit});
    EXPECT_EQ(found.vectors.row(300), found.vectors.row(7));
    EXPECT_TRUE(found.vectors.bottomRows(2).isZero(0));
  }
  expectMostOf(laplacian, {by_default, 0}, "odd points");
}

TEST(SpectrumOfMost, IsExactWhereMassesAreUnevenOrNone) {
  // Against dense matrices of more digits: those of doubles lose what is small beside the largest eigenvalue.
  for (const double decades : {2.0, 5.0, 8.0}) {
    for (const std::uint64_t seed : {1, 2, 3}) {
      Laplacian laplacian = spheres(Kind::clean_cloud, 2, 120, seed);
      shapes::Random random(seed);
      for (double& mass : laplacian.M) mass *= std::pow(10, -decades * random.uniform());
      for (const int i : {3, 4, 50, 119}) laplacian.M[i] = 0;
      const VectorXd expected = oracles::denseEigenvalues(laplacian.L, laplacian.M, oracles::Precision::extended);
      for (const int k : {10, 60, 115}) {
        for (const int dense_limit : {by_default, 0}) {
          // The search loses two digits more, for it knows the smallest eigenvalues of an inverse by its largest alone.
          if (dense_limit == 0 && decades > 5) continue;
          const Spectrum found = spectrum(laplacian, k, {.dense_limit = dense_limit});
          expectPairs(laplacian, found, expected,
                      found.report.method + ", k = " + std::to_string(k) + ", decades " + std::to_string(decades));
        }
      }
    }
  }
}

TEST(SpectrumOfMost, DoesNotTakeMoreMemoryForDenseMatricesThanItMay) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::torus(400).points);
  EXPECT_EQ(spectrum(laplacian, 200).report.method, "dense");
  EXPECT_EQ(spectrum(laplacian, 200, {.memory_limit = 24 * 400 * 400 - 1}).report.method, "block Lanczos");
  EXPECT_EQ(spectrum(laplacian, 200, {.dense_limit = 399}).report.method, "block Lanczos");
  EXPECT_EQ(spectrum(laplacian, 20).report.method, "block Lanczos");
  EXPECT_EQ(spectrum(laplacian, 1).report.method, "");
}

TEST(SpectrumOfMost, SaysHowLongDenseMatricesWillTake) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::torus(700).points);
  std::vector<std::string> stages;
  spectrum(laplacian, 300, {.progress = [&](std::string_view stage, double) {
             if (stages.empty() || stages.back() != stage) stages.emplace_back(stage);
             return true;
           }});
  EXPECT_EQ(std::count(stages.begin(), stages.end(), "dense, about 1 s"), 1);
}

TEST(SpectrumOfNearlyDisconnectedSurfaces, SaysSoWhereItsResidualIsRounding) {
  // Two grids of as many points, joined by w: the first positive eigenvalue is 2 w over their number, to first order.
  for (const int side : {10, 30}) {
    for (const double weight : {1e-3, 1e-6, 1e-9, 1e-12, 1e-13}) {
      const Laplacian laplacian = support::joinedGrids(side, {weight});
      const Index half = laplacian.M.size() / 2;
      for (const int k : {20, side < 20 ? mostEigenpairs(laplacian) : 200}) {
        const Spectrum found = spectrum(laplacian, k);
        const std::string name = std::to_string(side) + ", " + numberText(weight) + ", k = " + std::to_string(k);
        EXPECT_NEAR(found.values[1] / weight * static_cast<double>(half), 2, 20 * weight + 1e-9) << name;
        EXPECT_LE(found.report.backward_error, 1e-10) << name;
        EXPECT_EQ(found.report.weak_pair, found.report.residual > 1e-8 ? 1 : -1) << name;
        EXPECT_EQ(found.report.weak_pair, weight > 1e-6 ? -1 : 1) << name << ": " << found.report.residual;
        const VectorXd x = found.vectors.col(1);
        EXPECT_GT(x.head(half).maxCoeff() * x.head(half).minCoeff(), 0) << name;
        EXPECT_GT(x.tail(half).maxCoeff() * x.tail(half).minCoeff(), 0) << name;
        EXPECT_LT(x.head(half).maxCoeff() * x.tail(half).maxCoeff(), 0) << name;
      }
    }
  }
}

TEST(SpectrumOfMost, NamesThePairWhoseResidualIsLarge) {
  // Not symmetric: what its lower triangle says is no eigenpair of the whole.
  Laplacian laplacian = pointCloudLaplacian(shapes::sphere(100).points, cloudOptions(Preset::clean));
  SparseMatrix::InnerIterator entry(laplacian.L, 50);
  while (entry.row() >= 50) ++entry;
  entry.valueRef() *= 1.001;
  for (const int k : {5, 99}) {
    try {
      spectrum(laplacian, k);
      ADD_FAILURE() << k;
    } catch (const SolverFailure& failure) {
      const std::string said = failure.what();
      EXPECT_EQ(said.find("spectrum: of pair "), 0) << said;
      EXPECT_NE(said.find("|L x - lambda M x| / (lambda |M x|) is "), std::string::npos) << said;
      EXPECT_NE(said.find(", must be at most 1"), std::string::npos) << said;
    }
  }
}

TEST(SpectrumOfMost, RefusesALimitBelowZero) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::sphere(50).points);
  EXPECT_EQ(support::refusal([&] { spectrum(laplacian, 5, {.dense_limit = -1}); }),
            "spectrum: dense_limit = -1, must be >= 0");
}

}  // namespace
}  // namespace tufted::spectrum_share_test
