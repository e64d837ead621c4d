#include "stars/predicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>

namespace tufted {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Four points count as on one circle if opposite angles sum to pi within this, in rad: wide enough for lattices of
/// rounded coordinates, and so narrow that random points hardly ever do.
constexpr double tie_angle = 1e-9;
/// Four points are nearly collinear if the sine of the angle at a is below this: there are no two diagonals to choose
/// from, and the exact predicate decides.
constexpr double flat_sine = 1e-6;
/// Rounding of a determinant over the sum of its two products: three roundings of half an ulp at most.
constexpr double determinant_rounding = 4e-16;
/// Products below this may have underflowed.
constexpr double least_bound = 1e-290;
/// The rounding error of a product above this is found exactly by a fused multiply-add.
constexpr double least_exact = 1e-270;
/// Products of squared sides between these bounds have all their digits.
constexpr double least_sides = 1e-280, most_sides = 1e280;

Kernel::Point_2 toCgal(const PlanarPoint& p) {
  return {p.u, p.v};
}

double determinantOf(double au, double av, double bu, double bv) {
  return au * bv - av * bu;
}
double dot(double au, double av, double bu, double bv) {
  return au * bu + av * bv;
}

}  // namespace

int orientation(const PlanarPoint& a, const PlanarPoint& b) {
  const double left = a.u * b.v;
  const double right = a.v * b.u;
  const double determinant = left - right;
  const double bound = determinant_rounding * (std::abs(left) + std::abs(right));
  if (std::abs(determinant) > bound && bound > least_bound) return determinant > 0 ? 1 : -1;
  if (bound > least_exact) {
    // The difference of products that are so nearly equal is exact; what is missing are their rounding errors.
    const double rest = std::fma(a.v, b.u, -right) - std::fma(a.u, b.v, -left);
    if (determinant != rest) return determinant > rest ? 1 : -1;
    if (rest == 0) return 0;
  }
  return static_cast<int>(CGAL::orientation(Kernel::Point_2(0, 0), toCgal(a), toCgal(b)));
}

CircleSide sideOfCircle(const PlanarPoint& a, const PlanarPoint& b, const PlanarPoint& c) {
  const double abu = a.u - b.u, abv = a.v - b.v;
  const double cbu = c.u - b.u, cbv = c.v - b.v;
  const double cross_p = determinantOf(a.u, a.v, c.u, c.v), dot_p = dot(a.u, a.v, c.u, c.v);
  const double cross_b = determinantOf(cbu, cbv, abu, abv), dot_b = dot(cbu, cbv, abu, abv);
  // Sine and cosine of the sum of the angles at p and b, times the product of the four sides.
  const double sine = cross_p * dot_b + dot_p * cross_b;
  const double cosine = dot_p * dot_b - cross_p * cross_b;
  const double sides =
      dot(a.u, a.v, a.u, a.v) * dot(c.u, c.v, c.u, c.v) * dot(abu, abv, abu, abv) * dot(cbu, cbv, cbu, cbv);
  const bool in_range = sides > least_sides && sides < most_sides;
  if (in_range && sine * sine > tie_angle * tie_angle * sides) {
    return sine > 0 ? CircleSide::inside : CircleSide::outside;
  }
  // Within the band the sum is near 0, pi or 2 pi. Near pi it is a tie, unless all four points are nearly collinear.
  const double cross_a = determinantOf(-a.u, -a.v, -abu, -abv);
  const double sides_a = dot(a.u, a.v, a.u, a.v) * dot(abu, abv, abu, abv);
  if (in_range && cosine < 0 && cross_a * cross_a > flat_sine * flat_sine * sides_a) return CircleSide::tie;
  switch (CGAL::side_of_oriented_circle(Kernel::Point_2(0, 0), toCgal(a), toCgal(b), toCgal(c))) {
    case CGAL::ON_POSITIVE_SIDE:
      return CircleSide::inside;
    case CGAL::ON_NEGATIVE_SIDE:
      return CircleSide::outside;
    default:
      return CircleSide::tie;
  }
}

}  // namespace tufted
