#include "operators/slope_fit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/symmetric_eigen.h"
#include "stars/tangent_frame.h"

namespace tufted {
namespace {

/// If the smaller spread of the points in the tangent plane is below this part of the larger, they lie on a line, and
/// the slope across it is 0.
constexpr double flat = 1e-10;
/// If it is below this part of the larger, more neighbours are taken: at the corner of a square L has one neighbour
/// only, and a scan line does not determine the slope across.
constexpr double narrow = 1e-4;
/// Maximum number of doublings of a narrow neighbourhood, to reach the next scan line; one of the neighbours in L gets
/// a ring instead.
constexpr int most_slope_doublings = 3;
/// The nearest points are chosen among at least this many times their number, because rings are not circles.
constexpr double gathered = 2.5;

/// The sum of outer products of columns in their order. Eigen's product sums in an order that depends on the address of
/// the result.
template <int rows>
Eigen::Matrix<double, rows, rows> secondMoment(const Eigen::Matrix<double, rows, Eigen::Dynamic>& columns) {
  Eigen::Matrix<double, rows, rows> sum = Eigen::Matrix<double, rows, rows>::Zero();
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < rows; ++j) sum(i, j) += columns(i, k) * columns(j, k);
  }
  return sum;
}

}  // namespace

/// Collects the neighbourhood. @return whether more points could be added
bool SlopeFitter::gather(int p, int doublings) {
  rings_.start(p);
  bool grows = true;
  if (options_.neighbors == 0) {
    for (int ring = 0; ring <= doublings && grows; ++ring) grows = rings_.grow();
    fit_.points = rings_.points();
  } else {
    const std::size_t wanted = static_cast<std::size_t>(options_.neighbors) << doublings;
    const auto enough = static_cast<std::size_t>(gathered * static_cast<double>(wanted));
    while (grows && rings_.points().size() <= enough) grows = rings_.grow();
    by_distance_.clear();
    for (const int q : rings_.points()) by_distance_.emplace_back((points_.row(q) - points_.row(p)).stableNorm(), q);
    fit_.points.clear();
    double last = INFINITY;
    if (by_distance_.size() > wanted + 1) {
      const auto farthest = by_distance_.begin() + static_cast<std::ptrdiff_t>(wanted);  // the point itself counts
      std::nth_element(by_distance_.begin(), farthest, by_distance_.end());
      last = farthest->first;
    }
    for (const auto& [distance, q] : by_distance_)
      if (distance <= last) fit_.points.push_back(q);
    grows |= fit_.points.size() < by_distance_.size();
  }
  std::sort(fit_.points.begin(), fit_.points.end());
  return grows;
}

/// Computes the edges over a power of two near the largest, against overflow of squares.
/// @return this power of two; 0 if all points are at one place
double SlopeFitter::findEdges(int p) {
  double extent = 0;
  for (const int q : fit_.points) extent = std::max(extent, (points_.row(q) - points_.row(p)).cwiseAbs().maxCoeff());
  if (!(extent > 0) || !std::isfinite(extent)) return 0;
  const double scale =
      std::exp2(std::clamp(std::ilogb(extent), -1021, 1022));  // the inverse must be a normal number, too
  edges_.resize(3, std::ssize(fit_.points));
  mean_.setZero();
  for (Eigen::Index k = 0; k < edges_.cols(); ++k) {
    edges_.col(k) = (points_.row(fit_.points[k]) - points_.row(p)).transpose() / scale;
    mean_ += edges_.col(k);
  }
  mean_ /= static_cast<double>(edges_.cols());
  return scale;
}

/// Sets the plane that fits the points best, with a normal on the same side as the frame's, unless planes are given.
void SlopeFitter::choosePlane(int p) {
  if (options_.planes == Planes::given) return;
  const Eigen::Matrix3Xd centered = edges_.colwise() - mean_;
  const auto solver = symmetricEigen(secondMoment<3>(centered));
  const Eigen::Vector3d& spreads = solver.eigenvalues();  // ascending
  const Eigen::Vector3d given = frames_.normals.row(p).transpose(), along = solver.eigenvectors().col(2);
  Eigen::Vector3d normal = solver.eigenvectors().col(0);
  if (!(spreads[1] > flat * spreads[2])) {  // points on a line: the plane through it that is nearest to the frame's
    normal = given - given.dot(along) * along;
    normal = normal.norm() > narrow ? normal.normalized() : tangentOf(along);
  }
  if (normal.dot(given) < 0) normal = -normal;
  fit_.normal = normal.transpose();
  fit_.tangent = tangentOf(normal).transpose();
}

/// Computes the coefficients of the slopes.
/// @param scale result of findEdges()
/// @return whether the points determine the slopes well
bool SlopeFitter::fitSlopes(int p, double scale) {
  const bool is_regularized = options_.regularization > 0;
  const Eigen::Vector3d x = fit_.tangent.transpose(), y = fit_.normal.cross(fit_.tangent).transpose();
  const Eigen::Vector3d origin = is_regularized ? Eigen::Vector3d::Zero() : mean_;
  Eigen::Matrix2Xd edges(2, edges_.cols());
  for (Eigen::Index k = 0; k < edges.cols(); ++k) {
    const Eigen::Vector3d edge = edges_.col(k) - origin;
    edges.col(k) << edge.dot(x), edge.dot(y);
  }
  const auto solver = symmetricEigen(secondMoment<2>(edges));
  const Eigen::Vector2d& spreads = solver.eigenvalues();  // ascending
  const double added = options_.regularization / scale / scale;
  Eigen::Vector2d inverse = Eigen::Vector2d::Zero();
  for (int k = 0; k < 2; ++k) {
    if (spreads[k] > flat * spreads[1]) inverse[k] = 1 / (spreads[k] + added);
  }
  const Eigen::Matrix2d pseudo = solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose();
  fit_.coefficients.resize(2, edges.cols());
  for (Eigen::Index k = 0; k < edges.cols(); ++k) {
    const Eigen::Vector2d edge = edges.col(k) / scale;
    fit_.coefficients.col(k) = pseudo.col(0) * edge.x() + pseudo.col(1) * edge.y();
  }
  fit_.is_on_a_line = !(spreads[0] > flat * spreads[1]);
  if (is_regularized) {
    const auto self = std::lower_bound(fit_.points.begin(), fit_.points.end(), p) - fit_.points.begin();
    fit_.coefficients.col(self) = -fit_.coefficients.rowwise().sum().eval();
  }
  return spreads[0] > narrow * spreads[1];
}

const SlopeFit& SlopeFitter::fit(int p) {
  fit_.normal = frames_.normals.row(p);
  fit_.tangent = frames_.tangents.row(p);
  bool is_wide = false, has_more = true;
  for (int doublings = 0; doublings <= most_slope_doublings && has_more && !is_wide; ++doublings) {
    has_more = gather(p, doublings);
    fit_.is_widened = doublings > 0;
    const double scale = findEdges(p);
    if (scale > 0) {
      choosePlane(p);
      is_wide = fitSlopes(p, scale);
    } else {
      fit_.coefficients = Eigen::Matrix2Xd::Zero(2, std::ssize(fit_.points));
      fit_.is_on_a_line = true;
    }
  }
  return fit_;
}

}  // namespace tufted
