// Every algorithm gives a defined result on odd data: a cloud of five components, a tenth of it copies and a fifth NaN;
// and a mesh of six components, two of them in the same place, with vertices that belong to nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <vector>

#include "shapes/shapes.h"
#include "support/defined_values.h"
#include "tufted/tufted.h"

namespace tufted::odd_data_test {
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
  static void SetUpTestSuite() { built = new Laplacian(pointCloudLaplacian(oddCloud())); }
  static void TearDownTestSuite() { delete built; }

  static void expectDefined(const MatrixXd& values) { support::expectDefined(*built, values, 0); }

  static const Laplacian* built;
};
const Laplacian* OddlyBuiltCloud::built = nullptr;

TEST_F(OddlyBuiltCloud, HasWhatItIsSaidToHave) {
  EXPECT_EQ(built->report.components, 5);
  EXPECT_EQ(built->report.coincident, 500);
  EXPECT_EQ(built->report.not_finite, 1000);
}

TEST_F(OddlyBuiltCloud, HasASpectrum) {
  const Spectrum found = spectrum(*built, 40);
  EXPECT_EQ(found.report.null_space, 5);
  EXPECT_LE(found.report.residual, 1e-8);
  EXPECT_LE(found.report.orthogonality, 1e-10);
  expectDefined(found.vectors);
  // The largest torus is twice the other one: its first eigenvalues are a quarter, and there are both.
  EXPECT_GT(found.values[5], 0);
  EXPECT_TRUE(found.vectors.col(0).segment(4000, 1000).cwiseAbs().maxCoeff() > 0);
}

TEST_F(OddlyBuiltCloud, HasSignaturesAndAnEmbedding) {
  const Spectrum found = spectrum(*built, 40);
  expectDefined(heatKernelSignature(found, heatTimes(found)));
  expectDefined(waveKernelSignature(found));
  expectDefined(spectralEmbedding(found));
  expectDefined(spectralEmbedding(found, Embedding::biharmonic));
}

TEST_F(OddlyBuiltCloud, IsFilteredPartByPart) {
  const Spectrum constants = spectrum(*built, 5);
  MatrixXd part(5000, 1);
  for (int i = 0; i < 5000; ++i) part(i, 0) = i / 1000;
  const MatrixXd kept = filterSignals(*built, constants, part);
  for (int i = 0; i < 5000; ++i) EXPECT_NEAR(kept(i, 0), i / 1000, 1e-12);  // NaN points keep their value
  Points points = oddCloud();
  const MatrixXd filtered = filterSignals(*built, spectrum(*built, 60), points);
  for (int i = 0; i < 5000; ++i) EXPECT_EQ(filtered.row(i).allFinite(), points.row(i).allFinite()) << i;
}

TEST_F(OddlyBuiltCloud, IsSolvedPartByPart) {
  MatrixXd f = MatrixXd::Zero(5000, 2);
  f(1000, 0) = 1;  // heat in one part alone
  f(3, 1) = NAN;   // of no consequence
  SolveReport report;
  const MatrixXd x = Solver::laplacian(*built).solve(f, &report);
  EXPECT_LE(report.residual, 1e-10);
  EXPECT_TRUE(x.col(1).isZero(0));
  EXPECT_GT(x.col(0).segment(1000, 1000).cwiseAbs().maxCoeff(), 0.1);
  EXPECT_TRUE(x.col(0).head(1000).isZero(1e-12) && x.col(0).tail(3000).isZero(1e-12));
}

TEST_F(OddlyBuiltCloud, HasMeansByComponent) {
  MatrixXd values(5000, 2);
  for (int i = 0; i < 5000; ++i) values.row(i) << (support::takesPart(*built, i) ? i / 1000 : NAN), i;
  const MatrixXd means = componentMeans(*built, values);
  expectDefined(means);
  for (int part = 0; part < 5; ++part) {
    const VectorXd areas = built->M.segment(1000 * part, 1000);
    EXPECT_NEAR(means(1000 * part, 0), part, 1e-12);
    EXPECT_NEAR(means(1000 * part, 1), areas.dot(values.col(1).segment(1000 * part, 1000)) / areas.sum(), 1e-8);
  }
}

TEST_F(OddlyBuiltCloud, IsMovedWhereItHasHandlesAndRims) {
  const Points points = oddCloud();
  const std::vector<int> handles = {0, 1500};
  for (const DeformationMethod method : {DeformationMethod::as_rigid_as_possible, DeformationMethod::linear}) {
    Points targets = built->positions(handles, Eigen::all);
    targets(0, 2) += 0.1;
    const Points moved = deform(*built, handles, targets, {.method = method});
    for (int i = 0; i < 5000; ++i) ASSERT_EQ(moved.row(i).allFinite(), points.row(i).allFinite()) << i;
    support::expectCopies(*built, moved);
  }
  const Triangles triangles = surfaceTriangles(*built);
  const Points soap = minimalSurface(*built, triangles, {.fixed = {0, 10, 20, 30}, .max_iterations = 2});
  for (int i = 0; i < 5000; ++i) ASSERT_EQ(soap.row(i).allFinite(), points.row(i).allFinite()) << i;
}

class OddMesh : public testing::Test {
 protected:
  /// Components by number.
  enum { sphere, square, book, double_rows, first_twin, second_twin, count };

  OddMesh() {
    add(shapes::icosphere(2), 0);
    add(shapes::gridSquare(8), 4);
    add(shapes::book(3, 6), 8);
    add(shapes::zeroLengthEdges(4), 12);  // vertices of one component that coincide, triangles without area
    add(shapes::icosphere(1), 16);
    add(shapes::icosphere(1), 16);
    const int corner = first_[square];
    addVertex({2, 2, 2});  // unused
    addVertex({NAN, 0, 0});
    addTriangle(corner, corner + 1, last());
    addVertex({0, INFINITY, 0});
    addVertex({4, 4, 4});  // of a triangle that names it twice
    addTriangle(last(), last(), corner);
    built = meshLaplacian(points_, triangles_);
  }

  void add(const shapes::Mesh& mesh, double x) {
    const Eigen::Index n = points_.rows(), f = triangles_.rows();
    first_.push_back(static_cast<int>(n));
    component_.resize(static_cast<std::size_t>(n + mesh.points.rows()), static_cast<int>(first_.size()) - 1);
    points_.conservativeResize(n + mesh.points.rows(), 3);
    points_.bottomRows(mesh.points.rows()) = mesh.points.rowwise() + Eigen::RowVector3d(x, 0, 0);
    triangles_.conservativeResize(f + mesh.triangles.rows(), 3);
    triangles_.bottomRows(mesh.triangles.rows()) = mesh.triangles.array() + static_cast<int>(n);
  }
  void addVertex(const Eigen::RowVector3d& position) {
    points_.conservativeResize(points_.rows() + 1, 3);
    points_.bottomRows(1) = position;
    component_.push_back(-1);
  }
  void addTriangle(int a, int b, int c) {
    triangles_.conservativeResize(triangles_.rows() + 1, 3);
    triangles_.bottomRows(1) << a, b, c;
  }
  int last() const { return static_cast<int>(points_.rows()) - 1; }
  bool isOf(int i, std::initializer_list<int> components) const {
    return std::find(components.begin(), components.end(), component_[i]) != components.end();
  }

  Points points_{0, 3};
  Triangles triangles_{0, 3};
  std::vector<int> component_, first_;  ///< by vertex, -1: none; first vertex by component
  Laplacian built;
};

TEST_F(OddMesh, HasWhatItIsSaidToHave) {
  EXPECT_EQ(built.report.components, count);
  EXPECT_EQ(built.report.not_finite, 2);
  EXPECT_EQ(built.report.isolated, 2);
  for (int i = 0; i <= last(); ++i) EXPECT_EQ(support::takesPart(built, i), component_[i] >= 0) << i;
  EXPECT_EQ(points_.row(first_[first_twin] + 5), points_.row(first_[second_twin] + 5));
}

TEST_F(OddMesh, HasASpectrumSignaturesAndEmbeddings) {
  const Spectrum found = spectrum(built, 40);
  EXPECT_EQ(found.report.null_space, count);
  EXPECT_LE(found.report.residual, 1e-8);
  EXPECT_LE(found.report.orthogonality, 1e-10);
  for (const MatrixXd& values :
       {found.vectors, heatKernelSignature(found, heatTimes(found)), waveKernelSignature(found),
        spectralEmbedding(found), spectralEmbedding(found, Embedding::biharmonic)})
    support::expectDefined(built, values, 0);
  // The twins do not see each other. Late enough for multiple eigenvalues that the spectrum may have cut in two.
  const MatrixXd heat = heatKernelSignature(found, heatTimes(found)).rightCols(8);
  for (int i = 0; i < 42; ++i)
    EXPECT_TRUE(heat.row(first_[first_twin] + i).isApprox(heat.row(first_[second_twin] + i), 1e-6)) << i;
}

TEST_F(OddMesh, IsFilteredAndSmoothedWhereItHasTriangles) {
  const MatrixXd filtered = filterSignals(built, spectrum(built, count), points_);
  const Points smoothed = smooth(built, points_);
  for (int i = 0; i <= last(); ++i) {
    if (component_[i] >= 0) {
      ASSERT_TRUE(filtered.row(i).isApprox(filtered.row(first_[component_[i]]), 1e-9)) << i;  // its component's mean
      ASSERT_TRUE(smoothed.row(i).allFinite()) << i;
    } else {
      for (int c = 0; c < 3; ++c) {
        ASSERT_TRUE(filtered(i, c) == points_(i, c) || std::isnan(points_(i, c))) << i;
        ASSERT_TRUE(smoothed(i, c) == points_(i, c) || std::isnan(points_(i, c))) << i;
      }
    }
  }
}

TEST_F(OddMesh, IsMovedWhereItHasHandlesAndRims) {
  const auto isDefined = [&](const Points& moved) {
    for (int i = 0; i <= last(); ++i) {
      if (component_[i] >= 0) {
        ASSERT_TRUE(moved.row(i).allFinite()) << i;
      }
    }
    EXPECT_EQ(moved.row(first_[sphere]), points_.row(first_[sphere]));  // closed, and without a handle
  };
  isDefined(minimalSurface(built, triangles_));
  const std::vector<int> handles = {first_[book], first_[double_rows], last()};
  Points targets = points_(handles, Eigen::all);
  targets.row(0) += Eigen::RowVector3d(0, 0, 1);
  for (const DeformationMethod method : {DeformationMethod::as_rigid_as_possible, DeformationMethod::linear})
    isDefined(deform(built, handles, targets, {.method = method}));
  EXPECT_TRUE(smooth(built, points_, {.method = SmoothingMethod::taubin}).row(first_[book]).allFinite());
}

TEST_F(OddMesh, HasDistancesWhereSourcesAre) {
  for (const DistanceOptions& options : std::initializer_list<DistanceOptions>{
           {.split = 0}, {.split = 1}, {.split = 2}, {.method = DistanceMethod::heat}}) {
    const VectorXd distance = DistanceSolver(built, options).query({first_[book], first_[first_twin], last()});
    for (int i = 0; i <= last(); ++i) {
      if (isOf(i, {book, first_twin})) {
        ASSERT_TRUE(distance[i] >= 0 && distance[i] < 4) << i;
      } else {
        ASSERT_EQ(distance[i], INFINITY) << i;
      }
    }
  }
}

TEST_F(OddMesh, IsInterpolatedWherePinsAre) {
  const Pins pins{{first_[sphere], first_[square], first_[square] + 40, first_[double_rows], last()},
                  VectorXd{{1, 2, 3, 4, 5}}};
  for (const MatrixXd& u :
       {harmonic(built, pins), biharmonic(built, pins), poisson(built, MatrixXd::Zero(last() + 1, 1), pins)}) {
    for (int i = 0; i <= last(); ++i) {
      ASSERT_EQ(std::isfinite(u(i, 0)), isOf(i, {sphere, square, double_rows}) || i == last()) << i;
      if (isOf(i, {sphere, double_rows})) {
        ASSERT_NEAR(u(i, 0), u(first_[component_[i]], 0), 1e-12) << i;
      }
    }
    EXPECT_EQ(u(last(), 0), 5);  // belongs to nothing, and keeps its pin
  }
}

TEST_F(OddMesh, HasGreensFunctionsAndPoissonSolutionsByComponent) {
  const MatrixXd g = greensFunction(built, {first_[second_twin] + 3});
  const MatrixXd u = poisson(built, MatrixXd::Constant(last() + 1, 1, 7));
  support::expectDefined(built, g, NAN);
  support::expectDefined(built, u, NAN);
  for (int i = 0; i <= last(); ++i) {
    if (component_[i] < 0) continue;
    ASSERT_EQ(g(i, 0) != 0, component_[i] == second_twin) << i;
    ASSERT_NEAR(u(i, 0), 0, 1e-12) << i;  // a constant has no part that could be solved for
  }
  EXPECT_THROW(greensFunction(built, {last()}), InvalidInput);
}

TEST_F(OddMesh, HasGradients) {
  const Gradients operators = gradients(built, points_, meshFrames(points_, triangles_));
  ASSERT_TRUE(operators.X.coeffs().allFinite() && operators.Y.coeffs().allFinite());
  ASSERT_TRUE(operators.frames.normals.allFinite() && operators.frames.tangents.allFinite());
  VectorXd components(last() + 1);
  for (int i = 0; i <= last(); ++i) components[i] = component_[i];
  EXPECT_TRUE((operators.X * components).isZero(1e-9));  // constant on each
  EXPECT_TRUE((operators.Y * components).isZero(1e-9));
  for (const int i : {last(), last() - 1, last() - 2, last() - 3}) EXPECT_TRUE(operators.X.row(i).norm() == 0) << i;
}

}  // namespace
}  // namespace tufted::odd_data_test
