#include "operators/distinct_faces.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace tufted {
namespace {

std::array<int, 3> cornersOf(const IntrinsicTriangulation& cover, std::int64_t face, const std::vector<int>& number) {
  const auto& [a, b, c] = cover.faces[face];
  return number.empty() ? cover.faces[face] : std::array{number[a], number[b], number[c]};
}

/// The faces, grouped by their smallest corner.
/// @param[out] offset vertices + 1; first place of each corner's faces
std::vector<int> facesByCorner(const IntrinsicTriangulation& cover, const std::vector<int>& number,
                               std::vector<int>& offset) {
  const auto owner = [&](std::int64_t face) {
    const std::array<int, 3> corners = cornersOf(cover, face, number);
    return *std::min_element(corners.begin(), corners.end());
  };
  offset.assign(static_cast<std::size_t>(cover.vertices) + 1, 0);
  for (std::int64_t f = 0; f < cover.size(); ++f) ++offset[owner(f) + 1];
  std::partial_sum(offset.begin(), offset.end(), offset.begin());
  std::vector<int> list(cover.faces.size()), fill(offset.begin(), offset.end() - 1);
  for (std::int64_t f = 0; f < cover.size(); ++f) list[fill[owner(f)]++] = static_cast<int>(f);
  return list;
}

}  // namespace

DistinctFace distinctFace(const std::array<int, 3>& corners, const std::array<double, 3>& opposite) {
  std::array<std::pair<int, double>, 3> parts;
  for (int s = 0; s < 3; ++s) parts[s] = {corners[s], opposite[s]};
  std::sort(parts.begin(), parts.end());
  return {{parts[0].first, parts[1].first, parts[2].first}, {parts[0].second, parts[1].second, parts[2].second}};
}

DistinctFace distinctFace(const IntrinsicTriangulation& cover, int face, const std::vector<int>& number) {
  const double* const length = cover.length.data() + 3 * std::int64_t{face};
  return distinctFace(cornersOf(cover, face, number), {length[1], length[2], length[0]});
}

void mergeCopies(std::vector<DistinctFace>& faces) {
  std::sort(faces.begin(), faces.end());
  std::size_t kept = 0;
  for (const DistinctFace& face : faces) {
    if (kept > 0 && faces[kept - 1].isCopyOf(face))
      faces[kept - 1].copies += face.copies;
    else
      faces[kept++] = face;
  }
  faces.resize(kept);
}

std::vector<DistinctFace> distinctFaces(const IntrinsicTriangulation& cover, const Workers& workers,
                                        const std::vector<int>& number) {
  std::vector<int> offset;
  const std::vector<int> list = facesByCorner(cover, number, offset);
  std::vector<std::vector<DistinctFace>> parts((cover.vertices + cheap_block - 1) / cheap_block);
  workers.forBlocks("faces", cover.vertices, cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
    std::vector<DistinctFace> around;
    for (auto v = begin; v < end; ++v) {
      around.clear();
      for (int i = offset[v]; i < offset[v + 1]; ++i) around.push_back(distinctFace(cover, list[i], number));
      mergeCopies(around);
      parts[begin / cheap_block].insert(parts[begin / cheap_block].end(), around.begin(), around.end());
    }
  });
  std::vector<DistinctFace> faces;
  for (auto& part : parts) {
    faces.insert(faces.end(), part.begin(), part.end());
    part = {};
  }
  return faces;
}

int unitOf(const std::vector<double>& lengths) {
  double largest = 0;
  for (const double length : lengths) largest = std::max(largest, length);
  if (!(largest > 0) || !std::isfinite(largest)) return 0;
  double sum = 0;
  for (const double length : lengths) sum += length / largest;
  return std::ilogb(largest) + std::ilogb(sum / static_cast<double>(lengths.size()));
}

}  // namespace tufted
