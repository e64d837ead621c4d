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

TEST(Segments, PartsOfTwoSpheresWithANeckAreTheSpheres) {
  const Points points = twoSpheres(3000);
  std::vector<int> sides;
  for (Eigen::Index i = 0; i < points.rows(); ++i) sides.push_back(points(i, 0) > 0 ? 1 : 0);
  const Laplacian cloud = pointCloudLaplacian(points);
  const Segments found = segments(cloud, {.method = SegmentMethod::parts});
  ASSERT_EQ(found.areas.size(), 2);
  EXPECT_GE(purity(found.labels, sides), 0.98);
  EXPECT_TRUE(found.seeds.empty());
  const Triangles triangles = surfaceTriangles(cloud);
  const Laplacian mesh = meshLaplacian(points, triangles);
  const Segments of_mesh = segments(mesh, meshFrames(mesh, points, triangles), {.method = SegmentMethod::parts});
  ASSERT_EQ(of_mesh.areas.size(), 2);
  EXPECT_GE(purity(of_mesh.labels, sides), 0.98);
}

/// A box of side 1 that stands on a table of side 4, as a sensor above sees them: the table has no points beneath it.
struct BoxOnTable {
  Points points{Points::Zero(8000, 3)};
  std::vector<int> things;  ///< 1: the box

  explicit BoxOnTable(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    const auto next = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    while (things.size() < 8000) {
      const int face = static_cast<int>(21 * next());  // of equal areas: 4 sides, the top, the table
      const double u = next(), v = next();
      Eigen::RowVector3d point;
      if (face < 4) {
        point << u - 0.5, face % 2 == 0 ? 0.5 : -0.5, v;
        if (face < 2) std::swap(point[0], point[1]);
      } else if (face == 4) {
        point << u - 0.5, v - 0.5, 1;
      } else {
        point << 4 * u - 2, 4 * v - 2, 0;
        if (std::abs(point[0]) < 0.5 && std::abs(point[1]) < 0.5) continue;
      }
      points.row(std::ssize(things)) = point;
      things.push_back(face < 5 ? 1 : 0);
    }
  }
};

TEST(Segments, PartsOfABoxOnATableAreTheBoxAndTheTable) {
  const Eigen::Vector3d above(0.3, 0.2, 20);
  for (const std::uint64_t seed : {101, 102}) {
    const BoxOnTable scene(seed);
    CloudOptions options;
    options.viewpoint = &above;
    const Segments found = segments(pointCloudLaplacian(scene.points, options), {.method = SegmentMethod::parts});
    ASSERT_EQ(found.areas.size(), 2);
    EXPECT_GE(purity(found.labels, scene.things), 0.99);
    EXPECT_NEAR(found.areas[1], 5, 0.2);
  }
}

TEST(Segments, PartsOfAConvexShapeAreTheShape) {
  for (const shapes::Cloud& cloud : {shapes::sphere(3000), shapes::ellipsoid(3000), shapes::cubeSurface(6000),
                                     shapes::square(3000), shapes::cylinderPatch(3000)}) {
    for (const double noise : {0.0, 0.2}) {
      const double spacing = std::sqrt(cloud.area / static_cast<double>(cloud.points.rows()));
      const Points points = noise > 0 ? shapes::withNoise(cloud, noise * spacing, 101).points : cloud.points;
      EXPECT_EQ(segments(pointCloudLaplacian(points), {.method = SegmentMethod::parts}).areas.size(), 1)
          << cloud.name << ", noise " << noise;
    }
  }
}

TEST(Segments, PartsHaveAtLeastAsManyPointsAsAsked) {
  const Laplacian laplacian = pointCloudLaplacian(twoSpheres(1000));
  for (const int least : {1, 100, 5000}) {
    const Segments found = segments(laplacian, {.method = SegmentMethod::parts, .least_points = least});
    std::map<int, int> counts;
    for (const int label : found.labels) ++counts[label];
    ASSERT_EQ(std::ssize(counts), found.areas.size());
    for (const auto& [label, count] : counts) EXPECT_GE(count, least == 5000 ? std::ssize(found.labels) : least);
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

TEST(Segments, OfSeedsThatAreFoundAreTheCellsOfTheseSeeds) {
  for (const int points : {2000, 8000}) {  // whose triangles are cut twice and once
    const Laplacian laplacian = pointCloudLaplacian(shapes::ellipsoid(points).points);
    const Segments found = segments(laplacian, {.count = 9});
    EXPECT_EQ(segments(laplacian, {.seeds = found.seeds}).labels, found.labels);
  }
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

TEST(Segments, PartsArePermutedWithThePoints) {
  const Points points = twoSpheres(2000);
  std::vector<int> order(points.rows());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  const SegmentOptions parts{.method = SegmentMethod::parts};
  const Segments expected = segments(pointCloudLaplacian(points), parts);
  const Segments found = segments(pointCloudLaplacian(points(order, Eigen::all)), parts);
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(found.labels[i], expected.labels[order[i]]);
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
  const SegmentOptions parts{.method = SegmentMethod::parts, .least_points = 5};
  const Segments of_parts = segments(laplacian, parts);
  EXPECT_EQ(of_parts.labels[9], of_parts.labels[1]);
  for (int i = 0; i < 500; ++i) EXPECT_EQ(of_parts.labels[i] >= 0, i != 3 && i != 12);
  for (const int exponent : {-400, 400}) {
    const Laplacian scaled = pointCloudLaplacian(points * std::ldexp(1.0, exponent));
    EXPECT_EQ(segments(scaled, parts).labels, of_parts.labels);
  }
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
  EXPECT_EQ(refusal({.method = SegmentMethod::parts, .seeds = {1}}),
            "segments: seeds are given, must be none with SegmentMethod::parts");
  EXPECT_EQ(refusal({.method = SegmentMethod::parts, .count = 3}),
            "segments: count = 3, must be none with SegmentMethod::parts");
  EXPECT_EQ(refusal({.method = SegmentMethod::parts, .crease = 0}),
            "segments: crease = 0, must be positive and finite");
  EXPECT_EQ(refusal({.method = SegmentMethod::parts, .least_points = 0}),
            "segments: least_points = 0, must be at least 1");
  EXPECT_EQ(support::refusal([&] { segments(pointCloudLaplacian(Points(0, 3))); }),
            "segments: no point is active, must be at least one");
  EXPECT_THROW(segments(laplacian, {.solver = {.progress = [](std::string_view, double) { return false; }}}),
               Cancelled);
}

}  // namespace
}  // namespace tufted::segments_test
