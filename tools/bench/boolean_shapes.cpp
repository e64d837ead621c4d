#include "bench/boolean_shapes.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/locate.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "shapes/random.h"
#include "shapes/shapes.h"

namespace tufted::bench {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

/// Number of segments of an edge of the cube.
constexpr int parts = 20;
/// Edges with a dihedral angle above this, in degrees, are creases, which remeshing keeps.
constexpr double crease = 30;

Surface surfaceOf(const Points& points, const Triangles& triangles) {
  Surface surface;
  for (const auto& p : points.rowwise()) surface.add_vertex({p.x(), p.y(), p.z()});
  for (const auto& t : triangles.rowwise())
    surface.add_face(Surface::Vertex_index(t[0]), Surface::Vertex_index(t[1]), Surface::Vertex_index(t[2]));
  return surface;
}

BooleanMesh meshOf(Surface surface) {
  surface.collect_garbage();
  BooleanMesh mesh;
  mesh.points.resize(surface.number_of_vertices(), 3);
  mesh.triangles.resize(surface.number_of_faces(), 3);
  for (const auto v : surface.vertices())
    for (int k = 0; k < 3; ++k) mesh.points(v.idx(), k) = surface.point(v)[k];
  for (const auto f : surface.faces()) {
    int corner = 0;
    for (const auto v : surface.vertices_around_face(surface.halfedge(f))) mesh.triangles(f.idx(), corner++) = v.idx();
  }
  return mesh;
}

Surface remeshed(Surface surface) {
  const auto is_crease = surface.add_property_map<Surface::Edge_index, bool>("e:is_crease", false).first;
  PMP::detect_sharp_edges(surface, crease, is_crease);
  PMP::isotropic_remeshing(
      surface.faces(), 1.0 / parts, surface,
      CGAL::parameters::number_of_iterations(10).edge_is_constrained_map(is_crease).number_of_relaxation_steps(3));
  return surface;
}

BooleanSolid solidOf(const char* name, Surface first, Surface second, bool is_union, const Plane& moves) {
  Surface cut;
  const bool made = is_union ? PMP::corefine_and_compute_union(first, second, cut)
                             : PMP::corefine_and_compute_difference(first, second, cut);
  if (!made) throw std::runtime_error(std::string(name) + ": CGAL cannot tell the boolean result");
  cut.collect_garbage();
  return {name, meshOf(cut), meshOf(remeshed(cut)), {Eigen::Vector3d::UnitZ(), 0}, moves};
}

}  // namespace

BooleanSolid cubeAndBall(bool is_union, std::uint64_t seed) {
  constexpr double radius = 0.35;
  shapes::Random random(seed);
  const shapes::Mesh cube = shapes::cubeMesh(parts, shapes::Quality::good, seed);
  shapes::Mesh ball = shapes::icosphere(3);
  const Eigen::RowVector3d centre(1, random.uniform(0.45, 0.55), random.uniform(0.45, 0.55));
  ball.points = (radius * ball.points).rowwise() + centre;
  return solidOf(is_union ? "cube and ball" : "cube without a ball", surfaceOf(cube.points, cube.triangles),
                 surfaceOf(ball.points, ball.triangles), is_union, {Eigen::Vector3d::UnitZ(), -1});
}

BooleanSolid cubeAndPost(std::uint64_t seed) {
  constexpr double radius = 0.3, length = 1.2, inside = 0.4, inclination = 0.3;
  shapes::Random random(seed);
  const shapes::Mesh cube = shapes::cubeMesh(parts, shapes::Quality::good, seed);
  shapes::Mesh post = shapes::cubeMesh(parts / 2, shapes::Quality::good, seed);
  const double direction = random.uniform(0, 2 * M_PI);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(inclination, Eigen::Vector3d(std::cos(direction), std::sin(direction), 0)).toRotationMatrix();
  const Eigen::Vector3d middle(0.5, 0.5, 1);  // middle of the cube's top
  for (auto&& p : post.points.rowwise()) {
    // Maps squares to circles.
    Eigen::Vector3d q(2 * p.x() - 1, 2 * p.y() - 1, length * p.z() - inside);
    const double norm = q.head<2>().norm();
    if (norm > 0) q.head<2>() *= radius * q.head<2>().lpNorm<Eigen::Infinity>() / norm;
    p = (turn * q + middle).transpose();
  }
  const Eigen::Vector3d up = turn.col(2);
  return solidOf("cube and post", surfaceOf(cube.points, cube.triangles), surfaceOf(post.points, post.triangles), true,
                 {up, middle + (length - inside) * up});
}

std::vector<int> pointsIn(const Plane& plane, const Points& points) {
  constexpr double rounding = 1e-9;
  std::vector<int> found;
  for (int i = 0; i < points.rows(); ++i)
    if (plane.absDistance(points.row(i).transpose()) < rounding) found.push_back(i);
  return found;
}

Points valuesAt(const BooleanMesh& mesh, const Points& values, const Points& places) {
  const Surface surface = surfaceOf(mesh.points, mesh.triangles);
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<Surface>>> tree;
  PMP::build_AABB_tree(surface, tree);
  Points found = Points::Zero(places.rows(), values.cols());
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    const Kernel::Point_3 place(places(i, 0), places(i, 1), places(i, 2));
    const auto [face, shares] = PMP::locate_with_AABB_tree(place, tree, surface);
    auto corner = surface.halfedge(face);
    for (int k = 0; k < 3; ++k, corner = surface.next(corner))
      found.row(i) += shares[k] * values.row(surface.source(corner).idx());
  }
  return found;
}

}  // namespace tufted::bench
