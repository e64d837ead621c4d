// The command for clouds that several processes share: `mpirun -n 4 tufted-mpi SUBCOMMAND FILE --out DIR`.
#include <slepc.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "../bytes.h"
#include "../options.h"
#include "../paths.h"
#include "tufted/errors.h"
#include "tufted/io/results.h"
#include "tufted/io/tiles.h"
#include "tufted/io/write.h"
#include "tufted/mpi/solves.h"
#include "tufted/mpi/write.h"
#include "tufted/version.h"

namespace {

constexpr const char* footer =
    R"(Examples:
  mpirun -n 4 tufted-mpi spectrum survey.las --count 20 --out modes
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
  // Each of these belongs to one subcommand.
  std::string coordinate;
  std::filesystem::path values, pins;
  int count = 10;
  double tolerance = 1e-9;
};

/// What a subcommand computes.
using Compute = std::function<void(const tufted::DistributedLaplacian& laplacian, const tufted::PointSource& source)>;

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

/// One coordinate of each point, by row.
tufted::PetscVector coordinateOf(const tufted::DistributedLaplacian& laplacian, const tufted::PointSource& source,
                                 int axis) {
  tufted::PetscVector by_point;
  VecDuplicate(laplacian.row.get(), by_point.make());
  PetscInt first = 0, last = 0;
  VecGetOwnershipRange(by_point.get(), &first, &last);
  PetscScalar* values = nullptr;
  VecGetArray(by_point.get(), &values);
  std::int64_t done = 0;
  source.pass([&](const tufted::PointsRef& batch) {
    for (Eigen::Index i = 0; i < batch.rows(); ++i, ++done)
      if (done >= first && done < last) values[done - first] = batch(i, axis);
  });
  VecRestoreArray(by_point.get(), &values);
  return valuesByRow(laplacian, by_point.get());
}

/// Values of the points, by row. @param given N x 1 in process 0; not used in the others
tufted::PetscVector valuesByRowOf(const tufted::DistributedLaplacian& laplacian, const Eigen::MatrixXd& given) {
  tufted::PetscVector by_point;
  VecDuplicate(laplacian.row.get(), by_point.make());
  for (Eigen::Index i = 0; i < given.rows(); ++i)
    VecSetValue(by_point.get(), static_cast<PetscInt>(i), given(i, 0), INSERT_VALUES);
  VecAssemblyBegin(by_point.get());
  VecAssemblyEnd(by_point.get());
  return valuesByRow(laplacian, by_point.get());
}

/// Pins of a text file: the rows of the points, and their values. In process 0; none in the others.
struct Pins {
  std::vector<PetscInt> rows;
  std::vector<double> values;
};

/// Reads lines INDEX VALUE.
std::vector<std::pair<std::int64_t, double>> readPins(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw tufted::IoError(file.string() + ": cannot read");
  std::vector<std::pair<std::int64_t, double>> pins;
  int line = 0;
  for (std::string text; std::getline(stream, text);) {
    ++line;
    text.erase(std::min(text.find('#'), text.size()));
    std::istringstream words(text);
    std::pair<std::int64_t, double> pin;
    std::string rest;
    if (!(words >> rest)) continue;
    words.clear();
    words.seekg(0);
    if (!(words >> pin.first >> pin.second) || words >> rest)
      throw tufted::IoError(file.string() + ": line " + std::to_string(line) + ": is not INDEX VALUE");
    pins.push_back(pin);
  }
  return pins;
}

/// @param given in process 0; none in the others
Pins pinsOf(const tufted::DistributedLaplacian& laplacian, const std::vector<std::pair<std::int64_t, double>>& given) {
  std::vector<std::int64_t> points;
  for (const auto& [point, value] : given) points.push_back(point);
  const std::vector<PetscInt> rows = rowsOf(laplacian, points);
  Pins pins;
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (rows[i] < 0)
      throw tufted::InvalidInput("--pins: point " + std::to_string(points[i]) + " takes no part, must be active");
    pins.rows.push_back(rows[i]);
    pins.values.push_back(given[i].second);
  }
  return pins;
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

/// Warns of options that PETSc did not ask for.
void warnUnused() {
  PetscInt count = 0;
  char** names = nullptr;
  char** values = nullptr;
  PetscOptionsLeftGet(nullptr, &count, &names, &values);
  for (PetscInt i = 0; i < count && processNumber() == 0; ++i)
    std::fprintf(stderr, "tufted-mpi: warning: nothing has used the option -%s\n", names[i]);
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
    addLaplacian();
    addPoisson();
    addHarmonic();
    addSpectrum();
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
    settings_.tiles.folder = existingFolder(settings_.out);
    const auto laplacian = tufted::distributedLaplacian(PETSC_COMM_WORLD, source, settings_.tiles);
    compute_(laplacian, source);
    auto report = reportOf(settings_, laplacian.report);
    report["components"] = laplacian.components;
    report.update(report_);
    result_.report = report.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    tufted::writeDistributed(settings_.out, laplacian, result_);
    warnUnused();
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    PetscPrintf(PETSC_COMM_WORLD, "points      %lld, %lld take part, %s\narea        %.10g, the sum of M\n",
                static_cast<long long>(laplacian.report.points), static_cast<long long>(laplacian.report.active),
                countText(laplacian.components, "component").c_str(), laplacian.report.area);
    if (report_.contains("iterations"))
      PetscPrintf(PETSC_COMM_WORLD, "solved      in %d iterations, residual %.2g\n", report_["iterations"].get<int>(),
                  report_["residual"].get<double>());
    PetscPrintf(PETSC_COMM_WORLD, "took        %.3g s\nwritten to  %s\n", seconds.count(), settings_.out.c_str());
  }

 private:
  /// Reads the small files, and refuses what can be seen before the build. In process 0 alone: one message is enough.
  void checkInputs(std::int64_t points) {
    for (const std::string& name : files_)
      refuseOverwriting("--out " + settings_.out.string(), settings_.out / name, inputsOf(*command_));
    tufted::checkWritable(settings_.out, files_);
    if (!settings_.values.empty()) given_values_ = tufted::readArray(settings_.values);
    if (!settings_.values.empty() && (given_values_.rows() != points || given_values_.cols() != 1))
      throw tufted::InvalidInput(settings_.values.string() + " has " + std::to_string(given_values_.rows()) + " x " +
                                 std::to_string(given_values_.cols()) + " values, must have " + std::to_string(points) +
                                 " x 1, one per point");
    if (!settings_.pins.empty()) given_pins_ = readPins(settings_.pins);
    for (const auto& [point, value] : given_pins_)
      if (point < 0 || point >= points)
        throw tufted::InvalidInput("--pins: point " + std::to_string(point) + ", must be in [0, " +
                                   std::to_string(points) + ")");
  }

  /// @param files names of the results
  CLI::App& add(const char* name, const char* description, std::vector<std::string> files, Compute compute) {
    CLI::App& command = *app_.add_subcommand(name, description);
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
    files.emplace_back("report.json");
    command.callback([this, &command, files = std::move(files), compute = std::move(compute)] {
      command_ = &command;
      files_ = files;
      compute_ = compute;
    });
    return command;
  }

  void addSolve(const tufted::DistributedSolve& made) {
    report_["iterations"] = made.iterations;
    report_["residual"] = made.residual;
  }

  void addLaplacian() {
    add("laplacian", "Write L and M as files of PETSc.", {"L.petsc", "M.petsc", "row.npy"},
        [this](const auto&, const auto&) { result_.has_matrices = true; });
  }

  void addPoisson() {
    CLI::App& command =
        add("poisson", "Solve L u = M f; writes u.npy.", {"u.npy"}, [this](const auto& laplacian, const auto& source) {
          const tufted::PetscVector f = settings_.values.empty()
                                            ? coordinateOf(laplacian, source, settings_.coordinate[0] - 'x')
                                            : valuesByRowOf(laplacian, given_values_);
          tufted::DistributedSolve made;
          kept_.push_back(poisson(laplacian, f.get(), &made));
          addSolve(made);
          result_.arrays = {{"u", {kept_.back().get()}}};
        });
    const CLI::Option* const values =
        command.add_option("--values", settings_.values, "f, a .npy file of N values; process 0 reads it as a whole")
            ->type_name("NPY");
    const CLI::Option* const coordinate =
        command.add_option("--coordinate", settings_.coordinate, "f is a coordinate of the points")
            ->check(CLI::IsMember({"x", "y", "z"}));
    command.parse_complete_callback([values, coordinate] {
      if (values->count() + coordinate->count() != 1)
        throw CLI::RequiredError("exactly one of --values and --coordinate");
    });
  }

  void addHarmonic() {
    CLI::App& command = add("harmonic", "Interpolate values of some points harmonically; writes values.npy.",
                            {"values.npy"}, [this](const auto& laplacian, const auto&) {
                              const Pins pins = pinsOf(laplacian, given_pins_);
                              tufted::DistributedSolve made;
                              kept_.push_back(harmonic(laplacian, pins.rows, pins.values, &made));
                              addSolve(made);
                              result_.arrays = {{"values", {kept_.back().get()}}};
                            });
    command.add_option("--pins", settings_.pins, "Text file of pins, lines INDEX VALUE")->required()->type_name("TEXT");
  }

  void addSpectrum() {
    CLI::App& command = add("spectrum", "Find the smallest positive eigenvalues; writes evals.npy and evecs.npy.",
                            {"evals.npy", "evecs.npy"}, [this](const auto& laplacian, const auto&) {
                              auto found = spectrum(laplacian, settings_.count, settings_.tolerance);
                              addSolve(found.report);
                              kept_ = std::move(found.vectors);
                              tufted::DistributedArray vectors = {"evecs", {}};
                              for (const auto& vector : kept_) vectors.columns.push_back(vector.get());
                              result_.arrays = {std::move(vectors)};
                              result_.lists = {{"evals", std::move(found.values)}};
                            });
    command.add_option("--count", settings_.count, "Number of eigenpairs")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command.add_option("--tolerance", settings_.tolerance, "Tolerance on their residual, below 1")
        ->check(CLI::Range(1e-15, 0.999))
        ->capture_default_str();
  }

  CLI::App app_;
  Settings settings_;
  // What the subcommand that was given has set:
  const CLI::App* command_ = nullptr;
  std::vector<std::string> files_;  ///< names of its results
  Compute compute_;
  Eigen::MatrixXd given_values_;                             ///< in process 0
  std::vector<std::pair<std::int64_t, double>> given_pins_;  ///< in process 0
  std::vector<tufted::PetscVector> kept_;                    ///< vectors of the result
  tufted::DistributedResult result_;
  nlohmann::ordered_json report_ = nlohmann::ordered_json::object();
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
