// Polygonal data in VTK's legacy format.
#include <gtest/gtest.h>
#include <pcl/PolygonMesh.h>
#include <pcl/conversions.h>
#include <pcl/io/vtk_io.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cstring>

#include "field_values.h"
#include "temporary_dir.h"
#include "tufted/errors.h"
#include "tufted/io/read.h"

namespace vtk_test {
namespace {

const tufted::Points square{{0.5, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const tufted::Triangles halves{{0, 1, 2}, {0, 2, 3}};

/// The values of a file, as text or as VTK's binary form has them: big endian.
class Values {
 public:
  explicit Values(bool binary) : binary_(binary) {}

  std::string form() const { return binary_ ? "BINARY\n" : "ASCII\n"; }
  template <class T>
  std::string operator()(const std::vector<T>& values) const {
    std::string bytes;
    for (T value : values) {
      if (!binary_) {
        bytes += std::to_string(+value) + (bytes.size() % 3 == 0 ? "\n" : " ");
        continue;
      }
      char raw[sizeof(T)];
      std::memcpy(raw, &value, sizeof(T));
      std::reverse(raw, raw + sizeof(T));
      bytes.append(raw, sizeof(T));
    }
    return bytes + "\n";
  }

 private:
  bool binary_;
};

std::string points(const Values& values) {
  return "DATASET POLYDATA\nPOINTS 4 float\n" + values(std::vector<float>{0.5, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
}

TEST(Vtk, EveryVersionIsReadInBothForms) {
  for (const bool binary : {false, true}) {
    const Values values(binary);
    const std::string old = "# vtk DataFile Version 3.0\na title\n" + values.form() + points(values) +
                            "POLYGONS 2 8\n" + values(std::vector<std::int32_t>{3, 0, 1, 2, 3, 0, 2, 3});
    const std::string recent = "# vtk DataFile Version 5.1\nvtk output\n" + values.form() + points(values) +
                               "METADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 1\n\n" +
                               "POLYGONS 3 6\nOFFSETS vtktypeint64\n" + values(std::vector<std::int64_t>{0, 3, 6}) +
                               "CONNECTIVITY vtktypeint64\n" + values(std::vector<std::int64_t>{0, 1, 2, 0, 2, 3});
    const std::string strip = "# vtk DataFile Version 2.0\n\n" + values.form() + points(values) +
                              "TRIANGLE_STRIPS 1 5\n" + values(std::vector<std::int32_t>{4, 1, 2, 0, 3});
    for (const std::string& bytes : {old, recent, strip})
      for (const char* name : {"a.vtk", "nameless"}) {
        const auto geometry = tufted::parse(bytes, name);
        EXPECT_EQ(geometry.points, square);
        EXPECT_TRUE(geometry.is_mesh);
        EXPECT_EQ(geometry.triangles.rows(), 2);
        if (bytes != strip) {
          EXPECT_EQ(geometry.triangles, halves);
        }
        EXPECT_EQ(geometry.format, binary ? "VTK, binary" : "VTK, ascii");
        EXPECT_TRUE(geometry.notes.empty());
      }
  }
}

TEST(Vtk, ValuesOfPointsAreNormalsColoursAndFieldsAndThoseOfCellsAreNot) {
  for (const bool binary : {false, true}) {
    const Values values(binary);
    const std::string colors =
        binary ? std::string("\xff\0\0\0\xff\0\0\0\xff\xff\xff\xff\n", 13) : "1 0 0 0 1 0 0 0 1 1 1 1\n";
    const auto geometry = tufted::parse(
        "# vtk DataFile Version 4.2\nvtk output\n" + values.form() + points(values) + "VERTICES 4 8\n" +
            values(std::vector<std::int32_t>{1, 0, 1, 1, 1, 2, 1, 3}) +
            "CELL_DATA 4\nSCALARS quality double\nLOOKUP_TABLE default\n" + values(std::vector<double>{1, 2, 3, 4}) +
            "POINT_DATA 4\nCOLOR_SCALARS rgb 3\n" + colors + "NORMALS Normals float\n" +
            values(std::vector<float>{0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 0, 1}) +
            "FIELD FieldData 2\nIntensity 1 4 unsigned_short\n" + values(std::vector<std::uint16_t>{7, 8, 9, 10}) +
            "my%20pair 2 4 double\n" + values(std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8}),
        "a.vtk");
    EXPECT_FALSE(geometry.is_mesh);
    EXPECT_EQ(geometry.points, square);
    ASSERT_EQ(geometry.normals.rows(), 4);
    EXPECT_EQ(geometry.normals.row(2), Eigen::RowVector3d(0, 1, 0));
    ASSERT_EQ(geometry.fields.size(), 5u);
    EXPECT_EQ(valuesOf<std::uint8_t>(*fieldNamed(geometry, "green")), (std::vector<std::uint8_t>{0, 255, 0, 255}));
    EXPECT_EQ(valuesOf<std::uint16_t>(*fieldNamed(geometry, "intensity")), (std::vector<std::uint16_t>{7, 8, 9, 10}));
    ASSERT_NE(fieldNamed(geometry, "my_pair"), nullptr);
    EXPECT_EQ(fieldNamed(geometry, "my_pair")->count, 2);
    EXPECT_EQ(fieldNamed(geometry, "quality"), nullptr);
  }
}

TEST(Vtk, WhatPclWritesIsRead) {
  pcl::PointCloud<pcl::PointXYZRGB> cloud;
  for (int i = 0; i < 4; ++i) {
    pcl::PointXYZRGB point(static_cast<std::uint8_t>(10 * i), 255, 0);
    point.getVector3fMap() = square.row(i).cast<float>();
    cloud.push_back(point);
  }
  pcl::PolygonMesh mesh;
  pcl::toPCLPointCloud2(cloud, mesh.cloud);
  for (int t = 0; t < 2; ++t) {
    mesh.polygons.emplace_back();
    for (int c = 0; c < 3; ++c) mesh.polygons.back().vertices.push_back(halves(t, c));
  }
  const TemporaryDir dir;
  ASSERT_EQ(pcl::io::saveVTKFile((dir / "mesh.vtk").string(), mesh), 0);
  const auto read = tufted::read(dir / "mesh.vtk");
  EXPECT_EQ(read.points, square);
  EXPECT_EQ(read.triangles, halves);
  ASSERT_NE(fieldNamed(read, "red"), nullptr);
  EXPECT_EQ(valuesOf<std::uint8_t>(*fieldNamed(read, "red")), (std::vector<std::uint8_t>{0, 10, 20, 30}));
  ASSERT_EQ(pcl::io::saveVTKFile((dir / "cloud.vtk").string(), mesh.cloud), 0);
  EXPECT_EQ(tufted::read(dir / "cloud.vtk").points, square);
  EXPECT_FALSE(tufted::read(dir / "cloud.vtk").is_mesh);
}

TEST(Vtk, BytesBehindTheLastSectionAreNoted) {
  for (const bool binary : {false, true}) {
    const Values values(binary);
    const auto geometry = tufted::parse(
        "# vtk DataFile Version 3.0\na\n" + values.form() + points(values) + std::string(7, '\0'), "a.vtk");
    EXPECT_EQ(geometry.points, square);
    EXPECT_EQ(geometry.unread_bytes, 7);
    EXPECT_EQ(geometry.notes.size(), 1u);
  }
}

TEST(Vtk, OtherDatasetsAreRefusedWithWhatToDo) {
  try {
    tufted::parse("# vtk DataFile Version 3.0\na\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 0 float\n", "a.vtk");
    FAIL() << "was read";
  } catch (const tufted::IoError& error) {
    EXPECT_NE(std::string(error.what()).find("'UNSTRUCTURED_GRID', must be POLYDATA; ParaView's"), std::string::npos);
  }
}

}  // namespace
}  // namespace vtk_test
