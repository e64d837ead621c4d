#include "algorithms/shape_frame.h"

#include <cmath>
#include <limits>

#include "algorithms/check_positions.h"

namespace tufted {

ShapeFrame::ShapeFrame(const std::string& function, const Laplacian& laplacian) {
  checkPositions(function, laplacian);
  Eigen::RowVector3d least = Eigen::RowVector3d::Constant(std::numeric_limits<double>::infinity()), most = -least;
  bool is_empty = true;
  for (Eigen::Index i = 0; i < std::ssize(laplacian.status); ++i) {
    if (laplacian.status[i] != PointStatus::active) continue;
    const Eigen::RowVector3d p = laplacian.positions.row(i);
    least = least.cwiseMin(p);
    most = most.cwiseMax(p);
    is_empty = false;
  }
  if (is_empty) return;
  origin_ = least / 2 + most / 2;
  const double longest = (most - least).maxCoeff();
  if (!(longest > 0)) return;
  exponent_ = std::ilogb(longest) + 1;
  extent_ = std::ldexp(longest, -exponent_);
}

Eigen::MatrixXd ShapeFrame::toFrame(const Eigen::Ref<const Eigen::MatrixXd>& positions) const {
  Eigen::MatrixXd x = positions.rowwise() - origin_;
  for (double& value : x.reshaped()) value = std::ldexp(value, -exponent_);
  return x;
}

Eigen::RowVector3d ShapeFrame::toCaller(const Eigen::RowVector3d& position) const {
  Eigen::RowVector3d p = position;
  for (double& value : p) value = std::ldexp(value, exponent_);
  return p + origin_;
}

double ShapeFrame::toCaller(double length) const {
  return std::ldexp(length, exponent_);
}

double ShapeFrame::areaToCaller(double area) const {
  return std::ldexp(area, 2 * exponent_);
}

double ShapeFrame::areaToFrame(double area) const {
  return std::ldexp(area, -2 * exponent_);
}

}  // namespace tufted
