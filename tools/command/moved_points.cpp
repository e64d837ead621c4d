#include "moved_points.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "tufted/surface_triangles.h"

tufted::Triangles trianglesOf(const Operator& source) {
  if (source.laplacian.kind == tufted::Kind::cloud)
    return tufted::surfaceTriangles(source.laplacian, {.progress = source.progress});
  if (!source.geometry.is_mesh)
    throw tufted::IoError(source.name + ": is the Laplacian of a mesh without its triangles; give the mesh as FILE");
  return source.geometry.triangles;
}

tufted::Triangles joinedTriangles(const Operator& source) {
  tufted::Triangles triangles = trianglesOf(source);
  for (int& corner : triangles.reshaped()) corner = source.laplacian.representative[corner];
  return triangles;
}

void checkHasPoints(const Operator& source) {
  if (source.geometry.points.rows() == 0 && source.points() > 0)
    throw tufted::IoError(source.name + ": has no points, which are to be moved");
}

void movePoints(const std::string& name, const Eigen::MatrixXd& positions, Operator& source, Results& results) {
  const Eigen::MatrixXd way = (positions - Eigen::MatrixXd(source.geometry.points)).rowwise().norm();
  double farthest = 0, sum = 0;
  long long count = 0;
  for (const double length : way.reshaped())
    if (std::isfinite(length)) farthest = std::max(farthest, length), sum += length, ++count;
  const double mean = count > 0 ? sum / static_cast<double>(count) : 0;
  results.report["way"] = {{"farthest", farthest}, {"mean", mean}};
  results.summary.add("moved", "points by %.6g in the mean, by %.6g at most", mean, farthest);
  results.shown = {{.name = moved_points_field, .values = way}};
  results.arrays = {{.name = name, .values = positions}};
  source.geometry.points = positions;
  // Normals and frames belong to the old positions.
  source.geometry.normals.resize(0, 3);
  source.laplacian.frames = {};
}
