#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "operator.h"
#include "options.h"
#include "oriented.h"
#include "point_options.h"
#include "taking_part.h"
#include "tufted/errors.h"
#include "tufted/segments.h"

namespace segment_command {
namespace {

constexpr const char* description =
    "Cut the surface into segments: things on a table, cells around seeds, or parts between narrow necks.";

constexpr const char* footer =
    R"(Example:
  tufted segment scan.ply --count 6 --out segments

  voronoi   each point belongs to the seed that is nearest along the surface. Seeds are --seeds, or K points, each as
            far as possible from those before it. Connected components that are small compared with the cells have no
            seed.
  spectral  points are clustered by k-means on the first K eigenvectors, which separates connected components first,
            then parts that are joined by narrow necks
  parts     the surface is cut along concave creases, as where things stand on a table or touch; there are as many
            parts as it has. Which side is hollow is seen from the sensor or, where its position is not known (see
            --viewpoint), from outside. --crease is smaller for more parts

Files in DIR, which replace older ones when all are complete:
  labels.npy   N labels, int32, 0 for the segment of the largest area; -1 at points that take no part and in connected
               components without a segment
  points.ply   the points with the field labels, float32; points.pcd with --format pcd
  report.json  method, seeds, the area of each segment in length^2, seconds
`tufted help laplacian` explains FILE and the options of building. --operator DIR reads L and M that
`tufted laplacian --format npz,ply,cover --out DIR` wrote: cells need
the triangles of the cover, other methods do without.)";

const std::map<std::string, tufted::SegmentMethod> methods = {{"voronoi", tufted::SegmentMethod::voronoi},
                                                              {"spectral", tufted::SegmentMethod::spectral},
                                                              {"parts", tufted::SegmentMethod::parts}};

std::string nameOf(tufted::SegmentMethod method) {
  return std::find_if(methods.begin(), methods.end(), [&](const auto& m) { return m.second == method; })->first;
}

struct Settings {
  OperatorSettings source;
  std::string seeds;
  tufted::SegmentOptions options;
  Orienting orienting;

  std::vector<std::string> files() const { return {"labels.npy"}; }
};

void check(Settings& settings, const Operator& source) {
  tufted::SegmentOptions& options = settings.options;
  if (options.method == tufted::SegmentMethod::parts) checkFrames(source);
  checkPositions(source);
  if (options.method == tufted::SegmentMethod::parts && options.count)
    throw tufted::InvalidInput("--count excludes --method parts, which finds as many as there are");
  if (settings.seeds.empty()) return;
  if (options.method != tufted::SegmentMethod::voronoi)
    throw tufted::InvalidInput("--seeds excludes --method " + nameOf(options.method));
  options.seeds.clear();
  for (const double index : parseNumbers(settings.seeds, "--seeds"))
    options.seeds.push_back(placeOf({index}, source, "--seeds " + settings.seeds).index);
}

Results compute(Settings& settings, Operator& source) {
  Results results;
  settings.options.solver = source.solverOptions();
  const std::optional<int>& count = settings.options.count;
  const auto compute = [&] {
    requireTakingPart(settings.options.seeds, source);
    if (settings.options.method != tufted::SegmentMethod::parts)
      return tufted::segments(source.laplacian, settings.options);
    return tufted::segments(source.laplacian, orientedFrames(settings.orienting, source, results), settings.options);
  };
  const tufted::Segments found = !settings.seeds.empty() ? forOption("--seeds " + settings.seeds, compute)
                                 : count                 ? forOption("--count " + std::to_string(*count), compute)
                                                         : compute();
  const long long without = std::count(found.labels.begin(), found.labels.end(), -1);
  results.report["report"] = {{"method", nameOf(settings.options.method)},
                              {"seeds", found.seeds},
                              {"areas", std::vector<double>(found.areas.begin(), found.areas.end())},
                              {"without_label", without},
                              {"seconds", found.seconds}};
  results.summary.add("segments", "%lld, areas from %.6g to %.6g", static_cast<long long>(found.areas.size()),
                      found.areas[found.areas.size() - 1], found.areas[0]);
  results.summary.add("without label", "%lld points", without);
  results.arrays = {{.name = "labels", .values = columnOf(found.labels), .is_integer = true}};
  return results;
}

}  // namespace
}  // namespace segment_command

void addSegment(CLI::App& app, Run& run) {
  using namespace segment_command;
  const auto [command, settings] =
      addOperatorCommand<Settings>(app, run, "segment", description, footer, compute, check);
  settings->source.cover = CoverUse::all;
  CLI::Option* const count = addNumber(*command, "--count", settings->options.count, 1, std::numeric_limits<int>::max(),
                                       "Number of segments (8, or as many as possible if fewer)")
                                 ->type_name("K");
  command
      ->add_option("--seeds", settings->seeds,
                   "Indices of the points whose cells are the segments, counted from 0 (K points far apart)")
      ->check(notEmpty)
      ->excludes(count)
      ->type_name("I,J,...");
  addChoice(
      *command, "--method", settings->options.method, methods,
      "voronoi: cells around seeds; spectral: parts that narrow necks join; parts: between concave creases (voronoi)")
      ->each([settings = settings.get()](const std::string& method) {
        settings->source.cover = method == "voronoi" ? CoverUse::all : CoverUse::none;
      });
  addNumber(*command, "--crease", settings->options.crease, std::numeric_limits<double>::min(),
            std::numeric_limits<double>::max(),
            "parts: a crease is where the normal turns inwards by more than RAD over one spacing (0.08)")
      ->type_name("RAD");
  addNumber(*command, "--least-points", settings->options.least_points, 1, std::numeric_limits<int>::max(),
            "parts: smaller sets of points go to the parts around them (100)")
      ->type_name("N");
  addOrienting(*command, settings->orienting);
}
