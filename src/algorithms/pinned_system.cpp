#include "algorithms/pinned_system.h"

#include <limits>

#include "tufted/errors.h"

namespace tufted {
namespace {

void checkPins(const std::string& function, const Laplacian& laplacian, const Pins& pins) {
  const auto n = laplacian.status.size();
  if (static_cast<std::size_t>(laplacian.L.rows()) != n || laplacian.representative.size() != n ||
      static_cast<std::size_t>(laplacian.M.size()) != n) {
    throw InvalidInput(function +
                       ": L, M, status and representative differ in their number of points, must be the same");
  }
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
  PinnedSystem system{findComponents(laplacian), std::vector<std::uint8_t>(n, 0), std::vector<std::uint8_t>(n, 0),
                      Eigen::MatrixXd::Zero(n, columns)};
  const Components& components = system.components;

  VectorXd count = VectorXd::Zero(n);
  for (std::size_t k = 0; k < pins.points.size(); ++k) {
    const int i = laplacian.representative[pins.points[k]];
    system.values.row(i) += pins.values.row(static_cast<Eigen::Index>(k));
    count[i] += 1;
    system.pinned[i] = 1;
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    if (count[i] > 1) system.values.row(i) /= count[i];
  }

  Eigen::MatrixXd means = Eigen::MatrixXd::Zero(components.count, columns);
  VectorXd pins_of = VectorXd::Zero(components.count);
  for (const int i : components.points) {
    if (system.pinned[i] == 0) continue;
    means.row(components.of[i]) += system.values.row(i);
    pins_of[components.of[i]] += 1;
  }
  if (!(pins_of.size() > 0 && pins_of.maxCoeff() > 0)) {
    throw InvalidInput(function + ": pins.points has no point on a component, must have at least one active point");
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    if (system.pinned[i] != 0) continue;
    const int component = components.of[i];
    system.free[i] = component >= 0 && pins_of[component] > 0 ? 1 : 0;
    if (system.free[i] != 0)
      system.values.row(i) = means.row(component) / pins_of[component];
    else
      system.values.row(i).setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return system;
}

}  // namespace tufted
