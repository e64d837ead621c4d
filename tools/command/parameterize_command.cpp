#include "subcommand.h"
#include "tufted/parameterization.h"

namespace {

using tufted::HarmonicWeights;
using tufted::ParameterizationMethod;

struct Parameterize : Subcommand {
  explicit Parameterize(CLI::App& app)
      : Subcommand(app, "parameterize", "Map the surface to the plane: two coordinates for each point.", R"(Examples:
  tufted parameterize open.off --out map
  tufted parameterize open.off --method harmonic --weights mean-value --out disc
  tufted parameterize mesh.off --cut seam.txt --out opened

  conformal  keeps angles as well as possible and leaves the rim free. The surface may have several rims and parts. The
             parts lie beside each other, each with the area that it has on the surface.
  harmonic   places the rim on a circle of radius 1, or where --rim puts it, and makes every other point a mean of its
             neighbours, with the weights of L or with mean-value weights, which flip no triangle. The surface must be a
             disk unless --rim is given.
The triangles of a cloud are those of `tufted laplacian --format triangles`. Closed and one-sided surfaces are refused,
and so are conformal maps of tubes so long that triangles collapse: cut such surfaces open, tubes along their length.
--rim is a text file of the points of the rim in order, in lines INDEX or INDEX U V. --cut is a text file of paths along
edges, a line of indices for each, which together open the surface to a disk.

Files in DIR, which replace older ones when all are complete:
  uv.npy         N x 2, float64; NaN at points that take no part and in parts that cannot be mapped
  corner_uv.npy  with --cut: F x 6, float64, u and v of the three corners of each triangle, as points on a cut have
                 several places, of which uv.npy has one
  points.ply     the points with the field uv, float32; points.pcd with --format pcd
  report.json    method, charts, rims, flipped and collapsed triangles, quasi_conformal_error (1 where all angles are
                 kept), residual, seconds)",
                   R"(--format npz,ply,cover --out DIR` wrote: clouds
need the cover, and meshes only their triangles in points.ply.)") {
    cover = CoverUse::clouds;
    addChoice(command, "--method", options.method, methods,
              "conformal: keeps angles, free rim; harmonic: rim on a circle or as in --rim (conformal)");
    addChoice(command, "--weights", options.weights, weights,
              "With --method harmonic: weights of L, or mean-value weights, which flip no triangle (laplacian)");
    CLI::Option* const rim_option =
        addText(command, "--rim TEXT", rim,
                "With --method harmonic: text file of the points of the rim in order, lines INDEX or INDEX U V");
    addText(command, "--cut TEXT", cut, "Text file of paths along edges to cut, a line of indices for each")
        ->excludes(rim_option);
  }

  static inline const std::map<std::string, ParameterizationMethod> methods = {
      {"conformal", ParameterizationMethod::conformal}, {"harmonic", ParameterizationMethod::harmonic}};
  static inline const std::map<std::string, HarmonicWeights> weights = {{"laplacian", HarmonicWeights::laplacian},
                                                                        {"mean-value", HarmonicWeights::mean_value}};

  void check(const Operator& source) override {
    checkPositions(source);
    const bool is_harmonic = options.method == ParameterizationMethod::harmonic;
    if (!is_harmonic && options.weights != HarmonicWeights::laplacian)
      throw tufted::InvalidInput("--weights needs --method harmonic");
    cuts.clear();
    if (!cut.empty()) {
      if (is_harmonic && options.weights == HarmonicWeights::laplacian)
        throw tufted::InvalidInput("--cut with --method harmonic needs --weights mean-value, as L has no cuts");
      for (const Row& row : readRows(cut)) {
        std::vector<int>& path = cuts.emplace_back();
        for (const double number : row.numbers) path.push_back(placeOf({number}, source, row.name).index);
        if (path.size() < 2) throw tufted::IoError(row.name + ": has 1 index, must have at least 2");
      }
    }
    if (rim.empty()) return;
    if (!is_harmonic) throw tufted::InvalidInput("--rim needs --method harmonic");
    options.rim.clear();
    std::vector<double> values;
    for (const Row& row : readRows(rim)) {
      const std::size_t count = row.numbers.size();
      if (count != 1 && count != 3) throw tufted::IoError(row.name + ": is not INDEX or INDEX U V");
      options.rim.push_back(indexOf({row.name, {row.numbers[0]}}, source));
      values.insert(values.end(), row.numbers.begin() + 1, row.numbers.end());
      if (!values.empty() && values.size() != 2 * options.rim.size())
        throw tufted::IoError(row.name + ": has " + std::to_string(count) + " numbers, must have as many as the first");
    }
    if (options.rim.size() < 3)
      throw tufted::IoError(rim.string() + ": has " + std::to_string(options.rim.size()) +
                            " points, must have at least 3");
    options.rim_positions.resize(static_cast<Eigen::Index>(values.size() / 2), 2);
    for (Eigen::Index k = 0; k < options.rim_positions.size(); ++k) options.rim_positions(k / 2, k % 2) = values[k];
    if (!options.rim_positions.allFinite()) throw tufted::IoError(rim.string() + ": a position is not finite, must be");
  }

  Results compute(Operator& source) override {
    Results results;
    options.solver = source.solverOptions();
    const tufted::Triangles triangles = trianglesOf(source);
    tufted::ParameterizationReport made;
    Eigen::MatrixX2d uv, corners;
    blameSurface(source, [&] {
      if (cut.empty())
        uv = tufted::parameterize(source.laplacian, triangles, options, &made);
      else
        corners = tufted::parameterizeCut(source.laplacian, triangles, cuts, options, &made);
    });
    if (!cut.empty()) {
      uv.setConstant(source.points(), 2, std::numeric_limits<double>::quiet_NaN());
      for (Eigen::Index c = 0; c < corners.rows(); ++c)
        if (corners.row(c).allFinite()) uv.row(triangles(c / 3, c % 3)) = corners.row(c);
      for (Eigen::Index i = 0; i < uv.rows(); ++i) uv.row(i) = uv.row(source.laplacian.representative[i]).eval();
    }
    const bool is_harmonic = options.method == ParameterizationMethod::harmonic;
    const char* const method = !is_harmonic                                     ? "conformal"
                               : options.weights == HarmonicWeights::mean_value ? "harmonic, mean values"
                                                                                : "harmonic";
    results.report["report"] = {{"method", method},
                                {"charts", made.charts},
                                {"closed", made.closed},
                                {"nonorientable", made.nonorientable},
                                {"collapsed_charts", made.collapsed_charts},
                                {"cut", made.cut},
                                {"nonmanifold", made.nonmanifold},
                                {"rims", made.rims},
                                {"shared_points", made.shared_points},
                                {"not_mapped", made.not_mapped},
                                {"triangles", made.triangles},
                                {"flipped", made.flipped},
                                {"collapsed", made.collapsed},
                                {"quasi_conformal_error", made.quasi_conformal_error},
                                {"iterations", made.iterations},
                                {"residual", made.residual},
                                {"solver", made.solver_method},
                                {"seconds", made.seconds}};
    results.summary.add("charts", "%lld, with %lld rims", static_cast<long long>(made.charts),
                        static_cast<long long>(made.rims));
    results.summary.add("triangles", "%lld, %lld flipped, %lld collapsed", static_cast<long long>(made.triangles),
                        static_cast<long long>(made.flipped), static_cast<long long>(made.collapsed));
    results.summary.add("angles", "quasi-conformal error %.4f, 1 where they are kept", made.quasi_conformal_error);
    results.summary.add("not mapped", "%lld points, which are NaN", static_cast<long long>(made.not_mapped));
    if (made.collapsed > 0)
      results.warnings.push_back(std::to_string(made.collapsed) +
                                 " triangles are lower in the plane than 1e-7 of the map");
    if (made.collapsed_charts > 0)
      results.warnings.push_back(std::to_string(made.collapsed_charts) +
                                 " parts are too long for their rims and are not mapped; cut them open");
    results.arrays = {{.name = "uv", .values = uv}};
    if (!cut.empty()) {
      Eigen::MatrixXd table(triangles.rows(), 6);
      for (Eigen::Index c = 0; c < corners.rows(); ++c) table.row(c / 3).segment<2>(2 * (c % 3)) = corners.row(c);
      results.arrays.push_back({.name = "corner_uv", .values = std::move(table), .per_point = false});
    }
    return results;
  }

  std::filesystem::path rim, cut;
  std::vector<std::vector<int>> cuts;
  tufted::ParameterizationOptions options;

  std::vector<std::string> files() const override {
    return cut.empty() ? std::vector<std::string>{"uv.npy"} : std::vector<std::string>{"uv.npy", "corner_uv.npy"};
  }
};

}  // namespace

void addParameterize(CLI::App& app, Run& run) {
  addSubcommand<Parameterize>(app, run);
}
