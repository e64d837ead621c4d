#include "subcommand.h"
#include "tufted/segments.h"

namespace {

struct Segment : Subcommand {
  explicit Segment(CLI::App& app)
      : Subcommand(
            app, "segment",
            "Cut the surface into segments: things on a table, cells around seeds, or parts between narrow necks.",
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
  report.json  method, seeds, the area of each segment in length^2, seconds)",
            R"(--format npz,ply,cover --out DIR` wrote: cells need
the triangles of the cover, other methods do without.)") {
    cover = CoverUse::all;
    CLI::Option* const count = addNumber(command, "--count K", options.count, 1, std::numeric_limits<int>::max(),
                                         "Number of segments (8, or as many as possible if fewer)");
    addText(command, "--seeds I,J,...", seeds,
            "Indices of the points whose cells are the segments, counted from 0 (K points far apart)")
        ->excludes(count);
    addChoice(
        command, "--method", options.method, methods,
        "voronoi: cells around seeds; spectral: parts that narrow necks join; parts: between concave creases (voronoi)")
        ->each([this](const std::string& method) { cover = method == "voronoi" ? CoverUse::all : CoverUse::none; });
    addNumber(command, "--crease RAD", options.crease, std::numeric_limits<double>::min(),
              std::numeric_limits<double>::max(),
              "parts: a crease is where the normal turns inwards by more than RAD over one spacing (0.08)");
    addNumber(command, "--least-points N", options.least_points, 1, std::numeric_limits<int>::max(),
              "parts: smaller sets of points go to the parts around them (100)");
    addOrienting(command, orienting);
  }

  static inline const std::map<std::string, tufted::SegmentMethod> methods = {
      {"voronoi", tufted::SegmentMethod::voronoi},
      {"spectral", tufted::SegmentMethod::spectral},
      {"parts", tufted::SegmentMethod::parts}};

  static std::string nameOf(tufted::SegmentMethod method) {
    return std::find_if(methods.begin(), methods.end(), [&](const auto& m) { return m.second == method; })->first;
  }

  void check(const Operator& source) override {
    if (options.method == tufted::SegmentMethod::parts) checkFrames(source);
    checkPositions(source);
    if (options.method == tufted::SegmentMethod::parts && options.count)
      throw tufted::InvalidInput("--count excludes --method parts, which finds as many as there are");
    if (seeds.empty()) return;
    if (options.method != tufted::SegmentMethod::voronoi)
      throw tufted::InvalidInput("--seeds excludes --method " + nameOf(options.method));
    options.seeds.clear();
    for (const double index : parseNumbers(seeds, "--seeds"))
      options.seeds.push_back(placeOf({index}, source, "--seeds " + seeds).index);
  }

  Results compute(Operator& source) override {
    Results results;
    options.solver = source.solverOptions();
    const std::optional<int>& count = options.count;
    const auto compute = [&] {
      requireTakingPart(options.seeds, source);
      if (options.method != tufted::SegmentMethod::parts) return tufted::segments(source.laplacian, options);
      return tufted::segments(source.laplacian, orientedFrames(orienting, source, results), options);
    };
    const tufted::Segments found = !seeds.empty() ? forOption("--seeds " + seeds, compute)
                                   : count        ? forOption("--count " + std::to_string(*count), compute)
                                                  : compute();
    const long long without = std::count(found.labels.begin(), found.labels.end(), -1);
    results.report["report"] = {{"method", nameOf(options.method)},
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

  std::string seeds;
  tufted::SegmentOptions options;
  Orienting orienting;

  std::vector<std::string> files() const override { return {"labels.npy"}; }
};

}  // namespace

void addSegment(CLI::App& app, Run& run) {
  addSubcommand<Segment>(app, run);
}
