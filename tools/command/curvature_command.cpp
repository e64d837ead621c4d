#include "subcommand.h"
#include "tufted/curvature.h"

namespace {

struct Curvature : Subcommand {
  explicit Curvature(CLI::App& app)
      : Subcommand(app, "curvature", "Compute mean, Gaussian and principal curvatures, and the principal directions.",
                   R"(Example:
  tufted curvature scan.ply --out curvature

  fit        a quadratic surface is fitted to the neighbours of each point, in a window that grows with the noise
  laplacian  mean curvature only, from L x = 2 H n M. It does not converge on random points: on a torus the mean
             error stays at 7 % of the largest curvature, however many points there are.
Curvature is positive where the surface bends away from the normal: a sphere of radius r whose normals point outwards
has curvature 1/r. Normals are those of `tufted normals`.

Files in DIR, which replace older ones when all are complete:
  curvature.npy             N x 4, float64: mean H, Gaussian K, and principal k1 >= k2, in 1 / length (K in 1 /
                            length^2); with --method laplacian N values of H; 0 at points that take no part
  principal_directions.npy  N x 6: unit vectors in the directions of k1 and of k2; not with --method laplacian
  points.ply                the points with the fields curvature_0 to curvature_3, float32, and the normals; points.pcd
                            with --format pcd
  report.json               method, orientation, number of points without a fit and of points that take no part, rings
                            of neighbours in the fits, seconds)") {
    addOrienting(command, orienting);
    addChoice(command, "--method", options.method, methods,
              "fit: a quadratic surface at each point; laplacian: mean curvature only, less accurate (fit)");
    addNumber(command, "--rings", options.rings, 1, 100,
              "Rings of neighbours in each fit (two, and more where noise was removed)");
  }

  static inline const std::map<std::string, tufted::CurvatureMethod> methods = {
      {"fit", tufted::CurvatureMethod::fit}, {"laplacian", tufted::CurvatureMethod::laplacian}};

  void check(const Operator& source) override {
    shown = {{"curvature", fits() ? 4 : 1}};
    if (options.rings > 0 && !fits()) throw tufted::InvalidInput("--rings applies to --method fit");
    checkFrames(source);
  }

  /// Adds the range of mean curvature, without points that take no part or whose curvature is undetermined.
  void addRange(const tufted::Curvatures& found, const tufted::Laplacian& laplacian, Results& results) const {
    std::int64_t left_out = 0;
    double least = std::numeric_limits<double>::infinity();
    double greatest = -least;
    for (Eigen::Index i = 0; i < found.mean.size(); ++i) {
      const int active = laplacian.representative[static_cast<std::size_t>(i)];
      if (laplacian.status[static_cast<std::size_t>(active)] != tufted::PointStatus::active) {
        ++left_out;
        continue;
      }
      if (fits() ? found.first.row(i).isZero(0) : !(laplacian.M[active] > 0)) continue;
      least = std::min(least, found.mean[i]);
      greatest = std::max(greatest, found.mean[i]);
    }
    results.report["report"]["left_out"] = left_out;
    const std::string without = left_out > 0 ? ", without " + countText(left_out, "point") +
                                                   (left_out == 1 ? " that takes no part" : " that take no part")
                                             : "";
    if (least <= greatest)
      results.summary.add("mean curvature", "%.6g to %.6g, 1 / length%s", least, greatest, without.c_str());
  }

  Results compute(Operator& source) override {
    Results results;
    source.laplacian.frames = orientedFrames(orienting, source, results);
    source.geometry.normals = {};  // copies get the normals of the signs, not those of the file
    options.threads = source.threads;
    options.progress = source.progress;
    const tufted::Curvatures found = tufted::curvatures(source.laplacian, options);
    Eigen::MatrixXd values(found.mean.size(), fits() ? 4 : 1);
    values.col(0) = found.mean;
    if (fits()) {
      values.col(1) = found.gaussian;
      values.rightCols(2) = found.principal;
    }
    results.arrays = {{.name = "curvature", .values = values}};
    if (fits()) {
      Eigen::MatrixXd directions(found.mean.size(), 6);
      directions << found.first, found.second;
      results.arrays.push_back({.name = "principal_directions", .values = directions, .per_point = false});
      results.summary.addDetail("windows", "%.1f rings of neighbours on average", found.report.mean_rings);
      if (found.report.undetermined > 0)
        results.summary.add("undetermined", "%lld points, whose neighbours lie on a line or a conic",
                            static_cast<long long>(found.report.undetermined));
    }
    results.report["report"] = {{"method", fits() ? "fit" : "laplacian"},
                                {"undetermined", found.report.undetermined},
                                {"mean_rings", found.report.mean_rings},
                                {"seconds", found.report.seconds}};
    addRange(found, source.laplacian, results);
    return results;
  }

  Orienting orienting;
  tufted::CurvatureOptions options;

  bool fits() const { return options.method == tufted::CurvatureMethod::fit; }
  std::vector<std::string> files() const override {
    return fits() ? std::vector<std::string>{"curvature.npy", "principal_directions.npy"}
                  : std::vector<std::string>{"curvature.npy"};
  }
};

}  // namespace

void addCurvature(CLI::App& app, Run& run) {
  addSubcommand<Curvature>(app, run);
}
