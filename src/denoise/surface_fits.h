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

/// Neighbours that quadratics are fitted to, whole packets.
constexpr std::array<int, 5> fit_sizes = {16, 32, 64, 128, 256};
constexpr int sizes = static_cast<int>(fit_sizes.size());

/// A surface at one position.
struct SurfacePlace {
  double height;           ///< of the position over it
  Eigen::Vector3d normal;  ///< of the surface there
};

/// A quadratic through the heights of a point and so many of its neighbours over their plane.
struct SurfaceFit {
  std::array<float, 6> coefficient{};  ///< of 1, u, v, u^2, u v, v^2, in units of `radius`
  std::array<float, 3> normal{};       ///< of the plane, unit length
  float radius = 0;                    ///< distance to the last neighbour
  float leverage = 1;                  ///< variance of the height over the point by that of each point's
  /// The variance of the residuals: their sum of squares by the number of points less 6. It is infinite where there is
  /// no fit.
  float variance = std::numeric_limits<float>::infinity();
  float thickness = 1;  ///< smallest by middle variance of the points

  bool isValid() const { return variance < std::numeric_limits<float>::infinity(); }
  /// The height of the quadratic over the point, along the normal of the plane.
  double height() const { return double{coefficient[0]} * radius; }
  /// The square of what the other points, by the same fit without the point, predict its height wrong by, divided by
  /// what it would be on average by the variance of noise that is independent from point to point.
  double squaredError() const { return height() * height() / (1 - leverage); }
  /// @param d from the point to a position
  SurfacePlace at(const Eigen::Vector3d& d) const;
};

/// What is known of the surface around one point.
struct LocalSurface {
  std::array<SurfaceFit, sizes> fit;
  float spacing;      ///< of points that are spread evenly over a disk with `measured` neighbours
  float inner_share;  ///< of these neighbours but the farthest, those within half of its distance
};

/// Surfaces around the centres.
struct SurfaceFits {
  /// Centres in a pool, which is about 100 points; their mean error is uncertain by a quarter.
  static constexpr int most_pooled = 32;

  Centers centers;
  RawBuffer<LocalSurface> surface;  ///< m
  RawBuffer<int> pool;              ///< m x pool_size: numbers of the centres nearest to each, itself first
  int pool_size = 0;                ///< at most `most_pooled`

  int count() const { return static_cast<int>(surface.size()); }
  std::span<const int> poolOf(int c) const {
    return std::span<const int>(pool).subspan(static_cast<std::size_t>(c) * pool_size, pool_size);
  }
};

/// Fits quadratics around every centre. Neighbours of other sheets, beyond a gap of heights, are left out.
/// @param search among the points
SurfaceFits fitSurfaces(const PointsView& points, const NeighborSearch& search, Centers centers,
                        const Workers& workers);

}  // namespace tufted
