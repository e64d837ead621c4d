// Surfaces that follow their handles: rigid motions, bending, equivariance, odd data, and what callers get wrong.
#include "tufted/deformation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "shapes/shapes.h"
#include "support/defined_values.h"
#include "support/odd_cloud.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::deformation_test {
namespace {

using support::refusal;

const DeformationOptions rigid{}, linear{.method = DeformationMethod::linear};

/// A tube along x from 0 to 4, of radius 0.3; the handles are its two ends.
struct Tube {
  shapes::Mesh mesh;
  std::vector<int> handles;
};
Tube tube(int around = 20, int along = 60) {
  Tube made;
  made.mesh.points.resize(Eigen::Index{around} * (along + 1), 3);
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * M_PI * i / around;
      made.mesh.points.row(Eigen::Index{j} * around + i) << 4.0 * j / along, 0.3 * std::cos(angle),
          0.3 * std::sin(angle);
    }
  made.mesh.triangles.resize(Eigen::Index{2} * around * along, 3);
  for (int j = 0, t = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      const int a = j * around + i, b = j * around + (i + 1) % around;
      made.mesh.triangles.row(t++) << a, b, b + around;
      made.mesh.triangles.row(t++) << a, b + around, a + around;
    }
  for (int i = 0; i < 3 * around; ++i) made.handles.push_back(i);
  for (int i = 0; i < 3 * around; ++i) made.handles.push_back((along - 2) * around + i);
  return made;
}

/// Where the ends of a tube go if its far end turns by an angle about an axis through (2, 0, 0).
Points turnedEnd(const Tube& tube, double angle, const Eigen::Vector3d& axis) {
  Points targets = tube.mesh.points(tube.handles, Eigen::all);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  const Eigen::RowVector3d centre(2, 0, 0);
  for (Eigen::Index k = targets.rows() / 2; k < targets.rows(); ++k)
    targets.row(k) = (turn * (targets.row(k) - centre).transpose()).transpose() + centre;
  return targets;
}

std::shared_ptr<const Laplacian> laplacianOf(const shapes::Mesh& mesh) {
  return std::make_shared<const Laplacian>(meshLaplacian(mesh.points, mesh.triangles));
}

TEST(Deformation, ByARigidMotionIsThatMotion) {
  const shapes::Cloud cloud = shapes::torus(2000);
  const Laplacian laplacian = pointCloudLaplacian(cloud.points);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Points moved = (cloud.points * turn.transpose()).rowwise() + Eigen::RowVector3d(3, -1, 2);
  std::vector<int> handles;
  for (int i = 0; i < 2000; i += 20) handles.push_back(i);
  DeformationReport report;
  const Points x = deform(laplacian, handles, moved(handles, Eigen::all), {.tolerance = 1e-6}, &report);
  EXPECT_TRUE(report.converged);
  EXPECT_LE((x - moved).rowwise().norm().maxCoeff(), 1e-4);
  EXPECT_LE(report.stretch, 1e-4);
  EXPECT_EQ(report.handles, 100);
  EXPECT_EQ(report.moved, 1900);
}

TEST(Deformation, ByHalfATurnIsThatTurn) {
  // From a start without rotations there is no telling which way round.
  const shapes::Mesh cube = shapes::cubeMesh(8, shapes::Quality::good);
  std::vector<int> handles;
  for (int i = 0; i < cube.points.rows(); ++i)
    if (cube.points(i, 2) == 0 || cube.points(i, 2) == 1) handles.push_back(i);
  const Points moved = cube.points * Eigen::Vector3d(-1, -1, 1).asDiagonal();
  const Points x = deform(*laplacianOf(cube), handles, moved(handles, Eigen::all), {.tolerance = 1e-6});
  EXPECT_LE((x - moved).rowwise().norm().maxCoeff(), 1e-5);
}

TEST(Deformation, WithoutAMoveIsExactlyNone) {
  const Tube made = tube();
  const auto laplacian = laplacianOf(made.mesh);
  for (const DeformationOptions& options : {rigid, linear}) {
    DeformationReport report;
    const Points x = deform(*laplacian, made.handles, made.mesh.points(made.handles, Eigen::all), options, &report);
    EXPECT_EQ(x, made.mesh.points);
    EXPECT_EQ(report.iterations, 0);
  }
}

TEST(Deformation, PutsHandlesWhereTheyShallLie) {
  const Tube made = tube();
  const Points targets = turnedEnd(made, 1, {0, 1, 0});
  for (const DeformationOptions& options : {rigid, linear})
    EXPECT_EQ(deform(*laplacianOf(made.mesh), made.handles, targets, options)(made.handles, Eigen::all), targets);
}

TEST(Deformation, OfABentTubeKeepsItsLengthAndItsWidth) {
  const Tube made = tube();
  DeformationReport report;
  const Points x = deform(*laplacianOf(made.mesh), made.handles, turnedEnd(made, M_PI / 2, {0, 1, 0}), rigid, &report);
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.stretch, 0.15);
  for (int j = 10; j < 50; ++j) {
    const Points ring = x.middleRows(20 * j, 20);
    const Eigen::RowVector3d centre = ring.colwise().mean();
    const double width = (ring.rowwise() - centre).rowwise().norm().mean();
    EXPECT_NEAR(width, 0.3, 0.06) << j;
  }
}

TEST(Deformation, ByLinearSolvesTurnsDetailsWithTheSurface) {
  // A bar with a ridge whose end is lifted: the ridge stays upright on the surface.
  const Tube made = tube();
  const Points x = deform(*laplacianOf(made.mesh), made.handles, turnedEnd(made, 0.8, {0, 1, 0}), linear);
  for (int j = 20; j < 40; ++j) {
    const Points ring = x.middleRows(20 * j, 20);
    const Eigen::RowVector3d centre = ring.colwise().mean();
    EXPECT_NEAR((ring.rowwise() - centre).rowwise().norm().mean(), 0.3, 0.06) << j;
  }
}

TEST(Deformation, HasLessStretchThanTheDisplacementItStartsFrom) {
  const Tube made = tube();
  const auto laplacian = laplacianOf(made.mesh);
  const Points targets = turnedEnd(made, 1.2, {1, 0, 0});
  double last = INFINITY;
  for (const int iterations : {1, 2, 10, 40}) {
    DeformationReport report;
    deform(*laplacian, made.handles, targets, {.smoothness = 0, .tolerance = 1e-12, .max_iterations = iterations},
           &report);
    EXPECT_FALSE(report.converged);
    EXPECT_EQ(report.iterations, iterations);
    EXPECT_LT(report.stretch, last);
    last = report.stretch;
  }
}

TEST(Deformation, BendsAlikeOnOtherTriangles) {
  // One shape, with triangles a third as long as wide, and with long ones; the handles are the same parts of it.
  const auto moved = [](int along, double smoothness) {
    Tube made = tube(40, along);
    made.handles.clear();
    for (int i = 0; i < made.mesh.points.rows(); ++i)
      if (std::abs(made.mesh.points(i, 0) - 2) > 1.79) made.handles.push_back(i);
    return deform(*laplacianOf(made.mesh), made.handles, turnedEnd(made, 0.8, {0, 1, 0}), {.smoothness = smoothness});
  };
  const auto difference = [&](double smoothness) {
    const Points fine = moved(120, smoothness), coarse = moved(40, smoothness);
    double farthest = 0;
    for (int j = 0; j <= 40; ++j) {
      const Points apart = fine.middleRows(40 * 3 * j, 40) - coarse.middleRows(40 * j, 40);
      farthest = std::max(farthest, apart.rowwise().norm().maxCoeff());
    }
    return farthest;
  };
  EXPECT_LE(difference(1e-3), 0.01);
  EXPECT_GE(difference(0), 0.05);
}

TEST(Deformation, DoesNotDependOnUnitPlaceOrThreads) {
  const Tube made = tube(8, 16);
  const Points targets = turnedEnd(made, 1, {0, 1, 1});
  for (DeformationOptions options : {rigid, linear}) {
    const Points x = deform(*laplacianOf(made.mesh), made.handles, targets, options);
    for (const int exponent : {400, -400}) {
      const double unit = std::ldexp(1, exponent);
      shapes::Mesh scaled = made.mesh;
      scaled.points *= unit;
      const Points found = deform(*laplacianOf(scaled), made.handles, unit * targets, options);
      EXPECT_LE((found / unit - x).cwiseAbs().maxCoeff(), 1e-13) << exponent;
    }
    const Eigen::RowVector3d offset(1e5, -1e5, 3e5);
    shapes::Mesh far = made.mesh;
    far.points.rowwise() += offset;
    const Points found = deform(*laplacianOf(far), made.handles, targets.rowwise() + offset, options);
    EXPECT_LE((found.rowwise() - offset - x).cwiseAbs().maxCoeff(), 1e-8);
    for (const int threads : {1, 3}) {
      options.solver.threads = threads;
      EXPECT_EQ(deform(*laplacianOf(made.mesh), made.handles, targets, options), x);
    }
  }
}

TEST(DeformationSolver, HasTheBitsOfDeform) {
  const Tube made = tube(8, 16);
  const auto laplacian = laplacianOf(made.mesh);
  for (const DeformationOptions& options : {rigid, linear}) {
    const DeformationSolver solver(*laplacian, made.handles, options);
    for (const double angle : {0.5, 1.0}) {
      const Points targets = turnedEnd(made, angle, {0, 1, 0});
      EXPECT_EQ(solver.query(targets), deform(*laplacian, made.handles, targets, options));
    }
  }
}

TEST(Deformation, GivesOddCloudsADefinedResult) {
  const Points points = support::oddDisk();
  const Laplacian laplacian = pointCloudLaplacian(points);
  const std::vector<int> handles = {0, 10, 1500, 20};
  Points targets = points(handles, Eigen::all);
  targets.row(2).z() += 0.5;
  for (const DeformationOptions& options : {rigid, linear}) {
    DeformationReport report;
    const Points x = deform(laplacian, handles, targets, options, &report);
    support::expectCopies(laplacian, x);
    EXPECT_TRUE(x.topRows(1500).allFinite());
    EXPECT_EQ(x.middleRows(1000, 500), points.middleRows(1000, 500));
    EXPECT_EQ(x.row(1500), targets.row(2));
    EXPECT_EQ(report.floating, 500);
    EXPECT_GT(report.stretch, 0);
  }
}

TEST(Deformation, GivesOddMeshesADefinedResult) {
  for (const shapes::Mesh& mesh :
       {shapes::slivers(8), shapes::zeroLengthEdges(6), shapes::repeatedVertices(6), shapes::duplicateTriangles(6),
        shapes::bowTie(), shapes::bowTieCones(5), shapes::moebius(6), shapes::book(3, 4), shapes::tetrahedron()}) {
    const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
    Points targets = mesh.points({0, 3}, Eigen::all);
    targets(1, 2) += 0.4;
    for (const DeformationOptions& options : {rigid, linear})
      EXPECT_TRUE(deform(laplacian, {0, 3}, targets, options).allFinite()) << mesh.name;
  }
}

TEST(Deformation, NamesWhatACallerGotWrong) {
  const shapes::Mesh square = shapes::gridSquare(4);
  const Laplacian laplacian = meshLaplacian(square.points, square.triangles);
  const Points targets = square.points.topRows(2);
  const auto why = [&](const std::vector<int>& handles, const Points& to, const DeformationOptions& options = {}) {
    return refusal([&] { deform(laplacian, handles, to, options); });
  };
  EXPECT_EQ(why({0}, targets), "deform: targets has 2 rows, must have 1, one per handle");
  EXPECT_EQ(why({0, 25}, targets), "deform: handles has 25, must lie in [0, 25)");
  EXPECT_EQ(why({}, Points(0, 3)), "deform: handles has no point on a component, must have at least one active point");
  EXPECT_EQ(why({0, 1}, targets, {.smoothness = -1}), "deform: smoothness = -1, must be finite and at least 0");
  EXPECT_EQ(why({0, 1}, targets, {.smoothness = 1e20}), "deform: smoothness = 1e+20, must be at most 1e+06");
  EXPECT_EQ(why({0, 1}, targets, {.tolerance = -1}), "deform: tolerance = -1, must be finite and above 0");
  EXPECT_EQ(why({0, 1}, targets, {.max_iterations = 0}), "deform: max_iterations = 0, must be at least 1");
  Points odd = targets;
  odd(1, 1) = INFINITY;
  EXPECT_EQ(why({0, 3}, odd), "deform: the target of point 3 is not finite, must be");
  for (DeformationOptions options : {rigid, linear}) {
    options.solver.progress = [](std::string_view, double) { return false; };
    EXPECT_THROW(deform(laplacian, {0}, square.points.middleRows(3, 1), options), Cancelled);
  }
}

}  // namespace
}  // namespace tufted::deformation_test
