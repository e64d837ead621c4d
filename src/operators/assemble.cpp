#include "operators/assemble.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "base/buffer.h"
#include "base/disjoint_sets.h"
#include "intrinsic/geometry.h"
#include "operators/column.h"
#include "operators/face_areas.h"
#include "operators/rows.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

constexpr std::int64_t block_size = 8192;

/// The weight of an edge, 1/2 (cot + cot).
double edgeWeight(const IntrinsicTriangulation& cover, const Buffer<double>& areas, int side) {
  return (finiteCotan(cover, areas, side) + finiteCotan(cover, areas, cover.glue[side])) / 2;
}

/// Side numbers of each vertex, one vertex after the other.
struct SideLists {
  Buffer<int> offset, sides;
};

/// Sides, one per edge, filed under the smaller vertex; edges from a vertex to itself are left out.
SideLists sidesByVertex(const IntrinsicTriangulation& cover) {
  const int sides = static_cast<int>(3 * cover.size());
  const auto counts = [&](int side) { return side < cover.glue[side] && tail(cover, side) != head(cover, side); };
  const auto owner = [&](int side) { return std::min(tail(cover, side), head(cover, side)); };
  Buffer<int> offset(static_cast<std::size_t>(cover.vertices) + 1);
  for (int side = 0; side < sides; ++side) {
    if (counts(side)) ++offset[owner(side) + 1];
  }
  std::partial_sum(offset.begin(), offset.end(), offset.begin());
  Buffer<int> list(offset.back());
  Buffer<int> fill(offset.begin(), offset.end() - 1);
  for (int side = 0; side < sides; ++side) {
    if (counts(side)) list[fill[owner(side)]++] = side;
  }
  return {std::move(offset), std::move(list)};
}

/// The upper triangle: for each vertex the summed weights of its edges to larger vertices, ascending.
Rows sumWeights(const IntrinsicTriangulation& cover, const Buffer<double>& areas, double scale,
                const Workers& workers) {
  const SideLists lists = sidesByVertex(cover);
  Rows upper;
  upper.offset.assign(lists.offset.size(), 0);
  Buffer<Buffer<Entry>> parts((cover.vertices + block_size - 1) / block_size);
  workers.forBlocks("assemble", cover.vertices, block_size, [&](std::int64_t begin, std::int64_t end, int) {
    Buffer<Entry>& part = parts[begin / block_size];
    Buffer<Entry> row, scratch;
    for (int v = static_cast<int>(begin); v < end; ++v) {
      row.clear();
      for (int i = lists.offset[v]; i < lists.offset[v + 1]; ++i) {
        const int side = lists.sides[i];
        row.push_back({std::max(tail(cover, side), head(cover, side)), scale * edgeWeight(cover, areas, side)});
      }
      Entry* const end_of_row = mergeColumns(row.data(), row.data() + row.size(), scratch);
      part.insert(part.end(), row.data(), end_of_row);
      upper.offset[v + 1] = static_cast<int>(end_of_row - row.data());
    }
  });
  std::partial_sum(upper.offset.begin(), upper.offset.end(), upper.offset.begin());
  upper.entries.reserve(upper.offset.back());
  for (auto& part : parts) {
    upper.entries.insert(upper.entries.end(), part.begin(), part.end());
    release(part);
  }
  return upper;
}

/// Minus the row sums, in ascending order of both halves.
Buffer<double> sumDiagonal(const Rows& upper) {
  const int n = static_cast<int>(upper.offset.size()) - 1;
  Buffer<double> diagonal(n);
  for (int v = 0; v < n; ++v) {  // when row v comes, all smaller vertices have added theirs
    for (int i = upper.offset[v]; i < upper.offset[v + 1]; ++i) {
      diagonal[v] += upper.entries[i].weight;
      diagonal[upper.entries[i].column] += upper.entries[i].weight;
    }
  }
  return diagonal;
}

void clampNegative(Rows& upper, const Buffer<double>& diagonal, Report& report) {
  const int n = static_cast<int>(diagonal.size());
  for (int v = 0; v < n; ++v) {
    for (int i = upper.offset[v]; i < upper.offset[v + 1]; ++i) {
      Entry& entry = upper.entries[i];
      if (entry.weight >= 0) continue;
      const double larger = std::max(diagonal[v], diagonal[entry.column]);
      const double relative = larger > 0 ? -entry.weight / larger : INFINITY;
      ++(relative <= weight_rounding ? report.clamped_weights : report.clamped_large);
      report.largest_clamped = std::max(report.largest_clamped, relative);
      entry.weight = 0;
    }
  }
}

/// Both halves and the diagonal as compressed columns in the caller's numbering. Zero weights are not stored.
void toCallerOrder(const Rows& upper, const Buffer<double>& diagonal, const Buffer<int>& caller, int size,
                   SparseMatrix& L) {
  const int n = static_cast<int>(diagonal.size());
  L.resize(size, size);
  Buffer<int> fill(static_cast<std::size_t>(size) + 1);
  const auto forEachEntry = [&](auto visit) {  // visit(column, row, value), both halves
    for (int v = 0; v < n; ++v) {
      if (diagonal[v] > 0) visit(caller[v], caller[v], diagonal[v]);
      for (int i = upper.offset[v]; i < upper.offset[v + 1]; ++i) {
        const auto [column, weight] = upper.entries[i];
        if (weight == 0) continue;
        visit(caller[v], caller[column], -weight);
        visit(caller[column], caller[v], -weight);
      }
    }
  };
  forEachEntry([&](int column, int, double) { ++fill[column + 1]; });
  std::partial_sum(fill.begin(), fill.end(), fill.begin());
  resizeEntries(L, fill.back());
  std::copy(fill.begin(), fill.end(), L.outerIndexPtr());
  forEachEntry([&](int column, int row, double value) {
    const int place = fill[column]++;
    L.innerIndexPtr()[place] = row;
    L.valuePtr()[place] = value;
  });
}

/// Sorts the rows within each column.
void sortColumns(SparseMatrix& L, const Workers& workers) {
  workers.forBlocks("assemble", L.cols(), block_size, [&](std::int64_t begin, std::int64_t end, int) {
    Column column;
    for (std::int64_t j = begin; j < end; ++j) {
      const int first = L.outerIndexPtr()[j], last = L.outerIndexPtr()[j + 1];
      column.start(last - first);
      for (int i = first; i < last; ++i) column.add(L.innerIndexPtr()[i], L.valuePtr()[i]);
      column.sortInto(L.innerIndexPtr() + first, L.valuePtr() + first);
    }
  });
}

/// A third of each face's area to each corner (Section 3.3), summed in the order of the faces.
void lumpAreas(const IntrinsicTriangulation& cover, const Buffer<double>& areas, const Buffer<int>& caller, int size,
               double scale, VectorXd& M, Report& report) {
  M.setZero(size);
  for (int f = 0; f < cover.size(); ++f) {
    const double area = areas[f];
    report.degenerate_faces += area > 0 ? 0 : 1;
    for (const int corner : cover.faces[f]) M[caller[corner]] += scale * area / 3;
  }
}

}  // namespace

void assembleLaplacian(const IntrinsicTriangulation& cover, const Buffer<int>& caller, int size, double scale,
                       const Workers& workers, Laplacian& result) {
  Report& report = result.report;
  const Buffer<double> areas = faceAreas(cover, workers);
  Rows upper = sumWeights(cover, areas, scale, workers);
  const auto most_entries = 2 * static_cast<std::int64_t>(upper.entries.size()) + cover.vertices;
  if (most_entries > INT32_MAX) {
    throw InvalidInput("assembleLaplacian: " + std::to_string(most_entries) + " entries of L, must be at most " +
                       std::to_string(INT32_MAX) + ", what an int can number");
  }
  clampNegative(upper, sumDiagonal(upper), report);
  toCallerOrder(upper, sumDiagonal(upper), caller, size, result.L);
  upper = {};
  sortColumns(result.L, workers);
  lumpAreas(cover, areas, caller, size, scale, result.M, report);
  for (int i = 0; i < size; ++i) {  // no row, no mass: the point takes no part
    if (result.L.outerIndexPtr()[i] == result.L.outerIndexPtr()[i + 1]) result.M[i] = 0;
  }
  report.nonzeros = result.L.nonZeros();
  report.components = countComponents(result.L);
}

std::int64_t countComponents(const SparseMatrix& L) {
  DisjointSets sets(L.cols());
  std::int64_t components = 0;
  for (int j = 0; j < L.cols(); ++j) {
    const int first = L.outerIndexPtr()[j], last = L.outerIndexPtr()[j + 1];
    components += first < last ? 1 : 0;
    for (int i = first; i < last && L.innerIndexPtr()[i] < j; ++i)
      if (sets.unite(L.innerIndexPtr()[i], j)) --components;
  }
  return components;
}

}  // namespace tufted
