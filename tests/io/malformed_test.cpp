#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <ostream>

#include "temporary_dir.h"
#include "tufted/errors.h"
#include "tufted/io/read.h"

namespace {

struct Malformed {
  std::string name;
  std::string bytes;
  std::string reason;  ///< a part of the message
};

void PrintTo(const Malformed& file, std::ostream* stream) {
  *stream << file.name;
}

std::string pcd(const std::string& counts, const std::string& width, const std::string& height,
                const std::string& points, const std::string& data) {
  return "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT " + counts + "\nWIDTH " + width + "\nHEIGHT " +
         height + "\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + points + "\nDATA " + data + "\n";
}

std::string ply(const std::string& vertices, const std::string& faces, const std::string& body,
                const std::string& format = "ascii") {
  return "ply\nformat " + format + " 1.0\nelement vertex " + vertices +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
         "\nproperty list uchar int vertex_indices\nend_header\n" + body;
}

/// A binary file's header, then fewer bytes than it announces.
std::string compressed(std::uint32_t packed, std::uint32_t unpacked) {
  std::string bytes = pcd("1 1 1", "75", "1", "75", "binary_compressed");
  bytes.append(reinterpret_cast<const char*>(&packed), 4);
  bytes.append(reinterpret_cast<const char*>(&unpacked), 4);
  return bytes + std::string(8, '\x1f');
}

std::vector<Malformed> malformedFiles() {
  return {
      {"empty.pcd", "", "is empty"},
      {"empty.ply", "", "is empty"},
      {"empty.stl", "", "is empty"},
      {"empty_field.csv", "1,2,3,4\n1,2,,3\n", "line 2: value 3 is empty"},
      {"empty_fields.csv", "1,2,,3\n1,2, ,3\n", "line 1: value 3 is empty"},
      {"empty_first_field.csv", "1,2,3\n,1,2,3\n", "line 2: value 1 is empty"},
      {"empty_row.csv", "1;2;3\n;;\n1;2;3\n", "line 2: value 1 is empty"},
      {"header_only.pcd", "VERSION .7\nFIELDS x y z\n", "DATA"},
      {"negative_count.pcd", pcd("1 -1 1", "1", "1", "1", "ascii") + "1 2 3\n", "line 5: out of range: '-1'"},
      {"negative_width.pcd", pcd("1 1 1", "-1", "1", "1", "ascii") + "1 2 3\n", "line 6"},
      {"huge_width.pcd", pcd("1 1 1", "99999999999", "1", "99999999999", "ascii") + "1 2 3\n", "2^31"},
      {"beyond_64_bits.pcd", pcd("1 1 1", "99999999999999999999", "1", "1", "ascii"), "is not an integer"},
      {"huge.pcd", pcd("1 1 1", "2000000000", "1", "2000000000", "ascii") + "1 2 3\n", "too short"},
      {"huge_binary.pcd", pcd("1 1 1", "2000000000", "1", "2000000000", "binary") + "abc", "need"},
      {"mismatch.pcd", pcd("1 1 1", "2", "2", "3", "ascii") + "1 2 3\n1 2 3\n1 2 3\n", "WIDTH"},
      {"words.pcd", pcd("1 1 1", "1", "1", "1", "ascii") + "a b c\n", "line 11: 'a' is not a number"},
      {"short_line.pcd", pcd("1 1 1", "2", "1", "2", "ascii") + "1.0 2.0 3.0\n1.0 2.0\n", "line 12: 2 values"},
      {"few_lines.pcd", pcd("1 1 1", "2", "1", "2", "ascii") + "1.00000 2.00000 3.00000\n", "1 of 2 points"},
      {"truncated.pcd", pcd("1 1 1", "2", "1", "2", "binary") + std::string(20, '\0'), "ends there"},
      {"compressed_short.pcd", compressed(1000, 900), "compressed data need"},
      {"compressed_bomb.pcd", compressed(8, 4000000000u), "not the 900"},
      {"compressed_garbage.pcd", compressed(8, 900), "damaged"},
      {"no_xyz.pcd", "FIELDS a b\nSIZE 4 4\nTYPE F F\nWIDTH 1\nHEIGHT 1\nDATA ascii\n1 2\n", "x, y, z"},
      {"bad_type.pcd", "FIELDS x y z\nSIZE 2 2 2\nTYPE F F F\nWIDTH 1\nHEIGHT 1\nDATA ascii\n1 2 3\n", "SIZE"},
      {"bad_data.pcd", pcd("1 1 1", "1", "1", "1", "zipped"), "line 10"},
      {"not_a.ply", "plywood\n", "line 1"},
      {"no_end.ply", "ply\nformat ascii 1.0\nelement vertex 1\n", "end_header"},
      {"negative.ply", ply("-1", "0", ""), "line 3"},
      {"huge.ply", ply("2000000000", "0", "1 2 3\n"), "at least"},
      {"huge_binary.ply", ply("2000000000", "0", "123", "binary_big_endian"), "at least"},
      {"beyond.ply", ply("99999999999", "0", "1 2 3\n"), "2^31"},
      {"words.ply", ply("1", "0", "a b c\n"), "line 10: 'a' is not a number"},
      {"short_line.ply", ply("2", "0", "1.0 2.0 3.0\n1.0 2.0\n"), "line 11"},
      {"long_line.ply", ply("1", "0", "1 2 3 4\n"), "line 10"},
      {"index.ply", ply("1", "1", "0 0 0\n3 0 1 2\n"), "line 11: a face names vertex 1"},
      {"negative_index.ply", ply("1", "1", "0 0 0\n3 0 -1 0\n"), "vertex -1"},
      {"long_list.ply", ply("1", "1", "0 0 0\n200 0 0 0\n"), "list of 200"},
      {"long_list_binary.ply",
       ply("1", "1", std::string(12, '\0') + "\xff" + std::string(8, '\0'), "binary_little_endian"), "list of 255"},
      {"truncated.ply", ply("1", "2", std::string(12, '\0') + '\1' + std::string(2, '\0'), "binary_little_endian"),
       "byte"},
      {"bad_type.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty int128 x\nend_header\n1\n", "line 4"},
      {"no_xyz.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n", "x, y, z"},
      {"no_vertex.ply", "ply\nformat ascii 1.0\nelement edge 1\nproperty float x\nend_header\n1\n", "vertex"},
      {"no_corners.ply",
       "ply\nformat ascii 1.0\nelement vertex 1\nproperty int x\nproperty int y\nproperty int z\n"
       "element face 1\nproperty int a\nend_header\n1 2 3\n1\n",
       "vertex_indices"},
      {"comments.xyz", "# nothing\n\n", "no points"},
      {"word.xyz", "1 2 3\n1 two 3\n", "line 2: 'two' is not a number"},
      {"short.xyz", "1 2 3\n1 2\n", "line 2: 2 values"},
      {"two_columns.xyz", "1 2\n", "line 1"},
      {"announced.pwn", "3\n1 2 3\n", "1 of 3 points"},
      {"comma.xyz", "1,5 2,5 3,5\nx\n", "line 2"},
      {"index.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n", "line 3: a face names vertex 2"},
      {"zero.obj", "v 0 0 0\nf 0 1 1\n", "line 2"},
      {"negative.obj", "v 0 0 0\nf -1 -2 1\n", "line 2"},
      {"huge_index.obj", "v 0 0 0\nf 1 1 99999999999\n", "line 2"},
      {"word.obj", "v 0 0 0\nf 1 one 1\n", "line 2: 'one'"},
      {"short.obj", "v 0 0\n", "line 1"},
      {"nothing.obj", "# nothing\n", "no vertices"},
      {"not_an.off", "hello\n", "header"},
      {"huge.off", "OFF\n2000000000 2000000000 0\n0 0 0\n", "too short"},
      {"negative.off", "OFF\n-3 1 0\n0 0 0\n", "line 2"},
      {"truncated.off", "OFF\n3 1 0\n0.00000 0.00000 0.00000\n1 0 0\n", "2 of 3 vertices"},
      {"index.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n", "line 6: no vertex 7"},
      {"huge_face.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3000000000 0 1 2\n", "corners"},
      {"negative_face.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n", "line 6"},
      {"colours.off", "COFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n", "line 4: 3 values"},
      {"binary_cut.off", std::string("OFF BINARY\n\0\0\0\3\0\0\0\1\0\0\0\0\0\0\0\0", 27), "too short"},
      {"short.stl", "abc", "neither"},
      {"truncated.stl", std::string(80, 'x') + std::string("\x02\0\0\0", 4) + std::string(50, '\0'), "need 184"},
      {"cut.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n", "ends inside"},
      {"square.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\n",
       "line 7"},
      {"word.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 zero\n", "line 4: 'zero'"},
      {"a.docx", "PK", "unknown file type '.docx'"},
      {"none", "PK\3\4", "no extension"},
  };
}

class MalformedFile : public testing::TestWithParam<Malformed> {};

TEST_P(MalformedFile, IsRefusedWithItsPathAndAReason) {
  const TemporaryDir dir;
  const auto path = dir.write(GetParam().name, GetParam().bytes);
  try {
    tufted::read(path);
    FAIL() << "was read";
  } catch (const tufted::IoError& error) {
    const std::string message = error.what();
    EXPECT_TRUE(message.starts_with(path.string() + ": ")) << message;
    EXPECT_NE(message.find(GetParam().reason), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

INSTANTIATE_TEST_SUITE_P(All, MalformedFile, testing::ValuesIn(malformedFiles()), [](const auto& test) {
  std::string name = test.param.name;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
});

std::string refusal(const std::filesystem::path& path, tufted::ReadAs as = tufted::ReadAs::automatic) {
  try {
    tufted::read(path, as);
  } catch (const tufted::IoError& error) {
    return error.what();
  }
  return "";
}

TEST(Read, WhatIsNoRegularFileIsRefused) {
  const TemporaryDir dir;
  EXPECT_NE(refusal(dir / "missing.ply").find("missing.ply: no such file"), std::string::npos);
  std::filesystem::create_directory(dir / "folder.ply");
  EXPECT_NE(refusal(dir / "folder.ply").find("is a directory"), std::string::npos);
  ASSERT_EQ(mkfifo((dir / "pipe.ply").c_str(), 0600), 0);
  EXPECT_NE(refusal(dir / "pipe.ply").find("not a regular file"), std::string::npos);
}

TEST(Read, ACloudIsNoMesh) {
  const TemporaryDir dir;
  EXPECT_NE(refusal(dir.write("a.xyz", "1 2 3\n"), tufted::ReadAs::mesh).find("has no faces"), std::string::npos);
}

TEST(Read, EveryBeginningOfAFileIsReadOrRefused) {
  const TemporaryDir dir;
  const std::string files[][2] = {
      {"a.pcd", pcd("1 1 1", "2", "1", "2", "ascii") + "1 2 3\n4 5 6\n"},
      {"b.pcd", pcd("1 1 1", "2", "1", "2", "binary") + std::string(24, 'a')},
      {"a.ply", ply("3", "1", "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")},
      {"b.ply", ply("3", "1", std::string(36, '\0') + "\x01" + std::string(4, '\0'), "binary_big_endian")},
      {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
      {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
  };
  for (const auto& [name, bytes] : files) {
    for (std::size_t length = 1; length < bytes.size(); ++length)
      EXPECT_NO_FATAL_FAILURE(refusal(dir.write(name, bytes.substr(0, length)))) << name << ' ' << length;
  }
}

}  // namespace
