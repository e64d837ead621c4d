#include "view/spacing.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "view/projection.h"
#include "view/shown_values.h"
#include "view/threads.h"

namespace tufted::view {
namespace {

/// Neighbours are searched among this many points before and after in Morton order; more find few nearer ones.
constexpr std::int64_t window = 14;
/// The distance to this neighbour, counted from 1, is the spacing; on a square grid it is a diagonal.
constexpr std::size_t neighbor = 8;
/// Points per parallel task.
constexpr std::int64_t spacing_block = 8192;
/// Radius of a disc in units of the spacing. Less leaves holes between randomly spaced points.
constexpr float disc_share = 0.85F;
/// Greatest radius of a disc, as a share of half the scene's size.
constexpr float most_of_scene = 0.12F;
/// Greatest radius of a disc in units of the median: enough for uneven scans, while outliers stay small.
constexpr float most_of_others = 4;
/// Planes are fitted to the neighbours within this many spacings: some twenty of them, so that noise averages out.
constexpr float plane_reach = 2;
/// Points lie on a line, which has no normal, if their second variance is below this share of the greatest one: that of
/// a strip five times as long as wide.
constexpr float least_breadth = 0.04F;
/// Points lie on a surface if the mean of the unit normals around them is longer than this: the middle between 0.5,
/// which is that of random directions on one side, and 1.
constexpr float least_agreement = 0.75F;
/// Radius in units of the median up to which a disc hides what is behind it; the rest of it fills gaps only.
constexpr float core_share = 1.5F;
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
std::uint64_t mortonCodeOf(const Eigen::Vector3d& position, double shift) {
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
  for (const int i : points.finite) places.emplace_back(mortonCodeOf(points.positions.row(i).transpose(), shift), i);
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

/// The places of the points that are near one of a list in Morton order and adjacent to it there.
struct Window {
  std::size_t begin, end;

  Window(std::int64_t count, std::int64_t middle)
      : begin(static_cast<std::size_t>(std::max<std::int64_t>(0, middle - window))),
        end(static_cast<std::size_t>(std::min(count, middle + window + 1))) {}
};

/// The unit normal of the plane through those points that lie within `reach` of `center`; 0 if there are fewer than 4,
/// or if they lie on a line.
Eigen::Vector3f normalAt(const Eigen::Vector3f& center, const std::vector<Placed>& placed, const Window& nearby,
                         float reach) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  Eigen::Matrix3f products = Eigen::Matrix3f::Zero();
  float count = 0;
  for (std::size_t k = nearby.begin; k < nearby.end; ++k) {
    const Eigen::Vector3f offset = (placed[k].position - center) / reach;
    if (!(offset.squaredNorm() < 1)) continue;
    sum += offset;
    products += offset * offset.transpose();
    ++count;
  }
  if (count < 4) return Eigen::Vector3f::Zero();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
  solver.computeDirect(products - sum * sum.transpose() / count);
  const Eigen::Vector3f& variances = solver.eigenvalues();
  if (!(variances[1] > least_breadth * variances[2])) return Eigen::Vector3f::Zero();
  return solver.eigenvectors().col(0);
}

/// The mean of the normals within `reach` of a point, turned to one side; 0 if they disagree.
/// @param normals of all points, in the order of `placed`
Eigen::Vector3f meanNormal(std::size_t own, const std::vector<Placed>& placed, const Window& nearby, float reach,
                           const std::vector<Eigen::Vector3f>& normals) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  float count = 0;
  for (std::size_t k = nearby.begin; k < nearby.end; ++k) {
    if (!((placed[k].position - placed[own].position).norm() < reach)) continue;
    sum += normals[k].dot(sum) < 0 ? Eigen::Vector3f(-normals[k]) : normals[k];
    ++count;
  }
  return sum.norm() > least_agreement * count ? sum.normalized() : Eigen::Vector3f::Zero();
}

/// Computes radius and normal of each point from its neighbours in one Morton order, and keeps those with the least
/// radius of all orders.
void measure(const std::vector<Placed>& placed, int threads, Discs& discs) {
  const std::int64_t count = std::ssize(placed);
  forBlocks(threads, count, spacing_block, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a < end; ++a) {
      const Placed& own = placed[static_cast<std::size_t>(a)];
      const Window nearby(count, a);
      Nearest nearest;
      for (std::size_t k = nearby.begin; k < nearby.end; ++k) {
        const float square = (placed[k].position - own.position).squaredNorm();
        if (square > 0) nearest.add(square);
      }
      const auto i = static_cast<std::size_t>(own.point);
      if (!(disc_share * nearest.farthest() < discs.radii[i])) continue;
      discs.radii[i] = disc_share * nearest.farthest();
      discs.normals[i] = normalAt(own.position, placed, nearby, plane_reach * nearest.farthest());
    }
  });
}

/// Replaces each normal by the mean around it.
void smoothNormals(const std::vector<Placed>& placed, int threads, Discs& discs) {
  std::vector<Eigen::Vector3f> along;  // in the order of `placed`, so that those of a window are adjacent in memory
  along.reserve(placed.size());
  for (const Placed& one : placed) along.push_back(discs.normals[static_cast<std::size_t>(one.point)]);
  const std::int64_t count = std::ssize(placed);
  forBlocks(threads, count, spacing_block, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t a = begin; a < end; ++a) {
      const auto own = static_cast<std::size_t>(a);
      const auto i = static_cast<std::size_t>(placed[own].point);
      const float reach = plane_reach / disc_share * discs.radii[i];
      if (std::isfinite(reach)) discs.normals[i] = meanNormal(own, placed, Window(count, a), reach, along);
    }
  });
}

/// Limits the radii of outliers, and those of points that lie on no surface.
void limitRadii(const Scene& scene, const NormalizedPoints& points, Discs& discs) {
  std::vector<float> sorted;
  for (const int i : points.finite) sorted.push_back(discs.radii[static_cast<std::size_t>(i)]);
  const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(0.5 * static_cast<double>(sorted.size() - 1));
  std::nth_element(sorted.begin(), at, sorted.end());
  const float median = *at, most = std::min(most_of_scene, most_of_others * median);
  for (std::size_t i = 0; i < discs.radii.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const bool is_on_surface =
        !discs.normals[i].isZero() && (scene.fields.empty() || !std::isnan(scene.fields.front().values(row, 0)));
    float& radius = discs.radii[i];
    radius = std::isfinite(radius) ? std::min(radius, is_on_surface ? most : median) : lone_radius;
  }
  discs.core = core_share * median;
}

std::vector<int> pointsOf(const std::vector<Placed>& placed) {
  std::vector<int> order;
  order.reserve(placed.size());
  for (const Placed& one : placed) order.push_back(one.point);
  return order;
}

}  // namespace

Discs discsOf(const Scene& scene, const NormalizedPoints& points, int threads) {
  const auto n = static_cast<std::size_t>(points.positions.rows());
  Discs discs = {.radii = std::vector<float>(n, std::numeric_limits<float>::infinity()),
                 .core = lone_radius,
                 .normals = std::vector<Eigen::Vector3f>(n, Eigen::Vector3f::Zero()),
                 .order = {}};
  // Neighbours on two sides of a large cell's border are far apart in Morton order, but mostly not in both of two
  // shifted orders.
  const std::array<double, 2> shifts = {0, 0.618};
  std::array<std::vector<Placed>, 2> orders;
  forBlocks(threads, 2, 1, [&](std::int64_t begin, std::int64_t) {
    orders[static_cast<std::size_t>(begin)] = alongCurve(points, shifts[static_cast<std::size_t>(begin)]);
  });
  discs.order = pointsOf(orders[0]);
  if (discs.order.size() <= neighbor) {
    std::fill(discs.radii.begin(), discs.radii.end(), lone_radius);
    return discs;
  }
  for (const std::vector<Placed>& placed : orders) measure(placed, threads, discs);
  smoothNormals(orders[0], threads, discs);
  limitRadii(scene, points, discs);
  return discs;
}

std::vector<int> thinned(const Scene& scene, Eigen::Index most) {
  if (most <= 0 || scene.positions.rows() <= most || scene.triangles.rows() > 0) return {};
  const std::vector<int> order = pointsOf(alongCurve(normalize(scene, 0), 0));
  const Eigen::Index count = std::ssize(order);
  if (count <= most) return {};
  std::vector<int> rows;
  for (Eigen::Index k = 0; k < most; ++k) rows.push_back(order[static_cast<std::size_t>(k * count / most)]);
  for (const SceneField& field : scene.fields) {
    const std::vector<int> sources = sourcesOf(field.kind, shownValues(field, 0));
    rows.insert(rows.end(), sources.begin(), sources.end());
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

Scene sceneOfRows(const Scene& scene, const std::vector<int>& rows) {
  Scene part = {.title = scene.title, .positions = scene.positions(rows, Eigen::all)};
  if (scene.normals.rows() > 0) part.normals = scene.normals(rows, Eigen::all);
  for (const SceneField& field : scene.fields)
    part.fields.push_back({field.name, field.kind, field.values(rows, Eigen::all), field.unit, field.label_names,
                           field.no_value, field.column_names});
  part.unit = scene.unit;
  part.path = scene.path;
  return part;
}

}  // namespace tufted::view
