// Parts between concave creases. Stein et al. (2014) cut patches of points where they meet in a concave edge; here the
// points along a crease are taken out by the curvature of the normals, and given back to the parts on either side.
#include "algorithms/crease_parts.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/buffer.h"
#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "cover/components.h"
#include "stars/tangent_frame.h"
#include "tufted/normals.h"

namespace tufted {
namespace {

/// Neighbours within two degrees of a line say nothing of the turn across it: the least ratio of the determinant of
/// their second moments to the squared trace.
constexpr double least_spread = 1e-3;

class Parts {
 public:
  Parts(const Laplacian& laplacian, const Frames& frames, const SegmentOptions& options, const Workers& workers)
      : laplacian_(laplacian),
        normals_(frames.normals),
        options_(options),
        workers_(workers),
        label_(laplacian.status.size(), -1) {}

  std::vector<int> find() {
    takeSmoothSets();
    Buffer<int> left;
    for (int p = 0; p < size(); ++p)
      if (isActive(p) && label_[p] < 0) left.push_back(p);
    while (grow(left)) workers_.report("parts", 0);
    takeRest(left);
    return std::move(label_);
  }

 private:
  int size() const { return static_cast<int>(label_.size()); }
  bool isActive(int p) const { return laplacian_.status[p] == PointStatus::active; }

  /// Calls visit(q, weight) for each neighbour q of p in L.
  template <class Visit>
  void forNeighbors(int p, const Visit& visit) const {
    for (SparseMatrix::InnerIterator entry(laplacian_.L, p); entry; ++entry)
      if (entry.row() != p && entry.value() != 0) visit(static_cast<int>(entry.row()), -entry.value());
  }

  /// By how many radians the normal turns inwards over one spacing at p, in the direction in which it does most. The
  /// differences of normals over the neighbours are fitted by a symmetric matrix, the shape operator.
  double inwardTurn(int p) const {
    const double spacing = std::sqrt(laplacian_.M[p]);
    if (!(spacing > 0)) return 0;
    const Eigen::RowVector3d normal = normals_.row(p), x = tangentOf(normal.transpose()), y = normal.cross(x);
    Eigen::Matrix2d moments = Eigen::Matrix2d::Zero(), products = Eigen::Matrix2d::Zero();
    forNeighbors(p, [&](int q, double) {
      const Eigen::RowVector3d offset = (laplacian_.positions.row(q) - laplacian_.positions.row(p)) / spacing;
      const Eigen::RowVector3d change = normals_.row(q) - normal;
      const Eigen::Vector2d d(offset.dot(x), offset.dot(y));
      moments += d * d.transpose();
      products += Eigen::Vector2d(change.dot(x), change.dot(y)) * d.transpose();
    });
    const double trace = moments.trace();
    if (!(moments.determinant() > least_spread * trace * trace)) return 0;
    const Eigen::Matrix2d turn = products * moments.inverse();
    const double mean = turn.trace() / 2, shear = (turn(0, 1) + turn(1, 0)) / 2;
    return std::hypot((turn(0, 0) - turn(1, 1)) / 2, shear) - mean;
  }

  /// Labels the connected sets of points off creases that are large enough, by the least point of each. A crease is
  /// also where the mean turn of a point and its neighbours says so: one point that seems smooth would be a bridge
  /// across.
  void takeSmoothSets() {
    Buffer<double> turn(label_.size(), 0);
    workers_.forBlocks("creases", size(), usual_block, [&](std::int64_t begin, std::int64_t end, int) {
      for (int p = static_cast<int>(begin); p < end; ++p)
        if (isActive(p)) turn[p] = inwardTurn(p);
    });
    Buffer<char> is_smooth(label_.size(), 0);
    workers_.forBlocks("creases", size(), cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
      for (int p = static_cast<int>(begin); p < end; ++p) {
        double sum = turn[p];
        int points = 1;
        forNeighbors(p, [&](int q, double) {
          sum += turn[q];
          ++points;
        });
        is_smooth[p] = isActive(p) && !(std::max(turn[p], sum / points) > options_.crease) ? 1 : 0;
      }
    });
    labelSets(is_smooth, options_.least_points);
  }

  /// Labels the connected sets of at least `least` marked points.
  void labelSets(const Buffer<char>& is_marked, int least) {
    DisjointSets sets(size());
    for (int p = 0; p < size(); ++p)
      if (is_marked[p] != 0)
        forNeighbors(p, [&](int q, double) {
          if (q < p && is_marked[q] != 0) sets.unite(p, q);
        });
    Buffer<int> points(label_.size(), 0);
    for (int p = 0; p < size(); ++p) points[sets.root(p)] += is_marked[p];
    for (int p = 0; p < size(); ++p)
      if (is_marked[p] != 0 && points[sets.root(p)] >= least) label_[p] = sets.root(p);
  }

  /// Gives each point without label that of its neighbours with the greatest sum of weights, of equal ones the least.
  /// Returns whether there were any.
  /// @param[in,out] left the points without label, ascending
  bool grow(Buffer<int>& left) {
    Buffer<int> found(left.size(), -1);
    for (std::size_t i = 0; i < left.size(); ++i) found[i] = heaviestLabel(left[i]);
    Buffer<int> still_left;
    for (std::size_t i = 0; i < left.size(); ++i) {
      label_[left[i]] = found[i];
      if (found[i] < 0) still_left.push_back(left[i]);
    }
    std::swap(left, still_left);
    return left.size() < still_left.size();
  }

  int heaviestLabel(int p) const {
    int heaviest = -1;
    double most = 0;
    forNeighbors(p, [&](int q, double) {
      const int label = label_[q];
      if (label < 0 || label == heaviest) return;
      double weight = 0;
      forNeighbors(p, [&](int r, double w) { weight += label_[r] == label ? w : 0; });
      if (heaviest >= 0 && (weight < most || (weight == most && label > heaviest))) return;
      heaviest = label;
      most = weight;
    });
    return heaviest;
  }

  /// Connected components without a set that was large enough are parts of their own.
  void takeRest(const Buffer<int>& left) {
    Buffer<char> is_left(label_.size(), 0);
    for (const int p : left) is_left[p] = 1;
    labelSets(is_left, 1);
  }

  const Laplacian& laplacian_;
  const Points& normals_;
  const SegmentOptions& options_;
  const Workers& workers_;
  std::vector<int> label_;  ///< the least point of the set that a part began with
};

}  // namespace

std::vector<int> creaseParts(const Laplacian& laplacian, const Frames& frames, const SegmentOptions& options) {
  const Workers workers(options.solver.threads, options.solver.progress);
  std::optional<Frames> oriented;
  if (frames.orientation == Orientation::arbitrary)
    oriented =
        orientedFrames(laplacian, frames, {.threads = options.solver.threads, .progress = options.solver.progress});
  std::vector<int> labels = Parts(laplacian, oriented ? *oriented : frames, options, workers).find();
  numberComponents(labels);
  return labels;
}

}  // namespace tufted
