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

/// Subcommands that use a Laplacian, in a folder of their own.
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
  /// Expects one line that has the word in it, the exit code and no output.
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
  /// The values of a .npy file of doubles.
  std::vector<double> values(const std::string& file) const {
    const std::string bytes = readAll(dir_ / file);
    const std::size_t start = 10 + static_cast<unsigned char>(bytes[8]) + 256 * static_cast<unsigned char>(bytes[9]);
    std::vector<double> result((bytes.size() - start) / sizeof(double));
    std::memcpy(result.data(), bytes.data() + start, result.size() * sizeof(double));
    return result;
  }

  TemporaryDir dir_;
};
