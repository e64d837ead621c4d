#include "subcommand.h"
#include "tufted/shape_maps.h"

namespace {

struct Map : Subcommand {
  explicit Map(CLI::App& app)
      : Subcommand(app, "map", "Map another shape to the surface: which point corresponds to which.", R"(Examples:
  tufted map bent.off --from flat.off --out maps
  tufted map bent.off --from flat.off --landmarks pairs.txt --count 60 --out maps --png maps.png

FILE is the target and --from the source; both are clouds or meshes, in any unit. A functional map of 30 eigenpairs is
found from wave kernel signatures at energies that both shapes share, and from wave kernels around the landmarks. It is
refined by ZoomOut to --count eigenpairs. Shapes that are their own mirror image have two maps of equal cost: landmarks,
pairs of corresponding points off the plane of symmetry, decide.
The options of choosing points and components apply to FILE alone; those of building clouds to FILE and, if both are
clouds, to the source; all others to both shapes.

Files in DIR, which replace older ones when all are complete:
  to_source.npy  N', int32: for each point of FILE the corresponding one of the source; -1 at points that take no part
  to_target.npy  N, int32: for each point of the source the corresponding one of FILE
  image.npy      N' x 3, float64: positions of the points to_source, NaN where there is none
  map.npy        K x K, float64: from coefficients of functions on the source to those on FILE, in bases of norm 1
  points.ply     the points of FILE with the fields image and to_source, float32; points.pcd with --format pcd
  report.json    there_and_back: mean distance of points from where they come back to, over the root of the area)") {
    addText(command, "--from SOURCE", from.file, "The other shape, a cloud or a mesh")->required();
    addText(command, "--landmarks TEXT", landmarks,
            "Text file of pairs of corresponding points, lines SOURCE TARGET of their indices");
    addNumber(command, "--count K", count, 2, 10000, "Number of eigenpairs of the map, zeros included (100)");
    addNumber(command, "--commutativity W", options.commutativity, 0., std::numeric_limits<double>::max(),
              "How much the first map is asked to commute with the Laplacians (0.03)");
  }

  void check(const Operator& source) override {
    from.as = input.as;
    from.weld = input.weld;
    source_build = build;
    refuseTooMany(from);
    shape = readInput(from, source.progress);
    if (shape.is_mesh) source_build.cloud_only.clear();  // these options are meant for FILE, if that is a cloud
    stages = spectralStages(count);
    shown = {{"image", 3}};
    const auto rows = static_cast<double>(shape.points.rows());
    options.landmarks.clear();
    if (landmarks.empty()) return;
    for (const Row& row : readRows(landmarks)) {
      if (row.numbers.size() != 2) throw tufted::IoError(row.name + ": is not SOURCE TARGET, two indices");
      const double first = row.numbers[0];
      if (!(first >= 0 && first < rows && first == std::floor(first)))
        throw tufted::InvalidInput(row.name + ": " + numberText(first) + " is no index in [0, " + numberText(rows) +
                                   "), the points of " + from.name());
      const Place place = placeOf({row.numbers[1]}, source, row.name);
      options.landmarks.push_back({static_cast<int>(first), place.index});
    }
  }

  /// Finds the first `count` eigenpairs of a shape, or all if it has fewer.
  /// @throws IoError for a shape that cannot be mapped
  static tufted::Spectrum pairsOf(const std::string& name, const tufted::Laplacian& laplacian, int count,
                                  const Operator& source) {
    const int most = tufted::mostEigenpairs(laplacian);
    if (most == 0) {
      const std::string why = nothingActive(laplacian);
      throw tufted::IoError(name + ": " + (why.empty() ? "no active point has an area" : why));
    }
    tufted::Spectrum pairs = tufted::spectrum(laplacian, std::min(count, most), source.spectrumOptions());
    if ((pairs.values.array() > 0).count() < 2)
      throw tufted::IoError(name + ": fewer than two of its " + std::to_string(pairs.values.size()) +
                            " first eigenvalues are positive, as it has many components or few points");
    return pairs;
  }

  /// The mean distance of points from where a map and its inverse bring them, over the root of the area.
  static double thereAndBack(const tufted::PointMaps& maps, const tufted::Laplacian& laplacian) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < maps.to_source.size(); ++i) {
      if (maps.to_source[i] < 0) continue;
      const int back = maps.to_target[static_cast<std::size_t>(maps.to_source[i])];
      sum += (laplacian.positions.row(back) - laplacian.positions.row(laplacian.representative[i])).stableNorm();
      ++count;
    }
    return sum / count / std::sqrt(laplacian.M.sum());
  }

  Results compute(Operator& source) override {
    Results results;
    const std::string name = from.name();
    const tufted::Laplacian other = buildLaplacian(shape, from, source_build, false, source.progress);
    results.warnings = warningsOf(name, shape, tufted::warnings(other.report));
    constexpr int least_pairs = 100;  // wave kernel signatures of fewer tell less, see FunctionalMapOptions
    const int pairs = std::max(count, least_pairs);
    const tufted::Spectrum first = pairsOf(name, other, pairs, source);
    const tufted::Spectrum second = pairsOf(source.name, source.laplacian, pairs, source);
    const tufted::MappedShape other_shape = {other, first}, own = {source.laplacian, second};
    options.k = std::min(options.k, count);
    options.progress = source.progress;
    const Eigen::MatrixXd start = tufted::functionalMap(other_shape, own, options);
    const Eigen::MatrixXd C =
        tufted::zoomOut(other_shape, own, start, {.k = count, .threads = source.threads, .progress = source.progress});
    const tufted::PointMaps maps = tufted::pointMaps(other_shape, own, C, source.threads, source.progress);
    Eigen::MatrixXd image(std::ssize(maps.to_source), 3);
    for (Eigen::Index i = 0; i < image.rows(); ++i) {
      const int point = maps.to_source[static_cast<std::size_t>(i)];
      if (point < 0)
        image.row(i).setConstant(std::numeric_limits<double>::quiet_NaN());
      else
        image.row(i) = shape.points.row(point);
    }
    const double back = thereAndBack(maps, source.laplacian);
    results.report["from"] = name;
    results.report["eigenpairs"] = C.rows();
    results.report["landmarks"] = options.landmarks.size();
    results.report["there_and_back"] = back;
    results.summary.add("eigenpairs", "%ld, %zu landmarks", static_cast<long>(C.rows()), options.landmarks.size());
    results.summary.add("there and back", "%.3g of the root of the area, mean distance", back);
    results.shown = {{.name = "image", .values = image}};
    results.arrays = {{.name = "image", .values = std::move(image)},
                      {.name = "to_source", .values = columnOf(maps.to_source), .is_integer = true},
                      {.name = "to_target", .values = columnOf(maps.to_target), .per_point = false, .is_integer = true},
                      {.name = "map", .values = C, .per_point = false}};
    return results;
  }

  Input from;
  Build source_build;  ///< of the source
  tufted::Geometry shape;
  std::filesystem::path landmarks;
  int count = 100;
  tufted::FunctionalMapOptions options;

  std::vector<std::string> files() const override { return {"image.npy", "to_source.npy", "to_target.npy", "map.npy"}; }
};

}  // namespace

void addMap(CLI::App& app, Run& run) {
  addSubcommand<Map>(app, run);
}
