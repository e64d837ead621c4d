// Section 4.5 of the paper: intrinsic mollification.
#include <algorithm>
#include <numeric>

#include "base/buffer.h"
#include "cover/cover.h"
#include "cover/geometry.h"

namespace tufted {
namespace {

/// The area of all faces, summed in blocks, so that it does not depend on the number of threads.
double sumAreas(const IntrinsicTriangulation& cover, const Workers& workers) {
  Buffer<double> sums((cover.size() + cheapest_block - 1) / cheapest_block);
  workers.forBlocks("mollify", cover.size(), cheapest_block, [&](std::int64_t begin, std::int64_t end, int) {
    double sum = 0;
    for (std::int64_t f = begin; f < end; ++f) sum += faceArea(cover, static_cast<int>(f));
    sums[begin / cheapest_block] = sum;
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

}  // namespace

Mollification mollify(IntrinsicTriangulation& cover, double delta, const Workers& workers) {
  const std::int64_t triangles = cover.size() / 2;
  Buffer<double> missing((triangles + cheapest_block - 1) / cheapest_block);
  workers.forBlocks("mollify", triangles, cheapest_block, [&](std::int64_t begin, std::int64_t end, int) {
    double most = 0;
    for (std::int64_t t = begin; t < end; ++t) {  // front and back have the same lengths
      const double* length = cover.length.data() + 6 * t;
      most = std::max(most, delta - triangleSlack(length[0], length[1], length[2]));
    }
    missing[begin / cheapest_block] = most;
  });
  const double added = missing.empty() ? 0 : *std::max_element(missing.begin(), missing.end());
  if (!(added > 0)) return {};
  const double before = sumAreas(cover, workers);
  for (double& length : cover.length) length += added;
  return {added, sumAreas(cover, workers) - before};
}

}  // namespace tufted
