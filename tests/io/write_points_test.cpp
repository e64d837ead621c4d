#include <CGAL/IO/read_ply_points.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/property_map.h>
#include <gtest/gtest.h>
#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <utility>

#include "field_values.h"
#include "sample_laplacian.h"
#include "temporary_dir.h"
#include "tufted/errors.h"
#include "tufted/io/results.h"
#include "tufted/io/write.h"

namespace write_points_test {
namespace {

using tufted::FieldType;
using tufted::Format;

const tufted::WriteOptions both = {.formats = {Format::ply, Format::pcd}};

tufted::Field bytesField(const char* name, std::initializer_list<int> values) {
  tufted::Field field = {name, FieldType::uint8, 1, {}};
  for (const int value : values) field.bytes.push_back(static_cast<std::byte>(value));
  return field;
}

/// The sample as a cloud near the origin: every coordinate is a float.
tufted::Geometry nearby() {
  tufted::Geometry geometry = sampleGeometry();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  geometry.points << 0.25, 0, 0, 2.25, 0, 0, 0.25, 2, -8, nan, nan, nan;
  geometry.is_mesh = false;
  geometry.triangles.resize(0, 3);
  return geometry;
}

tufted::Laplacian withNormals(double z = 0.8) {
  tufted::Laplacian laplacian = sampleLaplacian();
  laplacian.frames.normals.resize(4, 3);
  laplacian.frames.normals.rowwise() = Eigen::RowVector3d(0.6, 0, z);
  return laplacian;
}

template <class Point>
pcl::PointCloud<Point> readWithPcl(const std::filesystem::path& path) {
  pcl::PCLPointCloud2 blob;
  const int code = path.extension() == ".pcd" ? pcl::PCDReader().read(path.string(), blob)
                                              : pcl::PLYReader().read(path.string(), blob);
  EXPECT_EQ(code, 0) << path;
  pcl::PointCloud<Point> cloud;
  pcl::fromPCLPointCloud2(blob, cloud);
  return cloud;
}

class PointsFile : public testing::TestWithParam<const char*> {
 protected:
  std::filesystem::path write(const tufted::Laplacian& laplacian, const tufted::Geometry& geometry) {
    tufted::writeLaplacian(dir_ / "out", laplacian, geometry, both);
    return dir_ / "out" / GetParam();
  }
  TemporaryDir dir_;
};

INSTANTIATE_TEST_SUITE_P(All, PointsFile, testing::Values("points.ply", "points.pcd"));

TEST_P(PointsFile, DoublesAtUtmCoordinatesAreReadAgainBitForBit) {
  const auto geometry = sampleGeometry();
  const auto laplacian = sampleLaplacian();
  const auto again = tufted::read(write(laplacian, geometry));
  EXPECT_EQ(again.points.topRows(3), geometry.points.topRows(3));
  EXPECT_TRUE(std::isnan(again.points(3, 0)) && std::isnan(again.points(3, 1)) && std::isnan(again.points(3, 2)));
  for (const char* name : {"mass", "status", "boundary", "representative", "intensity"})
    ASSERT_NE(fieldNamed(again, name), nullptr) << name;
  EXPECT_EQ(valuesOf<double>(*fieldNamed(again, "mass")), (std::vector<double>{2.0 / 3, 2.0 / 3, 2.0 / 3, 0}));
  EXPECT_EQ(valuesOf<std::uint8_t>(*fieldNamed(again, "status")), (std::vector<std::uint8_t>{0, 0, 0, 1}));
  EXPECT_EQ(valuesOf<std::uint8_t>(*fieldNamed(again, "boundary")), (std::vector<std::uint8_t>{1, 2, 3, 0}));
  EXPECT_EQ(valuesOf<std::int32_t>(*fieldNamed(again, "representative")), (std::vector<std::int32_t>{0, 1, 2, 3}));
  EXPECT_EQ(valuesOf<float>(*fieldNamed(again, "intensity")), (std::vector<float>{0.1f, 0.2f, 0.3f, 0.4f}));
}

TEST_P(PointsFile, PclConvertsFloatsToItsPointsWithNormalsAndColours) {
  const auto geometry = nearby();
  const auto cloud = readWithPcl<pcl::PointXYZRGBNormal>(write(withNormals(), geometry));
  ASSERT_EQ(cloud.size(), 4u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(cloud[i].x, geometry.points(i, 0));
    EXPECT_EQ(cloud[i].y, geometry.points(i, 1));
    EXPECT_EQ(cloud[i].z, geometry.points(i, 2));
    EXPECT_EQ(cloud[i].normal_x, 0.6f);
    EXPECT_EQ(cloud[i].normal_z, 0.8f);
  }
  EXPECT_TRUE(std::isnan(cloud[3].x));
  EXPECT_EQ(cloud[0].r, 10);
  EXPECT_EQ(cloud[0].g, 20);
  EXPECT_EQ(cloud[0].b, 30);
}

TEST_P(PointsFile, PclFindsTheColoursOfAPly) {
  tufted::Geometry geometry = nearby();
  geometry.fields = {bytesField("red", {1, 2, 3, 4}), bytesField("green", {11, 12, 13, 14}),
                     bytesField("blue", {21, 22, 23, 24})};
  const auto cloud = readWithPcl<pcl::PointXYZRGB>(write(sampleLaplacian(), geometry));
  ASSERT_EQ(cloud.size(), 4u);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(cloud[i].r, 1 + i);
    EXPECT_EQ(cloud[i].g, 11 + i);
    EXPECT_EQ(cloud[i].b, 21 + i);
  }
}

TEST_P(PointsFile, TransparencyStays) {
  tufted::Geometry geometry = nearby();
  geometry.fields = {bytesField("red", {1, 1, 1, 1}), bytesField("green", {2, 2, 2, 2}),
                     bytesField("blue", {3, 3, 3, 3}), bytesField("alpha", {5, 6, 7, 8})};
  const auto cloud = readWithPcl<pcl::PointXYZRGBA>(write(sampleLaplacian(), geometry));
  ASSERT_EQ(cloud.size(), 4u);
  EXPECT_EQ(cloud[3].a, 8);
  EXPECT_EQ(cloud[3].r, 1);
  EXPECT_EQ(cloud[3].b, 3);
}

TEST_P(PointsFile, NormalsOfTheFileArePassedOnWithoutLoss) {
  tufted::Geometry geometry = nearby();
  geometry.normals.resize(4, 3);
  geometry.normals.rowwise() = Eigen::RowVector3d(0.6, 0, 0.8);  // no floats
  const auto again = tufted::read(write(withNormals(-0.8), geometry));
  EXPECT_EQ(again.normals, geometry.normals);
}

TEST_P(PointsFile, AnOrganizedCloudKeepsItsSizeForUsAndForPcl) {
  tufted::Geometry geometry = nearby();
  geometry.width = geometry.height = 2;
  const auto path = write(sampleLaplacian(), geometry);
  const auto again = tufted::read(path);
  EXPECT_EQ(again.width, 2);
  EXPECT_EQ(again.height, 2);
  const auto cloud = readWithPcl<pcl::PointXYZ>(path);
  EXPECT_EQ(cloud.width, 2u);
  EXPECT_EQ(cloud.height, 2u);
}

TEST_P(PointsFile, MassesAreTheDummyOnesWhereThoseAreAskedFor) {
  tufted::WriteOptions options = both;
  options.dummy = true;
  tufted::writeLaplacian(dir_ / "out", sampleLaplacian(), nearby(), options);
  const auto path = dir_ / "out" / GetParam();
  const auto mass = valuesOf<double>(*fieldNamed(tufted::read(path), "mass"));
  EXPECT_EQ(mass[2], 2.0 / 3);
  EXPECT_DOUBLE_EQ(mass[3], 1e-3 * (2.0 / 3));
  EXPECT_NE(readAll(path).find("inactive: points of status other than 0 keep their index; dummy values"),
            std::string::npos);
}

TEST(WritePcd, FieldsStayAsTheyAreStored) {
  const TemporaryDir dir;
  tufted::writeLaplacian(dir / "out", sampleLaplacian(), sampleGeometry(), both);
  const auto again = tufted::read(dir / "out/points.pcd");
  const auto geometry = sampleGeometry();
  for (const tufted::Field& field : geometry.fields) {
    if (field.name == "mass") continue;  // ours
    const tufted::Field* found = fieldNamed(again, field.name);
    ASSERT_NE(found, nullptr) << field.name;
    EXPECT_EQ(found->type, field.type) << field.name;
    EXPECT_EQ(found->count, field.count) << field.name;
    EXPECT_EQ(found->bytes, field.bytes) << field.name;
  }
}

TEST(WritePcd, TheSensorsPoseKeepsItsDoublesAndPclReadsIt) {
  const TemporaryDir dir;
  auto geometry = nearby();
  geometry.viewpoint = {500000.1234567891, 5400000.9876543211, 1.5, 0.6, 0, 0.8, 0};
  tufted::writeLaplacian(dir / "out", sampleLaplacian(), geometry, both);
  const std::string pose = "500000.1234567891 5400000.987654321 1.5 0.6 0 0.8 0\n";
  EXPECT_NE(readAll(dir / "out/points.pcd").find("\nVIEWPOINT " + pose), std::string::npos);
  for (const char* name : {"points.pcd", "points.ply"})
    EXPECT_EQ(tufted::read(dir / "out" / name).viewpoint, geometry.viewpoint) << name;
  pcl::PCLPointCloud2 cloud;
  Eigen::Vector4f origin;
  Eigen::Quaternionf orientation;
  int version = 0;
  ASSERT_EQ(pcl::PCDReader().read((dir / "out/points.pcd").string(), cloud, origin, orientation, version), 0);
  EXPECT_EQ(origin.head<3>(), Eigen::Vector3f(500000.1234567891f, 5400000.987654321f, 1.5f));
  EXPECT_EQ(orientation.coeffs(), Eigen::Vector4f(0, 0.8f, 0, 0.6f));
}

TEST(WritePoints, WhatIsNoPoseIsAMistake) {
  const TemporaryDir dir;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  auto geometry = nearby();
  for (const std::array<double, 7> pose :
       {std::array<double, 7>{nan, 0, 0, 1, 0, 0, 0}, {0, 0, 0, 1, 0, 0, INFINITY}, {1, 2, 3, 0, 0, 0, 0}}) {
    geometry.viewpoint = pose;
    EXPECT_THROW(tufted::writeLaplacian(dir / "out", sampleLaplacian(), geometry, both), tufted::InvalidInput);
    EXPECT_THROW(tufted::writeResults(dir / "out", sampleLaplacian(), geometry, {}), tufted::InvalidInput);
    EXPECT_FALSE(std::filesystem::exists(dir / "out"));
  }
}

TEST(WritePoints, FieldsOfOneNameAreAllKept) {
  const TemporaryDir dir;
  auto geometry = tufted::parse("x,y,z,a,a,nx\n0,0,0,1,2,3\n1,0,0,4,5,6\n0,1,0,7,8,9\n1,1,0,10,11,12\n", "a.csv");
  tufted::Laplacian laplacian = sampleLaplacian();
  laplacian.frames.normals = laplacian.frames.tangents = geometry.points;
  tufted::writeLaplacian(dir / "out", laplacian, geometry, both);
  for (const char* name : {"points.ply", "points.pcd"}) {
    const auto again = tufted::read(dir / "out" / name);
    EXPECT_EQ(again.normals.rows(), 0) << name;  // the computed ones give way to what the input calls nx
    for (const auto& [field, value] : {std::pair("a", 10.0), std::pair("a_2", 11.0), std::pair("nx", 12.0)}) {
      ASSERT_NE(fieldNamed(again, field), nullptr) << name << ' ' << field;
      EXPECT_EQ(valuesOf<double>(*fieldNamed(again, field))[3], value);
    }
  }
}

TEST(WritePcd, PclReadsDoublesAtUtmCoordinatesByteForByte) {
  const TemporaryDir dir;
  const auto geometry = sampleGeometry();
  tufted::writeLaplacian(dir / "out", sampleLaplacian(), geometry, both);
  pcl::PCLPointCloud2 cloud;
  ASSERT_EQ(pcl::PCDReader().read((dir / "out/points.pcd").string(), cloud), 0);
  ASSERT_EQ(cloud.width * cloud.height, 4u);
  for (const int axis : {0, 1, 2}) {
    const pcl::PCLPointField& field = cloud.fields.at(axis);
    EXPECT_EQ(field.name, std::string(1, static_cast<char>('x' + axis)));
    ASSERT_EQ(field.datatype, pcl::PCLPointField::FLOAT64);
    for (int i = 0; i < 4; ++i) {
      const auto* const value = &cloud.data.at(i * cloud.point_step + field.offset);
      EXPECT_EQ(std::memcmp(value, &geometry.points(i, axis), sizeof(double)), 0) << field.name << " of " << i;
    }
  }
}

using CgalKernel = CGAL::Simple_cartesian<double>;
using CgalPoint = std::pair<CgalKernel::Point_3, CgalKernel::Vector_3>;

/// Points and normals.
std::vector<CgalPoint> readWithCgal(const std::filesystem::path& path) {
  std::vector<CgalPoint> points;
  EXPECT_TRUE(CGAL::IO::read_PLY(path.string(), std::back_inserter(points),
                                 CGAL::parameters::point_map(CGAL::First_of_pair_property_map<CgalPoint>())
                                     .normal_map(CGAL::Second_of_pair_property_map<CgalPoint>())));
  return points;
}

TEST(WritePly, CgalReadsFloatsAndNormals) {
  const TemporaryDir dir;
  tufted::Geometry geometry = nearby();
  geometry.points.row(3) << 1, 2, 3;
  tufted::Laplacian laplacian = sampleLaplacian();
  laplacian.frames.normals.resize(4, 3);
  laplacian.frames.normals << 0.6, 0, 0.8, 0, -1, 0, 0, 0.6, -0.8, 1, 0, 0;
  tufted::writeLaplacian(dir / "out", laplacian, geometry, both);
  const auto points = readWithCgal(dir / "out/points.ply");
  ASSERT_EQ(points.size(), 4u);
  for (int i = 0; i < 4; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(points[i].first[axis], geometry.points(i, axis)) << i;
      EXPECT_EQ(points[i].second[axis], static_cast<float>(laplacian.frames.normals(i, axis))) << i;
    }
  }
}

TEST(WritePly, CgalReadsDoublesAtUtmCoordinatesBitForBit) {
  const TemporaryDir dir;
  auto geometry = sampleGeometry();
  geometry.points.row(3) << 1, 2, 3;
  tufted::writeLaplacian(dir / "out", sampleLaplacian(), geometry, both);
  const auto points = readWithCgal(dir / "out/points.ply");
  ASSERT_EQ(points.size(), 4u);
  for (int i = 0; i < 4; ++i) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(points[i].first[axis], geometry.points(i, axis)) << i;
  }
}

TEST(WriteLaplacian, AFieldWithoutAProperNameIsTheCallersMistake) {
  const TemporaryDir dir;
  for (const char* name : {"", "two words", "line\nend_header"}) {
    tufted::Geometry geometry = nearby();
    geometry.fields = {bytesField(name, {1, 2, 3, 4})};
    EXPECT_THROW(tufted::writeLaplacian(dir / "out", sampleLaplacian(), geometry), tufted::InvalidInput) << name;
  }
  tufted::Geometry geometry = nearby();
  geometry.width = 3;
  geometry.height = 2;
  EXPECT_THROW(tufted::writeLaplacian(dir / "out", sampleLaplacian(), geometry), tufted::InvalidInput);
  EXPECT_FALSE(std::filesystem::exists(dir / "out"));
}

}  // namespace
}  // namespace write_points_test
