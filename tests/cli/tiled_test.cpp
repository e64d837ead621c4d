// Clouds built by tiles.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "../io/las_file.h"
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

/// Bytes of floats x y z and a class, of points on a unit sphere.
std::string records(int points) {
  std::istringstream text(sphere(points));
  std::string bytes;
  float row[4] = {};
  for (int i = 0; text >> row[0] >> row[1] >> row[2]; ++i) {
    row[3] = static_cast<float>(i % 3);
    bytes.append(reinterpret_cast<const char*>(row), sizeof row);
  }
  return bytes;
}

/// The same points as a LAS file.
std::string lasOf(const std::string& records) {
  LasFile file(2, 1);
  for (std::size_t at = 0; at < records.size(); at += 16) {
    float row[4];
    std::memcpy(row, records.data() + at, sizeof row);
    const auto stored = [](float x) { return static_cast<std::int32_t>(std::lround(1000 * x)); };
    const std::size_t point = file.addPoint(stored(row[0]), stored(row[1]), 10 * stored(row[2]));
    file.set(point + 15, static_cast<std::uint8_t>(row[3]));
  }
  return file.bytes();
}

TEST_F(Tiled, FilesReadInPassesGiveTheBytesOfThoseReadWhole) {
  for (const int points : {1500, 40000}) {  // one batch, and two of which few points are chosen
    const std::string body = records(points), count = std::to_string(points);
    const std::string npy = "{'descr': '<f4', 'fortran_order': False, 'shape': (" + count + ", 4), }";
    const std::map<std::string, std::string> files = {
        {"a.las", lasOf(body)},
        {"a.pcd", "FIELDS x y z classification\nSIZE 4 4 4 4\nTYPE F F F F\nWIDTH " + count +
                      "\nHEIGHT 1\nDATA binary\n" + body},
        {"grid.pcd",
         "FIELDS x y z classification\nWIDTH 50\nHEIGHT " + std::to_string(points / 50) + "\nDATA binary\n" + body},
        {"a.ply", "ply\nformat binary_little_endian 1.0\nelement vertex " + count +
                      "\nproperty float x\nproperty float y\nproperty float z\nproperty float classification\n"
                      "end_header\n" +
                      body},
        {"a.npy", std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(npy.size()) + '\0' + npy + body}};
    for (const auto& [name, bytes] : files) {
      const std::string path = dir_.write(name, bytes).string();
      const std::string field = name == "a.npy" ? "column3" : "classification";
      const std::string box = name == "a.las" ? "499989,5399989,-92,500011,5400011,-89" : "-1,-1,.8,1,1,1";
      std::vector<std::string> words = {"laplacian", path,   "--preset", "clean",
                                        "--memory",  "500M", "--out",    in("passes")};
      if (points > 1500) words.insert(words.end(), {"--crop", box, "--where", field + "=0,2"});
      run(words);
      words[1] = "-";
      words[7] = in("whole");
      EXPECT_EQ(runTufted(words, path).code, 0);
      nlohmann::json made = report("passes"), whole = report("whole");
      made.erase("source"), whole.erase("source");
      EXPECT_EQ(made, whole) << name;
      for (const std::string file : made["files"])
        if (file != "report.json") {
          EXPECT_TRUE(readAll(in("passes/" + file)) == readAll(in("whole/" + file))) << name << ' ' << file;
        }
    }
  }
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
  expectRefusal(build({"--memory", "10M", "--preset", "clean"}), "--memory 10M, of which reading takes 0.048 MB: ");
  expectRefusal(build({"--memory", "500M", "--preset", "clean", "--verbose"}), "--memory excludes --verbose");
  expectRefusal(build({"--memory", "500M", "--preset", "clean", "--format", "npz"}), "--memory excludes --format");
  expectRefusal(build({"--keep-noise"}), "--keep-noise requires --memory");
  const std::string mesh = dir_.write("tetrahedron.off", tetrahedron);
  expectRefusal({"laplacian", mesh, "--memory", "500M", "--preset", "clean"}, "holds a mesh");
  EXPECT_FALSE(std::filesystem::exists(in("refused")));
}

}  // namespace
}  // namespace tiled_test
