// Geodesic distance, by the heat method for most of this: against analytic shapes and CGAL's exact paths, far away, and
// on odd input.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "oracles/geodesics.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "support/compare.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::distance_test {
namespace {

using support::meanError;

VectorXd straight(const Points& points, const Eigen::RowVector3d& from) {
  return (points.rowwise() - from).rowwise().norm();
}

/// A strip of squares of side 1 in the plane, each of two triangles; vertices 2 i and 2 i + 1 lie at x = i.
shapes::Mesh strip(int squares) {
  shapes::Mesh mesh;
  mesh.points.resize(2 * (squares + 1), 3);
  mesh.triangles.resize(2 * squares, 3);
  for (int i = 0; i <= squares; ++i) {
    mesh.points.row(2 * i) << i, 0, 0;
    mesh.points.row(2 * i + 1) << i, 1, 0;
  }
  for (int i = 0; i < squares; ++i) {
    mesh.triangles.row(2 * i) << 2 * i, 2 * i + 2, 2 * i + 1;
    mesh.triangles.row(2 * i + 1) << 2 * i + 2, 2 * i + 3, 2 * i + 1;
  }
  return mesh;
}

/// Two unit squares of 30 x 30, the second 10 further along x; 31^2 vertices each.
shapes::Mesh twoSquares() {
  const shapes::Mesh one = shapes::gridSquare(30);
  const auto n = one.points.rows(), m = one.triangles.rows();
  shapes::Mesh both = one;
  both.points.resize(2 * n, 3);
  both.points << one.points, one.points.rowwise() + Eigen::RowVector3d(10, 0, 0);
  both.triangles.resize(2 * m, 3);
  both.triangles << one.triangles, one.triangles.array() + static_cast<int>(n);
  return both;
}

TEST(Distance, IsFiniteAndMonotoneAtAHundredThousandEdges) {
  const int squares = 100000;
  const shapes::Mesh mesh = strip(squares);
  const DistanceSolver solver(meshLaplacian(mesh.points, mesh.triangles), {.method = DistanceMethod::heat});
  DistanceReport report;
  const VectorXd distance = solver.query({0, 1}, &report);
  EXPECT_GT(report.rounds, 10);
  ASSERT_TRUE(distance.allFinite());
  for (int i = 0; i < squares; ++i) {
    for (const int side : {0, 1}) ASSERT_LT(distance[2 * i + side], distance[2 * i + 2 + side]) << "after x = " << i;
  }
  // A straight wave stays straight through all rounds.
  for (int i = 0; i <= squares; ++i) ASSERT_NEAR(distance[2 * i], i, 0.1);
}

TEST(Distance, FramesSayNothingOfItsScale) {
  const shapes::Mesh ball = shapes::icosphere(3);
  Laplacian mesh = meshLaplacian(ball.points, ball.triangles);
  const VectorXd on_mesh = DistanceSolver(mesh, {.method = DistanceMethod::heat}).query({0});
  mesh.frames = meshFrames(ball.points, ball.triangles);
  EXPECT_TRUE(support::sameBits(DistanceSolver(mesh, {.method = DistanceMethod::heat}).query({0}), on_mesh));
  EXPECT_LE(meanError(on_mesh, shapes::sphereDistances(ball.points, 0)), 0.02);

  const Points points = shapes::sphere(2000).points;
  for (const Gluing gluing : {Gluing::star, Gluing::vertex_pair}) {
    Laplacian cloud = pointCloudLaplacian(points, {.paper = {.gluing = gluing}});
    const VectorXd on_cloud = DistanceSolver(cloud, {.method = DistanceMethod::heat}).query({0});
    cloud.frames = {};
    EXPECT_TRUE(support::sameBits(DistanceSolver(cloud, {.method = DistanceMethod::heat}).query({0}), on_cloud));
    EXPECT_LE(meanError(on_cloud, shapes::sphereDistances(points, 0)), 0.04);
  }
}

TEST(Distance, FromSeveralSourcesIsThatFromTheNearest) {
  const Points points = shapes::sphere(8000).points;
  const DistanceSolver solver(pointCloudLaplacian(points));
  const std::vector<int> sources = {0, 100, 2000, 7999};
  VectorXd exact = shapes::sphereDistances(points, sources[0]);
  for (const int source : sources) exact = exact.cwiseMin(shapes::sphereDistances(points, source));
  const VectorXd distance = solver.query(sources);
  EXPECT_LE(meanError(distance, exact), 0.02);
  for (const int source : sources) EXPECT_EQ(distance[source], 0);
  EXPECT_GE(distance.minCoeff(), 0);
}

TEST(Distance, FromARegionIsThatFromItsBoundary) {
  const Points points = shapes::sphere(16000).points;
  std::vector<int> cap;
  for (int i = 0; i < points.rows(); ++i) {
    if (points(i, 2) > std::cos(1.0)) cap.push_back(i);
  }
  const VectorXd distance = DistanceSolver(pointCloudLaplacian(points)).query(cap);
  VectorXd exact(points.rows());
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    exact[i] = std::max(0.0, std::acos(std::clamp(points(i, 2), -1.0, 1.0)) - 1);
  }
  for (const int i : cap) EXPECT_EQ(distance[i], 0);
  EXPECT_LE(meanError(distance, exact), 0.02);
}

TEST(Distance, IsInfiniteAcrossComponents) {
  const shapes::Mesh mesh = twoSquares();
  const int n = 31 * 31;
  const DistanceSolver solver(meshLaplacian(mesh.points, mesh.triangles));
  const VectorXd one = solver.query({0});
  EXPECT_TRUE(one.head(n).allFinite());
  EXPECT_TRUE((one.tail(n).array() == INFINITY).all());
  // With a source in each, neither knows of the other.
  const VectorXd both = solver.query({0, n + 480});
  EXPECT_LE((both.head(n) - one.head(n)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LE((both.tail(n) - solver.query({480}).head(n)).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(Distance, OfCopiesIsThatOfTheirPointAndASourceCountsOnce) {
  Points points(1010, 3);
  points.topRows(1000) = shapes::torus(1000).points;
  for (int i = 0; i < 10; ++i) points.row(1000 + i) = points.row(7 * i);
  const DistanceSolver solver(pointCloudLaplacian(points));
  const VectorXd distance = solver.query({7});
  for (int i = 0; i < 10; ++i) EXPECT_EQ(distance[1000 + i], distance[7 * i]);
  EXPECT_EQ(distance[1001], 0);
  EXPECT_EQ(solver.query({1001}), distance);
  EXPECT_EQ(solver.query({7, 7, 1001}), distance);
}

TEST(Distance, FromInsideAFaceMeetsExactPaths) {
  const shapes::Mesh mesh = shapes::icosphere(4);
  const std::array<double, 3> inside = {0.6, 0.3, 0.1};
  const SurfacePoint source = SurfacePoint::inFace(mesh.points, mesh.triangles, 700, inside);
  const DistanceSolver solver(meshLaplacian(mesh.points, mesh.triangles));
  const VectorXd distance = solver.queryAt({source}),
                 exact = *oracles::exactDistances(mesh.points, mesh.triangles, 700, inside);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(distance[source.corners[k]], exact[source.corners[k]], 1e-12);
  }
  EXPECT_LE(meanError(distance, exact), 0.02);
  // At a corner it is that corner.
  const SurfacePoint corner = SurfacePoint::inFace(mesh.points, mesh.triangles, 700, {0, 2, 0});
  EXPECT_LE(meanError(solver.queryAt({corner}), solver.query({mesh.triangles(700, 1)})), 0.02);
}

TEST(Distance, HardlyNoticesWhereTheSurfaceEnds) {
  const shapes::Cloud square = shapes::square(8000, shapes::Sampling::jittered, shapes::Rim::included);
  const Laplacian laplacian = pointCloudLaplacian(square.points);
  int source = 0;
  straight(square.points, Eigen::RowVector3d(0.3, 0.1, 0)).minCoeff(&source);
  const VectorXd exact = straight(square.points, square.points.row(source));
  const double open =
      meanError(DistanceSolver(laplacian, {.method = DistanceMethod::heat, .time_step = 4}).query({source}), exact);
  const double closed =
      meanError(DistanceSolver(laplacian, {.method = DistanceMethod::heat, .time_step = 4, .open_boundary = false})
                    .query({source}),
                exact);
  EXPECT_LE(open, 0.015);
  EXPECT_LE(open, 0.5 * closed);
}

TEST(Distance, AdaptsItsStepToTheGapsOfUnevenSamples) {
  const shapes::Cloud step = shapes::sphere(8000, shapes::Sampling::densityStep(100));
  const Laplacian laplacian = pointCloudLaplacian(step.points);
  const VectorXd exact = shapes::sphereDistances(step.points, 0);
  const DistanceSolver plain(laplacian, {.method = DistanceMethod::heat}),
      adapted(laplacian, {.method = DistanceMethod::heat, .unit = TimeUnit::adapted_edge});
  EXPECT_GT(adapted.timeStep(), 2 * plain.timeStep());
  EXPECT_LT(meanError(adapted.query({0}), exact), meanError(plain.query({0}), exact));
}

TEST(Distance, ScalesAndMovesWithTheCloud) {
  const Points points = shapes::ellipsoid(4000).points;
  for (const DistanceMethod method : {DistanceMethod::marching, DistanceMethod::heat}) {
    const auto distanceOf = [&](const Points& cloud) {
      return DistanceSolver(pointCloudLaplacian(cloud), {.method = method}).query({5});
    };
    const VectorXd reference = distanceOf(points);
    EXPECT_EQ(distanceOf(0x1p60 * points), 0x1p60 * reference);
    const double tiny = std::ldexp(1.0, -560);  // all areas underflow
    EXPECT_LE((distanceOf(tiny * points) / tiny - reference).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_EQ(distanceOf(points.rowwise() + Eigen::RowVector3d(500000, 4000000, 100)), reference);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    EXPECT_LE((distanceOf(points * turn.transpose()) - reference).cwiseAbs().maxCoeff(), 1e-10);
  }
}

/// A strip of `squares` in three rows, its vertices moved at random: 4 (squares + 1) of them.
shapes::Mesh roughStrip(int squares) {
  shapes::Mesh mesh;
  mesh.points.resize(4 * (squares + 1), 3);
  mesh.triangles.resize(6 * squares, 3);
  shapes::Random random(1);
  for (int i = 0; i <= squares; ++i) {
    for (int j = 0; j < 4; ++j)
      mesh.points.row(4 * i + j) << i + 0.5 * random.uniform(), j + 0.5 * random.uniform(), 0.3 * random.uniform();
  }
  for (int i = 0; i < squares; ++i) {
    for (int j = 0; j < 3; ++j) {
      const int a = 4 * i + j;
      mesh.triangles.row(6 * i + 2 * j) << a, a + 4, a + 1;
      mesh.triangles.row(6 * i + 2 * j + 1) << a + 4, a + 5, a + 1;
    }
  }
  return mesh;
}

TEST(Distance, InWindowsOfHeatIsThatOfTheWhole) {
  // Round the sphere, with a boundary, from two sources, on sheets apart from each other, over steps of density.
  const Points uneven = shapes::sphere(8000, shapes::Sampling::densityStep(16)).points;
  struct {
    const char* name;
    Laplacian laplacian;
    std::vector<int> sources;
  } cases[] = {{"sphere", pointCloudLaplacian(shapes::sphere(8000).points), {0}},
               {"square", pointCloudLaplacian(shapes::square(20000).points), {7, 300}},
               {"sheets", meshLaplacian(twoSquares().points, twoSquares().triangles), {0, 1500}},
               {"uneven", pointCloudLaplacian(uneven), {0}},
               {"strip", meshLaplacian(roughStrip(3000).points, roughStrip(3000).triangles), {0}}};
  for (auto& [name, laplacian, sources] : cases) {
    SCOPED_TRACE(name);
    const VectorXd distance = DistanceSolver(laplacian, {.method = DistanceMethod::heat}).query(sources);
    DistanceReport report;
    const VectorXd in_windows =
        DistanceSolver(laplacian, {.method = DistanceMethod::heat, .solver = {.method = SolverMethod::multigrid}})
            .query(sources, &report);
    // The strip takes several rounds in either way, and every start of the whole shifts the wave by a hundredth edge.
    const double tolerance = name == std::string("strip") ? 0.1 : 1e-6 * distance.maxCoeff();
    EXPECT_LE((in_windows - distance).cwiseAbs().maxCoeff(), tolerance) << report.rounds << " rounds";
    EXPECT_LE(report.rounds, 30);
    EXPECT_LE(report.residual, 1e-10);
  }
}

TEST(Distance, NamesWhatACallerGotWrong) {
  Points points = shapes::sphere(500).points;
  points.row(3).setConstant(NAN);
  const Laplacian laplacian = pointCloudLaplacian(points);
  using support::refusal;
  for (const double step : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_EQ(refusal([&] { DistanceSolver(laplacian, {.time_step = step}); }).find("DistanceSolver: time_step = "), 0)
        << step;
  }
  const DistanceSolver solver(laplacian);
  EXPECT_EQ(refusal([&] { solver.query({}); }), "DistanceSolver::query: sources is empty, must name at least one");
  EXPECT_EQ(refusal([&] { solver.query({500}); }), "DistanceSolver::query: source 500, must lie in [0, 500)");
  EXPECT_EQ(refusal([&] { solver.query({-1}); }), "DistanceSolver::query: source -1, must lie in [0, 500)");
  EXPECT_EQ(refusal([&] { solver.query({3}); }),
            "DistanceSolver::query: no source lies on a component, must be at least one active point: source 3 is not "
            "finite");
  EXPECT_EQ(solver.query({3, 4}), solver.query({4}));
  SurfacePoint odd = SurfacePoint::vertex(0);
  odd.weights[0] = -1;
  EXPECT_NE(refusal([&] { solver.queryAt({odd}); }), "accepted");
  odd = SurfacePoint::vertex(0);
  odd.distances[0] = NAN;
  EXPECT_NE(refusal([&] { solver.queryAt({odd}); }), "accepted");
  const Triangles triangles{{0, 1, 3}, {0, 1, 2}};
  EXPECT_NE(refusal([&] { SurfacePoint::inFace(points, triangles, 2, {1, 0, 0}); }), "accepted");
  EXPECT_NE(refusal([&] { SurfacePoint::inFace(points, triangles, 0, {1, 0, 0}); }), "accepted");
  EXPECT_NE(refusal([&] { SurfacePoint::inFace(points, triangles, 1, {1, -0.1, 0}); }), "accepted");
  EXPECT_NE(refusal([&] { SurfacePoint::inFace(points, triangles, 1, {0, 0, 0}); }), "accepted");
  EXPECT_NE(refusal([&] { DistanceSolver(pointCloudLaplacian(points, {.keep_cover = false})); }), "accepted");
}

}  // namespace
}  // namespace tufted::distance_test
