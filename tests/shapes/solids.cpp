#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include "shapes/mesh_builder.h"
#include "shapes/spectra.h"

namespace tufted::shapes {
namespace {

using Eigen::Vector3d;
using Rows = std::vector<std::vector<int>>;
using AddStrip = std::function<void(MeshBuilder&, const std::vector<int>&, const std::vector<int>&)>;

// Rows of points of the parallelogram origin + [0, 1] u + [0, 1] v. Points of the rim are shared with other faces, so
// only inner points are jittered, along their row: rows stay straight, and any triangulation of a strip is valid.
Rows parallelogramRows(MeshBuilder& builder, const Vector3d& origin, const Vector3d& u, const Vector3d& v, int n,
                       Random* random) {
  Rows rows(n + 1);
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const bool inner = i > 0 && i < n && j > 0 && j < n;
      const double jitter = inner && random ? random->uniform(-0.3, 0.3) : 0;
      const Vector3d p = origin + u * ((i + jitter) / n) + v * (j / double(n));
      rows[j].push_back(inner ? builder.add(p) : builder.weld(p));
    }
  }
  return rows;
}

Rows triangleRows(MeshBuilder& builder, const Vector3d& a, const Vector3d& b, const Vector3d& c, int n,
                  Random* random) {
  Rows rows(n + 1);
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n - j; ++i) {
      const bool inner = i > 0 && i < n - j && j > 0;
      const double jitter = inner && random ? random->uniform(-0.3, 0.3) : 0;
      const Vector3d p = a + (b - a) * ((i + jitter) / n) + (c - a) * (j / double(n));
      rows[j].push_back(inner ? builder.add(p) : builder.weld(p));
    }
  }
  return rows;
}

void addStrips(MeshBuilder& builder, const Rows& rows, const AddStrip& add_strip) {
  for (std::size_t j = 0; j + 1 < rows.size(); ++j) add_strip(builder, rows[j], rows[j + 1]);
}

void addCube(MeshBuilder& builder, int n, Random* random, const AddStrip& add_strip) {
  // Every edge runs in the direction of an axis, so that faces share its points bit for bit; u x v points outwards.
  const std::array<Vector3d, 3> axes{Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d u = axes[(axis + 1) % 3], v = axes[(axis + 2) % 3];
    addStrips(builder, parallelogramRows(builder, Vector3d::Zero(), v, u, n, random), add_strip);
    addStrips(builder, parallelogramRows(builder, axes[axis], u, v, n, random), add_strip);
  }
}

void addPrism(MeshBuilder& builder, int n, Random* random, const AddStrip& add_strip) {
  const Vector3d up(0, 0, 1.5);
  const std::array<Vector3d, 3> base{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0.5, std::sqrt(0.75), 0)};
  addStrips(builder, triangleRows(builder, base[0] + up, base[1] + up, base[2] + up, n, random), add_strip);
  addStrips(builder, triangleRows(builder, base[1], base[0], base[2], n, random), add_strip);
  for (int k = 0; k < 3; ++k) {
    const Rows rows = parallelogramRows(builder, base[k], base[(k + 1) % 3] - base[k], up, n, random);
    addStrips(builder, rows, add_strip);
  }
}

AddStrip triangleStrips(Quality quality) {
  return [quality](MeshBuilder& builder, const std::vector<int>& right, const std::vector<int>& left) {
    builder.strip(right, left, quality);
  };
}

AddStrip polygonStrips() {
  return [](MeshBuilder& builder, const std::vector<int>& right, const std::vector<int>& left) {
    builder.stripPolygons(right, left);
  };
}

Mesh closedSolid(const MeshBuilder& builder, const std::string& shape, const std::string& suffix, double area) {
  Mesh mesh = builder.finish(shape);
  mesh.name += suffix;
  mesh.area = area;
  mesh.euler = 2;
  return mesh;
}

const double prism_area = 3 * 1.5 + 2 * std::sqrt(3.0) / 4;

}  // namespace

Mesh cubeMesh(int n, Quality quality, std::uint64_t seed) {
  MeshBuilder builder;
  Random random(seed);
  addCube(builder, n, &random, triangleStrips(quality));
  Mesh mesh = closedSolid(builder, "cube", quality == Quality::good ? "_good" : "_bad", 6);
  mesh.eigenvalues = cubeSpectrum(known_eigenvalues);
  return mesh;
}

Mesh prismMesh(int n, Quality quality, std::uint64_t seed) {
  MeshBuilder builder;
  Random random(seed);
  addPrism(builder, n, &random, triangleStrips(quality));
  return closedSolid(builder, "prism", quality == Quality::good ? "_good" : "_bad", prism_area);
}

Mesh cubeQuads(int n) {
  MeshBuilder builder;
  addCube(builder, n, nullptr, polygonStrips());
  Mesh mesh = closedSolid(builder, "cube", "_quads", 6);
  mesh.eigenvalues = cubeSpectrum(known_eigenvalues);
  return mesh;
}

Mesh prismQuads(int n) {
  MeshBuilder builder;
  addPrism(builder, n, nullptr, polygonStrips());
  return closedSolid(builder, "prism", "_quads", prism_area);
}

Mesh tetrahedron() {
  MeshBuilder builder;
  for (const Vector3d& p : {Vector3d(1, 1, 1), Vector3d(1, -1, -1), Vector3d(-1, 1, -1), Vector3d(-1, -1, 1)}) {
    builder.add(p);
  }
  builder.triangle(0, 1, 2);
  builder.triangle(0, 3, 1);
  builder.triangle(0, 2, 3);
  builder.triangle(1, 3, 2);
  return closedSolid(builder, "tetrahedron", "", 8 * std::sqrt(3.0));
}

Mesh icosphere(int subdivisions) {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  std::vector<Vector3d> points;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-golden, golden}) {
      points.insert(points.end(), {Vector3d(x, y, 0), Vector3d(0, x, y), Vector3d(y, 0, x)});
    }
  }
  for (Vector3d& p : points) p.normalize();
  // Faces are triples of vertices with distances of 1.05; the next larger distance is 1.7.
  const auto near = [&](int a, int b) { return (points[a] - points[b]).norm() < 1.2; };
  std::vector<std::array<int, 3>> faces;
  for (int a = 0; a < 12; ++a) {
    for (int b = a + 1; b < 12; ++b) {
      for (int c = b + 1; c < 12; ++c) {
        if (!near(a, b) || !near(b, c) || !near(c, a)) continue;
        const bool outwards = points[a].dot(points[b].cross(points[c])) > 0;
        faces.push_back({a, outwards ? b : c, outwards ? c : b});
      }
    }
  }
  for (int level = 0; level < subdivisions; ++level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [place, isNew] = middles.try_emplace(std::minmax(a, b), static_cast<int>(points.size()));
      if (isNew) points.push_back(Vector3d(points[a] + points[b]).normalized());
      return place->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : faces) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    faces = std::move(finer);
  }
  MeshBuilder builder;
  for (const Vector3d& p : points) builder.add(p);
  for (const auto& [a, b, c] : faces) builder.triangle(a, b, c);
  Mesh mesh = closedSolid(builder, "icosphere", "", 16 * std::atan(1.0));
  mesh.flat = false;
  mesh.eigenvalues = sphereSpectrum(known_eigenvalues);
  return mesh;
}

}  // namespace tufted::shapes
