#include "algorithms/fine_normals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/parallel.h"
#include "operators/rings.h"
#include "stars/offsets.h"
#include "stars/quadratic_fit.h"
#include "stars/tangent_frame.h"

namespace tufted {
namespace {

/// Nearest points that a plane is fitted to, beside the point itself. With it 10: of 10, 16, 30 and 48 this is the best
/// on 14 clean shapes, and the second best on denoised ones.
constexpr std::size_t fitted_neighbors = 9;
/// A middle variance below this part of the largest counts as 0: points on a line keep the normal of 30 points.
constexpr double singular = 1e-9;
/// Least cosine to the normal of 30 points; a fit below it follows noise and is not used. Without it one normal in 800
/// would point inwards on a cube with 1 % noise.
constexpr double least_agreement = 0.5;
/// Squared distances that differ by less than this part count as equal, so that a lattice has one answer in any order.
constexpr double equal_distances = 1e-9;

/// A plane or quadratic fitted to some points.
struct Fit {
  Eigen::Vector3d normal;
  double variance;  ///< of the heights over it, by degrees of freedom
};

/// Fits a plane to p and the points at some offsets from it.
std::optional<Fit> planeThrough(const Offsets& offsets) {
  const PrincipalAxes axes = principalAxes(offsets);
  if (!(axes.variance[1] > singular * axes.variance[2])) return std::nullopt;
  const double count = offsets.count + 1;
  return Fit{axes.normal, std::max(0.0, axes.variance[0]) * axes.extent * axes.extent * count / (count - 3)};
}

/// Fits a quadratic over the plane of a normal, and once more over its own tangent plane.
std::optional<Fit> quadraticThrough(const Offsets& offsets, Eigen::Vector3d normal) {
  double variance = 0;
  for (int round = 0; round < 2; ++round) {
    const HeightFit fit = fitHeights(heightMoments(offsets, normal, 1));
    if (!fit.is_valid) return std::nullopt;
    normal = normalOf(fit, normal);
    variance = fit.variance;
  }
  return Fit{normal, variance};
}

/// Offsets from p to the points of its first two rings, divided by the longest, in ascending length.
void takeOffsets(int p, const Points& positions, Rings& rings, std::vector<Eigen::RowVector3d>& offsets) {
  rings.start(p);
  rings.grow();
  rings.grow();
  offsets.clear();
  for (const int q : rings.points()) {
    if (q != p) offsets.emplace_back(positions.row(q) - positions.row(p));
  }
  // Against overflow and underflow of squares.
  double extent = 0;
  for (const Eigen::RowVector3d& d : offsets) extent = std::max(extent, d.stableNorm());
  for (Eigen::RowVector3d& d : offsets) d /= extent;
  std::sort(offsets.begin(), offsets.end(),
            [](const Eigen::RowVector3d& a, const Eigen::RowVector3d& b) { return a.squaredNorm() < b.squaredNorm(); });
}

/// Number of the nearest `fitted_neighbors` offsets, and of those as long as the last of them.
int countFew(const std::vector<Eigen::RowVector3d>& offsets) {
  std::size_t count = std::min(fitted_neighbors, offsets.size());
  const double farthest = (1 + equal_distances) * offsets[count - 1].squaredNorm();
  while (count < offsets.size() && offsets[count].squaredNorm() <= farthest) ++count;
  return static_cast<int>(count);
}

/// The normal or its opposite, the same for both: fits on either side round differently.
Eigen::Vector3d upright(const Eigen::Vector3d& normal) {
  const double decides = normal.z() != 0 ? normal.z() : normal.y() != 0 ? normal.y() : normal.x();
  return decides < 0 ? Eigen::Vector3d(-normal) : normal;
}

}  // namespace

void takeFineNormals(const Laplacian& laplacian, int threads, const Progress& progress, Frames& frames) {
  const Workers workers(threads, progress);
  struct Scratch {
    Rings rings;
    std::vector<Eigen::RowVector3d> offsets;
    OffsetBuffer buffer;
  };
  std::vector<Scratch> scratches(static_cast<std::size_t>(workers.count()), {Rings(laplacian.L), {}, {}});
  workers.forBlocks("normals", frames.normals.rows(), costly_block, [&](std::int64_t begin, std::int64_t end, int w) {
    auto& [rings, offsets, buffer] = scratches[w];
    for (auto p = static_cast<int>(begin); p < end; ++p) {
      if (laplacian.status[p] != PointStatus::active) continue;
      takeOffsets(p, laplacian.positions, rings, offsets);
      if (offsets.empty()) continue;
      buffer.fill(static_cast<int>(offsets.size()), [&](int i) { return scratches[w].offsets[i]; });
      const Offsets all = buffer.view(), nearest{countFew(offsets), all.x, all.y, all.z};
      const Eigen::Vector3d before = frames.normals.row(p), tangent = frames.tangents.row(p);
      const std::optional<Fit> bent = quadraticThrough(all, upright(before)), near = planeThrough(nearest);
      if (!bent || !near) continue;
      const Eigen::Vector3d& found = near->variance <= bent->variance ? near->normal : bent->normal;
      const double cosine = found.dot(before);
      if (!(std::abs(cosine) >= least_agreement)) continue;
      const Eigen::Vector3d normal = cosine < 0 ? Eigen::Vector3d(-found) : found;
      frames.normals.row(p) = normal;
      // The tangent turns with the normal, about the axis perpendicular to both normals.
      frames.tangents.row(p) = tangent - normal.dot(tangent) / (1 + before.dot(normal)) * (before + normal);
    }
  });
}

}  // namespace tufted
