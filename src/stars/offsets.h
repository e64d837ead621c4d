#pragma once

#include <Eigen/Core>
#include <span>

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "neighbors/neighbors.h"
#include "simd/kernels.h"

namespace tufted {

/// The offsets q - p of one neighbourhood, padded to whole packets with 0.
class OffsetBuffer {
 public:
  /// Sets the offsets from p to the neighbours.
  void take(const PointsView& points, int p, std::span<const Neighbor> neighbors) {
    const double* const all = points.data();
    const double* const origin = all + 3 * std::ptrdiff_t{p};
    fill(static_cast<int>(neighbors.size()), [&](int i) {
      const double* const q = all + 3 * std::ptrdiff_t{neighbors[i].index};
      return Eigen::RowVector3d(q[0] - origin[0], q[1] - origin[1], q[2] - origin[2]);
    });
  }

  /// Sets the offsets to offset(0), offset(1), ...
  template <class Offset>
  void fill(int count, const Offset& offset) {
    resize(count);
    double *const x = axis(0), *const y = axis(1), *const z = axis(2);
    for (int i = 0; i < count; ++i) {
      const Eigen::RowVector3d d = offset(i);
      x[i] = d[0];
      y[i] = d[1];
      z[i] = d[2];
    }
    for (int i = count; i < toPackets(count); ++i) x[i] = y[i] = z[i] = 0;
  }

  /// Keeps those of the given offsets whose heights are in the range; `given` may be a view of this buffer.
  void takeConnected(const Offsets& given, const double* heights, const HeightRange& range) {
    const bool is_own = !memory_.empty() && given.x == axis(0);
    if (!is_own) resize(given.count);
    count_ = kernels().keepConnected(given, heights, range, axis(0), axis(1), axis(2));
  }

  int count() const { return count_; }

  /// Valid until the next change.
  Offsets view() const { return {count_, axis(0), axis(1), axis(2)}; }

 private:
  struct alignas(64) Values {
    double value[kernel_packet];
  };

  void resize(int count) {
    count_ = count;
    room_ = static_cast<std::size_t>(toPackets(count)) / kernel_packet;
    if (memory_.size() < 3 * room_ + 1) memory_.resize(3 * room_ + 1);  // never empty
  }
  double* axis(int c) { return (memory_.data() + c * room_)->value; }
  const double* axis(int c) const { return (memory_.data() + c * room_)->value; }

  RawBuffer<Values> memory_;  ///< x, y, z, one after the other
  std::size_t room_ = 0;      ///< packets per axis
  int count_ = 0;
};

}  // namespace tufted
