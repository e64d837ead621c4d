#include "denoise/surface_fits.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "denoise/listed_search.h"
#include "stars/quadratic_fit.h"
#include "stars/sheets.h"
#include "stars/tangent_frame.h"

namespace tufted {
namespace {

/// A fit with more leverage than this passes through its point and tells nothing about it. Inside a surface a fit to 16
/// points has 0.3.
constexpr double most_leverage = 0.9;
/// Heights farther apart than this share of the radius belong to two sheets. With 0.25 and 0.5 the results are the
/// same.
constexpr double gap = 0.35;
/// Number of neighbours from which the spacing and the share of inner ones are measured. Of 128 some belong to other
/// strands of a knot.
constexpr int measured = 64;

/// Fits surfaces around one point at a time; memory of one worker.
class SurfaceFitter {
 public:
  explicit SurfaceFitter(const PointsView& points) : points_(points) {}

  /// @param neighbors by ascending distance, as many as the widest fit needs, or all
  void fit(int p, std::span<const Neighbor> neighbors, LocalSurface& surface) {
    const auto fitted = static_cast<std::size_t>(
        std::ranges::count_if(fit_sizes, [&](int size) { return size <= std::ssize(neighbors); }));
    surface.fit = {};
    all_.take(points_, p, neighbors);
    fitPlanes(neighbors, std::span(surface.fit).first(fitted));
    for (std::size_t s = 0; s < fitted; ++s) takeMoments(fit_sizes[s], surface.fit[s], moments_[s]);
    fitHeights(std::span(moments_).first(fitted), std::span(fits_).first(fitted));
    for (std::size_t s = 0; s < fitted; ++s) {
      if (!fits_[s].is_valid || !(fits_[s].leverage < most_leverage)) continue;
      SurfaceFit& fit = surface.fit[s];
      std::ranges::copy(fits_[s].coefficient, fit.coefficient.begin());
      fit.leverage = static_cast<float>(fits_[s].leverage);
      fit.variance = static_cast<float>(fits_[s].variance);
    }
    const std::size_t count = std::min<std::size_t>(measured, neighbors.size());
    const double squared = neighbors[count - 1].squared_distance;
    surface.spacing = static_cast<float>(std::sqrt(squared * std::numbers::pi / static_cast<double>(count)));
    const auto inside =
        std::ranges::count_if(neighbors, [&](const Neighbor& q) { return q.squared_distance <= squared / 4; });
    surface.inner_share = static_cast<float>(inside) / static_cast<float>(std::max<std::size_t>(1, count - 1));
  }

 private:
  void fitPlanes(std::span<const Neighbor> neighbors, std::span<SurfaceFit> fits) {
    const double extent = std::sqrt(neighbors.back().squared_distance);
    for (std::size_t s = 0; s < fits.size(); s += most_sets) {
      const std::size_t together = std::min<std::size_t>(most_sets, fits.size() - s);
      findCovariances(all_.view(), extent, std::span(fit_sizes).subspan(s, together),
                      std::span(covariances_).subspan(s, together));
    }
    principalAxes(std::span(covariances_).first(fits.size()), axes_);
    for (std::size_t s = 0; s < fits.size(); ++s) {
      SurfaceFit& fit = fits[s];
      for (int axis = 0; axis < 3; ++axis) fit.normal[axis] = static_cast<float>(axes_[s].normal[axis]);
      fit.radius = static_cast<float>(std::sqrt(neighbors[fit_sizes[s] - 1].squared_distance));
      const Eigen::Vector3d& variance = axes_[s].variance;
      if (variance[1] > 0) fit.thickness = static_cast<float>(std::clamp(variance[0] / variance[1], 0.0, 1.0));
    }
  }

  void takeMoments(int size, const SurfaceFit& fit, HeightMoments& moments) {
    Offsets first = all_.view();
    first.count = size;
    heights_.resize(static_cast<std::size_t>(size));
    const Eigen::Vector3d normal(fit.normal[0], fit.normal[1], fit.normal[2]);
    const HeightRange range = kernels().connectedHeights(first, normal.data(), gap * fit.radius, heights_.data());
    if (!isWhole(range)) sheet_.takeConnected(first, heights_.data(), range);
    moments = heightMoments(isWhole(range) ? first : sheet_.view(), normal, fit.radius);
  }

  PointsView points_;
  OffsetBuffer all_, sheet_;
  Buffer<double> heights_;
  std::array<Covariance, sizes> covariances_;
  std::array<PrincipalAxes, sizes> axes_;
  std::array<HeightMoments, sizes> moments_;
  std::array<HeightFit, sizes> fits_;
};

}  // namespace

SurfacePlace SurfaceFit::at(const Eigen::Vector3d& d) const {
  // A normal of floats is not exactly a unit vector; what follows holds for any length.
  const Eigen::Vector3d up(normal[0], normal[1], normal[2]), first = tangentOf(up), second = up.cross(first);
  const auto& c = coefficient;
  const double u = d.dot(first) / radius, v = d.dot(second) / radius;
  const double height = radius * (c[0] + c[1] * u + c[2] * v + c[3] * u * u + c[4] * u * v + c[5] * v * v);
  const double along_u = c[1] + 2 * c[3] * u + c[4] * v, along_v = c[2] + c[4] * u + 2 * c[5] * v;
  const Eigen::Vector3d across = up - along_u * first - along_v * second;
  const double length = across.norm();
  return {(d.dot(up) - height) / length, across / length};
}

SurfaceFits fitSurfaces(const PointsView& points, const PointBuffer& normals, const NeighborSearch& search,
                        Centers centers, const Workers& workers) {
  SurfaceFits fits;
  fits.centers = std::move(centers);
  const Buffer<int>& ranks = fits.centers.rank;
  fits.surface.resize(ranks.size());
  workers.forBlocks("surface fits", fits.count(), costly_block, [&](std::int64_t begin, std::int64_t end, int) {
    SurfaceFitter fitter(points);
    LocalSurface* surface = &fits.surface[begin];
    forEachListed(points, normals, search, std::span(ranks).subspan(begin, end - begin), fit_sizes.back(),
                  [&](int p, std::span<const Neighbor> neighbors) { fitter.fit(p, neighbors, *surface++); });
  });
  const PointBuffer places = placesOf(points, ranks), sides = normals.rows() > 0 ? placesOf(normals, ranks) : normals;
  const NeighborSearch among_centers(places, workers);
  fits.pool_size = std::min(SurfaceFits::most_pooled, fits.count());
  fits.pool.resize(static_cast<std::size_t>(fits.count()) * fits.pool_size);
  // Where normals are given, half of the nearest may be on the other side of a thin part.
  const int searched = normals.rows() > 0 ? std::min(2 * fits.pool_size, fits.count()) - 1 : fits.pool_size - 1;
  workers.forBlocks("pools", fits.count(), costly_block, [&](std::int64_t begin, std::int64_t end, int) {
    BatchScratch scratch;
    Buffer<Neighbor> found;
    nearestOfEach(among_centers, places, static_cast<int>(begin), static_cast<int>(end - begin), searched, kernels(),
                  scratch, found);
    int* pooled = &fits.pool[begin * fits.pool_size];
    std::span<Neighbor> next(found);
    for (auto c = static_cast<int>(begin); c < end; ++c, next = next.subspan(static_cast<std::size_t>(searched))) {
      const auto own = static_cast<int>(keepOwnSide(places, sides, c, next.first(static_cast<std::size_t>(searched))));
      *pooled++ = c;
      for (int i = 1; i < fits.pool_size; ++i) *pooled++ = i <= own ? next[static_cast<std::size_t>(i) - 1].index : c;
    }
  });
  return fits;
}

}  // namespace tufted
