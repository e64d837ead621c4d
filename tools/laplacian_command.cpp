#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <type_traits>
#include <vector>

#include "command.h"
#include "interrupt.h"
#include "progress_bar.h"
#include "tufted/errors.h"
#include "tufted/io/read.h"
#include "tufted/io/write.h"
#include "tufted/laplacian.h"

namespace {

constexpr const char* description = "Build L and M for a point cloud or a mesh and write them into a directory.";

constexpr const char* footer = R"(Sign and scale:
  L is positive semidefinite: minus the Laplacian, integrated. libigl and PMP use the opposite sign.
  M holds an area per point in length^2; their sum approximates the surface area.
  Scale on clouds: 1/2 (front and back of the cover) times 1/3 (each triangle is found by its three corners).
  Scale on meshes: 1/2 (front and back of the cover).
  Poisson L u = M f, eigenproblem L x = lambda M x.
  Points that cannot take part keep their index, with zero row, column and mass; status.npy says why.

Reads .pcd .ply .xyz .xyzn .pwn .txt .csv .asc .pts (clouds), .ply .obj .off .stl (meshes).
The normals of a file are not used for L and M; points.ply passes them on.

Writes into DIR, renamed one after the other when all are complete:
  L.npz               sparse matrix, scipy.sparse.load_npz
  M.npy               areas
  status.npy          0 active, 1 not finite, 2 coincident, 3 isolated
  representative.npy  the point that stands for a coincident one
  boundary.npy        1 where the surface ends
  report.json         what happened, with options, sign and scale
  points.ply          the points with mass, boundary, status and representative as fields)";

struct Settings {
  std::filesystem::path file;
  std::filesystem::path out;
  tufted::ReadAs as = tufted::ReadAs::automatic;
  tufted::CloudOptions cloud;
  std::optional<double> mollify;  ///< the default of clouds or of meshes
};

const std::map<std::string, tufted::Gluing> gluings = {{"star", tufted::Gluing::star},
                                                       {"vertex-pair", tufted::Gluing::vertex_pair}};
const std::map<std::string, tufted::FaceOrder> orders = {
    {"angle", tufted::FaceOrder::angle}, {"area", tufted::FaceOrder::area}, {"random", tufted::FaceOrder::random}};
const std::map<std::string, tufted::Delaunay> backends = {{"star", tufted::Delaunay::star},
                                                          {"cgal", tufted::Delaunay::cgal}};
const std::map<std::string, tufted::ReadAs> kinds = {{"cloud", tufted::ReadAs::cloud}, {"mesh", tufted::ReadAs::mesh}};

/// An option that takes one of the names in `values`.
template <class T>
CLI::Option* addChoice(CLI::App& app, const std::string& name, T& target, const std::map<std::string, T>& values,
                       const std::string& help) {
  std::string names;
  for (const auto& [key, value] : values) names += (names.empty() ? "" : "|") + key;
  const auto set = [&target, &values](const std::string& key) { target = values.at(key); };
  const auto check = [&values, names](const std::string& key) {
    return values.count(key) > 0 ? std::string() : key + " is none of " + names;
  };
  return app.add_option_function<std::string>(name, set, help)->check(check)->type_name(names);
}

std::string notEmpty(const std::string& path) {
  return path.empty() ? "must not be empty" : "";
}

/// An option that takes a number in [least, most].
template <class T, class Target>
CLI::Option* addNumber(CLI::App& app, const std::string& name, Target& target, T least, T most,
                       const std::string& help) {
  const auto parse = [least, most](const std::string& text) -> std::optional<T> {
    T value = {};
    const char* const text_end = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), text_end, value);
    const bool valid = error == std::errc() && end == text_end && value >= least && value <= most;
    return valid ? std::optional<T>(value) : std::nullopt;
  };
  const auto check = [parse, least, most](const std::string& text) {
    if (parse(text)) return std::string();
    std::ostringstream message;
    message << text << " is not " << (std::is_integral_v<T> ? "an integer" : "a number") << " in [" << least << ", "
            << most << ']';
    return message.str();
  };
  const auto set = [&target, parse](const std::string& text) { target = parse(text).value(); };
  return app.add_option_function<std::string>(name, set, help)->check(check);
}

/// Refuses what no build can be written to.
void checkOutput(const Settings& settings) {
  std::error_code error;
  for (const char* name : tufted::result_files)
    if (std::filesystem::equivalent(settings.file, settings.out / name, error))
      throw tufted::InvalidInput(settings.file.string() + ": is the input, and --out " + settings.out.string() +
                                 " would overwrite it");
  const auto status = std::filesystem::status(settings.out, error);
  if (status.type() == std::filesystem::file_type::not_found) return;
  if (error) throw tufted::IoError(settings.out.string() + ": " + error.message());
  if (!std::filesystem::is_directory(status)) throw tufted::IoError(settings.out.string() + ": is not a directory");
}

/// Options that have no meaning for a mesh.
void refuseCloudOptions(const Settings& settings, const std::vector<CLI::Option*>& options) {
  for (const CLI::Option* option : options)
    if (option->count() > 0)
      throw tufted::InvalidInput(option->get_name() + " applies to point clouds, and " + settings.file.string() +
                                 " holds a mesh (--as cloud takes its vertices alone)");
}

tufted::MeshOptions meshOptions(const tufted::CloudOptions& cloud) {
  return {.order = cloud.order, .seed = cloud.seed, .threads = cloud.threads, .progress = cloud.progress};
}

/// Peak memory of this process in MB.
double peakMemory() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;  // Linux counts in KB
}

void printSummary(const Settings& settings, const tufted::Geometry& geometry, const tufted::Laplacian& laplacian,
                  double seconds) {
  const tufted::Report& report = laplacian.report;
  const auto count = [](std::int64_t n) { return static_cast<long long>(n); };
  std::printf("%-15s %s (%s)\n", "file", settings.file.c_str(), geometry.is_mesh ? "mesh" : "cloud");
  if (geometry.polygons > 0) std::printf("%-15s %lld triangulated\n", "polygons", count(geometry.polygons));
  if (geometry.merged_vertices > 0)
    std::printf("%-15s %lld equal corners\n", "merged", count(geometry.merged_vertices));
  std::printf("%-15s %lld, %lld active, %lld not finite, %lld coincident, %lld isolated\n", "points",
              count(report.points), count(report.active), count(report.not_finite), count(report.coincident),
              count(report.isolated));
  std::printf("%-15s %lld\n", "triangles", count(report.triangles));
  std::printf("%-15s %.2f\n", "nonzeros/row",
              static_cast<double>(report.nonzeros) / static_cast<double>(std::max<std::int64_t>(report.active, 1)));
  std::printf("%-15s %lld\n", "components", count(report.components));
  std::printf("%-15s %.17g\n", "sum of M", laplacian.M.sum());
  std::printf("%-15s %lld\n", "flips", count(report.flips));
  std::printf("%-15s %lld weights\n", "clamped", count(report.clamped_weights + report.clamped_large));
  if (report.flip_failures + report.clamped_large > 0)
    std::printf("%-15s %lld edges not flipped, %lld large weights clamped\n", "failures", count(report.flip_failures),
                count(report.clamped_large));
  std::printf("%-15s %.3g s, peak memory %.0f MB\n", "took", seconds, peakMemory());
  std::printf("%-15s %s\n", "written to", settings.out.c_str());
  if (std::fflush(stdout) != 0) throw tufted::IoError("standard output: cannot write the summary");
}

int runLaplacian(Settings settings, const std::vector<CLI::Option*>& cloud_only) {
  const auto start = std::chrono::steady_clock::now();
  checkOutput(settings);
  ProgressBar bar;
  const tufted::Progress progress = [&bar](std::string_view stage, double fraction) {
    bar.show(stage, fraction);
    return !interrupted();
  };
  progress("read", 0);
  const tufted::Geometry geometry = tufted::read(settings.file, settings.as);
  if (interrupted()) throw tufted::Cancelled("cancelled");
  if (geometry.is_mesh) refuseCloudOptions(settings, cloud_only);

  settings.cloud.progress = progress;
  settings.cloud.keep_cover = false;
  tufted::MeshOptions mesh = meshOptions(settings.cloud);
  if (settings.mollify) settings.cloud.mollify = mesh.mollify = *settings.mollify;
  const tufted::Laplacian laplacian = geometry.is_mesh
                                          ? tufted::meshLaplacian(geometry.points, geometry.triangles, mesh)
                                          : tufted::pointCloudLaplacian(geometry.points, settings.cloud);
  tufted::WriteOptions write = {.source = settings.file.string(), .progress = progress};
  if (geometry.is_mesh)
    write.mesh = &mesh;
  else
    write.cloud = &settings.cloud;
  tufted::writeLaplacian(settings.out, laplacian, geometry, write);
  bar.clear();
  printSummary(settings, geometry, laplacian,
               std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  return exit_done;
}

}  // namespace

void addLaplacian(CLI::App& app, Run& run) {
  CLI::App& command = *app.add_subcommand("laplacian", description);
  command.footer(footer);
  const auto settings = std::make_shared<Settings>();
  tufted::CloudOptions& options = settings->cloud;
  command.add_option("FILE", settings->file, "Points or mesh")->required()->check(notEmpty);
  command.add_option("--out", settings->out, "Directory for the results, made if missing")
      ->required()
      ->check(notEmpty)
      ->type_name("DIR");
  const std::vector<CLI::Option*> cloud_only = {
      addNumber(command, "--neighbors", options.neighbors, 3, std::numeric_limits<int>::max(),
                "Neighbours per point, clouds only (30)")
          ->type_name("K"),
      addChoice(command, "--gluing", options.gluing, gluings, "How the stars are glued, clouds only (star)"),
      addChoice(command, "--delaunay", options.delaunay, backends, "Who finds the stars, clouds only (star)")};
  addChoice(command, "--order", options.order, orders, "Order of the faces around an edge (angle)");
  const CLI::Option* const seed =
      addNumber(command, "--seed", options.seed, std::uint64_t(0), std::numeric_limits<std::uint64_t>::max(),
                "Seed, only with --order random (0)")
          ->type_name("S");
  addNumber(command, "--mollify", settings->mollify, 0.0, 1.0,
            "Mollification in mean edge lengths, at most 1 (1e-5 clouds, 1e-4 meshes)")
      ->type_name("D");
  addNumber(command, "--threads", options.threads, 1, 1 << 16, "At most this many threads (all)")->type_name("N");
  addChoice(command, "--as", settings->as, kinds, "Take a file that may be either as one of them");
  command.callback([&run, settings, cloud_only, seed] {
    if (seed->count() > 0 && settings->cloud.order != tufted::FaceOrder::random)
      throw CLI::RequiresError("--seed", "--order random");
    run = [=] { return runLaplacian(*settings, cloud_only); };
  });
}
