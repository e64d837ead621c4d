#include <gtest/gtest.h>
#include <pcl/PCLPointCloud2.h>
#include <pcl/io/pcd_io.h>

#include <cmath>
#include <limits>

#include "field_values.h"
#include "temporary_dir.h"
#include "tufted/io/read.h"

namespace pcd_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Packed as in a binary file. EXPECT_EQ would bind references to its members, `+` copies them.
#pragma pack(push, 1)
struct SurveyPoint {
  double x, y, z;
  float intensity;
  std::uint16_t ring;
  std::int32_t label;
};
#pragma pack(pop)

/// Six points in UTM coordinates, organized as 3 x 2, the fifth of them missing.
std::vector<SurveyPoint> survey() {
  std::vector<SurveyPoint> points;
  for (int i = 0; i < 6; ++i)
    points.push_back({500000.1234567891 + i * 1e-9, 5400000.9876543211 - i, 0.1 * i, 0.3f + static_cast<float>(i),
                      static_cast<std::uint16_t>(65530 + i), -7 * i});
  points[4].x = points[4].y = points[4].z = nan;
  return points;
}

pcl::PCLPointCloud2 toPcl(const std::vector<SurveyPoint>& points) {
  pcl::PCLPointCloud2 cloud;
  const auto add = [&](const char* name, std::size_t offset, std::uint8_t type) {
    pcl::PCLPointField field;
    field.name = name;
    field.offset = static_cast<std::uint32_t>(offset);
    field.datatype = type;
    field.count = 1;
    cloud.fields.push_back(field);
  };
  add("x", offsetof(SurveyPoint, x), pcl::PCLPointField::FLOAT64);
  add("y", offsetof(SurveyPoint, y), pcl::PCLPointField::FLOAT64);
  add("z", offsetof(SurveyPoint, z), pcl::PCLPointField::FLOAT64);
  add("intensity", offsetof(SurveyPoint, intensity), pcl::PCLPointField::FLOAT32);
  add("ring", offsetof(SurveyPoint, ring), pcl::PCLPointField::UINT16);
  add("label", offsetof(SurveyPoint, label), pcl::PCLPointField::INT32);
  cloud.width = 3;
  cloud.height = 2;
  cloud.point_step = sizeof(SurveyPoint);
  cloud.row_step = 3 * sizeof(SurveyPoint);
  cloud.data.resize(points.size() * sizeof(SurveyPoint));
  std::memcpy(cloud.data.data(), points.data(), cloud.data.size());
  return cloud;
}

enum class Encoding { ascii, binary, compressed };

class PcdEncoding : public testing::TestWithParam<Encoding> {
 protected:
  std::filesystem::path write(const pcl::PCLPointCloud2& cloud) {
    const auto path = dir_ / "cloud.pcd";
    pcl::PCDWriter writer;
    const Eigen::Vector4f origin = Eigen::Vector4f::Zero();
    const Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();
    if (GetParam() == Encoding::ascii) writer.writeASCII(path.string(), cloud, origin, orientation, 17);
    if (GetParam() == Encoding::binary) writer.writeBinary(path.string(), cloud, origin, orientation);
    if (GetParam() == Encoding::compressed) writer.writeBinaryCompressed(path.string(), cloud, origin, orientation);
    return path;
  }

  TemporaryDir dir_;
};

TEST_P(PcdEncoding, KeepsDoublesAtUtmCoordinates) {
  const auto points = survey();
  const auto geometry = tufted::read(write(toPcl(points)));
  ASSERT_EQ(geometry.points.rows(), 6);
  for (int i = 0; i < 6; ++i) {
    if (i == 4) continue;
    EXPECT_EQ(geometry.points(i, 0), +points[i].x);
    EXPECT_EQ(geometry.points(i, 1), +points[i].y);
    EXPECT_EQ(geometry.points(i, 2), +points[i].z);
  }
}

TEST_P(PcdEncoding, KeepsTheIndexOfMissingPointsInAnOrganizedCloud) {
  const auto geometry = tufted::read(write(toPcl(survey())));
  EXPECT_EQ(geometry.width, 3);
  EXPECT_EQ(geometry.height, 2);
  for (int i = 0; i < 6; ++i) EXPECT_EQ(std::isnan(geometry.points(i, 0)), i == 4) << i;
}

TEST_P(PcdEncoding, KeepsFurtherFieldsAsTheyAreStored) {
  const auto points = survey();
  const auto geometry = tufted::read(write(toPcl(points)));
  ASSERT_EQ(geometry.fields.size(), 3u);
  EXPECT_EQ(geometry.fields[0].name, "intensity");
  EXPECT_EQ(geometry.fields[0].type, tufted::FieldType::float32);
  EXPECT_EQ(geometry.fields[1].type, tufted::FieldType::uint16);
  EXPECT_EQ(geometry.fields[2].type, tufted::FieldType::int32);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(valuesOf<float>(geometry.fields[0])[i], +points[i].intensity);
    EXPECT_EQ(valuesOf<std::uint16_t>(geometry.fields[1])[i], +points[i].ring);
    EXPECT_EQ(valuesOf<std::int32_t>(geometry.fields[2])[i], +points[i].label);
  }
  EXPECT_FALSE(geometry.is_mesh);
}

INSTANTIATE_TEST_SUITE_P(All, PcdEncoding, testing::Values(Encoding::ascii, Encoding::binary, Encoding::compressed));

TEST(Pcd, NormalsAreToldFromOtherFieldsAndPaddingIsDropped) {
  const TemporaryDir dir;
  const auto path = dir.write("n.pcd",
                              "VERSION .7\nFIELDS x y z _ normal_x normal_y normal_z curvature\n"
                              "SIZE 4 4 4 1 4 4 4 4\nTYPE F F F U F F F F\nCOUNT 1 1 1 4 1 1 1 1\n"
                              "WIDTH 1\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 1\nDATA ascii\n"
                              "1 2 3 0 0 0 0 0 0 1 0.5\n");
  const auto geometry = tufted::read(path);
  ASSERT_EQ(geometry.normals.rows(), 1);
  EXPECT_EQ(geometry.normals(0, 2), 1);
  ASSERT_EQ(geometry.fields.size(), 1u);
  EXPECT_EQ(geometry.fields[0].name, "curvature");
}

TEST(Pcd, FieldsOfSeveralValuesAndWideIntegersSurviveBinary) {
  const TemporaryDir dir;
  std::string bytes =
      "VERSION .7\nFIELDS x y z t h\nSIZE 4 4 4 8 2\nTYPE I I I U U\nCOUNT 1 1 1 1 3\n"
      "WIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA binary\n";
  for (int i = 0; i < 2; ++i) {
    const std::int32_t position[3] = {10 + i, 20, 30};
    const std::uint64_t time = (std::uint64_t{1} << 62) + 1 + i;
    const std::uint16_t histogram[3] = {1, 2, static_cast<std::uint16_t>(3 + i)};
    bytes.append(reinterpret_cast<const char*>(position), sizeof(position));
    bytes.append(reinterpret_cast<const char*>(&time), sizeof(time));
    bytes.append(reinterpret_cast<const char*>(histogram), sizeof(histogram));
  }
  const auto geometry = tufted::read(dir.write("wide.pcd", bytes));
  EXPECT_EQ(geometry.points(1, 0), 11);
  ASSERT_NE(fieldNamed(geometry, "t"), nullptr);
  EXPECT_EQ(valuesOf<std::uint64_t>(*fieldNamed(geometry, "t"))[1], (std::uint64_t{1} << 62) + 2);
  ASSERT_NE(fieldNamed(geometry, "h"), nullptr);
  EXPECT_EQ(fieldNamed(geometry, "h")->count, 3);
  EXPECT_EQ(valuesOf<std::uint16_t>(*fieldNamed(geometry, "h")), (std::vector<std::uint16_t>{1, 2, 3, 1, 2, 4}));
}

TEST(Pcd, TheViewpointIsKept) {
  const auto geometry =
      tufted::parse("FIELDS x y z\nVIEWPOINT 1 2 3 0.5 0.5 -0.5 0.5\nPOINTS 1\nDATA ascii\n1 2 3\n", "a.pcd");
  EXPECT_EQ(geometry.viewpoint, (std::array<double, 7>{1, 2, 3, 0.5, 0.5, -0.5, 0.5}));
  const auto silent = tufted::parse("FIELDS x y z\nPOINTS 1\nDATA ascii\n1 2 3\n", "a.pcd");
  EXPECT_EQ(silent.viewpoint, (std::array<double, 7>{0, 0, 0, 1, 0, 0, 0}));
}

}  // namespace
}  // namespace pcd_test
