// The subcommands poisson and filter, which take functions on the points, and embed.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "subcommands.h"

namespace signals_test {
namespace {

class SignalCommands : public Subcommands {
 protected:
  /// Points of the unit sphere with the field f = z, and a point that is not finite.
  std::string sphereWithField(int points) {
    std::istringstream lines(sphere(points));
    std::string text = "x y z f\n";
    for (std::string line; std::getline(lines, line);) text += line + line.substr(line.rfind(' ')) + '\n';
    return dir_.write("sphere.txt", text + "nan 0 0 5\n");
  }
  std::string npy(const std::string& name, const std::string& shape, const std::vector<double>& numbers) {
    std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" + shape + "), }\n";
    std::string bytes("\x93NUMPY\x01\0", 8);
    bytes += static_cast<char>(header.size());
    bytes += '\0' + header;
    bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double));
    return dir_.write(name, bytes);
  }
  /// z of the points of sphere(), which is minus its Laplacian over 2.
  std::vector<double> heights(int points) {
    std::istringstream numbers(sphere(points));
    std::vector<double> result;
    for (double x = 0, y = 0, z = 0; numbers >> x >> y >> z;) result.push_back(z);
    return result;
  }
};

TEST_F(SignalCommands, PoissonSolvesForAFieldAsForAnArrayFromFileOrFolder) {
  const std::string file = sphereWithField(1000);
  run({"poisson", file, "--field", "f", "--out", in("field")});
  const std::vector<double> u = values("field/u.npy"), mean = values("field/mean.npy"), z = heights(1000);
  ASSERT_EQ(u.size(), 1001u);
  EXPECT_TRUE(std::isnan(u[1000]));
  EXPECT_EQ(mean[1000], 0);
  const double shift = std::accumulate(z.begin(), z.end(), 0.0) / 1000 / 2;  // close to the mean over the area
  for (int i = 0; i < 1000; ++i) {
    EXPECT_NEAR(u[i], z[i] / 2 - shift, 0.05) << i;
    EXPECT_EQ(mean[i], mean[0]);
  }
  EXPECT_EQ(report("field")["greatest_mean"], std::abs(mean[0]));
  EXPECT_LE(report("field")["report"]["residual"], 1e-10);
  EXPECT_NE(readAll(dir_ / "field/points.ply").find("property float u\n"), std::string::npos);

  run({"laplacian", file, "--out", in("folder")});
  run({"poisson", "--operator", in("folder"), "--field", "f", "--out", in("read")});
  EXPECT_TRUE(readAll(dir_ / "read/u.npy") == readAll(dir_ / "field/u.npy"));
  std::vector<double> f = z;
  f.push_back(NAN);  // for the point that is not finite
  run({"poisson", file, "--values", npy("f.npy", "1001, ", f), "--out", in("array")});
  EXPECT_NEAR(values("array/u.npy")[500], u[500], 1e-6);  // the file has float text of six digits
}

TEST_F(SignalCommands, PoissonTakesPins) {
  const std::string file = sphereWithField(500);
  run({"poisson", file, "--field", "f,x", "--pin", "3=1,2", "--pin", "7=0,0", "--out", in("out")});
  const std::vector<double> u = values("out/u.npy");
  EXPECT_EQ(u[2 * 3], 1);
  EXPECT_EQ(u[2 * 3 + 1], 2);
  EXPECT_FALSE(std::filesystem::exists(in("out/mean.npy")));
  expectRefusal({"poisson", file, "--field", "f", "--normals", "--pin", "3=1,2"}, "pins have 2 values");
}

TEST_F(SignalCommands, FunctionsAreCheckedBeforeTheBuild) {
  const std::string file = sphereWithField(100);
  for (const std::string command : {"poisson", "filter"}) {
    // A build fails with --normals, because the file has none.
    expectRefusal({command, file, "--normals", "--field", "f"}, "--normals", 1);
    expectRefusal({command, file, "--normals"}, command == "filter" ? "exactly one of --field, --values and --positions"
                                                                    : "exactly one of --field and --values");
    expectRefusal({command, file, "--normals", "--field", "f,g"}, "--field g: ");
    expectRefusal({command, file, "--normals", "--field", "nx"}, "--field nx: ");
    expectRefusal({command, file, "--normals", "--values", npy("f.npy", "3, ", {1, 2, 3})}, "f.npy: has 3 rows", 1);
    expectRefusal({command, file, "--normals", "--values", in("none.npy")}, "none.npy: no such file", 1);
  }
  expectRefusal({"filter", file, "--normals", "--positions", "--field", "f"}, "--positions excludes");
  std::vector<double> f(101, 1);
  f[3] = NAN;
  expectRefusal({"poisson", file, "--values", npy("f.npy", "101, ", f)}, "point 3 are not finite", 1);
  for (const char* name : {"u.npy", "mean.npy"}) {
    std::filesystem::rename(in("f.npy"), in(name));
    const Result inside = runTufted({"poisson", file, "--values", in(name), "--out", dir_.path().string()});
    EXPECT_EQ(inside.code, 2);
    EXPECT_NE(inside.err.find("would overwrite it"), std::string::npos) << inside.err;
    std::filesystem::rename(in(name), in("f.npy"));
  }
}

TEST_F(SignalCommands, FilterKeepsLongWavesAndTakesOutShortOnes) {
  const std::string file = dir_.write("sphere.xyz", sphere(1000));
  const std::vector<double> z = heights(1000);
  std::vector<double> f;
  for (int i = 0; i < 1000; ++i) f.insert(f.end(), {z[i] + 1, (i * 7919 % 1000) / 1000.0});
  const std::string array = npy("f.npy", "1000, 2", f);
  for (const std::vector<std::string>& how : {std::vector<std::string>{"--count", "8"}, {"--wavelength", "2.1"}}) {
    std::vector<std::string> arguments = {"filter", file, "--values", array, "--out", in("out")};
    arguments.insert(arguments.end(), how.begin(), how.end());
    run(arguments);
    EXPECT_EQ(report("out")["eigenvectors"], 8);  // of eigenvalues 2 and 6, waves of 4.4 and 2.6; the next is 1.8
    const std::vector<double> filtered = values("out/filtered.npy");
    ASSERT_EQ(filtered.size(), 2000u);
    for (int i = 0; i < 1000; ++i) {
      EXPECT_NEAR(filtered[2 * i], z[i] + 1, 0.05) << i;  // a wave of 4.4
      EXPECT_NEAR(filtered[2 * i + 1], 0.5, 0.2) << i;    // noise
    }
  }
  const std::string few = dir_.write("few.off", tetrahedron);
  expectRefusal({"filter", few, "--positions", "--wavelength", "0.1"}, "shorter than what 4 points");
  expectRefusal({"filter", file, "--values", array, "--wavelength", "0.01"}, "shorter than what 1000 points");
  expectRefusal({"filter", file, "--values", array, "--wavelength", "1", "--count", "3"}, "--wavelength");
}

TEST_F(SignalCommands, FilterMovesThePositions) {
  // All waves of the second, small sphere are too short, so its points move to their mean.
  std::string points = sphere(1000);
  std::istringstream numbers(sphere(200));
  for (double x = 0, y = 0, z = 0; numbers >> x >> y >> z;)
    points += std::to_string(9 + x / 100) + ' ' + std::to_string(y / 100) + ' ' + std::to_string(z / 100) + '\n';
  run({"filter", dir_.write("two.xyz", points), "--positions", "--count", "3", "--out", in("out")});
  const std::vector<double> moved = values("out/filtered.npy");
  ASSERT_EQ(moved.size(), 3600u);
  for (int i = 0; i < 1000; ++i) EXPECT_NEAR(std::hypot(moved[3 * i], moved[3 * i + 1], moved[3 * i + 2]), 1, 0.1) << i;
  for (int i = 1000; i < 1200; ++i) EXPECT_NEAR(moved[3 * i], 9, 2e-3) << i;
  const std::string copy = readAll(dir_ / "out/points.ply");
  EXPECT_NE(copy.find("property double x\n"), std::string::npos);
  EXPECT_EQ(copy.find("property float nx\n"), std::string::npos);
}

TEST_F(SignalCommands, ColoursOfPcdAreUnpacked) {
  for (const std::string type : {"U", "I"}) {  // some programs store the four bytes as a signed number
    std::istringstream lines(sphere(200));
    std::string pcd = "VERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F " + type +
                      "\nCOUNT 1 1 1 1\nWIDTH 200\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 200\nDATA ascii\n";
    for (std::string line; std::getline(lines, line);) pcd += line + ' ' + std::to_string(0x0a141e) + '\n';
    run({"filter", dir_.write("red.pcd", pcd), "--field", "rgb", "--count", "3", "--out", in("out")});
    const std::vector<double> colors = values("out/filtered.npy");
    ASSERT_EQ(colors.size(), 600u) << type;
    for (int i = 0; i < 200; ++i)
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(colors[3 * i + c], 10 * (c + 1), 1e-9) << type;
  }
}

TEST_F(SignalCommands, EmbedGivesCoordinatesWithoutConstants) {
  // Two spheres: the vectors of the first eigenvalue, 2 and 8, are the coordinates.
  std::string points = sphere(1000);
  std::istringstream numbers(sphere(500));
  for (double x = 0, y = 0, z = 0; numbers >> x >> y >> z;)
    points += std::to_string(9 + x / 2) + ' ' + std::to_string(y / 2) + ' ' + std::to_string(z / 2) + '\n';
  const std::string file = dir_.write("two.xyz", points);
  run({"laplacian", file, "--out", in("folder")});
  for (const std::vector<std::string>& source : {std::vector<std::string>{file}, {"--operator", in("folder")}}) {
    std::vector<std::string> arguments = {"embed", "--distance", "biharmonic", "--out", in("out")};
    arguments.insert(arguments.end(), source.begin(), source.end());
    run(arguments);
    const std::vector<double> embedding = values("out/embedding.npy"), evals = values("out/evals.npy");
    ASSERT_EQ(embedding.size(), 4500u);
    ASSERT_EQ(evals.size(), 3u);
    for (int i = 0; i < 1000; ++i)  // phi = sqrt(3 / 4 pi) x, and lambda = 2
      EXPECT_NEAR(std::hypot(embedding[3 * i], embedding[3 * i + 1], embedding[3 * i + 2]), std::sqrt(3 / M_PI) / 4,
                  0.03);
    EXPECT_NEAR(embedding[3 * 1200], 0, 1e-12);
  }
  EXPECT_NE(readAll(dir_ / "out/points.ply").find("property float embedding_2\n"), std::string::npos);
  expectRefusal({"embed", file, "--dimension", "1499"}, "k = 1499");
  expectRefusal({"embed", file, "--dimension", "0"}, "--dimension");
}

}  // namespace
}  // namespace signals_test
