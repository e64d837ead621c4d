#include "bench/compare/cover_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "cover/cover.h"
#include "cover/flip_edges.h"

namespace tufted::bench {
namespace {

using Eigen::Vector2d;

/// Lines that pass a vertex nearer than this, relative to their length, end there.
constexpr double vertex_reach = 1e-7;
constexpr int most_faces = 10000;  ///< a traced edge crosses fewer faces, unless something is wrong

/// A direction at the first corner of a side of the glued cover: `angle` counterclockwise from the side.
struct Direction {
  int side;
  double angle;
  bool is_flipped;  ///< whether it is that of an edge that the mesh does not have
};

double angleBetween(double left, double right, double opposite) {
  return std::acos(std::clamp((left * left + right * right - opposite * opposite) / (2 * left * right), -1.0, 1.0));
}

double cornerAngle(const IntrinsicTriangulation& t, int side) {
  return angleBetween(t.length[side], t.length[previousSide(side)], t.length[nextSide(side)]);
}

/// The third corner of a triangle to the left of the way from a to b.
Vector2d apexOf(const Vector2d& a, const Vector2d& b, double from_a, double from_b) {
  const Vector2d way = b - a;
  const double base = way.norm(), along = (from_a * from_a - from_b * from_b + base * base) / (2 * base);
  const double height = 2 * triangleArea(base, from_a, from_b) / base;
  return a + (along * way + height * Vector2d(-way.y(), way.x())) / base;
}

class Tracer {
 public:
  Tracer(const IntrinsicTriangulation& glued, const Points& points) : glued_(glued), points_(points) {}

  /// The direction of a flipped edge, `angle` counterclockwise from another.
  Direction turned(Direction from, double angle) const {
    from.angle += angle;
    from.is_flipped = true;
    for (double corner = cornerAngle(glued_, from.side); from.angle >= corner - 1e-12;
         corner = cornerAngle(glued_, from.side)) {
      from.angle -= corner;
      from.side = glued_.glue[previousSide(from.side)];
    }
    return from;
  }

  /// The parts of the straight line of this length; `miss` is how far it ends from a vertex.
  std::vector<EdgePart> trace(Direction direction, double length, double& miss) const {
    int side = direction.side;  // of the current face, from corner a to corner b
    Vector2d a(0, 0), b(glued_.length[side], 0);
    const Vector2d way(std::cos(direction.angle), std::sin(direction.angle));
    Eigen::Vector3d from = points_.row(tail(glued_, side));
    std::vector<EdgePart> parts;
    for (int passed = 0; passed < most_faces; ++passed) {
      const Vector2d c = apexOf(a, b, glued_.length[previousSide(side)], glued_.length[nextSide(side)]);
      const int vertices[] = {head(glued_, side), head(glued_, nextSide(side))};
      const Vector2d corners[] = {b, c};
      for (int k = 0; k < 2; ++k) {
        const double distance = (corners[k] - length * way).norm();
        if ((passed > 0 && k == 0) || distance > vertex_reach * length) continue;
        miss = distance / length;
        parts.push_back({side / 3, from, points_.row(vertices[k])});
        return parts;
      }
      // The line leaves through b c if c lies to its left, else through c a, which the first face cannot be left by.
      const bool is_left = way.x() * c.y() - way.y() * c.x() > 0;
      const Vector2d start = is_left ? b : c, end = is_left ? c : a;
      const int exit = is_left ? nextSide(side) : previousSide(side);
      const auto across = [&](const Vector2d& p) { return way.x() * p.y() - way.y() * p.x(); };
      const double share = std::clamp(across(start) / (across(start) - across(end)), 0.0, 1.0);
      const Eigen::Vector3d to =
          (1 - share) * points_.row(tail(glued_, exit)) + share * points_.row(head(glued_, exit));
      parts.push_back({side / 3, from, to});
      from = to;
      side = glued_.glue[exit];
      a = end, b = start;
    }
    throw std::runtime_error("an intrinsic edge has no end");
  }

 private:
  const IntrinsicTriangulation& glued_;
  const Points& points_;
};

/// Flips an edge, and finds the directions of the new one.
void flipWithDirections(IntrinsicTriangulation& t, std::vector<Direction>& directions, int side, const Tracer& tracer) {
  const int mate = t.glue[side];
  const int jk = nextSide(side), ki = previousSide(side), im = nextSide(mate), mj = previousSide(mate);
  const std::array<double, 4> outer = {t.length[ki], t.length[im], t.length[mj], t.length[jk]};
  const Direction at_k = directions[ki], at_m = directions[mj], at_i = directions[im], at_j = directions[jk];
  flip(t, side, mate);  // now `side` runs from m to k, and the outer sides have new numbers
  const double length = t.length[side];
  directions[jk] = at_k, directions[ki] = at_i, directions[im] = at_m, directions[mj] = at_j;
  directions[mate] = tracer.turned(at_k, angleBetween(outer[0], length, outer[1]));
  directions[side] = tracer.turned(at_m, angleBetween(outer[2], length, outer[3]));
}

}  // namespace

IntrinsicTriangulation gluedCover(const Points& points, const Triangles& triangles) {
  const Workers workers(1, {});
  IntrinsicTriangulation cover;
  resizeCover(cover, static_cast<int>(points.rows()), triangles.rows());
  for (int t = 0; t < triangles.rows(); ++t) addTriangle(cover, t, triangles(t, 0), triangles(t, 1), triangles(t, 2));
  PointBuffer places(points.rows());
  for (Eigen::Index i = 0; i < points.rows(); ++i) places.row(i) = points.row(i);
  glueEdges(cover, places, {}, workers);
  measureLengths(cover, places, workers);
  return cover;
}

IntrinsicEdges intrinsicEdges(const IntrinsicTriangulation& cover, const Points& points) {
  IntrinsicTriangulation t = cover;
  const Tracer tracer(cover, points);
  const int sides = static_cast<int>(3 * t.size());
  std::vector<Direction> directions;
  for (int side = 0; side < sides; ++side) directions.push_back({side, 0, false});
  IntrinsicEdges result;
  for (bool changed = true; changed;) {
    changed = false;
    for (int side = 0; side < sides; ++side) {
      if (isDelaunay(t, side, t.glue[side])) continue;
      flipWithDirections(t, directions, side, tracer);
      ++result.flips;
      changed = true;
    }
  }
  for (int side = 0; side < sides; ++side) {
    if (side > t.glue[side]) continue;
    double miss = 0;
    result.edges.push_back({directions[side].is_flipped, tracer.trace(directions[side], t.length[side], miss)});
    result.greatest_miss = std::max(result.greatest_miss, miss);
  }
  return result;
}

}  // namespace tufted::bench
