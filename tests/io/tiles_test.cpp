#include "tufted/io/tiles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "small_disk.h"
#include "temporary_dir.h"
#include "tufted/errors.h"
#include "tufted/io/results.h"
#include "tufted/laplacian.h"

namespace tufted {
namespace {

/// A wavy sheet with a missing point and a point that is there twice.
Points sheet() {
  Points points(6402, 3);
  for (int i = 0; i < 6400; ++i) {
    const double x = 0.013 * (i % 80), y = 0.011 * (i / 80);
    points.row(i) << x + 0.003 * std::sin(9.0 * i), y, 0.1 * std::sin(6 * x);
  }
  points.row(6400) = points.row(5);
  points.row(6401).setConstant(NAN);
  return points;
}

TileOptions twoTiles() {
  TileOptions options = {.tiles = 2};
  options.cloud.steps = cloudSteps(Preset::clean);
  options.cloud.threads = 1;
  return options;
}

TEST(TileFiles, HoldTheRowsOfTheWhole) {
  const TemporaryDir dir;
  const Points points = sheet();
  const TileReport report = writeLaplacianByTiles(dir.path(), sourceOf(points), twoTiles(), {.source = "sheet"});
  const Laplacian whole = pointCloudLaplacian(points, twoTiles().cloud);
  EXPECT_EQ(filesOfResult(dir.path()), tileFiles());
  EXPECT_EQ(report.coincident, 1);
  EXPECT_EQ(report.not_finite, 1);
  const auto read = [&](const char* name) { return readArray(dir / name); };
  const Eigen::MatrixXd begin = read("L_indptr.npy"), column = read("L_indices.npy"), value = read("L_data.npy"),
                        M = read("M.npy"), status = read("status.npy"), representative = read("representative.npy"),
                        boundary = read("boundary.npy"), normals = read("normals.npy");
  ASSERT_EQ(begin.rows(), points.rows() + 1);
  ASSERT_EQ(value.rows(), whole.L.nonZeros());
  for (int i = 0; i < points.rows(); ++i) {
    auto e = static_cast<Eigen::Index>(begin(i));
    for (SparseMatrix::InnerIterator entry(whole.L, i); entry; ++entry, ++e) {
      ASSERT_EQ(column(e), entry.row());
      ASSERT_NEAR(value(e), entry.value(), 1e-12 * whole.L.coeff(i, i));
    }
    ASSERT_EQ(e, begin(i + 1));
    ASSERT_EQ(status(i), static_cast<int>(whole.status[i]));
    ASSERT_EQ(representative(i), whole.representative[i]);
    ASSERT_EQ(boundary(i), static_cast<int>(whole.boundary[i]));
    ASSERT_NEAR(M(i), whole.M[i], 1e-12 * whole.M[i]);
    if (whole.status[i] != PointStatus::not_finite) {
      ASSERT_NEAR(std::abs(normals.row(i).dot(whole.frames.normals.row(i))), 1, 1e-12);
    }
  }
}

TEST(TileFiles, HaveTheRowsOfChosenPoints) {
  const TemporaryDir dir;
  const Points points = sheet();
  TileSourceText text;
  for (const std::int64_t first : {std::int64_t{0}, std::int64_t{5} << 32}) {  // int32 and int64
    std::vector<std::int64_t> numbers;
    for (int i = 0; i < points.rows(); ++i) numbers.push_back(first + 2 * i);
    text.of = numbers.back() + 1;
    text.rows = [&](const auto& take) {
      take({numbers.begin(), numbers.begin() + 100});
      take({numbers.begin() + 100, numbers.end()});
    };
    writeLaplacianByTiles(dir.path(), sourceOf(points), twoTiles(), text);
    const Eigen::MatrixXd rows = readArray(dir / "file_row.npy");
    ASSERT_EQ(rows.rows(), points.rows());
    EXPECT_EQ(rows(6401), static_cast<double>(first) + 2 * 6401);
    EXPECT_EQ(std::filesystem::file_size(dir / "file_row.npy"), 128 + (first == 0 ? 4u : 8u) * 6402);
  }
  EXPECT_EQ(filesOfResult(dir.path()).size(), tileFiles().size() + 1);
  text.rows = [](const auto& take) { take({1, 2, 3}); };
  EXPECT_THROW(writeLaplacianByTiles(dir.path(), sourceOf(points), twoTiles(), text), InvalidInput);
}

TEST(TileFiles, AreNotWrittenInPart) {
  const TemporaryDir dir;
  const auto folder = dir / "new";
  TileOptions cancelled = twoTiles();
  cancelled.progress = [](auto, double done) { return done == 0; };
  EXPECT_THROW(writeLaplacianByTiles(folder, sourceOf(sheet()), cancelled), Cancelled);
  cancelled.progress = [](auto stage, double) { return stage != "write"; };
  EXPECT_THROW(writeLaplacianByTiles(folder, sourceOf(sheet()), cancelled), Cancelled);
  EXPECT_FALSE(std::filesystem::exists(folder));
  const SmallDisk disk("1M");
  if (!disk.isMounted()) GTEST_SKIP() << "only root may mount a disk";
  EXPECT_THROW(writeLaplacianByTiles(disk.path(), sourceOf(sheet()), twoTiles()), IoError);
  EXPECT_TRUE(std::filesystem::is_empty(disk.path()));
}

}  // namespace
}  // namespace tufted
