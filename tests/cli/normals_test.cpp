// The subcommands normals and curvature, and the sources of the sensor's position.
#include <cmath>
#include <fstream>
#include <sstream>

#include "subcommands.h"
#include "tufted/io/read.h"

namespace normals_test {
namespace {

using Normals = Subcommands;

/// The share of normals that point away from the origin.
double outward(const std::vector<double>& normals, const tufted::Points& points) {
  double count = 0;
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    count += points(i, 0) * normals[3 * i] + points(i, 1) * normals[3 * i + 1] + points(i, 2) * normals[3 * i + 2] > 0;
  return count / static_cast<double>(points.rows());
}

TEST_F(Normals, PointOutwardsAndFaceTheSensorWhereItIsKnown) {
  const std::string file = dir_.write("sphere.xyz", sphere(500));
  const tufted::Points points = tufted::read(file).points;
  EXPECT_NE(run({"normals", file, "--out", in("out")}).out.find("outwards on 1 component,"), std::string::npos);
  EXPECT_EQ(outward(values("out/normals.npy"), points), 1);
  EXPECT_EQ(report("out")["orientation"]["disagreeing_edges"], 0);
  EXPECT_NE(readAll(dir_ / "out/points.ply").find("property float nx\n"), std::string::npos);

  // With the centre as viewpoint all face inwards.
  EXPECT_NE(run({"normals", file, "--viewpoint", "0,0,0", "--out", in("in")}).out.find("towards the sensor"),
            std::string::npos);
  EXPECT_EQ(outward(values("in/normals.npy"), points), 0);
  EXPECT_EQ(report("in")["orientation"]["towards"], "viewpoint");
  run({"normals", file, "--viewpoint", "0,0,0", "--consistent", "--out", in("out")});
  EXPECT_EQ(outward(values("out/normals.npy"), points), 1);

  // The folder stores the orientation.
  run({"laplacian", file, "--viewpoint", "0,0,0", "--out", in("folder")});
  EXPECT_EQ(report("folder")["orientation"], "viewpoint");
  run({"normals", "--operator", in("folder"), "--out", in("in")});
  EXPECT_EQ(outward(values("in/normals.npy"), points), 0);
  run({"normals", "--operator", in("folder"), "--consistent", "--out", in("out")});
  EXPECT_EQ(outward(values("out/normals.npy"), points), 1);
}

TEST_F(Normals, OfAnOpenSheetAreSaidToHaveNoOutsideAndUpDecides) {
  std::string valley;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 40; ++j)
      valley += std::to_string(i + 0.1 * (j % 3)) + ' ' + std::to_string(j) + ' ' +
                std::to_string(0.02 * j * j - 0.8 * j) + '\n';
  const std::string file = dir_.write("valley.xyz", valley);
  const auto upward = [&] {
    int count = 0;
    const std::vector<double> normals = values("out/normals.npy");
    for (std::size_t i = 2; i < normals.size(); i += 3) count += normals[i] > 0 ? 1 : 0;
    return count;
  };
  const std::string text = run({"normals", file, "--out", in("out")}).out;
  EXPECT_TRUE(contains(text, "alike on 1 open component without an outside (--up or, of a scan, --viewpoint decides)"))
      << text;
  EXPECT_FALSE(contains(text, "outwards")) << text;
  EXPECT_EQ(report("out")["orientation"]["open"], 1);
  EXPECT_TRUE(contains(run({"normals", file, "--up", "z", "--out", in("out")}).out, "upwards on 1 open component"));
  EXPECT_EQ(upward(), 1600);
  run({"normals", file, "--up", "-z", "--out", in("out")});
  EXPECT_EQ(upward(), 0);
  run({"curvature", file, "--up", "z", "--out", in("out")});
  const double below = values("out/curvature.npy")[4 * 820];
  run({"curvature", file, "--up", "-z", "--out", in("out")});
  EXPECT_EQ(values("out/curvature.npy")[4 * 820], -below);
  EXPECT_LT(below, 0);
}

TEST_F(Normals, OfMeshesAreThoseOfTheirTriangles) {
  const std::string file = dir_.write("tetrahedron.off", tetrahedron);
  run({"normals", file, "--out", in("out")});
  EXPECT_EQ(values("out/normals.npy").size(), 12u);
  run({"laplacian", file, "--out", in("folder")});
  run({"normals", "--operator", in("folder"), "--out", in("same")});
  EXPECT_EQ(values("same/normals.npy"), values("out/normals.npy"));
}

TEST_F(Normals, DecideOnTheSignOfCurvature) {
  const std::string file = dir_.write("sphere.xyz", sphere(2000));
  run({"curvature", file, "--out", in("out")});
  const std::vector<double> outward = values("out/curvature.npy");
  ASSERT_EQ(outward.size(), 8000u);
  for (int i = 0; i < 2000; ++i) {
    EXPECT_NEAR(outward[4 * i], 1, 0.1);      // H
    EXPECT_NEAR(outward[4 * i + 1], 1, 0.2);  // K
    EXPECT_GE(outward[4 * i + 2], outward[4 * i + 3]);
  }
  EXPECT_EQ(values("out/principal_directions.npy").size(), 12000u);
  EXPECT_NE(readAll(dir_ / "out/points.ply").find("property float curvature_3\n"), std::string::npos);
  EXPECT_EQ(report("out")["report"]["undetermined"], 0);
  run({"curvature", file, "--viewpoint", "0,0,0", "--out", in("in")});
  const std::vector<double> inward = values("in/curvature.npy");
  // Frames that face a viewpoint are those of the tangent planes, others are fitted anew; curvature hardly differs.
  for (int i = 0; i < 2000; ++i) EXPECT_NEAR(inward[4 * i], -outward[4 * i], 1e-6);
  run({"curvature", file, "--method", "laplacian", "--out", in("laplacian")});
  EXPECT_EQ(values("laplacian/curvature.npy").size(), 2000u);
  EXPECT_FALSE(std::filesystem::exists(in("laplacian/principal_directions.npy")));
  expectRefusal({"curvature", file, "--method", "laplacien"}, "did you mean `laplacian`?");
  expectRefusal({"curvature", file, "--method", "laplacian", "--rings", "5"}, "--rings applies to --method fit");
}

TEST_F(Normals, OfPointsThatTakeNoPartHaveNoCurvatureToSumUp) {
  const std::string file = dir_.write("sphere.xyz", sphere(2000) + "nan nan nan\n900 0 0\n");
  for (const char* method : {"fit", "laplacian"}) {
    const std::string said = run({"curvature", file, "--method", method, "--out", in(method)}).out;
    EXPECT_TRUE(contains(said, ", 1 / length, without 2 points that take no part\n")) << said;
    EXPECT_FALSE(contains(said, "mean curvature  0 to")) << said;
    EXPECT_EQ(report(method)["report"]["left_out"], 2);
  }
  const std::string whole = run({"curvature", dir_.write("whole.xyz", sphere(200)), "--out", in("whole")}).out;
  EXPECT_TRUE(contains(whole, ", 1 / length\n")) << whole;
}

TEST_F(Normals, RefuseWhatTheyCannotUse) {
  const std::string file = dir_.write("sphere.xyz", sphere(200));
  const std::string mesh = dir_.write("tetrahedron.off", tetrahedron);
  expectRefusal({"normals", file, "--viewpoint", "1,2"}, "--viewpoint 1,2 is not X,Y,Z");
  expectRefusal({"normals", file, "--viewpoint", "1,2,inf"}, "--viewpoint 1,2,inf is not finite");
  expectRefusal({"normals", file, "--viewpoint", "up"}, "--viewpoint up is no list of numbers");
  expectRefusal({"normals", mesh, "--viewpoint", "1,2,3"}, "--viewpoint applies to point clouds");
  run({"laplacian", file, "--out", in("folder")});
  expectRefusal({"normals", "--operator", in("folder"), "--viewpoint", "1,2,3"}, "--viewpoint");
  // A report of an older version, and an invalid one.
  const auto change = [&](const std::string& from, const std::string& to) {
    std::string text = readAll(dir_ / "folder/report.json");
    text.replace(text.find(from), from.size(), to);
    std::ofstream(dir_ / "folder/report.json") << text;
  };
  change("\"orientation\": \"arbitrary\"", "\"orientation\": \"upwards\"");
  expectRefusal({"normals", "--operator", in("folder")}, "has the orientation '\"upwards\"', must be arbitrary", 1);
  change("\"orientation\": \"upwards\",", "");
  run({"normals", "--operator", in("folder"), "--out", in("out")});
  change("\"measured_positions.npy\",", "");
  expectRefusal({"normals", "--operator", in("folder")}, "has no measured_positions.npy", 1);
}

}  // namespace
}  // namespace normals_test
