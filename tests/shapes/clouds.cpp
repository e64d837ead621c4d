#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <stdexcept>
#include <unordered_set>
#include <utility>

#include "shapes/random.h"
#include "shapes/spectra.h"
#include "shapes/surface.h"

namespace tufted::shapes {
namespace {

// Samples flat patches given by triangles, for surfaces that are not one patch of rows.
Cloud sampleSolid(const Mesh& mesh, const std::string& shape, int n, const std::vector<int>& face_of_triangle,
                  std::uint64_t seed) {
  Cloud cloud = sampleMesh(mesh, n, seed);
  cloud.name = shape + "_uniform";
  cloud.shape = shape;
  for (int& label : cloud.labels) label = face_of_triangle[label];
  return cloud;
}

}  // namespace

Cloud sphere(int n, Sampling sampling, std::uint64_t seed) {
  return sampleSurface(sphereSurface(), n, sampling, Rim::none, seed);
}

Points twoSpheres(double radius) {
  Points points(2000, 3);
  points.topRows(1000) = sphere(1000).points;
  points.bottomRows(1000) = (radius * sphere(1000, Sampling::uniform, 2).points).array() + 3;
  return points;
}

Cloud ellipsoid(int n, std::uint64_t seed) {
  if (n > 100000) throw std::invalid_argument("ellipsoid: n > 100,000 leaves too few distinct coordinates");
  const Surface surface = ellipsoidSurface(1.5, 1.25, 1);
  std::array<std::unordered_set<double>, 3> used;
  Cloud cloud = sampleSurface(surface, n, Sampling::uniform, Rim::none, seed);
  // A point that would repeat a coordinate is replaced from a second sequence.
  std::uint64_t spare_seed = seed + 1000003;
  Cloud spare;
  Eigen::Index next = 0;
  for (Eigen::Index i = 0; i < cloud.points.rows(); ++i) {
    for (;;) {
      const Eigen::RowVector3d p = (cloud.points.row(i) * 0x1p20).array().round() * 0x1p-20;
      if (!used[0].contains(p.x()) && !used[1].contains(p.y()) && !used[2].contains(p.z())) {
        cloud.points.row(i) = p;
        for (int axis = 0; axis < 3; ++axis) used[axis].insert(p[axis]);
        break;
      }
      if (next == spare.points.rows()) {
        spare = sampleSurface(surface, 1000, Sampling::uniform, Rim::none, spare_seed++);
        next = 0;
      }
      cloud.points.row(i) = spare.points.row(next);
      cloud.normals.row(i) = spare.normals.row(next++);
    }
  }
  return cloud;
}

Cloud square(int n, Sampling sampling, Rim rim, std::uint64_t seed) {
  return sampleSurface(squareSurface(), n, sampling, rim, seed);
}

Cloud disk(int n, Sampling sampling, Rim rim, std::uint64_t seed) {
  static const Surface surface = diskSurface();  // its spectrum takes a while
  return sampleSurface(surface, n, sampling, rim, seed);
}

Cloud torus(int n, Sampling sampling, std::uint64_t seed) {
  static const Surface surface = torusSurface(1, 0.4);  // its spectrum takes a while
  return sampleSurface(surface, n, sampling, Rim::none, seed);
}

Cloud cylinderPatch(int n, Sampling sampling, Rim rim, std::uint64_t seed) {
  return sampleSurface(cylinderSurface(), n, sampling, rim, seed);
}

Cloud saddle(int n, Sampling sampling, Rim rim, std::uint64_t seed) {
  return sampleSurface(saddleSurface(), n, sampling, rim, seed);
}

Cloud squareLattice(int side, double spacing) {
  const int n = side * side;
  const double extent = (side - 1) * spacing;
  Cloud cloud{.name = "square_exact_lattice",
              .shape = "square",
              .sampling = "exact_lattice",
              .points = Points::Zero(n, 3),
              .normals = Points::Zero(n, 3),
              .area = extent * extent,
              .boundary = true,
              .eigenvalues = rectangleSpectrum(extent, extent, known_eigenvalues)};
  cloud.normals.col(2).setOnes();
  for (int i = 0; i < n; ++i) cloud.points.row(i) << (i % side) * spacing, (i / side) * spacing, 0;
  return cloud;
}

Cloud twoSheets(int n, double distance, std::uint64_t seed) {
  Cloud cloud = square(n, Sampling::uniform, Rim::none, seed);
  cloud.name = "two_sheets";
  cloud.shape = "two_sheets";
  cloud.area = 2;
  cloud.components = 2;
  cloud.eigenvalues = repeatedSpectrum(cloud.eigenvalues, 2);
  cloud.labels.resize(n);
  for (int i = 0; i < n; ++i) {
    cloud.labels[i] = i % 2;
    cloud.points(i, 2) = i % 2 * distance;
  }
  return cloud;
}

Cloud crossingPlanes(int n, std::uint64_t seed) {
  Cloud cloud = square(n, Sampling::uniform, Rim::none, seed);
  cloud.name = "crossing_planes";
  cloud.shape = "crossing_planes";
  cloud.area = 2;
  cloud.eigenvalues = bookSpectrum(4, 0.5, 1, known_eigenvalues);
  cloud.labels.resize(n);
  for (int i = 0; i < n; ++i) {
    cloud.labels[i] = i % 2;
    const double x = cloud.points(i, 0) - 0.5, y = cloud.points(i, 1) - 0.5;
    if (i % 2 == 0) {
      cloud.points.row(i) << x, y, 0;
    } else {
      cloud.points.row(i) << x, 0, y;
      cloud.normals.row(i) << 0, -1, 0;
    }
  }
  return cloud;
}

Cloud cubeSurface(int n, std::uint64_t seed) {
  std::vector<int> faces;
  for (int i = 0; i < 12; ++i) faces.push_back(i / 2);
  Cloud cloud = sampleSolid(cubeQuads(1), "cube", n, faces, seed);
  cloud.eigenvalues = cubeSpectrum(known_eigenvalues);
  return cloud;
}

Cloud prismSurface(int n, std::uint64_t seed) {
  return sampleSolid(prismMesh(1, Quality::good), "prism", n, {0, 1, 2, 2, 3, 3, 4, 4}, seed);
}

VectorXd sphereDistances(const Points& points, int from) {
  VectorXd result(points.rows());
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Eigen::Vector3d a = points.row(i), b = points.row(from);
    result[i] = std::atan2(a.cross(b).norm(), a.dot(b));
  }
  return result;
}

Cloud withNoise(Cloud cloud, double sigma, std::uint64_t seed) {
  Random random(seed);
  for (Eigen::Index i = 0; i < cloud.points.rows(); ++i) {
    for (int axis = 0; axis < 3; ++axis) cloud.points(i, axis) += sigma * random.normal();
  }
  cloud.noise = sigma;
  char text[32];  // 0.001 becomes "0p1pct": test names allow no point
  std::snprintf(text, sizeof text, "_noise_%gpct", 100 * sigma);
  std::replace(std::begin(text), std::end(text), '.', 'p');
  cloud.name += text;
  return cloud;
}

Cloud withOutliers(Cloud cloud, Outliers where, double share, std::uint64_t seed) {
  Random random(seed);
  const int n = static_cast<int>(cloud.points.rows());
  const int added = static_cast<int>(std::lround(share * n));
  const double spacing = std::sqrt(cloud.area / n);
  const Eigen::RowVector3d low = cloud.points.colwise().minCoeff(), high = cloud.points.colwise().maxCoeff();
  cloud.points.conservativeResize(n + added, Eigen::NoChange);
  cloud.normals.conservativeResize(n + added, Eigen::NoChange);
  for (int i = n; i < n + added; ++i) {
    if (where == Outliers::near) {
      const int p = random.below(n);
      const double off = random.uniform(2, 6) * spacing, side = random.uniform() < 0.5 ? -1 : 1;
      cloud.points.row(i) = cloud.points.row(p) + side * off * cloud.normals.row(p);
      cloud.normals.row(i) = cloud.normals.row(p);
    } else {
      for (int axis = 0; axis < 3; ++axis) {
        const double margin = (high[axis] - low[axis]) / 4;
        cloud.points(i, axis) = random.uniform(low[axis] - margin, high[axis] + margin);
      }
      cloud.normals.row(i).setZero();
    }
  }
  if (!cloud.labels.empty()) cloud.labels.resize(n + added, -1);
  cloud.width = cloud.height = 0;
  cloud.outliers = added;
  cloud.name += where == Outliers::near ? "_outliers_near" : "_outliers_far";
  return cloud;
}

Cloud shuffled(Cloud cloud, std::uint64_t seed) {
  const std::vector<int> order = Random(seed).permutation(static_cast<int>(cloud.points.rows()));
  cloud.points = Points(cloud.points(order, Eigen::all));
  cloud.normals = Points(cloud.normals(order, Eigen::all));
  std::vector<int> labels(cloud.labels.size());
  for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = cloud.labels[order[i]];
  cloud.labels = std::move(labels);
  cloud.width = cloud.height = cloud.rim_points = cloud.outliers = 0;
  cloud.name += "_shuffled";
  return cloud;
}

Cloud sampleMesh(const Mesh& mesh, int n, std::uint64_t seed) {
  using Eigen::Vector3d;
  const auto corner = [&](int face, int k) -> Vector3d { return mesh.points.row(mesh.triangles(face, k)).transpose(); };
  std::vector<double> ends;
  std::vector<Vector3d> normals;
  double total = 0;
  for (int face = 0; face < mesh.triangles.rows(); ++face) {
    const Vector3d cross = (corner(face, 1) - corner(face, 0)).cross(corner(face, 2) - corner(face, 0));
    ends.push_back(total += cross.norm() / 2);
    normals.push_back(cross.normalized());
  }
  Cloud cloud{.name = mesh.name + "_sampled",
              .shape = mesh.shape,
              .sampling = "uniform",
              .seed = seed,
              .points = Points(n, 3),
              .normals = Points(n, 3),
              .area = mesh.area,
              .components = mesh.components,
              .boundary = mesh.boundary_edges > 0,
              .labels = std::vector<int>(n)};
  Random random(seed);
  for (int i = 0; i < n; ++i) {
    const auto found = std::upper_bound(ends.begin(), ends.end(), random.uniform() * total);
    const int face = static_cast<int>(std::min<std::ptrdiff_t>(found - ends.begin(), ends.size() - 1));
    double u = random.uniform();
    double v = random.uniform();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const Vector3d a = corner(face, 0), b = corner(face, 1), c = corner(face, 2);
    cloud.points.row(i) = (a + u * (b - a) + v * (c - a)).transpose();
    cloud.normals.row(i) = normals[face].transpose();
    cloud.labels[i] = face;
  }
  return cloud;
}

}  // namespace tufted::shapes
