#pragma once

#include <CLI/App.hpp>
#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "build.h"
#include "command.h"
#include "component_options.h"
#include "console.h"
#include "input.h"
#include "look.h"
#include "paths.h"
#include "progress_bar.h"
#include "summary.h"
#include "tufted/io/results.h"
#include "tufted/laplacian.h"
#include "tufted/solver.h"
#include "tufted/spectrum.h"

// Options and steps that commands which use a Laplacian share: its source, and where results go.

/// How systems are solved.
struct Solving {
  tufted::SolverMethod method = tufted::SolverMethod::automatic;
  std::size_t memory_limit = 0;  ///< bytes, see SolverOptions
};

/// The field that shows how far points move; the normals of the old positions are not shown with it.
inline constexpr const char* moved_points_field = "displacement";

/// For which sources a command needs the cover: of a cloud it has the triangles, which a mesh has by itself.
enum class CoverUse { none, clouds, all };

/// The options of a command that uses a Laplacian.
struct OperatorSettings {
  explicit OperatorSettings(CLI::App& subcommand) : command(subcommand) {}

  CLI::App& command;
  Input input;                   ///< FILE; empty with --operator
  std::filesystem::path folder;  ///< folder given by --operator
  std::filesystem::path out;
  Build build;
  Solving solving;
  ComponentOptions components;
  Console console;
  Look look;
  /// The fields as which the results will be shown, set by the command's check; empty: its arrays, of one column each.
  std::vector<ShownField> shown;
  std::vector<NamedInput> inputs;  ///< all files and folders that the command reads
  std::vector<tufted::Format> copies = {tufted::Format::ply};
  CoverUse cover = CoverUse::none;
  PlannedStages stages = solvingStages();  ///< what comes between the build and writing

  /// Whether the command needs the cover, not only L and M.
  bool needsCover(bool is_mesh) const { return cover == CoverUse::all || (cover == CoverUse::clouds && !is_mesh); }
  /// Name of the source in messages.
  std::string name() const { return folder.empty() ? input.name() : folder.string(); }
};

/// A Laplacian, and the points it belongs to.
struct Operator {
  std::string name;           ///< name of the source in messages
  tufted::Geometry geometry;  ///< without points for a folder without points.ply and points.pcd
  tufted::Laplacian laplacian;
  Solving solving;
  int threads = 0;
  tufted::Progress progress;
  /// The component of each point before some were left out, and the option that left them out; empty: none was.
  std::vector<int> all_components = {};
  std::string chosen_by = {};
  ChosenPoints chosen = {};                      ///< which points of FILE were chosen
  tufted::Points moved;                          ///< the points as moved by --denoise; 0 x 3 without it
  Eigen::Vector3d up = Eigen::Vector3d::Zero();  ///< direction given by --up; 0: none

  /// The points from which a command that moves points starts.
  const tufted::Points& startingPoints() const { return moved.rows() > 0 ? moved : geometry.points; }
  int points() const {
    return static_cast<int>(std::max<std::size_t>(geometry.points.rows(), laplacian.status.size()));
  }
  tufted::SolverOptions solverOptions() const {
    return {.method = solving.method, .memory_limit = solving.memory_limit, .threads = threads, .progress = progress};
  }
  tufted::SpectrumOptions spectrumOptions() const {
    return {.method = solving.method, .memory_limit = solving.memory_limit, .threads = threads, .progress = progress};
  }
};

/// Integers as a column of a result.
inline Eigen::MatrixXd columnOf(const std::vector<int>& values) {
  return Eigen::Map<const Eigen::VectorXi>(values.data(), std::ssize(values)).cast<double>();
}

/// The results of a command.
struct Results {  // NOLINT(bugprone-exception-escape): moves of its json, which do not throw
  std::vector<tufted::ResultArray> arrays;
  nlohmann::ordered_json report;  ///< members of report.json beside "tufted", "command" and "source"
  Summary summary;
  std::vector<std::string> warnings = {};  ///< one line for each warning
  /// What is shown instead of `arrays`, if not empty.
  std::vector<tufted::ResultArray> shown = {};
  /// Lines to write as lines.ply, lines.obj and lines.svg, if set.
  std::optional<std::vector<tufted::Polyline>> lines = {};
  /// Writes the results instead of writeResults(), if set.
  std::function<void(const std::filesystem::path& dir, const tufted::ResultOptions& options)> write = {};
};

/// A subcommand that uses a Laplacian: its options, and what it computes.
struct Subcommand : OperatorSettings {
  /// Adds FILE, --operator, --out, --format and the options of building and of solving.
  /// @param footer ends the help of the subcommand, and is followed by how FILE and --operator are given
  /// @param written the options by which the folder of --operator is written, and what for
  Subcommand(CLI::App& app, const char* name, const char* description, const std::string& footer,
             const std::string& written = "--out DIR` wrote.");
  virtual ~Subcommand() = default;
  Subcommand(const Subcommand&) = delete;
  Subcommand& operator=(const Subcommand&) = delete;

  /// Names of the results except the copies of the points and report.json.
  virtual std::vector<std::string> files() const = 0;
  /// Checks options before the Laplacian is built, which may take long. The source already has its points and, with
  /// --operator, its Laplacian.
  virtual void check(const Operator& /*source*/) {}
  /// Computes the results. It may change the points, whose copies are written.
  virtual Results compute(Operator& source) = 0;

  /// Loads the Laplacian, computes, writes the results and then the summary.
  /// @return an exit code
  int run();
};

/// Adds a subcommand.
template <class Derived>
void addSubcommand(CLI::App& app, Run& run) {
  const auto added = std::make_shared<Derived>(app);
  added->command.callback([&run, added] { run = [added] { return added->run(); }; });
}
