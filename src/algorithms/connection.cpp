// The connection on tangent planes (Sharp, Soliman, Crane: "The vector heat method", 2019, Section 3.2).
#include "algorithms/connection.h"

#include <Eigen/Geometry>

namespace tufted {

Eigen::Matrix2d transportBetween(const Frames& frames, int from, int to) {
  const Eigen::Vector3d n = frames.normals.row(to), x = frames.tangents.row(to), y = n.cross(x);
  const Eigen::Vector3d m = frames.normals.row(from), u = frames.tangents.row(from), v = m.cross(u);
  const double cosine = n.dot(m);
  const Eigen::Vector3d facing = cosine < 0 ? Eigen::Vector3d(-m) : m;
  // The rotation takes a vector w of the plane to w - (n . w) / (1 + n . facing) (n + facing).
  const Eigen::Vector3d axis = (n + facing) / (1 + std::abs(cosine));
  const auto rotated = [&](const Eigen::Vector3d& w) -> Eigen::Vector3d { return w - n.dot(w) * axis; };
  const Eigen::Vector3d a = rotated(u), b = rotated(v);
  Eigen::Matrix2d transport;
  transport << x.dot(a), x.dot(b), y.dot(a), y.dot(b);
  return transport;
}

SparseMatrix connectionLaplacian(const SparseMatrix& L, const Frames& frames) {
  SparseMatrix result(2 * L.rows(), 2 * L.cols());
  Eigen::VectorXi sizes(2 * L.cols());
  for (int j = 0; j < L.cols(); ++j) sizes[2 * j] = sizes[2 * j + 1] = 2 * L.col(j).nonZeros();
  result.reserve(sizes);
  for (int j = 0; j < L.cols(); ++j) {
    for (SparseMatrix::InnerIterator entry(L, j); entry; ++entry) {
      const auto i = static_cast<int>(entry.row());
      if (i == j) {
        result.insert(2 * j, 2 * j) = result.insert(2 * j + 1, 2 * j + 1) = entry.value();
        continue;
      }
      // Both blocks of a pair come from the same transport, so that the matrix is exactly symmetric.
      const Eigen::Matrix2d block = i > j ? transportBetween(frames, j, i) : transportBetween(frames, i, j).transpose();
      for (int c = 0; c < 2; ++c)
        for (int r = 0; r < 2; ++r) result.insert(2 * i + r, 2 * j + c) = entry.value() * block(r, c);
    }
  }
  result.makeCompressed();
  return result;
}

}  // namespace tufted
