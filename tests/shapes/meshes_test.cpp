#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "oracles/oracles.h"
#include "shapes/shapes.h"

namespace tufted::shapes::meshes_test {
namespace {

const std::vector<Mesh>& meshes() {
  static const std::vector<Mesh> all = allMeshes();
  return all;
}

class EveryMesh : public testing::TestWithParam<int> {
 protected:
  const Mesh& mesh() const { return meshes()[GetParam()]; }
};

TEST_P(EveryMesh, HasTheClaimedTopology) {
  const oracles::Topology found = oracles::topology(mesh().triangles);
  EXPECT_EQ(mesh().components, found.components);
  EXPECT_EQ(mesh().boundary_edges, found.boundary_edges);
  EXPECT_EQ(mesh().nonmanifold_edges, found.nonmanifold_edges);
  EXPECT_EQ(mesh().nonmanifold_vertices, found.nonmanifold_vertices);
  EXPECT_EQ(mesh().orientable, found.orientable);
  EXPECT_EQ(mesh().euler, found.euler);
}

TEST_P(EveryMesh, HasTheClaimedArea) {
  const double area = oracles::surfaceArea(mesh().points, mesh().triangles);
  EXPECT_NEAR(area, mesh().area, (mesh().flat ? 1e-12 : 0.1) * mesh().area);
}

TEST_P(EveryMesh, UsesValidIndices) {
  EXPECT_GE(mesh().triangles.minCoeff(), 0);
  EXPECT_LT(mesh().triangles.maxCoeff(), mesh().points.rows());
  EXPECT_TRUE(mesh().points.allFinite());
}

INSTANTIATE_TEST_SUITE_P(Shapes, EveryMesh, testing::Range(0, static_cast<int>(meshes().size())),
                         [](const auto& param_info) { return meshes()[param_info.param].name; });

TEST(Meshes, CurvedAreasConverge) {
  const Mesh strip = moebius(20), bottle = kleinBottle(100), ball = icosphere(5);
  for (const Mesh* mesh : {&strip, &bottle, &ball}) {
    EXPECT_NEAR(oracles::surfaceArea(mesh->points, mesh->triangles) / mesh->area, 1, 2e-3) << mesh->name;
  }
}

double smallestAngle(const Mesh& mesh) {
  double smallest = std::numbers::pi;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const auto corner = [&](int j) -> Eigen::RowVector3d { return mesh.points.row(mesh.triangles(f, (k + j) % 3)); };
      const Eigen::RowVector3d u = corner(1) - corner(0), v = corner(2) - corner(0);
      smallest = std::min(smallest, std::atan2(u.cross(v).norm(), u.dot(v)));
    }
  }
  return smallest;
}

TEST(Meshes, GoodAndBadSolidsShareTheirPointsOnly) {
  const Mesh good = cubeMesh(12, Quality::good), bad = cubeMesh(12, Quality::bad);
  EXPECT_EQ(good.points, bad.points);
  EXPECT_EQ(good.points.rows(), 6 * 12 * 12 + 2);
  EXPECT_EQ(good.triangles.rows(), bad.triangles.rows());
  EXPECT_GT(smallestAngle(good), 0.2);  // 11 degrees
  EXPECT_LT(smallestAngle(bad), 0.01);
  EXPECT_EQ(prismMesh(6, Quality::good).points, prismMesh(6, Quality::bad).points);
  EXPECT_GT(smallestAngle(prismMesh(6, Quality::good)), 0.2);
  EXPECT_LT(smallestAngle(prismMesh(6, Quality::bad)), 0.08);
}

TEST(Meshes, ClosedSolidsFaceOutwards) {
  // The divergence theorem gives the enclosed volume.
  const auto volume = [](const Mesh& mesh) {
    double sum = 0;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
      const Eigen::RowVector3d a = mesh.points.row(mesh.triangles(f, 0)), b = mesh.points.row(mesh.triangles(f, 1)),
                               c = mesh.points.row(mesh.triangles(f, 2));
      sum += a.dot(b.cross(c)) / 6;
    }
    return sum;
  };
  const double prism = 1.5 * std::sqrt(3.0) / 4;
  EXPECT_NEAR(volume(cubeMesh(5, Quality::good)), 1, 1e-12);
  EXPECT_NEAR(volume(cubeMesh(5, Quality::bad)), 1, 1e-12);
  EXPECT_NEAR(volume(prismMesh(5, Quality::good)), prism, 1e-12);
  EXPECT_NEAR(volume(prismMesh(5, Quality::bad)), prism, 1e-12);
  EXPECT_NEAR(volume(cubeQuads(3)), 1, 1e-12);
  EXPECT_NEAR(volume(prismQuads(3)), prism, 1e-12);
  EXPECT_NEAR(volume(tetrahedron()), 8.0 / 3, 1e-12);
  EXPECT_NEAR(volume(icosphere(5)), 4.0 / 3 * std::numbers::pi, 2e-2);
}

TEST(Meshes, PolygonsCoverWhatTheirTrianglesCover) {
  for (const Mesh& mesh : {cubeQuads(4), prismQuads(4)}) {
    Eigen::Index triangles = 0;
    for (const std::vector<int>& polygon : mesh.polygons) triangles += static_cast<Eigen::Index>(polygon.size()) - 2;
    EXPECT_EQ(triangles, mesh.triangles.rows());
  }
  EXPECT_EQ(cubeQuads(4).polygons.size(), 6u * 16);
}

TEST(Meshes, DegeneraciesAreThere) {
  const Mesh zero = zeroLengthEdges(4);
  int coincident = 0, repeated = 0;
  for (Eigen::Index i = 0; i < zero.points.rows(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) coincident += zero.points.row(i) == zero.points.row(j);
  }
  EXPECT_EQ(coincident, 5);
  const Triangles triangles = repeatedVertices(4).triangles;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) repeated += triangles(f, 0) == triangles(f, 1);
  EXPECT_EQ(repeated, 2);
  EXPECT_EQ(unreferencedVertices(4).points.rows(), 25 + 3);
  EXPECT_GT(unreferencedVertices(4).triangles.minCoeff(), 0);
  EXPECT_LT(smallestAngle(slivers(8)), 1e-8);
  EXPECT_GT(smallestAngle(slivers(8)), 0);
}

TEST(Meshes, KleinBottleHasNoCoincidentPoints) {
  const Mesh bottle = kleinBottle(16);
  for (Eigen::Index i = 0; i < bottle.points.rows(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) EXPECT_GT((bottle.points.row(i) - bottle.points.row(j)).norm(), 1e-3);
  }
}

}  // namespace
}  // namespace tufted::shapes::meshes_test
