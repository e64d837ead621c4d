// Writes the pages that the tests in a browser look at: page_sample DIR, and page_sample DIR N for one of N points.
#include <tufted/view/page.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <string>

namespace {

using tufted::FieldKind;
using tufted::Points;
using tufted::Scene;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const tufted::PageOptions from_above = {.camera = {.eye = {0, 0, 1}, .up = {0, 1, 0}}};

/// A square of side 2 around 0 at z = 0, of side * side points, row after row from y = -1 and x = -1 on.
Points square(int side) {
  Points points(side * side, 3);
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column)
      points.row(row * side + column) << 2.0 * column / (side - 1) - 1, 2.0 * row / (side - 1) - 1, 0;
  return points;
}

/// Points of a square with x as a field, four columns of constants, labels by quadrant, and no value in a corner.
Scene plane() {
  const Points points = square(101);
  Scene scene = {.title = "plane", .positions = points, .unit = "m"};
  Eigen::MatrixXd x = points.col(0);
  Eigen::MatrixXd columns(points.rows(), 4), labels(points.rows(), 1), colors(points.rows(), 3);
  for (Eigen::Index row = 0; row < points.rows(); ++row) {
    columns.row(row) << -1, 0, 0.5, 1;
    labels(row, 0) = (points(row, 0) > 0) + 2 * (points(row, 1) > 0);
    colors.row(row) << 255 * (points(row, 0) > 0), 0, 255;
    if (points(row, 0) < -0.5 && points(row, 1) < -0.5) x(row, 0) = nan;
  }
  columns(0, 0) = 1;  // so that the first column is not all the same
  columns(0, 1) = columns(0, 2) = columns(0, 3) = -1;
  scene.fields = {{"x", FieldKind::scalar, x, "m"},
                  {"steps", FieldKind::diverging, columns},
                  {"quadrant", FieldKind::label, labels},
                  {"paint", FieldKind::color, colors},
                  {"around 0", FieldKind::coordinates, points.leftCols<2>(), "m"},
                  {"far", FieldKind::distance, points.rowwise().norm(), "m"},
                  {"spread", FieldKind::positive, (3 * std::log(10) * points.col(0).array()).exp(), "m"}};
  scene.fields[2].label_names = {"south-west", "south-east"};
  scene.fields[0].no_value = "cut out";
  return scene;
}

/// The unit sphere as a mesh, z as a field.
Scene sphere() {
  const int rings = 48, sectors = 96;
  Scene scene = {.title = "sphere", .positions = Points((rings + 1) * sectors, 3)};
  scene.triangles.resize(2 * rings * sectors, 3);
  for (int ring = 0; ring <= rings; ++ring)
    for (int sector = 0; sector < sectors; ++sector) {
      const double polar = M_PI * ring / rings, angle = 2 * M_PI * sector / sectors;
      scene.positions.row(ring * sectors + sector) << std::sin(polar) * std::cos(angle),
          std::sin(polar) * std::sin(angle), std::cos(polar);
      if (ring == rings) continue;
      const int next = (sector + 1) % sectors, face = 2 * (ring * sectors + sector);
      scene.triangles.row(face) << ring * sectors + sector, (ring + 1) * sectors + sector, ring * sectors + next;
      scene.triangles.row(face + 1) << ring * sectors + next, (ring + 1) * sectors + sector,
          (ring + 1) * sectors + next;
    }
  scene.normals = scene.positions;
  scene.fields = {
      {"height", FieldKind::diverging, scene.positions.col(2)},
      {"distance", FieldKind::distance, scene.positions.col(2).array().min(1).max(-1).acos().matrix(), "m"}};
  return scene;
}

/// A square whose vectors go around its middle.
Scene whirl() {
  const Points points = square(101);
  Points vectors = Points::Zero(points.rows(), 3);
  vectors.col(0) = -points.col(1);
  vectors.col(1) = points.col(0);
  return {.title = "whirl", .positions = points, .fields = {{"around", FieldKind::vector, vectors, "m/s"}}};
}

/// A square in a unit of length, with lengths, coordinates and vectors in it, and with values that differ in their last
/// digits only.
Scene squareIn(double unit) {
  Scene scene = {.title = "unit", .positions = square(101)};
  const Points around = whirl().fields[0].values;
  scene.fields = {{"time", FieldKind::scalar, (3.2e8 + 30 * (1 + scene.positions.col(0).array())).matrix(), "s"},
                  {"x", FieldKind::scalar, unit * scene.positions.col(0)},
                  {"around 0", FieldKind::coordinates, unit * scene.positions.leftCols<2>()},
                  {"far", FieldKind::distance, unit * scene.positions.rowwise().norm()},
                  {"around", FieldKind::vector, unit * around}};
  scene.positions *= unit;
  return scene;
}

/// A square with a path along y = 0.2, from the left to the middle.
Scene walk() {
  Scene scene = {.title = "walk", .positions = square(101)};
  scene.fields = {{"x", FieldKind::scalar, scene.positions.col(0)}};
  scene.path.resize(3, 3);
  scene.path << -0.8, 0.2, 0, -0.7, 0.2, 0, 0, 0.2, 0;
  return scene;
}

/// What a depth camera sees: a floor that runs away from it, and a wall that stands on it and ends in the air. Rows of
/// the image one after another; a column and a corner have no depth.
Scene depthImage() {
  const int width = 160, height = 120;
  Scene scene = {.title = "depth image", .positions = Points(width * height, 3), .unit = "m"};
  Eigen::MatrixXd labels = Eigen::MatrixXd::Constant(width * height, 1, -1);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const double x = (column - 79.5) / 140, y = (row - 30) / 140.0;
      const bool is_wall = column > 50 && column < 110 && row > 20 && 2.5 * y < 1;
      const double depth = is_wall ? 2.5 : 1 / y;
      const bool is_seen = depth > 0 && depth < 4 && column != 30 && (row > 100 ? column < 150 : true);
      const Eigen::Index i = row * width + column;
      scene.positions.row(i) = (is_seen ? depth : nan) * Eigen::RowVector3d(x, y, 1);
      if (is_seen) labels(i, 0) = is_wall;
    }
  scene.fields = {{"label", FieldKind::label, labels}};
  return scene;
}

/// A square whose quarters have normals along x, y, -z and none, labels 0, 0, -1 and NaN, and a source in the middle.
Scene quarters() {
  Scene scene = {.title = "quarters", .positions = square(101)};
  const Eigen::Index n = scene.positions.rows();
  Eigen::MatrixXd normals = Eigen::MatrixXd::Zero(n, 3), labels = Eigen::MatrixXd::Zero(n, 1);
  for (Eigen::Index row = 0; row < n; ++row) {
    const int quarter = (scene.positions(row, 0) > 0) + 2 * (scene.positions(row, 1) > 0);
    if (quarter < 3) normals(row, quarter) = quarter == 2 ? -1 : 1;
    if (quarter > 1) labels(row, 0) = quarter == 2 ? -1 : nan;
  }
  scene.fields = {{"normals", FieldKind::direction, normals},
                  {"boundary", FieldKind::label, labels},
                  {"far", FieldKind::distance, scene.positions.rowwise().norm()}};
  return scene;
}

/// Names that would do harm as HTML or script.
Scene hostile() {
  Scene scene = plane();
  scene.title = "</script><script>window.harm = 1</script><img src=x onerror='window.harm = 2'>\"'&\xff\xfe\x00z";
  scene.fields[0].name = "</script><script>window.harm = 3</script><!--<script>";
  scene.fields[1].name = "<b onmouseover=\"window.harm = 4\">\xc3\x28";
  scene.fields[0].unit = "</option><script>window.harm = 5</script>";
  scene.unit = "&lt;\"><svg onload='window.harm = 6'>";
  return scene;
}

/// Random points of a cube with a field, the worst case for the size of a page.
Scene noise(Eigen::Index count) {
  Scene scene = {.title = "random points", .positions = Points(count, 3)};
  Eigen::VectorXd values(count);
  std::uint64_t state = 1;
  const auto random = [&state] {  // Vigna's splitmix64
    std::uint64_t z = state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ z >> 31) >> 11) * 0x1p-53;
  };
  for (Eigen::Index i = 0; i < count; ++i) {
    scene.positions.row(i) << random(), random(), random();
    values[i] = random();
  }
  scene.fields = {{"value", FieldKind::scalar, values}};
  return scene;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 2) return 2;
  const std::filesystem::path dir = argv[1];
  std::filesystem::create_directories(dir);
  if (argc > 2) {
    tufted::writePage(dir / (std::string(argv[2]) + ".html"), noise(std::stol(argv[2])));
    return 0;
  }
  tufted::writePage(dir / "plane.html", plane(), from_above);
  tufted::writePage(dir / "sphere.html", sphere());
  tufted::writePage(dir / "whirl.html", whirl(), from_above);
  for (const char* const unit : {"1", "1e-50", "1e50", "1e120"})
    tufted::writePage(dir / (std::string("unit-") + unit + ".html"), squareIn(std::stod(unit)), from_above);
  tufted::writePage(dir / "walk.html", walk(), from_above);
  tufted::writePage(dir / "depth.html", depthImage(), {.camera = {.eye = {0.3, -0.8, -1}, .up = {0, -1, 0}}});
  tufted::writePage(dir / "quarters.html", quarters(), from_above);
  tufted::writePage(dir / "thinned.html", quarters(),
                    {.camera = {.eye = {0, 0, 1}, .up = {0, 1, 0}, .is_parallel = true}, .most_points = 2000});
  tufted::writePage(dir / "hostile.html", hostile(), from_above);
  tufted::writePage(dir / "empty.html", {.title = "empty", .positions = Points(0, 3)});
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
