// Curvature of shapes whose curvature is known.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "shapes/shapes.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::curvature_test {
namespace {

using Principal = Eigen::RowVector2d;

/// A cloud, and k1 >= k2 of the surface at each of its points, for outward normals.
struct Shape {
  shapes::Cloud cloud;
  Eigen::MatrixX2d exact;
  double greatest;  ///< |k|
};

Shape sphere(int n, double noise = 0, std::uint64_t seed = 1) {
  const shapes::Cloud cloud = shapes::sphere(n, shapes::Sampling::uniform, seed);
  return {shapes::withNoise(cloud, noise, seed), Eigen::MatrixX2d::Ones(n, 2), 1};
}

Shape torus(int n, double noise = 0, std::uint64_t seed = 1) {
  Shape shape{shapes::torus(n, shapes::Sampling::uniform, seed), Eigen::MatrixX2d(n, 2), 2.5};
  for (int i = 0; i < n; ++i) {
    const double distance = shape.cloud.points.row(i).head<2>().norm();
    shape.exact.row(i) << 2.5, (distance - 1) / 0.4 / distance;
  }
  shape.cloud = shapes::withNoise(shape.cloud, noise, seed);
  return shape;
}

/// Half a cylinder, whose rims are two half circles and two straight lines.
Shape cylinder(int n) {
  Shape shape{shapes::cylinderPatch(n), Eigen::MatrixX2d(n, 2), 1};
  const shapes::Cloud& cloud = shape.cloud;
  for (int i = 0; i < n; ++i) {
    const bool outward = cloud.normals.row(i).head<2>().dot(cloud.points.row(i).head<2>()) > 0;
    shape.exact.row(i) << (outward ? Principal(1, 0) : Principal(0, -1));
  }
  return shape;
}

/// The frames of a Laplacian with the signs of the exact normals.
Frames framesLike(const Laplacian& laplacian, const Points& normals) {
  Frames frames = laplacian.frames;
  for (Eigen::Index i = 0; i < normals.rows(); ++i)
    if (frames.normals.row(i).dot(normals.row(i)) < 0) frames.normals.row(i) *= -1;
  return frames;
}

/// The errors of k1 and k2, weighted by M, over the greatest curvature; the larger of the two.
double error(const Laplacian& laplacian, const Eigen::MatrixX2d& found, const Shape& shape) {
  const Eigen::MatrixX2d errors = (found - shape.exact).cwiseAbs();
  const Principal sum = laplacian.M.transpose() * errors;
  return sum.maxCoeff() / laplacian.M.sum() / shape.greatest;
}

double error(const Shape& shape) {
  const Laplacian laplacian = pointCloudLaplacian(shape.cloud.points);
  const Curvatures found = curvatures(laplacian, framesLike(laplacian, shape.cloud.normals));
  EXPECT_EQ(found.report.undetermined, 0);
  return error(laplacian, found.principal, shape);
}

TEST(Curvature, IsWithinTwoPercentAndFallsWithTheSpacing) {
  for (Shape (*const make)(int) : {+[](int n) { return torus(n); }, cylinder}) {
    const double coarse = error(make(4000)), middle = error(make(16000)), fine = error(make(64000));
    EXPECT_LE(middle, 0.02);
    EXPECT_LE(middle, 0.6 * coarse);
    EXPECT_LE(fine, 0.6 * middle);
  }
}

TEST(Curvature, OfASphereIsExactWhateverTheSpacing) {
  EXPECT_LE(error(sphere(1000)), 1e-6);
}

TEST(Curvature, IsRightNextToARim) {
  const Shape shape = cylinder(16000);
  const Laplacian laplacian = pointCloudLaplacian(shape.cloud.points);
  const Curvatures found = curvatures(laplacian, framesLike(laplacian, shape.cloud.normals));
  const double near = 3 * std::sqrt(shape.cloud.area / 16000);
  double worst = 0;
  int count = 0;
  for (int i = 0; i < 16000; ++i) {
    const double z = shape.cloud.points(i, 2);
    const double rim = std::min(z - shape.cloud.points.col(2).minCoeff(), shape.cloud.points.col(2).maxCoeff() - z);
    if (rim > near) continue;
    ++count;
    worst = std::max(worst, (found.principal.row(i) - shape.exact.row(i)).cwiseAbs().maxCoeff());
  }
  EXPECT_GT(count, 500);
  EXPECT_LE(worst, 0.02);
}

TEST(Curvature, OfNoisyShapesComesFromWiderWindows) {
  // Seeds that were never used to choose a constant.
  for (const Shape& shape : {sphere(16000, 0.01, 101), torus(16000, 0.01, 102)}) {
    const Laplacian laplacian = pointCloudLaplacian(shape.cloud.points);
    const Curvatures found = curvatures(laplacian, framesLike(laplacian, shape.cloud.normals));
    EXPECT_LE(error(laplacian, found.principal, shape), 0.03) << shape.greatest;
    EXPECT_GT(found.report.mean_rings, 10);
  }
}

TEST(Curvature, TakesNoDetailForNoise) {
  // 1,000 points on a torus: its small circle has 25 of them.
  const Shape shape = torus(1000);
  const Laplacian laplacian = pointCloudLaplacian(shape.cloud.points);
  const Curvatures found = curvatures(laplacian, framesLike(laplacian, shape.cloud.normals));
  EXPECT_EQ(found.report.mean_rings, 2);
  EXPECT_LE(error(laplacian, found.principal, shape), 0.06);
}

TEST(Curvature, OfNoiseThatStaysWantsMoreRings) {
  const Shape shape = sphere(16000, 0.003, 101);
  const Laplacian laplacian = pointCloudLaplacian(shape.cloud.points, cloudOptions(Preset::clean));
  const Frames frames = framesLike(laplacian, shape.cloud.normals);
  const Curvatures narrow = curvatures(laplacian, frames), wide = curvatures(laplacian, frames, {.rings = 12});
  EXPECT_GT(error(laplacian, narrow.principal, shape), 0.5);
  EXPECT_LE(error(laplacian, wide.principal, shape), 0.02);
  EXPECT_EQ(wide.report.mean_rings, 12);
}

TEST(Curvature, HasPerpendicularDirectionsAlongTheCircles) {
  const Shape shape = torus(16000);
  const Laplacian laplacian = pointCloudLaplacian(shape.cloud.points);
  const Curvatures found = curvatures(laplacian, framesLike(laplacian, shape.cloud.normals));
  double sum = 0;
  for (int i = 0; i < 16000; ++i) {
    const Eigen::RowVector3d first = found.first.row(i), second = found.second.row(i);
    EXPECT_NEAR(first.norm(), 1, 1e-12);
    EXPECT_NEAR(first.dot(second), 0, 1e-9);
    const Eigen::RowVector3d around = Eigen::RowVector3d::UnitZ().cross(shape.cloud.points.row(i)).normalized();
    sum += std::abs(first.dot(around));  // k1 belongs to the small circle, perpendicular to that
  }
  EXPECT_LE(sum / 16000, 0.02);
}

TEST(Curvature, TurnsWithTheNormal) {
  const Shape shape = torus(4000);
  const Laplacian laplacian = pointCloudLaplacian(shape.cloud.points);
  Frames frames = framesLike(laplacian, shape.cloud.normals);
  const Curvatures outward = curvatures(laplacian, frames);
  frames.normals *= -1;
  const Curvatures inward = curvatures(laplacian, frames);
  EXPECT_LE((outward.mean + inward.mean).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LE((outward.gaussian - inward.gaussian).cwiseAbs().maxCoeff(), 1e-9);
}

// Normals that a caller brings along may lean by some tens of degrees, as those of coarse estimates do.
TEST(Curvature, IsThatOfTheSurfaceWhereNormalsLean) {
  for (const auto& [shape, noise] :
       {std::pair(torus(4000, 0, 101), 0.0), std::pair(cylinder(4000), 0.0), std::pair(torus(8000, 0.01, 102), 0.01)}) {
    const Laplacian laplacian = pointCloudLaplacian(shape.cloud.points);
    const Frames upright = framesLike(laplacian, shape.cloud.normals);
    Frames leaning = upright;
    const double angle = 29 * M_PI / 180;
    for (Eigen::Index i = 0; i < leaning.normals.rows(); ++i) {
      const Eigen::Vector3d normal = upright.normals.row(i), x = upright.tangents.row(i), y = normal.cross(x);
      const double where = 0.7 * static_cast<double>(i);
      const Eigen::Vector3d axis = std::cos(where) * x + std::sin(where) * y;
      const Eigen::AngleAxisd turn(angle, axis);
      leaning.normals.row(i) = turn * normal;
      leaning.tangents.row(i) = turn * x;
    }
    const double right = error(laplacian, curvatures(laplacian, upright).principal, shape);
    EXPECT_LE(error(laplacian, curvatures(laplacian, leaning).principal, shape), 1.1 * right) << noise;
    const Laplacian built = pointCloudLaplacian(shape.cloud.points, {.normals = &leaning.normals});
    EXPECT_LE(error(built, curvatures(built, framesLike(built, shape.cloud.normals)).principal, shape), 1.1 * right)
        << noise;
  }
}

TEST(Curvature, OfMeshes) {
  const shapes::Mesh ball = shapes::icosphere(4);
  const Laplacian laplacian = meshLaplacian(ball.points, ball.triangles);
  const Frames frames = meshFrames(ball.points, ball.triangles);
  const Curvatures found = curvatures(laplacian, frames);
  EXPECT_LE((found.principal.array() - 1).abs().maxCoeff(), 0.01);
  const Curvatures by_laplacian = curvatures(laplacian, frames, {.method = CurvatureMethod::laplacian});
  EXPECT_LE((by_laplacian.mean.array() - 1).abs().mean(), 0.05);
  EXPECT_EQ(by_laplacian.principal.rows(), 0);
}

TEST(Curvature, OfMeshesAtOnePlaceIsThatOfEach) {
  const shapes::Mesh mesh = shapes::icosphere(3);
  const Eigen::Index n = mesh.points.rows(), faces = mesh.triangles.rows();
  Points points(2 * n, 3);
  points << mesh.points, mesh.points;
  Triangles triangles(2 * faces, 3);
  triangles << mesh.triangles, mesh.triangles.array() + static_cast<int>(n);
  const auto meanOf = [](const Points& places, const Triangles& corners) {
    return curvatures(meshLaplacian(places, corners), meshFrames(places, corners)).mean;
  };
  const VectorXd mean = meanOf(points, triangles);
  EXPECT_EQ(mean.head(n), meanOf(mesh.points, mesh.triangles));
  EXPECT_EQ(mean.tail(n), mean.head(n));
}

TEST(Curvature, OfAPlaneIsZero) {
  const Points plane = shapes::square(1000).points;
  const Curvatures found = curvatures(pointCloudLaplacian(plane));
  EXPECT_LE(found.principal.cwiseAbs().maxCoeff(), 1e-9);
  // What is exact takes no wider window, but where two rings have fewer than nine points, as at corners.
  EXPECT_NEAR(found.report.mean_rings, 2, 0.01);
  const auto isSigned = [](double value) { return value == 0 && std::signbit(value); };
  EXPECT_TRUE(std::none_of(found.mean.begin(), found.mean.end(), isSigned));
  EXPECT_TRUE(std::none_of(found.gaussian.begin(), found.gaussian.end(), isSigned));
  EXPECT_FALSE(found.principal.unaryExpr(isSigned).any());
}

TEST(Curvature, OfFewPointsIsDefined) {
  for (const int n : {0, 1, 3, 5}) {
    const Curvatures few = curvatures(pointCloudLaplacian(shapes::sphere(n + 1).points.topRows(n)));
    EXPECT_EQ(few.mean.size(), n);
    EXPECT_TRUE(few.principal.allFinite());
  }
}

TEST(Curvature, IsFiniteOrRefusedAtAnyScale) {
  const Points points = shapes::sphere(200).points;
  for (const double scale : {1e100, 1e-100}) {
    const Curvatures of_scaled = curvatures(pointCloudLaplacian(scale * points));
    EXPECT_TRUE(of_scaled.gaussian.allFinite());
    EXPECT_NEAR(scale * scale * of_scaled.gaussian.mean(), 1, 1e-3);
  }
  EXPECT_THROW(curvatures(pointCloudLaplacian(1e-200 * points)), SolverFailure);
}

TEST(Curvature, RefusesWhatDoesNotFit) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::sphere(100).points);
  Laplacian without = laplacian;
  without.positions = {};
  EXPECT_EQ(support::refusal([&] { curvatures(without); }),
            "curvatures: Laplacian::positions has 0 rows, must have 100, one per point");
  Laplacian broken = laplacian;
  broken.frames.tangents(4, 0) = INFINITY;
  EXPECT_EQ(support::refusal([&] { curvatures(broken); }),
            "curvatures: the position or frame of point 4 is not finite, must be: the Laplacian has it active");
  EXPECT_EQ(support::refusal([&] { curvatures(laplacian, {.threads = -1}); }),
            "curvatures: threads = -1, must be >= 0");
  EXPECT_EQ(support::refusal([&] { curvatures(laplacian, {.rings = 101}); }),
            "curvatures: rings = 101, must lie in [0, 100]");
  EXPECT_EQ(support::refusal([&] { curvatures(laplacian, {.method = CurvatureMethod::laplacian, .rings = 5}); }),
            "curvatures: rings = 5, must be 0 without CurvatureMethod::fit");
  EXPECT_THROW(curvatures(laplacian, {.progress = [](std::string_view, double) { return false; }}), Cancelled);
}

}  // namespace
}  // namespace tufted::curvature_test
