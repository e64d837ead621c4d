#include "view/page_columns.h"

#include <algorithm>
#include <cmath>

namespace tufted::view {

namespace {

/// The greatest level.
constexpr double top_level = no_level - 1;
/// Values beyond the outer percentiles by more than this many times their distance are stored in full, because levels
/// for them would cost the others digits. Uniformly or normally distributed values have none.
constexpr double level_reach = 6;
/// One in this many values lies below the lower percentile and one above the upper, so that a few outliers do not move
/// them.
constexpr std::size_t percentile_share = 100;

/// The 1st and the 99th percentile of at least one value. Reorders the values.
std::pair<double, double> outerPercentiles(std::vector<double>& values) {
  const std::size_t rank = values.size() / percentile_share;
  const auto low = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), low, values.end());
  const auto high = values.begin() + static_cast<std::ptrdiff_t>(values.size() - 1 - rank);
  const double lower = *low;
  std::nth_element(values.begin(), high, values.end());
  return {lower, *high};
}

}  // namespace

LevelColumn levelsOf(const Eigen::Ref<const Eigen::VectorXd>& values) {
  LevelColumn column;
  column.levels.assign(static_cast<std::size_t>(values.size()), no_level);
  std::vector<double> finite;
  finite.reserve(column.levels.size());
  for (const double value : values)
    if (std::isfinite(value)) finite.push_back(value);
  column.finite = static_cast<Eigen::Index>(finite.size());
  if (finite.empty()) return column;

  const auto [minimum, maximum] = std::minmax_element(finite.begin(), finite.end());
  column.minimum = *minimum;
  column.maximum = *maximum;
  std::tie(column.low, column.high) = outerPercentiles(finite);
  // Halves, because a difference may overflow. An infinite `reach` does no harm.
  const double reach = 2 * level_reach * (column.high / 2 - column.low / 2);
  column.least = std::max(column.minimum, column.low - reach);
  const double greatest = std::min(column.maximum, column.high + reach);
  column.step = greatest / top_level - column.least / top_level;
  for (Eigen::Index row = 0; row < values.size(); ++row) {
    const double value = values[row];
    if (!std::isfinite(value)) continue;
    const double level = column.step > 0 ? (value / 2 - column.least / 2) / (column.step / 2) : 0;
    column.levels[static_cast<std::size_t>(row)] =
        static_cast<std::uint16_t>(std::clamp(std::round(level), 0.0, top_level));
    if (value < column.least || value > greatest) {
      column.far_rows.push_back(static_cast<std::uint32_t>(row));
      column.far_values.push_back(value);
    }
  }
  return column;
}

LabelColumn labelsOf(const Eigen::Ref<const Eigen::VectorXd>& values) {
  LabelColumn column;
  for (const double value : values)
    if (std::isfinite(value)) column.names.push_back(value);
  std::sort(column.names.begin(), column.names.end());
  column.names.erase(std::unique(column.names.begin(), column.names.end()), column.names.end());
  column.indices.reserve(static_cast<std::size_t>(values.size()));
  for (const double value : values) {
    const auto name =
        std::isfinite(value) ? std::lower_bound(column.names.begin(), column.names.end(), value) : column.names.end();
    column.indices.push_back(static_cast<std::uint32_t>(name - column.names.begin()));
  }
  return column;
}

void octahedralBytes(const Eigen::Vector3d& direction, std::uint8_t bytes[2]) {
  // Steps from 0 to 1: normals are off by less than a degree, which shading does not show.
  constexpr double steps = 127;
  bytes[0] = bytes[1] = 0;
  const double largest = direction.cwiseAbs().maxCoeff();  // divided out first, because a sum may overflow
  if (!direction.allFinite() || !(largest > 0)) return;
  const Eigen::Vector3d unit = direction / largest;
  Eigen::Array2d p = unit.head<2>().array() / unit.cwiseAbs().sum();
  if (unit.z() < 0) {
    const Eigen::Array2d folded = 1 - p.abs().reverse();
    p = (p < 0).select(-folded, folded);
  }
  for (int i = 0; i < 2; ++i) bytes[i] = static_cast<std::uint8_t>(128 + std::lround(steps * p[i]));
}

}  // namespace tufted::view
