#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include "shapes/shapes.h"

namespace tufted::shapes {
namespace {

class ScanGrid {
 public:
  ScanGrid(const Cloud& scan, bool goes_round) : scan_(scan), goes_round_(goes_round) {}

  double area() const {
    double sum = 0;
    for (int row = 0; row + 1 < scan_.height; ++row) {
      for (int column = 0; column + 1 < scan_.width + (goes_round_ ? 1 : 0); ++column) sum += cellArea(row, column);
    }
    return sum;
  }

  bool isInner(int row, int column) const {
    for (int r = row - 1; r <= row + 1; ++r) {
      for (int c = column - 1; c <= column + 1; ++c) {
        if (ray(r, c) < 0 || scan_.labels[ray(r, c)] != scan_.labels[ray(row, column)]) return false;
      }
    }
    return true;
  }

 private:
  /// The index of a ray; -1 outside of the scan.
  int ray(int row, int column) const {
    if (goes_round_) column = (column + scan_.width) % scan_.width;
    const bool inside = row >= 0 && row < scan_.height && column >= 0 && column < scan_.width;
    return inside ? row * scan_.width + column : -1;
  }

  /// The area between four rays: of two triangles, as the mean over both diagonals, or of the one triangle whose
  /// corners hit one surface.
  double cellArea(int row, int column) const {
    const std::array<int, 4> corner{ray(row, column), ray(row, column + 1), ray(row + 1, column + 1),
                                    ray(row + 1, column)};
    double sum = 0;
    int triangles = 0;
    for (int left_out = 0; left_out < 4; ++left_out) {
      const int a = corner[(left_out + 1) % 4], b = corner[(left_out + 2) % 4], c = corner[(left_out + 3) % 4];
      if (scan_.labels[a] != scan_.labels[b] || scan_.labels[a] != scan_.labels[c]) continue;
      const Eigen::Vector3d ab = scan_.points.row(b) - scan_.points.row(a);
      const Eigen::Vector3d ac = scan_.points.row(c) - scan_.points.row(a);
      sum += ab.cross(ac).norm() / 2;
      ++triangles;
    }
    return triangles == 4 ? sum / 2 : sum;
  }

  const Cloud& scan_;
  bool goes_round_;
};

}  // namespace

ScanTruth scanTruth(const Cloud& scan, bool goes_round) {
  if (scan.width * scan.height != static_cast<int>(scan.labels.size()) || !scan.points.allFinite()) {
    throw std::invalid_argument("scanTruth: the scan must be organized, labelled and finite");
  }
  const ScanGrid grid(scan, goes_round);
  ScanTruth truth{.area = grid.area(), .inner = {}};
  for (int row = 0; row < scan.height; ++row) {
    for (int column = 0; column < scan.width; ++column) truth.inner.push_back(grid.isInner(row, column) ? 1 : 0);
  }
  return truth;
}

namespace {

/// Calls `visit(i, j)` for all pixels i and all j at most `pixels` rows and columns away; j is -1 outside of the image.
template <class Visit>
void forPairs(int width, int height, int pixels, const Visit& visit) {
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      for (int r = row - pixels; r <= row + pixels; ++r) {
        for (int c = column - pixels; c <= column + pixels; ++c) {
          const bool inside = r >= 0 && r < height && c >= 0 && c < width;
          visit(row * width + column, inside ? r * width + c : -1);
        }
      }
    }
  }
}

}  // namespace

ImageEdges imageEdges(const Cloud& image) {
  constexpr double jump = 1.05;  // more than the ratio of depths on a wall seen at 5 degrees, 1.02 per pixel
  const std::vector<std::uint8_t> unmarked(image.labels.size());
  ImageEdges edges{unmarked, unmarked, unmarked};
  forPairs(image.width, image.height, 1, [&](int i, int j) {
    if (j < 0 || !image.points.row(j).allFinite()) {
      edges.rim[i] = 1;
    } else if (image.labels[i] != image.labels[j]) {
      const auto [near, far] = std::minmax(image.points(i, 2), image.points(j, 2));
      edges.other[i] = 1;
      if (far >= jump * near) edges.jump[i] = 1;
    }
  });
  return edges;
}

std::vector<std::uint8_t> widened(const std::vector<std::uint8_t>& marks, int width, int pixels) {
  std::vector<std::uint8_t> wide(marks.size());
  forPairs(width, static_cast<int>(marks.size()) / width, pixels, [&](int i, int j) {
    if (j >= 0 && marks[j] != 0) wide[i] = 1;
  });
  return wide;
}

}  // namespace tufted::shapes
