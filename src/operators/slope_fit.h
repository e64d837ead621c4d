#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "operators/rings.h"
#include "tufted/laplacian.h"
#include "tufted/types.h"

namespace tufted {

/// The plane in which slopes are measured: that of the frame, or the one that fits the points best.
enum class Planes { given, fitted };

struct SlopeOptions {
  int neighbors;          ///< number of nearest points besides the point itself; 0: its neighbours in L
  double regularization;  ///< see GradientOptions::regularization
  Planes planes;
};

/// The slopes of the linear function that fits values at a point and around it.
struct SlopeFit {
  std::vector<int> points;        ///< ascending, the point itself included
  Eigen::Matrix2Xd coefficients;  ///< slopes along tangent and cross(normal, tangent), per value at each of `points`
  Eigen::RowVector3d normal, tangent;  ///< of the plane
  bool is_widened = false;             ///< see GradientReport::widened
  bool is_on_a_line = false;
};

/// Fits linear functions around one point after the other (docs/algorithm.md, section 15).
class SlopeFitter {
 public:
  /// L, points and frames are borrowed.
  SlopeFitter(const SparseMatrix& L, const PointsRef& points, const Frames& frames, const SlopeOptions& options)
      : points_(points), frames_(frames), options_(options), rings_(L) {}

  /// Fits around point p.
  /// @return valid until the next call
  const SlopeFit& fit(int p);

 private:
  bool gather(int p, int doublings);
  double findEdges(int p);
  void choosePlane(int p);
  bool fitSlopes(int p, double scale);

  PointsRef points_;
  const Frames& frames_;
  SlopeOptions options_;
  Rings rings_;
  std::vector<std::pair<double, int>> by_distance_;
  Eigen::Matrix3Xd edges_;  ///< from the point to each of fit_.points, over findEdges()
  Eigen::Vector3d mean_;    ///< mean of the edges
  SlopeFit fit_;
};

}  // namespace tufted
