#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <span>

#include "base/buffer.h"
#include "base/parallel.h"
#include "base/point_buffer.h"
#include "denoise/centers.h"
#include "neighbors/neighbors.h"

namespace tufted {

/// Numbers of neighbours that quadratics are fitted to, whole packets.
constexpr std::array<int, 5> fit_sizes = {16, 32, 64, 128, 256};
constexpr int sizes = static_cast<int>(fit_sizes.size());

/// A surface near a position.
struct SurfacePlace {
  double height;           ///< signed distance of the position from the surface
  Eigen::Vector3d normal;  ///< of the surface there, unit length
};

/// A quadratic fitted to the heights of a centre and its nearest neighbours over their plane.
struct SurfaceFit {
  std::array<float, 6> coefficient{};  ///< of 1, u, v, u^2, u v, v^2, in units of `radius`
  std::array<float, 3> normal{};       ///< normal of the plane, unit length
  float radius = 0;                    ///< distance to the last neighbour
  float leverage = 1;                  ///< variance of height() over that of the noise of each point
  /// Variance of the residuals: their sum of squares over m - 6, for m points. Infinite without a fit.
  float variance = std::numeric_limits<float>::infinity();
  float thickness = 1;  ///< smallest variance of the points over the middle one

  bool isValid() const { return variance < std::numeric_limits<float>::infinity(); }
  /// The height of the quadratic over the centre, along the normal of the plane.
  double height() const { return double{coefficient[0]} * radius; }
  /// The squared error of predicting the centre's height by the same fit without the centre, scaled so that its mean is
  /// the variance of independent noise (E in section 27 of docs/algorithm.md).
  double squaredError() const { return height() * height() / (1 - leverage); }
  /// @param d from the centre to a position
  SurfacePlace at(const Eigen::Vector3d& d) const;
};

/// The fits of all sizes around one centre.
struct LocalSurface {
  std::array<SurfaceFit, sizes> fit;
  float spacing;      ///< spacing of points spread evenly over the disk of `measured` neighbours
  float inner_share;  ///< share of these neighbours, without the farthest, within half of its distance
};

/// Surfaces around all centres, and their pools.
struct SurfaceFits {
  /// Greatest number of centres in a pool, for about 100 points; their mean error is uncertain by a quarter.
  static constexpr int most_pooled = 32;

  Centers centers;
  RawBuffer<LocalSurface> surface;  ///< m
  RawBuffer<int> pool;              ///< m x pool_size: the centres nearest to each, itself first
  int pool_size = 0;                ///< at most `most_pooled`

  int count() const { return static_cast<int>(surface.size()); }
  std::span<const int> poolOf(int c) const {
    return std::span<const int>(pool).subspan(static_cast<std::size_t>(c) * pool_size, pool_size);
  }
};

/// Fits quadratics around every centre, without neighbours beyond a gap of heights or with opposed normals, which are
/// on other sheets.
/// @param points n x 3, those of `search`
/// @param normals n x 3, or 0 x 3 if not known
SurfaceFits fitSurfaces(const PointsView& points, const PointBuffer& normals, const NeighborSearch& search,
                        Centers centers, const Workers& workers);

}  // namespace tufted
