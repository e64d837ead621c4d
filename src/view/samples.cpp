#include "view/samples.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <utility>

#include "view/spacing.h"
#include "view/threads.h"

namespace tufted::view {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

/// Points per parallel task.
constexpr std::int64_t block_size = 4096;
/// Greatest radius of a disc as a share of the picture's height, so that points next to the eye do not hide everything.
constexpr float most_of_picture = 0.1F;
/// Least radius of a disc in samples. At more than 0.71, half the diagonal of a sample, no disc falls between samples.
constexpr float least_radius = 0.75F;
/// Discs are tilted at most so far that the cosine between normal and view is this; edge on they would vanish.
constexpr float least_cosine = 0.25F;
/// The middle of a disc is nearer to the eye than its rim by this share of its radius, so that of overlapping discs the
/// one with the nearest middle is seen, for slopes up to 45 degrees.
constexpr float bulge = 1;
/// Distances in samples at which the surface around a hole is looked for; holes are about as large as discs.
constexpr int hole_reaches[] = {2, 4, 8};
/// A disc counts at the second and third distance only if this many times its radius reaches from there to the hole.
constexpr float hole_share = 1.5F;
/// In how many of eight directions there must be a disc in front; at a silhouette there is one in at most five.
constexpr int hole_neighbors = 7;
/// A sample is behind a disc if it is farther away by more than this many radii; on a steep surface none is.
constexpr float hole_depth = 4;

void put(Sample& target, float depth, std::uint32_t number, bool is_rim = false) {
  const Sample sample =
      static_cast<Sample>(std::bit_cast<std::uint32_t>(depth)) << 32 | number | (is_rim ? rim_bit : 0);
  const std::atomic_ref<Sample> shared(target);
  Sample seen = shared.load(std::memory_order_relaxed);
  while (sample < seen && !shared.compare_exchange_weak(seen, sample, std::memory_order_relaxed)) {
  }
}

/// Samples in [low, high).
struct Range {
  int low, high;
};
/// The samples of a screen of `size` whose middle is within `radius` of `center`.
Range around(double center, double radius, int size) {
  return {static_cast<int>(std::clamp(std::ceil(center - radius - 0.5), 0.0, static_cast<double>(size))),
          static_cast<int>(std::clamp(std::floor(center + radius - 0.5) + 1, 0.0, static_cast<double>(size)))};
}

void drawDisc(SeenScene& seen, int i) {
  const Vector3f& p = seen.views[static_cast<std::size_t>(i)];
  if (!(p.z() > nearest_depth)) return;
  const Vector3d view = p.cast<double>();
  const float reach = seen.screen_radii[static_cast<std::size_t>(i)];
  const auto per_sample = static_cast<float>(1 / seen.projection.scaleAt(view.z()));
  const float radius = reach * per_sample;
  const double x = seen.projection.screenX(view);
  const double y = seen.projection.screenY(view);
  float slope_x = 0;
  float slope_y = 0;
  if (!seen.normals.empty()) {
    const Vector3f& n = seen.normals[static_cast<std::size_t>(i)];
    if (n.squaredNorm() > 0) {
      const float down = std::min(n.z(), -least_cosine);  // negative: depth grows away from the eye
      slope_x = -n.x() / down;
      slope_y = -n.y() / down;
    }
  }
  const float least = least_radius * per_sample;
  const float core = std::max(seen.core, least);
  const Range columns = around(x, reach, seen.width);
  const Range rows = around(y, reach, seen.height);
  for (int row = rows.low; row < rows.high; ++row) {
    const float dy = static_cast<float>(y - row - 0.5) * per_sample;
    for (int column = columns.low; column < columns.high; ++column) {
      const float dx = static_cast<float>(column + 0.5 - x) * per_sample;
      const float dz = slope_x * dx + slope_y * dy;
      const float flat = dx * dx + dy * dy;
      if (flat > radius * radius) continue;
      const float square = flat + dz * dz;
      if (square > radius * radius && flat > least * least) continue;
      const float depth = p.z() + dz + bulge * std::min(square / radius, radius);
      put(seen.samples[static_cast<std::size_t>(row) * seen.width + column], std::max(depth, float(nearest_depth)),
          static_cast<std::uint32_t>(i), flat > core * core);
    }
  }
}

void drawTriangle(SeenScene& seen, std::int64_t t) {
  Vector3d corners[3];
  bool is_in_front = true;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(seen.scene.triangles(t, k));
    corners[k] = seen.views[i].cast<double>();
    if (!seen.scene.positions.row(static_cast<Eigen::Index>(i)).allFinite()) return;
    is_in_front = is_in_front && corners[k].z() > nearest_depth;
  }
  Range columns = {0, seen.width};
  Range rows = {0, seen.height};
  if (is_in_front) {
    double low_x = 1e300, high_x = -1e300, low_y = 1e300, high_y = -1e300;
    for (const Vector3d& corner : corners) {
      low_x = std::min(low_x, seen.projection.screenX(corner));
      high_x = std::max(high_x, seen.projection.screenX(corner));
      low_y = std::min(low_y, seen.projection.screenY(corner));
      high_y = std::max(high_y, seen.projection.screenY(corner));
    }
    columns = around(0.5 * (low_x + high_x), 0.5 * (high_x - low_x) + 1e-6, seen.width);
    rows = around(0.5 * (low_y + high_y), 0.5 * (high_y - low_y) + 1e-6, seen.height);
  } else if (std::all_of(corners, corners + 3, [](const Vector3d& c) { return c.z() <= nearest_depth; })) {
    return;
  }
  const SeenTriangle triangle(seen.projection, corners[0], corners[1], corners[2]);
  const auto number = static_cast<std::uint32_t>(seen.scene.positions.rows() + t);
  for (int row = rows.low; row < rows.high; ++row)
    for (int column = columns.low; column < columns.high; ++column) {
      const Vector3d shares = triangle.shares(rayThrough(seen.projection, column, row));
      const bool is_inside = (shares.array() >= 0).all() || (shares.array() <= 0).all();
      if (!is_inside) continue;
      const double depth = triangle.depthAt(shares);
      if (depth > nearest_depth && depth < 1e30)
        put(seen.samples[static_cast<std::size_t>(row) * seen.width + column], static_cast<float>(depth), number);
    }
}

/// Whether a sample lies so far behind a point that it is on another surface.
bool isBehind(const SeenScene& seen, Sample sample, int point) {
  const float radius = seen.radii[static_cast<std::size_t>(point)];
  return sample == nothing || depthOf(sample) > seen.views[static_cast<std::size_t>(point)].z() + hole_depth * radius;
}

/// Fills a sample in a hole between discs: with a disc in front of it, if there are discs in front in nearly all
/// directions. Returns the sample itself otherwise.
Sample overHole(const SeenScene& seen, int x, int y) {
  static constexpr std::array<std::array<int, 2>, 8> directions = {
      {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, -1}, {1, -1}, {-1, 1}}};
  const Sample own = seen.samples[static_cast<std::size_t>(y) * seen.width + x];
  const auto n = static_cast<std::uint32_t>(seen.scene.positions.rows());
  for (const int reach : hole_reaches) {
    int in_front = 0;
    Sample first = own;
    for (const auto& [i, j] : directions) {
      const int u = x + reach * i;
      const int v = y + reach * j;
      if (u < 0 || v < 0 || u >= seen.width || v >= seen.height) continue;
      const Sample other = seen.samples[static_cast<std::size_t>(v) * seen.width + u];
      if (other == nothing || numberOf(other) >= n || other >= own) continue;
      const int point = static_cast<int>(numberOf(other));
      const bool is_wide = reach == hole_reaches[0] ||
                           hole_share * seen.screen_radii[static_cast<std::size_t>(point)] >= static_cast<float>(reach);
      if (!is_wide || !isBehind(seen, own, point)) continue;
      if (in_front++ == 0) first = other;
    }
    if (in_front >= hole_neighbors) return first;
  }
  return own;
}

/// Fills the holes that randomly spaced points leave between discs.
void closeHoles(SeenScene& seen, int threads) {
  std::vector<Sample> closed(seen.samples.size());
  forBlocks(threads, seen.height, 16, [&](std::int64_t begin, std::int64_t end) {
    for (int y = static_cast<int>(begin); y < end; ++y)
      for (int x = 0; x < seen.width; ++x) closed[static_cast<std::size_t>(y) * seen.width + x] = overHole(seen, x, y);
  });
  seen.samples = std::move(closed);
}

/// The radius of a point's disc on the screen, in samples.
float screenRadius(const SeenScene& seen, std::size_t i) {
  const float wanted = seen.radii[i] * static_cast<float>(seen.projection.scaleAt(seen.views[i].z()));
  return std::clamp(wanted, least_radius, std::max(least_radius, most_of_picture * static_cast<float>(seen.height)));
}

}  // namespace

SeenScene look(const Scene& scene, const NormalizedPoints& points, const Projection& projection, int width, int height,
               int threads) {
  const Eigen::Index n = scene.positions.rows();
  SeenScene seen = {scene, points, projection, width, height, {}, {}, {}, 0, {}, {}};
  seen.views.assign(static_cast<std::size_t>(n), Vector3f::Zero());
  std::vector<Vector3f> normals;
  std::vector<bool> is_corner(static_cast<std::size_t>(n), false);
  for (Eigen::Index t = 0; t < scene.triangles.rows(); ++t)
    for (int k = 0; k < 3; ++k) is_corner[static_cast<std::size_t>(scene.triangles(t, k))] = true;
  const auto is_disc = [&](int i) { return !is_corner[static_cast<std::size_t>(i)]; };
  std::vector<int> discs;
  seen.radii.assign(static_cast<std::size_t>(n), 0);
  if (std::any_of(points.finite.begin(), points.finite.end(), is_disc)) {
    Discs all = discsOf(scene, points, threads);
    seen.radii = std::move(all.radii);
    seen.core = all.core;
    normals = std::move(all.normals);
    discs = std::move(all.order);
    std::erase_if(discs, [&](int i) { return !is_disc(i); });
  }
  const bool has_normals = scene.normals.rows() == n && n > 0;
  if (has_normals || !normals.empty()) seen.normals.assign(static_cast<std::size_t>(n), Vector3f::Zero());
  seen.screen_radii.assign(static_cast<std::size_t>(n), 0);
  forBlocks(threads, static_cast<std::int64_t>(points.finite.size()), block_size,
            [&](std::int64_t begin, std::int64_t end) {
              for (std::int64_t k = begin; k < end; ++k) {
                const int i = points.finite[static_cast<std::size_t>(k)];
                const auto at = static_cast<std::size_t>(i);
                const Vector3d view = projection.toView(points.positions.row(i).transpose());
                seen.views[at] = view.cast<float>();
                seen.screen_radii[at] = screenRadius(seen, at);
                if (seen.normals.empty() || (has_normals && !scene.normals.row(i).allFinite())) continue;
                const Vector3d normal = projection.turn(has_normals ? Vector3d(scene.normals.row(i)).stableNormalized()
                                                                    : normals[at].cast<double>().eval());
                seen.normals[at] = (normal.dot(projection.sight(view)) > 0 ? Vector3d(-normal) : normal).cast<float>();
              }
            });
  seen.samples.assign(static_cast<std::size_t>(width) * height, nothing);
  forBlocks(threads, static_cast<std::int64_t>(discs.size()), block_size, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t k = begin; k < end; ++k) drawDisc(seen, discs[static_cast<std::size_t>(k)]);
  });
  if (!discs.empty()) closeHoles(seen, threads);
  forBlocks(threads, scene.triangles.rows(), 256, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t t = begin; t < end; ++t) drawTriangle(seen, t);
  });
  return seen;
}

}  // namespace tufted::view
