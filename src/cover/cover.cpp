// The arrays of a cover (Section 4.1), and MEASUREEDGELENGTHS of Algorithm 3.
#include "cover/cover.h"

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "base/power_of_two.h"
#include "cover/edge_lengths.h"

namespace tufted {
void resizeCover(IntrinsicTriangulation& cover, int vertices, std::int64_t triangles) {
  cover.vertices = vertices;
  cover.faces.resize(static_cast<std::size_t>(2 * triangles));
  cover.glue.assign(static_cast<std::size_t>(6 * triangles), unglued);
  cover.length.resize(static_cast<std::size_t>(6 * triangles));
}

MeanLengths measureLengths(IntrinsicTriangulation& cover, const PointsView& points, const Workers& workers) {
  const std::int64_t triangles = cover.size() / 2;
  const EdgeLengths lengthOf{points};
  // Summed per block, for the same bits on any number of threads.
  Buffer<MeanLengths> sums((triangles + cheap_block - 1) / cheap_block);
  workers.forBlocks("lengths", triangles, cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
    MeanLengths& sum = sums[begin / cheap_block];
    for (int t = static_cast<int>(begin); t < end; ++t) {
      const auto& corner = cover.faces[2 * t];
      for (int s = 0; s < 3; ++s) {
        const double length = lengthOf(corner[s], corner[(s + 1) % 3]);
        cover.length[frontSide(t, s)] = cover.length[backSide(t, s)] = length;
        sum.length += length;
        sum.square += length * length;
      }
    }
  });
  MeanLengths mean;
  const auto sides = static_cast<double>(3 * triangles);
  for (const MeanLengths& sum : sums) {
    mean.length += sum.length;
    mean.square += sum.square;
  }
  return triangles > 0 ? MeanLengths{mean.length / sides, mean.square / sides} : mean;
}

void toInput(IntrinsicTriangulation& cover, const Buffer<int>& input_index, int size, int exponent) {
  cover.vertices = size;
  for (auto& face : cover.faces) {
    for (int& corner : face) corner = input_index[corner];
  }
  const PowerOfTwo unit(exponent);
  for (double& length : cover.length) length = unit.times(length);
}

}  // namespace tufted
