// Our stars against CGAL's Delaunay triangulation of the same projected doubles.
#include "stars/delaunay_star.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "neighbors/neighbors.h"
#include "oracles/oracles.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "simd/kernels.h"
#include "stars/inverted_star.h"
#include "stars/offsets.h"
#include "stars/star_gap.h"
#include "stars/tangent_frame.h"
#include "support/compare_stars.h"
#include "support/ranked.h"

namespace tufted::delaunay_star_test {
namespace {

void expectStarsOfCloud(const std::string& name, const Points& points) {
  const support::StarComparison comparison = support::compareStars(points, 1);
  EXPECT_EQ(comparison.different, 0) << name << ": " << comparison.first_difference;
  EXPECT_GT(comparison.stars, 0) << name;
}

TEST(DelaunayStar, EqualsCgalOnEveryPointOfEveryGeneratedCloud) {
  for (const auto& cloud : shapes::allClouds(500)) expectStarsOfCloud(cloud.name, cloud.points);
}

/// The short cut through the convex hull may decline, not differ; and it is the same bits on any processor.
TEST(DelaunayStar, OfTheShortCutIsThatOfTheExactWay) {
  StarScratch scratch;
  Buffer<Neighbor> neighbors;
  int inverted = 0, with_ties = 0, gaping = 0, all = 0;
  for (const auto& shape : shapes::allClouds(1500)) {
    const RankedCloud cloud = support::ranked(shape.points);
    const NeighborSearch search(cloud.points);
    for (int p = 0; p < cloud.size(); ++p) {
      search.nearest(p, p % 2 == 0 ? 30 : 60, neighbors);
      const Eigen::Vector3d normal = principalAxes(cloud.points, p, neighbors).normal;
      const Eigen::Vector3d x = tangentOf(normal), y = normal.cross(x);
      OffsetBuffer offsets;
      PlanarOffsets planar;
      offsets.take(cloud.points, p, neighbors);
      kernels().project(offsets.view(), 1, x.data(), y.data(), planar);
      Buffer<PlanarPoint> candidates;
      for (int i = 0; i < planar.count; ++i) candidates.push_back({planar.u[i], planar.v[i], neighbors[i].index});
      DelaunayStar exact, star, portable;
      delaunayStar(candidates, p, scratch, exact);
      ++all;
      Buffer<PlanarPoint> tied, tied_portable;
      const StarKind kind = wrapInverted(kernels(), planar, neighbors, star, tied);
      ASSERT_EQ(wrapInverted(portableKernels(), planar, neighbors, portable, tied_portable), kind);
      if (kind == StarKind::gaping) {  // most often open, and certainly that of all
        scratch.chosen = candidates;
        wrapChosen(p, scratch, star);
        ASSERT_EQ(star.closed, exact.closed) << shape.name << " point " << p;
        ASSERT_EQ(star.radius, exact.radius);
        ++gaping;
        continue;
      }
      if (kind == StarKind::unknown) continue;
      ++inverted;
      if (kind == StarKind::tied) {
        ++with_ties;
        delaunayStar(tied, p, scratch, star);
        delaunayStar(tied_portable, p, scratch, portable);
        ASSERT_EQ(tied.size(), tied_portable.size());
        ASSERT_TRUE(star.closed);
      }
      ASSERT_EQ(star.radius, portable.radius);
      ASSERT_TRUE(exact.closed) << shape.name << " point " << p;
      ASSERT_EQ(star.link.size(), exact.link.size()) << shape.name << " point " << p;
      for (std::size_t i = 0; i < star.link.size(); ++i) {
        ASSERT_EQ(star.link[i].index, exact.link[i].index);
        ASSERT_EQ(star.link[i].index, portable.link[i].index);
        ASSERT_NEAR(star.radius[i], exact.radius[i], 1e-9 * exact.radius[i]);
      }
    }
  }
  EXPECT_GT(4 * inverted, 3 * all);  // worth its while
  EXPECT_GT(with_ties, 1000);
  EXPECT_GT(gaping, 1000);
}

TEST(DelaunayStar, OfALatticeTakesTheDiagonalOfTheSmallestIndex) {
  // The unit square around its corner p = 0 or with p as the largest index.
  const Buffer<PlanarPoint> square = {{1, 0, 1}, {0, 1, 2}, {1, 1, 3}};
  StarScratch scratch;
  DelaunayStar star;
  delaunayStar(square, 0, scratch, star);
  EXPECT_EQ(star.triangles(), 2);  // the diagonal starts at 0
  Buffer<PlanarPoint> shifted = square;
  for (PlanarPoint& q : shifted) --q.index;  // now 0, 1, 2 and p = 3
  delaunayStar(shifted, 3, scratch, star);
  EXPECT_EQ(star.triangles(), 1);  // the diagonal joins 0 and 1
}

TEST(DelaunayStar, HasNoTriangleAmongCollinearPoints) {
  StarScratch scratch;
  DelaunayStar star;
  for (const double slope : {0.0, 1.0, 0.375}) {
    Buffer<PlanarPoint> line;
    for (int i = -5; i <= 5; ++i) line.push_back({double(i), slope * i, i + 5});
    delaunayStar(line, 20, scratch, star);
    EXPECT_EQ(star.triangles(), 0);
    EXPECT_FALSE(star.closed);
  }
}

TEST(DelaunayStar, DropsWhatHasNoDirectionAndKeepsTheNearestInEach) {
  StarScratch scratch;
  DelaunayStar star;
  const Buffer<PlanarPoint> points = {{0, 0, 1}, {2, 0, 2}, {1, 0, 3}, {0, 1, 4}, {-1, 0, 5}, {0, -1, 6}, {1, 0, 7}};
  delaunayStar(points, 0, scratch, star);
  ASSERT_EQ(star.link.size(), 4U);
  EXPECT_EQ(star.link[0].index, 3);  // not 7, which projects to the same place but is further away in space
  EXPECT_TRUE(star.closed);
}

TEST(DelaunayStar, IsRightForPointsOnTinyAndHugeScales) {
  shapes::Random random(4);
  StarScratch scratch;
  DelaunayStar star, scaled_star;
  for (const int exponent : {-300, -150, 150, 300}) {
    Buffer<PlanarPoint> points, scaled;
    for (int i = 0; i < 30; ++i) points.push_back({random.uniform(-1, 1), random.uniform(-1, 1), i});
    for (const auto& q : points) scaled.push_back({std::ldexp(q.u, exponent), std::ldexp(q.v, exponent), q.index});
    delaunayStar(points, 99, scratch, star);
    delaunayStar(scaled, 99, scratch, scaled_star);
    ASSERT_EQ(star.link.size(), scaled_star.link.size()) << exponent;
    for (std::size_t i = 0; i < star.link.size(); ++i) EXPECT_EQ(star.link[i].index, scaled_star.link[i].index);
  }
}

__extension__ typedef __int128 Wide;

TEST(Orientation, OfNearlyCollinearPointsIsTheSignOfTheExactDeterminant) {
  shapes::Random random(3);
  std::array<int, 3> seen = {};
  for (int i = 0; i < 100000; ++i) {
    // Whole numbers of up to 50 bits, whose products 128 bits hold: b is next to a multiple of a short vector, as a is.
    const double size = std::ldexp(1, static_cast<int>(random.uniform(2, 24)));
    const std::int64_t u = std::llround(random.uniform(-size, size)), v = std::llround(random.uniform(-size, size));
    const std::int64_t s = std::llround(random.uniform(1, 1 << 24)), t = std::llround(random.uniform(1, 1 << 24));
    const auto off = [&] { return std::llround(random.uniform(-1.4, 1.4)); };
    const std::int64_t au = s * u + off(), av = s * v + off(), bu = t * u + off(), bv = t * v + off();
    const Wide exact = static_cast<Wide>(au) * bv - static_cast<Wide>(av) * bu;
    const int sign = exact > 0 ? 1 : exact < 0 ? -1 : 0;
    ++seen[sign + 1];
    for (const int exponent : {0, -440, -560, 300}) {  // the last but one has products that underflow
      const auto scaled = [&](std::int64_t x) { return std::ldexp(static_cast<double>(x), exponent); };
      ASSERT_EQ(orientation({scaled(au), scaled(av), 0}, {scaled(bu), scaled(bv), 0}), sign)
          << au << ' ' << av << ' ' << bu << ' ' << bv << ' ' << exponent;
    }
  }
  EXPECT_GT(*std::min_element(seen.begin(), seen.end()), 1000);
}

TEST(SideOfCircle, AgreesWithTheSignOfTheAngleSum) {
  shapes::Random random(9);
  for (int i = 0; i < 10000; ++i) {
    const double s = random.uniform(0.1, 3), t = random.uniform(s, 3.1), r = random.uniform(0.2, 2);
    // a, b, c in order on a circle through the origin, then b's opposite moved by a relative amount.
    const auto on = [&](double angle) { return PlanarPoint{r * (1 - std::cos(angle)), -r * std::sin(angle), 0}; };
    const PlanarPoint c = on(s), b = on(t), a = on(random.uniform(t, 6.2));
    if (orientation(a, b) <= 0 || orientation(b, c) <= 0) continue;
    EXPECT_EQ(sideOfCircle(a, b, c), CircleSide::tie);
    EXPECT_EQ(sideOfCircle(a, b, {c.u * 0.99, c.v * 0.99, 0}), CircleSide::inside);
    EXPECT_EQ(sideOfCircle(a, b, {c.u * 1.01, c.v * 1.01, 0}), CircleSide::outside);
  }
}

/// A gap that is said to be left is, and none is missed but for rounding, gaps of just pi among them.
TEST(StarGap, IsOpenWhereTheStarOfMorePointsIs) {
  shapes::Random random(11);
  StarScratch scratch;
  int open = 0, found = 0, closed = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    // Few points of a half-plane, then more of a wider wedge; every other time on a lattice, with gaps of just pi.
    const double width = (0.8 + 0.5 * random.uniform()) * std::numbers::pi, turn = 7 * random.uniform();
    Buffer<PlanarPoint> points;
    for (int i = 0; i < 12; ++i) {
      const double share = i < 6 ? 0.2 + 0.5 * random.uniform() : random.uniform();
      const double angle = turn + share * width, radius = 0.1 + random.uniform();
      PlanarPoint q{radius * std::cos(angle), radius * std::sin(angle), i + 1};
      if (trial % 2 == 0) q = {std::round(2 * q.u), std::round(2 * q.v), i + 1};
      points.push_back(q);
    }
    DelaunayStar few, star;
    delaunayStar({points.begin(), points.begin() + 6}, 0, scratch, few);
    if (few.closed) continue;
    const bool is_left = leaveGap(points, middleOfGap(few));
    delaunayStar(points, 0, scratch, star);
    ASSERT_FALSE(is_left && star.closed) << trial;
    open += star.closed ? 0 : 1;
    closed += star.closed ? 1 : 0;
    found += is_left ? 1 : 0;
  }
  EXPECT_GT(closed, 1000);
  EXPECT_GT(open, 1000);
  EXPECT_GE(found, open - 2);
}

}  // namespace
}  // namespace tufted::delaunay_star_test
