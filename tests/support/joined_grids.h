#pragma once

#include <vector>

#include "tufted/laplacian.h"

namespace tufted::support {

/// The graph Laplacian of several square grids with edges of weight 1, and an edge from the last point of each grid to
/// the first of the next.
/// @param side points along a grid's side
/// @param joints weights of the edges between grids, one less than there are grids
inline Laplacian joinedGrids(int side, const std::vector<double>& joints) {
  const int size = side * side, grids = static_cast<int>(joints.size()) + 1, n = grids * size;
  std::vector<Eigen::Triplet<double>> entries;
  const auto join = [&](int i, int j, double weight) {
    entries.insert(entries.end(), {{i, j, -weight}, {j, i, -weight}, {i, i, weight}, {j, j, weight}});
  };
  for (int i = 0; i < n; ++i) {
    const int row = i % size / side, column = i % side;
    if (column + 1 < side) join(i, i + 1, 1);
    if (row + 1 < side) join(i, i + side, 1);
  }
  for (int k = 0; k + 1 < grids; ++k) join((k + 1) * size - 1, (k + 1) * size, joints[k]);
  Laplacian laplacian;
  laplacian.L.resize(n, n);
  laplacian.L.setFromTriplets(entries.begin(), entries.end());
  laplacian.M = laplacian.cover_areas = VectorXd::Ones(n);
  laplacian.status.assign(n, PointStatus::active);
  laplacian.boundary.assign(n, Boundary::none);
  for (int i = 0; i < n; ++i) laplacian.representative.push_back(i);
  laplacian.report.points = laplacian.report.active = n;
  laplacian.report.components = 1;
  laplacian.report.mean_squared_edge = 1;
  return laplacian;
}

}  // namespace tufted::support
