#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "build.h"
#include "command.h"
#include "console.h"
#include "input.h"
#include "interrupt.h"
#include "look.h"
#include "options.h"
#include "output.h"
#include "progress_bar.h"
#include "scene_fields.h"
#include "summary.h"
#include "tiled.h"
#include "tufted/errors.h"
#include "tufted/io/read.h"
#include "tufted/io/tiles.h"
#include "tufted/io/write.h"
#include "tufted/laplacian.h"
#include "warnings.h"

namespace laplacian_command {
namespace {

constexpr const char* description = "Build L and M for a point cloud or a mesh and write them into a folder.";

constexpr const char* footer = R"(Examples:
  tufted laplacian scan.ply --out laplacian
  tufted laplacian mesh.off --format npz,mat --out laplacian
  tufted laplacian scan.ply --where z=0..2 --thin 0.01 --out part

Sign and scale:
  L is positive semidefinite: minus the Laplacian, integrated. libigl and PMP use the opposite sign.
  M holds the area of each point in length^2; their sum approximates the surface area.
  Scale on clouds: 1/2 (front and back of the cover) times 1/3 (each triangle is found by its three corners).
  Scale on meshes: 1/2 (front and back of the cover).
  Poisson's equation is L u = M f, the eigenproblem L x = lambda M x.
  Points that take no part keep their index, with zero row, column and mass; status.npy says why.
  --sign igl negates L: negative semidefinite, as in libigl and PMP; then -L u = M f and -L x = lambda M x.
  --dummy gives points that take no part 1 on the diagonal of L (-1 with --sign igl) and a thousandth of the smallest
  positive mass in M.

Presets of clouds:
  clean  exact samples of a surface: only the steps of the paper
  scan   depth images, laser scans, photogrammetry: withstands noise, depth jumps, outliers and nearby sheets. Noisy
         points are first moved onto the surface, stars agree on the diagonals of grids, and at rims M is the area of a
         point in its own star.
  lidar  the same for spinning scanners, whose rings `scan` would take for separate sheets

Structures, from which the neighbours of a point are taken:
  automatic  image for an organized cloud that a pinhole camera saw from the VIEWPOINT of FILE, unless --neighbors or
             --preset lidar is given or the image is sparse; otherwise none
  none       the nearest points in space
  image      the pixels around the point, none behind a depth jump. Noise of any strength is smoothed along the rays of
             the camera. The cloud must be organized (PCD, or PLY with obj_info num_cols).
  rings      points on the rings beside the point, however far apart the rings are. The field `ring`, and the field
             `azimuth` in radians, degrees or hundredths of a degree (the first unit whose full turn contains all
             values), are read. If a field is missing, the directions from the VIEWPOINT of FILE replace it.

FILE is a cloud (PCD, PLY, LAS, text in columns, or NPY of N x 3 or wider) or a mesh (PLY, OBJ, OFF, STL, or VTK legacy
polygonal data). OBJ, OFF and VTK without faces are clouds. The extension decides the format (.pcd .ply .las .xyz .xyzn
.pwn .txt .csv .asc .pts .obj .off .coff .noff .stl .npy .vtk), or if it is unknown the content. L and M use the normals
of FILE only with --normals; points.ply, points.pcd and points.las contain them in any case.

Points can be dropped before the build: --where compares fields, such as x, y, z, intensity and classification, with
numbers, lists (2,6), ranges (10..20) or fields, by = != < <= > >=. Results have a row per kept point; indices that are
given count the points of FILE. Dropped pixels of an organized cloud become missing ones, and its rows stay.

Files in DIR, which replace older ones when all are complete; other files in DIR are kept:
  file_row.npy        the row of each kept point in FILE, if --where, --crop, --polygon or --thin dropped points
  report.json         counts, seconds, options, sign and scale, and the list of the files of this result
  measured_positions.npy
                      N x 3: the positions between which lengths are measured; noisy points of a cloud are moved
  components.npy      the connected component of each point; 0 has the most points, -1: takes no part
  --format npz
  L.npz               N x N sparse matrix, for scipy.sparse.load_npz
  M.npy               N areas
  status.npy          0 active, 1 not finite, 2 coincident, 3 isolated
  representative.npy  the point that represents a coincident one, otherwise the point itself, counted from 0
  boundary.npy        0 where the surface continues; where it ends 1 rim (the sampling ends), 2 jump (another surface
                      lies behind; seen from the sensor, if its position is known), 3 lost (triangles are missing)
  frames.npy          N x 3 x 3: x axis, y axis and normal of each point; empty for meshes
  noise.npy           standard deviation of the noise around each moved point, 0 at the others; empty if none was moved
  component_edges.npy for each component the number of triangle sides, their mean length and mean squared length
  --format mtx
  L.mtx, M.mtx        Matrix Market: lower triangle of a symmetric matrix, N x 1 array
  --format mat
  laplacian.mat       MATLAB: L, M, status, representative, boundary, conventions
  --format spmat
  L.spmat, M.spmat    a line `row column value` per entry, counted from 1; M is a diagonal matrix
  --format petsc
  L.petsc, M.petsc    for MatLoad and VecLoad of PETSc, with 32-bit indices
  --format ply
  points.ply          the points with the fields mass, boundary, status and representative
  --format pcd
  points.pcd          the same, for PCL
  --format las
  points.las          the same as LAS 1.4, for surveyors: the results are extra bytes; coordinates are rounded to the
                      scale of FILE if it is a LAS file
  --format cover
  cover.npz           the triangles of the tufted cover with their gluing and lengths, which subcommands such as
                      `tufted distance --operator` need; three times as large as the files of npz
  --format triangles
  triangles.ply       triangles between the measured positions: for a cloud a consistently oriented surface with one or
                      two triangles at each edge, for a mesh its own

With --memory the rows of a cloud are those of the whole, but built and written tile by tile, see docs/scale.md:
  L_indptr.npy, L_indices.npy, L_data.npy
                      for scipy.sparse.csr_matrix; with int64 indices
  M.npy, status.npy, representative.npy, boundary.npy
                      as above, but representative with int64 indices
  normals.npy         N x 3, the sign of each normal arbitrary
  file_row.npy        as above
There are no components, no cover, no copies of the points, and no noise is removed. LAS, binary PLY, binary PCD and NPY
are read in passes, so they may be larger than memory. Other files, and all files with --thin, are read as a whole.)";

struct Settings {
  Input input;
  std::filesystem::path out;
  Build build;
  tufted::WriteOptions write;
  Console console;
  Look look;
  Tiled tiled;
  std::vector<NamedInput> inputs;
};

const std::map<std::string, tufted::Format> formats = {
    {"npz", tufted::Format::npz},     {"mtx", tufted::Format::mtx},
    {"mat", tufted::Format::mat},     {"spmat", tufted::Format::spmat},
    {"petsc", tufted::Format::petsc}, {"ply", tufted::Format::ply},
    {"pcd", tufted::Format::pcd},     {"las", tufted::Format::las},
    {"cover", tufted::Format::cover}, {"triangles", tufted::Format::triangles}};
const std::map<std::string, tufted::Sign> signs = {{"psd", tufted::Sign::psd}, {"igl", tufted::Sign::igl}};

/// Adds the options that say what is written, and how.
void addWriteOptions(CLI::App& command, tufted::WriteOptions& options) {
  addFormats(
      command, options.formats, formats,
      "Formats, separated by commas: npz, mtx, mat, spmat, petsc, ply, pcd, las, cover, triangles, or none (npz,ply)");
  addChoice(command, "--sign", options.sign, signs,
            "Sign of L in the files: positive semidefinite (psd) or negative semidefinite as in libigl (psd)");
  command.add_flag("--dummy", options.dummy, "Give points that take no part a nonzero diagonal in L and M, see below");
}

/// The number of points, and of those that take no part.
std::string pointsText(const tufted::Report& report) {
  const std::int64_t left_out = report.points - report.active;
  std::string text = std::to_string(report.points);
  if (left_out == 0) return text + ", all take part";
  text += ", " + std::to_string(report.active) + " take part";
  const auto add = [&text](std::int64_t count, const char* why) {
    if (count > 0) text += ", " + std::to_string(count) + " " + why;
  };
  add(report.not_finite, "not finite");
  add(report.coincident, "equal to an earlier one");
  add(report.isolated, "without a surface");
  return text;
}

Summary summarize(const Settings& settings, const tufted::Geometry& geometry, const tufted::Laplacian& laplacian,
                  double seconds) {
  const tufted::Report& report = laplacian.report;
  const auto count = [](std::int64_t n) { return static_cast<long long>(n); };
  Summary summary;
  summary.add("file", "%s (%s)", settings.input.name().c_str(), geometry.is_mesh ? "mesh" : "cloud");
  if (geometry.polygons > 0) summary.add("polygons", "%lld cut into triangles", count(geometry.polygons));
  addMerged(geometry, settings.input, summary);
  summary.add("points", "%s", pointsText(report).c_str());
  if (report.rim_points + report.jump_points + report.lost_points > 0)
    summary.add("boundary", "%lld points on rims, %lld at depth jumps, %lld where triangles are missing",
                count(report.rim_points), count(report.jump_points), count(report.lost_points));
  addBuild(report, settings.build, summary);
  summary.add("area", "%.10g, the sum of M", laplacian.M.sum());
  summary.add("components", "%lld connected", count(report.components));
  summary.addDetail("triangles", "%lld", count(report.triangles));
  summary.addDetail(
      "nonzeros/row", "%.2f",
      static_cast<double>(report.nonzeros) / static_cast<double>(std::max<std::int64_t>(report.active, 1)));
  summary.addDetail("flips", "%lld", count(report.flips));
  summary.addDetail("clamped", "%lld weights", count(report.clamped_weights + report.clamped_large));
  addEnd(seconds, settings.out, summary);
  addLook(settings.look, summary);
  return summary;
}

int runByTiles(Settings& settings) {
  checkOutput(settings.inputs, settings.out, tufted::tileFiles());
  return runTiled(settings.tiled, settings.input, settings.build, settings.out, settings.console);
}

int runLaplacian(Settings& settings) {
  if (settings.tiled.memory > 0) return runByTiles(settings);
  const auto start = std::chrono::steady_clock::now();
  checkLook(settings.look, settings.out, settings.inputs);
  checkOutput(settings.inputs, settings.out, tufted::resultFiles(settings.write.formats));
  ProgressBar bar(settings.console.quiet);
  const tufted::Progress progress = showOn(bar);
  progress("read", 0);
  refuseTooMany(settings.input);
  tufted::Geometry geometry = readInput(settings.input, progress);
  checkField(settings.look, geometry, laplacian_fields);
  requireLas(geometry, settings.write.formats, settings.input.name(), {});
  if (interrupted()) throw tufted::Cancelled("cancelled");
  tufted::WriteOptions& write = settings.write;
  const auto isWanted = [&write](tufted::Format format) {
    return std::find(write.formats.begin(), write.formats.end(), format) != write.formats.end();
  };
  const bool keep_cover = isWanted(tufted::Format::cover) || isWanted(tufted::Format::triangles);
  bar.follow({geometry, {}});
  const tufted::Laplacian laplacian = buildLaplacian(geometry, settings.input, settings.build, keep_cover, progress);
  write.source = settings.input.name();
  if (settings.input.chosen.of > 0)
    write.selection =
        settings.input.chosen.json().dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  write.progress = progress;
  if (geometry.is_mesh)
    write.mesh = &settings.build.mesh;
  else
    write.cloud = &settings.build.cloud;
  const std::string title = "laplacian: " + std::filesystem::path(settings.input.name()).filename().string();
  writeAndShow(
      settings.look, geometry, [&] { return sceneOf(title, geometry, laplacian, {}); },
      [&] { tufted::writeLaplacian(settings.out, laplacian, geometry, write); });
  bar.clear();
  const std::vector<std::string> warnings =
      warningsOf(settings.input.name(), geometry, tufted::warnings(laplacian.report));
  for (const std::string& warning : warnings) warn(bar, warning);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  sayResults(settings.console, summarize(settings, geometry, laplacian, seconds.count()), settings.out, warnings);
  return exit_done;
}

}  // namespace
}  // namespace laplacian_command

void addLaplacian(CLI::App& app, Run& run) {
  using namespace laplacian_command;
  CLI::App& command = *app.add_subcommand("laplacian", description);
  command.footer(footer);
  const auto settings = std::make_shared<Settings>();
  addInput(command, settings->input);
  addWeld(command, settings->input);
  addOut(command, settings->out);
  addWriteOptions(command, settings->write);
  command.option_defaults()->group("Building the Laplacian");
  addBuildOptions(command, settings->build);
  command.option_defaults()->group("Picture and page of the result");
  addLookOptions(command, settings->look);
  addVerboseConsole(command, settings->console);
  command.option_defaults()->group("Clouds that are larger than memory");
  addTiled(command, settings->tiled);
  command.callback([&run, &command, settings] {
    settings->inputs = inputsOf(command);
    checkTiled(command, settings->tiled);
    checkSeed(settings->build);
    run = [=] { return runLaplacian(*settings); };
  });
}
