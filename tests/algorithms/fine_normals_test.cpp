// Normals are taken from as few points as noise allows.
#include <gtest/gtest.h>

#include <utility>

#include "base/median.h"
#include "shapes/shapes.h"
#include "tufted/normals.h"

namespace tufted::fine_normals_test {
namespace {

/// The median sine of the angle to the true normals.
double errorOf(const Points& normals, const Points& exact) {
  Buffer<double> sines;
  for (Eigen::Index i = 0; i < exact.rows(); ++i)
    sines.push_back(normals.row(i).head<3>().cross(exact.row(i).head<3>()).norm());
  return medianOf(std::move(sines));
}

TEST(FineNormals, BendWithTheSurface) {
  for (const shapes::Cloud& exact : {shapes::torus(4000), shapes::ellipsoid(4000), shapes::sphere(4000)}) {
    const Laplacian laplacian = pointCloudLaplacian(exact.points);
    EXPECT_LT(errorOf(orientedFrames(laplacian).normals, exact.normals),
              0.5 * errorOf(laplacian.frames.normals, exact.normals))
        << exact.shape;
  }
}

/// A quarter of the points of a coarse cube have neighbours beyond an edge: planes of ten have fewer of them than
/// planes of thirty.
TEST(FineNormals, EndAtCreases) {
  const shapes::Cloud cube = shapes::cubeSurface(1000);
  const Laplacian laplacian = pointCloudLaplacian(cube.points);
  const auto areRight = [&](const Points& normals) {
    return ((normals.array() * cube.normals.array()).rowwise().sum().abs() > 0.99).count();
  };
  EXPECT_GT(areRight(orientedFrames(laplacian).normals), 1.2 * static_cast<double>(areRight(laplacian.frames.normals)));
}

TEST(FineNormals, AreWithTangentsAnOrthonormalFrame) {
  const Frames frames = orientedFrames(pointCloudLaplacian(shapes::withNoise(shapes::torus(3000), 0.01).points));
  for (Eigen::Index i = 0; i < 3000; ++i) {
    EXPECT_NEAR(frames.normals.row(i).norm(), 1, 1e-12);
    EXPECT_NEAR(frames.tangents.row(i).norm(), 1, 1e-12);
    EXPECT_NEAR(frames.normals.row(i).dot(frames.tangents.row(i)), 0, 1e-12);
  }
}

TEST(FineNormals, OfBothSignsAreTheSameBits) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::withNoise(shapes::ellipsoid(2000), 0.003).points);
  const Eigen::Vector3d inside(0, 0, 0), outside(1000, 0, 0);
  const Points one = orientedFrames(laplacian, {.viewpoint = &inside}).normals,
               other = orientedFrames(laplacian, {.viewpoint = &outside}).normals;
  EXPECT_EQ(one.cwiseAbs(), other.cwiseAbs());
}

TEST(FineNormals, DoNotDependOnTheUnit) {
  const Points points = shapes::torus(2000).points;
  const Points normals = orientedFrames(pointCloudLaplacian(points)).normals;
  for (const double unit : {0x1p-560, 0x1p300})  // squares of the first are 0
    EXPECT_LE((orientedFrames(pointCloudLaplacian(unit * points)).normals - normals).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(FineNormals, OfTheCallerStay) {
  const shapes::Cloud cloud = shapes::torus(1000);
  CloudOptions options;
  options.normals = &cloud.normals;
  const Laplacian laplacian = pointCloudLaplacian(cloud.points, options);
  const Points normals = orientedFrames(laplacian).normals;
  for (Eigen::Index i = 0; i < normals.rows(); ++i)
    EXPECT_EQ(normals.row(i).cwiseAbs(), laplacian.frames.normals.row(i).cwiseAbs());
}

}  // namespace
}  // namespace tufted::fine_normals_test
