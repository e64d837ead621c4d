// Maps to the plane: similarities, discs, surfaces that no plane can hold, odd data.
#include "tufted/parameterization.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

#include "shapes/shapes.h"
#include "support/defined_values.h"
#include "support/joined_meshes.h"
#include "support/maps.h"
#include "support/odd_cloud.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::parameterization_test {
namespace {

using Eigen::MatrixX2d;
using support::mapMesh;
using support::mean_value;
using support::refusal;
using support::tutte;

/// Half of an icosphere.
shapes::Mesh hemisphere(int subdivisions) {
  shapes::Mesh mesh = shapes::icosphere(subdivisions);
  Triangles kept(0, 3);
  for (int t = 0; t < mesh.triangles.rows(); ++t) {
    double height = 0;
    for (const int i : mesh.triangles.row(t)) height += mesh.points(i, 2);
    if (height < 0) continue;
    kept.conservativeResize(kept.rows() + 1, 3);
    kept.bottomRows(1) = mesh.triangles.row(t);
  }
  mesh.triangles = kept;
  return mesh;
}

/// The part of uv that no similarity of flat positions explains, in the size of uv.
double strain(const Points& flat, const MatrixX2d& uv) {
  Eigen::VectorXcd z(uv.rows()), w(uv.rows());
  for (int i = 0; i < uv.rows(); ++i) {
    z[i] = {flat(i, 0), flat(i, 1)};
    w[i] = {uv(i, 0), uv(i, 1)};
  }
  z.array() -= z.mean();
  w.array() -= w.mean();
  const std::complex<double> factor = z.dot(w) / z.squaredNorm();
  return (w - factor * z).norm() / w.norm();
}

TEST(Conformal, IsASimilarityOfAPlaneMesh) {
  const shapes::Mesh square = shapes::gridSquare(20);
  ParameterizationReport report;
  const MatrixX2d uv = mapMesh(square, {}, &report);
  EXPECT_LE(strain(square.points, uv), 1e-9);
  EXPECT_NEAR(report.quasi_conformal_error, 1, 1e-8);
  EXPECT_EQ(report.flipped, 0);
  EXPECT_EQ(report.triangles, 800);
  EXPECT_NEAR((uv.row(0) - uv.row(20)).norm(), 1, 1e-8);  // a side, as areas are kept
}

TEST(Conformal, IsASimilarityOfAPlaneCloud) {
  const Points points = shapes::disk(2000).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const MatrixX2d uv = parameterize(laplacian, surfaceTriangles(laplacian));
  ASSERT_TRUE(uv.allFinite());
  EXPECT_LE(std::min(strain(points, uv), strain(points * Eigen::DiagonalMatrix<double, 3>(-1, 1, 1), uv)), 1e-6);
}

TEST(Conformal, KeepsTheAnglesOfAHemisphereTheBetterTheFinerItIs) {
  double last = 1;
  for (const int subdivisions : {2, 3, 4}) {
    ParameterizationReport report;
    mapMesh(hemisphere(subdivisions), {}, &report);
    EXPECT_LE(report.quasi_conformal_error - 1, last / 1.8) << subdivisions;
    EXPECT_EQ(report.flipped, 0) << subdivisions;
    last = report.quasi_conformal_error - 1;
  }
}

TEST(Conformal, MapsAnyNumberOfRims) {
  const shapes::Mesh square = shapes::gridSquare(12);
  Triangles kept(0, 3);
  for (int t = 0; t < square.triangles.rows(); ++t) {
    const int cell = t / 2, x = cell % 12, y = cell / 12;
    if ((x == 3 || x == 8) && (y == 4 || y == 7)) continue;
    kept.conservativeResize(kept.rows() + 1, 3);
    kept.bottomRows(1) = square.triangles.row(t);
  }
  ParameterizationReport report;
  const MatrixX2d uv = parameterize(meshLaplacian(square.points, kept), kept, {}, &report);
  EXPECT_EQ(report.rims, 5);
  EXPECT_LE(strain(square.points, uv), 1e-9);
}

TEST(Conformal, DoesNotDependOnUnitPlaceOrThreads) {
  const shapes::Mesh mesh = hemisphere(2);
  const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
  const auto named = [](const MatrixX2d& uv) -> MatrixX2d { return uv.array().isNaN().select(-1, uv); };
  const MatrixX2d uv = parameterize(laplacian, mesh.triangles);
  for (const int threads : {1, 3})
    EXPECT_EQ(named(parameterize(laplacian, mesh.triangles, {.solver = {.threads = threads}})), named(uv)) << threads;
  for (const int exponent : {400, -400}) {
    const double unit = std::ldexp(1, exponent);
    const Points scaled = unit * mesh.points;
    const MatrixX2d found = parameterize(meshLaplacian(scaled, mesh.triangles), mesh.triangles);
    EXPECT_EQ(named(found / unit), named(uv)) << exponent;
  }
  const shapes::Mesh square = shapes::gridSquare(8);
  const Points far = square.points.rowwise() + Eigen::RowVector3d(1e5, -1e5, 3e5);
  EXPECT_LE(strain(square.points, parameterize(meshLaplacian(far, square.triangles), square.triangles)), 1e-8);
}

TEST(Conformal, LaysChartsOutBesideEachOther) {
  const shapes::Mesh plane = shapes::gridSquare(6), mesh = support::joined(plane, hemisphere(1), {9, 0, 0});
  const int n = static_cast<int>(plane.points.rows());
  ParameterizationReport report;
  const MatrixX2d uv = mapMesh(mesh, {}, &report);
  EXPECT_EQ(report.charts, 2);
  EXPECT_EQ(report.flipped, 0);
  const MatrixX2d square = uv.topRows(n);
  Eigen::AlignedBox2d first, second;
  for (int i = 0; i < n; ++i) first.extend(square.row(i).transpose());
  for (Eigen::Index i = n; i < uv.rows(); ++i)
    if (uv.row(i).allFinite()) second.extend(uv.row(i).transpose());
  EXPECT_TRUE(first.intersection(second).isEmpty());
  EXPECT_LE(strain(mesh.points.topRows(n), square), 1e-8);
}

TEST(Parameterize, RefusesWhatNoPlaneCanHoldAndSaysWhy) {
  const auto why = [](const shapes::Mesh& mesh, const ParameterizationOptions& options = {}) {
    return refusal([&] { mapMesh(mesh, options); });
  };
  for (const auto& options : {ParameterizationOptions{}, tutte, mean_value}) {
    EXPECT_NE(why(shapes::icosphere(1), options).find("is closed, must have a rim"), std::string::npos);
    EXPECT_NE(why(shapes::moebius(6), options).find("is nonorientable"), std::string::npos);
    EXPECT_NE(why(shapes::kleinBottle(8), options).find("is nonorientable"), std::string::npos);
    EXPECT_NE(why(shapes::book(3, 4), options).find("has an edge of more than two triangles"), std::string::npos);
  }
  for (const auto& options : {tutte, mean_value}) {
    EXPECT_NE(why(shapes::bowTie(), options).find("has 2 parts, must be one"), std::string::npos);
  }
}

TEST(Parameterize, NamesWhatACallerGotWrong) {
  const shapes::Mesh square = shapes::gridSquare(4);
  const Laplacian laplacian = meshLaplacian(square.points, square.triangles);
  const auto why = [&](const ParameterizationOptions& options) {
    return refusal([&] { parameterize(laplacian, square.triangles, options); });
  };
  ParameterizationOptions options = tutte;
  options.rim = {0, 4};
  EXPECT_EQ(why(options), "parameterize: rim has 2 points, must have at least 3");
  options.rim = {0, 4, 0};
  EXPECT_EQ(why(options), "parameterize: point 0 of rim is given twice, must be once");
  options.rim = {0, 4, 25};
  EXPECT_EQ(why(options), "parameterize: rim has 25, must lie in [0, 25)");
  options.rim = {0, 4, 24};
  options.rim_positions = MatrixX2d::Zero(2, 2);
  EXPECT_EQ(why(options), "parameterize: rim_positions has 2 rows, must have 3, one per point of rim");
  options.method = ParameterizationMethod::conformal;
  options.rim_positions.resize(0, 2);
  EXPECT_EQ(why(options),
            "parameterize: rim or weights are given, must be with ParameterizationMethod::harmonic alone");
  Triangles wrong = square.triangles;
  wrong(3, 1) = 25;
  EXPECT_EQ(refusal([&] { parameterize(laplacian, wrong); }),
            "parameterize: triangle 3 names point 25, must lie in [0, 25)");
  EXPECT_EQ(refusal([&] { parameterize(laplacian, Triangles(0, 3)); }),
            "parameterize: no triangle has three different active points, must be at least one");
}

TEST(Parameterize, StopsWhenTold) {
  const shapes::Mesh square = shapes::gridSquare(10);
  const Laplacian laplacian = meshLaplacian(square.points, square.triangles);
  for (ParameterizationOptions options : {ParameterizationOptions{}, tutte, mean_value}) {
    options.solver.progress = [](std::string_view, double) { return false; };
    EXPECT_THROW(parameterize(laplacian, square.triangles, options), Cancelled);
  }
}

TEST(Tutte, FillsTheDiscAndFlipsNothingByMeanValues) {
  const shapes::Mesh cap = hemisphere(3);
  for (const auto& options : {tutte, mean_value}) {
    ParameterizationReport report;
    const MatrixX2d uv = mapMesh(cap, options, &report);
    EXPECT_EQ(report.flipped, 0);
    double area = 0;
    for (int t = 0; t < cap.triangles.rows(); ++t) {
      const Eigen::RowVector2d a = uv.row(cap.triangles(t, 0)), b = uv.row(cap.triangles(t, 1)),
                               c = uv.row(cap.triangles(t, 2));
      area += ((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x()) / 2;
    }
    EXPECT_NEAR(area, M_PI, 0.05);
    EXPECT_LE(area, M_PI);
  }
}

TEST(Tutte, OfMeanValuesFlipsNoTriangleHoweverThin) {
  // A square whose inner points are moved at random, so that many angles are obtuse.
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    shapes::Mesh mesh = hemisphere(3);
    std::uint64_t state = seed;
    for (double& value : mesh.points.reshaped()) {
      state = state * 6364136223846793005U + 1442695040888963407U;
      value += 0.06 * (static_cast<double>(state >> 11) * 0x1p-53 - 0.5);
    }
    ParameterizationReport report;
    mapMesh(mesh, mean_value, &report);
    EXPECT_EQ(report.flipped, 0) << seed;
  }
}

TEST(Tutte, IsLinearWithALinearRim) {
  const shapes::Mesh square = shapes::gridSquare(9);
  for (ParameterizationOptions options : {tutte, mean_value}) {
    for (int k = 0; k < 9; ++k) options.rim.push_back(k);
    for (int k = 0; k < 9; ++k) options.rim.push_back(9 + 10 * k);
    for (int k = 0; k < 9; ++k) options.rim.push_back(99 - k);
    for (int k = 0; k < 9; ++k) options.rim.push_back(90 - 10 * k);
    options.rim_positions = square.points(options.rim, {0, 1});
    const MatrixX2d uv = mapMesh(square, options);
    EXPECT_LE((uv - square.points.leftCols(2)).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST(Parameterize, GivesOddCloudsADefinedResult) {
  const Laplacian laplacian = pointCloudLaplacian(support::oddDisk());
  ParameterizationReport report;
  const MatrixX2d uv = parameterize(laplacian, surfaceTriangles(laplacian), {}, &report);
  support::expectCopies(laplacian, uv);
  EXPECT_TRUE(uv.topRows(1000).allFinite());
  EXPECT_TRUE(uv.middleRows(1000, 500).array().isNaN().all());
  EXPECT_TRUE(uv.bottomRows(2).array().isNaN().all());
  EXPECT_EQ(uv.row(1500), uv.row(7));
  EXPECT_EQ(report.closed, 1);
  EXPECT_EQ(report.not_mapped, uv.col(0).array().isNaN().count());
}

TEST(Parameterize, CutsTheSurfaceOfACloudThatHasOneSide) {
  const shapes::Mesh strip = shapes::moebius(12);
  Laplacian laplacian = pointCloudLaplacian(strip.points);
  ParameterizationReport report;
  const MatrixX2d uv = parameterize(laplacian, strip.triangles, {}, &report);
  EXPECT_TRUE(uv.allFinite());
  EXPECT_GE(report.cut, 12);  // across the strip
  EXPECT_LE(report.cut, 30);
  EXPECT_EQ(report.charts, 1);
  EXPECT_EQ(report.nonorientable, 0);
  laplacian.kind = Kind::mesh;
  EXPECT_NE(refusal([&] { parameterize(laplacian, strip.triangles); }).find("is nonorientable"), std::string::npos);
}

TEST(Parameterize, GivesOddMeshesADefinedResult) {
  for (const shapes::Mesh& mesh :
       {shapes::slivers(8), shapes::zeroLengthEdges(6), shapes::repeatedVertices(6), shapes::unreferencedVertices(6),
        shapes::duplicateTriangles(6), shapes::mixedOrientation(6), shapes::bowTie(), shapes::bowTieCones(5)}) {
    const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
    ParameterizationReport report;
    const std::string said =
        refusal([&] { support::expectDefined(laplacian, parameterize(laplacian, mesh.triangles, {}, &report), NAN); });
    EXPECT_TRUE(said == "accepted" || said.find("edge of more than two") != std::string::npos) << mesh.name << said;
  }
  const shapes::Mesh mixed = shapes::mixedOrientation(6);
  EXPECT_LE(std::min(strain(mixed.points, mapMesh(mixed)),
                     strain(mixed.points * Eigen::DiagonalMatrix<double, 3>(-1, 1, 1), mapMesh(mixed))),
            1e-9);
}

}  // namespace
}  // namespace tufted::parameterization_test
