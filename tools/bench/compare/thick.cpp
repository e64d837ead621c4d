// Figure 1 of the paper: the Laplacian of a nonmanifold mesh beside that of tetrahedra that fill a layer around it.
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/make_mesh_3.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "base/stage_clock.h"
#include "bench/compare/solves.h"
#include "bench/compare/tables.h"
#include "shapes/shapes.h"
#include "tufted/tufted.h"

namespace tufted::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Domain = CGAL::Labeled_mesh_domain_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;
namespace parameters = CGAL::parameters;

struct Tetrahedra {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 4>> cells;
};

/// Tetrahedra of about the size of the thickness that fill all places within half of it of the mesh.
Tetrahedra thickened(const shapes::Mesh& mesh, double thickness) {
  const auto corner = [&](int f, int c) {
    const auto p = mesh.points.row(mesh.triangles(f, c));
    return Kernel::Point_3(p[0], p[1], p[2]);
  };
  std::vector<Kernel::Triangle_3> triangles;
  for (int f = 0; f < mesh.triangles.rows(); ++f) triangles.emplace_back(corner(f, 0), corner(f, 1), corner(f, 2));
  using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Kernel::Triangle_3>::const_iterator>;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree(triangles.begin(), triangles.end());
  tree.accelerate_distance_queries();
  const double square = thickness * thickness / 4;
  const auto outside = [&](const Kernel::Point_3& p) { return tree.squared_distance(p) - square; };

  const Eigen::RowVector3d middle = mesh.points.colwise().mean();
  const double radius = (mesh.points.rowwise() - middle).rowwise().norm().maxCoeff() + thickness;
  const Domain domain = Domain::create_implicit_mesh_domain(
      outside, Kernel::Sphere_3({middle[0], middle[1], middle[2]}, 2 * radius * radius),
      parameters::relative_error_bound = 1e-5);
  const Criteria criteria(parameters::facet_angle = 25, parameters::facet_size = thickness,
                          parameters::facet_distance = thickness / 20, parameters::cell_radius_edge_ratio = 2,
                          parameters::cell_size = thickness);
  const Complex complex = CGAL::make_mesh_3<Complex>(domain, criteria);

  Tetrahedra result;
  std::map<Triangulation::Vertex_handle, int> numbers;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell) {
    std::array<int, 4> corners;
    for (int c = 0; c < 4; ++c) {
      const auto [place, is_new] = numbers.try_emplace(cell->vertex(c), static_cast<int>(numbers.size()));
      if (is_new) {
        const auto& p = cell->vertex(c)->point();
        result.points.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
      }
      corners[c] = place->second;
    }
    result.cells.push_back(corners);
  }
  return result;
}

/// Stiffness and lumped masses of linear elements.
Operators operatorsOf(const Tetrahedra& mesh) {
  const auto n = static_cast<Eigen::Index>(mesh.points.size());
  std::vector<Eigen::Triplet<double>> entries;
  VectorXd masses = VectorXd::Zero(n);
  for (const std::array<int, 4>& cell : mesh.cells) {
    Eigen::Matrix3d edges;
    for (int c = 0; c < 3; ++c) edges.row(c) = mesh.points[cell[c + 1]] - mesh.points[cell[0]];
    const double volume = std::abs(edges.determinant()) / 6;
    Eigen::Matrix<double, 3, 4> gradients;
    gradients.rightCols<3>() = edges.inverse();
    gradients.col(0) = -gradients.rightCols<3>().rowwise().sum();
    for (int a = 0; a < 4; ++a) {
      masses[cell[a]] += volume / 4;
      for (int b = 0; b < 4; ++b)
        entries.emplace_back(cell[a], cell[b], volume * gradients.col(a).dot(gradients.col(b)));
    }
  }
  SparseMatrix L(n, n);
  L.setFromTriplets(entries.begin(), entries.end());
  return {L, masses};
}

/// The mean of |a - b| / b over the positive eigenvalues.
double meanDifference(const VectorXd& a, const VectorXd& b) {
  double sum = 0;
  int positive = 0;
  for (Eigen::Index k = 0; k < std::min(a.size(), b.size()); ++k) {
    if (!(b[k] > 1e-6 * b[b.size() - 1])) continue;
    sum += std::abs(a[k] - b[k]) / b[k];
    ++positive;
  }
  return sum / positive;
}

}  // namespace

Table printThick(const Settings&) {
  constexpr int count = 21;
  Table table({"mesh", "thickness", "tetrahedra", "volume over thickness and area", "20 eigenvalues differ by",
               "tetrahedra, s", "tufted, s"});
  for (const shapes::Mesh& mesh : {shapes::book(3, 24), shapes::book(5, 24), shapes::fins(24)}) {
    const Stopwatch own;
    const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
    const VectorXd ours = spectrum(laplacian, count).values;
    const double own_seconds = own.seconds();
    for (const double thickness : {0.2, 0.1, 0.05}) {
      const Stopwatch watch;
      const Tetrahedra tetrahedra = thickened(mesh, thickness);
      const Operators operators = operatorsOf(tetrahedra);
      const VectorXd theirs = eigenvaluesOf(operators, true, count).values;
      table.row({mesh.name, Cell("%g", thickness), static_cast<int>(tetrahedra.cells.size()),
                 Cell("%.3f", operators.M.sum() / thickness / laplacian.M.sum()), percent(meanDifference(ours, theirs)),
                 Cell("%.1f", watch.seconds()), Cell("%.2f", own_seconds)});
    }
  }
  return table;
}

}  // namespace tufted::bench
