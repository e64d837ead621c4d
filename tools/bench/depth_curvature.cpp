// Curvature of bodies that a depth camera sees, from every pixel and from fewer.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "bench/depth_views.h"
#include "bench/tables.h"
#include "tufted/curvature.h"
#include "tufted/laplacian.h"

namespace tufted::bench {
namespace {

constexpr int most_stride = 3;
/// A window has 12 rings at most, of every third pixel; curvature is wrong within some rings of a rim.
constexpr int from_edge = 12;

/// A body of a view and its principal curvatures, larger one first, in 1 / m.
struct CurvedBody {
  std::string name;
  View (*view)(std::uint64_t seed);
  int body;
  Eigen::RowVector2d curvatures;
};

const std::array<CurvedBody, 3> bodies{{{"mug, radius 4 cm, at 0.6 m", nearView, 0, {1 / mug_radius, 0}},
                                        {"ball, 40 cm, 1.2 m", ballView, 0, {1 / ball_radius, 1 / ball_radius}},
                                        {"table, 0.3 m to 0.9 m", nearView, 3, {0, 0}}}};

/// The larger of the errors of both curvatures at each pixel that every stride takes.
std::vector<double> errorsOf(const CurvedBody& body, const View& view, const Points& image, int stride) {
  const int columns = view.width / stride, rows = view.height / stride;
  const auto pixelOf = [&](int i) { return i / columns * stride * view.width + i % columns * stride; };
  Points points(columns * rows, 3);
  for (int i = 0; i < points.rows(); ++i) points.row(i) = image.row(pixelOf(i));
  const ScanStructure structure = imageStructure(columns, rows);
  CloudOptions options;
  options.structure = &structure;
  options.keep_cover = false;
  const Laplacian laplacian = pointCloudLaplacian(points, options);
  Frames frames = laplacian.frames;
  for (int i = 0; i < points.rows(); ++i)
    if (frames.normals.row(i).dot(points.row(i)) > 0) frames.normals.row(i) *= -1;  // towards the camera
  const Curvatures found = curvatures(laplacian, frames);
  std::vector<double> errors;
  for (int i = 0; i < points.rows(); ++i) {
    const int pixel = pixelOf(i);
    const bool is_common = pixel % view.width % 6 == 0 && pixel / view.width % 6 == 0;
    if (!is_common || view.bodies[pixel] != body.body || !isInside(view, pixel, from_edge)) continue;
    if (laplacian.status[i] != PointStatus::active) continue;
    errors.push_back((found.principal.row(i) - body.curvatures).cwiseAbs().maxCoeff());
  }
  return errors;
}

}  // namespace

void printDepthCurvatures() {
  std::printf("| body | depth | every pixel | every second | every third |\n|---|---|---|---|---|\n");
  for (const CurvedBody& body : bodies) {
    for (const CameraNoise& noise : camera_noises) {
      std::array<std::vector<double>, most_stride> errors;
      for (std::uint64_t seed = first_view_seed; seed <= last_view_seed; ++seed) {
        const View view = body.view(seed);
        const Points image = seenBy(view, noise, seed);
        for (int stride = 1; stride <= most_stride; ++stride) {
          const std::vector<double> of_seed = errorsOf(body, view, image, stride);
          errors[stride - 1].insert(errors[stride - 1].end(), of_seed.begin(), of_seed.end());
        }
      }
      std::printf("| %s | %s |", body.name.c_str(), noise.name.c_str());
      for (std::vector<double>& of_stride : errors)
        std::printf(" %.2f, %.2f |", quantile(of_stride, 0.5), quantile(of_stride, 0.9));
      std::printf("\n");
      std::fflush(stdout);
    }
  }
}

}  // namespace tufted::bench
