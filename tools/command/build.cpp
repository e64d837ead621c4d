#include "build.h"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <map>
#include <new>
#include <utility>

#include "options.h"
#include "point_options.h"
#include "tufted/errors.h"

namespace {

const std::map<std::string, tufted::Gluing> gluings = {{"star", tufted::Gluing::star},
                                                       {"vertex-pair", tufted::Gluing::vertex_pair}};
const std::map<std::string, tufted::FaceOrder> orders = {
    {"angle", tufted::FaceOrder::angle}, {"area", tufted::FaceOrder::area}, {"random", tufted::FaceOrder::random}};
const std::map<std::string, tufted::Preset> presets = {
    {"clean", tufted::Preset::clean}, {"scan", tufted::Preset::scan}, {"lidar", tufted::Preset::lidar}};
const std::map<std::string, tufted::Delaunay> backends = {{"star", tufted::Delaunay::star},
                                                          {"cgal", tufted::Delaunay::cgal}};

/// @throws InvalidInput if one of these options is given with a mesh
void refuseCloudOptions(const Input& input, const std::vector<const CLI::Option*>& options) {
  for (const CLI::Option* option : options)
    if (option->count() > 0)
      throw tufted::InvalidInput(option->get_name() + " applies to point clouds, and " + input.name() +
                                 " holds a mesh (--as cloud takes its vertices alone)");
}

/// Builds a cloud's Laplacian. @throws IoError instead of InvalidInput for azimuths that do not fit the points
tufted::Laplacian cloudLaplacian(const tufted::Geometry& geometry, const Input& input, const Build& build) {
  try {
    return tufted::pointCloudLaplacian(geometry.points, build.cloud);
  } catch (const tufted::InvalidInput& error) {
    const std::string message = error.what(), rings = "pointCloudLaplacian: structure.position: ";
    if (build.structure != Structure::rings || !message.starts_with(rings)) throw;
    throw tufted::IoError(input.name() + ": " + message.substr(rings.size()) + " (--structure rings asks for them)");
  }
}

}  // namespace

std::string presetName(tufted::Preset preset) {
  return std::find_if(presets.begin(), presets.end(), [&](const auto& named) { return named.second == preset; })->first;
}

void addBuildOptions(CLI::App& command, Build& build) {
  build.neighbors = addNumber(command, "--neighbors K", build.cloud.neighbors, 3, std::numeric_limits<int>::max(),
                              "Number of neighbours per point, clouds only (30)");
  build.cloud_only.insert(
      build.cloud_only.end(),
      {build.neighbors,
       addChoice(command, "--preset", build.preset, presets,
                 "Kind of cloud: exact samples, spinning laser scanner, or any other scan; clouds only (scan)"),
       addChoice(
           command, "--structure", build.structure, structures,
           "Neighbours are pixels (image), nearest points (none) or on rings of a scanner; clouds only (automatic)"),
       command.add_flag(
           "--normals", build.normals,
           "Take tangent planes from the normals of FILE, which also tell the two sides of thin parts apart; clouds "
           "only (planes fitted to the neighbours)"),
       command.add_flag(
           "--denoise", build.denoise,
           "Move noisy points onto the surface even with --preset clean, and start from the moved points; clouds only"),
       command
           .add_option("--viewpoint", build.given_viewpoint,
                       "Position of the sensor, clouds only (VIEWPOINT of FILE, or the origin for an organized cloud)")
           ->type_name("X,Y,Z")});
  addNumber(command, "--threads N", build.cloud.threads, 1, 1 << 16, "Maximum number of threads (one per processor)");
  const CLI::Option* const mollify = addNumber(command, "--mollify D", build.mollify, 0.0, 1.0,
                                               "Shortest allowed edge, as a fraction of the longest side of its "
                                               "smaller triangle; with 0 flat triangles stay (" +
                                                   numberText(tufted::default_mollify) + ")");

  tufted::PaperOptions& paper = build.cloud.paper;
  CLI::Option* const gluing =
      addChoice(command, "--gluing", paper.gluing, gluings,
                "Which faces are glued at an edge: those of one star, or all, as in the paper; clouds only (star)");
  CLI::Option* const delaunay =
      addChoice(command, "--delaunay", paper.delaunay, backends,
                "Code that computes the stars: CGAL or Tufted itself (star), with the same result; clouds only (star)");
  CLI::Option* const order =
      addChoice(command, "--order", paper.order, orders,
                "Order of the faces around an edge: ascending dihedral angle or area, or random (angle)");
  CLI::Option* const seed =
      addNumber(command, "--seed S", paper.seed, std::uint64_t(0), std::numeric_limits<std::uint64_t>::max(),
                "Seed of the random order, only with --order random (0)");
  for (CLI::Option* const option : {gluing, delaunay, order, seed}) option->group("For comparison with the paper");
  build.seed = seed;
  build.cloud_only.insert(build.cloud_only.end(), {gluing, delaunay});
  build.building = build.cloud_only;
  build.building.insert(build.building.end(), {order, seed, mollify});
}

void checkSeed(const Build& build) {
  if (build.seed->count() > 0 && build.cloud.paper.order != tufted::FaceOrder::random)
    throw CLI::RequiresError("--seed", "--order random");
}

tufted::Laplacian buildLaplacian(const tufted::Geometry& geometry, const Input& input, Build& build, bool keep_cover,
                                 const tufted::Progress& progress) {
  if (geometry.is_mesh) refuseCloudOptions(input, build.cloud_only);
  if (build.normals) {
    if (geometry.normals.rows() == 0)
      throw tufted::IoError(input.name() + ": has no normals, which --normals asks for");
    build.cloud.normals = &geometry.normals;
  }
  build.doubt = doubtOf(geometry, build.structure);
  if (build.structure == Structure::automatic) {
    // --neighbors and --preset lidar ask for a search.
    const bool may_be_image = build.neighbors->count() == 0 && build.preset != tufted::Preset::lidar;
    build.structure = may_be_image ? structureFor(geometry) : Structure::none;
  }
  if (build.structure == Structure::image && build.neighbors->count() > 0)
    throw tufted::InvalidInput("--neighbors " + std::to_string(build.cloud.neighbors) +
                               " excludes --structure image, which takes the pixels around a point");
  build.scan = structureOf(geometry, build.structure, input.name());
  if (build.scan) build.cloud.structure = &*build.scan;
  build.cloud.steps = tufted::cloudSteps(build.preset);
  if (build.denoise) build.cloud.steps.denoise = true;
  // The sensor's position is known if given or stated in the file; that of an organized cloud may be the origin.
  build.viewpoint = {geometry.viewpoint[0], geometry.viewpoint[1], geometry.viewpoint[2]};
  const bool is_given = !build.given_viewpoint.empty();
  if (is_given) build.viewpoint = parsePosition(build.given_viewpoint, "--viewpoint");
  if (is_given || geometry.height > 1 || !build.viewpoint.isZero(0)) build.cloud.viewpoint = &build.viewpoint;
  build.cloud.progress = progress;
  build.cloud.keep_cover = keep_cover;
  build.mesh.paper = build.cloud.paper;
  build.mesh.threads = build.cloud.threads;
  build.mesh.progress = progress;
  build.mesh.keep_cover = keep_cover;
  build.mesh.weld = input.weld;
  if (build.mollify) build.cloud.mollify = build.mesh.mollify = *build.mollify;
  if (geometry.is_mesh) return tufted::meshLaplacian(geometry.points, geometry.triangles, build.mesh);
  tufted::Laplacian laplacian;
  try {
    laplacian = cloudLaplacian(geometry, input, build);
  } catch (const std::bad_alloc&) {
    const auto points = geometry.points.rows();
    throw tufted::FileTooLarge("out of memory: " +
                               memoryText(input, points, static_cast<double>(points) * least_build_bytes));
  }
  if (build.denoise) build.moved = laplacian.positions;
  return laplacian;
}

void addBuild(const tufted::Report& report, const Build& build, Summary& summary) {
  if (build.structure == Structure::image) {
    if (report.denoised == 0)
      summary.add("structure", "depth image, no point moved");
    else
      summary.add("structure", "depth image, %s moved along their rays, off the surface by %.3g of the file's unit",
                  countText(report.denoised, "point").c_str(), report.noise);
    if (!build.doubt.empty()) summary.add("rays", "%s", build.doubt.c_str());
  } else if (report.noise > 0)
    summary.add("noise", "%s moved onto the surface, off it by %.3g of the file's unit (standard deviation)",
                countText(report.denoised, "point").c_str(), report.noise);
  if (report.neighbors_clamped)
    summary.add("neighbors", "%d and not %d: all other points", report.neighbors, build.cloud.neighbors);
}
