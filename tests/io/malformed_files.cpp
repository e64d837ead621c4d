#include "malformed_files.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <initializer_list>

#include "las_file.h"

namespace {

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

std::string npy(const std::string& type, const std::string& shape, std::size_t bytes) {
  const std::string header = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + shape + "), }\n";
  return std::string("\x93NUMPY\x01\x00", 8) + static_cast<char>(header.size()) + '\0' + header +
         std::string(bytes, '\0');
}

std::string vtk(const std::string& sections) {
  return "# vtk DataFile Version 3.0\na title\nASCII\nDATASET POLYDATA\n" + sections;
}

/// A binary file's header, then fewer bytes than it announces.
std::string compressed(std::uint32_t packed, std::uint32_t unpacked) {
  std::string bytes = pcd("1 1 1", "75", "1", "75", "binary_compressed");
  bytes.append(reinterpret_cast<const char*>(&packed), 4);
  bytes.append(reinterpret_cast<const char*>(&unpacked), 4);
  return bytes + std::string(8, '\x1f');
}

}  // namespace

namespace {

std::string seenFrom(const std::string& pose) {
  return "FIELDS x y z\nVIEWPOINT " + pose + "\nPOINTS 1\nDATA ascii\n1 2 3\n";
}

std::string plySeenFrom(const std::string& pose) {
  return "ply\nformat ascii 1.0\nobj_info viewpoint " + pose +
         "\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n";
}

/// A PLY file with the sensor as PCL writes it: where it is and its axes.
std::string plyWithCamera(const std::string& values) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex 1\n";
  for (const char* name : {"x", "y", "z"}) text += std::string("property float ") + name + "\n";
  text += "element camera 1\n";
  for (const char* name : {"view_px", "view_py", "view_pz", "x_axisx", "x_axisy", "x_axisz", "y_axisx", "y_axisy",
                           "y_axisz", "z_axisx", "z_axisy", "z_axisz"})
    text += std::string("property float ") + name + "\n";
  return text + "end_header\n1 2 3\n" + values + "\n";
}

/// A point with a value of its own, an 8-bit integer with a scale and an offset.
std::string scaledLas(double scale, double offset) {
  LasFile file(4, 6, 1);
  file.describe("height", 1, scale, offset);
  file.addPoint(1, 2, 3);
  return file.bytes();
}

LasFile las() {
  LasFile file(4, 6);
  for (int i = 0; i < 20; ++i) file.addPoint(i, i * i, -i);
  return file;
}

template <class T>
std::string packed(std::initializer_list<T> values, bool big_endian = false) {
  std::string bytes;
  for (const T value : values) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (big_endian) std::reverse(raw, raw + sizeof(T));
    bytes.append(raw, sizeof(T));
  }
  return bytes;
}

/// Padding that the header makes large and the compressed data leave out.
std::string paddingBomb() {
  std::string bytes =
      "FIELDS x y z _\nSIZE 1 1 1 8\nTYPE I I I F\nCOUNT 1 1 1 1000000\nWIDTH 200\nHEIGHT 1\nPOINTS 200\n"
      "DATA binary_compressed\n";
  bytes += packed<std::uint32_t>({12, 601}) + std::string(12, '\0');
  return bytes;
}

/// Points of 2^34 bytes, and so many that all bytes are a multiple of 2^64.
std::string overflowing() {
  std::string names = "FIELDS x y z", sizes = "SIZE 4 4 4", types = "TYPE F F F", counts = "COUNT 1 1 1";
  std::int64_t rest = (std::int64_t{1} << 34);
  for (; rest > 0; rest -= std::min<std::int64_t>(rest, 8'000'000)) {
    names += " _";
    sizes += " 8";
    types += " F";
    counts.append(" ").append(std::to_string(std::min<std::int64_t>(rest, 8'000'000) / 8));
  }
  return names + "\n" + sizes + "\n" + types + "\n" + counts + "\nWIDTH 1073741824\nHEIGHT 1\nDATA binary\n";
}

/// A LAS file whose header counts `points`.
std::string lasCounting(std::uint64_t points) {
  LasFile file = las();
  file.set(247, points);
  return file.bytes();
}

const char* const square_text = "0.5 0 0\n1.5 0 0\n1.5 1 0\n0.5 1 0\n";

}  // namespace

std::vector<WellFormed> wellFormedFiles() {
  const auto corners = [](bool big) { return packed<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, big); };
  // A literal run of 32 values at most; the corners of a square take 48 bytes.
  const std::string columns = packed<float>({0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0});
  const std::string lzf = std::string(1, '\x1f').append(columns, 0, 32).append(1, '\x0f').append(columns, 32);
  const std::string sizes = packed<std::uint32_t>({static_cast<std::uint32_t>(lzf.size()), 48});
  const std::string facet = packed<float>({0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}) + std::string(2, '\0');
  const std::string facet_text =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  return {
      {"ascii.pcd", pcd("1 1 1", "4", "1", "4", "ascii") + square_text},
      {"binary.pcd", pcd("1 1 1", "4", "1", "4", "binary") + corners(false)},
      {"compressed.pcd", pcd("1 1 1", "4", "1", "4", "binary_compressed") + sizes + lzf},
      {"ascii.ply", ply("4", "2", std::string(square_text) + "3 0 1 2\n3 0 2 3\n")},
      {"little.ply", ply("4", "2", corners(false) + "\3" + packed<int>({0, 1, 2}) + "\3" + packed<int>({0, 2, 3}),
                         "binary_little_endian")},
      {"big.ply",
       ply("4", "2", corners(true) + "\3" + packed<int>({0, 1, 2}, true) + "\3" + packed<int>({0, 2, 3}, true),
           "binary_big_endian")},
      {"ascii.off", std::string("OFF\n4 2 0\n") + square_text + "3 0 1 2\n3 0 2 3\n"},
      {"binary.off", std::string("OFF BINARY\n") + packed<int>({4, 2, 0}, true) + corners(true) +
                         packed<int>({3, 0, 1, 2, 0, 3, 0, 2, 3, 0}, true)},
      {"ascii.stl", std::string("solid\n") + facet_text + facet_text + "endsolid\n"},
      {"binary.stl", std::string(80, ' ') + packed<std::uint32_t>({3}) + facet + facet + facet},
      {"points.las", las().bytes()},
  };
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
      {"huge_binary.pcd", pcd("1 1 1", "2000000000", "1", "2000000000", "binary") + "abc", "too short"},
      {"mismatch.pcd", pcd("1 1 1", "2", "2", "3", "ascii") + "1 2 3\n1 2 3\n1 2 3\n", "WIDTH"},
      {"words.pcd", pcd("1 1 1", "1", "1", "1", "ascii") + "a b c\n", "line 11: 'a' is not a number"},
      {"short_line.pcd", pcd("1 1 1", "2", "1", "2", "ascii") + "1.0 2.0 3.0\n1.0 2.0\n", "line 12: 2 values"},
      {"few_lines.pcd", pcd("1 1 1", "2", "1", "2", "ascii") + "1.00000 2.00000 3.00000\n", "1 of 2 points"},
      {"truncated.pcd", pcd("1 1 1", "2", "1", "2", "binary") + std::string(20, '\0'), "ends there"},
      {"cut_off_header.pcd", "VERSION .7\nFIELDS x y z\nC", "line 3: the file ends within the header"},
      {"cut_off_header.ply", "ply\nformat ascii 1.0\nelem", "line 3: the file ends within the header"},
      {"compressed_short.pcd", compressed(1000, 900), "compressed data need"},
      {"compressed_bomb.pcd", compressed(8, 4000000000u), "not those of 75 points"},
      {"compressed_garbage.pcd", compressed(8, 900), "damaged"},
      {"no_xyz.pcd", "FIELDS a b\nSIZE 4 4\nTYPE F F\nWIDTH 1\nHEIGHT 1\nDATA ascii\n1 2\n", "x, y, z"},
      {"bad_type.pcd", "FIELDS x y z\nSIZE 2 2 2\nTYPE F F F\nWIDTH 1\nHEIGHT 1\nDATA ascii\n1 2 3\n", "SIZE"},
      {"bad_data.pcd", pcd("1 1 1", "1", "1", "1", "zipped"), "line 10"},
      {"not_a.ply", "plywood\n", "line 1"},
      {"not_a.npy", "\x93NUMPI", "is no array of numpy"},
      {"flat.npy", npy("<f8", "3,", 24), "is an array of 3, must be N x 3 or H x W x 3"},
      {"pairs.npy", npy("<f8", "2, 2", 32), "is an array of 2 points of 2 values, must be N x 3"},
      {"single.npy", npy("<f8", "", 8), "is an array of one value"},
      {"objects.npy", npy("|O", "1, 3", 24), "must be of real numbers"},
      {"short.npy", npy("<f8", "2, 3", 47), "has 47 bytes of values, its shape 2 x 3 needs more"},
      {"huge.npy", npy("<f4", "1000000000000, 3", 12), "bytes of values"},
      {"header.npy", npy("<f4", "1, 3", 12).substr(0, 40), "byte 40: ends within the header"},
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
      {"comma.xyz", "1,5 2,5 3,5\n", "line 1: values are separated in two ways"},
      {"commas.xyz", "1,5;2,5;3,5\n", "line 1: values are separated in two ways"},
      {"below_zero.xyz", "-5\n1 2 3\n", "line 1: a number of points below zero"},
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
      {"short.stl", "abc", "line 1: 'abc' where an ascii STL begins with 'solid'"},
      {"short_binary.stl", std::string("a\0c", 3), "neither"},
      {"capitals.stl", "SOLID\nFACET\nVERTEX 1 2\n", "line 3: three coordinates"},
      {"no_facets.stl", "solid a\nendsolid a\n", "line 2: holds no facets"},
      {"unknown.stl", "solid a\nfacet\nouter loop\nvertices 1 2 3\n", "line 4: unknown word 'vertices'"},
      {"truncated.stl", std::string(80, 'x') + std::string("\x02\0\0\0", 4) + std::string(50, '\0'), "need 184"},
      {"cut.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n", "ends inside"},
      {"square.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\n",
       "line 7"},
      {"word.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 zero\n", "line 4: 'zero'"},
      {"count_4e9.pcd", pcd("1 1 1", "4000000000", "1", "4000000000", "binary"), "line 6: 4000000000 points"},
      {"count_2_64.pcd", pcd("1 1 1", "18446744073709551615", "1", "1", "binary"), "line 6"},
      {"size_0.pcd", "FIELDS x y z\nSIZE 4 0 4\nTYPE F F F\nWIDTH 1\nHEIGHT 1\nDATA ascii\n1 2 3\n", "line 2: out of"},
      {"two_fields.pcd", "FIELDS x y z\nSIZE 4 4 4\nFIELDS x\nDATA ascii\n1 2 3\n", "line 3: a second list"},
      {"viewpoint.pcd", "FIELDS x y z\nVIEWPOINT 0 0 0\nDATA ascii\n", "line 2: seven numbers"},
      {"viewpoint_nan.pcd", seenFrom("nan 0 0 1 0 0 0"), "line 2: a viewpoint that is not finite"},
      {"viewpoint_inf.pcd", seenFrom("0 0 0 1 0 inf 0"), "line 2: a viewpoint that is not finite"},
      {"viewpoint_zero.pcd", seenFrom("1 2 3 0 0 -0 0"), "line 2: a viewpoint whose quaternion has the length 0"},
      {"viewpoint_nan.ply", plySeenFrom("0 nan 0 1 0 0 0"), "line 3: a viewpoint that is not finite"},
      {"viewpoint_zero.ply", plySeenFrom("0 0 0 0 0 0 0"), "line 3: a viewpoint whose quaternion has the length 0"},
      {"camera.ply", plyWithCamera("0 0 inf 1 0 0 0 1 0 0 0 1"), "line 22: a viewpoint that is not finite"},
      {"camera_turned.ply", plyWithCamera("0 0 0 nan 0 0 0 1 0 0 0 1"), "line 22: a viewpoint that is not finite"},
      {"scale_nan.las", scaledLas(NAN, 0), "byte 541: a scale that is not finite"},
      {"offset_inf.las", scaledLas(1, INFINITY), "byte 565: an offset that is not finite"},
      {"missing_x.pcd", "FIELDS y z\nPOINTS 1\nDATA ascii\n1 2\n", "line 3: has no fields x, y, z"},
      {"count_4e9.ply", ply("4000000000", "0", "", "binary_little_endian"), "line 3: a count of '4000000000'"},
      {"count_2_64.ply", ply("18446744073709551615", "0", ""), "line 3"},
      {"faces_4e9.ply", ply("1", "4000000000", "1 2 3\n"), "line 7"},
      {"huge_list.ply", ply("1", "1", std::string(12, '\0') + "\xff", "binary_little_endian"), "list of 255"},
      {"missing_x.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float y\nend_header\n1\n", "line 5"},
      {"no_properties.ply", "ply\nformat ascii 1.0\nelement vertex 1\nend_header\n1\n", "line"},
      {"count_4e9.off", "OFF\n4000000000 0 0\n0 0 0\n", "line 2"},
      {"count_2_64.off", "OFF\n18446744073709551615 0 0\n0 0 0\n", "line 2"},
      {"negative_binary.off", std::string("OFF BINARY\n") + packed<int>({-1, 0, 0}, true) + std::string(99, '\0'),
       "too short"},
      {"huge_binary.off", std::string("OFF BINARY\n") + packed<int>({2147483647, 2147483647, 0}, true), "too short"},
      {"huge_face_binary.off", std::string("OFF BINARY\n") + packed<int>({0, 1, 0, 2147483647, 0, 0}, true),
       "byte 23: a face of"},
      {"index_binary.off", std::string("OFF BINARY\n") + packed<int>({0, 1, 0, 1, 7, 0}, true),
       "byte 23: a face names vertex 7"},
      {"count_2_32.stl", std::string(80, ' ') + packed<std::uint32_t>({4294967295u}) + std::string(50, '\0'),
       "byte 134"},
      {"empty.las", "", "is empty"},
      {"header_only.las", lasCounting(20).substr(0, 375), "byte 247"},
      {"short.las", lasCounting(20).substr(0, 200), "byte 200: ends inside the header"},
      {"count_4e9.las", lasCounting(4'000'000'000u), "byte 247: 4000000000 points"},
      {"count_2_64.las", lasCounting(~std::uint64_t(0)), "byte 247: 18446744073709551615 points"},
      {"junk.las", std::string(300, '\x7f'), "byte 0"},
      {"junk.pcd", std::string(300, '\x7f'), "line 1"},
      {"junk.ply", std::string(300, '\x7f'), "line 1"},
      {"junk.off", std::string(300, '\x7f'), "line 1"},
      {"junk.obj", std::string(300, '\x7f'), "line 1"},
      {"junk.xyz", std::string(300, '\x7f'), "line 1"},
      {"junk.vtk", std::string(300, '\x7f'), "byte 0: does not begin with '# vtk DataFile Version'"},
      {"junk.npy", std::string(300, '\x7f'), "is no array of numpy"},
      {"junk.stl", std::string(300, '\x7f'), "byte 300"},
      {"padding_bomb.pcd", paddingBomb(), "byte 118: the compressed data hold 601 bytes"},
      {"overflow.pcd", overflowing(), "too short for 1073741824 points of 17179869196 bytes"},
      {"zeros.stl", std::string(1000, '\0'), "byte 84: 916 zero bytes behind a header that counts no points"},
      {"glued.off", "OFF3 1\n0.00000 0.00000 0.00000\n", "line 2: ends after 1 of 3 vertices"},
      {"glued_word.off", "OFFSET 3\n", "line 1: the header does not begin"},
      {"names.csv", "x,y\n1,2\n", "line 1"},
      {"others.csv", "a,b,c\n1,2,3\n", "line 1: has no fields x, y, z; has 'a', 'b', 'c'"},
      {"columns.csv", "x,y,z\n1,2,3,4\n", "line 2: line 1 names 3 columns, here are 4"},
      {"count.csv", "x,y,z\n3\n1,2,3\n", "ends after 1 of 3 points"},
      {"no_points.vtk", vtk("METADATA\n\n"), "has no POINTS"},
      {"grid.vtk", "# vtk DataFile Version 3.0\na\nASCII\nDATASET STRUCTURED_GRID\n", "must be POLYDATA"},
      {"huge.vtk", vtk("POINTS 2000000000 float\n1 2 3\n"), "too short for its 2000000000 x 3 values"},
      {"words.vtk", vtk("POINTS 1 float\n1 two 3\n"), "'two' is not a number"},
      {"bits.vtk", vtk("POINTS 1 bit\n1 0 1\n"), "unknown type 'bit'"},
      {"index.vtk", vtk("POINTS 1 float\n1 2 3\nPOLYGONS 1 4\n3 0 0 1\n"), "no vertex 1"},
      {"cells.vtk", vtk("POINTS 1 float\n1 2 3\nPOLYGONS 2 4\n3 0 0 0\n"), "2 cells expected, here are 1"},
      {"long_cell.vtk", vtk("POINTS 1 float\n1 2 3\nPOLYGONS 1 4\n9 0 0 0\n"), "a cell of 9 corners"},
      {"tuples.vtk", vtk("POINTS 1 float\n1 2 3\nPOINT_DATA 2\n"), "values of 2 points, of which there are 1"},
      {"unknown.vtk", vtk("POINTS 1 float\n1 2 3\nPOLYGON 1 4\n3 0 0 0\n"), "unknown word 'POLYGON'"},
      {"a.docx", "PK", "unknown file type '.docx'"},
      {"none", "PK\3\4", "no extension"},
  };
}
