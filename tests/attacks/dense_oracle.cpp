#include "attacks/dense_oracle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <numbers>
#include <tuple>

#include "cover/dihedral_order.h"

namespace tufted::attacks {
namespace {

using Real = long double;

/// A face with less slack than this share of its longest side is taken as flat: corners on a line of a grid.
constexpr Real flat = 1e-15L;
constexpr int most_flips = 20000;
/// Angles around an edge that are smaller may be 0.
constexpr double rounding_of_angles = 1e-7;

struct TriangleFace {
  std::array<int, 3> corner;
  std::array<Real, 3> length;  ///< of the sides from corner s to corner s + 1
  std::array<int, 3> mate;     ///< 3 f + s

  Real longest() const { return *std::max_element(length.begin(), length.end()); }
  bool isFlat() const {
    const Real sum = length[0] + length[1] + length[2];
    return sum - 2 * longest() < flat * longest();
  }
  Real area() const {
    if (isFlat()) return 0;
    std::array<Real, 3> l = length;
    std::sort(l.begin(), l.end());
    const auto [c, b, a] = l;
    return std::sqrt((a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c))) / 4;
  }
  /// The cotangent of the angle opposite side s: of a flat face infinite, negative at its longest side.
  Real cotangent(int s) const {
    const Real a = length[s], b = length[(s + 1) % 3], c = length[(s + 2) % 3];
    if (isFlat()) return a == longest() ? -HUGE_VALL : HUGE_VALL;
    return (b * b + c * c - a * a) / (4 * area());
  }
};

class DenseCover {
 public:
  DenseCover(const Points& points, std::span<const StarTriangle> triangles, DenseResult& result)
      : points_(points), triangles_(triangles), result_(result) {
    for (const StarTriangle& t : triangles) {
      const auto [i, j, k] = t.corner;
      faces_.push_back(faceOf({i, j, k}));
      faces_.push_back(faceOf({i, k, j}));
    }
    glueAll();
    for (const TriangleFace& face : faces_) noteAspect(face);
  }

  void flipAll() {
    std::deque<int> waiting;
    for (int side = 0; side < sides(); ++side) waiting.push_back(side);
    while (!waiting.empty() && result_.flips < most_flips) {
      const int side = waiting.front(), mate = mateOf(side);
      waiting.pop_front();
      if (side / 3 == mate / 3 || !(cotanSum(side) < -1e-14L * cotanSize(side))) continue;
      for (const int outer : flip(side, mate)) waiting.push_back(outer);
      ++result_.flips;
    }
    result_.is_endless = !waiting.empty();
  }

  void assemble(double scale) {
    const Eigen::Index n = points_.rows();
    Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic> L = decltype(L)::Zero(n, n);
    Eigen::Matrix<Real, Eigen::Dynamic, 1> M = decltype(M)::Zero(n);
    for (int side = 0; side < sides(); ++side) {
      const TriangleFace& face = faces_[side / 3];
      const int s = side % 3, i = face.corner[s], j = face.corner[(s + 1) % 3];
      if (face.isFlat()) result_.has_flat = true;
      if (std::abs(cotanSum(side)) < 1e-9L * (1 + cotanSize(side)) && side / 3 != mateOf(side) / 3)
        result_.has_tie = true;
      M[i] += scale * face.area() / 3;
      const Real weight = scale * face.cotangent(s) / 2;
      if (i == j) continue;
      L(i, j) -= weight;
      L(j, i) -= weight;
      L(i, i) += weight;
      L(j, j) += weight;
    }
    result_.L = L.cast<double>();
    result_.M = M.cast<double>();
  }

 private:
  int sides() const { return static_cast<int>(3 * faces_.size()); }
  int mateOf(int side) const { return faces_[side / 3].mate[side % 3]; }
  Real cotanSum(int side) const { return cotan(side) + cotan(mateOf(side)); }
  Real cotanSize(int side) const {
    const Real size = std::abs(cotan(side)) + std::abs(cotan(mateOf(side)));
    return std::isfinite(size) ? size : 1;
  }
  Real cotan(int side) const { return faces_[side / 3].cotangent(side % 3); }

  Real distance(int a, int b) const {
    const auto d = (points_.row(a) - points_.row(b)).cast<Real>().eval();
    return std::hypot(d[0], d[1], d[2]);
  }
  TriangleFace faceOf(const std::array<int, 3>& c) const {
    return {c, {distance(c[0], c[1]), distance(c[1], c[2]), distance(c[2], c[0])}, {-1, -1, -1}};
  }
  void noteAspect(const TriangleFace& face) {
    if (face.isFlat()) return;
    const Real aspect = face.longest() * face.longest() / (2 * face.area());
    result_.aspect = std::max(result_.aspect, static_cast<double>(aspect));
  }

  /// Algorithm 1 around each edge. Of a cloud, the two faces of a star at a spoke have an edge of their own; all other
  /// sides between two points share one.
  void glueAll() {
    std::map<std::tuple<int, int, int>, std::vector<int>> spokes, edges;  // (low, high, star): sides 3 t + s
    const auto ends = [&](int side) {
      const auto& c = triangles_[side / 3].corner;
      return std::minmax(c[side % 3], c[(side + 1) % 3]);
    };
    for (int side = 0; side < static_cast<int>(3 * triangles_.size()); ++side) {
      const auto [low, high] = ends(side);
      const int star = triangles_[side / 3].star;
      if (star >= 0 && (low == star || high == star))
        spokes[{low, high, star}].push_back(side);
      else
        edges[{low, high, -1}].push_back(side);
    }
    for (const auto& [name, sides] : spokes) {
      auto& edge = sides.size() == 2 ? edges[name] : edges[{std::get<0>(name), std::get<1>(name), -1}];
      edge.insert(edge.end(), sides.begin(), sides.end());
    }
    for (auto& [name, sides] : edges) glueAround(std::get<0>(name), std::get<1>(name), sides);
  }

  /// The key of the library settles what is a tie but for rounding. That the order is right is measured by angles.
  void glueAround(int low, int high, std::vector<int>& sides) {
    std::sort(sides.begin(), sides.end());  // ties keep the order of the triangles
    const auto apex = [&](int side) { return triangles_[side / 3].corner[(side + 2) % 3]; };
    if (sides.size() > 2) {
      const DihedralOrder order(points_, low, high);
      std::stable_sort(sides.begin(), sides.end(),
                       [&](int a, int b) { return order.key(apex(a)) < order.key(apex(b)); });
      std::vector<int> apexes;  // those on the line of the edge may be anywhere
      for (const int side : sides)
        if (!faces_[2 * (side / 3)].isFlat()) apexes.push_back(apex(side));
      double turned = 0;  // a whole turn, or none if all lie in one half plane
      for (std::size_t i = 0; i < apexes.size(); ++i)
        turned += angle(low, high, apexes[i], apexes[(i + 1) % apexes.size()]);
      result_.worst_order = std::max(result_.worst_order, turned - 2 * std::numbers::pi);
    }
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const int plus = copyThatRuns(low, sides[i]), minus = copyThatRuns(high, sides[(i + 1) % sides.size()]);
      faces_[plus / 3].mate[plus % 3] = minus;
      faces_[minus / 3].mate[minus % 3] = plus;
    }
  }

  /// The direction of `apex`, perpendicular to the edge.
  Eigen::Vector3d direction(int low, int high, int apex) const {
    const Eigen::Vector3d axis = (points_.row(high) - points_.row(low)).normalized();
    const Eigen::Vector3d d = points_.row(apex) - points_.row(low);
    return (d - d.dot(axis) * axis).stableNormalized();
  }
  /// The angle from apex `a` to apex `b` around the edge, in [0, 2 pi), and 0 if it is 2 pi but for rounding.
  double angle(int low, int high, int a, int b) const {
    const Eigen::Vector3d axis = (points_.row(high) - points_.row(low)).normalized();
    const Eigen::Vector3d x = direction(low, high, a), d = direction(low, high, b);
    const double turned = std::atan2(axis.dot(x.cross(d)), x.dot(d));
    return turned < -rounding_of_angles ? turned + 2 * std::numbers::pi : turned;
  }

  /// The side of front or back that starts at `from`, of the triangle's side 3 t + s.
  int copyThatRuns(int from, int side) const {
    const int t = side / 3, s = side % 3;
    const int front = 6 * t + s, back = 6 * t + 3 + (2 - s);
    return faces_[2 * t].corner[s] == from ? front : back;
  }

  /// Replaces the faces (i, j, k), (j, i, m) by (k, i, m), (m, j, k) and returns the four outer sides.
  std::array<int, 4> flip(int side, int mate) {
    const int f = side / 3, g = mate / 3, s = side % 3, z = mate % 3;
    const TriangleFace a = faces_[f], b = faces_[g];
    const int jk = (s + 1) % 3, ki = (s + 2) % 3, im = (z + 1) % 3, mj = (z + 2) % 3;
    const Real base = a.length[s];
    const auto foot = [&](Real from_i, Real from_j) {
      return (base + (from_i - from_j) * (from_i + from_j) / base) / 2;
    };
    const Real across = foot(a.length[ki], a.length[jk]) - foot(b.length[im], b.length[mj]);
    const Real diagonal = std::hypot(across, 2 * (a.area() + b.area()) / base);
    const int i = a.corner[s], j = a.corner[jk], k = a.corner[ki], m = b.corner[mj];
    const std::array<int, 4> before = {3 * f + ki, 3 * g + im, 3 * g + mj, 3 * f + jk};
    const std::array<int, 4> now = {3 * f, 3 * f + 1, 3 * g, 3 * g + 1};
    std::array<int, 4> outer;
    for (int e = 0; e < 4; ++e) {
      outer[e] = mateOf(before[e]);
      for (int o = 0; o < 4; ++o)
        if (mateOf(before[e]) == before[o]) outer[e] = now[o];
    }
    faces_[f] = {{k, i, m}, {a.length[ki], b.length[im], diagonal}, {outer[0], outer[1], 3 * g + 2}};
    faces_[g] = {{m, j, k}, {b.length[mj], a.length[jk], diagonal}, {outer[2], outer[3], 3 * f + 2}};
    for (int e = 0; e < 4; ++e) faces_[outer[e] / 3].mate[outer[e] % 3] = now[e];
    noteAspect(faces_[f]);
    noteAspect(faces_[g]);
    return now;
  }

  const Points& points_;
  std::span<const StarTriangle> triangles_;
  DenseResult& result_;
  std::vector<TriangleFace> faces_;
};

}  // namespace

DenseResult denseLaplacian(const Points& points, std::span<const StarTriangle> triangles, double scale) {
  DenseResult result;
  DenseCover cover(points, triangles, result);
  cover.flipAll();
  cover.assemble(scale);
  return result;
}

}  // namespace tufted::attacks
