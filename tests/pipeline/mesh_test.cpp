// Algorithm 3 on meshes of any connectivity.
#include <gtest/gtest.h>

#include <cmath>

#include "cover/assemble.h"
#include "cover/cover.h"
#include "oracles/oracles.h"
#include "shapes/shapes.h"
#include "shapes/spectra.h"
#include "support/compare.h"
#include "tufted/tufted.h"

namespace tufted::mesh_test {
namespace {

using support::largestDifference;
using support::largestEntry;

TEST(MeshLaplacian, OfAMeshThatIsDelaunayIsTheCotanLaplacian) {
  const shapes::Mesh mesh = shapes::icosphere(3);
  const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
  const oracles::Operators cotan = oracles::cotanLaplacian(mesh.points, mesh.triangles);
  EXPECT_EQ(laplacian.report.flips, 0);
  EXPECT_LE(largestDifference(laplacian.L, cotan.L), 1e-12 * largestEntry(cotan.L));
  EXPECT_LE((laplacian.M - cotan.M).cwiseAbs().maxCoeff(), 1e-14);
}

class FlatSolid : public testing::TestWithParam<bool> {
 protected:
  static shapes::Mesh solid(shapes::Quality quality) {
    return GetParam() ? shapes::cubeMesh(8, quality) : shapes::prismMesh(8, quality);
  }
};

TEST_P(FlatSolid, HasOneLaplacianHoweverItsFacesAreTriangulated) {
  const shapes::Mesh good = solid(shapes::Quality::good), bad = solid(shapes::Quality::bad);
  ASSERT_EQ(good.points, bad.points);
  const Laplacian a = meshLaplacian(good.points, good.triangles, {.mollify = 0});
  const Laplacian b = meshLaplacian(bad.points, bad.triangles, {.mollify = 0});
  EXPECT_GT(b.report.flips, 0);
  EXPECT_LE(largestDifference(a.L, b.L), 1e-9);
  // Areas are lumped by the triangulation, which is not unique for cocircular points; their sum is.
  EXPECT_NEAR(a.M.sum(), good.area, 1e-12);
  EXPECT_NEAR(b.M.sum(), good.area, 1e-12);
  EXPECT_EQ(b.report.clamped_large, 0);
  EXPECT_LE(b.report.largest_clamped, 1e-9);
}

TEST_P(FlatSolid, NeedsItsFlips) {
  // The pipeline without Algorithm 2 leaves large negative weights and another matrix.
  const shapes::Mesh bad = solid(shapes::Quality::bad);
  const int n = static_cast<int>(bad.points.rows());
  const Progress silent;
  const Workers workers(1, silent);
  IntrinsicTriangulation cover;
  resizeCover(cover, n, bad.triangles.rows());
  for (int t = 0; t < bad.triangles.rows(); ++t) {
    addTriangle(cover, t, bad.triangles(t, 0), bad.triangles(t, 1), bad.triangles(t, 2));
  }
  glueEdges(cover, bad.points, {}, workers);
  measureLengths(cover, bad.points, workers);
  Buffer<int> input_index(n);
  for (int i = 0; i < n; ++i) input_index[i] = i;
  Laplacian before, after;
  assembleLaplacian(cover, input_index, n, 0.5, workers, before);
  EXPECT_FALSE(validate(cover).ok());
  EXPECT_GT(before.report.clamped_large, 0);
  flipToDelaunay(cover, workers);
  assembleLaplacian(cover, input_index, n, 0.5, workers, after);
  EXPECT_TRUE(validate(cover).ok());
  EXPECT_EQ(after.report.clamped_large, 0);
  EXPECT_GT(largestDifference(before.L, after.L), 1e-2);
}

INSTANTIATE_TEST_SUITE_P(Solids, FlatSolid, testing::Bool(),
                         [](const auto& solid) { return solid.param ? "cube" : "prism"; });

TEST(MeshLaplacian, KeepsAreaAndComponentsOfEveryGeneratedMesh) {
  for (const shapes::Mesh& mesh : shapes::allMeshes()) {
    const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
    if (mesh.shape != "slivers" && laplacian.report.lengthened_edges == 0) {
      EXPECT_NEAR(laplacian.M.sum(), oracles::surfaceArea(mesh.points, mesh.triangles), 1e-9) << mesh.name;
    }
    EXPECT_EQ(laplacian.report.components, mesh.components) << mesh.name;
    EXPECT_EQ(laplacian.report.boundary_edges, mesh.boundary_edges) << mesh.name;
    EXPECT_EQ(laplacian.report.nonmanifold_edges, mesh.nonmanifold_edges) << mesh.name;
    EXPECT_EQ(laplacian.report.clamped_large, 0) << mesh.name;
  }
}

TEST(MeshLaplacian, OfABookHasItsSpectrum) {
  // Pages that meet at one edge: a truly nonmanifold domain with known eigenvalues.
  for (const int pages : {3, 5}) {
    const shapes::Mesh book = shapes::book(pages, 16);
    ASSERT_GE(book.eigenvalues.size(), 12);
    const Laplacian laplacian = meshLaplacian(book.points, book.triangles);
    const VectorXd values = oracles::smallestEigenvalues(laplacian.L, laplacian.M, 12);
    EXPECT_LE(oracles::meanRelativeError(values, book.eigenvalues.head(12)), 1e-2) << pages;
  }
}

TEST(MeshLaplacian, OrientationOfTrianglesDoesNotMatter) {
  const shapes::Mesh mixed = shapes::mixedOrientation(12);
  const shapes::Mesh grid = shapes::gridSquare(12);
  const Laplacian a = meshLaplacian(mixed.points, mixed.triangles), b = meshLaplacian(grid.points, grid.triangles);
  EXPECT_LE(largestDifference(a.L, b.L), 1e-12);
  EXPECT_EQ(a.boundary, b.boundary);
}

TEST(MeshLaplacian, BoundaryWeightsAreNotNegativeEither) {
  // Section 5.5: an obtuse angle opposite a boundary edge, where flips of a plain mesh cannot help.
  Points points(3, 3);
  points << 0, 0, 0, 1, 0, 0, 0.5, 0.1, 0;
  Triangles triangle(1, 3);
  triangle << 0, 1, 2;
  EXPECT_GT(oracles::cotanLaplacian(points, triangle).L.coeff(0, 1), 0);  // a negative weight
  const Laplacian laplacian = meshLaplacian(points, triangle);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (i == j) continue;
      EXPECT_LE(laplacian.L.coeff(i, j), 0);
    }
  }
  EXPECT_TRUE(validate(laplacian.cover()).ok());
}

TEST(MeshLaplacian, CountsWhatItDrops) {
  const shapes::Mesh repeated = shapes::repeatedVertices(8);
  const Report report = meshLaplacian(repeated.points, repeated.triangles).report;
  EXPECT_GT(report.repeated_vertex_triangles, 0);
  EXPECT_EQ(report.triangles + report.repeated_vertex_triangles, repeated.triangles.rows());

  const shapes::Mesh unreferenced = shapes::unreferencedVertices(8);
  const Laplacian laplacian = meshLaplacian(unreferenced.points, unreferenced.triangles);
  EXPECT_EQ(laplacian.report.isolated, 3);
  EXPECT_EQ(laplacian.status[0], PointStatus::isolated);
  EXPECT_EQ(laplacian.L.rows(), unreferenced.points.rows());

  shapes::Mesh grid = shapes::gridSquare(8);
  grid.points(40, 1) = NAN;
  const Report odd = meshLaplacian(grid.points, grid.triangles).report;
  EXPECT_EQ(odd.not_finite, 1);
  EXPECT_EQ(odd.not_finite_triangles, 6);
}

TEST(MeshLaplacian, SurvivesEdgesOfLengthZeroAndSlivers) {
  for (const shapes::Mesh& mesh : {shapes::zeroLengthEdges(8), shapes::slivers(8)}) {
    const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
    const double plain = oracles::surfaceArea(mesh.points, mesh.triangles);
    EXPECT_NEAR(laplacian.report.area_added, laplacian.M.sum() - plain, 1e-12 * plain) << mesh.name;
    EXPECT_LE(std::abs(laplacian.report.area_added), default_mollify * plain) << mesh.name;
    EXPECT_EQ(laplacian.report.degenerate_faces, 0) << mesh.name;
    EXPECT_TRUE(validate(laplacian.cover()).ok()) << mesh.name;
    // And without mollification nothing is lost but the flat triangles.
    EXPECT_TRUE(meshLaplacian(mesh.points, mesh.triangles, {.mollify = 0}).M.allFinite()) << mesh.name;
  }
}

TEST(MeshLaplacian, AllVerticesAtOnePointGiveZeros) {
  const shapes::Mesh grid = shapes::gridSquare(4);
  const Points points = Points::Constant(grid.points.rows(), 3, 2.5);
  const Laplacian laplacian = meshLaplacian(points, grid.triangles);
  EXPECT_EQ(laplacian.L.nonZeros(), 0);
  EXPECT_EQ(laplacian.M.sum(), 0);
  EXPECT_EQ(laplacian.report.degenerate_faces, 2 * grid.triangles.rows());
  EXPECT_EQ(laplacian.report.isolated, points.rows());
}

TEST(MeshLaplacian, EmptyMeshesAreEmptyOperators) {
  EXPECT_EQ(meshLaplacian(Points(0, 3), Triangles(0, 3)).L.rows(), 0);
  EXPECT_EQ(meshLaplacian(Points::Zero(5, 3), Triangles(0, 3)).report.isolated, 5);
}

TEST(MeshLaplacian, NamesAnIndexOutOfRange) {
  Triangles triangle(1, 3);
  triangle << 0, 1, 3;
  try {
    meshLaplacian(Points::Random(3, 3), triangle);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_STREQ(error.what(), "meshLaplacian: triangle 0 names vertex 3, must lie in [0, 3)");
  }
}

TEST(MeshLaplacian, OrdersOfFacesAllGiveValidCovers) {
  const shapes::Mesh book = shapes::book(5, 8);
  for (const FaceOrder order : {FaceOrder::angle, FaceOrder::area, FaceOrder::random}) {
    const Laplacian laplacian = meshLaplacian(book.points, book.triangles, {.paper = {.order = order, .seed = 11}});
    EXPECT_TRUE(validate(laplacian.cover()).ok());
    EXPECT_NEAR(laplacian.M.sum(), book.area, 1e-9);
  }
}

}  // namespace
}  // namespace tufted::mesh_test
