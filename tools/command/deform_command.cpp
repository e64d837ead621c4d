#include "subcommand.h"
#include "tufted/deformation.h"

namespace {

using tufted::DeformationMethod;

struct Deform : Subcommand {
  explicit Deform(CLI::App& app)
      : Subcommand(app, "deform", "Move some points to given positions and let the surface follow.", R"(Examples:
  tufted deform mesh.off --handles handles.txt --out bent
  tufted deform scan.ply --handles handles.txt --method linear --out bent

--handles is a text file with lines INDEX X Y Z for a point that moves to this position, and INDEX for a point that
stays. A handle should be a patch of several points, because a single point pulls a spike.
  rigid   rotates neighbourhoods smoothly and hardly stretches them, by iterations (as rigid as possible)
  linear  takes two linear solves that keep the bending of the surface, and suits small rotations

Files in DIR, which replace older ones when all are complete:
  positions.npy  N x 3, float64; points of components without a handle stay, coincident points lie where their
                 representative does
  points.ply     the moved points, without normals; points.pcd with --format pcd
  report.json    method, handles, moved points, iterations, whether they converged, stretch of edges, seconds)") {
    addText(command, "--handles TEXT", handles_file,
            "Text file of points that move to X Y Z or stay, lines INDEX X Y Z or INDEX")
        ->required();
    addChoice(command, "--method", options.method, methods,
              "rigid: hardly stretches the surface; linear: two solves, for small rotations (rigid)");
    addNumber(command, "--smoothness S", options.smoothness, 0.0, 1e6,
              "With --method rigid: cost of bending, as a fraction of the area; 0: none (1e-3)");
    addNumber(command, "--iterations N", options.max_iterations, 1, 1000000,
              "With --method rigid: maximum number of iterations (500)");
    addNumber(command, "--tolerance T", options.tolerance, std::numeric_limits<double>::min(), 1.0,
              "With --method rigid: stop when no point moves more than T times the longest way of a handle (1e-3)");
  }

  static inline const std::map<std::string, DeformationMethod> methods = {
      {"rigid", DeformationMethod::as_rigid_as_possible}, {"linear", DeformationMethod::linear}};

  void check(const Operator& source) override {
    shown = {{moved_points_field}};
    checkPositions(source);
    checkHasPoints(source);
    const std::vector<Row> rows = readRows(handles_file);
    if (rows.empty()) throw tufted::IoError(handles_file.string() + ": names no point, must name one");
    targets.resize(std::ssize(rows), 3);
    for (Eigen::Index k = 0; k < std::ssize(rows); ++k) {
      const Row& row = rows[static_cast<std::size_t>(k)];
      if (row.numbers.size() != 1 && row.numbers.size() != 4)
        throw tufted::IoError(row.name + ": is not INDEX or INDEX X Y Z");
      const int point = indexOf({row.name, {row.numbers[0]}}, source);
      handles.push_back(point);
      if (row.numbers.size() == 4) {
        targets.row(k) << row.numbers[1], row.numbers[2], row.numbers[3];
      } else {
        staying.push_back(k);
        targets.row(k) = source.geometry.points.row(point);
      }
      if (!targets.row(k).allFinite()) throw tufted::IoError(row.name + ": the place is not finite, must be");
    }
  }

  Results compute(Operator& source) override {
    Results results;
    noteLeftOut(handles, source, results);
    options.solver = source.solverOptions();
    // All points start from Laplacian::positions, which for noisy points are not those of the file.
    for (const Eigen::Index k : staying)
      targets.row(k) = source.laplacian.positions.row(handles[static_cast<std::size_t>(k)]);
    tufted::DeformationReport made;
    const tufted::Points moved = forOption("--handles " + handles_file.string(), [&] {
      return tufted::deform(source.laplacian, handles, targets, options, &made);
    });
    const bool is_linear = options.method == DeformationMethod::linear;
    results.report["report"] = {{"method", is_linear ? "linear" : "rigid"},
                                {"handles", made.handles},
                                {"moved", made.moved},
                                {"floating", made.floating},
                                {"longest_way", made.longest_way},
                                {"iterations", made.iterations},
                                {"last_move", made.last_move},
                                {"converged", made.converged},
                                {"stretch", made.stretch},
                                {"seconds", made.seconds}};
    results.summary.add("handles", "%lld, the longest way %.6g", static_cast<long long>(made.handles),
                        made.longest_way);
    results.summary.add("iterations", "%d, edges stretch by %.3g of their length", made.iterations, made.stretch);
    if (made.floating > 0)
      results.warnings.push_back(std::to_string(made.floating) +
                                 " points lie on components without a handle; they stay");
    if (!made.converged)
      results.warnings.push_back("points still move by " + numberText(made.last_move) + "; --iterations was too small");
    movePoints("positions", moved, source, results);
    return results;
  }

  std::filesystem::path handles_file;
  tufted::DeformationOptions options;
  std::vector<int> handles;
  tufted::Points targets;
  std::vector<Eigen::Index> staying;  ///< which handles have no target and stay in place

  std::vector<std::string> files() const override { return {"positions.npy"}; }
};

}  // namespace

void addDeform(CLI::App& app, Run& run) {
  addSubcommand<Deform>(app, run);
}
