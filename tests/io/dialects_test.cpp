// What programs write that is not quite the format: other names, other cases, other numbers, bytes behind the end.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "../support/refusal.h"
#include "field_values.h"
#include "malformed_files.h"
#include "tufted/errors.h"
#include "tufted/io/read.h"

namespace dialects_test {
namespace {

using tufted::Geometry;

const tufted::Points two{{1, 2, 3}, {4, 5, 6}};

std::string refusal(const std::string& bytes, const std::string& name) {
  return tufted::support::refusal<tufted::IoError>([&] { tufted::parse(bytes, name); });
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

TEST(FieldNames, OfManyProgramsAreOneForEachMeaning) {
  const std::vector<std::pair<std::vector<const char*>, const char*>> meanings = {
      {{"x", "X", "\"X\"", " 'x' ", "X [m]", "pos_x", "position_x", "PointX", "x_coordinate", "Points_m_XYZ:0",
        "\"Points:0\"", "Points_0", "Easting"},
       "x"},
      {{"y", "Points:1", "Northing"}, "y"},
      {{"z", "Points_m_XYZ:2", "Elevation", "Height (m)"}, "z"},
      {{"nx", "NX", "normal_x", "NormalX", "Normals:0", "n_x"}, "nx"},
      {{"nz", "Normals:2"}, "nz"},
      {{"red", "Red", "R", "diffuse_red", "RGB:0"}, "red"},
      {{"blue", "B", "rgb:2"}, "blue"},
      {{"intensity", "Intensity", "scalar_Intensity", "I"}, "intensity"},
      {{"gps_time", "GpsTime", "\"gps time\""}, "gps_time"},
      {{"return_number", "ReturnNumber"}, "return_number"},
      {{"ring", "laser_id", "Ring"}, "ring"},
      {{"my_value", "My Value", "\"my value\""}, "my_value"}};
  for (const auto& [names, meaning] : meanings)
    for (const char* name : names) EXPECT_EQ(tufted::fieldKey(name), meaning) << name;
}

TEST(FieldNames, OfAUserMeanTheSameNameFirst) {
  EXPECT_EQ(tufted::findField({"z", "Elevation"}, "Elevation"), 1);
  EXPECT_EQ(tufted::findField({"z", "Elevation"}, "elevation"), 1);
  EXPECT_EQ(tufted::findField({"x", "z"}, "elevation"), 1);
  EXPECT_EQ(tufted::findField({"intensity"}, "Intensity"), 0);
  EXPECT_EQ(tufted::findField({"MyValue"}, "myvalue"), 0);
  EXPECT_EQ(tufted::findField({"intensity"}, "ring"), -1);
}

/// The same two points with normals, colours and intensity, in every format that names its fields.
TEST(FieldNames, AreKnownInAllFormats) {
  const std::string values = "1 2 3 0 0 1 10 20 30 7\n4 5 6 0 1 0 11 21 31 8\n";
  const std::vector<std::vector<std::string>> dialects = {
      {"X", "Y", "Z", "NX", "NY", "NZ", "R", "G", "B", "Intensity"},
      {"Points_m_XYZ:0", "Points_m_XYZ:1", "Points_m_XYZ:2", "Normals:0", "Normals:1", "Normals:2", "diffuse_red",
       "diffuse_green", "diffuse_blue", "scalar_Intensity"}};
  for (const auto& names : dialects) {
    std::string fields, properties, quoted;
    for (const std::string& name : names) {
      fields += " " + name;
      properties += "property double " + name + "\n";
      quoted += (quoted.empty() ? "\"" : ",\"") + name + "\"";
    }
    std::string commas = values;
    std::replace(commas.begin(), commas.end(), ' ', ',');
    for (const auto& [name, bytes] :
         {std::pair<std::string, std::string>{"a.txt", fields.substr(1) + "\n" + values},
          {"b.txt", "//" + fields + "\n2\n" + values},
          {"c.txt", "#" + fields + "\n" + values},
          {"d.txt", fields.substr(1) + "\n2\n" + values},
          {"e.txt", "2\n" + fields.substr(1) + "\n" + values},
          {"f.csv", quoted + "\n" + commas},
          {"g.pcd", "FIELDS" + fields + "\nPOINTS 2\nDATA ascii\n" + values},
          {"h.ply", "ply\nformat ascii 1.0\nelement vertex 2\n" + properties + "end_header\n" + values}}) {
      const Geometry geometry = tufted::parse(bytes, name);
      EXPECT_EQ(geometry.points, two) << name;
      ASSERT_EQ(geometry.normals.rows(), 2) << name << names[3];
      EXPECT_EQ(geometry.normals.row(1), Eigen::RowVector3d(0, 1, 0)) << name;
      ASSERT_EQ(geometry.fields.size(), 4u) << name;
      for (const auto& [field, value] : {std::pair{"red", 11}, {"green", 21}, {"blue", 31}, {"intensity", 8}}) {
        ASSERT_NE(fieldNamed(geometry, field), nullptr) << name << field;
        EXPECT_EQ(tufted::valueOf(*fieldNamed(geometry, field), 1), value) << name << field;
      }
      EXPECT_TRUE(geometry.notes.empty()) << geometry.notes.front();
    }
  }
}

TEST(FieldNames, ThatMeanAnotherCoordinateGiveWayToIt) {
  const Geometry geometry = tufted::parse("x,y,Elevation,z\n1,2,9,3\n4,5,9,6\n", "a.csv");
  EXPECT_EQ(geometry.points, two);
  ASSERT_EQ(geometry.fields.size(), 1u);
  EXPECT_EQ(geometry.fields[0].name, "Elevation");
  // One letter alone may mean anything.
  EXPECT_EQ(tufted::parse("x,y,z,b\n1,2,3,4\n", "a.csv").fields[0].name, "b");
}

TEST(FieldNames, AMessageListsThoseThatThereAre) {
  EXPECT_NE(refusal("\"a\",\"b\",\"c\"\n1,2,3\n", "a.csv").find("line 1: has no fields x, y, z; has 'a', 'b', 'c'"),
            std::string::npos);
}

TEST(FieldNames, AColumnOfRowNumbersNeedsNone) {
  const std::vector<std::string> texts = {",x,y,z\n0,1,2,3\n1,4,5,6\n",                          // pandas, to_csv()
                                          "\tx\ty\tz\n0\t1\t2\t3\n1\t4\t5\t6\n",                 // with sep="\t"
                                          "   x  y  z\n0  1  2  3\n1  4  5  6\n",                // to_string()
                                          "\"\",\"x\",\"y\",\"z\"\n\"1\",1,2,3\n\"2\",4,5,6\n",  // R, write.csv()
                                          "\"x\" \"y\" \"z\"\n\"1\" 1 2 3\n\"2\" 4 5 6\n"};      // R, write.table()
  for (const std::string& text : texts) {
    const Geometry geometry = tufted::parse(text, "a.csv");
    EXPECT_EQ(geometry.points, two) << text;
    EXPECT_TRUE(geometry.fields.empty()) << text;
    EXPECT_EQ(tufted::parse(text, "nameless").points, two) << text;  // told by the content
  }
  EXPECT_NE(refusal("x y z\n1 2 3 4\n", "a.txt").find("line 2: line 1 names 3 columns, here are 4"), std::string::npos);
}

TEST(FieldNames, AreOneWordForWriters) {
  EXPECT_EQ(tufted::parse("x,y,z,my value [m]\n1,2,3,4\n", "a.csv").fields[0].name, "my_value");
}

TEST(Pts, HasIntensityAndColoursAndMayHoldSeveralScans) {
  const Geometry geometry = tufted::parse("1\n1 2 3 -500 10 20 30\n1\n4 5 6 7 11 21 31\n", "a.pts");
  EXPECT_EQ(geometry.points, two);
  ASSERT_NE(fieldNamed(geometry, "intensity"), nullptr);
  EXPECT_EQ(tufted::valueOf(*fieldNamed(geometry, "intensity"), 0), -500);
  ASSERT_NE(fieldNamed(geometry, "blue"), nullptr);
  EXPECT_EQ(valuesOf<std::uint8_t>(*fieldNamed(geometry, "blue")), (std::vector<std::uint8_t>{30, 31}));
}

TEST(Keywords, OfEveryTextMayBeInCapitalsAndInSmallLetters) {
  for (const WellFormed& file : wellFormedFiles()) {
    if (!file.name.starts_with("ascii")) continue;
    const Geometry expected = tufted::parse(file.bytes, file.name);
    std::string small = file.bytes;
    std::transform(small.begin(), small.end(), small.begin(), [](unsigned char c) { return std::tolower(c); });
    for (const std::string& bytes : {upper(file.bytes), small})
      for (const std::string& name : {file.name, std::string("nameless")}) {
        const Geometry geometry = tufted::parse(bytes, name);
        EXPECT_EQ(geometry.points, expected.points) << file.name;
        EXPECT_EQ(geometry.triangles, expected.triangles) << file.name;
      }
  }
  EXPECT_EQ(tufted::parse("V 0 0 0\nV 1 0 0\nV 0 1 0\nF 1 2 3\n", "a.obj").triangles.rows(), 1);
}

TEST(Keywords, OfAnAsciiStlMayChangeTheirCaseBehindSolid) {
  const std::string facet =
      "FACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVertex 1 0 0\nvertex 0 1 0\nEND LOOP\n"
      "EndFacet\n";
  for (const std::string& name : {std::string("a"), std::string(2000, 'x')})
    EXPECT_EQ(tufted::parse("solid " + name + "\n" + facet + "ENDSOLID\n", "a.stl").triangles.rows(), 1);
}

TEST(Keywords, ThatAreUnknownAreRefusedWithTheirLine) {
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
      "endfacet\n";
  EXPECT_NE(refusal("sloid a\n" + facet + "endsolid\n", "a.stl").find("line 1: 'sloid'"), std::string::npos);
  EXPECT_NE(refusal("solid a\n" + facet + "facette\nendsolid\n", "a.stl").find("line 9: unknown word 'facette'"),
            std::string::npos);
  EXPECT_NE(refusal("solid a\nendsolid a\n", "a.stl").find("holds no facets"), std::string::npos);
  EXPECT_NE(refusal("FIELDS x y z\nFEILDS\n", "a.pcd").find("line 2: unknown keyword 'FEILDS'"), std::string::npos);
  const Geometry noted = tufted::parse("v 1 2 3\nvertex 4 5 6\nv 4 5 6\n", "a.obj");
  EXPECT_EQ(noted.points, two);
  ASSERT_EQ(noted.notes.size(), 1u);
  EXPECT_NE(noted.notes[0].find("1 lines begin with an unknown word"), std::string::npos) << noted.notes[0];
  EXPECT_NE(noted.notes[0].find("line 2: 'vertex'"), std::string::npos) << noted.notes[0];
}

TEST(Stl, ABinaryFileThatBeginsWithSolidStaysBinary) {
  for (const WellFormed& file : wellFormedFiles()) {
    if (file.name != "binary.stl") continue;
    std::string bytes = file.bytes;
    bytes.replace(0, 5, "solid");
    EXPECT_EQ(tufted::parse(bytes, "a.stl").triangles.rows(), 3);
    EXPECT_EQ(tufted::parse(bytes + std::string(500, '\0'), "a.stl").triangles.rows(), 3);
    EXPECT_NE(refusal(bytes.substr(0, bytes.size() - 50), "a.stl").find("3 triangles need 234"), std::string::npos);
  }
}

TEST(Unread, BytesBehindTheLastRecordArePassedOverAndNotedInAllFormats) {
  for (const WellFormed& file : wellFormedFiles()) {
    const Geometry expected = tufted::parse(file.bytes, file.name);
    EXPECT_EQ(expected.unread_bytes, 0) << file.name;
    EXPECT_TRUE(expected.notes.empty()) << file.name;
    const bool is_text = file.name.starts_with("ascii");
    for (const std::string& behind : {std::string("\n"), std::string(7, '\0'), std::string(4096, '\0'),
                                      std::string(4096, 'x'), std::string("1 2 3\n"), std::string("\x1a")}) {
      const Geometry geometry = tufted::parse(file.bytes + behind, file.name);
      EXPECT_EQ(geometry.points, expected.points) << file.name;
      EXPECT_EQ(geometry.triangles, expected.triangles) << file.name;
      const bool is_blank = is_text && behind == "\n";
      EXPECT_EQ(geometry.unread_bytes, is_blank ? 0 : std::ssize(behind)) << file.name;
      ASSERT_EQ(geometry.notes.size(), is_blank ? 0u : 1u) << file.name;
      if (is_blank) continue;
      EXPECT_TRUE(geometry.notes[0].starts_with(file.name + (is_text ? ": line " : ": byte "))) << geometry.notes[0];
      const std::string zero = behind.find_first_not_of('\0') == std::string::npos ? " zero byte" : " byte";
      EXPECT_NE(geometry.notes[0].find(": " + std::to_string(behind.size()) + zero), std::string::npos);
    }
  }
}

TEST(Unread, RowsBehindTheNumberThatATextAnnouncesAreNoted) {
  const Geometry geometry = tufted::parse("2\n1 2 3\n4 5 6\n7 8 9\n", "a.xyz");
  EXPECT_EQ(geometry.points, two);
  EXPECT_EQ(geometry.unread_bytes, 6);
  ASSERT_EQ(geometry.notes.size(), 1u);
  EXPECT_TRUE(geometry.notes[0].starts_with("a.xyz: line 4: ")) << geometry.notes[0];
}

TEST(Unread, AFileWithContentNeverReadsAsEmpty) {
  const std::string points = "1 2 3\n4 5 6\n";
  const std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (0, 3), }";
  const std::string npy =
      std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size()) + '\0' + header + points;
  for (const auto& [name, bytes] :
       {std::pair<std::string, std::string>{"a.xyz", "0\n" + points},
        {"a.pcd", "FIELDS x y z\nPOINTS 0\nDATA ascii\n" + points},
        {"b.pcd", "FIELDS x y z\nPOINTS 0\nDATA binary\n" + points},
        {"c.pcd", "FIELDS x y z\nPOINTS 0\nDATA binary_compressed\n" + points.substr(0, 6)},
        {"a.ply",
         "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\n"
         "end_header\n" +
             points},
        {"a.off", "OFF\n0 0 0\n" + points},
        {"a.stl", std::string(1000, '\0')},
        {"a.npy", npy}}) {
    const std::string message = refusal(bytes, name);
    EXPECT_NE(message.find(" behind a header that counts no points"), std::string::npos) << name << message;
    EXPECT_TRUE(message.find(": line ") != std::string::npos || message.find(": byte ") != std::string::npos)
        << message;
  }
}

TEST(Off, TheNumberOfVerticesMayFollowTheKeywordWithoutABlank) {
  for (const char* first : {"OFF3 1 0\n", "off3 1 0\n", "OFF3 1 0 # glued\n"}) {
    const Geometry geometry = tufted::parse(std::string(first) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "a.off");
    EXPECT_EQ(geometry.points.rows(), 3) << first;
    EXPECT_EQ(geometry.triangles.rows(), 1) << first;
  }
  EXPECT_EQ(tufted::parse("NOFF1 0 0\n0 0 0 0 0 1\n", "a.off").normals.rows(), 1);
  EXPECT_NE(refusal("OFF3x 1 0\n", "a.off").find("line 1"), std::string::npos);
  EXPECT_NE(refusal("OFF999999999999 1 0\n", "a.off").find("line 1"), std::string::npos);
}

/// Two triangles in the binary form of OFF.
std::string binaryOff(bool little_endian, bool face_colors, const std::string& keyword = "OFF BINARY\n") {
  std::string bytes = keyword;
  const auto add = [&](auto value) {
    char raw[4];
    std::memcpy(raw, &value, 4);
    if (!little_endian) std::reverse(raw, raw + 4);
    bytes.append(raw, 4);
  };
  for (const int count : {4, 2, 0}) add(count);
  for (const float value : {0.5f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 0.f, 0.f, 1.f, 0.f}) add(value);
  for (const auto& face : {std::array{3, 0, 1, 2}, std::array{3, 0, 2, 3}}) {
    for (const int corner : face) add(corner);
    if (face_colors) add(0);
  }
  return bytes;
}

TEST(Off, TheSizeTellsTheOrderOfBytesAndWhetherFacesHaveColours) {
  for (const bool little_endian : {false, true})
    for (const bool face_colors : {false, true})
      for (const std::string& behind : {std::string(), std::string(1, '\n'), std::string(100, '\0')}) {
        const Geometry geometry = tufted::parse(binaryOff(little_endian, face_colors) + behind, "a.off");
        EXPECT_EQ(geometry.points.row(0), Eigen::RowVector3d(0.5, 0, 0));
        ASSERT_EQ(geometry.triangles.rows(), 2);
        EXPECT_EQ(geometry.triangles.row(1), Eigen::RowVector3i(0, 2, 3));
        EXPECT_EQ(geometry.unread_bytes, std::ssize(behind));
      }
}

TEST(Obj, AWeightDividesAndMayStandBesideAColour) {
  const Geometry divided = tufted::parse("v 2 4 6 2\nv 4 5 6 1\n", "a.obj");
  EXPECT_EQ(divided.points, two);
  ASSERT_EQ(divided.notes.size(), 1u);
  EXPECT_NE(divided.notes[0].find("1 vertices have a weight w other than 1"), std::string::npos);
  const Geometry colored = tufted::parse("v 1 2 3 1 0.5 0 1.0\nv 4 5 6 1 0 0.25 0\n", "a.obj");
  EXPECT_EQ(colored.points, two);
  ASSERT_EQ(colored.fields.size(), 3u);
  EXPECT_EQ(valuesOf<float>(*fieldNamed(colored, "red")), (std::vector<float>{0.5f, 0}));
  EXPECT_EQ(valuesOf<float>(*fieldNamed(colored, "blue")), (std::vector<float>{1, 0}));
  EXPECT_EQ(tufted::parse("v 1 2 3 1 0 0 1\nv 4 5 6 0 0 1 1\n", "a.obj").fields.size(), 4u);  // r g b a
}

TEST(Obj, ColoursOfSomeVerticesAloneAreNoted) {
  const Geometry geometry = tufted::parse("v 1 2 3 1 0 0\nv 4 5 6\n", "a.obj");
  EXPECT_TRUE(geometry.fields.empty());
  ASSERT_EQ(geometry.notes.size(), 1u);
  EXPECT_NE(geometry.notes[0].find("colour"), std::string::npos);
}

}  // namespace
}  // namespace dialects_test
