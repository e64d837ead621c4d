// Rivals whose weights are values of a heat kernel.
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "bench/compare/patches.h"
#include "bench/compare/rivals.h"

namespace tufted::bench {
namespace {

/// The kernel is cut off at this many roots of t, where it has fallen to exp(-4). Errors of eigenvalues on four shapes,
/// seed 1, are about the same with 2, 3 and 4, but with 3 values of L u at single points do not converge visibly.
constexpr double cutoff = 4;

/// exp(-d^2 / 4t) / (4 pi t^2) with the t at which a disk of radius `cutoff` sqrt(t) holds k points. As in the papers t
/// is the same everywhere.
class GaussianKernel {
 public:
  GaussianKernel(const Points& points, double area, int k)
      : points_(points), t_(area / static_cast<double>(points.rows()) * k / std::numbers::pi / (cutoff * cutoff)) {}
  bool reaches(int p, int q) const { return squaredDistance(p, q) <= cutoff * cutoff * t_; }
  double operator()(int p, int q) const {
    // What the cut leaves of the second moment of the kernel, by which weights are divided.
    const double x = cutoff * cutoff / 4, kept = 1 - (1 + x) * std::exp(-x);
    return std::exp(-squaredDistance(p, q) / (4 * t_)) / (4 * std::numbers::pi * t_ * t_ * kept);
  }

 private:
  double squaredDistance(int p, int q) const { return (points_.row(p) - points_.row(q)).squaredNorm(); }
  const Points& points_;
  double t_;
};

}  // namespace

Operators belkinLaplacian(const Points& points, int k) {
  const VectorXd areas = starAreas(points);
  const NearestPoints nearest(points);
  const GaussianKernel kernel(points, areas.sum(), k);
  std::vector<Eigen::Triplet<double>> weights;
  for (int p = 0; p < points.rows(); ++p) {
    // Areas near the hull of a triangulation are wrong, so it has twice as many points as the kernel reaches.
    const Patch patch = patchOf(nearest, p, 2 * k);
    const VectorXd of_neighbor = cornerAreas(patch);
    for (std::size_t j = 0; j < patch.index.size(); ++j) {
      const int q = patch.index[j];
      if (kernel.reaches(p, q))
        weights.emplace_back(p, q, areas[p] * of_neighbor[static_cast<Eigen::Index>(j)] * kernel(p, q));
    }
  }
  return {fromWeights(weights, points.rows()), areas};
}

Operators liuLaplacian(const Points& points, int k) {
  const VectorXd areas = starAreas(points);
  const NearestPoints nearest(points);
  const GaussianKernel kernel(points, areas.sum(), k);
  std::vector<Eigen::Triplet<double>> weights;
  std::set<std::pair<int, int>> pairs;
  for (int p = 0; p < points.rows(); ++p) {
    for (const int q : patchOf(nearest, p, 2 * k).index) {
      if (!kernel.reaches(p, q) || !pairs.insert(std::minmax(p, q)).second) continue;
      const double weight = areas[p] * areas[q] * kernel(p, q);
      weights.insert(weights.end(), {{p, q, weight}, {q, p, weight}});
    }
  }
  return {fromWeights(weights, points.rows()), areas};
}

Operators graphLaplacian(const Points& points, int k) {
  const NearestPoints nearest(points);
  std::set<std::pair<int, int>> pairs;
  double mean_square = 0;
  for (int p = 0; p < points.rows(); ++p)
    for (const int q : patchOf(nearest, p, k).index) pairs.insert(std::minmax(p, q));
  const auto square = [&](int p, int q) { return (points.row(p) - points.row(q)).squaredNorm(); };
  for (const auto& [p, q] : pairs) mean_square += square(p, q) / static_cast<double>(pairs.size());
  std::vector<Eigen::Triplet<double>> weights;
  double energy = 0;
  for (const auto& [p, q] : pairs) {
    const double weight = std::exp(-square(p, q) / mean_square);  // 4 t is the mean squared edge, as is common
    weights.insert(weights.end(), {{p, q, weight}, {q, p, weight}});
    energy += weight * square(p, q);
  }
  const double area = starAreas(points).sum();
  return {2 * area / energy * fromWeights(weights, points.rows()),
          VectorXd::Constant(points.rows(), area / static_cast<double>(points.rows()))};
}

}  // namespace tufted::bench
