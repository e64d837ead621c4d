// Clouds built by tiles.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "subcommands.h"

namespace tiled_test {
namespace {

class Tiled : public Subcommands {
 protected:
  std::vector<std::string> build(std::vector<std::string> more) const {
    more.insert(more.begin(), {"laplacian", cloud_});
    return more;
  }
  const std::string cloud_ = dir_.write("sphere.xyz", sphere(2000));
};

TEST_F(Tiled, FilesHoldTheAreasOfTheWhole) {
  run(build({"--preset", "clean", "--out", in("whole")}));
  run(build({"--preset", "clean", "--memory", "500M", "--out", in("tiles")}));
  EXPECT_EQ(values("tiles/M.npy"), values("whole/M.npy"));
  run(build({"--keep-noise", "--memory", "0.5G", "--crop", "-1,-1,0,1,1,1", "--out", in("half")}));
  const std::size_t half = values("half/M.npy").size();
  EXPECT_LT(half, 1200u);
  EXPECT_EQ(values<std::int32_t>("half/file_row.npy").size(), half);
  EXPECT_FALSE(std::filesystem::exists(in("tiles/file_row.npy")));
  run(build({"--preset", "clean", "--memory", "1e9GB", "--out", in("much")}));
  EXPECT_EQ(values("much/M.npy"), values("whole/M.npy"));
}

TEST_F(Tiled, CloudsOfWhichNoPointIsActiveAreReported) {
  const std::string three = dir_.write("three.xyz", "0 0 0\n0 0 0\n0 0 0\n");
  const auto result = runTufted({"laplacian", three, "--preset", "clean", "--memory", "500M", "--out", in("none")});
  EXPECT_NE(result.err.find("no point is active"), std::string::npos) << result.err;
}

TEST_F(Tiled, OptionsThatTilesDoNotHaveAreRefused) {
  expectRefusal(build({"--memory", "4X"}), "4X is not a size such as 4G or 500M");
  expectRefusal(build({"--memory", "-1"}), "-1 is not a size");
  expectRefusal(build({"--memory", "500M"}), "--memory needs --preset clean or --keep-noise");
  expectRefusal(build({"--memory", "10M", "--preset", "clean"}), "--memory 10M, of which the points take 0.048 MB: ");
  expectRefusal(build({"--memory", "500M", "--preset", "clean", "--verbose"}), "--memory excludes --verbose");
  expectRefusal(build({"--memory", "500M", "--preset", "clean", "--format", "npz"}), "--memory excludes --format");
  expectRefusal(build({"--keep-noise"}), "--keep-noise requires --memory");
  const std::string mesh = dir_.write("tetrahedron.off", tetrahedron);
  expectRefusal({"laplacian", mesh, "--memory", "500M", "--preset", "clean"}, "holds a mesh");
  EXPECT_FALSE(std::filesystem::exists(in("refused")));
}

}  // namespace
}  // namespace tiled_test
