#include "cover/cover.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "cover/geometry.h"
#include "cover/short_edges.h"
#include "shapes/shapes.h"
#include "tufted/tufted.h"

namespace tufted::cover_test {
namespace {

const Progress silent;
const Workers workers(1, silent);

IntrinsicTriangulation coverOf(const Points& points, const Triangles& triangles, const EdgeOrder& order = {}) {
  IntrinsicTriangulation cover;
  resizeCover(cover, static_cast<int>(points.rows()), triangles.rows());
  for (int t = 0; t < triangles.rows(); ++t) addTriangle(cover, t, triangles(t, 0), triangles(t, 1), triangles(t, 2));
  glueEdges(cover, points, order, workers);
  measureLengths(cover, points, workers);
  return cover;
}

std::pair<int, int> endsOf(const IntrinsicTriangulation& cover, int side) {
  return std::minmax({tail(cover, side), head(cover, side)});
}

/// All of `validate` but Delaunay.
bool isValidCover(const IntrinsicTriangulation& cover) {
  CoverCheck check = validate(cover);
  check.not_delaunay = 0;
  return check.ok();
}

TEST(TuftedCover, OfATriangleIsItsFrontGluedToItsBack) {
  Points points(3, 3);
  points << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  Triangles triangle(1, 3);
  triangle << 0, 1, 2;
  const IntrinsicTriangulation cover = coverOf(points, triangle);
  for (int s = 0; s < 3; ++s) EXPECT_EQ(cover.glue[frontSide(0, s)], backSide(0, s));
  EXPECT_TRUE(isValidCover(cover));
}

TEST(TuftedCover, OfAClosedManifoldIsTwoCopiesOfIt) {
  const shapes::Mesh sphere = shapes::icosphere(2);
  const IntrinsicTriangulation cover = coverOf(sphere.points, sphere.triangles);
  for (int side = 0; side < static_cast<int>(cover.glue.size()); ++side) {
    EXPECT_EQ((side / 3) % 2, (cover.glue[side] / 3) % 2);  // front to front, back to back
  }
}

TEST(TuftedCover, GluesPagesToTheirNeighboursByAngle) {
  // Five pages about the z axis, listed out of order: each sheet between two pages joins the facing sides.
  const std::vector<int> listed = {3, 0, 4, 1, 2};
  Points points(7, 3);
  points.row(0) << 0, 0, 0;
  points.row(1) << 0, 0, 1;
  Triangles pages(5, 3);
  for (int t = 0; t < 5; ++t) {
    const double angle = 2 * M_PI * listed[t] / 5 + 0.3;
    points.row(2 + t) << std::cos(angle), std::sin(angle), 0.5;
    pages.row(t) << 0, 1, 2 + t;
  }
  const IntrinsicTriangulation cover = coverOf(points, pages);
  EXPECT_TRUE(isValidCover(cover));
  for (int t = 0; t < 5; ++t) {
    // The front runs along +z, and its normal z x r points towards larger angles: it faces the back of the next page.
    const int mate = cover.glue[frontSide(t, 0)];
    ASSERT_EQ(mate / 3 % 2, 1);
    EXPECT_EQ(listed[mate / 6], (listed[t] + 1) % 5);
  }
}

TEST(TuftedCover, IsClosedManifoldAndOrientedForEveryMeshAndOrder) {
  for (const shapes::Mesh& mesh : shapes::allMeshes()) {
    Triangles clean(0, 3);
    for (int t = 0; t < mesh.triangles.rows(); ++t) {
      const auto f = mesh.triangles.row(t);
      if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0]) continue;
      clean.conservativeResize(clean.rows() + 1, 3);
      clean.row(clean.rows() - 1) = f;
    }
    for (const FaceOrder order : {FaceOrder::angle, FaceOrder::area, FaceOrder::random}) {
      EXPECT_TRUE(isValidCover(coverOf(mesh.points, clean, {order, 5}))) << mesh.name;
    }
  }
}

TEST(Mollify, LeavesGoodTrianglesAndThinOnesAlone) {
  shapes::Mesh thin = shapes::icosphere(2);
  thin.points.col(2) *= 1e-6;
  for (const shapes::Mesh& mesh : {shapes::icosphere(2), thin}) {
    IntrinsicTriangulation cover = coverOf(mesh.points, mesh.triangles);
    const std::vector<double> before = cover.length;
    EXPECT_EQ(lengthenShortEdges(cover, default_mollify, workers), 0);
    EXPECT_EQ(lengthenAtFlatFaces(cover, workers), 0);
    EXPECT_EQ(cover.length, before);
  }
}

TEST(Mollify, ChangesOnlyTheLengthsAtTheCornerOfAFlatTriangle) {
  // A square grid of two rows, and a flat triangle over one of its edges.
  Points points(7, 3);
  points << 0, 0, 0, 1, 0, 0, 2, 0, 0, 0, 1, 0, 1, 1, 0, 2, 1, 0, 0.4, 1, 0;
  Triangles triangles(5, 3);
  triangles << 0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 3, 4, 6;
  IntrinsicTriangulation cover = coverOf(points, triangles);
  const std::vector<double> before = cover.length;
  EXPECT_EQ(lengthenAtFlatFaces(cover, workers), 2);  // of front and back together, which share their edges
  for (int side = 0; side < static_cast<int>(before.size()); ++side) {
    const bool is_at_corner = tail(cover, side) == 6 || head(cover, side) == 6;
    EXPECT_EQ(cover.length[side] > before[side], is_at_corner);
    EXPECT_LE(cover.length[side], before[side] + 0x1p-44);
  }
  for (int f = 0; f < cover.size(); ++f) EXPECT_GT(faceArea(cover, f), 0);
}

TEST(Mollify, GivesEdgesOfLengthZeroTheLeastLengthAndNothingElse) {
  Points points(4, 3);
  points << 0, 0, 0, 0, 0, 0, 3, 0, 0, -2, 1, 0;  // the first two coincide
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 1, 0, 3;
  IntrinsicTriangulation cover = coverOf(points, triangles);
  const std::vector<double> before = cover.length;
  EXPECT_EQ(lengthenShortEdges(cover, 1e-8, workers), 2);
  for (int side = 0; side < static_cast<int>(before.size()); ++side)
    EXPECT_EQ(cover.length[side], before[side] > 0 ? before[side] : 1e-8 * std::sqrt(5.0));  // of the smaller triangle
}

TEST(Flips, KeepAreaVerticesAndEveryPromiseOfTheCover) {
  for (const shapes::Mesh& mesh :
       {shapes::cubeMesh(6, shapes::Quality::bad), shapes::moebius(6), shapes::kleinBottle(8), shapes::book(4, 6)}) {
    IntrinsicTriangulation cover = coverOf(mesh.points, mesh.triangles);
    double before = 0, after = 0;
    for (int f = 0; f < cover.size(); ++f) before += faceArea(cover, f);
    const FlipCounts counts = flipToDelaunay(cover, workers);
    for (int f = 0; f < cover.size(); ++f) after += faceArea(cover, f);
    EXPECT_TRUE(validate(cover).ok()) << mesh.name;
    EXPECT_EQ(counts.failures, 0) << mesh.name;
    EXPECT_NEAR(after, before, 1e-12 * before) << mesh.name;
  }
}

TEST(Flips, OfAFlatQuadrilateralGiveItsOtherDiagonal) {
  Points points(4, 3);
  points << 0, 0, 0, 4, 0, 0, 2, 1, 0, 2, -1, 0;
  Triangles triangles(2, 3);
  triangles << 0, 1, 2, 1, 0, 3;
  IntrinsicTriangulation cover = coverOf(points, triangles);
  const FlipCounts counts = flipToDelaunay(cover, workers);
  EXPECT_GE(counts.flips, 2);  // once on each sheet
  int diagonals = 0;
  for (int side = 0; side < 12; ++side) {
    EXPECT_NE(endsOf(cover, side), std::pair(0, 1));
    if (endsOf(cover, side) == std::pair(2, 3)) {
      ++diagonals;
      EXPECT_DOUBLE_EQ(cover.length[side], 2);
    }
  }
  EXPECT_EQ(diagonals, 4);
  EXPECT_TRUE(validate(cover).ok());
}

TEST(Flips, CopeWithMultiEdgesAndSelfEdges) {
  // The cover of one obtuse triangle: flipping its long edge joins the obtuse corner to itself across the fold.
  Points points(3, 3);
  points << 0, 0, 0, 1, 0, 0, 0.5, 0.1, 0;
  Triangles triangle(1, 3);
  triangle << 0, 1, 2;
  IntrinsicTriangulation cover = coverOf(points, triangle);
  EXPECT_EQ(flipToDelaunay(cover, workers).flips, 1);
  int self_edges = 0;
  for (int side = 0; side < 6; ++side) self_edges += tail(cover, side) == head(cover, side) ? 1 : 0;
  EXPECT_EQ(self_edges, 2);  // both sides of the new edge
  EXPECT_TRUE(validate(cover).ok());
  EXPECT_NEAR(faceArea(cover, 0) + faceArea(cover, 1), 0.1, 1e-15);
}

TEST(Validate, FindsEveryPlantedFault) {
  const shapes::Mesh mesh = shapes::book(3, 3);
  IntrinsicTriangulation good = coverOf(mesh.points, mesh.triangles);
  flipToDelaunay(good, workers);
  ASSERT_TRUE(validate(good).ok());
  const auto broken = [&](auto change) {
    IntrinsicTriangulation cover = good;
    change(cover);
    return validate(cover);
  };
  EXPECT_GT(broken([](auto& c) { c.glue[4] = unglued; }).not_closed, 0);
  EXPECT_GT(broken([](auto& c) { c.glue[4] = 1 << 30; }).not_closed, 0);
  EXPECT_GT(broken([](auto& c) { c.glue[4] = 4; }).not_edge_manifold, 0);
  EXPECT_GT(broken([](auto& c) { std::swap(c.glue[0], c.glue[1]); }).not_edge_manifold, 0);
  EXPECT_GT(broken([](auto& c) { std::swap(c.faces[0][0], c.faces[0][1]); }).not_oriented, 0);
  EXPECT_GT(broken([](auto& c) { c.length[5] *= 1 + 1e-15; }).unequal_lengths, 0);
  EXPECT_GT(broken([](auto& c) { c.length[5] = c.length[c.glue[5]] = 100; }).triangle_inequality, 0);
  EXPECT_GT(broken([](auto& c) { c.length.pop_back(); }).not_closed, 0);
  const shapes::Mesh bad = shapes::cubeMesh(4, shapes::Quality::bad);
  EXPECT_GT(validate(coverOf(bad.points, bad.triangles)).not_delaunay, 0);
}

TEST(Validate, FindsAnEdgeThatIsNotDelaunayInAnyUnit) {
  const shapes::Mesh bad = shapes::cubeMesh(4, shapes::Quality::bad);
  const IntrinsicTriangulation cover = coverOf(bad.points, bad.triangles);
  const CoverCheck check = validate(cover);
  EXPECT_LT(check.smallest_cotan_sum, -1);
  for (const int exponent : {-900, -400, 400, 900}) {
    IntrinsicTriangulation scaled = cover;
    for (double& length : scaled.length) length = std::ldexp(length, exponent);
    EXPECT_EQ(validate(scaled).not_delaunay, check.not_delaunay) << exponent;
    EXPECT_EQ(validate(scaled).smallest_cotan_sum, check.smallest_cotan_sum) << exponent;
  }
}

TEST(Validate, FindsANeedleThatIsNotDelaunay) {
  // Front and back of one triangle whose corner 2 lies next to corner 0 and almost on the side opposite: both angles
  // there are next to pi, with a cotangent of -2e5.
  IntrinsicTriangulation cover;
  cover.vertices = 3;
  cover.faces = {{0, 1, 2}, {0, 2, 1}};
  cover.glue = {5, 4, 3, 2, 1, 0};
  const double rest = 1 - 1e-4 + 1e-15;
  cover.length = {1, rest, 1e-4, 1e-4, rest, 1};
  const CoverCheck check = validate(cover);
  EXPECT_LT(check.smallest_cotan_sum, -1e5);
  EXPECT_EQ(check.not_delaunay, 1);
  EXPECT_EQ(check.not_closed + check.not_edge_manifold + check.not_oriented + check.unequal_lengths, 0);
}

}  // namespace
}  // namespace tufted::cover_test
