#include "polygons/ear_clipper.h"

#include <Eigen/Geometry>
#include <cmath>

namespace tufted {
namespace {

using Eigen::Vector2d;

// Keys of corners that have no quality; all qualities are above -3/2.
constexpr double not_a_number = -2;  // of a corner whose quality is NaN
constexpr double clipped = -3;       // of a clipped corner

// From this number of corners on, nearly straight corners count as straight: comparing each with all others on its line
// would take the square of their number.
constexpr std::size_t many_corners = 1000;
/// Corners of such a polygon are straight up to this quality, as it may be rounding of coordinates.
constexpr double straight = 0x1p-40;

double squaredEdges(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
}

/// Projects the polygon along the greatest axis of its Newell normal, which keeps the turn of every corner.
void project(const Points& points, const std::vector<int>& polygon, std::vector<Vector2d>& planar) {
  const Eigen::RowVector3d origin = points.row(polygon[0]);  // to work with differences only
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d a = points.row(polygon[i]) - origin;
    const Eigen::Vector3d b = points.row(polygon[(i + 1) % polygon.size()]) - origin;
    normal += a.cross(b);
  }
  int dropped = 0;
  normal.cwiseAbs().maxCoeff(&dropped);
  const int x = (dropped + 1) % 3, y = (dropped + 2) % 3;
  const double sign = normal[dropped] < 0 ? -1 : 1;
  planar.clear();
  for (const int vertex : polygon) {
    const Eigen::RowVector3d d = points.row(vertex) - origin;
    planar.emplace_back(sign * d[x], d[y]);
  }
}

}  // namespace

void EarClipper::begin(const Points& points, const std::vector<int>& polygon) {
  project(points, polygon, planar_);
  const int n = static_cast<int>(polygon.size());
  first_ = 0;
  left_ = n;
  corners_.clear();
  for (int i = 0; i < n; ++i) corners_.push_back({.before = i == 0 ? n - 1 : i - 1, .after = i + 1 == n ? 0 : i + 1});
  tree_.build(planar_);
  key_.clear();
  for (int i = 0; i < n; ++i) key_.push_back(keyOfEmpty(i));
  winner_.resize(polygon.size());
  for (int node = n - 1; node > 0; --node) findWinner(node);
}

std::array<int, 3> EarClipper::next() {
  const bool is_last = left_ == 3;
  const int ear = is_last ? corners_[first_].after : bestEar();
  const std::array<int, 3> triangle = {corners_[ear].before, ear, corners_[ear].after};
  if (!is_last) clip(ear);
  return triangle;
}

double EarClipper::keyOfEmpty(int corner) const {
  const Vector2d &a = planar_[corners_[corner].before], &b = planar_[corner], &c = planar_[corners_[corner].after];
  const double edges = squaredEdges(a, b, c);
  const double quality = edges > 0 ? turn(a, b, c) / edges : 0;
  if (std::isnan(quality)) return not_a_number;
  return quality > (planar_.size() < many_corners ? 0 : straight) ? quality : quality - 1;
}

int EarClipper::bestEar() {
  for (;;) {
    const int best = winnerBelow(1);
    Corner& corner = corners_[best];
    if (key_[best] <= 0 || corner.holds == nothing) return best;
    const Vector2d &a = planar_[corner.before], &b = planar_[best], &c = planar_[corner.after];
    const int held = tree_.firstIn(PlanarTriangle(a, b, c, turn(a, b, c), squaredEdges(a, b, c)));
    if (held < 0)
      corner.holds = nothing;
    else
      wait(best, held);
  }
}

void EarClipper::clip(int ear) {
  const int before = corners_[ear].before, after = corners_[ear].after;
  if (ear == first_) first_ = after;
  --left_;
  corners_[before].after = after;
  corners_[after].before = before;
  tree_.remove(ear);
  stopWaiting(ear);
  setKey(ear, clipped);
  while (corners_[ear].first_waiting != none) judge(corners_[ear].first_waiting);
  judge(before);
  judge(after);
}

void EarClipper::judge(int corner) {
  stopWaiting(corner);
  corners_[corner].holds = unknown;
  setKey(corner, keyOfEmpty(corner));
}

void EarClipper::wait(int corner, int held) {
  int& first = corners_[held].first_waiting;
  if (first != none) corners_[first].last = corner;
  corners_[corner].holds = held;
  corners_[corner].last = none;
  corners_[corner].next = first;
  first = corner;
  setKey(corner, key_[corner] - 1);
}

void EarClipper::stopWaiting(int corner) {
  const Corner& waiting = corners_[corner];
  if (waiting.holds < 0) return;
  (waiting.last == none ? corners_[waiting.holds].first_waiting : corners_[waiting.last].next) = waiting.next;
  if (waiting.next != none) corners_[waiting.next].last = waiting.last;
}

int EarClipper::winnerBelow(int node) const {
  const int n = static_cast<int>(key_.size());
  return node < n ? winner_[node] : node - n;
}

void EarClipper::findWinner(int node) {
  const int a = winnerBelow(2 * node), b = winnerBelow(2 * node + 1);
  winner_[node] = key_[a] > key_[b] || (key_[a] == key_[b] && a < b) ? a : b;
}

void EarClipper::setKey(int corner, double key) {
  key_[corner] = key;
  for (int node = (static_cast<int>(key_.size()) + corner) / 2; node > 0; node /= 2) {
    const int before = winner_[node];
    findWinner(node);
    if (winner_[node] == before && before != corner) return;  // the nodes above do not change either
  }
}

}  // namespace tufted
