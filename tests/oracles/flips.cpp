#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include "oracles/oracles.h"

namespace tufted::oracles {
namespace {

using Real = long double;

/// Side k of a face is opposite its corner k.
struct Side {
  int face = -1, k = 0;
  bool operator==(const Side&) const = default;
};

struct Face {
  std::array<int, 3> corner;
  std::array<Real, 3> length;
  std::array<Side, 3> across;

  int next(int k) const { return (k + 1) % 3; }
  /// The area by Kahan's formula.
  Real area() const {
    auto [a, b, c] = length;
    if (a < b) std::swap(a, b);
    if (a < c) std::swap(a, c);
    if (b < c) std::swap(b, c);
    return std::sqrt(std::max<Real>(0, (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c)))) / 4;
  }
  Real cotangent(int k) const {
    const Real a = length[k], b = length[(k + 1) % 3], c = length[(k + 2) % 3];
    return (b * b + c * c - a * a) / (4 * area());
  }
};

class Flipper {
 public:
  Flipper(const Points& points, const Triangles& triangles) {
    std::map<std::pair<int, int>, Side> sides;
    for (int f = 0; f < triangles.rows(); ++f) {
      Face face;
      for (int k = 0; k < 3; ++k) {
        const int from = triangles(f, (k + 1) % 3), to = triangles(f, (k + 2) % 3);
        face.corner[k] = triangles(f, k);
        face.length[k] = (points.row(to).cast<Real>() - points.row(from).cast<Real>()).norm();
        if (!sides.insert({{from, to}, {f, k}}).second) throw std::runtime_error("flippedLaplacian: not oriented");
      }
      faces_.push_back(face);
    }
    for (const auto& [edge, side] : sides) {
      const auto other = sides.find({edge.second, edge.first});
      if (other == sides.end()) throw std::runtime_error("flippedLaplacian: not closed");
      at(side) = other->second;
      waiting_.push_back(side);
    }
  }

  void run() {
    while (!waiting_.empty()) {
      const Side side = waiting_.front();
      waiting_.pop_front();
      const Side other = at(side);
      const Real one = cotangent(side), two = cotangent(other);
      if (side.face != other.face && one + two < -1e-12L * std::min(std::abs(one), std::abs(two))) flip(side, other);
    }
  }

  Operators operators(Eigen::Index n) const {
    std::vector<Eigen::Triplet<double>> entries;
    VectorXd mass = VectorXd::Zero(n);
    for (const Face& face : faces_) {
      for (int k = 0; k < 3; ++k) {
        const int i = face.corner[(k + 1) % 3], j = face.corner[(k + 2) % 3];
        const auto weight = static_cast<double>(face.cotangent(k) / 2);
        entries.insert(entries.end(), {{i, j, -weight}, {j, i, -weight}, {i, i, weight}, {j, j, weight}});
        mass[face.corner[k]] += static_cast<double>(face.area() / 3);
      }
    }
    SparseMatrix L(n, n);
    L.setFromTriplets(entries.begin(), entries.end());
    return {L, mass};
  }

 private:
  Side& at(const Side& side) { return faces_[side.face].across[side.k]; }
  Real cotangent(const Side& side) const { return faces_[side.face].cotangent(side.k); }

  /// Replaces the faces p u v and q v u by p u q and q v p.
  void flip(const Side& side, const Side& other) {
    const Face one = faces_[side.face], two = faces_[other.face];
    const int i = side.k, i1 = one.next(i), i2 = one.next(i1), j = other.k, j1 = two.next(j), j2 = two.next(j1);
    const Real l = one.length[i];
    const Real along = (one.length[i2] * one.length[i2] - one.length[i1] * one.length[i1] -
                        two.length[j1] * two.length[j1] + two.length[j2] * two.length[j2]) /
                       (2 * l);
    const Real crossing = std::hypot(along, 2 * (one.area() + two.area()) / l);
    const int p = one.corner[i], u = one.corner[i1], v = one.corner[i2], q = two.corner[j];
    faces_[side.face] = {{p, u, q}, {two.length[j1], crossing, one.length[i2]}, {}};
    faces_[other.face] = {{q, v, p}, {one.length[i1], crossing, two.length[j2]}, {}};
    // Old and new places of the four outer sides, two of which may be glued to each other.
    const int f = side.face, g = other.face;
    const std::array<std::pair<Side, Side>, 4> moved = {
        {{{g, j1}, {f, 0}}, {{f, i2}, {f, 2}}, {{f, i1}, {g, 0}}, {{g, j2}, {g, 2}}}};
    for (const auto& [before, now] : moved) {
      Side glued = before.face == f ? one.across[before.k] : two.across[before.k];
      for (const auto& [old, place] : moved) {
        if (glued != old) continue;
        glued = place;
        break;
      }
      at(now) = glued;
      at(glued) = now;
      waiting_.push_back(now);
    }
    at({f, 1}) = {g, 1};
    at({g, 1}) = {f, 1};
  }

  std::vector<Face> faces_;
  std::deque<Side> waiting_;  ///< sides to examine, some of them twice, because sides of faces change
};

}  // namespace

Operators flippedLaplacian(const Points& points, const Triangles& triangles) {
  Flipper flipper(points, triangles);
  flipper.run();
  return flipper.operators(points.rows());
}

}  // namespace tufted::oracles
