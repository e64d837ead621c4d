#include "../command.h"

#include <sys/wait.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "../console.h"
#include "../options.h"
#include "../progress_bar.h"
#include "../warnings.h"
#include "children.h"
#include "files.h"
#include "table.h"
#include "tufted/errors.h"
#include "worker.h"

namespace validate_command {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* name = "validate";

constexpr const char* description = "Build L and M for files or whole folders and check everything that they promise.";

constexpr const char* footer =
    R"(Example:
  tufted validate scans --json

Takes files, and folders with all that is below them and has a known extension; links to folders are followed.
Each file has a process of its own, so that none can stop the run. Prints a line per file, in the order given:

  result   OK, EMPTY (nothing broke, but no point is active: L and M are zero), REFUSED (the reader gives its reason;
           also a folder that cannot be listed) or FAILED (what broke, or how the process ended)
  seconds  from the start of its process to its end: reading, building, checking
  MB       peak memory of its process
  nnz/row  stored entries of L per active point
  flips    intrinsic edge flips
  >0       off-diagonals of L that are positive
  clamped  largest negative weight set to 0, over the diagonal
  asym     greatest |L_ij - L_ji| over the larger diagonal
  rowsum   greatest |sum of a row| over its diagonal
  recomp   greatest difference of L from the same assembled once more from the faces of its cover, over the larger
           diagonal; - where there is no cover
  psd      whether L + 1e-12 diag(L) of the active points has a Cholesky factor
  parts    connected components
  active, not fin(ite), coinc(ident), isol(ated): points by status

The intrinsic triangulation is checked as well, and M against the areas that it must hold. What could not be checked is
said behind the file's name. The exit code is 1 if a file FAILED, and 0 otherwise.

--operator takes what `tufted laplacian --out DIR` has written: --sign igl and --dummy are undone, and the same is
checked, of the intrinsic triangulation if --format had `cover`. A folder without it all, or one whose arrays do not fit
each other, is REFUSED.)";

struct Settings {
  std::vector<std::filesystem::path> paths, operators;
  FileSettings file;
  int jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  Console console;
};

/// How a process ended that gave no result.
std::string describeEnd(const ChildEnd& end, const Settings& settings) {
  std::ostringstream reason;
  const bool timed_out = WIFSIGNALED(end.status) && WTERMSIG(end.status) == SIGALRM;
  if (timed_out) {
    reason << "took longer than --time " << settings.file.seconds;
  } else if (WIFSIGNALED(end.status)) {
    const int signal = WTERMSIG(end.status);
    reason << "its process was ended by signal " << signal << " (" << strsignal(signal) << ")";
    if (signal == SIGKILL) reason << ", as the system does when memory runs out";
  } else {
    reason << "its process ended with code " << WEXITSTATUS(end.status) << " and no result";
  }
  if (settings.file.memory && !timed_out) reason << " under --memory " << *settings.file.memory;
  const std::size_t first = end.err.find_first_not_of('\n'), last = end.err.find_last_not_of('\n');
  if (first != std::string::npos) reason << ": " << end.err.substr(first, last + 1 - first);
  return reason.str();
}

/// What is known about a file whose process has ended.
Json describeFile(const std::filesystem::path& file, const ChildEnd& end, const Settings& settings) {
  Json row = {{"file", file.string()}, {"result", "FAILED"}, {"reasons", Json::array()}};
  row["seconds"] = end.seconds;
  row["memory_mb"] = end.peak_memory;
  const Json found = Json::parse(end.out, nullptr, false);
  if (found.is_object() && WIFEXITED(end.status) && WEXITSTATUS(end.status) == exit_done)
    row.update(found);
  else
    row["reasons"].push_back(describeEnd(end, settings));
  return row;
}

Json describeRefusal(const Found& folder) {
  return {{"file", folder.path.string()}, {"result", "REFUSED"}, {"reasons", {folder.refusal}}};
}

/// The rows in the order of the files, each as soon as all before it are known.
class Results {
 public:
  Results(std::size_t files, const Console& console)
      : rows_(files), as_lines_(!console.json && !console.quiet), as_json_(console.json) {}

  void add(std::size_t number, Json row, ProgressBar& bar) {
    ++known_;
    const std::string result = row.at("result");
    ++(result == "OK" ? ok_ : result == "EMPTY" ? empty_ : result == "REFUSED" ? refused_ : failed_);
    rows_[number] = std::move(row);
    if (!as_lines_) return;
    for (; printed_ < rows_.size() && !rows_[printed_].is_null(); ++printed_) {
      bar.clear();
      print(tableLine(rows_[printed_]));
    }
  }

  std::size_t known() const { return known_; }
  int failed() const { return failed_; }
  int empty() const { return empty_; }

  void printHeader() const {
    if (as_lines_) print(tableHeader());
  }
  void printSummary(double seconds) const {
    if (as_lines_) {
      std::string text = std::to_string(rows_.size()) + (rows_.size() == 1 ? " file: " : " files: ");
      text += std::to_string(ok_) + " OK, " + (empty_ > 0 ? std::to_string(empty_) + " EMPTY, " : "");
      text += std::to_string(refused_) + " REFUSED, " + std::to_string(failed_);
      char end[32];
      std::snprintf(end, sizeof(end), " FAILED, %.1f s", seconds);
      return print(text + end);
    }
    if (!as_json_) return;
    const Json summary = {{"files", rows_.size()}, {"ok", ok_},         {"empty", empty_},
                          {"refused", refused_},   {"failed", failed_}, {"seconds", seconds}};
    const Json document = {{"tufted", TUFTED_VERSION}, {"files", rows_}, {"summary", summary}};
    print(document.dump(2, ' ', false, Json::error_handler_t::replace));
  }

 private:
  static void print(const std::string& line) {
    std::fwrite(line.data(), 1, line.size(), stdout);
    std::fputc('\n', stdout);
    if (std::fflush(stdout) != 0) throw tufted::IoError("standard output: cannot write the results");
  }

  std::vector<Json> rows_;
  bool as_lines_, as_json_;
  std::size_t known_ = 0, printed_ = 0;
  int ok_ = 0, empty_ = 0, refused_ = 0, failed_ = 0;
};

constexpr const char* protection = "./";

bool isInBrackets(const std::string& argument) {
  return argument.starts_with('[') && argument.ends_with(']');
}

/// A transformation, as CLI11 has them.
std::string withoutProtection(std::string& path) {
  if (path.starts_with(protection) && isInBrackets(path.substr(std::strlen(protection))))
    path.erase(0, std::strlen(protection));
  return "";  // no error
}

int runValidate(Settings settings) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<Found> files = findFiles(settings.paths);
  for (const std::filesystem::path& folder : settings.operators) {
    if (!std::filesystem::is_directory(folder)) throw tufted::IoError(folder.string() + ": no such folder");
    files.push_back({.path = folder, .is_operator = true});
  }
  const int jobs = std::min<int>(settings.jobs, static_cast<int>(files.size()));
  const int processors = static_cast<int>(std::thread::hardware_concurrency());
  // Every further thread would allocate a stack, and so make a limit of memory depend on the machine.
  settings.file.threads = settings.file.memory ? 1 : std::max(1, processors / jobs);

  Results results(files.size(), settings.console);
  results.printHeader();
  ProgressBar bar(settings.console.quiet);
  std::vector<std::vector<std::string>> arguments;  // of each process
  std::vector<std::size_t> numbers;                 // and of its file
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (files[i].refusal.empty()) {
      arguments.push_back(fileArguments(files[i], settings.file));
      numbers.push_back(i);
    } else {
      results.add(i, describeRefusal(files[i]), bar);
    }
  }
  const auto ended = [&](std::size_t process, const ChildEnd& end) {
    const std::size_t number = numbers[process];
    const Json row = describeFile(files[number].path, end, settings);
    if (row.contains("warnings"))
      for (const Json& warning : row["warnings"]) warn(bar, warning.get<std::string>());
    results.add(number, row, bar);
  };
  const auto wait = [&] {
    bar.show("validate, " + std::to_string(results.known()) + " of " + std::to_string(files.size()),
             static_cast<double>(results.known()) / static_cast<double>(files.size()));
  };
  runChildren(arguments, jobs, ended, wait);
  bar.clear();
  results.printSummary(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  const std::string of = " of " + std::to_string(files.size()) + " ";
  std::string empty;
  if (results.empty() > 0) empty = std::to_string(results.empty()) + of + "EMPTY: no point is active";
  if (results.failed() > 0)
    throw std::runtime_error(std::to_string(results.failed()) + of + "FAILED" + (empty.empty() ? "" : ", ") + empty);
  if (!empty.empty()) warn(bar, empty);
  return exit_done;
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
  CLI::Option* const paths = command.add_option("PATH", settings->paths, "Files and folders")
                                 ->check(notEmpty)
                                 ->transform(CLI::Validator(withoutProtection, ""));
  command.add_option("--operator", settings->operators, "A Laplacian that `tufted laplacian --out DIR` wrote")
      ->allow_extra_args(false)  // what follows may be PATH
      ->check(notEmpty)
      ->transform(CLI::Validator(withoutProtection, ""))
      ->type_name("DIR");
  addNumber(command, "--jobs", settings->jobs, 1, 1024, "At most this many files at once (processors)")->type_name("N");
  addNumber(command, "--time", settings->file.seconds, 0.0, most_seconds, "Limit per file in seconds, 0 for none (600)")
      ->type_name("S");
  addNumber(command, "--memory", settings->file.memory, 1, std::numeric_limits<int>::max(),
            "Limit per file in MB: what one thread allocates for it (none)")
      ->type_name("MB");
  addChoice(command, "--as", settings->file.as, kinds, "Take files that may be either as one of them")->needs(paths);
  addConsole(command, settings->console);
  command.callback([&run, settings] {
    if (settings->paths.empty() && settings->operators.empty()) throw CLI::RequiredError("PATH or --operator");
    run = [=] { return runValidate(*settings); };
  });
  addValidateFile(app, run);
}
