// Eigenpairs of L x = lambda M x: exactness, order and signs, multiplicities, odd clouds, and what callers may ask for.
#include "tufted/spectrum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "oracles/oracles.h"
#include "shapes/shapes.h"
#include "shapes/spectra.h"
#include "support/compare.h"
#include "tufted/tufted.h"

namespace tufted::spectrum_test {
namespace {

using Eigen::MatrixXd;

/// Copies of one cloud side by side, so that each eigenvalue is there as often, to the last bit.
Points copies(const Points& points, int count) {
  Points result(points.rows() * count, 3);
  for (int c = 0; c < count; ++c)
    result.middleRows(c * points.rows(), points.rows()) = points.rowwise() + Eigen::RowVector3d(8.0 * c, 0, 0);
  return result;
}

/// What every spectrum promises.
void expectEigenpairs(const Laplacian& laplacian, const Spectrum& spectrum, const std::string& name) {
  const Eigen::Index k = spectrum.values.size();
  const MatrixXd gram = spectrum.vectors.transpose() * laplacian.M.asDiagonal() * spectrum.vectors;
  EXPECT_LE((gram - MatrixXd::Identity(k, k)).cwiseAbs().maxCoeff(), 1e-10) << name;
  EXPECT_LE(spectrum.report.orthogonality, 1e-10) << name;
  EXPECT_LE(spectrum.report.residual, 1e-8) << name;
  for (Eigen::Index c = 0; c < k; ++c) {
    const VectorXd x = spectrum.vectors.col(c);
    const double lambda = spectrum.values[c];
    EXPECT_GE(lambda, spectrum.values[std::max<Eigen::Index>(c - 1, 0)]) << name << ", " << c;
    EXPECT_EQ(lambda == 0, c < spectrum.report.null_space) << name << ", " << c;
    EXPECT_GE(x.maxCoeff(), (1 - 1e-5) * -x.minCoeff()) << name << ", " << c;  // the fixed sign
    const VectorXd weighted = laplacian.M.cwiseProduct(x);
    if (lambda == 0) {
      EXPECT_LE((laplacian.L * x).cwiseAbs().maxCoeff(), 1e-12 * laplacian.L.diagonal().maxCoeff() * x.maxCoeff());
      continue;
    }
    EXPECT_LE((laplacian.L * x - lambda * weighted).norm(), 1e-8 * lambda * weighted.norm()) << name << ", " << c;
  }
  for (Eigen::Index i = 0; i < spectrum.vectors.rows(); ++i) {
    const PointStatus status = laplacian.status[i];
    if (status == PointStatus::coincident) {
      EXPECT_EQ(spectrum.vectors.row(i), spectrum.vectors.row(laplacian.representative[i]));
    } else if (status != PointStatus::active) {
      EXPECT_TRUE(spectrum.vectors.row(i).isZero(0)) << i;
    }
  }
}

TEST(Spectrum, IsThatOfTheOracle) {
  const std::vector<std::pair<std::string, Points>> clouds = {
      {"torus", shapes::torus(3000).points},
      {"noisy sphere", shapes::withNoise(shapes::sphere(2000), 0.02).points},
      {"disk", shapes::disk(2000).points},
      {"density step", shapes::sphere(3000, shapes::Sampling::densityStep(100)).points}};
  for (const auto& [name, points] : clouds) {
    const Laplacian laplacian = pointCloudLaplacian(points);
    for (const int k : {2, 30}) {
      const Spectrum found = spectrum(laplacian, k);
      EXPECT_TRUE(found.report.counted) << name;
      expectEigenpairs(laplacian, found, name);
      const VectorXd expected = oracles::smallestEigenvalues(laplacian.L, laplacian.M, k);
      EXPECT_LE((found.values - expected).cwiseAbs().maxCoeff(), 1e-8 * expected[k - 1]) << name;
    }
  }
}

TEST(Spectrum, FindsCopiesOfMultipleEigenvalues) {
  // The icosphere has eigenvalues five times over by its symmetry; side by side, each of them eleven times as often.
  const shapes::Mesh ball = shapes::icosphere(3);
  const Laplacian alone = meshLaplacian(ball.points, ball.triangles);
  const VectorXd expected = oracles::smallestEigenvalues(alone.L, alone.M, 40);
  EXPECT_LE((spectrum(alone, 40).values - expected).cwiseAbs().maxCoeff(), 1e-9 * expected[39]);

  const Points points = shapes::torus(700).points;
  const Laplacian one = pointCloudLaplacian(points), many = pointCloudLaplacian(copies(points, 11));
  const Spectrum single = spectrum(one, 6), repeated = spectrum(many, 66);
  EXPECT_EQ(repeated.report.null_space, 11);
  expectEigenpairs(many, repeated, "copies");
  EXPECT_TRUE(repeated.report.counted);
  for (int c = 0; c < 66; ++c) EXPECT_NEAR(repeated.values[c], single.values[c / 11], 1e-9 * single.values[5]) << c;
  // Twenty of each, and the last eigenvalue cut short.
  const Spectrum more = spectrum(pointCloudLaplacian(copies(points, 20)), 110);
  EXPECT_TRUE(more.report.counted);
  for (int c = 0; c < 110; ++c) EXPECT_NEAR(more.values[c], single.values[c / 20], 1e-9 * single.values[5]) << c;
}

TEST(Spectrum, HasTheWholeSpaceButOne) {
  const shapes::Mesh mesh = shapes::tetrahedron();
  const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
  const Spectrum most = spectrum(laplacian, 3);  // of 4; the non-zero ones are equal, for the tetrahedron is regular
  expectEigenpairs(laplacian, most, "tetrahedron");
  EXPECT_NEAR(most.values[1], most.values[2], 1e-12 * most.values[2]);

  // By both methods, and of meshes: spectrum_share_test.cpp.
  for (const int n : {150, 300, 400, 1000}) {
    const Laplacian cloud = pointCloudLaplacian(shapes::torus(n).points);
    const VectorXd dense = oracles::denseEigenvalues(cloud.L, cloud.M);
    const Spectrum all = spectrum(cloud, n - 1);
    expectEigenpairs(cloud, all, std::to_string(n) + " points");
    EXPECT_LE(all.report.residual, 1e-9) << n;
    for (int c = 1; c < n - 1; ++c) EXPECT_NEAR(all.values[c], dense[c], 1e-8 * dense[c]) << n << ", " << c;
  }
}

TEST(Spectrum, IsThatOfDenseMatricesOnAHandfulOfPoints) {
  for (int n = 4; n <= 12; ++n) {
    const Laplacian laplacian = pointCloudLaplacian(shapes::sphere(n).points);
    ASSERT_EQ(laplacian.report.active, n);
    const VectorXd dense = oracles::denseEigenvalues(laplacian.L, laplacian.M);
    for (int k = 1; k < n; ++k) {
      const Spectrum found = spectrum(laplacian, k);
      expectEigenpairs(laplacian, found, std::to_string(n) + " points");
      EXPECT_LE((found.values - dense.head(k)).cwiseAbs().maxCoeff(), 1e-11 * dense[n - 1]) << n << ", " << k;
    }
  }
}

TEST(Spectrum, HasAConstantForEachOfManyTinyComponents) {
  const shapes::Mesh one = shapes::tetrahedron();
  const int count = 200;
  Points points(4 * count, 3);
  Triangles triangles(4 * count, 3);
  for (int c = 0; c < count; ++c) {
    points.middleRows(4 * c, 4) = one.points.rowwise() + Eigen::RowVector3d(4.0 * c, 0, 0);
    triangles.middleRows(4 * c, 4) = one.triangles.array() + 4 * c;
  }
  const Laplacian laplacian = meshLaplacian(points, triangles);
  for (const int k : {150, 200, 201, 250, 799}) {  // all others are one eigenvalue, 600 times
    const Spectrum found = spectrum(laplacian, k);
    EXPECT_EQ(found.report.null_space, std::min(k, count));
    expectEigenpairs(laplacian, found, std::to_string(k) + " of tetrahedra");
    EXPECT_LE(found.values[k - 1] - found.values[std::min(count, k - 1)], 1e-10 * found.values[k - 1]);
  }
}

TEST(Spectrum, OfPointsThatNothingJoinsIsZero) {
  Laplacian laplacian = pointCloudLaplacian(shapes::sphere(50).points);
  laplacian.L.setZero();
  laplacian.M = VectorXd::LinSpaced(50, 1, 2);
  const Spectrum found = spectrum(laplacian, 49);
  EXPECT_EQ(found.report.null_space, 49);
  EXPECT_TRUE(found.values.isZero(0));
  expectEigenpairs(laplacian, found, "points");
}

TEST(Spectrum, IsSearchedWhereTheFactorForCountingDoesNotFit) {
  // Nine copies of each eigenvalue, one more than a block has vectors.
  const Laplacian laplacian = pointCloudLaplacian(copies(shapes::torus(500).points, 9));
  const Spectrum counted = spectrum(laplacian, 30);
  const std::size_t held = counted.report.solver.bytes;
  const Spectrum searched = spectrum(laplacian, 30, {.memory_limit = held + held / 10});
  EXPECT_TRUE(counted.report.counted);
  EXPECT_FALSE(searched.report.counted);
  EXPECT_FALSE(searched.report.solver.iterative);
  EXPECT_GE(searched.report.iterations, counted.report.iterations + 8);  // a search that finds nothing more
  EXPECT_LE((searched.values - counted.values).cwiseAbs().maxCoeff(), 1e-9 * counted.values[29]);
}

TEST(Spectrum, RefusesAreasWhoseEigenvaluesAreNoDoubles) {
  const Laplacian laplacian = pointCloudLaplacian(1e-160 * shapes::sphere(500).points);
  ASSERT_GT(laplacian.M.sum(), 0);
  EXPECT_THROW(spectrum(laplacian, 5), SolverFailure);
  EXPECT_EQ(spectrum(laplacian, 1).values[0], 0);
}

TEST(Spectrum, ScalesWithTheCloud) {
  // Multiples of 2^-20: moving and doubling are exact.
  const Points points = shapes::ellipsoid(2000).points;
  const Spectrum reference = spectrum(pointCloudLaplacian(points), 12);
  for (const int exponent : {-500, -60, 1, 60, 400}) {
    const double scale = std::ldexp(1.0, exponent);
    const Spectrum scaled = spectrum(pointCloudLaplacian(scale * points), 12);
    EXPECT_LE((scaled.values * scale * scale - reference.values).cwiseAbs().maxCoeff(), 1e-12 * reference.values[11]);
    EXPECT_LE((scaled.vectors * scale - reference.vectors).cwiseAbs().maxCoeff(), 1e-9) << exponent;
  }
}

TEST(Spectrum, OnAnyNumberOfThreadsGivesTheSameBits) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::torus(30000).points);
  const Spectrum one = spectrum(laplacian, 20, {.threads = 1}), three = spectrum(laplacian, 20, {.threads = 3});
  EXPECT_TRUE(support::sameBits(one.values, three.values));
  EXPECT_TRUE(support::sameBits(one.vectors.data(), three.vectors.data(), one.vectors.size()));
}

TEST(Spectrum, ByMultigridIsTheSame) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::torus(5000).points);
  const Spectrum found = spectrum(laplacian, 10, {.method = SolverMethod::multigrid});
  EXPECT_TRUE(found.report.solver.method.starts_with("multigrid"));
  expectEigenpairs(laplacian, found, "multigrid");
  const VectorXd expected = spectrum(laplacian, 10).values;
  EXPECT_LE((found.values - expected).cwiseAbs().maxCoeff(), 1e-10 * expected[9]);
}

TEST(Spectrum, HasAConstantPerComponentLargestAreaFirst) {
  // Spheres of radius 1, 2, 1/2; a copy and points without surface among them.
  Points points(3003, 3);
  points.topRows(1000) = shapes::sphere(1000).points;
  points.middleRows(1000, 1000) = (2 * shapes::sphere(1000).points).array() + 9;
  points.middleRows(2000, 1000) = (0.5 * shapes::sphere(1000).points).array() - 9;
  points.row(3000) = points.row(1500);
  points.row(3001).setConstant(NAN);
  points.row(3002) << 1e90, 0, 0;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const Spectrum found = spectrum(laplacian, 6);
  expectEigenpairs(laplacian, found, "three spheres");
  ASSERT_EQ(found.report.null_space, 3);
  for (const auto& [column, first] : {std::pair(0, 1000), std::pair(1, 0), std::pair(2, 2000)}) {
    const double constant = 1 / std::sqrt(laplacian.M.segment(first, 1000).sum());
    for (int i = 0; i < 3000; ++i)
      EXPECT_NEAR(found.vectors(i, column), i >= first && i < first + 1000 ? constant : 0, 1e-12);
  }
  // Fewer than the constants are some of them.
  const Spectrum two = spectrum(laplacian, 2);
  EXPECT_EQ(two.vectors, found.vectors.leftCols(2));
  EXPECT_EQ(two.report.iterations, 0);
  // Without them the rest is the same.
  const Spectrum rest = spectrum(laplacian, 3, {.null_space = false});
  EXPECT_EQ(rest.report.null_space, 0);
  EXPECT_EQ(rest.values, found.values.tail(3));
  EXPECT_EQ(rest.vectors, found.vectors.rightCols(3));
}

TEST(Spectrum, NamesWhatACallerGotWrong) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::sphere(500).points);
  const auto refusal = [](const Laplacian& of, int k, const SpectrumOptions& options = {}) {
    try {
      spectrum(of, k, options);
    } catch (const InvalidInput& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(refusal(laplacian, 0),
            "spectrum: k = 0, must be at least 1 and at most 500, the number of active points of positive area");
  EXPECT_NE(refusal(laplacian, 501), "accepted");
  EXPECT_NE(refusal(laplacian, 500, {.null_space = false}).find("at most 499, "), std::string::npos);
  EXPECT_NE(refusal(pointCloudLaplacian(Points(0, 3)), 1), "accepted");
  EXPECT_EQ(refusal(laplacian, 5, {.tolerance = 1}), "spectrum: tolerance = 1, must lie in (0, 1)");
  EXPECT_EQ(refusal(laplacian, 5, {.max_iterations = 0}), "spectrum: max_iterations = 0, must be at least 1");
  EXPECT_EQ(refusal(laplacian, 5, {.threads = -2}), "spectrum: threads = -2, must be >= 0");
  Laplacian wrong = laplacian;
  wrong.M[3] = -1;
  EXPECT_EQ(refusal(wrong, 5), "spectrum: M has values that are negative or not finite, must have none");
  wrong.M.conservativeResize(499);
  EXPECT_NE(refusal(wrong, 5), "accepted");
}

TEST(Spectrum, GivesAllPairsThatThereAre) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::sphere(300).points);
  const double trace = laplacian.L.diagonal().cwiseQuotient(laplacian.M).sum();
  for (const int dense_limit : {0, 3000}) {
    const Spectrum positive = spectrum(laplacian, 299, {.dense_limit = dense_limit, .null_space = false});
    EXPECT_EQ(positive.report.method, dense_limit == 0 ? "block Lanczos" : "dense");
    EXPECT_GT(positive.values[0], 0);
    EXPECT_NEAR(positive.values.sum(), trace, 1e-9 * trace) << dense_limit;
    const Spectrum all = spectrum(laplacian, 300, {.dense_limit = dense_limit});
    EXPECT_EQ(all.values.tail(299), positive.values);
  }
}

TEST(Spectrum, FailsTypedWhereItCannotBeFound) {
  Laplacian laplacian = pointCloudLaplacian(shapes::sphere(3000).points);
  EXPECT_THROW(spectrum(laplacian, 40, {.max_iterations = 2}), SolverFailure);
  laplacian.L *= -1;
  EXPECT_THROW(spectrum(laplacian, 40), SolverFailure);
}

TEST(Spectrum, CancelsAtEveryCall) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::sphere(500).points);
  int calls = 0;
  const auto findUntil = [&](int stop) {
    calls = 0;
    spectrum(laplacian, 10, {.progress = [&](std::string_view, double) { return ++calls < stop; }});
  };
  findUntil(std::numeric_limits<int>::max());
  const int all = calls;
  EXPECT_GE(all, 5);
  int cancelled = 0;
  for (int stop = 1; stop <= all; ++stop) {
    try {
      findUntil(stop);
      EXPECT_LT(calls, stop);  // how many calls there are depends on the time that passes
    } catch (const Cancelled&) {
      ++cancelled;
    }
  }
  EXPECT_GE(cancelled, all / 2);
}

TEST(MostEigenpairs, IsTheLargestCountThatSpectrumTakes) {
  // Two tetrahedra, joined by a weight that is lost in rounding: to the report one component, to the spectrum two.
  shapes::Mesh mesh = shapes::tetrahedron();
  const Points one = mesh.points;
  const Triangles triangles = mesh.triangles;
  mesh.points.resize(8, 3);
  mesh.points << one, one.rowwise() + Eigen::RowVector3d(9, 0, 0);
  mesh.triangles.resize(8, 3);
  mesh.triangles << triangles, triangles.array() + 4;
  Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
  laplacian.L.coeffRef(0, 4) = laplacian.L.coeffRef(4, 0) = -1e-20;
  laplacian.L.makeCompressed();
  laplacian.report.components = 1;
  for (const bool null_space : {true, false}) {
    const int most = mostEigenpairs(laplacian, null_space);
    EXPECT_EQ(most, null_space ? 8 : 6);
    EXPECT_EQ(spectrum(laplacian, most, {.null_space = null_space}).values.size(), most);
    EXPECT_THROW(spectrum(laplacian, most + 1, {.null_space = null_space}), InvalidInput);
  }
  const Laplacian nothing = pointCloudLaplacian(Points(0, 3));
  EXPECT_EQ(mostEigenpairs(nothing), 0);
  EXPECT_EQ(mostEigenpairs(nothing, false), 0);
}

}  // namespace
}  // namespace tufted::spectrum_test
