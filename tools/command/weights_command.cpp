#include <CLI/CLI.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "command.h"
#include "moved_points.h"
#include "operator.h"
#include "options.h"
#include "point_options.h"
#include "taking_part.h"
#include "tufted/errors.h"
#include "tufted/weights.h"

namespace weights_command {
namespace {

constexpr const char* description = "Compute bounded biharmonic weights of handles, for skinning and blending.";

constexpr const char* footer =
    R"(Example:
  tufted weights mesh.off --handles points.txt --out weights

--handles is a text file. Each line INDEX is a handle of one point; lines INDEX HANDLE with the same HANDLE (0, 1, ...)
form one handle. The weight of a handle is 1 at its points, 0 at the points of other handles, between 0 and 1 elsewhere,
and bends least. The weights of each point sum to 1.

Files in DIR, which replace older ones when all are complete:
  weights.npy  N x H for H handles, float64; NaN on components without a handle, and at points that take no part
  points.ply   the points with the fields weights, float32; points.pcd with --format pcd
  report.json  handles, systems solved, residual of the optimality conditions (Karush-Kuhn-Tucker), local maxima,
               seconds
`tufted help laplacian` explains FILE and the options of building. --operator DIR reads L and M that
`tufted laplacian --out DIR` wrote.)";

struct Settings {
  OperatorSettings source;
  std::filesystem::path file;
  tufted::WeightOptions options;
  std::vector<std::vector<int>> handles;

  std::vector<std::string> files() const { return {"weights.npy"}; }
};

/// The number of the handle in a row, counted from 0.
int handleOf(const Row& row) {
  const double number = row.numbers[1];
  if (!(number >= 0 && number < std::numeric_limits<int>::max() && number == std::floor(number)))
    throw tufted::IoError(row.name + ": the handle is no number counted from 0");
  return static_cast<int>(number);
}

void check(Settings& settings, const Operator& source) {
  std::map<int, std::vector<int>> points;  // points of each handle
  int count = 0;
  std::size_t width = 0;
  for (const Row& row : readRows(settings.file)) {
    if (width == 0) width = row.numbers.size();
    if (row.numbers.size() != width || width > 2)
      throw tufted::IoError(row.name + ": is not " + (width == 1 ? "INDEX, as the first line" : "INDEX HANDLE"));
    const int handle = width == 2 ? handleOf(row) : count;
    points[handle].push_back(indexOf({row.name, {row.numbers[0]}}, source));
    ++count;
  }
  if (count == 0) throw tufted::IoError(settings.file.string() + ": names no point, must name one");
  for (const auto& [handle, members] : points) {
    if (handle != std::ssize(settings.handles))
      throw tufted::IoError(settings.file.string() + ": has no handle " + std::to_string(settings.handles.size()) +
                            ", but handle " + std::to_string(handle));
    settings.handles.push_back(members);
  }
  settings.source.shown = {{"weights", std::ssize(settings.handles)}};
}

Results compute(Settings& settings, Operator& source) {
  Results results;
  std::vector<int> points;
  for (const std::vector<int>& handle : settings.handles) points.insert(points.end(), handle.begin(), handle.end());
  noteLeftOut(points, source, results);
  settings.options.solver = source.solverOptions();
  tufted::WeightReport made;
  const Eigen::MatrixXd weights = blameSurface(source, [&] {
    return tufted::boundedBiharmonicWeights(source.laplacian, settings.handles, settings.options, &made);
  });
  results.report["report"] = {{"handles", made.handles},
                              {"free", made.free},
                              {"not_reached", made.not_reached},
                              {"iterations", made.iterations},
                              {"residual", made.residual},
                              {"local_maxima", made.local_maxima},
                              {"greatest_sum_error", made.greatest_sum_error},
                              {"seconds", made.seconds}};
  results.summary.add("handles", "%lld, at most %d systems each, residual %.2g", static_cast<long long>(made.handles),
                      made.iterations, made.residual);
  results.summary.add("local maxima", "%lld away from handles", static_cast<long long>(made.local_maxima));
  results.summary.add("not reached", "%lld points, which are NaN", static_cast<long long>(made.not_reached));
  results.arrays = {{.name = "weights", .values = weights}};
  return results;
}

}  // namespace
}  // namespace weights_command

void addWeights(CLI::App& app, Run& run) {
  using namespace weights_command;
  const auto [command, settings] =
      addOperatorCommand<Settings>(app, run, "weights", description, footer, compute, check);
  command
      ->add_option("--handles", settings->file, "Text file of the points of the handles, lines INDEX or INDEX HANDLE")
      ->check(notEmpty)
      ->required()
      ->type_name("TEXT");
}
