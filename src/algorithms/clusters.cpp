#include "algorithms/clusters.h"

namespace tufted {
namespace {

/// Maximum number of iterations of k-means; it usually takes ten.
constexpr int lloyd_iterations = 100;

/// The first centres, see clusters(): `count` x d.
Eigen::MatrixXd farthestRows(const Eigen::MatrixXd& rows, const VectorXd& weights, int count) {
  Eigen::MatrixXd centres(count, rows.cols());
  const Eigen::RowVectorXd mean = weights.transpose() * rows / weights.sum();
  VectorXd distance = (rows.rowwise() - mean).rowwise().squaredNorm();
  for (int c = 0; c < count; ++c) {
    Eigen::Index farthest = 0;
    distance.maxCoeff(&farthest);
    centres.row(c) = rows.row(farthest);
    const VectorXd here = (rows.rowwise() - centres.row(c)).rowwise().squaredNorm();
    distance = c == 0 ? here : VectorXd(distance.cwiseMin(here));
  }
  return centres;
}

}  // namespace

std::vector<int> clusters(const Eigen::MatrixXd& rows, VectorXd weights, int count) {
  std::vector<int> cluster(static_cast<std::size_t>(rows.rows()), -1);
  if (rows.rows() == 0) return cluster;
  if (!(weights.sum() > 0)) weights.setOnes();
  weights /= weights.maxCoeff();
  Eigen::MatrixXd centres = farthestRows(rows, weights, count);
  for (int iteration = 0; iteration < lloyd_iterations; ++iteration) {
    bool changed = false;
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      Eigen::Index nearest = 0;
      (centres.rowwise() - rows.row(i)).rowwise().squaredNorm().minCoeff(&nearest);
      changed |= cluster[i] != nearest;
      cluster[i] = static_cast<int>(nearest);
    }
    if (!changed) break;
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(count, rows.cols());
    VectorXd size = VectorXd::Zero(count);
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      sums.row(cluster[i]) += weights[i] * rows.row(i);
      size[cluster[i]] += weights[i];
    }
    // A centre without rows stays where it is.
    for (int c = 0; c < count; ++c)
      if (size[c] > 0) centres.row(c) = sums.row(c) / size[c];
  }
  return cluster;
}

}  // namespace tufted
