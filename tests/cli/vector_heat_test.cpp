// The subcommands extend, transport and logmap.
#include <cmath>

#include "subcommands.h"
#include "tufted/io/read.h"

namespace vector_heat_test {
namespace {

using VectorHeat = Subcommands;

TEST_F(VectorHeat, ExtendCarriesPinsAsInterpolateTakesThem) {
  const std::string file = dir_.write("sphere.xyz", sphere(500));
  EXPECT_NE(run({"extend", file, "--pin", "0,0,1=1", "--pin", "0,0,-1=3", "--out", in("out")}).out.find("not reached"),
            std::string::npos);
  const std::vector<double> found = values("out/values.npy");
  ASSERT_EQ(found.size(), 500u);
  const tufted::Points points = tufted::read(file).points;
  for (int i = 0; i < 500; ++i) {
    EXPECT_GE(found[i], 1);
    EXPECT_LE(found[i], 3);
    EXPECT_NEAR(found[i], points(i, 2) > 0 ? 1 : 3, std::abs(points(i, 2)) > 0.9 ? 0.05 : 2);
  }
  EXPECT_EQ(report("out")["pins"], 2);
  EXPECT_GT(report("out")["time_step"], 0);
  run({"laplacian", file, "--out", in("folder")});
  run({"extend", "--operator", in("folder"), "--pin", "0,0,1=1", "--pin", "0,0,-1=3", "--out", in("same")});
  EXPECT_EQ(values("same/values.npy"), found);
  expectRefusal({"extend", file}, "no pin is given");
  expectRefusal({"extend", file, "--pin", "0=1", "--time-step", "1e9"}, "beyond all points");
}

TEST_F(VectorHeat, TransportTakesAVectorPerSource) {
  const std::string file = dir_.write("sphere.xyz", sphere(500));
  run({"transport", file, "--source", "3,7", "--near", "-1,0,0", "--vector", "1,2,3", "--vector", "0,1,0", "--vector",
       "0,0,2", "--out", in("out")});
  const std::vector<double> found = values("out/vectors.npy");
  ASSERT_EQ(found.size(), 1500u);
  const tufted::Points points = tufted::read(file).points;
  for (int i = 0; i < 500; ++i) {
    const Eigen::RowVector3d vector(found[3 * i], found[3 * i + 1], found[3 * i + 2]);
    EXPECT_LE(std::abs(vector.dot(points.row(i))), 0.2 * vector.norm());
    EXPECT_GT(vector.norm(), 0);
    EXPECT_LE(vector.norm(), 4);
  }
  EXPECT_NE(readAll(dir_ / "out/points.ply").find("property float vectors_2\n"), std::string::npos);
  EXPECT_EQ(report("out")["sources"].size(), 3u);
  expectRefusal({"transport", file, "--source", "3,7", "--vector", "1,2,3"}, "1 of --vector for 2 sources");
  expectRefusal({"transport", file}, "no source is given");
  expectRefusal({"transport", file, "--source", "3", "--vector", "1,2"}, "--vector 1,2 is not X,Y,Z");
  run({"laplacian", file, "--out", in("folder")});
  run({"transport", "--operator", in("folder"), "--source", "3", "--vector", "1,2,3", "--out", in("same")});
  EXPECT_EQ(values("same/vectors.npy").size(), 1500u);
}

TEST_F(VectorHeat, LogmapHasItsAxesInTheReport) {
  const std::string file = dir_.write("sphere.xyz", sphere(2000));
  run({"logmap", file, "--near", "0,0,1", "--axis", "1,0,0", "--out", in("out")});
  const std::vector<double> map = values("out/logmap.npy");
  ASSERT_EQ(map.size(), 4000u);
  EXPECT_GT(report("out")["axes"][0][0], 0.9);
  EXPECT_GT(report("out")["axes"][1][1], 0.9);  // counterclockwise, seen from outside
  const tufted::Points points = tufted::read(file).points;
  for (int i = 0; i < 2000; ++i) {
    if (points(i, 2) < 0) continue;
    const double angle = std::atan2(points(i, 1), points(i, 0)), distance = std::acos(std::min(1.0, points(i, 2)));
    EXPECT_NEAR(map[2 * i], distance * std::cos(angle), 0.15);
    EXPECT_NEAR(map[2 * i + 1], distance * std::sin(angle), 0.15);
  }
  run({"logmap", file, "--near", "0,0,1", "--axis", "1,0,0", "--viewpoint", "0,0,0", "--out", in("in")});
  EXPECT_LT(report("in")["axes"][1][1], -0.9);
  expectRefusal({"logmap", file}, "0 sources are given, must be one");
  expectRefusal({"logmap", file, "--source", "1,2"}, "2 sources are given, must be one");
  expectRefusal({"logmap", file, "--source", "1", "--axis", "0,0,0"}, "--axis 0,0,0 has no direction");
  const std::string mesh = dir_.write("tetrahedron.off", tetrahedron);
  run({"logmap", mesh, "--source", "1", "--out", in("mesh")});
  EXPECT_EQ(values("mesh/logmap.npy").size(), 8u);
}

TEST_F(VectorHeat, DefaultsDoForATetrahedron) {
  const std::string mesh = dir_.write("tetrahedron.off", tetrahedron);
  expectRefusal({"transport", mesh, "--source", "1", "--vector", "0,0,0"}, "--vector 0,0,0 has no direction");
  run({"transport", mesh, "--source", "1", "--vector", "1,2,3", "--out", in("out")});
  EXPECT_EQ(values("out/vectors.npy").size(), 12u);
  run({"extend", mesh, "--pin", "1=2", "--out", in("out")});
  for (const double value : values("out/values.npy")) EXPECT_EQ(value, 2);
  expectRefusal({"extend", mesh, "--pin", "1=2", "--time-step", "1e6"}, "beyond all points");
}

}  // namespace
}  // namespace vector_heat_test
