#include <Eigen/Geometry>
#include <vector>

#include "oracles/oracles.h"

namespace tufted::oracles {

Operators cotanLaplacian(const Points& points, const Triangles& triangles) {
  std::vector<Eigen::Triplet<double>> entries;
  VectorXd mass = VectorXd::Zero(points.rows());
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    const Eigen::RowVector3i t = triangles.row(f);
    const Eigen::RowVector3d a = points.row(t[0]), b = points.row(t[1]), c = points.row(t[2]);
    const double double_area = (b - a).cross(c - a).norm();
    if (!(double_area > 0)) continue;
    for (int k = 0; k < 3; ++k) {
      const int i = t[(k + 1) % 3], j = t[(k + 2) % 3];
      const Eigen::RowVector3d u = points.row(i) - points.row(t[k]), v = points.row(j) - points.row(t[k]);
      const double weight = u.dot(v) / double_area / 2;  // cot / 2
      entries.insert(entries.end(), {{i, j, -weight}, {j, i, -weight}, {i, i, weight}, {j, j, weight}});
      mass[t[k]] += double_area / 6;
    }
  }
  SparseMatrix L(points.rows(), points.rows());
  L.setFromTriplets(entries.begin(), entries.end());
  return {L, mass};
}

double surfaceArea(const Points& points, const Triangles& triangles) {
  double sum = 0;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    const Eigen::RowVector3d a = points.row(triangles(f, 0));
    const Eigen::RowVector3d u = points.row(triangles(f, 1)) - a, v = points.row(triangles(f, 2)) - a;
    sum += u.cross(v).norm() / 2;
  }
  return sum;
}

}  // namespace tufted::oracles
