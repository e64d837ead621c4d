// Choosing points: fields of every format, boxes, polygons and thinning.
#include "tufted/io/select.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <random>

#include "../support/refusal.h"
#include "field_values.h"
#include "las_file.h"
#include "temporary_dir.h"
#include "tufted/errors.h"
#include "tufted/io/results.h"

namespace select_test {
namespace {

using Eigen::Vector2d;
using tufted::Geometry;
using tufted::Points;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The rows that a comparison keeps; none if it keeps no point.
std::vector<int> kept(Geometry geometry, const std::string& comparison) {
  try {
    return tufted::select(geometry, {.where = {comparison}});
  } catch (const tufted::InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("none of the"), std::string::npos) << error.what();
    return {};
  }
}

std::string refusal(Geometry geometry, const tufted::Selection& selection) {
  return tufted::support::refusal([&] { tufted::select(geometry, selection); });
}

/// Four points with two fields in a format that stores them as text.
Geometry parseText(const std::string& bytes, const std::string& name) {
  return tufted::parse(bytes, name);
}

const std::string rows = "0 0 0 2 10.5\n1 0 0 5 20\n0 1 0 6 -3\n1 1 7 2 nan\n";

/// The same points and fields as in `rows`, as an array of records.
std::string npyOfRows() {
  std::string header =
      "{'descr': [('x','<f8'),('y','<f8'),('z','<f8'),('classification','|u1'),('Intensity','<f4')], "
      "'fortran_order': False, 'shape': (4,), }";
  header.resize(246 - 1, ' ');  // with the line's end 0xf6 bytes
  std::string bytes = std::string("\x93NUMPY\x01\x00", 8) + std::string("\xf6\x00", 2) + header + "\n";
  const auto add = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof(value)); };
  const double at[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 7}};
  const std::uint8_t classes[] = {2, 5, 6, 2};
  const float intensities[] = {10.5F, 20, -3, std::numeric_limits<float>::quiet_NaN()};
  for (int i = 0; i < 4; ++i) {
    for (const double x : at[i]) add(x);
    add(classes[i]);
    add(intensities[i]);
  }
  return bytes;
}

std::vector<Geometry> everyFormat() {
  return {parseText("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                    "property uchar classification\nproperty float intensity\nend_header\n" +
                        rows,
                    "a.ply"),
          parseText("FIELDS x y z classification intensity\nSIZE 4 4 4 1 4\nTYPE F F F U F\nCOUNT 1 1 1 1 1\nWIDTH 4\n"
                    "HEIGHT 1\nPOINTS 4\nDATA ascii\n" +
                        rows,
                    "a.pcd"),
          parseText("//X Y Z Classification Intensity\n" + rows, "a.xyz"), parseText(npyOfRows(), "a.npy")};
}

TEST(Select, FieldsOfEveryFormatAreComparedInTheSameWay) {
  for (const Geometry& geometry : everyFormat()) {
    SCOPED_TRACE(geometry.format);
    using Rows = std::vector<int>;
    EXPECT_EQ(kept(geometry, "classification=2,6"), (Rows{0, 2, 3}));
    EXPECT_EQ(kept(geometry, "classification == 2 , 6"), (Rows{0, 2, 3}));
    EXPECT_EQ(kept(geometry, "Classification!=2,6"), (Rows{1}));
    EXPECT_EQ(kept(geometry, "intensity>10.5"), (Rows{1}));
    EXPECT_EQ(kept(geometry, "intensity>=10.5"), (Rows{0, 1}));
    EXPECT_EQ(kept(geometry, "intensity<10.5"), (Rows{2}));
    EXPECT_EQ(kept(geometry, "intensity <= 10.5"), (Rows{0, 2}));
    EXPECT_EQ(kept(geometry, "intensity=-3..10.5"), (Rows{0, 2}));
    EXPECT_EQ(kept(geometry, "classification=5..6,2..3"), (Rows{0, 1, 2, 3}));
    EXPECT_EQ(kept(geometry, "classification=-1e300..1e300"), (Rows{0, 1, 2, 3}));
    EXPECT_EQ(kept(geometry, "classification!=3..9"), (Rows{0, 3}));
    EXPECT_EQ(kept(geometry, "x=y"), (Rows{0, 3}));
    EXPECT_EQ(kept(geometry, "z>y"), (Rows{3}));
    EXPECT_EQ(kept(geometry, "classification=x,5"), (Rows{1}));
  }
}

TEST(Select, NanSatisfiesNoComparison) {
  for (const char* comparison : {"intensity=0", "intensity!=0", "intensity<1e9", "intensity>=-1e9", "x!=intensity"}) {
    const std::vector<int> found = kept(everyFormat()[0], comparison);
    EXPECT_EQ(std::count(found.begin(), found.end(), 3), 0) << comparison;
  }
}

TEST(Select, BitsOfLasAreFields) {
  LasFile file(4, 8);
  for (int i = 0; i < 8; ++i) {
    const std::size_t point = file.addPoint(i, 0, 0);
    file.set<std::uint8_t>(point + 14, static_cast<std::uint8_t>((i % 4 + 1) | 2 << 4));  // return i % 4 + 1 of 2
    file.set<std::uint8_t>(point + 16, static_cast<std::uint8_t>(i));
  }
  const Geometry geometry = tufted::parse(file.bytes(), "a.las");
  EXPECT_EQ(kept(geometry, "return_number=number_of_returns"), (std::vector<int>{1, 5}));
  EXPECT_EQ(kept(geometry, "return_number<number_of_returns"), (std::vector<int>{0, 4}));
  EXPECT_EQ(kept(geometry, "classification=2,6"), (std::vector<int>{2, 6}));
  EXPECT_EQ(kept(geometry, "ReturnNumber>3"), (std::vector<int>{3, 7}));
}

TEST(Select, PartsOfAFieldAndPackedColoursHaveNames) {
  const Geometry geometry = parseText(
      "FIELDS x y z rgb weights normal_x normal_y normal_z\nSIZE 4 4 4 4 4 4 4 4\nTYPE F F F U F F F F\n"
      "COUNT 1 1 1 1 2 1 1 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\nDATA ascii\n0 0 0 66051 3 4 0 0 1\n0 0 1 16711680 5 6 1 0 "
      "0\n",
      "a.pcd");
  EXPECT_EQ(kept(geometry, "red=1"), std::vector<int>{0});  // 66051 is 0x010203
  EXPECT_EQ(kept(geometry, "green=2"), std::vector<int>{0});
  EXPECT_EQ(kept(geometry, "blue=3"), std::vector<int>{0});
  EXPECT_EQ(kept(geometry, "red=255"), std::vector<int>{1});
  EXPECT_EQ(kept(geometry, "weights_1=6"), std::vector<int>{1});
  EXPECT_EQ(kept(geometry, "nz>0.5"), std::vector<int>{0});
}

TEST(Select, MalformedComparisonsAreRefusedWithTheFault) {
  const Geometry geometry = everyFormat()[0];
  const std::pair<const char*, const char*> faults[] = {
      {"", "missing"},
      {" ", "missing"},
      {"=2", "missing"},
      {"classification", "expected =, !=, <, <=, > or >="},
      {"classification 2", "expected =, !=, <, <=, > or >="},
      {"classification=", "missing"},
      {"classification=2,", "missing"},
      {"classification=,2", "missing"},
      {"classification=2 6", "expected the end"},
      {"classification=2=3", "expected the end"},
      {"classification>2,6", "expected the end"},
      {"classification>2..6", "a range follows only = and !="},
      {"classification=6..2", "LOW <= HIGH"},
      {"classification=2..", "LOW..HIGH"},
      {"classification=..2", "LOW..HIGH"},
      {"classification=nan..2", "LOW..HIGH"},
      {"classification=!2", "missing"},
      {"klass=2", "'klass' is no field, must be one of classification"},
      {"2=classification", "'2' is no field"},
      {"classification=two", "'two' is no field"}};
  for (const auto& [comparison, fault] : faults) {
    const std::string message = refusal(geometry, {.where = {"z<9", comparison}});
    EXPECT_NE(message.find(std::string("select: where = '") + comparison + "'"), std::string::npos) << message;
    EXPECT_NE(message.find(fault), std::string::npos) << message;
  }
}

Geometry cloudOf(const Points& points) {
  Geometry geometry;
  geometry.points = points;
  geometry.width = static_cast<int>(points.rows());
  return geometry;
}

/// Points in a cube, on a grid so coarse that many are equal and many lie on lines between grid points.
Points gridPoints(int count, int steps, const Eigen::RowVector3d& offset, double scale) {
  std::mt19937_64 generator(101);
  Points points(count, 3);
  for (double& x : points.reshaped()) x = static_cast<double>(generator() % static_cast<unsigned>(steps)) * scale;
  return points.rowwise() + offset;
}

TEST(Select, ABoxHasItsSides) {
  const Points points = gridPoints(500, 5, {0, 0, 0}, 1);
  Geometry geometry = cloudOf(points);
  const std::vector<int> found = tufted::select(
      geometry, {.crop = Eigen::AlignedBox3d(Eigen::Vector3d(1, 2, -infinity), Eigen::Vector3d(3, 2, 2))});
  std::vector<int> expected;
  for (int i = 0; i < 500; ++i)
    if (points(i, 0) >= 1 && points(i, 0) <= 3 && points(i, 1) == 2 && points(i, 2) <= 2) expected.push_back(i);
  EXPECT_EQ(found, expected);
  const auto box = [](double low) {
    return tufted::Selection{.crop = Eigen::AlignedBox3d(Eigen::Vector3d(0, low, 0), Eigen::Vector3d(3, 2, 2))};
  };
  EXPECT_NE(refusal(cloudOf(points), box(3)).find("crop"), std::string::npos);
  EXPECT_NE(refusal(cloudOf(points), box(nan)).find("crop"), std::string::npos);
}

std::vector<int> inside(const Points& points, const std::vector<Vector2d>& polygon) {
  Geometry geometry = cloudOf(points);
  return tufted::select(geometry, {.polygon = polygon});
}

TEST(Select, PolygonsThatShareAnEdgeShareNoPoint) {
  // At UTM offsets and with steps of 0.1, which doubles do not hold, many points lie on or beside the edge.
  const Eigen::RowVector3d offset(512345.7, 5412345.3, 0);
  const Points points = gridPoints(4000, 40, offset, 0.1);
  const auto at = [&](double x, double y) { return Vector2d(offset.x() + x, offset.y() + y); };
  const Vector2d low = at(-1, -1), right = at(5, -1), high = at(5, 5), left = at(-1, 5);
  const std::pair<std::vector<Vector2d>, std::vector<Vector2d>> cuts[] = {
      {{low, right, high}, {low, high, left}},
      {{low, right, at(5, 3.3), at(-1, 0.3)}, {at(-1, 0.3), at(5, 3.3), high, left}},
      {{low, at(1, -1), at(3, 5), left}, {right, high, at(3, 5), at(1, -1)}}};
  const std::vector<int> whole = inside(points, {low, right, high, left});
  EXPECT_EQ(whole.size(), 4000u);
  for (const auto& [one, other] : cuts) {
    std::vector<int> both = inside(points, one);
    const std::vector<int> rest = inside(points, other);
    EXPECT_GT(both.size(), 500u);
    EXPECT_GT(rest.size(), 500u);
    both.insert(both.end(), rest.begin(), rest.end());
    std::sort(both.begin(), both.end());
    EXPECT_EQ(both, whole);
  }
}

TEST(Select, APolygonMayTurnEitherWayAndCrossItself) {
  Points points(4, 3);
  points << 0, 0, 5, 0, 0.8, -5, 2, 0, 0, nan, 0, 0;
  std::vector<Vector2d> star;  // five points, every second joined: the middle is passed twice
  for (int k = 0; k < 5; ++k) star.emplace_back(std::sin(0.8 * M_PI * k), std::cos(0.8 * M_PI * k));
  EXPECT_EQ(inside(points, star), std::vector<int>{1});
  std::reverse(star.begin(), star.end());
  EXPECT_EQ(inside(points, star), std::vector<int>{1});
  EXPECT_EQ(inside(points, {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}), (std::vector<int>{0, 1}));
  EXPECT_NE(refusal(cloudOf(points), {.polygon = {{0, 0}, {1, 1}}}).find("at least 3"), std::string::npos);
  EXPECT_NE(refusal(cloudOf(points), {.polygon = {{0, 0}, {1, 1}, {nan, 1}}}).find("polygon"), std::string::npos);
  EXPECT_NE(refusal(cloudOf(points), {.polygon = {{0, 0}, {1, 1}, {1, nan}}}).find("polygon"), std::string::npos);
  EXPECT_NE(refusal(cloudOf(points), {.polygon = {{0, 0}, {1, 1}, {1e200, 1}}}).find("polygon"), std::string::npos);
}

/// Positions of some points, sorted.
std::vector<std::array<double, 3>> positionsOf(const Points& points, const std::vector<int>& chosen) {
  std::vector<std::array<double, 3>> positions;
  for (const int i : chosen) positions.push_back({points(i, 0), points(i, 1), points(i, 2)});
  std::sort(positions.begin(), positions.end());
  return positions;
}

/// Clouds at the origin and at UTM offsets, with equal points and distances of exactly the spacing.
std::vector<Points> thinned() {
  return {gridPoints(1500, 12, {0, 0, 0}, 1), gridPoints(1500, 1 << 20, {512345, 5412345, 300}, 12.0 / (1 << 20)),
          gridPoints(1500, 1 << 20, {-1e9, -6, 0}, 12.0 / (1 << 20)), gridPoints(300, 3, {1e17, 0, 0}, 16)};
}

TEST(Thin, ChosenPointsKeepTheSpacingAndTheOthersLieWithinIt) {
  for (const Points& points : thinned())
    for (const double spacing : {1e-9, 0.4, 1.0, 3.0, 1e6}) {
      const std::vector<int> chosen = tufted::thinPoints(points, spacing);
      EXPECT_TRUE(std::is_sorted(chosen.begin(), chosen.end()));
      for (int i = 0; i < points.rows(); ++i) {
        const bool is_chosen = std::binary_search(chosen.begin(), chosen.end(), i);
        const auto close = std::count_if(chosen.begin(), chosen.end(), [&](int j) {
          return (points.row(j) - points.row(i)).squaredNorm() < spacing * spacing;
        });
        EXPECT_TRUE(is_chosen ? close == 1 : close > 0) << i << ' ' << close;
      }
    }
}

TEST(Thin, TheOrderOfThePointsDoesNotMatter) {
  for (const Points& points : thinned()) {
    std::vector<int> order(static_cast<std::size_t>(points.rows()));
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), std::mt19937_64(102));
    const Points shuffled = points(order, Eigen::all);
    EXPECT_EQ(positionsOf(points, tufted::thinPoints(points, 1.5)),
              positionsOf(shuffled, tufted::thinPoints(shuffled, 1.5)));
  }
}

TEST(Thin, OddPointsAreLeftOut) {
  Points points(6, 3);
  points << nan, 0, 0, 1, 1, 1, 1, 1, 1, infinity, 0, 0, -0.0, 0, 0, 0, 0, 0;
  EXPECT_EQ(tufted::thinPoints(points, 0.5), (std::vector<int>{1, 4}));
  EXPECT_EQ(tufted::thinPoints(points, 1e-150), (std::vector<int>{1, 4}));
  EXPECT_EQ(tufted::thinPoints(points, 1e150).size(), 1u);
  EXPECT_TRUE(tufted::thinPoints(Points(0, 3), 1).empty());
  for (const double spacing : {0.0, -1.0, nan, infinity, 1e-160, 1e160})
    EXPECT_THROW(tufted::thinPoints(points, spacing), tufted::InvalidInput);
}

TEST(Select, KeptPointsKeepTheirFieldsAndKnowTheirRow) {
  Geometry geometry = everyFormat()[0];
  tufted::select(geometry, {.where = {"classification=2,6", "y=1"}});
  EXPECT_EQ(geometry.points, (Points(2, 3) << 0, 1, 0, 1, 1, 7).finished());
  EXPECT_EQ(geometry.width, 2);
  EXPECT_EQ(valuesOf<std::uint8_t>(*fieldNamed(geometry, "classification")), (std::vector<std::uint8_t>{6, 2}));
  EXPECT_EQ(valuesOf<float>(*fieldNamed(geometry, "intensity"))[0], -3);
  EXPECT_EQ(valuesOf<int>(*fieldNamed(geometry, "file_row")), (std::vector<int>{2, 3}));
  EXPECT_EQ(tufted::select(geometry, {.where = {"z=7"}}), std::vector<int>{1});
  EXPECT_EQ(valuesOf<int>(*fieldNamed(geometry, "file_row")), std::vector<int>{1});  // of the last selection

  const TemporaryDir dir;
  tufted::writeResults(dir / "out", {}, geometry, {{.name = "u", .values = Eigen::VectorXd::Ones(1)}});
  EXPECT_EQ(tufted::readArray(dir / "out/file_row.npy"), Eigen::MatrixXd::Ones(1, 1));
  const std::vector<std::string> files = tufted::filesOfResult(dir / "out");
  EXPECT_EQ(std::count(files.begin(), files.end(), "file_row.npy"), 1);
  EXPECT_EQ(valuesOf<int>(*fieldNamed(tufted::readPoints(dir / "out"), "file_row")), std::vector<int>{1});
}

TEST(Select, AnOrganizedCloudKeepsItsGrid) {
  Geometry geometry = everyFormat()[1];
  geometry.width = geometry.height = 2;
  geometry.normals = Points::Ones(4, 3);
  EXPECT_EQ(tufted::select(geometry, {.where = {"classification=2"}}), (std::vector<int>{0, 3}));
  EXPECT_EQ(geometry.height, 2);
  ASSERT_EQ(geometry.points.rows(), 4);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(geometry.points.row(i).hasNaN(), i == 1 || i == 2);
    EXPECT_EQ(geometry.normals.row(i).hasNaN(), i == 1 || i == 2);
  }
  EXPECT_EQ(fieldNamed(geometry, "file_row"), nullptr);
}

TEST(Select, NothingKeptMeshesAndSpacingsAreRefused) {
  const Geometry geometry = everyFormat()[0];
  EXPECT_NE(refusal(geometry, {.where = {"z>7"}}).find("none of the 4 points"), std::string::npos);
  for (const double spacing : {-1.0, nan, infinity})
    EXPECT_NE(refusal(geometry, {.thin = spacing}).find("spacing = "), std::string::npos);
  Geometry mesh = geometry;
  mesh.is_mesh = true;
  EXPECT_NE(refusal(mesh, {.thin = 1}).find("is a mesh"), std::string::npos);
  Geometry empty;
  empty.points.resize(0, 3);
  EXPECT_TRUE(tufted::select(empty, {.thin = 1}).empty());
}

}  // namespace
}  // namespace select_test
