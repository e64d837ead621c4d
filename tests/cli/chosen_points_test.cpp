// The options that choose points of a cloud before anything is computed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <sstream>

#include "subcommands.h"

namespace chosen_points_test {
namespace {

/// A curved sheet of 20 x 20 points with a class: 5 for every seventh point, which hovers above the sheet, else 2.
/// @param classes the classes that the file has
std::string sheet(const std::vector<int>& classes) {
  std::ostringstream text;
  text.precision(17);
  text << "//X Y Z Classification\n";
  for (int i = 0; i < 400; ++i) {
    const int kind = i % 7 == 3 ? 5 : 2;
    if (std::find(classes.begin(), classes.end(), kind) == classes.end()) continue;
    const double x = i % 20 + 0.1 * std::sin(i), y = i / 20 + 0.1 * std::cos(3 * i);
    text << x << ' ' << y << ' ' << 0.02 * x * y + (kind == 5 ? 4 : 0) << ' ' << kind << '\n';
  }
  return text.str();
}

/// A plane of 36 x 36 points with four balls of 90 points above it.
std::string trees() {
  std::mt19937_64 generator(101);
  const auto random = [&] { return 2 * std::ldexp(static_cast<double>(generator() >> 11), -53) - 1; };
  std::ostringstream text;
  for (int i = 0; i < 36 * 36; ++i) text << i % 36 + 0.4 * random() << ' ' << i / 36 + 0.4 * random() << " 0\n";
  for (int count = 0; count < 360;) {
    const double x = random(), y = random(), z = random();
    if (x * x + y * y + z * z > 1) continue;
    text << 4 * x + 8 + count % 2 * 18 << ' ' << 4 * y + 8 + count / 180 * 18 << ' ' << 4 * z + 9 << '\n';
    ++count;
  }
  return text.str();
}

class ChosenPoints : public Subcommands {
 protected:
  const std::string all_ = dir_.write("all.xyz", sheet({2, 5}));
  const std::string ground_ = dir_.write("ground.xyz", sheet({2}));
};

TEST_F(ChosenPoints, HaveHandlesWhoseNumbersAreNoPoints) {
  // Point 3 of the file hovers and is not chosen, but handle 3 is a handle.
  const std::string handles = dir_.write("handles.txt", "0 0\n50 1\n99 2\n350 3\n");
  run({"weights", all_, "--where", "classification=2", "--handles", handles, "--out", in("weights")});
  EXPECT_NE(runTufted({"weights", all_, "--handles", dir_.write("odd.txt", "0 0.5\n"), "--out", in("odd")})
                .err.find("the handle is no number counted from 0"),
            std::string::npos);
}

TEST_F(ChosenPoints, AreWhatInfoDescribes) {
  const Result result = run({"info", all_, "--where", "classification=2"});
  EXPECT_NE(result.out.find("chosen          343 of 400 points"), std::string::npos) << result.out;
  const Result whole = run({"info", all_}), alone = run({"info", ground_});
  const auto highest = [](const Result& of) { return of.out.substr(of.out.find("highest"), 50); };
  EXPECT_EQ(highest(result), highest(alone));
  EXPECT_NE(highest(result), highest(whole));
}

TEST_F(ChosenPoints, AreAdvisedIfPointsHoverOverTheGround) {
  const std::string file = dir_.write("trees.xyz", trees());
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"info"}, {"laplacian"}, {"denoise"}, {"normals"}, {"distance", "--source", "0"}}) {
    std::vector<std::string> all = command;
    all.insert(all.end(), {file, "--json"});
    if (command[0] != "info") all.insert(all.end(), {"--out", in("hovering")});
    const Result result = runTufted(all);
    EXPECT_NE(result.err.find("vegetation"), std::string::npos) << command[0] << result.err;
    EXPECT_NE(nlohmann::json::parse(result.out)["warnings"].dump().find("--where"), std::string::npos) << command[0];
    all.insert(all.end(), {"--where", "z<1"});
    run(all);  // without a warning
  }
  EXPECT_NE(runTufted({"validate", file, "--json"}).out.find("vegetation"), std::string::npos);
}

TEST_F(ChosenPoints, AreThoseThatValidateAndViewTake) {
  const std::vector<std::string> choice = {"--where", "classification=2", "--thin", "1.0000000001", "--json"};
  const auto selectionOf = [&](std::vector<std::string> words) {
    words.insert(words.end(), choice.begin(), choice.end());
    const auto result = nlohmann::json::parse(runTufted(words).out);
    return words[0] == "view" ? result["selection"] : result["files"][0]["selection"];
  };
  const auto validated = selectionOf({"validate", all_}),
             viewed = selectionOf({"view", all_, "--out", in("page.html")});
  EXPECT_EQ(validated, viewed);
  EXPECT_EQ(viewed["points"], 400);
  EXPECT_LT(viewed["kept"], 343);
  EXPECT_EQ(viewed["thin"], 1.0000000001);
  // Without a field of its own a file is shown by height, and points keep their numbers in the file.
  const std::string bare = dir_.write("bare.xyz", "0 0 0\n1 0 0\n0 1 0\n1 1 1\n");
  const Result shown = run({"view", bare, "--where", "x<0.5", "--out", in("bare.html")});
  EXPECT_NE(shown.out.find("fields          z, file_row\n"), std::string::npos) << shown.out;
  const std::string none = dir_.write("none.xyz", "0 0 0\n1 0 0\n0 1 0\n1 1 1\n");
  const Result refused = runTufted({"validate", none, all_, "--where", "classification=2"});
  EXPECT_NE(refused.out.find(none + ": select: where"), std::string::npos) << refused.out;
  EXPECT_NE(refused.out.find("OK"), std::string::npos) << refused.out;
  run({"laplacian", all_, "--out", in("folder")});
  expectRefusal({"view", in("folder"), "--where", "x<1"}, "is a folder of results");
  const Result both = runTufted({"validate", all_, "--operator", in("folder"), "--where", "x<1"});
  EXPECT_EQ(both.code, 2);
  EXPECT_NE(both.err.find("--operator names a folder"), std::string::npos) << both.err;
}

TEST_F(ChosenPoints, ResultsAreThoseOfAFileOfThesePointsAlone) {
  const std::vector<std::string> choice = {"--where", "classification=2"};
  for (std::vector<std::string> command : commands) {
    // The fourth point hovers, so point 4 of the file is point 3 of the ground.
    std::vector<std::string> alone = command;
    for (std::size_t k = 0; k + 1 < command.size(); ++k) {
      if (command[k] == "--source" || command[k] == "--to") command[k + 1] = "4", alone[k + 1] = "3";
      if (command[k] == "--pin") command[k + 1] = "4=1", alone[k + 1] = "3=1";
    }
    command.insert(command.begin() + 1, all_);
    command.insert(command.end(), choice.begin(), choice.end());
    alone.insert(alone.begin() + 1, ground_);
    command.insert(command.end(), {"--threads", "1", "--out", in("chosen")});
    alone.insert(alone.end(), {"--threads", "1", "--out", in("alone")});
    std::filesystem::remove_all(dir_ / "chosen");
    std::filesystem::remove_all(dir_ / "alone");
    const Result result = run(command);
    run(alone);
    SCOPED_TRACE(command[0]);
    EXPECT_NE(result.out.find("chosen          343 of 400 points"), std::string::npos) << result.out;
    EXPECT_EQ(report("chosen")["selection"]["kept"], 343);
    const std::vector<std::int32_t> rows = values<std::int32_t>("chosen/file_row.npy");
    ASSERT_EQ(rows.size(), 343u);
    for (int i = 0; i < 343; ++i) EXPECT_EQ(rows[i], i + (i + 3) / 6) << i;
    const nlohmann::json alone_report = report("alone");
    for (const std::string file : alone_report["files"]) {
      if (!file.ends_with(".npy")) continue;
      EXPECT_EQ(readAll(dir_ / "chosen" / file), readAll(dir_ / "alone" / file)) << file;
    }
  }
}

TEST_F(ChosenPoints, BoxesPolygonsAndSpacingsAddUp) {
  const std::string outline = dir_.write("outline.txt", "# X Y\n-1,-1\n12 -1\n12 12\n\n-1 12  # the last corner\n");
  const std::vector<std::string> choice = {
      "--polygon", outline, "--crop", "-inf,-1,-1,inf,9,2.5", "--where", "z<2", "--where", "x>=1", "--thin", "1.5"};
  std::vector<std::string> command = {"laplacian", all_, "--format", "npz,ply", "--out", in("out")};
  command.insert(command.end(), choice.begin(), choice.end());
  const Result result = runTufted(command);
  ASSERT_EQ(result.code, 0) << result.err;
  const std::vector<double> at = values("out/measured_positions.npy");
  ASSERT_GT(at.size(), 3u * 10);
  for (std::size_t i = 0; i < at.size(); i += 3) {
    EXPECT_GE(at[i], 1);
    EXPECT_LT(at[i], 12);
    EXPECT_LE(at[i + 1], 9);
    EXPECT_LT(at[i + 2], 2);
    for (std::size_t j = 0; j < i; j += 3)
      EXPECT_GE(std::hypot(at[i] - at[j], at[i + 1] - at[j + 1], at[i + 2] - at[j + 2]), 1.5);
  }
  const nlohmann::json selection = report("out")["selection"];
  EXPECT_EQ(selection["points"], 400);
  EXPECT_EQ(selection["kept"], at.size() / 3);
  EXPECT_EQ(selection["where"], (std::vector<std::string>{"z<2", "x>=1"}));
  EXPECT_EQ(selection["crop"], "-inf,-1,-1,inf,9,2.5");
  EXPECT_EQ(selection["polygon"], outline);
  EXPECT_EQ(selection["thin"], 1.5);
}

TEST_F(ChosenPoints, PointsAreNamedByTheirIndexInTheFile) {
  const Result result = run({"distance", all_, "--where", "classification=2", "--near", "4,0,0", "--out", in("near")});
  EXPECT_NE(result.out.find("nearest         point 4,"), std::string::npos) << result.out;
  EXPECT_EQ(report("near")["nearest"][0]["point"], 3);  // a row of the results, as everything in files
  expectRefusal({"distance", all_, "--where", "classification=2", "--source", "3"},
                "--source 3 is a point that was not");
  expectRefusal({"distance", all_, "--where", "classification=2", "--source", "400"}, "no index in [0, 400)");
  const std::string pins = dir_.write("pins.txt", "3 1\n");
  expectRefusal({"interpolate", all_, "--thin", "1", "--where", "classification=2", "--pins", pins},
                "line 1 is a point");
}

TEST_F(ChosenPoints, MessagesNamePointsByTheirRowsInTheFile) {
  const std::vector<std::string> choice = {"--where", "classification=2"};
  const auto with = [&](std::vector<std::string> command) {
    command.insert(command.end(), choice.begin(), choice.end());
    return command;
  };
  expectRefusal(with({"segment", all_, "--seeds", "4,4"}), "--seeds 4,4: segments: seed 4 is given twice");
  std::string values = "//X Y Z Classification f\n", line;
  std::istringstream lines(sheet({2, 5}));
  std::getline(lines, line);
  for (int i = 0; std::getline(lines, line); ++i) values += line + (i == 4 ? " nan\n" : " 1\n");
  const std::string odd = dir_.write("odd.xyz", values);
  expectRefusal(with({"poisson", odd, "--field", "f"}), "the values of point 4 are not finite", 1);
  const std::string far = dir_.write("far.xyz", sheet({2, 5}) + "1000 1000 1000 2\n");
  expectRefusal(with({"path", far, "--from", "4", "--to", "400"}), "point 400 is isolated");
  const Result result = runTufted(with({"distance", far, "--source", "4,400", "--out", in("far")}));
  EXPECT_NE(result.err.find("point 400 is isolated"), std::string::npos) << result.err;
}

TEST_F(ChosenPoints, AreFoundUntilCtrlC) {
  const std::string file = dir_.write("sphere.xyz", sphere(200000));
  for (const std::vector<std::string>& choice : {std::vector<std::string>{"--where", "x>-2"}, {"--thin", "1e-9"}}) {
    std::vector<std::string> command = {"laplacian", file, "--out", in("stopped")};
    command.insert(command.end(), choice.begin(), choice.end());
    const Result result = interruptTufted(command, SIGINT, choice[0] == "--thin" ? "thin" : "select");
    EXPECT_EQ(result.code, 130) << result.err;
    EXPECT_EQ(result.err.find("stars"), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(in("stopped")));
  }
}

TEST_F(ChosenPoints, MistakesAreRefusedBeforeTheBuild) {
  const auto refuses = [&](const std::vector<std::string>& choice, const std::string& word, int code = 2) {
    std::vector<std::string> command = {"laplacian", all_};
    command.insert(command.end(), choice.begin(), choice.end());
    expectRefusal(command, word, code);
  };
  refuses({"--where", "klass=2"}, "'klass' is no field, must be one of classification, x, y, z");
  refuses({"--where", "classification=2,"}, "missing");
  refuses({"--where", "classification=9"}, "none of the 400 points");
  refuses({"--crop", "0,0,0,1,1"}, "--crop 0,0,0,1,1 is not X0,Y0,Z0,X1,Y1,Z1");
  refuses({"--crop", "0,0,0,1,1,x"}, "--crop 0,0,0,1,1,x");
  refuses({"--crop", "2,0,0,1,1,1"}, "crop");
  refuses({"--thin", "0"}, "--thin");
  refuses({"--thin", "near"}, "--thin");
  refuses({"--polygon", in("none.txt")}, "cannot be read", 1);
  refuses({"--polygon", dir_.write("three.txt", "1 2 3\n")}, "line 1: is not X Y", 1);
  refuses({"--polygon", dir_.write("two.txt", "1 2\n3 4\n")}, "at least 3");
  refuses({"--polygon", dir_.write("empty.txt", "# none\n")}, "has no corners", 1);
  const std::string mesh = dir_.write("mesh.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  expectRefusal({"laplacian", mesh, "--thin", "1"}, "holds a mesh (--as cloud");
  run({"laplacian", all_, "--where", "classification=2", "--format", "npz,ply,cover", "--out", in("L")});
  expectRefusal({"distance", "--operator", in("L"), "--source", "0", "--thin", "1"}, "--thin excludes --operator");
}

TEST_F(ChosenPoints, AFolderCountsItsOwnPoints) {
  run({"laplacian", all_, "--where", "classification=2", "--format", "npz,ply,cover", "--out", in("L")});
  run({"distance", "--operator", in("L"), "--source", "3", "--out", in("folder")});
  run({"distance", all_, "--where", "classification=2", "--source", "4", "--out", in("file")});
  EXPECT_EQ(values("folder/distance.npy"), values("file/distance.npy"));
  EXPECT_EQ(values<std::int32_t>("folder/file_row.npy"), values<std::int32_t>("file/file_row.npy"));
}

TEST_F(ChosenPoints, AnOrganizedCloudKeepsItsRows) {
  std::string text = sheet({2, 5});
  text.erase(0, text.find('\n') + 1);
  const std::string grid =
      dir_.write("grid.pcd",
                 "FIELDS x y z classification\nSIZE 8 8 8 1\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH 20\nHEIGHT 20\n"
                 "POINTS 400\nDATA ascii\n" +
                     text);
  const Result result = run({"distance", grid, "--where", "classification=2", "--source", "4", "--out", in("out")});
  EXPECT_NE(result.out.find("343 of 400 points; the others are missing pixels"), std::string::npos) << result.out;
  const std::vector<double> distance = values("out/distance.npy");
  ASSERT_EQ(distance.size(), 400u);
  for (int i = 0; i < 400; ++i) EXPECT_EQ(std::isinf(distance[i]), i % 7 == 3) << i;
  EXPECT_EQ(distance[4], 0);
  EXPECT_FALSE(std::filesystem::exists(in("out/file_row.npy")));
}

}  // namespace
}  // namespace chosen_points_test
