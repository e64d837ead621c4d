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
#include "support/odd_cloud.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::parameterization_test {
namespace {

using Eigen::MatrixX2d;
using support::refusal;

const ParameterizationOptions tutte{.method = ParameterizationMethod::harmonic};
const ParameterizationOptions mean_value{.method = ParameterizationMethod::harmonic,
                                         .weights = HarmonicWeights::mean_value};

MatrixX2d mapMesh(const shapes::Mesh& mesh, const ParameterizationOptions& options = {},
                  ParameterizationReport* report = nullptr) {
  return parameterize(meshLaplacian(mesh.points, mesh.triangles), mesh.triangles, options, report);
}

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
  shapes::Mesh mesh = shapes::gridSquare(6);
  const shapes::Mesh cap = hemisphere(1);
  const int n = static_cast<int>(mesh.points.rows());
  const Eigen::Index f = mesh.triangles.rows();
  mesh.points.conservativeResize(n + cap.points.rows(), 3);
  mesh.points.bottomRows(cap.points.rows()) = cap.points.rowwise() + Eigen::RowVector3d(9, 0, 0);
  mesh.triangles.conservativeResize(f + cap.triangles.rows(), 3);
  mesh.triangles.bottomRows(cap.triangles.rows()) = cap.triangles.array() + n;
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
  shapes::Mesh mesh = shapes::gridSquare(100);  // larger than the tube
  const shapes::Mesh pole = tube(200, 52, false);
  const auto points = static_cast<int>(mesh.points.rows()), triangles = static_cast<int>(mesh.triangles.rows());
  mesh.points.conservativeResize(points + pole.points.rows(), 3);
  mesh.points.bottomRows(pole.points.rows()) = pole.points.rowwise() + Eigen::RowVector3d(9, 0, 0);
  mesh.triangles.conservativeResize(triangles + pole.triangles.rows(), 3);
  mesh.triangles.bottomRows(pole.triangles.rows()) = pole.triangles.array() + points;
  ParameterizationReport report;
  const MatrixX2d uv = mapMesh(mesh, {}, &report);
  EXPECT_EQ(report.charts, 1);
  EXPECT_EQ(report.rims, 1);
  EXPECT_EQ(report.collapsed_charts, 1);
  EXPECT_EQ(report.not_mapped, pole.points.rows());
  EXPECT_EQ(report.triangles, triangles);
  EXPECT_TRUE(uv.topRows(points).allFinite());
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
