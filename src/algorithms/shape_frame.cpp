#include "algorithms/shape_frame.h"

#include <cmath>
#include <limits>

#include "tufted/check.h"
#include "tufted/errors.h"

namespace tufted {

ShapeFrame::ShapeFrame(const std::string& function, const Laplacian& laplacian) {
  checkSizes(function, laplacian);
  const auto n = std::ssize(laplacian.status);
  if (laplacian.positions.rows() != n)
    throw InvalidInput(function + ": Laplacian::positions has " + std::to_string(laplacian.positions.rows()) +
                       " rows, must have " + std::to_string(n) + ", one per point");
  Eigen::RowVector3d least = Eigen::RowVector3d::Constant(std::numeric_limits<double>::infinity()), most = -least;
  bool is_empty = true;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (laplacian.status[i] != PointStatus::active) continue;
    const Eigen::RowVector3d p = laplacian.positions.row(i);
    if (!p.allFinite())
      throw InvalidInput(function + ": the position of point " + std::to_string(i) +
                         " is not finite, must be: the Laplacian has it active");
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

}  // namespace tufted
