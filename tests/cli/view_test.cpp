// A look at results: --png, --view and --color of all subcommands, and the subcommand view.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <utility>

#include "subcommands.h"

namespace view_test {
namespace {

class View : public Subcommands {
 protected:
  /// Width and height of a PNG file, which must be complete.
  std::pair<int, int> sizeOf(const std::string& name) const {
    const std::string bytes = readAll(dir_ / name);
    EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n") << name;
    EXPECT_EQ(bytes.substr(bytes.size() - 8, 4), "IEND") << name;
    const auto number = [&](std::size_t at) {
      int value = 0;
      for (std::size_t k = 0; k < 4; ++k) value = 256 * value + static_cast<unsigned char>(bytes.at(at + k));
      return value;
    };
    return {number(16), number(20)};
  }
  void expectPage(const std::string& name) const {
    const std::string page = readAll(dir_ / name);
    EXPECT_TRUE(contains(page.substr(0, 100), "<!doctype html>") || contains(page.substr(0, 100), "<!DOCTYPE html>"));
    EXPECT_TRUE(contains(page.substr(page.size() - 20), "</html>"));
  }
  /// What `view` says in JSON of a folder, of which it makes a.png.
  nlohmann::json seen(const std::string& folder) {
    return nlohmann::json::parse(run({"view", in(folder), "--png", in("a.png"), "--size", "200x150", "--json"}).out);
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(dir_ / name); }

  /// A sphere with a field.
  std::string warmSphere() const {
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 200\nproperty float x\nproperty float y\nproperty float z\n"
        "property float heat\nend_header\n";
    int number = 0;
    for (const std::string& line : linesOf(sphere(200))) text += line + ' ' + std::to_string(number++) + '\n';
    return text;
  }

  const std::string cloud_ = dir_.write("sphere.ply", warmSphere());
  const std::string mesh_ = dir_.write("tetrahedron.off", tetrahedron);
};

TEST_F(View, EverySubcommandShowsItsResult) {
  int number = 0;
  for (std::vector<std::string> arguments : commands) {
    const std::string name = std::to_string(number++) + arguments[0];
    std::replace(arguments.begin(), arguments.end(), std::string("x"), std::string("heat"));  // the field for poisson
    arguments.insert(arguments.end(), {cloud_, "--out", in(name), "--png", in(name + ".png"), "--view",
                                       in(name + ".html"), "--size", "200x150"});
    const Result result = run(arguments);
    EXPECT_TRUE(contains(result.out, "picture")) << result.out;
    EXPECT_TRUE(contains(result.out, "page")) << result.out;
    EXPECT_EQ(sizeOf(name + ".png"), (std::pair{200, 150})) << name;
    expectPage(name + ".html");
  }
}

TEST_F(View, OfStandardInputNeedsAName) {
  const Result unnamed = runTufted({"view", "-"}, cloud_);
  EXPECT_EQ(unnamed.code, 2);
  EXPECT_TRUE(contains(unnamed.err, "neither --out nor --png is given")) << unnamed.err;
  const Result named = runTufted({"view", "-", "--png", in("a.png"), "--size", "200x150"}, cloud_);
  EXPECT_EQ(named.code, 0) << named.err;
  EXPECT_EQ(sizeOf("a.png"), (std::pair{200, 150}));
}

TEST_F(View, OfAMeshAsACloudChoosesVertices) {
  const std::vector<std::string> words = {"view", mesh_, "--where", "x<0.5", "--png", in("a.png")};
  const Result refused = runTufted(words);
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(contains(refused.err, "--as cloud takes its vertices alone")) << refused.err;
  std::vector<std::string> as_cloud = words;
  as_cloud.insert(as_cloud.end(), {"--as", "cloud", "--field", "file_row"});
  const Result chosen = run(as_cloud);
  EXPECT_TRUE(contains(chosen.out, "chosen")) << chosen.out;
  EXPECT_TRUE(contains(chosen.out, "fields          file_row\n")) << chosen.out;
}

TEST_F(View, OfAPathShowsIt) {
  const std::string size = "200x150";
  run({"path", mesh_, "--from", "1", "--to", "2", "--out", in("path"), "--png", in("path.png"), "--view",
       in("path.html"), "--size", size});
  EXPECT_TRUE(contains(readAll(dir_ / "path.html"), "\"path\":"));
  run({"distance", mesh_, "--source", "1", "--out", in("distance"), "--png", in("distance.png"), "--size", size});
  EXPECT_NE(readAll(dir_ / "path.png"), readAll(dir_ / "distance.png"));  // too small for a title
  run({"view", in("path"), "--out", in("again.html"), "--png", in("again.png"), "--size", size, "--color", "distance"});
  EXPECT_TRUE(contains(readAll(dir_ / "again.html"), "\"path\":"));
}

TEST_F(View, OfAFolderShowsWhatASubcommandWrote) {
  run({"spectrum", cloud_, "--count", "3", "--out", in("modes")});
  run({"view", in("modes")});
  expectPage("modes/view.html");
  const nlohmann::json said = seen("modes");
  EXPECT_EQ(said["fields"][0], "evecs");
  EXPECT_EQ(said["points"], 200);
  EXPECT_EQ(said["picture"], in("a.png"));
  run({"view", in("modes"), "--png", in("b.png"), "--column", "2", "--size", "200x150"});
  EXPECT_NE(readAll(dir_ / "a.png"), readAll(dir_ / "b.png"));
  run({"distance", mesh_, "--source", "0", "--out", in("mesh")});
  EXPECT_TRUE(contains(run({"view", in("mesh")}).out, "triangles       4"));
}

TEST_F(View, OfAFolderShowsNothingOfAnEarlierResult) {
  run({"spectrum", cloud_, "--count", "3", "--format", "ply,pcd", "--out", in("out")});
  run({"laplacian", cloud_, "--format", "npz,ply,triangles", "--out", in("out")});
  run({"distance", mesh_, "--source", "0", "--format", "pcd", "--out", in("out")});
  nlohmann::json said = seen("out");
  EXPECT_EQ(said["points"], 4);
  EXPECT_EQ(said["triangles"], 0);
  EXPECT_EQ(said["fields"], (nlohmann::json{"distance", "mass", "boundary"}));
  run({"distance", cloud_, "--source", "0", "--out", in("out")});
  said = seen("out");
  EXPECT_EQ(said["points"], 200);
  EXPECT_EQ(said["triangles"], 0);
  EXPECT_EQ(said["fields"], (nlohmann::json{"distance", "heat", "mass", "boundary"}));
  run({"distance", cloud_, "--source", "0", "--format", "none", "--out", in("out")});
  EXPECT_EQ(runTufted({"view", in("out")}).code, 1);
}

TEST_F(View, OperatorsAndSpectraAreThoseOfTheLastResult) {
  const std::string other = dir_.write("other.xyz", sphere(300));
  run({"laplacian", other, "--format", "npz,ply,pcd", "--out", in("out")});
  for (const std::string format : {"npz,ply", "npz,pcd"}) {
    run({"laplacian", cloud_, "--format", format, "--out", in("out")});
    run({"green", "--operator", in("out"), "--source", "0", "--out", in("green")});
    EXPECT_EQ(seen("green")["points"], 200);
    run({"laplacian", other, "--format", "npz,ply,pcd", "--out", in("out")});
  }
  run({"spectrum", cloud_, "--count", "3", "--out", in("out")});
  run({"hks", cloud_, "--spectrum", in("out"), "--out", in("hks")});
  expectRefusal({"green", "--operator", in("out"), "--source", "0"}, "is of a run that did not write L.npz", 1);
  run({"green", cloud_, "--source", "0", "--out", in("out")});
  expectRefusal({"hks", cloud_, "--spectrum", in("out")}, "its last result has no evals.npy", 1);
}

TEST_F(View, OfAFileShowsItsFields) {
  const std::string ply = dir_.write("colored.ply",
                                     "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                                     "property float z\nproperty float heat\nproperty uchar red\n"
                                     "property uchar green\nproperty uchar blue\nend_header\n0 0 0 1 255 0 0\n"
                                     "1 0 0 2 0 255 0\n0 1 0 3 0 0 255\n1 1 0 4 9 9 9\n");
  const nlohmann::json said = nlohmann::json::parse(run({"view", ply, "--out", in("c.html"), "--json"}).out);
  EXPECT_EQ(said["fields"], (nlohmann::json{"color", "heat"}));
  expectPage("c.html");
  run({"view", ply, "--field", "heat", "--png", in("heat.png"), "--background", "dark", "--colormap", "magma"});
  EXPECT_EQ(sizeOf("heat.png"), (std::pair{1200, 900}));
  run({"view", ply});
  expectPage("colored.ply.html");
  for (const auto& [word, arguments] : std::vector<std::pair<std::string, std::vector<std::string>>>{
           {"did you mean `heat`", {"view", ply, "--field", "heta"}},
           {"--column 1", {"view", ply, "--field", "heat", "--column", "1"}},
           {"overwrite", {"view", ply, "--out", ply}},
           {"no directory", {"view", ply, "--out", in("none/a.html")}},
           {"report.json", {"view", in("")}}}) {
    const Result result = runTufted(arguments);
    EXPECT_NE(result.code, 0) << word;
    EXPECT_TRUE(contains(result.err, word)) << result.err;
  }
}

TEST_F(View, CopiesOfThePointsHaveColoursAndQuality) {
  run({"distance", cloud_, "--source", "0", "--out", in("colored"), "--format", "ply,pcd", "--color", "distance"});
  const std::string ply = readAll(dir_ / "colored/points.ply");
  for (const char* property : {"uchar red", "uchar green", "uchar blue", "float quality"})
    EXPECT_TRUE(contains(ply.substr(0, ply.find("end_header")), std::string("property ") + property)) << property;
  const std::string pcd = readAll(dir_ / "colored/points.pcd");
  EXPECT_TRUE(contains(pcd.substr(0, pcd.find("DATA")), " rgb "));
  run({"laplacian", cloud_, "--out", in("mass"), "--color", "mass"});
  EXPECT_TRUE(contains(readAll(dir_ / "mass/points.ply").substr(0, 3000), "property uchar red"));
  run({"distance", cloud_, "--source", "0", "--out", in("plain")});
  EXPECT_FALSE(contains(readAll(dir_ / "plain/points.ply").substr(0, 3000), "quality"));
}

TEST_F(View, PicturesMayLieInTheFolderThatResultsMake) {
  run({"distance", cloud_, "--source", "0", "--out", in("new/distance"), "--png", in("new/distance/a.png"), "--size",
       "40x30"});
  EXPECT_TRUE(exists("new/distance/a.png"));
  run({"laplacian", cloud_, "--out", in("new/./a/b/"), "--png", in("new/a/b.png"), "--view", in("new/a/b/c.html"),
       "--size", "40x30"});
  EXPECT_TRUE(exists("new/a/b.png"));
  EXPECT_TRUE(exists("new/a/b/c.html"));
}

TEST_F(View, PicturesGoWhereLinksLeadAndNeverReplaceAPipe) {
  const std::filesystem::path target = dir_.write("kept.png", "old");
  std::filesystem::create_symlink("kept.png", dir_ / "link.png");
  std::filesystem::create_symlink(dir_ / "new.html", dir_ / "link.html");  // its target does not exist yet
  run({"view", cloud_, "--png", in("link.png"), "--out", in("link.html"), "--size", "40x30"});
  EXPECT_EQ(sizeOf("kept.png"), (std::pair{40, 30}));
  expectPage("new.html");
  EXPECT_TRUE(std::filesystem::is_symlink(dir_ / "link.png") && std::filesystem::is_symlink(dir_ / "link.html"));
  ASSERT_EQ(mkfifo(in("pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink(in("pipe"), dir_ / "to_pipe");
  std::filesystem::create_symlink(in("none/a.png"), dir_ / "to_none.png");
  std::filesystem::create_symlink("circle", dir_ / "circle");
  for (const char* name : {"pipe", "to_pipe"})
    for (const char* option : {"--png", "--view"})
      expectRefusal({"distance", cloud_, "--source", "0", option, in(name)}, "is no regular file");
  EXPECT_TRUE(std::filesystem::is_fifo(dir_ / "pipe"));
  expectRefusal({"distance", cloud_, "--source", "0", "--png", in("to_none.png")}, "there is no directory", 1);
  expectRefusal({"distance", cloud_, "--source", "0", "--png", in("circle")}, "cannot write", 1);
}

TEST_F(View, OfNoFinitePointIsRefused) {
  const std::string file = dir_.write("none.xyz", "nan nan nan\ninf 0 0\n");
  const Result result = runTufted({"view", file, "--png", in("none.png")});
  EXPECT_EQ(result.code, 1);
  EXPECT_EQ(result.err, "tufted: " + file + ": has no finite point to look at\n");
  EXPECT_FALSE(exists("none.png"));
}

TEST_F(View, MistakesAreRefusedBeforeTheBuild) {
  const std::vector<std::string> distance = {"distance", cloud_, "--source", "0"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), distance.begin(), distance.end());
    return more;
  };
  expectRefusal(with({"--png", in("none/a.png")}), "there is no directory", 1);
  expectRefusal(with({"--png", dir_.write("a.txt", "").string() + "/b.png"}), "there is no directory", 1);
  expectRefusal(with({"--view", in(".")}), "is a directory");
  expectRefusal(with({"--png", in("a.JPG")}), "its name must end in .png");
  expectRefusal(with({"--view", in("a.png")}), "its name must end in .html");
  expectRefusal(with({"--png", in("refused/points.ply")}), "must end in .png");
  expectRefusal(with({"--png", cloud_}), "overwrite");
  expectRefusal(with({"--png", in("./sphere.ply")}), "overwrite");
  expectRefusal(with({"--png", in("a.png"), "--size", "10x900"}), "WIDTHxHEIGHT");
  expectRefusal(with({"--png", in("a.png"), "--size", "800"}), "WIDTHxHEIGHT");
  expectRefusal(with({"--png", in("a.png"), "--colormap", "viridsi"}), "did you mean `viridis`");
  expectRefusal(with({"--png", in("a.png"), "--camera", "10"}), "AZIMUTH,ELEVATION");
  expectRefusal(with({"--png", in("a.png"), "--camera", "10,91"}), "AZIMUTH,ELEVATION");
  for (const char* camera : {"foo", "30,x", ",30", "30;40", "1e999,20", "30,20,0", ""})
    expectRefusal(with({"--png", in("a.png"), "--camera", camera}), "--camera");
  expectRefusal(with({"--png", in("a.png"), "--color", "distanec"}), "did you mean `distance`");
  expectRefusal(with({"--png", in("a.png"), "--up", "w"}), "is none of");
  EXPECT_FALSE(exists("a.png"));
}

}  // namespace
}  // namespace view_test
