#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "base/buffer.h"
#include "base/parallel.h"
#include "base/point_buffer.h"
#include "denoise/quadratic_fit.h"
#include "neighbors/neighbor_source.h"
#include "stars/offsets.h"

namespace tufted {

/// The quadratic through the heights in one window; its fit radius is the radius of the base window.
struct WindowFit : HeightFit {
  double radius = 0;  ///< distance to the last neighbour of the window
  int count = 0;      ///< points that the fit is through, the middle included
};

/// Around each point, or every so many, four nested windows of neighbours: half the base window, the base window, twice
/// and four times as many neighbours. Around every so many points the two widest hold middles of others
/// instead, see fitThroughMiddles(). The tangent plane of all is that of the base window.
struct Windows {
  static constexpr int searched = 4;           ///< windows of neighbours, the smallest first
  static constexpr int sizes = searched + 2;   ///< with those of middles
  static constexpr std::int8_t base_size = 1;  ///< of all, the base window
  static constexpr int widest_stride = 8;      ///< all strides are powers of two, but that of a first look
  static constexpr int first_base = 32;        ///< neighbours in the base window, but where the noise is stronger
  static constexpr int pooled = 32;
  /// Windows spread over a window, by whose values its own are averaged.
  using Pool = std::array<int, pooled>;

  int stride = 1;                 ///< window w is that around the point of rank w * stride
  int fitted = searched;          ///< how many windows of neighbours have fits, the smallest first
  Buffer<int> base;               ///< neighbours in the base window of each: 32, 64, 128 or 256
  PointBuffer normal;             ///< of the base window
  RawBuffer<double> radius;       ///< of the base window
  RawBuffer<double> thickness;    ///< the smallest variance of the base window by the middle one
  RawBuffer<std::uint8_t> line;   ///< whether the base window is one scan line
  RawBuffer<std::uint8_t> split;  ///< whether neighbours of another sheet were left out of the base window
  /// From the middle to the centroid of a window, by its radius: of those wider than the base window the least, 0
  /// where there is none.
  RawBuffer<double> one_sided;
  Buffer<std::uint8_t> is_copy;  ///< whether it is the same as a window beside it, see copy()
  RawBuffer<std::array<WindowFit, sizes>> fits;
  RawBuffer<Pool> near;         ///< windows spread over the base window
  RawBuffer<Pool> middle, far;  ///< over twice and four times as many neighbours

  /// Room for windows around every `stride`-th of n points, with base windows of `first_base` neighbours.
  void resize(Eigen::Index n, int stride);
  /// How many windows there are around a point.
  int levels() const { return stride == 1 ? searched : sizes; }
  int size() const { return static_cast<int>(base.size()); }
  int pointOf(int w) const { return w * stride; }
  /// The distance of points from each other, were they spread evenly.
  double spacing(int w) const;
  /// Makes window w the same as window `other`.
  void copy(int other, int w);
  /// The window that the copy w is the same as: base windows of twice as many neighbours stand for twice as many
  /// points.
  int copied(int w) const { return w - w % (base[w] / first_base); }
};

/// The nearest neighbours of a point that belong to its surface; memory of one worker.
struct WindowNeighbors {
  std::span<const Neighbor> all;  ///< ascending; borrowed
  Buffer<std::uint8_t> skipped;   ///< of each, whether it is left out: an outlier, or of another sheet
  OffsetBuffer offsets;           ///< of all, from the middle; 0 where left out, which adds nothing to sums
  Buffer<double> heights;

  /// @param w the window whose plane tells sheets apart
  /// @param left_out n; points with an entry other than 0 are left out; may be empty
  void take(const PointsView& points, const Windows& windows, int w, std::span<const Neighbor> neighbors,
            const Buffer<std::uint8_t>& left_out);
};

class NeighborLists;

/// Makes windows and fits quadratics in them.
class WindowFitter {
 public:
  /// All arguments are borrowed.
  /// @param source by search, for `first_base` neighbours
  WindowFitter(const PointsView& points, const NeighborSource& source, const Workers& workers)
      : points_(points), source_(source), workers_(workers) {}

  const PointsView& points() const { return points_; }
  /// Planes of the base windows of some points, and quadratics in the first `fitted` ones.
  /// @param[out] lists gets the neighbours of each; null: they are not kept
  void take(std::span<const int> which, Windows& windows, NeighborLists* lists = nullptr) const;
  /// Fits the quadratics of some windows again.
  /// @param lists with the neighbours of each
  /// @param left_out n; points with an entry other than 0 are in no fit but their own
  void refit(std::span<const int> which, NeighborLists& lists, const Buffer<std::uint8_t>& left_out,
             Windows& windows) const;
  /// Spreads the pools of some windows, whose stride is a power of two, over the neighbours that their fits are
  /// through.
  void spreadPools(std::span<const int> which, const NeighborLists& lists, Windows& windows) const;

 private:
  PointsView points_;
  const NeighborSource& source_;
  const Workers& workers_;
};

}  // namespace tufted
