#include "subcommand.h"
#include "tufted/isolines.h"

namespace {

struct Isolines : Subcommand {
  explicit Isolines(CLI::App& app)
      : Subcommand(app, "isolines", "Find the lines on which a field has given values.", R"(Examples:
  tufted isolines scan.ply --field z --count 10 --out contours
  tufted isolines mesh.off --field x --at 0.25,0.5 --out cuts

The field is linear within each triangle of FILE or, for a cloud, of `tufted laplacian --format triangles`. Lines are
closed, or end where the surface ends, at edges of more than two triangles, and where the field is not finite. Larger
values lie to the left of a line, seen from the front of its triangles.

Files in DIR, which replace older ones when all are complete:
  isolines.npy  K x 5, float64: number of the line, its value, and x, y, z of its points in order; a closed line does
                not repeat its first point
  lines.ply     the points with the field value, float64, and edges between them
  lines.obj     the points, and an element l for each line
  lines.svg     a plan of the lines to scale, seen from above, y up, with a legend of the values
  points.ply    the points; points.pcd with --format pcd
  report.json   value, length, points, and whether it is closed, of each line)",
                   R"(--format npz,ply,cover --out DIR` wrote: clouds
need the triangles of the cover.)") {
    cover = CoverUse::clouds;
    addSignalOptions(command, signals, "Field, one value per point");
    CLI::Option* const at_option = addText(command, "--at V,...", at, "Values of the lines");
    addNumber(command, "--count K", count, 1, 10000,
              "Number of values, in equal steps between the least and the greatest of the field (10)")
        ->excludes(at_option);
  }

  /// Values in equal steps between the least and the greatest one, without these.
  std::vector<double> valuesBetween() const {
    double least = std::numeric_limits<double>::infinity(), greatest = -least;
    for (const double value : field.reshaped()) {
      if (!std::isfinite(value)) continue;
      least = std::min(least, value);
      greatest = std::max(greatest, value);
    }
    std::vector<double> between;
    for (int k = 1; k <= count && least < greatest; ++k) {
      const double share = static_cast<double>(k) / (count + 1);
      between.push_back((1 - share) * least + share * greatest);
    }
    return between;
  }

  void check(const Operator& source) override {
    checkPositions(source);
    field = readSignals(signals, source);
    if (field.cols() != 1)
      throw tufted::InvalidInput("the field of --field or --values has " + std::to_string(field.cols()) +
                                 " columns, must have one");
    if (!at.empty()) values = parseNumbers(at, "--at");
    for (const double value : values)
      if (!std::isfinite(value)) throw tufted::InvalidInput("--at " + at + " is not finite, must be");
    shown = {{"values"}};
  }

  Results compute(Operator& source) override {
    Results results;
    for (int i = 0; i < source.points(); ++i)
      if (source.laplacian.status[source.laplacian.representative[i]] != tufted::PointStatus::active)
        field(i, 0) = std::numeric_limits<double>::quiet_NaN();  // also where --component leaves points out
    if (at.empty()) values = valuesBetween();
    results.lines =
        tufted::isolines(source.laplacian.positions, joinedTriangles(source), field.col(0), values, source.progress);
    const std::vector<tufted::Polyline>& lines = *results.lines;
    Eigen::Index rows = 0;
    for (const tufted::Polyline& line : lines) rows += line.points.rows();
    Eigen::MatrixXd table(rows, 5);
    rows = 0;
    double length = 0;
    long long closed = 0;
    results.report["lines"] = nlohmann::ordered_json::array();
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const tufted::Polyline& line = lines[k];
      auto part = table.middleRows(rows, line.points.rows());
      part.col(0).setConstant(static_cast<double>(k));
      part.col(1).setConstant(line.value);
      part.rightCols(3) = line.points;
      rows += line.points.rows();
      length += line.length;
      closed += line.is_closed ? 1 : 0;
      results.report["lines"].push_back(
          {{"value", line.value}, {"length", line.length}, {"points", line.points.rows()}, {"closed", line.is_closed}});
    }
    results.arrays = {{.name = "isolines", .values = std::move(table), .per_point = false}};
    results.shown = {{.name = "values", .values = field}};
    results.summary.add("lines", "%zu of %s, %lld closed, length %.6g", lines.size(),
                        countText(std::ssize(values), "value").c_str(), closed, length);
    return results;
  }

  SignalOptions signals;
  std::string at;
  int count = 10;
  Eigen::MatrixXd field;
  std::vector<double> values;

  std::vector<std::string> files() const override { return {"isolines.npy", "lines.ply", "lines.obj", "lines.svg"}; }
};

}  // namespace

void addIsolines(CLI::App& app, Run& run) {
  addSubcommand<Isolines>(app, run);
}
