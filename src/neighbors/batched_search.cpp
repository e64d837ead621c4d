#include "neighbors/batched_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "base/buffer.h"
#include "base/point_buffer.h"

namespace tufted {
namespace {

/// Greatest number of points of a batch. 48 and 64 were no faster, as each point tests more candidates, nor were 12 to
/// 24.
constexpr int most_batch = 32;
/// Greatest diagonal of the box of a batch, in radii of a neighbourhood; 3.2 and 4 were no faster. Batches of a fixed
/// number of points straddle jumps of the curve (1.55 instead of 1.29 us per point).
constexpr double widest_batch = 2.5;
/// The squared k-th distance of the previous point times this mostly holds k points; if not, the bound is used.
constexpr double likely = 1.08;
/// The first ball exceeds the batch by this many radii of a neighbourhood: half as many candidates as in the proven
/// ball (100,000 points: 70 to 49 ms).
constexpr double first_around = 1.2;
/// If the first ball is too small it grows by `next_around`, while it stays below `last_around`; then the proven ball
/// is searched.
constexpr double next_around = 1.6, last_around = 4;
/// A ball for one point is larger than needed by this factor, to serve the next point as well.
constexpr double spare_around = 1.05;
constexpr double nowhere = std::numeric_limits<double>::infinity();

/// Appends the result of the last search to the known candidates, as those of `batch`.
void keepSearched(SearchedBatch& batch, BatchScratch& scratch) {
  batch.begin = scratch.known.size();
  scratch.known.insert(scratch.known.end(), scratch.searched.begin(), scratch.searched.end());
  batch.end = scratch.known.size();
}

/// The distance from `point` to the border of the ball.
double roomAround(const Eigen::RowVector3d& point, const SearchedBall& ball) {
  return ball.radius - (point - ball.center).norm();
}

template <class Ranks>
PointGroup groupOf(const PointsView& points, const Ranks& ranks) {
  const auto count = static_cast<int>(ranks.size());
  Eigen::RowVector3d lowest = points.row(ranks[0]), highest = lowest;
  for (int i = 1; i < count; ++i) {
    lowest = lowest.cwiseMin(points.row(ranks[i]));
    highest = highest.cwiseMax(points.row(ranks[i]));
  }
  const Eigen::RowVector3d center = lowest + (highest - lowest) / 2;
  double farthest = 0;
  for (int i = 0; i < count; ++i) farthest = std::max(farthest, (points.row(ranks[i]) - center).squaredNorm());
  return {ranks[0], ranks[count / 2], center, std::sqrt(farthest)};
}

/// A range of consecutive ranks.
struct Consecutive {
  int first;
  std::size_t count;

  std::size_t size() const { return count; }
  int operator[](std::size_t i) const { return first + static_cast<int>(i); }
  Consecutive subspan(std::size_t from, std::size_t size) const { return {(*this)[from], size}; }
};

/// The candidates of a batch, from which its points take their neighbours.
class BatchCandidates {
 public:
  BatchCandidates(const PointsView& points, const Kernels& kernels, BatchScratch& scratch)
      : points_(points), kernels_(kernels), scratch_(scratch) {}

  void gather(const SearchedBatch& batch) {
    const auto ranks = std::span<const int>(scratch_.known).subspan(batch.begin, batch.end - batch.begin);
    scratch_.gathered = batch.first;
    const int size = static_cast<int>(ranks.size()), room = toPackets(size);
    scratch_.candidate.resize(room);
    for (auto* axis : {&scratch_.x, &scratch_.y, &scratch_.z}) axis->resize(room);
    for (int i = 0; i < size; ++i) {
      const double* point = points_.row(ranks[i]).data();
      scratch_.candidate[i] = ranks[i];
      scratch_.x[i] = point[0];
      scratch_.y[i] = point[1];
      scratch_.z[i] = point[2];
    }
    for (int i = size; i < room; ++i) scratch_.x[i] = scratch_.y[i] = scratch_.z[i] = nowhere;
    scratch_.squared.resize(room + kernel_packet);
    scratch_.index.resize(room + kernel_packet);
  }

  /// Takes the candidates within the squared distance `guess` if that is below `bound` and holds k, else within
  /// `bound`. Returns their number.
  int takeWithin(int p, int k, double guess, double bound) {
    const int count = guess < bound ? takeWithin(p, guess) : 0;
    return count < k ? takeWithin(p, bound) : count;
  }

  /// takeWithin() bounded by the border of the ball. Returns 0 if fewer than k are within it.
  int takeWithinBall(int p, int k, double guess, const SearchedBall& ball) {
    const double room = roomAround(points_.row(p), ball), bound = room * room * (1 - distance_rounding);
    if (!(room > 0 && bound > least_square)) return 0;
    const int count = takeWithin(p, k, guess, bound);
    return count < k ? 0 : count;
  }

  /// Writes the k least of the taken candidates by (distance, index), ascending, to `row`, and others behind them,
  /// where the next row or spare room is. A candidate's place is the number of smaller distances, if no two are equal
  /// as floats.
  void takeNearest(int count, int k, Neighbor* row) {
    const int room = toPackets(count);
    std::fill(scratch_.squared.begin() + count, scratch_.squared.begin() + room, nowhere);
    scratch_.rounded.resize(room + 2 * kernel_packet);
    scratch_.place.resize(room + 2 * kernel_packet);
    kernels_.rankValues(scratch_.squared.data(), room, scratch_.rounded.data(), scratch_.place.data());
    std::int64_t sum = 0;
    // Those behind the k-th are written too, which saves an unpredictable branch.
    for (int i = 0; i < count; ++i) {
      sum += scratch_.place[i];
      row[scratch_.place[i]] = {scratch_.squared[i], scratch_.index[i]};
    }
    if (sum == static_cast<std::int64_t>(count) * (count - 1) / 2) return;
    // Equal floats are placed one behind the other, then sorted.
    scratch_.sorted.resize(static_cast<std::size_t>(count));
    scratch_.taken.assign(static_cast<std::size_t>(count), 0);
    for (int i = 0; i < count; ++i) {
      const int place = scratch_.place[i];
      scratch_.sorted[place + scratch_.taken[place]++] = {scratch_.squared[i], scratch_.index[i]};
    }
    for (int i = 1; i < count; ++i)
      for (int j = i; j > 0 && scratch_.sorted[j] < scratch_.sorted[j - 1]; --j)
        std::swap(scratch_.sorted[j], scratch_.sorted[j - 1]);
    std::copy_n(scratch_.sorted.begin(), k, row);
  }

 private:
  int takeWithin(int p, double bound) {
    const Candidates candidates{static_cast<int>(scratch_.x.size()), scratch_.candidate.data(), scratch_.x.data(),
                                scratch_.y.data(), scratch_.z.data()};
    return kernels_.takeWithin(candidates, points_.row(p).data(), p, bound, scratch_.squared.data(),
                               scratch_.index.data());
  }

  PointsView points_;
  const Kernels& kernels_;
  BatchScratch& scratch_;
};

/// Finds the k nearest neighbours of each point of a batch, in one of three ways:
/// - among the points up to 1.2 radii of a nearby neighbourhood around the batch, or a few times as far: nearly always
/// enough, and certain for each point whose k nearest lie within the ball that was searched;
/// - among all points that can be among the k nearest of any point of the batch, by the k nearest of its centre;
/// - if these are too many, in halves of the batch, and at last for one point by itself.
/// @tparam Ranks the points of a batch, ascending: Consecutive, or a span
template <class Ranks>
class BatchSearch {
 public:
  BatchSearch(const NeighborSearch& search, const PointsView& points, int k, const Kernels& kernels,
              BatchScratch& scratch)
      : search_(search), points_(points), k_(k), candidates_(points, kernels, scratch), scratch_(scratch) {
    scratch_.batches.clear();
    scratch_.known.clear();
  }

  /// How many of the first points lie close enough together for one batch.
  int batchAt(const Ranks& ranks, double radius) const {
    Eigen::RowVector3d lowest = points_.row(ranks[0]), highest = lowest;
    const int most = std::min(static_cast<int>(ranks.size()), most_batch);
    int size = 1;
    for (; size < most && ranks[size] - ranks[0] < std::max(most_batch, k_ / 2); ++size) {
      lowest = lowest.cwiseMin(points_.row(ranks[size]));
      highest = highest.cwiseMax(points_.row(ranks[size]));
      if ((highest - lowest).norm() > widest_batch * radius) break;
    }
    return size;
  }

  /// @param radius of a neighbourhood nearby, or infinity
  void find(const Ranks& ranks, double radius, Neighbor* found) {
    const int count = static_cast<int>(ranks.size());
    const int done = count > 1 && radius < nowhere ? findAround(ranks, radius, found) : 0;
    if (done < count) findByCentre(ranks, done, found);
  }

  Neighbor* rowOf(Neighbor* found, int i) const { return found + static_cast<std::ptrdiff_t>(i) * k_; }
  double radiusOf(const Neighbor* row) const { return std::sqrt(row[k_ - 1].squared_distance); }

 private:
  /// The first way. Returns how many points of the batch, counted from the first, have their neighbours.
  int findAround(const Ranks& ranks, double radius, Neighbor* found) {
    const int count = static_cast<int>(ranks.size());
    const PointGroup group = groupOf(points_, ranks);
    int done = 0;
    // grows by a factor and need not end exactly
    for (double around = first_around; around < last_around; around *= next_around) {
      SearchedBatch batch = batchOf(ranks);
      if (!search_.candidatesWithin(group, k_, around * radius, scratch_.searched, batch.ball)) break;
      keep(batch);
      for (; done < count; ++done) {
        const double before = done > 0 ? radiusOf(rowOf(found, done - 1)) : radius;
        const int taken = candidates_.takeWithinBall(ranks[done], k_, likely * before * before, batch.ball);
        if (taken == 0) break;
        candidates_.takeNearest(taken, k_, rowOf(found, done));
      }
      if (done == count) break;
      forget(batch);
    }
    return done;
  }

  /// The second way, for the points of the batch from `done` on, or the third.
  void findByCentre(const Ranks& ranks, int done, Neighbor* found) {
    const int count = static_cast<int>(ranks.size());
    SearchedBatch batch = batchOf(ranks);
    if (count == 1) return findAlone(ranks[0], found);
    if (!search_.candidates(groupOf(points_, ranks), k_, scratch_.searched, scratch_.bounds, batch.ball)) {
      findByCentre(ranks.subspan(0, count / 2), 0, found);
      return findByCentre(ranks.subspan(count / 2, count - count / 2), 0, rowOf(found, count / 2));
    }
    keep(batch);
    for (int i = done; i < count; ++i) {
      const int p = ranks[i];
      // Balls around p that hold the k nearest of the centre, or those of the previous point.
      double bound = batch.ball.k_radius + (points_.row(p) - batch.ball.center).norm(), guess = nowhere;
      if (i > 0) {
        const double before = radiusOf(rowOf(found, i - 1));
        bound = std::min(bound, before + (points_.row(p) - points_.row(ranks[i - 1])).norm());
        guess = likely * before * before;
      }
      const int taken = candidates_.takeWithin(p, k_, guess, widened(bound * bound));
      if (taken >= k_)
        candidates_.takeNearest(taken, k_, rowOf(found, i));
      else  // squared distances underflow, so that no bound on them holds
        findAlone(p, rowOf(found, i));
    }
  }

  static SearchedBatch batchOf(const Ranks& ranks) {
    return {ranks[0], ranks[ranks.size() - 1] - ranks[0] + 1, {}, 0, 0};
  }

  void findAlone(int p, Neighbor* row) {
    search_.nearest(p, k_, scratch_.sorted);
    std::copy(scratch_.sorted.begin(), scratch_.sorted.end(), row);
  }

  /// Makes the result of the last search the candidates of the batch.
  void keep(SearchedBatch& batch) {
    keepSearched(batch, scratch_);
    scratch_.batches.push_back(batch);
    candidates_.gather(batch);
  }

  void forget(const SearchedBatch& last) {
    scratch_.known.resize(last.begin);
    scratch_.batches.pop_back();
  }

  const NeighborSearch& search_;
  PointsView points_;
  const int k_;
  BatchCandidates candidates_;
  BatchScratch& scratch_;
};

template <class Ranks>
void nearestOfAll(const NeighborSearch& search, const PointsView& points, const Ranks& ranks, int k,
                  const Kernels& kernels, BatchScratch& scratch, Buffer<Neighbor>& found, double radius) {
  k = std::max(0, std::min(k, static_cast<int>(points.rows()) - 1));
  if (k == 0) return found.clear();
  found.resize(ranks.size() * static_cast<std::size_t>(k) +
               static_cast<std::size_t>(NeighborSearch::mostCandidates(k)));
  BatchSearch<Ranks> search_batch(search, points, k, kernels, scratch);
  for (std::size_t i = 0; i < ranks.size();) {
    Neighbor* rows = search_batch.rowOf(found.data(), static_cast<int>(i));
    const int size = search_batch.batchAt(ranks.subspan(i, ranks.size() - i), radius);
    search_batch.find(ranks.subspan(i, static_cast<std::size_t>(size)), radius, rows);
    radius = search_batch.radiusOf(search_batch.rowOf(rows, size - 1));
    i += static_cast<std::size_t>(size);
  }
  found.resize(found.size() - static_cast<std::size_t>(NeighborSearch::mostCandidates(k)));
}

}  // namespace

void nearestOfEach(const NeighborSearch& search, const PointsView& points, int first, int count, int k,
                   const Kernels& kernels, BatchScratch& scratch, Buffer<Neighbor>& found, double radius) {
  nearestOfAll(search, points, Consecutive{first, static_cast<std::size_t>(count)}, k, kernels, scratch, found, radius);
}

void nearestOfListed(const NeighborSearch& search, const PointsView& points, std::span<const int> ranks, int k,
                     const Kernels& kernels, BatchScratch& scratch, Buffer<Neighbor>& found, double radius) {
  nearestOfAll(search, points, ranks, k, kernels, scratch, found, radius);
}

bool nearestOfKnown(const NeighborSearch& search, const PointsView& points, int p, int k, double likely_square,
                    const Kernels& kernels, BatchScratch& scratch, Buffer<Neighbor>& found) {
  const auto after = std::partition_point(scratch.batches.begin(), scratch.batches.end(),
                                          [p](const SearchedBatch& batch) { return batch.first <= p; });
  if (after == scratch.batches.begin()) return false;
  SearchedBatch& batch = *(after - 1);
  if (p >= batch.first + batch.count) return false;
  BatchCandidates candidates(points, kernels, scratch);
  if (scratch.gathered != batch.first) candidates.gather(batch);
  int count = candidates.takeWithinBall(p, k, likely_square, batch.ball);
  if (count == 0) {
    const double radius = std::sqrt(likely_square);
    SearchedBall ball;
    if (roomAround(points.row(p), batch.ball) > radius) return false;
    const PointGroup group = groupOf(points, Consecutive{batch.first, static_cast<std::size_t>(batch.count)});
    if (!search.candidatesWithin(group, k, spare_around * radius, scratch.searched, ball)) return false;
    batch.ball = ball;
    keepSearched(batch, scratch);
    candidates.gather(batch);
    count = candidates.takeWithinBall(p, k, likely_square, ball);
  }
  if (count == 0) return false;
  found.resize(static_cast<std::size_t>(count));
  candidates.takeNearest(count, k, found.data());
  found.resize(static_cast<std::size_t>(k));
  return true;
}

}  // namespace tufted
