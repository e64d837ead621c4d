#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "depth_image/depth_noise.h"
#include "depth_image/image_stars.h"
#include "depth_image/pixel_window.h"
#include "neighbors/morton.h"
#include "tufted/laplacian.h"
#include "tufted/scan_structure.h"

namespace tufted::image_tests {

constexpr int width = 60, height = 50;

/// What a camera of 60 x 50 pixels, 0.01 rad each, sees where its ray of depth 1 at (u, v, 1) is `depth(column, row)`
/// long.
inline Points imageOf(const std::function<double(int, int)>& depth) {
  Points points(width * height, 3);
  for (int i = 0; i < points.rows(); ++i) {
    const double u = (i % width - width / 2) / 100.0, v = (i / width - height / 2) / 100.0;
    points.row(i) = Eigen::RowVector3d(u, v, 1) * depth(i % width, i / width);
  }
  return points;
}

/// A plane of depth 1 in the middle.
inline double planeDepth(int column, int row, double slope_x, double slope_y) {
  return 1 / (1 - slope_x * (column - width / 2) / 100.0 - slope_y * (row - height / 2) / 100.0);
}

/// The Laplacian of an image by its pixels.
inline Laplacian imageLaplacian(const Points& points, int columns = width, int rows = height) {
  const ScanStructure structure = imageStructure(columns, rows);
  CloudOptions options;
  options.structure = &structure;
  return pointCloudLaplacian(points, options);
}

/// An image with its ranks and surface.
class Image {
 public:
  explicit Image(const Points& points, double noise = 0, bool smooths = false)
      : Image(points, imageStructure(width, height), noise, smooths) {}
  Image(const Points& points, const ScanStructure& structure, double noise = 0, bool smooths = false)
      : cloud_(rankPoints(points, status_, representative_)) {
    surface_.grid = pixelGrid(rankScan(structure, cloud_, status_, representative_));
    const Progress silent;
    const Workers workers(1, silent);
    findAxis(cloud_.points, workers, surface_.grid);
    surface_.noise = {noise, 0};
    surface_.windows = findSurfaceWindows(surface_.grid, cloud_.points, surface_.noise, smooths, workers);
  }

  const RankedCloud& cloud() const { return cloud_; }
  const PixelGrid& grid() const { return surface_.grid; }
  const SurfaceWindows& windows() const { return surface_.windows; }
  DepthImage view() const { return surface_.view(cloud_.points); }
  int pointOf(int rank) const { return cloud_.input_index[rank]; }

  /// The points in the window of a rank, by the caller's index.
  std::vector<int> around(int rank, int rings = WindowPixels::reach) const {
    PixelWindow window;
    window.take(view(), rank, rings);
    return pointsOf(window);
  }
  /// The same by the rule of larger windows, pixel by pixel.
  std::vector<int> aroundByPixels(int rank, int rings = WindowPixels::reach) const {
    PixelWindow window;
    window.widen(view(), rank, rings);
    return pointsOf(window);
  }

 private:
  std::vector<int> pointsOf(const PixelWindow& window) const {
    std::vector<int> points;
    for (const Neighbor& q : window.neighbors()) points.push_back(pointOf(q.index));
    std::sort(points.begin(), points.end());
    return points;
  }

  std::vector<PointStatus> status_;
  std::vector<int> representative_;
  RankedCloud cloud_;
  SurfaceImage surface_;
};

}  // namespace tufted::image_tests
