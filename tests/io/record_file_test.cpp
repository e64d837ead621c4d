// Files that are read in batches, compared with the same files read as a whole.
#include "io/record_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <map>

#include "../support/refusal.h"
#include "../support/resource_limit.h"
#include "las_file.h"
#include "temporary_dir.h"
#include "tufted/errors.h"
#include "tufted/io/head.h"
#include "tufted/io/tiles.h"

namespace record_file_test {
namespace {

using tufted::FileSource;
using tufted::Geometry;
using tufted::Points;
using tufted::io::RecordFile;

constexpr int points = 48;
constexpr std::size_t small_batch = 400;  // bytes: four to twenty points

template <class T>
std::string packed(const std::vector<double>& values, bool is_swapped = false) {
  std::string bytes;
  for (const double value : values) {
    const T number = static_cast<T>(value);
    std::string raw(reinterpret_cast<const char*>(&number), sizeof(T));
    bytes += is_swapped ? std::string(raw.rbegin(), raw.rend()) : raw;
  }
  return bytes;
}

/// Rows of x y z, a unit normal, and a number, one of which is NaN.
std::vector<double> rows(int columns = 7) {
  std::vector<double> values;
  for (int i = 0; i < points; ++i) {
    const double row[] = {0.5 * i, i % 7 + 0.25, i == 20 ? NAN : 100. - i, 0, i % 2 == 0 ? -1. : 1., 0, double(i % 5)};
    values.insert(values.end(), row, row + columns);
  }
  return values;
}

std::string npy(const std::string& descr, const std::string& shape, const std::string& values,
                const std::string& by_columns = "False") {
  std::string header = "{'descr': " + descr + ", 'fortran_order': " + by_columns + ", 'shape': (" + shape + "), }\n";
  header.insert(0, {static_cast<char>(header.size() & 255), static_cast<char>(header.size() >> 8)});
  return std::string("\x93NUMPY\x01\x00", 8) + header + values;
}

std::string npyByColumns() {
  const std::vector<double> values = rows(4);
  std::string columns;
  for (std::size_t c = 0; c < 4; ++c)
    for (std::size_t i = 0; i < points; ++i) columns += packed<double>({values[4 * i + c]});
  return npy("'<f8'", "48, 4", columns, "True");
}

std::string ply(const std::string& order, const std::string& more = "", const std::string& behind = "") {
  std::string header = "ply\r\nformat binary_" + order + "_endian 1.0\r\ncomment made by hand\r\nelement vertex 48\r\n";
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz", "intensity"})
    header += std::string("property float ") + name + "\r\n";
  return header + more + "end_header\r\n" + packed<float>(rows(), order == "big") + behind;
}

std::string pcd(const std::string& size) {
  return "# .PCD v.7\nVERSION .7\nFIELDS x y z normal_x normal_y normal_z _\nSIZE 4 4 4 4 4 4 1\nTYPE F F F F F F U\n"
         "COUNT 1 1 1 1 1 1 4\n" +
         size + "VIEWPOINT 1 2 3 1 0 0 0\nDATA binary\n" + packed<float>(rows());
}

std::string las(int minor, int format, bool is_counted_by_32_bits = false) {
  LasFile file(minor, format, minor >= 2 ? 3 : 0);
  file.addRecord("LASF_Projection", 2112, "a reference system");
  if (minor >= 2) file.describe("height", 3, 0.5, 7);  // uint16, and an extra byte without description
  for (int i = 0; i < points; ++i) {
    const std::size_t at = file.addPoint(100 * i, 37 * (i % 9), -i * i);
    file.set(at + 12, static_cast<std::uint16_t>(11 * i));
    file.set(at + las_format_bytes[format] - 1, static_cast<std::uint8_t>(i));
  }
  if (is_counted_by_32_bits) {
    file.set<std::uint64_t>(247, 0);
    file.set<std::uint32_t>(107, points);
  }
  if (minor == 4) file.addLaterRecord("user", 7, "a record behind the points");
  return file.bytes();
}

/// Files of every kind that has records.
const std::map<std::string, std::string> files = {
    {"0.las", las(0, 0)},
    {"1.las", las(1, 1)},
    {"2.las", las(2, 3)},
    {"3.las", las(3, 4)},
    {"4.las", las(4, 7)},
    {"old_count.las", las(4, 1, true)},
    {"little.ply", ply("little")},
    {"big.ply", ply("big")},
    {"faces.ply", ply("little", "element face 2\r\nproperty list uchar int vertex_indices\r\n",
                      packed<char>({3}) + packed<int>({0, 1, 2}) + packed<char>({3}) + packed<int>({1, 2, 3}))},
    {"grid.ply", ply("little", "obj_info num_cols 6\r\nobj_info num_rows 8\r\n")},
    {"row.pcd", pcd("WIDTH 48\nHEIGHT 1\nPOINTS 48\n")},
    {"points.pcd", pcd("POINTS 48\n")},
    {"grid.pcd", pcd("WIDTH 12\nHEIGHT 4\nPOINTS 48\n")},
    {"float.npy", npy("'<f4'", "48, 3", packed<float>(rows(3)))},
    {"big.npy", npy("'>f8'", "48, 5", packed<double>(rows(5), true))},
    {"normals.npy", npy("'<f4'", "48,7", packed<float>(rows()))},
    {"columns.npy", npyByColumns()},
    {"named.npy", npy("[('X', '<f8'), ('y', '<f8'), ('z', '<f8'), ('class', '<f8')]", "48,", packed<double>(rows(4)))},
    {"grid.npy", npy("'<f8'", "4, 12, 4", packed<double>(rows(4)))}};

bool areSame(const Points& a, const Points& b) {  // NaN included
  return a.rows() == b.rows() &&
         std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}

std::string refusal(const std::function<void()>& call) {
  return tufted::support::refusal<std::exception>(call);
}

/// The points that a pass gives.
Points pointsOf(const FileSource& source) {
  Points all(0, 3);
  source.pass([&](const tufted::PointsRef& batch) {
    all.conservativeResize(all.rows() + batch.rows(), 3);
    all.bottomRows(batch.rows()) = batch;
  });
  EXPECT_EQ(all.rows(), source.size);
  return all;
}

TEST(RecordFile, BatchesAreTheWhole) {
  const TemporaryDir dir;
  for (const auto& [name, bytes] : files) {
    const auto path = dir.write(name, bytes);
    const Geometry whole = tufted::read(path, tufted::ReadAs::cloud);
    ASSERT_EQ(whole.points.rows(), points) << name;
    const auto file = RecordFile::open(path, small_batch);
    ASSERT_NE(file, nullptr) << name;
    EXPECT_EQ(file->layout().is_organized, whole.height > 1) << name;
    std::int64_t done = 0, batches = 0;
    std::vector<std::string> values(whole.fields.size());
    file->forBatches([&, &name = name](const Geometry& batch, std::int64_t first) {
      const Eigen::Index count = batch.points.rows();
      EXPECT_EQ(first, done);
      EXPECT_TRUE(areSame(batch.points, whole.points.middleRows(first, count))) << name;
      if (whole.normals.rows() > 0) {
        EXPECT_TRUE(areSame(batch.normals, whole.normals.middleRows(first, count))) << name;
      }
      ASSERT_EQ(batch.fields.size(), values.size()) << name;
      for (std::size_t f = 0; f < values.size(); ++f) {
        EXPECT_EQ(batch.fields[f].name, whole.fields[f].name) << name;
        values[f].append(reinterpret_cast<const char*>(batch.fields[f].bytes.data()), batch.fields[f].bytes.size());
      }
      done += count;
      ++batches;
    });
    EXPECT_EQ(done, points) << name;
    EXPECT_GT(batches, 1) << name;
    for (std::size_t f = 0; f < values.size(); ++f)
      EXPECT_EQ(values[f],
                std::string(reinterpret_cast<const char*>(whole.fields[f].bytes.data()), whole.fields[f].bytes.size()))
          << name << ' ' << whole.fields[f].name;
  }
}

TEST(RecordFile, MayBeLargerThanTheAddressesThatAreLeft) {
  const TemporaryDir dir;
  for (const auto& [name, bytes] : files) {
    const auto path = dir.write(name, bytes);
    const Points expected = tufted::read(path, tufted::ReadAs::cloud).points;
    const auto head = tufted::readHead(path);
    std::filesystem::resize_file(path, std::size_t{1} << 32);  // zeros that take no room on disk
    const ResourceLimit limit(RLIMIT_AS, addressBytes() + (std::size_t{1} << 28));
    const auto file = RecordFile::open(path, small_batch);
    ASSERT_NE(file, nullptr) << name;
    Points points(0, 3);
    file->forBatches([&](const Geometry& batch, std::int64_t) {
      points.conservativeResize(points.rows() + batch.points.rows(), 3);
      points.bottomRows(batch.points.rows()) = batch.points;
    });
    EXPECT_TRUE(areSame(points, expected)) << name;
    const auto head_of_large = tufted::readHead(path);
    ASSERT_EQ(head_of_large.has_value(), head.has_value()) << name;
    if (head) {
      EXPECT_EQ(head_of_large->points, head->points) << name;
    }
  }
}

TEST(RecordFile, OthersAreReadWhole) {
  const TemporaryDir dir;
  const std::string lists = "property list uchar int neighbours\r\n";
  for (const auto& [name, bytes] : std::map<std::string, std::string>{
           {"text.xyz", "1 2 3\n4 5 6\n"},
           {"text.ply",
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
            "z\nend_header\n1 2 3\n"},
           {"lists.ply", ply("little", lists, std::string(200, '\0'))},
           {"text.pcd", "FIELDS x y z\nPOINTS 1\nDATA ascii\n1 2 3\n"},
           {"none.las", LasFile(2, 0).bytes()},
           {"grid.npy", npy("'<f8'", "2, 2, 3", packed<double>(std::vector<double>(12)), "True")}})
    EXPECT_EQ(RecordFile::open(dir.write(name, bytes)), nullptr) << name;
}

TEST(RecordFile, ShortFilesAreRefusedAsAWhole) {
  const TemporaryDir dir;
  for (const auto& [name, bytes] : files) {
    const auto path = dir.write(name, bytes.substr(0, bytes.size() - bytes.size() / 3));
    const std::string expected = refusal([&] { tufted::read(path, tufted::ReadAs::cloud); });
    EXPECT_NE(expected.find(name + ": byte "), std::string::npos) << expected;
    EXPECT_EQ(refusal([&] { RecordFile::open(path); }), expected);
  }
}

TEST(RecordFile, OfAPcdThatEndsBehindItsHeaderNamesTheByte) {
  const TemporaryDir dir;
  const auto path =
      dir.write("a.pcd", "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 3\nHEIGHT 1\nPOINTS 3\nDATA binary");
  EXPECT_EQ(refusal([&] { RecordFile::open(path); }), refusal([&] { tufted::read(path); }));
}

TEST(FileSource, OfALongHeaderIsReadInPassesToo) {
  const TemporaryDir dir;
  const std::string comment = "comment " + std::string(std::size_t{1} << 20, 'c') + '\n';
  const auto path = dir.write("a.ply", "ply\nformat binary_little_endian 1.0\n" + comment +
                                           "element vertex 48\nproperty float x\nproperty float y\n"
                                           "property float z\nend_header\n" +
                                           packed<float>(rows(3)));
  EXPECT_NE(RecordFile::open(path), nullptr);
  EXPECT_TRUE(areSame(pointsOf(tufted::sourceOf(path)), tufted::read(path).points));
}

TEST(FileSource, HasTheChosenPoints) {
  const TemporaryDir dir;
  for (const auto& [name, bytes] : files) {
    const auto path = dir.write(name, bytes);
    for (const tufted::Selection& selection :
         {tufted::Selection(), tufted::Selection{.where = {"y<=5", "x!=10,11.5"}},
          tufted::Selection{.crop = Eigen::AlignedBox3d(Eigen::Vector3d(2, 0, -1e9), Eigen::Vector3d(1e9, 6e6, 1e9))},
          tufted::Selection{.polygon = {{3, 0}, {1e7, 0}, {1e7, 1e7}, {3, 1e7}}}, tufted::Selection{.thin = 1.5}}) {
      Geometry whole = tufted::read(path, tufted::ReadAs::cloud);
      const bool is_las = whole.points(1, 0) > 1e4;
      if (is_las && !selection.where.empty()) continue;
      std::vector<int> chosen;
      if (!selection.isEmpty()) chosen = tufted::select(whole, selection);
      const FileSource source = tufted::sourceOf(path, tufted::ReadAs::cloud, selection);
      EXPECT_TRUE(areSame(pointsOf(source), whole.points)) << name;
      EXPECT_TRUE(areSame(pointsOf(source), whole.points)) << name << ", second pass";
      EXPECT_EQ(source.of, points);
      EXPECT_EQ(source.kept, selection.isEmpty() ? points : std::ssize(chosen)) << name;
      ASSERT_EQ(bool(source.rows), !selection.isEmpty() && whole.height == 1) << name;
      std::vector<int> given;
      if (source.rows) {
        source.rows([&](const auto& batch) { given.insert(given.end(), batch.begin(), batch.end()); });
        EXPECT_EQ(given, chosen) << name;
      }
    }
  }
}

TEST(FileSource, RefusesWhatIsNoCloudAndSelectionsOfNothing) {
  const TemporaryDir dir;
  const auto mesh = dir.write("faces.ply", files.at("faces.ply"));
  EXPECT_NE(refusal([&] { tufted::sourceOf(mesh); }).find("faces.ply holds a mesh"), std::string::npos);
  EXPECT_NE(refusal([&] {
              tufted::sourceOf(mesh, tufted::ReadAs::cloud, {.where = {"x>1000"}});
            }).find("none of the 48 points"),
            std::string::npos);
  EXPECT_NE(
      refusal([&] { tufted::sourceOf(mesh, tufted::ReadAs::cloud, {.where = {"w>1000"}}); }).find("'w' is no field"),
      std::string::npos);
  EXPECT_THROW(tufted::sourceOf(mesh, tufted::ReadAs::cloud, {.where = {"x>1"}}, [](auto, double) { return false; }),
               tufted::Cancelled);
}

TEST(FileSource, NotesBytesBehindThePointsOnce) {
  const TemporaryDir dir;
  for (const char* const name : {"2.las", "big.ply", "row.pcd", "named.npy"})
    for (const std::string& more : {std::string("abc"), std::string(5, '\0')}) {
      const auto path = dir.write(name, files.at(name) + more);
      const FileSource source = tufted::sourceOf(path);
      pointsOf(source);
      EXPECT_EQ(source.notes, tufted::read(path).notes);
      EXPECT_EQ(source.notes.size(), 1u);
    }
}

TEST(FileSource, RefusesAFileThatChanges) {
  const TemporaryDir dir;
  for (const char* const name : {"4.las", "row.pcd"}) {
    const std::string& bytes = files.at(name);
    const auto path = dir.write(name, bytes);
    const auto file = RecordFile::open(path, small_batch);
    const auto read = [&] { file->forBatches([](const Geometry&, std::int64_t) {}); };
    read();
    std::string changed = bytes;
    changed[file->layout().begin + 1] ^= 1;
    dir.write(name, changed);
    EXPECT_EQ(refusal(read).find(path.string() + ": byte " + std::to_string(file->layout().begin) + ": the points"), 0u)
        << refusal(read);
    dir.write(name, bytes);
    read();
    std::filesystem::resize_file(path, file->layout().begin + 500);
    EXPECT_EQ(refusal(read).find(path.string() + ": byte " + std::to_string(file->layout().begin + 500) +
                                 ": the file ends there"),
              0u)
        << refusal(read);
  }
}

}  // namespace
}  // namespace record_file_test
