// Accuracy of Laplacians of depth images with known surfaces, by pixels and by the tree.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "bench/depth_views.h"
#include "bench/tables.h"
#include "tufted/denoise.h"
#include "tufted/laplacian.h"

namespace tufted::bench {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

/// Whether an edge leads from one body to another along the line of sight.
bool isAcrossJump(const View& view, int i, int j) {
  if (view.bodies[i] == view.bodies[j]) return false;
  const Eigen::Vector3d a = view.points.row(i), b = view.points.row(j);
  const double along = std::abs(a.norm() - b.norm());
  const double across = std::sqrt(std::max(0.0, (a - b).squaredNorm() - along * along));
  return along > 6 * across + 0.01 * a.z();
}

/// Figures of one build.
struct Quality {
  double area = 0, local_area = 0, normal = 0, worst_normal = 0, linear = 0, across = 0, agreed = 0;

  Quality& operator+=(const Quality& other) {
    area += other.area;
    local_area += other.local_area;
    normal += other.normal;
    worst_normal += other.worst_normal;
    linear += other.linear;
    across += other.across;
    agreed += other.agreed;
    return *this;
  }
};

Quality measure(const View& view, const Points& points, const Laplacian& laplacian) {
  Quality quality;
  std::vector<double> angles, linear, areas(view.areas.size());
  for (int i = 0; i < points.rows(); ++i) {
    if (!std::isfinite(points(i, 0))) continue;
    const Eigen::Vector3d x = view.points.row(i), normal = view.normals.row(i);
    const double pixel = x.z() * x.z() / (view.focal * view.focal) / std::abs(normal.dot(x / x.z()));
    areas[view.areaOf(i, view.bodies[i])] += laplacian.M[i];
    const bool is_inside = isInside(view, i, 5);
    if (is_inside) {
      const double cosine = std::abs(normal.dot(laplacian.frames.normals.row(i).transpose()));
      angles.push_back(degrees * std::acos(std::min(1.0, cosine)));
    }
    Eigen::Vector3d image = Eigen::Vector3d::Zero();
    for (SparseMatrix::InnerIterator entry(laplacian.L, i); entry; ++entry) {
      const auto j = static_cast<int>(entry.row());
      image += entry.value() * view.points.row(j).transpose();
      if (j > i && entry.value() != 0 && isAcrossJump(view, i, j)) ++quality.across;
    }
    const double diagonal = laplacian.L.coeff(i, i);
    if (is_inside && diagonal > 0)
      linear.push_back((image - image.dot(normal) * normal).norm() / (diagonal * std::sqrt(pixel)));
  }
  // Excess area of one body or patch does not compensate for area missing in another.
  const double seen = std::accumulate(view.areas.begin(), view.areas.end(), 0.0);
  for (int body = 0; body < view.body_count; ++body) {
    double error = 0;
    for (std::size_t i = body; i < areas.size(); i += view.body_count) {
      error += areas[i] - view.areas[i];
      quality.local_area += std::abs(areas[i] - view.areas[i]) / seen;
    }
    quality.area += std::abs(error) / seen;
  }
  quality.normal = quantile(angles, 0.5);
  quality.worst_normal = quantile(angles, 0.9);
  quality.linear = quantile(linear, 0.5);
  const auto& votes = laplacian.report.votes;
  quality.agreed = static_cast<double>(votes[2]) / static_cast<double>(votes[0] + votes[1] + votes[2]);
  return quality;
}

/// Root mean square distance from the surface, at pixels inside by isInside().
double offSurface(const View& view, const Points& points) {
  double sum = 0, count = 0;
  for (int i = 0; i < points.rows(); ++i) {
    if (!std::isfinite(points(i, 0)) || !isInside(view, i, 5)) continue;
    sum += std::pow((points.row(i) - view.points.row(i)).dot(view.normals.row(i)), 2);
    ++count;
  }
  return std::sqrt(sum / count);
}

/// The views for all seeds.
std::vector<std::vector<View>> seenViews() {
  std::vector<std::vector<View>> seen;
  for (std::uint64_t seed = first_view_seed; seed <= last_view_seed; ++seed) seen.push_back(views(seed));
  return seen;
}

}  // namespace

void printDepthImages() {
  std::printf(
      "| view | disparity | by | edges across jumps | area off, body by body, patch by patch | normals off, median and "
      "90 %% | L x in "
      "the plane | "
      "triangles "
      "from all corners |\n|---|---|---|---|---|---|---|---|\n");
  const std::vector<std::vector<View>> seen = seenViews();
  for (std::size_t v = 0; v < seen.front().size(); ++v) {
    for (const CameraNoise& noise : camera_noises) {
      for (const bool by_pixels : {false, true}) {
        Quality sum;
        for (std::size_t i = 0; i < seen.size(); ++i) {
          const View& view = seen[i][v];
          const ScanStructure structure = imageStructure(view.width, view.height);
          const Eigen::Vector3d sensor = Eigen::Vector3d::Zero();
          CloudOptions options;
          options.viewpoint = &sensor;
          options.keep_cover = false;
          if (by_pixels) options.structure = &structure;
          const Points points = seenBy(view, noise, first_view_seed + i);
          sum += measure(view, points, pointCloudLaplacian(points, options));
        }
        std::printf("| %s | %s | %s | %.0f | %.1f %%, %.1f %% | %.2f, %.2f deg | %.1e | %.1f %% |\n",
                    seen[0][v].name.c_str(), noise.name.c_str(), by_pixels ? "pixels" : "tree", sum.across / view_seeds,
                    100 * sum.area / view_seeds, 100 * sum.local_area / view_seeds, sum.normal / view_seeds,
                    sum.worst_normal / view_seeds, sum.linear / view_seeds, 100 * sum.agreed / view_seeds);
        std::fflush(stdout);
      }
    }
  }
}

void printDenoisedImages() {
  std::printf("| view | disparity | off the surface, mm | denoise, by the tree | by pixels |\n|---|---|---|---|---|\n");
  const std::vector<CameraNoise> noises = {
      {"exact", 0, 0}, {"steps of 1/8, noise .1 px", 0.125, 0.1}, {"timed light, noise 5 mm", 0, 0, 0.005}};
  const std::vector<std::vector<View>> seen = seenViews();
  for (std::size_t v = 0; v < seen.front().size(); ++v) {
    for (const CameraNoise& noise : noises) {
      double raw = 0, by_tree = 0, by_pixels = 0;
      for (std::size_t i = 0; i < seen.size(); ++i) {
        const View& view = seen[i][v];
        const ScanStructure structure = imageStructure(view.width, view.height);
        const Points points = seenBy(view, noise, first_view_seed + i);
        raw += offSurface(view, points);
        by_tree += offSurface(view, denoise(points).positions);
        by_pixels += offSurface(view, denoise(points, {.structure = &structure}).positions);
      }
      const double scale = 1000 / view_seeds;
      std::printf("| %s | %s | %.2f | %.2f | %.2f |\n", seen[0][v].name.c_str(), noise.name.c_str(), scale * raw,
                  scale * by_tree, scale * by_pixels);
      std::fflush(stdout);
    }
  }
}

}  // namespace tufted::bench
