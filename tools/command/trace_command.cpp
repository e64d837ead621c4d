#include "subcommand.h"
#include "tufted/tracing.h"

namespace {

struct Trace : Subcommand {
  explicit Trace(CLI::App& app)
      : Subcommand(app, "trace", "Follow a straight line along the surface from a point in a direction.", R"(Examples:
  tufted trace scan.ply --source 0 --direction 1,0,0 --length 2 --out line
  tufted trace mesh.off --face 2,1,1,1 --direction 0,0,1 --length 0.5 --out line

The direction is projected into the tangent plane of the source, or, of a place inside a triangle (--face), into its
plane.
The line is straight within triangles, and across an edge when both triangles are unfolded into a plane. It leaves a
vertex that it meets with equal angles on both sides. It ends early where the surface ends, and at edges of more than
two triangles. The triangles are those of FILE or, for a cloud, of `tufted laplacian --format triangles`.

Files in DIR, which replace older ones when all are complete:
  path.npy     K x 3, float64: the start, where the line crosses edges and passes vertices, and the end
  lines.ply    the same points and the edges between them
  lines.obj    the same points and an element l
  lines.svg    a plan of the line to scale, seen from above, y up
  points.ply   the points; points.pcd with --format pcd
  report.json  length, why the line ends (length, rim, branch or crossings), the triangle there, barycentric
               coordinates in it, and the direction at the end)",
                   R"(--format npz,ply,cover --out DIR` wrote: clouds
need the triangles of the cover.)") {
    cover = CoverUse::clouds;
    addPointOptions(command, points, "Start");
    addFaceOption(command, faces, "Start");
    command.add_option("--direction", direction_text, "Direction in which the line starts, of any length")
        ->required()
        ->type_name("X,Y,Z");
    addNumber(command, "--length D", length, std::numeric_limits<double>::min(), std::numeric_limits<double>::max(),
              "Length of the line, in the unit of FILE")
        ->required();
  }

  void check(const Operator& source) override {
    checkFrames(source);
    places = points.places(source);
    starts = pointsInFaces(faces, source);
    if (places.size() + starts.size() != 1)
      throw tufted::InvalidInput(std::to_string(places.size() + starts.size()) +
                                 " starts are given, must be one by --source, --near or --face");
    direction = parsePosition(direction_text, "--direction");
    if (direction.isZero(0)) throw tufted::InvalidInput("--direction " + direction_text + " has no direction");
  }

  Results compute(Operator& source) override {
    Results results;
    for (const int point : locate(places, source, results)) {
      requireTakingPart({point}, source);
      starts = {tufted::SurfacePoint::vertex(point)};
      results.report["source_point"] = point;
    }
    tufted::SurfacePoint start = starts.front();
    for (int& corner : start.corners) corner = source.laplacian.representative[corner];
    const tufted::GeodesicTracer tracer(source.laplacian.positions, joinedTriangles(source), framesOf(source));
    const tufted::TracedLine traced = tracer.query(start, direction, length, source.progress);
    const char* const reason = tufted::nameOf(traced.reason);
    results.arrays = {{.name = "path", .values = traced.line.points, .per_point = false}};
    results.lines = {traced.line};
    results.report["length"] = traced.line.length;
    results.report["ended_by"] = reason;
    results.report["end"] = {{"corners", traced.end.corners}, {"weights", traced.end.weights}};
    results.report["direction"] = {traced.direction[0], traced.direction[1], traced.direction[2]};
    results.summary.add("length", "%.6g, %lld points", traced.line.length,
                        static_cast<long long>(traced.line.points.rows()));
    results.summary.add("ended by", "%s", reason);
    return results;
  }

  NamedPoints points;
  std::vector<std::string> faces;
  std::string direction_text;
  double length = 0;
  std::vector<Place> places;
  std::vector<tufted::SurfacePoint> starts;
  Eigen::RowVector3d direction = Eigen::RowVector3d::Zero();

  std::vector<std::string> files() const override { return {"path.npy", "lines.ply", "lines.obj", "lines.svg"}; }
};

}  // namespace

void addTrace(CLI::App& app, Run& run) {
  addSubcommand<Trace>(app, run);
}
