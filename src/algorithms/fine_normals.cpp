#include "algorithms/fine_normals.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "operators/rings.h"

namespace tufted {
namespace {

/// Nearest points that a plane is fitted to, the point itself included. Of 10, 16, 30 and 48 this is the best on 14
/// clean shapes, and the second best on denoised ones.
constexpr std::size_t few = 10;
constexpr int terms = 6;  // coefficients of a quadratic in two variables
/// A quadratic needs this many points: three more than terms, so that residuals say how well it fits.
constexpr std::size_t least_points = 9;
/// Pivots and variances below this part of the largest count as 0: points on a conic or a line keep the normal of 30
/// points.
constexpr double singular = 1e-9;
/// Least cosine to the normal of 30 points; a fit below it follows noise and is not used. Without it one normal in 800
/// would point inwards on a cube with 1 % noise.
constexpr double least_agreement = 0.5;
/// Squared distances that differ by less than this part count as equal, so that a lattice has one answer in any order.
constexpr double tie = 1e-9;

/// A plane or quadratic fitted to some points.
struct Fit {
  Eigen::Vector3d normal;
  double variance;  ///< of the heights over it, by degrees of freedom
};

/// Fits a plane.
/// @param offsets from one of the points to all, itself included; at most 1 long
std::optional<Fit> planeThrough(std::span<const Eigen::Vector3d> offsets) {
  const auto count = static_cast<double>(offsets.size());
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& d : offsets) {
    sum += d;
    squares += d * d.transpose();
  }
  squares -= sum * sum.transpose() / count;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(squares);
  const Eigen::Vector3d& along = axes.eigenvalues();
  if (!(along[1] > singular * along[2])) return std::nullopt;
  return Fit{axes.eigenvectors().col(0), std::max(0.0, along[0]) / (count - 3)};
}

/// Fits a quadratic over the plane of a normal, and once more over its own tangent plane.
std::optional<Fit> quadraticThrough(std::span<const Eigen::Vector3d> offsets, Eigen::Vector3d normal) {
  double variance = 0;
  for (int round = 0; round < 2; ++round) {
    const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
    Eigen::Matrix<double, terms, terms> left = Eigen::Matrix<double, terms, terms>::Zero();
    Eigen::Matrix<double, terms, 1> right = Eigen::Matrix<double, terms, 1>::Zero();
    double squares = 0;
    for (const Eigen::Vector3d& d : offsets) {
      const double x = d.dot(u), y = d.dot(v), height = d.dot(normal);
      const Eigen::Matrix<double, terms, 1> base{1, x, y, x * x, x * y, y * y};
      left += base * base.transpose();
      right += base * height;
      squares += height * height;
    }
    const Eigen::LDLT<Eigen::Matrix<double, terms, terms>> factor(left);
    const auto pivots = factor.vectorD();
    if (!(pivots.minCoeff() > singular * pivots.maxCoeff())) return std::nullopt;
    const Eigen::Matrix<double, terms, 1> found = factor.solve(right);
    variance = std::max(0.0, squares - found.dot(right)) / static_cast<double>(offsets.size() - terms);
    normal = (normal - found[1] * u - found[2] * v).normalized();
  }
  return Fit{normal, variance};
}

/// Offsets from p to itself and the points of its first two rings, divided by the longest, in ascending length.
void takeOffsets(int p, const Points& positions, Rings& rings, std::vector<Eigen::Vector3d>& offsets) {
  rings.start(p);
  rings.grow();
  rings.grow();
  offsets.clear();
  for (const int q : rings.points()) offsets.emplace_back(positions.row(q) - positions.row(p));
  // Against overflow and underflow of squares.
  double extent = 0;
  for (const Eigen::Vector3d& d : offsets) extent = std::max(extent, d.stableNorm());
  for (Eigen::Vector3d& d : offsets) d /= extent;
  std::sort(offsets.begin(), offsets.end(),
            [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.squaredNorm() < b.squaredNorm(); });
}

/// The nearest `few` offsets, and those as long as the last of them.
std::span<const Eigen::Vector3d> fewOf(std::span<const Eigen::Vector3d> offsets) {
  std::size_t count = std::min(few, offsets.size());
  const double farthest = (1 + tie) * offsets[count - 1].squaredNorm();
  while (count < offsets.size() && offsets[count].squaredNorm() <= farthest) ++count;
  return offsets.first(count);
}

/// The normal or its opposite, the same for both: fits on either side round differently.
Eigen::Vector3d upright(const Eigen::Vector3d& normal) {
  const double decides = normal.z() != 0 ? normal.z() : normal.y() != 0 ? normal.y() : normal.x();
  return decides < 0 ? Eigen::Vector3d(-normal) : normal;
}

}  // namespace

void takeFineNormals(const Laplacian& laplacian, Frames& frames) {
  Rings rings(laplacian.L);
  std::vector<Eigen::Vector3d> offsets;
  for (int p = 0; p < static_cast<int>(frames.normals.rows()); ++p) {
    if (laplacian.status[p] != PointStatus::active) continue;
    takeOffsets(p, laplacian.positions, rings, offsets);
    if (offsets.size() < least_points) continue;
    const Eigen::Vector3d before = frames.normals.row(p), tangent = frames.tangents.row(p);
    const std::optional<Fit> bent = quadraticThrough(offsets, upright(before)), near = planeThrough(fewOf(offsets));
    if (!bent || !near) continue;
    const Eigen::Vector3d& found = near->variance <= bent->variance ? near->normal : bent->normal;
    const double cosine = found.dot(before);
    if (!(std::abs(cosine) >= least_agreement)) continue;
    const Eigen::Vector3d normal = cosine < 0 ? Eigen::Vector3d(-found) : found;
    frames.normals.row(p) = normal;
    frames.tangents.row(p) = Eigen::Quaterniond::FromTwoVectors(before, normal) * tangent;
  }
}

}  // namespace tufted
