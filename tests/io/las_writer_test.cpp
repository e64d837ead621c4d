#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "../support/refusal.h"
#include "field_values.h"
#include "las_file.h"
#include "temporary_dir.h"
#include "tufted/errors.h"
#include "tufted/io/head.h"
#include "tufted/io/results.h"

// The places of values are those of ASPRS, LAS Specification 1.4 R15: Table 3 (header), 7 (records), 24 (extra bytes).
namespace las_writer_test {
namespace {

using tufted::Format;

class LasOutput : public testing::Test {
 protected:
  /// The bytes of points.las.
  std::string written(const tufted::Geometry& geometry, const std::vector<tufted::ResultArray>& arrays = {}) {
    tufted::writeResults(dir_.path(), tufted::Laplacian(), geometry, arrays, {.copies = {Format::las}});
    return readAll(dir_ / "points.las");
  }

  std::string refusal(const tufted::Geometry& geometry, const std::vector<tufted::ResultArray>& arrays = {}) {
    return tufted::support::refusal([&] { written(geometry, arrays); });
  }

  TemporaryDir dir_;
};

template <class T>
T at(const std::string& bytes, std::size_t byte) {
  T value;
  std::memcpy(&value, bytes.data() + byte, sizeof(T));
  return value;
}

tufted::Geometry parse(const std::string& bytes) {
  return tufted::parse(bytes, "points.las");
}

/// A file of `count` points whose bytes behind the coordinates are random.
LasFile randomFile(int format, int count) {
  LasFile file(format < 6 ? 2 : 4, format);
  file.addRecord("LASF_Projection", 34735, "keys of the reference system");
  std::mt19937_64 random(static_cast<std::uint64_t>(format + 1));
  for (int i = 0; i < count; ++i) {
    const std::size_t point = file.addPoint(100 * i, -i, 7 * i);
    for (std::size_t byte = 12; byte < las_format_bytes[format]; ++byte)
      file.set(point + byte, static_cast<char>(random()));
  }
  return file;
}

tufted::Geometry twoPoints() {
  tufted::Geometry geometry;
  geometry.points.resize(2, 3);
  geometry.points << 500000.125, 5400000.25, -3, 500400.0625, 5400100, 17.7;
  geometry.width = 2;
  return geometry;
}

TEST_F(LasOutput, EveryPointFormatKeepsItsRecordsToTheByte) {
  constexpr int without_waves[] = {0, 1, 2, 3, 1, 3, 6, 7, 8, 6, 8};
  for (int format = 0; format <= 10; ++format) {
    const LasFile file = randomFile(format, 20);
    const int kept = without_waves[format];
    const std::string bytes = written(parse(file.bytes()));
    ASSERT_EQ(at<std::uint8_t>(bytes, 104), kept);
    const std::size_t from = at<std::uint32_t>(file.bytes(), 96), to = at<std::uint32_t>(bytes, 96);
    const std::size_t row = at<std::uint16_t>(bytes, 105);
    for (std::size_t i = 0; i < 20; ++i)
      EXPECT_EQ(file.bytes().substr(from + i * las_format_bytes[format], las_format_bytes[kept]),
                bytes.substr(to + i * row, las_format_bytes[kept]))
          << format << " point " << i;
    EXPECT_EQ(bytes.size(), to + 20 * row);
  }
}

TEST_F(LasOutput, TheHeaderCountsAndBoundsThePoints) {
  LasFile file = randomFile(1, 0);
  file.set<std::uint16_t>(6, 1);  // GPS time is adjusted standard time
  for (int i = 0; i < 5; ++i) file.set<std::uint8_t>(file.addPoint(10 * i, -i, 3) + 14, i < 3 ? 0b010'001 : 0b010'010);
  const std::string bytes = written(parse(file.bytes()));
  EXPECT_EQ(bytes.substr(0, 4), "LASF");
  EXPECT_EQ(at<std::uint16_t>(bytes, 6), 1);
  EXPECT_EQ(at<std::uint8_t>(bytes, 24), 1);
  EXPECT_EQ(at<std::uint8_t>(bytes, 25), 4);
  EXPECT_EQ(bytes.substr(58, 7), "Tufted ");
  EXPECT_EQ(at<std::uint16_t>(bytes, 94), 375);
  EXPECT_EQ(at<std::uint32_t>(bytes, 107), 5u);
  EXPECT_EQ(at<std::uint32_t>(bytes, 111), 3u);
  EXPECT_EQ(at<std::uint32_t>(bytes, 115), 2u);
  EXPECT_EQ(at<std::uint64_t>(bytes, 247), 5u);
  EXPECT_EQ(at<std::uint64_t>(bytes, 255), 3u);
  EXPECT_EQ(at<std::uint64_t>(bytes, 263), 2u);
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(at<double>(bytes, 131 + 8 * c), at<double>(file.bytes(), 131 + 8 * c));
    EXPECT_EQ(at<double>(bytes, 155 + 8 * c), at<double>(file.bytes(), 155 + 8 * c));
  }
  EXPECT_EQ(at<double>(bytes, 179), 40 * 0.01 + 500000);
  EXPECT_EQ(at<double>(bytes, 187), 500000);
  EXPECT_EQ(at<double>(bytes, 203), -4 * 0.01 + 5400000);
  EXPECT_EQ(at<std::uint32_t>(written(parse(randomFile(6, 3).bytes())), 107), 0u);  // as formats 6 to 10 must have it
}

TEST_F(LasOutput, ResultsAreExtraBytesAndRecordsOfTheInputStay) {
  LasFile file(4, 6, 2);
  file.addRecord("LASF_Projection", 2112, "PROJCS[\"somewhere\"]");
  file.describe("height", 3, 0.01, 5);
  for (int i = 0; i < 2; ++i) file.set<std::uint16_t>(file.addPoint(i, 2, 3) + 30, static_cast<std::uint16_t>(200 + i));
  file.addLaterRecord("later", 9, "kept, too");
  file.addLaterRecord("LASF_Spec", 65535, "waves");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const tufted::ResultArray distance = {"distance", Eigen::Vector2d(0.5, nan)};
  const tufted::ResultArray pair = {"pair", Eigen::Matrix2d::Constant(3)};
  const std::string bytes = written(parse(file.bytes()), {distance, pair});

  ASSERT_EQ(at<std::uint32_t>(bytes, 100), 3u);
  EXPECT_EQ(bytes.substr(375, 54 + 19), file.bytes().substr(375, 54 + 19));
  const std::size_t later = 375 + 54 + 19;
  EXPECT_EQ(bytes.substr(later + 2, 5), "later");
  EXPECT_EQ(at<std::uint16_t>(bytes, later + 18), 9);
  EXPECT_EQ(bytes.substr(later + 54, 9), "kept, too");
  const std::size_t extra = later + 54 + 9;
  EXPECT_EQ(bytes.substr(extra + 2, 10), std::string("LASF_Spec\0", 10));
  EXPECT_EQ(at<std::uint16_t>(bytes, extra + 18), 4);
  ASSERT_EQ(at<std::uint16_t>(bytes, extra + 20), 4 * 192);
  const char* const names[] = {"height", "distance", "pair_0", "pair_1"};
  for (std::size_t e = 0; e < 4; ++e) {
    const std::size_t place = extra + 54 + 192 * e;
    EXPECT_EQ(at<std::uint8_t>(bytes, place + 2), e == 0 ? 10 : 9);  // double, float
    EXPECT_EQ(at<std::uint8_t>(bytes, place + 3), 1);                // only no_data is set
    EXPECT_STREQ(bytes.substr(place + 4, 32).c_str(), names[e]);
    EXPECT_TRUE(std::isnan(at<double>(bytes, place + 40)));
  }
  const std::size_t points = at<std::uint32_t>(bytes, 96);
  EXPECT_EQ(points, extra + 54 + 4 * 192);
  ASSERT_EQ(at<std::uint16_t>(bytes, 105), 30 + 8 + 4 + 4 + 4);
  EXPECT_EQ(at<double>(bytes, points + 30), 200 * 0.01 + 5);
  EXPECT_EQ(at<float>(bytes, points + 38), 0.5f);
  EXPECT_TRUE(std::isnan(at<float>(bytes, points + 50 + 38)));

  const tufted::Geometry read = parse(bytes);
  EXPECT_EQ(read.points, parse(file.bytes()).points);
  EXPECT_EQ(valuesOf<float>(*fieldNamed(read, "pair_1")), (std::vector<float>{3, 3}));
  EXPECT_EQ(written(read), bytes);
}

TEST_F(LasOutput, OtherPointsAreStoredToAHundredMillionthOfTheirExtent) {
  tufted::Geometry geometry = twoPoints();
  for (const char* name : {"red", "green", "blue"})
    geometry.fields.push_back({name, tufted::FieldType::uint8, 1, {std::byte(1), std::byte(255)}});
  const std::string bytes = written(geometry);
  EXPECT_LE((parse(bytes).points - geometry.points).cwiseAbs().maxCoeff(), 400e-9);
  EXPECT_EQ(at<std::uint16_t>(bytes, 6), 16);  // formats 6 to 10 must say that the reference system is text
  EXPECT_EQ(at<std::uint8_t>(bytes, 104), 7);
  const std::size_t point = at<std::uint32_t>(bytes, 96);
  EXPECT_EQ(at<std::uint8_t>(bytes, point + 14), 0x11);  // the first of one return
  EXPECT_EQ(at<std::uint16_t>(bytes, point + 30), 0x0101);
  EXPECT_EQ(at<std::uint16_t>(bytes, point + 36 + 34), 0xffff);
  EXPECT_EQ(at<std::uint64_t>(bytes, 255), 2u);
}

TEST_F(LasOutput, APlaceFarFromWholeNumbersHasAFineScaleToo) {
  for (const double extent : {1e-9, 2.0, 1e9, 1e-320, 1e300}) {
    tufted::Geometry geometry = twoPoints();
    const double place = extent < 1e200 ? 0.4 : 0;
    geometry.points << place, place, place, place + extent, place, place;
    const Eigen::RowVector3d found = parse(written(geometry)).points.row(1) - parse(written(geometry)).points.row(0);
    EXPECT_NEAR(found[0], geometry.points(1, 0) - geometry.points(0, 0), 1e-8 * extent + 1e-308) << extent;
  }
}

TEST_F(LasOutput, AFieldNamedAsAnItemOfAnotherTypeComesBackAsItWas) {
  tufted::Geometry geometry = twoPoints();
  const float values[] = {0.25F, 1.5F};
  const auto* const bytes = reinterpret_cast<const std::byte*>(values);
  geometry.fields.push_back({"intensity", tufted::FieldType::float32, 1, {bytes, bytes + sizeof(values)}});
  const tufted::Geometry read = parse(written(geometry));
  int count = 0;
  for (const tufted::Field& field : read.fields) {
    if (field.name != "intensity") continue;
    ++count;
    EXPECT_EQ(field.type, tufted::FieldType::float32);
    EXPECT_EQ(field.bytes, geometry.fields[0].bytes);
  }
  EXPECT_EQ(count, 1);
}

TEST_F(LasOutput, WhatLasCannotHoldIsRefused) {
  tufted::Geometry geometry = twoPoints();
  EXPECT_NE(refusal(geometry, {{"many", Eigen::MatrixXd::Zero(2, 342)}}).find("342 values per point"),
            std::string::npos);
  geometry.points(1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal(geometry).find("point 1 at"), std::string::npos) << refusal(geometry);
  tufted::Geometry moved = parse(randomFile(0, 2).bytes());
  moved.points(0, 0) += 1e9;
  EXPECT_NE(refusal(moved).find("out of the range"), std::string::npos) << refusal(moved);
}

TEST_F(LasOutput, RoomForResultsIsCheckedWithoutThem) {
  tufted::Geometry geometry;
  geometry.points = tufted::Points::Zero(2, 3);
  geometry.fields = {{"Intensity of it", tufted::FieldType::float32, 1, std::vector<std::byte>(8)}};
  tufted::Laplacian laplacian;  // it takes seven values: mass, boundary, status, representative and a normal
  laplacian.status.resize(2);
  laplacian.representative = {0, 1};
  laplacian.boundary.resize(2);
  laplacian.M = tufted::VectorXd::Zero(2);
  laplacian.frames.normals = tufted::Points::Zero(2, 3);
  for (const int columns : {333, 334}) {  // with the others 341 and 342
    const std::vector<tufted::ResultArray> arrays = {{"values", Eigen::MatrixXd::Zero(2, columns)}};
    const auto write = [&] {
      tufted::writeResults(dir_.path(), laplacian, geometry, arrays, {.copies = {Format::las}});
    };
    if (columns == 333) {
      EXPECT_NO_THROW(write());
      EXPECT_NO_THROW(tufted::checkLas(geometry, arrays));
    } else {
      EXPECT_THROW(write(), tufted::InvalidInput);
      EXPECT_THROW(tufted::checkLas(geometry, arrays), tufted::InvalidInput);
    }
  }
  EXPECT_NO_THROW(tufted::checkLas(tufted::Geometry()));
}

TEST_F(LasOutput, LongNamesAreCutAndNoPointsAreFine) {
  const std::string name(40, 'n');
  EXPECT_NE(fieldNamed(parse(written(twoPoints(), {{name, Eigen::Vector2d::Zero()}})), name.substr(0, 32)), nullptr);
  const tufted::Geometry alike =
      parse(written(twoPoints(), {{name + "a", Eigen::Vector2d::Zero()}, {name + "b", Eigen::Vector2d::Ones()}}));
  EXPECT_NE(fieldNamed(alike, name.substr(0, 32)), nullptr);
  EXPECT_NE(fieldNamed(alike, name.substr(0, 30) + "_2"), nullptr);
  EXPECT_EQ(parse(written(tufted::Geometry())).points.rows(), 0);
}

TEST_F(LasOutput, AFolderOfAResultRemembersTheHeader) {
  const tufted::Geometry geometry = parse(randomFile(3, 4).bytes());
  tufted::writeResults(dir_.path(), tufted::Laplacian(), geometry, {}, {.copies = {Format::ply, Format::las}});
  EXPECT_EQ(tufted::readPoints(dir_.path()).las_header, parse(readAll(dir_ / "points.las")).las_header);
  tufted::writeResults(dir_.path(), tufted::Laplacian(), geometry, {}, {.copies = {Format::las}});
  EXPECT_EQ(tufted::readPoints(dir_.path()).points, geometry.points);
}

TEST_F(LasOutput, TheHeadTellsWhatReadingTells) {
  LasFile file(4, 6, 2);
  file.describe("height", 3, 0.01, 5);
  file.addPoint(1, 2, 3);
  const auto path = dir_.write("a.las", file.bytes());
  const auto head = tufted::readHead(path);
  const tufted::Geometry whole = tufted::read(path);
  ASSERT_TRUE(head.has_value());
  EXPECT_EQ(head->points, 1);
  EXPECT_EQ(head->geometry.format, whole.format);
  EXPECT_EQ(head->geometry.las_header, whole.las_header);
  ASSERT_EQ(head->geometry.fields.size(), whole.fields.size());
  for (std::size_t f = 0; f < whole.fields.size(); ++f) {
    EXPECT_EQ(head->geometry.fields[f].name, whole.fields[f].name);
    EXPECT_EQ(head->geometry.fields[f].type, whole.fields[f].type);
  }
}

TEST_F(LasOutput, HeadsOfPlyAndPcdCountPointsAndFaces) {
  const auto ply = dir_.write("a.ply",
                              "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                              "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
                              "property uchar label\nelement face 1\nproperty list uchar int vertex_indices\n"
                              "end_header\n0 0 0 0 0 1 5\n1 0 0 0 0 1 5\n0 1 0 0 0 1 5\n3 0 1 2\n");
  const auto head = tufted::readHead(ply);
  ASSERT_TRUE(head.has_value());
  EXPECT_EQ(head->points, 3);
  EXPECT_EQ(head->faces, 1);
  EXPECT_TRUE(head->has_normals);
  ASSERT_EQ(head->geometry.fields.size(), 1u);
  EXPECT_EQ(head->geometry.fields[0].name, "label");
  EXPECT_EQ(tufted::readHead(ply, tufted::ReadAs::cloud)->faces, 0);
  const auto pcd = dir_.write("a.pcd",
                              "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 3\n"
                              "VIEWPOINT 1 2 3 1 0 0 0\nPOINTS 6\nDATA binary\n" +
                                  std::string(72, '\0'));
  EXPECT_EQ(tufted::readHead(pcd)->geometry.height, 3);
  EXPECT_EQ(tufted::readHead(pcd)->geometry.format, "PCD, binary");
  EXPECT_FALSE(tufted::readHead(dir_.write("a.xyz", "0 0 0\n")).has_value());
  EXPECT_FALSE(tufted::readHead(dir_ / "missing.las").has_value());
  EXPECT_FALSE(tufted::readHead(dir_.path()).has_value());
  EXPECT_THROW(tufted::readHead(dir_.write("bad.las", "LASF")), tufted::IoError);
}

}  // namespace
}  // namespace las_writer_test
