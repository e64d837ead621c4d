// Gradients on real scans, beside plain fits over the 30 nearest points.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>

#include "guarantees/real_files.h"
#include "tufted/gradient.h"
#include "tufted/io/read.h"

namespace tufted::guarantees::gradients_test {
namespace {

namespace fs = std::filesystem;

/// The error of the gradients of x, y and z, in a frame whose axes they should show.
double errorOf(const Eigen::Matrix<double, 2, 3>& found, const Eigen::Matrix<double, 2, 3>& axes) {
  return (found - axes).norm() / std::sqrt(2);
}

/// That of a fit through the point p over the k nearest others, in the plane that fits all of these points.
double plainError(const Points& points, const std::vector<int>& others, int p, int k) {
  std::vector<std::pair<double, int>> near;
  for (const int q : others)
    if (q != p) near.emplace_back((points.row(q) - points.row(p)).squaredNorm(), q);
  k = std::min<int>(k, static_cast<int>(near.size()));
  std::nth_element(near.begin(), near.begin() + k - 1, near.end());
  Eigen::Matrix3Xd edges = Eigen::Matrix3Xd::Zero(3, k + 1);
  for (int j = 0; j < k; ++j) edges.col(j) = (points.row(near[j].second) - points.row(p)).transpose();
  const Eigen::Matrix3Xd centered = edges.colwise() - edges.rowwise().mean();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(centered * centered.transpose());
  const Eigen::Matrix<double, 2, 3> axes = solver.eigenvectors().rightCols<2>().transpose();
  const Eigen::Matrix2Xd flat = axes * edges;
  const Eigen::Matrix2d spread = flat * flat.transpose();
  return errorOf(spread.completeOrthogonalDecomposition().solve(flat * edges.transpose()), axes);
}

double quantile(std::vector<double> values, double part) {
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

class GradientsOfFile : public testing::TestWithParam<fs::path> {};

TEST_P(GradientsOfFile, AreNoWorseThanPlainFitsOverThirtyPoints) {
  const fs::path& path = GetParam();
  if (!fs::is_regular_file(path)) GTEST_SKIP() << "no folder " << path;
  const Points points = read(path, ReadAs::cloud).points;
  const Laplacian laplacian = pointCloudLaplacian(points);
  const Gradients found = gradients(laplacian, points);
  Points finite = points;
  std::vector<int> active;
  for (int i = 0; i < points.rows(); ++i) {
    if (laplacian.status[i] == PointStatus::active)
      active.push_back(i);
    else
      finite.row(i).setZero();  // their columns are empty, but 0 * NaN is NaN
  }
  const Eigen::MatrixX3d x = found.X * finite, y = found.Y * finite;
  std::vector<double> errors, plain;
  const std::size_t stride = std::max<std::size_t>(1, active.size() / 100);
  for (std::size_t k = 0; k < active.size(); k += stride) {
    const int i = active[k];
    Eigen::Matrix<double, 2, 3> slopes, axes;
    slopes << x.row(i), y.row(i);
    const Eigen::RowVector3d normal = found.frames.normals.row(i), tangent = found.frames.tangents.row(i);
    axes << tangent, normal.cross(tangent);
    errors.push_back(errorOf(slopes, axes));
    plain.push_back(plainError(points, active, i, 30));
  }
  for (const double part : {0.5, 0.95}) {
    EXPECT_LE(quantile(errors, part), std::max(quantile(plain, part), 1e-12)) << part;
  }
  RecordProperty("plain_median", std::to_string(quantile(plain, 0.5)));
  RecordProperty("plain_95", std::to_string(quantile(plain, 0.95)));
  EXPECT_LE(quantile(errors, 1), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Clouds, GradientsOfFile, testing::ValuesIn(filesIn(TUFTED_DATA_DIR "/clouds")), testName);

}  // namespace
}  // namespace tufted::guarantees::gradients_test
