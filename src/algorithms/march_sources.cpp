#include "algorithms/march_sources.h"

#include <algorithm>
#include <bit>

#include "algorithms/march_heap.h"
#include "algorithms/march_views.h"

namespace tufted {

std::vector<std::span<const MarchStart>> spreadSources(const std::vector<MarchStart>& starts) {
  std::vector<std::span<const MarchStart>> sources, result;
  for (auto first = starts.begin(); first != starts.end();) {
    const auto last = std::find_if(first, starts.end(), [&](const MarchStart& s) { return s.source != first->source; });
    sources.emplace_back(first, last);
    first = last;
  }
  const std::size_t count = std::bit_ceil(sources.size());
  for (std::size_t i = 0; i < count; ++i) {
    std::size_t place = 0;
    for (std::size_t bit = 1, mirrored = count / 2; mirrored > 0; bit *= 2, mirrored /= 2)
      if ((i & bit) != 0) place |= mirrored;
    if (place < sources.size()) result.push_back(sources[place]);
  }
  return result;
}

void boundAlongEdges(const MarchFaces& faces, const std::vector<MarchStart>& starts, std::vector<double>& bound) {
  const WholeFaces whole{faces};
  MarchHeap heap(whole.size());
  const auto lower = [&](int vertex, double distance) {
    if (!(distance < bound[vertex])) return;
    bound[vertex] = distance;
    heap.lower(vertex, distance);
  };
  for (const MarchStart& start : starts)
    if (start.vertex < faces.vertices) lower(start.vertex, start.distance);
  while (!heap.empty()) {
    const int a = heap.top().number;
    heap.pop();
    whole.around(a, [&](const MarchTriangle& t) {
      lower(t.b, bound[a] + t.ab);
      lower(t.c, bound[a] + t.ac);
    });
  }
  for (std::size_t m = whole.size(); m < bound.size(); ++m) {
    const int side = faces.edge_slots[faces.edge_offset[static_cast<int>(m) - faces.vertices]];
    const double nearer = std::min(bound[faces.vertexAt(nextSide(side))], bound[faces.vertexAt(previousSide(side))]);
    bound[m] = std::min(bound[m], nearer + faces.lengthAt(side) / 2);
  }
}

}  // namespace tufted
