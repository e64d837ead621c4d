#include "operators/distinct_faces.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace tufted {
namespace {

/// Merges equal faces that follow one another.
void mergeEqual(std::vector<DistinctFace>& faces) {
  std::size_t kept = 0;
  for (const DistinctFace& face : faces) {
    if (kept > 0 && faces[kept - 1].isCopyOf(face))
      faces[kept - 1].copies += face.copies;
    else
      faces[kept++] = face;
  }
  faces.resize(kept);
}

/// @param forEachLength forEachLength(visit) calls visit(length) for all lengths, in the same order each time
template <class ForEachLength>
int exponentOfMean(const ForEachLength& forEachLength) {
  double largest = 0, sum = 0;
  std::int64_t count = 0;
  forEachLength([&](double length) { largest = std::max(largest, length); });
  if (!(largest > 0) || !std::isfinite(largest)) return 0;
  forEachLength([&](double length) {
    sum += length / largest;
    ++count;
  });
  return std::ilogb(largest) + std::ilogb(sum / static_cast<double>(count));
}

}  // namespace

DistinctFace distinctFace(const std::array<int, 3>& corners, const std::array<double, 3>& opposite) {
  std::array<std::pair<int, double>, 3> parts;
  for (int s = 0; s < 3; ++s) parts[s] = {corners[s], opposite[s]};
  std::sort(parts.begin(), parts.end());
  return {{parts[0].first, parts[1].first, parts[2].first}, {parts[0].second, parts[1].second, parts[2].second}};
}

void mergeCopies(std::vector<DistinctFace>& faces) {
  std::sort(faces.begin(), faces.end());
  mergeEqual(faces);
}

std::vector<DistinctFace> distinctFaces(const CoverSource& cover, int vertices, const Workers& workers,
                                        const std::vector<int>& number) {
  // Most copies of a triangle are in the same block. They are merged there, as all together would take much memory.
  std::vector<std::vector<DistinctFace>> blocks((cover.parts() + usual_block - 1) / usual_block);
  workers.forBlocks("faces", cover.parts(), usual_block, [&](std::int64_t begin, std::int64_t end, int) {
    std::vector<DistinctFace> found;
    cover.visitFaces(begin, end, [&](const std::array<int, 3>& corners, const double* length) {
      const auto& [a, b, c] = corners;
      const DistinctFace face = distinctFace(number.empty() ? corners : std::array{number[a], number[b], number[c]},
                                             {length[1], length[2], length[0]});
      if (!found.empty() && found.back().isCopyOf(face))  // the back of a triangle follows its front
        ++found.back().copies;
      else
        found.push_back(face);
    });
    mergeCopies(found);
    blocks[begin / usual_block].assign(found.begin(), found.end());
  });
  std::vector<int> offset(static_cast<std::size_t>(vertices) + 1, 0);
  for (const auto& block : blocks)
    for (const DistinctFace& face : block) ++offset[face.corners[0] + 1];
  std::partial_sum(offset.begin(), offset.end(), offset.begin());
  std::vector<DistinctFace> faces(static_cast<std::size_t>(offset.back()));
  std::vector<int> fill(offset.begin(), offset.end() - 1);
  for (auto& block : blocks) {
    for (const DistinctFace& face : block) faces[fill[face.corners[0]]++] = face;
    release(block);
  }
  for (int v = 0; v < vertices; ++v) std::sort(faces.begin() + offset[v], faces.begin() + offset[v + 1]);
  mergeEqual(faces);
  return faces;
}

int unitOf(const CoverSource& cover) {
  return exponentOfMean([&](const auto& visit) {
    cover.visitFaces(0, cover.parts(), [&](const std::array<int, 3>&, const double* length) {
      for (int s = 0; s < 3; ++s) visit(length[s]);
    });
  });
}

int unitOf(const std::vector<DistinctFace>& faces) {
  return exponentOfMean([&](const auto& visit) {
    for (const DistinctFace& face : faces)
      for (const double length : face.opposite) visit(length);
  });
}

}  // namespace tufted
