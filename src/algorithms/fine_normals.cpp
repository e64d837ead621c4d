#include "algorithms/fine_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "base/power_of_two.h"
#include "operators/rings.h"
#include "stars/offsets.h"
#include "stars/quadratic_fit.h"
#include "stars/tangent_frame.h"

namespace tufted {
namespace {

/// Nearest points that a plane is fitted to, beside the point itself. With it 10: of 10, 16, 30 and 48 this is the best
/// on 14 clean shapes, and the second best on denoised ones.
constexpr std::size_t fitted_neighbors = 9;
/// A middle variance below this part of the largest counts as 0: points on a line keep the normal of 30 points.
constexpr double singular = 1e-9;
/// Least cosine to the normal of 30 points; a fit below it follows noise and is not used. Without it one normal in 800
/// would point inwards on a cube with 1 % noise.
constexpr double least_agreement = 0.5;
/// Squared distances that differ by less than this part count as equal, so that a lattice has one answer in any order.
constexpr double equal_distances = 1e-9;

/// An offset with its squared length.
struct ByLength {
  double square;
  Eigen::RowVector3d offset;

  friend bool operator<(const ByLength& a, const ByLength& b) { return a.square < b.square; }
};

/// The normal or its opposite, the same for both: fits on either side round differently.
Eigen::Vector3d upright(const Eigen::Vector3d& normal) {
  const double decides = normal.z() != 0 ? normal.z() : normal.y() != 0 ? normal.y() : normal.x();
  return decides < 0 ? Eigen::Vector3d(-normal) : normal;
}

/// Fits the normals of up to eight points at a time, as many as the kernels solve together.
class FineNormals {
 public:
  FineNormals(const Laplacian& laplacian, Frames& frames)
      : positions_(laplacian.positions), frames_(frames), rings_(laplacian.L) {}

  /// Adds a point, if it has neighbours.
  void add(int p) {
    takeOffsets(p);
    if (sorted_.empty()) return;
    points_[count_] = p;
    nearest_[count_] = countNearest();
    offsets_[count_].fill(static_cast<int>(std::ssize(sorted_)), [&](int i) { return sorted_[i].offset; });
    if (++count_ == kernel_packet) fit();
  }

  /// Sets the normals of the points that were added.
  void fit() {
    // Quadratics over the planes of the normals, then over their own tangent planes.
    std::array<Eigen::Vector3d, kernel_packet> bent;
    std::array<HeightMoments, kernel_packet> moments;
    std::array<HeightFit, kernel_packet> fits;
    for (std::size_t i = 0; i < count_; ++i) bent[i] = upright(frames_.normals.row(points_[i]));
    for (int round = 0; round < 2; ++round) {
      for (std::size_t i = 0; i < count_; ++i) moments[i] = heightMoments(offsets_[i].view(), bent[i], 1);
      fitHeights({moments.data(), count_}, fits);
      for (std::size_t i = 0; i < count_; ++i)
        if (fits[i].is_valid) bent[i] = normalOf(fits[i], bent[i]);
    }
    std::array<Covariance, kernel_packet> covariances;
    std::array<PrincipalAxes, kernel_packet> axes;
    for (std::size_t i = 0; i < count_; ++i) {
      const Offsets all = offsets_[i].view();
      covariances[i] = covarianceOf({nearest_[i], all.x, all.y, all.z});
    }
    principalAxes({covariances.data(), count_}, axes);
    for (std::size_t i = 0; i < count_; ++i) {
      const Eigen::Vector3d& variance = axes[i].variance;
      if (!fits[i].is_valid || !(variance[1] > singular * variance[2])) continue;
      const double count = nearest_[i] + 1, unit = axes[i].extent * axes[i].extent;
      const double of_plane = std::max(0.0, variance[0]) * unit * count / (count - 3);  // by degrees of freedom
      take(points_[i], of_plane <= fits[i].variance ? axes[i].normal : bent[i]);
    }
    count_ = 0;
  }

 private:
  /// Offsets from p to the points of its first two rings, over a power of two near the extent, in ascending length.
  void takeOffsets(int p) {
    rings_.start(p);
    rings_.grow();
    rings_.grow();
    sorted_.clear();
    double extent = 0;
    for (const int q : rings_.points()) {
      if (q == p) continue;
      const Eigen::RowVector3d offset = positions_.row(q) - positions_.row(p);
      extent = std::max(extent, offset.cwiseAbs().maxCoeff());
      sorted_.push_back({0, offset});
    }
    const double unit = 1 / magnitudeOf(extent);  // against overflow and underflow of squares
    for (auto& [square, offset] : sorted_) {
      offset *= unit;
      square = offset.squaredNorm();
    }
    std::sort(sorted_.begin(), sorted_.end());
  }

  /// Number of the nearest `fitted_neighbors` offsets, and of those as long as the last of them.
  int countNearest() const {
    std::size_t count = std::min(fitted_neighbors, sorted_.size());
    const double farthest = (1 + equal_distances) * sorted_[count - 1].square;
    while (count < sorted_.size() && sorted_[count].square <= farthest) ++count;
    return static_cast<int>(count);
  }

  /// Sets the normal of p to a fitted one with the same sign. The tangent turns with it, about the axis perpendicular
  /// to both normals.
  void take(int p, const Eigen::Vector3d& found) {
    const Eigen::Vector3d before = frames_.normals.row(p), tangent = frames_.tangents.row(p);
    const double cosine = found.dot(before);
    if (!(std::abs(cosine) >= least_agreement)) return;
    const Eigen::Vector3d normal = cosine < 0 ? Eigen::Vector3d(-found) : found;
    frames_.normals.row(p) = normal;
    frames_.tangents.row(p) = tangent - normal.dot(tangent) / (1 + before.dot(normal)) * (before + normal);
  }

  const Points& positions_;
  Frames& frames_;
  Rings rings_;
  std::vector<ByLength> sorted_;                         ///< of the last point
  std::size_t count_ = 0;                                ///< of the points that wait for fit()
  std::array<int, kernel_packet> points_{}, nearest_{};  ///< nearest_: number of the nearest offsets
  std::array<OffsetBuffer, kernel_packet> offsets_;
};

}  // namespace

void takeFineNormals(const Laplacian& laplacian, int threads, const Progress& progress, Frames& frames) {
  const Workers workers(threads, progress);
  std::vector<FineNormals> normals(static_cast<std::size_t>(workers.count()), {laplacian, frames});
  workers.forBlocks("normals", frames.normals.rows(), costly_block, [&](std::int64_t begin, std::int64_t end, int w) {
    for (auto p = static_cast<int>(begin); p < end; ++p)
      if (laplacian.status[p] == PointStatus::active) normals[w].add(p);
    normals[w].fit();
  });
}

}  // namespace tufted
