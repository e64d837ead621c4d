// The subcommands parameterize, denoise, smooth, minimal, deform and signed-distance.
#include <cmath>
#include <random>

#include "subcommands.h"

namespace moved_points_test {
namespace {

/// A unit square of n x n cells with a bump in the middle.
std::string bump(int n, double height) {
  std::string text = "OFF\n" + std::to_string((n + 1) * (n + 1)) + " " + std::to_string(2 * n * n) + " 0\n";
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
      const double z = height * std::sin(M_PI * x) * std::sin(M_PI * y);
      text += std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
    }
  const auto triangle = [&](int a, int b, int c) {
    text += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int a = i * (n + 1) + j, b = a + n + 1;
      triangle(a, b, b + 1);
      triangle(a, b + 1, a + 1);
    }
  return text;
}

class MovedPoints : public Subcommands {
 protected:
  /// The greatest third coordinate of N x 3 values.
  double highest(const std::string& file) const {
    const std::vector<double> x = values(file);
    double high = -1;
    for (std::size_t i = 2; i < x.size(); i += 3) high = std::max(high, x[i]);
    return high;
  }

  std::string open_ = dir_.write("open.off", bump(8, 0.4)), closed_ = dir_.write("closed.off", tetrahedron);
  std::string cloud_ = dir_.write("sphere.xyz", sphere(400));
};

TEST_F(MovedPoints, ParameterizeWritesTheMapAndHowGoodItIs) {
  run({"parameterize", open_, "--out", in("conformal")});
  EXPECT_EQ(values("conformal/uv.npy").size(), 2u * 81);
  nlohmann::json made = report("conformal")["report"];
  EXPECT_EQ(made["method"], "conformal");
  EXPECT_EQ(made["flipped"], 0);
  EXPECT_LT(made["quasi_conformal_error"], 1.2);
  run({"parameterize", open_, "--method", "harmonic", "--weights", "mean-value", "--out", in("disc")});
  for (const double value : values("disc/uv.npy")) EXPECT_LE(std::abs(value), 1 + 1e-12);
  dir_.write("rim.txt", "0 0 0\n72, 1, 0\n80 1 1\n8 0 1\n");
  run({"parameterize", open_, "--method", "harmonic", "--rim", in("rim.txt"), "--out", in("corners")});
  const std::vector<double> uv = values("corners/uv.npy");
  EXPECT_EQ(uv[2 * 72], 1);
  EXPECT_EQ(uv[2 * 72 + 1], 0);
}

TEST_F(MovedPoints, ParameterizeCountsEveryPointThatHasNoPlace) {
  // A square, points of no triangle and one that is not finite; then the same with a closed surface.
  const std::string beside = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n5 5 5\n6 6 6\nnan 0 0\n", faces = "3 0 1 2\n3 0 2 3\n";
  const std::string square = dir_.write("square.off", "OFF\n7 2 0\n" + beside + faces);
  const std::string parts = dir_.write("parts.off", "OFF\n11 6 0\n" + beside + "8 0 0\n9 0 0\n8 1 0\n8 0 1\n" + faces +
                                                        "3 7 9 8\n3 7 8 10\n3 8 9 10\n3 9 7 10\n");
  const auto nans = [&](const std::string& file) {
    const std::vector<double> found = values(file);
    return std::count_if(found.begin(), found.end(), [](double value) { return std::isnan(value); });
  };
  EXPECT_TRUE(contains(run({"parameterize", square, "--out", in("map")}).out, "3 points, which are NaN"));
  EXPECT_EQ(report("map")["report"]["not_mapped"], 3);
  EXPECT_EQ(nans("map/uv.npy"), 2 * 3);
  run({"weights", parts, "--handles", dir_.write("handles.txt", "0\n2\n"), "--out", in("weights")});
  EXPECT_EQ(report("weights")["report"]["not_reached"], 7);
  EXPECT_EQ(nans("weights/weights.npy"), 2 * 7);
}

TEST_F(MovedPoints, ParameterizeRefusesWhatItCannotLayOut) {
  expectRefusal({"parameterize", closed_}, "is closed, must have a rim", 1);
  expectRefusal({"parameterize", cloud_}, "is closed, must have a rim", 1);
  expectRefusal({"parameterize", open_, "--weights", "mean-value"}, "--weights needs --method harmonic");
  expectRefusal({"parameterize", open_, "--method", "flat"}, "flat is none of conformal|harmonic");
  dir_.write("rim.txt", "0\n5 1\n");
  expectRefusal({"parameterize", open_, "--rim", in("rim.txt")}, "--rim needs --method harmonic");
  expectRefusal({"parameterize", open_, "--method", "harmonic", "--rim", in("rim.txt")},
                "line 2: is not INDEX or INDEX U V", 1);
}

TEST_F(MovedPoints, DenoiseMovesTheDepthsOfAnImageAlongItsRays) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0, 0.002);
  const auto imageWith = [&](double share) {
    std::string text =
        "VERSION .7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 60\nHEIGHT 50\nPOINTS 3000\n";
    text += "DATA ascii\n";
    for (int i = 0; i < 3000; ++i) {
      const double u = (i % 60 - 30) / 100.0, v = (i / 60 - 25) / 100.0,
                   depth = 1 / (1 - 0.3 * u + 0.2 * v + share * noise(random));
      for (const double c : {u * depth, v * depth, depth}) text += std::to_string(c) + ' ';
      text += '\n';
    }
    return text;
  };
  const std::string image = dir_.write("image.pcd", imageWith(1));
  EXPECT_NE(run({"denoise", image, "--out", in("clean")}).out.find("rays"), std::string::npos);
  const nlohmann::json made = report("clean")["report"];
  EXPECT_GT(made["moved"], 2850);
  EXPECT_NEAR(made["noise"], 0.002, 0.0003);
  // The summary names the depth image even if no point moves.
  const std::string exact = run({"denoise", dir_.write("exact.pcd", imageWith(0)), "--out", in("exact")}).out;
  EXPECT_TRUE(contains(exact, "0 moved") && contains(exact, "by the pixels of a depth image")) << exact;
  // A build moves the same points, with and without --denoise.
  for (const std::vector<std::string>& asked :
       {std::vector<std::string>{}, {"--denoise"}, {"--denoise", "--preset", "clean"}}) {
    std::vector<std::string> command = {"laplacian", image, "--out", in("built")};
    command.insert(command.end(), asked.begin(), asked.end());
    run(command);
    EXPECT_EQ(report("built")["cloud_options"]["structure"], "image");
    EXPECT_EQ(report("built")["report"]["noise"], made["noise"]);
    EXPECT_EQ(values("built/measured_positions.npy"), values("clean/positions.npy"));
  }
  EXPECT_EQ(run({"denoise", image, "--structure", "none", "--out", in("clean")}).out.find("rays"), std::string::npos);
  EXPECT_NE(values("built/measured_positions.npy"), values("clean/positions.npy"));
  expectRefusal({"denoise", cloud_, "--structure", "image"}, "is one row of points", 1);
  expectRefusal({"denoise", cloud_, "--structure", "rings"}, "rings is none of automatic|image|none");
}

TEST_F(MovedPoints, DenoiseBringsPointsToTheSurface) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0, 0.02);
  std::string text;
  for (int i = 0; i < 3000; ++i) {
    double x[3];
    for (double& c : x) c = noise(random);
    const double radius = (1 + noise(random)) / std::hypot(x[0], x[1], x[2]);
    for (const double c : x) text += std::to_string(c * radius) + " ";
    text += std::to_string(i) + "\n";
  }
  const std::string scan = dir_.write("scan.txt", text);
  const Result said = run({"denoise", scan, "--out", in("clean")});
  EXPECT_NE(said.out.find("moved"), std::string::npos) << said.out;
  const nlohmann::json made = report("clean")["report"];
  EXPECT_GT(made["moved"], 2900);
  EXPECT_NEAR(made["noise"], 0.02, 0.004);
  EXPECT_EQ(values("clean/noise.npy").size(), 3000u);
  const auto off = [](const std::vector<double>& x) {
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); i += 3) sum += std::pow(std::hypot(x[i], x[i + 1], x[i + 2]) - 1, 2);
    return std::sqrt(3 * sum / static_cast<double>(x.size()));
  };
  EXPECT_LT(off(values("clean/positions.npy")), 0.008);
  // With --denoise commands that move points start from the denoised points: a tiny time step leaves them there.
  run({"smooth", scan, "--denoise", "--time-step", "1e-9", "--out", in("smooth")});
  const std::vector<double> clean = values("clean/positions.npy"), still = values("smooth/positions.npy");
  for (std::size_t i = 0; i < clean.size(); ++i) ASSERT_NEAR(still[i], clean[i], 1e-6) << i;
  run({"filter", scan, "--positions", "--denoise", "--count", "20", "--out", in("filter")});
  run({"filter", in("clean/points.ply"), "--positions", "--count", "20", "--out", in("expected")});
  const std::vector<double> filtered = values("filter/filtered.npy"), expected = values("expected/filtered.npy");
  for (std::size_t i = 0; i < clean.size(); ++i) ASSERT_NEAR(filtered[i], expected[i], 1e-5) << i;
  const std::string ply = readAll(dir_ / "clean/points.ply");
  EXPECT_NE(ply.find("property float noise"), std::string::npos);
  EXPECT_EQ(ply.find("property double mass"), std::string::npos);

  // In a build the denoised points are those between which lengths are measured.
  run({"laplacian", scan, "--denoise", "--out", in("built")});
  EXPECT_LT(off(values("built/measured_positions.npy")), 0.008);
  EXPECT_GT(report("built")["report"]["denoised"], 2900);
  EXPECT_NEAR(report("built")["report"]["noise"], 0.02, 0.004);
  // Handles without a target stay at their denoised positions.
  dir_.write("stay.txt", "0\n100\n2000\n");
  run({"deform", scan, "--denoise", "--handles", in("stay.txt"), "--out", in("deform")});
  const std::vector<double> measured = values("built/measured_positions.npy"), kept = values("deform/positions.npy");
  for (std::size_t i = 0; i < measured.size(); ++i) ASSERT_NEAR(kept[i], measured[i], 1e-6) << i;
  run({"distance", scan, "--denoise", "--source", "0", "--out", in("distance")});
  EXPECT_GT(report("distance")["build"]["denoised"], 2900);
}

TEST_F(MovedPoints, DenoiseSaysThatThereIsNothingToDo) {
  const std::string exact = dir_.write("exact.xyz", sphere(2000));
  const Result said = run({"denoise", exact, "--out", in("same"), "--format", "none"});
  EXPECT_NE(said.out.find("none that can be told"), std::string::npos) << said.out;
  EXPECT_EQ(report("same")["report"]["moved"], 0);
  expectRefusal({"denoise", open_}, "is a mesh; --as cloud takes its points alone", 1);
  // denoise takes only clouds, which have no vertices to join.
  expectRefusal({"denoise", open_, "--weld"}, "unknown option `--weld`");
  EXPECT_FALSE(contains(runTufted({"denoise", "--help"}).out, "--weld"));
  expectRefusal({"laplacian", open_, "--denoise"}, "--denoise applies to point clouds");
}

TEST_F(MovedPoints, SmoothMovesPointsOrFields) {
  run({"smooth", open_, "--time-step", "4", "--out", in("implicit")});
  EXPECT_LT(highest("implicit/positions.npy"), 0.38);
  EXPECT_GT(report("implicit")["way"]["farthest"], 0.02);
  run({"smooth", open_, "--method", "taubin", "--iterations", "5", "--out", in("taubin")});
  EXPECT_GT(highest("taubin/positions.npy"), 0.38);
  EXPECT_EQ(report("taubin")["report"]["mu"], -0.53);
  run({"smooth", cloud_, "--time-step", "20", "--keep-volume", "--out", in("round")});
  const std::vector<double> x = values("round/positions.npy");
  EXPECT_NEAR(std::hypot(x[0], x[1], x[2]), 1, 0.05);
  run({"smooth", cloud_, "--method", "flow", "--iterations", "2", "--out", in("flow")});
  EXPECT_EQ(report("flow")["report"]["time_step"], 0.01);
  const std::vector<double> on_ball = values("flow/positions.npy");
  EXPECT_NEAR(std::hypot(on_ball[0], on_ball[1], on_ball[2]), 1, 0.05);
  run({"smooth", open_, "--field", "z", "--out", in("field")});
  EXPECT_EQ(values("field/smoothed.npy").size(), 81u);
  dir_.write("fixed.txt", "40\n");
  run({"smooth", open_, "--fixed", in("fixed.txt"), "--out", in("fixed")});
  EXPECT_NEAR(highest("fixed/positions.npy"), 0.4, 1e-6);
}

TEST_F(MovedPoints, SmoothRefusesOptionsThatDoNotFit) {
  expectRefusal({"smooth", open_, "--mu", "-0.5"}, "--mu needs --method taubin");
  expectRefusal({"smooth", open_, "--method", "taubin", "--time-step", "1"},
                "--time-step needs --method implicit or flow");
  expectRefusal({"smooth", open_, "--lambda", "2", "--method", "taubin"}, "--lambda: 2 is not a number in (0, 1]");
  expectRefusal({"smooth", open_, "--keep-volume", "--field", "x"}, "--keep-volume excludes --field");
  expectRefusal({"smooth", open_, "--keep-volume"}, "has a rim, must be closed", 1);
  expectRefusal({"smooth", open_, "--method", "flow", "--field", "x"}, "--method flow excludes --keep-volume");
  dir_.write("fixed.txt", "1\n81\n");
  expectRefusal({"smooth", open_, "--fixed", in("fixed.txt")}, "line 2 is no index in [0, 81)");
}

TEST_F(MovedPoints, MinimalFlattensWithinAFlatRim) {
  // The summary gives the last move off the surface; points also move within it.
  EXPECT_NE(run({"minimal", open_, "--out", in("soap")}).out.find("in the last one points left the surface by at most"),
            std::string::npos);
  EXPECT_LE(highest("soap/positions.npy"), 1e-3);
  const nlohmann::json made = report("soap")["report"];
  EXPECT_TRUE(made["converged"]);
  EXPECT_EQ(made["fixed"], 32);
  EXPECT_NEAR(made["area"], 1, 1e-4);
  const Result few = runTufted({"minimal", open_, "--iterations", "1", "--out", in("few")});
  EXPECT_EQ(few.code, 0);
  EXPECT_NE(few.err.find("--iterations was too small"), std::string::npos) << few.err;
  expectRefusal({"minimal", closed_}, "has no rim, so points that stay in place must be given", 1);
  dir_.write("fixed.txt", "# none\n");
  expectRefusal({"minimal", open_, "--fixed", in("fixed.txt")}, "names no point, must name one", 1);
}

TEST_F(MovedPoints, SignedDistanceIsPositiveToTheLeft) {
  // The curve runs along y through the middle. The normals point up, so -x is to its left.
  std::string along;
  for (int j = 0; j <= 8; ++j) along += std::to_string(4 * 9 + j) + "\n";
  dir_.write("curve.txt", along);
  dir_.write("flat.off", bump(8, 0));
  run({"signed-distance", in("flat.off"), "--curve", in("curve.txt"), "--out", in("out")});
  const std::vector<double> distance = values("out/distance.npy");
  EXPECT_NEAR(distance[0], 0.5, 1e-6);
  EXPECT_NEAR(distance[80], -0.5, 1e-6);
  EXPECT_NEAR(report("out")["curve"]["length"], 1, 1e-12);
  // Also from a second curve, one of whose places lies in a triangle, and from a point.
  dir_.write("rim.txt", "0 1 0 0\n8\n");
  const Result long_step = runTufted({"signed-distance", in("flat.off"), "--curve", in("curve.txt"), "--curve",
                                      in("rim.txt"), "--method", "marching", "--near", "1,1,0", "--out", in("out")});
  EXPECT_EQ(long_step.code, 0);
  EXPECT_NE(long_step.err.find("1 of the 9 segments of the curves are longer"), std::string::npos) << long_step.err;
  const std::vector<double> several = values("out/distance.npy");
  EXPECT_EQ(several[80], 0);
  EXPECT_EQ(report("out")["method"], "marching");
  EXPECT_NEAR(several[3 * 9 + 4], 0.125, 1e-6);
  EXPECT_NEAR(several[6 * 9 + 4], -0.25, 1e-6);
  dir_.write("bad.txt", "0\n1 2\n");
  expectRefusal({"signed-distance", open_, "--curve", in("bad.txt")}, "line 2: is neither INDEX nor FACE A B C", 1);
  dir_.write("bad.txt", "0\n");
  expectRefusal({"signed-distance", open_, "--curve", in("bad.txt")}, "has 1 points, must have at least 2", 1);
  dir_.write("bad.txt", "0\n0\n");
  expectRefusal({"signed-distance", open_, "--curve", in("bad.txt")}, "must have at least two on one component", 1);
  dir_.write("bad.txt", "999 1 0 0\n0\n");
  expectRefusal({"signed-distance", open_, "--curve", in("bad.txt")}, "line 1: face = 999, must lie in");
  expectRefusal({"signed-distance", open_}, "no curve is given, must be at least one by --curve");
  expectRefusal({"signed-distance", open_, "--curve", in("curve.txt"), "--source", "3"},
                "--source, --near, --sources and --face apply to --method marching");
  expectRefusal({"signed-distance", open_, "--curve", in("curve.txt"), "--split", "1"}, "--split applies to --method");
  expectRefusal({"signed-distance", open_, "--curve", in("curve.txt"), "--method", "marching", "--time-step", "2"},
                "--time-step applies to --method heat");
}

TEST_F(MovedPoints, WeightsOfHandlesHaveTheSumOne) {
  dir_.write("points.txt", "0\n40\n80\n");
  run({"weights", open_, "--handles", in("points.txt"), "--out", in("out")});
  const std::vector<double> weights = values("out/weights.npy");
  ASSERT_EQ(weights.size(), 3u * 81);
  EXPECT_EQ(weights[3 * 40 + 1], 1);
  for (std::size_t i = 0; i < 81; ++i)
    EXPECT_NEAR(weights[3 * i] + weights[3 * i + 1] + weights[3 * i + 2], 1, 1e-14) << i;
  EXPECT_LE(report("out")["report"]["residual"], 1e-8);
  dir_.write("points.txt", "0 0\n8 0\n80 1\n");
  run({"weights", open_, "--handles", in("points.txt"), "--out", in("two")});
  EXPECT_EQ(values("two/weights.npy").size(), 2u * 81);
  dir_.write("bad.txt", "0 0\n8 2\n");
  expectRefusal({"weights", open_, "--handles", in("bad.txt")}, "has no handle 1, but handle 2", 1);
  dir_.write("bad.txt", "0\n8 1\n");
  expectRefusal({"weights", open_, "--handles", in("bad.txt")}, "line 2: is not INDEX, as the first line", 1);
  dir_.write("bad.txt", "0\n0\n");
  expectRefusal({"weights", open_, "--handles", in("bad.txt")}, "must be of one", 1);
}

TEST_F(MovedPoints, DeformPutsHandlesWhereTheyShallLie) {
  dir_.write("handles.txt", "0\n8\n72\n80\n40 0.5 0.5 1  # up\n");
  for (const char* method : {"rigid", "linear"}) {
    run({"deform", open_, "--handles", in("handles.txt"), "--method", method, "--out", in("out")});
    const std::vector<double> x = values("out/positions.npy");
    EXPECT_EQ(x[3 * 40 + 2], 1);
    EXPECT_EQ(x[2], 0);
    EXPECT_EQ(report("out")["report"]["method"], method);
    EXPECT_GT(report("out")["report"]["stretch"], 0);
  }
  expectRefusal({"deform", open_, "--handles", in("handles.txt"), "--smoothness", "-1"}, "--smoothness");
  dir_.write("bad.txt", "0\n8 1 2\n");
  expectRefusal({"deform", open_, "--handles", in("bad.txt")}, "line 2: is not INDEX or INDEX X Y Z", 1);
  dir_.write("bad.txt", "0\n8 1 2 nan\n");
  expectRefusal({"deform", open_, "--handles", in("bad.txt")}, "line 2", 1);
  expectRefusal({"deform", open_}, "--handles");
}

}  // namespace
}  // namespace moved_points_test
