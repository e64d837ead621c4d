// Grids that lie on curved surfaces, where stars disagree about the diagonals of cells.
#include "stars/diagonals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <utility>

#include "pipeline/build.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "stars/agreement.h"
#include "support/cloud_stars.h"
#include "tufted/laplacian.h"
#include "tufted/spectrum.h"

namespace tufted::diagonals_test {
namespace {

constexpr double pi = std::numbers::pi;
const Progress silent;

/// A grid that may be closed in each direction, and the triangles of its cells.
struct Grid {
  std::string name;
  Points points;
  Triangles triangles;
};

/// @param place(u, v) where both run from 0 to 1
Grid grid(const char* name, int columns, int rows, bool columns_close, bool rows_close,
          const std::function<Eigen::RowVector3d(double, double)>& place) {
  Grid result{name, Points(columns * rows, 3), {}};
  const int wide = columns_close ? columns : columns - 1, high = rows_close ? rows : rows - 1;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i)
      result.points.row(j * columns + i) = place(static_cast<double>(i) / wide, static_cast<double>(j) / high);
  result.triangles.resize(2 * Eigen::Index{wide} * high, 3);
  for (int j = 0; j < high; ++j) {
    for (int i = 0; i < wide; ++i) {
      const int next = (i + 1) % columns, above = (j + 1) % rows * columns, here = j * columns;
      result.triangles.row(2 * (j * wide + i)) << here + i, here + next, above + i;
      result.triangles.row(2 * (j * wide + i) + 1) << here + next, above + next, above + i;
    }
  }
  return result;
}

Eigen::RowVector3d onSphere(double azimuth, double elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

/// What a spinning scanner sees of a sphere around it; cells of a cylinder; the hill and the saddle of a torus; saddles
/// along and across their cells.
std::vector<Grid> grids() {
  return {grid("sphere from within", 90, 60, false, false,
               [](double u, double v) { return onSphere((u - 0.5) * pi / 2, (v - 0.5) * pi / 3); }),
          grid("cylinder", 80, 40, true, false,
               [](double u, double v) {
                 return Eigen::RowVector3d(onSphere(2 * pi * u, 0) + 3 * v * onSphere(0, pi / 2));
               }),
          grid("torus", 160, 60, true, true,
               [](double u, double v) {
                 const Eigen::RowVector3d out = onSphere(2 * pi * u, 0), tube = onSphere(0, 2 * pi * v);
                 return Eigen::RowVector3d((1 + 0.4 * tube[0]) * out + Eigen::RowVector3d(0, 0, 0.4 * tube[2]));
               }),
          grid("saddle along its cells", 60, 60, false, false,
               [](double u, double v) { return Eigen::RowVector3d(u, v, 2 * (u - 0.5) * (v - 0.5)); }),
          grid("saddle across its cells", 60, 60, false, false, [](double u, double v) {
            return Eigen::RowVector3d(u, v, (u - 0.5) * (u - 0.5) - (v - 0.5) * (v - 0.5));
          })};
}

/// Stars that have not settled their diagonals.
support::CloudStars starsOf(const Points& points) {
  CloudOptions options;
  options.steps.settle_diagonals = false;
  return support::starsOf(points, options);
}

double meanRatio(const VectorXd& values, const VectorXd& of) {
  return values.cwiseQuotient(of).mean();
}

TEST(Diagonals, OfGridsOnCurvedSurfacesLeaveAreaAndSpectrumRight) {
  for (const Grid& sample : grids()) {
    const Laplacian truth = meshLaplacian(sample.points, sample.triangles), cloud = pointCloudLaplacian(sample.points);
    EXPECT_NEAR(cloud.cover_areas.sum() / truth.M.sum(), 1, 0.01) << sample.name;
    EXPECT_NEAR(cloud.M.sum() / truth.M.sum(), 1, 0.01) << sample.name;
    const SpectrumOptions options{.null_space = false};
    EXPECT_NEAR(meanRatio(spectrum(cloud, 8, options).values, spectrum(truth, 8, options).values), 1, 0.02)
        << sample.name;
  }
}

TEST(Diagonals, OfGridsOnCurvedSurfacesHaveThreeVotesPerTriangle) {
  for (const Grid& sample : grids()) {
    const Report report = pointCloudLaplacian(sample.points).report;
    EXPECT_GT(report.votes[2], 0.97 * static_cast<double>(sample.triangles.rows())) << sample.name;
    EXPECT_LT(report.votes[0] + report.votes[1], 0.03 * static_cast<double>(sample.triangles.rows())) << sample.name;
  }
}

TEST(Diagonals, LeaveStarsThatAgreeAsTheyAre) {
  const support::CloudStars lattice = starsOf(shapes::squareLattice(40).points);
  Stars stars = lattice.built.stars;
  settleDiagonals(lattice.cloud.points, lattice.built.disagrees, Workers(1, silent), stars);
  EXPECT_EQ(stars.link, lattice.built.stars.link);
  EXPECT_EQ(stars.offset, lattice.built.stars.offset);
  EXPECT_EQ(stars.triangle, lattice.built.stars.triangle);
}

/// The same stars with other numbers of the points, some stars the other way round, each from another link vertex on.
Stars renumbered(const Stars& stars, const Buffer<int>& number, shapes::Random& random) {
  Buffer<int> old(number.size());
  for (int p = 0; p < stars.size(); ++p) old[number[p]] = p;
  Stars result;
  result.offset.assign(1, 0);
  for (const int p : old) {
    const int size = stars.offset[p + 1] - stars.offset[p];
    const bool turns = random.uniform() < 0.5;
    const int start = size > 0 ? static_cast<int>(size * random.uniform()) : 0;
    for (int k = 0; k < size; ++k) {
      const int at = turns ? (start + size - k) % size : (start + k) % size;
      result.link.push_back(number[stars.link[stars.offset[p] + at]]);
      result.triangle.push_back(stars.triangle[stars.offset[p] + (turns ? (at + size - 1) % size : at)]);
    }
    result.offset.push_back(static_cast<int>(result.link.size()));
    result.ends.push_back(stars.ends[p]);
  }
  return result;
}

/// The triangles of all stars: each star's point first, then both others, the lower first.
std::vector<std::array<int, 3>> trianglesOf(const Stars& stars, const Buffer<int>& number) {
  std::vector<std::array<int, 3>> triangles;
  for (int p = 0; p < stars.size(); ++p) {
    for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i) {
      if (!stars.hasTriangle(i)) continue;
      const auto [low, high] = std::minmax({number[stars.link[i]], number[stars.link[stars.after(p, i)]]});
      triangles.push_back({number[p], low, high});
    }
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

TEST(Diagonals, DependNeitherOnNumbersNorOnTheDirectionOfStarsNorOnThreads) {
  std::vector<Grid> samples = grids();
  samples.push_back({"noise", shapes::withNoise(shapes::sphere(20000), 0.008).points, {}});
  for (const Grid& sample : samples) {
    const support::CloudStars given = starsOf(sample.points);
    const int n = given.cloud.size();
    Stars settled = given.built.stars;
    const auto count = settleDiagonals(given.cloud.points, given.built.disagrees, Workers(1, silent), settled);
    EXPECT_GT(count, sample.triangles.rows() > 0 ? 100 : 0) << sample.name;
    Buffer<int> same(n);
    std::iota(same.begin(), same.end(), 0);

    shapes::Random random(4);
    Buffer<int> number = same;
    for (int i = n - 1; i > 0; --i) std::swap(number[i], number[static_cast<int>((i + 1) * random.uniform())]);
    Stars other = renumbered(given.built.stars, number, random);
    Points points(n, 3);
    for (int p = 0; p < n; ++p) points.row(number[p]) = given.cloud.points.row(p);
    const Workers workers(3, silent);
    EXPECT_EQ(settleDiagonals(points, findDisagreement(other, workers), workers, other), count) << sample.name;
    EXPECT_EQ(trianglesOf(other, same), trianglesOf(settled, number)) << sample.name;
  }
}

TEST(Diagonals, LeaveClosedStarsThreeNeighbours) {
  for (const double noise : {0.01, 0.05}) {
    const support::CloudStars given = starsOf(shapes::withNoise(shapes::sphere(3000), noise).points);
    Stars settled = given.built.stars;
    settleDiagonals(given.cloud.points, given.built.disagrees, Workers(1, silent), settled);
    for (int p = 0; p < settled.size(); ++p) {
      const int before = given.built.stars.offset[p + 1] - given.built.stars.offset[p];
      const int after = settled.offset[p + 1] - settled.offset[p];
      EXPECT_GE(after, settled.ends[p] == 0 ? std::min(before, 3) : std::min(before, 2));
      auto link =
          std::vector<int>(settled.link.begin() + settled.offset[p], settled.link.begin() + settled.offset[p + 1]);
      std::sort(link.begin(), link.end());
      EXPECT_EQ(std::adjacent_find(link.begin(), link.end()), link.end()) << "point " << p;
    }
  }
}

TEST(Diagonals, AreTheSameByTheShortCutAndByTheWholeCover) {
  for (const Grid& sample : grids()) {
    Laplacian fast, plain;
    buildCloudLaplacian(sample.points, {}, CloudBuild::automatic, fast);
    buildCloudLaplacian(sample.points, {}, CloudBuild::whole_cover, plain);
    const SparseMatrix difference = fast.L - plain.L;
    EXPECT_LE(difference.coeffs().cwiseAbs().maxCoeff(), 1e-9 * plain.L.diagonal().maxCoeff()) << sample.name;
    EXPECT_LE((fast.M - plain.M).cwiseAbs().maxCoeff(), 1e-9 * plain.M.maxCoeff()) << sample.name;
  }
}

}  // namespace
}  // namespace tufted::diagonals_test
