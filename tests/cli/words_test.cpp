// Errors name an unknown word, and the one that was probably meant.
#include <gtest/gtest.h>

#include "subcommands.h"

namespace words_test {
namespace {

class Words : public Subcommands {
 protected:
  /// Expects a usage error of this line after "tufted: ".
  void expectSaid(const std::vector<std::string>& arguments, const std::string& line) {
    const Result result = runTufted(arguments);
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.err, "tufted: " + line + "\n");
    EXPECT_EQ(result.out, "");
  }

  const std::string cloud_ = dir_.write("sphere.xyz", sphere(100));
};

TEST_F(Words, AnUnknownCommandIsNamedWithTheNearest) {
  const auto said = [](const std::string& word, const std::string& meant) {
    return "unknown command `" + word + "`; did you mean `" + meant + "`? (see tufted --help)";
  };
  expectSaid({"lapacian"}, said("lapacian", "laplacian"));
  expectSaid({"Laplacian", cloud_, "--out", in("out")}, said("Laplacian", "laplacian"));
  expectSaid({"lapacian", "--help"}, said("lapacian", "laplacian"));
  expectSaid({"spectum", cloud_}, said("spectum", "spectrum"));
  expectSaid({"flter", cloud_}, said("flter", "filter"));
  expectSaid({"inof", cloud_}, said("inof", "info"));
  expectSaid({"help", "spectum"}, said("spectum", "spectrum"));
  expectSaid({"validate-fil"}, said("validate-fil", "validate"));
  expectSaid(
      {"xyz"},
      "unknown command `xyz`, must be one of info, view, validate, laplacian, operators, distance, path, trace, "
      "signed-distance, logmap, "
      "transport, isolines, interpolate, extend, weights, poisson, green, spectrum, hks, embed, filter, map, normals, "
      "curvature, segment, "
      "parameterize, denoise, smooth, minimal, deform (see tufted --help)");
  expectSaid({"--hlep"}, "unknown option `--hlep`; did you mean `--help`? (see tufted --help)");
}

TEST_F(Words, AnUnknownOptionIsNamedWithTheNearest) {
  const auto expectOption = [&](std::vector<std::string> arguments, const std::string& word, const std::string& meant) {
    expectSaid(arguments, "unknown option `" + word + "`" + (meant.empty() ? "" : "; did you mean `" + meant + "`?") +
                              " (see tufted " + arguments[0] + " --help)");
  };
  expectOption({"laplacian", cloud_, "--ouput", "o"}, "--ouput", "--out");
  expectOption({"laplacian", cloud_, "--output=o"}, "--output", "--out");
  expectOption({"laplacian", cloud_, "-out", "o"}, "-out", "--out");
  expectOption({"laplacian", cloud_, "-out=o"}, "-out", "--out");
  expectOption({"laplacian", cloud_, "--out", "o", "--neighbor", "7"}, "--neighbor", "--neighbors");
  expectOption({"laplacian", cloud_, "--hlep"}, "--hlep", "--help");
  expectOption({"laplacian", cloud_, "--out", "o", "-k", "7"}, "-k", "");
  expectOption({"laplacian", cloud_, "--out", "o", "--frobnicate"}, "--frobnicate", "");
  expectOption({"distance", "--sorce", "3", cloud_, "--out", "o"}, "--sorce", "--source");
  expectOption({"distance", "--near", "-1,0,0", cloud_, "--ot", "o"}, "--ot", "--out");
  expectOption({"filter", cloud_, "--out", "o", "--positons"}, "--positons", "--positions");
  expectOption({"hks", cloud_, "--out", "o", "--wawe"}, "--wawe", "--wave");
  expectOption({"info", cloud_, "--jason"}, "--jason", "--json");
  expectOption({"validate", cloud_, "--job", "2"}, "--job", "--jobs");
  for (const char* folder : {"o", "ut", "ut=o"}) EXPECT_FALSE(std::filesystem::exists(folder)) << folder;
}

TEST_F(Words, WhatIsMissingIsNamedWithTheHelpOfTheCommand) {
  expectSaid({"laplacian", cloud_}, "--out is required (see tufted laplacian --help)");
  expectSaid({"laplacian", "--out", in("out")}, "FILE is required (see tufted laplacian --help)");
  expectSaid({"green", "--out", in("out")}, "exactly one of FILE and --operator is required (see tufted green --help)");
  expectSaid({"info"}, "FILE is required (see tufted info --help)");
  expectSaid({"validate"}, "PATH or --operator is required (see tufted validate --help)");
  expectSaid({"filter", cloud_, "--out", in("out")},
             "nothing to filter is given, must be exactly one of --field, --values and --positions");
}

TEST_F(Words, MisusedOptionsAreNamedWithTheRule) {
  const std::string out = in("out");
  expectSaid(
      {"distance", cloud_, "--near", "0", "0", "1", "--out", out},
      "--near 0 0 1 has blanks between its numbers, must have commas: --near 0,0,1 (see tufted distance --help)");
  expectSaid({"laplacian", cloud_, "--png", "--out", out},
             "--png has no value, must have FILE.png (see tufted laplacian --help)");
  expectSaid({"laplacian", cloud_, "--out"}, "--out has no value, must have DIR (see tufted laplacian --help)");
  expectSaid({"laplacian", cloud_, "--out", out, "--preset", "clean", "--preset", "scan"},
             "--preset is given twice, must be given once (see tufted laplacian --help)");
  expectSaid({"laplacian", cloud_, "--out", out, "a", "b"}, "not expected: a b (see tufted laplacian --help)");
}

TEST_F(Words, AMisspeltValueIsNamedWithTheNearest) {
  const auto expectValue = [&](const std::string& option, const std::string& value, const std::string& rule) {
    expectSaid({"laplacian", cloud_, "--out", in("out"), option, value},
               option + ": " + value + " " + rule + " (see tufted laplacian --help)");
  };
  expectValue("--preset", "scna", "is none of clean|lidar|scan; did you mean `scan`?");
  expectValue("--sign", "igll", "is none of igl|psd; did you mean `igl`?");
  expectValue("--structure", "Rings", "is none of automatic|image|none|rings; did you mean `rings`?");
  expectValue("--gluing", "tape", "is none of star|vertex-pair");
  expectValue("--as", "clod", "is none of cloud|mesh; did you mean `cloud`?");
  expectValue("--format", "spmta",
              "is none of cover|las|mat|mtx|npz|pcd|petsc|ply|spmat|triangles|none; did you mean `spmat`?");
  expectSaid(
      {"embed", cloud_, "--out", in("out"), "--distance", "biharmonc"},
      "--distance: biharmonc is none of biharmonic|commute; did you mean `biharmonic`? (see tufted embed --help)");
  const std::string fields = dir_.write("fields.txt", "x y z intensity\n0 0 0 1\n1 0 0 2\n0 1 0 3\n");
  expectSaid({"poisson", fields, "--out", in("out"), "--field", "intensty"},
             "--field intensty: " + fields + " has no such field; did you mean `intensity`?");
}

TEST_F(Words, ListsHaveNoEmptyWords) {
  const std::string fields = dir_.write("fields.txt", "x y z f\n0 0 0 1\n1 0 0 2\n0 1 0 3\n0 0 1 3\n");
  const auto expectList = [&](const std::vector<std::string>& command, const std::string& option,
                              const std::string& one, const std::string& other) {
    for (const std::string& list : {one + ",," + other, one + ",", "," + other}) {
      std::vector<std::string> arguments = command;
      arguments.insert(arguments.end(), {fields, "--out", in("out"), option, list});
      expectSaid(arguments,
                 option + ": " + list + " has an empty word, must have none (see tufted " + command[0] + " --help)");
    }
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.end(), {fields, "--out", in("out"), option, ""});
    expectSaid(arguments, option + ": must not be empty (see tufted " + command[0] + " --help)");
  };
  expectList({"laplacian"}, "--format", "ply", "pcd");
  expectList({"denoise"}, "--format", "ply", "pcd");
  expectList({"spectrum"}, "--format", "ply", "pcd");
  expectList({"hks"}, "--times", "0.5", "1");
  expectList({"poisson"}, "--field", "f", "f");
  EXPECT_FALSE(std::filesystem::exists(in("out")));
}

TEST_F(Words, ValuesOutOfRangeNameTheirOptionAndTheRule) {
  const std::string square = dir_.write("square.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
  expectRefusal({"distance", square, "--face", "2,1,1,1"}, "--face 2,1,1,1: face = 2, must lie in [0, 2)");
  expectRefusal({"filter", cloud_, "--positions", "--wavelength", "0"}, "--wavelength: 0 is not a number in (0, inf)");
  expectRefusal({"distance", cloud_, "--source", "0", "--time-step", "0"},
                "--time-step: 0 is not a number in [0.0001, 1e+12]");
  expectRefusal({"embed", cloud_, "--dimension", "100"}, "--dimension = 100, must be at most 99, of 100 points");
  expectRefusal({"hks", cloud_, "--samples", "1"}, "--samples: 1 is not an integer in [2, 65536]");
}

TEST_F(Words, TheShortOptionForOutIsTakenByEveryCommand) {
  for (std::vector<std::string> command : commands) {
    const std::string name = command[0];
    command.insert(command.end(), {cloud_, "-o", in(name)});
    run(command);
    EXPECT_TRUE(std::filesystem::exists(dir_ / name / "report.json")) << name;
  }
}

TEST_F(Words, APipeIsReadAsStandardInput) {
  const std::string mesh = dir_.write("tetrahedron.off", tetrahedron);
  for (const std::string& file : {cloud_, mesh}) {
    run({"laplacian", file, "--out", in("file")});
    const std::string command = tuftedCommand() + " laplacian <(cat " + file + ") --out " + in("pipe");
    const Result result = runProgram({"bash", "-c", command});
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_TRUE(readAll(dir_ / "pipe/L.npz") == readAll(dir_ / "file/L.npz")) << file;
  }
  const std::string bad = "cat " + dir_.write("bad.xyz", "1 2 3\n1 two 3\n").string();
  const Result result = runProgram({"bash", "-c", tuftedCommand() + " info <(" + bad + ")"});
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.err.find("line 2: 'two' is not a number"), std::string::npos) << result.err;
}

TEST_F(Words, FewerNeighboursThanAskedForAreStated) {
  const std::string line = "neighbors       99 and not 999999: all other points\n";
  const auto outOf = [](const std::vector<std::string>& command) {
    const Result result = runTufted(command);
    EXPECT_EQ(result.code, 0);
    EXPECT_TRUE(contains(result.err, "neighbourhood of each point is the whole cloud")) << result.err;
    return result.out;
  };
  EXPECT_TRUE(contains(outOf({"laplacian", cloud_, "--out", in("out"), "--neighbors", "999999"}), line));
  EXPECT_EQ(report("out")["report"]["neighbors"], 99);
  EXPECT_EQ(report("out")["report"]["neighbors_clamped"], true);
  EXPECT_TRUE(contains(outOf({"green", cloud_, "--source", "0", "--out", in("g"), "--neighbors", "999999"}), line));
  EXPECT_EQ(report("g")["build"]["neighbors"], 99);
  EXPECT_EQ(report("g")["build"]["neighbors_clamped"], true);
  EXPECT_TRUE(contains(run({"info", cloud_, "--neighbors", "999999"}).out, "neighbors       99, all other points\n"));
  EXPECT_FALSE(contains(run({"laplacian", cloud_, "--out", in("out"), "--neighbors", "30"}).out, "neighbors"));
  EXPECT_FALSE(contains(run({"info", cloud_}).out, "neighbors"));
}

}  // namespace
}  // namespace words_test
