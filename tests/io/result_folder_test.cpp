// Whatever lies in a folder, its last result is what its report lists.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "field_values.h"
#include "folder_content.h"
#include "laplacian_folder.h"
#include "odd_sphere.h"
#include "tufted/io/operators.h"
#include "tufted/spectrum.h"

namespace result_folder_test {
namespace {

using tufted::Format;
using tufted::Geometry;
using Names = std::set<std::string>;

class ResultFolder : public LaplacianFolder {
 protected:
  Names onDisk(const std::string& name) const {
    Names names;
    for (const auto& [file, bytes] : contentOf(dir_ / name)) names.insert(file);
    return names;
  }
  Names listed(const std::string& name) const {
    const std::vector<std::string> files = tufted::filesOfResult(dir_ / name);
    return {files.begin(), files.end()};
  }

  const Geometry geometry_ = tufted::oddSphere(3), other_ = tufted::oddSphere(4);
  const tufted::Laplacian laplacian_ = tufted::pointCloudLaplacian(geometry_.points);
  const tufted::Laplacian different_ = tufted::pointCloudLaplacian(other_.points);
};

TEST_F(ResultFolder, EveryReportListsTheFilesThatAreWritten) {
  for (const Format format : {Format::npz, Format::mtx, Format::mat, Format::spmat, Format::petsc, Format::ply,
                              Format::pcd, Format::cover, Format::triangles}) {
    const std::string name = "format" + std::to_string(static_cast<int>(format));
    tufted::writeLaplacian(dir_ / name, laplacian_, geometry_, {.formats = {format}});
    EXPECT_EQ(listed(name), onDisk(name));
  }
  tufted::writeResults(dir_ / "results", laplacian_, geometry_, {{.name = "u", .values = laplacian_.M}},
                       {.copies = {Format::ply, Format::pcd}, .report = "{\"command\": \"of my own\"}"});
  EXPECT_EQ(listed("results"), onDisk("results"));
  EXPECT_EQ(listed("results"), (Names{"u.npy", "points.ply", "points.pcd", "report.json"}));
  EXPECT_NE(readAll(dir_ / "results/report.json").find("\"command\": \"of my own\""), std::string::npos);
  tufted::writeOperators(dir_ / "operators", laplacian_, geometry_, tufted::gradients(laplacian_, geometry_.points),
                         tufted::spectrum(laplacian_, 5));
  EXPECT_EQ(listed("operators"), onDisk("operators"));
}

TEST_F(ResultFolder, FilesThatTheLastResultDoesNotListAreNotTaken) {
  const std::vector<Format> all = {Format::npz, Format::ply, Format::pcd, Format::cover};
  const auto overwrite = [&](const std::vector<Format>& formats) {
    tufted::writeLaplacian(dir_.path(), laplacian_, geometry_, {.formats = all});
    tufted::writeLaplacian(dir_.path(), different_, other_, {.formats = formats});
  };
  for (const std::vector<Format>& points : {std::vector{Format::ply}, {Format::pcd}, {Format::ply, Format::pcd}}) {
    std::vector<Format> formats = points;
    formats.push_back(Format::npz);
    overwrite(formats);
    EXPECT_EQ(tufted::readPoints(dir_.path()).points.topRows(9), other_.points.topRows(9));
    EXPECT_EQ(tufted::readLaplacian(dir_.path()).M, different_.M);
    EXPECT_FALSE(tufted::readLaplacian(dir_.path()).hasCover());
  }
  overwrite({Format::npz});
  EXPECT_EQ(tufted::readPoints(dir_.path()).points.rows(), 0);
  overwrite({Format::ply});
  EXPECT_EQ(refusal(), "report.json: is of a run that did not write L.npz");
  // Of another kind of result nothing of the Laplacian is taken.
  overwrite(all);
  tufted::writeResults(dir_.path(), laplacian_, geometry_, {{.name = "M", .values = laplacian_.M}});
  EXPECT_EQ(refusal(), "report.json: is no report of a Laplacian");
  EXPECT_EQ(tufted::readPoints(dir_.path()).points.topRows(9), geometry_.points.topRows(9));
  // A stranger's file counts as little.
  tufted::writeLaplacian(dir_.path(), different_, other_, {.formats = {Format::npz}});
  dir_.write("points.ply", "not points");
  dir_.write("cover.npz", "not a cover");
  EXPECT_EQ(tufted::readPoints(dir_.path()).points.rows(), 0);
  EXPECT_EQ(tufted::readLaplacian(dir_.path()).M, different_.M);
}

TEST_F(ResultFolder, AReportMustListItsFiles) {
  tufted::writeLaplacian(dir_.path(), laplacian_, geometry_);
  std::string report = readAll(dir_ / "report.json");
  const std::size_t begin = report.find("\"files\": ["), end = report.find(']', begin) + 1;
  const std::string list = report.substr(begin, end - begin);
  dir_.write("report.json", report.substr(0, begin) + "\"files\": 7" + report.substr(end));
  EXPECT_EQ(refusal(), "report.json: does not list the files of its result, must have them as \"files\"");
  // Where versions before this one listed them.
  dir_.write("report.json", report.substr(0, begin) + "\"was\": 7" + report.substr(end));
  report = readAll(dir_ / "report.json");
  const std::string options = "\"write_options\": {";
  const std::size_t inside = report.find(options) + options.size();
  dir_.write("report.json", report.substr(0, inside) + list + ", " + report.substr(inside));
  EXPECT_EQ(refusal(), "");
  EXPECT_EQ(tufted::readPoints(dir_.path()).points.rows(), 200);
}

TEST_F(ResultFolder, GivesBackAllThatWasWritten) {
  Geometry geometry = geometry_;
  geometry.width = 20;
  geometry.height = 10;
  geometry.viewpoint = {0.1, 2, -3, 0.5, 0.5, 0.5, 0.5};
  for (int type = 0; type <= static_cast<int>(tufted::FieldType::float64); ++type)
    for (const int count : {1, 3}) {
      tufted::Field field = {"f" + std::to_string(10 * type + count), static_cast<tufted::FieldType>(type), count, {}};
      constexpr std::array<int, 10> sizes = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
      for (int k = 0; k < 200 * count * sizes[static_cast<std::size_t>(type)]; ++k)
        field.bytes.push_back(static_cast<std::byte>(k * 7 % 61));
      geometry.fields.push_back(field);
    }
  Geometry mesh = geometry_;
  mesh.is_mesh = true;
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 1, 2, 2, 1, 4;
  mesh.polygons = 1;
  mesh.merged_vertices = 12;
  Geometry bare = mesh;  // every face is gone
  bare.triangles.resize(0, 3);
  const tufted::Laplacian of_mesh = tufted::meshLaplacian(mesh.points, mesh.triangles),
                          of_bare = tufted::meshLaplacian(bare.points, bare.triangles);
  const tufted::CloudOptions cloud_options = {.neighbors = 12};
  const tufted::MeshOptions mesh_options;
  for (const auto& [laplacian, points] : {std::pair(&laplacian_, &geometry), {&of_mesh, &mesh}, {&of_bare, &bare}}) {
    tufted::WriteOptions options = {.formats = {Format::npz, Format::ply, Format::pcd, Format::cover},
                                    .source = "here.ply"};
    if (points->is_mesh)
      options.mesh = &mesh_options;
    else
      options.cloud = &cloud_options;
    tufted::writeLaplacian(dir_ / "first", *laplacian, *points, options);
    const tufted::Laplacian read = tufted::readLaplacian(dir_ / "first");
    const Geometry again = tufted::readPoints(dir_ / "first");
    EXPECT_EQ(again.is_mesh, points->is_mesh);
    EXPECT_EQ(again.triangles, points->triangles);
    EXPECT_EQ(again.polygons, points->polygons);
    EXPECT_EQ(again.merged_vertices, points->merged_vertices);
    EXPECT_EQ(again.width, points->width);
    EXPECT_EQ(again.viewpoint, points->viewpoint);
    for (const tufted::Field& field : points->fields) {
      const tufted::Field* const found = fieldNamed(again, field.name);
      ASSERT_NE(found, nullptr) << field.name;
      EXPECT_EQ(found->type, field.type);
      EXPECT_EQ(found->count, field.count);
      EXPECT_EQ(found->bytes, field.bytes) << field.name;
    }
    tufted::writeLaplacian(dir_ / "second", read, again, options);
    EXPECT_EQ(contentOf(dir_ / "second"), contentOf(dir_ / "first"));
  }
}

TEST_F(ResultFolder, AReportThatIsNoObjectIsTheCallersMistake) {
  for (const char* report : {"", "[]", "{", "7"})
    EXPECT_THROW(tufted::writeResults(dir_ / "out", laplacian_, geometry_, {}, {.report = report}),
                 tufted::InvalidInput);
  EXPECT_THROW(tufted::writeLaplacian(dir_ / "out", laplacian_, geometry_, {.build_options = "[]"}),
               tufted::InvalidInput);
  EXPECT_FALSE(std::filesystem::exists(dir_ / "out"));
}

}  // namespace
}  // namespace result_folder_test
