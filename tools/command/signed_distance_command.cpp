#include "subcommand.h"
#include "tufted/signed_distance.h"

namespace {

struct SignedDistance : Subcommand {
  explicit SignedDistance(CLI::App& app)
      : Subcommand(app, "signed-distance", "Compute the distance from curves on the surface, positive on their left.",
                   R"(Examples:
  tufted signed-distance mesh.off --curve curve.txt --out signed
  tufted signed-distance mesh.off --curve curve.txt --source 3 --method marching --out signed

--curve is a text file of the places along a curve in order, a line each: INDEX of a point, or FACE A B C, a place
inside triangle FACE of a mesh with barycentric coordinates A, B, C. A closed curve ends with its first place. Distances
are positive on the left, seen from the side of the normals, which are those of `tufted normals`. `tufted path` finds
paths between points.

  heat      all curves count as pieces of one, whose left sides should agree. They may be open or have gaps, across which
            the distance continues smoothly. Its mean over each curve is 0.
  marching  each point has the length of a shortest path to the nearest curve, negative if the path leaves that curve to
            the right. The sign changes where paths from both sides meet, as it does beyond the ends of open curves.
            Points given by --source, --near, --sources or --face have no side: distances from them are positive.

Files in DIR, which replace older ones when all are complete:
  distance.npy  N distances, float64, in the unit of FILE; NaN on components without a source, and at points that take
                no part
  points.ply    the points with the field distance, float32; points.pcd with --format pcd
  report.json   method, points and length of the curves, counts of the query, residual, seconds)",
                   R"(--out DIR` wrote, for marching with --format npz,ply,cover.)") {
    addOrienting(command, orienting);
    addText(command, "--curve TEXT", files_of_curves,
            "Text file of the places along a curve in order, lines INDEX or FACE A B C; may be repeated")
        ->allow_extra_args(false);
    addPointOptions(command, points, "With --method marching: further sources without a side");
    addFaceOption(command, faces, "With --method marching: further source without a side");
    addChoice(command, "--method", options.method, methods,
              "heat: smooth, also across gaps; marching: lengths of shortest paths (heat)")
        ->each([this](const std::string& method) { cover = method == "marching" ? CoverUse::all : CoverUse::none; });
    addNumber(command, "--split TIMES", options.split, 0, 2,
              "With --method marching: how often each triangle is divided into four (2 up to 5,000 points, else 1)");
    addTimeStep(command, time_step,
                "With --method heat: time step in mean squared edges; larger values bridge wider gaps (4)");
  }

  static inline const std::map<std::string, tufted::DistanceMethod> methods = {
      {"marching", tufted::DistanceMethod::marching}, {"heat", tufted::DistanceMethod::heat}};

  /// @throws InvalidInput for options of the other method
  void checkMethod() const {
    const bool has_points =
        !points.indices.empty() || !points.positions.empty() || !points.file.empty() || !faces.empty();
    if (isHeat() && has_points)
      throw tufted::InvalidInput("--source, --near, --sources and --face apply to --method marching");
    if (isHeat() && options.split) throw tufted::InvalidInput("--split applies to --method marching");
    if (!isHeat() && time_step) throw tufted::InvalidInput("--time-step applies to --method heat");
    if (files_of_curves.empty() && !has_points)
      throw tufted::InvalidInput("no curve is given, must be at least one by --curve");
  }

  /// The place in a line of a file.
  static tufted::SurfacePoint placeOn(const Row& row, const Operator& source) {
    if (row.numbers.size() == 1) return tufted::SurfacePoint::vertex(indexOf(row, source));
    if (row.numbers.size() != 4) throw tufted::IoError(row.name + ": is neither INDEX nor FACE A B C");
    requireMesh(row.name + ": a place in a triangle", source);
    return pointInFace(row.numbers, row.name, source);
  }

  void check(const Operator& source) override {
    checkMethod();
    shown = {{"signed_distance"}};
    checkFrames(source);
    for (const std::filesystem::path& file : files_of_curves) {
      tufted::SurfaceCurve& curve = curves.emplace_back();
      for (const Row& row : readRows(file)) curve.push_back(placeOn(row, source));
      if (curve.size() < 2)
        throw tufted::IoError(file.string() + ": has " + std::to_string(curve.size()) +
                              " points, must have at least 2");
    }
    places = points.places(source);
    inside = pointsInFaces(faces, source);
    if (!isHeat()) stages = {{"faces", 26, 2}, {"edges", 3}, {"march", 18}};
  }

  Results compute(Operator& source) override {
    Results results;
    std::vector<tufted::SurfacePoint> others;
    const std::vector<int> sources = locate(places, source, results);
    for (const int point : sources) others.push_back(tufted::SurfacePoint::vertex(point));
    others.insert(others.end(), inside.begin(), inside.end());
    std::vector<int> named = sources;
    bool has_others = !inside.empty();
    for (const tufted::SurfaceCurve& curve : curves) {
      for (const tufted::SurfacePoint& place : curve) {
        const bool is_point = place.corners[0] == place.corners[1];
        if (is_point) named.push_back(place.corners[0]);
        has_others |= !is_point;
      }
    }
    noteLeftOut(named, source, results, has_others);
    options.solver = source.solverOptions();
    if (time_step) options.time_step = *time_step;
    const tufted::SignedDistanceSolver solver(source.laplacian, orientedFrames(orienting, source, results), options);
    checkTimeStep(time_step, solver.timeStep(), source);
    tufted::SignedDistanceReport made;
    const Eigen::VectorXd distance =
        blameSurface(source, [&] { return solver.queryAt(curves, others, &made, source.progress); });
    results.report["method"] = isHeat() ? "heat" : "marching";
    results.report["curve"] = {{"points", made.curve_points},
                               {"length", made.curve_length},
                               {"segments", made.segments},
                               {"long_segments", made.long_segments}};
    if (const std::string warning = tufted::longSegmentsWarning(made); !warning.empty())
      results.warnings.push_back(warning);
    results.summary.add(curves.size() > 1 ? "curves" : "curve", "%lld points, length %.6g",
                        static_cast<long long>(made.curve_points), made.curve_length);
    made.heat.residual = std::max(made.heat.residual, made.residual);
    if (isHeat())
      addReport(made.heat, solver.report(), results);
    else
      addReport(made.march, solver.report(), results);
    results.summary.add("not reached", "%lld points, which are NaN",
                        static_cast<long long>(distance.array().isNaN().count()));
    results.arrays = {{.name = "distance", .values = distance}};
    results.shown = {{.name = "signed_distance", .values = distance}};
    return results;
  }

  Orienting orienting;
  std::vector<std::filesystem::path> files_of_curves;
  NamedPoints points;
  std::vector<std::string> faces;
  tufted::SignedDistanceOptions options;
  std::optional<double> time_step;
  std::vector<tufted::SurfaceCurve> curves;
  std::vector<Place> places;
  std::vector<tufted::SurfacePoint> inside;  ///< further sources inside faces

  bool isHeat() const { return options.method == tufted::DistanceMethod::heat; }
  std::vector<std::string> files() const override { return {"distance.npy"}; }
};

}  // namespace

void addSignedDistance(CLI::App& app, Run& run) {
  addSubcommand<SignedDistance>(app, run);
}
