// tufted_surface: how well noise is told from detail on real shapes and scans. See --help.
#include <CGAL/Monge_via_jet_fitting.h>
#include <CGAL/Simple_cartesian.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "base/median.h"
#include "bench/nearest_points.h"
#include "bench/real_images.h"
#include "bench/real_scans.h"
#include "bench/real_shapes.h"
#include "oracles/oracles.h"
#include "tufted/curvature.h"
#include "tufted/denoise.h"
#include "tufted/io/read.h"
#include "tufted/laplacian.h"
#include "tufted/normals.h"
#include "tufted/spectrum.h"

namespace tufted::bench {
namespace {

constexpr int eigenvalues = 40;

struct Settings {
  std::filesystem::path real = std::filesystem::path(TUFTED_DATA_DIR).parent_path() / "real";
  Half half = Half::both;
  std::vector<int> points = {8000, 20000};
  std::vector<double> noise = {0, .1, .3, .6};
  std::uint64_t first_seed = 101;
  int seeds = 5;

  bool asksFor(Half of_file) const { return half == Half::both || half == of_file; }
};

/// A variant of the build.
struct Column {
  std::string name;
  CloudOptions options;
};

std::vector<Column> columns() {
  CloudOptions as_measured;
  as_measured.steps.denoise = false;
  return {{"clean", cloudOptions(Preset::clean)}, {"default", {}}, {"as measured", as_measured}};
}

/// For each column the geometric mean over seeds of the error of eigenvalues, and the mean error of the area.
struct ShapeRow {
  std::vector<double> error, area;
};

ShapeRow shapeRow(const RealShape& shape, int points, double noise, const Settings& settings) {
  const std::vector<Column> builds = columns();
  ShapeRow row{std::vector<double>(builds.size(), 0), std::vector<double>(builds.size(), 0)};
  for (int s = 0; s < settings.seeds; ++s) {
    const Points cloud = sampleOf(shape, points, noise, settings.first_seed + static_cast<std::uint64_t>(s)).points;
    for (std::size_t c = 0; c < builds.size(); ++c) {
      const Laplacian laplacian = pointCloudLaplacian(cloud, builds[c].options);
      const VectorXd found = spectrum(laplacian, eigenvalues, {.null_space = false}).values;
      row.error[c] += std::log(oracles::meanRelativeError(found, shape.eigenvalues)) / settings.seeds;
      row.area[c] += (laplacian.report.area / shape.area - 1) / settings.seeds;
    }
  }
  for (double& error : row.error) error = std::exp(error);
  return row;
}

void printShapes(const Settings& settings) {
  const std::vector<Column> builds = columns();
  std::printf("| shape | points | noise |");
  for (const Column& build : builds) std::printf(" %s |", build.name.c_str());
  std::printf("\n|---|---|---|");
  for (std::size_t c = 0; c < builds.size(); ++c) std::printf("---|");
  std::printf("\n");
  std::map<std::pair<int, double>, std::vector<std::vector<double>>> ratios;  // of each column to the best one
  for (const auto& [path, half] : shapeFiles(settings.real / "shapes")) {
    if (!settings.asksFor(half)) continue;
    const RealShape shape = realShape(path, eigenvalues);
    for (const int points : settings.points) {
      for (const double noise : settings.noise) {
        const ShapeRow row = shapeRow(shape, points, noise, settings);
        std::printf("| %s | %d | %g |", shape.name.c_str(), points, noise);
        for (std::size_t c = 0; c < builds.size(); ++c)
          std::printf(" %.1e (%+.1f %%) |", row.error[c], 100 * row.area[c]);
        std::printf("\n");
        std::fflush(stdout);
        const double best = *std::min_element(row.error.begin(), row.error.end());
        auto& of_row = ratios[{points, noise}];
        of_row.resize(builds.size());
        for (std::size_t c = 0; c < builds.size(); ++c) of_row[c].push_back(row.error[c] / best);
      }
    }
  }
  for (const auto& [row, of_row] : ratios) {
    std::printf("| over the best: median; worst | %d | %g |", row.first, row.second);
    for (const auto& of_column : of_row) {
      Buffer<double> values(of_column.begin(), of_column.end());
      const double worst = *std::max_element(of_column.begin(), of_column.end());
      std::printf(" %.2f; %.2f |", medianOf(std::move(values)), worst);
    }
    std::printf("\n");
  }
}

void printVertices(const Settings& settings) {
  std::printf("| vertices of | points | moved |\n|---|---|---|\n");
  for (const auto& [path, half] : shapeFiles(settings.real / "shapes")) {
    if (!settings.asksFor(half)) continue;
    const RealShape shape = realShape(path, 0);
    const DenoiseReport report = denoise(shape.mesh.points).report;
    std::printf("| %s | %d | %.1f %% |\n", shape.name.c_str(), static_cast<int>(report.points),
                100 * static_cast<double>(report.moved) / static_cast<double>(report.points));
  }
}

/// The median angle between normals and exact ones, in degrees.
double medianAngle(const Points& normals, const Points& exact) {
  Buffer<double> angles;
  for (Eigen::Index i = 0; i < exact.rows(); ++i)
    if (normals.row(i).allFinite() && !normals.row(i).isZero())
      angles.push_back(std::acos(std::min(1.0, std::abs(normals.row(i).dot(exact.row(i))))) * 180 / std::numbers::pi);
  return medianOf(std::move(angles));
}

/// Compares normals with those of planes fitted to fixed numbers of nearest points.
void printNormals(const Settings& settings) {
  constexpr std::array<int, 4> windows = {10, 16, 30, 48};
  std::printf("| shape | points | noise | planes of 10; 16; 30; 48 | normals() | over the best | signs right |\n");
  std::printf("|---|---|---|---|---|---|---|\n");
  for (const auto& [path, half] : shapeFiles(settings.real / "shapes")) {
    if (!settings.asksFor(half)) continue;
    const RealShape shape = realShape(path, 0);
    for (const int points : settings.points) {
      for (const double noise : settings.noise) {
        const shapes::Cloud cloud = sampleOf(shape, points, noise, settings.first_seed);
        const NearestPoints nearest(cloud.points);
        std::array<Points, windows.size()> planes;
        planes.fill(Points(points, 3));
        for (int i = 0; i < points; ++i) {
          const std::vector<std::size_t> near = nearest.of(cloud.points.row(i), windows.back());
          for (std::size_t w = 0; w < windows.size(); ++w)
            planes[w].row(i) = frameOf(rowsOf(cloud.points, near, windows[w])).axes.col(2);
        }
        const Points normals = orientedFrames(pointCloudLaplacian(cloud.points)).normals;
        const double found = medianAngle(normals, cloud.normals);
        double best = std::numeric_limits<double>::infinity();
        std::printf("| %s | %d | %g |", shape.name.c_str(), points, noise);
        for (std::size_t w = 0; w < windows.size(); ++w) {
          const double angle = medianAngle(planes[w], cloud.normals);
          best = std::min(best, angle);
          std::printf("%s %.2f", w > 0 ? ";" : "", angle);
        }
        const auto right = ((normals.array() * cloud.normals.array()).rowwise().sum() > 0).count();
        std::printf(" | %.2f | %.2f | %.1f %% |\n", found, found / best, 100.0 * static_cast<double>(right) / points);
        std::fflush(stdout);
      }
    }
  }
}

/// Median and 90th percentile of the error of both principal curvatures, over the median of their size.
std::array<double, 2> curvatureError(const Eigen::MatrixX2d& found, const Eigen::MatrixX2d& exact) {
  Buffer<double> errors, sizes;
  for (Eigen::Index i = 0; i < exact.rows(); ++i) {
    errors.push_back((found.row(i) - exact.row(i)).norm());
    sizes.push_back(exact.row(i).norm());
  }
  const auto last = errors.begin() + std::ssize(errors) * 9 / 10;
  std::nth_element(errors.begin(), last, errors.end());
  const double size = medianOf(std::move(sizes)), most = *last / size;
  return {medianOf(std::move(errors)) / size, most};
}

/// The principal curvatures at a vertex of a fine mesh, descending, from a polynomial of degree 4 that CGAL fits to the
/// nearest vertices.
Eigen::RowVector2d exactCurvatures(const NearestPoints& vertices, const Eigen::RowVector3d& place,
                                   const Eigen::RowVector3d& normal) {
  using Kernel = CGAL::Simple_cartesian<double>;
  constexpr int fitted = 30, degree = 4;
  std::vector<Kernel::Point_3> points;
  for (const std::size_t v : vertices.of(place, fitted)) {
    const auto q = vertices.points().row(static_cast<Eigen::Index>(v));
    points.emplace_back(q[0], q[1], q[2]);
  }
  auto form = CGAL::Monge_via_jet_fitting<Kernel>()(points.begin(), points.end(), degree, 2);
  form.comply_wrt_given_normal({normal[0], normal[1], normal[2]});
  return {-form.principal_curvatures(1), -form.principal_curvatures(0)};
}

/// Compares curvatures of points with those of the smooth surface that they are taken from.
void printCurvatures(const Settings& settings) {
  constexpr int fine_faces = 400000;
  std::printf("| shape | points | noise | median error | 90 %% below | rings | us per point |\n");
  std::printf("|---|---|---|---|---|---|---|\n");
  for (const auto& [path, half] : shapeFiles(settings.real / "shapes")) {
    if (!settings.asksFor(half)) continue;
    const RealShape shape = smoothed(realShape(path, 0), fine_faces);
    if (shape.mesh.triangles.rows() == 0) continue;
    const NearestPoints vertices(shape.mesh.points);
    for (const int points : settings.points) {
      const shapes::Cloud truth = sampleOf(shape, points, 0, settings.first_seed);
      Eigen::MatrixX2d exact(points, 2);
      for (int i = 0; i < points; ++i)
        exact.row(i) = exactCurvatures(vertices, truth.points.row(i), truth.normals.row(i));
      for (const double noise : settings.noise) {
        const shapes::Cloud cloud = sampleOf(shape, points, noise, settings.first_seed);
        const Laplacian laplacian = pointCloudLaplacian(cloud.points);
        Frames frames = laplacian.frames;
        for (int i = 0; i < points; ++i)
          if (frames.normals.row(i).dot(cloud.normals.row(i)) < 0) frames.normals.row(i) *= -1;
        const Curvatures found = curvatures(laplacian, frames, {.threads = 1});
        const auto [median, most] = curvatureError(found.principal, exact);
        std::printf("| %s | %d | %g | %.3f | %.3f | %.1f | %.1f |\n", shape.name.c_str(), points, noise, median, most,
                    found.report.mean_rings, 1e6 * found.report.seconds / points);
        std::fflush(stdout);
      }
    }
  }
}

constexpr const char* prediction_columns = "points | as measured | denoised | moved |\n|---|---|---|---|---|\n";

void printRow(const std::string& name, Eigen::Index points, const Prediction& found) {
  std::printf("| %s | %d | %.4f | %.4f | %.0f %% |\n", name.c_str(), static_cast<int>(points), found.as_measured,
              found.denoised, 100 * found.moved);
  std::fflush(stdout);
}

void printHidden(const Settings& settings) {
  std::printf("| half of the points of | %s", prediction_columns);
  for (const auto& [path, half] : scanFiles(settings.real / "scans")) {
    if (!settings.asksFor(half)) continue;
    const Points scan = finitePoints(path);
    printRow(path.stem().string(), scan.rows(), predictHidden(scan));
  }
}

/// Predicts one scan of the Stanford bunny from a second one, which is first moved to the pose in its README.
void printSecond(const Settings& settings) {
  const std::filesystem::path scans = settings.real / "scans";
  if (!exists(scans / "bun000.ply") || !exists(scans / "bun045.ply")) return;
  const Points first = read(scans / "bun000.ply", ReadAs::cloud).points;
  const Points second = read(scans / "bun045.ply", ReadAs::cloud).points;
  const Eigen::Quaterniond turn(0.955586, 0.00548449, -0.294635, -0.0038555);
  const Eigen::RowVector3d shift(-0.0520211, -0.000383981, -0.0109223);
  const Points near = (second * turn.normalized().toRotationMatrix()).rowwise() + shift;
  std::printf("| second scan of | %s", prediction_columns);
  printRow("bun000", first.rows(), predictSecond(first, near));
}

void printImageRow(const std::string& name, const ImagePrediction& found) {
  std::printf("| %s | %.3f | %.3f | %.3f |\n", name.c_str(), found.as_measured, found.by_tree, found.by_pixels);
  std::fflush(stdout);
}

void printImages(const Settings& settings) {
  std::printf("| depth image | as measured | denoised by the tree | by its pixels |\n|---|---|---|---|\n");
  const std::filesystem::path scans = settings.real / "scans";
  for (const auto& [path, half] : scanFiles(scans)) {
    if (!settings.asksFor(half)) continue;
    const RealImage image = realImage(path);
    if (image.isOne()) printImageRow(path.stem().string() + ", hidden rows", predictHiddenRows(image));
  }
  const std::filesystem::path one = scans / "capture0004.pcd", other = scans / "capture0005.pcd";
  if (!settings.asksFor(Half::held_out) || !exists(one) || !exists(other)) return;
  const RealImage first = realImage(one), second = realImage(other);
  printImageRow("capture0005 from 0004", predictSecondView(first, second));
  printImageRow("capture0004 from 0005", predictSecondView(second, first));
}

}  // namespace
}  // namespace tufted::bench

int main(int argc, char** argv) {
  namespace bench = tufted::bench;
  bench::Settings settings;
  const std::map<std::string, void (*)(const bench::Settings&)> tables = {
      {"shapes", bench::printShapes},        {"vertices", bench::printVertices}, {"hidden", bench::printHidden},
      {"second", bench::printSecond},        {"images", bench::printImages},     {"normals", bench::printNormals},
      {"curvatures", bench::printCurvatures}};
  const std::map<std::string, bench::Half> halves = {
      {"choosing", bench::Half::choosing}, {"held-out", bench::Half::held_out}, {"both", bench::Half::both}};
  std::vector<std::string> known, names;
  for (const auto& [name, print] : tables) known.push_back(name);
  CLI::App app("Tables of what is noise and what is detail, on real shapes and scans.");
  app.add_option("TABLE", names, "Which (all)")->check(CLI::IsMember(known));
  app.add_option("--real", settings.real, "Folder of shapes/ and scans/");
  app.add_option("--half", settings.half, "Which half of the files")->transform(CLI::CheckedTransformer(halves));
  app.add_option("--points", settings.points, "Points drawn on a shape");
  app.add_option("--noise", settings.noise, "Its standard deviation in spacings");
  app.add_option("--seed", settings.first_seed, "The first seed; constants are chosen on 1 to 9");
  app.add_option("--seeds", settings.seeds, "How many seeds");
  CLI11_PARSE(app, argc, argv);
  try {
    for (const std::string& name : names.empty() ? known : names) tables.at(name)(settings);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tufted_surface: %s\n", error.what());
    return 1;
  }
}
