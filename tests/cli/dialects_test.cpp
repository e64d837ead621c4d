// Odd files and options of building, with all subcommands.
#include <gtest/gtest.h>

#include <sstream>

#include "subcommands.h"

namespace dialects_test {
namespace {

class Dialects : public Subcommands {
 protected:
  /// Arguments that run a command of `commands` on a file.
  std::vector<std::string> on(const std::string& file, std::vector<std::string> command) const {
    command.insert(command.begin() + 1, file);
    command.insert(command.end(), {"--out", in("out"), "--json"});
    return command;
  }
};

TEST_F(Dialects, EverySubcommandWarnsOfBytesThatItHasNotRead) {
  const std::string file = dir_.write("a.xyz", "100\n" + sphere(100) + "7 8 9\n");
  const std::string warning =
      "tufted: " + file + ": line 102: 6 bytes behind the last record that the file counts, not read\n";
  std::vector<std::vector<std::string>> all;
  for (const std::vector<std::string>& command : commands) all.push_back(on(file, command));
  all.push_back({"info", file, "--json"});
  all.push_back({"view", file, "--out", in("a.html"), "--json"});
  all.push_back({"validate", file, "--json"});
  for (const std::vector<std::string>& command : all) {
    const Result result = runTufted(command);
    EXPECT_EQ(result.code, 0) << command[0] << result.err;
    EXPECT_EQ(result.err, warning) << command[0];
    const nlohmann::json json = nlohmann::json::parse(result.out);
    const nlohmann::json warnings = command[0] == "validate" ? json["files"][0]["warnings"] : json["warnings"];
    EXPECT_EQ(warnings.size(), 1u) << command[0];
    EXPECT_EQ("tufted: " + warnings[0].get<std::string>() + "\n", warning) << command[0];
  }
}

TEST_F(Dialects, FieldsAreNamedAsTheFileOrThisProgramNamesThem) {
  std::string text = "\"X\",\"Y\",\"Z\",\"Intensity\",\"MyValue\"\n";
  std::istringstream points(sphere(100));
  for (double x = 0, y = 0, z = 0; points >> x >> y >> z;)
    text += std::to_string(x) + "," + std::to_string(y) + "," + std::to_string(z) + ",7," + std::to_string(z) + "\n";
  const std::string file = dir_.write("a.csv", text);
  for (const char* name : {"Intensity", "intensity", "INTENSITY", "MyValue", "myvalue", "X", "Z"}) {
    run({"smooth", file, "--field", name, "--out", in("out")});
    if (std::string(name).size() == 1) continue;
    run({"laplacian", file, "--out", in("out"), "--png", in("a.png"), "--size", "64x64", "--color", name});
    run({"view", file, "--field", name, "--png", in("a.png"), "--size", "64x64", "-q"});
  }
}

TEST_F(Dialects, EverySubcommandThatBuildsTakesAllOptionsOfBuilding) {
  const std::string file = dir_.write("a.xyz", sphere(100));
  for (std::vector<std::string> command : commands) {
    if (command[0] == "denoise") continue;  // builds no Laplacian
    std::vector<std::string> refused = command;
    refused.insert(refused.begin() + 1, file);
    refused.insert(refused.end(), {"--seed", "3"});
    expectRefusal(refused, "--seed requires --order random");
    command = on(file, command);
    command.insert(command.end(), {"--mollify", "0", "--order", "random", "--seed", "3", "--gluing", "vertex-pair",
                                   "--delaunay", "star"});
    const Result result = runTufted(command);
    EXPECT_EQ(result.code, 0) << command[0] << result.err;
  }
}

TEST_F(Dialects, WhatWasBuiltBeforeTakesNone) {
  run({"laplacian", dir_.write("a.xyz", sphere(100)), "--out", in("built")});
  for (const auto& [option, value] : {std::pair{"--mollify", "0"},
                                      {"--order", "area"},
                                      {"--gluing", "star"},
                                      {"--neighbors", "10"},
                                      {"--delaunay", "star"}})
    expectRefusal({"spectrum", "--operator", in("built"), option, value}, option);
}

}  // namespace
}  // namespace dialects_test
