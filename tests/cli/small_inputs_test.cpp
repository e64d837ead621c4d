// Every subcommand with its defaults on the smallest clouds and meshes.
#include <algorithm>

#include "subcommands.h"

namespace small_inputs_test {
namespace {

class SmallInputs : public Subcommands {
 protected:
  /// Runs with defaults every subcommand that works on any surface, and checks that results have numbers.
  void runAll(const std::string& file, bool is_open) {
    std::vector<std::vector<std::string>> all = commands;
    for (std::vector<std::string>& words : all)
      if (const auto count = std::find(words.begin(), words.end(), "--count"); count != words.end())
        words.erase(count, count + 2);
    all.insert(all.end(), {{"hks", "--samples", "2"},
                           {"segment", "--method", "spectral"},
                           {"segment", "--method", "parts"},
                           {"embed", "--distance", "biharmonic"},
                           {"spectrum", "--with-null-space"},
                           {"distance", "--source", "0", "--method", "heat"},
                           {"weights", "--handles", dir_.write("handles.txt", "0\n1\n")},
                           {"signed-distance", "--curve", in("handles.txt")},
                           {"signed-distance", "--curve", in("handles.txt"), "--method", "marching"},
                           {"smooth", "--method", "taubin"},
                           {"deform", "--handles", dir_.write("targets.txt", "0 0 0 0\n1 1 1 1\n")}});
    if (is_open) all.insert(all.end(), {{"parameterize"}, {"parameterize", "--method", "harmonic"}, {"minimal"}});
    for (std::vector<std::string> words : all) {
      if (words[0] == "denoise" && file.ends_with(".off")) continue;  // for clouds only
      words.insert(words.begin() + 1, file);
      words.insert(words.end(), {"--out", in("out")});
      std::string line;
      for (const std::string& word : words) line += word + ' ';
      const Result result = runTufted(words);
      EXPECT_EQ(result.code, 0) << line << result.err;
      std::filesystem::remove_all(in("out"));
    }
  }
};

TEST_F(SmallInputs, OfTheSmallestMeshesDefaultsGiveResults) {
  runAll(dir_.write("tetrahedron.off", tetrahedron), false);
  runAll(
      dir_.write("regular.off", "OFF\n4 4 0\n1 1 1\n1 -1 -1\n-1 1 -1\n-1 -1 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"),
      false);
  runAll(dir_.write("square.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n"), true);
}

TEST_F(SmallInputs, OfTheSmallestCloudsDefaultsGiveResults) {
  runAll(dir_.write("square.xyz", "0 0 0\n1 0 0\n1 1 0\n0 1 0\n"), false);
  runAll(dir_.write("corner.xyz", "0 0 0\n1 0 0\n0 1 0\n0 0 1\n"), false);
  for (const int points : {5, 6, 7, 9, 12, 20, 40}) runAll(dir_.write("sphere.xyz", sphere(points)), false);
}

TEST_F(SmallInputs, AllPairsThatThereAreCanBeAskedFor) {
  const std::string cloud = dir_.write("sphere.xyz", sphere(300));
  run({"spectrum", cloud, "--count", "299", "--out", in("all")});
  EXPECT_EQ(values("all/evals.npy").size(), 299u);
  run({"spectrum", cloud, "--count", "299", "--with-null-space", "--out", in("null")});
  EXPECT_EQ(values("null/evals.npy").size(), 300u);
  run({"operators", cloud, "--count", "300", "--out", in("operators")});
  run({"hks", cloud, "--count", "299", "--out", in("hks")});
  run({"hks", cloud, "--count", "299", "--spectrum", in("all"), "--out", in("folder")});
  EXPECT_EQ(values("hks/hks.npy"), values("folder/hks.npy"));
  expectRefusal({"spectrum", cloud, "--count", "300"}, "--count = 300, must be at most 299, of 300 points");
  expectRefusal({"operators", cloud, "--count", "301"}, "--count = 301, must be at most 300, of 300 points");
}

TEST_F(SmallInputs, ADefaultCountIsThatOfWhatThereIs) {
  const std::string cloud = dir_.write("sphere.xyz", sphere(70));
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{{"hks"}, {"hks", "--wave"}}) {
    std::vector<std::string> all = words, none = words;
    all.insert(all.end(), {cloud, "--count", "69", "--out", in("all")});
    none.insert(none.end(), {cloud, "--out", in("none")});
    run(all);
    run(none);
    EXPECT_EQ(values("all/evals.npy").size(), 69u);
    EXPECT_EQ(values("all/evals.npy"), values("none/evals.npy"));
  }
  // Two components have one positive eigenvalue less.
  const std::string two = dir_.write("two.off",
                                     "OFF\n8 8 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n9 0 0\n10 0 0\n9 1 0\n9 0 1\n"
                                     "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n3 4 6 5\n3 4 5 7\n3 5 6 7\n3 6 4 7\n");
  run({"spectrum", two, "--out", in("two")});
  EXPECT_EQ(values("two/evals.npy").size(), 6u);
}

}  // namespace
}  // namespace small_inputs_test
