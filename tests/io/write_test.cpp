#include "tufted/io/write.h"

#include <CGAL/IO/PLY.h>
#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>
#include <pcl/PolygonMesh.h>
#include <pcl/io/ply_io.h>

#include <cmath>

#include "../support/refusal.h"
#include "../support/resource_limit.h"
#include "field_values.h"
#include "sample_laplacian.h"
#include "temporary_dir.h"
#include "tufted/errors.h"
#include "tufted/io/operators.h"

namespace write_test {
namespace {

std::size_t entries(const std::filesystem::path& dir) {
  const std::filesystem::directory_iterator iterator(dir);
  return static_cast<std::size_t>(std::distance(begin(iterator), end(iterator)));
}

TEST(WriteLaplacian, WritesTheDocumentedFilesAndNothingElse) {
  const TemporaryDir dir;
  tufted::writeLaplacian(dir / "deep/er", sampleLaplacian(), sampleGeometry());
  const auto names = tufted::resultFiles(tufted::WriteOptions().formats);
  for (const std::string& name : names)
    EXPECT_TRUE(std::filesystem::is_regular_file(dir.path() / "deep/er" / name)) << name;
  EXPECT_EQ(entries(dir / "deep/er"), names.size());
}

TEST(WriteLaplacian, TheSameInputGivesTheSameBytes) {
  const TemporaryDir dir;
  for (const char* name : {"a", "b"}) tufted::writeLaplacian(dir / name, sampleLaplacian(), sampleGeometry());
  for (const auto& file : std::filesystem::directory_iterator(dir / "a"))
    EXPECT_EQ(readAll(file.path()), readAll(dir / "b" / file.path().filename())) << file.path();
}

TEST(WriteLaplacian, NpyFilesAreVersionOneWithValuesAtAMultipleOf64) {
  const TemporaryDir dir;
  tufted::writeLaplacian(dir / "out", sampleLaplacian(), sampleGeometry());
  const std::string bytes = readAll(dir / "out/M.npy");
  ASSERT_EQ(bytes.size(), 128 + 4 * sizeof(double));
  EXPECT_EQ(bytes.substr(0, 10), std::string("\x93NUMPY\x01\x00\x76\x00", 10));
  EXPECT_TRUE(bytes.substr(10).starts_with("{'descr': '<f8', 'fortran_order': False, 'shape': (4,), }  "));
  EXPECT_EQ(bytes[127], '\n');
  double mass;
  std::memcpy(&mass, bytes.data() + 128, sizeof(mass));
  EXPECT_EQ(mass, 2.0 / 3);
}

TEST(WriteLaplacian, PointsAreReadAgainWithoutLoss) {
  const TemporaryDir dir;
  const auto geometry = sampleGeometry();
  tufted::writeLaplacian(dir / "out", sampleLaplacian(), geometry);
  const auto again = tufted::read(dir / "out/points.ply");
  EXPECT_TRUE(again.is_mesh);
  EXPECT_EQ(again.triangles, geometry.triangles);
  EXPECT_EQ(again.points.topRows(3), geometry.points.topRows(3));
  EXPECT_TRUE(std::isnan(again.points(3, 0)));
  const auto field = [&](const char* name) {
    const tufted::Field* found = fieldNamed(again, name);
    EXPECT_NE(found, nullptr) << name;
    static const tufted::Field none;
    return found ? *found : none;
  };
  EXPECT_EQ(valuesOf<float>(field("intensity")), (std::vector<float>{0.1f, 0.2f, 0.3f, 0.4f}));
  EXPECT_EQ(valuesOf<std::uint8_t>(field("red"))[0], 10);
  EXPECT_EQ(valuesOf<std::uint8_t>(field("green"))[0], 20);
  EXPECT_EQ(valuesOf<std::uint8_t>(field("blue"))[0], 30);
  EXPECT_EQ(valuesOf<std::int16_t>(field("histogram_1")), (std::vector<std::int16_t>{-2, -4, -6, -8}));
  EXPECT_EQ(valuesOf<double>(field("time"))[3], std::ldexp(1.0, 40));
  EXPECT_EQ(valuesOf<double>(field("mass"))[1], 2.0 / 3);  // ours, not the field of that name in the input
  EXPECT_EQ(valuesOf<std::uint8_t>(field("status"))[3], 1);
  EXPECT_EQ(valuesOf<std::uint8_t>(field("boundary"))[0], 1);
  EXPECT_EQ(valuesOf<std::int32_t>(field("representative"))[2], 2);
}

TEST(WriteLaplacian, PclAndCgalReadThePoints) {
  const TemporaryDir dir;
  const auto geometry = sampleGeometry();
  tufted::writeLaplacian(dir / "out", sampleLaplacian(), geometry);
  const std::string path = (dir / "out/points.ply").string();
  pcl::PolygonMesh mesh;
  ASSERT_EQ(pcl::PLYReader().read(path, mesh), 0);
  ASSERT_EQ(mesh.cloud.width, 4u);
  double x;
  std::memcpy(&x, mesh.cloud.data.data() + mesh.cloud.fields[0].offset, sizeof(x));
  EXPECT_EQ(x, geometry.points(0, 0));
  ASSERT_EQ(mesh.polygons.size(), 1u);
  EXPECT_EQ(mesh.polygons[0].vertices[2], 2);

  std::vector<CGAL::Simple_cartesian<double>::Point_3> points;
  std::vector<std::vector<std::size_t>> faces;
  ASSERT_TRUE(CGAL::IO::read_PLY(path, points, faces));
  ASSERT_EQ(points.size(), 4u);
  EXPECT_EQ(points[1].y(), geometry.points(1, 1));
  EXPECT_EQ(faces, (std::vector<std::vector<std::size_t>>{{0, 1, 2}}));
}

TEST(WriteLaplacian, AnOrganizedCloudKeepsItsSizeForUsAndForPcl) {
  const TemporaryDir dir;
  auto geometry = sampleGeometry();
  geometry.is_mesh = false;
  geometry.triangles.resize(0, 3);
  geometry.width = geometry.height = 2;
  tufted::writeLaplacian(dir / "out", sampleLaplacian(), geometry);
  const auto again = tufted::read(dir / "out/points.ply");
  EXPECT_EQ(again.width, 2);
  EXPECT_EQ(again.height, 2);
  pcl::PCLPointCloud2 cloud;
  ASSERT_EQ(pcl::PLYReader().read((dir / "out/points.ply").string(), cloud), 0);
  EXPECT_EQ(cloud.width, 2u);
  EXPECT_EQ(cloud.height, 2u);
}

TEST(WriteLaplacian, AFullDiskLeavesNoFileAndNamesThePath) {
  const TemporaryDir dir;
  auto geometry = sampleGeometry();
  auto laplacian = sampleLaplacian();
  // HeightRange by the largest file, after others were written.
  for (const rlim_t limit : {100u, 400u, 1400u}) {
    std::string message;
    try {
      const FileSizeLimit full(limit);
      tufted::writeLaplacian(dir / "out", laplacian, geometry);
    } catch (const tufted::IoError& error) {
      message = error.what();
    }
    EXPECT_TRUE(message.starts_with((dir / "out").string())) << limit << ' ' << message;
    EXPECT_EQ(message.find(".tufted-"), std::string::npos) << message;
    EXPECT_FALSE(std::filesystem::exists(dir / "out")) << limit;
  }
}

TEST(WriteLaplacian, CancellingLeavesEarlierResultsAsTheyWere) {
  const TemporaryDir dir;
  tufted::writeLaplacian(dir / "out", sampleLaplacian(), sampleGeometry());
  const std::string before = readAll(dir / "out/M.npy");
  const auto files = entries(dir / "out");
  auto laplacian = sampleLaplacian();
  laplacian.M *= 2;
  tufted::WriteOptions options;
  options.progress = [](std::string_view, double fraction) { return fraction < 0.9; };
  EXPECT_THROW(tufted::writeLaplacian(dir / "out", laplacian, sampleGeometry(), options), tufted::Cancelled);
  EXPECT_EQ(readAll(dir / "out/M.npy"), before);
  EXPECT_EQ(entries(dir / "out"), files);
  tufted::writeLaplacian(dir / "out", laplacian, sampleGeometry());
  EXPECT_NE(readAll(dir / "out/M.npy"), before);
}

TEST(WriteLaplacian, WhereNoDirectoryCanBeIsAnIoError) {
  const TemporaryDir dir;
  const auto file = dir.write("file", "x");
  EXPECT_THROW(tufted::writeLaplacian(file, sampleLaplacian(), sampleGeometry()), tufted::IoError);
  EXPECT_THROW(tufted::writeLaplacian(file / "below", sampleLaplacian(), sampleGeometry()), tufted::IoError);
  EXPECT_EQ(readAll(file), "x");
  EXPECT_THROW(tufted::writeLaplacian("", sampleLaplacian(), sampleGeometry()), tufted::IoError);
  std::filesystem::create_symlink(dir / "nowhere", dir / "link");
  EXPECT_THROW(tufted::writeLaplacian(dir / "link", sampleLaplacian(), sampleGeometry()), tufted::IoError);
  EXPECT_TRUE(std::filesystem::is_symlink(dir / "link"));
}

TEST(WriteLaplacian, ANameThatIsTooLongLeavesNoParentBehind) {
  const TemporaryDir dir;
  const std::string name(300, 'x');
  EXPECT_THROW(tufted::writeLaplacian(dir / name, sampleLaplacian(), sampleGeometry()), tufted::IoError);
  EXPECT_THROW(tufted::writeLaplacian(dir / "deep/er" / name, sampleLaplacian(), sampleGeometry()), tufted::IoError);
  EXPECT_EQ(entries(dir.path()), 0u);
}

TEST(WriteLaplacian, ArraysOfDifferentLengthAreTheCallersMistake) {
  const TemporaryDir dir;
  auto laplacian = sampleLaplacian();
  laplacian.boundary.pop_back();
  EXPECT_THROW(tufted::writeLaplacian(dir / "out", laplacian, sampleGeometry()), tufted::InvalidInput);
  laplacian = sampleLaplacian();
  laplacian.positions.setZero(laplacian.L.rows() - 1, 3);
  EXPECT_THROW(tufted::writeLaplacian(dir / "out", laplacian, sampleGeometry()), tufted::InvalidInput);
  EXPECT_FALSE(std::filesystem::exists(dir / "out"));
}

TEST(WriteOperators, ArraysThatDoNotFitAreTheCallersMistake) {
  const TemporaryDir dir;
  const tufted::Laplacian laplacian = sampleLaplacian();
  const tufted::Geometry geometry = sampleGeometry();
  const Eigen::Index n = geometry.points.rows();
  tufted::Gradients gradients;
  gradients.X.resize(n, n);
  gradients.Y.resize(n, n);
  gradients.frames.normals.setZero(n, 3);
  gradients.frames.tangents.setZero(n, 3);
  tufted::Spectrum spectrum;
  spectrum.values.setZero(2);
  spectrum.vectors.setZero(n, 2);
  const auto expectRefusal = [&](const std::string& word, const tufted::Geometry& points,
                                 const tufted::Gradients& slopes, const tufted::Spectrum& pairs) {
    const std::string said =
        tufted::support::refusal([&] { tufted::writeOperators(dir / "out", laplacian, points, slopes, pairs); });
    EXPECT_NE(said.find("writeOperators: " + word), std::string::npos) << said;
  };
  tufted::Geometry fewer_points = geometry;
  fewer_points.points.conservativeResize(n - 1, 3);
  expectRefusal("geometry has", fewer_points, gradients, spectrum);
  tufted::Gradients wrong = gradients;
  wrong.X.resize(n + 1, n);
  expectRefusal("gradients.X has 5 rows", geometry, wrong, spectrum);
  wrong = gradients;
  wrong.Y.resize(n, n - 1);
  expectRefusal("gradients.Y has 3 columns", geometry, wrong, spectrum);
  wrong = gradients;
  wrong.Y.coeffRef(0, 0) = 1;
  wrong.Y.uncompress();
  expectRefusal("gradients.Y must be compressed", geometry, wrong, spectrum);
  wrong = gradients;
  wrong.frames.tangents.resize(n - 1, 3);
  expectRefusal("gradients.frames.tangents has", geometry, wrong, spectrum);
  tufted::Spectrum fewer_pairs = spectrum;
  fewer_pairs.vectors.conservativeResize(n, 1);
  expectRefusal("spectrum.vectors has 1 columns", geometry, gradients, fewer_pairs);
  EXPECT_FALSE(std::filesystem::exists(dir / "out"));
  tufted::writeOperators(dir / "out", laplacian, geometry, gradients, spectrum);
}

TEST(ToJson, StatesEveryCountOfTheReport) {
  const std::string json = tufted::toJson(sampleLaplacian().report);
  for (const char* part :
       {"\"points\": 4", "\"active\": 3", "\"nonzeros\": 7", "\"name\": \"flips\"", "\"bytes\": 1024"})
    EXPECT_NE(json.find(part), std::string::npos) << part << json;
}

TEST(WriteLaplacian, TheReportStatesSignScaleAndOptions) {
  const TemporaryDir dir;
  const tufted::CloudOptions cloud = {.neighbors = 17, .paper = {.gluing = tufted::Gluing::vertex_pair}};
  tufted::Geometry geometry = sampleGeometry();
  geometry.polygons = 5;
  geometry.merged_vertices = 6;
  tufted::writeLaplacian(dir / "out", sampleLaplacian(), geometry, {.source = "a\xff.ply", .cloud = &cloud});
  const std::string json = readAll(dir / "out/report.json");
  for (const char* part :
       {"positive semidefinite", "opposite sign", "length^2", "L u = M f", "L x = lambda M x", "\"neighbors\": 17",
        "\"gluing\": \"vertex-pair\"", "\"tufted\": \"",
        "1/2 (front and back of the cover) times 1/3 (each triangle is found by its three corners)",
        "\"mesh\": \"L: 1/2 (front and back of the cover)\"", "\"polygons\": 5", "\"merged_vertices\": 6"})
    EXPECT_NE(json.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace write_test
