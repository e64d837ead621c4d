#include "view/shown_values.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tufted::view {
namespace {

/// Values within this many interquartile ranges of the quartiles are no outliers (the outer fences of Tukey 1977,
/// "Exploratory Data Analysis"). Uniformly or normally distributed values have none.
constexpr double fence = 3;
/// More sources than this are not marked, because their marks would hide the values.
constexpr std::size_t most_sources = 64;

ValueRange fitted(FieldKind kind, double low, double high) {
  if (kind == FieldKind::diverging) {
    high = std::max(std::abs(low), std::abs(high));
    low = -high;
  }
  const bool is_length = kind == FieldKind::distance || kind == FieldKind::vector || kind == FieldKind::coordinates;
  return {is_length ? std::min(0.0, low) : low, high};
}

}  // namespace

Eigen::VectorXd shownValues(const SceneField& field, int column) {
  if (showsAllColumns(field.kind) && field.kind != FieldKind::color) {
    Eigen::VectorXd lengths(field.values.rows());
    for (Eigen::Index i = 0; i < lengths.size(); ++i) lengths[i] = field.values.row(i).stableNorm();
    return lengths;
  }
  Eigen::VectorXd values = field.values.col(column);
  if (!isLogarithmic(field.kind)) return values;
  for (double& value : values) value = value > 0 ? std::log10(value) : std::numeric_limits<double>::quiet_NaN();
  return values;
}

std::vector<int> sourcesOf(FieldKind kind, const Eigen::Ref<const Eigen::VectorXd>& values) {
  std::vector<int> sources;
  if (kind != FieldKind::distance && kind != FieldKind::coordinates) return sources;
  for (Eigen::Index i = 0; i < values.size() && sources.size() <= most_sources; ++i)
    if (values[i] == 0) sources.push_back(static_cast<int>(i));
  if (sources.size() > most_sources) sources.clear();
  return sources;
}

ValueRanges rangesOf(FieldKind kind, const Eigen::Ref<const Eigen::VectorXd>& values) {
  std::vector<double> finite;
  finite.reserve(static_cast<std::size_t>(values.size()));
  for (const double value : values)
    if (std::isfinite(value)) finite.push_back(value);
  if (finite.empty()) return {};
  const auto [least, greatest] = std::minmax_element(finite.begin(), finite.end());
  const double bounds[] = {*least, *greatest};
  const double first = percentile(finite, 0.01);
  const double last = percentile(finite, 0.99);
  const double lower = percentile(finite, 0.25);
  const double upper = percentile(finite, 0.75);
  const double reach = fence * (upper - lower);
  return {.usual = fitted(kind, std::max(bounds[0], std::min(first, lower - reach)),
                          std::min(bounds[1], std::max(last, upper + reach))),
          .all = fitted(kind, bounds[0], bounds[1]),
          .middle = fitted(kind, first, last)};
}

}  // namespace tufted::view
