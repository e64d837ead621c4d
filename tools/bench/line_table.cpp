#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "bench/tables.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "tufted/tufted.h"

namespace tufted::bench {
namespace {

using Eigen::RowVector3d;

/// The greatest distances, in spacings, of traced lines of length 1.5 from the planes of their great circles,
/// ascending.
std::vector<double> offGreatCircles(const Points& points, const Triangles& triangles, const Frames& frames,
                                    double spacing) {
  const GeodesicTracer tracer(points, triangles, frames);
  shapes::Random random(101);
  std::vector<double> errors;
  for (int i = 0; i < 100; ++i) {
    const int start = random.below(static_cast<int>(points.rows()));
    const RowVector3d axis =
        points.row(start).cross(RowVector3d(random.normal(), random.normal(), random.normal())).normalized();
    const TracedLine traced = tracer.query(SurfacePoint::vertex(start), axis.cross(points.row(start)), 1.5);
    const Points places = traced.line.points.rowwise().normalized();
    errors.push_back((places * axis.transpose()).cwiseAbs().maxCoeff() / spacing);
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

/// The greatest distance, in spacings, of the isolines of nine heights from the circles of the sphere.
double offCircles(const Points& points, const Triangles& triangles, double spacing) {
  double greatest = 0;
  for (int k = -4; k <= 4; ++k) {
    const double height = 0.2 * k, radius = std::sqrt(1 - height * height);
    for (const Polyline& line : isolines(points, triangles, points.col(2), {height}))
      greatest = std::max(greatest, (line.points.leftCols<2>().rowwise().norm().array() - radius).abs().maxCoeff());
  }
  return greatest / spacing;
}

void printLinesOn(const char* name, const Points& points, const Triangles& triangles, const Frames& frames) {
  const double spacing = std::sqrt(4 * std::numbers::pi / static_cast<double>(points.rows()));
  const std::vector<double> lines = offGreatCircles(points, triangles, frames, spacing);
  std::printf("| %s | %d | %.4f | %.4f | %.4f |\n", name, static_cast<int>(points.rows()), lines[lines.size() / 2],
              lines.back(), offCircles(points, triangles, spacing));
  std::fflush(stdout);
}

}  // namespace

void printLines() {
  std::printf("| unit sphere | points | lines: median | max | isolines: max |\n|---|---|---|---|---|\n");
  for (const int subdivisions : {4, 5, 6, 7}) {
    const shapes::Mesh mesh = shapes::icosphere(subdivisions);
    printLinesOn("icosphere", mesh.points, mesh.triangles, meshFrames(mesh.points, mesh.triangles));
  }
  for (const int n : {4000, 16000, 64000}) {
    const Laplacian cloud = pointCloudLaplacian(shapes::sphere(n, shapes::Sampling::jittered, 101).points);
    printLinesOn("cloud", cloud.positions, surfaceTriangles(cloud), cloud.frames);
  }
}

}  // namespace tufted::bench
