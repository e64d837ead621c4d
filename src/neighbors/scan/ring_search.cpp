#include "neighbors/scan/ring_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/stage_clock.h"

namespace tufted {
namespace {

/// First step of the search for the foot on a ring, so long that noise of single points does not stop it.
constexpr int first_stride = 16;
/// The first 16 points of a ring on either side are all candidates; farther ones, ever more sparsely, serve the plane
/// and not the star.
constexpr int dense_steps = 16;
/// Rings that are searched on each side; farther ones have no part in a star.
constexpr int searched_rings = 2;
/// Number of neighbours whose ball has a radius of one spacing, half the default k: with k = 30 it has 1.4 spacings.
constexpr double neighbors_per_spacing = 15;
/// The walk along a ring ends after this many consecutive points outside the ball: the surface has ended.
constexpr int most_misses = 2;

/// The radius of the ball that is searched: as far as a star reaches if points are nowhere denser than across the
/// rings, 1.4 spacings for 30 neighbours. Points beyond, above all on a sparse ring, mostly lie behind a crease or
/// jump.
double ballRadius(int k, double spacing) {
  return std::sqrt(k / neighbors_per_spacing) * spacing;
}

/// The largest finite number of the two; 0 if there is none.
double larger(double a, double b) {
  return std::max(std::isfinite(a) ? a : 0, std::isfinite(b) ? b : 0);
}

/// The step after `steps`: all up to 16, then 24, 32, 48, 64, ..., two per octave.
int nextStep(int steps) {
  if (steps < dense_steps) return steps + 1;
  const bool is_power = (steps & (steps - 1)) == 0;
  return is_power ? steps + steps / 2 : steps + steps / 3;
}

}  // namespace

RingSearch::RingSearch(const RankedScan& scan, const RankedCloud& cloud) : place_(scan.row.size(), -1) {
  Buffer<int> order;
  for (int p = 0; p < cloud.size(); ++p)
    if (scan.row[p] >= 0) order.push_back(p);
  std::sort(order.begin(), order.end(), [&scan](int a, int b) {
    if (scan.row[a] != scan.row[b]) return scan.row[a] < scan.row[b];
    return scan.position[a] != scan.position[b] ? scan.position[a] < scan.position[b] : a < b;
  });
  points_.resize(std::ssize(order));
  azimuth_.resize(order.size());
  ring_.resize(order.size());
  for (int i = 0; i < static_cast<int>(order.size()); ++i) {
    const int p = order[i];
    if (i == 0 || scan.row[p] != scan.row[order[i - 1]]) begin_.push_back(i);
    place_[p] = i;
    points_.row(i) = cloud.points.row(p);
    azimuth_[i] = scan.position[p];
    ring_[i] = static_cast<int>(begin_.size()) - 1;
  }
  begin_.push_back(static_cast<int>(order.size()));
  rank_ = std::move(order);
}

double RingSearch::nearest(int p, int k, Buffer<Neighbor>& found) const {
  found.clear();
  if (place_[p] < 0) return 0;
  const int self = place_[p];
  const int own = ring_[self];
  const auto [above, below] = std::pair(footOn(own + 1, self, self), footOn(own - 1, self, self));
  const double radius =
      ballRadius(k, larger(std::min(distanceTo(self, above), distanceTo(self, below)),
                           std::min(distanceTo(self, stepped(self, 1)), distanceTo(self, stepped(self, -1)))));
  addRing(self, self, radius, found);
  for (const int side : {1, -1}) {
    int foot = side > 0 ? above : below;
    for (int rings = 1; rings <= searched_rings && distanceTo(self, foot) <= radius; ++rings) {
      addRing(self, foot, radius, found);
      foot = footOn(own + side * (rings + 1), self, foot);
    }
  }
  std::sort(found.begin(), found.end());
  return radius;
}

std::size_t RingSearch::bytes() const {
  return bytesOf(place_) + bytesOf(rank_) + bytesOf(ring_) + bytesOf(azimuth_) + bytesOf(begin_) + points_.bytes();
}

int RingSearch::stepped(int place, int steps) const {
  const int ring = ring_[place], size = ringSize(ring);
  const int to = begin_[ring] + ((place - begin_[ring] + steps) % size + size) % size;
  return to == place ? -1 : to;
}

double RingSearch::distanceTo(int a, int b) const {
  return b < 0 ? std::numeric_limits<double>::infinity() : std::sqrt(squaredDistance(a, b));
}

int RingSearch::footOn(int ring, int self, int from) const {
  if (ring < 0 || ring + 1 >= static_cast<int>(begin_.size())) return -1;
  const auto first = azimuth_.begin() + begin_[ring], last = azimuth_.begin() + begin_[ring + 1];
  auto start = std::lower_bound(first, last, azimuth_[from]);
  if (start == last) start = first;
  int best = static_cast<int>(start - azimuth_.begin());
  double nearest = squaredDistance(self, best);
  for (int stride = std::min(first_stride, ringSize(ring) / 4 + 1); stride > 0; stride /= 2) {
    for (const int step : {stride, -stride}) {
      for (int tried = stepped(best, step); tried >= 0; tried = stepped(best, step)) {
        const double distance = squaredDistance(self, tried);
        if (!(distance < nearest)) break;
        best = tried;
        nearest = distance;
      }
    }
  }
  return best;
}

void RingSearch::addRing(int self, int foot, double radius, Buffer<Neighbor>& found) const {
  if (foot != self) found.push_back({squaredDistance(self, foot), rank_[foot]});
  const double most = radius * radius;
  const int size = ringSize(ring_[foot]);
  for (const int side : {1, -1}) {
    const int half = (side > 0 ? size : size - 1) / 2;  // so that the opposite point is visited once
    int misses = 0;
    for (int steps = 1; steps <= half; steps = nextStep(steps)) {
      const int place = stepped(foot, side * steps);
      const double distance = squaredDistance(self, place);
      if (distance <= most) {
        misses = 0;
        found.push_back({distance, rank_[place]});
      } else if (++misses == most_misses) {
        break;
      }
    }
  }
}

}  // namespace tufted
