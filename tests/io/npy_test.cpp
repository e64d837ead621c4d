// Arrays of numpy of every real type, order and shape as points.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "../support/refusal.h"
#include "field_values.h"
#include "temporary_dir.h"
#include "tufted/errors.h"
#include "tufted/io/read.h"
#include "tufted/io/results.h"

namespace npy_test {
namespace {

const tufted::Points two{{1, 2, 3}, {4, 5, 6}};

std::string npy(const std::string& descr, const std::string& shape, const std::string& values,
                const std::string& by_columns = "False") {
  const std::string header =
      "{'descr': " + descr + ", 'fortran_order': " + by_columns + ", 'shape': (" + shape + "), }\n";
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() & 255);
  bytes += static_cast<char>(header.size() >> 8);
  return bytes + header + values;
}

template <class T>
std::string packed(const std::vector<double>& values, bool swapped = false) {
  std::string bytes;
  for (const double value : values) {
    const T number = static_cast<T>(value);
    char raw[sizeof(T)];
    std::memcpy(raw, &number, sizeof(T));
    if (swapped) std::reverse(raw, raw + sizeof(T));
    bytes.append(raw, sizeof(T));
  }
  return bytes;
}

std::string refusal(const std::string& bytes) {
  return tufted::support::refusal<tufted::IoError>([&] { tufted::parse(bytes, "a.npy"); });
}

TEST(Npy, HoldsPointsOfEveryRealType) {
  const std::vector<double> rows = {1, 2, 3, 4, 5, 6}, columns = {1, 4, 2, 5, 3, 6};
  const std::string halves = packed<std::uint16_t>({0x3c00, 0x4000, 0x4200, 0x4400, 0x4500, 0x4600});
  for (const auto& [descr, values] : {std::pair<std::string, std::string>{"<f4", packed<float>(rows)},
                                      {">f4", packed<float>(rows, true)},
                                      {">f8", packed<double>(rows, true)},
                                      {"<f2", halves},
                                      {"|i1", packed<std::int8_t>(rows)},
                                      {"<i2", packed<std::int16_t>(rows)},
                                      {">i2", packed<std::int16_t>(rows, true)},
                                      {"<i4", packed<std::int32_t>(rows)},
                                      {"<i8", packed<std::int64_t>(rows)},
                                      {"<u2", packed<std::uint16_t>(rows)},
                                      {"<u8", packed<std::uint64_t>(rows)}})
    EXPECT_EQ(tufted::parse(npy("'" + descr + "'", "2, 3", values), "a.npy").points, two) << descr;
  EXPECT_EQ(tufted::parse(npy("'>i4'", "2, 3", packed<std::int32_t>(columns, true), "True"), "a.npy").points, two);
}

TEST(Npy, HalvesAreExact) {
  const auto values =
      tufted::parse(npy("'<f2'", "2, 3", packed<std::uint16_t>({0x0001, 0x8400, 0xfbff, 0x7c00, 0xfe00, 0x8000})),
                    "a.npy")
          .points;
  EXPECT_EQ(values(0, 0), 0x1p-24);
  EXPECT_EQ(values(0, 1), -0x1p-14);
  EXPECT_EQ(values(0, 2), -65504);
  EXPECT_EQ(values(1, 0), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(values(1, 1)));
  EXPECT_TRUE(std::signbit(values(1, 2)));
}

TEST(Npy, FurtherColumnsAreNormalsOrFields) {
  std::vector<double> rows;
  for (int i = 0; i < 7; ++i) rows.insert(rows.end(), {1. * i, 2, 3, 0, 0, 1, 10. + i});
  const auto geometry = tufted::parse(npy("'<f4'", "7, 7", packed<float>(rows)), "a.npy");
  EXPECT_EQ(geometry.points.row(4), Eigen::RowVector3d(4, 2, 3));
  ASSERT_EQ(geometry.normals.rows(), 7);
  EXPECT_EQ(geometry.normals(3, 2), 1);
  ASSERT_EQ(geometry.fields.size(), 1u);
  EXPECT_EQ(valuesOf<float>(geometry.fields[0])[6], 16);
}

TEST(Npy, ThreeDimensionsAreAnOrganizedCloudInEitherOrder) {
  std::vector<double> rows, columns;
  for (int i = 0; i < 18; ++i) rows.push_back(i);
  for (int c = 0; c < 3; ++c)
    for (int w = 0; w < 3; ++w)
      for (int h = 0; h < 2; ++h) columns.push_back(rows[(h * 3 + w) * 3 + c]);
  for (const std::string& bytes :
       {npy("'<f8'", "2, 3, 3", packed<double>(rows)), npy("'<f8'", "2, 3, 3", packed<double>(columns), "True")}) {
    const auto geometry = tufted::parse(bytes, "a.npy");
    EXPECT_EQ(geometry.width, 3);
    EXPECT_EQ(geometry.height, 2);
    EXPECT_EQ(geometry.points.row(4), Eigen::RowVector3d(12, 13, 14));
  }
  const auto listed = tufted::parse(npy("'<f8'", "6, 1, 3", packed<double>(rows)), "a.npy");  // as OpenCV has points
  EXPECT_EQ(listed.width, 6);
  EXPECT_EQ(listed.height, 1);
}

TEST(Npy, StructuresHaveTheirNames) {
  const std::string one = packed<float>({1, 2, 3}) + std::string(4, 'p') + packed<std::uint8_t>({10, 20, 30}) +
                          packed<std::uint16_t>({7}, true);
  const std::string other = packed<float>({4, 5, 6}) + std::string(4, 'p') + packed<std::uint8_t>({11, 21, 31}) +
                            packed<std::uint16_t>({8}, true);
  for (const std::string xyz : {"('X', '<f4'), ('Y', '<f4'), ('Z', '<f4')", "('xyz', '<f4', (3,))",
                                "(('a title', 'x'), '<f4'), ('y', '<f4'), ('z', '<f4')"}) {
    const auto geometry = tufted::parse(
        npy("[" + xyz + ", ('', '|V4'), ('rgb', '|u1', (3,)), ('Intensity', '>u2')]", "2,", one + other), "a.npy");
    EXPECT_EQ(geometry.points, two) << xyz;
    ASSERT_EQ(geometry.fields.size(), 4u) << xyz;
    EXPECT_EQ(valuesOf<std::uint8_t>(*fieldNamed(geometry, "green")), (std::vector<std::uint8_t>{20, 21}));
    EXPECT_EQ(valuesOf<std::uint16_t>(*fieldNamed(geometry, "intensity")), (std::vector<std::uint16_t>{7, 8}));
  }
}

TEST(Npy, WhatIsNoPointsSaysWhatToDo) {
  const auto expect = [](const std::string& bytes, const std::string& word) {
    EXPECT_NE(refusal(bytes).find(word), std::string::npos) << refusal(bytes);
  };
  expect(npy("'<f4'", "3, 100", std::string(1200, '\0')), "numpy.save(file, array.T)");
  expect(npy("'<c8'", "2, 3", std::string(48, '\0')), "numpy.save(file, array.astype(float))");
  expect(npy("'|O'", "2, 3", std::string(48, '\0')), "numpy.save(file, array.astype(float))");
  expect(npy("'<f4'", "2, 2", std::string(16, '\0')), "must be N x 3 or more");
  expect(npy("'<f4'", "6,", std::string(24, '\0')), "must be N x 3");
  expect(npy("[('a', '<f4'), ('b', '<f4')]", "2,", std::string(16, '\0')), "has no fields x, y, z; has 'a', 'b'");
  expect(npy("[('p', [('x', '<f4')])]", "2,", std::string(8, '\0')), "numpy.column_stack");
}

TEST(Npy, ArraysOfValuesMayHaveEveryRealType) {
  const TemporaryDir dir;
  EXPECT_EQ(tufted::readArray(dir.write("a.npy", npy("'>f4'", "3,", packed<float>({1, 2, 3}, true)))),
            Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(
      tufted::readArray(dir.write("b.npy", npy("'<i4'", "2, 3", packed<std::int32_t>({1, 4, 2, 5, 3, 6}), "True"))),
      (Eigen::MatrixXd(2, 3) << 1, 2, 3, 4, 5, 6).finished());
}

}  // namespace
}  // namespace npy_test
