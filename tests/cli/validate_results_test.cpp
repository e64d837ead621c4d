// `tufted validate` on clouds without a surface, and on folders written by `tufted laplacian`.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../io/temporary_dir.h"
#include "command.h"
#include "samples.h"

namespace validate_results_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class ValidateResults : public testing::Test {
 protected:
  std::string writeTetrahedron() const { return dir_.write("good.off", tetrahedron); }

  TemporaryDir dir_;
};

TEST_F(ValidateResults, AFileOfWhichNoPointIsActiveIsEmptyAndBreaksNothing) {
  const std::string line = dir_.write("line.xyz", "0 0 0\n1 0 0\n2 0 0\n1 0 0\nnan 0 0\n");
  const std::string flat = dir_.write("flat.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 1\n"),
                    good = writeTetrahedron();
  const Result result = runTufted({"validate", line, flat, good});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.err, "tufted: 2 of 3 EMPTY: no point is active\n");
  const std::vector<std::string> lines = linesOf(result.out);
  ASSERT_EQ(lines.size(), 5u) << result.out;
  EXPECT_TRUE(lines[1].starts_with("EMPTY ")) << lines[1];
  EXPECT_TRUE(lines[1].ends_with(line + ": no point is active: 1 not finite, 1 coincident, 3 isolated")) << lines[1];
  EXPECT_TRUE(lines[2].starts_with("EMPTY ")) << lines[2];
  EXPECT_TRUE(lines[3].starts_with("OK ")) << lines[3];
  EXPECT_TRUE(lines[4].starts_with("3 files: 1 OK, 2 EMPTY, 0 REFUSED, 0 FAILED, ")) << lines[4];

  const json document = json::parse(runTufted({"validate", "--json", line, good}).out);
  EXPECT_EQ(document["summary"]["empty"], 1);
  EXPECT_EQ(document["summary"]["ok"], 1);
  EXPECT_EQ(document["files"][0]["result"], "EMPTY");
  EXPECT_EQ(document["files"][0]["active"], 0);
  EXPECT_EQ(document["files"][0]["reasons"].size(), 1u);
}

TEST_F(ValidateResults, TakesALaplacianThatWasWritten) {
  const std::string file = dir_.write("sphere.xyz", sphere(300) + "nan 0 0\n"), folder = dir_ / "laplacian";
  const auto write = [&](std::vector<std::string> how) {
    fs::remove_all(folder);
    how.insert(how.begin(), {"laplacian", file, "--out", folder});
    ASSERT_EQ(runTufted(how).code, 0);
  };
  for (const std::vector<std::string>& how :
       {std::vector<std::string>{}, {"--sign", "igl", "--dummy"}, {"--format", "npz,cover"}}) {
    write(how);
    const Result result = runTufted({"validate", "--json", "--operator", folder});
    EXPECT_EQ(result.code, 0) << result.err;
    const json row = json::parse(result.out)["files"].at(0);
    EXPECT_EQ(row["file"], folder);
    EXPECT_EQ(row["result"], "OK") << row;
    EXPECT_EQ(row["kind"], "cloud");
    EXPECT_EQ(row["points"], 301);
    EXPECT_EQ(row["active"], 300);
    EXPECT_EQ(row["definite"], true);
    EXPECT_EQ(row.contains("cover"), how.size() == 2) << row;
  }
  const Result table = runTufted({"validate", file, "--operator", folder});
  EXPECT_EQ(table.code, 0) << table.err;
  ASSERT_EQ(linesOf(table.out).size(), 4u) << table.out;
  EXPECT_TRUE(linesOf(table.out)[2].starts_with("OK ") &&
              linesOf(table.out)[2].find("  " + folder) != std::string::npos)
      << table.out;

  // Point 300, which is not finite, becomes active; then the array is missing.
  std::string status = readAll(dir_ / "laplacian/status.npy");
  status.back() = 0;
  dir_.write("laplacian/status.npy", status);
  const Result broken = runTufted({"validate", "--operator", folder});
  EXPECT_EQ(broken.code, 1);
  EXPECT_EQ(broken.err, "tufted: 1 of 1 FAILED\n");
  EXPECT_TRUE(contains(broken.out, folder + ": positive diagonal: L(300, 300) = 0")) << broken.out;
  dir_.write("laplacian/status.npy", status.substr(0, status.size() - 1));
  const Result unfit = runTufted({"validate", "--operator", folder});
  EXPECT_EQ(unfit.code, 0);
  EXPECT_TRUE(linesOf(unfit.out).at(1).starts_with("REFUSED ")) << unfit.out;
  EXPECT_EQ(runTufted({"validate", "--operator", dir_ / "nowhere"}).code, 1);
}

}  // namespace
}  // namespace validate_results_test
