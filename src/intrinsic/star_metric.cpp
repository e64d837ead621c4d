#include "intrinsic/star_metric.h"

#include <algorithm>
#include <limits>

#include "base/buffer.h"
#include "intrinsic/geometry.h"

namespace tufted {
namespace {

constexpr std::int64_t block_size = 8192;

/// Sums over one block of stars, so that they have the same bits for any number of threads.
struct BlockSums {
  double length = 0, square = 0, least_slack = std::numeric_limits<double>::infinity();
  std::int64_t triangles = 0;
};

class StarMeasurer {
 public:
  StarMeasurer(const Stars& stars, const EdgeLengths& length, StarMetric& metric)
      : stars_(stars), length_(length), metric_(metric) {}

  void measure(int p, Buffer<double>& spokes, BlockSums& sums) const {
    const int begin = stars_.offset[p], end = stars_.offset[p + 1];
    const double nan = std::numeric_limits<double>::quiet_NaN();
    spokes.clear();
    for (int i = begin; i < end; ++i) spokes.push_back(length_(p, stars_.link[i]));
    double area = 0, first = nan,
           before = nan;  // cotangents opposite spokes: at b in the first triangle, at a in the last
    bool is_flat = false;
    for (int i = begin; i < end; ++i) {
      if (!stars_.hasTriangle(i)) {
        metric_.cotan_sum[i] = before = nan;
        continue;
      }
      const int next = stars_.after(p, i);
      const double pa = spokes[i - begin], pb = spokes[next - begin];
      const double ab = length_(stars_.link[i], stars_.link[next]);
      const double own_area = triangleArea(pa, pb, ab), inverse = 1 / (4 * own_area);
      const double at_b = cotanNumerator(pa, pb, ab) * inverse;  // opposite the spoke to a
      if (i == begin) first = at_b;
      metric_.cotan_sum[i] = before + at_b;
      before = cotanNumerator(pb, pa, ab) * inverse;
      area += own_area;
      is_flat |= !(own_area > 0);
      sums.length += pa + pb + ab;
      sums.square += pa * pa + pb * pb + ab * ab;
      sums.least_slack = std::min(sums.least_slack, triangleSlack(pa, pb, ab));
      ++sums.triangles;
    }
    if (begin < end) metric_.cotan_sum[begin] = before + first;  // the triangle before the first spoke is the last
    metric_.area[p] = area;
    metric_.is_flat[p] = is_flat ? 1 : 0;
  }

 private:
  const Stars& stars_;
  const EdgeLengths& length_;
  StarMetric& metric_;
};

}  // namespace

StarMetric measureStars(const Stars& stars, const EdgeLengths& length, const Workers& workers) {
  StarMetric metric;
  metric.cotan_sum.resize(stars.link.size());
  metric.area.resize(stars.size());
  metric.is_flat.resize(stars.size());
  Buffer<BlockSums> sums((stars.size() + block_size - 1) / block_size);
  const StarMeasurer measurer(stars, length, metric);
  workers.forBlocks("lengths", stars.size(), block_size, [&](std::int64_t begin, std::int64_t end, int) {
    Buffer<double> spokes;
    for (int p = static_cast<int>(begin); p < end; ++p) measurer.measure(p, spokes, sums[begin / block_size]);
  });
  BlockSums all;
  for (const BlockSums& sum : sums) {
    all.length += sum.length;
    all.square += sum.square;
    all.triangles += sum.triangles;
    all.least_slack = std::min(all.least_slack, sum.least_slack);
  }
  metric.least_slack = all.least_slack;
  if (all.triangles > 0) {
    const auto sides = static_cast<double>(3 * all.triangles);
    metric.mean = {all.length / sides, all.square / sides};
  }
  return metric;
}

}  // namespace tufted
