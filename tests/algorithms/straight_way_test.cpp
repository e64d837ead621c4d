// Straight ways from corner to corner: through a plane, past a bend of pages, and none where there is no vertex.
#include "algorithms/straight_way.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <optional>

#include "algorithms/turn.h"
#include "oracles/planar.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "tufted/tufted.h"

namespace tufted::straight_way_test {
namespace {

constexpr int many = 1000;

/// Triangles as they are, without flips.
MarchFaces facesOf(const Points& points, const Triangles& triangles) {
  const Progress silent;
  const Workers workers(1, silent);
  std::vector<DistinctFace> faces;
  for (const auto& triangle : triangles.rowwise()) {
    const auto length = [&](int i) {
      return (points.row(triangle[(i + 1) % 3]) - points.row(triangle[(i + 2) % 3])).norm();
    };
    faces.push_back(distinctFace({triangle[0], triangle[1], triangle[2]}, {length(0), length(1), length(2)}));
  }
  mergeCopies(faces);
  return marchFaces(faces, static_cast<int>(points.rows()), 0, 0, workers);
}

/// The way through any of the faces at a vertex towards another one.
std::optional<Strip> wayTo(const MarchFaces& faces, const Points& points, int from, int to, double length) {
  const Eigen::Vector3d way = points.row(to) - points.row(from);
  for (int i = faces.corner_offset[from]; i < faces.corner_offset[from + 1]; ++i) {
    const int slot = faces.corner_slots[i];
    const Eigen::Vector3d next = points.row(faces.vertexAt(nextSide(slot))) - points.row(from),
                          previous = points.row(faces.vertexAt(previousSide(slot))) - points.row(from);
    const auto angle = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
      return std::atan2(a.cross(b).norm(), a.dot(b));
    };
    if (angle(next, way) + angle(way, previous) > angle(next, previous) + 1e-9) continue;
    if (auto strip = straightWay(faces, slot, angle(next, way), length, to, many)) return strip;
  }
  return {};
}

TEST(StraightWay, LeadsFromVertexToVertexOfAPlane) {
  const oracles::PlanarMesh mesh = oracles::obtuseSquare(120, 1, 101);
  const MarchFaces faces = facesOf(mesh.points, mesh.triangles);
  shapes::Random random(101);
  int found = 0;
  for (int i = 0; i < 200; ++i) {
    const auto draw = [&] { return static_cast<int>(random.uniform() * static_cast<double>(mesh.points.rows())); };
    const int from = draw(), to = draw();
    const double length = (mesh.points.row(to) - mesh.points.row(from)).norm();
    if (!(length > 0)) continue;
    EXPECT_FALSE(wayTo(faces, mesh.points, from, to, 0.9 * length)) << from << " to " << to;
    const auto strip = wayTo(faces, mesh.points, from, to, length);
    if (!strip) continue;  // along an edge
    ++found;
    EXPECT_EQ(faces.vertexAt(strip->start), from);
    EXPECT_EQ(faces.vertexAt(strip->end), to);
    const auto pieces = straighten(faces, *strip);
    ASSERT_EQ(pieces.size(), 1U);
    EXPECT_NEAR(pieces[0].length, length, 1e-12);
  }
  EXPECT_GE(found, 180);
}

/// Pages in the directions 0, 120 and 240 degrees about the z axis, each of one triangle with the spine from 0 to 1.
/// @param height of the points 2, 3 and 4, which are 1 away from it
shapes::Mesh book(double height) {
  shapes::Mesh book;
  book.points.resize(5, 3);
  book.points.row(0) << 0, 0, 0;
  book.points.row(1) << 0, 0, 1;
  for (int page = 0; page < 3; ++page) {
    const double turn = page * 2 * std::numbers::pi / 3;
    book.points.row(2 + page) << std::cos(turn), std::sin(turn), height;
  }
  book.triangles.resize(3, 3);
  book.triangles << 0, 1, 2, 0, 1, 3, 0, 1, 4;
  return book;
}

TEST(StraightWay, PassesAnEdgeOfThreePages) {
  const shapes::Mesh pages = book(0.5);
  const MarchFaces faces = facesOf(pages.points, pages.triangles);
  for (const int to : {3, 4}) {
    const int slot = faces.corner_slots[faces.corner_offset[2]];
    const double half = cornerAngle(faces, slot) / 2;
    const auto strip = straightWay(faces, slot, half, 2, to, many);
    ASSERT_TRUE(strip) << to;
    EXPECT_EQ(faces.vertexAt(strip->end), to);
    EXPECT_EQ(strip->doors.size(), 1U);
    EXPECT_FALSE(straightWay(faces, slot, half, 2, to, 0));
  }
}

// From page to page by the corner of a third one.
TEST(StraightWay, TakesThePlaceOfPiecesThatMeetInATriangle) {
  for (const double height : {0.1, 0.5, 0.9}) {
    const shapes::Mesh pages = book(height);
    const MarchFaces faces = facesOf(pages.points, pages.triangles);
    const auto cornerOf = [&](int vertex) { return faces.corner_slots[faces.corner_offset[vertex]]; };
    const auto pieceTo = [&](int from, int to) {
      const int leave = cornerOf(from), enter = cornerOf(to);
      const auto pieces = straighten(faces, {leave, enter, {doorBetween(faces, leave, enter)}});
      EXPECT_EQ(pieces.size(), 1U);
      return pieces.front();
    };
    for (const int to : {3, 4}) {
      const auto pieces = shortcutAt(faces, pieceTo(3, 2), pieceTo(2, to), false);
      ASSERT_TRUE(pieces) << height;
      EXPECT_NEAR(lengthOf(*pieces), to == 3 ? 0 : 2, 1e-12) << height;
    }
  }
}

TEST(StraightWay, EndsAtARim) {
  // A square from which a quarter is cut.
  const oracles::PlanarMesh mesh = oracles::obtuseSquare(400, 1, 102);
  std::vector<int> kept;
  for (int t = 0; t < mesh.triangles.rows(); ++t) {
    const Eigen::RowVector3d middle = mesh.points(mesh.triangles.row(t), Eigen::all).colwise().mean();
    if (!(middle.x() > 0.5 && middle.y() > 0.5)) kept.push_back(t);
  }
  const MarchFaces faces = facesOf(mesh.points, mesh.triangles(kept, Eigen::all));
  int out = 0;
  for (int from = 0; from < mesh.points.rows(); ++from) {
    for (int to = 0; to < mesh.points.rows(); to += 7) {
      const Eigen::RowVector3d middle = (mesh.points.row(from) + mesh.points.row(to)) / 2;
      if (!(middle.x() > 0.6 && middle.y() > 0.6)) continue;
      ++out;
      EXPECT_FALSE(wayTo(faces, mesh.points, from, to, (mesh.points.row(to) - mesh.points.row(from)).norm()));
    }
  }
  EXPECT_GE(out, 1000);
}

}  // namespace
}  // namespace tufted::straight_way_test
