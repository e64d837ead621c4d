// What the algorithms reach on large clouds, on badly triangulated models and on real data.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "oracles/classic_heat.h"
#include "oracles/oracles.h"
#include "oracles/planar.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "support/compare.h"
#include "support/overshoot.h"
#include "tufted/tufted.h"
#ifdef TUFTED_DATA_DIR
#include "tufted/io/read.h"
#endif

namespace tufted::applications_test {
namespace {

using support::meanError;

TEST(Applications, DistanceOnASphereIsAsGoodAsThatOfTheHull) {
  const Points points = shapes::sphere(16000).points;
  const Laplacian cloud = pointCloudLaplacian(points), hull = meshLaplacian(points, oracles::convexHullMesh(points));
  struct Bound {
    DistanceMethod method;
    double error, difference;  ///< mean error; of the two errors, in parts of the hull's
  };
  for (const Bound& bound : {Bound{DistanceMethod::heat, 0.017, 0.02}, Bound{DistanceMethod::marching, 0.001, 0.1}}) {
    const DistanceSolver of_cloud(cloud, {.method = bound.method}), of_hull(hull, {.method = bound.method});
    for (const int source : {0, 100, 5000}) {
      const VectorXd exact = shapes::sphereDistances(points, source);
      const double ours = meanError(of_cloud.query({source}), exact),
                   theirs = meanError(of_hull.query({source}), exact);
      EXPECT_LE(ours, bound.error) << source;
      EXPECT_NEAR(ours, theirs, bound.difference * theirs) << source;
    }
  }
}

TEST(Applications, GreensFunctionOfALargeSphere) {
  const int n = 64000;
  const Points points = shapes::sphere(n).points;
  const Laplacian laplacian = pointCloudLaplacian(points, {.keep_cover = false});
  const double edge = std::sqrt(laplacian.report.mean_squared_edge);
  const Eigen::MatrixXd g = greensFunction(laplacian, {0, 20000});
  for (int k = 0; k < 2; ++k) {
    const int source = k == 0 ? 0 : 20000;
    double square = 0;
    for (int i = 0; i < n; ++i) {
      const double chord = (points.row(i) - points.row(source)).norm();
      if (chord < 4 * edge) continue;
      const double exact = -(std::log(chord * chord / 4) + 1) / (4 * M_PI);
      square += laplacian.M[i] * (g(i, k) - exact) * (g(i, k) - exact);
    }
    EXPECT_LE(std::sqrt(square), 7e-4) << source;
  }
}

TEST(Applications, DistanceOnABadNonmanifoldModelIsNearerThanByCotan) {
  // Figure 16, on pages that meet at a spine, in slivers.
  for (const double stretch : {4.0, 16.0}) {
    const oracles::Book book = oracles::badBook(3, 40, stretch, 1);
    const int source = 41 + 500;  // inside the first page
    const VectorXd exact = oracles::bookDistances(book, source);
    const VectorXd ours = DistanceSolver(meshLaplacian(book.points, book.triangles)).query({source});
    const VectorXd cotan = oracles::classicHeatDistances(book.points, book.triangles, source);
    EXPECT_LE(meanError(ours, exact), 0.03) << stretch;
    EXPECT_LE(3 * meanError(ours, exact), meanError(cotan, exact)) << stretch;
  }
}

#ifdef TUFTED_DATA_DIR
TEST(Applications, HarmonicFunctionsStayWithinTheirPinsOnRealData) {
  int files = 0;
  for (const char* folder : {"/clouds", "/meshes"}) {
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(TUFTED_DATA_DIR + std::string(folder), error)) {
      const Geometry geometry = read(entry.path());
      const Laplacian laplacian = geometry.is_mesh
                                      ? meshLaplacian(geometry.points, geometry.triangles, {.keep_cover = false})
                                      : pointCloudLaplacian(geometry.points, {.keep_cover = false});
      std::vector<int> active;
      for (std::size_t i = 0; i < laplacian.status.size(); ++i) {
        if (laplacian.status[i] == PointStatus::active) active.push_back(static_cast<int>(i));
      }
      ASSERT_FALSE(active.empty()) << entry.path();
      shapes::Random random(static_cast<std::uint64_t>(++files));
      const int count = files % 2 == 0 ? 3 : 100;
      Pins pins{{}, Eigen::MatrixXd(count, 2)};
      for (int k = 0; k < count; ++k)
        pins.points.push_back(active[static_cast<std::size_t>(random.uniform(0, static_cast<double>(active.size())))]);
      for (double& value : pins.values.reshaped()) value = random.uniform(-1, 3);
      EXPECT_LE(support::overshoot(laplacian, harmonic(laplacian, pins), pins), 1e-12) << entry.path() << " " << count;
    }
  }
  if (files == 0) GTEST_SKIP() << "no folder " << TUFTED_DATA_DIR;
}
#endif

}  // namespace
}  // namespace tufted::applications_test
