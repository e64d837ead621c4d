#pragma once

// Plain arrays and no functions of others: see kernels_source.h.
#include <cstddef>
#include <cstdint>

namespace tufted {

/// Numbers are worked on in groups of so many.
constexpr int kernel_packet = 8;

/// `count` filled up to whole packets.
static constexpr int toPackets(int count) {
  return (count + kernel_packet - 1) / kernel_packet * kernel_packet;
}

/// Points by coordinate, filled up to whole packets with points that are nowhere near. Borrowed.
struct Candidates {
  int count;
  const int* index;  ///< ranks
  const double *x, *y, *z;
};

/// The neighbours of a point relative to it, or some of them, filled up to whole packets with zeros. Borrowed.
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
  alignas(64) double sums[numbers][kernel_packet];  ///< in the order of HeightSums
  alignas(64) double count[kernel_packet];          ///< points, that of height 0 at the origin included
};

/// The solutions of HeightSystems.
struct HeightSolutions {
  alignas(
      64) double coefficient[6][kernel_packet];  ///< of 1, u, v, u^2, u v, v^2: the first is the height over the origin
  alignas(64) double leverage[kernel_packet];    ///< variance of that height by the variance of each point's
  alignas(64) double explained[kernel_packet];   ///< of the sum of squared heights
  alignas(64) double least_pivot[kernel_packet], most_pivot[kernel_packet];
};

/// Unit vectors, one per lane, or zeros.
struct Normals {
  alignas(64) double x[kernel_packet], y[kernel_packet], z[kernel_packet];
};

/// The range of heights that are connected with 0: from one to the next no gap is wider than a bound. And the extremes
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
  alignas(64) double is_found[kernel_packet];  ///< 1; 0 where two eigenvalues lie too close for a closed form
};

/// Neighbours in the tangent plane of a point, which lies at the origin; anything behind them.
struct PlanarOffsets {
  /// Neighbours that are projected at once; those of a grown neighbourhood come in parts.
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
  /// Vertices of a hull; larger ones go the careful way.
  static constexpr int most = 24;
  int size = 0;
  int link[most];
  double radius[most];
};

/// The pixels around one in an image, 5 x 5 without itself, by steps of rows and columns: first ring 1 by direction,
/// from where rows grow to where columns grow, then ring 2.
constexpr int pixels_around = 24, pixels_beside = 8;
constexpr int around_row[pixels_around] = {1, 1,  0,  -1, -1, -1, 0,  1,  2, 2, 2, 1,
                                           0, -1, -2, -2, -2, -2, -2, -1, 0, 1, 2, 2};
constexpr int around_column[pixels_around] = {0, 1, 1, 1, 0, -1, -1, -1, 0,  1,  2,  2,
                                              2, 2, 2, 1, 0, -1, -2, -2, -2, -2, -2, -1};

/// The points in the pixels around each of eight points, relative to it. Lanes that stand for no point may
/// hold any numbers.
struct PixelsAround {
  alignas(64) double x[pixels_around][kernel_packet], y[pixels_around][kernel_packet], z[pixels_around][kernel_packet];
  alignas(64) double sight_x[kernel_packet], sight_y[kernel_packet], sight_z[kernel_packet];  ///< from the sensor
  bool is_stretched = false;  ///< rows are farther apart than columns: how far ring 3 is is told by its rows alone
};

/// Frames and stars of eight points of an image among PixelsAround; sets of lanes are bits.
struct PixelStars {
  alignas(64) double normal_x[kernel_packet], normal_y[kernel_packet], normal_z[kernel_packet];  ///< to the sensor
  alignas(64) double fit_radius[kernel_packet];  ///< of a disk with the mean squared distance of all points around
  /// Circumradii of the triangles: radius[2 c] is that of the triangle whose rim starts at number 2 c of PixelsAround,
  /// radius[2 c + 1] that of the one whose rim ends at number 2 c + 2. Both are the same triangle where the corner,
  /// number 2 c + 1, is not in the link.
  alignas(64) double radius[pixels_beside][kernel_packet];
  unsigned has_corner[pixels_beside / 2];  ///< number 2 c + 1 is in the link
  unsigned is_found;                       ///< there is a plane
  unsigned is_mirrored;                    ///< the numbers of ring 1 run clockwise around the normal
  unsigned is_certain;  ///< the star is closed, beyond doubt that among the points around, and no circle reaches ring 3
};

/// Values of an image around each of eight: what is `row` rows and `column` columns on from lane l is
/// at[l + row * row_step + column * column_step]. Borrowed.
struct PixelRows {
  const double* at;
  std::ptrdiff_t row_step, column_step;
};

/// The pixels of 7 x 7 around one, see depth_image/window_pixels.h: first those of ring 1, then ring 2 and 3.
constexpr int pixels_of_window = 48;

/// A row of an image: where its first pixel is in arrays that hold the image row by row, relative to the sensor; a
/// pixel without a point may hold any numbers. Borrowed.
struct PixelPoints {
  const double *x, *y, *z, *range;
};
/// Pixels of a row whose set is a word.
constexpr int pixels_in_word = 64;

/// Steps from a pixel to others of the image.
struct PixelSteps {
  int count;
  const int* shift;    ///< in the arrays of the image
  const double* most;  ///< squared tangents, see JumpTest::steepestOf()
};

/// Quadratics by least squares over the square of pixels around each of eight.
struct SquareFits {
  alignas(64) double value[kernel_packet];     ///< in the middle
  alignas(64) double variance[kernel_packet];  ///< of the residuals
};

/// Triangles side by side: number i has the spokes i and i + 1, which start at one point, and the rim between their
/// ends. Borrowed arrays of `count` numbers and room for whole packets; those of the spokes have one packet more.
struct TriangleFans {
  int count;
  const double *spoke_x, *spoke_y, *spoke_z, *rim_x, *rim_y, *rim_z;  ///< vectors
  double *spoke, *rim;                                                ///< lengths
  double *area, *slack;                                               ///< of the triangle inequality
  double *cotan_at_next, *cotan_at_own;                               ///< opposite spoke i, opposite spoke i + 1
};

/// The loops that a build spends its time in. They are compiled for every processor, for AVX2 and for AVX-512; the
/// operations are the same, and so are the bits.
struct Kernels {
  // NOLINTBEGIN(readability-identifier-naming): they are called as functions
  /// The candidates within the squared distance `bound` of a point, but for number p: squared distances, with the bits
  /// of FLANN's L2_Simple, and ranks. Both arrays have room for all candidates and one packet.
  /// @returns how many
  int (*takeWithin)(const Candidates& candidates, const double* point, int p, double bound, double* squared_distance,
                    int* index);
  /// How many of the values, rounded to floats, are less than each.
  /// @param count a multiple of the packet
  /// @param rounded scratch; this and `rank` have room for two packets more
  void (*rankValues)(const double* values, int count, float* rounded, int* rank);
  /// The largest absolute coordinate.
  double (*extent)(const Offsets& offsets);
  /// Sums over the first ends[0], ends[1], ... offsets times `unit`.
  /// @param ends ascending, at most most_sets
  void (*sumOffsets)(const Offsets& offsets, double unit, const int* ends, int sets, OffsetSums* sums);
  /// Sums over the offsets in the coordinates u, v and h, whose axes are given one after the other.
  void (*sumHeights)(const Offsets& offsets, const double* axes, HeightSums& sums);
  /// Solves each system with the same bits as if it were alone.
  void (*solveHeights)(const HeightSystems& systems, HeightSolutions& solutions);
  /// Heights along `normal`, and the range of those connected with 0 by gaps of at most `gap`.
  /// @param[out] heights room for whole packets
  HeightRange (*connectedHeights)(const Offsets& offsets, const double* normal, double gap, double* heights);
  /// Heights along each of the normals, and their ranges, as connectedHeights() gives them for one normal.
  /// @param[out] heights one packet per offset, with a height for each normal
  /// @param[out] range one packet
  void (*connectedHeightsAlong)(const Offsets& offsets, const Normals& normals, double gap, double* heights,
                                HeightRange* range);
  /// Puts the offsets within the range to the front, filled up to whole packets with zeros.
  /// @param[out] x, y, z room for whole packets; may be what is given
  /// @returns how many
  int (*keepConnected)(const Offsets& offsets, const double* heights, const HeightRange& range, double* x, double* y,
                       double* z);
  /// The smallest eigenvalue and its axis of each matrix, with the same bits as if it were alone.
  void (*findSmallest)(const Covariances& covariances, SmallestAxes& axes);
  /// The offsets, at most PlanarOffsets::most, times `unit` along the axes x and y.
  void (*project)(const Offsets& offsets, double unit, const double* x, const double* y, PlanarOffsets& planar);
  /// The triangles of the fans, by the formulas of cover/geometry.h.
  void (*measureTriangleFans)(const TriangleFans& fans);
  /// See wrapInverted().
  StarKind (*wrapInverted)(const PlanarOffsets& planar, InvertedStar& star);
  /// The plane through the points around each pixel, as fitFrame() has it, and the star where it is made of ring 1.
  /// Each lane has the same bits as if it were alone.
  void (*wrapPixels)(const PixelsAround& around, PixelStars& stars);
  /// Over 5 x 5 and 7 x 7 pixels.
  void (*fitSquares5)(const PixelRows& rows, SquareFits& fits);
  void (*fitSquares7)(const PixelRows& rows, SquareFits& fits);
  /// For each step whether JumpTest joins each pixel of a row with the one that the step leads to: bits of 64 pixels.
  /// @param of_inverse,of_depth its tolerance
  void (*joinPixels)(const PixelPoints& pixels, const PixelSteps& steps, double of_inverse, double of_depth,
                     std::uint64_t* joined);
  /// The mean squared spacing, in inverse depth, between each of eight pixels and those beside it that are chosen; 0
  /// where none is.
  /// @param shift of the pixels of ring 1
  /// @param beside of each of them, for which lanes it is chosen
  void (*spacingsOf)(const PixelPoints& pixels, const double* inverse_depth, const int* shift,
                     const unsigned char* beside, double* squared);
  /// Which values of a 7 x 7 window differ from the middle by at most the lane's slope times the ring, plus its
  /// tolerance; what is no number differs.
  /// @param values in the middle of each of eight windows
  /// @param shift to each pixel of the window
  /// @param wanted lanes
  /// @param[out] within for each pixel of the window, the lanes; not set where those wanted are within as a whole
  /// @returns the lanes of which all are within
  unsigned (*squaresWithin)(const double* values, const std::ptrdiff_t* shift, const double* slope,
                            const double* tolerance, unsigned wanted, unsigned char* within);
  // NOLINTEND(readability-identifier-naming)
};

/// What every processor runs.
const Kernels& portableKernels();

/// What this processor runs fastest, or what was chosen below.
const Kernels& kernels();

/// Builds that begin after this use the given ones; for tests and benchmarks. Null: the fastest.
void chooseKernels(const Kernels* chosen);

}  // namespace tufted
