#include "algorithms/pinned_system.h"

#include <algorithm>
#include <limits>

#include "tufted/check.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

void checkPins(const std::string& function, const Laplacian& laplacian, const Pins& pins) {
  checkSizes(function, laplacian);
  const auto n = laplacian.status.size();
  if (static_cast<std::size_t>(pins.values.rows()) != pins.points.size()) {
    throw InvalidInput(function + ": pins.values has " + std::to_string(pins.values.rows()) + " rows, must have " +
                       std::to_string(pins.points.size()) + ", one per point pinned");
  }
  if (pins.values.cols() == 0) throw InvalidInput(function + ": pins.values has no column, must have at least one");
  for (std::size_t k = 0; k < pins.points.size(); ++k) {
    if (pins.points[k] < 0 || static_cast<std::size_t>(pins.points[k]) >= n) {
      throw InvalidInput(function + ": pins.points has " + std::to_string(pins.points[k]) + ", must lie in [0, " +
                         std::to_string(n) + ")");
    }
    if (!pins.values.row(static_cast<Eigen::Index>(k)).allFinite()) {
      throw InvalidInput(function + ": pins.values of point " + std::to_string(pins.points[k]) +
                         " are not finite, must be");
    }
  }
}

}  // namespace

PinnedSystem pinnedSystem(const std::string& function, const Laplacian& laplacian, const Pins& pins) {
  checkPins(function, laplacian, pins);
  const auto n = static_cast<Eigen::Index>(laplacian.status.size()), columns = pins.values.cols();
  const Components components = findComponents(laplacian);
  PinnedSystem system{components, std::vector<std::uint8_t>(n, 0), std::vector<std::uint8_t>(n, 0),
                      Eigen::MatrixXd::Zero(n, columns), Eigen::MatrixXd::Zero(components.count, columns)};

  VectorXd count = VectorXd::Zero(n);
  for (std::size_t k = 0; k < pins.points.size(); ++k) {
    const int i = laplacian.representative[pins.points[k]];
    system.values.row(i) += pins.values.row(static_cast<Eigen::Index>(k));
    count[i] += 1;
    system.pinned[i] = 1;
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    if (count[i] > 1) system.values.row(i) /= count[i];
    if (count[i] == 0) system.values.row(i).setConstant(std::numeric_limits<double>::quiet_NaN());
  }

  VectorXd pins_of = VectorXd::Zero(components.count);
  for (const int i : components.points) {
    if (system.pinned[i] == 0) continue;
    system.means.row(components.of[i]) += system.values.row(i);
    pins_of[components.of[i]] += 1;
  }
  if (!(pins_of.size() > 0 && pins_of.maxCoeff() > 0)) {
    throw InvalidInput(function + ": pins.points has no point on a component, must have at least one active point");
  }
  for (int c = 0; c < components.count; ++c) system.means.row(c) /= std::max(pins_of[c], 1.0);
  for (const int i : components.points) {
    system.free[i] = system.pinned[i] == 0 && pins_of[components.of[i]] > 0 ? 1 : 0;
  }
  return system;
}

}  // namespace tufted
