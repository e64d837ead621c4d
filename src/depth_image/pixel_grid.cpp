#include "depth_image/pixel_grid.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <string>

#include "neighbors/scan/pinhole.h"
#include "neighbors/scan/sparse_share.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// An image may have this many pixels however few points it holds.
constexpr std::int64_t most_pixels = 1 << 24;
/// A larger one must have an entry per this many pixels, so that rows and columns that are no image are refused before
/// memory is taken.
constexpr std::int64_t pixels_per_point = 64;
/// Number of rays that the camera is fitted to; rays have no noise.
constexpr std::int64_t axis_samples = 2000;
/// If more than this share of the points is not in front of the camera, there is none; as many may be off its rays.
constexpr double most_aside = 0.05;
/// Least ratio of depth and range, 78 degrees off the axis; with less, the depths of all points would be nearly equal.
constexpr double least_depth = 0.2;

/// Numbers the rows, or the columns, of an image that hold points, without the empty ones.
class Lines {
 public:
  void widen(std::int64_t line) {
    first_ = std::min(first_, line);
    end_ = std::max(end_, line + 1);
  }
  std::int64_t extent() const { return std::max<std::int64_t>(0, end_ - first_); }

  void reserve() { number_.assign(static_cast<std::size_t>(extent()), 0); }
  void hold(std::int64_t line) { number_[line - first_] = 1; }
  /// Numbers the lines that hold points and returns how many there are.
  int count() {
    int held = 0;
    for (int& line : number_) line = line == 0 ? -1 : held++;
    return held;
  }
  int numberOf(std::int64_t line) const { return number_[line - first_]; }
  /// The caller's numbers of the lines that hold points, ascending.
  Buffer<std::int64_t> held() const {
    Buffer<std::int64_t> lines;
    for (std::int64_t i = 0; i < std::ssize(number_); ++i)
      if (number_[i] >= 0) lines.push_back(first_ + i);
    return lines;
  }

 private:
  std::int64_t first_ = std::numeric_limits<std::int64_t>::max(), end_ = 0;
  Buffer<int> number_;
};

/// Fills the margins left and right of an image that goes round.
void repeatBeyondSeam(PixelGrid& grid) {
  const int around = grid.columnsInImage();
  for (int row = PixelGrid::margin; row < grid.rows - PixelGrid::margin; ++row) {
    int* const rank = grid.rank.data() + std::int64_t{row} * grid.columns;
    std::copy_n(rank + around, PixelGrid::margin, rank);
    std::copy_n(rank + PixelGrid::margin, PixelGrid::margin, rank + PixelGrid::margin + around);
  }
}

std::optional<Eigen::Vector3d> axisOfCamera(const PointsView& points, const PixelGrid& grid) {
  if (grid.row_line.empty()) return std::nullopt;
  const auto place = [](const Buffer<std::int64_t>& lines, int number) {
    const auto line = static_cast<double>(lines[number - PixelGrid::margin] - lines.front());
    return 2 * line / static_cast<double>(lines.back() - lines.front()) - 1;
  };
  const auto extent = [](const Buffer<std::int64_t>& lines) {
    return static_cast<int>(std::min<std::int64_t>(lines.back() - lines.front() + 1, std::numeric_limits<int>::max()));
  };
  Buffer<Sighting> sightings;
  const std::int64_t stride = std::max<std::int64_t>(1, points.rows() / axis_samples) | 1;
  for (std::int64_t p = 0; p < points.rows(); p += stride) {
    const Eigen::Vector3d ray = (points.row(p) - grid.origin).transpose();
    if (grid.pixel[p] < 0 || ray.isZero(0)) continue;
    const int number = static_cast<int>(p);
    sightings.push_back({{place(grid.column_line, grid.columnOf(number)), place(grid.row_line, grid.rowOf(number))},
                         ray.stableNormalized()});
  }
  return opticalAxis(sightings, extent(grid.column_line), extent(grid.row_line));
}

}  // namespace

PixelGrid pixelGrid(const RankedScan& scan, int around) {
  const int n = static_cast<int>(scan.row.size());
  Lines rows, columns;
  const auto forEachPlace = [&](const auto& visit) {
    for (int p = 0; p < n; ++p)
      if (scan.row[p] >= 0) visit(p, std::int64_t{scan.row[p]}, static_cast<std::int64_t>(scan.position[p]));
  };
  forEachPlace([&](int, std::int64_t row, std::int64_t column) {
    rows.widen(row);
    columns.widen(column);
  });
  if (around > 0) {
    columns.widen(0);
    columns.widen(around - 1);
  }
  // The bound is on the caller's entries, so that it does not depend on how many points are usable.
  if (rows.extent() * columns.extent() > std::max(most_pixels, pixels_per_point * scan.entries)) {
    throw InvalidInput(std::string(scan.function) + ": structure has points in " + std::to_string(rows.extent()) +
                       " rows of " + std::to_string(columns.extent()) +
                       " columns, must be at most 64 pixels for each of its " + std::to_string(scan.entries) +
                       " entries");
  }
  rows.reserve();
  columns.reserve();
  forEachPlace([&](int, std::int64_t row, std::int64_t column) {
    rows.hold(row);
    columns.hold(column);
  });

  for (int column = 0; column < around; ++column) columns.hold(column);

  PixelGrid grid;
  grid.goes_round = around > 0;
  grid.origin = scan.origin.transpose();
  grid.rows = rows.count() + 2 * PixelGrid::margin;
  grid.columns = columns.count() + 2 * PixelGrid::margin;
  grid.row_line = rows.held();
  grid.column_line = columns.held();
  grid.rank.assign(static_cast<std::size_t>(grid.rows) * grid.columns, -1);
  grid.pixel.assign(static_cast<std::size_t>(n), -1);
  forEachPlace([&](int p, std::int64_t row, std::int64_t column) {
    const std::int64_t pixel = std::int64_t{rows.numberOf(row) + PixelGrid::margin} * grid.columns +
                               columns.numberOf(column) + PixelGrid::margin;
    if (grid.rank[pixel] >= 0) return;  // the smallest rank keeps the pixel
    grid.rank[pixel] = p;
    grid.pixel[p] = pixel;
  });
  if (grid.goes_round) repeatBeyondSeam(grid);
  return grid;
}

std::int64_t sampleStride(std::int64_t pixels, std::int64_t samples, std::int64_t row) {
  std::int64_t stride = std::max<std::int64_t>(1, pixels / samples);
  while (std::gcd(stride, row) > 1) ++stride;
  return stride;
}

void findAxis(const PointsView& points, const Workers& workers, PixelGrid& grid) {
  grid.axis.setZero();
  const auto axis = grid.goes_round ? std::optional(Eigen::Vector3d::UnitZ().eval()) : axisOfCamera(points, grid);
  if (!axis) return;
  grid.axis = axis->transpose();
  const Buffer<int> aside = numbersWhere("windows", static_cast<int>(points.rows()), workers, [&](int p) {
    const double depth = grid.depthOf(points.row(p)), range_squared = (points.row(p) - grid.origin).squaredNorm();
    return grid.pixel[p] >= 0 && !(depth > 0 && depth * depth >= least_depth * least_depth * range_squared);
  });
  const double most = grid.goes_round ? 0 : most_aside * static_cast<double>(points.rows());
  if (static_cast<double>(aside.size()) > most) {
    grid.axis.setZero();
    return;
  }
  for (const int p : aside) {
    grid.rank[grid.pixel[p]] = -1;
    grid.pixel[p] = -1;
  }
}

double sparseShare(const PixelGrid& grid) {
  return sparseShare(grid.row_line, grid.column_line, [&grid](int row, int column) {
    return grid.rankAt(row + PixelGrid::margin, column + PixelGrid::margin) >= 0;
  });
}

}  // namespace tufted
