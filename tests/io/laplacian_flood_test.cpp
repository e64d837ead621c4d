// Archives that deflate has made a thousand times smaller, and reports of numbers that fit nowhere, are refused before
// they fill the memory.
#include <gtest/gtest.h>
#include <zip.h>

#include <cstring>
#include <map>

#include "laplacian_folder.h"
#include "memory_peak.h"
#include "odd_sphere.h"

namespace laplacian_flood_test {
namespace {

constexpr std::size_t many = 20'000'000;

std::string npy(const std::string& descr, const std::string& shape, const std::string& values) {
  const std::string header = "{'descr': '" + descr + "', 'fortran_order': False, 'shape': (" + shape + "), }\n";
  return std::string("\x93NUMPY\x01\0", 8) + static_cast<char>(header.size()) + '\0' + header + values;
}

template <class T>
std::string raw(const std::vector<T>& values) {
  return std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

std::string zeros(const std::string& shape, std::size_t count) {
  return npy("|u1", shape, std::string(count, '\0'));
}

using Arrays = std::map<std::string, std::string>;

class LaplacianFlood : public LaplacianFolder {
 protected:
  LaplacianFlood() {
    const tufted::Geometry sphere = tufted::oddSphere(101);
    tufted::writeLaplacian(dir_.path(), tufted::pointCloudLaplacian(sphere.points), sphere,
                           {.formats = {tufted::Format::npz, tufted::Format::cover}});
  }

  /// Puts an archive in place of a file.
  std::size_t pack(const std::string& name, const Arrays& arrays) const {
    const auto path = dir_ / name;
    zip_t* const archive = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
    for (const auto& [array, bytes] : arrays) {
      zip_source_t* const source = zip_source_buffer(archive, bytes.data(), bytes.size(), 0);
      const zip_int64_t index = zip_file_add(archive, (array + ".npy").c_str(), source, 0);
      zip_set_file_compression(archive, index, ZIP_CM_DEFLATE, 9);
    }
    EXPECT_EQ(zip_close(archive), 0);
    return std::filesystem::file_size(path);
  }

  void expectRefusal(const std::string& name, const Arrays& arrays, const std::string& reason) const {
    SCOPED_TRACE(reason);
    const std::size_t bytes = pack(name, arrays);
    EXPECT_LT(bytes, 200'000u);
    const MemoryPeak peak;
    EXPECT_NE(refusal().find(reason), std::string::npos) << refusal();
    if (!peak.bytes()) GTEST_SKIP() << "the system does not tell the peak of the memory";
    EXPECT_LT(*peak.bytes(), (is_sanitized ? 8 : 1) * (128.0 * static_cast<double>(bytes) + 4e6));
  }
};

/// A matrix of 200 rows and no entry.
Arrays emptyMatrix() {
  return {{"format", npy("|S3", "", "csc")},
          {"shape", npy("<i8", "2,", raw<std::int64_t>({200, 200}))},
          {"indptr", npy("<i4", "201,", raw(std::vector<int>(201)))},
          {"indices", npy("<i4", "0,", "")},
          {"data", npy("<f8", "0,", "")}};
}

TEST_F(LaplacianFlood, MatricesAreJudgedByWhatTheirArraysSay) {
  const auto expect = [&](const Arrays& changed, const std::string& reason) {
    Arrays arrays = emptyMatrix();
    for (const auto& [name, bytes] : changed) arrays[name] = bytes;
    expectRefusal("L.npz", arrays, reason);
  };
  const std::string entries = std::to_string(many) + ",";
  expect({{"data", zeros(entries, many)}}, "L.npz: has columns that do not fit its entries");
  expect({{"indices", zeros(entries, many)}}, "L.npz: has columns that do not fit its entries");
  expect({{"indptr", zeros(entries, many)}}, "L.npz: has columns that do not fit its entries");
  expect({{"shape", zeros(entries, many)}}, "'shape' has 20000000 values, must have 2");
  expect({{"format", npy("|S20000000", "", std::string(many, 'c'))}}, "'format' is no word");
  expect({{"data", zeros(entries, many)}, {"indices", zeros(entries, many)}}, "do not fit its entries");
  std::vector<int> all_in_one(201, static_cast<int>(many));
  all_in_one[0] = 0;
  expect({{"data", zeros(entries, many)},
          {"indices", zeros(entries, many)},
          {"indptr", npy("<i4", "201,", raw(all_in_one))}},
         "do not fit its entries");
  expect({{"shape", npy("<i8", "2,", raw<std::int64_t>({many, many}))}, {"indptr", zeros("20000001,", many + 1)}},
         "M.npy: is not an array of 20000000 values");
  expect({{"data", zeros("5,", many)}}, "bytes of values, its shape says another number");
  expect({{"data", std::string("\x93NUMPY\x02\0\0\0\0\1", 12) + std::string(many, ' ')}}, "'data' is damaged");
  expect({}, "L.npz: L(0, 0) = 0, must be above 0");  // whose arrays fit
}

TEST_F(LaplacianFlood, EntriesThatRepeatAreSummed) {
  Arrays arrays = emptyMatrix();
  std::vector<int> starts(201, 6);
  starts[0] = 0;
  arrays["indptr"] = npy("<i4", "201,", raw(starts));
  arrays["indices"] = npy("<i4", "6,", raw<int>({5, 0, 5, 3, 0, 5}));
  arrays["data"] = npy("<f8", "6,", raw<double>({1, 2, 4, 8, 16, 32}));
  for (const bool by_rows : {false, true}) {
    arrays["format"] = npy("|S3", "", by_rows ? "csr" : "csc");
    pack("L.npz", arrays);
    const tufted::SparseMatrix L = tufted::readUncheckedLaplacian(dir_.path()).L;
    const auto entry = [&](int i, int j) { return by_rows ? L.coeff(j, i) : L.coeff(i, j); };
    EXPECT_EQ(L.nonZeros(), 3);
    EXPECT_EQ(entry(0, 0), 18);
    EXPECT_EQ(entry(3, 0), 8);
    EXPECT_EQ(entry(5, 0), 37);
  }
}

TEST_F(LaplacianFlood, CoversAreJudgedByWhatTheirArraysSay) {
  constexpr std::size_t sides = many / 3 * 3;
  const std::string shape = std::to_string(sides / 3) + ", 3", two = "2, 3";
  const std::string glue = npy("<i4", two, raw<int>({5, 4, 3, 2, 1, 0}));
  expectRefusal("cover.npz",
                {{"faces", zeros(shape, sides)}, {"glue", zeros(shape, sides)}, {"length", zeros(shape, sides)}},
                "cover.npz: is no cover: sides that are glued to themselves or not back, side 0 the first");
  expectRefusal("cover.npz", {{"faces", zeros(two, 6)}, {"glue", glue}, {"length", zeros(shape, sides)}},
                "cover.npz: has arrays of different sizes");
  expectRefusal("cover.npz", {{"faces", zeros(shape, sides)}, {"glue", glue}, {"length", zeros(two, 6)}},
                "cover.npz: has arrays of different sizes");
}

TEST_F(LaplacianFlood, DamagedArraysAreNamed) {
  Arrays arrays = emptyMatrix();
  arrays["indptr"] = npy("<i4", "201,", raw(std::vector<int>(200)) + "abcd");
  const std::size_t bytes = pack("L.npz", arrays);
  std::string archive = readAll(dir_ / "L.npz");
  int damaged = 0;
  for (std::size_t i = 0; i < bytes; ++i) {
    std::string changed = archive;
    changed[i] = static_cast<char>(changed[i] ^ 0x10);
    dir_.write("L.npz", changed);
    EXPECT_NE(refusal(), "") << i;
    damaged += refusal() == "L.npz: the array 'indptr' is damaged";
  }
  EXPECT_GT(damaged, 0);
}

TEST_F(LaplacianFlood, NumbersOfTheReportMustFit) {
  const std::string report = readAll(dir_ / "report.json");
  const auto with = [&](const std::string& name, const std::string& value) {
    const std::string key = "\"" + name + "\": ";
    const std::size_t at = report.find(key) + key.size();
    dir_.write("report.json", report.substr(0, at) + value + report.substr(report.find_first_of(",\n", at)));
    return refusal();
  };
  EXPECT_EQ(with("points", "200"), "");
  EXPECT_EQ(with("points", "1e300"),
            "report.json: has points = '1e+300', must be an integer in [0, 9223372036854775807]");
  EXPECT_EQ(with("points", "18446744073709551615"),
            "report.json: has points = '18446744073709551615', must be an integer in [0, 9223372036854775807]");
  EXPECT_EQ(with("neighbors", "4294967326"),
            "report.json: has neighbors = '4294967326', must be an integer in [0, 2147483647]");
  for (const std::string value : {"-1", "2.5", "\"30\"", "true", "[]", "-9223372036854775808"})
    for (const std::string name : {"active", "triangles", "flips", "star_masses"})
      EXPECT_TRUE(with(name, value).starts_with("report.json: has " + name + " = ")) << name << " " << value;
  EXPECT_EQ(with("mean_edge", "null"), "");
}

TEST_F(LaplacianFlood, AReportIsNotNestedDeeply) {
  const std::string report = readAll(dir_ / "report.json");
  for (const std::string name : {"\"points\": ", "\"kind\": ", "\"write_options\": "}) {
    const std::size_t at = report.find(name);
    ASSERT_NE(at, std::string::npos);
    const std::string nested = std::string(1'000'000, '[') + std::string(1'000'000, ']');
    dir_.write("report.json", report.substr(0, at) + name + nested + ", " + report.substr(at));
    EXPECT_EQ(refusal(), "report.json: is nested deeper than 32 levels");
  }
}

}  // namespace
}  // namespace laplacian_flood_test
