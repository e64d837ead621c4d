#pragma once

// Plain arrays and no functions of others: see kernels_source.h.
#include <cstdint>

namespace tufted {

/// Numbers are worked on in groups of so many.
constexpr int kernel_lane = 8;

/// `count` filled up to whole lanes.
static constexpr int toLanes(int count) {
  return (count + kernel_lane - 1) / kernel_lane * kernel_lane;
}

/// Points by coordinate, filled up to whole lanes with points that are nowhere near. Borrowed.
struct Candidates {
  int count;
  const int* index;  ///< ranks
  const double *x, *y, *z;
};

/// The neighbours of a point relative to it, or some of them, filled up to whole lanes with zeros. Borrowed.
struct Offsets {
  int count;
  const double *x, *y, *z;
};

/// Sums over neighbours.
struct OffsetSums {
  double x, y, z, xx, xy, xz, yy, yz, zz;
};
constexpr int most_sets = 3;  // of neighbours that are summed at once

/// Sums over neighbours with the coordinates u, v in a plane and the height h over it.
struct HeightSums {
  double u, v, uu, uv, vv, uuu, uuv, uvv, vvv, uuuu, uuuv, uuvv, uvvv, vvvv, h, hu, hv, huu, huv, hvv, hh;
};

/// Normal equations of height fits, one per lane.
struct HeightSystems {
  static constexpr int numbers = sizeof(HeightSums) / sizeof(double);
  alignas(64) double sums[numbers][kernel_lane];  ///< in the order of HeightSums
  alignas(64) double count[kernel_lane];          ///< points, that of height 0 at the origin included
};

/// Their solutions.
struct HeightSolutions {
  alignas(64) double height[kernel_lane];     ///< of the quadratic over the origin
  alignas(64) double explained[kernel_lane];  ///< of the sum of squared heights
  alignas(64) double least_pivot[kernel_lane], most_pivot[kernel_lane];
};

/// Unit vectors, one per lane, or zeros.
struct Normals {
  alignas(64) double x[kernel_lane], y[kernel_lane], z[kernel_lane];
};

/// Heights that are reached from 0 over gaps of a bounded size, and the extremes of all.
struct Reached {
  double lowest, highest;
  double bottom, top;
};

/// Symmetric 3 x 3 matrices without negative eigenvalues, one per lane.
struct Covariances {
  alignas(64) double xx[kernel_lane], xy[kernel_lane], xz[kernel_lane], yy[kernel_lane], yz[kernel_lane],
      zz[kernel_lane];
};

/// Their eigenvalues, and the unit eigenvector of the smallest one.
struct SmallestAxes {
  alignas(64) double x[kernel_lane], y[kernel_lane], z[kernel_lane];
  alignas(64) double smallest[kernel_lane], middle[kernel_lane], largest[kernel_lane];
  alignas(64) double is_found[kernel_lane];  ///< 1; 0 where two eigenvalues lie too close for a closed form
};

/// Neighbours in the tangent plane of a point, which lies at the origin; anything behind them.
struct PlanarOffsets {
  static constexpr int most = 64;
  int count = 0;
  alignas(64) double u[most], v[most];
};

/// What is certain of a star: that it is closed, and its link; which few neighbours are in the link, but for ties among
/// them; or nothing, be it that it looks open.
enum class StarKind { closed, tied, gaping, unknown };

/// A closed star: numbers of neighbours counterclockwise, and the circumradius of each and the next. A tied one:
/// numbers of all that may be in the link, first the corners of a hull counterclockwise, then others in ascending
/// order.
struct InvertedStar {
  static constexpr int most = 24;
  int size = 0;
  int link[most];
  double radius[most];
};

/// Triangles side by side: number i has the spokes i and i + 1, which start at one point, and the rim between their
/// ends. Borrowed arrays of `count` numbers and room for whole lanes; those of the spokes have one lane more.
struct Fans {
  int count;
  const double *spoke_x, *spoke_y, *spoke_z, *rim_x, *rim_y, *rim_z;  ///< vectors
  double *spoke, *rim;                                                ///< lengths
  double *area, *slack;                                               ///< of the triangle inequality
  double *cotan_at_next, *cotan_at_own;                               ///< opposite spoke i, opposite spoke i + 1
};

/// The loops that a build spends its time in. They are compiled for every processor and once more for AVX-512; the
/// operations are the same, and so are the bits.
struct Kernels {
  /// The candidates within the squared distance `bound` of a point, but for number p: squared distances, with the bits
  /// of FLANN's L2_Simple, and ranks. Both arrays have room for all candidates and one lane.
  /// @returns how many
  int (*takeWithin)(const Candidates& candidates, const double* point, int p, double bound, double* squared_distance,
                    int* index);
  /// How many of the values, rounded to floats, are less than each.
  /// @param count a multiple of the lane
  /// @param rounded scratch; this and `rank` have room for two lanes more
  void (*rankValues)(const double* values, int count, float* rounded, int* rank);
  /// The largest absolute coordinate.
  double (*extent)(const Offsets& offsets);
  /// Of the first ends[0], ends[1], ... offsets times `unit`.
  /// @param ends ascending, at most most_sets
  void (*sumOffsets)(const Offsets& offsets, double unit, const int* ends, int sets, OffsetSums* sums);
  /// Of the offsets along the axes of u, v and h, which are given one after the other.
  void (*sumHeights)(const Offsets& offsets, const double* axes, HeightSums& sums);
  /// Each as if it were alone.
  void (*solveHeights)(const HeightSystems& systems, HeightSolutions& solutions);
  /// Heights along `normal`, and which of them are reached over gaps of at most `gap`.
  /// @param[out] heights room for whole lanes
  Reached (*reachHeights)(const Offsets& offsets, const double* normal, double gap, double* heights);
  /// The same along each normal.
  /// @param[out] heights of each offset one lane, in which normals are side by side
  /// @param[out] reached one lane
  void (*reachAlong)(const Offsets& offsets, const Normals& normals, double gap, double* heights, Reached* reached);
  /// Puts those from the lowest to the highest height to the front, filled up to whole lanes with zeros.
  /// @param[out] x, y, z room for whole lanes; may be what is given
  /// @returns how many
  int (*keepReached)(const Offsets& offsets, const double* heights, const Reached& reached, double* x, double* y,
                     double* z);
  /// Each as if it were alone.
  void (*findSmallest)(const Covariances& covariances, SmallestAxes& axes);
  /// The offsets, at most PlanarOffsets::most, times `unit` along the axes x and y.
  void (*project)(const Offsets& offsets, double unit, const double* x, const double* y, PlanarOffsets& planar);
  /// The triangles of the fans, with `added` to all lengths; the formulas of cover/geometry.h.
  void (*measureFans)(const Fans& fans, double added);
  /// See wrapInverted().
  StarKind (*wrapInverted)(const PlanarOffsets& planar, InvertedStar& star);
};

/// What every processor runs.
const Kernels& portableKernels();

/// What this processor runs fastest, or what was chosen below.
const Kernels& kernels();

/// Builds that begin after this use the given ones; for tests and benchmarks. Null: the fastest.
void chooseKernels(const Kernels* chosen);

}  // namespace tufted
