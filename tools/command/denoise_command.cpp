#include <CLI/CLI.hpp>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.h"
#include "console.h"
#include "input.h"
#include "interrupt.h"
#include "look.h"
#include "options.h"
#include "output.h"
#include "progress_bar.h"
#include "scene_fields.h"
#include "structure.h"
#include "tufted/denoise.h"
#include "tufted/errors.h"
#include "tufted/io/results.h"
#include "tufted/io/write.h"
#include "tufted/version.h"
#include "warnings.h"

namespace denoise_command {
namespace {

constexpr const char* description = "Move the points of a noisy scan onto the surface.";

constexpr const char* footer =
    R"(Examples:
  tufted denoise scan.ply --out clean
  tufted denoise scan.ply --out clean --png noise.png

There is no radius to choose: the size of the fitted neighbourhoods follows from the noise around each point and the
curvature of the surface. Exact points, outliers, and noise that cannot be distinguished from shape stay bit for bit.
An organized cloud that a pinhole camera saw from the VIEWPOINT of FILE is a depth image, and with --structure image
every organized cloud is one. The points of a depth image move along the rays of its camera. How the noise grows with
the distance follows from the image: quadratically for stereo and structured light, hardly for time of flight, or in
between.
All subcommands that build L and M move noisy points in the same way, with --preset clean only if --denoise is given.

Files in DIR, which replace older ones when all are complete:
  positions.npy  N x 3, float64, in the order of FILE
  noise.npy      N, float64: standard deviation of the noise around each moved point, along the normal (for depth images
                 along the ray), in the unit of FILE; 0 at other points
  points.ply     the moved points with the fields of FILE, without normals, and noise, float32; points.pcd with
                 --format pcd
  report.json    number of moved points and of outliers, noise, mean and largest displacement, seconds)";

/// Bytes per point that this command takes at least: 150 of an exact sphere of a million points.
constexpr double least_bytes = 150;
/// The values of --structure here, without rings.
const std::map<std::string, Structure> image_structures = {
    {"automatic", Structure::automatic}, {"none", Structure::none}, {"image", Structure::image}};

struct Settings {
  Input input;
  std::filesystem::path out;
  std::vector<tufted::Format> copies = {tufted::Format::ply};
  Structure structure = Structure::automatic;
  int threads = 0;
  Console console;
  Look look;
  std::vector<NamedInput> inputs;
};

int runDenoise(Settings& settings) {
  const std::vector<std::string> arrays = {"positions", "noise"};
  std::vector<std::string> files = tufted::resultFiles({}, {.copies = settings.copies});
  for (const std::string& name : arrays) files.push_back(name + ".npy");
  checkLook(settings.look, settings.out, settings.inputs);
  checkOutput(settings.inputs, settings.out, files);
  ProgressBar bar(settings.console.quiet);
  const tufted::Progress progress = showOn(bar);
  progress("read", 0);
  refuseTooMany(settings.input, least_bytes);
  tufted::Geometry geometry = readInput(settings.input, progress);
  if (geometry.is_mesh) throw tufted::IoError(settings.input.name() + ": is a mesh; --as cloud takes its points alone");
  checkField(settings.look, geometry, {{"noise"}}, false);
  requireLas(geometry, settings.copies, settings.input.name(), {{"noise"}});
  if (interrupted()) throw tufted::Cancelled("cancelled");
  bar.follow(Plan(denoiseStages(geometry)));
  const std::string doubt = doubtOf(geometry, settings.structure);
  if (settings.structure == Structure::automatic) settings.structure = structureFor(geometry);
  const auto scan = structureOf(geometry, settings.structure, settings.input.name());
  const tufted::DenoisedPoints denoised = tufted::denoise(
      geometry.points, {.structure = scan ? &*scan : nullptr, .threads = settings.threads, .progress = progress});
  geometry.points = denoised.positions;
  geometry.normals.resize(0, 3);  // those of the file belong to the old positions

  const tufted::DenoiseReport& done = denoised.report;
  nlohmann::ordered_json json = {{"tufted", TUFTED_VERSION}, {"command", "denoise"}, {"source", settings.input.name()}};
  if (settings.input.chosen.of > 0) json["selection"] = settings.input.chosen.json();
  json["structure"] = nameOf(settings.structure);
  json["report"] = nlohmann::ordered_json::parse(toJson(done));
  const std::vector<tufted::ResultArray> results = {
      {.name = "positions", .values = denoised.positions, .per_point = false},
      {.name = "noise", .values = denoised.noise}};
  tufted::ResultOptions options = {.copies = settings.copies, .progress = progress};
  options.report = textOf(json);
  const tufted::Laplacian none;
  const std::string title = "denoise: " + std::filesystem::path(settings.input.name()).filename().string();
  writeAndShow(
      settings.look, geometry, [&] { return sceneOf(title, geometry, none, {results.back()}); },
      [&] { tufted::writeResults(settings.out, none, geometry, results, options); });
  bar.clear();

  Summary summary;
  addMerged(geometry, settings.input, summary);
  summary.add("points", "%lld, %lld moved, %lld outliers, %lld on no surface", static_cast<long long>(done.points),
              static_cast<long long>(done.moved), static_cast<long long>(done.outliers),
              static_cast<long long>(done.no_surface));
  if (done.moved > 0) {
    summary.add("noise", "%.4g, standard deviation along the %s", done.noise,
                scan ? "rays of a depth image" : "normal");
    summary.add("way", "of the moved points %.4g in the mean, by %.4g at most", done.mean_move, done.farthest_move);
  } else {
    summary.add("noise", "none that can be told from the shape of the surface%s",
                scan ? ", by the pixels of a depth image" : "");
  }
  if (!doubt.empty()) summary.add("rays", "%s", doubt.c_str());
  addEnd(done.seconds, settings.out, summary);
  addLook(settings.look, summary);
  const std::vector<std::string> warnings = warningsOf(settings.input.name(), geometry, tufted::warnings(done));
  for (const std::string& line : warnings) warn(bar, line);
  sayResults(settings.console, summary, settings.out, warnings);
  return exit_done;
}

}  // namespace
}  // namespace denoise_command

void addDenoise(CLI::App& app, Run& run) {
  using namespace denoise_command;
  CLI::App& command = *app.add_subcommand("denoise", description);
  command.footer(footer);
  const auto settings = std::make_shared<Settings>();
  addInput(command, settings->input);
  addOut(command, settings->out);
  addCopies(command, settings->copies);
  addChoice(
      command, "--structure", settings->structure, image_structures,
      "Treat the cloud as a depth image, or not (automatic: if a pinhole camera saw it from the VIEWPOINT of FILE)");
  addNumber(command, "--threads N", settings->threads, 1, 1 << 16, "Maximum number of threads (one per processor)");
  addLookOptions(command, settings->look);
  addConsole(command, settings->console);
  command.callback([&run, &command, settings] {
    settings->inputs = inputsOf(command);
    run = [settings] { return runDenoise(*settings); };
  });
}
