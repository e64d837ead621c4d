#pragma once

#include <flann/algorithms/dist.h>
#include <flann/algorithms/kdtree_single_index.h>

#include <Eigen/Dense>
#include <algorithm>
#include <vector>

#include "tufted/types.h"

namespace tufted::bench {

/// Finds the nearest of some points.
class NearestPoints {
 public:
  explicit NearestPoints(const Points& points)
      : points_(points),
        index_(flann::Matrix<double>(points_.data(), static_cast<std::size_t>(points_.rows()), 3),
               flann::KDTreeSingleIndexParams()) {
    index_.buildIndex();
  }
  const Points& points() const { return points_; }
  /// The `count` nearest points, ascending by distance.
  std::vector<std::size_t> of(const Eigen::RowVector3d& place, int count) const {
    const auto k = std::min(static_cast<std::size_t>(count), static_cast<std::size_t>(points_.rows()));
    flann::KNNSimpleResultSet<double> nearest(k);
    index_.findNeighbors(nearest, place.data(), flann::SearchParams(flann::FLANN_CHECKS_UNLIMITED));
    std::vector<std::size_t> found(k);
    std::vector<double> squared(k);
    nearest.copy(found.data(), squared.data(), k);
    return found;
  }

 private:
  Points points_;
  flann::KDTreeSingleIndex<flann::L2_Simple<double>> index_;
};

/// The plane that fits some points best.
struct Frame {
  Eigen::RowVector3d middle;
  Eigen::Matrix3d axes;  ///< columns: two directions in the plane, then the normal
};

inline Frame frameOf(const Points& points) {
  const Eigen::RowVector3d middle = points.colwise().mean();
  const Eigen::MatrixX3d d = points.rowwise() - middle;
  const Eigen::Matrix3d covariance = d.transpose() * d;
  const Eigen::Matrix3d vectors = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors();
  return {middle, vectors.rowwise().reverse()};
}

inline Points rowsOf(const Points& points, const std::vector<std::size_t>& which, int count) {
  Points some(count, 3);
  for (int i = 0; i < count; ++i) some.row(i) = points.row(static_cast<Eigen::Index>(which[i]));
  return some;
}

}  // namespace tufted::bench
