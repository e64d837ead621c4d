#include "algorithms/vertex_view.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "algorithms/apex.h"
#include "base/cross.h"
#include "base/power_of_two.h"
#include "cover/geometry.h"

namespace tufted {
namespace {

using Eigen::Vector2d;

/// The angle between sides a and b of a triangle.
double angleBetweenSides(double a, double b, double opposite) {
  return std::atan2(4 * triangleArea(opposite, a, b), cotanNumerator(opposite, a, b));
}

}  // namespace

Wedge Wedge::of(const SurfacePoint& source, double on_line) {
  const auto& distances = source.distances;
  const int corner = static_cast<int>(std::min_element(distances.begin(), distances.end()) - distances.begin());
  const auto lengthTo = [&](int k) { return source.sides[3 - corner - k]; };
  int far = (corner + 1) % 3, near = (corner + 2) % 3;
  if (lengthTo(far) < lengthTo(near)) std::swap(far, near);
  const double unit = magnitudeOf(lengthTo(far));
  const std::array<double, 2> length = {lengthTo(far) / unit, lengthTo(near) / unit};
  return {.corner = source.corners[corner],
          .others = {source.corners[far], source.corners[near]},
          .length = length,
          .weight = {source.weights[far], source.weights[near]},
          .angle = angleBetweenSides(length[0], length[1], source.sides[corner] / unit),
          .unit = unit,
          .on_line = on_line * length[0]};
}

VertexView::VertexView(const IntrinsicTriangulation& cover, const Wedge& wedge, int side)
    : cover_(cover), wedge_(wedge) {
  for (int first = side; sectors_.empty() || first != side; first = cover.glue[previousSide(first)]) {
    sectors_.push_back({first, total_});
    addImage(head(cover, first), {lengthOf(first), total_});
    total_ += angleBetweenSides(lengthOf(first), lengthOf(previousSide(first)), lengthOf(nextSide(first)));
  }
}

void VertexView::lookFarther() {
  for (const Sector& sector : sectors_) {
    const Door door = doorOf(sector);
    add({0, sector.angle, door, door.right.normalized(), door.left.normalized()});
  }
  while (!windows_.empty()) {
    const Window window = windows_.top();
    windows_.pop();
    cross(window);
  }
}

VertexView::Match VertexView::match(int turn) const {
  const Vector2d expected = polar(wedge_.length[1], wedge_.angle);
  Match best;
  for (const Image& far : images_[0]) {
    for (const Image& near : images_[1]) {
      const double angle = wedge_.angle + std::remainder(turn * (near.angle - far.angle) - wedge_.angle, total_);
      const Vector2d far_at(far.distance, 0), near_at = polar(near.distance, angle);
      const double misfit = std::abs(far.distance - wedge_.length[0]) + (near_at - expected).norm();
      if (!(misfit < best.misfit && std::abs(angle - wedge_.angle) < std::numbers::pi)) continue;
      const Vector2d point = wedge_.weight[0] * far_at + wedge_.weight[1] * near_at;
      const bool is_beside_far = std::abs(point.y()) * near.distance <= std::abs(tufted::cross(near_at, point));
      best = {misfit, point.norm(), far.angle + turn * std::atan2(point.y(), point.x()), is_beside_far ? -turn : turn};
    }
  }
  return best;
}

PlaceInCover VertexView::follow(const Match& match) const {
  const double angle = match.angle - std::floor(match.angle / total_) * total_;
  const auto after = std::upper_bound(sectors_.begin() + 1, sectors_.end(), angle,
                                      [](double value, const Sector& sector) { return value < sector.angle; });
  const Sector& sector = *std::prev(after);
  const Vector2d point = polar(match.distance, angle - sector.angle), along = point.normalized();
  // Whether the point lies before the place where the line leaves the face through a side, which may lie on the line.
  const auto isBefore = [&](const Vector2d& right, const Vector2d& left) {
    const double from_right = std::abs(tufted::cross(along, right)), from_left = std::abs(tufted::cross(along, left));
    const double at_right = along.dot(right), at_left = along.dot(left), across = from_right + from_left;
    const double exit =
        across > wedge_.on_line ? (from_left * at_right + from_right * at_left) / across : std::max(at_right, at_left);
    return match.distance <= exit;
  };
  Door door = doorOf(sector);
  if (isBefore(door.right, door.left)) return placeIn(sector.side, {Vector2d::Zero(), door.right, door.left}, point);
  for (std::int64_t steps = 0; steps < std::ssize(cover_.glue); ++steps) {
    const Vector2d apex = apexOf(cover_, wedge_.unit, door);
    const double offset = tufted::cross(along, apex);
    const bool is_left = std::abs(offset) <= wedge_.on_line ? match.vertices_on_line > 0 : offset > 0;
    const Vector2d right = is_left ? door.right : apex, left = is_left ? apex : door.left;
    if (isBefore(right, left)) return placeIn(door.side, {door.left, door.right, apex}, point);
    door = {cover_.glue[is_left ? nextSide(door.side) : previousSide(door.side)], left, right};
  }
  return {0, -1, {}};
}

Door VertexView::doorOf(const Sector& sector) const {
  const double right = lengthOf(sector.side), left = lengthOf(previousSide(sector.side)),
               across = lengthOf(nextSide(sector.side));
  const Vector2d right_end(right, 0);
  return {cover_.glue[nextSide(sector.side)],
          apexLeftOf(Vector2d::Zero(), right_end, left, across, 2 * triangleArea(right, left, across)), right_end};
}

void VertexView::addImage(int vertex, const Image& image) {
  for (int k = 0; k < 2; ++k)
    if (wedge_.others[k] == vertex) images_[k].push_back(image);
  shorten(vertex, image.distance);
}

void VertexView::shorten(int vertex, double distance) {
  double& nearest = nearest_.try_emplace(vertex, distance).first->second;
  nearest = std::min(nearest, distance);
}

double VertexView::nearest(int vertex) const {
  const auto found = nearest_.find(vertex);
  return found == nearest_.end() ? std::numeric_limits<double>::infinity() : found->second;
}

/// Adds a window unless it is too far, a shorter path leads around an end of its side, or it lies in one added before.
void VertexView::add(Window window) {
  const double on_line = wedge_.on_line;
  const int side = window.door.side;
  const Vector2d left = window.door.left, right = window.door.right;
  const auto [low_end, high_end, distance] = partBetween(window.door, window.low, window.high);
  window.distance = distance;
  if (!(window.distance <= (1 + Wedge::same_triangle) * wedge_.length[0])) return;
  const auto isLonger = [&](int vertex, const Vector2d& at, const Vector2d& end) {
    return nearest(vertex) + (at - end).norm() + on_line < end.norm();
  };
  if (isLonger(head(cover_, side), right, high_end) || isLonger(tail(cover_, side), left, low_end)) return;
  std::vector<Window>& seen = seen_[side];
  const auto holdsWindow = [&](const Window& other) {
    return other.angle == window.angle && (other.door.left - left).norm() <= on_line &&
           (other.door.right - right).norm() <= on_line && tufted::cross(other.low, window.low) >= -on_line &&
           tufted::cross(window.high, other.high) >= -on_line;
  };
  if (std::any_of(seen.begin(), seen.end(), holdsWindow)) return;
  seen.push_back(window);
  windows_.push(window);
}

/// Continues a window through the two other sides of the face behind it. If a vertex lies on a bound of the window,
/// lines pass it on both sides.
void VertexView::cross(const Window& window) {
  const Door& door = window.door;
  const int right_side = nextSide(door.side), left_side = previousSide(door.side);
  const Vector2d apex = apexOf(cover_, wedge_.unit, door);
  shorten(tail(cover_, left_side), std::min(nearest(tail(cover_, door.side)) + lengthOf(left_side),
                                            nearest(head(cover_, door.side)) + lengthOf(right_side)));
  const Passing passing = passingOf(window.low, window.high, apex);
  const bool is_left = passing.from_low >= -wedge_.on_line, is_right = passing.from_high <= wedge_.on_line;
  if (is_left && is_right)
    addImage(tail(cover_, left_side), {apex.norm(), window.angle + std::atan2(apex.y(), apex.x())});
  if (is_left) add({0, window.angle, {cover_.glue[right_side], apex, door.right}, window.low, passing.right_of});
  if (is_right) add({0, window.angle, {cover_.glue[left_side], door.left, apex}, passing.left_of, window.high});
}

/// The place of a point in a face.
/// @param side of the face, starts at corners[0]
/// @param seen the point up to rounding; if outside of the face, the nearest point on its sides is used
PlaceInCover VertexView::placeIn(int side, const std::array<Vector2d, 3>& corners, const Vector2d& seen) const {
  const auto areaAt = [&](int k) -> double {  // twice the area of the part opposite a corner
    return tufted::cross(corners[(k + 1) % 3] - seen, corners[(k + 2) % 3] - seen);
  };
  std::array<double, 3> weights = {areaAt(0), areaAt(1), areaAt(2)};
  Vector2d point = seen;
  const double sum = weights[0] + weights[1] + weights[2];
  if (sum > 0 && *std::min_element(weights.begin(), weights.end()) >= 0) {
    for (double& weight : weights) weight /= sum;
  } else {
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
      const Vector2d begin = corners[(k + 1) % 3], along = corners[(k + 2) % 3] - begin;
      const double square = along.squaredNorm();
      const double share = square > 0 ? std::clamp((seen - begin).dot(along) / square, 0.0, 1.0) : 0.0;
      const Vector2d nearest = begin + share * along;
      if (!((nearest - seen).norm() < least)) continue;
      least = (nearest - seen).norm();
      point = nearest;
      weights[k] = 0;
      weights[(k + 1) % 3] = 1 - share;
      weights[(k + 2) % 3] = share;
    }
  }
  PlaceInCover place{0, side / 3, {}};
  const std::array<int, 3> sides = {side, nextSide(side), previousSide(side)};
  for (int k = 0; k < 3; ++k) {
    const int at = sides[k] % 3;
    place.point.corners[at] = tail(cover_, sides[k]);
    place.point.weights[at] = weights[k];
    place.point.distances[at] = (corners[k] - point).norm() * wedge_.unit;
    place.point.sides[at] = cover_.length[sides[(k + 1) % 3]];
  }
  return place;
}

}  // namespace tufted
