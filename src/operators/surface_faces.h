#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/cover_source.h"
#include "base/parallel.h"
#include "operators/distinct_faces.h"
#include "tufted/types.h"

namespace tufted {

/// A triangle laid out in its own plane: corner 0 at the origin, corner 1 at (base, 0), corner 2 at (foot, height). The
/// base is the longest side, so that 0 <= foot <= base and no digits cancel.
struct SurfaceFace {
  std::array<int, 3> corners;
  double base, foot, height;
  double weight;  ///< number of copies in the cover times the scale of L
};

/// The distinct faces of a cover (see distinctFaces()) for gradients and divergences, without those of no area. The
/// order does not depend on the number of threads.
struct SurfaceFaces {
  std::vector<SurfaceFace> faces;  ///< sorted by corners
  int exponent = 0;                ///< lengths are in units of 2^exponent of the cover's
};

/// Collects the faces of a cover with `vertices` vertices.
/// @param scale of L: 1/2 for meshes, 1/6 for clouds
SurfaceFaces surfaceFaces(const CoverSource& cover, int vertices, double scale, const Workers& workers);

/// The mean squared side of the faces of each part, in units of 2^(2 exponent); 0 without a face.
/// @param part number of each point's part, in [0, parts); -1: none
/// @param by_area whether each face is weighted by its area
VectorXd meanSquaredSides(const SurfaceFaces& surface, const std::vector<int>& part, int parts, bool by_area);

/// Lays a face out in its plane, with lengths in units of 2^exponent. False if it has no area.
bool layOut(const DistinctFace& given, double weight, int exponent, SurfaceFace& face);

/// The sum of its squared sides.
double squaredSides(const SurfaceFace& face);

/// Areas of `size` points, a third of each face per corner, in units of 2^(2 exponent).
VectorXd lumpedAreas(const SurfaceFaces& surface, int size);

/// Unit direction of the gradient of the linear function with these values at the corners; 0 if they are equal.
inline Eigen::Vector2d gradientDirection(const SurfaceFace& face, double v0, double v1, double v2) {
  const double first = v1 - v0, second = v2 - v0;
  const double top = std::max(std::abs(first), std::abs(second));
  if (!(top > 0)) return Eigen::Vector2d::Zero();
  // The gradient times base and height, which has the same direction.
  const Eigen::Vector2d gradient(first / top * face.height, second / top * face.base - first / top * face.foot);
  const double length = gradient.norm();
  return length > 0 ? Eigen::Vector2d(gradient / length) : Eigen::Vector2d::Zero();
}

/// Integrals over the face of X times the gradient of each corner's hat function, for a constant X; they sum to 0.
inline std::array<double, 3> divergence(const SurfaceFace& face, const Eigen::Vector2d& X) {
  const double half = face.weight / 2;
  const double second = half * face.base * X.y();
  const double first = half * (face.height * X.x() - face.foot * X.y());
  return {-(first + second), first, second};
}

}  // namespace tufted
