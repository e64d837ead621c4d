// Distances by fast marching: exact where unfolding is, near CGAL's exact paths elsewhere, and the same however the
// input is given.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/cover_source.h"
#include "oracles/geodesics.h"
#include "oracles/planar.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "support/compare.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::marching_test {
namespace {

using support::meanError;

/// Rows of equilateral triangles of side 1 in the plane.
shapes::Mesh equilateral(int n) {
  shapes::Mesh mesh;
  mesh.points.resize((n + 1) * (n + 1), 3);
  mesh.triangles.resize(2 * n * n, 3);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) mesh.points.row(i * (n + 1) + j) << j + i / 2.0, i * std::sqrt(0.75), 0;
  for (int i = 0, f = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const int a = i * (n + 1) + j;
      mesh.triangles.row(f++) << a, a + 1, a + n + 1;
      mesh.triangles.row(f++) << a + 1, a + n + 2, a + n + 1;
    }
  }
  return mesh;
}

/// Greatest excess of |d_a - d_b| over the length of any edge of the cover, in parts of the greatest distance.
double steepest(const Laplacian& laplacian, const VectorXd& distance) {
  const IntrinsicTriangulation& cover = laplacian.cover();
  double excess = 0, farthest = 0;
  for (int side = 0; side < 3 * cover.size(); ++side) {
    const double a = distance[cover.faces[side / 3][side % 3]], b = distance[cover.faces[side / 3][(side + 1) % 3]];
    if (!std::isfinite(a) || !std::isfinite(b)) continue;
    excess = std::max(excess, std::abs(a - b) - cover.length[side]);
    farthest = std::max({farthest, a, b});
  }
  return farthest > 0 ? excess / farthest : 0;
}

TEST(Marching, IsExactInThePlane) {
  const shapes::Mesh mesh = equilateral(20);
  const int source = 5 * 21 + 8;
  // Mollification would make all edges longer.
  const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles, {.mollify = 0});
  const VectorXd exact = (mesh.points.rowwise() - mesh.points.row(source)).rowwise().norm();
  for (const int split : {0, 1, 2}) {
    const VectorXd distance = DistanceSolver(laplacian, {.split = split}).query({source});
    EXPECT_LE((distance - exact).cwiseAbs().maxCoeff(), 1e-12) << split;
  }
}

TEST(Marching, FromInsideAFaceIsExactInThePlane) {
  const shapes::Mesh mesh = equilateral(12);
  const SurfacePoint source = SurfacePoint::inFace(mesh.points, mesh.triangles, 100, {0.5, 0.3, 0.2});
  Eigen::RowVector3d place = Eigen::RowVector3d::Zero();
  for (int k = 0; k < 3; ++k) place += source.weights[k] * mesh.points.row(source.corners[k]);
  const VectorXd exact = (mesh.points.rowwise() - place).rowwise().norm();
  const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles, {.mollify = 0});
  for (const int split : {1, 2}) {
    const VectorXd distance = DistanceSolver(laplacian, {.split = split}).queryAt({source});
    EXPECT_LE((distance - exact).cwiseAbs().maxCoeff(), 1e-12) << split;
  }
}

TEST(Marching, FromACornerOfAFaceIsFromThatPoint) {
  // Flips at an obtuse rim leave faces of the cover that have the same corner twice.
  const oracles::PlanarMesh mesh = oracles::obtuseSquare(60, 8, 101);
  const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
  for (const int split : {1, 2}) {
    const DistanceSolver solver(laplacian, {.split = split});
    for (int face = 0; face < mesh.triangles.rows(); ++face) {
      for (int k = 0; k < 3; ++k) {
        std::array<double, 3> corner = {0, 0, 0};
        corner[k] = 1;
        const VectorXd from_face = solver.queryAt({SurfacePoint::inFace(mesh.points, mesh.triangles, face, corner)});
        const VectorXd from_point = solver.query({mesh.triangles(face, k)});
        const VectorXd exact = (mesh.points.rowwise() - mesh.points.row(mesh.triangles(face, k))).rowwise().norm();
        // Long triangles cost each a few hundredths of the side.
        ASSERT_LE((from_face - exact).cwiseAbs().maxCoeff(), 0.07) << split << " " << face << " " << k;
        ASSERT_LE((from_point - exact).cwiseAbs().maxCoeff(), 0.07) << split << " " << face << " " << k;
      }
    }
  }
}

TEST(Marching, CutsTheTrianglesOfSmallSurfacesTwice) {
  for (const int n : {5000, 5001}) {
    const Laplacian laplacian = pointCloudLaplacian(shapes::sphere(n).points);
    const int split = n == 5000 ? 2 : 1;
    DistanceReport report;
    const VectorXd distance = DistanceSolver(laplacian).query({0}, &report);
    EXPECT_EQ(report.split, split);
    EXPECT_EQ(distance, DistanceSolver(laplacian, {.split = split}).query({0}));
    const NearbyPoints near = pointsWithin(laplacian, {0}, 0.5), asked = pointsWithin(laplacian, {0}, 0.5, split);
    EXPECT_EQ(near.distances, asked.distances);
  }
}

TEST(Marching, MeetsExactPathsTwiceAsWellAsHeat) {
  const shapes::Mesh cube = shapes::cubeMesh(8, shapes::Quality::good), ball = shapes::icosphere(4);
  for (const shapes::Mesh& mesh : {cube, ball}) {
    const VectorXd exact = *oracles::exactDistances(mesh.points, mesh.triangles, 7, {1, 0, 0});
    const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
    const int source = mesh.triangles(7, 0);
    const VectorXd distance = DistanceSolver(laplacian).query({source}),
                   heat = DistanceSolver(laplacian, {.method = DistanceMethod::heat}).query({source});
    EXPECT_LE(2 * meanError(distance, exact), meanError(heat, exact)) << mesh.shape;
    EXPECT_LE((distance - exact).cwiseAbs().maxCoeff(), 0.02 * exact.maxCoeff()) << mesh.shape;
  }
}

TEST(Marching, UnfoldsPagesOfSlivers) {
  for (const double stretch : {1.0, 16.0}) {
    const oracles::Book book = oracles::badBook(3, 40, stretch, 101);
    const Laplacian laplacian = meshLaplacian(book.points, book.triangles);
    const VectorXd distance = DistanceSolver(laplacian).query({541});
    EXPECT_LE(meanError(distance, oracles::bookDistances(book, 541)), 0.002) << stretch;
  }
}

TEST(Marching, ConvergesOnClouds) {
  double before = 0.006;
  for (const int n : {2000, 8000, 32000}) {
    const Points points = shapes::sphere(n, shapes::Sampling::uniform, 101).points;
    const double error =
        meanError(DistanceSolver(pointCloudLaplacian(points)).query({0}), shapes::sphereDistances(points, 0));
    EXPECT_LE(error, before) << n;
    before = 0.6 * error;
  }
}

TEST(Marching, IsFiniteWhereHeatIsAndNeverTooSteep) {
  for (const shapes::Mesh& mesh : shapes::allMeshes()) {
    const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
    const auto active = std::find(laplacian.status.begin(), laplacian.status.end(), PointStatus::active);
    if (active == laplacian.status.end()) continue;
    const int source = static_cast<int>(active - laplacian.status.begin());
    const VectorXd heat = DistanceSolver(laplacian, {.method = DistanceMethod::heat}).query({source});
    for (const int split : {0, 1, 2}) {
      const VectorXd distance = DistanceSolver(laplacian, {.split = split}).query({source});
      for (Eigen::Index i = 0; i < heat.size(); ++i)
        ASSERT_EQ(std::isfinite(distance[i]), std::isfinite(heat[i])) << mesh.name << ", point " << i;
      EXPECT_EQ(distance[source], 0) << mesh.name;
      EXPECT_LE(steepest(laplacian, distance), 1e-14) << mesh.name;
    }
  }
}

TEST(Marching, IsSymmetricToItsError) {
  const Points noisy = shapes::withNoise(shapes::torus(6000), 0.01).points;
  const shapes::Mesh strip = shapes::moebius(12), bottle = shapes::kleinBottle(24);
  const Laplacian laplacians[] = {pointCloudLaplacian(noisy), meshLaplacian(strip.points, strip.triangles),
                                  meshLaplacian(bottle.points, bottle.triangles)};
  for (const Laplacian& laplacian : laplacians) {
    const DistanceSolver solver(laplacian);
    const int n = static_cast<int>(laplacian.L.rows());
    for (const int a : {n / 3, n / 7}) {
      const VectorXd from_a = solver.query({a});
      for (const int b : {n / 2, n / 5, n - 1}) {
        if (!std::isfinite(from_a[b])) continue;
        EXPECT_NEAR(solver.query({b})[a], from_a[b], 0.02 * from_a[b]);
      }
    }
  }
}

TEST(Marching, HasTheSameBitsInAnyOrderOfPoints) {
  const shapes::Mesh grid = shapes::gridSquare(20), ball = shapes::icosphere(3);  // full of ties
  for (const shapes::Mesh& mesh : {grid, ball}) {
    const auto n = static_cast<int>(mesh.points.rows());
    std::vector<int> place(static_cast<std::size_t>(n));
    std::iota(place.begin(), place.end(), 0);
    shapes::Random random(101);
    for (int i = n - 1; i > 0; --i) std::swap(place[i], place[static_cast<int>(random.uniform() * (i + 1))]);
    Points points(n, 3);
    for (int i = 0; i < n; ++i) points.row(place[i]) = mesh.points.row(i);
    Triangles triangles = mesh.triangles;
    for (int& corner : triangles.reshaped()) corner = place[corner];
    const VectorXd before = DistanceSolver(meshLaplacian(mesh.points, mesh.triangles)).query({17, 60}),
                   after = DistanceSolver(meshLaplacian(points, triangles)).query({place[17], place[60]});
    for (int i = 0; i < n; ++i) ASSERT_EQ(after[place[i]], before[i]) << mesh.shape << ", point " << i;
  }
}

TEST(Marching, NamesTheNearestSource) {
  const Points points = shapes::sphere(8000).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const std::vector<int> sources = {5, 900, 5, 7000};
  std::vector<SurfacePoint> places;
  Eigen::MatrixXd exact(points.rows(), 4);
  for (std::size_t s = 0; s < sources.size(); ++s) {
    places.push_back(SurfacePoint::vertex(sources[s]));
    exact.col(static_cast<Eigen::Index>(s)) = shapes::sphereDistances(points, sources[s]);
  }
  for (const DistanceMethod method : {DistanceMethod::marching, DistanceMethod::heat}) {
    const DistanceSolver solver(laplacian, {.method = method});
    const NearestSources found = solver.nearest(places);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      ASSERT_NE(found.source[i], 2) << "the place of source 0";
      ASSERT_LE(exact(i, found.source[i]), exact.row(i).minCoeff() + 0.06) << i;
    }
    EXPECT_LE(meanError(found.distance, exact.rowwise().minCoeff()), method == DistanceMethod::heat ? 0.05 : 0.005);
    EXPECT_EQ(found.distance == solver.query(sources), method == DistanceMethod::marching);
  }
}

TEST(Marching, WithinAMaximumIsThePartOfTheWhole) {
  const shapes::Cloud cloud = shapes::withNoise(shapes::torus(8000), 0.01);
  const Laplacian laplacian = pointCloudLaplacian(cloud.points);
  for (const DistanceMethod method : {DistanceMethod::marching, DistanceMethod::heat}) {
    DistanceReport of_whole, of_part;
    const VectorXd whole = DistanceSolver(laplacian, {.method = method}).query({4}, &of_whole),
                   part = DistanceSolver(laplacian, {.method = method, .maximum = 0.5}).query({4}, &of_part);
    for (Eigen::Index i = 0; i < whole.size(); ++i) ASSERT_EQ(part[i], whole[i] <= 0.5 ? whole[i] : HUGE_VAL) << i;
    EXPECT_LE(of_part.visits, of_whole.visits / 4);
  }
}

TEST(DistanceReport, AddsAnotherQuery) {
  DistanceReport sum{.split = 1, .visits = 3, .rounds = 2, .residual = 1e-14, .seconds = 1};
  sum.add({.split = 2,
           .visits = 4,
           .rounds = 1,
           .iterations = 9,
           .residual = 1e-15,
           .backward_error = 1e-16,
           .seconds = 2});
  EXPECT_EQ(sum.split, 2);
  EXPECT_EQ(sum.visits, 7);
  EXPECT_EQ(sum.rounds, 3);
  EXPECT_EQ(sum.iterations, 9);
  EXPECT_EQ(sum.residual, 1e-14);
  EXPECT_EQ(sum.backward_error, 1e-16);
  EXPECT_EQ(sum.seconds, 3);
  sum.add({.residual = std::nan("")});
  EXPECT_TRUE(std::isnan(sum.residual));
}

TEST(Marching, SurvivesScalesNeedlesAndCopies) {
  const shapes::Mesh needles = shapes::slivers(12), copies = shapes::zeroLengthEdges(12);
  for (const shapes::Mesh& mesh : {needles, copies}) {
    const VectorXd reference = DistanceSolver(meshLaplacian(mesh.points, mesh.triangles)).query({3});
    const VectorXd exact = (mesh.points.rowwise() - mesh.points.row(3)).rowwise().norm();
    EXPECT_LE(meanError(reference, exact), 0.01) << mesh.shape;
    for (const int exponent : {400, -400}) {
      const double scale = std::ldexp(1.0, exponent);
      const VectorXd scaled = DistanceSolver(meshLaplacian(scale * mesh.points, mesh.triangles)).query({3});
      EXPECT_EQ(scaled, scale * reference) << exponent;
    }
  }
}

TEST(Marching, TurnsWithTheMesh) {
  const shapes::Mesh mesh = shapes::cubeMesh(6, shapes::Quality::good);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const VectorXd before = DistanceSolver(meshLaplacian(mesh.points, mesh.triangles)).query({40}),
                 after = DistanceSolver(meshLaplacian(mesh.points * turn.transpose(), mesh.triangles)).query({40});
  EXPECT_LE((after - before).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Marching, TakesTheFacesOfACloudFromItsStarsWithTheBitsOfTheCover) {
  struct StarsOnly : CoverSource {
    explicit StarsOnly(std::shared_ptr<const CoverSource> source) : source_(std::move(source)) {}
    const IntrinsicTriangulation& cover() const override { throw std::logic_error("the cover is asked for"); }
    int vertices() const override { return source_->vertices(); }
    std::int64_t parts() const override { return source_->parts(); }
    void visitFaces(std::int64_t begin, std::int64_t end, const FaceVisit& visit) const override {
      source_->visitFaces(begin, end, visit);
    }
    std::shared_ptr<const CoverSource> source_;
  };
  // More stars than one block has; the noise makes edges flip.
  const shapes::Cloud cloud = shapes::withNoise(shapes::sphere(9000, shapes::Sampling::uniform, 101), 0.02, 101);
  Laplacian laplacian = pointCloudLaplacian(cloud.points, cloudOptions(Preset::clean)), of_stars = laplacian;
  ASSERT_GT(laplacian.report.flips, 100);
  of_stars.cover_source = std::make_shared<StarsOnly>(laplacian.cover_source);
  laplacian.setCover(IntrinsicTriangulation(laplacian.cover()));
  for (const DistanceMethod method : {DistanceMethod::marching, DistanceMethod::heat}) {
    const DistanceOptions options = {.method = method};
    EXPECT_EQ(DistanceSolver(of_stars, options).query({3, 4000}), DistanceSolver(laplacian, options).query({3, 4000}));
  }
  EXPECT_EQ(segments(of_stars).labels, segments(laplacian).labels);
}

TEST(Marching, NamesWhatACallerGotWrongAndStopsWhenTold) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::sphere(500).points);
  using support::refusal;
  EXPECT_EQ(refusal([&] { DistanceSolver(laplacian, {.split = 3}); }), "DistanceSolver: split = 3, must lie in [0, 2]");
  EXPECT_EQ(refusal([&] { DistanceSolver(laplacian, {.maximum = 0}); }),
            "DistanceSolver: maximum = 0, must be above 0");
  EXPECT_EQ(refusal([&] { DistanceSolver(laplacian).nearest({}); }),
            "DistanceSolver::query: sources is empty, must name at least one");
  EXPECT_THROW(DistanceSolver(laplacian).query({0}, nullptr, [](std::string_view, double) { return false; }),
               Cancelled);
}

}  // namespace
}  // namespace tufted::marching_test
