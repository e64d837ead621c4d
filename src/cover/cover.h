#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/buffer.h"
#include "base/parallel.h"
#include "base/point_buffer.h"
#include "cover/edge_lengths.h"
#include "tufted/intrinsic_triangulation.h"
#include "tufted/options.h"
#include "tufted/report.h"
#include "tufted/types.h"

namespace tufted {

/// The mate of a side that is not glued yet.
constexpr int unglued = -1;
/// A triangle has 6 sides in the cover, whose numbers must fit an int.
constexpr std::int64_t most_triangles = INT32_MAX / 6;

/// An IntrinsicTriangulation in memory of the workspace.
struct CoverBuffer {
  int vertices = 0;
  RawBuffer<std::array<int, 3>> faces;
  RawBuffer<int> glue;
  RawBuffer<double> length;

  std::int64_t size() const { return std::ssize(faces); }
};

/// Bytes of the values in the arrays, which may have room for more.
template <class Triangulation>
std::size_t bytesOfCover(const Triangulation& cover) {
  const auto bytes = [](const auto& values) { return values.size() * sizeof(values[0]); };
  return bytes(cover.faces) + bytes(cover.glue) + bytes(cover.length);
}

/// Adds front and back of a triangle, not glued yet (Section 4.2): face 2 t is triangle t = (i, j, k), face 2 t + 1 is
/// (i, k, j).
template <class Triangulation>
void addTriangle(Triangulation& cover, int t, int i, int j, int k) {
  cover.faces[2 * t] = {i, j, k};
  cover.faces[2 * t + 1] = {i, k, j};
}

/// Resizes the arrays for `triangles` triangles; no side is glued.
void resizeCover(IntrinsicTriangulation& cover, int vertices, std::int64_t triangles);

/// Side `s` of the front of triangle `t`.
constexpr int frontSide(int t, int s) {
  return 6 * t + s;
}
/// The side of the back of triangle `t` on the same edge as frontSide(t, s).
constexpr int backSide(int t, int s) {
  return 6 * t + 5 - s;
}

/// Glues two sides to each other.
template <class Triangulation>
void glueSides(Triangulation& cover, int a, int b) {
  cover.glue[a] = b;
  cover.glue[b] = a;
}

/// The circular order in which the triangles around an edge are glued (Section 5.4).
struct EdgeOrder {
  FaceOrder order = FaceOrder::angle;
  std::uint64_t seed = 0;
};

struct EdgeCounts {
  std::int64_t boundary = 0;     ///< edges of one triangle
  std::int64_t nonmanifold = 0;  ///< edges of more than two triangles
};

/// Algorithm 1: groups all sides that are not glued yet by vertex pair, orders each group circularly and glues front to
/// back. `boundary`, unless null, becomes Boundary::rim at both vertices of an edge of a single triangle.
EdgeCounts glueEdges(IntrinsicTriangulation& cover, const PointsView& points, const EdgeOrder& order,
                     const Workers& workers, std::vector<Boundary>* boundary = nullptr);

/// Mean length and mean square of all sides; 0 without a triangle.
struct MeanLengths {
  double length = 0;
  double square = 0;
};

/// Sets all sides to Euclidean lengths (MEASUREEDGELENGTHS of Algorithm 3).
MeanLengths measureLengths(IntrinsicTriangulation& cover, const PointsView& points, const Workers& workers);

/// Gives slack to faces that are flat but for rounding (section 10 of docs/algorithm.md, step 3): each edge grows by
/// the radii of its ends, which are 0 except between the two shorter sides of such a face.
/// @returns the number of edges that grew
std::int64_t lengthenAtFlatFaces(IntrinsicTriangulation& cover, const Workers& workers);

struct FlipCounts {
  std::int64_t flips = 0;
  std::int64_t failures = 0;  ///< edges that are not Delaunay although flipping ended

  FlipCounts& operator+=(const FlipCounts& other) {
    flips += other.flips;
    failures += other.failures;
    return *this;
  }
};

/// Algorithm 2 in long double, if any face is so thin that rounding of double lengths changes it; otherwise does
/// nothing. Edges between coincident vertices are lengthened first, see lengthenShortEdges().
/// @param lengths Euclidean lengths between the vertices
/// @param delta CloudOptions::mollify; 0: nothing is lengthened
/// @param[in,out] lengthened increased by the number of lengthened edges
FlipCounts flipThinFaces(IntrinsicTriangulation& cover, const EdgeLengths& lengths, double delta,
                         std::int64_t& lengthened, const Workers& workers);

/// Algorithm 2: flips edges until all are intrinsic Delaunay.
FlipCounts flipToDelaunay(IntrinsicTriangulation& cover, const Workers& workers);

/// Brings a cover into the caller's numbering and unit.
/// @param input_index the caller's index of each vertex
/// @param size N, the number of the caller's points
/// @param exponent the cover's unit is 2^exponent of the caller's
void toInput(IntrinsicTriangulation& cover, const Buffer<int>& input_index, int size, int exponent);

}  // namespace tufted
