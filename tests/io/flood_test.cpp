// Counts that no file of that size can hold are refused before anything is done so many times or made so large, and
// what a file holds is read within the memory that tufted/io/read.h states.
#include <gtest/gtest.h>

#include <cstring>
#include <ctime>
#include <functional>
#include <ostream>

#include "memory_peak.h"
#include "temporary_dir.h"
#include "tufted/errors.h"
#include "tufted/io/read.h"

namespace flood_test {
namespace {

struct Flood {
  std::string name;
  std::function<std::string()> bytes;  ///< made when asked for: each test is a process that knows all floods
  std::string reason;                  ///< of the refusal; empty where the file is good
};

void PrintTo(const Flood& flood, std::ostream* stream) {
  *stream << flood.name;
}

std::string times(std::size_t count, const std::string& text) {
  std::string all;
  for (std::size_t i = 0; i < count; ++i) all += text;
  return all;
}

template <class T>
std::string raw(T value) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

const std::string little = "ply\nformat binary_little_endian 1.0\n", ascii = "ply\nformat ascii 1.0\n";
const std::string vertices = "element vertex 3\nproperty uchar x\nproperty uchar y\nproperty uchar z\n";
const std::string three(std::string("\0\0\0\1\0\0\0\1\0", 9));

constexpr int many = 400'000;
const std::string list = "property list int uchar vertex_indices\nend_header\n";
const std::string facet = "facet\nvertex 0 0 0\nvertex 0 0 1\nvertex 0 1 0\nendfacet\n";

std::string counting(const std::string& form, const std::string& element, const std::string& properties) {
  return form + "element " + element + " 2147483647\n" + properties + "end_header\n";
}

std::vector<Flood> floods() {
  return {
      {"no_properties.ply", [] { return counting(little, "vertex", ""); }, "line 4: has no fields x, y, z"},
      {"no_properties_ascii.ply", [] { return counting(ascii, "vertex", ""); }, "line 4: has no fields x, y, z"},
      {"no_x.ply", [] { return little + "element vertex 2147483647\nend_header\n" + std::string(1000, '\0'); },
       "has no fields x"},
      {"only_lists.ply", [] { return counting(ascii, "vertex", "property list uchar int a\n"); }, "at least"},
      {"lists.ply", [] { return counting(little, "vertex", "property list uchar int a\n"); }, "byte 99: ends there"},
      {"faces.ply",
       [] { return counting(little + vertices, "face", "property list uchar int vertex_indices\n") + three; },
       "at least"},
      {"plain_faces.ply", [] { return counting(little + vertices, "face", "") + three; }, "no list of integers"},
      {"strips.ply", [] { return counting(little + vertices, "tristrips", "") + three; }, "no list of integers"},
      {"long_list.ply",
       [] {
         return little + vertices + "element face 1\nproperty list uint uchar vertex_indices\nend_header\n" + three +
                raw(4294967295u);
       },
       "a list of 4294967295 values"},
      {"others.ply", [] { return counting(little, "edge", "") + three; }, "has no element 'vertex'"},
      {"points.pcd", [] { return "FIELDS x y z\nPOINTS 2147483647\nDATA ascii\n1 2 3\n"; }, "too short"},
      {"binary.pcd", [] { return "FIELDS x y z\nPOINTS 2147483647\nDATA binary\n"; }, "too short"},
      {"compressed.pcd",
       [] { return "FIELDS x y z\nPOINTS 300000000\nDATA binary_compressed\n" + raw(0u) + raw(3600000000u); },
       "too short"},
      {"padding.pcd",
       [] {
         return "FIELDS x y z _\nSIZE 4 4 4 8\nTYPE F F F F\nCOUNT 1 1 1 1000000\nPOINTS 2147483647\nDATA binary\n";
       },
       "too short"},
      {"many_fields.pcd", [] { return "FIELDS" + times(many, " a") + "\nPOINTS 1\nDATA ascii\n1 2 3\n"; },
       "has no fields x, y, z"},
      {"counts.off", [] { return "OFF\n2147483647 2147483647 0\n"; }, "too short"},
      {"binary.off", [] { return "OFF BINARY\n" + std::string("\x7f\xff\xff\xff\x7f\xff\xff\xff\0\0\0\0", 12); },
       "too short"},
      {"announced.xyz", [] { return "9000000000000000000\n1 2 3\n"; }, "1 of 9000000000000000000 points"},
      {"returns.xyz", [] { return times(many, "1 2 3\r") + "x\r"; }, "line 400001"},
      {"returns.obj", [] { return times(many, "v 1 2 3\r") + "f 0\r"; }, "line 400001"},
      {"count.stl", [] { return std::string(80, ' ') + raw(4294967295u); }, "need 214748364834"},
      {"empty_faces.ply",
       [] {
         return little + vertices + "element face 400000\nproperty list uchar int vertex_indices\nend_header\n" +
                three + std::string(many, '\0');
       },
       ""},
      {"large_face.ply",
       [] {
         return little + vertices + "element face 1\n" + list + three + raw(many / 10) + std::string(many / 10, '\1');
       },
       ""},
      {"strip.ply",
       [] {
         return little + vertices + "element tristrips 1\n" + list + three + raw(3 * many) +
                times(many, std::string("\0\1\2", 3));
       },
       ""},
      {"empty_faces.obj", [] { return "v 1 2 3\n" + times(many, "f\n"); }, ""},
      {"short_faces.obj", [] { return "v 1 2 3\n" + times(many, "f 1\n"); }, ""},
      {"continued.obj", [] { return "v 1 2 3\nf" + times(many, " 1\\\n"); }, "is not an integer"},
      {"empty_faces.off", [] { return "OFF\n1 400000 0\n1 2 3\n" + times(many, "0\n"); }, ""},
      {"wide.xyz", [] { return times(many, "1 ") + "\n"; }, ""},
      {"facets.stl", [] { return "solid\n" + times(many / 10, facet) + "endsolid\n"; }, ""},
      {"zeros.pcd",  // three literal zeros, then 264 from each three bytes
       [] {
         return "FIELDS x y z\nSIZE 1 1 1\nTYPE U U U\nPOINTS 879913\nDATA binary_compressed\n" + raw(30'001u) +
                raw(2'639'739u) + std::string("\2\0\0\0", 4) + times(9'999, std::string("\xe0\xff\0", 3));
       },
       ""},
  };
}

std::size_t bytesOf(const tufted::Geometry& geometry) {
  std::size_t bytes = 24 * (geometry.points.rows() + geometry.normals.rows()) + 12 * geometry.triangles.rows();
  for (const tufted::Field& field : geometry.fields) bytes += sizeof(field) + field.bytes.size();
  return bytes;
}

class FloodOf : public testing::TestWithParam<Flood> {};

TEST_P(FloodOf, IsJudgedByItsSize) {
  const TemporaryDir dir;
  const std::string bytes = GetParam().bytes();
  const auto path = dir.write(GetParam().name, bytes);
  tufted::Geometry geometry;
  std::string message;
  const MemoryPeak peak;
  const std::clock_t begin = std::clock();
  try {
    geometry = tufted::read(path);
  } catch (const tufted::IoError& error) {
    message = error.what();
  }
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  if (GetParam().reason.empty()) {
    EXPECT_EQ(message, "");
  } else {
    EXPECT_TRUE(message.starts_with(path.string() + ": line ") || message.starts_with(path.string() + ": byte "))
        << message;
    EXPECT_NE(message.find(GetParam().reason), std::string::npos) << message;
  }
  EXPECT_LT(seconds, is_sanitized ? 20 : 3);
  if (!peak.bytes()) GTEST_SKIP() << "the system does not tell the peak of the memory";
  const double stated = 128.0 * static_cast<double>(bytes.size()) + 2.0 * static_cast<double>(bytesOf(geometry));
  constexpr double library = 4e6;  // pages of the program itself
  EXPECT_LT(static_cast<double>(*peak.bytes()), (is_sanitized ? 8 : 1) * (stated + library));
}

INSTANTIATE_TEST_SUITE_P(All, FloodOf, testing::ValuesIn(floods()), [](const auto& tested) {
  std::string name = tested.param.name;
  name[name.find('.')] = '_';
  return name;
});

}  // namespace
}  // namespace flood_test
