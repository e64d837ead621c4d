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

/// Stands for the mate of a side that is not glued yet.
constexpr int unglued = -1;
/// Sides have int numbers: 6 per triangle under the cover.
constexpr std::int64_t most_triangles = INT32_MAX / 6;

/// An IntrinsicTriangulation while it grows.
struct CoverBuffer {
  int vertices = 0;
  RawBuffer<std::array<int, 3>> faces;
  RawBuffer<int> glue;
  RawBuffer<double> length;

  std::int64_t size() const { return std::ssize(faces); }
};

/// Bytes in use: arrays of an earlier build may have room for more.
template <class Triangulation>
std::size_t bytesOfCover(const Triangulation& cover) {
  const auto bytes = [](const auto& values) { return values.size() * sizeof(values[0]); };
  return bytes(cover.faces) + bytes(cover.glue) + bytes(cover.length);
}

/// Front and back of each triangle (Section 4.2), nothing glued yet: face 2 t is triangle t = (i, j, k), face 2 t + 1
/// is (i, k, j).
template <class Triangulation>
void addTriangle(Triangulation& cover, int t, int i, int j, int k) {
  cover.faces[2 * t] = {i, j, k};
  cover.faces[2 * t + 1] = {i, k, j};
}

/// Makes room for `triangles` triangles.
void resizeCover(IntrinsicTriangulation& cover, int vertices, std::int64_t triangles);

/// Side `s` of the front of triangle `t`.
constexpr int frontSide(int t, int s) {
  return 6 * t + s;
}
/// The side of the back that lies on it.
constexpr int backSide(int t, int s) {
  return 6 * t + 5 - s;
}

/// Glues two sides to each other.
template <class Triangulation>
void glueSides(Triangulation& cover, int a, int b) {
  cover.glue[a] = b;
  cover.glue[b] = a;
}

/// Which circular order the faces around an edge are glued in (Section 5.4).
struct EdgeOrder {
  FaceOrder order = FaceOrder::angle;
  std::uint64_t seed = 0;
};

struct EdgeCounts {
  std::int64_t boundary = 0;     ///< edges of one face
  std::int64_t nonmanifold = 0;  ///< edges of more than two faces
};

/// Algorithm 1: puts all sides that are not glued yet into one group per vertex pair, orders each group circularly and
/// glues front to back. `boundary`, if given, gets rim at both vertices of an edge of a single face.
EdgeCounts glueEdges(IntrinsicTriangulation& cover, const PointsView& points, const EdgeOrder& order,
                     const Workers& workers, std::vector<Boundary>* boundary = nullptr);

/// Means over the triangles' sides; 0 without a triangle.
struct MeanLengths {
  double length = 0;
  double square = 0;
};

/// Euclidean lengths of all sides (MEASUREEDGELENGTHS).
MeanLengths measureLengths(IntrinsicTriangulation& cover, const PointsView& points, const Workers& workers);

/// Gives faces that are flat but for rounding a slack: each edge grows by a length at each of its two ends, which is 0
/// but at vertices between the two shorter sides of such a face.
/// @returns how many edges have grown
std::int64_t lengthenAtFlatFaces(IntrinsicTriangulation& cover, const Workers& workers);

struct FlipCounts {
  std::int64_t flips = 0;
  std::int64_t failures = 0;  ///< edges that were not Delaunay when flipping was given up

  FlipCounts& operator+=(const FlipCounts& other) {
    flips += other.flips;
    failures += other.failures;
    return *this;
  }
};

/// Algorithm 2 in long double, if any face is so thin that rounding of double lengths changes it; else nothing.
/// Vertices that coincide are joined by edges as lengthenShortEdges() makes them first.
/// @param lengths between the vertices
/// @param delta of lengthenShortEdges(), 0: nothing is lengthened
/// @param[in,out] lengthened grows by the number of these edges
FlipCounts flipThinFaces(IntrinsicTriangulation& cover, const EdgeLengths& lengths, double delta,
                         std::int64_t& lengthened, const Workers& workers);

/// Algorithm 2: flips edges until all are intrinsic Delaunay.
FlipCounts flipToDelaunay(IntrinsicTriangulation& cover, const Workers& workers);

/// Brings a cover into the caller's numbering and unit.
/// @param input_index the caller's index of each vertex
/// @param size how many points the caller has
/// @param exponent the cover's unit is 2^exponent of the caller's
void toInput(IntrinsicTriangulation& cover, const Buffer<int>& input_index, int size, int exponent);

}  // namespace tufted
