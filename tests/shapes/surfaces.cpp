#include <cmath>
#include <numbers>

#include "shapes/spectra.h"
#include "shapes/surface.h"

namespace tufted::shapes {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

// Composite Gauss-Legendre quadrature of the stretch, 3 points per panel; accurate to 1e-12 on all surfaces here.
double integrateArea(const Surface& surface) {
  constexpr int panels = 64;
  const double node = std::sqrt(0.6);
  const double nodes[] = {-node, 0, node}, weights[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  const auto place = [&](int panel, int k) { return (panel + 0.5 + 0.5 * nodes[k]) / panels; };
  double sum = 0;
  for (int i = 0; i < 3 * panels; ++i) {
    for (int j = 0; j < 3 * panels; ++j) {
      const double t = surface.span * place(i / 3, i % 3), s = place(j / 3, j % 3);
      sum += weights[i % 3] * weights[j % 3] * surface.at(t, s).stretch;
    }
  }
  return sum * surface.span / (panels * panels);
}

}  // namespace

Surface sphereSurface() {
  return {.name = "sphere",
          .span = pi,
          .at =
              [](double t, double s) {
                const double phi = 2 * pi * s;
                const Vector3d p(std::sin(t) * std::cos(phi), std::sin(t) * std::sin(phi), std::cos(t));
                return SurfacePoint{p, p, 2 * pi * std::sin(t)};
              },
          .max_stretch = 2 * pi,
          .area = 4 * pi,
          .eigenvalues = sphereSpectrum(known_eigenvalues)};
}

Surface ellipsoidSurface(double a, double b, double c) {
  Surface surface{.name = "ellipsoid", .span = pi, .max_stretch = 2 * pi * a * b};
  surface.at = [=](double t, double s) {
    const double phi = 2 * pi * s;
    const Vector3d unit(std::sin(t) * std::cos(phi), std::sin(t) * std::sin(phi), std::cos(t));
    const Vector3d gradient(unit.x() / a, unit.y() / b, unit.z() / c);
    const Vector3d p(a * unit.x(), b * unit.y(), c * unit.z());
    return SurfacePoint{p, gradient.normalized(), 2 * pi * a * b * c * std::sin(t) * gradient.norm()};
  };
  surface.area = integrateArea(surface);
  return surface;
}

Surface squareSurface() {
  return {.name = "square",
          .span = 1,
          .at =
              [](double t, double s) {
                return SurfacePoint{{s, t, 0}, {0, 0, 1}, 1};
              },
          .max_stretch = 1,
          .area = 1,
          .rim_first = true,
          .rim_last = true,
          .rim_sides = true,
          .eigenvalues = rectangleSpectrum(1, 1, known_eigenvalues)};
}

Surface diskSurface() {
  return {.name = "disk",
          .span = 1,
          .at =
              [](double t, double s) {
                return SurfacePoint{{t * std::cos(2 * pi * s), t * std::sin(2 * pi * s), 0}, {0, 0, 1}, 2 * pi * t};
              },
          .max_stretch = 2 * pi,
          .area = pi,
          .rim_last = true,
          .eigenvalues = diskSpectrum(known_eigenvalues)};
}

Surface torusSurface(double major_radius, double minor_radius) {
  const double R = major_radius, r = minor_radius;
  return {.name = "torus",
          .span = 2 * pi * r,
          .at =
              [=](double t, double s) {
                const double b = t / r, phi = 2 * pi * s, w = R + r * std::cos(b);
                const Vector3d n(std::cos(b) * std::cos(phi), std::cos(b) * std::sin(phi), std::sin(b));
                return SurfacePoint{{w * std::cos(phi), w * std::sin(phi), r * std::sin(b)}, n, 2 * pi * w};
              },
          .max_stretch = 2 * pi * (R + r),
          .area = 4 * pi * pi * R * r,
          .eigenvalues = torusSpectrum(R, r, known_eigenvalues)};
}

Surface cylinderSurface() {
  return {.name = "cylinder_patch",
          .span = 2,
          .at =
              [](double t, double s) {
                const Vector3d n(std::cos(pi * s), std::sin(pi * s), 0);
                return SurfacePoint{{n.x(), n.y(), t}, n, pi};
              },
          .max_stretch = pi,
          .area = 2 * pi,
          .rim_first = true,
          .rim_last = true,
          .rim_sides = true,
          .eigenvalues = rectangleSpectrum(pi, 2, known_eigenvalues)};
}

Surface saddleSurface() {
  Surface surface{.name = "saddle",
                  .span = 2,
                  .max_stretch = 2 * std::sqrt(3.0),
                  .rim_first = true,
                  .rim_last = true,
                  .rim_sides = true};
  surface.at = [](double t, double s) {
    const double x = 2 * s - 1, y = t - 1;
    const Vector3d normal(-x, y, 1);
    return SurfacePoint{{x, y, (x * x - y * y) / 2}, normal.normalized(), 2 * normal.norm()};
  };
  surface.area = integrateArea(surface);
  return surface;
}

}  // namespace tufted::shapes
