#include "bench/real_shapes.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "oracles/oracles.h"
#include "tufted/components.h"
#include "tufted/io/read.h"
#include "tufted/laplacian.h"
#include "tufted/spectrum.h"

namespace tufted::bench {
namespace {

/// The mesh that gives the eigenvalues of a shape is refined to at least this many faces.
constexpr Eigen::Index fine_faces = 60000;

/// Cuts each triangle into four at the midpoints of its sides.
shapes::Mesh divided(const shapes::Mesh& mesh) {
  std::map<std::pair<int, int>, int> middle;
  std::vector<Eigen::RowVector3d> points;
  for (Eigen::Index i = 0; i < mesh.points.rows(); ++i) points.emplace_back(mesh.points.row(i));
  const auto middleOf = [&](int a, int b) {
    const auto [place, is_new] = middle.try_emplace(std::minmax(a, b), static_cast<int>(points.size()));
    if (is_new) points.emplace_back((mesh.points.row(a) + mesh.points.row(b)) / 2);
    return place->second;
  };
  shapes::Mesh fine;
  fine.triangles.resize(4 * mesh.triangles.rows(), 3);
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    const int a = mesh.triangles(f, 0), b = mesh.triangles(f, 1), c = mesh.triangles(f, 2);
    const int ab = middleOf(a, b), bc = middleOf(b, c), ca = middleOf(c, a);
    fine.triangles.middleRows<4>(4 * f) << a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca;
  }
  fine.points.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i) fine.points.row(static_cast<Eigen::Index>(i)) = points[i];
  return fine;
}

/// x^T M x with the consistent mass matrix of linear elements.
double consistentNorm(const shapes::Mesh& mesh, const VectorXd& x) {
  double sum = 0;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    const Eigen::RowVector3i t = mesh.triangles.row(f);
    const double area = oracles::surfaceArea(mesh.points, t);
    const Eigen::Vector3d values(x[t[0]], x[t[1]], x[t[2]]);
    sum += area / 12 * (values.squaredNorm() + values.sum() * values.sum());
  }
  return sum;
}

/// Eigenvalues by linear elements: those with lumped masses are too small, those with consistent masses too large by
/// about as much, so the mean of both is taken.
VectorXd eigenvaluesOf(shapes::Mesh mesh, int count) {
  while (mesh.triangles.rows() < fine_faces) mesh = divided(mesh);
  const Spectrum found = spectrum(meshLaplacian(mesh.points, mesh.triangles), count, {.null_space = false});
  VectorXd values = found.values;
  for (int i = 0; i < count; ++i) values[i] *= (1 + 1 / consistentNorm(mesh, found.vectors.col(i))) / 2;
  return values;
}

shapes::Mesh largestComponent(const Geometry& geometry) {
  const Laplacian laplacian = meshLaplacian(geometry.points, geometry.triangles, {.weld = true});
  const std::vector<int> label = componentLabels(laplacian);
  std::map<int, double> area;
  for (std::size_t i = 0; i < label.size(); ++i)
    if (label[i] >= 0) area[label[i]] += laplacian.M[static_cast<Eigen::Index>(i)];
  const int largest = std::max_element(area.begin(), area.end(), [](const auto& a, const auto& b) {
                        return a.second < b.second;
                      })->first;
  shapes::Mesh mesh;
  std::vector<int> number(label.size(), -1);
  int points = 0;
  mesh.points.resize(geometry.points.rows(), 3);
  mesh.triangles.resize(geometry.triangles.rows(), 3);
  Eigen::Index triangles = 0;
  std::map<std::array<double, 3>, int> vertex;  // joins equal vertices
  for (std::size_t i = 0; i < label.size(); ++i) {
    if (label[i] != largest) continue;
    const Eigen::RowVector3d x = geometry.points.row(static_cast<Eigen::Index>(i));
    const auto [place, is_new] = vertex.try_emplace({x[0], x[1], x[2]}, points);
    if (is_new) mesh.points.row(points++) = x;
    number[i] = place->second;
  }
  for (Eigen::Index f = 0; f < geometry.triangles.rows(); ++f) {
    const auto numbered = geometry.triangles.row(f).unaryExpr([&](int i) { return number[i]; }).eval();
    if (numbered.minCoeff() < 0 || numbered[0] == numbered[1] || numbered[1] == numbered[2] ||
        numbered[2] == numbered[0])
      continue;
    mesh.triangles.row(triangles++) = numbered;
  }
  mesh.points.conservativeResize(points, 3);
  mesh.triangles.conservativeResize(triangles, 3);
  const Eigen::RowVector3d middle = mesh.points.colwise().mean();
  mesh.points.rowwise() -= middle;
  mesh.points /= mesh.points.cwiseAbs().maxCoeff();
  return mesh;
}

}  // namespace

std::vector<ShapeFile> shapeFiles(const std::filesystem::path& shapes) {
  const std::filesystem::path cgal = std::filesystem::path(TUFTED_CGAL_DATA_DIR) / "meshes";
  const auto choosing = {shapes / "elephant.obj",   shapes / "nefertiti.obj", shapes / "rocker-arm.obj",
                         shapes / "suzanne.obj",    cgal / "armadillo.off",   cgal / "bull.off",
                         cgal / "cow.off",          cgal / "elk.off",         cgal / "hand.off",
                         cgal / "knot2.off",        cgal / "man.off",         cgal / "pinion_small.off",
                         cgal / "anchor_dense.off", cgal / "joint.off"};
  const auto held_out = {shapes / "bumpy-cube.obj",
                         shapes / "fertility.off",
                         shapes / "ogre.obj",
                         shapes / "spot.obj",
                         cgal / "ChineseDragon-10kv.off",
                         cgal / "camel.off",
                         cgal / "dino.off",
                         cgal / "femur.off",
                         cgal / "homer.off",
                         cgal / "lion-head.off",
                         cgal / "pig.off",
                         cgal / "rotor_small.off",
                         cgal / "couplingdown.off",
                         cgal / "bunny00.off"};
  std::vector<ShapeFile> files;
  for (const auto& path : choosing) files.push_back({path, Half::choosing});
  for (const auto& path : held_out) files.push_back({path, Half::held_out});
  std::erase_if(files, [](const ShapeFile& file) { return !exists(file.path); });
  return files;
}

RealShape realShape(const std::filesystem::path& path, int eigenvalues) {
  RealShape shape{path.stem().string(), largestComponent(read(path, ReadAs::mesh)), 0, {}};
  shape.area = oracles::surfaceArea(shape.mesh.points, shape.mesh.triangles);
  if (eigenvalues > 0) shape.eigenvalues = eigenvaluesOf(shape.mesh, eigenvalues);
  return shape;
}

RealShape smoothed(const RealShape& shape, int faces) {
  using Kernel = CGAL::Simple_cartesian<double>;
  CGAL::Surface_mesh<Kernel::Point_3> fine;
  using Vertex = decltype(fine)::Vertex_index;
  RealShape result{shape.name, {}, 0, {}};
  const shapes::Mesh& mesh = shape.mesh;
  for (const auto& p : mesh.points.rowwise()) fine.add_vertex({p[0], p[1], p[2]});
  for (const auto& t : mesh.triangles.rowwise())
    if (fine.add_face(Vertex(t[0]), Vertex(t[1]), Vertex(t[2])) == fine.null_face()) return result;
  while (static_cast<int>(fine.number_of_faces()) < faces)
    CGAL::Subdivision_method_3::Loop_subdivision(fine, CGAL::parameters::number_of_iterations(1));
  result.mesh.points.resize(fine.number_of_vertices(), 3);
  result.mesh.triangles.resize(fine.number_of_faces(), 3);
  for (const Vertex v : fine.vertices()) {
    const Kernel::Point_3& p = fine.point(v);
    result.mesh.points.row(v) << p.x(), p.y(), p.z();
  }
  Eigen::Index row = 0;
  for (const auto f : fine.faces()) {
    int corner = 0;
    for (const Vertex v : fine.vertices_around_face(fine.halfedge(f)))
      result.mesh.triangles(row, corner++) = static_cast<int>(v);
    ++row;
  }
  result.area = oracles::surfaceArea(result.mesh.points, result.mesh.triangles);
  return result;
}

shapes::Cloud sampleOf(const RealShape& shape, int points, double noise, std::uint64_t seed) {
  const shapes::Cloud cloud = shapes::sampleMesh(shape.mesh, points, seed);
  if (noise == 0) return cloud;
  return shapes::withNoise(cloud, noise * std::sqrt(shape.area / points), seed + 100);
}

}  // namespace tufted::bench
