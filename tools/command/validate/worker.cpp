#include "worker.h"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <limits>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "../interrupt.h"
#include "../options.h"
#include "../peak_memory.h"
#include "../structure.h"
#include "../warnings.h"
#include "tufted/check.h"
#include "tufted/errors.h"
#include "tufted/io/results.h"

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* name = "validate-file";

/// Never outlives the command that asked, however that ends.
void dieWithTheCommand(int command) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != command) throw tufted::Cancelled("cancelled");  // it has ended before
}

/// After so many seconds the process ends by SIGALRM.
void limitTime(double seconds) {
  const auto whole = static_cast<time_t>(seconds);
  const itimerval timer = {{0, 0}, {whole, static_cast<suseconds_t>(1e6 * (seconds - static_cast<double>(whole)))}};
  setitimer(ITIMER_REAL, &timer, nullptr);
}

void limitMemory(int megabytes) {
#ifdef __SANITIZE_ADDRESS__
  throw tufted::InvalidInput("--memory: " + std::to_string(megabytes) + ", has no meaning under the address sanitizer");
#else
  // What the process allocates, and not its address space, which starts with that of the libraries.
  const rlim_t bytes = static_cast<rlim_t>(megabytes) << 20;
  const rlimit limit = {bytes, bytes};
  setrlimit(RLIMIT_DATA, &limit);
#endif
}

/// Measures the seconds since it was asked last.
class StopWatch {
 public:
  double lap() {
    const auto start = std::exchange(start_, Clock::now());
    return std::chrono::duration<double>(start_ - start).count();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// Builds the Laplacian as `tufted laplacian` does without options.
tufted::Laplacian build(const tufted::Geometry& geometry, int threads, const tufted::Progress& progress) {
  if (geometry.is_mesh)
    return tufted::meshLaplacian(geometry.points, geometry.triangles, {.threads = threads, .progress = progress});
  const std::optional<tufted::ScanStructure> structure = structureOf(geometry, structureFor(geometry), name);
  const tufted::ScanStructure* const by_pixels = structure ? &*structure : nullptr;
  return tufted::pointCloudLaplacian(geometry.points,
                                     {.threads = threads, .structure = by_pixels, .progress = progress});
}

Json coverObject(const tufted::CoverCheck& cover) {
  return {{"not_closed", cover.not_closed},
          {"not_edge_manifold", cover.not_edge_manifold},
          {"not_oriented", cover.not_oriented},
          {"unequal_lengths", cover.unequal_lengths},
          {"triangle_inequality", cover.triangle_inequality},
          {"not_delaunay", cover.not_delaunay},
          {"smallest_cotan_sum", cover.smallest_cotan_sum}};
}

void addSurface(Json& row, const tufted::SurfaceCheck& surface) {
  row.update({{"weight_error", surface.weight_error},
              {"area_error", surface.area_error},
              {"mass_error", surface.mass_error},
              {"masses_compared", surface.masses_compared},
              {"coarse_points", surface.coarse_points}});
}

void addFigures(Json& row, const tufted::LaplacianCheck& check, const tufted::Report& report) {
  row.update({{"active", check.status[0]},
              {"not_finite_points", check.status[1]},
              {"coincident", check.status[2]},
              {"isolated", check.status[3]},
              {"nonzeros_per_row", check.nonzeros_per_row},
              {"components", check.components},
              {"flips", report.flips},
              {"clamped_weights", report.clamped_weights + report.clamped_large},
              {"largest_clamped", report.largest_clamped},
              {"positive_off_diagonals", check.positive_off_diagonals},
              {"not_finite_entries", check.not_finite},
              {"not_positive_diagonals", check.not_positive_diagonals},
              {"negative_masses", check.negative_masses},
              {"zero_masses", check.zero_masses},
              {"inactive_not_zero", check.inactive_not_zero},
              {"symmetry_error", check.symmetry_error},
              {"row_sum_error", check.row_sum_error},
              {"definite", check.definite}});
  if (check.cover) row["cover"] = coverObject(*check.cover);
  row["recomputed"] = check.surface.has_value();
  if (check.surface) addSurface(row, *check.surface);
  row["not_checked"] = check.not_checked;
}

/// Reads a file and builds the Laplacian.
tufted::Laplacian buildFrom(const std::filesystem::path& file, const FileSettings& settings, Json& row,
                            std::string& stage) {
  StopWatch watch;
  stage = "read";
  const tufted::Geometry geometry = tufted::read(file, settings.as);
  row["seconds_read"] = watch.lap();
  if (!geometry.notes.empty()) row["warnings"] = geometry.notes;
  row["kind"] = geometry.is_mesh ? "mesh" : "cloud";
  row["points"] = geometry.points.rows();
  row["faces"] = geometry.triangles.rows();
  tufted::Laplacian laplacian = build(geometry, settings.threads, [&stage](std::string_view now, double) {
    stage = now;
    return true;
  });
  row["seconds_build"] = watch.lap();
  return laplacian;
}

/// Reads a Laplacian, whatever it holds.
tufted::Laplacian readFrom(const std::filesystem::path& folder, Json& row, std::string& stage) {
  StopWatch watch;
  stage = "read";
  tufted::Laplacian laplacian = tufted::readUncheckedLaplacian(folder);
  row["seconds_read"] = watch.lap();
  row["kind"] = laplacian.kind == tufted::Kind::mesh ? "mesh" : "cloud";
  row["points"] = laplacian.status.size();
  return laplacian;
}

/// Reads, builds and checks; `row` keeps what is known when this throws, and `stage` says where.
void validateFile(const Found& file, const FileSettings& settings, Json& row, std::string& stage) {
  const tufted::Laplacian laplacian =
      file.is_operator ? readFrom(file.path, row, stage) : buildFrom(file.path, settings, row, stage);
  stage = "check";
  StopWatch watch;
  const tufted::LaplacianCheck check = tufted::validate(laplacian);
  row["seconds_check"] = watch.lap();
  addFigures(row, check, laplacian.report);
  const std::string nothing = nothingActive(laplacian);
  row["result"] = !check.ok() ? "FAILED" : nothing.empty() ? "OK" : "EMPTY";
  row["reasons"] = check.faults;
  if (!nothing.empty()) row["reasons"].push_back(nothing);
}

int runValidateFile(const Found& file, const FileSettings& settings, int command) {
  dieWithTheCommand(command);
  releaseInterrupt();  // nothing is left behind, and the command tells how this process ended
  limitTime(settings.seconds);
  if (settings.memory) limitMemory(*settings.memory);
  Json row;
  std::string stage;
  const auto end = [&row, &file](const char* result, std::string reason) {
    const std::string path = file.path.string() + ": ";
    if (reason.starts_with(path)) reason.erase(0, path.size());  // the row has it already
    row["result"] = result;
    row["reasons"] = {std::move(reason)};
  };
  const std::string limit = settings.memory ? " (--memory " + std::to_string(*settings.memory) + ")" : "";
  try {
    validateFile(file, settings, row, stage);
  } catch (const tufted::FileTooLarge& error) {
    end("FAILED", error.what() + limit);
  } catch (const tufted::IoError& error) {
    end("REFUSED", error.what());
  } catch (const std::bad_alloc&) {
    end("FAILED", "out of memory" + limit + " in the stage " + stage);
  } catch (const std::exception& error) {
    end("FAILED", error.what());
  }
  row["memory_mb"] = peakMemory();
  // A path need not be UTF-8.
  const std::string line = row.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
  std::fputs(line.c_str(), stdout);
  return std::fflush(stdout) == 0 ? exit_done : exit_failed;
}

}  // namespace

std::vector<std::string> fileArguments(const Found& file, const FileSettings& settings) {
  const double seconds = settings.seconds > 0 ? std::max(1e-6, settings.seconds) : 0;  // to_string has six digits
  std::vector<std::string> arguments = {
      name, std::to_string(getpid()), "--threads", std::to_string(settings.threads), "--time", std::to_string(seconds)};
  if (settings.memory) arguments.insert(arguments.end(), {"--memory", std::to_string(*settings.memory)});
  for (const auto& [key, value] : kinds)
    if (value == settings.as) arguments.insert(arguments.end(), {"--as", key});
  if (file.is_operator) arguments.emplace_back("--operator");
  arguments.insert(arguments.end(), {"--", file.path.string()});
  return arguments;
}

void addValidateFile(CLI::App& app, Run& run) {
  CLI::App& command = *app.add_subcommand(name, "One file of validate, in a process of its own");
  command.group("");  // not in the help
  const auto file = std::make_shared<Found>();
  const auto settings = std::make_shared<FileSettings>();
  const auto parent = std::make_shared<int>(0);
  command.add_option("COMMAND", *parent)->required();
  command.add_option("FILE", file->path)->required();
  command.add_flag("--operator", file->is_operator);
  addNumber(command, "--threads", settings->threads, 1, 1 << 16, "");
  addNumber(command, "--time", settings->seconds, 0.0, most_seconds, "");
  addNumber(command, "--memory", settings->memory, 1, std::numeric_limits<int>::max(), "");
  addChoice(command, "--as", settings->as, kinds, "");
  command.callback(
      [&run, file, settings, parent] { run = [=] { return runValidateFile(*file, *settings, *parent); }; });
}
