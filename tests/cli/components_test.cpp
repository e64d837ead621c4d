// Connected components on the command line, segments and triangles.
#include <algorithm>
#include <cmath>

#include "subcommands.h"
#include "tufted/io/read.h"

namespace components_test {
namespace {

class ComponentCommands : public Subcommands {
 protected:
  /// Two spheres, of 300 and of 200 points.
  std::string twoSpheres() {
    std::string text = sphere(300);
    const tufted::Points small = tufted::read(dir_.write("small.xyz", sphere(200))).points;
    for (Eigen::Index i = 0; i < small.rows(); ++i)
      text += std::to_string(small(i, 0) + 10) + " " + std::to_string(small(i, 1)) + " " + std::to_string(small(i, 2)) +
              "\n";
    return dir_.write("spheres.xyz", text);
  }
};

TEST_F(ComponentCommands, AreNumberedInAFile) {
  const std::string file = twoSpheres();
  run({"laplacian", file, "--out", in("folder"), "--format", "npz"});
  const std::string bytes = readAll(dir_ / "folder/components.npy");
  EXPECT_NE(bytes.find("'<i4'"), std::string::npos);
  EXPECT_EQ(bytes.size() % 64, (500 * 4) % 64);
  EXPECT_EQ(bytes.substr(bytes.size() - 4), std::string("\1\0\0\0", 4));
}

TEST_F(ComponentCommands, CanBeChosen) {
  const std::string file = twoSpheres();
  EXPECT_NE(run({"distance", file, "--source", "0", "--component", "largest", "--out", in("out")})
                .out.find("components      1 of 2, 300 points (60 %)\n"),
            std::string::npos);
  EXPECT_EQ(report("out")["components"]["of"], 2);
  run({"distance", file, "--source", "0", "--min-component", "250", "--out", in("same")});
  EXPECT_EQ(values("same/distance.npy"), values("out/distance.npy"));
  run({"normals", file, "--component", "0,1", "--out", in("both")});
  EXPECT_EQ(report("both")["components"]["points"], 500);
  expectRefusal({"distance", file, "--source", "499", "--component", "largest"},
                "point 499 lies on a component that --component largest leaves out");
  expectRefusal({"normals", file, "--component", "2"}, "--component 2: " + file + " has 2 components, counted from 0");
  expectRefusal({"normals", file, "--component", "larges"}, "--component larges");
  expectRefusal({"normals", file, "--min-component", "301"}, "has 2 components, the largest of 300 points");
  expectRefusal({"normals", file, "--min-component", "3", "--component", "1"}, "--component");
}

TEST_F(ComponentCommands, HaveTheirConstantsInTheNullSpace) {
  const std::string file = twoSpheres();
  EXPECT_NE(run({"spectrum", file, "--count", "5", "--out", in("positive")}).out.find("null space      2, "),
            std::string::npos);
  const std::vector<double> positive = values("positive/evals.npy");
  ASSERT_EQ(positive.size(), 5u);
  EXPECT_GT(positive[0], 0);
  EXPECT_EQ(report("positive")["null_space"], 2);
  run({"spectrum", file, "--count", "5", "--with-null-space", "--out", in("all")});
  const std::vector<double> all = values("all/evals.npy");
  ASSERT_EQ(all.size(), 7u);
  EXPECT_EQ(all[0], 0);
  EXPECT_EQ(all[1], 0);
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(all[k + 2], positive[k], 1e-9 * positive[k]);
  run({"hks", file, "--count", "5", "--out", in("hks")});
  for (const double value : values("hks/hks.npy")) EXPECT_GT(value, 0);
  const Result few = runTufted({"operators", file, "--count", "3", "--out", in("operators")});
  EXPECT_EQ(few.code, 0);
  EXPECT_NE(few.err.find("2 of 3 eigenvalues are 0"), std::string::npos) << few.err;
}

TEST_F(ComponentCommands, AreTheFirstSegments) {
  const std::string file = twoSpheres();
  for (const char* method : {"voronoi", "spectral"}) {
    run({"segment", file, "--count", "2", "--method", method, "--out", in(method)});
    const std::string bytes = readAll(dir_ / method / "labels.npy");
    EXPECT_NE(bytes.find("'<i4'"), std::string::npos);
    EXPECT_EQ(report(method)["report"]["areas"].size(), 2u);
    EXPECT_EQ(report(method)["report"]["without_label"], 0);
  }
  run({"segment", file, "--seeds", "3,400,5", "--out", in("seeds")});
  EXPECT_EQ(report("seeds")["report"]["seeds"].size(), 3u);
  run({"segment", file, "--method", "parts", "--out", in("parts")});
  EXPECT_EQ(report("parts")["report"]["method"], "parts");
  EXPECT_EQ(report("parts")["report"]["areas"].size(), 2u);
  EXPECT_EQ(report("parts")["orientation"]["towards"], "outside");
  expectRefusal({"segment", file, "--method", "parts", "--count", "2"}, "--count excludes --method parts");
  expectRefusal({"segment", file, "--method", "parts", "--seeds", "2"}, "--seeds excludes --method parts");
  expectRefusal({"segment", file, "--method", "parts", "--crease", "0"}, "--crease: 0 is not a number in");
  expectRefusal({"segment", file, "--seeds", "3,3"}, "seed 3 is given twice");
  expectRefusal({"segment", file, "--seeds", "3,500"}, "--seeds 3,500");
  expectRefusal({"segment", file, "--seeds", "3", "--method", "spectral"}, "--seeds excludes --method spectral");
  expectRefusal({"segment", dir_.write("tetrahedron.off", tetrahedron), "--count", "5"},
                "--count 5: segments: count = 5, must be at most 4");
  expectRefusal({"segment", file, "--count", "0"}, "--count: 0 is not an integer in [1,");
}

TEST_F(ComponentCommands, HaveTrianglesToLookAt) {
  const std::string file = dir_.write("sphere.xyz", sphere(500));
  run({"laplacian", file, "--format", "triangles", "--out", in("out")});
  const tufted::Geometry cloud = tufted::read(dir_ / "out/triangles.ply");
  EXPECT_TRUE(cloud.is_mesh);
  EXPECT_EQ(cloud.points.rows(), 500);
  EXPECT_EQ(cloud.triangles.rows(), 2 * 500 - 4);
  const std::string mesh = dir_.write("tetrahedron.off", tetrahedron);
  run({"laplacian", mesh, "--format", "triangles", "--out", in("mesh")});
  EXPECT_EQ(tufted::read(dir_ / "mesh/triangles.ply").triangles, tufted::read(mesh).triangles);
}

}  // namespace
}  // namespace components_test
