// The subcommands trace and isolines, and the files of their lines.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <sstream>

#include "subcommands.h"

namespace lines_test {
namespace {

constexpr double pi = std::numbers::pi;

class Lines : public Subcommands {
 protected:
  const std::string square_ = dir_.write("square.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");

  /// The body of lines.ply, after checking its header.
  std::string bodyOf(const std::string& folder, int vertices, int edges) const {
    const std::string bytes = readAll(dir_ / folder / "lines.ply");
    EXPECT_TRUE(contains(bytes, "element vertex " + std::to_string(vertices) + "\n")) << bytes.substr(0, 300);
    EXPECT_TRUE(contains(bytes, "element edge " + std::to_string(edges) + "\n")) << bytes.substr(0, 300);
    const std::string body = bytes.substr(bytes.find("end_header\n") + 11);
    EXPECT_EQ(body.size(), 32u * static_cast<unsigned>(vertices) + 8u * static_cast<unsigned>(edges));
    return body;
  }
};

TEST_F(Lines, TraceIsAGreatCircleOfASphere) {
  const std::string file = dir_.write("sphere.xyz", sphere(2000));
  const Result result = run({"trace", file, "--near", "0,0,1", "--direction", "1,0,0", "--length",
                             std::to_string(2 * pi), "--out", in("out")});
  EXPECT_TRUE(contains(result.out, "ended by")) << result.out;
  const std::vector<double> path = values("out/path.npy");
  for (std::size_t i = 1; i < path.size(); i += 3) EXPECT_NEAR(path[i], path[1], 0.15);
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(path[path.size() - 3 + static_cast<std::size_t>(k)], path[static_cast<std::size_t>(k)], 0.15);
  EXPECT_NEAR(report("out")["length"], 2 * pi, 1e-5);
  EXPECT_EQ(report("out")["ended_by"], "length");
  EXPECT_GT(report("out")["direction"][0], 0.98);
  bodyOf("out", static_cast<int>(path.size() / 3), static_cast<int>(path.size() / 3) - 1);
  run({"laplacian", file, "--format", "npz,ply,cover", "--out", in("folder")});
  run({"trace", "--operator", in("folder"), "--near", "0,0,1", "--direction", "1,0,0", "--length",
       std::to_string(2 * pi), "--out", in("same")});
  EXPECT_EQ(readAll(dir_ / "same/path.npy"), readAll(dir_ / "out/path.npy"));
}

TEST_F(Lines, TraceStartsInsideTrianglesAndEndsAtTheRim) {
  run({"trace", square_, "--face", "0,0,1,1", "--direction", "0,1,5", "--length", "9", "--out", in("out")});
  const std::vector<double> path = values("out/path.npy");
  EXPECT_EQ(path, (std::vector<double>{1, 0.5, 0, 1, 1, 0}));
  EXPECT_EQ(report("out")["ended_by"], "rim");
  EXPECT_EQ(readAll(dir_ / "out/lines.obj"), "v 1 0.5 0\nv 1 1 0\nl 1 2\n");
}

TEST_F(Lines, PathIsWrittenAsLineToo) {
  run({"path", square_, "--from", "1", "--to", "3", "--out", in("out")});
  const std::string text = readAll(dir_ / "out/lines.obj");
  EXPECT_TRUE(text.starts_with("v 1 0 0\n") && contains(text, "v 0 1 0\nl 1 ")) << text;
  EXPECT_TRUE(contains(readAll(dir_ / "out/lines.svg"), "d=\"M820 820L")) << readAll(dir_ / "out/lines.svg");
}

TEST_F(Lines, PathLeadsAroundATubeOnTheSideThatPointsSay) {
  const std::string tube = dir_.write("tube.off",
                                      "OFF\n6 6 0\n0 0 0\n3 0 0\n0 4 0\n0 0 1\n3 0 1\n0 4 1\n"
                                      "3 0 1 4\n3 0 4 3\n3 1 2 5\n3 1 5 4\n3 2 0 3\n3 2 3 5\n");
  const auto length = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"path", tube, "--from", "0", "--to", "1", "--out", in("out")});
    run(more);
    return report("out")["length"].get<double>();
  };
  EXPECT_NEAR(length({}), 3, 1e-15);
  EXPECT_NEAR(length({"--via", "0,4,0"}), 9, 1e-14);
  EXPECT_EQ(report("out")["via_points"], std::vector<int>({2}));
  EXPECT_NEAR(length({"--via", "2", "--closed"}), 12, 1e-14);
  const std::vector<double> loop = values("out/path.npy");
  EXPECT_TRUE(std::equal(loop.begin(), loop.begin() + 3, loop.end() - 3));
  EXPECT_TRUE(contains(readAll(dir_ / "out/lines.svg"), "Z\"")) << readAll(dir_ / "out/lines.svg");
  expectRefusal({"path", tube, "--from", "0", "--to", "1", "--via", "6"}, "--via 6 is no index");
}

TEST_F(Lines, TraceRefusesOtherThanOneStartAndDirection) {
  const std::vector<std::string> line = {"trace", square_, "--direction", "1,0,0", "--length", "1"};
  const auto with = [&](std::vector<std::string> words) {
    words.insert(words.begin(), line.begin(), line.end());
    return words;
  };
  expectRefusal(line, "0 starts are given, must be one by --source, --near or --face");
  expectRefusal(with({"--source", "1", "--face", "0,1,1,1"}), "2 starts are given, must be one");
  expectRefusal(with({"--source", "4"}), "--source 4 is no index in [0, 4)");
  expectRefusal(with({"--face", "2,1,1,1"}), "--face 2,1,1,1");
  expectRefusal(with({"--as", "cloud", "--face", "0,1,1,1"}), "--face applies to meshes");
  expectRefusal({"trace", square_, "--source", "0", "--direction", "0,0,0", "--length", "1"},
                "--direction 0,0,0 has no direction");
  expectRefusal({"trace", square_, "--source", "0", "--direction", "0,0,1", "--length", "1"},
                "direction stands on the tangent plane");
  expectRefusal({"trace", square_, "--source", "0", "--direction", "1,0,0", "--length", "-1"}, "--length");
}

TEST_F(Lines, IsolinesAreWrittenAsTableEdgesAndElements) {
  run({"isolines", square_, "--field", "y", "--at", "0.25,7,0.5", "--out", in("out")});
  const std::vector<double> table = values("out/isolines.npy");
  // Larger values lie to the left: lines run towards -x or +x, which the test below tells.
  EXPECT_EQ(table, (std::vector<double>{0, 0.25, 0, 0.25, 0, 0, 0.25, 0.25, 0.25, 0, 0, 0.25, 1, 0.25, 0,  //
                                        1, 0.5,  0, 0.5,  0, 1, 0.5,  0.5,  0.5,  0, 1, 0.5,  1, 0.5,  0}));
  EXPECT_EQ(readAll(dir_ / "out/lines.obj"),
            "v 0 0.25 0\nv 0.25 0.25 0\nv 1 0.25 0\nl 1 2 3\nv 0 0.5 0\nv 0.5 0.5 0\nv 1 0.5 0\nl 4 5 6\n");
  const std::string plan = readAll(dir_ / "out/lines.svg");
  EXPECT_TRUE(contains(plan, ">0.5</text>") && contains(plan, ">0.25</text>") && !contains(plan, ">7<")) << plan;
  const std::string body = bodyOf("out", 6, 4);
  std::array<double, 4> last;
  std::memcpy(last.data(), body.data() + 5 * sizeof last, sizeof last);
  EXPECT_EQ(last, (std::array<double, 4>{1, 0.5, 0, 0.5}));
  std::array<int, 8> edges;
  std::memcpy(edges.data(), body.data() + 6 * sizeof last, sizeof edges);
  EXPECT_EQ(edges, (std::array<int, 8>{0, 1, 1, 2, 3, 4, 4, 5}));
  EXPECT_EQ(report("out")["lines"].size(), 2u);
  EXPECT_EQ(report("out")["lines"][1]["length"], 1);
  EXPECT_EQ(report("out")["lines"][1]["closed"], false);
}

TEST_F(Lines, IsolinesOfAClosedSurfaceAreClosed) {
  const std::string file = dir_.write("sphere.xyz", sphere(1000));
  run({"isolines", file, "--field", "z", "--count", "3", "--out", in("out")});
  const nlohmann::json lines = report("out")["lines"];
  ASSERT_EQ(lines.size(), 3u);
  int points = 0;
  for (const nlohmann::json& line : lines) {
    EXPECT_EQ(line["closed"], true);
    const double value = line["value"], circle = 2 * pi * std::sqrt(1 - value * value);
    EXPECT_NEAR(line["length"], circle, 0.02 * circle);
    points += line["points"].get<int>();
  }
  bodyOf("out", points, points);
  const std::string text = readAll(dir_ / "out/lines.obj");
  const std::string element =
      text.substr(text.find("\nl ") + 1, text.find('\n', text.find("\nl ") + 1) - text.find("\nl "));
  EXPECT_TRUE(element.starts_with("l 1 2 ")) << element;
  EXPECT_TRUE(element.ends_with(" 1\n") || element.ends_with(" 1")) << element;
}

TEST_F(Lines, IsolinesRefuseWhatIsNoValueOrNoField) {
  const std::vector<std::string> lines = {"isolines", square_};
  const auto with = [&](std::vector<std::string> words) {
    words.insert(words.begin(), lines.begin(), lines.end());
    return words;
  };
  expectRefusal(with({"--field", "x", "--at", "0", "--count", "2"}), "--at excludes --count");
  expectRefusal(with({"--field", "x", "--at", "0,nan"}), "--at 0,nan is not finite");
  expectRefusal(with({"--field", "x", "--at", "0,"}), "--at 0, is no list of numbers");
  expectRefusal(with({"--field", "x", "--count", "0"}), "--count");
  expectRefusal(with({"--field", "x,y", "--at", "0"}), "has 2 columns, must have one");
  expectRefusal(with({"--field", "colour", "--at", "0"}), "has no such field");
  expectRefusal(with({"--at", "0"}), "exactly one of --field and --values must be given");
}

}  // namespace
}  // namespace lines_test
