// Minimal surfaces: planes, the catenoid, hulls of neighbours, odd data, and what callers get wrong.
#include "tufted/minimal_surface.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "shapes/shapes.h"
#include "support/defined_values.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::minimal_surface_test {
namespace {

using support::refusal;

/// A tube of rings of radius 1 at z = -0.5 and 0.5, whose middle is pinched and dented.
/// @param unevenness part of a step by which points inside are moved along the surface at random
shapes::Mesh tube(int around, int along, double unevenness = 0) {
  shapes::Mesh mesh;
  mesh.points.resize(Eigen::Index{around} * (along + 1), 3);
  std::uint64_t state = 1;
  const auto random = [&] {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return static_cast<double>(state >> 11) * 0x1p-53 - 0.5;
  };
  for (int j = 0; j <= along; ++j) {
    const bool is_rim = j == 0 || j == along;
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * M_PI * (i + (is_rim ? 0 : unevenness * random())) / around;
      const double z = (j + (is_rim ? 0 : unevenness * random())) / along - 0.5;
      const double pinch = 1 - 0.5 * std::cos(M_PI * z),
                   radius = is_rim ? 1 : pinch * (1 + 0.2 * std::sin(3 * angle + 5 * z));
      mesh.points.row(Eigen::Index{j} * around + i) << radius * std::cos(angle), radius * std::sin(angle), z;
    }
  }
  mesh.triangles.resize(Eigen::Index{2} * around * along, 3);
  for (int j = 0, t = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      const int a = j * around + i, b = j * around + (i + 1) % around;
      mesh.triangles.row(t++) << a, b, b + around;
      mesh.triangles.row(t++) << a, b + around, a + around;
    }
  return mesh;
}

/// The radius of the catenoid between these rings at a height: c cosh(z / c), c cosh(0.5 / c) = 1.
double catenoidRadius(double z) {
  double c = 0.85;
  for (int k = 0; k < 50; ++k) c -= (c * std::cosh(0.5 / c) - 1) / (std::cosh(0.5 / c) - 0.5 / c * std::sinh(0.5 / c));
  return c * std::cosh(z / c);
}

Points minimal(const shapes::Mesh& mesh, const MinimalSurfaceOptions& options = {},
               MinimalSurfaceReport* report = nullptr) {
  return minimalSurface(meshLaplacian(mesh.points, mesh.triangles), mesh.triangles, options, report);
}

TEST(MinimalSurface, BetweenTwoRingsIsACatenoid) {
  for (const double unevenness : {0.0, 0.9}) {
    MinimalSurfaceReport report;
    const Points x = minimal(tube(60, 24, unevenness), {}, &report);
    EXPECT_TRUE(report.converged);
    EXPECT_LE(report.iterations, 40);
    EXPECT_EQ(report.fixed, 120);
    EXPECT_EQ(report.moved, 60 * 23);
    for (const auto& p : x.rowwise())
      EXPECT_NEAR(p.head<2>().norm(), catenoidRadius(p.z()), 0.01 * catenoidRadius(p.z()))
          << unevenness << ' ' << p.z();
    EXPECT_LT(report.area, report.area_before);
    EXPECT_LT(report.area, 2 * M_PI);  // a straight tube has that
  }
}

TEST(MinimalSurface, PutsEachPointWithinTheHullOfItsNeighbours) {
  const shapes::Mesh mesh = tube(60, 24, 0.9);
  const Points x = minimal(mesh);
  const Laplacian there = meshLaplacian(x, mesh.triangles);
  for (int i = 60; i < 60 * 24; ++i) {
    Eigen::RowVector3d mean = Eigen::RowVector3d::Zero();
    double sum = 0;
    for (SparseMatrix::InnerIterator entry(there.L, i); entry; ++entry) {
      if (entry.row() == i) continue;
      ASSERT_LE(entry.value(), 0);
      mean -= entry.value() * x.row(entry.row());
      sum -= entry.value();
    }
    EXPECT_LE((mean / sum - x.row(i)).norm(), 1e-3) << i;
  }
}

TEST(MinimalSurface, WithAFlatRimIsFlat) {
  shapes::Mesh mesh = shapes::gridSquare(12);
  const Points flat = mesh.points;
  for (auto&& p : mesh.points.rowwise()) p.z() = std::sin(M_PI * p.x()) * std::sin(M_PI * p.y());
  MinimalSurfaceReport report;
  const Points x = minimal(mesh, {}, &report);
  EXPECT_LE(x.col(2).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_NEAR(report.area, 1, 1e-6);
  EXPECT_EQ(report.fixed, 48);
}

TEST(MinimalSurface, KeepsGivenPointsInPlace) {
  shapes::Mesh mesh = shapes::gridSquare(12);
  std::vector<int> fixed;
  for (int i = 0; i < 169; ++i)
    if (i % 13 == 0 || i % 13 == 12 || i < 13 || i > 155) fixed.push_back(i);
  fixed.push_back(84);
  mesh.points(84, 2) = 0.3;
  const Points x = minimal(mesh, {.fixed = fixed});
  EXPECT_EQ(x(fixed, Eigen::all), mesh.points(fixed, Eigen::all));
  for (const int i : {83, 85, 71, 97}) EXPECT_LE(x(i, 2), 0.01);  // a single point holds nothing up: it has no length
  // Between single points there is no surface of least area, only lines.
  EXPECT_THROW(minimal(mesh, {.fixed = {0, 12, 168, 156, 84}}), SolverFailure);
}

TEST(MinimalSurface, OfACloudIsThatOfItsTriangles) {
  const shapes::Cloud disk = shapes::disk(1500);
  Points points = disk.points;
  for (auto&& p : points.rowwise()) p.z() = 0.3 * (1 - p.head<2>().squaredNorm());
  const Laplacian laplacian = pointCloudLaplacian(points);
  MinimalSurfaceReport report;
  const Points x = minimalSurface(laplacian, surfaceTriangles(laplacian), {}, &report);
  // The rim of the cloud is jagged, so it is the rim's heights that bound it.
  double low = 1;
  for (int i = 0; i < 1500; ++i)
    if (x.row(i) == points.row(i)) low = std::min(low, points(i, 2));
  EXPECT_TRUE(report.converged);
  EXPECT_GE(x.col(2).minCoeff(), low - 1e-9);
  EXPECT_LE(x.col(2).maxCoeff(), 0.05);
  EXPECT_LT(report.area, 0.95 * report.area_before);
}

TEST(MinimalSurface, DoesNotDependOnUnitPlaceOrThreads) {
  const shapes::Mesh mesh = tube(16, 8);
  const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
  const Points x = minimalSurface(laplacian, mesh.triangles);
  for (const int threads : {1, 3})
    EXPECT_EQ(minimalSurface(laplacian, mesh.triangles, {.solver = {.threads = threads}}), x) << threads;
  for (const int exponent : {400, -400}) {
    shapes::Mesh scaled = mesh;
    scaled.points *= std::ldexp(1, exponent);
    EXPECT_EQ(minimal(scaled) * std::ldexp(1, -exponent), x) << exponent;
  }
  shapes::Mesh far = mesh;
  const Eigen::RowVector3d offset(1e5, -1e5, 3e5);
  far.points.rowwise() += offset;
  EXPECT_LE((minimal(far).rowwise() - offset - x).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(MinimalSurface, LeavesWhatHasNoRimInPlace) {
  shapes::Mesh mesh = shapes::severalComponents();  // icosphere, square, tetrahedron
  mesh.points.conservativeResize(mesh.points.rows() + 1, 3);
  mesh.points.bottomRows(1).setConstant(NAN);
  MinimalSurfaceReport report;
  const Points x = minimal(mesh, {}, &report);
  EXPECT_GT(report.floating, 4);
  EXPECT_TRUE(x.bottomRows(1).array().isNaN().all());
  EXPECT_LE((x - mesh.points).topRows(x.rows() - 1).cwiseAbs().maxCoeff(), 1e-6);  // the square is flat
  EXPECT_EQ(x.topRows(10), mesh.points.topRows(10));
}

TEST(MinimalSurface, GivesOddMeshesADefinedResult) {
  for (const shapes::Mesh& mesh :
       {shapes::slivers(8), shapes::zeroLengthEdges(6), shapes::repeatedVertices(6), shapes::unreferencedVertices(6),
        shapes::duplicateTriangles(6), shapes::mixedOrientation(6), shapes::bowTie(), shapes::bowTieCones(5),
        shapes::moebius(6), shapes::book(3, 4), shapes::fins(8)}) {
    const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
    MinimalSurfaceReport report;
    const Points x = minimalSurface(laplacian, mesh.triangles, {}, &report);
    EXPECT_TRUE(x.allFinite()) << mesh.name;
    EXPECT_LE(report.area, report.area_before * (1 + 1e-9)) << mesh.name;
  }
}

TEST(MinimalSurface, NamesWhatACallerGotWrong) {
  const shapes::Mesh square = shapes::gridSquare(4);
  const auto why = [&](const MinimalSurfaceOptions& options) { return refusal([&] { minimal(square, options); }); };
  EXPECT_EQ(why({.fixed = {0, 25}}), "minimalSurface: fixed has 25, must lie in [0, 25)");
  EXPECT_EQ(why({.tolerance = 0}), "minimalSurface: tolerance = 0, must be finite and above 0");
  EXPECT_EQ(why({.max_iterations = 0}), "minimalSurface: max_iterations = 0, must be at least 1");
  EXPECT_EQ(refusal([] { minimal(shapes::icosphere(1)); }),
            "minimalSurface: the surface has no rim, so points that stay in place must be given");
  const Laplacian laplacian = meshLaplacian(square.points, square.triangles);
  EXPECT_EQ(refusal([&] { minimalSurface(laplacian, Triangles(0, 3)); }),
            "minimalSurface: no triangle has three different active points, must be at least one");
  EXPECT_THROW(minimal(square, {.solver = {.progress = [](std::string_view, double) { return false; }}}), Cancelled);
}

}  // namespace
}  // namespace tufted::minimal_surface_test
