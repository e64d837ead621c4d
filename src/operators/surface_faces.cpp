// Gradients and divergences on faces for the heat method (Crane, Weischedel, Wardetzky 2013, 2017).
#include "operators/surface_faces.h"

#include <algorithm>
#include <cmath>

#include "cover/geometry.h"

namespace tufted {

bool layOut(const DistinctFace& given, double weight, int exponent, SurfaceFace& face) {
  std::array<double, 3> opposite;
  for (int k = 0; k < 3; ++k) opposite[k] = std::ldexp(given.opposite[k], -exponent);
  const int top = static_cast<int>(std::max_element(opposite.begin(), opposite.end()) - opposite.begin());
  const int first = (top + 1) % 3, second = (top + 2) % 3;
  const double base = opposite[top], from_first = opposite[second], from_second = opposite[first];
  const double area = triangleArea(base, from_first, from_second);
  if (!(area > 0) || !std::isfinite(area)) return false;
  face.corners = {given.corners[first], given.corners[second], given.corners[top]};
  face.base = base;
  face.foot = (base + (from_first - from_second) * ((from_first + from_second) / base)) / 2;
  face.height = 2 * area / base;
  face.weight = weight;
  return face.height > 0;
}

double squaredSides(const SurfaceFace& face) {
  const double rest = face.base - face.foot;
  return face.base * face.base + face.foot * face.foot + rest * rest + 2 * face.height * face.height;
}

SurfaceFaces surfaceFaces(const CoverSource& cover, int vertices, double scale, const Workers& workers) {
  SurfaceFaces surface;
  const std::vector<DistinctFace> faces = distinctFaces(cover, vertices, workers);
  surface.exponent = unitOf(faces);
  for (const DistinctFace& distinct : faces) {
    SurfaceFace face;
    if (layOut(distinct, scale * distinct.copies, surface.exponent, face)) surface.faces.push_back(face);
  }
  return surface;
}

VectorXd meanSquaredSides(const SurfaceFaces& surface, const std::vector<int>& part, int parts, bool by_area) {
  VectorXd weights = VectorXd::Zero(parts), squares = weights;
  for (const SurfaceFace& face : surface.faces) {
    const int of = part[face.corners[0]];
    if (of < 0) continue;
    const double weight = by_area ? face.weight * face.base * face.height : face.weight;
    weights[of] += weight;
    squares[of] += weight * (squaredSides(face) / 3);
  }
  return (weights.array() > 0).select(squares.cwiseQuotient(weights), 0);
}

VectorXd lumpedAreas(const SurfaceFaces& surface, int size) {
  VectorXd areas = VectorXd::Zero(size);
  for (const SurfaceFace& face : surface.faces) {
    for (const int corner : face.corners) areas[corner] += face.weight * face.base * face.height / 6;
  }
  return areas;
}

}  // namespace tufted
