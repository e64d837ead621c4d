// Subcommands that use a Laplacian: its source, and where results go.
#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "subcommands.h"

namespace spectrum_test {
namespace {

class SpectrumCommand : public Subcommands {};

TEST_F(SpectrumCommand, WritesEigenpairsAndACopyOfThePoints) {
  const std::string file = dir_.write("sphere.xyz", sphere(500));
  const Result result = run({"spectrum", file, "--out", in("out"), "--count", "5"});
  EXPECT_NE(result.out.find("eigenvalues     5 positive ones, from "), std::string::npos) << result.out;
  const std::vector<double> evals = values("out/evals.npy");
  ASSERT_EQ(evals.size(), 5u);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(evals[i], 2, 0.3);
  EXPECT_NE(readAll(dir_ / "out/evecs.npy").find("'shape': (500, 5), }"), std::string::npos);
  EXPECT_EQ(values("out/evecs.npy").size(), 2500u);
  EXPECT_NE(readAll(dir_ / "out/points.ply").find("property float evecs_4\n"), std::string::npos);
  const auto json = report("out");
  EXPECT_EQ(json["command"], "spectrum");
  EXPECT_EQ(json["source"], file);
  EXPECT_EQ(json["null_space"], 1);
  EXPECT_LE(json["report"]["residual"], 1e-8);
  EXPECT_GT(json["report"]["iterations"], 0);
}

TEST_F(SpectrumCommand, HasItsResidualsWhereMostOfTheSpaceIsAskedFor) {
  const std::string file = dir_.write("sphere.xyz", sphere(400));
  for (const char* count : {"200", "268", "398"}) {
    const Result result = run({"spectrum", file, "--out", in("out"), "--count", count, "--format", "none", "-v"});
    EXPECT_NE(result.out.find("dense, residual "), std::string::npos) << result.out;
    const auto json = report("out");
    EXPECT_EQ(json["report"]["method"], "dense");
    EXPECT_LE(json["report"]["residual"], 1e-9);
    EXPECT_LE(json["report"]["backward_error"], 1e-11);
    EXPECT_EQ(json["report"]["weak_pair"], -1);
  }
}

TEST_F(SpectrumCommand, TakesAFormerLaplacianAsItWouldBuildItself) {
  std::string points = sphere(400);
  points += points.substr(0, points.find('\n') + 1) + "nan 0 0\n";  // a copy of the first, and one not finite
  const std::string file = dir_.write("sphere.xyz", points);
  run({"spectrum", file, "--out", in("built"), "--count", "6"});
  const std::string evals = readAll(dir_ / "built/evals.npy"), evecs = readAll(dir_ / "built/evecs.npy");
  for (const std::vector<std::string>& how :
       {std::vector<std::string>{}, {"--sign", "igl", "--dummy"}, {"--format", "npz,pcd"}, {"--format", "npz"}}) {
    std::vector<std::string> arguments = {"laplacian", file, "--out", in("laplacian")};
    arguments.insert(arguments.end(), how.begin(), how.end());
    std::filesystem::remove_all(in("laplacian"));
    std::filesystem::remove_all(in("out"));
    run(arguments);
    run({"spectrum", "--operator", in("laplacian"), "--out", in("out"), "--count", "6"});
    EXPECT_TRUE(readAll(dir_ / "out/evals.npy") == evals);
    EXPECT_TRUE(readAll(dir_ / "out/evecs.npy") == evecs);
    const bool has_points = how.size() != 2 || how[1] != "npz";
    EXPECT_EQ(std::filesystem::exists(dir_ / "out/points.ply"), has_points);
  }
  const std::vector<double> vectors = values("out/evecs.npy");
  for (int c = 0; c < 6; ++c) {
    EXPECT_EQ(vectors[400 * 6 + c], vectors[c]);
    EXPECT_EQ(vectors[401 * 6 + c], 0);
  }
}

TEST_F(SpectrumCommand, AFolderOfTwoRunsIsNotMixed) {
  const std::string first = dir_.write("first.xyz", sphere(100)), second = dir_.write("second.xyz", sphere(200));
  run({"laplacian", first, "--out", in("both")});
  run({"laplacian", second, "--out", in("both"), "--format", "mtx"});
  expectRefusal({"spectrum", "--operator", in("both")}, "L.npz", 1);
  run({"laplacian", second, "--out", in("both"), "--format", "npz"});
  run({"spectrum", "--operator", in("both"), "--count", "3", "--out", in("out")});
  EXPECT_FALSE(std::filesystem::exists(in("out/points.ply")));  // the points in the folder are those of the first run
}

TEST_F(SpectrumCommand, ACopyOfACopyHasTheNewVectorsAlone) {
  const std::string file = dir_.write("sphere.xyz", sphere(100));
  run({"spectrum", file, "--count", "3", "--out", in("once")});
  run({"spectrum", in("once/points.ply"), "--as", "cloud", "--count", "2", "--out", in("twice")});
  const std::string copy = readAll(dir_ / "twice/points.ply");
  EXPECT_NE(copy.find("property float evecs_1\n"), std::string::npos);
  EXPECT_EQ(copy.find("evecs_2"), std::string::npos);
  EXPECT_EQ(copy.find("evecs_0_"), std::string::npos);
}

TEST_F(SpectrumCommand, WritesTheCopyInTheFormatAskedFor) {
  const std::string file = dir_.write("tetrahedron.off", tetrahedron);
  run({"spectrum", file, "--out", in("pcd"), "--count", "2", "--format", "pcd"});
  EXPECT_NE(readAll(dir_ / "pcd/points.pcd").find(" evecs "), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(in("pcd/points.ply")));
  run({"spectrum", file, "--out", in("none"), "--count", "2", "--format", "none"});
  EXPECT_FALSE(std::filesystem::exists(in("none/points.ply")));
  EXPECT_TRUE(std::filesystem::exists(in("none/evals.npy")));
}

TEST_F(SpectrumCommand, MistakesAreOneLineAndTwo) {
  const std::string file = dir_.write("sphere.xyz", sphere(100));
  run({"laplacian", file, "--out", in("laplacian")});
  expectRefusal({"spectrum"}, "--operator");
  expectRefusal({"spectrum", file, "--operator", in("laplacian")}, "--operator");
  expectRefusal({"spectrum", "--operator", in("laplacian"), "--preset", "clean"}, "--preset");
  expectRefusal({"spectrum", "--operator", in("laplacian"), "--as", "mesh"}, "--as");
  expectRefusal({"spectrum", "--operator", in("laplacian"), "--weld"}, "--weld");
  expectRefusal({"spectrum", file, "--count", "0"}, "--count");
  expectRefusal({"spectrum", file, "--tolerance", "2"}, "--tolerance");
  expectRefusal({"spectrum", file, "--format", "npz"}, "--format");
  const Result same = runTufted({"spectrum", "--operator", in("laplacian"), "--out", in("laplacian")});
  EXPECT_EQ(same.code, 2);
  EXPECT_NE(same.err.find("would overwrite it"), std::string::npos) << same.err;
}

TEST_F(SpectrumCommand, DamagedFoldersAreOneLineAndOne) {
  const std::string file = dir_.write("sphere.xyz", sphere(100));
  const auto withFile = [&](const std::string& name, const std::string& bytes) {
    std::filesystem::remove_all(in("laplacian"));
    run({"laplacian", file, "--out", in("laplacian")});
    dir_.write("laplacian/" + name, bytes);
    expectRefusal({"spectrum", "--operator", in("laplacian")}, name, 1);
  };
  expectRefusal({"spectrum", "--operator", in("nowhere")}, "nowhere", 1);
  run({"laplacian", file, "--out", in("laplacian")});
  const std::string L = readAll(dir_ / "laplacian/L.npz"), M = readAll(dir_ / "laplacian/M.npy");
  withFile("L.npz", "no archive");
  withFile("L.npz", L.substr(0, L.size() / 2));
  withFile("M.npy", "no array");
  withFile("M.npy", M.substr(0, M.size() - 8));
  withFile("M.npy", M.substr(0, 40));
  withFile("M.npy", readAll(dir_ / "laplacian/status.npy").substr(0, 128) + std::string(99, '\0'));
  withFile("status.npy", readAll(dir_ / "laplacian/status.npy").substr(0, 128) + std::string(100, '\x09'));
  withFile("representative.npy", M);
  withFile("report.json", "[]");
  withFile("points.ply", "ply");
}

TEST_F(SpectrumCommand, BrokenPromisesInAFolderAreOneLineAndOne) {
  const std::string file = dir_.write("sphere.xyz", sphere(100));
  run({"laplacian", file, "--out", in("laplacian"), "--sign", "igl"});
  const std::string M = readAll(dir_ / "laplacian/M.npy");
  std::string negative = M, representative = readAll(dir_ / "laplacian/representative.npy");
  negative[negative.size() - 1] = static_cast<char>(negative[negative.size() - 1] | 0x80);  // sets the sign bit
  dir_.write("laplacian/M.npy", negative);
  expectRefusal({"spectrum", "--operator", in("laplacian")}, "M.npy: M(99) = -", 1);
  expectRefusal({"poisson", "--operator", in("laplacian"), "--field", "x"}, "M.npy: M(99) = -", 1);
  dir_.write("laplacian/M.npy", M);
  representative[representative.size() - 4] = 5;
  dir_.write("laplacian/representative.npy", representative);
  expectRefusal({"spectrum", "--operator", in("laplacian")}, "representative.npy: point 99 names 5", 1);
}

TEST_F(SpectrumCommand, WhereNoPointIsActiveEveryCommandSaysSo) {
  const std::string file = dir_.write("line.xyz", "0 0 0\n1 0 0\n2 0 0\n1 0 0\nnan 0 0\n3 0 0\n");
  const std::string nothing = ": no point is active: 1 not finite, 1 coincident, 4 isolated";
  const Result built = runTufted({"laplacian", file, "--out", in("laplacian"), "--format", "npz,ply,cover"});
  EXPECT_EQ(built.code, 0);
  EXPECT_EQ(built.err, "tufted: " + file + nothing + "\n");
  EXPECT_EQ(runTufted({"info", file}).err, "tufted: " + file + nothing + "\n");
  const std::vector<std::vector<std::string>> commands = {{"spectrum", "--count", "2"},
                                                          {"hks", "--count", "2"},
                                                          {"embed", "--dimension", "1"},
                                                          {"filter", "--positions", "--count", "1"},
                                                          {"filter", "--positions", "--wavelength", "1"},
                                                          {"distance", "--source", "0"},
                                                          {"distance", "--near", "0,0,0"},
                                                          {"interpolate", "--pin", "0=1"},
                                                          {"interpolate", "--pin", "0=1", "--method", "biharmonic"},
                                                          {"poisson", "--field", "x", "--pin", "0=1"},
                                                          {"green", "--source", "0"},
                                                          {"operators", "--count", "2"}};
  for (const std::string& source : {file, in("laplacian")}) {
    const auto with = [&](std::vector<std::string> command) {
      if (source != file) command.emplace_back("--operator");
      command.push_back(source);
      return command;
    };
    for (const std::vector<std::string>& command : commands) expectRefusal(with(command), source + nothing + ": ", 1);
    std::vector<std::string> poisson = with({"poisson", "--field", "x"});
    poisson.insert(poisson.end(), {"--out", in("u")});
    const Result solved = runTufted(poisson);
    EXPECT_EQ(solved.code, 0);
    EXPECT_EQ(solved.err, "tufted: " + source + nothing + "\n");
    for (const double u : values("u/u.npy")) EXPECT_TRUE(std::isnan(u));
  }
  const std::string none = dir_.write("none.pcd", "FIELDS x y z\nPOINTS 0\nDATA ascii\n");
  expectRefusal({"spectrum", none}, none + ": no point is active, there are none: ", 1);
}

TEST_F(SpectrumCommand, HksWritesSignaturesOfHeatAndOfWaves) {
  const std::string file = dir_.write("sphere.xyz", sphere(500));
  run({"hks", file, "--out", in("heat"), "--count", "30", "--samples", "7"});
  EXPECT_EQ(values("heat/hks.npy").size(), 3500u);
  EXPECT_EQ(values("heat/times.npy").size(), 7u);
  EXPECT_EQ(values("heat/evals.npy").size(), 30u);
  EXPECT_NE(readAll(dir_ / "heat/points.ply").find("property float hks_6\n"), std::string::npos);
  EXPECT_EQ(report("heat")["command"], "hks");
  run({"hks", "--out", in("times"), "--count", "30", "--times", "0.1,0.5,15", file});
  const std::vector<double> heat = values("times/hks.npy");
  ASSERT_EQ(heat.size(), 1500u);
  for (std::size_t i = 0; i < 500; ++i) {
    EXPECT_NEAR(heat[3 * i + 2], 1 / (4 * M_PI), 0.01);  // heat is constant in the end: one over the area
    EXPECT_GE(heat[3 * i], heat[3 * i + 1]);
  }
  run({"hks", file, "--out", in("wave"), "--count", "30", "--wave", "--format", "pcd"});
  EXPECT_EQ(values("wave/wks.npy").size(), 50000u);
  EXPECT_EQ(values("wave/energies.npy").size(), 100u);
  EXPECT_NE(readAll(dir_ / "wave/points.pcd").find(" wks "), std::string::npos);
  // The energies of one shape serve another one.
  std::ostringstream range;
  range.precision(17);
  range << values("wave/energies.npy").front() << ',' << values("wave/energies.npy").back();
  run({"hks", file, "--out", in("same"), "--count", "30", "--wave", "--energies", range.str()});
  const std::vector<double> wave = values("wave/wks.npy"), same = values("same/wks.npy");
  for (std::size_t i = 0; i < wave.size(); ++i) EXPECT_NEAR(same[i], wave[i], 1e-9 * wave[i]) << i;
  for (const char* energies : {"1", "2,1", "nan,1", "1,inf", "1,1.0000000000000002"})
    expectRefusal({"hks", file, "--wave", "--energies", energies}, std::string("--energies ") + energies);
  expectRefusal({"hks", file, "--energies", "1,2"}, "--energies requires --wave");
  // Energies are about those of the eigenvalues.
  for (const char* energies : {"-40,-30", "40,50"})
    expectRefusal({"hks", file, "--wave", "--energies", energies}, "lie outside those of the");
  const Result wide = runTufted({"hks", file, "--wave", "--energies", "-20,20", "--out", in("wide")});
  EXPECT_EQ(wide.code, 0) << wide.err;
  EXPECT_TRUE(isOneLine(wide.err) && contains(wide.err, "reach beyond those of the")) << wide.err;
  expectRefusal({"hks", file, "--times", "1", "--samples", "3"}, "--samples");
  expectRefusal({"hks", file, "--times", "1", "--wave"}, "--wave");
  for (const char* times : {"-1", "0", "nan", "1,nan", "inf", "1,x"})
    expectRefusal({"hks", file, "--times", times}, "--times");
  expectRefusal({"hks", file, "--count", "1"}, "--count");
}

TEST_F(SpectrumCommand, StopsAtCtrlC) {
  const std::string file = dir_.write("sphere.xyz", sphere(20000));
  const Result result = interruptTufted({"spectrum", file, "--out", in("out"), "--count", "200"});
  EXPECT_EQ(result.code, 130);
  EXPECT_FALSE(std::filesystem::exists(in("out")));
}

}  // namespace
}  // namespace spectrum_test
