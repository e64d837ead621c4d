#include "tufted/nearest_point.h"

#include <cstdint>
#include <limits>
#include <string>

#include "base/buffer.h"
#include "base/parallel.h"
#include "neighbors/neighbors.h"
#include "tufted/check.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// For fewer positions than this, comparing all points is faster than building a search tree.
constexpr Eigen::Index worth_a_tree = 16;
/// Positions between two calls of `progress`; one far from all points may take a millisecond.
constexpr std::int64_t positions_per_block = 64;

/// The active points, ascending.
std::vector<int> activePoints(const std::string& function, const Laplacian& laplacian, const PointsRef& points) {
  checkSizes(function, laplacian);
  const auto n = static_cast<Eigen::Index>(laplacian.status.size());
  if (points.rows() != n) {
    throw InvalidInput(function + ": points has " + std::to_string(points.rows()) + " rows, must have " +
                       std::to_string(n) + ", one per point of the Laplacian");
  }
  std::vector<int> active;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (laplacian.status[i] != PointStatus::active) continue;
    if (!points.row(i).allFinite()) {
      throw InvalidInput(function + ": point " + std::to_string(i) +
                         " is not finite, must be: the Laplacian has it active");
    }
    active.push_back(static_cast<int>(i));
  }
  if (active.empty())
    throw InvalidInput(function + ": none of the " + std::to_string(n) + " points is active, must be one");
  return active;
}

/// The nearest point seen so far, the first one if several are equally near.
class Nearest {
 public:
  explicit Nearest(const PointsRef& points, const Eigen::RowVector3d& position)
      : points_(points), position_(position) {}

  void consider(int i) {
    const double distance = (points_.row(i) - position_).stableNorm();
    if (index_ >= 0 && !(distance < least_ || (distance == least_ && i < index_))) return;
    least_ = distance;
    index_ = i;
  }
  int index() const { return index_; }

 private:
  PointsRef points_;
  Eigen::RowVector3d position_;
  int index_ = -1;
  double least_ = std::numeric_limits<double>::infinity();
};

int nearestOfAll(const PointsRef& points, const std::vector<int>& active, const Eigen::RowVector3d& position) {
  Nearest nearest(points, position);
  for (const int i : active) nearest.consider(i);
  return nearest.index();
}

}  // namespace

int nearestPoint(const Laplacian& laplacian, const PointsRef& points, const Eigen::Vector3d& position) {
  const std::vector<int> active = activePoints("nearestPoint", laplacian, points);
  if (!position.allFinite()) throw InvalidInput("nearestPoint: position is not finite, must be");
  return nearestOfAll(points, active, position.transpose());
}

std::vector<int> nearestPoints(const Laplacian& laplacian, const PointsRef& points, const PointsRef& positions,
                               const Progress& progress) {
  const std::vector<int> active = activePoints("nearestPoints", laplacian, points);
  for (Eigen::Index k = 0; k < positions.rows(); ++k) {
    if (!positions.row(k).allFinite())
      throw InvalidInput("nearestPoints: position " + std::to_string(k) + " is not finite, must be");
  }
  const Workers workers(1, progress);
  std::vector<int> result(static_cast<std::size_t>(positions.rows()));
  if (positions.rows() < worth_a_tree) {
    workers.forBlocks("nearest", positions.rows(), 1, [&](std::int64_t k, std::int64_t, int) {
      result[k] = nearestOfAll(points, active, positions.row(k));
    });
    return result;
  }
  workers.report("search tree", 0);
  const Points usable = points(active, Eigen::all);
  const NeighborSearch search(usable);
  Buffer<Neighbor> candidates;
  workers.forBlocks("nearest", positions.rows(), positions_per_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t k = begin; k < end; ++k) {
      const Eigen::RowVector3d position = positions.row(k);
      search.nearestTo(position, candidates);
      Nearest nearest(points, position);
      for (const Neighbor& candidate : candidates) nearest.consider(active[candidate.index]);
      // If a position is so far away that squares overflow, all points are searched.
      result[k] = nearest.index() >= 0 ? nearest.index() : nearestOfAll(points, active, position);
    }
  });
  return result;
}

}  // namespace tufted
