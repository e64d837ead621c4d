// Points that the user names but that take no part: they are left out with a warning, or refused.
#include <cmath>

#include "subcommands.h"

namespace taking_part_test {
namespace {

class NamedPoints : public Subcommands {
 protected:
  /// Point 0 is not finite; 1 to 300 and 301 to 500 are two spheres, and 501 lies far from both.
  std::string odd() {
    std::string text = "nan nan nan\n" + sphere(300);
    for (const std::string& line : linesOf(sphere(200))) {
      const std::size_t blank = line.find(' ');
      text += std::to_string(std::stod(line.substr(0, blank)) + 10) + line.substr(blank) + "\n";
    }
    return dir_.write("odd.ply",
                      "ply\nformat ascii 1.0\nelement vertex 501\nproperty double x\nproperty double y\n"
                      "property double z\nend_header\n" +
                          text);
  }

  /// Runs the command, and expects a warning with the reason, and the point in the report.
  void expectLeftOut(std::vector<std::string> arguments, const std::string& count, const std::string& why) {
    arguments.insert(arguments.end(), {"--out", in("out")});
    const Result result = runTufted(arguments);
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_TRUE(result.err.starts_with("tufted: " + count + " points that are named take no part: " + why + "\n"))
        << result.err;
    EXPECT_TRUE(contains(result.out, "left out        " + count + " points that are named\n")) << result.out;
    EXPECT_EQ(report("out")["left_out"].size(), 1u);
  }
};

TEST_F(NamedPoints, ThatTakeNoPartAreLeftOutByEveryCommandThatTakesSeveral) {
  const std::string file = odd(), handles = dir_.write("handles.txt", "0 0\n5 0\n250 1\n"),
                    places = dir_.write("places.txt", "0 0 0 0\n5\n250\n"),
                    curve = dir_.write("curve.txt", "0\n5\n6\n");
  const std::string why = "point 0 is not finite";
  for (const char* method : {"marching", "heat"})
    expectLeftOut({"distance", file, "--source", "0,5", "--method", method}, "1 of 2", why);
  expectLeftOut({"distance", file, "--source", "0,5", "--within", "0.5"}, "1 of 2", why);
  expectLeftOut({"interpolate", file, "--pin", "0=1", "--pin", "5=0"}, "1 of 2", why);
  expectLeftOut({"extend", file, "--pin", "0=1", "--pin", "5=0"}, "1 of 2", why);
  expectLeftOut({"poisson", file, "--field", "x", "--pin", "0=1", "--pin", "5=0"}, "1 of 2", why);
  expectLeftOut({"transport", file, "--source", "0,5", "--vector", "1,0,0", "--vector", "0,0,1"}, "1 of 2", why);
  expectLeftOut({"weights", file, "--handles", handles}, "1 of 3", why);
  expectLeftOut({"deform", file, "--handles", places}, "1 of 3", why);
  expectLeftOut({"signed-distance", file, "--curve", curve}, "1 of 3", why);
  expectLeftOut({"distance", file, "--source", "5,400", "--component", "largest"}, "1 of 2",
                "point 400 lies on a component that --component largest leaves out");
}

TEST_F(NamedPoints, ThatTakeNoPartHaveAnInfiniteColumnAmongDistances) {
  expectLeftOut({"distance", odd(), "--source", "0,5", "--matrix"}, "1 of 2", "point 0 is not finite");
  const std::vector<double> found = values("out/distance.npy");
  ASSERT_EQ(found.size(), 2u * 501);
  for (std::size_t i = 0; i < 501; ++i) EXPECT_TRUE(std::isinf(found[2 * i])) << i;
  EXPECT_EQ(found[2 * 5 + 1], 0);
}

TEST_F(NamedPoints, AreRefusedWithTheReasonWhereNoneIsLeftOrAllAreNeeded) {
  const std::string file = odd();
  const std::string none = "no point that is named takes part, must be at least one: point 0 is not finite";
  expectRefusal({"distance", file, "--source", "0"}, none);
  expectRefusal({"interpolate", file, "--pin", "0=1"}, none);
  expectRefusal({"transport", file, "--source", "0", "--vector", "1,0,0"}, none);
  for (const std::vector<std::string>& command : {std::vector<std::string>{"green", file, "--source", "5,0"},
                                                  {"logmap", file, "--source", "0"},
                                                  {"path", file, "--from", "5", "--to", "0"},
                                                  {"segment", file, "--seeds", "5,0"}})
    expectRefusal(command, "point 0 is not finite, must take part");
  expectRefusal({"green", file, "--source", "400", "--min-component", "250"},
                "point 400 lies on a component that --min-component 250 leaves out, must take part");
  const std::string mesh = dir_.write("loose.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0\n5 5 5\n3 0 1 2\n");
  expectRefusal({"distance", mesh, "--source", "3"}, "point 3 is isolated");
}

TEST_F(NamedPoints, OnDifferentComponentsHaveNoPathWhichIsTheFaultOfTheFile) {
  expectRefusal({"path", odd(), "--from", "5", "--to", "400"},
                ": no path leads from 5 to 400, must lie on one component", 1);
}

TEST_F(NamedPoints, AreListsWithoutEmptyWords) {
  const std::string file = odd();
  for (const char* list : {"5,,6", "5,", ",5", ""}) expectRefusal({"distance", file, "--source", list}, "--source");
  expectRefusal({"distance", file, "--source", "5,501"}, "--source 501 is no index in [0, 501)");
}

}  // namespace
}  // namespace taking_part_test
