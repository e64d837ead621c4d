#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <regex>
#include <set>

#include "../io/temporary_dir.h"
#include "command.h"
#include "malformed_files.h"

namespace files_test {
namespace {

class Files : public testing::Test {
 protected:
  std::string out() const { return (dir_ / "out").string(); }

  /// Expects exit code 1, one line that names the path and the line or byte, and no files.
  void expectRefused(const std::string& path, const Result& result) {
    EXPECT_EQ(result.code, 1) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_TRUE(result.err.starts_with("tufted: " + path + ": ")) << result.err;
    EXPECT_TRUE(std::regex_search(result.err, std::regex("line [0-9]|byte [0-9]|is empty"))) << result.err;
    EXPECT_FALSE(std::filesystem::exists(out()));
  }

  void expectRefused(const std::string& name, std::string_view bytes) {
    const std::string path = dir_.write(name, bytes);
    expectRefused(path, runTufted({"laplacian", path, "--out", out()}));
  }

  TemporaryDir dir_;
};

TEST_F(Files, MalformedOnesOfEveryFormatAreRefused) {
  std::set<std::string> formats;
  for (const Malformed& file : malformedFiles())
    if (formats.insert(std::filesystem::path(file.name).extension()).second) expectRefused(file.name, file.bytes);
}

TEST_F(Files, CutOnesAreRefused) {
  for (const WellFormed& file : wellFormedFiles()) {
    const std::string path = dir_.write(file.name, std::string_view(file.bytes).substr(0, file.bytes.size() * 7 / 10));
    expectRefused(path, runTufted({"laplacian", path, "--out", out()}));
    expectRefused("standard input", runTufted({"laplacian", "-", "--out", out()}, path));
  }
}

TEST_F(Files, StandardInputGivesWhatTheFileGives) {
  for (const WellFormed& file : wellFormedFiles()) {
    const std::string path = dir_.write(file.name, file.bytes);
    ASSERT_EQ(runTufted({"laplacian", path, "--out", dir_ / "a"}).code, 0) << file.name;
    const Result result = runTufted({"laplacian", "-", "--out", dir_ / "b"}, path);
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_NE(result.out.find("standard input"), std::string::npos);
    for (const char* name : {"L.npz", "M.npy", "points.ply"})
      EXPECT_EQ(readAll(dir_ / "a" / name), readAll(dir_ / "b" / name)) << file.name << ' ' << name;
  }
}

TEST_F(Files, ThatMayNotBeReadAreRefused) {
  const std::string path = dir_.write("secret.xyz", "1 2 3\n");
  std::filesystem::permissions(path, std::filesystem::perms::none);
  std::filesystem::permissions(dir_.path(), std::filesystem::perms::all);  // so that --out is not at fault
  std::vector<std::string> words = {tuftedCommand(), "laplacian", path, "--out", out()};
  if (geteuid() == 0) {  // root may read anything
    if (runProgram({"setpriv", "--reuid", "65534", "--clear-groups", tuftedCommand(), "--version"}).code != 0)
      GTEST_SKIP() << "cannot run the command as another user";
    const std::vector<std::string> other = {"setpriv", "--reuid", "65534", "--clear-groups"};
    words.insert(words.begin(), other.begin(), other.end());
  }
  const Result result = runProgram(words);
  EXPECT_EQ(result.code, 1);
  EXPECT_EQ(result.err, "tufted: " + path + ": cannot read: Permission denied\n");
  EXPECT_FALSE(std::filesystem::exists(out()));
}

TEST_F(Files, NormalsAreUsedWhereTheFileHasThem) {
  // A lattice in the plane z = 0, with correct normals except one that lies in the plane.
  std::string text, plain;
  for (int i = 0; i < 100; ++i) {
    const std::string point = std::to_string(i % 10 + 0.1 * (i * i % 7)) + ' ' + std::to_string(i / 10) + " 0";
    plain += point + '\n';
    text += point + (i == 44 ? " 1 0 0\n" : " 0 0 1\n");
  }
  const std::string with = dir_.write("with.xyz", text), without = dir_.write("without.xyz", plain);
  ASSERT_EQ(runTufted({"laplacian", with, "--out", dir_ / "pca"}).code, 0);
  ASSERT_EQ(runTufted({"laplacian", without, "--out", dir_ / "none"}).code, 0);
  const Result used = runTufted({"laplacian", with, "--out", dir_ / "used", "--normals"});
  ASSERT_EQ(used.code, 0) << used.err;
  EXPECT_EQ(readAll(dir_ / "pca/L.npz"), readAll(dir_ / "none/L.npz"));
  EXPECT_NE(readAll(dir_ / "used/L.npz"), readAll(dir_ / "pca/L.npz"));
  const Result missing = runTufted({"laplacian", without, "--out", out(), "--normals"});
  EXPECT_EQ(missing.code, 1);
  EXPECT_EQ(missing.err, "tufted: " + without + ": has no normals, which --normals asks for\n");
}

TEST_F(Files, WeldJoinsCoincidentVerticesOfMeshesOnly) {
  const std::string mesh =
      dir_.write("two.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 4 6 5\n");
  const Result apart = runTufted({"laplacian", mesh, "--out", out()});
  EXPECT_NE(apart.out.find("components      2"), std::string::npos) << apart.out;
  const Result welded = runTufted({"laplacian", mesh, "--out", out(), "--weld"});
  EXPECT_NE(welded.out.find("components      1"), std::string::npos) << welded.out;
  EXPECT_NE(welded.out.find("points          6, 4 take part, 2 equal to an earlier one"), std::string::npos)
      << welded.out;
  EXPECT_EQ(runTufted({"laplacian", dir_.write("a.xyz", "1 2 3\n"), "--out", out(), "--weld"}).code, 2);
}

}  // namespace
}  // namespace files_test
