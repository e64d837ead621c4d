// The subcommands distance, interpolate and green.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "../support/joined_grids.h"
#include "subcommands.h"
#include "tufted/io/write.h"

namespace applications_test {
namespace {

class ApplicationCommands : public Subcommands {};

TEST_F(ApplicationCommands, DistanceComesFromIndicesPositionsAndFaces) {
  const std::string cloud = dir_.write("sphere.xyz", sphere(500));
  run({"distance", cloud, "--source", "3,7", "--near", "-1,0,0", "--out", in("out")});
  const std::vector<double> distance = values("out/distance.npy");
  ASSERT_EQ(distance.size(), 500u);
  EXPECT_EQ(distance[3], 0);
  EXPECT_EQ(distance[7], 0);
  EXPECT_EQ(std::count(distance.begin(), distance.end(), 0), 3);
  EXPECT_NE(readAll(dir_ / "out/points.ply").find("property float distance\n"), std::string::npos);
  const auto json = report("out");
  EXPECT_EQ(json["command"], "distance");
  EXPECT_EQ(json["sources"].size(), 3u);
  EXPECT_EQ(json["method"], "marching");
  EXPECT_GT(json["report"]["visits"], 500);
  run({"distance", cloud, "--source", "3,7", "--near", "-1,0,0", "--method", "heat", "--out", in("heat")});
  EXPECT_EQ(report("heat")["report"]["rounds"], 1);
  EXPECT_LE(report("heat")["report"]["residual"], 1e-10);
  const std::vector<double> heat = values("heat/distance.npy");
  for (std::size_t i = 0; i < heat.size(); ++i) EXPECT_NEAR(heat[i], distance[i], 0.15);

  const std::string square = dir_.write("square.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
  run({"distance", square, "--face", "0,2,1,1", "--out", in("face")});
  const std::vector<double> corners = values("face/distance.npy");
  EXPECT_NEAR(corners[0], std::hypot(0.5, 0.25), 1e-15);  // the source is (1/2, 1/4)
  EXPECT_NEAR(corners[2], std::hypot(0.5, 0.75), 1e-15);
  expectRefusal({"distance", square, "--face", "2,1,1,1"}, "face = 2");
  expectRefusal({"distance", square, "--face", "0,1,1"}, "FACE,A,B,C");
  expectRefusal({"distance", cloud, "--face", "0,1,1,1"}, "applies to meshes");
  expectRefusal({"distance", cloud}, "no source is given");
  expectRefusal({"distance", cloud, "--source", "500"}, "source 500");
  expectRefusal({"distance", cloud, "--near", "1,2"}, "X,Y,Z");
  expectRefusal({"distance", cloud, "--source", "0", "--time-step", "0"}, "--time-step");
}

TEST_F(ApplicationCommands, DistanceStopsAtARadiusLabelsAndFillsMatrices) {
  const std::string cloud = dir_.write("sphere.xyz", sphere(500));
  run({"distance", cloud, "--source", "3,7", "--out", in("whole")});
  run({"distance", cloud, "--source", "3,7", "--within", "0.5", "--labels", "--out", in("part")});
  run({"distance", cloud, "--source", "3,7", "--matrix", "--out", in("matrix")});
  const std::vector<double> whole = values("whole/distance.npy"), part = values("part/distance.npy"),
                            matrix = values("matrix/distance.npy");
  const std::vector<std::int32_t> label = values<std::int32_t>("part/labels.npy");
  ASSERT_EQ(label.size(), 500u);
  ASSERT_EQ(matrix.size(), 1000u);
  run({"distance", cloud, "--source", "3,7", "--matrix", "--symmetric", "--out", in("symmetric")});
  const std::vector<double> symmetric = values("symmetric/distance.npy");
  EXPECT_EQ(symmetric[2 * 3 + 1], symmetric[2 * 7]);
  EXPECT_EQ(symmetric[2 * 3 + 1], (matrix[2 * 3 + 1] + matrix[2 * 7]) / 2);
  EXPECT_EQ(symmetric[0], matrix[0]);
  for (std::size_t i = 0; i < 500; ++i) {
    EXPECT_EQ(part[i], whole[i] <= 0.5 ? whole[i] : HUGE_VAL) << i;
    ASSERT_EQ(label[i] < 0, std::isinf(part[i])) << i;
    if (label[i] < 0) continue;
    EXPECT_NEAR(matrix[2 * i + static_cast<std::size_t>(label[i])], part[i], 0.01) << i;
  }
  EXPECT_EQ(label[3], 0);
  EXPECT_EQ(label[7], 1);
  EXPECT_LT(report("part")["report"]["visits"], report("whole")["report"]["visits"]);
  run({"distance", cloud, "--source", "3,7", "--within", "0.5", "--out", in("near")});
  EXPECT_EQ(values("near/distance.npy"), part);
  EXPECT_FALSE(report("near")["report"].contains("solver"));  // no solver for the whole surface is made
  expectRefusal({"distance", cloud, "--source", "0", "--within", "0"}, "--within");
  expectRefusal({"distance", cloud, "--source", "0", "--split", "3"}, "--split");
  expectRefusal({"distance", cloud, "--source", "0", "--time-step", "1"}, "--time-step applies to --method heat");
  expectRefusal({"distance", cloud, "--source", "0", "--split", "1", "--method", "heat"},
                "--split applies to --method marching");
  expectRefusal({"distance", cloud, "--source", "0", "--labels", "--matrix"}, "--matrix");
  expectRefusal({"distance", cloud, "--source", "0", "--symmetric"}, "--symmetric requires --matrix");
}

TEST_F(ApplicationCommands, DistanceReportsTheGreatestResidualOfAMatrix) {
  const std::string cloud = dir_.write("sphere.xyz", sphere(500));
  const auto residual = [&](const std::string& sources) {
    run({"distance", cloud, "--source", sources, "--matrix", "--method", "heat", "--out", in(sources)});
    return report(sources)["report"]["residual"].get<double>();
  };
  EXPECT_EQ(residual("3,7,99"), std::max({residual("3"), residual("7"), residual("99")}));
}

TEST_F(ApplicationCommands, PlacesComeFromFiles) {
  const std::string cloud = dir_.write("sphere.xyz", sphere(500));
  const std::string places = dir_.write("places.txt", "# by index, by position\n3\r\n\n-1, 0 0 # x y z\n 7.000e+00");
  run({"distance", cloud, "--source", "3,7", "--near", "-1,0,0", "--out", in("options")});
  run({"distance", cloud, "--sources", places, "--out", in("file")});
  EXPECT_EQ(values("options/distance.npy"), values("file/distance.npy"));
  run({"green", cloud, "--sources", places, "--out", in("green")});
  EXPECT_EQ(values("green/green.npy").size(), 1500u);

  const std::string pins = dir_.write("pins.txt", "1 0 0 5\n-1 0 0 6\n");
  run({"interpolate", cloud, "--pin", "1,0,0=5", "--pin", "-1,0,0=6", "--out", in("options")});
  run({"interpolate", cloud, "--pins-near", pins, "--out", in("file")});
  EXPECT_EQ(values("options/values.npy"), values("file/values.npy"));

  expectRefusal({"distance", cloud, "--sources", in("nowhere")}, "nowhere: cannot be read", 1);
  expectRefusal({"distance", cloud, "--sources", dir_.write("word.txt", "1\nx\n")}, "word.txt: line 2: 'x'", 1);
  expectRefusal({"distance", cloud, "--sources", dir_.write("two.txt", "\n1 2\n")}, "two.txt: line 2 is neither");
  expectRefusal({"interpolate", cloud, "--pins", dir_.write("index.txt", "500 1\n")}, "index.txt: line 1 is no index");
  expectRefusal({"interpolate", cloud, "--pins-near", dir_.write("short.txt", "1 0 0\n")}, "short.txt: line 1", 1);
}

TEST_F(ApplicationCommands, PlacesAreCheckedBeforeTheBuild) {
  const std::string cloud = dir_.write("sphere.xyz", sphere(100));
  // A build fails with --normals, because the file has none.
  expectRefusal({"distance", cloud, "--normals", "--source", "0"}, "--normals", 1);
  expectRefusal({"distance", cloud, "--normals", "--source", "100"}, "--source 100 is no index in [0, 100)");
  expectRefusal({"distance", cloud, "--normals", "--near", "0,0,nan"}, "--near 0,0,nan is not finite");
  expectRefusal({"distance", cloud, "--normals", "--face", "0,1,1,1"}, "applies to meshes");
  expectRefusal({"distance", cloud, "--normals"}, "no source");
  expectRefusal({"green", cloud, "--normals", "--source", "-1"}, "--source -1");
  expectRefusal({"interpolate", cloud, "--normals", "--pin", "100=1"}, "--pin 100=1 is no index");
  expectRefusal({"interpolate", cloud, "--normals", "--pin", "1=inf"}, "not finite");
}

TEST_F(ApplicationCommands, CountsAreCheckedBeforeTheBuild) {
  const std::string cloud = dir_.write("sphere.xyz", sphere(100));
  // A build fails with --normals, because the file has none.
  for (const std::string command : {"spectrum", "hks", "operators"}) {
    const std::string most = command == "operators" ? "100" : "99", more = command == "operators" ? "101" : "100";
    expectRefusal({command, cloud, "--normals", "--count", most}, "--normals", 1);
    expectRefusal({command, cloud, "--normals", "--count", more}, "--count = " + more + ", must be at most " + most);
  }
  expectRefusal({"embed", cloud, "--normals", "--dimension", "100"}, "--dimension = 100");
  expectRefusal({"filter", cloud, "--normals", "--positions", "--count", "100"}, "--count = 100");
  expectRefusal({"filter", cloud, "--normals", "--positions", "--wavelength", "1"}, "--normals", 1);
}

TEST_F(ApplicationCommands, OperatorsFromAFolderAreThoseOfABuild) {
  const std::string cloud = dir_.write("sphere.xyz", sphere(300)), mesh = dir_.write("tetrahedron.off", tetrahedron);
  for (const std::string& file : {cloud, mesh}) {
    run({"laplacian", file, "--out", in("folder")});
    run({"operators", file, "--count", "3", "--out", in("built")});
    run({"operators", "--operator", in("folder"), "--count", "3", "--out", in("read")});
    for (const char* name : {"/operators.npz", "/points.ply"})
      EXPECT_TRUE(readAll(in("built") + name) == readAll(in("read") + name)) << file << name;
  }
  const std::string copy = readAll(dir_ / "built/points.ply");
  EXPECT_NE(copy.find("property float frames_8\n"), std::string::npos);
  EXPECT_NE(copy.find("property float evecs_2\n"), std::string::npos);
  run({"operators", cloud, "--count", "3", "--format", "pcd", "--out", in("pcd")});
  EXPECT_NE(readAll(dir_ / "pcd/points.pcd").find(" frames evecs "), std::string::npos);
  run({"laplacian", mesh, "--format", "npz,pcd", "--out", in("folder")});
  expectRefusal({"operators", "--operator", in("folder")}, "triangles of a mesh", 1);
  run({"laplacian", mesh, "--format", "npz", "--out", in("folder")});
  expectRefusal({"operators", "--operator", in("folder")}, "has no points", 1);
}

TEST_F(ApplicationCommands, InterpolateTakesPinsByIndexPositionAndFile) {
  const std::string cloud = dir_.write("sphere.xyz", sphere(500));
  const std::string pins = dir_.write("pins.txt", "3 1 10\n\n7 2 20\n");
  run({"laplacian", cloud, "--out", in("laplacian")});
  for (const std::vector<std::string>& source : {std::vector<std::string>{cloud}, {"--operator", in("laplacian")}}) {
    std::vector<std::string> arguments = {"interpolate", "--pins", pins, "--pin", "9=0,0", "--pin", "-1,0,0=3,30"};
    arguments.insert(arguments.end(), source.begin(), source.end());
    arguments.insert(arguments.end(), {"--out", in("out")});
    run(arguments);
    const std::vector<double> found = values("out/values.npy");
    ASSERT_EQ(found.size(), 1000u);
    EXPECT_EQ(found[2 * 3], 1);
    EXPECT_EQ(found[2 * 7 + 1], 20);
    EXPECT_EQ(found[2 * 9], 0);
    for (int i = 0; i < 500; ++i) {
      EXPECT_TRUE(found[2 * i] >= -1e-12 && found[2 * i] <= 3 + 1e-12) << i;
      EXPECT_NEAR(found[2 * i + 1], 10 * found[2 * i], 1e-10);
    }
    EXPECT_EQ(report("out")["pins"], 4);
  }
  run({"interpolate", cloud, "--pin", "0=1", "--pin", "1=2", "--method", "biharmonic", "--out", in("smooth")});
  EXPECT_EQ(report("smooth")["method"], "biharmonic");
  expectRefusal({"interpolate", cloud}, "--pin");
  expectRefusal({"interpolate", cloud, "--pin", "0"}, "INDEX=V");
  expectRefusal({"interpolate", cloud, "--pin", "0.5=1"}, "--pin 0.5=1 is no index");
  expectRefusal({"interpolate", cloud, "--pin", "0=1", "--pin", "1=1,2"}, "--pin 1=1,2 has 2 values");
  expectRefusal({"interpolate", cloud, "--pin", "500=1"}, "500");
}

TEST_F(ApplicationCommands, GreenHasAColumnPerPoint) {
  const std::string cloud = dir_.write("sphere.xyz", sphere(500));
  run({"green", cloud, "--source", "3,7", "--out", in("out")});
  const std::vector<double> green = values("out/green.npy");
  ASSERT_EQ(green.size(), 1000u);
  EXPECT_NEAR(green[2 * 7], green[2 * 3 + 1], 1e-12);
  EXPECT_EQ(report("out")["sources"], nlohmann::json({3, 7}));
  expectRefusal({"green", cloud}, "no point is given");
  expectRefusal({"green", cloud, "--source", "-1"}, "-1");
}

TEST_F(ApplicationCommands, AdaptedTimeStepsFollowTheLargeTrianglesOfAnUnevenMesh) {
  // A strip of squares, or of rectangles whose width grows.
  const auto timeStep = [&](double growth, const std::string& unit) {
    std::string strip = "OFF\n42 40 0\n";
    double x = 0, width = 1;
    for (int i = 0; i <= 20; ++i, x += width, width *= growth)
      strip += std::to_string(x) + " 0 0\n" + std::to_string(x) + " 1 0\n";
    for (int i = 0; i < 40; i += 2)
      strip += "3 " + std::to_string(i) + ' ' + std::to_string(i + 2) + ' ' + std::to_string(i + 1) + "\n3 " +
               std::to_string(i + 1) + ' ' + std::to_string(i + 2) + ' ' + std::to_string(i + 3) + '\n';
    run({"distance", dir_.write("strip.off", strip), "--source", "0", "--method", "heat", "--time-unit", unit, "--out",
         in("out")});
    return report("out")["time_step"].get<double>();
  };
  EXPECT_NEAR(timeStep(1, "mean"), 0.5 * (1 + 1 + 2) / 3, 1e-3);  // half the mean square of sides and diagonals
  EXPECT_NEAR(timeStep(1, "adapted"), timeStep(1, "mean"), 1e-12);
  EXPECT_GT(timeStep(1.5, "adapted"), 2 * timeStep(1.5, "mean"));
  expectRefusal({"distance", in("strip.off"), "--source", "0", "--method", "heat", "--time-unit", "huge"},
                "--time-unit");
}

TEST_F(ApplicationCommands, StopAtCtrlCWhileTheySolve) {
  // A strip so long that heat takes many rounds.
  const int squares = 20000;
  std::string strip = "OFF\n" + std::to_string(2 * squares + 2) + ' ' + std::to_string(2 * squares) + " 0\n";
  for (int i = 0; i <= squares; ++i) strip += std::to_string(i) + " 0 0\n" + std::to_string(i) + " 1 0\n";
  for (int i = 0; i < 2 * squares; i += 2) {
    const std::string a = ' ' + std::to_string(i), b = ' ' + std::to_string(i + 1), c = ' ' + std::to_string(i + 2),
                      d = ' ' + std::to_string(i + 3);
    strip += '3' + a + c + b + "\n3" + b + c + d + '\n';
  }
  run({"laplacian", dir_.write("strip.off", strip), "--format", "npz,ply,cover", "--out", in("strip")});
  run({"laplacian", dir_.write("sphere.xyz", sphere(20000)), "--out", in("sphere")});
  struct Case {
    std::string folder, stage;
    std::vector<std::string> arguments;
  };
  const std::vector<Case> cases = {{"strip", "directions", {"distance", "--source", "0", "--method", "heat"}},
                                   {"strip", "analyse", {"distance", "--source", "0", "--method", "heat"}},
                                   {"sphere", "analyse", {"interpolate", "--pin", "0=1", "--pin", "1=2"}},
                                   {"sphere", "analyse", {"poisson", "--field", "x"}},
                                   {"sphere", "analyse", {"poisson", "--field", "x", "--pin", "0=1"}},
                                   {"sphere", "analyse", {"green", "--source", "0"}},
                                   {"sphere", "eigenpairs", {"operators"}},
                                   {"sphere", "eigenpairs", {"hks"}},
                                   {"sphere", "eigenpairs", {"embed"}},
                                   {"sphere", "eigenpairs", {"filter", "--positions"}}};
  for (const Case& c : cases) {
    std::vector<std::string> arguments = c.arguments;
    arguments.insert(arguments.end(), {"--operator", in(c.folder), "--out", in("out")});
    const Result result = interruptTufted(arguments, SIGINT, c.stage);
    EXPECT_EQ(result.code, 130) << c.arguments[0] << ", " << c.stage;
    EXPECT_FALSE(std::filesystem::exists(in("out"))) << c.arguments[0] << ", " << c.stage;
    std::filesystem::remove_all(in("out"));
  }
}

TEST_F(ApplicationCommands, TellThatTwoPartsAreBadlyJoined) {
  constexpr int side = 30, size = side * side;
  tufted::Geometry geometry;
  geometry.points = tufted::Points::Random(2 * size, 3);
  const auto write = [&](double weight) {
    tufted::writeLaplacian(in("joined"), tufted::support::joinedGrids(side, {weight}), geometry,
                           {.formats = {tufted::Format::npz}});
  };
  write(1);
  run({"green", "--source", "0", "--operator", in("joined"), "--out", in("f")});
  const std::vector<std::vector<std::string>> commands = {
      {"green", "--source", "0"},
      {"poisson", "--values", in("f/green.npy")},
      {"poisson", "--values", in("f/green.npy"), "--pin", "0=1"},
      {"green", "--source", "0", "--solver", "multigrid"},
  };
  for (const double weight : {1e-12}) {
    write(weight);
    for (std::vector<std::string> command : commands) {
      command.insert(command.end(), {"--operator", in("joined"), "--out", in("out"), "--verbose"});
      const std::string said = run(command).out;
      const auto made = report("out")["report"];
      ASSERT_TRUE(made["backward_error"].is_number()) << command[0];
      EXPECT_LE(made["backward_error"], 1e-13) << command[0] << ", " << weight;
      EXPECT_NE(said.find("backward error "), std::string::npos) << said;
      const auto& joint = made["nearly_disconnected"];
      EXPECT_NE(said.find("nearly disconnected"), std::string::npos) << said;
      ASSERT_FALSE(joint.is_null()) << command[0] << ", " << weight;
      EXPECT_GT(made["residual"], 1e-8);
      EXPECT_EQ(joint["weight"], weight);
      EXPECT_EQ(joint["parts"], nlohmann::json::parse(R"([{"point": 0, "size": 900}, {"point": 900, "size": 900}])"));
    }
  }
  write(1);
  EXPECT_EQ(run({"green", "--source", "0", "--operator", in("joined"), "--out", in("out")}).out.find("disconnected"),
            std::string::npos);
  EXPECT_TRUE(report("out")["report"]["nearly_disconnected"].is_null());
}

TEST_F(ApplicationCommands, TellWhichPairIsAllRounding) {
  constexpr int side = 10;
  tufted::Geometry geometry;
  geometry.points = tufted::Points::Random(2 * side * side, 3);
  for (const double weight : {1.0, 1e-13}) {
    tufted::writeLaplacian(in("joined"), tufted::support::joinedGrids(side, {weight}), geometry,
                           {.formats = {tufted::Format::npz}});
    if (weight == 1) run({"green", "--source", "0", "--operator", in("joined"), "--out", in("f")});
    const std::vector<std::pair<std::vector<std::string>, int>> commands = {
        {{"spectrum", "--count", "20", "--with-null-space"}, 1},
        {{"spectrum", "--count", "198"}, 0},
        {{"hks", "--count", "5"}, 0},
        {{"embed"}, 0},
        {{"filter", "--count", "5", "--values", in("f/green.npy")}, 0}};
    for (auto [command, pair] : commands) {
      command.insert(command.end(), {"--operator", in("joined"), "--out", in("out"), "--verbose"});
      const std::string said = run(command).out;
      const auto made = report("out")["report"];
      EXPECT_EQ(made["weak_pair"], weight == 1 ? -1 : pair) << command[0];
      EXPECT_EQ(said.find("nearly disconnected") == std::string::npos, weight == 1) << said;
      EXPECT_EQ(made["residual"] > 1e-8, weight < 1) << command[0];
      EXPECT_LE(made["backward_error"], 1e-10) << command[0];
    }
  }
}

}  // namespace
}  // namespace applications_test
