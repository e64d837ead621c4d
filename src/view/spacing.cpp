#include "view/spacing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "view/threads.h"

namespace tufted::view {

namespace {

/// Neighbours are searched among this many points before and after in Morton order; more find few nearer ones.
constexpr std::ptrdiff_t window = 14;
/// The distance to this neighbour, counted from 1, is the spacing; on a square grid it is a diagonal.
constexpr int neighbor = 8;
/// Radius of a disc in units of the spacing. Less leaves holes between randomly spaced points.
constexpr float disc_share = 0.85F;
/// Greatest radius of a disc, as a share of half the scene's size.
constexpr float most_of_scene = 0.12F;
/// Greatest radius of a disc in units of the median: enough for uneven scans, while outliers stay small.
constexpr float most_of_others = 4;
/// Radius of points without enough neighbours, as a share of half the scene's size.
constexpr float lone_radius = 0.025F;

/// Spreads 21 bits so that there are two bits between neighbours.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x1f00000000ffff;
  x = (x | x << 16) & 0x1f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

/// The Morton code of a position in a cube that is moved by `shift`.
std::uint64_t placeOf(const Eigen::Vector3d& position, double shift) {
  std::uint64_t place = 0;
  for (int k = 0; k < 3; ++k) {
    const double share = std::clamp((position[k] + 4 + shift) / 9, 0.0, 1.0);
    place |= spread(static_cast<std::uint64_t>(share * 0x1fffff)) << k;
  }
  return place;
}

/// A point in Morton order, with its position, so that positions of a window are adjacent in memory.
struct Placed {
  int point;
  Eigen::Vector3f position;
};

/// The finite points in Morton order in the cube moved by `shift`, ties by index.
std::vector<Placed> alongCurve(const NormalizedPoints& points, double shift) {
  std::vector<std::pair<std::uint64_t, int>> places;
  places.reserve(points.finite.size());
  for (const int i : points.finite) places.emplace_back(placeOf(points.positions.row(i).transpose(), shift), i);
  std::sort(places.begin(), places.end());
  std::vector<Placed> order;
  order.reserve(places.size());
  for (const auto& [place, i] : places) order.push_back({i, points.positions.row(i).transpose().cast<float>()});
  return order;
}

/// The smallest squared distances added so far, ascending.
class Nearest {
 public:
  Nearest() { squares_.fill(std::numeric_limits<float>::infinity()); }
  void add(float square) {
    if (square >= squares_.back()) return;
    std::size_t k = squares_.size() - 1;
    for (; k > 0 && squares_[k - 1] > square; --k) squares_[k] = squares_[k - 1];
    squares_[k] = square;
  }
  float farthest() const { return std::sqrt(squares_.back()); }

 private:
  std::array<float, neighbor> squares_;
};

}  // namespace

Discs discsOf(const Scene& scene, const NormalizedPoints& points, int threads) {
  const auto count = static_cast<std::int64_t>(points.finite.size());
  std::vector<float> radii(static_cast<std::size_t>(points.positions.rows()), std::numeric_limits<float>::infinity());
  // Neighbours on two sides of a large cell's border are far apart in Morton order, but mostly not in both of two
  // shifted orders.
  const std::array<double, 2> shifts = {0, 0.618};
  std::array<std::vector<Placed>, 2> orders;
  forBlocks(threads, 2, 1, [&](std::int64_t begin, std::int64_t) {
    orders[static_cast<std::size_t>(begin)] = alongCurve(points, shifts[static_cast<std::size_t>(begin)]);
  });
  for (const std::vector<Placed>& placed : orders)
    forBlocks(threads, count, 8192, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t a = begin; a < end; ++a) {
        const Placed& own = placed[static_cast<std::size_t>(a)];
        Nearest nearest;
        for (std::int64_t b = std::max<std::int64_t>(0, a - window); b <= std::min(count - 1, a + window); ++b) {
          const float square = (placed[static_cast<std::size_t>(b)].position - own.position).squaredNorm();
          if (square > 0) nearest.add(square);
        }
        float& radius = radii[static_cast<std::size_t>(own.point)];
        radius = std::min(radius, disc_share * nearest.farthest());
      }
    });
  std::vector<int> order;
  order.reserve(points.finite.size());
  for (const Placed& along : orders[0]) order.push_back(along.point);
  if (count <= neighbor) {
    std::fill(radii.begin(), radii.end(), lone_radius);
    return {std::move(radii), std::move(order)};
  }
  std::vector<float> sorted;
  for (const int i : points.finite) sorted.push_back(radii[static_cast<std::size_t>(i)]);
  const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(0.5 * static_cast<double>(count - 1));
  std::nth_element(sorted.begin(), at, sorted.end());
  const float median = *at, most = std::min(most_of_scene, most_of_others * median);
  for (float& radius : radii) radius = std::isfinite(radius) ? std::min(radius, most) : lone_radius;
  if (!scene.fields.empty()) {
    const Eigen::MatrixXd& values = scene.fields.front().values;
    for (const int i : points.finite)
      if (std::isnan(values(i, 0)))
        radii[static_cast<std::size_t>(i)] = std::min(radii[static_cast<std::size_t>(i)], median);
  }
  return {std::move(radii), std::move(order)};
}

}  // namespace tufted::view
