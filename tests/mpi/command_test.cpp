// The program tufted-mpi beside the command, on two processes.
#include <cstdint>
#include <filesystem>
#include <fstream>

#include "../cli/subcommands.h"
#include "tufted/io/results.h"

namespace {

namespace fs = std::filesystem;

class TuftedMpi : public Subcommands {
 protected:
  const std::string cloud_ = dir_.write("cloud.xyz", sphere(1200));

  /// Runs the program on two processes, without what mpirun says of those that fail.
  static Result runMpi(std::vector<std::string> words) {
    words.insert(words.begin(), {TUFTED_MPIRUN, "-q", "-n", "2", TUFTED_MPI_COMMAND});
    return runProgram(words);
  }
  Result expectDone(const std::vector<std::string>& words) {
    const Result result = runMpi(words);
    EXPECT_EQ(result.code, 0) << result.err;
    return result;
  }
  void expectNear(const std::string& file, const std::string& expected, double tolerance) {
    const Eigen::MatrixXd a = tufted::readArray(dir_ / file), b = tufted::readArray(dir_ / expected);
    ASSERT_EQ(a.rows(), b.rows());
    ASSERT_EQ(a.cols(), b.cols());
    EXPECT_LE((a - b).cwiseAbs().maxCoeff(), tolerance * b.cwiseAbs().maxCoeff()) << file;
  }
};

TEST_F(TuftedMpi, SolvesAndEigenvaluesAreThoseOfTheCommand) {
  run({"spectrum", cloud_, "--preset", "clean", "--count", "5", "--out", in("one/spectrum")});
  expectDone({"spectrum", cloud_, "--count", "5", "--out", in("two/spectrum")});
  expectNear("two/spectrum/evals.npy", "one/spectrum/evals.npy", 1e-7);
  EXPECT_EQ(tufted::readArray(dir_ / "two/spectrum/evecs.npy").rows(), 1200);
  EXPECT_LE(report("two/spectrum")["residual"], 1e-8);

  run({"poisson", cloud_, "--preset", "clean", "--field", "x", "--out", in("one/poisson")});
  expectDone({"poisson", cloud_, "--coordinate", "x", "--out", in("two/poisson")});
  expectNear("two/poisson/u.npy", "one/poisson/u.npy", 1e-6);
  expectDone({"poisson", cloud_, "--values", in("one/poisson/u.npy"), "--out", in("two/again")});
  run({"poisson", cloud_, "--preset", "clean", "--values", in("one/poisson/u.npy"), "--out", in("one/again")});
  expectNear("two/again/u.npy", "one/again/u.npy", 1e-6);

  run({"distance", cloud_, "--preset", "clean", "--method", "heat", "--source", "3,700", "--out", in("one/distance")});
  expectDone({"distance", cloud_, "--source", "3,700", "--out", in("two/distance")});
  expectNear("two/distance/distance.npy", "one/distance/distance.npy", 1e-6);

  const std::string pins = dir_.write("pins.txt", "3 1  # a comment\n\n700 -2\n");
  run({"interpolate", cloud_, "--preset", "clean", "--pins", pins, "--out", in("one/harmonic")});
  expectDone({"harmonic", cloud_, "--pins", pins, "--out", in("two/harmonic")});
  expectNear("two/harmonic/values.npy", "one/harmonic/values.npy", 1e-6);
}

TEST_F(TuftedMpi, MatricesAreFilesOfPetsc) {
  const Result result = expectDone({"laplacian", cloud_, "--out", in("out")});
  EXPECT_NE(result.out.find("1200 take part, 1 component"), std::string::npos) << result.out;
  // Big-endian: the mark of a matrix, rows, columns, entries.
  const std::string bytes = readAll(dir_ / "out/L.petsc");
  const auto number = [&](int i) {
    std::uint32_t value = 0;
    for (int k = 0; k < 4; ++k) value = value << 8 | static_cast<unsigned char>(bytes[4 * i + k]);
    return value;
  };
  EXPECT_EQ(number(0), 1211216u);
  EXPECT_EQ(number(1), 1200u);
  EXPECT_EQ(number(2), 1200u);
  EXPECT_EQ(number(3), report("out")["nonzeros"]);
  const std::vector<std::int64_t> rows = values<std::int64_t>("out/row.npy");
  run({"laplacian", cloud_, "--preset", "clean", "--format", "npz", "--out", in("one")});
  const std::vector<double> masses = values("one/M.npy");
  const std::string found = readAll(dir_ / "out/M.petsc");
  ASSERT_EQ(found.size(), 8 + 8 * 1200u);
  for (std::size_t p = 0; p < 1200; ++p) {
    std::string bytes_of_mass = found.substr(8 + 8 * static_cast<std::size_t>(rows[p]), 8);
    std::reverse(bytes_of_mass.begin(), bytes_of_mass.end());
    double mass = 0;
    std::memcpy(&mass, bytes_of_mass.data(), 8);
    EXPECT_NEAR(mass, masses[p], 1e-12 * masses[p]) << p;
  }
}

TEST_F(TuftedMpi, MistakesAreRefusedWithOneMessageAndNoResult) {
  const auto expectRefused = [&](std::vector<std::string> words, int code, const std::string& text) {
    words.insert(words.end(), {"--out", in("out")});
    const Result result = runMpi(words);
    EXPECT_EQ(result.code, code) << result.err;
    EXPECT_EQ(result.err.find("tufted-mpi: " + text), 0u) << result.err;
    EXPECT_EQ(result.err.find("tufted-mpi: ", 1), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(dir_ / "out/report.json"));
  };
  expectRefused({"spectrum", in("missing.xyz")}, 1, in("missing.xyz") + ": no such file");
  expectRefused({"spectrum", cloud_, "--cont", "3"}, 2, "The following argument");
  expectRefused({"distance", cloud_, "--source", "3,1200"}, 2, "--source 1200 is no index in [0, 1200)");
  expectRefused({"distance", dir_.write("nan.xyz", "nan 0 0\n" + sphere(900)), "--source", "0"}, 2,
                "--source: none of the points takes part");
  expectRefused({"poisson", cloud_}, 2, "");
  expectRefused({"spectrum", cloud_, "--count", "0"}, 2, "--count: ");
  expectRefused({"spectrum", cloud_, "--count", "1000"}, 2, "spectrum: k = 1000, must be in [1, 400]");
  expectRefused({"spectrum", cloud_, "--memory", "1M"}, 2, "laplacianByTiles: memory = ");
  expectRefused({"spectrum", cloud_, "--memory", "much"}, 2, "--memory: much is not a size");
  expectRefused({"harmonic", cloud_, "--pins", dir_.write("pins.txt", "3 1\n4\n")}, 1,
                in("pins.txt") + ": line 2: is not INDEX VALUE");
  expectRefused({"harmonic", cloud_, "--pins", dir_.write("pins.txt", "1200 1\n")}, 2,
                in("pins.txt") + ": line 1: 1200 is no index in [0, 1200)");
  expectRefused({"poisson", cloud_, "--values", dir_.write("short.npy", readAll(cloud_))}, 1, in("short.npy"));
}

TEST_F(TuftedMpi, OptionsOfPetscArePassedOnAndUnusedOnesNamed) {
  const Result result =
      expectDone({"poisson", cloud_, "--coordinate", "z", "--out", in("out"), "-ksp_monitor", "-ksp_typ", "cg"});
  EXPECT_NE(result.out.find("0 KSP Residual norm"), std::string::npos) << result.out;
  EXPECT_EQ(result.err, "tufted-mpi: warning: nothing has used the option -ksp_typ\n");
}

TEST_F(TuftedMpi, WarnsOfSourcesThatTakeNoPart) {
  const std::string cloud = dir_.write("nan.xyz", "nan 0 0\n" + sphere(900));
  const Result result = expectDone({"distance", cloud, "--source", "0,5", "--out", in("out")});
  EXPECT_EQ(result.err, "tufted-mpi: warning: --source 0 takes no part, and is left out\n");
  const Eigen::MatrixXd distance = tufted::readArray(dir_ / "out/distance.npy");
  EXPECT_TRUE(std::isinf(distance(0, 0)));
  EXPECT_EQ(distance(5, 0), 0);
}

TEST_F(TuftedMpi, NeverOverwritesItsInput) {
  run({"poisson", cloud_, "--preset", "clean", "--field", "x", "--out", in("out")});
  const std::string before = readAll(dir_ / "out/u.npy");
  const Result result = runMpi({"poisson", cloud_, "--values", in("out/u.npy"), "--out", in("out")});
  EXPECT_EQ(result.code, 2) << result.err;
  EXPECT_EQ(readAll(dir_ / "out/u.npy"), before);
}

TEST_F(TuftedMpi, LeavesNoResultWhenAnotherProcessDies) {
  // The second process ends with an error before it has joined the first.
  const Result result = runProgram({TUFTED_MPIRUN, "-q", "-n", "1", TUFTED_MPI_COMMAND, "spectrum", cloud_, "--out",
                                    in("out"), ":", "-n", "1", "false"});
  EXPECT_NE(result.code, 0);
  EXPECT_FALSE(fs::exists(dir_ / "out/report.json"));
}

}  // namespace
