#include <gtest/gtest.h>

#include "../support/refusal.h"
#include "field_values.h"
#include "las_file.h"
#include "temporary_dir.h"
#include "tufted/errors.h"
#include "tufted/io/read.h"

namespace las_test {
namespace {

tufted::Geometry parse(const LasFile& file) {
  return tufted::parse(file.bytes(), "a.las");
}

std::string refusal(const LasFile& file) {
  return tufted::support::refusal<tufted::IoError>([&] { parse(file); });
}

template <class T>
T first(const tufted::Geometry& geometry, const char* name) {
  const tufted::Field* const field = fieldNamed(geometry, name);
  return field ? valuesOf<T>(*field)[0] : throw std::runtime_error(name);
}

TEST(Las, ScaleAndOffsetAreAppliedInDouble) {
  LasFile file(2, 0);
  file.addPoint(12, -34, 5678);
  file.addPoint(2147483647, 0, -2147483647);
  const auto geometry = parse(file);
  EXPECT_EQ(geometry.format, "LAS 1.2, point format 0");
  ASSERT_EQ(geometry.points.rows(), 2);
  EXPECT_EQ(geometry.points.row(0), Eigen::RowVector3d(12 * 0.01 + 500000, -34 * 0.01 + 5400000, 5678 * 0.001 - 100));
  EXPECT_EQ(geometry.points(1, 0), 2147483647 * 0.01 + 500000);
  EXPECT_FALSE(geometry.is_mesh);
  EXPECT_EQ(geometry.width, 2);
}

TEST(Las, BitsOfTheFirstFormatsAreToldApart) {
  LasFile file(2, 1);
  const std::size_t point = file.addPoint(1, 2, 3);
  file.set<std::uint16_t>(point + 12, 777);
  file.set<std::uint8_t>(point + 14, 0b01'011'010);  // forward, 3 returns, the second
  file.set<std::uint8_t>(point + 15, 0b101'00110);   // withheld, synthetic, class 6
  file.set<std::int8_t>(point + 16, -15);
  file.set<std::uint16_t>(point + 18, 65535);
  file.set<double>(point + 20, 1234.5);
  const auto geometry = parse(file);
  EXPECT_EQ(first<std::uint16_t>(geometry, "intensity"), 777);
  EXPECT_EQ(first<std::uint8_t>(geometry, "return_number"), 2);
  EXPECT_EQ(first<std::uint8_t>(geometry, "number_of_returns"), 3);
  EXPECT_EQ(first<std::uint8_t>(geometry, "scan_direction"), 1);
  EXPECT_EQ(first<std::uint8_t>(geometry, "edge_of_flight_line"), 0);
  EXPECT_EQ(first<std::uint8_t>(geometry, "classification"), 6);
  EXPECT_EQ(first<std::uint8_t>(geometry, "synthetic"), 1);
  EXPECT_EQ(first<std::uint8_t>(geometry, "key_point"), 0);
  EXPECT_EQ(first<std::uint8_t>(geometry, "withheld"), 1);
  EXPECT_EQ(first<std::int8_t>(geometry, "scan_angle_rank"), -15);
  EXPECT_EQ(first<std::uint16_t>(geometry, "point_source_id"), 65535);
  EXPECT_EQ(first<double>(geometry, "gps_time"), 1234.5);
}

TEST(Las, BitsOfTheLaterFormatsAreToldApart) {
  LasFile file(4, 8);
  const std::size_t point = file.addPoint(1, 2, 3);
  file.set<std::uint8_t>(point + 14, 0x5f);          // 5 returns, the fifteenth
  file.set<std::uint8_t>(point + 15, 0b10'01'1010);  // edge, channel 1, overlap, key point
  file.set<std::uint8_t>(point + 16, 200);
  file.set<std::int16_t>(point + 18, -3000);
  file.set<double>(point + 22, 1e9);
  file.set<std::uint16_t>(point + 30, 1);
  file.set<std::uint16_t>(point + 34, 3);
  file.set<std::uint16_t>(point + 36, 4);
  const auto geometry = parse(file);
  EXPECT_EQ(first<std::uint8_t>(geometry, "return_number"), 15);
  EXPECT_EQ(first<std::uint8_t>(geometry, "number_of_returns"), 5);
  EXPECT_EQ(first<std::uint8_t>(geometry, "synthetic"), 0);
  EXPECT_EQ(first<std::uint8_t>(geometry, "key_point"), 1);
  EXPECT_EQ(first<std::uint8_t>(geometry, "overlap"), 1);
  EXPECT_EQ(first<std::uint8_t>(geometry, "scanner_channel"), 1);
  EXPECT_EQ(first<std::uint8_t>(geometry, "scan_direction"), 0);
  EXPECT_EQ(first<std::uint8_t>(geometry, "edge_of_flight_line"), 1);
  EXPECT_EQ(first<std::uint8_t>(geometry, "classification"), 200);
  EXPECT_EQ(first<std::int16_t>(geometry, "scan_angle"), -3000);
  EXPECT_EQ(first<double>(geometry, "gps_time"), 1e9);
  EXPECT_EQ(first<std::uint16_t>(geometry, "red"), 1);
  EXPECT_EQ(first<std::uint16_t>(geometry, "blue"), 3);
  EXPECT_EQ(first<std::uint16_t>(geometry, "nir"), 4);
}

TEST(Las, EveryFormatHasItsTimeColourAndWave) {
  for (int format = 0; format <= 10; ++format) {
    LasFile file(format < 4 ? 2 : format < 6 ? 3 : 4, format);
    const std::size_t point = file.addPoint(1, 2, 3);
    const bool time = format != 0 && format != 2, wave = format == 4 || format == 5 || format >= 9;
    const bool color = format == 2 || format == 3 || format == 5 || format == 7 || format == 8 || format == 10;
    const std::size_t color_byte = format == 2 ? 20 : format < 6 ? 28 : 30;
    if (time) file.set<double>(point + (format < 6 ? 20 : 22), 0.5);
    if (color) file.set<std::uint16_t>(point + color_byte + 2, 9);
    if (wave) file.set<float>(point + las_format_bytes[format] - 4, 2.5f);
    const auto geometry = parse(file);
    EXPECT_EQ(fieldNamed(geometry, "gps_time") != nullptr, time) << format;
    EXPECT_EQ(fieldNamed(geometry, "green") != nullptr, color) << format;
    EXPECT_EQ(fieldNamed(geometry, "wave_z") != nullptr, wave) << format;
    EXPECT_EQ(fieldNamed(geometry, "nir") != nullptr, format == 8 || format == 10) << format;
    if (time) {
      EXPECT_EQ(first<double>(geometry, "gps_time"), 0.5) << format;
    }
    if (color) {
      EXPECT_EQ(first<std::uint16_t>(geometry, "green"), 9) << format;
    }
    if (wave) {
      EXPECT_EQ(first<float>(geometry, "wave_z"), 2.5f) << format;
    }
  }
}

TEST(Las, ExtraBytesAreFieldsWithTheirNameScaleAndOffset) {
  LasFile file(4, 6, 2 + 8 + 3);
  file.describe("height", 3, 0.01, 5);
  file.describe("pair", 19);  // two floats
  const std::size_t point = file.addPoint(1, 2, 3);
  file.set<std::uint16_t>(point + 30, 250);
  file.set<float>(point + 32, 1.5f);
  file.set<float>(point + 36, -2.5f);
  file.set<std::uint8_t>(point + 42, 7);
  const auto geometry = parse(file);
  EXPECT_EQ(first<double>(geometry, "height"), 250 * 0.01 + 5);
  ASSERT_NE(fieldNamed(geometry, "pair"), nullptr);
  EXPECT_EQ(valuesOf<float>(*fieldNamed(geometry, "pair")), (std::vector<float>{1.5f, -2.5f}));
  ASSERT_NE(fieldNamed(geometry, "extra_bytes"), nullptr);
  EXPECT_EQ(fieldNamed(geometry, "extra_bytes")->count, 3);
  EXPECT_EQ(valuesOf<std::uint8_t>(*fieldNamed(geometry, "extra_bytes"))[2], 7);
}

TEST(Las, TheOldCountStandsInForAMissingNewOne) {
  LasFile file(4, 6);
  file.addPoint(1, 2, 3);
  file.set<std::uint64_t>(247, 0);
  file.set<std::uint32_t>(107, 1);
  EXPECT_EQ(parse(file).points.rows(), 1);
}

TEST(Las, WhatCannotBeIsRefusedWithItsByte) {
  const auto broken = [](const auto& change) {
    LasFile file(4, 6);
    file.addPoint(1, 2, 3);
    change(file);
    return refusal(file);
  };
  const auto expect = [&](const auto& change, const char* reason) {
    EXPECT_NE(broken(change).find(reason), std::string::npos) << broken(change) << " / " << reason;
  };
  expect([](LasFile& file) { file.set<char>(0, 'l'); }, "a.las: byte 0: does not begin with 'LASF'");
  expect([](LasFile& file) { file.set<std::uint8_t>(24, 2); }, "byte 24: LAS 2.4");
  expect([](LasFile& file) { file.set<std::uint16_t>(94, 227); }, "byte 94: a header of 227 bytes");
  expect([](LasFile& file) { file.set<std::uint32_t>(96, 4'000'000'000u); }, "byte 96");
  expect([](LasFile& file) { file.set<std::uint8_t>(104, 6 | 0x80); }, "LAZ");
  expect([](LasFile& file) { file.set<std::uint8_t>(104, 11); }, "unknown point format 11");
  expect([](LasFile& file) { file.set<std::uint16_t>(105, 0); }, "points of 0 bytes");
  expect([](LasFile& file) { file.set<std::uint64_t>(247, 4'000'000'000u); },
         "byte 247: 4000000000 points of 30 bytes");
  expect([](LasFile& file) { file.set<std::uint64_t>(247, ~0ull); }, "byte 247: 18446744073709551615 points");
  expect([](LasFile& file) { file.set<double>(139, 0.0); }, "byte 139: a scale");
  expect([](LasFile& file) { file.set<double>(163, std::numeric_limits<double>::infinity()); }, "byte 163: an offset");
  expect([](LasFile& file) { file.set<std::uint32_t>(100, 4'000'000'000u); }, "record 1 of 4000000000");
}

TEST(Las, NamesOfExtraBytesBecomeOneWord) {
  LasFile file(4, 6, 3);
  file.describe("Pulse width", 1);
  file.describe("", 1);
  file.describe("a\x01z ", 1);
  file.addPoint(1, 2, 3);
  const auto geometry = parse(file);
  for (const char* name : {"Pulse_width", "extra_2", "a_z"}) EXPECT_NE(fieldNamed(geometry, name), nullptr) << name;
}

TEST(Las, AnExtraValueBeyondThePointIsRefused) {
  LasFile file(4, 6, 1);
  file.describe("height", 10);
  file.addPoint(1, 2, 3);
  EXPECT_NE(refusal(file).find("described values take 38 bytes of points of 31"), std::string::npos) << refusal(file);
}

}  // namespace
}  // namespace las_test
