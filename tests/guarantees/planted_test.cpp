// The checks, that of the tests and validate, can fail: each finds a violation that was planted into a good result.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <utility>

#include "guarantees/guarantees.h"
#include "shapes/shapes.h"
#include "tufted/check.h"

namespace tufted::guarantees::planted_test {
namespace {

constexpr int not_finite_row = 500, coincident_row = 501;

/// A sphere of 500 points, then a point that is not finite and a copy of point 7.
Points samplePoints() {
  Points points(502, 3);
  points.topRows(500) = shapes::sphere(500).points.topRows(500);
  points.row(not_finite_row).setConstant(NAN);
  points.row(coincident_row) = points.row(7);
  return points;
}

struct Planted {
  std::string name;      ///< of the test
  std::string expected;  ///< how the message begins
  std::function<void(Laplacian&)> plant;
  std::string of_validate = expected;  ///< the same for validate, which does not see the points
};
void PrintTo(const Planted& planted, std::ostream* out) {
  *out << planted.name;
}

/// Row of the first stored entry beside the diagonal in column 0.
int neighborOfFirst(const Laplacian& laplacian) {
  for (SparseMatrix::InnerIterator it(laplacian.L, 0); it; ++it) {
    if (it.row() != 0 && it.value() < 0) return static_cast<int>(it.row());
  }
  return -1;
}

Planted onCover(std::string name, const std::function<void(IntrinsicTriangulation&)>& change) {
  return {std::move(name), "cover", [change](Laplacian& laplacian) {
            IntrinsicTriangulation cover = laplacian.cover();
            change(cover);
            laplacian.setCover(std::move(cover));
          }};
}

std::vector<Planted> planted() {
  return {
      {"OtherSizeOfM", "size", [](Laplacian& l) { l.M.conservativeResize(501); }},
      {"OtherSizeOfL", "size", [](Laplacian& l) { l.L.conservativeResize(503, 502); }},
      {"OtherSizeOfStatus", "size", [](Laplacian& l) { l.status.pop_back(); }},
      {"NoBoundaryTag", "boundary", [](Laplacian& l) { l.boundary[5] = static_cast<Boundary>(4); }},
      {"TaggedWithoutASurface", "boundary", [](Laplacian& l) { l.boundary[not_finite_row] = Boundary::rim; }},
      {"NotCompressed", "storage", [](Laplacian& l) { l.L.uncompress(); }},
      {"RowsDoNotAscend", "storage",
       [](Laplacian& l) {
         std::swap(l.L.innerIndexPtr()[0], l.L.innerIndexPtr()[1]);
         std::swap(l.L.valuePtr()[0], l.L.valuePtr()[1]);
       }},
      {"ColumnsStartLate", "storage", [](Laplacian& l) { l.L.outerIndexPtr()[0] = 1; }},
      {"AColumnEndsBeforeItStarts", "storage", [](Laplacian& l) { l.L.outerIndexPtr()[7] = INT32_MAX; }},
      {"AColumnStartsBeforeAll", "storage", [](Laplacian& l) { l.L.outerIndexPtr()[7] = -1'000'000; }},
      {"ColumnsEndBeyondTheEntries", "storage", [](Laplacian& l) { l.L.outerIndexPtr()[l.L.cols()] = INT32_MAX; }},
      {"ColumnsEndEarly", "storage", [](Laplacian& l) { --l.L.outerIndexPtr()[l.L.cols()]; }},
      {"NotFiniteInL", "finite", [](Laplacian& l) { l.L.coeffRef(0, 0) = INFINITY; }},
      {"NotFiniteInM", "finite", [](Laplacian& l) { l.M[3] = NAN; }},
      {"PositiveOffDiagonal", "off-diagonal sign", [](Laplacian& l) { l.L.coeffRef(neighborOfFirst(l), 0) = 1e-300; }},
      {"RowSum", "row sum", [](Laplacian& l) { l.L.coeffRef(0, 0) *= 1 + 1e-13; }},
      {"ZeroDiagonal", "positive diagonal", [](Laplacian& l) { l.L.coeffRef(0, 0) = 0; }},
      {"InactiveRow", "inactive is zero",
       [](Laplacian& l) {
         l.L.coeffRef(not_finite_row, not_finite_row) = 1;
         l.L.makeCompressed();
       }},
      {"InactiveMass", "inactive is zero", [](Laplacian& l) { l.M[coincident_row] = 1e-300; }},
      {"NegativeMass", "mass", [](Laplacian& l) { l.M[0] = -1e-300; }},
      {"OneBitOfSymmetry", "symmetry",
       [](Laplacian& l) {
         double& weight = l.L.coeffRef(neighborOfFirst(l), 0);
         weight = std::nextafter(weight, 0.0);
       }},
      {"PatternNotSymmetric", "symmetry",
       [](Laplacian& l) {
         const int row = neighborOfFirst(l);
         l.L.prune([row](Eigen::Index i, Eigen::Index j, double) { return i != row || j != 0; });
       }},
      {"Indefinite", "definite",
       [](Laplacian& l) {  // one positive weight: x = 1 at an end of it has less than no energy
         const int row = neighborOfFirst(l);
         const double much = 10 * l.L.coeff(0, 0);
         l.L.coeffRef(row, 0) += much, l.L.coeffRef(0, row) += much;
         l.L.coeffRef(0, 0) -= much, l.L.coeffRef(row, row) -= much;
       }},
      {"JustIndefinite", "definite",
       [](Laplacian& l) { l.L.coeffRef(0, 0) *= 1 - 1e-8; }},  // a constant has less than no energy
      onCover("CoverNotClosed", [](IntrinsicTriangulation& t) { t.glue[5] = -1; }),
      onCover("CoverNotManifold", [](IntrinsicTriangulation& t) { t.glue[5] = t.glue[8]; }),
      onCover("CoverLengths", [](IntrinsicTriangulation& t) { t.length[5] *= 1 + 1e-15; }),
      onCover("CoverNotDelaunay",
              [](IntrinsicTriangulation& t) {
                for (const int side : {0, t.glue[0]}) {
                  t.length[side] =
                      0.99 * std::min(t.length[nextSide(side)] + t.length[previousSide(side)],
                                      t.length[nextSide(t.glue[side])] + t.length[previousSide(t.glue[side])]);
                }
              }),
      onCover("CoverCorner", [](IntrinsicTriangulation& t) { t.faces[3][1] = 502; }),
      onCover("CoverVertices", [](IntrinsicTriangulation& t) { ++t.vertices; }),
      {"CoverFaces", "cover", [](Laplacian& l) { ++l.report.triangles; }},
      {"ClampedLarge", "failures", [](Laplacian& l) { l.report.clamped_large = 1; }},
      {"FlipFailures", "failures", [](Laplacian& l) { l.report.flip_failures = 1; }},
      {"CountOfPoints", "counts", [](Laplacian& l) { ++l.report.points; }},
      {"CountOfActive", "counts", [](Laplacian& l) { --l.report.active; }},
      {"CountOfNonzeros", "counts", [](Laplacian& l) { ++l.report.nonzeros; }},
      {"NoComponents", "counts", [](Laplacian& l) { l.report.components = 0; }},
      {"NotFiniteIsActive", "status", [](Laplacian& l) { l.status[not_finite_row] = PointStatus::active; },
       "positive diagonal"},
      {"CoincidentIsIsolated", "status", [](Laplacian& l) { l.status[coincident_row] = PointStatus::isolated; },
       "representative"},
      {"RepresentativeIsLater", "representative",
       [](Laplacian& l) { l.representative[coincident_row] = coincident_row; }},
      {"RepresentativeOfAnother", "representative", [](Laplacian& l) { l.representative[3] = 2; }},
      {"LongNormal", "frame", [](Laplacian& l) { l.frames.normals.row(3) *= 2; }},
      {"SkewTangent", "frame", [](Laplacian& l) { l.frames.tangents.row(3) = l.frames.normals.row(3); }},
  };
}

TEST(Guarantees, HoldForTheSample) {
  const Points points = samplePoints();
  EXPECT_THAT(brokenGuarantees(pointCloudLaplacian(points), points), testing::IsEmpty());
  EXPECT_THAT(validate(pointCloudLaplacian(points)).faults, testing::IsEmpty());
}

class PlantedViolation : public testing::TestWithParam<Planted> {};

TEST_P(PlantedViolation, IsFound) {
  static const Points points = samplePoints();
  static const Laplacian good = pointCloudLaplacian(points);
  Laplacian laplacian = good;
  GetParam().plant(laplacian);
  EXPECT_THAT(brokenGuarantees(laplacian, points), testing::Contains(testing::StartsWith(GetParam().expected)));
}

TEST_P(PlantedViolation, IsFoundByValidate) {
  static const Laplacian good = pointCloudLaplacian(samplePoints());
  Laplacian laplacian = good;
  GetParam().plant(laplacian);
  EXPECT_THAT(validate(laplacian).faults, testing::Contains(testing::StartsWith(GetParam().of_validate)));
}

INSTANTIATE_TEST_SUITE_P(Guarantees, PlantedViolation, testing::ValuesIn(planted()),
                         [](const auto& shape) { return shape.param.name; });

}  // namespace
}  // namespace tufted::guarantees::planted_test
