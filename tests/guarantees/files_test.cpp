// The guarantees hold on real scans and on meshes that were collected for being difficult.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "guarantees/guarantees.h"
#include "tufted/errors.h"
#include "tufted/io/read.h"

namespace tufted::guarantees {
namespace {

namespace fs = std::filesystem;
using testing::IsEmpty;

/// The files of one folder, by name; the folder itself where it is absent.
std::vector<fs::path> filesIn(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files.empty() ? std::vector{folder} : files;
}

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
  const Laplacian by_pairs = pointCloudLaplacian(points, {.gluing = Gluing::vertex_pair});
  EXPECT_THAT(brokenGuarantees(by_pairs, points), IsEmpty()) << "cloud, glued per vertex pair";
}

std::string testName(const testing::TestParamInfo<fs::path>& info) {
  std::string name = info.param.filename().string();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return std::to_string(info.index) + "_" + name;  // names may differ in signs only
}

INSTANTIATE_TEST_SUITE_P(Clouds, GuaranteesOfFile, testing::ValuesIn(filesIn(TUFTED_DATA_DIR "/clouds")), testName);
INSTANTIATE_TEST_SUITE_P(Meshes, GuaranteesOfFile, testing::ValuesIn(filesIn(TUFTED_DATA_DIR "/meshes")), testName);
INSTANTIATE_TEST_SUITE_P(CgalPoints, GuaranteesOfFile, testing::ValuesIn(filesIn(TUFTED_CGAL_DATA_DIR "/points_3")),
                         testName);
INSTANTIATE_TEST_SUITE_P(CgalMeshes, GuaranteesOfFile, testing::ValuesIn(filesIn(TUFTED_CGAL_DATA_DIR "/meshes")),
                         testName);

}  // namespace
}  // namespace tufted::guarantees
