// Errors of eigenvalues: real shapes, noise, density, scan lines, sheets.
#include "shapes/spectra.h"

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "base/median.h"
#include "base/stage_clock.h"
#include "bench/compare/solves.h"
#include "bench/compare/tables.h"

namespace tufted::bench {
namespace {

/// A cloud and the eigenvalues of its surface, ascending with zeros.
struct Case {
  Points points, normals;
  VectorXd eigenvalues;
};
/// Cases of one column of a table.
using Column = std::vector<Case>;

/// What a rival does on some cases.
struct Result {
  Buffer<double> errors;  ///< of each case that has a spectrum
  int failed = 0, complex = 0, negative = 0;
  double seconds = 0;  ///< of all builds

  double mean() const {
    double sum = 0;
    for (const double error : errors) sum += std::log(error);
    return std::exp(sum / static_cast<double>(errors.size()));
  }
};

/// @param build makes the Laplacian of a case
template <class Build>
Result measure(const Build& build, bool is_symmetric, const Column& cases) {
  Result result;
  for (const Case& c : cases) {
    const auto zeros = static_cast<int>((c.eigenvalues.array() == 0).count());
    const Stopwatch watch;
    const Operators operators = build(c);
    result.seconds += watch.seconds();
    try {
      const Eigenvalues found = eigenvaluesOf(operators, is_symmetric, compared + zeros);
      // Real parts stand for complex eigenvalues, whose number the tables give.
      result.errors.push_back(oracles::meanRelativeError(found.values, c.eigenvalues));
      result.complex += found.complex;
      result.negative += found.negative;
    } catch (const std::runtime_error&) {
      ++result.failed;
    }
  }
  return result;
}

/// @param k number of neighbours; 0: the rival's own
Result measure(const CloudRival& rival, int k, const Column& cases) {
  return measure([&](const Case& c) { return rival.build(c.points, k > 0 ? k : rival.k); }, rival.symmetric, cases);
}

constexpr const char* ours_with_normals = "tufted, default, normals given";
Result measureWithNormals(const Column& cases) {
  const auto build = [](const Case& c) {
    CloudOptions options;
    options.normals = &c.normals;
    return tuftedLaplacian(c.points, options, options.neighbors);
  };
  return measure(build, true, cases);
}

/// "3 complex, 2 negative", of all eigenvalues compared.
std::string notReal(const Result& result) {
  std::string text;
  const auto add = [&text](int count, const char* what) {
    if (count > 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + what;
  };
  add(result.complex, "complex");
  add(result.negative, "negative");
  add(result.failed, "without spectrum");
  return text.empty() ? "none" : text;
}

Cell errorCell(const Result& result, double error) {
  if (result.errors.empty()) return "no spectrum";
  Cell cell = percent(error);
  if (error > 10) cell.text = "over 1000 %";
  return cell;
}

/// The clouds that `make` draws for each seed.
template <class Make>
Column columnOf(const Settings& settings, const Make& make) {
  Column column;
  for (int s = 0; s < settings.seeds; ++s) {
    const shapes::Cloud cloud = make(settings.first_seed + static_cast<std::uint64_t>(s));
    column.push_back({cloud.points, cloud.normals, cloud.eigenvalues});
  }
  return column;
}

/// One row per rival, one column of mean errors per number, for which make(number, seed) draws clouds.
/// @param with_normals whether there is a row of ours with the normals of the clouds
template <class Make>
Table printConditions(const Settings& settings, const char* name, const std::vector<double>& numbers, const Make& make,
                      bool with_normals = false) {
  std::vector<Column> columns;
  std::vector<std::string> names = {"Laplacian"};
  for (const double number : numbers) {
    columns.push_back(columnOf(settings, [&](std::uint64_t seed) { return make(number, seed); }));
    names.push_back(Cell(name, number).text);
  }
  names.emplace_back("not real and positive");
  Table table(names);
  const auto addRow = [&](const std::string& laplacian, const auto& measureColumn) {
    std::vector<Cell> row = {laplacian};
    Result all;
    for (const Column& column : columns) {
      const Result result = measureColumn(column);
      row.push_back(errorCell(result, result.mean()));
      all.complex += result.complex, all.negative += result.negative, all.failed += result.failed;
    }
    row.emplace_back(notReal(all));
    table.row(row);
  };
  for (const CloudRival& rival : rivalsOf(settings))
    addRow(rival.name, [&](const Column& column) { return measure(rival, settings.k, column); });
  if (with_normals) addRow(ours_with_normals, measureWithNormals);
  return table;
}

}  // namespace

Table printSpectrum(const Settings& settings) {
  const int n = settings.pointsOr(8000);
  Column real;
  for (const RealShape& shape : shapesOf(settings, compared)) {
    VectorXd eigenvalues(compared + 1);
    eigenvalues << 0, shape.eigenvalues;
    for (int s = 0; s < settings.seeds; ++s) {
      const std::uint64_t seed = settings.first_seed + static_cast<std::uint64_t>(s);
      const shapes::Cloud cloud = sampleOf(shape, n, settings.noise, seed);
      real.push_back({cloud.points, cloud.normals, eigenvalues});
    }
  }
  const auto noisy = [&](const shapes::Cloud& cloud, std::uint64_t seed) {
    const double spacing = std::sqrt(cloud.area / n);
    return settings.noise > 0 ? shapes::withNoise(cloud, settings.noise * spacing, seed + 100) : cloud;
  };
  const auto sphere = columnOf(
      settings, [&](std::uint64_t seed) { return noisy(shapes::sphere(n, shapes::Sampling::uniform, seed), seed); });
  const auto torus = columnOf(
      settings, [&](std::uint64_t seed) { return noisy(shapes::torus(n, shapes::Sampling::uniform, seed), seed); });
  Table table({"Laplacian", std::to_string(real.size()) + " real clouds, median", "worst", "sphere", "torus",
               "not real and positive", "build, s"});
  const auto addRow = [&](const std::string& laplacian, const auto& measureColumn) {
    const Result result = measureColumn(real), on_sphere = measureColumn(sphere), on_torus = measureColumn(torus);
    const auto& errors = result.errors;
    table.row({laplacian, errors.empty() ? Cell("no spectrum") : percent(medianOf(errors)),
               errors.empty() ? Cell("") : percent(*std::max_element(errors.begin(), errors.end())),
               errorCell(on_sphere, on_sphere.mean()), errorCell(on_torus, on_torus.mean()), notReal(result),
               Cell("%.2f", result.seconds / static_cast<double>(std::max<std::size_t>(real.size(), 1)))});
  };
  for (const CloudRival& rival : rivalsOf(settings))
    addRow(rival.name, [&](const Column& column) { return measure(rival, settings.k, column); });
  addRow(ours_with_normals, measureWithNormals);
  return table;
}

Table printNoise(const Settings& settings) {
  const int n = settings.pointsOr(4000);
  return printConditions(settings, "%g spacings", {0, .1, .3, .6, 1}, [n](double noise, std::uint64_t seed) {
    const shapes::Cloud torus = shapes::torus(n, shapes::Sampling::uniform, seed);
    return noise > 0 ? shapes::withNoise(torus, noise * std::sqrt(torus.area / n), seed + 100) : torus;
  });
}

Table printDensity(const Settings& settings) {
  const int n = settings.pointsOr(4000);
  return printConditions(settings, "density 1 to %g", {1, 4, 16, 100}, [n](double ratio, std::uint64_t seed) {
    return shapes::torus(n, shapes::Sampling::densityStep(ratio), seed);
  });
}

Table printLines(const Settings& settings) {
  const int n = settings.pointsOr(4000);
  return printConditions(
      settings, "lines %g times as far apart", {1, 3, 10, 30},
      [n](double ratio, std::uint64_t seed) { return shapes::torus(n, shapes::Sampling::scanLines(ratio), seed); });
}

Table printSheets(const Settings& settings) {
  const int n = settings.pointsOr(4000);
  return printConditions(
      settings, "%g spacings apart", {0.5, 1, 2, 4, 8},
      [n](double spacings, std::uint64_t seed) {
        shapes::Cloud sheets = shapes::twoSheets(n, spacings * std::sqrt(2.0 / n), seed);
        for (int i = 0; i < n; ++i) sheets.normals(i, 2) = sheets.labels[i] == 0 ? -1 : 1;  // of a thin plate
        return sheets;
      },
      true);
}

}  // namespace tufted::bench
