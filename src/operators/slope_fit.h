#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "operators/rings.h"
#include "tufted/laplacian.h"
#include "tufted/types.h"

namespace tufted {

/// The plane in which slopes are measured: that of the frame, or the one that fits the neighbourhood best.
enum class Planes { given, fitted };

struct SlopeOptions {
  int neighbors;          ///< beside the point; 0: those in L
  double regularization;  ///< as GradientOptions::regularization
  Planes planes;
};

/// The slopes of a linear function that fits a function at a point and around it.
struct SlopeFit {
  std::vector<int> points;             ///< ascending, the point itself among them
  Eigen::Matrix2Xd coefficients;       ///< slopes along the tangent and across, by the values at the points
  Eigen::RowVector3d normal, tangent;  ///< of the plane
  bool is_widened = false;             ///< as GradientReport
  bool is_on_a_line = false;
};

/// Fits linear functions around one point after the other.
class SlopeFitter {
 public:
  /// @param L, points and frames borrowed
  SlopeFitter(const SparseMatrix& L, const PointsRef& points, const Frames& frames, const SlopeOptions& options)
      : points_(points), frames_(frames), options_(options), rings_(L) {}

  /// @return valid until the next fit
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
  Eigen::Matrix3Xd edges_;  ///< from the point to each of fit_.points, about their mean unless the fit is regularized
  Eigen::Vector3d mean_;    ///< of the edges
  SlopeFit fit_;
};

}  // namespace tufted
