#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "../io/temporary_dir.h"
#include "command.h"
#include "samples.h"

namespace structure_test {
namespace {

class Structures : public testing::Test {
 protected:
  std::string out() const { return (dir_ / "out").string(); }

  TemporaryDir dir_;
};

TEST_F(Structures, FindsNeighborsByTheStructureItIsTold) {
  std::string pixels, rings;
  for (int i = 0; i < 600; ++i) {
    const double angle = 2 * M_PI * (i % 60) / 60;
    pixels += std::to_string(i % 60 * 0.01) + ' ' + std::to_string(i / 60 * 0.01) + " 1\n";
    rings += std::to_string(std::cos(angle)) + ' ' + std::to_string(std::sin(angle)) + ' ' +
             std::to_string(i / 60 * 0.1) + ' ' + std::to_string(i / 60) + '\n';
  }
  const auto image = dir_.write("image.pcd",
                                "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 60\n"
                                "HEIGHT 10\nPOINTS 600\nDATA ascii\n" +
                                    pixels);
  const auto scan = dir_.write("rings.pcd",
                               "VERSION .7\nFIELDS x y z ring\nSIZE 4 4 4 2\nTYPE F F F U\nCOUNT 1 1 1 1\n"
                               "WIDTH 600\nHEIGHT 1\nPOINTS 600\nDATA ascii\n" +
                                   rings);
  ASSERT_EQ(runTufted({"laplacian", image, "--out", out(), "--structure", "image"}).code, 0);
  EXPECT_NE(readAll(dir_ / "out/report.json").find("\"structure\": \"image\""), std::string::npos);
  const Result both = runTufted({"laplacian", image, "--out", out(), "--structure", "image", "--neighbors", "20"});
  EXPECT_EQ(both.code, 2);
  EXPECT_EQ(both.err, "tufted: --neighbors 20 excludes --structure image, which takes the pixels around a point\n");
  // A camera at the origin sees ten rows at one depth, a camera at another place does not.
  const std::string rays =
      "\nrays            of no pinhole camera at 1, 2, 0, the viewpoint of the file or 0 without one\n";
  std::string header = "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 60\nHEIGHT 10\n";
  header += "VIEWPOINT 1 2 0 1 0 0 0\nPOINTS 600\nDATA ascii\n";
  std::string curved;
  for (int i = 0; i < 600; ++i) {
    const double depth = 1 + 0.3 * std::sin(i % 60 * 0.2) + 0.2 * std::cos(i / 60 * 0.5);
    curved += std::to_string(i % 60 * 0.01 * depth) + ' ' + std::to_string(i / 60 * 0.01 * depth) + ' ' +
              std::to_string(depth) + '\n';
  }
  const auto aside = dir_.write("aside.pcd", header + curved);
  for (const char* command : {"laplacian", "denoise"}) {
    const Result doubted = runTufted({command, aside, "--out", out(), "--structure", "image"});
    EXPECT_EQ(doubted.code, 0);
    EXPECT_TRUE(contains(doubted.out, rays)) << doubted.out;
    EXPECT_FALSE(contains(runTufted({command, image, "--out", out(), "--structure", "image"}).out, "\nrays"));
  }
  ASSERT_EQ(runTufted({"laplacian", scan, "--out", out(), "--structure", "rings"}).code, 0);
  EXPECT_NE(readAll(dir_ / "out/report.json").find("\"unplaced\": 0"), std::string::npos);
  const auto loose = dir_.write("loose.xyz", sphere(500));
  for (const char* structure : {"image", "rings"}) {
    const Result result = runTufted({"laplacian", loose, "--out", out(), "--structure", structure});
    EXPECT_EQ(result.code, 1);
    EXPECT_TRUE(isOneLine(result.err)) << result.err;
    EXPECT_NE(result.err.find("--structure"), std::string::npos);
  }
}

/// Ten rings of 60 points around (shift, 0, 0), with the fields `ring` and, in units of `turn` per turn, `azimuth`.
std::string ringScan(double shift, double turn) {
  std::string text =
      "VERSION .7\nFIELDS x y z ring azimuth\nSIZE 4 4 4 2 4\nTYPE F F F U F\nCOUNT 1 1 1 1 1\n"
      "WIDTH 600\nHEIGHT 1\nPOINTS 600\nDATA ascii\n";
  for (int i = 0; i < 600; ++i) {
    const double angle = 2 * M_PI * (i % 60) / 60;
    text += std::to_string(shift + std::cos(angle)) + ' ' + std::to_string(std::sin(angle)) + ' ' +
            std::to_string(i / 60 * 0.1) + ' ' + std::to_string(i / 60) + ' ' + std::to_string(i % 60 / 60.0 * turn) +
            '\n';
  }
  return text;
}

TEST_F(Structures, TakesTheAzimuthsOfAFileInAnyUnit) {
  const auto matrix = [&](double shift, double turn) {
    const auto file = dir_.write("rings.pcd", ringScan(shift, turn));
    const Result result = runTufted({"laplacian", file, "--out", out(), "--structure", "rings"});
    EXPECT_EQ(result.code, 0) << result.err;
    return readAll(dir_ / "out/L.npz");
  };
  const auto boundaryPoints = [&] {
    const auto report = nlohmann::json::parse(readAll(dir_ / "out/report.json")).at("report");
    return report.at("rim_points").get<int>() + report.at("jump_points").get<int>() +
           report.at("lost_points").get<int>();
  };
  const std::string radians = matrix(0, 2 * M_PI);
  EXPECT_EQ(boundaryPoints(), 120);  // the first and the last ring
  for (const double turn : {360.0, 36000.0, -360.0}) EXPECT_TRUE(matrix(0, turn) == radians) << turn;
  // The origin is not where this scanner is: from there front and back of a ring are in one direction.
  matrix(4, 360);
  EXPECT_EQ(boundaryPoints(), 120);
  const Result result =
      runTufted({"laplacian", dir_.write("odd.pcd", ringScan(0, 360000)), "--out", out(), "--structure", "rings"});
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.err.find("azimuth"), std::string::npos) << result.err;
}

TEST_F(Structures, AViewpointThatIsNoneIsTheFilesFaultWhateverIsAskedOfIt) {
  for (const char* pose : {"nan 0 0 1 0 0 0", "0 -inf 0 1 0 0 0", "0 0 0 1 0 nan 0", "1 2 3 0 0 0 0"}) {
    std::string text = ringScan(0, 360);
    text.insert(text.find("POINTS"), std::string("VIEWPOINT ") + pose + "\n");
    const std::string file = dir_.write("rings.pcd", text), refusal = "tufted: " + file + ": line 8: a viewpoint ";
    for (const std::vector<std::string>& command : {std::vector<std::string>{"laplacian"},
                                                    {"laplacian", "--structure", "image"},
                                                    {"laplacian", "--structure", "rings"},
                                                    {"spectrum", "--structure", "rings"},
                                                    {"poisson", "--field", "ring"}}) {
      std::vector<std::string> arguments = command;
      arguments.insert(arguments.end(), {file, "--out", out()});
      const Result result = runTufted(arguments);
      EXPECT_EQ(result.code, 1) << command.back() << ": " << result.err;
      EXPECT_TRUE(result.err.starts_with(refusal) && isOneLine(result.err)) << result.err;
    }
    EXPECT_TRUE(runTufted({"info", file}).err.starts_with(refusal));
    EXPECT_NE(runTufted({"validate", file}).out.find(file + ": line 8: a viewpoint "), std::string::npos);
  }
}

TEST_F(Structures, TheLengthOfTheQuaternionDoesNotMatter) {
  const auto matrix = [&](const std::string& quaternion) {
    std::string text = ringScan(0, 360);
    text.replace(text.find("azimuth"), 7, "shuttle");
    text.insert(text.find("POINTS"), "VIEWPOINT 0 0 0 " + quaternion + "\n");
    const Result result =
        runTufted({"laplacian", dir_.write("rings.pcd", text), "--out", out(), "--structure", "rings"});
    EXPECT_EQ(result.code, 0) << result.err;
    return readAll(dir_ / "out/L.npz");
  };
  const std::string tilted = matrix("2 1 0 0");  // by 53 degrees
  EXPECT_FALSE(matrix("1 0 0 0") == tilted);
  // 2^-600 and 2^600 times that.
  for (const char* quaternion : {"4.819839730205768e-181 2.409919865102884e-181 0 0",
                                 "8.299031137761986e+180 4.149515568880993e+180 0 0", "-6 -3 0 0"})
    EXPECT_TRUE(matrix(quaternion) == tilted) << quaternion;
}

TEST_F(Structures, TakesTheAzimuthsOfAFileWhoseRingsItHasToFind) {
  // Azimuths in the other direction and from another zero change nothing; equal ones fit no scan.
  const auto file = [&](const std::string& azimuth, double slope) {
    std::string text = "VERSION .7\nFIELDS x y z " + azimuth + "\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\n" +
                       "WIDTH 600\nHEIGHT 1\nPOINTS 600\nDATA ascii\n";
    for (int i = 0; i < 600; ++i) {
      const double angle = 2 * M_PI * (i % 60) / 60;
      text += std::to_string(std::cos(angle)) + ' ' + std::to_string(std::sin(angle)) + ' ' +
              std::to_string(i / 60 * 0.1) + ' ' + std::to_string(slope * (i % 60 * 6 - 100)) + '\n';
    }
    return dir_.write("scan.pcd", text).string();
  };
  const auto matrix = [&](const std::string& azimuth) {
    const Result result = runTufted({"laplacian", file(azimuth, -1), "--out", out(), "--structure", "rings"});
    EXPECT_EQ(result.code, 0) << result.err;
    return readAll(dir_ / "out/L.npz");
  };
  EXPECT_TRUE(matrix("azimuth") == matrix("intensity"));
  const std::string one = file("azimuth", 0);
  for (const char* command : {"laplacian", "spectrum"}) {
    const Result result = runTufted({command, one, "--out", (dir_ / "none").string(), "--structure", "rings"});
    EXPECT_EQ(result.code, 1);
    EXPECT_TRUE(result.err.starts_with("tufted: " + one + ": ") && isOneLine(result.err)) << result.err;
    EXPECT_TRUE(contains(result.err, "azimuth") && contains(result.err, "--structure rings")) << result.err;
    EXPECT_FALSE(std::filesystem::exists(dir_ / "none"));
  }
}

}  // namespace
}  // namespace structure_test
