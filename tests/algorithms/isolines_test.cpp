// Isolines: plane sections of closed surfaces, lengths by brute force, topology, and typed errors.
#include "tufted/isolines.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "shapes/random.h"
#include "shapes/shapes.h"
#include "support/refusal.h"

namespace tufted::isolines_test {
namespace {

constexpr double pi = std::numbers::pi;

double lengthOf(const std::vector<Polyline>& lines) {
  double sum = 0;
  for (const Polyline& line : lines) sum += line.length;
  return sum;
}

int closedOf(const std::vector<Polyline>& lines) {
  return static_cast<int>(
      std::count_if(lines.begin(), lines.end(), [](const Polyline& line) { return line.is_closed; }));
}

/// The length of a line within one triangle, found by cutting all three sides.
double lengthIn(const shapes::Mesh& mesh, Eigen::Index face, const VectorXd& field, double value) {
  std::vector<Eigen::RowVector3d> places;
  for (int k = 0; k < 3; ++k) {
    const int a = mesh.triangles(face, k), b = mesh.triangles(face, (k + 1) % 3);
    if ((field[a] < value) == (field[b] < value)) continue;
    const double share = (value - field[a]) / (field[b] - field[a]);
    places.emplace_back(mesh.points.row(a) + share * (mesh.points.row(b) - mesh.points.row(a)));
  }
  return places.size() == 2 ? (places[1] - places[0]).norm() : 0;
}

/// A coordinate is linear in space, so its isolines are the plane sections of the triangles.
TEST(Isolines, OfACoordinateOnASphereAreCircles) {
  for (const int subdivisions : {2, 3, 4}) {
    const shapes::Mesh mesh = shapes::icosphere(subdivisions);
    double longest = 0;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
      longest =
          std::max(longest, (mesh.points.row(mesh.triangles(f, 0)) - mesh.points.row(mesh.triangles(f, 1))).norm());
    for (const double height : {0.0, 0.3, -0.7}) {  // 0 is the height of vertices, too
      const std::vector<Polyline> lines = isolines(mesh.points, mesh.triangles, mesh.points.col(2), {height});
      ASSERT_EQ(lines.size(), 1u);
      EXPECT_TRUE(lines[0].is_closed);
      const double circle = 2 * pi * std::sqrt(1 - height * height);
      EXPECT_LT(lines[0].length, circle);
      EXPECT_GT(lines[0].length, circle * (1 - longest * longest / (1 - height * height)));
      const Points& points = lines[0].points;
      for (Eigen::Index i = 0; i < points.rows(); ++i) {
        EXPECT_NEAR(points(i, 2), height, 1e-15);
        // The points lie on edges, which are chords of the sphere.
        EXPECT_GT(points.row(i).norm(), std::sqrt(1 - longest * longest / 4) - 1e-12);
        EXPECT_LT(points.row(i).norm(), 1 + 1e-12);
        // Larger values are on the left as seen from outside: the line runs around the z axis counterclockwise.
        const Eigen::RowVector3d next = points.row((i + 1) % points.rows()), here = points.row(i);
        EXPECT_GT(here.cross(next).z(), 0);
      }
    }
  }
}

TEST(Isolines, AreAllClosedOnClosedSurfacesAndAsLongAsTheirPieces) {
  const std::vector<shapes::Mesh> meshes = {shapes::icosphere(2), shapes::cubeMesh(5, shapes::Quality::good),
                                            shapes::kleinBottle(10), shapes::tetrahedron()};
  for (const shapes::Mesh& mesh : meshes) {
    shapes::Random random(101);
    VectorXd field(mesh.points.rows());
    for (double& value : field) value = random.below(5);  // most values below are those of vertices
    for (const double value : {0.0, 1.0, 1.5, 2.0, 3.0, 4.0}) {
      const std::vector<Polyline> lines = isolines(mesh.points, mesh.triangles, field, {value});
      EXPECT_EQ(closedOf(lines), std::ssize(lines)) << mesh.name << value;
      double length = 0;
      for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) length += lengthIn(mesh, f, field, value);
      EXPECT_NEAR(lengthOf(lines), length, 1e-12 * (1 + length)) << mesh.name << value;
      EXPECT_EQ(lines.empty(), length == 0) << mesh.name << value;
    }
  }
}

TEST(Isolines, EndAtRimsAndRunStraightInThePlane) {
  const shapes::Mesh grid = shapes::gridSquare(8);
  const VectorXd field = 3 * grid.points.col(0) - 4 * grid.points.col(1);
  const std::vector<Polyline> lines = isolines(grid.points, grid.triangles, field, {0.5, 0, -3.25, 7});
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(closedOf(lines), 0);
  // The ends of 3 x - 4 y = c in the unit square.
  const std::vector<double> lengths = {std::hypot(5 / 6.0, 5 / 8.0), std::hypot(1, 0.75), std::hypot(0.25, 3 / 16.0)};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(lines[k].length, lengths[k], 1e-14);
    const VectorXd values = 3 * lines[k].points.col(0) - 4 * lines[k].points.col(1);
    EXPECT_LT((values.array() - lines[k].value).abs().maxCoeff(), 1e-14);
    // Larger values, towards +x, are on the left.
    EXPECT_LT(lines[k].points(lines[k].points.rows() - 1, 1), lines[k].points(0, 1));
  }
}

TEST(Isolines, EndWhereMoreThanTwoTrianglesMeet) {
  const shapes::Mesh book = shapes::book(3, 4);
  const VectorXd along = book.points.col(2);
  const double between = (along.maxCoeff() + along.minCoeff()) / 2 + 0.03;
  const std::vector<Polyline> lines = isolines(book.points, book.triangles, along, {between});
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(closedOf(lines), 0);
  for (const Polyline& line : lines) EXPECT_NEAR(line.length, 1, 1e-12);
}

TEST(Isolines, LeaveOutPointsAndWhatIsNotFinite) {
  const shapes::Mesh grid = shapes::gridSquare(8);
  VectorXd field = VectorXd::Zero(grid.points.rows());
  field[40] = 1;  // the middle
  EXPECT_TRUE(isolines(grid.points, grid.triangles, field, {1}).empty());
  EXPECT_EQ(closedOf(isolines(grid.points, grid.triangles, field, {0.5})), 1);
  EXPECT_TRUE(isolines(grid.points, grid.triangles, field, {}).empty());
  EXPECT_TRUE(isolines(Points(0, 3), Triangles(0, 3), VectorXd(0), {0.5}).empty());

  field = grid.points.col(0);
  field[40] = std::numeric_limits<double>::quiet_NaN();  // its six triangles lie on both sides of x = 0.45
  const std::vector<Polyline> cut = isolines(grid.points, grid.triangles, field, {0.45});
  EXPECT_EQ(cut.size(), 2u);
  EXPECT_LT(lengthOf(cut), 1 - 0.125);
  for (const Polyline& line : cut) EXPECT_TRUE(line.points.allFinite());
  field.setConstant(std::numeric_limits<double>::infinity());
  EXPECT_TRUE(isolines(grid.points, grid.triangles, field, {0.45}).empty());
  // Differences of these values overflow.
  field = (grid.points.col(0).array() > 0.5).select(VectorXd::Constant(81, 1.5e308), VectorXd::Constant(81, -1.5e308));
  EXPECT_NEAR(lengthOf(isolines(grid.points, grid.triangles, field, {0})), 1, 0.5);
}

TEST(Isolines, RefuseWhatDoesNotFit) {
  const shapes::Mesh mesh = shapes::tetrahedron();
  const VectorXd field = VectorXd::Zero(4);
  EXPECT_EQ(support::refusal([&] { isolines(mesh.points, mesh.triangles, VectorXd::Zero(3), {0}); }),
            "isolines: field has 3 values, must have 4");
  EXPECT_EQ(support::refusal([&] {
              isolines(mesh.points, mesh.triangles, field, {0, NAN});
            }),
            "isolines: value 1 is not finite, must be");
  EXPECT_EQ(support::refusal([&] {
              isolines(mesh.points, Triangles{{0, 1, 4}}, field, {0});
            }),
            "isolines: corner 4 of triangle 0, must lie in [0, 4)");
  EXPECT_THROW(isolines(mesh.points, mesh.triangles, field, {0}, [](auto, auto) { return false; }), Cancelled);
}

}  // namespace
}  // namespace tufted::isolines_test
