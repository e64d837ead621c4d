#include "algorithms/fine_normals.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

namespace tufted {
namespace {

constexpr std::size_t few = 10;          // points of a plane, the one in the middle among them
constexpr int terms = 6;                 // of a quadratic in two variables
constexpr std::size_t least_points = 9;  // of a quadratic, three more than terms
constexpr double singular = 1e-9;        // of the largest pivot, and of a variance: points on a conic, on a line
constexpr double least_agreement = 0.5;  // cosine to the normal before: a plane across it is one of noise
constexpr double tie = 1e-9;             // of a squared distance

/// A surface through some points.
struct Fit {
  Eigen::Vector3d normal;
  double variance;  ///< of the heights over it
};

std::optional<Fit> planeThrough(const Points& positions, std::span<const int> points) {
  const Eigen::RowVector3d middle = positions.row(points.front());
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const int q : points) {
    const Eigen::RowVector3d d = positions.row(q) - middle;
    sum += d;
    squares += d.transpose() * d;
  }
  squares -= sum.transpose() * sum / static_cast<double>(points.size());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(squares);
  const Eigen::Vector3d& along = axes.eigenvalues();
  if (!(along[1] > singular * along[2])) return std::nullopt;
  return Fit{axes.eigenvectors().col(0), std::max(0.0, along[0]) / static_cast<double>(points.size() - 3)};
}

/// A quadratic over the plane of a normal, and once more over its own.
std::optional<Fit> quadraticThrough(const Points& positions, std::span<const int> points, Eigen::Vector3d normal) {
  const Eigen::RowVector3d middle = positions.row(points.front());
  const double extent = (positions.row(points.back()) - middle).norm();
  double variance = 0;
  for (int round = 0; round < 2; ++round) {
    const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
    Eigen::Matrix<double, terms, terms> left = Eigen::Matrix<double, terms, terms>::Zero();
    Eigen::Matrix<double, terms, 1> right = Eigen::Matrix<double, terms, 1>::Zero();
    double squares = 0;
    for (const int q : points) {
      const Eigen::Vector3d d = (positions.row(q) - middle).transpose() / extent;
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
    variance = std::max(0.0, squares - found.dot(right)) * extent * extent / static_cast<double>(points.size() - terms);
    normal = (normal - found[1] * u - found[2] * v).normalized();
  }
  return Fit{normal, variance};
}

/// The points within two edges of L around some points, the nearest first.
class TwoRings {
 public:
  explicit TwoRings(const Laplacian& laplacian)
      : laplacian_(laplacian), last_(static_cast<std::size_t>(laplacian.L.cols()), -1) {}

  /// Of the points, how many are as near as the tenth: those that are equally far count together.
  std::size_t countOfFew(int p) const {
    if (points_.size() <= few) return points_.size();
    const double farthest = (1 + tie) * squaredDistance(p, points_[few - 1]);
    const auto end = std::partition_point(points_.begin() + few, points_.end(),
                                          [&](int q) { return squaredDistance(p, q) <= farthest; });
    return static_cast<std::size_t>(end - points_.begin());
  }

  std::span<const int> around(int p) {
    points_.clear();
    take(p, p);
    takeNeighbors(p, p);
    for (std::size_t i = 1, ring = points_.size(); i < ring; ++i) takeNeighbors(points_[i], p);
    std::sort(points_.begin(), points_.end(),
              [&](int a, int b) { return squaredDistance(p, a) < squaredDistance(p, b); });
    return points_;
  }

 private:
  double squaredDistance(int p, int q) const {
    return (laplacian_.positions.row(q) - laplacian_.positions.row(p)).squaredNorm();
  }
  void take(int q, int p) {
    if (last_[q] == p) return;
    last_[q] = p;
    points_.push_back(q);
  }
  void takeNeighbors(int q, int p) {
    for (SparseMatrix::InnerIterator entry(laplacian_.L, q); entry; ++entry)
      if (entry.value() != 0) take(static_cast<int>(entry.row()), p);
  }

  const Laplacian& laplacian_;
  std::vector<int> last_;  ///< the point that each was last taken for
  std::vector<int> points_;
};

}  // namespace

void takeFineNormals(const Laplacian& laplacian, Frames& frames) {
  TwoRings rings(laplacian);
  for (int p = 0; p < static_cast<int>(frames.normals.rows()); ++p) {
    if (laplacian.status[p] != PointStatus::active) continue;
    const std::span<const int> points = rings.around(p);
    if (points.size() < least_points) continue;
    const Eigen::Vector3d before = frames.normals.row(p);
    const std::optional<Fit> bent = quadraticThrough(laplacian.positions, points, before);
    const std::optional<Fit> near = planeThrough(laplacian.positions, points.first(rings.countOfFew(p)));
    if (!bent || !near) continue;
    const Eigen::Vector3d& found = near->variance <= bent->variance ? near->normal : bent->normal;
    const double cosine = found.dot(before);
    if (!(std::abs(cosine) >= least_agreement)) continue;
    const Eigen::Vector3d normal = cosine < 0 ? Eigen::Vector3d(-found) : found;
    const Eigen::Vector3d tangent = frames.tangents.row(p);
    frames.normals.row(p) = normal;
    frames.tangents.row(p) = Eigen::Quaterniond::FromTwoVectors(before, normal) * tangent;
  }
}

}  // namespace tufted
