#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "moved_points.h"
#include "operator.h"
#include "options.h"
#include "oriented.h"
#include "point_options.h"
#include "reports.h"
#include "taking_part.h"
#include "time_step.h"
#include "tufted/errors.h"
#include "tufted/signed_distance.h"

namespace signed_distance_command {
namespace {

constexpr const char* description = "Compute the distance from curves on the surface, positive on their left.";

constexpr const char* footer =
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
  report.json   method, points and length of the curves, counts of the query, residual, seconds
`tufted help laplacian` explains FILE and the options of building. --operator DIR reads L and M that
`tufted laplacian --out DIR` wrote, for marching with --format npz,ply,cover.)";

const std::map<std::string, tufted::DistanceMethod> methods = {{"marching", tufted::DistanceMethod::marching},
                                                               {"heat", tufted::DistanceMethod::heat}};

struct Settings {
  OperatorSettings source;
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
  std::vector<std::string> files() const { return {"distance.npy"}; }
};

/// @throws InvalidInput for options of the other method
void checkMethod(const Settings& settings) {
  const NamedPoints& points = settings.points;
  const bool has_points =
      !points.indices.empty() || !points.positions.empty() || !points.file.empty() || !settings.faces.empty();
  if (settings.isHeat() && has_points)
    throw tufted::InvalidInput("--source, --near, --sources and --face apply to --method marching");
  if (settings.isHeat() && settings.options.split) throw tufted::InvalidInput("--split applies to --method marching");
  if (!settings.isHeat() && settings.time_step) throw tufted::InvalidInput("--time-step applies to --method heat");
  if (settings.files_of_curves.empty() && !has_points)
    throw tufted::InvalidInput("no curve is given, must be at least one by --curve");
}

/// The place in a line of a file.
tufted::SurfacePoint placeOn(const Row& row, const Operator& source) {
  if (row.numbers.size() == 1) return tufted::SurfacePoint::vertex(indexOf(row, source));
  if (row.numbers.size() != 4) throw tufted::IoError(row.name + ": is neither INDEX nor FACE A B C");
  requireMesh(row.name + ": a place in a triangle", source);
  return pointInFace(row.numbers, row.name, source);
}

void check(Settings& settings, const Operator& source) {
  checkMethod(settings);
  settings.source.shown = {{"signed_distance"}};
  checkFrames(source);
  for (const std::filesystem::path& file : settings.files_of_curves) {
    tufted::SurfaceCurve& curve = settings.curves.emplace_back();
    for (const Row& row : readRows(file)) curve.push_back(placeOn(row, source));
    if (curve.size() < 2)
      throw tufted::IoError(file.string() + ": has " + std::to_string(curve.size()) + " points, must have at least 2");
  }
  settings.places = settings.points.places(source);
  settings.inside = pointsInFaces(settings.faces, source);
  if (!settings.isHeat()) settings.source.stages = {{"faces", 26, 2}, {"edges", 3}, {"march", 18}};
}

Results compute(Settings& settings, Operator& source) {
  Results results;
  std::vector<tufted::SurfacePoint> points;
  const std::vector<int> sources = locate(settings.places, source, results);
  for (const int point : sources) points.push_back(tufted::SurfacePoint::vertex(point));
  points.insert(points.end(), settings.inside.begin(), settings.inside.end());
  std::vector<int> named = sources;
  bool has_others = !settings.inside.empty();
  for (const tufted::SurfaceCurve& curve : settings.curves) {
    for (const tufted::SurfacePoint& place : curve) {
      const bool is_point = place.corners[0] == place.corners[1];
      if (is_point) named.push_back(place.corners[0]);
      has_others |= !is_point;
    }
  }
  noteLeftOut(named, source, results, has_others);
  settings.options.solver = source.solverOptions();
  if (settings.time_step) settings.options.time_step = *settings.time_step;
  const tufted::SignedDistanceSolver solver(source.laplacian, orientedFrames(settings.orienting, source, results),
                                            settings.options);
  checkTimeStep(settings.time_step, solver.timeStep(), source);
  tufted::SignedDistanceReport made;
  const Eigen::VectorXd distance =
      blameSurface(source, [&] { return solver.queryAt(settings.curves, points, &made, source.progress); });
  results.report["method"] = settings.isHeat() ? "heat" : "marching";
  results.report["curve"] = {{"points", made.curve_points}, {"length", made.curve_length}};
  results.summary.add(settings.curves.size() > 1 ? "curves" : "curve", "%lld points, length %.6g",
                      static_cast<long long>(made.curve_points), made.curve_length);
  made.heat.residual = std::max(made.heat.residual, made.residual);
  if (settings.isHeat())
    addReport(made.heat, solver.report(), results);
  else
    addReport(made.march, solver.report(), results);
  results.summary.add("not reached", "%lld points, which are NaN",
                      static_cast<long long>(distance.array().isNaN().count()));
  results.arrays = {{.name = "distance", .values = distance}};
  results.shown = {{.name = "signed_distance", .values = distance}};
  return results;
}

}  // namespace
}  // namespace signed_distance_command

void addSignedDistance(CLI::App& app, Run& run) {
  using namespace signed_distance_command;
  const auto [command, settings] =
      addOperatorCommand<Settings>(app, run, "signed-distance", description, footer, compute, check);
  addOrienting(*command, settings->orienting);
  command
      ->add_option("--curve", settings->files_of_curves,
                   "Text file of the places along a curve in order, lines INDEX or FACE A B C; may be repeated")
      ->allow_extra_args(false)
      ->check(notEmpty)
      ->type_name("TEXT");
  addPointOptions(*command, settings->points, "With --method marching: further sources without a side");
  addFaceOption(*command, settings->faces, "With --method marching: further source without a side");
  addChoice(*command, "--method", settings->options.method, methods,
            "heat: smooth, also across gaps; marching: lengths of shortest paths (heat)")
      ->each([settings = settings.get()](const std::string& method) {
        settings->source.cover = method == "marching" ? CoverUse::all : CoverUse::none;
      });
  addNumber(*command, "--split", settings->options.split, 0, 2,
            "With --method marching: how often each triangle is divided into four (2 up to 5,000 points, else 1)")
      ->type_name("TIMES");
  addTimeStep(*command, settings->time_step,
              "With --method heat: time step in mean squared edges; larger values bridge wider gaps (4)");
}
