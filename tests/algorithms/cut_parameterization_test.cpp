// Maps of surfaces that are cut open along given edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "shapes/shapes.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::cut_parameterization_test {
namespace {

using Eigen::MatrixX2d;
using support::refusal;
using Cuts = std::vector<std::vector<int>>;

/// A tube of flat strips without caps, or with `is_torus` its end joined to its begin; point j * around + i.
shapes::Mesh tube(int around, int along, bool is_torus = false) {
  shapes::Mesh mesh;
  const int rows = is_torus ? along : along + 1;
  mesh.points.resize(rows * around, 3);
  mesh.triangles.resize(2 * around * along, 3);
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < around; ++i) {
      const double a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * j / along;
      if (is_torus)
        mesh.points.row(j * around + i) << (3 + std::cos(a)) * std::cos(b), (3 + std::cos(a)) * std::sin(b),
            std::sin(a);
      else
        mesh.points.row(j * around + i) << std::cos(a), std::sin(a), 0.3 * j;
    }
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      const int next = (j + 1) % rows * around, on = (i + 1) % around, at = j * around;
      mesh.triangles.row(2 * (j * around + i)) << at + i, at + on, next + on;
      mesh.triangles.row(2 * (j * around + i) + 1) << at + i, next + on, next + i;
    }
  return mesh;
}

/// Points first, first + step, ..., `count` of them.
std::vector<int> line(int first, int step, int count) {
  std::vector<int> points;
  for (int k = 0; k < count; ++k) points.push_back(first + k * step);
  return points;
}

MatrixX2d mapCut(const shapes::Mesh& mesh, const Cuts& cuts, const ParameterizationOptions& options = {},
                 ParameterizationReport* report = nullptr) {
  return parameterizeCut(meshLaplacian(mesh.points, mesh.triangles), mesh.triangles, cuts, options, report);
}

/// The places of each point.
std::vector<std::set<std::pair<double, double>>> placesOf(const shapes::Mesh& mesh, const MatrixX2d& uv) {
  std::vector<std::set<std::pair<double, double>>> places(static_cast<std::size_t>(mesh.points.rows()));
  for (int c = 0; c < uv.rows(); ++c) places[mesh.triangles(c / 3, c % 3)].insert({uv(c, 0), uv(c, 1)});
  return places;
}

TEST(CutParameterization, UnrollsATubeWithoutAnyStretch) {
  const shapes::Mesh mesh = tube(12, 8);
  ParameterizationReport report;
  const MatrixX2d uv = mapCut(mesh, {line(5, 12, 9)}, {}, &report);
  EXPECT_EQ(report.charts, 1);
  EXPECT_EQ(report.rims, 1);
  EXPECT_EQ(report.flipped, 0);
  EXPECT_EQ(report.not_mapped, 0);
  for (int c = 0; c < uv.rows(); ++c) {
    const int next = c - c % 3 + (c + 1) % 3;
    const double length =
        (mesh.points.row(mesh.triangles(c / 3, c % 3)) - mesh.points.row(mesh.triangles(next / 3, next % 3))).norm();
    EXPECT_NEAR((uv.row(c) - uv.row(next)).norm(), length, 1e-7);
  }
  const auto places = placesOf(mesh, uv);
  for (int i = 0; i < std::ssize(places); ++i) EXPECT_EQ(places[i].size(), i % 12 == 5 ? 2u : 1u) << i;
}

TEST(CutParameterization, GivesAClosedSurfaceASeam) {
  const shapes::Mesh mesh = tube(16, 24, true);
  Cuts cuts = {line(0, 1, 16), line(0, 16, 24)};
  for (std::vector<int>& loop : cuts) loop.push_back(0);
  for (const auto method : {ParameterizationMethod::conformal, ParameterizationMethod::harmonic}) {
    ParameterizationReport report;
    const MatrixX2d uv = mapCut(mesh, cuts,
                                {.method = method,
                                 .weights = method == ParameterizationMethod::harmonic ? HarmonicWeights::mean_value
                                                                                       : HarmonicWeights::laplacian},
                                &report);
    EXPECT_TRUE(uv.allFinite());
    EXPECT_EQ(report.triangles, mesh.triangles.rows());
    EXPECT_EQ(report.flipped, 0);
    const auto places = placesOf(mesh, uv);
    for (int i = 0; i < std::ssize(places); ++i)
      EXPECT_EQ(places[i].size(), i == 0 ? 4u : i < 16 || i % 16 == 0 ? 2u : 1u) << i;
  }
}

TEST(CutParameterization, WithoutACutIsThatOfTheSurface) {
  const shapes::Mesh mesh = tube(10, 3);
  const MatrixX2d whole = parameterize(meshLaplacian(mesh.points, mesh.triangles), mesh.triangles);
  const MatrixX2d corners = mapCut(mesh, {});
  for (int c = 0; c < corners.rows(); ++c) EXPECT_EQ(corners.row(c), whole.row(mesh.triangles(c / 3, c % 3)));
}

TEST(CutParameterization, SeparatesTrianglesOfACrowdedEdge) {
  // Three triangles share an edge: cut along it, each is a disk by itself.
  shapes::Mesh mesh;
  mesh.points.resize(5, 3);
  mesh.points << 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, -1, -1, 0;
  mesh.triangles.resize(3, 3);
  mesh.triangles << 0, 1, 2, 0, 1, 3, 0, 1, 4;
  ParameterizationReport report;
  EXPECT_TRUE(mapCut(mesh, {{0, 1}}, {}, &report).allFinite());
  EXPECT_EQ(report.charts, 3);
}

TEST(CutParameterization, LeavesOutTrianglesThatTakeNoPart) {
  shapes::Mesh mesh = tube(12, 8);
  mesh.points.row(30).setConstant(std::nan(""));  // a hole, which the second cut joins to the first
  const MatrixX2d uv = mapCut(mesh, {line(0, 12, 9), line(24, 1, 6)});
  for (int c = 0; c < uv.rows(); ++c) {
    const bool takes_part = (mesh.triangles.row(c / 3).array() != 30).all();
    EXPECT_EQ(uv.row(c).allFinite(), takes_part);
  }
}

TEST(CutParameterization, NamesMistakes) {
  const shapes::Mesh mesh = tube(16, 24, true), open = tube(12, 8);
  const auto expect = [](const auto& call, const std::string& words) {
    EXPECT_NE(refusal(call).find(words), std::string::npos) << refusal(call);
  };
  expect([&] { mapCut(mesh, {{3}}); }, "parameterize: a cut has 1 points, must have at least 2");
  expect([&] { mapCut(mesh, {{3, 999}}); }, "a cut has 999, must lie in [0, 384)");
  expect([&] { mapCut(mesh, {{0, 2}}); }, "a cut goes from point 0 to 2, which no edge of the triangles joins");
  expect([&] { mapCut(mesh, {{0, 0}}); }, "a cut goes from point 0 to 0, which no edge");
  expect([&] { mapCut(mesh, {}); }, "is closed, must have a rim");
  expect([&] { mapCut(mesh, {{0, 1}}); }, "has 0 rims and Euler characteristic 0, must be a disk, with 1 and 1");
  expect([&] { mapCut(mesh, {{0, 1, 2}}); }, "has 1 rims and Euler characteristic -1, must be a disk");
  std::vector<int> loop = line(0, 1, 16);
  loop.push_back(0);
  expect([&] { mapCut(mesh, {loop}); }, "has 2 rims and Euler characteristic 0, must be a disk");
  expect([&] { mapCut(open, {line(5, 12, 9)}, {.method = ParameterizationMethod::harmonic}); },
         "weights are those of L, which has no cuts, must be mean-value weights");
  expect(
      [&] {
        mapCut(open, {line(5, 12, 9)}, {.method = ParameterizationMethod::harmonic, .rim = {1, 2, 3}});
      },
      "a rim is given with cuts");
}

}  // namespace
}  // namespace tufted::cut_parameterization_test
