// validate assembles L once more: it finds a matrix or a mass that keeps all other promises and is of another surface.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "shapes/shapes.h"
#include "tufted/check.h"

namespace tufted::guarantees::surface_test {
namespace {

using testing::Contains;
using testing::IsEmpty;
using testing::StartsWith;

struct Sample {
  const char* name;
  Laplacian laplacian;
  bool has_stars;
};

std::vector<Sample> samples() {
  const Points points = shapes::withNoise(shapes::sphere(400), 0.01).points;
  const shapes::Mesh cube = shapes::cubeMesh(4, shapes::Quality::bad), needles = shapes::slivers(8);
  return {{"cloud", pointCloudLaplacian(points), false},
          {"cloud of preset clean", pointCloudLaplacian(points, cloudOptions(Preset::clean)), false},
          {"open cloud", pointCloudLaplacian(shapes::saddle(400).points), true},
          {"open cloud in an image's unit", pointCloudLaplacian(1e-3 * shapes::saddle(400).points), true},
          {"mesh", meshLaplacian(cube.points, cube.triangles), false},
          {"mesh of needles", meshLaplacian(needles.points, needles.triangles), false},
          {"huge mesh", meshLaplacian(1e100 * cube.points, cube.triangles), false},
          {"tiny mesh", meshLaplacian(1e-100 * needles.points, needles.triangles), false}};
}

/// Makes one weight larger by a factor, its symmetric copy too, and the rows still sum to 0.
void scaleWeight(SparseMatrix& L, int i, int j, double factor) {
  const double more = (factor - 1) * L.coeff(i, j);
  for (const auto& [row, column] : {std::pair(i, j), {j, i}}) L.coeffRef(row, column) += more;
  for (const int k : {i, j}) {
    double sum = 0;
    for (SparseMatrix::InnerIterator it(L, k); it; ++it) sum += it.row() == k ? 0 : it.value();
    L.coeffRef(k, k) = -sum;
  }
}

TEST(Surface, AgreesWithWhatWasBuilt) {
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.name);
    const LaplacianCheck check = validate(sample.laplacian);
    EXPECT_THAT(check.faults, IsEmpty());
    EXPECT_THAT(check.not_checked, IsEmpty());
    ASSERT_TRUE(check.surface.has_value());
    EXPECT_LT(check.surface->weight_error, 1e-14);
    EXPECT_LT(check.surface->area_error, 1e-13);
    EXPECT_LT(check.surface->mass_error, 1e-13);
    EXPECT_EQ(sample.laplacian.report.star_masses > 0, sample.has_stars);
  }
}

TEST(Surface, FindsAnyWeightThatIsLargerByAHundredth) {
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.name);
    const SparseMatrix& L = sample.laplacian.L;
    const VectorXd diagonal = L.diagonal();
    int tried = 0, edge = 0;
    for (int j = 0; j < L.cols(); ++j) {
      for (SparseMatrix::InnerIterator it(L, j); it; ++it) {
        const int i = static_cast<int>(it.row());
        // Weights of cocircular corners are rounding, up to 1e-10.
        if (i <= j || -it.value() < 1e-8 * std::max(diagonal[i], diagonal[j]) || ++edge % 29 != 0) continue;
        ++tried;
        for (const double factor : {1.01, 0.99}) {
          Laplacian changed = sample.laplacian;
          scaleWeight(changed.L, i, j, factor);
          const LaplacianCheck check = validate(changed);
          EXPECT_EQ(check.faults.size(), 1u);
          EXPECT_THAT(check.faults, Contains(StartsWith("surface: L(" + std::to_string(i) + ", " + std::to_string(j))));
        }
      }
    }
    EXPECT_GE(tried, 5);
  }
}

TEST(Surface, FindsTheMatrixOfAnother) {
  const Points points = shapes::sphere(400).points;
  Points bent = points;
  bent.col(2) *= 1.01;
  Laplacian laplacian = pointCloudLaplacian(bent);
  laplacian.L = pointCloudLaplacian(points).L;
  laplacian.report.nonzeros = laplacian.L.nonZeros();
  EXPECT_THAT(validate(laplacian).faults, testing::ElementsAre(StartsWith("surface: ")));

  Laplacian scaled = pointCloudLaplacian(points);
  scaled.L *= 3;  // which has all other promises of L
  EXPECT_THAT(validate(scaled).faults, testing::ElementsAre(StartsWith("surface: ")));
}

TEST(Surface, FindsAMassThatWasMoved) {
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.name);
    Laplacian changed = sample.laplacian;
    const double moved = 1e-6 * changed.M[3];
    changed.M[3] -= moved;
    changed.M[4] += moved;
    EXPECT_THAT(validate(changed).faults, testing::ElementsAre(StartsWith("mass: 2 times, first M(3) = ")));
    changed = sample.laplacian;
    changed.cover_areas[5] *= 1 + 1e-9;
    EXPECT_THAT(validate(changed).faults, testing::ElementsAre(StartsWith("cover area: cover_areas(5) = ")));
  }
}

TEST(Surface, WithoutTheStarsMassesAreComparedButWhereItEndsAndThatIsSaid) {
  Laplacian laplacian = pointCloudLaplacian(shapes::saddle(400).points);
  laplacian.setCover(laplacian.cover());
  const LaplacianCheck check = validate(laplacian);
  EXPECT_THAT(check.faults, IsEmpty());
  EXPECT_FALSE(check.surface->masses_compared);
  EXPECT_THAT(check.not_checked, testing::ElementsAre(StartsWith("mass: M was not compared where the surface ends")));
  const auto inside = std::find(laplacian.boundary.begin(), laplacian.boundary.end(), Boundary::none);
  laplacian.M[inside - laplacian.boundary.begin()] *= 1 + 1e-9;
  EXPECT_THAT(validate(laplacian).faults, testing::ElementsAre(StartsWith("mass: M(")));
}

TEST(Surface, LengthsOfFewDigitsAreLeftOutAndCounted) {
  const shapes::Mesh mesh = shapes::gridSquare(4);
  const LaplacianCheck check = validate(meshLaplacian(1e-318 * mesh.points, mesh.triangles));
  EXPECT_THAT(check.faults, IsEmpty());
  EXPECT_EQ(check.surface->coarse_points, mesh.points.rows());
}

}  // namespace
}  // namespace tufted::guarantees::surface_test
