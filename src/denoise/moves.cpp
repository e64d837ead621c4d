#include "denoise/moves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "denoise/noise_level.h"
#include "denoise/surface_fits.h"

namespace tufted {
namespace {

/// An outlier is more than this many sigmas, and spacings, off the surface of its neighbours. Of normal noise one point
/// in a million is that many sigmas off; points nearer than a spacing do little harm.
constexpr double outlier_sigmas = 5, outlier_spacings = 1;
/// A fit moves points up to this many squared radii from its centre, so that fits of the faces reach a crease. With
/// 0.75, 0.9, 1.1 and 1.4 real shapes keep 0.158, 0.157, 0.156 and 0.156 of noise of 0.3 spacings.
constexpr double reach_squared = 1.2;
/// The weight of a fit falls by a factor of e for this excess, see excessOf(). With 1, 1.5 and 3 the results are the
/// same.
constexpr double most_excess = 2;
/// Noise draws fits inwards by about this times its variance times the mean curvature, by which points are put back.
/// With 1 eigenvalues of real shapes are off by 3.5e-2, with 2 by 3.3e-2; those of a sphere by 1.9e-3 and 2.6e-3.
constexpr double taken_back = 2;
/// A sum of weights below this is rounding, and the point stays.
constexpr double least_weight_sum = 1e-12;

/// Moves points onto the weighted mean of the surfaces around them.
class Mover {
 public:
  /// All arguments are borrowed.
  Mover(const PointsView& points, const SurfaceFits& fits, const RawBuffer<LocalNoise>& noise)
      : points_(points), fits_(fits), noise_(noise) {}

  /// @param[out] move 0 if the point stays
  /// @returns whether p is an outlier
  bool move(int p, Eigen::Vector3d& move) const {
    const int near = fits_.centers.near[p];
    const double variance = noise_[near].variance;
    move.setZero();
    double weights = 0, nearest = std::numeric_limits<double>::infinity();
    for (const int c : fits_.poolOf(near)) {
      if (noise_[c].size < 0) continue;
      const SurfaceFit& fit = fits_.surface[c].fit[noise_[c].size];
      if (!fit.isValid()) continue;
      const Eigen::Vector3d d = (points_.row(p) - points_.row(fits_.centers.rank[c])).transpose();
      const double squared = d.squaredNorm() / (double{fit.radius} * fit.radius);
      if (!(squared < reach_squared)) continue;
      const double up = -taken_back * variance * (double{fit.coefficient[3]} + fit.coefficient[5]) / fit.radius;
      const auto [height, normal] = fit.at(d);
      const double way = up - height;
      nearest = std::min(nearest, way * way);
      if (!(way * way < outlier_sigmas * outlier_sigmas * variance)) continue;
      const double excess = std::max(0.0, excessOf(fit, noise_[c].size, variance));
      const double weight = (1 - squared / reach_squared) * std::exp(-excess / most_excess) / fit.leverage;
      move += weight * way * normal;
      weights += weight;
    }
    if (weights > least_weight_sum)
      move /= weights;
    else
      move.setZero();
    const double spacing = outlier_spacings * fits_.surface[near].spacing;
    return weights == 0 && std::isfinite(nearest) &&
           nearest > std::max(outlier_sigmas * outlier_sigmas * variance, spacing * spacing);
  }

 private:
  PointsView points_;
  const SurfaceFits& fits_;
  const RawBuffer<LocalNoise>& noise_;
};

}  // namespace

SurfaceMoves surfaceMoves(const PointsView& points, const PointBuffer& normals, const NeighborSearch& search,
                          const Workers& workers) {
  SurfaceMoves result;
  const auto n = static_cast<int>(points.rows());
  const auto count = static_cast<std::size_t>(n);
  result.move.setZero(n);
  result.variance.resize(count);
  result.outlier.assign(count, 0);
  if (n <= fit_sizes[1]) return result;
  const Buffer<std::uint8_t> inside = whereNoiseMayBe(points, normals, search, workers);
  Centers centers = manyCenters(points, normals, search, inside, workers);
  if (centers.rank.size() < 2) return result;
  const SurfaceFits fits = fitSurfaces(points, normals, search, std::move(centers), workers);
  const RawBuffer<LocalNoise> noise = findNoise(fits, workers);
  const Mover mover(points, fits, noise);
  workers.forBlocks("noise", n, star_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (auto p = static_cast<int>(begin); p < end; ++p) {
      if (inside[p] == 0) continue;
      const LocalNoise& around = noise[fits.centers.near[p]];
      result.variance[p] = around.variance;
      if (around.size < 0) continue;
      Eigen::Vector3d move;
      result.outlier[p] = mover.move(p, move) ? 1 : 0;
      result.move.row(p) = move.transpose();
    }
  });
  for (int p = 0; p < n; ++p) result.no_surface += inside[p] != 0 && noise[fits.centers.near[p]].no_surface ? 1 : 0;
  return result;
}

std::int64_t SurfaceMoves::count() const {
  std::int64_t moved = 0;
  for (int p = 0; p < move.rows(); ++p) moved += move.row(p).isZero(0) ? 0 : 1;
  return moved;
}

}  // namespace tufted
