// Lengths and times beyond the size of the points or below their spacing, and positions far from all points.
#include <gtest/gtest.h>

#include <cmath>

#include "subcommands.h"

namespace units_test {
namespace {

class Units : public Subcommands {
 protected:
  /// Expects a command to be refused on the unit sphere and on the folder of its Laplacian, with the word, a size near
  /// 2 sqrt(3), the diagonal of the box, and a spacing near 0.11, the root of the area per point.
  void expectBothRefused(const std::vector<std::string>& command, const std::string& word) {
    for (const std::vector<std::string>& source : {std::vector<std::string>{cloud_}, {"--operator", in("folder")}}) {
      std::vector<std::string> arguments = command;
      arguments.insert(arguments.end(), source.begin(), source.end());
      expectRefusal(arguments, word);
      expectRefusal(arguments, ": " + source.back() + " has the size 3.5");
      expectRefusal(arguments, " and the spacing 0.12");
    }
  }
  void SetUp() override { run({"laplacian", cloud_, "--format", "npz,ply,cover", "--out", in("folder")}); }

  const std::string cloud_ = dir_.write("sphere.xyz", sphere(1000));
};

TEST_F(Units, WavesLongerThanAllOrShorterThanThePointsTellAreRefused) {
  expectBothRefused({"filter", "--positions", "--wavelength", "200"},
                    "--wavelength 200 is longer than the longest wave, 4.4");
  expectBothRefused({"filter", "--positions", "--wavelength", "5"}, "--wavelength 5 is longer");
  expectBothRefused({"filter", "--positions", "--wavelength", "0.01"}, "--wavelength 0.01 is shorter");
  for (const char* wavelength : {"4.2", "0.8"}) {
    run({"filter", cloud_, "--positions", "--wavelength", wavelength, "--out", in("out")});
    const std::vector<double> moved = values("out/filtered.npy");
    EXPECT_GT(std::hypot(moved[0] - moved[30], moved[1] - moved[31], moved[2] - moved[32]), 0.1);
  }
}

TEST_F(Units, TimesOfHeatThatIsEvenOrStaysWhereItIsAreRefused) {
  expectBothRefused({"hks", "--count", "10", "--times", "1,1000"}, "--times 1000: heat goes 31.6228, and after 18.1");
  expectBothRefused({"hks", "--count", "10", "--times", "1e-4,1"},
                    "--times 0.0001: heat goes 0.01, not to the next point: ");
  run({"hks", cloud_, "--count", "10", "--times", "0.05,15", "--out", in("out")});
  run({"hks", cloud_, "--count", "10", "--out", in("out")});
}

TEST_F(Units, TimeStepsOfDistancesThatCoverAllOrNothingAreRefused) {
  const std::vector<std::string> distance = {"distance", "--source", "0", "--method", "heat", "--time-step"};
  const auto with = [&](const char* step) {
    std::vector<std::string> command = distance;
    command.emplace_back(step);
    return command;
  };
  expectBothRefused(with("1e12"), "--time-step 1e+12: heat goes 1");
  expectBothRefused(with("1e4"), ", beyond all points: ");
  for (const std::string step : {"1e-300", "5e-5"}) {
    std::vector<std::string> command = with(step.c_str());
    command.push_back(cloud_);
    expectRefusal(command, "--time-step: " + step + " is not a number in [0.0001, 1e+12]");
  }
  for (const char* step : {"0.001", "0.03", "0.5", "100"})
    run({"distance", cloud_, "--source", "0", "--method", "heat", "--time-step", step, "--out", in("out")});
}

TEST_F(Units, ThePointTakenForAPositionIsAlwaysSaid) {
  const std::string places = dir_.write("places.txt", "0 0 1.5\n");
  const std::string pins = dir_.write("pins.txt", "0 0 1.5 7\n");
  struct Case {
    std::vector<std::string> near, far;
    std::string name;
  };
  const std::vector<Case> cases = {
      {{"distance", "--near", "0,0,1"}, {"distance", "--near", "1000,0,0"}, "--near 1000,0,0"},
      {{"green", "--near", "0,0,1"}, {"green", "--sources", places}, places + ": line 1"},
      {{"interpolate", "--pin", "0,0,1=7"}, {"interpolate", "--pin", "1000,0,0=7"}, "--pin 1000,0,0=7"},
      {{"poisson", "--field", "x", "--pin", "0,0,1=7"},
       {"poisson", "--field", "x", "--pins-near", pins},
       pins + ": line 1"}};
  for (const Case& c : cases) {
    for (const bool is_far : {false, true}) {
      std::vector<std::string> arguments = is_far ? c.far : c.near;
      arguments.insert(arguments.end(), {cloud_, "--out", in("out")});
      const Result result = runTufted(arguments);
      EXPECT_EQ(result.code, 0) << result.err;
      const auto nearest = report("out")["nearest"];
      ASSERT_EQ(nearest.size(), 1u);
      const std::string point = std::to_string(nearest[0]["point"].get<int>());
      EXPECT_TRUE(contains(result.out, "nearest         point " + point + ", ")) << result.out;
      EXPECT_EQ(nearest[0]["distance"] > nearest[0]["spacing"], is_far);
      if (is_far) {
        EXPECT_TRUE(isOneLine(result.err)) << result.err;
        EXPECT_TRUE(result.err.starts_with("tufted: " + c.name + ": the nearest point, " + point + ", is "))
            << result.err;
        EXPECT_TRUE(contains(result.out, " from " + c.name + "\n")) << result.out;
      } else {
        EXPECT_EQ(result.err, "");
      }
    }
  }
}

TEST_F(Units, ManyPositionsAreSaidInTheReport) {
  std::string text;
  for (int i = 0; i < 30; ++i) text += "0 0 " + std::to_string(5 + i) + '\n';
  const Result result = runTufted({"green", cloud_, "--sources", dir_.write("places.txt", text), "--out", in("out")});
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(report("out")["nearest"].size(), 30u);
  EXPECT_EQ(linesOf(result.err).size(), 11u) << result.err;
  EXPECT_TRUE(contains(result.out, "nearest         to further positions: see report.json\n")) << result.out;
}

}  // namespace
}  // namespace units_test
