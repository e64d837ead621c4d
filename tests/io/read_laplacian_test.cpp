// What writeLaplacian wrote is read back, and what does not fit is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>

#include "odd_sphere.h"
#include "temporary_dir.h"
#include "tufted/errors.h"
#include "tufted/io/results.h"

namespace read_laplacian_test {
namespace {

using tufted::Format;
using tufted::IntrinsicTriangulation;

class ReadLaplacian : public testing::Test {
 protected:
  void write() {
    tufted::writeLaplacian(dir_.path(), laplacian_, geometry_, {.formats = {Format::npz, Format::cover}});
  }

  void expectRefusal(const std::string& file, const std::string& word) {
    try {
      tufted::readLaplacian(dir_.path());
      ADD_FAILURE() << word;
    } catch (const tufted::IoError& error) {
      const std::string message = error.what();
      EXPECT_TRUE(message.starts_with((dir_ / file).string() + ": ")) << message;
      EXPECT_NE(message.find(word), std::string::npos) << message;
    }
  }

  void expectRefusal(const std::string& word, const std::function<void(IntrinsicTriangulation&)>& damage) {
    tufted::Laplacian damaged = laplacian_;
    IntrinsicTriangulation cover = laplacian_.cover();
    damage(cover);
    damaged.setCover(std::move(cover));
    tufted::writeLaplacian(dir_.path(), damaged, geometry_, {.formats = {Format::npz, Format::cover}});
    expectRefusal("cover.npz", word);
  }

  tufted::Geometry geometry_ = tufted::oddSphere(3);
  tufted::Laplacian laplacian_ = tufted::pointCloudLaplacian(geometry_.points);
  TemporaryDir dir_;
};

template <class Matrix>
bool sameBits(const Matrix& a, const Matrix& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(*a.data())) == 0;
}

TEST_F(ReadLaplacian, GivesBackWhatWasWrittenBitForBit) {
  write();
  const tufted::Laplacian read = tufted::readLaplacian(dir_.path());
  EXPECT_TRUE(sameBits(tufted::VectorXd(read.L.coeffs()), tufted::VectorXd(laplacian_.L.coeffs())));
  EXPECT_TRUE(sameBits(read.M, laplacian_.M));
  EXPECT_EQ(read.status, laplacian_.status);
  EXPECT_EQ(read.representative, laplacian_.representative);
  EXPECT_TRUE(sameBits(read.frames.normals, laplacian_.frames.normals));
  EXPECT_TRUE(sameBits(read.frames.tangents, laplacian_.frames.tangents));
  EXPECT_TRUE(sameBits(read.positions, laplacian_.positions));
  EXPECT_EQ(read.cover().vertices, 200);
  EXPECT_EQ(read.cover().faces, laplacian_.cover().faces);
  EXPECT_EQ(read.cover().glue, laplacian_.cover().glue);
  EXPECT_EQ(read.cover().length, laplacian_.cover().length);
  EXPECT_FALSE(tufted::readLaplacian(dir_.path(), false).hasCover());
}

TEST_F(ReadLaplacian, PositionsMayBeMissingButMustFit) {
  laplacian_.positions.resize(0, 3);
  write();
  EXPECT_EQ(tufted::readLaplacian(dir_.path()).positions.rows(), 0);
  std::filesystem::copy_file(dir_ / "frames.npy", dir_ / "measured_positions.npy",
                             std::filesystem::copy_options::overwrite_existing);
  expectRefusal("measured_positions.npy", "is not an array of 200 x 3 values");
}

TEST_F(ReadLaplacian, ACoverOfAnEarlierRunIsNotTaken) {
  write();
  tufted::writeLaplacian(dir_.path(), laplacian_, geometry_, {.formats = {Format::npz}});
  EXPECT_FALSE(tufted::readLaplacian(dir_.path()).hasCover());
}

TEST_F(ReadLaplacian, FaultsOfTheCoverAreNamed) {
  using Cover = IntrinsicTriangulation;
  expectRefusal("none of those expected", [](Cover& cover) { cover.faces[5][1] = 200; });
  expectRefusal("none of those expected", [](Cover& cover) { cover.glue[5] = -1; });
  expectRefusal("none of those expected", [](Cover& cover) { cover.glue[5] = static_cast<int>(3 * cover.size()); });
  expectRefusal("its shape says another", [](Cover& cover) { cover.faces.pop_back(); });
  expectRefusal("glued to themselves", [](Cover& cover) { cover.glue[5] = 5; });
  expectRefusal("glued to others", [](Cover& cover) { std::swap(cover.faces[5][0], cover.faces[5][1]); });
  expectRefusal("another length", [](Cover& cover) { cover.length[5] *= 1.001; });
  expectRefusal("make no triangle", [](Cover& cover) { cover.length[5] = cover.length[cover.glue[5]] = 10; });
  expectRefusal("negative or not finite", [](Cover& cover) { cover.length[5] = -1; });
  expectRefusal("negative or not finite", [](Cover& cover) { cover.length[5] = NAN; });
}

TEST_F(ReadLaplacian, FaultsOfFramesAreNamed) {
  laplacian_.frames.tangents.row(0) *= 2;
  write();
  expectRefusal("frames.npy", "the frame of point 0 is not orthonormal");
  laplacian_.frames.tangents = laplacian_.frames.normals;
  write();
  expectRefusal("frames.npy", "not orthonormal");
  laplacian_.frames = {tufted::Points::Ones(3, 3), tufted::Points::Ones(3, 3)};
  write();
  expectRefusal("frames.npy", "200 x 3 x 3");
}

TEST(ReadArray, TakesRowsAndColumnsOfAnyType) {
  const TemporaryDir dir;
  const auto array = [&](const std::string& descr, const std::string& shape, const std::string& values) {
    std::string header = "{'descr': '" + descr + "', 'fortran_order': False, 'shape': (" + shape + "), }\n";
    return dir.write("a.npy",
                     std::string("\x93NUMPY\x01\0", 8) + static_cast<char>(header.size()) + '\0' + header + values);
  };
  EXPECT_EQ(tufted::readArray(array("|u1", "3,", "\x01\x02\xff")), Eigen::Vector3d(1, 2, 255));
  EXPECT_EQ(tufted::readArray(array("|i1", "2, 2", "\x01\x02\x03\xff")), (Eigen::Matrix2d() << 1, 2, 3, -1).finished());
  EXPECT_EQ(tufted::readArray(array("|i1", "0, 2", "")).cols(), 2);
  EXPECT_THROW(tufted::readArray(array("|u1", "1, 1, 1", "\x01")), tufted::IoError);
  EXPECT_THROW(tufted::readArray(array("|u1", "", "\x01")), tufted::IoError);
  EXPECT_THROW(tufted::readArray(array("|S1", "1,", "\x01")), tufted::IoError);
  EXPECT_THROW(tufted::readArray(dir / "missing.npy"), tufted::IoError);
}

}  // namespace
}  // namespace read_laplacian_test
