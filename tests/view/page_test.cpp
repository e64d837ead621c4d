#include "tufted/view/page.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>

#include "tufted/errors.h"
#include "view/page_parts.h"
#include "view/spacing.h"

namespace tufted::page_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// `count` numbers from 0 to 1, the same on every system.
Eigen::VectorXd randomNumbers(Eigen::Index count, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  Eigen::VectorXd numbers(count);
  for (double& number : numbers) number = static_cast<double>(engine() >> 11) * 0x1p-53;
  return numbers;
}

Scene randomScene(Eigen::Index count) {
  const Eigen::VectorXd numbers = randomNumbers(3 * count, 1);
  return {.title = "random",
          .positions = Eigen::Map<const Points>(numbers.data(), count, 3),
          .fields = {{"value", FieldKind::scalar, randomNumbers(count, 2)}}};
}

/// The values that a page gives back.
Eigen::VectorXd decoded(const view::LevelColumn& column) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(column.levels.size()));
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const std::uint16_t level = column.levels[static_cast<std::size_t>(i)];
    values[i] = level == view::no_level ? nan : column.least + column.step * level;
  }
  for (std::size_t k = 0; k < column.far_rows.size(); ++k)
    values[static_cast<Eigen::Index>(column.far_rows[k])] = column.far_values[k];
  return values;
}

/// Texts that must not be found, as they would end an element or begin one.
std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

template <typename Function>
std::string refusal(const Function& function) {
  try {
    function();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "nothing thrown";
}

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "tufted-page-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  std::ptrdiff_t entries() const {
    return std::distance(std::filesystem::directory_iterator(path_), std::filesystem::directory_iterator());
  }

 private:
  std::filesystem::path path_;
};

std::string content(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

TEST(LevelColumn, IsOffByHalfAStep) {
  for (const double scale : {1e-300, 1e-9, 1.0, 1e12, 1e300})
    for (const double shift : {0.0, 3.0, -1e3}) {
      const Eigen::VectorXd values = scale * (randomNumbers(5000, 3).array() + shift);
      const view::LevelColumn column = view::levelsOf(values);
      const double rounding = 4 * std::numeric_limits<double>::epsilon() * values.cwiseAbs().maxCoeff();
      EXPECT_LE((decoded(column) - values).cwiseAbs().maxCoeff(), column.step / 2 + rounding) << scale << ", " << shift;
      EXPECT_NEAR(column.step, (values.maxCoeff() - values.minCoeff()) / 65534, 1e-6 * column.step);
      EXPECT_TRUE(column.far_rows.empty());
    }
}

TEST(LevelColumn, OfFarOutliersKeepsTheDigitsOfTheOthers) {
  const Eigen::VectorXd values = randomNumbers(5000, 4);
  const double step = view::levelsOf(values).step;
  for (const double far : {1e3, 1e9, -1e300, 1.7e308}) {
    Eigen::VectorXd more = values;
    more[17] = far;
    more[4000] = -far;
    const view::LevelColumn column = view::levelsOf(more);
    EXPECT_LE(column.step, 14 * step) << far;  // six distances of percentiles on either side, and these themselves
    EXPECT_EQ(column.far_rows, (std::vector<std::uint32_t>{17, 4000}));
    EXPECT_EQ(decoded(column)[17], far);
    EXPECT_EQ(column.maximum, std::abs(far));
    EXPECT_LE((decoded(column) - more).cwiseAbs().maxCoeff(), 7 * step);
  }
}

TEST(LevelColumn, KeepsValuesThatAreNotFiniteApart) {
  const view::LevelColumn column = view::levelsOf(Eigen::Vector4d(1, nan, infinity, 2));
  EXPECT_EQ(column.levels, (std::vector<std::uint16_t>{0, 65535, 65535, 65534}));
  EXPECT_EQ(column.finite, 2);
  EXPECT_EQ(view::levelsOf(Eigen::Vector2d(nan, -infinity)).finite, 0);
  EXPECT_EQ(view::levelsOf(Eigen::VectorXd(0)).levels.size(), 0u);
}

TEST(LevelColumn, OfEqualValuesIsExact) {
  EXPECT_EQ(decoded(view::levelsOf(Eigen::Vector3d::Constant(0.1))), Eigen::Vector3d::Constant(0.1));
  Eigen::VectorXd values = Eigen::VectorXd::Constant(1000, -3);
  values[5] = 8;
  EXPECT_EQ(decoded(view::levelsOf(values)), values);
}

TEST(LevelColumn, OfTheWholeRangeOfDoublesDoesNotOverflow) {
  const Eigen::Vector3d values(-1.7e308, 0, 1.7e308);
  const view::LevelColumn column = view::levelsOf(values);
  EXPECT_TRUE(std::isfinite(column.step));
  EXPECT_EQ(column.levels, (std::vector<std::uint16_t>{0, 32767, 65534}));
}

TEST(LabelColumn, NamesEveryIntegerOnce) {
  Eigen::VectorXd values(6);
  values << 7, -1, 7, nan, 1e15, 0;
  const view::LabelColumn column = view::labelsOf(values);
  EXPECT_EQ(column.names, (std::vector<double>{-1, 0, 7, 1e15}));
  EXPECT_EQ(column.indices, (std::vector<std::uint32_t>{2, 0, 2, 4, 3, 1}));
}

TEST(OctahedralBytes, AreWithinADegree) {
  const Eigen::VectorXd numbers = randomNumbers(3000, 5).array() - 0.5;
  for (Eigen::Index i = 0; i < 1000; ++i) {
    const Eigen::Vector3d direction = numbers.segment<3>(3 * i);
    std::uint8_t bytes[2];
    view::octahedralBytes(1e300 * direction, bytes);
    const double x = (bytes[0] - 128) / 127.0, y = (bytes[1] - 128) / 127.0, z = 1 - std::abs(x) - std::abs(y);
    Eigen::Vector3d back(x, y, z);
    if (z < 0) back.head<2>() << (1 - std::abs(y)) * (x < 0 ? -1 : 1), (1 - std::abs(x)) * (y < 0 ? -1 : 1);
    EXPECT_GT(back.normalized().dot(direction.normalized()), std::cos(M_PI / 180));
  }
  std::uint8_t bytes[2] = {1, 1};
  view::octahedralBytes({0, nan, 1}, bytes);
  EXPECT_EQ(bytes[0], 0);
}

TEST(Base64, IsThatOfTheStandard) {  // RFC 4648, Section 10
  EXPECT_EQ(view::base64(""), "");
  EXPECT_EQ(view::base64("f"), "Zg==");
  EXPECT_EQ(view::base64("fo"), "Zm8=");
  EXPECT_EQ(view::base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(view::base64("\xff\xff\xfe"), "///+");
}

TEST(Page, OfAMillionRandomPointsAndAFieldIsUnderTwelveMegabytes) {
  EXPECT_LT(pageOf(randomScene(1000000)).size(), 12000000u);
}

TEST(Page, OfALargeCloudHasAShareOfItsPointsAndAllSources) {
  Scene scene = {.title = "grid", .positions = Points(40'000, 3)};
  for (int i = 0; i < 40'000; ++i) scene.positions.row(i) << i % 200, i / 200, 0;
  scene.positions(7, 0) = nan;
  scene.fields = {{"distance", FieldKind::distance, Eigen::MatrixXd::Ones(40'000, 1)}};
  scene.fields[0].values(12'345, 0) = 0;
  const std::vector<int> rows = view::thinned(scene, 4'000);
  EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end()));
  EXPECT_EQ(std::adjacent_find(rows.begin(), rows.end()), rows.end());
  EXPECT_NEAR(static_cast<double>(rows.size()), 4'000, 1);
  EXPECT_TRUE(std::binary_search(rows.begin(), rows.end(), 12'345));
  EXPECT_FALSE(std::binary_search(rows.begin(), rows.end(), 7));
  std::array<int, 16> cells = {};  // each part of the cloud keeps its share
  for (const int row : rows) ++cells[static_cast<std::size_t>(row % 200 / 50 + 4 * (row / 200 / 50))];
  for (const int cell : cells) EXPECT_NEAR(cell, 250, 12);
  const std::string page = pageOf(scene, {.most_points = 4'000});
  EXPECT_EQ(count(page, "\"count\":" + std::to_string(rows.size())), 1u);
  EXPECT_EQ(count(page, "\"finiteCount\":39999"), 1u);
  EXPECT_EQ(count(page, "\"sources\":["), 1u);
  EXPECT_EQ(count(page, "\"numbers\":"), 1u);
  for (const Eigen::Index all : {0, 40'000}) EXPECT_TRUE(view::thinned(scene, all).empty());
  scene.triangles = Triangles::Zero(1, 3);
  EXPECT_TRUE(view::thinned(scene, 4'000).empty());
}

TEST(Page, LoadsNothing) {
  const std::string page = pageOf(randomScene(10));
  EXPECT_EQ(count(page, "<link"), 1u);  // an empty icon, or a server would be asked for one
  EXPECT_EQ(count(page, "<img"), 0u);
  EXPECT_EQ(count(page, "src="), 0u);
  EXPECT_EQ(count(page, "default-src 'none'"), 1u);
  EXPECT_EQ(count(page, "Permission is hereby granted"), 1u);  // the licence of three.js
}

TEST(Page, OfHostileNamesHasTheElementsOfHarmlessOnes) {
  Scene scene = randomScene(10);
  const std::string harmless = pageOf(scene);
  constexpr char text[] = "</script><script>alert(1)</script><!--<script>\"'\\&\xff\xc3(\0\n";
  const std::string hostile(text, sizeof(text) - 1);  // with the 0 inside
  scene.title = scene.unit = scene.fields[0].name = scene.fields[0].unit = hostile;
  const std::string page = pageOf(scene);
  for (const char* part : {"<script", "</script", "<!--"}) EXPECT_EQ(count(page, part), count(harmless, part)) << part;
  EXPECT_EQ(page.find('\xff'), std::string::npos);
  EXPECT_EQ(page.find('\0'), std::string::npos);
  EXPECT_EQ(count(page, "\\ufffd"), 8u);  // two bytes that are not UTF-8 in each text
}

TEST(Page, OfOddScenesIsDefined) {
  EXPECT_FALSE(pageOf({.title = "", .positions = Points(0, 3)}).empty());
  Scene scene = {.title = "nothing", .positions = Points::Constant(5, 3, nan)};
  scene.triangles = Triangles::Zero(1, 3);
  scene.normals = Points::Constant(5, 3, infinity);
  for (const FieldKind kind : {FieldKind::scalar, FieldKind::positive, FieldKind::diverging, FieldKind::distance,
                               FieldKind::label, FieldKind::vector, FieldKind::coordinates, FieldKind::color}) {
    const int columns = kind == FieldKind::coordinates ? 2 : 3;
    scene.fields.push_back({"nothing", kind, Eigen::MatrixXd::Constant(5, columns, nan)});
  }
  const std::string page = pageOf(scene);
  EXPECT_EQ(count(page, "\"finite\":0"), 3u + 4 * 3 + 3 + 2);
}

TEST(Page, RefusesMistakes) {
  Scene scene = randomScene(10);
  EXPECT_EQ(refusal([&] { pageOf(scene, {.field = 1}); }), "pageOf: field 1, must be at least -1 and less than 1");
  EXPECT_EQ(refusal([&] { pageOf(scene, {.column = -1}); }), "pageOf: column -1, must be at least 0 and less than 1");
  EXPECT_NE(refusal([&] { pageOf(scene, {.color_map = "rainbow"}); }).find("rainbow"), std::string::npos);
  EXPECT_NE(refusal([&] { pageOf(scene, {.camera = {.eye = {nan, 0, 1}}}); }).find("eye"), std::string::npos);
  scene.fields[0].values.conservativeResize(9, 1);
  EXPECT_NE(refusal([&] { pageOf(scene); }).find("pageOf: field value has 9 rows"), std::string::npos);
}

TEST(WritePage, WritesTheWholePageOrNothing) {
  const TemporaryFolder folder;
  const Scene scene = randomScene(10);
  writePage(folder / "a.html", scene);
  writePage(folder / "a.html", scene);
  EXPECT_EQ(content(folder / "a.html"), pageOf(scene));
  EXPECT_EQ(folder.entries(), 1);
  for (const char* name : {"no/such/folder.html", "folder"}) {
    std::filesystem::create_directories(folder / "folder");
    try {
      writePage(folder / name, scene);
      ADD_FAILURE() << name;
    } catch (const IoError& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(folder.entries(), 2);
  EXPECT_THROW(writePage(folder / "b.html", scene, {.field = 9}), InvalidInput);
  EXPECT_EQ(folder.entries(), 2);
}

}  // namespace
}  // namespace tufted::page_test
