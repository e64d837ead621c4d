#include "component_options.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "operator.h"
#include "options.h"
#include "point_options.h"
#include "tufted/components.h"
#include "tufted/errors.h"

namespace {

/// The option that chooses components, as the user gave it.
std::string nameOf(const ComponentOptions& options) {
  return options.chosen.empty() ? "--min-component " + std::to_string(options.min_points)
                                : "--component " + options.chosen;
}

/// The labels of the chosen components.
/// @param sizes number of points of each component
std::vector<int> chosenOf(const ComponentOptions& options, const std::vector<std::int64_t>& sizes,
                          const Operator& source) {
  const std::string name = nameOf(options);
  const std::string rest = ": " + source.name + " has " + countText(std::ssize(sizes), "component");
  std::vector<int> chosen;
  if (options.chosen.empty()) {
    for (std::size_t c = 0; c < sizes.size() && sizes[c] >= options.min_points; ++c)
      chosen.push_back(static_cast<int>(c));
    if (chosen.empty())
      throw tufted::InvalidInput(name + rest +
                                 (sizes.empty() ? "" : ", the largest of " + std::to_string(sizes[0]) + " points"));
    return chosen;
  }
  if (options.chosen == "largest") return {0};
  for (const double label : parseNumbers(options.chosen, "--component")) {
    if (label != std::floor(label) || !(label >= 0 && label < static_cast<double>(sizes.size())))
      throw tufted::InvalidInput(name + rest + ", counted from 0");
    chosen.push_back(static_cast<int>(label));
  }
  return chosen;
}

}  // namespace

void addComponentOptions(CLI::App& command, ComponentOptions& options) {
  CLI::Option* const chosen = addText(command, "--component largest|I,J,...", options.chosen,
                                      "Use only these connected components; component 0 has the most points (all)");
  addNumber(command, "--min-component N", options.min_points, 1, std::numeric_limits<int>::max(),
            "Use only connected components of at least N points (1)")
      ->excludes(chosen);
}

void chooseComponents(const ComponentOptions& options, Operator& source, Results& results) {
  if (options.chosen.empty() && options.min_points <= 1) return;
  std::vector<int> labels = tufted::componentLabels(source.laplacian);
  const std::vector<std::int64_t> sizes = tufted::componentSizes(labels);
  if (sizes.empty()) return;  // no point is active; nothingActive() explains it
  const std::vector<int> chosen = chosenOf(options, sizes, source);
  std::int64_t all = 0, points = 0;
  for (const std::int64_t size : sizes) all += size;
  source.all_components = std::move(labels);
  source.chosen_by = nameOf(options);
  source.laplacian = tufted::restrictedTo(source.laplacian, chosen);
  for (const std::int64_t size : tufted::componentSizes(source.laplacian.component)) points += size;
  results.report["components"] = {
      {"of", sizes.size()}, {"taken", source.laplacian.report.components}, {"points", points}};
  results.summary.add("components", "%lld of %zu, %lld points (%.3g %%)",
                      static_cast<long long>(source.laplacian.report.components), sizes.size(),
                      static_cast<long long>(points), 100.0 * static_cast<double>(points) / static_cast<double>(all));
}
