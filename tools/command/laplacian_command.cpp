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
#include "peak_memory.h"
#include "progress_bar.h"
#include "scene_fields.h"
#include "summary.h"
#include "tufted/errors.h"
#include "tufted/io/read.h"
#include "tufted/io/write.h"
#include "tufted/laplacian.h"
#include "warnings.h"

namespace laplacian_command {
namespace {

constexpr const char* description = "Build L and M for a point cloud or a mesh and write them into a directory.";

constexpr const char* footer = R"(Examples:
  tufted laplacian scan.ply --out laplacian
  tufted laplacian mesh.off --format npz,mat --out laplacian

Sign and scale:
  L is positive semidefinite: minus the Laplacian, integrated. libigl and PMP use the opposite sign.
  M holds an area per point in length^2; their sum approximates the surface area.
  Scale on clouds: 1/2 (front and back of the cover) times 1/3 (each triangle is found by its three corners).
  Scale on meshes: 1/2 (front and back of the cover).
  Poisson L u = M f, eigenproblem L x = lambda M x.
  Points that cannot take part keep their index, with zero row, column and mass; their status says why.
  --sign igl negates L: negative semidefinite, as in libigl and PMP; then -L u = M f and -L x = lambda M x.
  --dummy gives those points 1 (-1 with --sign igl) on the diagonal of L and, in M, a thousandth of the smallest
  positive mass.

Presets of clouds:
  clean  exact samples: the paper's steps and no others
  scan   depth images, laser scans, photogrammetry: noise, jumps, outliers, near sheets. Noisy points are moved onto the
         surface first, stars agree on the diagonals of grids, and M is measured in a point's own star at rims.
  lidar  the same from a spinning scanner, whose rings would be taken for sheets

Structures of scans:
  automatic  image for an organized cloud that a pinhole camera saw from the file's viewpoint, unless --neighbors or
             --preset lidar is given; else none
  none   the nearest points in space
  image  the pixels around the point, none behind a depth jump; noise is smoothed along the rays of the camera, however
         strong it is. The cloud must be organized (PCD, or PLY with obj_info num_cols)
  rings  they lie on the rings beside the point, however far apart those are: by the field `ring`, or else by the
         elevations seen from the file's viewpoint, which must show rings; and by the field `azimuth` in radians,
         degrees or hundredths of degrees (the first whose turn, 6.28, 360 or 36000, holds all values), or else by the
         directions seen from there

Reads PCD, PLY, LAS, text in columns and NPY of N x 3 numbers or more (clouds), PLY, OBJ, OFF, STL and VTK's legacy
polygonal data (meshes; OBJ, OFF and VTK without faces are clouds).
The format goes by the extension, .pcd .ply .las .xyz .xyzn .pwn .txt .csv .asc .pts .obj .off .coff .noff .stl .npy .vtk,
and where that is unknown by the content. Normals of a file are used for L and M with --normals alone; points.ply and
points.pcd pass them on.

Writes into DIR, renamed one after the other when all are complete; other files there stay, and are no part of it:
  report.json         what happened, with options, sign and scale, and which files are of this result
  measured_positions.npy
                      N x 3: where lengths are measured, noisy points of a cloud put back onto the surface
  components.npy      the connected component of each point, 0 has the most points; -1: takes no part
  --format npz
  L.npz               sparse matrix, scipy.sparse.load_npz
  M.npy               areas
  status.npy          0 active, 1 not finite, 2 coincident, 3 isolated
  representative.npy  the point that stands for a coincident one, counted from 0
  boundary.npy        0, or why the surface ends there: 1 rim (the sampling ends), 2 jump (another surface lies
                      beyond; of organized clouds and those with a VIEWPOINT as seen from there), 3 lost (triangles
                      of the surface are missing)
  frames.npy          N x 3 x 3: of each point the x axis, the y axis and the normal; none for meshes
  noise.npy           the noise around each point that was moved, a standard deviation; 0 elsewhere, empty if none was
  component_edges.npy for each component: sides of triangles, their mean length, their mean squared length
  --format mtx
  L.mtx, M.mtx        Matrix Market: lower triangle of a symmetric matrix, N x 1 array
  --format mat
  laplacian.mat       MATLAB: L, M, status, representative, boundary, conventions
  --format spmat
  L.spmat, M.spmat    a line `row column value` per entry, counted from 1; M as a diagonal matrix
  --format ply
  points.ply          the points with mass, boundary, status and representative as fields
  --format pcd
  points.pcd          the same, for PCL
  --format cover
  cover.npz           the triangles of the tufted cover by corners, gluing and lengths, which `tufted distance
                      --operator` needs; three times as large as all of npz, so only on request
  --format triangles
  triangles.ply       triangles to look at, at the measured positions: of a cloud those of its surface, oriented alike,
                      one or two at each edge; of a mesh its own)";

struct Settings {
  Input input;
  std::filesystem::path out;
  Build build;
  tufted::WriteOptions write;
  Console console;
  Look look;
  std::vector<NamedInput> inputs;
};

const std::map<std::string, tufted::Format> formats = {
    {"npz", tufted::Format::npz},     {"mtx", tufted::Format::mtx},
    {"mat", tufted::Format::mat},     {"spmat", tufted::Format::spmat},
    {"ply", tufted::Format::ply},     {"pcd", tufted::Format::pcd},
    {"cover", tufted::Format::cover}, {"triangles", tufted::Format::triangles}};
const std::map<std::string, tufted::Sign> signs = {{"psd", tufted::Sign::psd}, {"igl", tufted::Sign::igl}};

/// Adds the options that say what is written, and how.
void addWriteOptions(CLI::App& command, tufted::WriteOptions& options) {
  addFormats(command, options.formats, formats,
             "Formats, separated by commas: npz, mtx, mat, spmat, ply, pcd, cover, triangles, or none (npz,ply)");
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
  addMerged(geometry, summary);
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
  summary.add("took", "%.3g s, peak memory %.0f MB", seconds, peakMemory());
  summary.add("written to", "%s", settings.out.c_str());
  addLook(settings.look, summary);
  return summary;
}

int runLaplacian(Settings& settings) {
  const auto start = std::chrono::steady_clock::now();
  checkLook(settings.look, settings.out, settings.inputs);
  checkOutput(settings.inputs, settings.out, tufted::resultFiles(settings.write.formats));
  ProgressBar bar(settings.console.quiet);
  const tufted::Progress progress = showOn(bar);
  progress("read", 0);
  tufted::Geometry geometry = readInput(settings.input, progress);
  checkField(settings.look, geometry, laplacian_fields);
  if (interrupted()) throw tufted::Cancelled("cancelled");
  tufted::WriteOptions& write = settings.write;
  const auto isWanted = [&write](tufted::Format format) {
    return std::find(write.formats.begin(), write.formats.end(), format) != write.formats.end();
  };
  const bool keep_cover = isWanted(tufted::Format::cover) || isWanted(tufted::Format::triangles);
  bar.setPoints(geometry.points.rows());
  const tufted::Laplacian laplacian = buildLaplacian(geometry, settings.input, settings.build, keep_cover, progress);
  bar.setPoints(0);
  write.source = settings.input.name();
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
  std::vector<std::string> warnings = geometry.notes;
  for (const std::string& line : warningsOf(settings.input.name(), laplacian.report)) warnings.push_back(line);
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
  command.callback([&run, &command, settings] {
    settings->inputs = inputsOf(command);
    checkSeed(settings->build);
    run = [=] { return runLaplacian(*settings); };
  });
}
