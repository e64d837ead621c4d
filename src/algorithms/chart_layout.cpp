#include "algorithms/chart_layout.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>

#include "algorithms/chart_metric.h"
#include "base/cross.h"

namespace tufted {
namespace {

/// The gap between two charts, as a part of the side of a square with the total area of their bounding boxes.
constexpr double gap_share = 0.02;
/// A triangle whose height is below this part of the extent of the map counts as collapsed, unless it is as low on the
/// surface. Single-precision coordinates and eigenvectors are no more accurate.
constexpr double least_height = 1e-7;

/// The largest distance of a corner of a chart from its first corner.
/// @param at returns the position of a point; NaN where it has none
template <class At>
double extentOf(const Chart& chart, const At& at) {
  auto first = at(chart.triangles[0][0]);
  double extent = 0;
  for (const auto& corners : chart.triangles) {
    for (const int i : corners) {
      if (first.hasNaN()) first = at(i);
      extent = std::max(extent, (at(i) - first).norm());
    }
  }
  return extent;
}

double extentOnSurface(const Points& positions, const Chart& chart, int exponent) {
  const Eigen::RowVector3d origin = positions.row(chart.triangles[0][0]);
  return extentOf(chart, [&](int i) -> Eigen::RowVector3d {
    const Eigen::RowVector3d p = positions.row(i) - origin;
    return {std::ldexp(p.x(), -exponent), std::ldexp(p.y(), -exponent), std::ldexp(p.z(), -exponent)};
  });
}

/// Whether a triangle has collapsed in the plane, but not on the surface.
/// @param surface, plane extents of the chart
/// @param a, b two sides in the plane
bool hasCollapsed(const TriangleSides& sides, double surface, const Eigen::RowVector2d& a, const Eigen::RowVector2d& b,
                  double plane) {
  const double longest = std::max({a.norm(), b.norm(), (a - b).norm()});
  return std::abs(cross(a, b)) <= least_height * plane * longest &&
         2 * sides.area >= least_height * surface * *std::max_element(sides.opposite.begin(), sides.opposite.end());
}

}  // namespace

Collapse placeAlone(const Points& positions, const Chart& chart, int exponent, const std::vector<int>& local,
                    Eigen::MatrixX2d& uv) {
  // Centres coordinates at their mean and scales them by the largest, against overflow.
  const Eigen::RowVector2d mean = uv.colwise().mean();
  uv.rowwise() -= mean;
  const double size = uv.cwiseAbs().maxCoeff();
  if (size > 0) uv /= size;
  const double surface = extentOnSurface(positions, chart, exponent);
  const double plane = extentOf(chart, [&](int i) -> Eigen::RowVector2d { return uv.row(local[i]); });
  double wanted = 0, area = 0, lost = 0;
  Collapse collapse;
  for (const auto& corners : chart.triangles) {
    const TriangleSides sides = measureTriangle(positions, corners, exponent);
    wanted += sides.area;
    const auto at = [&](int k) -> Eigen::RowVector2d { return uv.row(local[corners[k]]); };
    area += cross(at(1) - at(0), at(2) - at(0)) / 2;
    if (!hasCollapsed(sides, surface, at(1) - at(0), at(2) - at(0), plane)) continue;
    ++collapse.triangles;
    lost += sides.area;
  }
  if (!(area > 0 && std::isfinite(area))) return {std::ssize(chart.triangles), 1};
  collapse.area_share = wanted > 0 ? lost / wanted : 0;
  uv *= std::sqrt(wanted / area);

  using Complex = std::complex<double>;
  const auto forTriangles = [&](const auto& visit) {
    for (const auto& corners : chart.triangles) {
      const auto at = [&](int k) -> Eigen::RowVector2d { return uv.row(local[corners[k]]); };
      const Eigen::RowVector2d centre = (at(0) + at(1) + at(2)) / 3;
      visit(std::abs(cross(at(1) - at(0), at(2) - at(0))), Complex(centre.x(), centre.y()));
    }
  };
  double sum = 0;
  Complex centre = 0, second = 0;
  forTriangles([&](double weight, const Complex& z) { sum += weight, centre += weight * z; });
  if (sum > 0) centre /= sum;
  forTriangles([&](double weight, const Complex& z) { second += weight * (z - centre) * (z - centre); });
  const Complex turn = std::abs(second) > 0 ? std::polar(1.0, -std::arg(second) / 2) : Complex(1);
  double third = 0;
  forTriangles([&](double weight, const Complex& z) { third += weight * std::pow(((z - centre) * turn).real(), 3); });
  const Complex whole = third < 0 ? -turn : turn;
  for (Eigen::Index i = 0; i < uv.rows(); ++i) {
    const Complex z = Complex(uv(i, 0), uv(i, 1)) * whole;
    uv.row(i) << z.real(), z.imag();
  }
  const Eigen::RowVector2d least = uv.colwise().minCoeff();
  uv.rowwise() -= least;
  return collapse;
}

void placeBesideEachOther(std::vector<Eigen::MatrixX2d>& charts, const std::vector<int>& exponents) {
  if (charts.empty()) return;
  const int unit = *std::max_element(exponents.begin(), exponents.end());
  std::vector<Eigen::RowVector2d> extent(charts.size());
  double total = 0, widest = 0;
  for (std::size_t c = 0; c < charts.size(); ++c) {
    extent[c] = (charts[c].colwise().maxCoeff() * std::ldexp(1.0, exponents[c] - unit)).eval();
    total += extent[c].prod();
    widest = std::max(widest, extent[c].x());
  }
  const double gap = gap_share * std::sqrt(total), width = std::max(widest, std::sqrt(total));
  std::vector<std::size_t> order(charts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // The first chart stays at the origin.
  std::stable_sort(order.begin() + 1, order.end(),
                   [&](std::size_t a, std::size_t b) { return extent[a].y() > extent[b].y(); });
  double u = 0, v = 0, height = 0;
  for (const std::size_t c : order) {
    if (u > 0 && u + extent[c].x() > width) {
      v += height + gap;
      u = height = 0;
    }
    charts[c] *= std::ldexp(1.0, exponents[c] - unit);
    charts[c].rowwise() += Eigen::RowVector2d(u, v);
    for (double& value : charts[c].reshaped()) value = std::ldexp(value, unit);
    u += extent[c].x() + gap;
    height = std::max(height, extent[c].y());
  }
}

void measureMaps(const Points& positions, const std::vector<const Chart*>& charts, const std::vector<int>& owner,
                 const Eigen::MatrixX2d& uv, ParameterizationReport& report) {
  double error = 0, weights = 0;
  int largest = 0;
  double greatest = 0;
  for (const Chart* chart : charts)
    for (const auto& corners : chart->triangles)
      for (const int i : corners) greatest = std::max(greatest, uv.row(i).cwiseAbs().maxCoeff());
  const int plane = greatest > 0 ? std::ilogb(greatest) : 0;
  for (std::size_t c = 0; c < charts.size(); ++c) {
    const int exponent = exponentOf(positions, charts[c]->triangles);
    if (c == 0) largest = exponent;
    const double surface = extentOnSurface(positions, *charts[c], exponent);
    const auto place = [&](int i) -> Eigen::RowVector2d {
      return {std::ldexp(uv(i, 0), -plane), std::ldexp(uv(i, 1), -plane)};
    };
    const double extent = extentOf(*charts[c], [&](int i) -> Eigen::RowVector2d {
      return owner[i] == static_cast<int>(c) ? place(i) : Eigen::RowVector2d::Constant(NAN);
    });
    for (const auto& corners : charts[c]->triangles) {
      if (owner[corners[0]] != static_cast<int>(c) || owner[corners[1]] != static_cast<int>(c) ||
          owner[corners[2]] != static_cast<int>(c))
        continue;
      ++report.triangles;
      const auto side = [&](int k) -> Eigen::RowVector2d { return place(corners[k]) - place(corners[0]); };
      if (hasCollapsed(measureTriangle(positions, corners, exponent), surface, side(1), side(2), extent)) {
        ++report.collapsed;
        continue;
      }
      Eigen::Matrix2d image;
      image << side(1).transpose(), side(2).transpose();
      const double determinant = image.determinant();
      if (!(determinant > 0)) {
        ++report.flipped;
        continue;
      }
      // The same triangle on the surface, laid out in its plane.
      const auto edge = [&](int k) -> Eigen::Vector3d {
        const Eigen::RowVector3d difference = positions.row(corners[k]) - positions.row(corners[0]);
        return {std::ldexp(difference.x(), -exponent), std::ldexp(difference.y(), -exponent),
                std::ldexp(difference.z(), -exponent)};
      };
      const Eigen::Vector3d a = edge(1), b = edge(2);
      const double base = a.norm(), area = a.cross(b).norm();
      if (!(area > 0)) continue;
      Eigen::Matrix2d flat;
      flat << base, a.dot(b) / base, 0, area / base;
      const Eigen::Matrix2d map = image * flat.inverse();
      const double squares = map.squaredNorm(), product = map.determinant();
      if (!(product > 0) || !std::isfinite(squares)) continue;
      const double ratio =
          (squares + std::sqrt(std::max(0.0, squares * squares - 4 * product * product))) / 2 / product;
      const double weight = std::ldexp(area, 2 * (exponent - largest));
      error += weight * ratio;
      weights += weight;
    }
  }
  report.quasi_conformal_error = weights > 0 ? error / weights : 1;
}

}  // namespace tufted
