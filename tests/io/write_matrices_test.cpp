#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "sample_laplacian.h"
#include "temporary_dir.h"
#include "tufted/errors.h"
#include "tufted/io/write.h"

namespace write_matrices_test {
namespace {

using tufted::Format;
using tufted::Sign;

/// The text of a file that holds the sample, without its comments.
std::string written(const char* name, const tufted::WriteOptions& options,
                    const tufted::Laplacian& laplacian = sampleLaplacian()) {
  const TemporaryDir dir;
  tufted::writeLaplacian(dir / "out", laplacian, sampleGeometry(), options);
  std::istringstream lines(readAll(dir.path() / "out" / name));
  std::string text, line;
  while (std::getline(lines, line))
    if (!line.starts_with("% ")) text += line + '\n';
  return text;
}

TEST(WriteMtx, HoldsTheLowerTriangleCountedFromOne) {
  EXPECT_EQ(written("L.mtx", {.formats = {Format::mtx}}),
            "%%MatrixMarket matrix coordinate real symmetric\n4 4 5\n1 1 1\n2 1 -0.5\n3 1 -0.5\n2 2 0.5\n3 3 0.5\n");
  EXPECT_EQ(written("M.mtx", {.formats = {Format::mtx}}),
            "%%MatrixMarket matrix array real general\n4 1\n"
            "0.66666666666666663\n0.66666666666666663\n0.66666666666666663\n0\n");
}

TEST(WriteSpmat, HoldsBothTrianglesAndTheLastDiagonalEntryAndNothingElse) {
  EXPECT_EQ(written("L.spmat", {.formats = {Format::spmat}}),
            "1 1 1\n2 1 -0.5\n3 1 -0.5\n1 2 -0.5\n2 2 0.5\n1 3 -0.5\n3 3 0.5\n4 4 0\n");
  EXPECT_EQ(written("M.spmat", {.formats = {Format::spmat}}),
            "1 1 0.66666666666666663\n2 2 0.66666666666666663\n3 3 0.66666666666666663\n4 4 0\n");
}

TEST(WriteSpmat, AStoredLastDiagonalEntryIsNotRepeated) {
  EXPECT_TRUE(written("L.spmat", {.formats = {Format::spmat}, .dummy = true}).ends_with("3 3 0.5\n4 4 1\n"));
}

TEST(WriteOptions, SignIglNegatesLAndNotM) {
  EXPECT_EQ(written("L.spmat", {.formats = {Format::spmat}, .sign = Sign::igl}),
            "1 1 -1\n2 1 0.5\n3 1 0.5\n1 2 0.5\n2 2 -0.5\n1 3 0.5\n3 3 -0.5\n4 4 0\n");
  EXPECT_EQ(written("M.spmat", {.formats = {Format::spmat}, .sign = Sign::igl}),
            written("M.spmat", {.formats = {Format::spmat}}));
}

TEST(WriteOptions, DummyFillsTheRowsOfPointsThatAreNotActiveAlone) {
  const std::string M = "1 1 0.66666666666666663\n2 2 0.66666666666666663\n3 3 0.66666666666666663\n4 4 ";
  for (const Sign sign : {Sign::psd, Sign::igl}) {
    const tufted::WriteOptions options = {.formats = {Format::spmat}, .sign = sign, .dummy = true};
    EXPECT_TRUE(written("L.spmat", options).ends_with(sign == Sign::psd ? "4 4 1\n" : "4 4 -1\n"));
    const std::string with_dummy = written("M.spmat", options);
    ASSERT_TRUE(with_dummy.starts_with(M)) << with_dummy;
    EXPECT_DOUBLE_EQ(std::stod(with_dummy.substr(M.size())), 1e-3 * (2.0 / 3));
  }
}

TEST(WriteOptions, TheDummyMassIsOneWithoutAnyOtherAndPositiveBesideTheSmallest) {
  const tufted::WriteOptions options = {.formats = {Format::spmat}, .dummy = true};
  tufted::Laplacian laplacian = sampleLaplacian();
  laplacian.M.setZero();
  EXPECT_TRUE(written("M.spmat", options, laplacian).ends_with("\n4 4 1\n"));
  laplacian.M(0) = std::numeric_limits<double>::denorm_min();
  const std::string text = written("M.spmat", options, laplacian);
  EXPECT_GT(std::stod(text.substr(text.rfind(' '))), 0) << text;
}

TEST(WriteOptions, AMatrixThatIsNotCompressedIsWrittenAllTheSame) {
  tufted::Laplacian laplacian = sampleLaplacian();
  laplacian.L.uncompress();
  for (const char* name : {"L.npz", "L.spmat", "laplacian.mat"}) {
    const tufted::WriteOptions options = {.formats = {Format::npz, Format::mat, Format::spmat}};
    EXPECT_EQ(written(name, options, laplacian), written(name, options)) << name;
  }
}

TEST(WriteMat, AVariableBeyondTheFormatIsAnIoErrorAndLeavesNothing) {
  const TemporaryDir dir;
  tufted::Laplacian laplacian = sampleLaplacian();
  // Room for 2^31 bytes and more, which are neither written nor read.
  laplacian.L.resizeNonZeros(180'000'000);
  laplacian.L.outerIndexPtr()[4] = 180'000'000;
  try {
    tufted::writeLaplacian(dir / "out", laplacian, sampleGeometry(), {.formats = {Format::mat}});
    FAIL();
  } catch (const tufted::IoError& error) {
    const std::string message = error.what();
    EXPECT_TRUE(message.starts_with((dir / "out/laplacian.mat").string() + ": cannot write: L takes 21600")) << message;
    EXPECT_NE(message.find("2147483647"), std::string::npos) << message;
  }
  EXPECT_FALSE(std::filesystem::exists(dir / "out"));
}

TEST(ResultFiles, AreThoseThatAreWrittenWhateverTheFormats) {
  const std::vector<std::vector<Format>> choices = {
      {},
      {Format::npz},
      {Format::mtx},
      {Format::mat},
      {Format::spmat},
      {Format::petsc},
      {Format::ply},
      {Format::pcd},
      {Format::cover},
      {Format::pcd, Format::mtx, Format::pcd},
      {Format::npz, Format::mtx, Format::mat, Format::spmat, Format::petsc, Format::ply, Format::pcd}};
  tufted::Laplacian laplacian = sampleLaplacian();
  tufted::IntrinsicTriangulation cover;
  cover.vertices = 4;
  laplacian.setCover(cover);
  for (const auto& formats : choices) {
    const TemporaryDir dir;
    tufted::writeLaplacian(dir.path(), laplacian, sampleGeometry(), {.formats = formats});
    std::vector<std::string> expected = tufted::resultFiles(formats), found;
    for (const auto& entry : std::filesystem::directory_iterator(dir.path())) found.push_back(entry.path().filename());
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
  }
}

TEST(WriteLaplacian, FilesOfFormatsNotAskedForStay) {
  const TemporaryDir dir;
  dir.write("L.mtx", "mine");
  tufted::writeLaplacian(dir.path(), sampleLaplacian(), sampleGeometry(), {.formats = {Format::npz}});
  EXPECT_EQ(readAll(dir / "L.mtx"), "mine");
}

TEST(WriteLaplacian, NoPointsAreWrittenInEveryFormat) {
  const TemporaryDir dir;
  tufted::Laplacian none;
  EXPECT_NO_THROW(tufted::writeLaplacian(
      dir / "out", none, {},
      {.formats = {Format::npz, Format::mtx, Format::mat, Format::spmat, Format::petsc, Format::ply, Format::pcd}}));
  EXPECT_EQ(readAll(dir / "out/L.spmat"), "");
  EXPECT_TRUE(readAll(dir / "out/L.mtx").ends_with("\n0 0 0\n"));
}

}  // namespace
}  // namespace write_matrices_test
