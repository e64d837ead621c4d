#include <gtest/gtest.h>

#include <cstring>

#include "field_values.h"
#include "temporary_dir.h"
#include "tufted/errors.h"
#include "tufted/io/read.h"

namespace {

constexpr std::size_t format_bytes[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

/// A LAS file of some points, written from the tables of the specification.
class LasFile {
 public:
  LasFile(int minor, int format, std::size_t extra_bytes = 0)
      : minor_(minor), record_(format_bytes[format] + extra_bytes) {
    bytes_.assign(minor == 4 ? 375 : minor == 3 ? 235 : 227, '\0');
    std::memcpy(bytes_.data(), "LASF", 4);
    set<std::uint8_t>(24, 1);
    set<std::uint8_t>(25, static_cast<std::uint8_t>(minor));
    set<std::uint16_t>(94, static_cast<std::uint16_t>(bytes_.size()));
    set<std::uint8_t>(104, static_cast<std::uint8_t>(format));
    set<std::uint16_t>(105, static_cast<std::uint16_t>(record_));
    for (int c = 0; c < 3; ++c) {
      set<double>(131 + 8 * c, c < 2 ? 0.01 : 0.001);
      set<double>(155 + 8 * c, c == 0 ? 500000.0 : c == 1 ? 5400000.0 : -100.0);
    }
    endRecords();
  }

  template <class T>
  void set(std::size_t byte, T value) {
    std::memcpy(bytes_.data() + byte, &value, sizeof(T));
  }

  /// Describes an extra value, with scale and offset where they are not 1 and 0. Before the first point.
  void describe(const std::string& name, int kind, double scale = 1, double offset = 0) {
    const std::size_t begin = bytes_.size();
    bytes_.append(54 + 192, '\0');
    std::memcpy(bytes_.data() + begin + 2, "LASF_Spec", 9);
    set<std::uint16_t>(begin + 18, 4);
    set<std::uint16_t>(begin + 20, 192);
    set<std::uint8_t>(begin + 54 + 2, static_cast<std::uint8_t>(kind));
    set<std::uint8_t>(begin + 54 + 3, scale != 1 || offset != 0 ? 0x18 : 0);
    std::memcpy(bytes_.data() + begin + 54 + 4, name.data(), name.size());
    set<double>(begin + 54 + 112, scale);
    set<double>(begin + 54 + 136, offset);
    set<std::uint32_t>(100, ++records_);
    endRecords();
  }

  /// Appends a point; returns where it begins.
  std::size_t addPoint(std::int32_t x, std::int32_t y, std::int32_t z) {
    const std::size_t begin = bytes_.size();
    bytes_.append(record_, '\0');
    set(begin, x);
    set(begin + 4, y);
    set(begin + 8, z);
    ++points_;
    if (minor_ == 4)
      set<std::uint64_t>(247, points_);
    else
      set<std::uint32_t>(107, static_cast<std::uint32_t>(points_));
    return begin;
  }

  const std::string& bytes() const { return bytes_; }

 private:
  void endRecords() { set<std::uint32_t>(96, static_cast<std::uint32_t>(bytes_.size())); }

  int minor_;
  std::size_t record_;
  std::uint64_t points_ = 0;
  std::uint32_t records_ = 0;
  std::string bytes_;
};

tufted::Geometry parse(const LasFile& file) {
  return tufted::parse(file.bytes(), "a.las");
}

std::string refusal(const LasFile& file) {
  try {
    parse(file);
  } catch (const tufted::IoError& error) {
    return error.what();
  }
  return "was read";
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
    if (wave) file.set<float>(point + format_bytes[format] - 4, 2.5f);
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

TEST(Las, AnExtraValueBeyondThePointIsRefused) {
  LasFile file(4, 6, 1);
  file.describe("height", 10);
  file.addPoint(1, 2, 3);
  EXPECT_NE(refusal(file).find("described values take 38 bytes of points of 31"), std::string::npos) << refusal(file);
}

}  // namespace
