// Results: the folder is checked before the build, and afterwards holds all old or all new files, whatever happens.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>

#include "../io/folder_content.h"
#include "../io/small_disk.h"
#include "subcommands.h"

namespace output_test {
namespace {

namespace fs = std::filesystem;
using Content = std::map<std::string, std::string>;

class OutputOfCommands : public Subcommands {
 protected:
  const std::string cloud_ = dir_.write("sphere.xyz", sphere(800));

  std::vector<std::string> build(int neighbors) const {
    return {"laplacian", cloud_, "--out", in("out"), "--format", "ply,mtx", "--neighbors", std::to_string(neighbors)};
  }
  /// The results of `build`, without report.json, which contains times.
  Content resultsOf(int neighbors) {
    run(build(neighbors));
    Content content = contentOf(dir_ / "out");
    content.erase("report.json");
    return content;
  }
  /// Expects the folder to hold the results for one of the numbers of neighbours and nothing else. Returns that number.
  int expectWhole(const std::map<int, Content>& results) {
    Content content = contentOf(dir_ / "out");
    const auto json = nlohmann::json::parse(content["report.json"], nullptr, false);
    EXPECT_FALSE(json.is_discarded());
    const int neighbors = json.value("/cloud_options/neighbors"_json_pointer, 0);
    content.erase("report.json");
    const auto expected = results.find(neighbors);
    EXPECT_TRUE(expected != results.end() && content == expected->second) << neighbors << ", " << content.size();
    return neighbors;
  }

  /// The content of the folder without report.json, after files that a killed process replaced are put back from its
  /// hidden folder.
  Content contentAfterKill() {
    Content content = contentOf(dir_ / "out");
    for (const auto& entry : fs::directory_iterator(dir_ / "out")) {
      if (!entry.is_directory()) continue;
      content.erase(entry.path().filename().string());
      if (!fs::exists(entry.path() / "old")) continue;
      for (const auto& [name, bytes] : contentOf(entry.path() / "old")) content[name] = bytes;
    }
    content.erase("report.json");
    return content;
  }

  /// Expects the folder to have no report, or one whose files are all of one result.
  void expectWholeOrNoReport(const std::map<int, Content>& results) {
    if (!fs::exists(dir_ / "out/report.json")) return;
    const auto report = nlohmann::json::parse(readAll(dir_ / "out/report.json"));
    for (const auto& [name, bytes] : results.at(report["cloud_options"]["neighbors"]))
      EXPECT_TRUE(readAll(dir_ / "out" / name) == bytes) << name;
  }
};

TEST_F(OutputOfCommands, ThatCannotBeWrittenIsRefusedBeforeTheBuild) {
  const std::string cloud = dir_.write("small.xyz", sphere(200)), file = dir_.write("file", "stays");
  for (std::vector<std::string> command : commands) {
    command.push_back(cloud);
    command.emplace_back("--out");
    std::vector<std::string> made = command;
    made.push_back(in("made"));
    run(made);
    const Content results = contentOf(dir_ / "made");
    fs::remove_all(dir_ / "made");

    const auto expectRefused = [&](const std::string& out, const std::string& named) {
      std::vector<std::string> arguments = command;
      arguments.push_back(out);
      if (command[0] != "denoise") arguments.emplace_back("--normals");  // the file has none, so a build fails
      const Result result = runTufted(arguments);
      EXPECT_EQ(result.code, 1) << command[0];
      EXPECT_TRUE(isOneLine(result.err)) << result.err;
      EXPECT_TRUE(result.err.starts_with("tufted: " + named + ": cannot ")) << command[0] << ": " << result.err;
    };
    expectRefused(file, file);
    expectRefused(file + "/below", file + "/below");
    for (const auto& [name, bytes] : results) {
      fs::create_directories(dir_ / "out" / name);
      expectRefused(in("out"), in("out/" + name));
      EXPECT_EQ(contentOf(dir_ / "out"), (Content{{name, "directory"}}));
      fs::remove_all(dir_ / "out");
    }
  }
  EXPECT_EQ(readAll(file), "stays");
}

TEST_F(OutputOfCommands, ThatMayNotBeWrittenIsRefusedBeforeTheBuild) {
  const fs::path closed = dir_ / "closed";
  fs::create_directory(closed);
  fs::permissions(closed,
                  fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read | fs::perms::others_exec);
  std::vector<std::string> other = {tuftedCommand()};
  if (geteuid() == 0) {  // root may write anywhere
    other = {"setpriv", "--reuid", "65534", "--clear-groups", tuftedCommand()};
    if (runProgram({"setpriv", "--reuid", "65534", "--clear-groups", tuftedCommand(), "--version"}).code != 0)
      GTEST_SKIP() << "cannot run the command as another user";
  }
  for (const std::string& out : {closed.string(), (closed / "below").string()}) {
    std::vector<std::string> words = other;
    words.insert(words.end(), {"laplacian", cloud_, "--normals", "--out", out});
    const Result result = runProgram(words);
    EXPECT_EQ(result.code, 1);
    EXPECT_TRUE(result.err.starts_with("tufted: " + out + ": cannot ")) << result.err;
    EXPECT_TRUE(result.err.ends_with(": Permission denied\n")) << result.err;
  }
}

TEST_F(OutputOfCommands, IsAsItWasWhereTheDiskIsFull) {
  const SmallDisk disk("4m");
  if (!disk.isMounted()) GTEST_SKIP() << "may not mount a small disk";
  const std::string out = (disk / "out").string();
  run({"laplacian", cloud_, "--out", out});
  const Content before = contentOf(out);
  const auto available = fs::space(disk.path()).available;
  // Leaves room for the first file only, ..., for all but the last.
  for (const int part : {1, 4, 7}) {
    std::uintmax_t size = 0;
    for (const auto& [name, bytes] : before) size += bytes.size();
    std::ofstream(disk / "filler") << std::string(available - size * part / 8, 'x');
    const Result result = runTufted({"laplacian", cloud_, "--out", out, "--neighbors", "12"});
    EXPECT_EQ(result.code, 1);
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
    EXPECT_TRUE(result.err.ends_with(": No space left on device\n")) << result.err;
    EXPECT_TRUE(contentOf(out) == before) << part;
    fs::remove(disk / "filler");
  }
}

TEST_F(OutputOfCommands, IsWhollyOldOrWhollyNewWhicheverStepFailsOrIsInterrupted) {
  // Runs the command so that the n-th system call of a kind fails or raises a signal.
  const auto runWith = [&](const std::string& call, const std::string& fault, int n, std::vector<std::string> words) {
    std::vector<std::string> strace = {"strace", "-f", "-o", in("calls"), "-e", "trace=" + call, "-e"};
    strace.push_back("inject=" + call + ":" + fault + ":when=" + std::to_string(n));
    words.insert(words.begin(), strace.begin(), strace.end());
    return runProgram(words).code;
  };
  if (runProgram({"sh", "-c", "command -v strace"}).code != 0 || runWith("mkdir", "error=EIO", 1, {"true"}) != 0)
    GTEST_SKIP() << "cannot run the command under strace";
  const std::map<int, Content> results = {{12, resultsOf(12)}, {30, resultsOf(30)}};
  fs::rename(dir_ / "out", dir_ / "before");
  std::vector<std::string> words = {tuftedCommand(), "--threads", "1"};
  const std::vector<std::string> command = build(12);
  words.insert(words.begin() + 1, command.begin(), command.end());
  // Runs the command on a copy of the results for 30 neighbours, and expects those for 12 if it succeeds.
  const auto runOverOld = [&](const std::string& call, const std::string& fault, int n) {
    fs::remove_all(dir_ / "out");
    fs::copy(dir_ / "before", dir_ / "out", fs::copy_options::recursive);
    const int code = runWith(call, fault, n, words);
    const int expected = code == 0 ? 12 : 30;
    if (fault == "signal=SIGKILL") {
      expectWholeOrNoReport(results);
      EXPECT_TRUE(contentAfterKill() == results.at(expected)) << call << ' ' << n << ": " << code;
    } else {
      EXPECT_EQ(expectWhole(results), expected) << call << ' ' << fault << ' ' << n << ": " << code;
    }
    return code;
  };
  for (const std::string call : {"mkdir", "fsync", "linkat", "rename"}) {
    EXPECT_EQ(runOverOld(call, "signal=SIGCONT", 1), 0);  // has no effect
    const std::vector<std::string> lines = linesOf(readAll(dir_ / "calls"));
    const auto calls =
        std::ranges::count_if(lines, [&](const std::string& line) { return contains(line, call + "("); });
    EXPECT_GT(calls, 0) << call;
    for (const std::string fault : {"error=EIO", "signal=SIGTERM", "signal=SIGKILL"}) {
      int ended = 0;  // runs ended by the fault
      for (int n = 1; n <= calls; ++n) ended += runOverOld(call, fault, n) != 0;
      const bool is_survived = call == "linkat" && fault == "error=EIO";  // then old files are renamed instead
      // The first mkdir() is before the build; a commit that has begun is not cancelled.
      EXPECT_EQ(ended == 0, is_survived || (call != "mkdir" && fault == "signal=SIGTERM")) << call << ' ' << fault;
    }
  }
  for (const std::string signal : {"SIGINT", "SIGHUP"}) EXPECT_NE(runOverOld("mkdir", "signal=" + signal, 1), 0);
}

TEST_F(OutputOfCommands, OfTwoAtOnceIsWhollyThatOfOne) {
  const std::map<int, Content> results = {{12, resultsOf(12)}, {30, resultsOf(30)}};
  for (int round = 0; round < 8; ++round) {
    if (round % 2 == 0) fs::remove_all(dir_ / "out");
    Process one = startTufted(build(12)), other = startTufted(build(30));
    const Result first = one.finish(), second = other.finish();
    EXPECT_EQ(first.code, 0) << first.err;
    EXPECT_EQ(second.code, 0) << second.err;
    expectWhole(results);
  }
}

TEST_F(OutputOfCommands, ThatLasCannotHoldIsRefusedBeforeTheBuild) {
  const std::string file = dir_.write("sphere.xyz", sphere(400));
  std::string all = "0";
  for (int i = 1; i < 345; ++i) all += "," + std::to_string(i);
  for (const std::vector<std::string>& words : {std::vector<std::string>{"spectrum", "--count", "350"},
                                                {"spectrum", "--count", "350", "--with-null-space"},
                                                {"distance", "--matrix", "--source", all}}) {
    std::vector<std::string> command = {words[0], file, "--format", "las", "--out", in("out")};
    command.insert(command.end(), words.begin() + 1, words.end());
    const Result result = watchTufted(command);
    EXPECT_EQ(result.code, 2) << result.err;
    EXPECT_NE(result.err.find("values per point are more than LAS can hold, 341"), std::string::npos) << result.err;
    EXPECT_EQ(result.err.find("stars"), std::string::npos) << result.err;
  }
}

}  // namespace
}  // namespace output_test
