#include "extent.h"

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "options.h"
#include "tufted/errors.h"

std::string Extent::text() const {
  return name + " has the size " + numberText(size) + " and the spacing " + numberText(spacing);
}

namespace {

double meanEdge(const tufted::Laplacian& laplacian) {
  double sides = 0, length = 0;
  for (const tufted::ComponentEdges& edges : laplacian.component_edges) {
    sides += static_cast<double>(edges.sides);
    length += static_cast<double>(edges.sides) * edges.mean;
  }
  return sides > 0 ? length / sides : 0;
}

}  // namespace

Extent extentOf(const Operator& source) {
  const tufted::Points& points = source.geometry.points;
  Eigen::AlignedBox3d box;
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    if (source.laplacian.status[static_cast<std::size_t>(i)] == tufted::PointStatus::active)
      box.extend(points.row(i).transpose());
  const double diagonal = box.isEmpty() ? 0 : box.diagonal().norm();
  return {.name = source.name,
          .size = std::max(diagonal, std::sqrt(source.laplacian.M.sum())),
          .spacing = meanEdge(source.laplacian)};
}

CLI::Option* addTimeStep(CLI::App& command, std::optional<double>& time_step, const std::string& text) {
  return addNumber(command, "--time-step T", time_step, 1e-4, 1e12, text);
}

void checkTimeStep(const std::optional<double>& time_step, double time, const Operator& source) {
  if (!time_step) return;
  constexpr double shortest = 0.01;  // least distance that heat spreads, in spacings
  const Extent extent = extentOf(source);
  const double length = std::sqrt(time);
  if (length >= shortest * extent.spacing && length <= extent.size) return;
  throw tufted::InvalidInput("--time-step " + numberText(*time_step) + ": heat goes " + numberText(length) + ", " +
                             (length > extent.size ? "beyond all points" : "less than a hundredth of the spacing") +
                             ": " + extent.text());
}
