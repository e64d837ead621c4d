#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../io/temporary_dir.h"
#include "command.h"
#include "samples.h"

/// A call of every subcommand that needs nothing but a cloud, without FILE and --out.
inline const std::vector<std::vector<std::string>> commands = {
    {"laplacian", "--format", "npz,ply,pcd,mtx,mat,spmat,petsc,cover,triangles"},
    {"spectrum", "--count", "3"},
    {"hks", "--count", "3"},
    {"hks", "--count", "3", "--wave", "--format", "pcd"},
    {"embed"},
    {"filter", "--positions", "--count", "3"},
    {"distance", "--source", "0"},
    {"path", "--from", "0", "--to", "1"},
    {"trace", "--source", "0", "--direction", "1,2,3", "--length", "0.5"},
    {"isolines", "--field", "x", "--count", "3"},
    {"interpolate", "--pin", "0=1"},
    {"poisson", "--field", "x"},
    {"poisson", "--field", "x", "--pin", "0=1"},
    {"green", "--source", "0"},
    {"extend", "--pin", "0=1"},
    {"transport", "--source", "0", "--vector", "1,2,3"},
    {"logmap", "--source", "0"},
    {"segment", "--count", "3"},
    {"denoise"},
    {"smooth"},
    {"normals"},
    {"curvature"},
    {"operators", "--count", "3"}};

/// Fixture for subcommands that use a Laplacian, with a temporary folder.
class Subcommands : public testing::Test {
 protected:
  std::string in(const std::string& name) const { return (dir_ / name).string(); }
  /// Runs the command and expects it to succeed.
  Result run(const std::vector<std::string>& arguments) {
    const Result result = runTufted(arguments);
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    return result;
  }
  /// Expects an error of one line that contains the word, the exit code, and no output.
  void expectRefusal(std::vector<std::string> arguments, const std::string& word, int code = 2) {
    arguments.insert(arguments.end(), {"--out", in("refused")});
    const Result result = runTufted(arguments);
    EXPECT_EQ(result.code, code) << result.err;
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
    EXPECT_NE(result.err.find(word), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(in("refused")));
  }
  nlohmann::json report(const std::string& folder) const {
    return nlohmann::json::parse(readAll(dir_ / folder / "report.json"));
  }
  /// Expects report.json to have method, accuracy and time of the solve.
  /// @param method beginning of the solver's name
  /// @param iterates whether iterations are expected
  void expectReport(const std::string& folder, const std::string& method, bool iterates) const {
    const nlohmann::json made = report(folder)["report"];
    const nlohmann::json solver = made.value("solver", made);
    EXPECT_EQ(solver.value("method", "").find(method), 0u) << folder << made;
    EXPECT_GT(solver.value("seconds", 0.0), 0) << folder << made;
    ASSERT_TRUE(made["iterations"].is_number_integer()) << folder << made;
    EXPECT_EQ(made["iterations"] > 0, iterates) << folder << made;
    ASSERT_TRUE(made["residual"].is_number()) << folder << made;  // JSON has null for NaN
    EXPECT_LE(made["residual"], 1e-8) << folder << made;
    EXPECT_GT(made["seconds"], 0) << folder << made;
  }
  /// The values of a .npy file of type T.
  template <class T = double>
  std::vector<T> values(const std::string& file) const {
    const std::string bytes = readAll(dir_ / file);
    const std::size_t start = 10 + static_cast<unsigned char>(bytes[8]) + 256 * static_cast<unsigned char>(bytes[9]);
    std::vector<T> result((bytes.size() - start) / sizeof(T));
    std::memcpy(result.data(), bytes.data() + start, result.size() * sizeof(T));
    return result;
  }

  TemporaryDir dir_;
};
