#include "algorithms/geodesic_windows.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "algorithms/apex.h"
#include "base/cross.h"
#include "base/infinity.h"
#include "cover/geometry.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

using Eigen::Vector2d;

/// A vertex no farther from a line than this, in the unit of the lengths, counts as on it. Rounding moves lines by
/// less.
constexpr double on_line = 1e-11;
/// Paths bend by more than this, radians: rounding of the angles around a vertex is less.
constexpr double least_bend = 1e-9;
constexpr std::int64_t windows_between_reports = 65536;
/// Most windows per vertex, and beside that. A torus of 16,000 points has 83 per vertex, and they grow with the root of
/// the number of vertices. In thin triangles lines wind around their tips without an end.
constexpr std::int64_t most_per_vertex = 2000, most_windows = 1'000'000;

}  // namespace

GeodesicWindows::GeodesicWindows(const IntrinsicTriangulation& surface, int exponent, int source,
                                 const Workers& workers)
    : surface_(surface),
      unit_(std::ldexp(1.0, exponent)),
      distance_(static_cast<std::size_t>(surface.vertices), infinity),
      turn_(distance_.size(), 0),
      arrival_(distance_.size()),
      offset_(distance_.size() + 1, 0),
      sides_(surface.glue.size()),
      nearest_(surface.glue.size()) {
  for (const auto& corners : surface.faces)
    for (const int corner : corners) ++offset_[corner + 1];
  std::partial_sum(offset_.begin(), offset_.end(), offset_.begin());
  std::vector<int> fill(offset_.begin(), offset_.end() - 1);
  for (int side = 0; side < std::ssize(sides_); ++side) sides_[fill[tail(surface, side)]++] = side;
  is_manifold_ = isManifold();
  distance_[source] = 0;
  sectors_ = sectorsAt(source);
  leaveSource();
  std::int64_t done = 0, settled = 0;
  while (!windows_.empty() || !bends_.empty()) {
    if (!bends_.empty() && (windows_.empty() || bends_.top().key <= windows_.top().key)) {
      const Bend next = bends_.top();
      bends_.pop();
      if (next.key != distance_[next.vertex]) continue;
      ++settled;
      bend(next.vertex);
      continue;
    }
    const Window window = windows_.top();
    windows_.pop();
    cross(window);
    if (done++ % windows_between_reports == 0) workers.report("paths", static_cast<double>(settled) / surface.vertices);
    if (done > most_windows + most_per_vertex * surface.vertices)
      throw SolverFailure(
          "LogMapSolver::query: " + std::to_string(done) +
          " windows were followed without an end, as in thin triangles or around a vertex of thousands; "
          "take the method heat");
  }
}

std::vector<Sector> GeodesicWindows::sectorsAt(int vertex) const {
  const auto begin = sides_.begin() + offset_[vertex], end = sides_.begin() + offset_[vertex + 1];
  std::vector<std::uint8_t> is_done(static_cast<std::size_t>(end - begin), 0);
  const auto isDone = [&](int side) -> std::uint8_t& { return is_done[std::lower_bound(begin, end, side) - begin]; };
  const auto rightOf = [&](int side) { return surface_.glue[side] < 0 ? -1 : nextSide(surface_.glue[side]); };
  const auto leftOf = [&](int side) { return surface_.glue[previousSide(side)]; };
  std::vector<Sector> sectors;
  double turn = 0;
  int fan = 0;
  for (auto it = begin; it != end; ++it) {
    if (isDone(*it) != 0) continue;
    int first = *it;
    for (int side = rightOf(first); side >= 0 && side != *it; side = rightOf(side)) first = side;
    for (int side = first; side >= 0 && isDone(side) == 0; side = leftOf(side)) {
      isDone(side) = 1;
      const double right = lengthOf(side), left = lengthOf(previousSide(side)), across = lengthOf(nextSide(side));
      const Vector2d apex =
          apexLeftOf(Vector2d::Zero(), Vector2d(right, 0), left, across, 2 * triangleArea(right, left, across));
      sectors.push_back({side, turn, std::atan2(apex.y(), apex.x()), fan});
      turn += sectors.back().angle;
    }
    ++fan;
  }
  return sectors;
}

/// Whether at most two triangles meet at each edge.
bool GeodesicWindows::isManifold() const {
  std::vector<int> heads;
  for (std::size_t v = 0; v + 1 < offset_.size(); ++v) {
    heads.clear();
    for (int i = offset_[v]; i < offset_[v + 1]; ++i) heads.push_back(head(surface_, sides_[i]));
    std::sort(heads.begin(), heads.end());
    for (std::size_t i = 2; i < heads.size(); ++i)
      if (heads[i] == heads[i - 2]) return false;
  }
  return true;
}

/// Which fans are front and back of one part of the surface with a given one. Paths on the one are mirror images of
/// those on the other, unless front and back are connected with different parts where more than two triangles meet.
std::vector<std::uint8_t> GeodesicWindows::mirrorsOf(const std::vector<Sector>& sectors, int fan) const {
  std::vector<std::vector<int>> heads;  // of each fan
  for (const Sector& sector : sectors) {
    heads.resize(static_cast<std::size_t>(sector.fan) + 1);
    heads.back().push_back(head(surface_, sector.side));
  }
  for (std::vector<int>& of_fan : heads) std::sort(of_fan.begin(), of_fan.end());
  std::vector<std::uint8_t> result;
  for (int other = 0; other < std::ssize(heads); ++other)
    result.push_back(is_manifold_ && other != fan && heads[other] == heads[fan] ? 1 : 0);
  return result;
}

void GeodesicWindows::reach(int vertex, double distance, double turn, const Arrival& arrival) {
  if (!(distance < distance_[vertex])) return;
  distance_[vertex] = distance;
  turn_[vertex] = turn;
  arrival_[vertex] = arrival;
  bends_.push({distance, vertex});
}

/// Starts a window in the directions of a sector from `low` to `high`, angles from its side.
/// @param window with its members `before`, `turn`, here of the side, and `has_bent`
void GeodesicWindows::leave(const Sector& sector, double low, double high, const Window& window) {
  const int right_side = sector.side, left_side = previousSide(sector.side), across = nextSide(sector.side);
  const Vector2d right(lengthOf(right_side), 0), left = polar(lengthOf(left_side), sector.angle);
  if (low <= 0)
    reach(head(surface_, right_side), window.before + right.x(), window.turn,
          {across, angleBetween(left - right, -right)});
  if (high >= sector.angle)
    reach(tail(surface_, left_side), window.before + lengthOf(left_side),
          window.has_bent ? window.turn : window.turn + sector.angle, {left_side, 0});
  Window started = window;
  started.door = {surface_.glue[across], left, right};
  started.low = polar(1, std::max(low, 0.0));
  started.high = polar(1, std::min(high, sector.angle));
  add(started, nullptr);
}

/// Starts windows in all directions, on one side of the surface if the other is its mirror image.
void GeodesicWindows::leaveSource() {
  const std::vector<std::uint8_t> is_mirror = mirrorsOf(sectors_, 0);
  for (const Sector& sector : sectors_)
    if (is_mirror[sector.fan] == 0)
      leave(sector, 0, sector.angle, {.before = 0, .turn = sector.begin, .has_bent = false});
}

/// Starts windows where a path bends: in the directions more than half a circle from the way back, on both sides.
void GeodesicWindows::bend(int vertex) {
  const std::vector<Sector> sectors = sectorsAt(vertex);
  const Arrival arrival = arrival_[vertex];
  const auto from =
      std::find_if(sectors.begin(), sectors.end(), [&](const Sector& s) { return s.side == arrival.side; });
  const auto [first, last] = std::equal_range(sectors.begin(), sectors.end(), *from,
                                              [](const Sector& a, const Sector& b) { return a.fan < b.fan; });
  const double back = from->begin + arrival.angle;
  const double total = std::prev(last)->begin + std::prev(last)->angle - first->begin;
  const double half = std::numbers::pi + least_bend / 2;
  const Window window = {.before = distance_[vertex], .turn = turn_[vertex], .has_bent = true};
  const std::vector<std::uint8_t> is_mirror = mirrorsOf(sectors, from->fan);
  for (const Sector& sector : sectors) {
    const auto leaveBetween = [&](double low, double high) {
      low = std::max(low - sector.begin, 0.0);
      high = std::min(high - sector.begin, sector.angle);
      if (low < high) leave(sector, low, high, window);
    };
    if (sector.fan != from->fan) {
      if (is_mirror[sector.fan] == 0) leaveBetween(-infinity, infinity);
    } else if (surface_.glue[first->side] < 0) {
      leaveBetween(back + half, infinity);
      leaveBetween(-infinity, back - half);
    } else {
      leaveBetween(back + half, back - half + total);
      leaveBetween(back + half - total, back - half);
    }
  }
}

/// Adds a window unless a path around one of its side's ends, or the corner behind, is shorter everywhere.
void GeodesicWindows::add(Window window, const Behind* behind) {
  const int side = window.door.side;
  if (side < 0) return;
  const Vector2d left = window.door.left, right = window.door.right;
  const auto [low_end, high_end, distance] = partBetween(window.door, window.low, window.high);
  if (!((high_end - low_end).squaredNorm() > on_line * on_line)) return;
  window.key = window.before + distance;
  const auto isLonger = [&](int vertex, const Vector2d& at, const Vector2d& end) {
    return distance_[vertex] + (at - end).norm() + on_line < window.before + end.norm();
  };
  if (isLonger(head(surface_, side), right, high_end) || isLonger(tail(surface_, side), left, low_end)) return;
  if (behind != nullptr && isLonger(behind->vertex, behind->at, behind->is_low_far ? low_end : high_end)) return;
  windows_.push(window);
}

/// Continues a window through the two other sides of the face behind it. If a vertex lies on a bound of the window,
/// lines pass it on both sides.
void GeodesicWindows::cross(const Window& window) {
  const Door& door = window.door;
  const int right_side = nextSide(door.side), left_side = previousSide(door.side);
  const Vector2d apex = apexOf(surface_, unit_, door);
  const Passing passing = passingOf(window.low, window.high, apex);
  bool passes_right = passing.from_low >= -on_line, passes_left = passing.from_high <= on_line;
  if (passes_right && passes_left) {
    const double distance = window.before + apex.norm();
    reach(tail(surface_, left_side), distance,
          window.has_bent ? window.turn : window.turn + std::atan2(apex.y(), apex.x()),
          {left_side, angleBetween(door.left - apex, -apex)});
    // Of two windows that see the vertex through this side, the one from which it is nearer goes on on both sides of
    // it, the other one on its own side only, as shortest paths do not cross. Where paths change their sheet, that has
    // lost some of them.
    const double to_left = std::abs(tufted::cross(apex, door.left)),
                 to_right = std::abs(tufted::cross(apex, door.right));
    const double place = to_left / (to_left + to_right);
    Nearest& nearest = nearest_[door.side];
    if (distance < nearest.distance)
      nearest = {distance, place};
    else if (is_manifold_ && distance > nearest.distance + on_line)
      (place < nearest.place ? passes_right : passes_left) = false;
  }
  Window next = window;
  if (passes_right) {
    next.door = {surface_.glue[right_side], apex, door.right};
    next.high = passing.right_of;
    const Behind behind{tail(surface_, door.side), door.left, true};
    add(next, &behind);
  }
  if (passes_left) {
    next.door = {surface_.glue[left_side], door.left, apex};
    next.low = passing.left_of;
    next.high = window.high;
    const Behind behind{head(surface_, door.side), door.right, false};
    add(next, &behind);
  }
}

}  // namespace tufted
