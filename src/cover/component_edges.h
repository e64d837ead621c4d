#pragma once

#include <cstdint>
#include <utility>

#include "base/buffer.h"
#include "base/parallel.h"
#include "tufted/laplacian.h"

namespace tufted {

/// Number of sides, and sums of lengths and squares.
struct SideSums {
  std::int64_t sides = 0;
  double length = 0, square = 0;

  void add(double side) {
    ++sides;
    length += side;
    square += side * side;
  }
  void add(const SideSums& others) {
    sides += others.sides;
    length += others.length;
    square += others.square;
  }
};

/// Mean lengths of the sides of items by component, with the same bits for any number of threads.
/// @param components number of components
/// @param componentOf componentOf(i): the component of item i; -1: the item is left out
/// @param addSides addSides(i, sums): adds the sides of item i to `sums`
template <class ComponentOf, class AddSides>
Buffer<ComponentEdges> edgesByComponent(std::int64_t items, std::int64_t components, const Workers& workers,
                                        const ComponentOf& componentOf, const AddSides& addSides) {
  // Consecutive items mostly belong to one component, so a block has few runs.
  using Runs = Buffer<std::pair<int, SideSums>>;
  Buffer<Runs> blocks((items + cheap_block - 1) / cheap_block);
  workers.forBlocks("lengths", items, cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
    Runs& runs = blocks[begin / cheap_block];
    for (auto i = static_cast<int>(begin); i < end; ++i) {
      const int component = componentOf(i);
      if (component < 0) continue;
      if (runs.empty() || runs.back().first != component) runs.push_back({component, {}});
      addSides(i, runs.back().second);
    }
  });
  Buffer<SideSums> sums(static_cast<std::size_t>(components));
  for (const Runs& runs : blocks)
    for (const auto& [component, added] : runs) sums[component].add(added);
  Buffer<ComponentEdges> edges;
  edges.reserve(sums.size());
  for (const auto& [sides, length, square] : sums) {
    const auto count = static_cast<double>(sides > 0 ? sides : 1);
    edges.push_back({sides, length / count, square / count});
  }
  return edges;
}

}  // namespace tufted
