// Maps of long tubes, whose scale falls until triangles collapse.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "shapes/shapes.h"
#include "support/joined_meshes.h"
#include "support/maps.h"
#include "support/refusal.h"
#include "tufted/errors.h"

namespace tufted::collapsing_map_test {
namespace {

using Eigen::MatrixX2d;
using support::mapMesh;
using support::mean_value;
using support::refusal;
using support::tutte;

/// A tube of radius 1 along z, of `rings` rings of 24 points; the first one may be closed by a point.
shapes::Mesh tube(int rings, double length, bool is_closed) {
  const int sides = 24;
  shapes::Mesh mesh;
  mesh.points.resize(sides * rings + (is_closed ? 1 : 0), 3);
  mesh.triangles.resize(2 * sides * (rings - 1) + (is_closed ? sides : 0), 3);
  const auto at = [](int ring, int side) { return sides * ring + side % sides; };
  Eigen::Index t = 0;
  for (int ring = 0; ring < rings; ++ring) {
    for (int side = 0; side < sides; ++side) {
      const double angle = 2 * M_PI * side / sides;
      mesh.points.row(at(ring, side)) << std::cos(angle), std::sin(angle), length * ring / (rings - 1);
      if (ring + 1 == rings) continue;
      mesh.triangles.row(t++) << at(ring, side), at(ring, side + 1), at(ring + 1, side + 1);
      mesh.triangles.row(t++) << at(ring, side), at(ring + 1, side + 1), at(ring + 1, side);
    }
  }
  for (int side = 0; is_closed && side < sides; ++side)
    mesh.triangles.row(t++) << at(0, side + 1), at(0, side), sides * rings;
  if (is_closed) mesh.points.bottomRows<1>().setZero();
  return mesh;
}

/// Triangles whose height in the plane is below 1e-7 of the map's radius.
std::int64_t lowTriangles(const shapes::Mesh& mesh, const MatrixX2d& uv) {
  const double extent = (uv.colwise().maxCoeff() - uv.colwise().minCoeff()).maxCoeff() / 2;
  std::int64_t count = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const auto side = [&](int a, int b) -> Eigen::RowVector2d {
      return uv.row(mesh.triangles(t, b)) - uv.row(mesh.triangles(t, a));
    };
    const double twice = std::abs(side(0, 1).x() * side(0, 2).y() - side(0, 1).y() * side(0, 2).x());
    const double longest = std::max({side(0, 1).norm(), side(1, 2).norm(), side(2, 0).norm()});
    count += twice <= 1e-7 * extent * longest ? 1 : 0;
  }
  return count;
}

TEST(Parameterize, RefusesTubesThatAreTooLong) {
  for (const bool is_closed : {false, true}) {
    const shapes::Mesh stub = tube(40, 10, is_closed);
    ParameterizationReport report;
    const MatrixX2d uv = mapMesh(stub, {}, &report);
    EXPECT_TRUE(uv.allFinite());
    EXPECT_EQ(report.collapsed, 0);
    EXPECT_EQ(lowTriangles(stub, uv), 0);
    for (const double length : {35., 52., 100., 400., 2000.}) {
      std::string why;
      try {
        why = refusal([&] { mapMesh(tube(200, length, is_closed)); });
      } catch (const SolverFailure&) {
        continue;  // the scales of the map leave doubles, which the check of the solution may see first
      }
      EXPECT_NE(why.find("is too long for its rims: "), std::string::npos) << length << why;
    }
  }
}

TEST(Parameterize, LeavesOutPartsThatCollapse) {
  const shapes::Mesh square = shapes::gridSquare(100), pole = tube(200, 52, false);  // the square is larger
  ParameterizationReport report;
  const MatrixX2d uv = mapMesh(support::joined(square, pole, {9, 0, 0}), {}, &report);
  EXPECT_EQ(report.charts, 1);
  EXPECT_EQ(report.rims, 1);
  EXPECT_EQ(report.collapsed_charts, 1);
  EXPECT_EQ(report.not_mapped, pole.points.rows());
  EXPECT_EQ(report.triangles, square.triangles.rows());
  EXPECT_TRUE(uv.topRows(square.points.rows()).allFinite());
  EXPECT_TRUE(uv.bottomRows(pole.points.rows()).array().isNaN().all());
}

TEST(Parameterize, CountsTrianglesThatCollapse) {
  const shapes::Mesh finger = tube(150, 39, true);  // in a harmonic map, too, the scale falls by e within each radius
  for (const ParameterizationOptions& options : {tutte, mean_value}) {
    ParameterizationReport report;
    const auto low = static_cast<double>(lowTriangles(finger, mapMesh(finger, options, &report)));
    EXPECT_GT(low, 1000);
    EXPECT_NEAR(static_cast<double>(report.collapsed), low, 0.05 * low);  // another measure of the extent
    EXPECT_EQ(report.flipped, 0);
  }
  // Needles that are as low on the surface are none.
  shapes::Mesh flat = shapes::gridSquare(10);
  flat.points.row(60) = flat.points.row(61) + Eigen::RowVector3d(-1e-9, 0, 0);
  ParameterizationReport report;
  mapMesh(flat, {}, &report);
  EXPECT_EQ(report.collapsed, 0);
}

}  // namespace
}  // namespace tufted::collapsing_map_test
