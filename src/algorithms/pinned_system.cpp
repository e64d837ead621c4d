#include "algorithms/pinned_system.h"

#include <algorithm>
#include <limits>

#include "tufted/check.h"
#include "tufted/errors.h"

namespace tufted {

PinnedPoints pinnedPoints(const std::string& function, const Laplacian& laplacian, const std::vector<int>& points,
                          const std::string& what) {
  checkSizes(function, laplacian);
  const auto n = laplacian.status.size();
  const std::string name = function + ": " + what;
  PinnedPoints result{findComponents(laplacian), std::vector<std::uint8_t>(n, 0), std::vector<std::uint8_t>(n, 0)};
  for (const int point : points) {
    if (point < 0 || static_cast<std::size_t>(point) >= n) {
      throw InvalidInput(name + " has " + std::to_string(point) + ", must lie in [0, " + std::to_string(n) + ")");
    }
    result.pinned[laplacian.representative[point]] = 1;
  }
  const Components& components = result.components;
  std::vector<bool> has_pin(components.count, false);
  for (const int i : components.points)
    if (result.pinned[i] != 0) has_pin[components.of[i]] = true;
  if (std::find(has_pin.begin(), has_pin.end(), true) == has_pin.end()) {
    std::string why;
    if (!points.empty())
      why = ": " + whyOnNone("point", points[0], laplacian.status[laplacian.representative[points[0]]]);
    throw InvalidInput(name + " has no point on a component, must have at least one active point" + why);
  }
  for (const int i : components.points) result.free[i] = result.pinned[i] == 0 && has_pin[components.of[i]] ? 1 : 0;
  return result;
}

void checkPinnedValues(const std::string& function, const std::vector<int>& points, const Eigen::MatrixXd& values) {
  if (static_cast<std::size_t>(values.rows()) != points.size()) {
    throw InvalidInput(function + ": pins.values has " + std::to_string(values.rows()) + " rows, must have " +
                       std::to_string(points.size()) + ", one per point pinned");
  }
  if (values.cols() == 0) throw InvalidInput(function + ": pins.values has no column, must have at least one");
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!values.row(static_cast<Eigen::Index>(k)).allFinite())
      throw InvalidInput(function + ": pins.values of point " + std::to_string(points[k]) + " are not finite, must be");
  }
}

PinnedValues pinnedValues(const Laplacian& laplacian, const PinnedPoints& pinned, const std::vector<int>& points,
                          const Eigen::MatrixXd& values) {
  const auto n = static_cast<Eigen::Index>(laplacian.status.size()), columns = values.cols();
  const Components& components = pinned.components;
  PinnedValues result{Eigen::MatrixXd::Zero(n, columns), Eigen::MatrixXd::Zero(components.count, columns)};
  VectorXd count = VectorXd::Zero(n);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const int i = laplacian.representative[points[k]];
    result.values.row(i) += values.row(static_cast<Eigen::Index>(k));
    count[i] += 1;
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    if (count[i] > 1) result.values.row(i) /= count[i];
    if (count[i] == 0) result.values.row(i).setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  VectorXd pins_of = VectorXd::Zero(components.count);
  for (const int i : components.points) {
    if (pinned.pinned[i] == 0) continue;
    result.means.row(components.of[i]) += result.values.row(i);
    pins_of[components.of[i]] += 1;
  }
  for (int c = 0; c < components.count; ++c) result.means.row(c) /= std::max(pins_of[c], 1.0);
  return result;
}

}  // namespace tufted
