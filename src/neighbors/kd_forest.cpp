#include "neighbors/kd_forest.h"

#include <algorithm>
#include <array>
#include <optional>

#include "neighbors/flann_tree.h"

namespace tufted {
namespace {

using Index = flann::KDTreeSingleIndex<flann::L2_Simple<double>>;

/// Least number of points of one of several trees: searching smaller ones costs more than building them in parallel
/// saves.
constexpr int least_points_per_tree = 8192;
/// Greatest number of points in a leaf.
constexpr int leaf_size = 16;
const flann::SearchParams all_checks{flann::FLANN_CHECKS_UNLIMITED};

}  // namespace

struct KdForest::Tree {
  int first = 0;
  std::array<double, 3> lowest{}, highest{};
  std::optional<Index> index;

  void build(const PointsView& points, int begin, int end) {
    first = begin;
    const auto rows = points.middleRows(begin, end - begin);
    Eigen::Map<Eigen::RowVector3d>(lowest.data()) = rows.colwise().minCoeff();
    Eigen::Map<Eigen::RowVector3d>(highest.data()) = rows.colwise().maxCoeff();
    // The points are in Morton order already, so FLANN's reordered copy would only cost memory.
    index.emplace(flann::Matrix<double>(const_cast<double*>(rows.data()), static_cast<std::size_t>(end - begin), 3),
                  flann::KDTreeSingleIndexParams(leaf_size, false));
    index->buildIndex();
  }

  /// A lower bound on the squared distance to the points of the tree, with the rounding of L2_Simple, which adds in
  /// the order x, y, z as well.
  double squaredDistance(const double* position) const {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double outside = std::max({lowest[axis] - position[axis], position[axis] - highest[axis], 0.0});
      sum += outside * outside;
    }
    return sum;
  }
};

KdForest::KdForest(const PointsView& points, const Workers& workers)
    : size_(static_cast<int>(points.rows())),
      trees_(static_cast<std::size_t>(std::clamp(size_ / least_points_per_tree, 1, workers.count()))) {
  const std::int64_t count = std::ssize(trees_);
  workers.forBlocks("tree", count, 1, [&](std::int64_t begin, std::int64_t, int) {
    trees_[begin].build(points, static_cast<int>(size_ * begin / count), static_cast<int>(size_ * (begin + 1) / count));
  });
}

KdForest::~KdForest() = default;

void KdForest::search(const double* position, int near_rank, RankSet& found) const {
  const auto after = std::partition_point(trees_.begin() + 1, trees_.end(),
                                          [near_rank](const Tree& tree) { return tree.first <= near_rank; });
  const Tree& nearest = *(after - 1);
  search(nearest, position, found);
  for (const Tree& tree : trees_)
    if (&tree != &nearest && !(tree.squaredDistance(position) > found.worstDist())) search(tree, position, found);
}

void KdForest::search(const Tree& tree, const double* position, RankSet& found) const {
  found.first_ = tree.first;
  tree.index->findNeighbors(found, position, all_checks);
}

std::size_t KdForest::bytes() const {
  // FLANN counts the nodes; it also holds a pointer and an index per point.
  std::size_t sum = static_cast<std::size_t>(size_) * (sizeof(double*) + sizeof(int));
  for (const Tree& tree : trees_) sum += static_cast<std::size_t>(tree.index->usedMemory());
  return sum;
}

}  // namespace tufted
