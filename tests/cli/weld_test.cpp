// Meshes with --weld: every subcommand takes indices of the file, and its results have the file's rows.
#include <array>
#include <set>

#include "subcommands.h"

namespace weld_test {
namespace {

TEST_F(Subcommands, WithWeldAllIndicesAndRowsAreThoseOfTheFile) {
  // A bent square of 25 positions; each triangle has three vertices of its own, and the last triangle comes first.
  std::string vertices, faces;
  int corners = 0;
  for (int j = 3; j >= 0; --j)
    for (int i = 3; i >= 0; --i)
      for (const auto& triangle :
           {std::array{i, j, i + 1, j, i, j + 1}, std::array{i + 1, j, i + 1, j + 1, i, j + 1}}) {
        for (int k = 0; k < 6; k += 2) {
          const double x = triangle[k], y = triangle[k + 1];
          vertices += "v " + std::to_string(x) + ' ' + std::to_string(y) + ' ' + std::to_string(0.1 * x * y) + '\n';
        }
        faces += "f " + std::to_string(corners + 1) + ' ' + std::to_string(corners + 2) + ' ' +
                 std::to_string(corners + 3) + '\n';
        corners += 3;
      }
  ASSERT_EQ(corners, 96);
  const std::string mesh = dir_.write("torn.obj", vertices + faces);
  const std::set<std::string> not_per_point = {"evals.npy",    "path.npy",  "frames.npy",          "times.npy",
                                               "energies.npy", "noise.npy", "component_edges.npy", "isolines.npy"};
  for (std::vector<std::string> command : commands) {
    if (command[0] == "denoise") continue;  // for clouds only
    command.insert(command.end(), {mesh, "--weld", "--out", in("out")});
    std::filesystem::remove_all(in("out"));
    run(command);
    for (const auto& entry : std::filesystem::directory_iterator(in("out"))) {
      const std::string name = entry.path().filename().string();
      if (!name.ends_with(".npy") || not_per_point.count(name) > 0) continue;
      EXPECT_TRUE(contains(readAll(entry.path()).substr(0, 128), "'shape': (96,")) << command[0] << ' ' << name;
    }
    if (const std::string points = in("out/points.ply"); std::filesystem::exists(points)) {
      EXPECT_TRUE(contains(readAll(points), "element vertex 96")) << command[0];
    }
  }
  // Vertices 84, 91 and 93 are at (1, 0), only 90 at (0, 0), and only 4 at (4, 4).
  run({"path", mesh, "--weld", "--from", "93", "--to", "4", "--out", in("path")});
  run({"path", mesh, "--weld", "--from", "91", "--to", "4", "--out", in("same")});
  EXPECT_EQ(readAll(dir_ / "path/path.npy"), readAll(dir_ / "same/path.npy"));
  run({"distance", mesh, "--weld", "--source", "93", "--out", in("distance")});
  const std::vector<double> distance = values("distance/distance.npy");
  EXPECT_EQ(distance[84], 0);
  EXPECT_EQ(distance[91], 0);
  EXPECT_EQ(distance[93], 0);
  EXPECT_NEAR(distance[90], 1, 1e-9);
  run({"laplacian", mesh, "--weld", "--format", "npz,ply,cover", "--out", in("saved")});
  run({"distance", "--operator", in("saved"), "--source", "93", "--out", in("again")});
  EXPECT_EQ(readAll(dir_ / "again/distance.npy"), readAll(dir_ / "distance/distance.npy"));
}

}  // namespace
}  // namespace weld_test
