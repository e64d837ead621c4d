#include <CGAL/IO/PLY.h>
#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "field_values.h"
#include "temporary_dir.h"
#include "tufted/io/read.h"

namespace ply_test {
namespace {

/// Writes the values of a PLY body in one of its three formats (on a little endian machine).
class PlyValues {
 public:
  explicit PlyValues(std::string format) : format_(std::move(format)) {}

  template <class T>
  PlyValues& add(T value) {
    if (format_ == "ascii") {
      std::ostringstream token;
      token.precision(17);
      token << +value << ' ';
      body_ += token.str();
      return *this;
    }
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    if (format_ == "binary_big_endian") std::reverse(bytes, bytes + sizeof(T));
    body_.append(bytes, sizeof(T));
    return *this;
  }

  /// Adds a value by the name of its type.
  PlyValues& add(const std::string& type, int value) {
    if (type == "char") return add(static_cast<std::int8_t>(value));
    if (type == "uchar") return add(static_cast<std::uint8_t>(value));
    if (type == "short") return add(static_cast<std::int16_t>(value));
    if (type == "ushort") return add(static_cast<std::uint16_t>(value));
    if (type == "int") return add(static_cast<std::int32_t>(value));
    return add(static_cast<std::uint32_t>(value));
  }

  void endItem() {
    if (format_ == "ascii") body_ += '\n';
  }

  std::string file(const std::string& elements) const {
    return "ply\nformat " + format_ + " 1.0\n" + elements + "end_header\n" + body_;
  }

 private:
  std::string format_;
  std::string body_;
};

const char* const formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};

class PlyFormat : public testing::TestWithParam<const char*> {
 protected:
  TemporaryDir dir_;
};

TEST_P(PlyFormat, KeepsDoublesNormalsAndFurtherFields) {
  PlyValues values(GetParam());
  for (int i = 0; i < 3; ++i) {
    values.add(500000.1234567891 + i).add(5400000.9876543211).add(1e-300 * i);
    values.add(0.0f).add(0.0f).add(1.0f);
    values.add(static_cast<std::uint8_t>(200 + i)).add(static_cast<std::int16_t>(-5 * i)).add(0.1f);
    values.endItem();
  }
  const auto geometry = tufted::read(
      dir_.write("a.ply", values.file("comment of many words\nelement vertex 3\nproperty double x\nproperty float64 y\n"
                                      "property double z\nproperty float nx\nproperty float ny\nproperty float32 nz\n"
                                      "property uchar red\nproperty int16 ring\nproperty float quality\n")));
  ASSERT_EQ(geometry.points.rows(), 3);
  EXPECT_FALSE(geometry.is_mesh);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(geometry.points(i, 0), 500000.1234567891 + i);
    EXPECT_EQ(geometry.points(i, 1), 5400000.9876543211);
    EXPECT_EQ(geometry.points(i, 2), 1e-300 * i);
    EXPECT_EQ(geometry.normals(i, 2), 1);
  }
  ASSERT_EQ(geometry.fields.size(), 3u);
  EXPECT_EQ(valuesOf<std::uint8_t>(geometry.fields[0]), (std::vector<std::uint8_t>{200, 201, 202}));
  EXPECT_EQ(valuesOf<std::int16_t>(geometry.fields[1]), (std::vector<std::int16_t>{0, -5, -10}));
  EXPECT_EQ(valuesOf<float>(geometry.fields[2])[1], 0.1f);
}

TEST_P(PlyFormat, EveryPairOfListTypesGivesTheSameFaces) {
  for (const std::string length : {"char", "uchar", "short", "ushort", "int", "uint"}) {
    for (const std::string corner : {"char", "uchar", "short", "ushort", "int", "uint"}) {
      PlyValues values(GetParam());
      for (int i = 0; i < 4; ++i) {
        values.add(i % 2).add(i / 2).add(0);
        values.endItem();
      }
      for (const std::vector<int>& face : {std::vector<int>{0, 1, 2}, std::vector<int>{0, 1, 3, 2}}) {
        values.add(static_cast<std::uint8_t>(9)).add(length, static_cast<int>(face.size()));
        for (const int vertex : face) values.add(corner, vertex);
        values.add(static_cast<std::uint8_t>(1)).add(0.5f);
        values.endItem();
      }
      const auto geometry = tufted::read(dir_.write(
          "mesh.ply", values.file("element vertex 4\nproperty int x\nproperty int y\nproperty int z\nelement face 2\n"
                                  "property uchar flag\nproperty list " +
                                  length + " " + corner + " vertex_index\nproperty list uchar float texcoord\n")));
      ASSERT_TRUE(geometry.is_mesh) << length << ' ' << corner;
      EXPECT_EQ(geometry.triangles.rows(), 3);
      EXPECT_EQ(geometry.polygons, 1);
      EXPECT_EQ(geometry.triangles.row(0), Eigen::RowVector3i(0, 1, 2));
      EXPECT_EQ(geometry.points(3, 1), 1);
    }
  }
}

TEST_P(PlyFormat, ElementsInAnyOrderAndListsOfVerticesArePassedOver) {
  PlyValues values(GetParam());
  values.add(static_cast<std::uint8_t>(2)).add(7.0).add(8.0);
  values.endItem();
  for (int i = 0; i < 2; ++i) {
    values.add(1.0f + static_cast<float>(i)).add(static_cast<std::uint8_t>(1)).add(5).add(2.0f).add(3.0f);
    values.endItem();
  }
  const auto geometry = tufted::read(
      dir_.write("a.ply", values.file("element camera 1\nproperty list uchar double view\nelement vertex 2\n"
                                      "property float x\nproperty list uchar int seen\nproperty float y\n"
                                      "property float z\n")));
  EXPECT_EQ(geometry.points.row(1), Eigen::RowVector3d(2, 2, 3));
  EXPECT_TRUE(geometry.fields.empty());
}

TEST_P(PlyFormat, StripsBecomeTrianglesOfOneOrientation) {
  PlyValues values(GetParam());
  for (int i = 0; i < 5; ++i) {
    values.add(i).add(i % 2).add(0);
    values.endItem();
  }
  values.add(8);
  for (const int vertex : {0, 1, 2, 3, -1, 2, 3, 4}) values.add(vertex);
  values.endItem();
  const auto geometry =
      tufted::read(dir_.write("a.ply", values.file("element vertex 5\nproperty int x\nproperty int y\nproperty int z\n"
                                                   "element tristrips 1\nproperty list int int vertex_indices\n")));
  ASSERT_EQ(geometry.triangles.rows(), 3);
  EXPECT_EQ(geometry.triangles.row(1), Eigen::RowVector3i(2, 1, 3));
  EXPECT_EQ(geometry.triangles.row(2), Eigen::RowVector3i(2, 3, 4));
}

INSTANTIATE_TEST_SUITE_P(All, PlyFormat, testing::ValuesIn(formats));

TEST(Ply, WhatPclWritesIsRead) {
  pcl::PointCloud<pcl::PointXYZRGBNormal> cloud;
  for (int i = 0; i < 4; ++i) {
    pcl::PointXYZRGBNormal point;
    point.x = 0.1f * static_cast<float>(i);
    point.y = 1;
    point.z = i == 2 ? std::numeric_limits<float>::quiet_NaN() : 2;
    point.r = 10;
    point.g = static_cast<std::uint8_t>(20 + i);
    point.b = 30;
    point.normal_x = point.normal_y = 0;
    point.normal_z = 1;
    point.curvature = 0.25f;
    cloud.push_back(point);
  }
  // A quarter turn around z, at (1, 2, 3).
  const float half = std::sqrt(0.5f);
  cloud.sensor_origin_ = {1, 2, 3, 1};
  cloud.sensor_orientation_ = Eigen::Quaternionf(half, 0, 0, half);
  const TemporaryDir dir;
  for (const bool binary : {false, true}) {
    const auto path = dir / "cloud.ply";
    ASSERT_EQ(pcl::PLYWriter().write(path.string(), cloud, binary, true), 0);
    const auto geometry = tufted::read(path);
    ASSERT_EQ(geometry.points.rows(), 4);
    EXPECT_EQ(geometry.points(1, 0), 0.1f);
    EXPECT_TRUE(std::isnan(geometry.points(2, 2)));
    EXPECT_EQ(geometry.normals(3, 2), 1);
    ASSERT_NE(fieldNamed(geometry, "green"), nullptr);
    EXPECT_EQ(valuesOf<std::uint8_t>(*fieldNamed(geometry, "green"))[3], 23);
    const double pose[] = {1, 2, 3, half, 0, 0, half};
    for (int i = 0; i < 7; ++i) EXPECT_NEAR(geometry.viewpoint[i], pose[i], 1e-6) << i;
  }
}

TEST(Ply, APropertyWithoutANameIsPassedOver) {
  const auto geometry = tufted::parse(
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float _\nproperty float y\n"
      "property float z\nend_header\n1 5 2 3\n",
      "a.ply");
  EXPECT_TRUE(geometry.fields.empty());
  EXPECT_EQ(geometry.points.row(0), Eigen::RowVector3d(1, 2, 3));
}

TEST(Ply, WhatCgalWritesIsRead) {
  using Point = CGAL::Simple_cartesian<double>::Point_3;
  const std::vector<Point> points = {{500000.1234567891, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<std::vector<std::size_t>> faces = {{0, 1, 2}, {0, 1, 3, 2}};
  const TemporaryDir dir;
  for (const bool binary : {false, true}) {
    const auto path = dir / "mesh.ply";
    ASSERT_TRUE(CGAL::IO::write_PLY(path.string(), points, faces,
                                    CGAL::parameters::use_binary_mode(binary).stream_precision(17)));
    const auto geometry = tufted::read(path);
    EXPECT_EQ(geometry.points(0, 0), 500000.1234567891);
    EXPECT_EQ(geometry.triangles.rows(), 3);
  }
}

TEST(Ply, AFileWithFacesIsAMeshUnlessACloudIsAskedFor) {
  const TemporaryDir dir;
  const std::string body = "property float x\nproperty float y\nproperty float z\n";
  const auto mesh = dir.write("mesh.ply", "ply\nformat ascii 1.0\nelement vertex 3\n" + body +
                                              "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                                              "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const auto cloud = dir.write("cloud.ply", "ply\nformat ascii 1.0\nelement vertex 1\n" + body +
                                                "element face 0\nproperty list uchar int vertex_indices\nend_header\n"
                                                "0 0 0\n");
  EXPECT_TRUE(tufted::read(mesh).is_mesh);
  EXPECT_FALSE(tufted::read(mesh, tufted::ReadAs::cloud).is_mesh);
  EXPECT_EQ(tufted::read(mesh, tufted::ReadAs::cloud).triangles.rows(), 0);
  EXPECT_FALSE(tufted::read(cloud).is_mesh);
}

TEST(Ply, AnOrganizedCloudKeepsItsSize) {
  const TemporaryDir dir;
  const auto path = dir.write("a.ply",
                              "ply\r\nformat ascii 1.0\r\nobj_info num_cols 2\r\nobj_info num_rows 1\r\n"
                              "element vertex 2\r\nproperty float x\r\nproperty float y\r\nproperty float z\r\n"
                              "end_header\r\nnan nan nan\r\n1 2 3\r\n");
  const auto geometry = tufted::read(path);
  EXPECT_EQ(geometry.width, 2);
  EXPECT_TRUE(std::isnan(geometry.points(0, 0)));
  EXPECT_EQ(geometry.points(1, 2), 3);
}

}  // namespace
}  // namespace ply_test
