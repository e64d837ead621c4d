#include "depth_image/image_tile.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "depth_image/surface_windows.h"

namespace tufted {
namespace {

/// A slope is ignored if the inverse range changes by more than this share per pixel; a road seen at 1.7 degrees by
/// rings 0.4 degrees apart has it.
constexpr double steepest_slope = 0.25;

/// A step is one of the steps down (to a later pixel) or the inverse of one. In a window it is reached over some pixels
/// one ring further in.
struct Way {
  int down = 0;    ///< index of the step down
  PixelStep from;  ///< the pixel where the step down starts
  int parents = 0;
  std::array<int, 3> parent{};  ///< those pixels, as indices of steps
  std::array<int, 3> link_down{};
  std::array<PixelStep, 3> link_from{};  ///< where the step down from or to each parent starts
};

struct Ways {
  std::array<Way, WindowPixels::count> way{};
  std::array<PixelStep, ImageTile::steps_down> down{};
  std::array<int, ImageTile::steps_down> down_shift{};
  std::array<double, ImageTile::steps_down> most{}, most_of_rings{};
  std::array<int, pixels_beside> beside_shift{};

  constexpr Ways() {
    int size = 0;
    for (const PixelStep& step : window_pixels.step)
      if (isDown(step)) down[size++] = step;
    for (int i = 0; i < ImageTile::steps_down; ++i) {
      down_shift[i] = shiftOf(down[i]);
      most[i] = JumpTest::steepestOf(down[i]);
      most_of_rings[i] = JumpTest::steepestOf(down[i], JumpTest::steepest_of_rings);
    }
    for (int i = 0; i < pixels_beside; ++i) beside_shift[i] = shiftOf(window_pixels.step[i]);
    for (int i = 0; i < WindowPixels::count; ++i) {
      const PixelStep& step = window_pixels.step[i];
      Way& to = way[i];
      setDown(step, {0, 0}, to.down, to.from);
      if (step.ring() == 1) continue;
      for (int j = 0; j < i; ++j) {
        const PixelStep& before = window_pixels.step[j];
        const PixelStep last{step.row - before.row, step.column - before.column};
        if (before.ring() != step.ring() - 1 || last.ring() != 1) continue;
        to.parent[to.parents] = j;
        setDown(last, before, to.link_down[to.parents], to.link_from[to.parents]);
        ++to.parents;
      }
    }
  }

 private:
  static constexpr bool isDown(const PixelStep& step) { return step.row > 0 || (step.row == 0 && step.column > 0); }
  static constexpr int shiftOf(const PixelStep& step) { return step.row * pixels_in_word + step.column; }
  constexpr void setDown(const PixelStep& step, const PixelStep& start, int& number, PixelStep& from) const {
    const PixelStep wanted = isDown(step) ? step : PixelStep{-step.row, -step.column};
    number = 0;
    while (down[number].row != wanted.row || down[number].column != wanted.column) ++number;
    from = isDown(step) ? start : PixelStep{start.row + step.row, start.column + step.column};
  }
};

constexpr Ways ways;

/// The pixels of a row from which a step of `columns` leads into `pixels`.
std::uint64_t stepped(std::uint64_t pixels, int columns) {
  return columns >= 0 ? pixels >> columns : pixels << -columns;
}

}  // namespace

void transposeBits(std::array<std::uint64_t, 64>& words) {
  std::uint64_t low = 0x00000000FFFFFFFF;
  for (int half = 32; half > 0; half /= 2, low ^= low << half) {
    for (int first = 0; first < 64; first += 2 * half) {
      for (int i = first; i < first + half; ++i) {
        const std::uint64_t change = ((words[i] >> half) ^ words[i + half]) & low;
        words[i] ^= change << half;
        words[i + half] ^= change;
      }
    }
  }
}

bool ImageTile::take(const PixelGrid& grid, const PointsView& points, int top, int left, const RangeNoise& tolerance) {
  bool any = false;
  const int own_columns = std::min(columns, grid.columns - PixelGrid::margin - halo - left);
  own_ = ((std::uint64_t{1} << own_columns) - 1) << halo;
  for (int row = 0; row < all_rows; ++row) {
    is_filled_[row] = is_open_[row] = 0;
    for (int column = 0; column < pixels_in_word; ++column) {
      const int i = row * pixels_in_word + column;
      const bool is_inside = top + row < grid.rows && left + column < grid.columns;
      const int p = is_inside ? grid.rank[std::int64_t{top + row} * grid.columns + left + column] : -1;
      rank_[i] = p;
      if (p < 0) {
        is_open_[row] |= std::uint64_t{is_inside && grid.isInImage(top + row, left + column)} << column;
        x_[i] = y_[i] = z_[i] = 0;
        continue;
      }
      is_filled_[row] |= std::uint64_t{1} << column;
      const double* const point = points.data() + 3 * std::ptrdiff_t{p};
      x_[i] = point[0] - grid.origin[0];
      y_[i] = point[1] - grid.origin[1];
      z_[i] = point[2] - grid.origin[2];
    }
    any |= row >= halo && row < halo + rows && (is_filled_[row] & own_) != 0;
  }
  if (!any) return false;
  using Row = Eigen::Map<Eigen::Array<double, all_pixels, 1>>;
  const auto inFull = [](Values& values) { return Row(values.data()); };
  inFull(range_) = (inFull(x_).square() + inFull(y_).square() + inFull(z_).square()).sqrt();
  const Eigen::RowVector3d& axis = grid.axis;
  if (axis.isZero(0)) {
    inFull(inverse_) = inFull(range_).inverse();
  } else if (grid.goes_round) {
    inFull(inverse_) = ((axis[1] * inFull(z_) - axis[2] * inFull(y_)).square() +
                        (axis[2] * inFull(x_) - axis[0] * inFull(z_)).square() +
                        (axis[0] * inFull(y_) - axis[1] * inFull(x_)).square())
                           .sqrt()
                           .inverse();
  } else {
    inFull(inverse_) = (axis[0] * inFull(x_) + axis[1] * inFull(y_) + axis[2] * inFull(z_)).inverse();
  }
  const PixelSteps steps{steps_down, ways.down_shift.data(), (grid.goes_round ? ways.most_of_rings : ways.most).data()};
  for (int row = 0; row < all_rows; ++row)
    kernels().joinPixels(pixelsAt(row * pixels_in_word), steps, tolerance.of_inverse, tolerance.of_depth,
                         joined_[row].data());
  if (grid.goes_round) {
    findSlopes(grid, points, top, left);
    for (int row = 0; row < all_rows; ++row) joinAlongSlopes(row, {tolerance});
  }
  return true;
}

void ImageTile::findSlopes(const PixelGrid& grid, const PointsView& points, int top, int left) {
  const auto inverseBeyond = [&](int row, int column) {
    if (row < 0 || row >= grid.rows || !grid.isInImage(row, grid.wrapped(column))) return unknown;
    const int p = grid.rankAt(row, column);
    return p < 0 ? unknown : 1 / (points.row(p) - grid.origin).norm();
  };
  const auto inverse = [&](int row, int column) {
    if (row < 0 || row >= all_rows || column < 0 || column >= pixels_in_word)
      return inverseBeyond(top + row, left + column);
    const int i = row * pixels_in_word + column;
    return rank_[i] < 0 ? unknown : 1 / range_[i];
  };
  for (int row = 0; row < all_rows; ++row) {
    forEachPixel(is_filled_[row], [&](int column) {
      const int i = row * pixels_in_word + column;
      const double here = 1 / range_[i], most = steepest_slope * here;
      slope_[i] = {commonSlope(here - inverse(row - 1, column), inverse(row + 1, column) - here, most),
                   commonSlope(here - inverse(row, column - 1), inverse(row, column + 1) - here, most)};
    });
  }
}

void ImageTile::joinAlongSlopes(int row, const JumpTest& test) {
  for (int i = 0; i < steps_down; ++i) {
    const PixelStep& step = ways.down[i];
    if (row + step.row >= all_rows) continue;
    const std::uint64_t both = is_filled_[row] & stepped(is_filled_[row + step.row], step.column);
    std::uint64_t more = 0;
    forEachPixel(both & ~joined_[row][i], [&](int column) {
      const int a = row * pixels_in_word + column, b = a + ways.down_shift[i];
      const double x = x_[a] - x_[b], y = y_[a] - y_[b], z = z_[a] - z_[b];
      const Rise rise = riseBetween(slope_[a], slope_[b], step);
      more |= std::uint64_t{test.joins(x * x + y * y + z * z, range_[a], range_[b], ways.most_of_rings[i], rise)}
              << column;
    });
    joined_[row][i] |= more;
  }
}

std::int64_t ImageTile::findWindows(int row, std::array<std::uint64_t, pixels_in_word>& windows) {
  const int here = row + halo;
  std::int64_t left_out = 0;
  std::array<std::uint64_t, WindowPixels::count> reached, filled;
  for (int i = 0; i < WindowPixels::count; ++i) {
    const Way& way = ways.way[i];
    const PixelStep& step = window_pixels.step[i];
    const auto joined = [&](int down, const PixelStep& from) {
      return stepped(joined_[here + from.row][down], from.column);
    };
    const std::uint64_t open = stepped(is_open_[here + step.row], step.column);
    filled[i] = stepped(is_filled_[here + step.row], step.column);
    reached[i] = open | (filled[i] & joined(way.down, way.from));
    if (way.parents > 0) {
      std::uint64_t linked = 0, over = 0, refused = 0;
      for (int j = 0; j < way.parents; ++j) {
        const int parent = way.parent[j];
        const std::uint64_t is_linked = open | joined(way.link_down[j], way.link_from[j]);
        const std::uint64_t from = reached[parent] & filled[parent];
        over |= reached[parent] & ~filled[parent];
        linked |= from & is_linked;
        refused |= from & ~is_linked;
      }
      reached[i] &= linked | (over & ~refused);
    }
    windows[i] = around_[i] = reached[i] & filled[i];
    left_out += std::popcount(filled[i] & ~reached[i] & is_filled_[here] & own_);
  }
  for (int i = WindowPixels::count; i < pixels_in_word; ++i) windows[i] = 0;
  transposeBits(windows);
  return left_out;
}

void ImageTile::spacings(int row, int column, double* squared) const {
  std::array<unsigned char, pixels_beside> beside;
  for (int i = 0; i < pixels_beside; ++i) beside[i] = static_cast<unsigned char>(around_[i] >> (column + halo));
  kernels().spacingsOf(pixelsAt(at(row, column)), inverseAt(row, column), ways.beside_shift.data(), beside.data(),
                       squared);
}

}  // namespace tufted
