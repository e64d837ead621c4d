#include "subcommand.h"
#include "tufted/weights.h"

namespace {

struct Weights : Subcommand {
  explicit Weights(CLI::App& app)
      : Subcommand(app, "weights", "Compute bounded biharmonic weights of handles, for skinning and blending.",
                   R"(Example:
  tufted weights mesh.off --handles points.txt --out weights

--handles is a text file. Each line INDEX is a handle of one point; lines INDEX HANDLE with the same HANDLE (0, 1, ...)
form one handle. The weight of a handle is 1 at its points, 0 at the points of other handles, between 0 and 1 elsewhere,
and bends least. The weights of each point sum to 1.

Files in DIR, which replace older ones when all are complete:
  weights.npy  N x H for H handles, float64; NaN on components without a handle, and at points that take no part
  points.ply   the points with the fields weights, float32; points.pcd with --format pcd
  report.json  handles, systems solved, residual of the optimality conditions (Karush-Kuhn-Tucker), local maxima,
               seconds)") {
    addText(command, "--handles TEXT", file, "Text file of the points of the handles, lines INDEX or INDEX HANDLE")
        ->required();
  }

  /// The number of the handle in a row, counted from 0.
  static int handleOf(const Row& row) {
    const double number = row.numbers[1];
    if (!(number >= 0 && number < std::numeric_limits<int>::max() && number == std::floor(number)))
      throw tufted::IoError(row.name + ": the handle is no number counted from 0");
    return static_cast<int>(number);
  }

  void check(const Operator& source) override {
    std::map<int, std::vector<int>> points;  // points of each handle
    int count = 0;
    std::size_t width = 0;
    for (const Row& row : readRows(file)) {
      if (width == 0) width = row.numbers.size();
      if (row.numbers.size() != width || width > 2)
        throw tufted::IoError(row.name + ": is not " + (width == 1 ? "INDEX, as the first line" : "INDEX HANDLE"));
      const int handle = width == 2 ? handleOf(row) : count;
      points[handle].push_back(indexOf({row.name, {row.numbers[0]}}, source));
      ++count;
    }
    if (count == 0) throw tufted::IoError(file.string() + ": names no point, must name one");
    for (const auto& [handle, members] : points) {
      if (handle != std::ssize(handles))
        throw tufted::IoError(file.string() + ": has no handle " + std::to_string(handles.size()) + ", but handle " +
                              std::to_string(handle));
      handles.push_back(members);
    }
    shown = {{"weights", std::ssize(handles)}};
  }

  Results compute(Operator& source) override {
    Results results;
    std::vector<int> points;
    for (const std::vector<int>& handle : handles) points.insert(points.end(), handle.begin(), handle.end());
    noteLeftOut(points, source, results);
    options.solver = source.solverOptions();
    tufted::WeightReport made;
    const Eigen::MatrixXd weights = blameSurface(
        source, [&] { return tufted::boundedBiharmonicWeights(source.laplacian, handles, options, &made); });
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

  std::filesystem::path file;
  tufted::WeightOptions options;
  std::vector<std::vector<int>> handles;

  std::vector<std::string> files() const override { return {"weights.npy"}; }
};

}  // namespace

void addWeights(CLI::App& app, Run& run) {
  addSubcommand<Weights>(app, run);
}
