// Results from a folder written by `tufted laplacian` are those from the file, bit for bit.
#include <algorithm>
#include <random>
#include <sstream>

#include "subcommands.h"

namespace operator_folder_test {
namespace {

class OperatorFolder : public Subcommands {
 protected:
  /// A noisy sphere and a coarse exact one beside it.
  std::string noisy() const {
    std::mt19937_64 generator(3);
    std::normal_distribution<double> normal;
    std::ostringstream text;
    text.precision(17);
    for (int i = 0; i < 1300; ++i) {
      const double x = normal(generator), y = normal(generator), z = normal(generator);
      const double size = (i < 1000 ? 1 + 0.02 * normal(generator) : 8) / std::sqrt(x * x + y * y + z * z);
      text << size * x + (i < 1000 ? 0 : 20) << ' ' << size * y << ' ' << size * z << '\n';
    }
    return dir_.write("noisy.xyz", text.str());
  }

  void expectSameArrays(const std::string& one, const std::string& other) const {
    int arrays = 0;
    for (const auto& entry : std::filesystem::directory_iterator(dir_ / one)) {
      const std::string name = entry.path().filename().string(), kind = entry.path().extension().string();
      if (kind != ".npy" && kind != ".npz") continue;
      ++arrays;
      EXPECT_TRUE(readAll(dir_ / one / name) == readAll(dir_ / other / name)) << one << ": " << name;
    }
    EXPECT_GT(arrays, 0) << one;
  }
};

TEST_F(OperatorFolder, GivesEveryCommandTheBitsOfTheFile) {
  const std::string file = noisy();
  run({"laplacian", file, "--format", "npz,ply,cover", "--out", in("folder")});
  std::vector<std::vector<std::string>> all = commands;
  std::erase_if(all,
                [](const std::vector<std::string>& words) { return words[0] == "laplacian" || words[0] == "denoise"; });
  all.push_back({"distance", "--source", "0", "--method", "heat"});
  all.push_back({"distance", "--source", "0", "--within", "0.4"});
  all.push_back({"curvature", "--method", "laplacian"});
  all.push_back({"signed-distance", "--curve", dir_.write("curve.txt", "0\n5\n9\n")});
  all.push_back({"signed-distance", "--curve", in("curve.txt"), "--method", "marching"});
  for (const char* name : {"spectrum", "smooth", "segment", "distance"}) {  // of a component alone
    std::vector<std::string> words =
        *std::find_if(all.begin(), all.end(), [&](const std::vector<std::string>& call) { return call[0] == name; });
    words.insert(words.end(), {"--component", "0"});
    all.push_back(words);
  }
  for (const std::vector<std::string>& words : all) {
    std::vector<std::string> from_file = words, from_folder = words;
    from_file.insert(from_file.end(), {file, "--out", in("file")});
    from_folder.insert(from_folder.end(), {"--operator", in("folder"), "--out", in("again")});
    for (const auto& call : {from_file, from_folder}) {
      const Result result = runTufted(call);
      EXPECT_EQ(result.code, 0) << result.err;
    }
    SCOPED_TRACE(words[0] + ' ' + words.back());
    expectSameArrays("file", "again");
    std::filesystem::remove_all(dir_ / "file");
    std::filesystem::remove_all(dir_ / "again");
  }
}

TEST_F(OperatorFolder, HasTheTrianglesOfAMesh) {
  const std::string file = dir_.write("mesh.off", tetrahedron);
  run({"laplacian", file, "--format", "npz,ply,cover", "--out", in("folder")});
  const std::vector<std::vector<std::string>> calls = {
      {"distance", "--face", "2,3,2,1"},
      {"distance", "--source", "1", "--face", "2,3,2,1", "--matrix"},
      {"signed-distance", "--method", "marching", "--face", "2,3,2,1"},
      {"trace", "--face", "2,3,2,1", "--direction", "1,2,3", "--length", "0.4"}};
  for (std::size_t k = 0; k < calls.size(); ++k) {
    SCOPED_TRACE(calls[k][0]);
    std::vector<std::string> from_file = calls[k], from_folder = calls[k];
    const std::string one = "file" + std::to_string(k), other = "again" + std::to_string(k);
    from_file.insert(from_file.end(), {file, "--out", in(one)});
    from_folder.insert(from_folder.end(), {"--operator", in("folder"), "--out", in(other)});
    run(from_file);
    run(from_folder);
    expectSameArrays(one, other);
  }
}

TEST_F(OperatorFolder, NeedsACoverOnlyForWhatFollowsItsFaces) {
  run({"laplacian", dir_.write("mesh.off", tetrahedron), "--out", in("mesh")});
  run({"laplacian", dir_.write("cloud.xyz", sphere(500)), "--out", in("cloud")});
  const std::vector<std::string> trace = {"trace", "--source", "0", "--direction", "1,1,0", "--length", "0.5"};
  const std::vector<std::string> lines = {"isolines", "--field", "x", "--count", "2"},
                                 keep = {"smooth", "--keep-volume"};
  const auto of = [&](const std::string& folder, std::vector<std::string> words) {
    words.insert(words.end(), {"--operator", in(folder)});
    return words;
  };
  for (const std::vector<std::string>& words : {trace, lines, keep}) {
    std::vector<std::string> command = of("mesh", words);
    command.insert(command.end(), {"--out", in(words[0])});
    run(command);
    expectRefusal(of("cloud", words), "has no cover.npz", 1);
  }
  for (const std::string method : {"spectral", "parts"})
    run({"segment", "--method", method, "--operator", in("cloud"), "--out", in(method)});
  for (const std::string folder : {"mesh", "cloud"}) {
    expectRefusal(of(folder, {"segment", "--count", "2"}), "has no cover.npz", 1);
    expectRefusal(of(folder, {"segment", "--method", "voronoi"}), "has no cover.npz", 1);
    expectRefusal(of(folder, {"distance", "--source", "0"}), "has no cover.npz", 1);
  }
}

}  // namespace
}  // namespace operator_folder_test
