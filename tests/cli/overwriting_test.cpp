// Output never replaces an input, and a command that fails never replaces earlier results.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "../io/folder_content.h"
#include "subcommands.h"

namespace overwriting_test {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

class Overwriting : public Subcommands {
 protected:
  Words with(Words words, const Words& more) const {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  /// Everything below the folder of the test, by path.
  std::map<std::string, std::string> everything() const {
    std::map<std::string, std::string> content;
    for (const auto& entry : fs::recursive_directory_iterator(dir_.path()))
      content[entry.path().string()] = entry.is_directory() ? "directory" : readAll(entry.path());
    return content;
  }

  const std::string cloud_ = dir_.write("sphere.xyz", sphere(200));
};

TEST_F(Overwriting, ALookThatFailsLeavesFormerResultsAndNothingElse) {
  for (Words command : commands) {
    command.insert(command.end(), {cloud_, "--out", in("out")});
    run(command);
    const auto before = everything();
    std::vector<Words> looks = {{"--png", in("p.png")}};
    if (command[0] == "distance") looks.insert(looks.end(), {{"--view", in("v.html")}, {"--color", "mass"}});
    for (const Words& look : looks) {
      const Result result = runTufted(with(with(command, look), {"--column", "1000"}));
      EXPECT_EQ(result.code, 2) << command[0];
      EXPECT_TRUE(contains(result.err, "--column 1000: ")) << result.err;
      EXPECT_TRUE(everything() == before) << command[0] << ' ' << look[0];
    }
    fs::remove_all(dir_ / "out");
  }
}

TEST_F(Overwriting, AColumnIsRefusedBeforeTheBuildWhereItIsKnown) {
  // The file has no normals, so a build fails with --normals.
  for (const Words& command : std::vector<Words>{{"distance", "--source", "0"},
                                                 {"distance", "--source", "0,1", "--matrix"},
                                                 {"laplacian"},
                                                 {"curvature"},
                                                 {"smooth"},
                                                 {"segment"},
                                                 {"green", "--source", "0,1"},
                                                 {"interpolate", "--pin", "0=1"},
                                                 {"embed"},
                                                 {"spectrum", "--count", "3"}})
    expectRefusal(with(command, {cloud_, "--normals", "--png", in("p.png"), "--column", "5"}), "--column 5: ");
}

TEST_F(Overwriting, EveryFieldThatARefusalNamesIsShown) {
  for (Words command : commands) {
    command.push_back(cloud_);
    const Result refused = runTufted(with(command, {"--out", in("out"), "--color", "?"}));
    EXPECT_EQ(refused.code, 2) << command[0];
    const std::string begin = "--color ? is none of ";
    const std::size_t at = refused.err.find(begin);
    ASSERT_NE(at, std::string::npos) << refused.err;
    std::istringstream names(refused.err.substr(at + begin.size()));
    int count = 0;
    for (std::string name; names >> name; ++count) {
      name.erase(std::remove(name.begin(), name.end(), ','), name.end());
      run(with(command, {"--out", in("out"), "--color", name, "--png", in("p.png"), "--size", "40x30"}));
    }
    EXPECT_GT(count, 0) << command[0];
  }
}

/// A command whose input is called INPUT.
struct Reading {
  Words words;
  std::string text;  ///< content of the input
};

TEST_F(Overwriting, NoOutputIsAnInputByWhateverWay) {
  run({"spectrum", cloud_, "--count", "5", "--out", in("modes")});
  const std::string points = sphere(200), pins = "0 1\n5 2\n", near = "0 0 1 1\n", indices = "0\n7\n";
  std::string npy = "{'descr': '<f8', 'fortran_order': False, 'shape': (200,), }\n";
  npy = std::string("\x93NUMPY\x01\0", 8) + static_cast<char>(npy.size()) + '\0' + npy + std::string(1600, '\0');
  const std::string mesh =
      dir_.write("disk.off", "OFF\n5 4 0\n0 0 1\n1 0 0\n0 1 0\n-1 0 0\n0 -1 0\n3 0 1 2\n3 0 2 3\n3 0 3 4\n3 0 4 1\n");
  const std::vector<Reading> readings = {
      {{"laplacian", "INPUT"}, points},
      {{"denoise", "INPUT"}, points},
      {{"distance", "INPUT", "--source", "0"}, points},
      {{"distance", cloud_, "--source", "0", "--polygon", "INPUT"}, "-9 -9\n9 -9\n9 9\n-9 9\n"},
      {{"distance", cloud_, "--sources", "INPUT"}, indices},
      {{"green", cloud_, "--sources", "INPUT"}, indices},
      {{"logmap", cloud_, "--sources", "INPUT"}, "3\n"},
      {{"transport", cloud_, "--sources", "INPUT", "--vector", "1,2,3"}, "3\n"},
      {{"interpolate", cloud_, "--pins", "INPUT"}, pins},
      {{"interpolate", cloud_, "--pins-near", "INPUT"}, near},
      {{"extend", cloud_, "--pins", "INPUT"}, pins},
      {{"poisson", cloud_, "--values", "INPUT"}, npy},
      {{"poisson", cloud_, "--field", "x", "--pins", "INPUT"}, pins},
      {{"filter", cloud_, "--count", "3", "--values", "INPUT"}, npy},
      {{"trace", cloud_, "--sources", "INPUT", "--direction", "1,2,3", "--length", "1"}, "3\n"},
      {{"isolines", cloud_, "--count", "3", "--values", "INPUT"}, npy},
      {{"smooth", cloud_, "--values", "INPUT"}, npy},
      {{"smooth", cloud_, "--fixed", "INPUT"}, indices},
      {{"map", cloud_, "--from", "INPUT"}, points},
      {{"map", mesh, "--from", mesh, "--landmarks", "INPUT"}, "0 0\n"},
      {{"minimal", mesh, "--fixed", "INPUT"}, "1\n2\n3\n4\n"},
      {{"deform", cloud_, "--handles", "INPUT"}, "0 0 0 1\n3 1 0 0\n9 0 1 0\n"},
      {{"weights", cloud_, "--handles", "INPUT"}, indices},
      {{"signed-distance", cloud_, "--curve", "INPUT"}, "0\n7\n19\n"},
      {{"parameterize", mesh, "--method", "harmonic", "--rim", "INPUT"}, "1\n2\n3\n4\n"},
      {{"parameterize", mesh, "--cut", "INPUT"}, "1 0\n"}};
  std::set<std::string> options;
  for (const Reading& reading : readings) {
    const bool is_first = &reading == &readings[0];  // all readings ask the same function whether two paths are one
    const auto named = [&](const std::string& input) {
      Words words = reading.words;
      std::replace(words.begin(), words.end(), std::string("INPUT"), input);
      return words;
    };
    const auto expectKept = [&](const Words& words) {
      const auto before = everything();
      const Result result = runTufted(words);
      EXPECT_EQ(result.code, 2) << words[0] << ": " << result.err << result.out;
      EXPECT_TRUE(contains(result.err, " would overwrite it")) << result.err;
      EXPECT_TRUE(everything() == before) << words[0];
    };
    fs::create_directories(dir_ / "here");
    for (const auto& [option, ending] : {std::pair("--png", ".png"), {"--view", ".html"}}) {
      const std::string input = dir_.write(std::string("here/input") + ending, reading.text),
                        link = in("link") + ending;
      fs::create_symlink(input, link);
      std::vector<std::string> outputs = {input};
      if (is_first) outputs.insert(outputs.end(), {in("here/../here/./input") + ending, link});
      for (const std::string& output : outputs) {
        expectKept(with(named(input), {"--out", in("new"), option, output}));
        expectKept(with(named(output), {"--out", in("new"), option, input}));
      }
      fs::remove(link);
      fs::remove(input);
    }
    // Names of results in --out. Points can only be in points.ply, because readers go by the extension.
    dir_.write("input", reading.text);
    run(with(named(in("input")), {"--out", in("made")}));
    std::vector<std::string> names = {"points.ply"};
    for (const auto& [name, bytes] : contentOf(dir_ / "made"))
      if (reading.words[1] != "INPUT" && name.ends_with(".npy")) names.push_back(name);
    for (const std::string& name : names) {
      fs::create_directories(dir_ / "old");
      const std::string input = dir_.write("old/" + name, reading.text);
      expectKept(with(named(input), {"--out", in("old")}));
      if (is_first) {
        expectKept(with(named(in("here/../old/" + name)), {"--out", in("old/.")}));
        fs::create_symlink(input, in("link"));
        expectKept(with(named(in("link")), {"--out", in("old")}));
        fs::remove(in("link"));
      }
      fs::remove_all(dir_ / "old");
    }
    fs::remove_all(dir_ / "made");
    const auto place = std::find(reading.words.begin(), reading.words.end(), "INPUT");
    if (place - reading.words.begin() > 1) options.insert(*(place - 1));
  }
  // All options of all subcommands that name a file occur above.
  for (const Reading& reading : readings) {
    std::istringstream lines(runTufted({reading.words[0], "--help"}).out);
    for (std::string line; std::getline(lines, line);) {
      const bool names_input = contains(line, " TEXT ") || contains(line, " SOURCE ") || contains(line, " NPY ");
      const std::size_t begin = line.find("--");
      if (!names_input || begin == std::string::npos) continue;
      const std::string option = line.substr(begin, line.find_first_of(" ,", begin) - begin);
      EXPECT_TRUE(options.contains(option)) << line;
    }
  }
}

TEST_F(Overwriting, AFolderThatIsReadIsNotWritten) {
  run({"laplacian", cloud_, "--out", in("folder")});
  run({"spectrum", cloud_, "--count", "5", "--out", in("modes")});
  fs::create_directory_symlink(in("folder"), in("link"));
  fs::create_directory_symlink(in("modes"), in("other"));
  const auto before = everything();
  for (const Words& words : {Words{"spectrum", "--count", "3", "--operator", in("folder"), "--out", in("folder/.")},
                             {"spectrum", "--count", "3", "--operator", in("link"), "--out", in("folder")},
                             {"spectrum", "--count", "3", "--operator", in("folder"), "--out", in("link")},
                             {"hks", cloud_, "--spectrum", in("other"), "--out", in("modes")},
                             {"hks", cloud_, "--spectrum", in("modes"), "--out", in("modes")}}) {
    const Result result = runTufted(words);
    EXPECT_EQ(result.code, 2);
    EXPECT_TRUE(contains(result.err, "would overwrite it")) << result.err;
  }
  EXPECT_TRUE(everything() == before);
}

TEST_F(Overwriting, APictureHasTheEndingOfItsFormatBehindLinksToo) {
  const Words distance = {"distance", cloud_, "--source", "0"};
  dir_.write("notes.txt", "mine");
  fs::create_symlink(in("notes.txt"), in("notes.png"));
  fs::create_symlink(in("notes.txt"), in("notes.html"));
  for (const char* name : {"a.txt", "a", "a.html", "a.png.txt", ".png", "a.npy", "a.json", "a.pngx"})
    expectRefusal(with(distance, {"--png", in(name)}), "must end in .png");
  for (const char* name : {"a.txt", "a", "a.png", "a.js"})
    expectRefusal(with(distance, {"--view", in(name)}), "must end in .html");
  expectRefusal(with(distance, {"--png", in("notes.png")}), "notes.txt, which must end in .png");
  expectRefusal(with(distance, {"--view", in("notes.html")}), "notes.txt, which must end in .html");
  EXPECT_EQ(readAll(dir_ / "notes.txt"), "mine");
  run(with(distance, {"--png", in("A.PNG"), "--view", in("A.HTM"), "--size", "40x30", "--out", in("out")}));
}

TEST_F(Overwriting, APictureIsNotWhereAFolderOfTheResultsIs) {
  const Words distance = {"distance", cloud_, "--source", "0"};
  for (const char* out : {"p.png", "p.png/deep/er", "x/../p.png"}) {
    const Result result = runTufted(with(distance, {"--png", in("p.png"), "--out", in(out)}));
    EXPECT_EQ(result.code, 2);
    EXPECT_TRUE(contains(result.err, "is a folder that --out")) << result.err;
    EXPECT_FALSE(fs::exists(in("p.png")));
  }
}

}  // namespace
}  // namespace overwriting_test
