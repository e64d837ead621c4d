// Lengths, cotangents and areas of stars; cover/cover.cpp is the reference.
#include "direct/star_metric.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "base/buffer.h"
#include "cover/geometry.h"
#include "direct/triangle_fans.h"

namespace tufted {
namespace {

/// Sums over one block of stars, so that they have the same bits for any number of threads.
struct BlockSums {
  double length = 0, square = 0;
  std::int64_t triangles = 0;
  bool has_flat = false;
};

class StarMeasurer {
 public:
  StarMeasurer(const Stars& stars, const EdgeLengths& length, StarMetric& metric)
      : stars_(stars), length_(length), metric_(metric) {}

  void measure(int begin, int end, TriangleFanBuffer& buffer, BlockSums& sums) const {
    forEachTriangleFan(stars_, length_, Numbers{begin, end}, buffer,
                       [&](int p, const TriangleFans& fans, int at) { take(p, fans, at, sums); });
  }

 private:
  /// @param at the first triangle of star p in the fans
  void take(int p, const TriangleFans& fans, int at, BlockSums& sums) const {
    const int begin = stars_.offset[p], end = stars_.offset[p + 1];
    const double nan = std::numeric_limits<double>::quiet_NaN();
    // cotangents opposite the first spoke, and opposite spoke i in the previous triangle
    double area = 0, first = nan, before = nan;
    bool is_flat = false;
    for (int i = begin; i < end; ++i, ++at) {
      if (!stars_.hasTriangle(i)) {
        metric_.cotan_sum[i] = before = nan;
        continue;
      }
      if (i == begin) first = fans.cotan_at_next[at];
      metric_.cotan_sum[i] = before + fans.cotan_at_next[at];
      before = fans.cotan_at_own[at];
      area += fans.area[at];
      const double own = fans.spoke[at], next = fans.spoke[at + 1], rim = fans.rim[at];
      sums.length += own + next + rim;
      sums.square += own * own + next * next + rim * rim;
      is_flat |= !(fans.area[at] > 0) || fans.slack[at] < flat_slack * std::max({own, next, rim});
      ++sums.triangles;
    }
    if (begin < end) metric_.cotan_sum[begin] = before + first;  // the triangle before the first spoke is the last
    metric_.area[p] = area;
    metric_.is_flat[p] = is_flat ? 1 : 0;
    sums.has_flat |= is_flat;
  }

  const Stars& stars_;
  const EdgeLengths& length_;
  StarMetric& metric_;
};

}  // namespace

StarMetric measureStars(const Stars& stars, const EdgeLengths& length, RawBuffer<double> memory,
                        const Workers& workers) {
  StarMetric metric;
  metric.cotan_sum = std::move(memory);
  metric.cotan_sum.resize(stars.link.size());
  metric.area.resize(stars.size());
  metric.is_flat.resize(stars.size());
  Buffer<BlockSums> sums((stars.size() + cheap_block - 1) / cheap_block);
  const StarMeasurer measurer(stars, length, metric);
  workers.forBlocks("lengths", stars.size(), cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
    TriangleFanBuffer buffer;
    measurer.measure(static_cast<int>(begin), static_cast<int>(end), buffer, sums[begin / cheap_block]);
  });
  BlockSums all;
  for (const BlockSums& sum : sums) {
    all.length += sum.length;
    all.square += sum.square;
    all.triangles += sum.triangles;
    metric.has_flat |= sum.has_flat;
  }
  if (all.triangles > 0) {
    const auto sides = static_cast<double>(3 * all.triangles);
    metric.mean = {all.length / sides, all.square / sides};
  }
  return metric;
}

}  // namespace tufted
