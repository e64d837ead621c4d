// Commands that read the eigenpairs of an earlier `tufted spectrum`.
#include <algorithm>

#include "subcommands.h"

namespace spectrum_folder_test {
namespace {

class SpectrumFolder : public Subcommands {
 protected:
  std::string name(const std::string& folder, const std::string& file) const { return (dir_ / folder / file).string(); }
  void expectSame(const std::string& one, const std::string& other) const {
    EXPECT_TRUE(readAll(dir_ / one) == readAll(dir_ / other)) << one << " and " << other;
  }
};

TEST_F(SpectrumFolder, GivesTheSameBitsAsThePairsThatACommandFinds) {
  const std::string file = dir_.write("sphere.xyz", sphere(400));
  run({"laplacian", file, "--sign", "igl", "--dummy", "--format", "npz,ply", "--out", in("folder")});
  run({"spectrum", file, "--count", "12", "--out", in("pairs")});
  for (const std::vector<std::string>& source : {std::vector<std::string>{file}, {"--operator", in("folder")}}) {
    const auto both = [&](std::vector<std::string> arguments, const std::string& count) {
      arguments.insert(arguments.end(), source.begin(), source.end());
      std::vector<std::string> computed = arguments, read = arguments;
      computed.insert(computed.end(), {count, "12", "--out", in("computed")});
      read.insert(read.end(), {"--spectrum", in("pairs"), "--out", in("read")});
      run(computed);
      run(read);
    };
    both({"hks"}, "--count");
    for (const char* array : {"/hks.npy", "/times.npy", "/evals.npy"})
      expectSame(std::string("computed") + array, std::string("read") + array);
    both({"embed"}, "--dimension");
    expectSame("computed/embedding.npy", "read/embedding.npy");
    both({"filter", "--field", "x"}, "--count");
    expectSame("computed/filtered.npy", "read/filtered.npy");
    EXPECT_EQ(report("read")["report"]["method"], "read");
  }
  // Eigenvalues 0 that a folder lacks are added if needed: thirteen pairs are a constant and twelve others.
  run({"operators", file, "--count", "13", "--out", in("computed")});
  run({"operators", file, "--spectrum", in("pairs"), "--out", in("read")});
  expectSame("computed/points.ply", "read/points.ply");
  run({"spectrum", file, "--count", "12", "--with-null-space", "--out", in("all")});
  run({"operators", file, "--spectrum", in("all"), "--out", in("again")});
  expectSame("read/operators.npz", "again/operators.npz");
  run({"hks", file, "--spectrum", in("all"), "--count", "7", "--out", in("seven")});
  EXPECT_EQ(values("seven/evals.npy").size(), 7u);
}

TEST_F(SpectrumFolder, OfWavesIsCutOrTooShort) {
  const std::string file = dir_.write("sphere.xyz", sphere(500));
  run({"spectrum", file, "--count", "20", "--out", in("pairs")});
  run({"filter", file, "--field", "x", "--wavelength", "2", "--out", in("computed")});
  run({"filter", file, "--field", "x", "--wavelength", "2", "--spectrum", in("pairs"), "--out", in("read")});
  EXPECT_EQ(report("read")["eigenvectors"], report("computed")["eigenvectors"]);
  const std::vector<double> computed = values("computed/filtered.npy"), read = values("read/filtered.npy");
  for (std::size_t i = 0; i < read.size(); ++i) ASSERT_NEAR(read[i], computed[i], 1e-7);
  expectRefusal({"filter", file, "--field", "x", "--wavelength", "0.5", "--spectrum", in("pairs")},
                "write more by `tufted spectrum --count`");
  expectRefusal({"filter", file, "--field", "x", "--wavelength", "50", "--spectrum", in("pairs")},
                "longer than the longest wave");
}

TEST_F(SpectrumFolder, IsRefusedWhereItBelongsToAnotherLaplacian) {
  const std::string file = dir_.write("sphere.xyz", sphere(300)), other = dir_.write("other.xyz", sphere(301));
  run({"spectrum", file, "--count", "5", "--out", in("pairs")});
  const std::string of_another = name("pairs", "report.json") + ": is of another Laplacian: its checksum is";
  for (const std::vector<std::string>& different : {std::vector<std::string>{"hks", other},
                                                    {"embed", file, "--neighbors", "12"},
                                                    {"operators", file, "--preset", "clean"}}) {
    std::vector<std::string> arguments = different;
    arguments.insert(arguments.end(), {"--spectrum", in("pairs")});
    expectRefusal(arguments, of_another, 1);
  }
  run({"hks", file, "--spectrum", in("pairs"), "--threads", "1", "--out", in("one")});
  expectRefusal({"hks", file, "--spectrum", in("pairs"), "--count", "6"}, "has 5 of these eigenvalues");
  expectRefusal({"hks", file, "--spectrum", in("pairs"), "--solver", "multigrid"}, "--spectrum");
  expectRefusal({"hks", file, "--spectrum", in("nowhere")}, name("nowhere", "report.json") + ": no such file", 1);
  const Result same = runTufted({"hks", file, "--spectrum", in("pairs"), "--out", in("pairs")});
  EXPECT_EQ(same.code, 2);
  EXPECT_NE(same.err.find("is the input of --spectrum"), std::string::npos) << same.err;
}

TEST_F(SpectrumFolder, IsRefusedWhereItsArraysAreDamaged) {
  const std::string file = dir_.write("sphere.xyz", sphere(300));
  const auto damaged = [&](const char* array, std::size_t from_end, const std::string& word) {
    run({"spectrum", file, "--count", "5", "--out", in("pairs")});
    std::string bytes = readAll(dir_ / "pairs" / array);
    const double wrong = 0.5;
    std::memcpy(bytes.data() + bytes.size() - from_end, &wrong, sizeof wrong);
    dir_.write(std::string("pairs/") + array, bytes);
    expectRefusal({"hks", file, "--spectrum", in("pairs")}, name("pairs", array) + ": " + word, 1);
  };
  damaged("evecs.npy", 8, "does not hold the eigenvectors of evals.npy");
  damaged("evals.npy", 8, "does not hold finite eigenvalues >= 0 that ascend");
  run({"laplacian", file, "--out", in("folder")});
  expectRefusal({"hks", file, "--spectrum", in("folder")}, in("folder") + ": its last result has no evals.npy", 1);
}

}  // namespace
}  // namespace spectrum_folder_test
