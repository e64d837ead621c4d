// Segments of shapes that a person would cut in one way.
#include "tufted/segments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include "shapes/shapes.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::segments_test {
namespace {

/// Two unit spheres that are joined by a neck of radius 0.3: each loses a cap there.
Points twoSpheres(int n) {
  const double cut = std::sqrt(1 - 0.09);
  const Points ball = shapes::sphere(n).points, other = shapes::sphere(n, shapes::Sampling::uniform, 2).points;
  std::vector<Eigen::RowVector3d> kept;
  for (int i = 0; i < n; ++i) {
    if (ball(i, 0) < cut) kept.emplace_back(ball(i, 0) - cut, ball(i, 1), ball(i, 2));
    if (other(i, 0) > -cut) kept.emplace_back(other(i, 0) + cut, other(i, 1), other(i, 2));
  }
  Points points(std::ssize(kept), 3);
  for (std::size_t i = 0; i < kept.size(); ++i) points.row(static_cast<Eigen::Index>(i)) = kept[i];
  return points;
}

/// The share of points whose label is the one that most points of their part have.
double purity(const std::vector<int>& labels, const std::vector<int>& parts) {
  std::map<int, std::map<int, int>> counts;
  for (std::size_t i = 0; i < labels.size(); ++i) ++counts[labels[i]][parts[i]];
  double pure = 0;
  for (const auto& [label, of_part] : counts) {
    int most = 0;
    for (const auto& [part, count] : of_part) most = std::max(most, count);
    pure += most;
  }
  return pure / static_cast<double>(labels.size());
}

TEST(Segments, OfTwoSpheresWithANeckAreTheSpheres) {
  const Points points = twoSpheres(3000);
  const Laplacian laplacian = pointCloudLaplacian(points);
  ASSERT_EQ(laplacian.report.components, 1);
  std::vector<int> sides;
  for (Eigen::Index i = 0; i < points.rows(); ++i) sides.push_back(points(i, 0) > 0 ? 1 : 0);
  for (const SegmentMethod method : {SegmentMethod::voronoi, SegmentMethod::spectral}) {
    const Segments found = segments(laplacian, {.method = method, .count = 2});
    EXPECT_GE(purity(found.labels, sides), 0.98);
    EXPECT_NEAR(found.areas[0], found.areas[1], 0.1 * found.areas[0]);
    EXPECT_NEAR(found.areas.sum(), laplacian.M.sum(), 1e-9);
  }
}

TEST(Segments, OfABoxWithSeedsOnItsFacesAreTheFaces) {
  const Points points = shapes::cubeSurface(6000).points;
  std::vector<int> faces, seeds(6, -1);
  Eigen::RowVector3d low = points.colwise().minCoeff(), high = points.colwise().maxCoeff();
  const Eigen::RowVector3d middle = (low + high) / 2;
  std::vector<double> nearest(6, INFINITY);
  for (int i = 0; i < 6000; ++i) {
    int axis = 0;
    const Eigen::RowVector3d offset = points.row(i) - middle;
    offset.cwiseAbs().maxCoeff(&axis);
    const int face = 2 * axis + (offset[axis] > 0 ? 1 : 0);
    faces.push_back(face);
    const double distance = offset.norm();
    if (distance < nearest[face]) nearest[face] = distance, seeds[face] = i;
  }
  const Segments found = segments(pointCloudLaplacian(points), {.seeds = seeds});
  EXPECT_GE(purity(found.labels, faces), 0.95);
  EXPECT_EQ(std::set<int>(found.seeds.begin(), found.seeds.end()), std::set<int>(seeds.begin(), seeds.end()));
}

TEST(Segments, ArePermutedWithThePoints) {
  const Points points = shapes::ellipsoid(2000).points;
  std::vector<int> order(2000);
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  const Laplacian laplacian = pointCloudLaplacian(points), shuffled = pointCloudLaplacian(points(order, Eigen::all));
  for (const SegmentMethod method : {SegmentMethod::voronoi, SegmentMethod::spectral}) {
    const Segments expected = segments(laplacian, {.method = method, .count = 5});
    const Segments found = segments(shuffled, {.method = method, .count = 5});
    for (int i = 0; i < 2000; ++i) EXPECT_EQ(found.labels[i], expected.labels[order[i]]);
  }
}

TEST(Segments, OfComponentsBeginWithTheLargest) {
  Points points(1200, 3);
  points << shapes::sphere(1000).points, shapes::sphere(200).points * 0.3;
  points.bottomRows(200).rowwise() += Eigen::RowVector3d(10, 0, 0);
  const Laplacian laplacian = pointCloudLaplacian(points);
  const Segments two = segments(laplacian, {.count = 2});
  EXPECT_EQ(two.labels[1100], -1);  // the other end of the large sphere is farther away than the small one is wide
  const Segments many = segments(laplacian, {.count = 10});
  EXPECT_GE(many.labels[1100], 0);
  for (int i = 0; i < 1200; ++i) EXPECT_EQ(many.labels[i] == many.labels[1100], i >= 1000);
  const Segments spectral = segments(laplacian, {.method = SegmentMethod::spectral, .count = 2});
  for (int i = 0; i < 1200; ++i) EXPECT_EQ(spectral.labels[i], i < 1000 ? 0 : 1);
}

TEST(Segments, OfOddPointsAreDefined) {
  Points points = shapes::sphere(500).points;
  points.row(3).setConstant(NAN);
  points.row(9) = points.row(1);
  points.row(12) << 50, 50, 50;
  const Laplacian laplacian = pointCloudLaplacian(points);
  for (const SegmentMethod method : {SegmentMethod::voronoi, SegmentMethod::spectral}) {
    for (const int count : {1, 2, 7}) {
      const Segments found = segments(laplacian, {.method = method, .count = count});
      EXPECT_EQ(found.labels[3], -1);
      EXPECT_EQ(found.labels[12], -1);
      EXPECT_EQ(found.labels[9], found.labels[1]);
      for (int i = 0; i < 500; ++i) EXPECT_EQ(found.labels[i] >= 0, i != 3 && i != 12);
      EXPECT_TRUE(std::is_sorted(found.areas.begin(), found.areas.end(), std::greater<>()));
    }
  }
  for (const int exponent : {-400, 400})
    EXPECT_EQ(segments(pointCloudLaplacian(points * std::ldexp(1.0, exponent)), {.count = 7}).labels,
              segments(laplacian, {.count = 7}).labels);
}

TEST(Segments, RefuseWhatDoesNotFit) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::sphere(100).points);
  const auto refusal = [&](const SegmentOptions& options) {
    return support::refusal([&] { segments(laplacian, options); });
  };
  EXPECT_EQ(refusal({.count = 0}), "segments: count = 0, must be at least 1");
  EXPECT_EQ(refusal({.count = 101}), "segments: count = 101, must be at most 100, the number of different places");
  EXPECT_EQ(refusal({.seeds = {100}}), "segments: seed 100, must lie in [0, 100)");
  EXPECT_EQ(refusal({.seeds = {1, 1}}), "segments: seed 1 is given twice, must be given once");
  EXPECT_EQ(refusal({.method = SegmentMethod::spectral, .seeds = {1}}),
            "segments: seeds are given, must be none with SegmentMethod::spectral");
  EXPECT_EQ(support::refusal([&] { segments(pointCloudLaplacian(Points(0, 3))); }),
            "segments: no point is active, must be at least one");
  EXPECT_THROW(segments(laplacian, {.solver = {.progress = [](std::string_view, double) { return false; }}}),
               Cancelled);
}

}  // namespace
}  // namespace tufted::segments_test
