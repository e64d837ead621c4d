// `tufted validate`: no file can stop the run, and every file gets its line.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "../io/temporary_dir.h"
#include "command.h"
#include "samples.h"

namespace validate_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// The files in the JSON of a run.
std::vector<std::string> filesOf(const json& document) {
  std::vector<std::string> files;
  for (const json& row : document["files"]) files.push_back(row["file"]);
  return files;
}

/// The processes that are validating `file`.
std::vector<pid_t> workersOn(const std::string& file) {
  std::vector<pid_t> workers;
  for (const auto& process : fs::directory_iterator("/proc")) {
    const std::string name = process.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    const std::string command_line = readAll(process.path() / "cmdline");
    if (contains(command_line, "--one") && contains(command_line, file)) workers.push_back(std::stoi(name));
  }
  return workers;
}

/// Waits up to ten seconds until some or no processes are validating `file`.
std::vector<pid_t> awaitWorkers(const std::string& file, bool some) {
  for (int i = 0; i < 1000; ++i) {
    std::vector<pid_t> workers = workersOn(file);
    if (workers.empty() != some) return workers;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ADD_FAILURE() << (some ? "no worker on " : "a worker is left on ") << file;
  return {};
}

/// CPU time of a process in clock ticks.
int ticksOf(pid_t process) {
  const std::string text = readAll("/proc/" + std::to_string(process) + "/stat");
  std::istringstream fields(text.substr(text.rfind(')') + 1));
  std::string field;
  for (int i = 3; i < 14; ++i) fields >> field;  // as proc(5) numbers them
  int ticks = 0;
  fields >> ticks;
  return ticks;
}

/// Waits up to ten seconds until a process has used this CPU time.
void awaitTicks(pid_t process, int ticks) {
  for (int i = 0; i < 10000 && ticksOf(process) < ticks; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

class Validate : public testing::Test {
 protected:
  std::string writeTetrahedron(const std::string& name = "good.off") const { return dir_.write(name, tetrahedron); }
  /// Writes a file that takes long enough to be interrupted.
  std::string writeLarge() const { return dir_.write("large.xyz", sphere(200000)); }

  TemporaryDir dir_;
};

TEST_F(Validate, GivesEveryFileALineInOrderAndSumsUp) {
  const std::string large = dir_.write("sphere.xyz", sphere(5000)), good = writeTetrahedron();
  const std::string bad = dir_.write("bad.xyz", "1 2 3\n1 two 3\n");
  const Result result = runTufted({"validate", large, good, bad, "--jobs", "3"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  const std::vector<std::string> lines = linesOf(result.out);
  ASSERT_EQ(lines.size(), 5u) << result.out;
  for (const char* title : {"result", "points", "faces", "seconds", "MB", "nnz/row", "flips", ">0", "clamped", "asym",
                            "rowsum", "recomp", "psd", "parts", "active", "not fin", "coinc", "isol", "file"})
    EXPECT_TRUE(contains(lines[0], title)) << title;
  EXPECT_TRUE(lines[1].starts_with("OK ") && lines[1].ends_with("  " + large)) << lines[1];
  EXPECT_TRUE(lines[2].starts_with("OK ") && lines[2].ends_with("  " + good)) << lines[2];
  EXPECT_TRUE(lines[3].starts_with("REFUSED ")) << lines[3];
  EXPECT_TRUE(lines[3].ends_with("  " + bad + ": line 2: 'two' is not a number")) << lines[3];
  EXPECT_TRUE(lines[4].starts_with("3 files: 2 OK, 1 REFUSED, 0 FAILED, ")) << lines[4];
}

TEST_F(Validate, WarnsAsOtherSubcommandsDo) {
  // A triangle that is too thin for the lengths of its edges to say its shape.
  const std::string thin = dir_.write("thin.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0.3 1e-12 0\n3 0 1 2\n");
  const Result validated = runTufted({"validate", thin}), built = runTufted({"laplacian", thin, "--out", dir_ / "out"});
  EXPECT_EQ(validated.code, 0) << validated.err;
  EXPECT_TRUE(contains(validated.err, "more area than its triangles")) << validated.err;
  EXPECT_EQ(validated.err, built.err);
}

TEST_F(Validate, TakesWhatIsReadableBelowAFolderSortedAndAnyFileThatIsNamed) {
  fs::create_directory(dir_ / "b");
  const std::string last = writeTetrahedron("c.OFF"), inner = writeTetrahedron("b/x.off");
  const std::string first = dir_.write("a.xyz", sphere(50)), notes = dir_.write("notes.md", "none");
  const json document = json::parse(runTufted({"validate", "--json", notes, dir_.path()}).out);
  EXPECT_EQ(filesOf(document), (std::vector<std::string>{notes, first, inner, last}));
  EXPECT_EQ(document["files"][0]["result"], "REFUSED");
  EXPECT_TRUE(contains(document["files"][0]["reasons"][0], "unknown file type '.md'"));
}

TEST_F(Validate, AFolderThatCannotBeListedIsRefusedAndTheOthersGoOn) {
  fs::create_directory(dir_ / "b");
  const std::string first = writeTetrahedron("a.off"), last = writeTetrahedron("c.off");
  fs::permissions(dir_ / "b", fs::perms::none);
  std::vector<std::string> words = {tuftedCommand(), "validate", "--json", dir_.path()};
  if (geteuid() == 0)  // permissions do not stop root
    words.insert(words.begin(), {"setpriv", "--inh-caps", "-all", "--bounding-set", "-all", "--"});
  const Result result = runProgram(words);
  fs::permissions(dir_ / "b", fs::perms::owner_all);
  EXPECT_EQ(result.code, 0) << result.err;
  const json document = json::parse(result.out);
  ASSERT_EQ(filesOf(document), (std::vector<std::string>{first, (dir_ / "b").string(), last}));
  EXPECT_EQ(document["files"][1]["result"], "REFUSED");
  EXPECT_EQ(document["files"][1]["reasons"], json({"cannot list: Permission denied"}));
  EXPECT_EQ(document["summary"]["ok"], 2);
}

TEST_F(Validate, FollowsLinksToFoldersAndGoesThroughEachOnce) {
  const TemporaryDir elsewhere;
  elsewhere.write("x.off", tetrahedron);
  fs::create_directory(dir_ / "own");
  const std::string own = writeTetrahedron("own/y.off");
  fs::create_directory_symlink(dir_ / "own", dir_ / "another_name");
  fs::create_directory_symlink(elsewhere.path(), dir_ / "there");
  fs::create_directory_symlink(dir_.path(), dir_ / "own/loop");
  fs::create_directory_symlink(elsewhere.path(), elsewhere / "loop");
  const json document = json::parse(runTufted({"validate", "--json", dir_.path()}).out);
  EXPECT_EQ(filesOf(document), (std::vector<std::string>{own, (dir_ / "there/x.off").string()}));
}

TEST_F(Validate, TakesPathsInBracketsAsTheyAreTyped) {
  for (const char* folder : {"a", "[a]", "[a,b]"}) {
    fs::create_directory(dir_ / folder);
    writeTetrahedron(std::string(folder) + "/x.off");
  }
  writeTetrahedron("[c]");
  const Result result = runProgram(
      {"sh", "-c", R"(cd "$1" && exec "$0" validate --json '[a]' '[a,b]' '[c]' 'a')", tuftedCommand(), dir_.path()});
  EXPECT_EQ(result.code, 0) << result.err;
  const json document = json::parse(result.out);
  EXPECT_EQ(filesOf(document), (std::vector<std::string>{"[a]/x.off", "[a,b]/x.off", "[c]", "a/x.off"}));
  EXPECT_EQ(document["summary"]["ok"], 4) << result.out;
}

TEST_F(Validate, WritesOneJsonDocumentWithTheFigures) {
  const Result result = runTufted({"validate", "--json", writeTetrahedron()});
  EXPECT_EQ(result.code, 0) << result.err;
  const json document = json::parse(result.out);
  const json expected = {{"files", 1}, {"ok", 1}, {"refused", 0}, {"failed", 0}};
  for (const auto& [key, value] : expected.items()) EXPECT_EQ(document["summary"][key], value) << key;
  const json row = document["files"].at(0);
  const json figures = {{"result", "OK"},
                        {"kind", "mesh"},
                        {"points", 4},
                        {"faces", 4},
                        {"active", 4},
                        {"not_finite_points", 0},
                        {"coincident", 0},
                        {"isolated", 0},
                        {"nonzeros_per_row", 4.0},
                        {"components", 1},
                        {"definite", true},
                        {"positive_off_diagonals", 0},
                        {"symmetry_error", 0},
                        {"not_positive_diagonals", 0}};
  for (const auto& [key, value] : figures.items()) EXPECT_EQ(row[key], value) << key;
  for (const char* key : {"row_sum_error", "largest_clamped", "seconds", "memory_mb"})
    EXPECT_TRUE(row[key].is_number());
  EXPECT_LT(row["row_sum_error"], 1e-14);
  EXPECT_GT(row["memory_mb"], 1);
  EXPECT_EQ(row["cover"]["not_delaunay"], 0);
  EXPECT_EQ(row["recomputed"], true);
  EXPECT_EQ(row["masses_compared"], true);
  EXPECT_LT(row["weight_error"], 1e-14);
  EXPECT_LT(row["mass_error"], 1e-14);
  EXPECT_EQ(row["not_checked"], json::array());
}

TEST_F(Validate, TheMemoryOfAFileIsNotThatOfTheCommand) {
  const std::string first = writeTetrahedron();
  fs::create_directory(dir_ / "many");
  for (int i = 0; i < 300; ++i) dir_.write("many/" + std::to_string(i) + ".off", "");
  const auto memoryOfFirst = [&](int times) {  // memory in the first row of a table of many files
    std::vector<std::string> words = {"sh", "-c", R"("$0" validate "$@" | head -n 2 | tail -n 1)", tuftedCommand(),
                                      first};
    words.insert(words.end(), times, (dir_ / "many").string());
    std::istringstream line(runProgram(words).out);
    std::string result;
    double points = 0, faces = 0, seconds = 0, memory = 0;
    line >> result >> points >> faces >> seconds >> memory;
    EXPECT_EQ(result, "OK");
    return memory;
  };
  EXPECT_LT(memoryOfFirst(1000), memoryOfFirst(1) + 100);
}

TEST_F(Validate, TakesAMeshAsACloudAndRefusesACloudAsAMesh) {
  const std::string cloud = dir_.write("sphere.xyz", sphere(50)), mesh = writeTetrahedron();
  const json as_cloud = json::parse(runTufted({"validate", "--json", "--as", "cloud", mesh}).out);
  EXPECT_EQ(as_cloud["files"][0]["kind"], "cloud");
  const json as_mesh = json::parse(runTufted({"validate", "--json", "--as", "mesh", cloud}).out);
  EXPECT_EQ(as_mesh["files"][0]["reasons"], json({"has no faces"}));
}

TEST_F(Validate, AFileThatTakesTooLongFails) {
  const Result result = runTufted({"validate", writeLarge(), "--time", "0.05"});
  EXPECT_EQ(result.code, 1);
  EXPECT_EQ(result.err, "tufted: 1 of 1 FAILED\n");
  EXPECT_TRUE(contains(result.out, "large.xyz: took longer than --time 0.05\n")) << result.out;
}

TEST_F(Validate, AFileThatNeedsTooMuchMemoryFailsAndTheOthersDoNot) {
#ifdef TUFTED_SANITIZED
  GTEST_SKIP() << "the shadow memory of a sanitizer counts too";
#endif
  const std::string large = writeLarge(), good = writeTetrahedron();
  const Result result = runTufted({"validate", "--json", large, good, "--memory", "30"});
  EXPECT_EQ(result.code, 1);
  const json files = json::parse(result.out)["files"];
  EXPECT_EQ(files[0]["result"], "FAILED");
  EXPECT_TRUE(contains(files[0]["reasons"][0], "memory (--memory 30)")) << files[0];
  EXPECT_EQ(files[1]["result"], "OK") << files[1];
}

TEST_F(Validate, TheResultIsFoundAmongLinesThatOthersWriteToStderr) {
  // The loader writes before and after all that the program does.
  const Result result = runProgram({"env", "LD_DEBUG=statistics", tuftedCommand(), "validate", writeTetrahedron()});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_TRUE(contains(result.err, "runtime linker statistics")) << result.err;
  EXPECT_TRUE(contains(result.out, "\n1 file: 1 OK, 0 REFUSED, 0 FAILED, ")) << result.out;
}

TEST_F(Validate, ACrashIsNamedAndTheOthersGoOn) {
  const std::string large = writeLarge(), good = writeTetrahedron();
  Process tufted = startTufted({"validate", "--jobs", "1", large, good});
  for (const pid_t worker : awaitWorkers(large, true)) kill(worker, SIGABRT);  // sanitizers handle SIGSEGV themselves
  const Result result = tufted.finish();
  EXPECT_EQ(result.code, 1);
  EXPECT_TRUE(contains(result.out, large + ": its process was ended by signal 6 (Aborted)")) << result.out;
  EXPECT_TRUE(contains(result.out, "\n2 files: 1 OK, 0 REFUSED, 1 FAILED, ")) << result.out;
}

TEST_F(Validate, AWorkerThatIsAskedToEndDoesSo) {  // as by daemons that watch memory
  const std::string large = writeLarge();
  for (const int ticks : {0, 2, 10}) {  // while it starts, and while it works
    Process tufted = startTufted({"validate", large});
    for (const pid_t worker : awaitWorkers(large, true)) {
      awaitTicks(worker, ticks);
      kill(worker, SIGTERM);
    }
    const Result result = tufted.finish();
    EXPECT_TRUE(contains(result.out, large + ": its process was ended by signal 15 (Terminated)")) << result.out;
  }
}

TEST_F(Validate, NoWorkerOutlivesTheCommand) {
  const std::string large = writeLarge();
  Process tufted = startTufted({"validate", large});
  const std::vector<pid_t> workers = awaitWorkers(large, true);
  ASSERT_EQ(workers.size(), 1u);
  awaitTicks(workers[0], 100);  // more than the 20 that loading takes with sanitizers
  kill(workers[0], SIGSTOP);    // so that it does not end by itself
  kill(tufted.pid(), SIGKILL);
  tufted.finish();
  awaitWorkers(large, false);
  for (const pid_t left : workersOn(large)) kill(left, SIGKILL);
}

TEST_F(Validate, AnInterruptEndsTheWorkersAndShowsProgressBefore) {
  const std::string large = writeLarge();
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const Result result = interruptTufted({"validate", large}, signal);
    EXPECT_EQ(result.code, 130) << signal << ": " << result.err;
    EXPECT_TRUE(contains(result.err, "validate, 0 of 1")) << result.err;
    EXPECT_TRUE(contains(result.err, "tufted: cancelled")) << result.err;
    EXPECT_TRUE(workersOn(large).empty());
  }
}

TEST_F(Validate, PathsThatHoldNothingAreOneLineAndOne) {
  fs::create_directory(dir_ / "empty");
  const std::string empty = (dir_ / "empty").string(), missing = (dir_ / "missing").string();
  const Result none = runTufted({"validate", empty});
  EXPECT_EQ(none.code, 1);
  EXPECT_EQ(none.err, "tufted: " + empty + ": holds no file of a known type\n");
  fs::create_directory(dir_ / "bare");
  const std::string bare = (dir_ / "bare").string();
  EXPECT_EQ(runTufted({"validate", empty, bare}).err,
            "tufted: " + empty + ", " + bare + ": hold no file of a known type\n");
  const Result nowhere = runTufted({"validate", writeTetrahedron(), missing});
  EXPECT_EQ(nowhere.code, 1);
  EXPECT_EQ(nowhere.err, "tufted: " + missing + ": no such file or folder\n");
  EXPECT_EQ(none.out + nowhere.out, "");
}

TEST_F(Validate, MistakesOnTheCommandLineAreOneLineAndTwo) {
  const std::string file = writeTetrahedron();
  const std::vector<std::vector<std::string>> mistakes = {{},
                                                          {""},
                                                          {file, "--jobs", "0"},
                                                          {file, "--time", "-1"},
                                                          {file, "--memory", "0"},
                                                          {file, "--as", "surface"},
                                                          {"--operator", ""},
                                                          {"--operator", dir_.path(), "--as", "mesh"}};
  for (std::vector<std::string> arguments : mistakes) {
    arguments.insert(arguments.begin(), "validate");
    const Result result = runTufted(arguments);
    EXPECT_EQ(result.code, 2) << result.err;
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
  }
}

class ValidateFolder : public testing::TestWithParam<const char*> {};

TEST_P(ValidateFolder, NothingFails) {
  if (!fs::is_directory(GetParam())) GTEST_SKIP() << "no folder " << GetParam();
  const Result result = runTufted({"validate", "--json", GetParam()});
  EXPECT_EQ(result.code, 0) << result.err;
  const json document = json::parse(result.out);
  EXPECT_EQ(document["summary"]["failed"], 0);
  EXPECT_EQ(document["summary"]["refused"], 0);  // today's readers accept them all
  EXPECT_EQ(document["summary"]["empty"], 0);
  EXPECT_EQ(document["summary"]["ok"], document["files"].size());
}

std::string folderName(const testing::TestParamInfo<const char*>& info) {
  const char* const names[] = {"Samples", "RealData"};
  return names[info.index];
}

INSTANTIATE_TEST_SUITE_P(All, ValidateFolder, testing::Values(TUFTED_SAMPLES_DIR, TUFTED_DATA_DIR), folderName);

}  // namespace
}  // namespace validate_test
