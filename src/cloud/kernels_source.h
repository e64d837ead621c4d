// The kernels, compiled once for each kind of processor: TUFTED_KERNELS names the table to define.
#include "cloud/inverted_hull.h"
#include "cloud/kernels.h"

namespace tufted {
namespace {

static_assert(lane_size == kernel_lane, "arrays are filled up to the lanes that are worked on");

int takeWithin(const Candidates& candidates, const double* point, int p, double bound, double* squared_distance,
               int* index) {
  // Copies, which what is written below cannot change.
  const auto [count, ranks, px, py, pz] = candidates;
  const Lane x = all(point[0]), y = all(point[1]), z = all(point[2]), limit = all(bound);
  int found = 0;
  for (int i = 0; i < count; i += lane_size) {
    const Lane dx = x - load(px + i), dy = y - load(py + i), dz = z - load(pz + i);
    const Lane squares = dx * dx + dy * dy + dz * dz;
    const Mask taken = both(isAtMost(squares, limit), differ(ranks + i, p));
    squeeze(taken, squares, squared_distance + found);
    squeeze(taken, ranks + i, index + found);
    found += countOf(taken);
  }
  return found;
}

void rankValues(const double* values, int count, float* rounded, int* rank) {
  for (int i = 0; i < count; i += lane_size) storeFloats(load(values + i), rounded + i);
  // All at once as long as they fit in registers.
  if (count <= float_lane_size) return rankFloats<1>(rounded, rounded, count, rank);
  if (count <= 2 * float_lane_size) return rankFloats<2>(rounded, rounded, count, rank);
  if (count <= 3 * float_lane_size) return rankFloats<3>(rounded, rounded, count, rank);
  for (int i = 0; i < count; i += float_lane_size) rankFloats<1>(rounded + i, rounded, count, rank + i);
}

double extent(const Offsets& offsets) {
  Lane largest = all(0);
  for (int i = 0; i < offsets.count; i += lane_size)
    largest = most(most(largest, absolute(load(&offsets.x[i]))),
                   most(absolute(load(&offsets.y[i])), absolute(load(&offsets.z[i]))));
  return most(largest);
}

void addSums(const Offsets& offsets, double unit, OffsetSums& total) {
  const Lane scale = all(unit);
  Lane sums[9];
  for (int i = 0; i < 9; ++i) sums[i] = load(&total.lanes[i * lane_size]);
  for (int i = 0; i < offsets.count; i += lane_size) {
    const Lane x = load(&offsets.x[i]) * scale, y = load(&offsets.y[i]) * scale, z = load(&offsets.z[i]) * scale;
    sums[0] = sums[0] + x;
    sums[1] = sums[1] + y;
    sums[2] = sums[2] + z;
    sums[3] = sums[3] + x * x;
    sums[4] = sums[4] + x * y;
    sums[5] = sums[5] + x * z;
    sums[6] = sums[6] + y * y;
    sums[7] = sums[7] + y * z;
    sums[8] = sums[8] + z * z;
  }
  for (int i = 0; i < 9; ++i) store(sums[i], &total.lanes[i * lane_size]);
}

void project(const Offsets& offsets, double unit, const double* x, const double* y, PlanarOffsets& planar) {
  planar.count = offsets.count;
  const Lane scale = all(unit);
  const Lane x0 = all(x[0]), x1 = all(x[1]), x2 = all(x[2]), y0 = all(y[0]), y1 = all(y[1]), y2 = all(y[2]);
  for (int i = 0; i < offsets.count; i += lane_size) {
    const Lane dx = load(&offsets.x[i]) * scale, dy = load(&offsets.y[i]) * scale, dz = load(&offsets.z[i]) * scale;
    store(dx * x0 + dy * x1 + dz * x2, &planar.u[i]);
    store(dx * y0 + dy * y1 + dz * y2, &planar.v[i]);
  }
}

}  // namespace

extern const Kernels TUFTED_KERNELS;
const Kernels TUFTED_KERNELS = {takeWithin, rankValues, extent, addSums, project, wrapInvertedLanes};

}  // namespace tufted
