// The kernels, compiled once for each kind of processor: TUFTED_KERNELS names the table to define.
#include "simd/inverted_hull.h"
#include "simd/kernels.h"
#include "simd/reached_heights.h"

namespace tufted {
namespace {

static_assert(lane_size == kernel_lane, "arrays are filled up to the lanes that are worked on");

int takeWithin(const Candidates& candidates, const double* point, int p, double bound, double* squared_distance,
               int* index) {
  const Candidates given = candidates;  // a copy, which what is written below cannot change
  const Part x = allOfPart(point[0]), y = allOfPart(point[1]), z = allOfPart(point[2]);
  const auto squares = [&](int i) {
    const Part dx = x - loadPart(given.x + i), dy = y - loadPart(given.y + i), dz = z - loadPart(given.z + i);
    return dx * dx + dy * dy + dz * dz;
  };
  int found = 0;
#ifdef TUFTED_WIDE_LANES
  const Lane limit = all(bound);
  for (int i = 0; i < given.count; i += lane_size) {
    const Lane square = squares(i);
    const Mask taken = both(isAtMost(square, limit), differ(given.index + i, p));
    squeeze(taken, square, squared_distance + found);
    squeeze(taken, given.index + i, index + found);
    found += countOf(taken);
  }
#else
  constexpr int some = 8 * lane_size;  // distances at a time
  alignas(64) double square[some];
  for (int first = 0; first < given.count; first += some) {
    const int end = given.count - first < some ? given.count - first : some;
    for (int i = 0; i < end; i += part_size) store(squares(first + i), square + i);
    for (int i = 0; i < end; ++i) {  // without a branch: which are within cannot be foreseen
      squared_distance[found] = square[i];
      index[found] = given.index[first + i];
      found += (square[i] <= bound ? 1 : 0) & (given.index[first + i] != p ? 1 : 0);
    }
  }
#endif
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

/// The total of each of the lanes, added in one order on any processor.
TUFTED_INLINE void addAcross(const double* lanes, int count, double* totals) {
  int n = 0;
#ifdef TUFTED_WIDE_LANES
  const auto halves = [](Lane a, Lane b) {
    return _mm512_shuffle_f64x2(a, b, 0x44) + _mm512_shuffle_f64x2(a, b, 0xee);
  };
  const auto quarters = [](Lane a, Lane b) {
    return _mm512_shuffle_f64x2(a, b, 0x88) + _mm512_shuffle_f64x2(a, b, 0xdd);
  };
  for (; n + lane_size <= count; n += lane_size) {
    const auto at = [&](int i) { return load(lanes + (n + i) * lane_size); };
    const Lane even = quarters(halves(at(0), at(2)), halves(at(4), at(6)));
    const Lane odd = quarters(halves(at(1), at(3)), halves(at(5), at(7)));
    store(_mm512_unpacklo_pd(even, odd) + _mm512_unpackhi_pd(even, odd), totals + n);
  }
#endif
  for (; n < count; ++n) {
    const double* s = &lanes[n * lane_size];
    totals[n] = ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
  }
}

/// Each a lane after the one before.
template <class... Parts>
TUFTED_INLINE void putInTurn(double* to, const Parts&... parts) {
  (..., (store(parts, to), to += lane_size));
}

/// OffsetSums in lanes.
struct OffsetParts {
  Part x, y, z, xx, xy, xz, yy, yz, zz;
};

TUFTED_INLINE OffsetParts plus(const OffsetParts& sum, Part x, Part y, Part z) {
  return {sum.x + x,      sum.y + y,      sum.z + z,      sum.xx + x * x, sum.xy + x * y,
          sum.xz + x * z, sum.yy + y * y, sum.yz + y * z, sum.zz + z * z};
}

void sumOffsets(const Offsets& offsets, double unit, const int* ends, int sets, OffsetSums* totals) {
  constexpr int numbers = sizeof(OffsetSums) / sizeof(double);
  alignas(64) static constexpr double numbered[] = {0, 1, 2, 3, 4, 5, 6, 7};
  static_assert(sizeof(numbered) == lane_size * sizeof(double));
  alignas(64) double lanes[most_sets][numbers * lane_size];
  const Part scale = allOfPart(unit), zero = allOfPart(0);
  for (int part = 0; part < lane_size; part += part_size) {
    OffsetParts sum = {zero, zero, zero, zero, zero, zero, zero, zero, zero};
    const auto at = [&](const double* values, int i) { return loadPart(values + i + part) * scale; };
    int i = 0;
    for (int set = 0; set < sets; ++set) {
      for (; i + lane_size <= ends[set]; i += lane_size)
        sum = plus(sum, at(offsets.x, i), at(offsets.y, i), at(offsets.z, i));
      const auto isInSet = isLess(loadPart(numbered + part), allOfPart(ends[set] - i));
      const auto some = [&](const double* values) { return select(isInSet, at(values, i), zero); };
      const OffsetParts here = i == ends[set] ? sum : plus(sum, some(offsets.x), some(offsets.y), some(offsets.z));
      putInTurn(lanes[set] + part, here.x, here.y, here.z, here.xx, here.xy, here.xz, here.yy, here.yz, here.zz);
    }
  }
  for (int set = 0; set < sets; ++set) addAcross(lanes[set], numbers, &totals[set].x);
}

/// HeightSums in lanes, each in a register as far as there are any.
struct HeightParts {
  Part u, v, uu, uv, vv, uuu, uuv, uvv, vvv, uuuu, uuuv, uuvv, uvvv, vvvv, h, hu, hv, huu, huv, hvv, hh;
};

void sumHeights(const Offsets& offsets, const double* axes, HeightSums& total) {
  constexpr int numbers = HeightSystems::numbers;
  alignas(64) double lanes[numbers * lane_size];
  for (int part = 0; part < lane_size; part += part_size) {
    const Part zero = allOfPart(0);
    HeightParts sum = {zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero,
                       zero, zero, zero, zero, zero, zero, zero, zero, zero, zero};
    for (int i = part; i < offsets.count; i += lane_size) {
      const Part x = loadPart(&offsets.x[i]), y = loadPart(&offsets.y[i]), z = loadPart(&offsets.z[i]);
      const auto along = [&](const double* axis) {
        return x * allOfPart(axis[0]) + y * allOfPart(axis[1]) + z * allOfPart(axis[2]);
      };
      const Part u = along(axes), v = along(axes + 3), h = along(axes + 6);
      const Part uu = u * u, uv = u * v, vv = v * v;
      sum = {sum.u + u,          sum.v + v,          sum.uu + uu,        sum.uv + uv,        sum.vv + vv,
             sum.uuu + uu * u,   sum.uuv + uu * v,   sum.uvv + u * vv,   sum.vvv + vv * v,   sum.uuuu + uu * uu,
             sum.uuuv + uu * uv, sum.uuvv + uu * vv, sum.uvvv + uv * vv, sum.vvvv + vv * vv, sum.h + h,
             sum.hu + h * u,     sum.hv + h * v,     sum.huu + h * uu,   sum.huv + h * uv,   sum.hvv + h * vv,
             sum.hh + h * h};
    }
    putInTurn(lanes + part, sum.u, sum.v, sum.uu, sum.uv, sum.vv, sum.uuu, sum.uuv, sum.uvv, sum.vvv, sum.uuuu,
              sum.uuuv, sum.uuvv, sum.uvvv, sum.vvvv, sum.h, sum.hu, sum.hv, sum.huu, sum.huv, sum.hvv, sum.hh);
  }
  addAcross(lanes, numbers, &total.u);
}

/// By L D L^T of the lower triangle.
void solveHeights(const HeightSystems& systems, HeightSolutions& solutions) {
  enum { u, v, uu, uv, vv, uuu, uuv, uvv, vvv, uuuu, uuuv, uuvv, uvvv, vvvv, h, hu, hv, huu, huv, hvv };
  constexpr int size = 6;
  constexpr int lower[size][size] = {
      {},  // the count
      {u, uu}, {v, uv, vv}, {uu, uuu, uuv, uuuu}, {uv, uuv, uvv, uuuv, uuvv}, {vv, uvv, vvv, uuvv, uvvv, vvvv}};
  Lane gram[size][size], pivot[size], solution[size];
  for (int i = 0; i < size; ++i)
    for (int j = 0; j <= i; ++j) gram[i][j] = load(i + j == 0 ? systems.count : systems.sums[lower[i][j]]);
  for (int j = 0; j < size; ++j) {
    pivot[j] = gram[j][j];
    for (int k = 0; k < j; ++k) pivot[j] = pivot[j] - gram[j][k] * gram[j][k] * pivot[k];
    const Lane inverse = all(1) / pivot[j];
    for (int i = j + 1; i < size; ++i) {
      for (int k = 0; k < j; ++k) gram[i][j] = gram[i][j] - gram[i][k] * gram[j][k] * pivot[k];
      gram[i][j] = gram[i][j] * inverse;
    }
  }
  for (int i = 0; i < size; ++i) {
    solution[i] = load(systems.sums[h + i]);
    for (int k = 0; k < i; ++k) solution[i] = solution[i] - gram[i][k] * solution[k];
  }
  Lane explained = all(0), smallest = pivot[0], largest = pivot[0];
  for (int i = size - 1; i >= 0; --i) {
    solution[i] = solution[i] / pivot[i];
    for (int k = i + 1; k < size; ++k) solution[i] = solution[i] - gram[k][i] * solution[k];
  }
  for (int i = 0; i < size; ++i) {
    explained = explained + solution[i] * load(systems.sums[h + i]);
    smallest = least(smallest, pivot[i]);
    largest = most(largest, pivot[i]);
  }
  store(solution[0], solutions.height);
  store(explained, solutions.explained);
  store(smallest, solutions.least_pivot);
  store(largest, solutions.most_pivot);
}

constexpr double least_gap = 1e-3;  // between the two smallest eigenvalues over the largest, for the closed form
constexpr int most_steps = 8;

/// The smallest eigenvalue by Newton's method on the characteristic polynomial, which from 0 rises to its first root,
/// and the eigenvector as a cross product.
void findSmallest(const Covariances& given, SmallestAxes& axes) {
  const Lane xx = load(given.xx), xy = load(given.xy), xz = load(given.xz);
  const Lane yy = load(given.yy), yz = load(given.yz), zz = load(given.zz);
  const Lane x_minor = yy * zz - yz * yz, trace = xx + yy + zz;
  const Lane minors = x_minor + (xx * zz - xz * xz) + (xx * yy - xy * xy);
  const Lane determinant = xx * x_minor - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
  Lane smallest = all(0);
  Mask converged = none();  // slowly towards a double root, or not at all
  for (int step = 0; step < most_steps && countOf(converged) < lane_size; ++step) {
    const Lane value = ((smallest - trace) * smallest + minors) * smallest - determinant;
    const Lane slope = (all(3) * smallest - all(2) * trace) * smallest + minors;
    const Lane change = value / slope;
    smallest = select(converged, smallest, smallest - change);                     // each as if it were alone
    converged = either(converged, isAtMost(absolute(change), all(1e-9) * trace));  // and quadratically it went further
  }
  const Lane rest = trace - smallest;  // sum and product of the other two
  const Lane product = minors - smallest * rest;
  const Lane root = squareRoot(most(all(0), rest * rest - all(4) * product));
  const Lane middle = all(0.5) * (rest - root), largest = all(0.5) * (rest + root);
  const Mask is_found = both(converged, isLess(all(least_gap) * largest, middle - smallest));

  // Two rows of the matrix less the eigenvalue span what is perpendicular to the eigenvector.
  const Lane xs = xx - smallest, ys = yy - smallest, zs = zz - smallest;
  const Lane ax = xy * yz - xz * ys, ay = xz * xy - xs * yz, az = xs * ys - xy * xy;  // rows x and y
  const Lane bx = ys * zs - yz * yz, by = yz * xz - xy * zs, bz = xy * yz - ys * xz;  // y and z
  const Lane cx = yz * xz - zs * xy, cy = zs * xs - xz * xz, cz = xz * xy - yz * xs;  // z and x
  const Lane a = ax * ax + ay * ay + az * az, b = bx * bx + by * by + bz * bz, c = cx * cx + cy * cy + cz * cz;
  const Mask second = isLess(a, b), third = isLess(most(a, b), c);
  const auto longest = [&](Lane of_a, Lane of_b, Lane of_c) { return select(third, of_c, select(second, of_b, of_a)); };
  const Lane length = squareRoot(longest(a, b, c));
  const Lane x = longest(ax, bx, cx) / length, y = longest(ay, by, cy) / length, z = longest(az, bz, cz) / length;
  const Lane along = x * (xx * x + xy * y + xz * z) + y * (xy * x + yy * y + yz * z) + z * (xz * x + yz * y + zz * z);
  store(x, axes.x);
  store(y, axes.y);
  store(z, axes.z);
  store(most(all(0), along), axes.smallest);
  store(middle, axes.middle);
  store(largest, axes.largest);
  store(select(is_found, all(1), all(0)), axes.is_found);
}

void project(const Offsets& offsets, double unit, const double* x, const double* y, PlanarOffsets& planar) {
  planar.count = offsets.count;
  const Part scale = allOfPart(unit);
  const Part x0 = allOfPart(x[0]), x1 = allOfPart(x[1]), x2 = allOfPart(x[2]), y0 = allOfPart(y[0]),
             y1 = allOfPart(y[1]), y2 = allOfPart(y[2]);
  for (int i = 0; i < offsets.count; i += part_size) {
    const Part dx = loadPart(&offsets.x[i]) * scale, dy = loadPart(&offsets.y[i]) * scale,
               dz = loadPart(&offsets.z[i]) * scale;
    store(dx * x0 + dy * x1 + dz * x2, &planar.u[i]);
    store(dx * y0 + dy * y1 + dz * y2, &planar.v[i]);
  }
}

TUFTED_INLINE Part lengthOf(const double* x, const double* y, const double* z) {
  const Part a = loadPart(x), b = loadPart(y), c = loadPart(z);
  return squareRoot(a * a + b * b + c * c);
}

/// 4 A cot of the angle opposite a.
TUFTED_INLINE Part cotanNumerator(Part a, Part b, Part c) {
  const Part shorter = least(b, c), longer = most(b, c);
  return shorter * shorter + (longer - a) * (longer + a);
}

void measureFans(const Fans& given, double added) {
  const Fans fans = given;  // a copy, which what is written below cannot change
  for (int i = 0; i < fans.count + 1; i += part_size)
    store(lengthOf(fans.spoke_x + i, fans.spoke_y + i, fans.spoke_z + i) + allOfPart(added), fans.spoke + i);
  for (int i = 0; i < fans.count; i += part_size) {
    const Part own = loadPart(fans.spoke + i), next = loadPart(fans.spoke + i + 1);
    const Part rim = lengthOf(fans.rim_x + i, fans.rim_y + i, fans.rim_z + i) + allOfPart(added);
    const Part longer = most(own, next), shorter = least(own, next), rest = least(longer, rim);
    const Part a = most(longer, rim), b = most(shorter, rest), c = least(shorter, rest);
    const Part slack = c - (a - b);
    const Part square = (a + (b + c)) * slack * (c + (a - b)) * (a + (b - c));
    const Part area = select(isLess(allOfPart(0), square), allOfPart(0.25) * squareRoot(square), allOfPart(0));
    const Part inverse = allOfPart(1) / (allOfPart(4) * area);
    store(rim, fans.rim + i);
    store(slack, fans.slack + i);
    store(area, fans.area + i);
    store(cotanNumerator(own, next, rim) * inverse, fans.cotan_at_next + i);
    store(cotanNumerator(next, own, rim) * inverse, fans.cotan_at_own + i);
  }
}

}  // namespace

extern const Kernels TUFTED_KERNELS;
const Kernels TUFTED_KERNELS = {takeWithin,   rankValues,   extent,           sumOffsets,  sumHeights,
                                solveHeights, reachHeights, reachAlong,       keepReached, findSmallest,
                                project,      measureFans,  wrapInvertedLanes};

}  // namespace tufted
