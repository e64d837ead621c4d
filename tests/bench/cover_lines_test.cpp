#include "bench/compare/cover_lines.h"

#include <gtest/gtest.h>

#include "shapes/shapes.h"
#include "tufted/laplacian.h"

namespace tufted::bench::cover_lines_test {
namespace {

double lengthOf(const IntrinsicEdge& edge) {
  double length = 0;
  for (const EdgePart& part : edge.parts) length += (part.to - part.from).norm();
  return length;
}

TEST(CoverLines, EndAtVerticesAndHaveTheLengthsOfTheCover) {
  shapes::Mesh book = shapes::book(3, 6);
  book.points.col(2) += 1.5 * book.points.leftCols(2).rowwise().norm();
  for (const shapes::Mesh& mesh : {book, shapes::cubeMesh(4, shapes::Quality::bad), shapes::icosphere(1)}) {
    const IntrinsicTriangulation glued = gluedCover(mesh.points, mesh.triangles);
    const IntrinsicEdges found = intrinsicEdges(glued, mesh.points);
    EXPECT_LT(found.greatest_miss, 1e-10) << mesh.name;
    ASSERT_EQ(2 * std::ssize(found.edges), 3 * glued.size());
    // The intrinsic Delaunay triangulation is unique but for ties, and its edges are as long as in the library's.
    const Laplacian built = meshLaplacian(mesh.points, mesh.triangles);
    double sum = 0, expected = 0;
    for (const IntrinsicEdge& edge : found.edges) sum += 2 * lengthOf(edge);
    for (const double length : built.cover().length) expected += length;
    EXPECT_NEAR(sum, expected, 1e-9 * expected) << mesh.name;
    EXPECT_EQ(found.flips > 0, built.report.flips > 0) << mesh.name;
    for (const IntrinsicEdge& edge : found.edges)  // a line goes on where it came to
      for (std::size_t p = 1; p < edge.parts.size(); ++p)
        EXPECT_EQ(edge.parts[p].from, edge.parts[p - 1].to) << mesh.name;
  }
}

}  // namespace
}  // namespace tufted::bench::cover_lines_test
