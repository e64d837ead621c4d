#include <CGAL/IO/OFF.h>
#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

#include "field_values.h"
#include "temporary_dir.h"
#include "tufted/errors.h"
#include "tufted/io/read.h"

namespace text_formats_test {
namespace {

/// A .npy file of points, by rows or by columns.
template <class T>
std::string npyFile(const char* type, const std::vector<T>& values, const char* by_columns) {
  const std::string header = std::string("{'descr': '") + type + "', 'fortran_order': " + by_columns + ", 'shape': (" +
                             std::to_string(values.size() / 3) + ", 3), }\n";
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size());
  bytes += '\0' + header;
  return bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

TEST(Npy, HoldsPointsOfFloatsOrDoublesInEitherOrder) {
  const TemporaryDir dir;
  const tufted::Points expected{{0.1, 2, 3}, {4, 5, 6}};
  const std::vector<double> rows = {0.1, 2, 3, 4, 5, 6}, columns = {0.1, 4, 2, 5, 3, 6};
  EXPECT_EQ(tufted::read(dir.write("a.npy", npyFile("<f8", rows, "False"))).points, expected);
  const auto by_columns = tufted::read(dir.write("b.npy", npyFile("<f8", columns, "True")));
  EXPECT_EQ(by_columns.points, expected);
  EXPECT_EQ(by_columns.format, "NPY, float64");
  EXPECT_FALSE(by_columns.is_mesh);
  const std::vector<float> floats(rows.begin(), rows.end());
  const auto single = tufted::read(dir.write("unknown", npyFile("<f4", floats, "False")));  // told by the content
  EXPECT_EQ(single.points, expected.cast<float>().cast<double>());
  EXPECT_EQ(tufted::read(dir.write("c.npy", npyFile("<f8", std::vector<double>(), "False"))).points.rows(), 0);
}

TEST(Xyz, KeepsDoublesAndTakesEveryWayToWriteANumber) {
  const TemporaryDir dir;
  const auto path = dir.write("a.xyz",
                              "# a comment\n\n500000.1234567891 5400000.9876543211\t+3e-2\r\n"
                              "  nan NaN -nan  # to the end\n1.#QNAN -1.#IND 1e999\n// another\n1 2 3");
  const auto geometry = tufted::read(path);
  ASSERT_EQ(geometry.points.rows(), 4);
  EXPECT_EQ(geometry.points(0, 0), 500000.1234567891);
  EXPECT_EQ(geometry.points(0, 1), 5400000.9876543211);
  EXPECT_EQ(geometry.points(0, 2), 0.03);
  for (int c = 0; c < 3; ++c) EXPECT_TRUE(std::isnan(geometry.points(1, c)));
  EXPECT_TRUE(std::isnan(geometry.points(2, 0)));
  EXPECT_EQ(geometry.points(2, 2), std::numeric_limits<double>::infinity());
  EXPECT_EQ(geometry.points(3, 2), 3);
}

TEST(Xyz, UnitVectorsInColumnsFourToSixAreNormalsAndColoursAreFields) {
  const TemporaryDir dir;
  const auto normals = tufted::read(dir.write("n.xyz", "0 0 0 0 0 1 7\n1 0 0 0 0.6 0.8 8\n"));
  EXPECT_EQ(normals.normals(1, 2), 0.8);
  ASSERT_EQ(normals.fields.size(), 1u);
  EXPECT_EQ(valuesOf<double>(normals.fields[0]), (std::vector<double>{7, 8}));
  const auto colours = tufted::read(dir.write("c.xyz", "0 0 0 255 0 0\n1 0 0 0 255 3\n"));
  EXPECT_EQ(colours.normals.rows(), 0);
  EXPECT_EQ(colours.fields.size(), 3u);
  const auto announced = tufted::read(dir.write("p.pwn", "2\n0 0 0 0 0 5\n1 0 0 0 4 0\n"));
  EXPECT_EQ(announced.points.rows(), 2);
  EXPECT_EQ(announced.normals(0, 2), 5);
}

TEST(Xyz, EveryEndOfLineEndsALine) {
  for (const char* text : {"1 2 3\n4 5 6\n", "1 2 3\r\n4 5 6\r\n", "1 2 3\r4 5 6\r", "1 2 3\r4 5 6"}) {
    const auto geometry = tufted::parse(text, "a.xyz");
    ASSERT_EQ(geometry.points.rows(), 2) << text;
    EXPECT_EQ(geometry.points(1, 2), 6);
    EXPECT_TRUE(geometry.fields.empty());
  }
  EXPECT_EQ(tufted::parse("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r", "a.obj").triangles.rows(), 1);
}

TEST(Xyz, AColumnWithoutANameIsPassedOver) {
  EXPECT_TRUE(tufted::parse("x,y,z,_\n0,0,0,5\n", "a.csv").fields.empty());
}

TEST(Xyz, AFirstLineOfNamesNamesTheColumns) {
  const TemporaryDir dir;
  const auto geometry = tufted::read(dir.write("a.csv", "Intensity,X,Y,Z\n9,1,2,3\n8,4,5,6\n"));
  EXPECT_EQ(geometry.points.row(1), Eigen::RowVector3d(4, 5, 6));
  ASSERT_NE(fieldNamed(geometry, "intensity"), nullptr);
}

TEST(Xyz, CommentsMayBeEmpty) {
  for (const std::string empty : {"#", "# ", "//", "##", "#\r", "#/"}) {
    const tufted::Geometry geometry = tufted::parse(empty + "\n# x y z\n" + empty + "\n1 2 3\n" + empty, "a.xyz");
    EXPECT_EQ(geometry.points, (tufted::Points(1, 3) << 1, 2, 3).finished()) << empty;
    EXPECT_TRUE(geometry.notes.empty()) << empty;
  }
}

TEST(Xyz, ACommaMayEndALineAndCommentsMayHoldEmptyFields) {
  const TemporaryDir dir;
  const auto geometry = tufted::read(dir.write("a.csv", "// a,,b\n1, 2 ,3,\r\n4;5;6; # ,,\n"));
  ASSERT_EQ(geometry.points.rows(), 2);
  EXPECT_EQ(geometry.points.row(0), Eigen::RowVector3d(1, 2, 3));
  EXPECT_EQ(geometry.points.row(1), Eigen::RowVector3d(4, 5, 6));
}

TEST(Obj, TabsNegativeNumbersContinuedLinesAndForeignKeywordsAreRead) {
  const TemporaryDir dir;
  const auto geometry = tufted::read(dir.write("a.obj",
                                               "mtllib a.mtl\no thing\nv 500000.1234567891 0 0 1\nv 1 0 0\nv 0 1 0\n"
                                               "vn 0 0 1\nvt 0 0\nf\t1/1/1\t2//1\t3\nl 1 2\nf -3 -2 \\\n -1\n"
                                               "v 0 0 1\nf 1 2 4 3\n"));
  EXPECT_TRUE(geometry.is_mesh);
  EXPECT_EQ(geometry.points(0, 0), 500000.1234567891);
  ASSERT_EQ(geometry.triangles.rows(), 4);
  EXPECT_EQ(geometry.triangles.row(0), Eigen::RowVector3i(0, 1, 2));
  EXPECT_EQ(geometry.triangles.row(1), Eigen::RowVector3i(0, 1, 2));
  EXPECT_EQ(geometry.polygons, 1);
  EXPECT_FALSE(tufted::read(dir.write("b.obj", "v 0 0 0\nv 1 1 1\n")).is_mesh);
}

TEST(Off, AFileWithoutFacesIsACloudAndNormalsAreKept) {
  const TemporaryDir dir;
  const auto cloud = tufted::read(dir.write("a.off", "NOFF\n# two points\n2 0 0\n\n1.5 2 3 0 0 1\n4 5 6 0 1 0\n"));
  EXPECT_FALSE(cloud.is_mesh);
  EXPECT_EQ(cloud.points(0, 0), 1.5);
  EXPECT_EQ(cloud.normals(1, 1), 1);
  const auto mesh =
      tufted::read(dir.write("b.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 255 0 0\n4 0 1 2 3\n"));
  EXPECT_TRUE(mesh.is_mesh);
  EXPECT_EQ(mesh.triangles.rows(), 3);
  EXPECT_EQ(mesh.polygons, 1);
}

TEST(Off, WhatCgalWritesIsRead) {
  using Point = CGAL::Simple_cartesian<double>::Point_3;
  const std::vector<Point> points = {{500000.1234567891, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<std::vector<std::size_t>> faces = {{0, 1, 2}};
  const TemporaryDir dir;
  ASSERT_TRUE(CGAL::IO::write_OFF((dir / "a.off").string(), points, faces, CGAL::parameters::stream_precision(17)));
  EXPECT_EQ(tufted::read(dir / "a.off").points(0, 0), 500000.1234567891);
}

TEST(Off, TheBinaryFormIsRead) {
  std::string bytes = "OFF BINARY\n";
  const auto add = [&bytes](auto value) {
    char big[4];
    std::memcpy(big, &value, 4);
    std::reverse(big, big + 4);
    bytes.append(big, 4);
  };
  for (const int count : {3, 1, 0}) add(count);
  for (const float coordinate : {0.1f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f}) add(coordinate);
  for (const int corner : {3, 0, 1, 2, 0}) add(corner);
  const TemporaryDir dir;
  const auto geometry = tufted::read(dir.write("a.off", bytes));
  EXPECT_EQ(geometry.points(0, 0), 0.1f);
  ASSERT_EQ(geometry.triangles.rows(), 1);
  EXPECT_EQ(geometry.triangles.row(0), Eigen::RowVector3i(0, 1, 2));
}

TEST(Off, ColoursOfAllVerticesAreFieldsInBothForms) {
  const auto bytes = tufted::parse("CNOFF 2 0 0\n0 0 0 0 0 1 255 128 0\n1 0 0 0 1 0 1 2 3\n", "a.off");
  ASSERT_NE(fieldNamed(bytes, "green"), nullptr);
  EXPECT_EQ(valuesOf<std::uint8_t>(*fieldNamed(bytes, "green")), (std::vector<std::uint8_t>{128, 2}));
  EXPECT_EQ(bytes.normals.row(1), Eigen::RowVector3d(0, 1, 0));
  const auto floats = tufted::parse("COFF 1 0 0\n0 0 0 0.5 1.0 0 1#red\n", "a.off");
  ASSERT_NE(fieldNamed(floats, "alpha"), nullptr);
  EXPECT_EQ(valuesOf<float>(*fieldNamed(floats, "red")), (std::vector<float>{0.5f}));
}

TEST(Off, ColoursOfAPlainOffAreKept) {
  const auto geometry = tufted::parse("OFF 2 0 0\n0 0 0 1 0 1\n1 0 0 0 1 1\n", "a.off");
  ASSERT_NE(fieldNamed(geometry, "blue"), nullptr);
  EXPECT_EQ(valuesOf<std::uint8_t>(*fieldNamed(geometry, "blue")), (std::vector<std::uint8_t>{1, 1}));
}

TEST(Off, ColoursMayBeMissingAndHomogeneousVerticesAreDivided) {
  const TemporaryDir dir;
  const auto coloured = tufted::read(dir.write("c.off", "COFF 3 1 0\n0 0 0 255 0 0\n1 0 0\n0 1 0 3\n3 0 1 2\n"));
  EXPECT_EQ(coloured.triangles.rows(), 1);
  const auto homogeneous = tufted::read(dir.write("h.off", "4OFF\n1 0 0\n2 4 6 2\n"));
  EXPECT_EQ(homogeneous.points.row(0), Eigen::RowVector3d(1, 2, 3));
}

TEST(Obj, ColoursAndNormalsOfVerticesAreKept) {
  const auto cloud = tufted::parse("v 0 0 0 1.0 0.5 0\nvn 0 0 1\nv 1 0 0 0 0 1.0\nvn 0 1 0\n", "a.obj");
  EXPECT_FALSE(cloud.is_mesh);
  ASSERT_NE(fieldNamed(cloud, "green"), nullptr);
  EXPECT_EQ(valuesOf<float>(*fieldNamed(cloud, "green")), (std::vector<float>{0.5f, 0}));
  ASSERT_EQ(cloud.normals.rows(), 2);
  EXPECT_EQ(cloud.normals.row(1), Eigen::RowVector3d(0, 1, 0));
}

TEST(Obj, ColoursArePartsOfOne) {
  const auto ones = tufted::parse("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\n", "a.obj");
  ASSERT_NE(fieldNamed(ones, "red"), nullptr);
  EXPECT_EQ(valuesOf<float>(*fieldNamed(ones, "red")), (std::vector<float>{1, 0}));
  const auto bytes = tufted::parse("v 0 0 0 255 0 0\n", "a.obj");
  EXPECT_EQ(valuesOf<std::uint8_t>(*fieldNamed(bytes, "red")), (std::vector<std::uint8_t>{255}));
}

TEST(Obj, NormalsOfCornersAreNotThoseOfVertices) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 0 1 0\nvn 1 0 0\n";
  EXPECT_EQ(tufted::parse(vertices + "f 1//1 2//2 3//3\n", "a.obj").normals.rows(), 3);
  EXPECT_EQ(tufted::parse(vertices + "f 1//2 2//2 3//3\n", "a.obj").normals.rows(), 0);
}

TEST(Obj, AWeightIsNoColour) {
  const auto cloud = tufted::parse("v 1 2 3 1\nv 4 5 6 1\n", "a.obj");
  EXPECT_TRUE(cloud.fields.empty());
  EXPECT_EQ(cloud.points(1, 2), 6);
}

const char* const square =
    "solid square\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\n"
    "facet normal 0 0 1\nouter loop\nvertex -0 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid square\n";

/// The two triangles of `square` in binary, behind a header that looks like ascii.
std::string binarySquare() {
  std::string bytes = "solid square";
  bytes.resize(80, ' ');
  const std::uint32_t count = 2;
  bytes.append(reinterpret_cast<const char*>(&count), 4);
  const float corners[2][12] = {{0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 1, 0}, {0, 0, 1, -0.0f, 0, 0, 1, 1, 0, 0, 1, 0}};
  for (const auto& triangle : corners) {
    bytes.append(reinterpret_cast<const char*>(triangle), sizeof(triangle));
    bytes.append(2, '\0');
  }
  return bytes;
}

TEST(Stl, EqualCornersBecomeOneVertexTheLowestFirst) {
  const TemporaryDir dir;
  for (const std::string& bytes : {std::string(square), binarySquare()}) {
    const auto geometry = tufted::read(dir.write("a.stl", bytes));
    EXPECT_EQ(geometry.points.rows(), 4);
    EXPECT_EQ(geometry.merged_vertices, 2);
    ASSERT_EQ(geometry.triangles.rows(), 2);
    EXPECT_EQ(geometry.triangles.row(0), Eigen::RowVector3i(0, 1, 2));
    EXPECT_EQ(geometry.triangles.row(1), Eigen::RowVector3i(0, 2, 3));
  }
}

TEST(Stl, CornersThatAreNotFiniteStayApart) {
  const TemporaryDir dir;
  const auto geometry = tufted::read(
      dir.write("a.stl",
                "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex nan 0 0\nvertex 1 1 0\nendloop\nendfacet\n"
                "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex nan 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
                "endsolid\n"));
  EXPECT_EQ(geometry.points.rows(), 5);
  EXPECT_EQ(geometry.merged_vertices, 1);
}

TEST(Read, AnExtensionInCapitalsIsTheSameFormat) {
  const TemporaryDir dir;
  EXPECT_EQ(tufted::read(dir.write("A.XYZ", "1 2 3\n")).points.rows(), 1);
  EXPECT_TRUE(tufted::isReadable("A.XYZ"));
}

TEST(Read, EveryExtensionThatItNamesIsReadableAndNoOther) {
  const TemporaryDir dir;
  std::string refusal;
  try {
    tufted::read(dir.write("a.docx", "PK"));
  } catch (const tufted::IoError& error) {
    refusal = error.what();
  }
  std::istringstream known(refusal.substr(refusal.find("known are") + 9));
  int count = 0;
  for (std::string extension; known >> extension; ++count) {
    EXPECT_TRUE(tufted::isReadable("a" + extension)) << extension;
    try {
      tufted::read(dir.write("a" + extension, "x"));
    } catch (const tufted::IoError& error) {
      EXPECT_EQ(std::string(error.what()).find("unknown file type"), std::string::npos) << error.what();
    }
  }
  EXPECT_GT(count, 0);
  EXPECT_FALSE(tufted::isReadable("a.docx"));
  EXPECT_FALSE(tufted::isReadable("none"));
  EXPECT_FALSE(tufted::isReadable(".xyz"));  // a hidden file without an extension
}

}  // namespace
}  // namespace text_formats_test
