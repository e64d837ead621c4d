// The guarantees hold on real scans and on meshes that were collected for being difficult.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "guarantees/guarantees.h"
#include "guarantees/real_files.h"
#include "tufted/errors.h"
#include "tufted/io/read.h"

namespace tufted::guarantees::files_test {
namespace {

namespace fs = std::filesystem;
using testing::IsEmpty;

/// Gluing per vertex pair takes a whole cover, whose checks take longer than all else on large scans.
constexpr int most_glued_by_pairs = 50000;

class GuaranteesOfFile : public testing::TestWithParam<fs::path> {};

TEST_P(GuaranteesOfFile, AsCloudAndAsMesh) {
  const fs::path& path = GetParam();
  if (!fs::is_regular_file(path)) GTEST_SKIP() << "no folder " << path;
  Geometry geometry;
  try {
    geometry = read(path);
  } catch (const IoError& error) {
    FAIL() << "refused: " << error.what();  // today's readers accept them all
  }
  const Points& points = geometry.points;
  if (geometry.is_mesh) {
    EXPECT_THAT(brokenGuarantees(meshLaplacian(points, geometry.triangles), points), IsEmpty()) << "mesh";
  }
  EXPECT_THAT(brokenGuarantees(pointCloudLaplacian(points), points), IsEmpty()) << "cloud, default";
  const Laplacian clean = pointCloudLaplacian(points, cloudOptions(Preset::clean));
  EXPECT_THAT(brokenGuarantees(clean, points), IsEmpty()) << "cloud, preset clean";
  if (points.rows() > most_glued_by_pairs) return;
  const Laplacian by_pairs = pointCloudLaplacian(points, {.paper = {.gluing = Gluing::vertex_pair}});
  EXPECT_THAT(brokenGuarantees(by_pairs, points), IsEmpty()) << "cloud, glued per vertex pair";
}

INSTANTIATE_TEST_SUITE_P(Clouds, GuaranteesOfFile, testing::ValuesIn(filesIn(TUFTED_DATA_DIR "/clouds")), testName);
INSTANTIATE_TEST_SUITE_P(Meshes, GuaranteesOfFile, testing::ValuesIn(filesIn(TUFTED_DATA_DIR "/meshes")), testName);
INSTANTIATE_TEST_SUITE_P(CgalPoints, GuaranteesOfFile, testing::ValuesIn(filesIn(TUFTED_CGAL_DATA_DIR "/points_3")),
                         testName);
INSTANTIATE_TEST_SUITE_P(CgalMeshes, GuaranteesOfFile, testing::ValuesIn(filesIn(TUFTED_CGAL_DATA_DIR "/meshes")),
                         testName);

}  // namespace
}  // namespace tufted::guarantees::files_test
