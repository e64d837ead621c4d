#include "one_file.h"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/time.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "../command.h"
#include "../console.h"
#include "../interrupt.h"
#include "../structure.h"
#include "../warnings.h"
#include "tufted/check.h"
#include "tufted/errors.h"
#include "tufted/io/results.h"

namespace {

using Json = nlohmann::ordered_json;

void limitTime(double seconds) {
  if (seconds > 0) seconds = std::max(seconds, 1e-6);  // the timer counts in microseconds, and 0 means no limit
  const auto whole = static_cast<time_t>(seconds);
  const itimerval timer = {{0, 0}, {whole, static_cast<suseconds_t>(1e6 * (seconds - static_cast<double>(whole)))}};
  setitimer(ITIMER_REAL, &timer, nullptr);
}

void limitMemory(int megabytes) {
#ifdef __SANITIZE_ADDRESS__
  throw tufted::InvalidInput("--memory: " + std::to_string(megabytes) + ", has no meaning under the address sanitizer");
#else
  // Limits what the process allocates, not its address space, which includes that of the libraries.
  const rlim_t bytes = static_cast<rlim_t>(megabytes) << 20;
  const rlimit limit = {bytes, bytes};
  setrlimit(RLIMIT_DATA, &limit);
#endif
}

Json figuresOf(const tufted::LaplacianCheck& check, const tufted::Report& report) {
  Json row = {{"active", check.status[0]},
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
              {"definite", check.definite},
              {"recomputed", check.surface.has_value()},
              {"not_checked", check.not_checked}};
  if (check.cover)
    row["cover"] = {{"not_closed", check.cover->not_closed},
                    {"not_edge_manifold", check.cover->not_edge_manifold},
                    {"not_oriented", check.cover->not_oriented},
                    {"unequal_lengths", check.cover->unequal_lengths},
                    {"triangle_inequality", check.cover->triangle_inequality},
                    {"not_delaunay", check.cover->not_delaunay},
                    {"smallest_cotan_sum", check.cover->smallest_cotan_sum}};
  if (check.surface)
    row.update({{"weight_error", check.surface->weight_error},
                {"area_error", check.surface->area_error},
                {"mass_error", check.surface->mass_error},
                {"masses_compared", check.surface->masses_compared},
                {"coarse_points", check.surface->coarse_points}});
  return row;
}

/// Reads a file. @throws IoError also if points cannot be chosen, as the file is to blame: it may be one of many
tufted::Geometry readFor(Input& input) {
  try {
    return readInput(input, {});
  } catch (const tufted::InvalidInput& error) {
    throw tufted::IoError(error.what());
  }
}

/// Reads a file and builds its Laplacian as `tufted laplacian` does without options.
/// @param[out] stage name of the current step, for messages of exceptions
tufted::Laplacian buildFrom(const OneFile& file, Json& row, std::string& stage) {
  Input input = {.file = file.path, .as = file.as, .chosen = file.chosen};
  const tufted::Geometry geometry = readFor(input);
  const std::vector<std::string> warnings = warningsOf(file.path.string(), geometry);
  if (!warnings.empty()) row["warnings"] = warnings;
  if (input.chosen.of > 0) row["selection"] = input.chosen.json();
  row["faces"] = geometry.triangles.rows();
  const tufted::Progress progress = [&stage](std::string_view now, double) {
    stage = now;
    return true;
  };
  if (geometry.is_mesh)
    return tufted::meshLaplacian(geometry.points, geometry.triangles, {.threads = file.threads, .progress = progress});
  const std::optional<tufted::ScanStructure> structure = structureOf(geometry, structureFor(geometry), "validate");
  return tufted::pointCloudLaplacian(
      geometry.points, {.threads = file.threads, .structure = structure ? &*structure : nullptr, .progress = progress});
}

void judgeInto(const OneFile& file, Json& row, std::string& stage) {
  const tufted::Laplacian laplacian =
      file.is_operator ? tufted::readUncheckedLaplacian(file.path) : buildFrom(file, row, stage);
  row["kind"] = laplacian.kind == tufted::Kind::mesh ? "mesh" : "cloud";
  row["points"] = laplacian.status.size();
  stage = "check";
  const tufted::LaplacianCheck check = tufted::validate(laplacian);
  row.update(figuresOf(check, laplacian.report));
  const std::string nothing = nothingActive(laplacian);
  for (const std::string& line : tufted::warnings(laplacian.report))
    if (nothing.empty()) row["warnings"].push_back(file.path.string() + ": " + line);
  row["result"] = !check.ok() ? "FAILED" : nothing.empty() ? "OK" : "EMPTY";
  row["reasons"] = check.faults;
  if (!nothing.empty()) row["reasons"].push_back(nothing);
}

}  // namespace

int judge(const OneFile& file) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // ends this process with the one that started it
  releaseInterrupt();
  limitTime(file.seconds);
  if (file.memory) limitMemory(*file.memory);
  Json row;
  std::string stage = "read";
  const auto end = [&row, &file](const char* result, std::string reason) {
    const std::string path = file.path.string() + ": ";
    if (reason.starts_with(path)) reason.erase(0, path.size());  // the table shows the name of the file itself
    row["result"] = result;
    row["reasons"] = {std::move(reason)};
  };
  const std::string limit = file.memory ? " (--memory " + std::to_string(*file.memory) + ")" : "";
  try {
    judgeInto(file, row, stage);
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
  std::puts(row.dump(-1, ' ', false, Json::error_handler_t::replace).c_str());  // paths need not be UTF-8
  return std::fflush(stdout) == 0 ? exit_done : exit_failed;
}
