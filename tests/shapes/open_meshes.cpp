#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "shapes/mesh_builder.h"
#include "shapes/spectra.h"

namespace tufted::shapes {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
using Parametrization = std::function<Vector3d(double u, double v)>;

MeshBuilder squareBuilder(int n) {
  MeshBuilder builder;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) builder.add({i / double(n), j / double(n), 0});
  }
  builder.grid(n, n, [n](int i, int j) { return j * (n + 1) + i; });
  return builder;
}

Mesh squareLike(const MeshBuilder& builder, const std::string& shape, int n) {
  Mesh mesh = builder.finish(shape);
  mesh.area = 1;
  mesh.boundary_edges = 4 * n;
  mesh.euler = 1;
  return mesh;
}

void insertTriangle(Mesh& mesh, Eigen::Index at, int a, int b, int c) {
  const Eigen::Index after = mesh.triangles.rows() - at;
  const Triangles rest = mesh.triangles.bottomRows(after);
  mesh.triangles.conservativeResize(mesh.triangles.rows() + 1, 3);
  mesh.triangles.row(at) << a, b, c;
  mesh.triangles.bottomRows(after) = rest;
}

// Area by the midpoint rule with central differences, accurate to about 1e-6.
double parametricArea(const Parametrization& at, double u_span, double v_low, double v_high) {
  constexpr int steps = 400;
  constexpr double h = 1e-5;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      const double u = u_span * (i + 0.5) / steps, v = v_low + (v_high - v_low) * (j + 0.5) / steps;
      const Vector3d du = (at(u + h, v) - at(u - h, v)) / (2 * h), dv = (at(u, v + h) - at(u, v - h)) / (2 * h);
      sum += du.cross(dv).norm();
    }
  }
  return sum * u_span * (v_high - v_low) / (steps * steps);
}

}  // namespace

Mesh gridSquare(int n) {
  Mesh mesh = squareLike(squareBuilder(n), "grid_square", n);
  mesh.eigenvalues = rectangleSpectrum(1, 1, known_eigenvalues);
  return mesh;
}

Mesh book(int pages, int n) {
  MeshBuilder builder;
  for (int j = 0; j <= n; ++j) builder.add({0, 0, j / double(n)});
  for (int page = 0; page < pages; ++page) {
    const double angle = 2 * pi * page / pages;
    const int first = (n + 1) * (1 + page * n);
    for (int i = 1; i <= n; ++i) {
      for (int j = 0; j <= n; ++j) builder.add({i * std::cos(angle) / n, i * std::sin(angle) / n, j / double(n)});
    }
    builder.grid(n, n, [=](int i, int j) { return i == 0 ? j : first + (i - 1) * (n + 1) + j; });
  }
  Mesh mesh = builder.finish("book");
  mesh.name.append("_").append(std::to_string(pages));
  mesh.area = pages;
  mesh.boundary_edges = pages * 3 * n + (pages == 1 ? n : 0);
  mesh.nonmanifold_edges = pages > 2 ? n : 0;
  mesh.euler = 1;
  mesh.eigenvalues = bookSpectrum(pages, 1, 1, known_eigenvalues);
  return mesh;
}

Mesh fins(int n) {
  MeshBuilder builder = squareBuilder(n);
  const int height = n / 4;
  for (const int row : {n / 4, n - n / 4}) {
    int first = 0;
    for (int k = 1; k <= height; ++k) {
      for (int i = 0; i <= n; ++i) {
        const int index = builder.add({i / double(n), row / double(n), k / double(n)});
        if (k == 1 && i == 0) first = index;
      }
    }
    builder.grid(n, height, [=](int i, int k) { return k == 0 ? row * (n + 1) + i : first + (k - 1) * (n + 1) + i; });
  }
  Mesh mesh = squareLike(builder, "fins", n);
  mesh.area = 1 + 2 * height / double(n);
  mesh.boundary_edges += 2 * (n + 2 * height);
  mesh.nonmanifold_edges = 2 * n;
  return mesh;
}

Mesh bowTie() {
  MeshBuilder builder;
  for (const Vector3d& p :
       {Vector3d(0, 0, 0), Vector3d(1, -0.5, 0), Vector3d(1, 0.5, 0), Vector3d(-1, 0.5, 0), Vector3d(-1, -0.5, 0)}) {
    builder.add(p);
  }
  builder.triangle(0, 1, 2);
  builder.triangle(0, 3, 4);
  Mesh mesh = builder.finish("bow_tie");
  mesh.area = 1;
  mesh.boundary_edges = 6;
  mesh.nonmanifold_vertices = 1;
  mesh.euler = 1;
  return mesh;
}

Mesh bowTieCones(int sides) {
  MeshBuilder builder;
  const int apex = builder.add(Vector3d::Zero());
  for (const int side : {-1, 1}) {
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * pi * i / sides;
      builder.add({0.5 * std::cos(angle), 0.5 * std::sin(angle), double(side)});
    }
    const int first = side < 0 ? 1 : 1 + sides;
    for (int i = 0; i < sides; ++i) builder.triangle(apex, first + i, first + (i + 1) % sides);
  }
  Mesh mesh = builder.finish("bow_tie_cones");
  mesh.area = 2 * sides * 0.5 * std::sin(pi / sides) * std::hypot(1, 0.5 * std::cos(pi / sides));
  mesh.boundary_edges = 2 * sides;
  mesh.nonmanifold_vertices = 1;
  mesh.euler = 1;
  return mesh;
}

Mesh moebius(int n) {
  const Parametrization at = [](double u, double v) {
    const double w = 1 + v * std::cos(u / 2);
    return Vector3d(w * std::cos(u), w * std::sin(u), v * std::sin(u / 2));
  };
  MeshBuilder builder;
  for (int i = 0; i < 4 * n; ++i) {
    for (int j = 0; j <= n; ++j) builder.add(at(2 * pi * i / (4 * n), 0.8 * j / n - 0.4));
  }
  builder.grid(4 * n, n, [n](int i, int j) { return i < 4 * n ? i * (n + 1) + j : n - j; });
  Mesh mesh = builder.finish("moebius");
  mesh.area = parametricArea(at, 2 * pi, -0.4, 0.4);
  mesh.flat = false;
  mesh.boundary_edges = 8 * n;
  mesh.orientable = false;
  return mesh;
}

Mesh kleinBottle(int n) {
  const Parametrization at = [](double u, double v) {
    const double x = std::cos(u / 2) * std::sin(v) - std::sin(u / 2) * std::sin(2 * v);
    const double z = std::sin(u / 2) * std::sin(v) + std::cos(u / 2) * std::sin(2 * v);
    return Vector3d((2 + x) * std::cos(u), (2 + x) * std::sin(u), z);
  };
  MeshBuilder builder;
  // Half a step away from v = 0 and v = pi, where the surface crosses itself. After a turn v becomes -v.
  for (int i = 0; i < 2 * n; ++i) {
    for (int j = 0; j < n; ++j) builder.add(at(pi * i / n, 2 * pi * (j + 0.5) / n));
  }
  builder.grid(2 * n, n, [n](int i, int j) { return i < 2 * n ? i * n + j % n : n - 1 - j % n; });
  Mesh mesh = builder.finish("klein_bottle");
  mesh.area = parametricArea(at, 2 * pi, 0, 2 * pi);
  mesh.flat = false;
  mesh.orientable = false;
  return mesh;
}

Mesh slivers(int n) {
  Mesh mesh = squareLike(squareBuilder(n), "slivers", n);
  const Eigen::Index points = mesh.points.rows();
  mesh.points.conservativeResize(points + n, 3);
  for (int i = 0; i < n; ++i) {
    // Splits the triangle above the i-th edge of the middle row at a point very close to that edge.
    const Eigen::Index face = 2 * (n / 2 * n + i);
    const Eigen::RowVector3i corner = mesh.triangles.row(face);
    const int middle = static_cast<int>(points) + i;
    mesh.points.row(middle) << (i + 0.5) / n, 0.5 + 1e-10, 0;
    mesh.triangles.row(face) << corner[0], corner[1], middle;
    insertTriangle(mesh, mesh.triangles.rows(), corner[1], corner[2], middle);
    insertTriangle(mesh, mesh.triangles.rows(), corner[2], corner[0], middle);
  }
  return mesh;
}

Mesh zeroLengthEdges(int n) {
  MeshBuilder builder;
  for (int j = 0; j <= n + 1; ++j) {
    for (int i = 0; i <= n; ++i) builder.add({i / double(n), (j <= n / 2 ? j : j - 1) / double(n), 0});
  }
  builder.grid(n, n + 1, [n](int i, int j) { return j * (n + 1) + i; });
  Mesh mesh = squareLike(builder, "zero_length_edges", n);
  mesh.boundary_edges += 2;
  return mesh;
}

Mesh repeatedVertices(int n) {
  Mesh mesh = squareLike(squareBuilder(n), "repeated_vertices", n);
  insertTriangle(mesh, 1, 0, 0, 1);
  insertTriangle(mesh, n, n, n, n);
  return mesh;
}

Mesh unreferencedVertices(int n) {
  MeshBuilder builder;
  builder.add({0.5, 0.5, 1});
  builder.append(gridSquare(n), Vector3d::Zero());
  builder.add({-100, 0, 0});
  builder.add({0.5, 0.5, 0});
  return squareLike(builder, "unreferenced_vertices", n);
}

Mesh duplicateTriangles(int n) {
  Mesh mesh = squareLike(squareBuilder(n), "duplicate_triangles", n);
  const Eigen::RowVector3i first = mesh.triangles.row(0);
  insertTriangle(mesh, 1, first[0], first[1], first[2]);
  insertTriangle(mesh, 2, first[0], first[2], first[1]);
  mesh.area += 1.0 / (n * n);
  mesh.boundary_edges -= 1;
  mesh.nonmanifold_edges = 3;
  mesh.euler += 2;
  return mesh;
}

Mesh mixedOrientation(int n, std::uint64_t seed) {
  Mesh mesh = squareLike(squareBuilder(n), "mixed_orientation", n);
  mesh.eigenvalues = rectangleSpectrum(1, 1, known_eigenvalues);
  Random random(seed);
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    if (random.uniform() < 0.5) std::swap(mesh.triangles(f, 1), mesh.triangles(f, 2));
  }
  return mesh;
}

Mesh severalComponents() {
  MeshBuilder builder;
  const Mesh tetra = tetrahedron();
  builder.append(cubeQuads(2), Vector3d::Zero());
  builder.append(gridSquare(4), Vector3d(3, 0, 0));
  builder.append(tetra, Vector3d(0, 5, 0));
  Mesh mesh = builder.finish("several_components");
  mesh.area = 6 + 1 + tetra.area;
  mesh.components = 3;
  mesh.boundary_edges = 16;
  mesh.euler = 2 + 1 + 2;
  return mesh;
}

}  // namespace tufted::shapes
