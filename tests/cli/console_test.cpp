// The command's output: help, version, summary with each option of the console, and progress.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "subcommands.h"
#include "tufted/version.h"

namespace console_test {
namespace {

namespace fs = std::filesystem;

class ConsoleOutput : public Subcommands {
 protected:
  static std::string help(const std::vector<std::string>& arguments) {
    const Result result = runTufted(arguments);
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    return result.out;
  }

  /// The names of all subcommands in the help, which lists them after two spaces.
  static std::vector<std::string> names() {
    std::vector<std::string> found;
    bool is_list = false;
    for (const std::string& line : linesOf(help({"--help"}))) {
      if (line == "Examples:") break;
      if (!line.empty() && line[0] != ' ') is_list = line != "Options:" && line.back() == ':';
      if (is_list && line.starts_with("  ") && line[2] != ' ') found.push_back(line.substr(2, line.find(' ', 2) - 2));
    }
    return found;
  }

  /// The words of each example in a help, without the first.
  static std::vector<std::vector<std::string>> examples(const std::string& text) {
    std::vector<std::vector<std::string>> found;
    for (const std::string& line : linesOf(text)) {
      if (!line.starts_with("  tufted ")) continue;
      std::istringstream stream(line.substr(line.find("tufted ") + 7));
      found.emplace_back();
      for (std::string word; stream >> word;) found.back().push_back(word);
    }
    return found;
  }

  /// Runs an example with files and folders in the folder of the test.
  void tryExample(std::vector<std::string> words) {
    const auto isFile = [](const std::string& word) {
      return word == "scans" || word.ends_with(".ply") || word.ends_with(".off") || word.ends_with(".png") ||
             word.ends_with(".txt");
    };
    for (std::size_t i = 1; i < words.size(); ++i)
      if (words[i - 1] == "--out" || words[i - 1] == "view" || isFile(words[i])) words[i] = in(words[i]);
    const Result result = runTufted(words);
    EXPECT_EQ(result.code, 0) << testing::PrintToString(words) << result.err;
  }
};

TEST_F(ConsoleOutput, WithoutArgumentsIsTheHelpWithSubcommandsByPurposeAndThreeExamples) {
  const std::string text = help({"--help"});
  for (const std::vector<std::string>& other : {std::vector<std::string>{}, {"help"}, {"-h"}})
    EXPECT_EQ(help(other), text);
  for (const char* purpose : {"Look at files:", "Matrices:", "Distances and directions along the surface:",
                              "Values on the surface:", "Frequencies:", "Shape:", "Moving the points:"})
    EXPECT_TRUE(contains(text, purpose)) << purpose;
  EXPECT_EQ(examples(text).size(), 3u);
  std::set<std::string> expected = {"info",   "validate",        "view",   "parameterize", "minimal", "map",
                                    "deform", "signed-distance", "weights"};
  for (const std::vector<std::string>& command : commands) expected.insert(command[0]);
  const std::vector<std::string> listed = names();
  EXPECT_EQ(std::set<std::string>(listed.begin(), listed.end()), expected) << text;
  EXPECT_EQ(listed.size(), expected.size()) << "one stands twice";
}

TEST_F(ConsoleOutput, HelpOfASubcommandIsThatOfItsOption) {
  for (const std::string& name : names()) {
    const std::string text = help({name, "--help"});
    EXPECT_EQ(help({"help", name}), text);
    EXPECT_EQ(help({name, "-h"}), text);
    const auto shown = examples(text);
    ASSERT_FALSE(shown.empty()) << name;
    EXPECT_EQ(shown[0][0], name);
  }
  const Result unknown = runTufted({"help", "spectum"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_TRUE(contains(unknown.err, "did you mean `spectrum`?")) << unknown.err;
}

TEST_F(ConsoleOutput, EveryExampleOfEveryHelpRuns) {
  fs::create_directory(dir_ / "scans");
  dir_.write("scan.ply", "");
  dir_.write("scan.xyz", sphere(400));
  dir_.write("mesh.off", tetrahedron);
  dir_.write("open.off", "OFF 4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");  // with a rim, for parameterize
  for (const char* name : {"flat.off", "bent.off"}) fs::copy_file(dir_ / "open.off", dir_ / name);
  dir_.write("pairs.txt", "0 0\n1 1\n");
  dir_.write("handles.txt", "0 0 0 1  # there\n3\n");
  dir_.write("rim.txt", "0\n1\n3\n");
  dir_.write("seam.txt", "0 1 2\n");
  dir_.write("points.txt", "0\n2\n");
  dir_.write("curve.txt", "0\n1\n2\n0\n");
  dir_.write("scans/mesh.off", tetrahedron);
  run({"laplacian", in("scan.xyz"), "--out", in("made")});
  fs::copy_file(dir_ / "made/points.ply", dir_ / "scan.ply", fs::copy_options::overwrite_existing);
  std::vector<std::vector<std::string>> all = examples(help({"--help"}));
  for (const std::string& name : names())
    for (const std::vector<std::string>& example : examples(help({name, "--help"}))) all.push_back(example);
  for (const std::vector<std::string>& example : all) tryExample(example);
}

TEST_F(ConsoleOutput, TheVersionSaysLicenceAndWhatIsBuiltIn) {
  const std::string text = help({"--version"});
  EXPECT_EQ(help({"-V"}), text);
  EXPECT_TRUE(text.starts_with("tufted " TUFTED_VERSION "\n")) << text;
  for (const char* part : {"BSD 3-clause", "GPL", "Factors:", "Reads:", "Writes:", "Eigen ", "CLI11 "})
    EXPECT_TRUE(contains(text, part)) << part;
}

TEST_F(ConsoleOutput, QuietSaysNothingAndJsonSaysTheReport) {
  const std::string file = dir_.write("sphere.xyz", sphere(300));
  for (std::vector<std::string> command : commands) {
    command.insert(command.begin() + 1, file);
    command.insert(command.end(), {"--out", in("out"), "--quiet"});
    const Result quiet = run(command);
    EXPECT_EQ(quiet.out, "") << command[0];
    command.back() = "--json";
    nlohmann::json said = nlohmann::json::parse(run(command).out);
    EXPECT_EQ(said["out"], in("out"));
    EXPECT_TRUE(said["warnings"].is_array());
    said.erase("out");
    said.erase("warnings");
    EXPECT_EQ(said, report("out")) << command[0];
  }
  EXPECT_EQ(runTufted({"laplacian", file, "--out", in("out"), "--json", "-q"}).code, 2);
  EXPECT_EQ(run({"info", file, "-q"}).out, "");
  EXPECT_EQ(run({"validate", file, "-q"}).out, "");
  EXPECT_EQ(nlohmann::json::parse(run({"validate", file, "--json"}).out)["summary"]["ok"], 1);
}

TEST_F(ConsoleOutput, JsonHasTheWarningsThatStderrHas) {
  const std::string file = dir_.write("line.xyz", "0 0 0\n1 0 0\n2 0 0\n3 0 0\n");
  for (const char* option : {"--json", "--quiet"}) {
    const Result result = runTufted({"laplacian", file, "--out", in("out"), option});
    EXPECT_EQ(result.code, 0);
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
    if (std::string(option) == "--quiet") continue;
    const nlohmann::json said = nlohmann::json::parse(result.out);
    ASSERT_EQ(said["warnings"].size(), 1u);
    EXPECT_TRUE(contains(result.err, said["warnings"][0].get<std::string>())) << result.err;
  }
}

/// An organized cloud of a plane of which every second pixel is missing.
std::string sparseImage() {
  constexpr int width = 40, height = 30;
  std::string text =
      "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 40\nHEIGHT 30\n"
      "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 1200\nDATA ascii\n";
  std::mt19937_64 generator(1);
  for (int i = 0; i < width * height; ++i) {
    const bool is_missing = generator() % 2 == 0 && i > 1;
    text += is_missing
                ? "nan nan nan\n"
                : std::to_string((i % width - 19.5) / 30) + ' ' + std::to_string((i / width - 14.5) / 30) + " 1\n";
  }
  return text;
}

/// A sheet of 9 x 9 points, which bulges; no triangle has further points as a corner.
std::string sheet(int points) {
  std::string text = "OFF\n" + std::to_string(points) + " 128 0\n";
  for (int i = 0; i < points; ++i)
    text += std::to_string(i / 9) + ' ' + std::to_string(i % 9) + ' ' +
            std::to_string(i < 81 ? (i / 9) * (8 - i / 9) * (i % 9) * (8 - i % 9) / 200. : 5.) + '\n';
  for (int i = 0; i < 72; ++i) {
    if (i % 9 == 8) continue;
    const std::string a = std::to_string(i), b = std::to_string(i + 9), c = std::to_string(i + 10);
    text += "3 " + a + ' ' + b + ' ' + c + "\n3 " + a + ' ' + c + ' ' + std::to_string(i + 1) + '\n';
  }
  return text;
}

TEST_F(ConsoleOutput, EveryCommandTellsWhatMustBeKnownOfTheSurface) {
  const auto expectWarning = [&](std::vector<std::string> command, const std::string& word) {
    SCOPED_TRACE(testing::PrintToString(command));
    command.insert(command.end(), {"--out", in("out"), "--json"});
    const Result result = runTufted(command);
    ASSERT_EQ(result.code, 0) << result.err;
    const nlohmann::json warnings = nlohmann::json::parse(result.out)["warnings"];
    ASSERT_EQ(warnings.size(), 1u) << warnings;
    EXPECT_TRUE(contains(warnings[0], word)) << warnings;
    EXPECT_EQ(result.err, "tufted: " + warnings[0].get<std::string>() + "\n");
  };
  const std::string image = dir_.write("image.pcd", sparseImage()), mesh = dir_.write("mesh.off", sheet(200));
  const std::string of_image = "fewer than half of the pixels hold points", of_mesh = "119 of 200 points take no part";
  for (const std::vector<std::string>& command : commands) {
    std::vector<std::string> words = command;
    words.insert(words.begin() + 1, image);
    words.insert(words.end(), {"--structure", "image"});
    expectWarning(words, of_image);
    if (command[0] == "denoise") continue;  // takes clouds only
    words = command;
    words.insert(words.begin() + 1, mesh);
    expectWarning(words, of_mesh);
  }
  const std::string few = dir_.write("few.txt", "0\n8\n72\n"), moved = dir_.write("moved.txt", "0\n8\n72 72 0 1\n");
  for (const std::vector<std::string>& command :
       std::vector<std::vector<std::string>>{{"parameterize", mesh},
                                             {"minimal", mesh},
                                             {"map", mesh, "--from", dir_.write("sheet.off", sheet(81))},
                                             {"deform", mesh, "--handles", moved},
                                             {"weights", mesh, "--handles", few},
                                             {"signed-distance", mesh, "--curve", dir_.write("row.txt", "0\n1\n2\n")}})
    expectWarning(command, of_mesh);
  // What the folder of a Laplacian tells is told again.
  ASSERT_EQ(runTufted({"laplacian", mesh, "--format", "npz,ply,cover", "--out", in("folder")}).code, 0);
  expectWarning({"distance", "--operator", in("folder"), "--source", "0"}, of_mesh);
  const Result looked = runTufted({"validate", mesh, "--json"});
  EXPECT_TRUE(contains(nlohmann::json::parse(looked.out)["files"][0]["warnings"].dump(), of_mesh)) << looked.out;
}

TEST_F(ConsoleOutput, DetailsAreForThoseWhoAskForThem) {
  const std::string file = dir_.write("sphere.xyz", sphere(300));
  const std::string usual = run({"laplacian", file, "--out", in("out")}).out;
  const std::string verbose = run({"laplacian", file, "--out", in("out"), "-v"}).out;
  for (const char* detail : {"flips", "clamped", "nonzeros/row"}) {
    EXPECT_FALSE(contains(usual, detail)) << usual;
    EXPECT_TRUE(contains(verbose, detail)) << verbose;
  }
  for (const std::string& line : linesOf(usual))
    EXPECT_TRUE(line.starts_with("took ") || contains(verbose, line)) << line;
  EXPECT_FALSE(contains(run({"green", file, "--source", "0", "--out", in("green")}).out, "residual"));
  EXPECT_TRUE(contains(run({"green", file, "--source", "0", "--out", in("green"), "--verbose"}).out, "residual"));
}

TEST_F(ConsoleOutput, FormatsAreListsInAllSubcommands) {
  const std::string file = dir_.write("sphere.xyz", sphere(300));
  for (std::vector<std::string> command : commands) {
    const auto format = std::find(command.begin(), command.end(), "--format");
    if (format != command.end()) command.erase(format, format + 2);
    command.insert(command.begin() + 1, file);
    const auto written = [&](const std::string& list, const std::string& folder) {
      std::vector<std::string> words = command;
      words.insert(words.end(), {"--out", in(folder), "--format", list});
      return runTufted(words).code;
    };
    fs::remove_all(dir_ / "both");
    fs::remove_all(dir_ / "neither");
    EXPECT_EQ(written("pcd,ply", "both"), 0) << command[0];
    EXPECT_TRUE(fs::exists(dir_ / "both/points.ply") && fs::exists(dir_ / "both/points.pcd")) << command[0];
    EXPECT_EQ(written("none", "neither"), 0) << command[0];
    EXPECT_TRUE(fs::exists(dir_ / "neither/report.json")) << command[0];
    EXPECT_FALSE(fs::exists(dir_ / "neither/points.ply") || fs::exists(dir_ / "neither/points.pcd")) << command[0];
    EXPECT_EQ(written("pyl", "refused"), 2) << command[0];
  }
  for (const char* wrong : {"none,ply", "ply,none", ""})
    EXPECT_EQ(runTufted({"laplacian", file, "--out", in("refused"), "--format", wrong}).code, 2) << wrong;
  EXPECT_FALSE(fs::exists(dir_ / "refused"));
}

/// The percentages that a progress bar showed, and the stage of the last.
std::pair<std::vector<int>, std::string> percentagesIn(const std::string& shown) {
  std::pair<std::vector<int>, std::string> found;
  for (std::size_t at = shown.find(" % "); at != std::string::npos; at = shown.find(" % ", at + 1)) {
    found.first.push_back(std::stoi(shown.substr(at - 3, 3)));
    found.second = shown.substr(at + 3, shown.find_first_of(",\033", at) - at - 3);
  }
  return found;
}

TEST_F(ConsoleOutput, OneBarShowsTheShareOfTheWholeCommand) {
  const std::string cloud = dir_.write("sphere.xyz", sphere(3000)), mesh = dir_.write("mesh.off", tetrahedron);
  const std::string large = dir_.write("large.xyz", sphere(60000));  // for more than a second of tiles
  for (const std::vector<std::string>& words : {std::vector<std::string>{"laplacian", cloud},
                                                {"spectrum", cloud, "--count", "5"},
                                                {"distance", cloud, "--source", "0"},
                                                {"distance", cloud, "--source", "0", "--method", "heat"},
                                                {"green", cloud, "--source", "0"},
                                                {"laplacian", large, "--keep-noise", "--memory", "270M"},
                                                {"distance", mesh, "--source", "0"}}) {
    std::vector<std::string> command = words;
    command.insert(command.end(), {"--out", in("out"), "--threads", "1"});
    const auto [percentages, last] = percentagesIn(watchTufted(command).err);
    ASSERT_GT(percentages.size(), 10u) << words[0];
    // The first ones are of reading alone.
    EXPECT_TRUE(std::is_sorted(percentages.begin(), percentages.end())) << words[0];
    EXPECT_GE(percentages.back(), 94) << words[0];
    EXPECT_EQ(last, "write") << words[0];
  }
}

TEST_F(ConsoleOutput, OnATerminalProgressShowsStagesAndTheirPaceAndQuietShowsNone) {
  const std::string file = dir_.write("sphere.xyz", sphere(30000));
  const std::string shown = watchTufted({"laplacian", file, "--out", in("out"), "--threads", "1"}).err;
  for (const char* part : {"read", "stars", "%"}) EXPECT_TRUE(contains(shown, part)) << part;
  EXPECT_TRUE(shown.ends_with("\033[K")) << "the bar is left behind";
  EXPECT_EQ(watchTufted({"laplacian", file, "--out", in("out"), "-q"}).err, "");
}

}  // namespace
}  // namespace console_test
