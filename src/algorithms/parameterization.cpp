// Maps of surfaces to the plane: spectral conformal (Mullen et al. 2008) and harmonic (Tutte 1963, Floater 2003).
#include "tufted/parameterization.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "algorithms/chart_layout.h"
#include "algorithms/chart_metric.h"
#include "algorithms/charts.h"
#include "algorithms/check_positions.h"
#include "algorithms/coincident.h"
#include "algorithms/conformal_map.h"
#include "algorithms/connected.h"
#include "algorithms/mean_value_map.h"
#include "base/parallel.h"
#include "base/require.h"
#include "base/sort_unique.h"
#include "base/stage_clock.h"
#include "tufted/interpolation.h"

namespace tufted {
namespace {

constexpr const char* parameterization_name = "parameterize";
/// A chart is not laid out if more than this share of its area collapses, as on long tubes; needles and ends of spikes
/// are less.
constexpr double most_collapsed = 1e-3;

void checkArguments(const Laplacian& laplacian, const ParameterizationOptions& options) {
  checkPositions(parameterization_name, laplacian);
  requireChoice(options.method, ParameterizationMethod::harmonic, parameterization_name, "method");
  requireChoice(options.weights, HarmonicWeights::mean_value, parameterization_name, "weights");
  const bool is_harmonic = options.method == ParameterizationMethod::harmonic;
  if (!is_harmonic && (!options.rim.empty() || options.weights != HarmonicWeights::laplacian))
    refuse(parameterization_name, "rim or weights are given, must be with ParameterizationMethod::harmonic alone");
  if (options.rim_positions.rows() > 0 && options.rim_positions.rows() != std::ssize(options.rim))
    refuse(parameterization_name, "rim_positions has " + std::to_string(options.rim_positions.rows()) +
                                      " rows, must have " + std::to_string(options.rim.size()) +
                                      ", one per point of rim");
  if (!options.rim_positions.allFinite()) refuse(parameterization_name, "rim_positions are not finite, must be");
}

/// The beginning of messages about the largest chart.
std::string textOf(const Chart& largest) {
  return "the surface (its largest part, of " + std::to_string(largest.triangles.size()) + " triangles) ";
}

bool canBeMapped(const Chart& chart) {
  return chart.is_manifold && chart.is_orientable && !chart.rims.empty();
}

/// The charts that can be mapped to the plane. The others are counted; throws if the largest is one.
std::vector<const Chart*> mappableCharts(const std::vector<Chart>& charts, ParameterizationReport& report) {
  std::vector<const Chart*> kept;
  for (const Chart& chart : charts) {
    if (canBeMapped(chart)) {
      kept.push_back(&chart);
    } else {
      ++(!chart.is_manifold ? report.nonmanifold : !chart.is_orientable ? report.nonorientable : report.closed);
    }
  }
  if (charts.empty())
    refuse(parameterization_name, "no triangle has three different active points, must be at least one");
  const Chart& largest = charts.front();
  const std::string where = textOf(largest);
  if (!largest.is_manifold)
    refuse(parameterization_name, where + "has an edge of more than two triangles, must have none");
  if (!largest.is_orientable) refuse(parameterization_name, where + "is nonorientable, must have two sides");
  if (largest.rims.empty()) refuse(parameterization_name, where + "is closed, must have a rim: cut it open");
  return kept;
}

/// Maps charts conformally, side by side.
/// @param charts those that collapse are removed
/// @param[out] owner N; chart of each point's (u, v)
Eigen::MatrixX2d conformal(const Laplacian& laplacian, std::vector<const Chart*>& charts,
                           const ParameterizationOptions& options, std::vector<int>& owner,
                           ParameterizationReport& report) {
  const auto n = std::ssize(laplacian.status);
  Eigen::MatrixX2d uv = Eigen::MatrixX2d::Constant(n, 2, std::nan(""));
  std::vector<Eigen::MatrixX2d> maps;
  std::vector<std::vector<int>> members;
  std::vector<int> exponents, local(static_cast<std::size_t>(n), -1);
  std::vector<const Chart*> kept;
  for (const Chart* chart : charts) {
    std::vector<int> points;
    for (const auto& corners : chart->triangles) points.insert(points.end(), corners.begin(), corners.end());
    sortUnique(points);
    for (std::size_t k = 0; k < points.size(); ++k) local[points[k]] = static_cast<int>(k);
    const int exponent = exponentOf(laplacian.positions, chart->triangles);
    Eigen::MatrixX2d map =
        conformalMap(parameterization_name, laplacian.positions, *chart, points, local, options.solver, report);
    const Collapse collapse = placeAlone(laplacian.positions, *chart, exponent, local, map);
    if (collapse.area_share > most_collapsed) {
      if (chart == charts.front())
        refuse(parameterization_name, textOf(*chart) +
                                          "is too long for its rims: " + std::to_string(collapse.triangles) +
                                          " triangles collapse in the plane; cut it open along its length");
      ++report.collapsed_charts;
      continue;
    }
    kept.push_back(chart);
    maps.push_back(std::move(map));
    exponents.push_back(exponent);
    members.push_back(std::move(points));
  }
  charts = std::move(kept);
  placeBesideEachOther(maps, exponents);
  std::vector<std::uint8_t> is_shared(static_cast<std::size_t>(n), 0);
  for (std::size_t c = 0; c < maps.size(); ++c) {
    for (std::size_t k = 0; k < members[c].size(); ++k) {
      const int i = members[c][k];
      if (owner[i] >= 0) {
        is_shared[i] = 1;
        continue;
      }
      owner[i] = static_cast<int>(c);
      uv.row(i) = maps[c].row(static_cast<Eigen::Index>(k));
    }
  }
  report.shared_points = std::count(is_shared.begin(), is_shared.end(), 1);
  return uv;
}

/// The rim of a surface that must be a disk.
std::vector<int> rimOfDisk(const std::vector<Chart>& charts) {
  if (charts.size() > 1)
    refuse(parameterization_name, "the surface has " + std::to_string(charts.size()) + " parts, must be one");
  const Chart& chart = charts.front();
  if (chart.rims.size() > 1)
    refuse(parameterization_name,
           "the surface has " + std::to_string(chart.rims.size()) + " rims, must have one; or give the rim");
  std::vector<int> rim = chart.rims.front(), sorted = rim;
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end())
    refuse(parameterization_name,
           "the rim passes point " + std::to_string(*twice) + " more than once, must pass it once");
  if (chart.eulerCharacteristic() != 1)
    refuse(parameterization_name, "the surface has Euler characteristic " +
                                      std::to_string(chart.eulerCharacteristic()) + ", must have 1, that of a disk");
  // Starts at the smallest index.
  std::rotate(rim.begin(), std::min_element(rim.begin(), rim.end()), rim.end());
  return rim;
}

/// The caller's rim, as representatives.
std::vector<int> givenRim(const Laplacian& laplacian, const ParameterizationOptions& options) {
  const int n = static_cast<int>(laplacian.status.size());
  const Components components = findComponents(laplacian);
  std::vector<int> rim;
  std::vector<std::uint8_t> seen(laplacian.status.size(), 0);
  for (const int given : options.rim) {
    const std::string point = "point " + std::to_string(given) + " of rim ";
    if (given < 0 || given >= n)
      refuse(parameterization_name,
             "rim has " + std::to_string(given) + ", must lie in [0, " + std::to_string(n) + ")");
    const int i = laplacian.representative[given];
    if (components.of[i] < 0) refuse(parameterization_name, point + "lies on no component, must be active");
    if (seen[i] != 0) refuse(parameterization_name, point + "is given twice, must be once");
    seen[i] = 1;
    rim.push_back(i);
    if (components.of[i] != components.of[rim[0]])
      refuse(parameterization_name, point + "lies on another component than the first, must lie on the same");
  }
  if (rim.size() < 3)
    refuse(parameterization_name, "rim has " + std::to_string(rim.size()) + " points, must have at least 3");
  return rim;
}

/// Positions on the unit circle, spaced by length along the rim.
Eigen::MatrixX2d onCircle(const Points& positions, const std::vector<int>& rim) {
  const auto count = std::ssize(rim);
  VectorXd along(count);
  double longest = 0;
  const auto step = [&](Eigen::Index k) {
    return (positions.row(rim[k]) - positions.row(rim[(k + 1) % count])).stableNorm();
  };
  for (Eigen::Index k = 0; k < count; ++k) longest = std::max(longest, step(k));
  double sum = 0;
  for (Eigen::Index k = 0; k < count; ++k) {
    along[k] = sum;
    sum += longest > 0 ? step(k) / longest : 1;
  }
  Eigen::MatrixX2d circle(count, 2);
  for (Eigen::Index k = 0; k < count; ++k) {
    const double angle = 2 * std::numbers::pi * along[k] / sum;
    circle.row(k) << std::cos(angle), std::sin(angle);
  }
  return circle;
}

Eigen::MatrixX2d harmonicMap(const Laplacian& laplacian, const std::vector<Chart>& charts,
                             const ParameterizationOptions& options, ParameterizationReport& report) {
  const bool is_mean_value = options.weights == HarmonicWeights::mean_value;
  if (is_mean_value && charts.size() > 1)
    refuse(parameterization_name, "the surface has " + std::to_string(charts.size()) + " parts, must be one");
  const std::vector<int> rim = options.rim.empty() ? rimOfDisk(charts) : givenRim(laplacian, options);
  const Eigen::MatrixX2d values =
      options.rim_positions.rows() > 0 ? options.rim_positions : onCircle(laplacian.positions, rim);
  if (!is_mean_value) {
    SolveReport solved;
    Eigen::MatrixX2d uv = harmonic(laplacian, {rim, values}, options.solver, &solved);
    report.iterations = solved.iterations;
    report.residual = solved.residual;
    report.solver_method = solved.method;
    return uv;
  }
  Eigen::MatrixX2d uv = Eigen::MatrixX2d::Constant(std::ssize(laplacian.status), 2, std::nan(""));
  std::vector<std::uint8_t> is_pinned(laplacian.status.size(), 0), is_named(laplacian.status.size(), 0);
  for (std::size_t k = 0; k < rim.size(); ++k) {
    uv.row(rim[k]) = values.row(static_cast<Eigen::Index>(k));
    is_pinned[rim[k]] = 1;
  }
  for (const auto& corners : charts.front().triangles)
    for (const int i : corners) is_named[i] = 1;
  for (const int i : rim)
    if (is_named[i] == 0)
      refuse(parameterization_name, "point " + std::to_string(i) + " of rim lies on no triangle, must lie on one");
  mapByMeanValues(parameterization_name, laplacian.positions, charts.front(), is_pinned, options.solver, uv, report);
  return uv;
}

}  // namespace

Eigen::MatrixX2d parameterize(const Laplacian& laplacian, const TrianglesRef& triangles,
                              const ParameterizationOptions& options, ParameterizationReport* report) {
  const Stopwatch watch;
  checkArguments(laplacian, options);
  Workers(options.solver.threads, options.solver.progress).report("charts", 0);
  ParameterizationReport made;
  const std::vector<Chart> charts = findCharts(parameterization_name, laplacian, triangles, &made.cut);
  std::vector<const Chart*> mapped = mappableCharts(charts, made);
  std::vector<int> owner(laplacian.status.size(), -1);
  Eigen::MatrixX2d uv;
  if (options.method == ParameterizationMethod::conformal) {
    uv = conformal(laplacian, mapped, options, owner, made);
  } else {
    uv = harmonicMap(laplacian, charts, options, made);
    for (std::size_t i = 0; i < owner.size(); ++i)
      if (uv.row(static_cast<Eigen::Index>(i)).allFinite()) owner[i] = 0;
  }
  made.charts = std::ssize(mapped);
  for (const Chart* chart : mapped) made.rims += std::ssize(chart->rims);
  if (options.method == ParameterizationMethod::harmonic)
    mapped.resize(1);  // (u, v) is measured on the largest chart only
  measureMaps(laplacian.positions, mapped, owner, uv, made);
  copyToCoincident(laplacian, uv);
  made.not_mapped = uv.col(0).array().isNaN().count();
  made.seconds = watch.seconds();
  if (report != nullptr) *report = std::move(made);
  return uv;
}

}  // namespace tufted
