#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "../io/las_file.h"
#include "../io/temporary_dir.h"
#include "command.h"
#include "samples.h"

namespace info_test {
namespace {

using Json = nlohmann::json;

class Info : public testing::Test {
 protected:
  Json info(const std::string& file) {
    const Result result = runTufted({"info", file, "--json"});
    EXPECT_EQ(result.code, 0) << result.err;
    return Json::parse(result.out);
  }

  /// Whether one of the oddities begins with this text.
  static bool isOdd(const Json& info, const std::string& beginning) {
    for (const Json& sentence : info["odd"])
      if (sentence.get<std::string>().starts_with(beginning)) return true;
    return false;
  }

  TemporaryDir dir_;
};

TEST_F(Info, SaysWhatAnOrganizedCloudHolds) {
  std::string text =
      "VERSION .7\nFIELDS x y z label normal_x normal_y normal_z\nSIZE 4 4 4 2 4 4 4\nTYPE F F F U F F F\n"
      "COUNT 1 1 1 2 1 1 1\nWIDTH 3\nHEIGHT 2\nVIEWPOINT 1 2 3 1 0 0 0\nPOINTS 6\nDATA ascii\n";
  for (int i = 0; i < 5; ++i) text += std::to_string(i % 3) + " " + std::to_string(i / 3) + " 0 7 8 0 0 1\n";
  const Json cloud = info(dir_.write("a.pcd", text + "nan nan nan 7 8 0 0 1\n"));
  EXPECT_EQ(cloud["format"], "PCD, ascii");
  EXPECT_EQ(cloud["kind"], "cloud");
  EXPECT_EQ(cloud["points"], 6);
  EXPECT_EQ(cloud["organized"], true);
  EXPECT_EQ(cloud["width"], 3);
  EXPECT_EQ(cloud["viewpoint"][2], 3);
  EXPECT_EQ(cloud["normals"], true);
  EXPECT_EQ(cloud["fields"], Json::parse(R"([{"name": "label", "type": "uint16", "count": 2}])"));
  EXPECT_EQ(cloud["highest"], Json::parse("[2, 1, 0]"));
  EXPECT_EQ(cloud["spacing"], 1);
  EXPECT_EQ(cloud["not_finite"], 1);
  EXPECT_TRUE(isOdd(cloud, "points that are not finite")) << cloud["odd"];
}

TEST_F(Info, ExpectsTheBuildByPixelsOfADepthImage) {
  // A slope seen by a pinhole camera at the origin, as an image and as one row.
  std::string points;
  for (int i = 0; i < 40 * 30; ++i) {
    const double x = (i % 40 - 19.5) / 40, y = (i / 40 - 14.5) / 40, depth = 2 / (1 - 0.3 * x);
    points += std::to_string(depth * x) + " " + std::to_string(depth * y) + " " + std::to_string(depth) + "\n";
  }
  const auto pcd = [&](int width, int height) {
    return "VERSION .7\nFIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + std::to_string(width) +
           "\nHEIGHT " + std::to_string(height) + "\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 1200\nDATA ascii\n" + points;
  };
  const std::string file = dir_.write("image.pcd", pcd(40, 30));
  const Json image = info(file);
  const Json cloud = info(dir_.write("cloud.pcd", pcd(1200, 1)));
  EXPECT_EQ(image["structure"], "image");
  EXPECT_EQ(cloud["structure"], "none");
  EXPECT_TRUE(contains(runTufted({"info", file}).out, "\nstructure       depth image, built by its pixels\n"));
  const Json searched = Json::parse(runTufted({"info", "--json", file, "--neighbors", "20"}).out);
  EXPECT_EQ(searched["structure"], "none");
}

TEST_F(Info, SaysWhatIsOddAboutAMesh) {
  const Json mesh = info(dir_.write("a.obj",
                                    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nv 0 -1 0\n"
                                    "f 1 2 3\nf 1 2 4\nf 1 2 5\nf 1 1 2\n"));
  EXPECT_EQ(mesh["kind"], "mesh");
  EXPECT_EQ(mesh["triangles"], 4);
  EXPECT_EQ(mesh["nonmanifold_edges"], 1);
  EXPECT_EQ(mesh["boundary_edges"], 6);
  EXPECT_EQ(mesh["isolated"], 1);
  EXPECT_EQ(mesh["components"], 1);
  EXPECT_FALSE(mesh.contains("graph_parts"));
  for (const char* beginning : {"edges of more than two", "vertices without a triangle", "triangles that name a vertex",
                                "vertices that equal another"})
    EXPECT_TRUE(isOdd(mesh, beginning)) << beginning;
}

TEST_F(Info, WarnsOfFloatsThatAreTooCoarse) {
  std::string text;
  for (int i = 0; i < 100; ++i)
    text += std::to_string(5400000 + 0.25 * (i % 10)) + " " + std::to_string(0.25 * (i / 10)) + " 0\n";
  const Json cloud = info(dir_.write("utm.xyz", text));
  EXPECT_EQ(cloud["float_step"], 0.5);
  EXPECT_EQ(cloud["spacing"], 0.25);
  EXPECT_TRUE(isOdd(cloud, "so far from the origin")) << cloud["odd"];
  const Json huge = info(dir_.write("huge.xyz", "1e40 0 0\n2e40 0 0\n1e40 1e40 0\n2e40 1e40 0\n"));
  EXPECT_TRUE(huge["float_step"].is_null());  // the step exceeds all floats
  EXPECT_TRUE(isOdd(huge, "coordinates beyond the range of floats"));
}

/// A LAS file of a square of `side` x `side` points in steps of 1 cm, of which every fifth is in class 5.
LasFile square(int side) {
  LasFile file(4, 6);
  for (int i = 0; i < side * side; ++i) {
    const std::size_t point = file.addPoint(i % side, i / side, 0);
    file.set<std::uint8_t>(point + 16, i % 5 == 0 ? 5 : 2);
  }
  return file;
}

TEST_F(Info, LooksAtASampleOfALargeFile) {
  const std::string file = dir_.write("square.las", square(350).bytes());
  const Json sample = info(file);
  EXPECT_EQ(sample["points"], 350 * 350);
  EXPECT_LE(sample["sampled"], 100000);
  EXPECT_GE(sample["sampled"], 50000);
  EXPECT_NEAR(sample["spacing"].get<double>(), 0.01, 1e-9);
  EXPECT_NEAR(sample["highest"][1].get<double>(), 5400003.49, 1e-6);
  EXPECT_EQ(sample["classes"], Json::parse(R"([{"number": 2, "name": "ground", "points": 98000},
                                               {"number": 5, "name": "high vegetation", "points": 24500}])"));
  EXPECT_FALSE(sample.contains("graph_parts"));
  EXPECT_TRUE(contains(runTufted({"info", file}).out, " points; --full looks at all\n"));
  const Json full = Json::parse(runTufted({"info", file, "--full", "--json"}).out);
  EXPECT_EQ(full["sampled"], full["points"]);
  EXPECT_EQ(full["graph_parts"], 1);
}

TEST_F(Info, NamesTheReferenceSystemOfALasFile) {
  const auto systemOf = [&](const std::vector<std::pair<std::uint16_t, std::string>>& records) {
    LasFile file(4, 6);
    for (const auto& [number, content] : records) file.addRecord("LASF_Projection", number, content);
    for (int i = 0; i < 4; ++i) file.addPoint(i % 2, i / 2, 0);
    const std::string path = dir_.write("system.las", file.bytes());
    const std::string name = info(path).value("reference_system", "");
    EXPECT_EQ(contains(runTufted({"info", path}).out, "crs             " + name + "\n"), !name.empty());
    return name;
  };
  const auto keys = [](const std::vector<int>& numbers) {
    std::string bytes;
    for (const int number : numbers) bytes += {static_cast<char>(number % 256), static_cast<char>(number / 256)};
    return bytes;
  };
  const std::string code = keys({1, 1, 0, 3, 1024, 0, 1, 1, 2048, 0, 1, 4258, 3072, 0, 1, 25832});
  const std::string own = keys({1, 1, 0, 1, 3072, 0, 1, 32767}), text = "Gauss-Kruger|more|";
  EXPECT_EQ(systemOf({}), "");
  EXPECT_EQ(systemOf({{34735, code}, {34737, text}}), "EPSG:25832");
  EXPECT_EQ(systemOf({{34735, own}, {34737, text}}), "Gauss-Kruger");
  EXPECT_EQ(systemOf({{34735, code}, {2112, "PROJCS[\"ETRS89 / UTM zone 32N\",GEOGCS[\"ETRS89\"]]"}}),
            "ETRS89 / UTM zone 32N");
  EXPECT_EQ(systemOf({{34735, code.substr(0, 13)}, {2112, "PROJCS[\"cut"}}), "cut");
  EXPECT_EQ(systemOf({{34735, "odd"}, {2112, ""}}), "");
}

TEST_F(Info, ACloudThatCannotFitIsRefusedUnread) {
  // The file is as long as its header says, but takes no room on the disk. A build would take 644 GB.
  const std::string file = dir_.write("huge.las", LasFile(4, 6).bytes());
  const std::uint64_t points = (std::uint64_t{1} << 31) - 1;
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(247);
  stream.write(reinterpret_cast<const char*>(&points), sizeof(points));
  stream.close();
  std::filesystem::resize_file(file, 375 + 30 * points);
  for (const std::vector<std::string>& words : {std::vector<std::string>{"laplacian", file, "--out", dir_ / "out"},
                                                {"hks", file, "--out", dir_ / "out"},
                                                {"denoise", file, "--out", dir_ / "out"}}) {
    const Result result = runTufted(words);
    EXPECT_EQ(result.code, 1) << result.err;
    const std::string needed = words[0] == "denoise" ? "322 GB" : "644 GB";
    EXPECT_TRUE(contains(result.err, "huge.las: 2147483647 points take " + needed + " of memory or more"))
        << result.err;
  }
}

TEST_F(Info, PointsThatAreNotFiniteCannotBecomeLas) {
  const std::string file = dir_.write("a.xyz", "0 0 0\n1 0 0\nnan 0 0\n0 1 0\n1 1 0\n");
  const Result result = runTufted({"laplacian", file, "--out", dir_ / "out", "--format", "las"});
  EXPECT_EQ(result.code, 1);
  EXPECT_TRUE(contains(result.err, "has points that are not finite, which points.las cannot hold")) << result.err;
}

TEST_F(Info, TheTextHoldsTheSame) {
  const Result result = runTufted({"info", dir_.write("a.xyz", "0 0 0\n1 0 0\n0 1 0\n0 1 0\n")});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  for (const char* part : {"text in columns", "points          4", "spacing         1 (1 to 1)",
                           "points that equal an earlier one and take no part: 1", "graph parts     1\n", "to expect"})
    EXPECT_NE(result.out.find(part), std::string::npos) << part << "\n" << result.out;
}

TEST_F(Info, AnUnreadableFileIsOneLineAndOne) {
  const Result result = runTufted({"info", dir_.write("a.xyz", "0 zero 0\n")});
  EXPECT_EQ(result.code, 1);
  EXPECT_EQ(result.out, "");
  EXPECT_NE(result.err.find("line 1: 'zero'"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace info_test
