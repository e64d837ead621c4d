#include "stars/neighborhood.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shapes/random.h"
#include "shapes/shapes.h"
#include "stars/stars.h"

namespace tufted::neighborhood_test {
namespace {

/// Neighbourhoods of a cloud, its points as they are.
class Hoods {
 public:
  Hoods(const Points& points, const CloudOptions& options)
      : points_(points), options_(options), finder_(points_, source_, options_) {
    source_.search = std::make_unique<NeighborSearch>(points_);
    source_.k = options.neighbors;
  }

  Neighborhood at(int p) {
    Neighborhood neighborhood;
    finder_.find(p, 1, scratch_, &neighborhood);
    offsets_.take(points_, p, neighborhood.neighbors);
    finder_.fitPlanes({&neighborhood, 1}, {&offsets_, 1});
    finder_.refine(p, neighborhood, offsets_, scratch_);
    expectOffsetsOf(p, neighborhood);
    return neighborhood;
  }

 private:
  void expectOffsetsOf(int p, const Neighborhood& neighborhood) const {
    const Offsets offsets = offsets_.view();
    ASSERT_EQ(offsets.count, std::ssize(neighborhood.neighbors));
    for (int i = 0; i < toPackets(offsets.count); ++i) {
      const Eigen::RowVector3d offset(offsets.x[i], offsets.y[i], offsets.z[i]);
      const Eigen::RowVector3d expected = i < offsets.count
                                              ? points_.row(neighborhood.neighbors[i].index) - points_.row(p)
                                              : Eigen::RowVector3d(0, 0, 0);
      ASSERT_EQ(offset, expected) << p << " " << i;
    }
  }

  Points points_;
  CloudOptions options_;
  NeighborSource source_;
  NeighborhoodFinder finder_;
  OffsetBuffer offsets_;
  NeighborhoodScratch scratch_;
};

/// n points of the unit square at height z, p = row 0 in its middle.
Points sheet(int n, double z, std::uint64_t seed) {
  Points points = shapes::square(n, shapes::Sampling::uniform, shapes::Rim::none, seed).points;
  points.col(2).setConstant(z);
  points.row(0) << 0.5, 0.5, z;
  return points;
}

Points together(const Points& a, const Points& b) {
  Points points(a.rows() + b.rows(), 3);
  points << a, b;
  return points;
}

TEST(Neighborhood, OnALineGrowsUntilItIsAPlane) {
  // Lines 40 times as far apart as the points on them.
  Points lines(9 * 401, 3);
  for (int i = 0; i < lines.rows(); ++i) lines.row(i) << (i % 401 - 200) * 0.01, (i / 401 - 4) * 0.4, 0;
  const Neighborhood neighborhood = Hoods(lines, {}).at(4 * 401 + 200);
  EXPECT_TRUE(neighborhood.grown);
  EXPECT_EQ(neighborhood.k, 120);  // 30 and 60 lie on one line
  EXPECT_NEAR(std::abs(neighborhood.axes.normal.z()), 1, 1e-12);
}

TEST(Neighborhood, OnAnEvenSurfaceStaysAsItIs) {
  const Points lattice = shapes::squareLattice(60, 1).points;
  for (const Growth growth : {Growth::line, Growth::uneven})
    EXPECT_FALSE(Hoods(lattice, {.steps = {.growth = growth, .split_sheets = false}}).at(30 * 60 + 30).grown);
}

TEST(Neighborhood, ThatIsCrowdedInTheMiddleGrowsWhenAskedTo) {
  // A dense spot of 16 points on a lattice: more than 40 % of the 30 nearest lie within half their radius.
  const Points lattice = shapes::squareLattice(60, 1).points;
  Points spot = 0.01 * shapes::squareLattice(4, 1).points;
  spot.rowwise() += lattice.row(30 * 60 + 30) + Eigen::RowVector3d(0.3, 0.3, 0) - spot.row(5);
  const Points points = together(spot, lattice);
  EXPECT_FALSE(Hoods(points, {.steps = {.growth = Growth::line, .split_sheets = false}}).at(5).grown);
  EXPECT_TRUE(Hoods(points, {.steps = {.growth = Growth::uneven, .split_sheets = false}}).at(5).grown);
}

TEST(Neighborhood, LeavesTheOtherSheetOut) {
  const int n = 4000;
  const double spacing = 1 / std::sqrt(double(n));
  const Points points = together(sheet(n, 0, 1), sheet(n, 4 * spacing, 2));
  const Neighborhood mixed = Hoods(points, {.neighbors = 60, .steps = cloudSteps(Preset::clean)}).at(0);
  const Neighborhood own = Hoods(points, {.neighbors = 60, .steps = cloudSteps(Preset::scan)}).at(0);
  const auto isOther = [&](const Neighbor& q) { return q.index >= n; };
  EXPECT_TRUE(std::any_of(mixed.neighbors.begin(), mixed.neighbors.end(), isOther));
  EXPECT_TRUE(std::none_of(own.neighbors.begin(), own.neighbors.end(), isOther));
  EXPECT_TRUE(own.split);
  EXPECT_FALSE(own.isolated);
  EXPECT_NEAR(std::abs(own.axes.normal.z()), 1, 1e-12);
  EXPECT_EQ(own.fit_radius, mixed.fit_radius);  // what was searched does not depend on what was kept
}

TEST(Neighborhood, HoldsOneOfTwoSheetsAtTwoSpacings) {
  // Random gaps leave some points, above all on the rim, with hardly more neighbours on their own sheet than across.
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const shapes::Cloud cloud = shapes::twoSheets(4000, 2 * std::sqrt(2.0 / 4000), seed);
    Hoods neighborhoods(cloud.points, {.steps = cloudSteps(Preset::scan)});
    int mixed = 0;
    for (int p = 0; p < 4000; ++p) {
      const Neighborhood neighborhood = neighborhoods.at(p);
      mixed += std::any_of(neighborhood.neighbors.begin(), neighborhood.neighbors.end(),
                           [&](const Neighbor& q) { return cloud.labels[q.index] != cloud.labels[p]; })
                   ? 1
                   : 0;
    }
    EXPECT_LE(mixed, 10) << seed;
  }
}

TEST(Neighborhood, OfANoisySheetIsNotSplit) {
  Points points = sheet(4000, 0, 3);
  shapes::Random random(4);
  for (int i = 0; i < points.rows(); ++i) points(i, 2) = 0.005 * random.normal();
  Hoods neighborhoods(points, {.steps = cloudSteps(Preset::scan)});
  int split = 0;
  for (int p = 0; p < 500; ++p) split += neighborhoods.at(p).split || neighborhoods.at(p).isolated ? 1 : 0;
  EXPECT_LE(split, 5);
}

TEST(Neighborhood, OfAPointBetweenSheetsIsIsolated) {
  const int n = 4000;
  const double spacing = 1 / std::sqrt(double(n));
  Points points = sheet(n, 0, 1);
  points.row(0) << 0.5, 0.5, 2.5 * spacing;  // an outlier
  const Neighborhood neighborhood = Hoods(points, {.steps = cloudSteps(Preset::scan)}).at(0);
  EXPECT_TRUE(neighborhood.isolated);
}

TEST(Neighborhood, MayLoseAllItsNeighbors) {
  // Two points far above each other and above all others: nothing lies within a quarter of the fit radius.
  Points points(12, 3);
  for (int i = 0; i < 12; ++i) points.row(i) << i % 3, i / 3 % 2, std::pow(3.0, i);
  Hoods neighborhoods(points, {.neighbors = 9, .steps = cloudSteps(Preset::scan)});
  for (int p = 0; p < points.rows(); ++p) {
    const Neighborhood neighborhood = neighborhoods.at(p);
    EXPECT_TRUE(!neighborhood.isolated || neighborhood.neighbors.size() <= 2) << p;
  }
}

}  // namespace
}  // namespace tufted::neighborhood_test
