// Maps between shapes whose answer is known: a sheet without symmetry and the same one rolled up, in another unit.
#include "tufted/shape_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "shapes/shapes.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::shape_maps_test {
namespace {

/// A quadrilateral without symmetry, of m x m squares.
shapes::Mesh sheet(int m) {
  shapes::Mesh mesh;
  mesh.points.resize((m + 1) * (m + 1), 3);
  mesh.triangles.resize(2 * m * m, 3);
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= m; ++i) {
      const double u = double(i) / m, v = double(j) / m;
      mesh.points.row(j * (m + 1) + i) << 2.6 * u - 0.7 * u * v, v + 0.3 * u * v, 0;
    }
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < m; ++i) {
      const int a = j * (m + 1) + i, c = a + m + 1;
      mesh.triangles.row(2 * (j * m + i)) << a, a + 1, c + 1;
      mesh.triangles.row(2 * (j * m + i) + 1) << a, c + 1, c;
    }
  return mesh;
}

struct Shape {
  Laplacian laplacian;
  Spectrum pairs;
  explicit Shape(Laplacian built, int k = 100) : laplacian(std::move(built)), pairs(spectrum(laplacian, k)) {}
  operator MappedShape() const { return {laplacian, pairs}; }
};

class ShapeMaps : public testing::Test {
 protected:
  static Shape flat() {
    const shapes::Mesh mesh = sheet(25);
    return Shape(meshLaplacian(mesh.points, mesh.triangles));
  }
  /// Rolled up, in a unit of which 5 make one; its points run the other way.
  static Shape rolled() {
    const shapes::Mesh mesh = sheet(25);
    const int n = static_cast<int>(mesh.points.rows());
    Points points(n, 3);
    for (int i = 0; i < n; ++i) {
      const auto& at = mesh.points.row(n - 1 - i);
      points.row(i) << 5 * std::sin(at.x()), 5 * at.y(), 5 * std::cos(at.x());
    }
    const Triangles triangles = (n - 1 - mesh.triangles.array()).matrix();
    return Shape(meshLaplacian(points, triangles));
  }
};

TEST_F(ShapeMaps, OfARolledSheetAreRightPointByPoint) {
  const Shape a = flat(), b = rolled();
  const Eigen::MatrixXd C = functionalMap(a, b);
  EXPECT_LT((C.cwiseAbs() - Eigen::MatrixXd::Identity(30, 30)).cwiseAbs().maxCoeff(), 0.15);
  for (const int samples : {300, 0}) {
    const PointMaps maps = pointMaps(a, b, zoomOut(a, b, C, {.k = 60, .step = 3, .samples = samples}));
    for (std::size_t i = 0; i < maps.to_target.size(); ++i) {
      EXPECT_EQ(maps.to_target[i], std::ssize(maps.to_target) - 1 - static_cast<int>(i));
      EXPECT_EQ(maps.to_source[i], maps.to_target[i]);
    }
  }
}

TEST_F(ShapeMaps, HaveTheSameBitsForAnyNumberOfThreads) {
  const Shape a = flat(), b = rolled();
  const Eigen::MatrixXd C = functionalMap(a, b);
  const Eigen::MatrixXd one = zoomOut(a, b, C, {.k = 40, .threads = 1}),
                        two = zoomOut(a, b, C, {.k = 40, .threads = 2});
  EXPECT_EQ(one, two);
  EXPECT_EQ(pointMaps(a, b, one, 1).to_source, pointMaps(a, b, one, 2).to_source);
}

TEST_F(ShapeMaps, ZoomOutStartsFromAFewPoints) {
  const Shape a = flat(), b = rolled();
  const int n = static_cast<int>(a.laplacian.status.size());
  std::vector<int> to_source(static_cast<std::size_t>(n), -1);
  for (int i = 0; i < n; i += 40) to_source[i] = n - 1 - i;
  const PointMaps maps = pointMaps(a, b, zoomOut(a, b, to_source, {.k = 60, .samples = 200}));
  for (int i = 0; i < n; ++i) EXPECT_EQ(maps.to_source[i], n - 1 - i);
}

TEST_F(ShapeMaps, DoNotDependOnTheUnitOfDescriptors) {
  const Shape a = flat(), b = rolled();
  const Eigen::MatrixXd x = a.laplacian.positions, y = x.colwise().reverse();
  const auto map = [&](double unit) {
    return functionalMap(a, b, {.source_descriptors = unit * x, .target_descriptors = unit * y});
  };
  for (const double unit : {0x1p-600, 0x1p600}) EXPECT_EQ(map(unit), map(1)) << unit;
}

TEST_F(ShapeMaps, LeaveOutPointsThatTakeNoPart) {
  Points points = shapes::torus(800).points;
  points.conservativeResize(803, 3);
  points.row(800) = points.row(3);
  points.row(801).setConstant(std::nan(""));
  points.row(802).setConstant(99);
  const Shape whole(pointCloudLaplacian(shapes::torus(800).points)), odd(pointCloudLaplacian(points));
  const PointMaps maps =
      pointMaps(whole, odd, functionalMap(whole, odd, {.landmarks = {{0, 0}, {90, 90}, {300, 300}}}));
  EXPECT_EQ(maps.to_source[801], -1);
  EXPECT_EQ(maps.to_source[802], -1);
  EXPECT_EQ(maps.to_source[800], maps.to_source[3]);
  EXPECT_EQ(maps.to_source, pointMaps(whole, odd, Eigen::MatrixXd::Identity(40, 40)).to_source);
}

TEST_F(ShapeMaps, NameMistakes) {
  const Shape a = flat();
  const Eigen::MatrixXd C = Eigen::MatrixXd::Identity(3, 3), one = a.laplacian.M;
  const auto refuses = [](const auto& call, const std::string& words) {
    EXPECT_NE(support::refusal(call).find(words), std::string::npos) << support::refusal(call);
  };
  refuses([&] { functionalMap(a, a, {.k = 0}); }, "functionalMap: k = 0, must be at least 1");
  refuses([&] { functionalMap(a, a, {.commutativity = std::nan("")}); }, "commutativity = nan, must be finite");
  refuses([&] { functionalMap(a, a, {.source_descriptors = one}); }, "descriptors have 1 and 0 columns");
  refuses([&] { functionalMap(a, a, {.source_descriptors = C, .target_descriptors = C}); },
          "have 3 rows, must have 676");
  refuses([&] { functionalMap(a, a, {.source_descriptors = one, .target_descriptors = 0 * one}); },
          "no column that is");
  refuses([&] { functionalMap(a, a, {.weights = VectorXd::Ones(2)}); }, "weights has 2 values, must have 0");
  refuses([&] { functionalMap(a, a, {.landmarks = {{0, 676}}}); }, "landmarks has 676, must lie in [0, 676)");
  Laplacian without = a.laplacian;
  without.positions.resize(0, 3);
  refuses([&] { zoomOut({without, a.pairs}, a, C); }, "zoomOut: Laplacian::positions has 0 rows");
  refuses([&] { zoomOut(a, a, C, {.step = 0}); }, "zoomOut: step = 0, must be at least 1");
  refuses([&] { zoomOut(a, a, C, {.samples = -1}); }, "samples = -1, must be at least 0");
  refuses([&] { zoomOut(a, a, std::vector<int>(3)); }, "to_source has 3 indices, must have 676");
  refuses([&] { zoomOut(a, a, std::vector<int>(676, 676)); }, "to_source has 676, must be below 676");
  refuses([&] { zoomOut(a, a, std::vector<int>(676, -1)); }, "to_source has no index of at least 0");
  refuses([&] { pointMaps(a, a, C.topRows(2)); }, "pointMaps: C is 2 x 3, must be k x k");
  refuses([&] { pointMaps(a, a, C / 0); }, "C has a value that is not finite");
  refuses([&] { pointMaps({a.laplacian, Spectrum()}, a, C); }, "the spectrum of the source has 0 values");
}

}  // namespace
}  // namespace tufted::shape_maps_test
