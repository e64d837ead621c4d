// The subcommand map, on a sheet without symmetry and the same one rolled up; and parameterize --cut.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <sstream>
#include <utility>

#include "subcommands.h"

namespace map_test {
namespace {

constexpr int parts = 16;  ///< of each side of the sheet
constexpr int vertices = (parts + 1) * (parts + 1);

class Maps : public Subcommands {
 protected:
  /// A quadrilateral without symmetry, flat or rolled up.
  static std::string sheet(bool is_rolled) {
    std::ostringstream text;
    text.precision(17);
    text << "OFF " << vertices << ' ' << 2 * parts * parts << " 0\n";
    for (int j = 0; j <= parts; ++j)
      for (int i = 0; i <= parts; ++i) {
        const double u = double(i) / parts, v = double(j) / parts, x = 2.6 * u - 0.7 * u * v, y = v + 0.3 * u * v;
        if (is_rolled)
          text << 5 * std::sin(x) << ' ' << 5 * y << ' ' << 5 * std::cos(x) << '\n';
        else
          text << x << ' ' << y << " 0\n";
      }
    for (int j = 0; j < parts; ++j)
      for (int i = 0; i < parts; ++i) {
        const int a = j * (parts + 1) + i, c = a + parts + 1;
        text << "3 " << a << ' ' << a + 1 << ' ' << c + 1 << "\n3 " << a << ' ' << c + 1 << ' ' << c << '\n';
      }
    return text.str();
  }
  const std::string flat_ = dir_.write("flat.off", sheet(false)), rolled_ = dir_.write("rolled.off", sheet(true));
};

TEST_F(Maps, OfARolledSheetAreRightPointByPoint) {
  const std::string pairs = dir_.write("pairs.txt", "0 0  # corners\n16 16\n");
  for (const std::vector<std::string>& options :
       {std::vector<std::string>{}, {"--landmarks", pairs}, {"--count", "40", "--commutativity", "0.1"}}) {
    std::vector<std::string> words = {"map", rolled_, "--from", flat_, "--out", in("out")};
    words.insert(words.end(), options.begin(), options.end());
    run(words);
    const std::vector<int> to_source = values<int>("out/to_source.npy"), to_target = values<int>("out/to_target.npy");
    ASSERT_EQ(to_source.size(), std::size_t{vertices});
    ASSERT_EQ(to_target.size(), std::size_t{vertices});
    for (int i = 0; i < vertices; ++i) {
      EXPECT_EQ(to_source[i], i);
      EXPECT_EQ(to_target[i], i);
    }
    const std::vector<double> image = values("out/image.npy");
    EXPECT_EQ(image[3 * 16], 2.6);
    EXPECT_EQ(image[3 * 16 + 1], 0);
    EXPECT_EQ(report("out")["there_and_back"], 0);
    const std::string first = options.empty() ? "" : options[0];
    EXPECT_EQ(report("out")["landmarks"], first == "--landmarks" ? 2 : 0);
    const std::size_t k = first == "--count" ? 40 : 100;
    EXPECT_EQ(report("out")["eigenpairs"], k);
    EXPECT_EQ(values("out/map.npy").size(), k * k);
  }
}

TEST_F(Maps, OfCloudsAndFoldersLeaveOutWhatTakesNoPart) {
  std::string points = sheet(true);
  points = points.substr(points.find('\n') + 1);
  const std::string cloud = dir_.write("cloud.xyz", points.substr(0, points.find("3 0 1")) + "nan nan nan\n");
  run({"map", cloud, "--preset", "clean", "--from", flat_, "--count", "30", "--out", in("out")});
  EXPECT_EQ(values<int>("out/to_source.npy").back(), -1);
  EXPECT_TRUE(std::isnan(values("out/image.npy").back()));
  run({"laplacian", rolled_, "--out", in("folder")});
  run({"map", rolled_, "--from", flat_, "--count", "30", "--out", in("of_file")});
  run({"map", "--operator", in("folder"), "--from", flat_, "--count", "30", "--out", in("of_folder")});
  EXPECT_EQ(readAll(dir_ / "of_folder/map.npy"), readAll(dir_ / "of_file/map.npy"));
}

TEST_F(Maps, RefuseWhatIsNoShapeAndNoPair) {
  const auto with = [&](const std::vector<std::string>& words) {
    std::vector<std::string> all = {"map", rolled_};
    all.insert(all.end(), words.begin(), words.end());
    return all;
  };
  const std::string empty = dir_.write("empty.off", "OFF 0 0 0\n");
  expectRefusal(with({}), "--from is required");
  expectRefusal(with({"--from", in("none.off")}), "none.off: no such file", 1);
  expectRefusal(with({"--from", empty}), "empty.off: no point is active", 1);
  expectRefusal(with({"--from", flat_, "--count", "1"}), "--count");
  expectRefusal(with({"--from", flat_, "--commutativity", "-1"}), "--commutativity");
  const auto pairs = [&](const std::string& text) {
    return with({"--from", flat_, "--landmarks", dir_.write("pairs.txt", text)});
  };
  expectRefusal(pairs("0 0\n1\n"), "line 2: is not SOURCE TARGET, two indices", 1);
  expectRefusal(pairs("289 0\n"), "line 1: 289 is no index in [0, 289), the points of");
  expectRefusal(pairs("0.5 0\n"), "line 1: 0.5 is no index");
  expectRefusal(pairs("0 -1\n"), "line 1 is no index in [0, 289)");
}

TEST_F(Subcommands, ParameterizeOpensAClosedSurfaceAlongACut) {
  const std::string mesh = dir_.write("tetrahedron.off", tetrahedron),
                    cut = dir_.write("cut.txt", "0 1 2\n1 3  # star\n");
  run({"parameterize", mesh, "--cut", cut, "--out", in("out")});
  const std::vector<double> corners = values("out/corner_uv.npy"), uv = values("out/uv.npy");
  ASSERT_EQ(corners.size(), 24u);
  ASSERT_EQ(uv.size(), 8u);
  EXPECT_EQ(report("out")["report"]["flipped"], 0);
  EXPECT_EQ(report("out")["report"]["rims"], 1);
  // Cut along the three edges of point 1, which has a place in each of its triangles: 0 1 3, 0 2 1 and 1 2 3.
  std::set<std::pair<double, double>> places;
  for (const int corner : {2, 4, 6}) places.insert({corners[2 * corner], corners[2 * corner + 1]});
  EXPECT_EQ(places.size(), 3u);
  EXPECT_TRUE(places.count({uv[2], uv[3]}) == 1);
  expectRefusal({"parameterize", mesh, "--cut", dir_.write("bad.txt", "0 1\n")}, "must be a disk", 1);
  expectRefusal({"parameterize", mesh, "--cut", dir_.write("bad.txt", "0 4\n")}, "line 1 is no index in [0, 4)");
  expectRefusal({"parameterize", mesh, "--cut", dir_.write("bad.txt", "0\n")},
                "line 1: has 1 index, must have at least 2", 1);
  expectRefusal({"parameterize", mesh, "--cut", cut, "--method", "harmonic"}, "--cut with --method harmonic needs");
  expectRefusal({"parameterize", mesh, "--cut", cut, "--method", "harmonic", "--rim", cut}, "--rim excludes --cut");
}

}  // namespace
}  // namespace map_test
