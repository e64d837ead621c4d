#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>

#include "base/point_buffer.h"
#include "base/stage_clock.h"
#include "neighbors/scan/scan_search.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

constexpr std::int64_t most_pixels = 1 << 24;  // of an image that holds few points
constexpr std::int64_t pixels_per_point = 64;
constexpr int most_pixels_per_neighbor = 4;  // of the window
constexpr int most_windows = 3;
constexpr double grazing = 1.0 / 12;  // sine of 5 degrees: no camera sees a surface at a lower angle
constexpr double far_step = 1.04;     // from the sensor; less may be the noise of a surface far away
constexpr int far_from_jumps = 255;

/// The nearest of the pixels around p, found in a window that is enlarged, in columns or in rows, while its border is
/// nearer than the last neighbour taken. On a smooth surface these are the nearest of all points (a last one apart,
/// perhaps), unless it is seen at so low an angle that the window would get too large.
///
/// The surface jumps between two neighbouring pixels of a row or column where the step from one to the other goes
/// along the line of sight. Pixels to be reached across a jump only, first along the row and then along the column or
/// the other way round, are no neighbours. What still leads to another depth is looked at on its straight way.
class ImageSearch final : public ScanSearch {
 public:
  ImageSearch(const RankedScan& scan, const RankedCloud& cloud)
      : origin_(scan.origin.transpose()), place_(scan.row.size(), -1) {
    // Only of the part of the image that holds points.
    std::int64_t first_row = INT32_MAX, first_column = INT32_MAX;
    for (int p = 0; p < cloud.size(); ++p) {
      if (scan.row[p] < 0) continue;
      ++places_;
      const std::int64_t row = scan.row[p], column = static_cast<std::int64_t>(scan.position[p]);
      first_row = std::min(first_row, row);
      first_column = std::min(first_column, column);
      rows_ = std::max(rows_, row + 1);
      columns_ = std::max(columns_, column + 1);
    }
    if (places_ > 0) {
      rows_ -= first_row;
      columns_ -= first_column;
    }
    // By what the caller gave: how many of the points are usable must not decide.
    if (rows_ * columns_ > std::max(most_pixels, pixels_per_point * scan.entries)) {
      throw InvalidInput("pointCloudLaplacian: structure has points in " + std::to_string(rows_) + " rows of " +
                         std::to_string(columns_) + " columns, must be at most 64 pixels for each of its " +
                         std::to_string(scan.entries) + " entries");
    }
    const auto pixelOf = [&](int p) {
      return (scan.row[p] - first_row) * columns_ + static_cast<std::int64_t>(scan.position[p]) - first_column;
    };
    begin_.assign(static_cast<std::size_t>(rows_ * columns_) + 1, 0);
    for (int p = 0; p < cloud.size(); ++p)
      if (scan.row[p] >= 0) ++begin_[pixelOf(p) + 1];
    for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    rank_.resize(static_cast<std::size_t>(places_));
    column_.resize(rank_.size());
    points_.resize(places_);
    Buffer<int> next(begin_.begin(), begin_.end() - 1);
    for (int p = 0; p < cloud.size(); ++p) {
      if (scan.row[p] < 0) continue;
      const std::int64_t pixel = pixelOf(p);
      const int place = next[pixel]++;
      place_[p] = place;
      rank_[place] = p;
      column_[place] = static_cast<int>(pixel % columns_);
      points_.row(place) = cloud.points.row(p);
    }
    row_.resize(rank_.size());
    for (int place = 0; place < static_cast<int>(places_); ++place)
      row_[place] = static_cast<int>(scan.row[rank_[place]] - first_row);
    findJumps();
  }

  Searched nearest(int p, int k, Buffer<Neighbor>& found) const override {
    found.clear();
    Searched searched;
    if (place_[p] < 0 || k <= 0) return searched;
    const std::int64_t most = most_pixels_per_neighbor * static_cast<std::int64_t>(k);
    const auto side = static_cast<std::int64_t>(std::ceil(radiusOfDisc(k) - 0.5));
    Window window{side, side};
    Borders borders = collect(place_[p], window, searched, found);
    const auto holdsEnough = [&] { return std::ssize(found) + searched.cut >= k; };
    while (!holdsEnough() && !isWhole(window)) {  // pixels without a point
      window = {2 * window.columns, 2 * window.rows};
      if (window.pixels() > pixels_per_point * most) break;
      borders = collect(place_[p], window, searched, found);
    }
    for (int windows = 1; windows < most_windows && holdsEnough(); ++windows) {
      const Window next = enlarged(window, borders, keepNearest(k, found), k);
      if (next == window || next.pixels() > most) break;
      window = next;
      borders = collect(place_[p], window, searched, found);
    }
    keepNearest(k, found);
    std::sort(found.begin(), found.end());
    if (!found.empty()) searched.radius = std::sqrt(found.back().squared_distance);
    return searched;
  }

  bool spansJump(int a, int b, int c) const override {
    const int i = place_[a], j = place_[b], k = place_[c];
    if (i < 0 || j < 0 || k < 0 || !(isFarStep(i, j) || isFarStep(j, k) || isFarStep(k, i))) return false;
    const auto jumpsEitherWay = [this](int from, int to) { return jumpsBetween(from, to) || jumpsBetween(to, from); };
    return jumpsEitherWay(i, j) || jumpsEitherWay(j, k) || jumpsEitherWay(k, i);
  }

  bool isGraded() const override { return false; }

  std::size_t bytes() const override {
    return bytesOf(begin_) + bytesOf(place_) + bytesOf(rank_) + bytesOf(row_) + bytesOf(column_) +
           bytesOf(jumps_in_row_) + bytesOf(jumps_in_column_) + bytesOf(to_jump_) + points_.bytes();
  }

 private:
  struct Window {
    std::int64_t columns, rows;  ///< on each side
    std::int64_t pixels() const { return (2 * columns + 1) * (2 * rows + 1); }
    bool operator==(const Window&) const = default;
  };

  struct Borders {
    double columns = std::numeric_limits<double>::infinity();  ///< distance of the nearest in the outermost columns
    double rows = std::numeric_limits<double>::infinity();
  };

  static std::int64_t toPixels(double steps) { return static_cast<std::int64_t>(std::min(std::ceil(steps), 1e6)); }

  /// Of a disc of p's and k other pixels, in pixels.
  static double radiusOfDisc(int k) { return std::sqrt((k + 1) / std::numbers::pi); }

  bool isWhole(const Window& window) const { return window.columns >= columns_ && window.rows >= rows_; }

  /// Keeps the k nearest if there are so many. Returns the distance of the last of these, or else infinity.
  static double keepNearest(int k, Buffer<Neighbor>& found) {
    if (std::ssize(found) < k) return std::numeric_limits<double>::infinity();
    std::nth_element(found.begin(), found.begin() + (k - 1), found.end());
    found.resize(k);
    return std::sqrt(found.back().squared_distance);
  }

  /// The window that should hold all within `last`, or the same one where it does. On a smooth surface a border one
  /// pixel further out is one step further away.
  Window enlarged(const Window& window, const Borders& borders, double last, int k) const {
    const double column_step = borders.columns / static_cast<double>(window.columns);
    const double row_step = borders.rows / static_cast<double>(window.rows);
    const bool wider = column_step * static_cast<double>(window.columns + 1) < last && window.columns < columns_;
    const bool higher = row_step * static_cast<double>(window.rows + 1) < last && window.rows < rows_;
    if (!wider && !higher) return window;
    Window next = window;
    const double pixel = column_step * row_step;  // its area
    if (std::isfinite(last) && std::isfinite(pixel) && pixel > 0) {
      const double radius = std::min(last, radiusOfDisc(k) * std::sqrt(pixel));
      next = {std::max(window.columns, toPixels(radius / column_step)),
              std::max(window.rows, toPixels(radius / row_step))};
    }
    if (next == window) next = {window.columns + (wider ? 1 : 0), window.rows + (higher ? 1 : 0)};
    return next;
  }

  Borders collect(int self, const Window& window, Searched& searched, Buffer<Neighbor>& found) const {
    found.clear();
    searched.cut = 0;
    const std::int64_t column = column_[self], row = row_[self];
    const std::int64_t left = std::max<std::int64_t>(0, column - window.columns);
    const std::int64_t right = std::min(columns_ - 1, column + window.columns);
    const std::int64_t top = std::max<std::int64_t>(0, row - window.rows);
    const std::int64_t bottom = std::min(rows_ - 1, row + window.rows);
    const bool may_jump = to_jump_[row * columns_ + column] <= std::max(window.columns, window.rows);
    Borders squared;
    for (std::int64_t r = top; r <= bottom; ++r) {
      const bool is_border = std::abs(r - row) == window.rows;
      for (int q = begin_[r * columns_ + left]; q < begin_[r * columns_ + right + 1]; ++q) {
        if (q == self) continue;
        if (may_jump && isBehindJump(row, column, r, column_[q])) {
          ++searched.cut;
          continue;
        }
        const double distance = (points_.row(q) - points_.row(self)).squaredNorm();
        if (is_border) squared.rows = std::min(squared.rows, distance);
        if (std::abs(column_[q] - column) == window.columns) squared.columns = std::min(squared.columns, distance);
        found.push_back({distance, rank_[q]});
      }
    }
    return {std::sqrt(squared.columns), std::sqrt(squared.rows)};
  }

  bool isBehindJump(std::int64_t row, std::int64_t column, std::int64_t to_row, std::int64_t to_column) const {
    const auto inRow = [&](std::int64_t r) {
      return jumps_in_row_[r * columns_ + to_column] != jumps_in_row_[r * columns_ + column];
    };
    const auto inColumn = [&](std::int64_t c) {
      return jumps_in_column_[to_row * columns_ + c] != jumps_in_column_[row * columns_ + c];
    };
    return (inRow(row) || inColumn(to_column)) && (inColumn(column) || inRow(to_row));
  }

  bool hasPoint(std::int64_t pixel) const { return begin_[pixel] < begin_[pixel + 1]; }

  double squaredRange(int place) const { return (points_.row(place) - origin_).squaredNorm(); }

  bool isFarStep(int a, int b) const {
    const auto [near, far] = std::minmax({squaredRange(a), squaredRange(b)});
    return far > far_step * far_step * near;
  }

  /// Whether the step from one place to the other goes along the sight.
  bool isJump(int a, int b) const {
    const Eigen::RowVector3d step = points_.row(b) - points_.row(a);
    const double along = step.dot((points_.row(a) - origin_).stableNormalized());
    return along * along > (1 - grazing * grazing) * step.squaredNorm();
  }

  /// Whether a far step on the straight way from one place to another is a jump. Pixels without a point are skipped;
  /// the way back may round to other pixels.
  bool jumpsBetween(int from, int to) const {
    const std::int64_t columns = column_[to] - column_[from], rows = row_[to] - row_[from];
    const std::int64_t steps = std::max(std::abs(columns), std::abs(rows));
    const auto part = [steps](std::int64_t whole, std::int64_t i) {  // rounded to the nearest pixel
      return (2 * whole * i + (whole < 0 ? -steps : steps)) / (2 * steps);
    };
    int last = from;
    for (std::int64_t i = 1; i <= steps; ++i) {
      const std::int64_t pixel = (row_[from] + part(rows, i)) * columns_ + column_[from] + part(columns, i);
      if (!hasPoint(pixel)) continue;
      const int next = i == steps ? to : begin_[pixel];
      if (isFarStep(last, next) && isJump(last, next)) return true;
      last = next;
    }
    return false;
  }

  /// Counts the jumps along every row and column, and the pixels from each to the next jump.
  void findJumps() {
    const auto pixels = static_cast<std::size_t>(rows_ * columns_);
    jumps_in_row_.assign(pixels, 0);
    jumps_in_column_.assign(pixels, 0);
    to_jump_.assign(pixels, far_from_jumps);
    // Pixels without a point are skipped: the step is that between the points on both sides.
    const auto walk = [&](std::int64_t first, std::int64_t step, std::int64_t count, Buffer<int>& jumps) {
      int seen = 0, last = -1;
      std::int64_t last_pixel = first;
      for (std::int64_t i = 0, pixel = first; i < count; ++i, pixel += step) {
        if (hasPoint(pixel)) {
          if (last >= 0 && isJump(last, begin_[pixel])) {
            ++seen;
            for (std::int64_t between = last_pixel; between <= pixel; between += step) to_jump_[between] = 0;
          }
          last = begin_[pixel];
          last_pixel = pixel;
        }
        jumps[pixel] = seen;
      }
    };
    for (std::int64_t row = 0; row < rows_; ++row) walk(row * columns_, 1, columns_, jumps_in_row_);
    for (std::int64_t column = 0; column < columns_; ++column) walk(column, columns_, rows_, jumps_in_column_);
    spreadDistances();
  }

  /// Chessboard distances from the zeros of `to_jump_`: forth and back, along rows and then along columns.
  void spreadDistances() {
    const auto spread = [&](std::int64_t from, std::int64_t to) {
      to_jump_[to] = static_cast<std::uint8_t>(std::min<int>(to_jump_[to], std::min(to_jump_[from] + 1, 255)));
    };
    const auto relax = [&](std::int64_t row, std::int64_t column, std::int64_t side) {
      const std::int64_t pixel = row * columns_ + column;
      const std::int64_t before = column - side, above = row - side;
      if (before >= 0 && before < columns_) spread(pixel - side, pixel);
      if (above < 0 || above >= rows_) return;
      for (std::int64_t c = std::max<std::int64_t>(0, column - 1); c <= std::min(columns_ - 1, column + 1); ++c)
        spread(above * columns_ + c, pixel);
    };
    for (std::int64_t i = 0; i < rows_ * columns_; ++i) relax(i / columns_, i % columns_, 1);
    for (std::int64_t i = rows_ * columns_ - 1; i >= 0; --i) relax(i / columns_, i % columns_, -1);
  }

  Eigen::RowVector3d origin_;  ///< of the sensor
  std::int64_t rows_ = 0, columns_ = 0, places_ = 0;
  Buffer<int> begin_;                           ///< by pixel, the first place; one more at the end
  Buffer<int> place_;                           ///< of each rank in the order of pixels, -1: none
  Buffer<int> rank_;                            ///< by place
  Buffer<int> row_;                             ///< by place
  Buffer<int> column_;                          ///< by place
  PointBuffer points_;                          ///< by place
  Buffer<int> jumps_in_row_, jumps_in_column_;  ///< by pixel, from the first one of the row or column on
  Buffer<std::uint8_t> to_jump_;                ///< by pixel, at most 255
};

}  // namespace

std::unique_ptr<ScanSearch> imageSearch(const RankedScan& scan, const RankedCloud& cloud) {
  return std::make_unique<ImageSearch>(scan, cloud);
}

}  // namespace tufted
