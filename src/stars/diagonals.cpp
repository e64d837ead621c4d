#include "stars/diagonals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/pseudo_angle.h"
#include "stars/agreement.h"

namespace tufted {
namespace {

// Bounds on the difference of two sums of opposite angles. Sums are compared as pseudo-angles, whose differences equal
// those in rad near two right angles, as in cells of grids.

/// Sums that differ by less than this count as equal; those of exact rectangles differ by rounding, 1e-15.
constexpr double equal_sums = 1e-9;
/// If sums differ by more than this each star keeps its diagonal: the surface is barely resolved there. Cells of grids
/// differ by less than 0.003; with 0.03 real shapes have 1.03 times the error.
constexpr double most_difference = 0.01;
/// Neighbours that a closed star keeps at least; two triangles back to back are no surface.
constexpr int least_degree = 3;

/// What the star of a corner v of a quadrilateral contains between the two corners beside v.
struct Corner {
  /// link entry of the far corner if the star has it in its link, else of the triangle (v, x, y); -1: neither
  int entry = -1;
  bool sees = false;  ///< whether the far corner is in the link

  /// @param x,y beside v; `far` is opposite
  Corner(const Stars& stars, int v, int x, int far, int y) {
    int at_x = -1, at_y = -1, at_far = -1;
    for (int i = stars.offset[v]; i < stars.offset[v + 1]; ++i) {
      const int q = stars.link[i];
      if (q == x) at_x = i;
      if (q == y) at_y = i;
      if (q == far) at_far = i;
    }
    if (at_x < 0 || at_y < 0) return;
    if (at_far >= 0) {
      const int previous = before(stars, v, at_far), next = stars.after(v, at_far);
      const bool is_between = (previous == at_x && next == at_y) || (previous == at_y && next == at_x);
      if (is_between && stars.hasTriangle(previous) && stars.hasTriangle(at_far)) take(at_far, true);
    } else if (stars.after(v, at_x) == at_y && stars.hasTriangle(at_x)) {
      take(at_x, false);
    } else if (stars.after(v, at_y) == at_x && stars.hasTriangle(at_y)) {
      take(at_y, false);
    }
  }

 private:
  void take(int at, bool sees_far) {
    entry = at;
    sees = sees_far;
  }
};

/// A quadrilateral whose stars chose different diagonals, its corners in cyclic order.
struct Quadrilateral {
  std::array<int, 4> corner;
  std::array<int, 4> entry;     ///< see Corner
  std::array<bool, 4> changes;  ///< stars that must gain or lose their far corner
  std::array<bool, 4> sees;
};

/// Pseudo-angle of the sum of two angles in [0, pi], given as (cosine, sine); increases with the sum.
double pseudoSum(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return pseudoAngle(a[0] * b[0] - a[1] * b[1], a[1] * b[0] + a[0] * b[1]);
}

bool isBefore(const Eigen::RowVector3d& a, const Eigen::RowVector3d& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

enum class Diagonal { first, other, both };

/// Chooses the diagonal: from corner 0 to corner 2, the other, or whatever each star has (`both`). The answer is the
/// same, to the last bit, whichever corner comes first.
Diagonal diagonalOf(const PointsView& points, const std::array<int, 4>& corner) {
  std::array<Eigen::RowVector3d, 4> place, side;
  for (int k = 0; k < 4; ++k) place[k] = points.row(corner[k]);
  for (int k = 0; k < 4; ++k) {
    side[k] = place[(k + 1) % 4] - place[k];
    side[k] /= side[k].norm();
  }
  std::array<Eigen::Vector2d, 4> angle;  // cosine and sine
  for (int k = 0; k < 4; ++k) {
    const Eigen::RowVector3d &in = side[(k + 3) % 4], &out = side[k];
    angle[k] = {-in.dot(out), in.cross(out).norm()};
  }
  const double opposite_first = pseudoSum(angle[1], angle[3]), opposite_other = pseudoSum(angle[0], angle[2]);
  const double difference = std::abs(opposite_first - opposite_other);
  if (difference > most_difference) return Diagonal::both;
  bool keeps_first = opposite_first < opposite_other;
  if (!(difference > equal_sums)) {
    const auto first = std::min_element(place.begin(), place.end(), isBefore);
    keeps_first = (first - place.begin()) % 2 == 0;
  }
  return keeps_first ? Diagonal::first : Diagonal::other;
}

class DiagonalSettler {
 public:
  DiagonalSettler(const PointsView& points, const Buffer<std::uint8_t>& disagrees, Stars& stars)
      : points_(points), disagrees_(disagrees), stars_(stars), claims_(stars.link.size()) {}

  /// Finds the quadrilaterals in which p has the least rank, and claims the triangles of their corners.
  void find(int p, Buffer<Quadrilateral>& found) {
    if (disagrees_[p] == 0) return;
    for (int i = stars_.offset[p]; i < stars_.offset[p + 1]; ++i) {
      if (!stars_.hasTriangle(i)) continue;
      const int a = stars_.link[i], next = stars_.after(p, i), b = stars_.link[next];
      if (a < p || disagrees_[a] == 0) continue;
      if (stars_.hasTriangle(next)) judge({p, a, b, stars_.link[stars_.after(p, next)]}, true, found);
      if (b < p) continue;
      const int j = entryOf(stars_, a, p);
      if (j < 0) continue;
      // The far corner is beside p in the star of a, or beyond b.
      const int left = farCorner(a, j, b, true), right = farCorner(a, j, b, false);
      if (left != p) judge({p, a, left, b}, false, found);
      if (right != left && right != p) judge({p, a, right, b}, false, found);
    }
  }

  /// Whether no other quadrilateral claims a triangle of this one, and all closed stars keep enough neighbours.
  bool isFree(const Quadrilateral& quad) const {
    for (int k = 0; k < 4; ++k) {
      const int v = quad.corner[k], i = quad.entry[k];
      if (claims_[i] >> 1 != 1 || (quad.sees[k] && claims_[before(stars_, v, i)] >> 1 != 1)) return false;
      if (!quad.sees[k] || !quad.changes[k] || stars_.ends[v] != 0) continue;
      int left = 0;
      for (int j = stars_.offset[v]; j < stars_.offset[v + 1]; ++j) left += claims_[j] % 2 == 0 ? 1 : 0;
      if (left < least_degree) return false;
    }
    return true;
  }

  void prepareChanges() { change_.assign(stars_.link.size(), unchanged); }

  /// Records the changes of a quadrilateral; false if it is not free.
  bool change(const Quadrilateral& quad) {
    if (!isFree(quad)) return false;
    for (int k = 0; k < 4; ++k)
      if (quad.changes[k]) change_[quad.entry[k]] = quad.sees[k] ? dropped : quad.corner[(k + 2) % 4];
    return true;
  }

  void rebuild(const Workers& workers) {
    Buffer<int> offset(stars_.offset.size());
    const auto forEachStar = [&](const auto& visit) {
      workers.forBlocks("diagonals", stars_.size(), cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
        for (int p = static_cast<int>(begin); p < end; ++p) visit(p);
      });
    };
    forEachStar([&](int p) {
      int size = 0;
      for (int i = stars_.offset[p]; i < stars_.offset[p + 1]; ++i)
        size += change_[i] == unchanged ? 1 : change_[i] == dropped ? 0 : 2;
      offset[p + 1] = size;
    });
    std::partial_sum(offset.begin(), offset.end(), offset.begin());
    RawBuffer<int> link(static_cast<std::size_t>(offset.back()));
    RawBuffer<std::uint8_t> triangle(link.size());
    forEachStar([&](int p) {
      int to = offset[p];
      for (int i = stars_.offset[p]; i < stars_.offset[p + 1]; ++i) {
        if (change_[i] == dropped) continue;
        link[to] = stars_.link[i];
        triangle[to++] = stars_.triangle[i];
        if (change_[i] < 0) continue;
        link[to] = change_[i];
        triangle[to++] = 1;
      }
    });
    stars_.offset = std::move(offset);
    stars_.link = std::move(link);
    stars_.triangle = std::move(triangle);
  }

 private:
  enum Change : int { unchanged = -1, dropped = -2 };

  /// The link vertex of star a next to link vertex j (which is p) on one side, or the one after if that is b; p if
  /// there is none.
  int farCorner(int a, int j, int b, bool forward) const {
    const int p = stars_.link[j];
    for (int steps = 0; steps < 2; ++steps) {
      const int triangle = forward ? j : before(stars_, a, j);
      if (!stars_.hasTriangle(triangle)) return p;
      j = forward ? stars_.after(a, j) : triangle;
      if (stars_.link[j] != b) return stars_.link[j];
    }
    return p;
  }

  /// Adds a quadrilateral whose stars disagree to `found` and claims its triangles.
  /// @param sees whether the star of corner 0, the least, must have the far corner in its link
  void judge(const std::array<int, 4>& corner, bool sees, Buffer<Quadrilateral>& found) {
    if (corner[1] == corner[3]) return;
    for (int k = 1; k < 4; ++k)
      if (corner[k] < corner[0] || disagrees_[corner[k]] == 0) return;
    Quadrilateral quad{.corner = corner, .entry = {}, .changes = {}, .sees = {}};
    for (int k = 0; k < 4; ++k) {
      const Corner here(stars_, corner[k], corner[(k + 3) % 4], corner[(k + 2) % 4], corner[(k + 1) % 4]);
      if (here.entry < 0 || (k == 0 && here.sees != sees)) return;
      quad.entry[k] = here.entry;
      quad.sees[k] = here.sees;
    }
    if (quad.sees[0] == quad.sees[2] && quad.sees[1] == quad.sees[3] && quad.sees[0] != quad.sees[1]) return;
    const Diagonal kept = diagonalOf(points_, quad.corner);
    if (kept == Diagonal::both) return;
    for (int k = 0; k < 4; ++k) quad.changes[k] = quad.sees[k] != ((k % 2 == 0) == (kept == Diagonal::first));
    for (int k = 0; k < 4; ++k) {
      claim(quad.entry[k], quad.sees[k] && quad.changes[k] ? 3 : 2);
      if (quad.sees[k]) claim(before(stars_, quad.corner[k], quad.entry[k]), 2);
    }
    found.push_back(quad);
  }

  void claim(int entry, std::uint8_t marks) {
    std::atomic_ref(claims_[entry]).fetch_add(marks, std::memory_order_relaxed);
  }

  const PointsView& points_;
  const Buffer<std::uint8_t>& disagrees_;
  Stars& stars_;
  /// per link entry: twice the number of claims on its triangle, plus 1 if it will be dropped
  Buffer<std::uint8_t> claims_;
  Buffer<int> change_;  ///< per link entry: a vertex to insert after it, `dropped` or `unchanged`
};

}  // namespace

std::int64_t settleDiagonals(const PointsView& points, const Buffer<std::uint8_t>& disagrees, const Workers& workers,
                             Stars& stars) {
  DiagonalSettler settler(points, disagrees, stars);
  Buffer<Buffer<Quadrilateral>> found(static_cast<std::size_t>((stars.size() + cheap_block - 1) / cheap_block));
  workers.forBlocks("diagonals", stars.size(), cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (int p = static_cast<int>(begin); p < end; ++p) settler.find(p, found[begin / cheap_block]);
  });
  if (std::all_of(found.begin(), found.end(), [](const auto& quads) { return quads.empty(); })) return 0;
  settler.prepareChanges();
  std::atomic<std::int64_t> settled{0};
  workers.forBlocks("diagonals", std::ssize(found), 1, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t block = begin; block < end; ++block)
      for (const Quadrilateral& quad : found[block])
        if (settler.change(quad)) settled.fetch_add(1, std::memory_order_relaxed);
  });
  if (settled > 0) settler.rebuild(workers);
  return settled;
}

}  // namespace tufted
