// The command for clouds that several processes share: `mpirun -n 4 tufted-mpi SUBCOMMAND FILE --out DIR`.
#include <slepc.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "../bytes.h"
#include "../options.h"
#include "../paths.h"
#include "subcommands.h"
#include "tufted/errors.h"
#include "tufted/io/tiles.h"
#include "tufted/io/write.h"
#include "tufted/version.h"

namespace {

constexpr const char* footer =
    R"(Examples:
  mpirun -n 4 tufted-mpi spectrum survey.las --count 20 --out modes
  mpirun -n 4 tufted-mpi distance survey.las --source 0,17 --out distances
  mpirun -n 4 tufted-mpi poisson survey.las --coordinate z --out solution -ksp_monitor
  srun tufted-mpi laplacian survey.las --memory 8G --out matrices

No process holds all points: each reads the file in passes, keeps the points in a file without a name beside DIR or in it, and
builds its own part of L, with the preset `clean`, which does not move noisy points.

Words such as -ksp_type and -eps_tol, with a single dash, are options of PETSc and SLEPc; give them behind FILE. All
processes must see FILE and DIR. `mpirun -q` leaves out what mpirun says about a process that fails.
Exit codes: 0 done, 1 the data or the numerics do not allow it, 2 the command line is wrong.)";

enum ExitCode : int { exit_done = 0, exit_failed = 1, exit_usage = 2 };

struct Settings {
  std::filesystem::path file, out;
  tufted::ReadAs as = tufted::ReadAs::automatic;
  tufted::TileOptions tiles;
};

int processNumber() {
  int number = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &number);
  return number;
}

/// Makes process 0 do something. Its error ends all processes, with one message.
void inProcess0(const std::function<void()>& work) {
  if (processNumber() == 0) work();
  MPI_Barrier(PETSC_COMM_WORLD);
}

/// A folder, or the nearest one above it that exists.
std::filesystem::path existingFolder(const std::filesystem::path& folder) {
  std::filesystem::path existing = std::filesystem::absolute(folder);
  while (!std::filesystem::is_directory(existing) && existing.has_relative_path()) existing = existing.parent_path();
  return existing;
}

/// Options of PETSc in the command line, with their values; they are taken out of the words.
std::vector<std::string> takePetscOptions(std::vector<std::string>& words) {
  const auto isOption = [](const std::string& word) {
    return word.size() > 2 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1])) != 0;
  };
  std::vector<std::string> options, others;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (!isOption(words[i])) {
      others.push_back(words[i]);
      continue;
    }
    options.push_back(words[i]);
    if (i + 1 < words.size() && !isOption(words[i + 1]) && !words[i + 1].starts_with("--"))
      options.push_back(words[++i]);
  }
  words = others;
  return options;
}

/// Prints a warning, in process 0.
void warn(const std::string& text) {
  if (processNumber() == 0) std::fprintf(stderr, "tufted-mpi: warning: %s\n", text.c_str());
}

/// Warns of options that PETSc did not ask for.
void warnUnused() {
  PetscInt count = 0;
  char** names = nullptr;
  char** values = nullptr;
  PetscOptionsLeftGet(nullptr, &count, &names, &values);
  for (PetscInt i = 0; i < count; ++i) warn("nothing has used the option -" + std::string(names[i]));
  PetscOptionsLeftRestore(nullptr, &count, &names, &values);
}

nlohmann::ordered_json reportOf(const Settings& settings, const tufted::TileReport& report) {
  int processes = 0;
  MPI_Comm_size(PETSC_COMM_WORLD, &processes);
  return {{"tufted", TUFTED_VERSION},
          {"source", settings.file.string()},
          {"processes", processes},
          {"neighbors", settings.tiles.cloud.neighbors},
          {"points", report.points},
          {"active", report.active},
          {"not_finite", report.not_finite},
          {"coincident", report.coincident},
          {"isolated", report.isolated},
          {"nonzeros", report.nonzeros},
          {"area", report.area},
          {"tiles", report.tiles},
          {"builds", report.builds},
          {"most_points", report.most_points}};
}

/// The command line.
class CommandLine {
 public:
  CommandLine() : app_("Laplacians of clouds, and systems with them, on the processes of MPI.", "tufted-mpi") {
    app_.set_version_flag("-V,--version", TUFTED_VERSION);
    app_.require_subcommand(1);
    app_.footer(footer);
    settings_.tiles.cloud = tufted::cloudOptions(tufted::Preset::clean);
    settings_.tiles.cloud.threads = 1;
    for (const auto& subcommand : subcommands_) add(*subcommand);
  }

  /// Parses the words, and returns an exit code if that is all there is to do.
  std::optional<int> parse(std::vector<std::string> words) {
    try {
      std::reverse(words.begin(), words.end());  // CLI11 expects them in reverse
      app_.parse(std::move(words));
    } catch (const CLI::Success& help) {
      return processNumber() == 0 ? app_.exit(help) : exit_done;
    } catch (const CLI::ParseError& error) {
      if (processNumber() == 0) std::fprintf(stderr, "tufted-mpi: %s; see tufted-mpi --help\n", error.what());
      return exit_usage;
    }
    return std::nullopt;
  }

  void run() {
    const auto start = std::chrono::steady_clock::now();
    tufted::FileSource source;
    const auto open = [&] { source = tufted::sourceOf(settings_.file, settings_.as); };
    inProcess0([&] {
      open();
      checkInputs(source.size);
    });
    if (processNumber() != 0) open();
    settings_.tiles.faces = chosen_->needsFaces();
    settings_.tiles.folder = existingFolder(settings_.out);
    const auto laplacian = tufted::distributedLaplacian(PETSC_COMM_WORLD, source, settings_.tiles);
    const auto seconds = [start] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    PetscPrintf(PETSC_COMM_WORLD, "points      %lld, %lld take part, %s\narea        %.10g, the sum of M\n",
                static_cast<long long>(laplacian.report.points), static_cast<long long>(laplacian.report.active),
                countText(laplacian.components, "component").c_str(), laplacian.report.area);
    PetscPrintf(PETSC_COMM_WORLD, "built       in %.3g s\n", seconds());
    MpiResults results;
    chosen_->compute(laplacian, source, results);
    auto report = reportOf(settings_, laplacian.report);
    report["components"] = laplacian.components;
    if (results.solve)
      report.update({{"iterations", results.solve->iterations}, {"residual", results.solve->residual}});
    results.files.report = report.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    tufted::writeDistributed(settings_.out, laplacian, results.files);
    for (const std::string& line : tufted::warnings(laplacian.report)) warn(settings_.file.string() + ": " + line);
    for (const std::string& line : results.warnings) warn(line);
    warnUnused();
    if (results.solve)
      PetscPrintf(PETSC_COMM_WORLD, "solved      in %d iterations, residual %.2g\n", results.solve->iterations,
                  results.solve->residual);
    PetscPrintf(PETSC_COMM_WORLD, "took        %.3g s\nwritten to  %s\n", seconds(), settings_.out.c_str());
  }

 private:
  /// Refuses what can be seen before the build. In process 0 alone: one message is enough.
  void checkInputs(std::int64_t points) {
    std::vector<std::string> files = chosen_->files;
    files.emplace_back("report.json");
    for (const std::string& name : files)
      refuseOverwriting("--out " + settings_.out.string(), settings_.out / name, inputsOf(*command_));
    tufted::checkWritable(settings_.out, files);
    chosen_->check(points);
  }

  void add(MpiSubcommand& subcommand) {
    CLI::App& command = *app_.add_subcommand(subcommand.name, subcommand.description);
    command.add_option("FILE", settings_.file, "Cloud: LAS, PLY, PCD, NPY, text in columns")
        ->required()
        ->check(notEmpty);
    addText(command, "--out DIR", settings_.out, "Folder of the results, made if missing")->required();
    addChoice(command, "--as", settings_.as, kinds, "What a PLY or OBJ is read as");
    command.add_option("--neighbors", settings_.tiles.cloud.neighbors, "Neighbours of each point")
        ->capture_default_str();
    command.add_option("--threads", settings_.tiles.cloud.threads, "Threads of each process")->capture_default_str();
    addBytes(
        command, "--memory",
        [this](std::size_t bytes, const std::string&) { settings_.tiles.memory = static_cast<double>(bytes); },
        "Memory of a build of tiles in each process; rows and solvers come on top, see docs/scale.md")
        ->default_str("4G");
    subcommand.addOptions(command);
    command.callback([this, &command, &subcommand] {
      command_ = &command;
      chosen_ = &subcommand;
    });
  }

  CLI::App app_;
  Settings settings_;
  const std::vector<std::unique_ptr<MpiSubcommand>> subcommands_ = mpiSubcommands();
  // The subcommand that was given:
  const CLI::App* command_ = nullptr;
  MpiSubcommand* chosen_ = nullptr;
};

/// Prints a message and ends all processes. Where all fail alike, process 0 speaks.
void fail(const std::string& message, int code) {
  if (processNumber() != 0) std::this_thread::sleep_for(std::chrono::seconds(1));
  std::fprintf(stderr, "tufted-mpi: %s\n", message.c_str());
  MPI_Abort(PETSC_COMM_WORLD, code);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  std::vector<std::string> petsc = takePetscOptions(words);
  petsc.insert(petsc.begin(), {"tufted-mpi", "-no_signal_handler"});
  std::vector<char*> arguments;
  for (std::string& word : petsc) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  int count = static_cast<int>(petsc.size());
  char** values = arguments.data();
  if (SlepcInitialize(&count, &values, nullptr, nullptr) != 0) return exit_failed;
  PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);  // errors are thrown
  int code = exit_done;
  {
    CommandLine command;
    if (const std::optional<int> done = command.parse(words)) {
      code = *done;
    } else {
      try {
        command.run();
      } catch (const tufted::InvalidInput& error) {
        fail(withoutClass(error.what()), exit_usage);
      } catch (const std::bad_alloc&) {
        fail("out of memory", exit_failed);
      } catch (const std::exception& error) {
        fail(error.what(), exit_failed);
      }
    }
  }
  SlepcFinalize();
  return code;
}
