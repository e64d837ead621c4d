#include "neighbors/neighbors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "neighbors/kd_forest.h"

namespace tufted {
namespace {

/// Up to this many neighbours are kept sorted while they are found; more are sorted at the end. Keeping 512 sorted took
/// a third of the time of denoise() on a noisy cube.
constexpr int most_inserted = 64;

/// The k smallest candidates by (distance, index), without the query point itself.
///
/// FLANN's own sets keep whichever of two equally distant points comes first in the tree, and its pruning sums rounded
/// terms. So the bound for FLANN is wider than the k-th distance by as much as its rounding needs, and ties are decided
/// here. L2_Simple adds the squared differences in the order x, y, z, so its distances are the same bits for any tree.
class NearestSet : public RankSet {
 public:
  /// @param radius of a ball that holds k points other than the query point, or infinity
  NearestSet(int self, int k, double radius, Buffer<Neighbor>& found)
      : found_(found), k_(static_cast<std::size_t>(k)), self_(self) {
    found_.clear();
    setWorst(radius * radius);
  }

  bool full() const override { return found_.size() >= k_; }
  double worstDist() const override { return worst_; }

 protected:
  void setWorst(double squared_distance) { worst_ = widened(squared_distance); }

  Buffer<Neighbor>& found_;
  const std::size_t k_;
  const int self_;

 private:
  double worst_ = 0;
};

/// Keeps its points sorted: fastest for few neighbours.
class AscendingSet final : public NearestSet {
 public:
  using NearestSet::NearestSet;

  void addPoint(double squared_distance, size_t index) override {
    const Neighbor candidate{squared_distance, rankOf(index)};
    if (candidate.index == self_ || (full() && !(candidate < found_.back()))) return;
    if (full()) found_.pop_back();
    std::size_t place = found_.size();
    found_.push_back(candidate);
    for (; place > 0 && candidate < found_[place - 1]; --place) found_[place] = found_[place - 1];
    found_[place] = candidate;
    if (full()) setWorst(found_.back().squared_distance);
  }
};

/// Collects up to 2 k points, then keeps the k nearest: fastest for hundreds.
class UnorderedSet final : public NearestSet {
 public:
  using NearestSet::NearestSet;

  void addPoint(double squared_distance, size_t index) override {
    const int rank = rankOf(index);
    if (rank == self_) return;
    found_.push_back({squared_distance, rank});
    if (found_.size() < 2 * k_) return;
    choose();
    setWorst(found_.back().squared_distance);
  }

  /// Keeps the k nearest; the farthest comes last.
  void choose() {
    if (found_.size() < k_) return;
    std::nth_element(found_.begin(), found_.begin() + static_cast<std::ptrdiff_t>(k_ - 1), found_.end());
    found_.resize(k_);
  }
};

/// All points that may be the nearest: the ball shrinks to the nearest distance plus the rounding of squares, including
/// that of subnormal ones.
class NearestTies final : public RankSet {
 public:
  explicit NearestTies(Buffer<Neighbor>& found) : found_(found) { found_.clear(); }

  bool full() const override { return true; }
  double worstDist() const override { return worst_; }

  void addPoint(double squared_distance, size_t index) override {
    if (!(squared_distance < worst_)) return;
    found_.push_back({squared_distance, rankOf(index)});
    worst_ =
        std::min(worst_, squared_distance * (1 + distance_rounding) + 16 * std::numeric_limits<double>::denorm_min());
  }

  void finish() {
    std::size_t kept = 0;
    for (const Neighbor& candidate : found_)
      if (candidate.squared_distance < worst_) found_[kept++] = candidate;
    found_.resize(kept);
  }

 private:
  Buffer<Neighbor>& found_;
  double worst_ = std::numeric_limits<double>::infinity();
};

/// All points in a ball; stops once there are more than `most`.
class WholeBall : public RankSet {
 public:
  WholeBall(double radius, int most, Buffer<int>& found) : most_(static_cast<std::size_t>(most)), found_(found) {
    found_.clear();
    setRadius(radius);
  }

  bool full() const override { return true; }
  double worstDist() const override { return worst_; }
  bool isTooFull() const { return found_.size() > most_; }

  void addPoint(double, size_t index) override {
    found_.push_back(rankOf(index));
    if (isTooFull()) worst_ = -1;  // no distance is smaller, so the search ends
  }

 protected:
  void setRadius(double radius) { worst_ = widened(radius * radius); }

 private:
  std::size_t most_;
  Buffer<int>& found_;
  double worst_ = 0;
};

/// Collects points in a ball whose radius shrinks to the k-th distance from the centre plus a margin.
class ShrinkingBall final : public WholeBall {
 public:
  /// @param nearest k squared distances from points to the centre, the largest in front
  ShrinkingBall(double margin, int most, Buffer<double>& nearest, Buffer<int>& found)
      : WholeBall(std::sqrt(nearest.front()) + margin, most, found), margin_(margin), nearest_(nearest) {
    // a bound; these points are found again
    std::fill(nearest_.begin(), nearest_.end(), nearest_.front());
  }

  void addPoint(double squared_distance, size_t index) override {
    WholeBall::addPoint(squared_distance, index);
    if (isTooFull() || !(squared_distance < nearest_.front())) return;
    replaceLargest(squared_distance);
    setRadius(std::sqrt(nearest_.front()) + margin_);
  }

 private:
  /// Half the cost of std::pop_heap and std::push_heap.
  void replaceLargest(double squared_distance) {
    std::size_t hole = 0, child = 1;
    for (; child < nearest_.size(); child = 2 * hole + 1) {
      if (child + 1 < nearest_.size() && nearest_[child] < nearest_[child + 1]) ++child;
      if (nearest_[child] <= squared_distance) break;
      nearest_[hole] = nearest_[child];
      hole = child;
    }
    nearest_[hole] = squared_distance;
  }

  double margin_;
  Buffer<double>& nearest_;
};

}  // namespace

NeighborSearch::NeighborSearch(const PointsView& points) : NeighborSearch(points, Workers(1, Progress())) {}

NeighborSearch::NeighborSearch(const PointsView& points, const Workers& workers) : points_(points) {
  if (points.rows() >= 2) forest_ = std::make_unique<KdForest>(points, workers);
}

NeighborSearch::~NeighborSearch() = default;

void NeighborSearch::nearest(int p, int k, Buffer<Neighbor>& found, NeighborOrder order, SearchBefore* before) const {
  const int available = static_cast<int>(points_.rows()) - 1;
  k = std::min(k, available);
  found.clear();
  if (k <= 0) return;
  const double* const point = points_.row(p).data();
  const auto search = [&](double radius) {
    if (order == NeighborOrder::ascending && k <= most_inserted) {
      AscendingSet set(p, k, radius, found);
      forest_->search(point, p, set);
      return;
    }
    UnorderedSet set(p, k, radius, found);
    forest_->search(point, p, set);
    set.choose();
    if (order == NeighborOrder::ascending) std::sort(found.begin(), found.end());
  };
  double radius = std::numeric_limits<double>::infinity();
  if (before != nullptr && before->k >= k) radius = before->radius + (points_.row(p) - points_.row(before->p)).norm();
  search(radius);
  if (std::ssize(found) < k) search(std::numeric_limits<double>::infinity());  // rounding made the bound too small
  if (before != nullptr) *before = {p, k, std::sqrt(found.back().squared_distance)};
}

void NeighborSearch::nearestTo(const Eigen::RowVector3d& position, Buffer<Neighbor>& found) const {
  NearestTies ties(found);
  if (!forest_) {
    if (points_.rows() == 1) ties.addPoint((points_.row(0) - position).squaredNorm(), 0);
    return;
  }
  forest_->search(position.data(), 0, ties);
  ties.finish();
}

bool NeighborSearch::candidates(const PointGroup& group, int k, Buffer<int>& found, Buffer<double>& bounds,
                                SearchedBall& ball) const {
  const int n = static_cast<int>(points_.rows());
  ball.center = group.center;

  // A point of the group is not its own neighbour, so k + 1 nearest of the centre hold k neighbours of it. The nearest
  // of the points around it on the curve give a first bound.
  const int wanted = std::min(k, n - 1) + 1;
  const int begin = std::max(0, std::min(group.middle - wanted, n - 2 * wanted));
  const int end = std::min(n, begin + 2 * wanted);
  bounds.clear();
  for (int q = begin; q < end; ++q) bounds.push_back((points_.row(q) - ball.center).squaredNorm());
  std::nth_element(bounds.begin(), bounds.begin() + (wanted - 1), bounds.end());
  std::swap(bounds.front(), bounds[wanted - 1]);
  bounds.resize(static_cast<std::size_t>(wanted));

  ShrinkingBall set(2 * group.spread, mostCandidates(k), bounds, found);
  forest_->search(ball.center.data(), group.first, set);
  ball.k_radius = std::sqrt(bounds.front());
  ball.radius = ball.k_radius + 2 * group.spread;
  return !set.isTooFull() && bounds.front() > least_square;
}

bool NeighborSearch::candidatesWithin(const PointGroup& group, int k, double around, Buffer<int>& found,
                                      SearchedBall& ball) const {
  ball.center = group.center;
  ball.radius = group.spread + around;
  WholeBall set(ball.radius, mostCandidates(k), found);
  forest_->search(ball.center.data(), group.first, set);
  return !set.isTooFull() && around * around > least_square;
}

std::size_t NeighborSearch::bytes() const {
  return forest_ ? forest_->bytes() : 0;
}

}  // namespace tufted
