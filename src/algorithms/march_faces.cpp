#include "algorithms/march_faces.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "base/cover_source.h"
#include "base/power_of_two.h"
#include "base/stage_clock.h"
#include "cover/geometry.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// Each face is cut into four at most this many times: three would take 64 times the memory of none.
constexpr int most_splits = 2;
/// By default, surfaces of up to this many points are cut twice: their triangles are coarse, and a query takes some 30
/// ms.
constexpr std::int64_t few_points = 5000;
/// Sides with the same ends are one edge if their lengths differ by at most this part: flips on front and back round
/// differently.
constexpr double equal_lengths = 1e-9;
/// A side that is longer than the straight line between its ends by more than this part was flipped around an edge in
/// space or mollified. Flips in a plane round by less.
constexpr double straight_side = 1e-12;

/// A side, stored at its end with the smaller number.
struct Side {
  int other;  ///< the end with the larger number
  double length;
  int slot;

  bool operator<(const Side& side) const {
    return std::tie(other, length, slot) < std::tie(side.other, side.length, side.slot);
  }
  bool isOneWith(const Side& side) const {
    return other == side.other && std::abs(length - side.length) <= equal_lengths * length;
  }
};

void groupByCorner(MarchFaces& result) {
  result.corner_offset.assign(static_cast<std::size_t>(result.vertices) + 1, 0);
  for (const MarchFace& face : result.faces)
    for (const int corner : face.corners) ++result.corner_offset[corner + 1];
  std::partial_sum(result.corner_offset.begin(), result.corner_offset.end(), result.corner_offset.begin());
  std::vector<int> fill(result.corner_offset.begin(), result.corner_offset.end() - 1);
  result.corner_slots.resize(3 * result.faces.size());
  for (std::size_t f = 0; f < result.faces.size(); ++f)
    for (int k = 0; k < 3; ++k) result.corner_slots[fill[result.faces[f].corners[k]]++] = static_cast<int>(3 * f) + k;
}

/// The sides whose smaller end is a vertex, sorted. Corners of faces ascend, so a face has two such sides at its first
/// corner, one at the second and none at the third.
void sidesAt(const MarchFaces& faces, int vertex, std::vector<Side>& sides) {
  sides.clear();
  const auto add = [&](int face, int side, int far) {
    sides.push_back({faces.faces[face].corners[far], faces.faces[face].opposite[side], 3 * face + side});
  };
  for (int i = faces.corner_offset[vertex]; i < faces.corner_offset[vertex + 1]; ++i) {
    const int face = faces.corner_slots[i] / 3, corner = faces.corner_slots[i] % 3;
    if (corner == 0) {
      add(face, 2, 1);
      add(face, 1, 2);
    } else if (corner == 1) {
      add(face, 0, 2);
    }
  }
  std::sort(sides.begin(), sides.end());
}

void groupByEdge(MarchFaces& result, const Workers& workers) {
  std::vector<int> first(static_cast<std::size_t>(result.vertices) + 1, 0);  // place of the sides of each vertex
  for (const MarchFace& face : result.faces) {
    first[face.corners[0] + 1] += 2;
    ++first[face.corners[1] + 1];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  result.edge_slots.resize(3 * result.faces.size());
  // The first side of each edge is stored as its complement, which is negative.
  workers.forBlocks("edges", result.vertices, cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
    std::vector<Side> sides;
    for (auto v = begin; v < end; ++v) {
      sidesAt(result, static_cast<int>(v), sides);
      for (std::size_t i = 0; i < sides.size(); ++i) {
        const bool is_first = i == 0 || !sides[i - 1].isOneWith(sides[i]);
        result.edge_slots[first[v] + i] = is_first ? ~sides[i].slot : sides[i].slot;
      }
    }
  });
  result.edges = static_cast<int>(
      std::count_if(result.edge_slots.begin(), result.edge_slots.end(), [](int slot) { return slot < 0; }));
  result.edge_offset.reserve(static_cast<std::size_t>(result.edges) + 1);
  for (std::size_t i = 0; i < result.edge_slots.size(); ++i) {
    int& slot = result.edge_slots[i];
    if (slot >= 0) continue;
    slot = ~slot;
    result.edge_offset.push_back(static_cast<int>(i));
  }
  result.edge_offset.push_back(static_cast<int>(result.edge_slots.size()));
  for (int e = 0; e < result.edges; ++e) {
    for (int i = result.edge_offset[e]; i < result.edge_offset[e + 1]; ++i)
      result.faces[result.edge_slots[i] / 3].edges[result.edge_slots[i] % 3] = e;
  }
}

bool isBent(const MarchFace& face, const std::vector<Eigen::Vector3d>& positions) {
  for (int k = 0; k < 3; ++k) {
    const double straight = (positions[face.corners[(k + 1) % 3]] - positions[face.corners[(k + 2) % 3]]).norm();
    if (face.opposite[k] > (1 + straight_side) * straight) return true;
  }
  return false;
}

MarchFaces wholeFaces(std::vector<DistinctFace> faces, int vertices, int exponent, const Workers& workers,
                      std::vector<Eigen::Vector3d> positions) {
  MarchFaces result;
  result.vertices = vertices;
  result.exponent = exponent;
  result.positions = std::move(positions);
  result.faces.resize(faces.size());
  const PowerOfTwo unit(-exponent);
  workers.forBlocks("faces", std::ssize(faces), cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (auto f = begin; f < end; ++f) {
      MarchFace& face = result.faces[f];
      face.corners = faces[f].corners;
      for (int k = 0; k < 3; ++k) face.opposite[k] = unit.times(faces[f].opposite[k]);
      face.signed_area = 2 * triangleArea(face.opposite[0], face.opposite[1], face.opposite[2]);
      if (!result.positions.empty() && isBent(face, result.positions)) face.signed_area = -face.signed_area;
    }
  });
  release(faces);
  groupByCorner(result);
  groupByEdge(result, workers);
  return result;
}

/// Cuts every face into four at the midpoints of its sides.
MarchFaces splitInFour(const MarchFaces& coarse, const Workers& workers) {
  std::vector<DistinctFace> faces(4 * coarse.faces.size());
  const auto part = [](const std::array<int, 3>& corners, const MarchFace& whole) {
    const auto& [a, b, c] = whole.opposite;
    return distinctFace(corners, {a / 2, b / 2, c / 2});
  };
  workers.forBlocks("faces", std::ssize(coarse.faces), cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (auto f = begin; f < end; ++f) {
      const MarchFace& face = coarse.faces[f];
      const int n = coarse.vertices;
      const auto& [i, j, k] = face.corners;
      const int opposite_i = n + face.edges[0], opposite_j = n + face.edges[1], opposite_k = n + face.edges[2];
      faces[4 * f] = part({i, opposite_k, opposite_j}, face);
      faces[4 * f + 1] = part({opposite_k, j, opposite_i}, face);
      faces[4 * f + 2] = part({opposite_j, opposite_i, k}, face);
      faces[4 * f + 3] = part({opposite_i, opposite_j, opposite_k}, face);
    }
  });
  std::vector<Eigen::Vector3d> positions = coarse.positions;
  for (int e = 0; e < coarse.edges && !coarse.positions.empty(); ++e) positions.push_back(coarse.middleOf(e));
  MarchFaces fine = wholeFaces(std::move(faces), coarse.vertices + coarse.edges, 0, workers, std::move(positions));
  fine.exponent = coarse.exponent;
  return fine;
}

}  // namespace

std::size_t MarchFaces::bytes() const {
  return bytesOf(faces) + bytesOf(positions) + bytesOf(corner_offset) + bytesOf(corner_slots) + bytesOf(edge_offset) +
         bytesOf(edge_slots);
}

MarchFaces marchFaces(std::vector<DistinctFace> faces, int vertices, int exponent, int split, const Workers& workers,
                      const Points& positions, const std::vector<int>& number) {
  const PowerOfTwo unit(-exponent);
  std::vector<Eigen::Vector3d> scaled(static_cast<std::size_t>(positions.rows()));
  for (Eigen::Index i = 0; i < positions.rows(); ++i)
    scaled[number.empty() ? i : number[i]] = scaledPosition(positions.row(i), unit);
  MarchFaces result = wholeFaces(std::move(faces), vertices, exponent, workers, std::move(scaled));
  for (int times = 1; times < split; ++times) result = splitInFour(result, workers);
  return result;
}

MarchFaces marchFaces(const Laplacian& laplacian, int split, const Workers& workers, const std::vector<int>& number) {
  const CoverSource& cover = *laplacian.cover_source;
  const auto vertices = static_cast<int>(laplacian.status.size());
  std::vector<DistinctFace> faces = distinctFaces(cover, vertices, workers, number);
  const int exponent = unitOf(faces);
  const Points unknown;
  const Points& positions = number.empty() ? unknown : laplacian.positions;
  return marchFaces(std::move(faces), vertices, exponent, split, workers, positions, number);
}

std::vector<int> numbersByFaces(const Laplacian& laplacian) {
  std::vector<int> number(laplacian.status.size(), -1);
  int next = 0;
  const CoverSource& cover = *laplacian.cover_source;
  cover.visitFaces(0, cover.parts(), [&](const std::array<int, 3>& corners, const double*) {
    for (const int corner : corners)
      if (number[corner] < 0) number[corner] = next++;
  });
  for (int& of_unused : number)
    if (of_unused < 0) of_unused = next++;
  return number;
}

int checkedSplit(const std::string& function, std::optional<int> split, const Laplacian& laplacian) {
  // Only active points have triangles.
  if (!split)
    return std::count(laplacian.status.begin(), laplacian.status.end(), PointStatus::active) <= few_points ? 2 : 1;
  if (*split >= 0 && *split <= most_splits) return *split;
  throw InvalidInput(function + ": split = " + std::to_string(*split) + ", must lie in [0, " +
                     std::to_string(most_splits) + "]");
}

}  // namespace tufted
