#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "base/buffer.h"
#include "base/parallel.h"
#include "base/point_buffer.h"
#include "neighbors/neighbor_source.h"
#include "stars/denoise.h"
#include "stars/offsets.h"

namespace tufted {

/// The quadratic through the heights in one window; its fit radius is the radius of the base window.
struct WindowFit : HeightFit {
  double radius = 0;  ///< distance to the last neighbour of the window
  int count = 0;      ///< points that the fit is through, p included
};

/// Around each point four nested windows of neighbours: half the base window, the base window, twice and four times as
/// many neighbours. The tangent plane of all four is that of the base window.
struct Windows {
  static constexpr int sizes = 4;
  static constexpr int first_base = 32;  ///< neighbours in the base window, but where the noise is stronger
  static constexpr int pooled = 32;
  /// Points spread over a window, by whose values a point's own are averaged.
  using Pool = std::array<int, pooled>;

  Buffer<int> base;               ///< n, neighbours in the base window: 32, 64, 128 or 256
  PointBuffer normal;             ///< n x 3
  RawBuffer<double> radius;       ///< n, of the base window
  RawBuffer<double> thickness;    ///< n, the smallest variance of the base window by the middle one
  RawBuffer<std::uint8_t> line;   ///< n, whether the base window is one scan line
  RawBuffer<std::uint8_t> split;  ///< n, whether neighbours of another sheet were left out of the base window
  RawBuffer<std::array<WindowFit, sizes>> fits;  ///< n
  RawBuffer<Pool> near;                          ///< n, spread over the base window
  RawBuffer<Pool> middle, far;  ///< n, over twice and four times as many; set with the fits of these windows

  int size() const { return static_cast<int>(base.size()); }
  /// The distance of points from each other, were they spread evenly.
  double spacing(int p) const;
};

/// The nearest neighbours of a point that belong to its surface; memory of one worker.
struct WindowNeighbors {
  std::span<const Neighbor> all;  ///< ascending; borrowed
  Buffer<std::uint8_t> skipped;   ///< of each, whether it is left out: an outlier, or of another sheet
  OffsetBuffer offsets;           ///< of all, from p; 0 where left out, which adds nothing to sums
  Buffer<double> heights;

  /// @param left_out n; points with an entry other than 0 are left out; may be empty
  void take(const PointsView& points, const Windows& windows, int p, std::span<const Neighbor> neighbors,
            const Buffer<std::uint8_t>& left_out);
};

/// Makes windows and fits quadratics in them.
class WindowFitter {
 public:
  /// All arguments are borrowed.
  /// @param source by search, for `first_base` neighbours
  WindowFitter(const PointsView& points, const NeighborSource& source, const Workers& workers)
      : points_(points), source_(source), workers_(workers) {}

  /// Base windows of `first_base` neighbours around every point, with planes.
  void start(Windows& windows) const;
  /// Doubles the base windows of some points.
  void widen(std::span<const int> which, Windows& windows) const;
  /// Takes base windows back to `first_base`.
  void reset(std::span<const int> which, Windows& windows) const;
  /// Fits quadratics in the two smaller windows of some points.
  /// @param left_out n; points with an entry other than 0 are in no fit but their own; may be empty
  void fitNear(std::span<const int> which, const Buffer<std::uint8_t>& left_out, Windows& windows) const;
  /// Fits quadratics in all four windows of some points.
  void fitAll(std::span<const int> which, const Buffer<std::uint8_t>& left_out, Windows& windows) const;

 private:
  void takePlanes(std::span<const int> which, Windows& windows) const;
  void fit(std::span<const int> which, int sizes, const Buffer<std::uint8_t>& left_out, Windows& windows) const;

  PointsView points_;
  const NeighborSource& source_;
  const Workers& workers_;
};

}  // namespace tufted
