// The kernels, compiled once for each kind of processor: TUFTED_KERNELS names the table to define.
#include "simd/connected_heights.h"
#include "simd/kernels.h"
#include "simd/pixel_joins.h"
#include "simd/pixel_star.h"
#include "simd/square_fit.h"
#include "simd/star_by_inversion.h"

namespace tufted {
namespace {

static_assert(packet_size == kernel_packet, "arrays are filled up to the packets that are worked on");

int takeWithin(const Candidates& candidates, const double* point, int p, double bound, double* squared_distance,
               int* index) {
  const Candidates given = candidates;  // copied, so that stores below cannot alias it
  const Packet x = broadcast(point[0]), y = broadcast(point[1]), z = broadcast(point[2]), limit = broadcast(bound);
  int found = 0;
  for (int i = 0; i < given.count; i += packet_size) {
    const Packet dx = x - load(given.x + i), dy = y - load(given.y + i), dz = z - load(given.z + i);
    const Packet square = dx * dx + dy * dy + dz * dz;
    const Mask taken = logicalAnd(isAtMost(square, limit), differ(given.index + i, p));
    compress(taken, square, squared_distance + found);
    compress(taken, given.index + i, index + found);
    found += countOf(taken);
  }
  return found;
}

void rankValues(const double* values, int count, float* rounded, int* rank) {
  for (int i = 0; i < count; i += packet_size) storeFloats(load(values + i), rounded + i);
  // Each call ranks as many values as fit in registers.
  int i = 0;
  for (; i + 2 * float_packet_size < count; i += 3 * float_packet_size)
    rankFloats<3>(rounded + i, rounded, count, rank + i);
  if (i + float_packet_size < count) return rankFloats<2>(rounded + i, rounded, count, rank + i);
  if (i < count) rankFloats<1>(rounded + i, rounded, count, rank + i);
}

double extent(const Offsets& offsets) {
  Packet largest = broadcast(0);
  for (int i = 0; i < offsets.count; i += packet_size)
    largest = max(max(largest, absolute(load(&offsets.x[i]))),
                  max(absolute(load(&offsets.y[i])), absolute(load(&offsets.z[i]))));
  return reduceMax(largest);
}

/// Sums the numbers of each packet, in the same order on any processor.
TUFTED_INLINE void addAcross(const double* packets, int count, double* totals) {
  int n = 0;
#ifdef TUFTED_WIDE_PACKETS
  const auto halves = [](Packet a, Packet b) {
    return _mm512_shuffle_f64x2(a, b, 0x44) + _mm512_shuffle_f64x2(a, b, 0xee);
  };
  const auto quarters = [](Packet a, Packet b) {
    return _mm512_shuffle_f64x2(a, b, 0x88) + _mm512_shuffle_f64x2(a, b, 0xdd);
  };
  for (; n + packet_size <= count; n += packet_size) {
    const auto at = [&](int i) { return load(packets + (n + i) * packet_size); };
    const Packet even = quarters(halves(at(0), at(2)), halves(at(4), at(6)));
    const Packet odd = quarters(halves(at(1), at(3)), halves(at(5), at(7)));
    store(_mm512_unpacklo_pd(even, odd) + _mm512_unpackhi_pd(even, odd), totals + n);
  }
#endif
  for (; n < count; ++n) {
    const double* s = &packets[n * packet_size];
    totals[n] = ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]));
  }
}

/// Stores the parts, each one packet behind the previous one.
template <class... Parts>
TUFTED_INLINE void putInTurn(double* to, const Parts&... parts) {
  (..., (store(parts, to), to += packet_size));
}

/// OffsetSums of eight neighbours at a time.
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
  static_assert(sizeof(numbered) == packet_size * sizeof(double));
  alignas(64) double packets[most_sets][numbers * packet_size];
  const Part scale = broadcastPart(unit), zero = broadcastPart(0);
  for (int part = 0; part < packet_size; part += part_size) {
    OffsetParts sum = {zero, zero, zero, zero, zero, zero, zero, zero, zero};
    const auto at = [&](const double* values, int i) { return loadPart(values + i + part) * scale; };
    int i = 0;
    for (int set = 0; set < sets; ++set) {
      for (; i + packet_size <= ends[set]; i += packet_size)
        sum = plus(sum, at(offsets.x, i), at(offsets.y, i), at(offsets.z, i));
      const auto isInSet = isLess(loadPart(numbered + part), broadcastPart(ends[set] - i));
      const auto some = [&](const double* values) { return select(isInSet, at(values, i), zero); };
      const OffsetParts here = i == ends[set] ? sum : plus(sum, some(offsets.x), some(offsets.y), some(offsets.z));
      putInTurn(packets[set] + part, here.x, here.y, here.z, here.xx, here.xy, here.xz, here.yy, here.yz, here.zz);
    }
  }
  for (int set = 0; set < sets; ++set) addAcross(packets[set], numbers, &totals[set].x);
}

/// HeightSums of eight neighbours at a time, in registers if there are enough.
struct HeightParts {
  Part u, v, uu, uv, vv, uuu, uuv, uvv, vvv, uuuu, uuuv, uuvv, uvvv, vvvv, h, hu, hv, huu, huv, hvv, hh;
};

struct HeightPart {
  Part u, v, h;
};

TUFTED_INLINE HeightPart heightAt(const Offsets& offsets, int i, const double* axes) {
  const Part x = loadPart(&offsets.x[i]), y = loadPart(&offsets.y[i]), z = loadPart(&offsets.z[i]);
  const auto along = [&](const double* axis) {
    return x * broadcastPart(axis[0]) + y * broadcastPart(axis[1]) + z * broadcastPart(axis[2]);
  };
  return {along(axes), along(axes + 3), along(axes + 6)};
}

/// Adds the monomials of a point to the sums.
/// @param wu, wv, wuu, wuv, wvv, wh the products of u, v, u^2, u v, v^2 and h with the weight of the point
TUFTED_INLINE void addHeight(Part u, Part v, Part h, Part wu, Part wv, Part wuu, Part wuv, Part wvv, Part wh,
                             HeightParts& sum) {
  const Part uu = u * u, uv = u * v, vv = v * v;
  sum = {sum.u + wu,          sum.v + wv,          sum.uu + wuu,        sum.uv + wuv,        sum.vv + wvv,
         sum.uuu + wuu * u,   sum.uuv + wuu * v,   sum.uvv + wu * vv,   sum.vvv + wvv * v,   sum.uuuu + wuu * uu,
         sum.uuuv + wuu * uv, sum.uuvv + wuu * vv, sum.uvvv + wuv * vv, sum.vvvv + wvv * vv, sum.h + wh,
         sum.hu + wh * u,     sum.hv + wh * v,     sum.huu + wh * uu,   sum.huv + wh * uv,   sum.hvv + wh * vv,
         sum.hh + wh * h};
}

TUFTED_INLINE void putHeights(const HeightParts& sum, double* packets) {
  putInTurn(packets, sum.u, sum.v, sum.uu, sum.uv, sum.vv, sum.uuu, sum.uuv, sum.uvv, sum.vvv, sum.uuuu, sum.uuuv,
            sum.uuvv, sum.uvvv, sum.vvvv, sum.h, sum.hu, sum.hv, sum.huu, sum.huv, sum.hvv, sum.hh);
}

void sumHeights(const Offsets& offsets, const double* axes, HeightSums& total) {
  constexpr int numbers = HeightSystems::numbers;
  alignas(64) double packets[numbers * packet_size];
  for (int part = 0; part < packet_size; part += part_size) {
    const Part zero = broadcastPart(0);
    HeightParts sum = {zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero,
                       zero, zero, zero, zero, zero, zero, zero, zero, zero, zero};
    for (int i = part; i < offsets.count; i += packet_size) {
      const auto [u, v, h] = heightAt(offsets, i, axes);
      addHeight(u, v, h, u, v, u * u, u * v, v * v, h, sum);
    }
    putHeights(sum, packets + part);
  }
  addAcross(packets, numbers, &total.u);
}

double sumWeightedHeights(const Offsets& offsets, const double* axes, HeightSums& total) {
  constexpr int numbers = HeightSystems::numbers + 1;
  const int padded = toPackets(offsets.count);  // whose zeros have weight 1, in all lanes on any processor
  alignas(64) double packets[numbers * packet_size];
  for (int part = 0; part < packet_size; part += part_size) {
    const Part zero = broadcastPart(0), least = broadcastPart(1e-300);
    HeightParts sum = {zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero,
                       zero, zero, zero, zero, zero, zero, zero, zero, zero, zero};
    Part weights = zero;
    for (int i = part; i < padded; i += packet_size) {
      const auto [u, v, height] = heightAt(offsets, i, axes);
      const Part uu = u * u, vv = v * v, square = uu + vv + height * height;
      const Part inner = max(zero, broadcastPart(1) - square), weight = inner * inner;
      const Part h = height - height * height * height / max(least, square);
      weights = weights + weight;
      addHeight(u, v, h, weight * u, weight * v, weight * uu, weight * (u * v), weight * vv, weight * h, sum);
    }
    putHeights(sum, packets + part);
    putInTurn(packets + HeightSystems::numbers * packet_size + part, weights);
  }
  double sums[numbers];
  addAcross(packets, numbers, sums);
  for (int i = 0; i < HeightSystems::numbers; ++i) (&total.u)[i] = sums[i];
  return sums[HeightSystems::numbers] - (padded - offsets.count);
}

/// Solves the systems by the decomposition L D L^T.
void solveHeights(const HeightSystems& systems, HeightSolutions& solutions) {
  enum { u, v, uu, uv, vv, uuu, uuv, uvv, vvv, uuuu, uuuv, uuvv, uvvv, vvvv, h, hu, hv, huu, huv, hvv };
  // Number of unknowns.
  constexpr int size = 6;
  constexpr int lower[size][size] = {
      {},  // the count
      {u, uu}, {v, uv, vv}, {uu, uuu, uuv, uuuu}, {uv, uuv, uvv, uuuv, uuvv}, {vv, uvv, vvv, uuvv, uvvv, vvvv}};
  Packet gram[size][size], pivot[size], solution[size];
  for (int i = 0; i < size; ++i)
    for (int j = 0; j <= i; ++j) gram[i][j] = load(i + j == 0 ? systems.count : systems.sums[lower[i][j]]);
  for (int j = 0; j < size; ++j) {
    pivot[j] = gram[j][j];
    for (int k = 0; k < j; ++k) pivot[j] = pivot[j] - gram[j][k] * gram[j][k] * pivot[k];
    const Packet inverse = broadcast(1) / pivot[j];
    for (int i = j + 1; i < size; ++i) {
      for (int k = 0; k < j; ++k) gram[i][j] = gram[i][j] - gram[i][k] * gram[j][k] * pivot[k];
      gram[i][j] = gram[i][j] * inverse;
    }
  }
  for (int i = 0; i < size; ++i) {
    solution[i] = load(systems.sums[h + i]);
    for (int k = 0; k < i; ++k) solution[i] = solution[i] - gram[i][k] * solution[k];
  }
  // The first entry of the inverse: |D^-1/2 L^-1 e|^2, e the first unit vector.
  Packet unit[size] = {broadcast(1)};
  Packet leverage = broadcast(1) / pivot[0];
  for (int i = 1; i < size; ++i) {
    unit[i] = broadcast(0);
    for (int k = 0; k < i; ++k) unit[i] = unit[i] - gram[i][k] * unit[k];
    leverage = leverage + unit[i] * unit[i] / pivot[i];
  }
  Packet explained = broadcast(0), smallest = pivot[0], largest = pivot[0];
  for (int i = size - 1; i >= 0; --i) {
    solution[i] = solution[i] / pivot[i];
    for (int k = i + 1; k < size; ++k) solution[i] = solution[i] - gram[k][i] * solution[k];
  }
  for (int i = 0; i < size; ++i) {
    explained = explained + solution[i] * load(systems.sums[h + i]);
    smallest = min(smallest, pivot[i]);
    largest = max(largest, pivot[i]);
  }
  for (int i = 0; i < size; ++i) store(solution[i], solutions.coefficient[i]);
  store(leverage, solutions.leverage);
  store(explained, solutions.explained);
  store(smallest, solutions.least_pivot);
  store(largest, solutions.most_pivot);
}

/// If the two smallest eigenvalues differ by more than this share of the largest, the closed form is as exact as
/// Eigen's iteration.
constexpr double least_gap = 1e-3;
/// Greatest number of steps of Newton's method. It converges quadratically, but slowly towards double roots, which are
/// left to Eigen.
constexpr int most_steps = 8;

/// The smallest eigenvalue by Newton's method on the characteristic polynomial, which increases from 0 to its first
/// root, and its eigenvector as a cross product.
void findSmallest(const Covariances& given, SmallestAxes& axes) {
  const Packet xx = load(given.xx), xy = load(given.xy), xz = load(given.xz);
  const Packet yy = load(given.yy), yz = load(given.yz), zz = load(given.zz);
  const Packet x_minor = yy * zz - yz * yz, trace = xx + yy + zz;
  const Packet minors = x_minor + (xx * zz - xz * xz) + (xx * yy - xy * xy);
  const Packet determinant = xx * x_minor - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
  Packet smallest = broadcast(0);
  Mask converged = none();
  for (int step = 0; step < most_steps && countOf(converged) < packet_size; ++step) {
    const Packet value = ((smallest - trace) * smallest + minors) * smallest - determinant;
    const Packet slope = (broadcast(3) * smallest - broadcast(2) * trace) * smallest + minors;
    const Packet change = value / slope;
    smallest = select(converged, smallest, smallest - change);  // lanes that converged keep their bits
    converged =
        // the error is about the square of this change
        logicalOr(converged, isAtMost(absolute(change), broadcast(1e-9) * trace));
  }
  const Packet rest = trace - smallest;  // sum of the other two eigenvalues
  const Packet product = minors - smallest * rest;
  const Packet root = squareRoot(max(broadcast(0), rest * rest - broadcast(4) * product));
  const Packet middle = broadcast(0.5) * (rest - root), largest = broadcast(0.5) * (rest + root);
  const Mask is_found = logicalAnd(converged, isLess(broadcast(least_gap) * largest, middle - smallest));

  // The eigenvector is the longest cross product of two rows of the matrix minus the eigenvalue.
  const Packet xs = xx - smallest, ys = yy - smallest, zs = zz - smallest;
  const Packet ax = xy * yz - xz * ys, ay = xz * xy - xs * yz, az = xs * ys - xy * xy;  // rows x and y
  const Packet bx = ys * zs - yz * yz, by = yz * xz - xy * zs, bz = xy * yz - ys * xz;  // rows y and z
  const Packet cx = yz * xz - zs * xy, cy = zs * xs - xz * xz, cz = xz * xy - yz * xs;  // rows z and x
  const Packet a = ax * ax + ay * ay + az * az, b = bx * bx + by * by + bz * bz, c = cx * cx + cy * cy + cz * cz;
  const Mask second = isLess(a, b), third = isLess(max(a, b), c);
  const auto longest = [&](Packet of_a, Packet of_b, Packet of_c) {
    return select(third, of_c, select(second, of_b, of_a));
  };
  const Packet length = squareRoot(longest(a, b, c));
  const Packet x = longest(ax, bx, cx) / length, y = longest(ay, by, cy) / length, z = longest(az, bz, cz) / length;
  const Packet along = x * (xx * x + xy * y + xz * z) + y * (xy * x + yy * y + yz * z) + z * (xz * x + yz * y + zz * z);
  store(x, axes.x);
  store(y, axes.y);
  store(z, axes.z);
  store(max(broadcast(0), along), axes.smallest);
  store(middle, axes.middle);
  store(largest, axes.largest);
  store(select(is_found, broadcast(1), broadcast(0)), axes.is_found);
}

void project(const Offsets& offsets, double unit, const double* x, const double* y, PlanarOffsets& planar) {
  planar.count = offsets.count;
  const Part scale = broadcastPart(unit);
  const Part x0 = broadcastPart(x[0]), x1 = broadcastPart(x[1]), x2 = broadcastPart(x[2]), y0 = broadcastPart(y[0]),
             y1 = broadcastPart(y[1]), y2 = broadcastPart(y[2]);
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

/// 4 A cot(alpha) for the area A and the angle alpha opposite a, as in cover/geometry.h.
TUFTED_INLINE Part cotanNumerator(Part a, Part b, Part c) {
  const Part shorter = min(b, c), longer = max(b, c);
  return shorter * shorter + (longer - a) * (longer + a);
}

void measureTriangleFans(const TriangleFans& given) {
  const TriangleFans fans = given;  // copied, so that stores below cannot alias it
  for (int i = 0; i < fans.count + 1; i += part_size)
    store(lengthOf(fans.spoke_x + i, fans.spoke_y + i, fans.spoke_z + i), fans.spoke + i);
  for (int i = 0; i < fans.count; i += part_size) {
    const Part own = loadPart(fans.spoke + i), next = loadPart(fans.spoke + i + 1);
    const Part rim = lengthOf(fans.rim_x + i, fans.rim_y + i, fans.rim_z + i);
    const Part longer = max(own, next), shorter = min(own, next), rest = min(longer, rim);
    const Part a = max(longer, rim), b = max(shorter, rest), c = min(shorter, rest);
    const Part slack = c - (a - b);
    const Part square = (a + (b + c)) * slack * (c + (a - b)) * (a + (b - c));
    const Part area =
        select(isLess(broadcastPart(0), square), broadcastPart(0.25) * squareRoot(square), broadcastPart(0));
    const Part inverse = broadcastPart(1) / (broadcastPart(4) * area);
    store(rim, fans.rim + i);
    store(slack, fans.slack + i);
    store(area, fans.area + i);
    store(cotanNumerator(own, next, rim) * inverse, fans.cotan_at_next + i);
    store(cotanNumerator(next, own, rim) * inverse, fans.cotan_at_own + i);
  }
}

}  // namespace

extern const Kernels TUFTED_KERNELS;
const Kernels TUFTED_KERNELS = {takeWithin,          rankValues,          extent,
                                sumOffsets,          sumHeights,          sumWeightedHeights,
                                solveHeights,        connectedHeights,    connectedHeightsAlong,
                                keepConnected,       findSmallest,        project,
                                measureTriangleFans, wrapInvertedPackets, wrapPixels,
                                fitSquares<2>,       fitSquares<3>,       joinPixels,
                                spacingsOf,          squaresWithin};

}  // namespace tufted
