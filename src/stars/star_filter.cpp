#include "stars/star_filter.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "base/power_of_two.h"
#include "stars/agreement.h"

namespace tufted {
namespace {

/// p sees further than the other two corners if its fit radius exceeds theirs by this factor. A smaller one removes
/// triangles at steps of density (1.5: 1.24 times the error of the core, 3: 1.18), a larger one leaves bridges from the
/// last ring of a scan.
constexpr double further = 2.75;
/// A triangle is dropped if its projected circumradius exceeds this many fit radii of its point. Not varied since the
/// first design.
constexpr double far_larger = 3;
/// A triangle with one vote is dropped if its squared circumradius exceeds this times the square of the smallest fit
/// radius. Not varied since the first design.
constexpr double doubtful_squared = 4;
/// With Filter::radius a triangle is dropped as a bridge if its circumradius exceeds this many smallest fit radii;
/// clean, nonuniform and scan-line clouds lose nothing.
constexpr double bridge = 4;

/// Whether the star of `a` contains the triangle (a, b, c) in either orientation.
bool contains(const Stars& stars, int a, int b, int c) {
  for (int i = stars.offset[a]; i < stars.offset[a + 1]; ++i) {
    const int x = stars.link[i], y = stars.link[stars.after(a, i)];
    if (stars.hasTriangle(i) && ((x == b && y == c) || (x == c && y == b))) return true;
  }
  return false;
}

/// How many stars of the other two corners contain the triangle at entry i of star p.
int otherVotes(const Stars& stars, int p, int i) {
  const int a = stars.link[i], b = stars.link[stars.after(p, i)];
  return (contains(stars, a, b, p) ? 1 : 0) + (contains(stars, b, p, a) ? 1 : 0);
}

/// otherVotes() for every triangle of star p; reads the star of each link vertex once.
/// @param[out] votes one per link entry
void countOtherVotes(const Stars& stars, int p, Buffer<int>& votes) {
  const int first = stars.offset[p], last = stars.offset[p + 1];
  votes.assign(static_cast<std::size_t>(last - first), 0);
  for (int i = first; i < last; ++i) {
    const int q = stars.link[i], j = entryOf(stars, q, p), previous = before(stars, p, i);
    if (j < 0) continue;
    const Sides there(stars, q, j);
    if (there.has(stars.link[stars.after(p, i)])) ++votes[i - first];
    if (there.has(stars.link[previous])) ++votes[previous - first];
  }
}

/// The squared circumradius in space over `length`, as a fraction, so that comparisons need no division; infinite for a
/// triangle without area.
struct SquaredRadius {
  double numerator, denominator;

  SquaredRadius(const PointsView& points, int p, int a, int b, double length) {
    // In a unit near `length`, because sixth powers of scaled coordinates may leave the range of a double.
    const double unit = magnitudeOf(length), in_units = 1 / unit, measure = length * in_units;
    const Eigen::Vector3d u = in_units * (points.row(a) - points.row(p));
    const Eigen::Vector3d v = in_units * (points.row(b) - points.row(p));
    numerator = u.squaredNorm() * v.squaredNorm() * (u - v).squaredNorm();
    denominator = 4 * u.cross(v).squaredNorm() * (measure * measure);
  }
  bool isAtMost(double square) const { return denominator > 0 && numerator <= square * denominator; }
};

/// Filter::radius: the circumradius exceeds S(p), as slivers along a rim do, or 4 times the smallest S of the three
/// corners, as bridges to outliers do.
bool isTooLarge(const BuiltStars& built, int p, int i) {
  const auto& [stars, support] = built;
  const int a = stars.link[i], b = stars.link[stars.after(p, i)];
  const double smallest = std::min({support.fit_radius[p], support.fit_radius[a], support.fit_radius[b]});
  return support.radius[i] > support.fit_radius[p] || support.radius[i] > bridge * smallest;
}

/// Filter::votes: the triangle is far larger than S(p), or has one vote and is large in space for the smallest S of its
/// corners, with a lower bound if p sees further than the other two.
bool isImplausible(const BuiltStars& built, const PointsView& points, int p, int i) {
  const auto& [stars, support] = built;
  const int a = stars.link[i], b = stars.link[stars.after(p, i)];
  if (support.radius[i] > far_larger * support.fit_radius[p]) return true;
  const double smallest = std::min({support.fit_radius[p], support.fit_radius[a], support.fit_radius[b]});
  const SquaredRadius radius(points, p, a, b, smallest);
  if (radius.isAtMost(1)) return false;
  const bool sees_further = support.fit_radius[p] > further * std::max(support.fit_radius[a], support.fit_radius[b]);
  if (radius.isAtMost(doubtful_squared) && !sees_further) return false;
  return otherVotes(stars, p, i) == 0;
}

/// Tests all triangles, then drops those with test(p, i). Returns their number.
template <class Test>
std::int64_t dropTriangles(Stars& stars, const Workers& workers, const Test& test) {
  Buffer<std::uint8_t> condemned(stars.link.size());
  std::atomic<std::int64_t> dropped{0};
  const auto forEachEntry = [&](const auto& visit) {
    workers.forBlocks("filter", stars.size(), cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
      for (int p = static_cast<int>(begin); p < end; ++p)
        for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i) visit(p, i);
    });
  };
  forEachEntry([&](int p, int i) {
    if (!stars.hasTriangle(i) || !test(p, i)) return;
    condemned[i] = 1;
    dropped.fetch_add(1, std::memory_order_relaxed);
  });
  if (dropped == 0) return 0;
  forEachEntry([&](int p, int i) {
    if (condemned[i] == 0) return;
    stars.triangle[i] = 0;
    stars.ends[p] = 1;
  });
  return dropped;
}

}  // namespace

void filterStars(BuiltStars& built, const PointsView& points, Filter filter, const Workers& workers, Report& report) {
  Stars& stars = built.stars;
  const StarSupport& support = built.support;
  if (stars.size() == 0) return;
  const bool any_isolated =
      std::any_of(support.isolated.begin(), support.isolated.end(), [](auto is) { return is != 0; });
  // Smaller triangles pass in any case, so their corners need not be read.
  const double harmless = *std::min_element(support.fit_radius.begin(), support.fit_radius.end());
  report.dropped_triangles += dropTriangles(stars, workers, [&](int p, int i) {
    if (any_isolated && (support.isolated[stars.link[i]] != 0 || support.isolated[stars.link[stars.after(p, i)]] != 0))
      return true;
    if (filter == Filter::votes) return isImplausible(built, points, p, i);
    return support.radius[i] > harmless && isTooLarge(built, p, i);
  });
}

void countVotes(const Stars& stars, const Buffer<std::uint8_t>& disagrees, const Workers& workers, Report& report) {
  std::array<std::atomic<std::int64_t>, 3> copies = {};
  workers.forBlocks("votes", stars.size(), cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
    std::array<std::int64_t, 3> found = {};
    Buffer<int> others;
    for (int p = static_cast<int>(begin); p < end; ++p) {
      const int first = stars.offset[p], last = stars.offset[p + 1];
      if (disagrees[p] == 0) {
        found[2] += last - first;
        continue;
      }
      countOtherVotes(stars, p, others);
      for (int i = first; i < last; ++i)
        if (stars.hasTriangle(i)) ++found[others[i - first]];
    }
    for (int v = 0; v < 3; ++v) copies[v] += found[v];
  });
  for (int v = 0; v < 3; ++v) report.votes[v] = copies[v] / (v + 1);  // each triangle was counted by v + 1 stars
}

}  // namespace tufted
