#include <tufted/tufted.h>

#include <cmath>
#include <cstdio>

#ifndef EIGEN_DONT_PARALLELIZE
#error "the target does not say how its copies of Eigen's functions were compiled"
#endif

namespace {

const double pi = std::acos(-1.0);

/// Points spread evenly over the unit sphere, along a spiral of the golden angle.
tufted::Points spiral(int n) {
  tufted::Points points(n, 3);
  for (int i = 0; i < n; ++i) {
    const double z = 1 - (2 * i + 1.0) / n;
    const double angle = i * pi * (3 - std::sqrt(5.0));
    const double radius = std::sqrt(1 - z * z);
    points.row(i) << radius * std::cos(angle), radius * std::sin(angle), z;
  }
  return points;
}

bool check(const char* what, double found, double expected, double tolerance) {
  if (std::abs(found - expected) <= tolerance) return true;
  std::fprintf(stderr, "%s: %.17g, expected %.17g\n", what, found, expected);
  return false;
}

bool cloud() {
  const tufted::Laplacian laplacian = tufted::pointCloudLaplacian(spiral(2000));
  const tufted::VectorXd sums = laplacian.L * tufted::VectorXd::Ones(2000);
  return check("sum(M) of a sphere", laplacian.M.sum(), 4 * pi, 0.05) &
         check("rows of L", sums.cwiseAbs().maxCoeff(), 0, 1e-12) &
         check("cover", tufted::validate(laplacian.cover()).ok(), true, 0);
}

bool frames() {
  tufted::LaplacianBuilder builder;
  builder.pointCloud(spiral(2000));
  return check("sum(M) of the second frame", builder.pointCloud(2 * spiral(2000)).M.sum(), 16 * pi, 0.2);
}

/// Links whatever the solver was built with.
bool algorithms() {
  const tufted::Laplacian laplacian = tufted::pointCloudLaplacian(spiral(2000));
  const tufted::Spectrum spectrum = tufted::spectrum(laplacian, 4);
  return check("first eigenvalue of a sphere", spectrum.values[0], 0, 0) &
         check("second eigenvalue of a sphere", spectrum.values[1], 2, 0.02) &
         check("residual", spectrum.report.residual, 0, 1e-8);
}

bool mesh() {
  const tufted::Points square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const tufted::Triangles triangles{{0, 1, 2}, {0, 2, 3}};
  const tufted::Laplacian laplacian = tufted::meshLaplacian(square, triangles);
  return check("sum(M) of a square", laplacian.M.sum(), 1, 1e-3) &
         check("diagonal of a square", laplacian.L.coeff(0, 0), 1, 1e-3);
}

bool errors() {
  try {
    tufted::CloudOptions options;
    options.neighbors = 2;
    tufted::pointCloudLaplacian(spiral(10), options);
  } catch (const tufted::InvalidInput&) {
    return true;
  }
  std::fprintf(stderr, "two neighbours are not refused\n");
  return false;
}

}  // namespace

int main() {
  return cloud() & frames() & algorithms() & mesh() & errors() ? 0 : 1;
}
