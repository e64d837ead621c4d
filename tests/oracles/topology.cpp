#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "oracles/oracles.h"

namespace tufted::oracles {
namespace {

class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<std::size_t> parent_;
};

struct Use {
  std::size_t face;
  bool rising;  // whether the face runs from the smaller to the larger vertex
};

}  // namespace

Topology topology(const Triangles& all) {
  std::vector<std::array<int, 3>> faces;
  for (Eigen::Index f = 0; f < all.rows(); ++f) {
    const int a = all(f, 0), b = all(f, 1), c = all(f, 2);
    if (a != b && b != c && c != a) faces.push_back({a, b, c});
  }
  std::map<std::pair<int, int>, std::vector<Use>> edges;
  std::map<int, std::vector<std::size_t>> stars;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int i = faces[f][k], j = faces[f][(k + 1) % 3];
      edges[std::minmax(i, j)].push_back({f, i < j});
      stars[i].push_back(f);
    }
  }

  Topology result;
  result.euler = static_cast<int>(stars.size()) - static_cast<int>(edges.size()) + static_cast<int>(faces.size());
  // Two copies of each face, one per orientation: not orientable if the two copies of a face are connected.
  UnionFind sides(2 * faces.size());
  for (const auto& [edge, uses] : edges) {
    if (uses.size() == 1) ++result.boundary_edges;
    if (uses.size() > 2) ++result.nonmanifold_edges;
    if (uses.size() != 2) continue;
    const bool flip = uses[0].rising == uses[1].rising;
    sides.join(2 * uses[0].face, 2 * uses[1].face + flip);
    sides.join(2 * uses[0].face + 1, 2 * uses[1].face + !flip);
  }
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (sides.root(2 * f) == sides.root(2 * f + 1)) result.orientable = false;
  }

  UnionFind corners(3 * faces.size()), pieces(faces.size());
  const auto corner = [&](std::size_t f, int vertex) {
    return 3 * f + (faces[f][0] == vertex ? 0 : faces[f][1] == vertex ? 1 : 2);
  };
  for (const auto& [edge, uses] : edges) {
    for (const Use& use : uses) {
      corners.join(corner(uses[0].face, edge.first), corner(use.face, edge.first));
      corners.join(corner(uses[0].face, edge.second), corner(use.face, edge.second));
    }
  }
  for (const auto& [vertex, star] : stars) {
    std::set<std::size_t> fans;
    for (const std::size_t f : star) {
      fans.insert(corners.root(corner(f, vertex)));
      pieces.join(star[0], f);
    }
    if (fans.size() > 1) ++result.nonmanifold_vertices;
  }
  for (std::size_t f = 0; f < faces.size(); ++f) result.components += pieces.root(f) == f;
  return result;
}

}  // namespace tufted::oracles
