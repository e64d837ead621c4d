#include "tufted/view/picture.h"

#include <gtest/gtest.h>
#include <png.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <random>

#include "tufted/errors.h"
#include "view/color_maps.h"

namespace picture_test {
namespace {

using tufted::FieldKind;
using tufted::Picture;
using tufted::PictureOptions;
using tufted::Points;
using tufted::Rgb;
using tufted::Scene;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Points spherePoints(int count) {
  std::mt19937_64 generator(1);
  const auto uniform = [&] { return static_cast<double>(generator() >> 11) * 0x1p-53; };
  Points points(count, 3);
  for (int i = 0; i < count; ++i) {
    const double z = 2 * uniform() - 1;
    const double angle = 2 * std::numbers::pi * uniform();
    const double r = std::sqrt(1 - z * z);
    points.row(i) << r * std::cos(angle), r * std::sin(angle), z;
  }
  return points;
}

Scene sphereOf(int count) {
  Scene scene = {.title = "Sphere", .positions = spherePoints(count)};
  scene.normals = scene.positions;
  scene.fields = {{"height", FieldKind::scalar, scene.positions.col(2), "m"}};
  return scene;
}

Rgb pixelOf(const Picture& picture, int x, int y) {
  const std::uint8_t* const p = &picture.pixels[4 * (static_cast<std::size_t>(y) * picture.width + x)];
  return {p[0], p[1], p[2]};
}

/// Points of a square of side 2 around 0 at a depth along y.
void addSquare(double y, double label, Scene& scene) {
  constexpr int side = 60;
  const Eigen::Index first = scene.positions.rows();
  scene.positions.conservativeResize(first + side * side, 3);
  scene.fields[0].values.conservativeResize(first + side * side, 1);
  for (int i = 0; i < side * side; ++i) {
    scene.positions.row(first + i) << 2.0 * (i % side) / (side - 1) - 1, y, 2.0 * (i / side) / (side - 1) - 1;
    scene.fields[0].values(first + i, 0) = label;
  }
}

/// What libpng reads from a file.
Picture decode(const std::filesystem::path& file) {
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_file(&image, file.c_str()), 0) << image.message;
  image.format = PNG_FORMAT_RGBA;
  Picture picture = {static_cast<int>(image.width), static_cast<int>(image.height), {}};
  picture.pixels.resize(PNG_IMAGE_SIZE(image));
  EXPECT_NE(png_image_finish_read(&image, nullptr, picture.pixels.data(), 0, nullptr), 0) << image.message;
  return picture;
}

class PictureFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("tufted-picture-" + std::to_string(::getpid()));
    std::filesystem::create_directory(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
};

TEST_F(PictureFile, ASphereHasTheColoursOfItsHeights) {
  const Scene scene = sphereOf(1'000'000);
  PictureOptions options = {
      .width = 800, .height = 800, .range = std::array{-1.0, 1.0}, .light = false, .legend = false};
  options.camera.viewpoint = Eigen::Vector3d(0, -5, 0);
  options.camera.look_at = Eigen::Vector3d::Zero();
  options.camera.up = Eigen::Vector3d::UnitZ();
  tufted::writePicture(folder_ / "sphere.png", scene, options);
  const Picture picture = decode(folder_ / "sphere.png");
  ASSERT_EQ(picture.width, 800);
  ASSERT_EQ(picture.height, 800);
  const double focal = 400 / std::tan(0.31);
  const double silhouette = focal * std::tan(std::asin(1.0 / 5));
  const tufted::ColorMap& map = tufted::colorMap("viridis", "test");
  /// The height where the ray through a place on the screen meets the sphere.
  const auto heightAt = [focal](double x, double y) {
    const Eigen::Vector3d ray = Eigen::Vector3d((x - 400) / focal, 1, (400 - y) / focal).normalized();
    const Eigen::Vector3d eye(0, -5, 0);
    const double along = ray.dot(eye);
    return (eye + (-along - std::sqrt(along * along - 24)) * ray).z();
  };
  int worst = 0;
  for (int y = 0; y < 800; ++y)
    for (int x = 0; x < 800; ++x) {
      if (std::hypot(x + 0.5 - 400, y + 0.5 - 400) > silhouette - 3) continue;
      std::array<double, 3> expected = {0, 0, 0};
      for (const double u : {0.25, 0.75})
        for (const double v : {0.25, 0.75}) {
          const Rgb color = tufted::colorAt(map, 0.5 * heightAt(x + u, y + v) + 0.5);
          for (std::size_t k = 0; k < 3; ++k) expected[k] += 0.25 * color[k];
        }
      const Rgb color = pixelOf(picture, x, y);
      for (std::size_t k = 0; k < 3; ++k)
        worst = std::max(worst, static_cast<int>(std::ceil(std::abs(color[k] - expected[k]) - 0.5)));
    }
  EXPECT_LE(worst, 2);
  for (int x = 0; x < 800; ++x)  // beyond the silhouette there is nothing
    if (std::abs(x + 0.5 - 400) > silhouette + 3) {
      EXPECT_EQ(pixelOf(picture, x, 400), (Rgb{255, 255, 255})) << x;
    }
}

TEST_F(PictureFile, HasTheSameBitsForAnyNumberOfThreads) {
  Scene scene = sphereOf(20'000);
  scene.triangles.resize(2, 3);
  scene.triangles << 0, 1, 2, 3, 4, 5;
  PictureOptions options = {.width = 300, .height = 240, .isolines = true, .threads = 1};
  const Picture one = tufted::drawPicture(scene, options);
  options.threads = 2;
  EXPECT_EQ(tufted::drawPicture(scene, options).pixels, one.pixels);
  options.threads = 0;
  EXPECT_EQ(tufted::drawPicture(scene, options).pixels, one.pixels);
  tufted::writePicture(folder_ / "one.png", scene, options);
  EXPECT_EQ(decode(folder_ / "one.png").pixels, one.pixels);
}

TEST(PictureOf, ANearSurfaceHidesAFarOne) {
  for (const bool is_near_first : {false, true}) {
    Scene scene;
    scene.positions.resize(0, 3);
    scene.fields = {{"square", FieldKind::label, Eigen::MatrixXd(0, 1)}};
    addSquare(is_near_first ? -1 : 1, is_near_first ? 0 : 1, scene);
    addSquare(is_near_first ? 1 : -1, is_near_first ? 1 : 0, scene);
    PictureOptions options = {.width = 200, .height = 200, .light = false, .legend = false};
    options.camera.eye = Eigen::Vector3d(0, -1, 0);
    options.camera.up = Eigen::Vector3d::UnitZ();
    const tufted::ColorMap& map = tufted::colorMap("labels", "test");
    EXPECT_EQ(pixelOf(tufted::drawPicture(scene, options), 100, 100), map.colors[0]);
    options.camera.eye = Eigen::Vector3d(0, 1, 0);
    EXPECT_EQ(pixelOf(tufted::drawPicture(scene, options), 100, 100), map.colors[1]);
  }
}

TEST(PictureOf, TrianglesHaveTheValuesBetweenTheirCorners) {
  Scene scene;
  scene.positions.resize(4, 3);
  scene.positions << -1, 0, -1, 1, 0, -1, 1, 0, 1, -1, 0, 1;
  scene.triangles.resize(2, 3);
  scene.triangles << 0, 1, 2, 0, 2, 3;
  scene.fields = {{"x", FieldKind::scalar, scene.positions.col(0)}};
  PictureOptions options = {.width = 256, .height = 256, .light = false, .legend = false};
  options.camera.viewpoint = Eigen::Vector3d(0, -1 / std::tan(0.31), 0);  // the square fills the picture
  options.camera.look_at = Eigen::Vector3d::Zero();
  options.camera.up = Eigen::Vector3d::UnitZ();
  const Picture picture = tufted::drawPicture(scene, options);
  const tufted::ColorMap& map = tufted::colorMap("viridis", "test");
  for (int y = 2; y < 254; y += 3)
    for (int x = 2; x < 254; x += 3) {
      const Rgb expected = tufted::colorAt(map, (x + 0.5) / 256);
      for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(pixelOf(picture, x, y)[k], expected[k], 2) << x << ' ' << y;
    }
}

TEST(PictureOf, HasALegendOnRequest) {
  Scene scene = sphereOf(2'000);
  PictureOptions options = {.width = 600, .height = 400};
  const Picture with = tufted::drawPicture(scene, options);
  options.legend = false;
  const Picture without = tufted::drawPicture(scene, options);
  const auto marks = [](const Picture& picture, int left, int right, int top, int bottom) {
    int count = 0;
    for (int y = top; y < bottom; ++y)
      for (int x = left; x < right; ++x) count += pixelOf(picture, x, y) != Rgb{255, 255, 255};
    return count;
  };
  EXPECT_GT(marks(with, 0, 150, 0, 24), 50);        // the title
  EXPECT_GT(marks(with, 520, 600, 24, 400), 1000);  // the bar
  EXPECT_EQ(marks(without, 0, 100, 0, 24), 0);
  const tufted::ColorMap& map = tufted::colorMap("viridis", "test");
  bool has_least = false;
  bool has_greatest = false;
  for (int y = 0; y < 400; ++y)
    for (int x = 515; x < 600; ++x) {
      has_least = has_least || pixelOf(with, x, y) == map.colors[1];
      has_greatest = has_greatest || pixelOf(with, x, y) == map.colors[254];
    }
  EXPECT_TRUE(has_least && has_greatest);
}

TEST(PictureOf, OddDataIsDefined) {
  const auto draw = [](const Points& positions, FieldKind kind, int columns) {
    Scene scene = {.title = "", .positions = positions};
    scene.fields = {{"f", kind, Eigen::MatrixXd::Constant(positions.rows(), columns, 1)}};
    return tufted::drawPicture(scene, {.width = 64, .height = 48});
  };
  Points line(50, 3);
  for (int i = 0; i < 50; ++i) line.row(i) << i, 2.0 * i, 3.0 * i;
  Points mixed = line;
  mixed.row(7).setConstant(nan);
  mixed.row(9).setConstant(std::numeric_limits<double>::infinity());
  const std::vector<Points> all = {
      Points(0, 3), Points::Zero(1, 3), Points::Constant(5, 3, nan),  Points::Constant(40, 3, 2), line, mixed,
      1e300 * line, 1e-300 * line,      (line.array() + 1e9).matrix()};
  for (const Points& positions : all)
    for (const FieldKind kind :
         {FieldKind::scalar, FieldKind::positive, FieldKind::diverging, FieldKind::distance, FieldKind::label})
      EXPECT_EQ(draw(positions, kind, 1).pixels.size(), 4u * 64 * 48);
  EXPECT_EQ(draw(line, FieldKind::vector, 3).width, 64);
  EXPECT_EQ(draw(line, FieldKind::color, 3).width, 64);
  EXPECT_EQ(draw(line, FieldKind::coordinates, 2).width, 64);
}

TEST(PictureOf, IsTheSameForAnyScaleByAPowerOfTwo) {
  Scene scene = sphereOf(3'000);
  const Picture once = tufted::drawPicture(scene, {.width = 200, .height = 150});
  for (const double scale : {0x1p-900, 0x1p40, 0x1p900}) {
    Scene scaled = scene;
    scaled.positions *= scale;
    EXPECT_EQ(tufted::drawPicture(scaled, {.width = 200, .height = 150}).pixels, once.pixels) << scale;
  }
}

TEST(PictureOf, PointsWithoutAValueAreGrey) {
  Scene scene = sphereOf(3'000);
  scene.fields[0].values.setConstant(nan);
  const Picture picture = tufted::drawPicture(scene, {.width = 100, .height = 100, .light = false, .legend = false});
  EXPECT_EQ(pixelOf(picture, 50, 50), tufted::no_value_color);
  EXPECT_EQ(tufted::pointColors(scene), std::vector<Rgb>(3'000, tufted::no_value_color));
}

TEST(PictureOf, FarPointsOfNoSurfaceAreDots) {
  Scene scene;
  scene.fields = {{.name = "label", .kind = FieldKind::label, .values = {}}};
  addSquare(0, 1, scene);
  const Eigen::Index surface = scene.positions.rows(), far = 16;
  scene.positions.conservativeResize(surface + far, 3);
  scene.fields[0].values.conservativeResize(surface + far, 1);
  const auto otherPixels = [&](double value) {
    for (Eigen::Index i = 0; i < far; ++i) {
      scene.positions.row(surface + i) << 1.2 + 0.2 * (i % 4), 0, 0.2 * (i / 4);
      scene.fields[0].values(surface + i, 0) = value;
    }
    const Rgb color = tufted::pointColors(scene).back();
    const Picture picture = tufted::drawPicture(scene, {.width = 300, .height = 200, .light = false, .legend = false});
    int count = 0;
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) count += pixelOf(picture, x, y) == color ? 1 : 0;
    return count;
  };
  const int with_values = otherPixels(2), without = otherPixels(nan);
  EXPECT_GE(without, 16);
  EXPECT_GE(with_values, 4 * without);
}

TEST_F(PictureFile, ATransparentOneKeepsItsColours) {
  const PictureOptions options = {
      .width = 120, .height = 90, .background = tufted::Background::transparent, .light = false, .legend = false};
  tufted::writePicture(folder_ / "clear.png", sphereOf(5'000), options);
  const Picture picture = decode(folder_ / "clear.png");
  EXPECT_EQ(picture.pixels[3], 0);
  EXPECT_EQ(picture.pixels[4 * (45 * 120 + 60) + 3], 255);
}

TEST_F(PictureFile, AFileThatCannotBeWrittenIsNamedAndNothingIsLeft) {
  try {
    tufted::writePicture(folder_ / "none" / "a.png", sphereOf(10));
    FAIL();
  } catch (const tufted::IoError& error) {
    EXPECT_NE(std::string(error.what()).find("a.png"), std::string::npos);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(PictureFile, ALinkStaysAndWhatItLeadsToIsReplacedButNeverAPipe) {
  std::filesystem::create_symlink("target.png", folder_ / "link.png");
  tufted::writePicture(folder_ / "link.png", sphereOf(10), {.width = 40, .height = 30});
  EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "link.png"));
  EXPECT_EQ(decode(folder_ / "target.png").width, 40);
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  try {
    tufted::writePicture(folder_ / "pipe", sphereOf(10));
    FAIL();
  } catch (const tufted::IoError& error) {
    EXPECT_EQ(error.what(), (folder_ / "pipe").string() + ": cannot write: is no regular file");
  }
  EXPECT_TRUE(std::filesystem::is_fifo(folder_ / "pipe"));
}

TEST(PictureOf, MistakesAreRefused) {
  const Scene scene = sphereOf(20);
  const auto expectRefused = [&](const PictureOptions& options, const std::string& word) {
    try {
      tufted::drawPicture(scene, options);
      ADD_FAILURE() << word;
    } catch (const tufted::InvalidInput& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  expectRefused({.width = 15}, "width 15");
  expectRefused({.height = 8193}, "height 8193");
  expectRefused({.field = 1}, "field 1");
  expectRefused({.field = -2}, "field -2");
  expectRefused({.column = 1}, "column 1");
  expectRefused({.color_map = "jet"}, "jet");
  expectRefused({.range = std::array{1.0, 1.0}}, "range");
  expectRefused({.camera = {.eye = {nan, 0, 0}}}, "eye");
  expectRefused({.camera = {.elevation = 91}}, "elevation");
  expectRefused({.camera = {.zoom = 0}}, "zoom");
  Scene wrong = scene;
  wrong.fields[0].values.resize(3, 1);
  EXPECT_THROW(tufted::drawPicture(wrong), tufted::InvalidInput);
}

}  // namespace
}  // namespace picture_test
