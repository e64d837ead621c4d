#pragma once

// Plain arrays, and no functions of other headers, see packet.h.
#include <cstddef>
#include <cstdint>

namespace tufted {

/// Numbers are processed in packets of this size.
constexpr int kernel_packet = 8;

/// `count` rounded up to whole packets.
static constexpr int toPackets(int count) {
  return (count + kernel_packet - 1) / kernel_packet * kernel_packet;
}

/// Points by coordinate, padded to whole packets with points at infinity. Borrowed.
struct Candidates {
  int count;
  const int* index;  ///< ranks
  const double *x, *y, *z;
};

/// Offsets from a point to neighbours, padded to whole packets with zeros. Borrowed.
struct Offsets {
  int count;
  const double *x, *y, *z;
};

/// Sums over neighbours.
struct OffsetSums {
  double x, y, z, xx, xy, xz, yy, yz, zz;
};
constexpr int most_sets = 3;  // nested sets of neighbours that are summed at once

/// Sums of monomials over neighbours with the coordinates u, v in a plane and the height h over it.
struct HeightSums {
  double u, v, uu, uv, vv, uuu, uuv, uvv, vvv, uuuu, uuuv, uuvv, uvvv, vvvv, h, hu, hv, huu, huv, hvv, hh;
};

/// Normal equations of height fits, one per lane.
struct HeightSystems {
  static constexpr int numbers = sizeof(HeightSums) / sizeof(double);
  alignas(64) double sums[numbers][kernel_packet];  ///< in the order of HeightSums
  alignas(64) double count[kernel_packet];  ///< sum of weights, including 1 for a point of height 0 at the origin
};

/// The solutions of HeightSystems.
struct HeightSolutions {
  alignas(
      64) double coefficient[6][kernel_packet];  ///< of 1, u, v, u^2, u v, v^2: the first is the height over the origin
  alignas(64) double leverage[kernel_packet];    ///< variance of coefficient[0] over that of each point's height
  alignas(64) double explained[kernel_packet];   ///< explained part of the sum of squared heights
  alignas(64) double least_pivot[kernel_packet], most_pivot[kernel_packet];
};

/// Unit vectors, one per lane, or zeros.
struct Normals {
  alignas(64) double x[kernel_packet], y[kernel_packet], z[kernel_packet];
};

/// The range [lowest, highest] of heights that are reached from 0 over gaps of at most a given size, and the extremes
/// of all heights.
struct HeightRange {
  double lowest, highest;
  double bottom, top;
};

/// Symmetric 3 x 3 matrices without negative eigenvalues, one per lane.
struct Covariances {
  alignas(64) double xx[kernel_packet], xy[kernel_packet], xz[kernel_packet], yy[kernel_packet], yz[kernel_packet],
      zz[kernel_packet];
};

/// The eigenvalues of Covariances, and the unit eigenvector of the smallest one.
struct SmallestAxes {
  alignas(64) double x[kernel_packet], y[kernel_packet], z[kernel_packet];
  alignas(64) double smallest[kernel_packet], middle[kernel_packet], largest[kernel_packet];
  alignas(64) double is_found[kernel_packet];  ///< 1; 0 if two eigenvalues are too close for the closed form
};

/// Neighbours projected to the tangent plane of a point, which is at the origin. Values behind `count` are arbitrary.
struct PlanarOffsets {
  /// Greatest number of neighbours; those of a grown neighbourhood come in parts.
  static constexpr int most = 64;
  int count = 0;
  alignas(64) double u[most], v[most];
};

/// What is certain of a star: closed, its link is known; tied, all neighbours that may be in its link are known;
/// gaping, it looks open; or unknown.
enum class StarKind { closed, tied, gaping, unknown };

/// A star found by inversion. If it is closed, it has the link, as numbers of neighbours counterclockwise, and the
/// circumradius of each with the next. If it is tied, it has all neighbours that may be in the link: first the corners
/// of a hull counterclockwise, then others, ascending.
struct InvertedStar {
  /// Greatest number of vertices; larger hulls are left to delaunayStar().
  static constexpr int most = 24;
  int size = 0;
  int link[most];
  double radius[most];
};

/// The 24 pixels around one in a 5 x 5 square, as steps of rows and columns: ring 1 in the order of directions, from
/// growing rows towards growing columns, then ring 2.
constexpr int pixels_around = 24, pixels_beside = 8;
constexpr int around_row[pixels_around] = {1, 1,  0,  -1, -1, -1, 0,  1,  2, 2, 2, 1,
                                           0, -1, -2, -2, -2, -2, -2, -1, 0, 1, 2, 2};
constexpr int around_column[pixels_around] = {0, 1, 1, 1, 0, -1, -1, -1, 0,  1,  2,  2,
                                              2, 2, 2, 1, 0, -1, -2, -2, -2, -2, -2, -1};

/// The offsets of the points in the pixels around each of eight points. Lanes without a point may hold any numbers.
struct PixelsAround {
  alignas(64) double x[pixels_around][kernel_packet], y[pixels_around][kernel_packet], z[pixels_around][kernel_packet];
  /// direction from the sensor
  alignas(64) double sight_x[kernel_packet], sight_y[kernel_packet], sight_z[kernel_packet];
  /// whether only the rows of ring 2 bound the distance of ring 3, because rows are far apart
  bool is_stretched = false;
};

/// Frames and stars of the eight points of PixelsAround; sets of lanes are bits.
struct PixelStars {
  alignas(64) double normal_x[kernel_packet], normal_y[kernel_packet], normal_z[kernel_packet];  ///< towards the sensor
  /// radius of a disk with the same mean squared distance as the points around
  alignas(64) double fit_radius[kernel_packet];
  /// Circumradii of the triangles: radius[2 c] is that of the triangle at the edge from number 2 c of PixelsAround on,
  /// radius[2 c + 1] that of the one at the edge to number 2 c + 2. Both are the same triangle if the corner, number 2
  /// c + 1, is not in the link.
  alignas(64) double radius[pixels_beside][kernel_packet];
  unsigned has_corner[pixels_beside / 2];  ///< lanes whose link contains number 2 c + 1
  unsigned is_found;                       ///< lanes with a plane
  unsigned is_mirrored;                    ///< lanes where ring 1 runs clockwise around the normal
  /// lanes whose star is certainly closed and that of the points around, with no circle that reaches ring 3
  unsigned is_certain;
};

/// Values of an image around eight pixels: the value `row` rows and `column` columns from the pixel of lane l is at[l +
/// row * row_step + column * column_step]. Borrowed.
struct PixelRows {
  const double* at;
  std::ptrdiff_t row_step, column_step;
};

/// The other pixels of a 7 x 7 square: ring 1, ring 2, ring 3, see depth_image/window_pixels.h.
constexpr int pixels_of_window = 48;

/// Points of a row of an image relative to the sensor: pointers to its first pixel in arrays that hold the image row by
/// row. Pixels without a point may hold any numbers. Borrowed.
struct PixelPoints {
  const double *x, *y, *z, *range;
};
/// Pixels of a row whose subsets are the bits of a word.
constexpr int pixels_in_word = 64;

/// Steps from a pixel to others of the image.
struct PixelSteps {
  int count;
  const int* shift;    ///< offset of the other pixel in the arrays of the image
  const double* most;  ///< squared tangent of the steepest step, see JumpTest::steepestOf()
};

/// Least squares fits of quadratics over the squares of pixels around each of eight.
struct SquareFits {
  alignas(64) double value[kernel_packet];     ///< of the fit at the middle
  alignas(64) double variance[kernel_packet];  ///< of the residuals
};

/// Triangles side by side: number i has the spokes i and i + 1, which start at one point, and the rim between their
/// ends. Borrowed arrays of `count` numbers with room for whole packets; those of spokes have one packet more.
struct TriangleFans {
  int count;
  const double *spoke_x, *spoke_y, *spoke_z, *rim_x, *rim_y, *rim_z;  ///< vectors
  double *spoke, *rim;                                                ///< lengths
  double *area, *slack;                                               ///< area, and slack of the triangle inequality
  double *cotan_at_next, *cotan_at_own;                               ///< cotangents opposite spoke i and spoke i + 1
};

/// The loops in which a build spends its time, compiled for all processors, for AVX2 and for AVX-512. All three do the
/// same operations, so results have the same bits.
struct Kernels {
  // NOLINTBEGIN(readability-identifier-naming): they are called as functions
  /// Selects the candidates within the squared distance `bound` of a point, except number p: their ranks, and squared
  /// distances with the bits of FLANN's L2_Simple. Both arrays have room for all candidates and one packet.
  /// @returns their number
  int (*takeWithin)(const Candidates& candidates, const double* point, int p, double bound, double* squared_distance,
                    int* index);
  /// For each value, how many of all values are less, compared as floats.
  /// @param count a multiple of kernel_packet
  /// @param rounded scratch; it and `rank` have room for two packets more
  void (*rankValues)(const double* values, int count, float* rounded, int* rank);
  /// The largest absolute coordinate.
  double (*extent)(const Offsets& offsets);
  /// Sums over the first ends[0], ends[1], ... offsets times `unit`.
  /// @param ends ascending, at most most_sets
  void (*sumOffsets)(const Offsets& offsets, double unit, const int* ends, int sets, OffsetSums* sums);
  /// Sums over the offsets in the coordinates u, v and h along three axes, 3 x 3 numbers row by row.
  void (*sumHeights)(const Offsets& offsets, const double* axes, HeightSums& sums);
  /// sumHeights() with weights (1 - d^2)^2, which fall to 0 at the distance d = 1, and with h (1 - h^2 / d^2) in place
  /// of h: a sphere through the origin whose normal there is the third axis is then exactly a quadratic in u and v.
  /// @returns the sum of weights
  double (*sumWeightedHeights)(const Offsets& offsets, const double* axes, HeightSums& sums);
  /// Solves each system, bit for bit independently of the others.
  void (*solveHeights)(const HeightSystems& systems, HeightSolutions& solutions);
  /// Heights along `normal`, and the range reached from 0 over gaps of at most `gap`.
  /// @param[out] heights room for whole packets
  HeightRange (*connectedHeights)(const Offsets& offsets, const double* normal, double gap, double* heights);
  /// connectedHeights() for eight normals.
  /// @param[out] heights one packet per offset, with a height for each normal
  /// @param[out] range one packet
  void (*connectedHeightsAlong)(const Offsets& offsets, const Normals& normals, double gap, double* heights,
                                HeightRange* range);
  /// Moves the offsets with heights in the range to the front, padded to whole packets with zeros.
  /// @param[out] x, y, z room for whole packets; may be the given arrays
  /// @returns their number
  int (*keepConnected)(const Offsets& offsets, const double* heights, const HeightRange& range, double* x, double* y,
                       double* z);
  /// The eigenvalues and the axis of the smallest, of each matrix, bit for bit independently of the others.
  void (*findSmallest)(const Covariances& covariances, SmallestAxes& axes);
  /// Projects offsets, at most PlanarOffsets::most, times `unit`, to the axes x and y.
  void (*project)(const Offsets& offsets, double unit, const double* x, const double* y, PlanarOffsets& planar);
  /// Measures the triangles of the fans by the formulas of cover/geometry.h.
  void (*measureTriangleFans)(const TriangleFans& fans);
  /// See wrapInverted().
  StarKind (*wrapInverted)(const PlanarOffsets& planar, InvertedStar& star);
  /// The plane of each of eight points by the pixels around, as fitFrame() has it, and its star if all link vertices
  /// are beside it. Each lane is bit for bit independent of the others.
  void (*wrapPixels)(const PixelsAround& around, PixelStars& stars);
  /// Quadratics over 5 x 5 and 7 x 7 pixels.
  void (*fitSquares5)(const PixelRows& rows, SquareFits& fits);
  void (*fitSquares7)(const PixelRows& rows, SquareFits& fits);
  /// For each step, whether JumpTest joins each of 64 pixels of a row with the one that the step leads to, as bits.
  /// @param of_inverse,of_depth tolerances of JumpTest
  void (*joinPixels)(const PixelPoints& pixels, const PixelSteps& steps, double of_inverse, double of_depth,
                     std::uint64_t* joined);
  /// The mean squared spacing, in inverse depth, between each of eight pixels and the chosen ones of ring 1; 0 if none
  /// is chosen.
  /// @param shift offsets to the pixels of ring 1
  /// @param beside for each of these, the lanes for which it is chosen
  void (*spacingsOf)(const PixelPoints& pixels, const double* inverse_depth, const int* shift,
                     const unsigned char* beside, double* squared);
  /// Which values of a 7 x 7 window differ from the middle by at most the lane's slope times the number of the ring,
  /// plus its tolerance; NaN never does.
  /// @param values the middle values of eight windows
  /// @param shift offsets to the pixels of the window
  /// @param wanted lanes whose `within` is needed
  /// @param[out] within for each pixel of the window, the lanes; not set if all pixels of all wanted lanes are within
  /// @returns the lanes with all pixels within
  unsigned (*squaresWithin)(const double* values, const std::ptrdiff_t* shift, const double* slope,
                            const double* tolerance, unsigned wanted, unsigned char* within);
  // NOLINTEND(readability-identifier-naming)
};

/// The kernels that every processor runs.
const Kernels& portableKernels();

/// The fastest kernels for this processor, or those set by chooseKernels().
const Kernels& kernels();

/// Sets the kernels of builds that begin later, for tests and benchmarks. Null: the fastest.
void chooseKernels(const Kernels* chosen);

}  // namespace tufted
