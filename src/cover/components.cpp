#include "cover/components.h"

#include <algorithm>
#include <tuple>

#include "base/buffer.h"
#include "base/disjoint_sets.h"

namespace tufted {
namespace {

/// Connected sets of the rows of L; a row without entries is a set by itself.
DisjointSets joinedSets(const SparseMatrix& L) {
  DisjointSets sets(L.cols());
  for (int j = 0; j < L.cols(); ++j)
    for (int k = L.outerIndexPtr()[j]; k < L.outerIndexPtr()[j + 1] && L.innerIndexPtr()[k] < j; ++k)
      sets.unite(L.innerIndexPtr()[k], j);
  return sets;
}

bool hasRow(const SparseMatrix& L, int i) {
  return L.outerIndexPtr()[i] < L.outerIndexPtr()[i + 1];
}

struct Set {
  int points, first, number;
};

}  // namespace

void numberComponents(std::vector<int>& set) {
  Buffer<Set> sets;
  Buffer<int> place(set.size(), -1);  // position of a set in `sets`
  for (int i = 0; i < static_cast<int>(set.size()); ++i) {
    if (set[i] < 0) continue;
    int& number = place[set[i]];
    if (number < 0) {
      number = static_cast<int>(sets.size());
      sets.push_back({0, i, number});
    }
    set[i] = number;
    ++sets[number].points;
  }
  std::sort(sets.begin(), sets.end(),
            [](const Set& a, const Set& b) { return std::tie(b.points, a.first) < std::tie(a.points, b.first); });
  for (std::size_t k = 0; k < sets.size(); ++k) place[sets[k].number] = static_cast<int>(k);
  for (int& number : set)
    if (number >= 0) number = place[number];
}

std::vector<int> componentsOf(const SparseMatrix& L) {
  DisjointSets sets = joinedSets(L);
  std::vector<int> component(static_cast<std::size_t>(L.cols()), -1);
  for (int i = 0; i < L.cols(); ++i)
    if (hasRow(L, i)) component[i] = sets.root(i);
  numberComponents(component);
  return component;
}

std::int64_t countComponents(const SparseMatrix& L) {
  DisjointSets sets = joinedSets(L);
  std::int64_t components = 0;
  for (int i = 0; i < L.cols(); ++i) components += hasRow(L, i) && sets.root(i) == i ? 1 : 0;
  return components;
}

}  // namespace tufted
