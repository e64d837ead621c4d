#pragma once

#include <Eigen/Geometry>
#include <algorithm>

#include "denoise/windows.h"
#include "simd/kernels.h"
#include "stars/tangent_frame.h"

namespace tufted {

/// The surface of a window at one position.
struct WindowSurface {
  double height;           ///< of the position over it
  Eigen::Vector3d normal;  ///< of the surface there
};

/// The surface of a window as a quadratic over its plane.
/// @param size of Windows::fits
inline PlaneQuadratic quadraticOf(const Windows& windows, int w, int size) {
  PlaneQuadratic quadratic;
  const Eigen::Vector3d normal = windows.normal.row(w).transpose(), first = tangentOf(normal);
  Eigen::Map<Eigen::Matrix3d>(quadratic.axes) << first, normal.cross(first), normal;
  quadratic.unit = windows.radius[w];
  std::ranges::copy(windows.fits[w][size].coefficient, quadratic.coefficient);
  return quadratic;
}

/// @param d the position relative to the middle of the window
inline WindowSurface surfaceAt(const PlaneQuadratic& quadratic, const Eigen::Vector3d& d) {
  const Eigen::Map<const Eigen::Vector3d> first(quadratic.axes), second(quadratic.axes + 3), normal(quadratic.axes + 6);
  const double* const c = quadratic.coefficient;
  const double unit = quadratic.unit, u = d.dot(first) / unit, v = d.dot(second) / unit;
  const double height = unit * (c[0] + c[1] * u + c[2] * v + c[3] * u * u + c[4] * u * v + c[5] * v * v);
  const double along_u = c[1] + 2 * c[3] * u + c[4] * v, along_v = c[2] + c[4] * u + 2 * c[5] * v;
  const Eigen::Vector3d across = normal - along_u * first - along_v * second;
  const double length = across.norm();
  return {(d.dot(normal) - height) / length, across / length};
}

/// @param size of Windows::fits
/// @param d the position relative to the middle of window w
inline WindowSurface surfaceAt(const Windows& windows, int w, int size, const Eigen::Vector3d& d) {
  return surfaceAt(quadraticOf(windows, w, size), d);
}

}  // namespace tufted
