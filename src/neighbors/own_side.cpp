#include "neighbors/own_side.h"

#include <algorithm>

namespace tufted {
namespace {

/// Normals are opposed if the cosine between them is below this: from 120 degrees on.
constexpr double opposed = -0.5;
/// Opposed neighbours are on another side if their mean height exceeds this many times the root mean square of the
/// others' heights, and the standard deviation of their own: where two sides meet at a sharp edge, that has 1.7.
constexpr double other_height = 2;

}  // namespace

std::size_t keepOwnSide(const PointsView& points, const PointBuffer& normals, int p, std::span<Neighbor> neighbors) {
  if (normals.rows() == 0) return neighbors.size();
  const Eigen::RowVector3d normal = normals.row(p);
  const auto isOpposed = [&](const Neighbor& q) { return normals.row(q.index).dot(normal) < opposed; };
  double height = 0, own_squares = 0, squares = 0;
  int removed = 0, kept = 0;
  for (const Neighbor& q : neighbors) {
    const double h = (points.row(q.index) - points.row(p)).dot(normal);
    if (isOpposed(q)) {
      height += h;
      own_squares += h * h;
      ++removed;
    } else {
      squares += h * h;
      ++kept;
    }
  }
  if (removed == 0 || kept == 0) return neighbors.size();
  const double mean = height / removed, variance = (own_squares - mean * height) / removed;
  if (!(mean * mean > other_height * other_height * std::max(squares / kept, variance))) return neighbors.size();
  const auto end = std::remove_if(neighbors.begin(), neighbors.end(), isOpposed);
  return static_cast<std::size_t>(end - neighbors.begin());
}

}  // namespace tufted
