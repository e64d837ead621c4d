#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/stage_clock.h"
#include "cloud/scan_search.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

constexpr std::int64_t most_pixels = 1 << 24;  // of an image that holds few points
constexpr std::int64_t pixels_per_point = 64;
constexpr int most_pixels_per_neighbor = 4;           // of the window
constexpr double grazing = 1.0 / 12;                  // sine of 5 degrees: no camera sees a surface at a lower angle
constexpr double most_along = 1 - grazing * grazing;  // of a step's squared length, along the line of sight

/// The nearest of the pixels around p: those of a window that grows, in columns or in rows, while its border is nearer
/// than the last neighbour taken. On a smooth surface these are the nearest of all points, until it is seen at so low
/// an angle that the window would get too large. What can be reached only along the line of sight is across a jump.
class ImageSearch final : public ScanSearch {
 public:
  ImageSearch(const RankedScan& scan, const RankedCloud& cloud) : points_(cloud.points), scan_(scan) {
    std::int64_t placed = 0;
    for (int p = 0; p < cloud.size(); ++p) {
      if (scan.row[p] < 0) continue;
      ++placed;
      rows_ = std::max(rows_, scan.row[p] + std::int64_t(1));
      columns_ = std::max(columns_, static_cast<std::int64_t>(scan.position[p]) + 1);
    }
    if (rows_ * columns_ > std::max(most_pixels, pixels_per_point * placed)) {
      throw InvalidInput("pointCloudLaplacian: structure places " + std::to_string(placed) + " points in " +
                         std::to_string(rows_) + " rows of " + std::to_string(columns_) +
                         " columns, must be at most 64 pixels per point");
    }
    begin_.assign(static_cast<std::size_t>(rows_ * columns_) + 1, 0);
    for (int p = 0; p < cloud.size(); ++p)
      if (scan.row[p] >= 0) ++begin_[pixel(p) + 1];
    for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    rank_.resize(static_cast<std::size_t>(placed));
    std::vector<int> next(begin_.begin(), begin_.end() - 1);
    for (int p = 0; p < cloud.size(); ++p)
      if (scan.row[p] >= 0) rank_[next[pixel(p)]++] = p;
  }

  Searched nearest(int p, int k, std::vector<Neighbor>& found) const override {
    found.clear();
    if (scan_.row[p] < 0 || k <= 0) return {};
    const int least = static_cast<int>(std::ceil(std::sqrt((k + 1) / std::numbers::pi) - 0.5));
    Window window{least, least};
    Searched searched;
    for (;;) {
      const auto [to_columns, to_rows] = collect(p, window, searched, found);
      const auto count = static_cast<std::int64_t>(found.size());
      const double last = count < k ? std::numeric_limits<double>::infinity() : takeNearest(k, found);
      // A border one pixel further out is that much further away where the surface is smooth.
      const auto isPast = [last](double border, int half) { return border * (half + 1) / half >= last; };
      const bool wider = !isPast(to_columns, window.columns) && window.columns < columns_;
      const bool higher = !isPast(to_rows, window.rows) && window.rows < rows_;
      const bool is_most = window.pixels() >= static_cast<std::int64_t>(most_pixels_per_neighbor) * k;
      if (is_most || (!wider && !higher)) break;
      window.columns += wider ? 1 + window.columns / 4 : 0;
      window.rows += higher ? 1 + window.rows / 4 : 0;
    }
    std::sort(found.begin(), found.end());
    if (!found.empty()) searched.radius = std::sqrt(found.back().squared_distance);
    return searched;
  }

  bool isGraded() const override { return false; }

  std::size_t bytes() const override { return bytesOf(begin_) + bytesOf(rank_); }

 private:
  struct Window {
    int columns, rows;  ///< on each side
    std::int64_t pixels() const { return (2 * std::int64_t(columns) + 1) * (2 * std::int64_t(rows) + 1); }
  };

  struct Borders {
    double columns = std::numeric_limits<double>::infinity();  ///< distance of the nearest in the outermost columns
    double rows = std::numeric_limits<double>::infinity();
  };

  std::size_t pixel(int p) const {
    return static_cast<std::size_t>(scan_.row[p] * columns_ + static_cast<std::int64_t>(scan_.position[p]));
  }

  /// Keeps the k nearest; the distance of the last.
  static double takeNearest(int k, std::vector<Neighbor>& found) {
    std::nth_element(found.begin(), found.begin() + (k - 1), found.end());
    found.resize(k);
    return std::sqrt(found.back().squared_distance);
  }

  Borders collect(int p, const Window& window, Searched& searched, std::vector<Neighbor>& found) const {
    found.clear();
    searched.cut = 0;
    const auto column = static_cast<std::int64_t>(scan_.position[p]);
    const std::int64_t row = scan_.row[p];
    const std::int64_t left = std::max<std::int64_t>(0, column - window.columns);
    const std::int64_t right = std::min<std::int64_t>(columns_ - 1, column + window.columns);
    const std::int64_t bottom = std::min<std::int64_t>(rows_ - 1, row + window.rows);
    double to_columns = std::numeric_limits<double>::infinity(), to_rows = to_columns;
    const Eigen::RowVector3d sight = (points_.row(p) - scan_.origin.transpose()).stableNormalized();
    for (std::int64_t r = std::max<std::int64_t>(0, row - window.rows); r <= bottom; ++r) {
      const bool is_border_row = std::abs(r - row) == window.rows;
      for (int i = begin_[r * columns_ + left]; i < begin_[r * columns_ + right + 1]; ++i) {
        const int q = rank_[i];
        if (q == p) continue;
        const Eigen::RowVector3d step = points_.row(q) - points_.row(p);
        const double squared = step.squaredNorm();
        const double along = step.dot(sight);
        if (along * along > squared * most_along) {
          ++searched.cut;
          continue;
        }
        if (std::abs(static_cast<std::int64_t>(scan_.position[q]) - column) == window.columns)
          to_columns = std::min(to_columns, squared);
        if (is_border_row) to_rows = std::min(to_rows, squared);
        found.push_back({squared, q});
      }
    }
    return {std::sqrt(to_columns), std::sqrt(to_rows)};
  }

  const Points& points_;
  RankedScan scan_;
  std::int64_t rows_ = 0, columns_ = 0;
  std::vector<int> begin_;  ///< by pixel, into `rank_`; one more at the end
  std::vector<int> rank_;   ///< row by row
};

}  // namespace

std::unique_ptr<ScanSearch> imageSearch(const RankedScan& scan, const RankedCloud& cloud) {
  return std::make_unique<ImageSearch>(scan, cloud);
}

}  // namespace tufted
