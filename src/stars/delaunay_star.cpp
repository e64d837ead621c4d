// Section 5.7 of the paper: the Delaunay triangles at one point, without the triangulation of its neighbours.
#include "stars/delaunay_star.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/buffer.h"
#include "base/pseudo_angle.h"
#include "base/stable_sort.h"

namespace tufted {
namespace {

/// Most stars are found among this many nearest candidates; farther ones are tested only if the circles of that star
/// reach them.
constexpr std::size_t near_part = 12;
/// Pseudo-angles that differ by less than this are compared exactly; rounding moves them by a few 1e-16.
constexpr double key_rounding = 1e-14;
/// Factor on the squared diameter of the widest circle that covers the tie band.
constexpr double reach_slack = 1.001;

double squaredNorm(const PlanarPoint& q) {
  return q.u * q.u + q.v * q.v;
}

/// Whether a is nearer to the origin than b, in exactly the same direction.
bool isNearer(const PlanarPoint& a, const PlanarPoint& b) {
  return std::abs(a.u) + std::abs(a.v) < std::abs(b.u) + std::abs(b.v);
}

bool comesBefore(const Directed& a, const Directed& b) {
  const double difference = b.key - a.key;
  return std::abs(difference) > key_rounding ? difference > 0 : orientation(a.point, b.point) > 0;
}

/// Sorts points by direction and keeps the nearest in each direction; of equal positions the first.
void sortByDirection(Buffer<PlanarPoint>& points, Buffer<Directed>& directed, Buffer<Directed>& scratch) {
  directed.clear();
  for (const PlanarPoint& q : points) directed.push_back({pseudoAngle(q.u, q.v), q});
  stableSort(directed.data(), directed.data() + directed.size(), scratch, comesBefore);
  points.clear();
  for (std::size_t i = 0; i < directed.size(); ++i) {
    const PlanarPoint& q = directed[i].point;
    if (i == 0 || comesBefore(directed[i - 1], directed[i])) {
      points.push_back(q);
    } else if (isNearer(q, points.back())) {
      points.back() = q;
    }
  }
}

/// Whether link vertex b is removed: the diagonal (a, c) of the quadrilateral (p, a, b, c) is Delaunay.
bool isCutOff(int p, const PlanarPoint& a, const PlanarPoint& b, const PlanarPoint& c) {
  const CircleSide side = sideOfCircle(a, b, c);
  if (side == CircleSide::outside) return false;
  if (orientation(a, c) <= 0) return false;  // the gap without b would be pi or more
  return side == CircleSide::inside || std::min(a.index, c.index) < std::min(p, b.index);
}

}  // namespace

double circumradius(const PlanarPoint& a, const PlanarPoint& b) {
  const double cross = a.u * b.v - a.v * b.u;
  if (!(cross > 0)) return std::numeric_limits<double>::infinity();
  // Root by root: the product of the squares could overflow.
  const double opposite = (a.u - b.u) * (a.u - b.u) + (a.v - b.v) * (a.v - b.v);
  return std::sqrt(squaredNorm(a)) * std::sqrt(squaredNorm(b)) * std::sqrt(opposite) / (2 * cross);
}

double DelaunayStar::largestCircumradius() const {
  return radius.empty() ? 0 : *std::max_element(radius.begin(), radius.end());
}

void wrapChosen(int p, StarScratch& scratch, DelaunayStar& star) {
  Buffer<PlanarPoint>& ring = scratch.chosen;
  sortByDirection(ring, scratch.directed, scratch.sorted);
  const int m = static_cast<int>(ring.size());
  star.link.clear();
  star.radius.clear();
  star.closed = false;
  if (m < 2) {
    star.link = ring;
    return;
  }

  // A gap of pi or more, if there is one, becomes the end of the link.
  star.closed = m >= 3;
  for (int i = 0; i < m; ++i) {
    const int next = i + 1 < m ? i + 1 : 0;
    if (orientation(ring[i], ring[next]) <= 0) {
      std::rotate(ring.begin(), ring.begin() + next, ring.end());
      star.closed = false;
      break;
    }
  }
  if (m == 2 && orientation(ring[0], ring[1]) <= 0) return;  // on one line through p: no triangle

  scratch.next.resize(m);
  scratch.previous.resize(m);
  for (int i = 0; i < m; ++i) {
    scratch.next[i] = i + 1;
    scratch.previous[i] = i - 1;
  }
  scratch.next[m - 1] = 0;
  scratch.previous[0] = m - 1;
  int left = m;
  int first = 0;
  int settled = 0;  // consecutive vertices that are not cut off
  for (int b = 0; settled < left && left > 2;) {
    const int a = scratch.previous[b], c = scratch.next[b];
    const bool is_end = !star.closed && (b == first || c == first);
    if (is_end || !isCutOff(p, ring[a], ring[b], ring[c])) {
      ++settled;
      b = c;
      continue;
    }
    scratch.next[a] = c;
    scratch.previous[c] = a;
    if (b == first) first = c;
    --left;
    settled = 0;
    b = a;
  }
  for (int i = 0, at = first; i < left; ++i, at = scratch.next[at]) star.link.push_back(ring[at]);
  for (int i = 0; i < star.triangles(); ++i) star.radius.push_back(circumradius(star.link[i], star.after(i)));
}

void delaunayStar(const Buffer<PlanarPoint>& candidates, int p, StarScratch& scratch, DelaunayStar& star) {
  Buffer<PlanarPoint>& chosen = scratch.chosen;
  const auto hasDirection = [](const PlanarPoint& q) { return q.u != 0 || q.v != 0; };
  const std::size_t near = std::min(near_part, candidates.size());
  chosen.clear();
  std::copy_if(candidates.begin(), candidates.begin() + near, std::back_inserter(chosen), hasDirection);
  const std::size_t chosen_near = chosen.size();
  wrapChosen(p, scratch, star);
  if (near == candidates.size()) return;

  // Circles through p reach at most twice their radius, so only candidates within that can change a closed star.
  double reach = std::numeric_limits<double>::infinity();
  if (star.closed) reach = std::pow(2 * star.largestCircumradius(), 2) * reach_slack;
  chosen.clear();
  std::copy_if(candidates.begin(), candidates.begin() + near, std::back_inserter(chosen), hasDirection);
  std::copy_if(candidates.begin() + near, candidates.end(), std::back_inserter(chosen),
               [&](const PlanarPoint& q) { return hasDirection(q) && squaredNorm(q) <= reach; });
  if (chosen.size() > chosen_near) wrapChosen(p, scratch, star);
}

}  // namespace tufted
