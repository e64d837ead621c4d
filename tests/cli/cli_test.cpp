#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../io/temporary_dir.h"
#include "../support/resource_limit.h"
#include "command.h"
#include "samples.h"

namespace cli_test {
namespace {

const char* const outputs[] = {"L.npz",        "M.npy",       "status.npy", "representative.npy",
                               "boundary.npy", "report.json", "points.ply"};

class Command : public testing::Test {
 protected:
  std::string out() const { return (dir_ / "out").string(); }
  bool noOutputs() const { return !std::filesystem::exists(out()); }

  void expectUsageError(const std::vector<std::string>& arguments) {
    const Result result = runTufted(arguments);
    EXPECT_EQ(result.code, 2) << result.err;
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
    EXPECT_TRUE(result.err.starts_with("tufted: ")) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(noOutputs());
  }

  TemporaryDir dir_;
};

TEST_F(Command, WritesAllFilesForACloudAndSaysWhatHappened) {
  const auto file = dir_.write("sphere.xyz", sphere(500));
  const Result result = runTufted({"laplacian", file, "--out", out()});
  ASSERT_EQ(result.code, 0) << result.err;
  for (const char* name : outputs) EXPECT_TRUE(std::filesystem::exists(dir_ / "out" / name)) << name;
  for (const char* part : {"500, all take part", "12.", "the sum of M", "1 connected", "peak memory", "written to"})
    EXPECT_NE(result.out.find(part), std::string::npos) << part;
  EXPECT_NE(result.out.find(out()), std::string::npos);
}

TEST_F(Command, WritesAllFilesForAMesh) {
  const auto file = dir_.write("tetrahedron.off", tetrahedron);
  const Result result = runTufted({"laplacian", file, "--out", out(), "--order", "area", "--mollify", "0"});
  ASSERT_EQ(result.code, 0) << result.err;
  for (const char* name : outputs) EXPECT_TRUE(std::filesystem::exists(dir_ / "out" / name)) << name;
  EXPECT_NE(result.out.find("(mesh)"), std::string::npos);
  EXPECT_NE(readAll(dir_ / "out/report.json").find("\"order\": \"area\""), std::string::npos);
}

TEST_F(Command, PresetsChooseTheStepsOfClouds) {
  const auto file = dir_.write("sphere.xyz", sphere(500));
  ASSERT_EQ(runTufted({"laplacian", file, "--out", out(), "--preset", "clean"}).code, 0);
  EXPECT_NE(readAll(dir_ / "out/report.json").find("\"mass\": \"cover\""), std::string::npos);
  EXPECT_NE(readAll(dir_ / "out/report.json").find("\"settle_diagonals\": false"), std::string::npos);
  ASSERT_EQ(runTufted({"laplacian", file, "--out", out()}).code, 0);
  EXPECT_NE(readAll(dir_ / "out/report.json").find("\"mass\": \"star\""), std::string::npos);
  EXPECT_NE(readAll(dir_ / "out/report.json").find("\"settle_diagonals\": true"), std::string::npos);
  const std::string mesh = dir_.write("tetrahedron.off", tetrahedron);
  EXPECT_EQ(runTufted({"laplacian", mesh, "--out", out(), "--preset", "scan"}).code, 2);
  EXPECT_EQ(runTufted({"laplacian", file, "--out", out(), "--preset", "dirty"}).code, 2);
}

TEST_F(Command, LooksForJumpsFromWhereTheFileSaysTheSensorStood) {
  // A square before a wall four times as far away, as an organized cloud and as one row.
  const auto jumps = [&](int width, int height, const std::string& viewpoint) {
    std::string text = "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + std::to_string(width) +
                       "\nHEIGHT " + std::to_string(height) + "\nVIEWPOINT " + viewpoint +
                       " 1 0 0 0\nPOINTS 1296\nDATA ascii\n";
    for (int row = -18; row < 18; ++row) {
      for (int column = -18; column < 18; ++column) {
        const int z = std::max(std::abs(row), std::abs(column)) < 7 ? 16 : 64;
        text += std::to_string(column * z) + " " + std::to_string(row * z) + " " + std::to_string(z) + "\n";
      }
    }
    const Result result = runTufted({"laplacian", dir_.write("wall.pcd", text), "--out", out()});
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_NE(result.out.find(" on rims, "), std::string::npos) << result.out;
    const std::string report = readAll(dir_ / "out/report.json"), name = "\"jump_points\": ";
    return std::stoi(report.substr(report.find(name) + name.size()));
  };
  EXPECT_EQ(jumps(1296, 1, "0 0 0"), 0);  // 0 is no viewpoint of an unorganized cloud
  EXPECT_GE(jumps(36, 36, "0 0 0"), 48);  // around the square of 13 x 13 pixels
  EXPECT_GE(jumps(1296, 1, "0 0 1"), 48);
}

TEST_F(Command, TakesAMeshAsACloudWhenAsked) {
  const auto file = dir_.write("tetrahedron.off", tetrahedron);
  const Result result = runTufted({"laplacian", file, "--out", out(), "--as", "cloud", "--neighbors", "3"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_NE(result.out.find("(cloud)"), std::string::npos);
}

TEST_F(Command, IsSilentOnStderrWhenThatIsNoTerminal) {
  const auto file = dir_.write("sphere.xyz", sphere(2000));
  EXPECT_EQ(runTufted({"laplacian", file, "--out", out()}).err, "");
}

TEST_F(Command, PeakMemoryIsThatOfTheCommandAndNotOfWhoeverStartsIt) {
  const std::string file = dir_.write("sphere.xyz", sphere(50));
  const auto peak = [&] {
    const std::string text = runTufted({"laplacian", file, "--out", out()}).out, label = "peak memory ";
    return std::stod(text.substr(text.find(label) + label.size()));
  };
  const double alone = peak();
  const std::vector<char> large(256 << 20, 1);
  EXPECT_LT(peak(), alone + 100);
}

TEST_F(Command, MistakesOnTheCommandLineAreOneLineAndTwo) {
  const std::string file = dir_.write("sphere.xyz", sphere(50));
  expectUsageError({"laplacians"});
  expectUsageError({"laplacian"});
  expectUsageError({"laplacian", file});
  expectUsageError({"laplacian", file, file, "--out", out()});
  expectUsageError({"laplacian", file, "--out", out(), "--neighbor", "7"});
  expectUsageError({"laplacian", file, "--out", out(), "--neighbors", "2"});
  expectUsageError({"laplacian", file, "--out", out(), "--neighbors", "many"});
  expectUsageError({"laplacian", file, "--out", out(), "--neighbors", "99999999999"});
  expectUsageError({"laplacian", file, "--out", out(), "--gluing", "tape"});
  for (const char* mollify : {"-1", "1.5", "nan", "inf", "1e-3x"})
    expectUsageError({"laplacian", file, "--out", out(), "--mollify", mollify});
  expectUsageError({"laplacian", file, "--out", out(), "--threads", "0"});
  for (const char* seed : {"-1", "99999999999999999999999", "18446744073709551616", "1.5", "0x1"})
    expectUsageError({"laplacian", file, "--out", out(), "--order", "random", "--seed", seed});
  expectUsageError({"laplacian", file, "--out", out(), "--seed", "1"});
  expectUsageError({"laplacian", file, "--out", out(), "--seed", "1", "--order", "area"});
  expectUsageError({"laplacian", file, "--out", out(), "--as", "surface"});
  for (const char* formats : {"", "npy", "npz mtx", "NPZ"})
    expectUsageError({"laplacian", file, "--out", out(), "--format", formats});
  expectUsageError({"laplacian", file, "--out", out(), "--sign", "+"});
  expectUsageError({"laplacian", file, "--out", ""});
  expectUsageError({"laplacian", "", "--out", out()});
}

TEST_F(Command, NumbersOutOfRangeAreNamedWithTheirRange) {
  const std::string file = dir_.write("sphere.xyz", sphere(50));
  const auto error = [&](const char* option, const char* value) {
    return runTufted({"laplacian", file, "--out", out(), "--order", "random", option, value}).err;
  };
  EXPECT_EQ(error("--mollify", "-1"),
            "tufted: --mollify: -1 is not a number in [0, 1] (see tufted laplacian --help)\n");
  EXPECT_EQ(error("--seed", "-1"),
            "tufted: --seed: -1 is not an integer in [0, 18446744073709551615] (see tufted laplacian --help)\n");
}

TEST_F(Command, TheGreatestSeedIsTakenAsItIs) {
  const std::string file = dir_.write("sphere.xyz", sphere(50));
  const std::string seed = "18446744073709551615";
  ASSERT_EQ(runTufted({"laplacian", file, "--out", out(), "--seed", seed, "--order", "random"}).code, 0);
  EXPECT_NE(readAll(dir_ / "out/report.json").find("\"seed\": " + seed), std::string::npos);
}

TEST_F(Command, PolygonsAndMergedCornersAreStated) {
  const auto polygon = dir_.write("square.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  const Result square = runTufted({"laplacian", polygon, "--out", out()});
  ASSERT_EQ(square.code, 0) << square.err;
  EXPECT_NE(square.out.find("polygons        1 cut into triangles\n"), std::string::npos) << square.out;
  EXPECT_EQ(square.out.find("merged"), std::string::npos);
  EXPECT_NE(readAll(dir_ / "out/report.json").find("\"polygons\": 1"), std::string::npos);
  const auto corners = dir_.write(
      "two.stl",
      "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\n"
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n");
  const Result two = runTufted({"laplacian", corners, "--out", out()});
  ASSERT_EQ(two.code, 0) << two.err;
  EXPECT_NE(two.out.find("merged          2 equal corners; indices and rows are those of points.ply\n"),
            std::string::npos)
      << two.out;
  EXPECT_EQ(two.out.find("polygons"), std::string::npos);
  EXPECT_NE(readAll(dir_ / "out/report.json").find("\"merged_vertices\": 2"), std::string::npos);
}

TEST_F(Command, OptionsOfCloudsAreRefusedForAMesh) {
  const std::string file = dir_.write("tetrahedron.off", tetrahedron);
  expectUsageError({"laplacian", file, "--out", out(), "--neighbors", "12"});
  expectUsageError({"laplacian", file, "--out", out(), "--gluing", "star"});
  expectUsageError({"laplacian", file, "--out", out(), "--delaunay", "star"});
}

TEST_F(Command, WritesTheFormatsItIsAskedForAndNoOthers) {
  const std::string file = dir_.write("sphere.xyz", sphere(200));
  ASSERT_EQ(runTufted({"laplacian", "--out", out(), "--format", "mtx,spmat", file}).code, 0);  // FILE is no format
  for (const char* name : {"L.mtx", "M.mtx", "L.spmat", "M.spmat", "report.json"})
    EXPECT_TRUE(std::filesystem::exists(dir_ / "out" / name)) << name;
  for (const char* name : {"L.npz", "points.ply", "points.pcd", "laplacian.mat"})
    EXPECT_FALSE(std::filesystem::exists(dir_ / "out" / name)) << name;
  ASSERT_EQ(runTufted({"laplacian", file, "--out", out(), "--format", "mat", "--format", "pcd"}).code, 0);
  for (const char* name : {"laplacian.mat", "points.pcd", "L.mtx"})
    EXPECT_TRUE(std::filesystem::exists(dir_ / "out" / name)) << name;
}

TEST_F(Command, AnInputIsRefusedOnlyWhereItsFormatIsWritten) {
  const std::string file = dir_.write("points.pcd",
                                      "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 4\nHEIGHT 1\n"
                                      "POINTS 4\nDATA ascii\n0 0 0\n1 0 0\n0 1 0\n1 1.5 0\n");
  const std::string bytes = readAll(file);
  const std::string here = dir_.path().string();
  EXPECT_EQ(runTufted({"laplacian", file, "--out", here, "--format", "npz,pcd"}).code, 2);
  EXPECT_EQ(readAll(file), bytes);
  EXPECT_EQ(runTufted({"laplacian", file, "--out", here, "--format", "npz"}).code, 0);
  EXPECT_EQ(readAll(file), bytes);
}

TEST_F(Command, SignAndDummyReachTheFilesAndTheReport) {
  const std::string file = dir_.write("tetrahedron.off",
                                      "OFF\n5 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n9 9 9\n"
                                      "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
  const auto lastEntry = [&](const std::vector<std::string>& further) {
    std::vector<std::string> arguments = {"laplacian", file, "--out", out(), "--format", "spmat"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    EXPECT_EQ(runTufted(arguments).code, 0);
    const std::string text = readAll(dir_ / "out/L.spmat");
    return text.substr(text.rfind('\n', text.size() - 2) + 1);
  };
  EXPECT_EQ(lastEntry({}), "5 5 0\n");
  EXPECT_EQ(lastEntry({"--dummy"}), "5 5 1\n");
  EXPECT_EQ(lastEntry({"--dummy", "--sign", "igl"}), "5 5 -1\n");
  EXPECT_NE(readAll(dir_ / "out/report.json").find("\"sign\": \"igl\""), std::string::npos);
  EXPECT_EQ(readAll(dir_ / "out/L.spmat").substr(0, 5), "1 1 -");
}

TEST_F(Command, AFullDiskIsOneLineAndOneAndLeavesNothing) {
  const std::string file = dir_.write("sphere.xyz", sphere(500));
  const std::pair<const char*, const char*> largest[] = {{"npz", "L.npz"},         {"mtx", "L.mtx"},
                                                         {"mat", "laplacian.mat"}, {"spmat", "L.spmat"},
                                                         {"ply", "points.ply"},    {"pcd", "points.pcd"}};
  for (const auto& [format, name] : largest) {
    const FileSizeLimit full(16'000);  // the other files are smaller
    const Result result = runTufted({"laplacian", file, "--out", out(), "--format", format});
    EXPECT_EQ(result.code, 1) << format;
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
    EXPECT_TRUE(result.err.starts_with("tufted: " + out() + "/" + name + ": cannot write")) << result.err;
    EXPECT_TRUE(result.err.ends_with("File too large\n")) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(noOutputs());
  }
}

TEST_F(Command, FilesThatCannotBeReadOrWrittenAreOneLineAndOne) {
  const std::string good = dir_.write("sphere.xyz", sphere(50));
  const std::string bad = dir_.write("bad.xyz", "1 2 3\n1 two 3\n");
  const std::string missing = (dir_ / "missing.ply").string();
  const std::string blocked = dir_.write("blocked", "");
  const std::vector<std::vector<std::string>> cases = {
      {"laplacian", bad, "--out", out()},
      {"laplacian", missing, "--out", out()},
      {"laplacian", dir_.path(), "--out", out()},
      {"laplacian", good, "--out", out(), "--as", "mesh"},
      {"laplacian", good, "--out", blocked},
      {"laplacian", good, "--out", blocked + "/below"},
      {"laplacian", good, "--out", (dir_ / std::string(300, 'x')).string()},
  };
  for (const auto& arguments : cases) {
    const Result result = runTufted(arguments);
    EXPECT_EQ(result.code, 1) << result.err;
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(noOutputs());
  }
  EXPECT_EQ(runTufted({"laplacian", bad, "--out", out()}).err, "tufted: " + bad + ": line 2: 'two' is not a number\n");
  EXPECT_EQ(runTufted({"laplacian", missing, "--out", out()}).err, "tufted: " + missing + ": no such file\n");
}

TEST_F(Command, HelpStatesSignScaleAndFiles) {
  const Result result = runTufted({"laplacian", "--help"});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.err, "");
  for (const char* part : {"positive semidefinite", "opposite sign", "length^2", "L u = M f", "L x = lambda M x",
                           "1/2 (front and back of the cover) times 1/3 (each triangle is found by its three corners)",
                           "meshes: 1/2 (front and back of the cover)", "--normals"})
    EXPECT_NE(result.out.find(part), std::string::npos) << part;
  for (const char* name : outputs) EXPECT_NE(result.out.find(name), std::string::npos) << name;
  for (const char* name :
       {"L.mtx", "M.mtx", "laplacian.mat", "L.spmat", "M.spmat", "L.petsc", "M.petsc", "points.pcd", "--sign igl"})
    EXPECT_NE(result.out.find(name), std::string::npos) << name;
  const Result overview = runTufted({"--help"});
  EXPECT_EQ(overview.code, 0);
  EXPECT_NE(overview.out.find("laplacian"), std::string::npos);
  EXPECT_NE(overview.out.find("130"), std::string::npos);
}

TEST_F(Command, ShowsProgressOnATerminalAndLeavesNothingBehindWhenInterrupted) {
  const auto file = dir_.write("sphere.xyz", sphere(200000));
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const Result result = interruptTufted({"laplacian", file, "--out", out()}, signal);
    EXPECT_EQ(result.code, 130) << signal << ": " << result.err;
    EXPECT_NE(result.err.find('\r'), std::string::npos);
    EXPECT_NE(result.err.find("tufted: cancelled"), std::string::npos) << result.err;
    EXPECT_TRUE(noOutputs());
  }
}

TEST_F(Command, IsInterruptedWhileAFaceOfManyCornersIsTriangulated) {
  constexpr int corners = 300'000;
  std::string text;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * M_PI * i / corners, r = 1 + 0.5 * std::sin(1e4 * angle * angle);
    text += "v " + std::to_string(r * std::cos(angle)) + " " + std::to_string(r * std::sin(angle)) + " 0\n";
  }
  text += "f";
  for (int i = 1; i <= corners; ++i) text.append(" ").append(std::to_string(i));  // GCC 12 warns of + by mistake
  const auto file = dir_.write("face.obj", text + "\n");
  for (const std::string command : {"laplacian", "info"}) {
    std::vector<std::string> arguments = {command, file};
    if (command == "laplacian") arguments.insert(arguments.end(), {"--out", out()});
    const Result result = interruptTufted(arguments, SIGTERM, "triangulate");
    EXPECT_EQ(result.code, 130) << command << ": " << result.err;
    EXPECT_NE(result.err.find("tufted: cancelled"), std::string::npos) << result.err;
    EXPECT_TRUE(noOutputs());
  }
}

}  // namespace
}  // namespace cli_test
