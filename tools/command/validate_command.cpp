#include <sys/wait.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "command.h"
#include "console.h"
#include "input.h"
#include "options.h"
#include "progress_bar.h"
#include "tufted/errors.h"
#include "tufted/version.h"
#include "validate/children.h"
#include "validate/files.h"
#include "validate/one_file.h"
#include "validate/table.h"
#include "warnings.h"

namespace validate_command {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* name = "validate";

constexpr const char* description = "Build L and M for files or whole folders and check every guarantee.";

constexpr const char* footer =
    R"(Example:
  tufted validate scans --json

Folders are searched with all folders below them, also behind links, for files with a known extension. Each file has its
own process, so that a crash does not end the run. A line per file is printed, in the order given:

  result   OK: all guarantees hold. EMPTY: nothing failed, but no point is active, so L and M are zero. REFUSED: the
           file cannot be read, or the folder cannot be listed. FAILED: a guarantee is broken, or the process
           ended early
  seconds  time from the start of the process to its end: reading, building, checking
  MB       peak memory of the process
  nnz/row  stored entries of L per active point
  flips    intrinsic edge flips
  >0       number of positive off-diagonal entries of L
  clamped  largest negative weight that was set to 0, divided by the diagonal
  asym     largest |L_ij - L_ji|, divided by the larger diagonal
  rowsum   largest |sum of a row|, divided by its diagonal
  recomp   largest difference between L and a second assembly from the faces of the cover, divided by the larger
           diagonal; - without a cover
  psd      whether L + 1e-12 diag(L) of the active points has a Cholesky factor
  parts    connected components
  active, not fin(ite), coinc(ident), isol(ated): number of points with this status

The intrinsic triangulation is also checked, and M against the areas of the points. What could not be checked follows
the name of the file. The exit code is 1 if a file FAILED, otherwise 0.

--operator checks the same of L and M that `tufted laplacian --out DIR` wrote, after undoing --sign igl and --dummy; the
intrinsic triangulation only if they were written with --format npz,cover. A folder in which arrays are missing or do
not fit each other is REFUSED.)";

constexpr double most_seconds = 1e9;     // greatest value of --time
constexpr std::size_t most_text = 4096;  // most bytes shown of the output of a process without a result

struct Settings {
  const CLI::App* command = nullptr;
  std::vector<std::filesystem::path> paths, operators;
  tufted::ReadAs as = tufted::ReadAs::automatic;
  ChosenPoints chosen;
  int jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  double seconds = 600;       ///< limit per file; 0: none
  std::optional<int> memory;  ///< limit per file, in MB
  bool is_one = false;        ///< whether to judge the only file in this process
  Console console;
};

/// The arguments with which this program judges one file: options of files as they were given.
std::vector<std::string> wordsForOne(const std::filesystem::path& path, bool is_operator, const Settings& settings) {
  std::vector<std::string> words = {name, "--one", "--jobs", std::to_string(settings.jobs)};
  for (const char* const option : {"--time", "--memory", "--as", "--where", "--crop", "--polygon", "--thin"})
    for (const std::string& value : settings.command->get_option(option)->results())
      words.insert(words.end(), {option, value});
  if (is_operator) words.emplace_back("--operator");
  words.push_back(std::filesystem::absolute(path).string());  // absolute, so that it does not look like an option
  return words;
}

/// Describes how a process without a result ended.
std::string describeEnd(int status, const std::string& text, const Settings& settings) {
  std::ostringstream reason;
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) {
    reason << "took longer than --time " << settings.seconds;
  } else if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    reason << "its process was ended by signal " << signal << " (" << strsignal(signal) << ")";
    if (signal == SIGKILL) reason << ", as the system does when memory runs out";
  } else {
    reason << "its process ended with code " << WEXITSTATUS(status) << " and no result";
  }
  if (settings.memory) reason << " under --memory " << *settings.memory;
  const std::size_t first = text.find_first_not_of('\n', text.size() - std::min(text.size(), most_text));
  if (first != std::string::npos) reason << ": " << text.substr(first, text.find_last_not_of('\n') + 1 - first);
  return reason.str();
}

/// The last line that begins with a brace: the loader and libraries may write others to stderr.
std::string resultIn(const std::string& text) {
  const std::size_t brace = ("\n" + text).rfind("\n{");
  return brace == std::string::npos ? "" : text.substr(brace, text.find('\n', brace) - brace);
}

/// The row of a file whose process has ended.
Json describeFile(const std::string& file, int status, double seconds, const std::string& text,
                  const Settings& settings) {
  Json row = {{"file", file}, {"result", "FAILED"}, {"reasons", Json::array()}, {"seconds", seconds}};
  const Json found = Json::parse(resultIn(text), nullptr, false);
  if (found.is_object() && WIFEXITED(status) && WEXITSTATUS(status) == exit_done)
    row.update(found);
  else
    row["reasons"].push_back(describeEnd(status, text, settings));
  return row;
}

/// Collects the rows, and prints them in the order of the files, each as soon as all before it are known.
class Results {
 public:
  Results(std::size_t files, const Console& console)
      : rows_(files), as_lines_(!console.json && !console.quiet), as_json_(console.json), bar_(console.quiet) {
    if (as_lines_) print(tableHeader() + "\n");
  }

  void add(std::size_t number, Json row) {
    ++known_;
    ++counts_[row.at("result")];
    for (const Json& warning : row.value("warnings", Json::array())) warn(bar_, warning.get<std::string>());
    rows_[number] = std::move(row);
    for (; as_lines_ && printed_ < rows_.size() && !rows_[printed_].is_null(); ++printed_) {
      bar_.clear();
      print(tableLine(rows_[printed_]) + "\n");
    }
  }

  void showProgress() {
    bar_.show("validate, " + std::to_string(known_) + " of " + std::to_string(rows_.size()),
              static_cast<double>(known_) / static_cast<double>(rows_.size()));
  }

  /// Prints the counts. @throws std::runtime_error if files failed
  void sumUp(double seconds) {
    bar_.clear();
    const int ok = counts_["OK"], empty = counts_["EMPTY"], refused = counts_["REFUSED"], failed = counts_["FAILED"];
    std::ostringstream text;
    text.precision(1);
    text << std::fixed << countText(static_cast<std::int64_t>(rows_.size()), "file") << ": " << ok << " OK, ";
    if (empty > 0) text << empty << " EMPTY, ";
    text << refused << " REFUSED, " << failed << " FAILED, " << seconds << " s";
    if (as_lines_) print(text.str() + "\n");
    const Json summary = {{"files", rows_.size()}, {"ok", ok},         {"empty", empty},
                          {"refused", refused},    {"failed", failed}, {"seconds", seconds}};
    const Json document = {{"tufted", TUFTED_VERSION}, {"files", rows_}, {"summary", summary}};
    if (as_json_) print(textOf(document));
    const std::string of = " of " + std::to_string(rows_.size()) + " ";
    const std::string none = empty > 0 ? std::to_string(empty) + of + "EMPTY: no point is active" : "";
    if (failed > 0)
      throw std::runtime_error(std::to_string(failed) + of + "FAILED" + (none.empty() ? "" : ", ") + none);
    if (!none.empty()) warn(bar_, none);
  }

 private:
  std::vector<Json> rows_;
  bool as_lines_, as_json_;
  ProgressBar bar_;
  std::size_t known_ = 0, printed_ = 0;
  std::map<std::string, int> counts_;  ///< number of files by result
};

constexpr const char* protection = "./";

bool isInBrackets(const std::string& argument) {
  return argument.starts_with('[') && argument.ends_with(']');
}

/// Undoes protectBrackets(). A transformation for CLI11.
std::string withoutProtection(std::string& path) {
  if (path.starts_with(protection) && isInBrackets(path.substr(std::strlen(protection))))
    path.erase(0, std::strlen(protection));
  return "";  // no error
}

int runValidate(Settings settings) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<Found> files = findFiles(settings.paths);
  const std::size_t first_operator = files.size();
  for (const std::filesystem::path& folder : settings.operators) {
    if (!std::filesystem::is_directory(folder)) throw tufted::IoError(folder.string() + ": no such folder");
    files.push_back({folder});
  }
  settings.jobs = std::min<int>(settings.jobs, static_cast<int>(files.size()));
  // With a memory limit OpenBLAS's threads would retry allocations for ever, and the process would not end.
  setenv("OPENBLAS_NUM_THREADS", "1", 1);

  Results results(files.size(), settings.console);
  std::vector<std::vector<std::string>> words;  // arguments of each process
  std::vector<std::size_t> numbers;             // index of its file
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (files[i].refusal.empty()) {
      words.push_back(wordsForOne(files[i].path, i >= first_operator, settings));
      numbers.push_back(i);
    } else {
      results.add(i, {{"file", files[i].path.string()}, {"result", "REFUSED"}, {"reasons", {files[i].refusal}}});
    }
  }
  const auto ended = [&](std::size_t process, int status, double seconds, const std::string& text) {
    const std::size_t i = numbers[process];
    results.add(i, describeFile(files[i].path.string(), status, seconds, text, settings));
  };
  runChildren(words, static_cast<std::size_t>(settings.jobs), ended, [&] { results.showProgress(); });
  results.sumUp(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  return exit_done;
}

/// Judges the only file, in a process for it.
int runOne(const Settings& settings) {
  const bool is_operator = !settings.operators.empty();
  const int processors = static_cast<int>(std::thread::hardware_concurrency());
  return judge({.path = is_operator ? settings.operators.front() : settings.paths.front(),
                .is_operator = is_operator,
                .as = settings.as,
                .chosen = settings.chosen,
                // Each thread allocates a stack, which would make a memory limit depend on the machine.
                .threads = settings.memory ? 1 : std::max(1, processors / settings.jobs),
                .seconds = settings.seconds,
                .memory = settings.memory});
}

}  // namespace
}  // namespace validate_command

void protectBrackets(std::vector<std::string>& arguments) {
  using namespace validate_command;
  if (arguments.empty() || arguments.front() != name) return;
  for (std::string& argument : arguments)
    if (isInBrackets(argument)) argument.insert(0, protection);
}

void addValidate(CLI::App& app, Run& run) {
  using namespace validate_command;
  CLI::App& command = *app.add_subcommand(name, description);
  command.footer(footer);
  const auto settings = std::make_shared<Settings>();
  CLI::Option* const paths = command
                                 .add_option("PATH", settings->paths,
                                             "Files, and folders, which are searched for files with a known extension")
                                 ->check(notEmpty)
                                 ->transform(CLI::Validator(withoutProtection, ""));
  command
      .add_option("--operator", settings->operators,
                  "Check L and M that `tufted laplacian --out DIR` wrote; may be repeated")
      ->allow_extra_args(false)  // the next word may be PATH
      ->check(notEmpty)
      ->transform(CLI::Validator(withoutProtection, ""))
      ->type_name("DIR");
  addNumber(command, "--jobs N", settings->jobs, 1, 1024,
            "Maximum number of files checked at once (one per processor)");
  addNumber(command, "--time S", settings->seconds, 0.0, most_seconds,
            "Time limit per file in seconds; 0: no limit (600)");
  addNumber(command, "--memory MB", settings->memory, 1, std::numeric_limits<int>::max(),
            "Memory limit per file in MB; each file is then built by one thread (no limit)");
  addChoice(command, "--as", settings->as, kinds,
            "Read each PATH as a point cloud or as a mesh (a mesh if the file has faces)")
      ->needs(paths);
  addSelection(command, settings->chosen);
  command.add_flag("--one", settings->is_one)->group("");  // hidden in the help
  addConsole(command, settings->console);
  command.callback([&run, &command, settings] {
    settings->command = &command;
    if (settings->paths.empty() && settings->operators.empty()) throw CLI::RequiredError("PATH or --operator");
    if (settings->chosen.isAsked() && !settings->is_one && !settings->operators.empty())
      throw tufted::InvalidInput("--where, --crop, --polygon and --thin apply to files, and --operator names a folder");
    run = [=] { return settings->is_one ? runOne(*settings) : runValidate(*settings); };
  });
}
