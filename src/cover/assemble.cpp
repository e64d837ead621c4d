// Algorithm 3 of the paper, lines 6 to 15: cotan weights and lumped areas (Section 3.3) of a cover.
#include "cover/assemble.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/buffer.h"
#include "base/disjoint_sets.h"
#include "base/require.h"
#include "cover/column.h"
#include "cover/face_areas.h"
#include "cover/geometry.h"
#include "cover/rows.h"

namespace tufted {
namespace {

constexpr std::int64_t block_size = 8192;

/// The upper triangle: the entries of row v are the summed weights of its edges to larger vertices, ascending.
struct UpperRows {
  Rows rows;
  Buffer<int> size;  ///< of each row, which may end before the next begins

  int begin(int v) const { return rows.offset[v]; }
  int end(int v) const { return rows.offset[v] + size[v]; }
};

/// Edges from a vertex to itself are left out.
UpperRows sumWeights(const IntrinsicTriangulation& cover, const Buffer<double>& areas, double scale,
                     const Workers& workers) {
  // In the order of the faces, which are neighbours in memory if they are on the surface.
  const auto forEachEdge = [&](const auto& visit) {
    for (int f = 0; f < static_cast<int>(cover.size()); ++f) {
      const auto& corner = cover.faces[f];
      for (int s = 0; s < 3; ++s) {
        const int side = 3 * f + s, from = corner[s], to = corner[(s + 1) % 3];
        if (side < cover.glue[side] && from != to) visit(std::min(from, to), std::max(from, to), f, s);
      }
    }
  };
  UpperRows upper;
  Rows& rows = upper.rows;
  rows.offset.assign(static_cast<std::size_t>(cover.vertices) + 1, 0);
  forEachEdge([&](int low, int, int, int) { ++rows.offset[low + 1]; });
  std::partial_sum(rows.offset.begin(), rows.offset.end(), rows.offset.begin());
  rows.entries.resize(static_cast<std::size_t>(rows.offset.back()));
  Buffer<int> fill(rows.offset.begin(), rows.offset.end() - 1);
  forEachEdge([&](int low, int high, int f, int s) {
    const double* const length = cover.length.data() + 3 * std::ptrdiff_t{f};
    const double cotan =
        finiteCotan(cotanNumerator(length[s], length[(s + 1) % 3], length[(s + 2) % 3]) / (4 * areas[f]));
    const double opposite = finiteCotan(cover, areas, cover.glue[3 * f + s]);
    rows.entries[fill[low]++] = {high, scale * (cotan + opposite) / 2};  // Section 3.3
  });
  upper.size = mergeRows(rows, workers);
  return upper;
}

/// Minus the row sums, in ascending order of both halves.
Buffer<double> sumDiagonal(const UpperRows& upper) {
  const int n = static_cast<int>(upper.size.size());
  Buffer<double> diagonal(n);
  for (int v = 0; v < n; ++v) {  // when row v comes, all smaller vertices have added theirs
    for (int i = upper.begin(v); i < upper.end(v); ++i) {
      diagonal[v] += upper.rows.entries[i].weight;
      diagonal[upper.rows.entries[i].column] += upper.rows.entries[i].weight;
    }
  }
  return diagonal;
}

void clampNegative(UpperRows& upper, const Buffer<double>& diagonal, Report& report) {
  const int n = static_cast<int>(diagonal.size());
  for (int v = 0; v < n; ++v) {
    for (int i = upper.begin(v); i < upper.end(v); ++i) {
      Entry& entry = upper.rows.entries[i];
      if (entry.weight >= 0) continue;
      const double larger = std::max(diagonal[v], diagonal[entry.column]);
      const double relative = larger > 0 ? -entry.weight / larger : INFINITY;
      ++(relative <= weight_rounding ? report.clamped_weights : report.clamped_large);
      report.largest_clamped = std::max(report.largest_clamped, relative);
      entry.weight = 0;
    }
  }
}

/// Writes both halves and the diagonal as compressed columns in the caller's numbering. Zero weights are not stored.
void toInputOrder(const UpperRows& upper, const Buffer<double>& diagonal, const Buffer<int>& input_index, int size,
                  SparseMatrix& L) {
  const int n = static_cast<int>(diagonal.size());
  L.resize(size, size);
  Buffer<int> fill(static_cast<std::size_t>(size) + 1);
  const auto forEachEntry = [&](auto visit) {  // visit(column, row, value), both halves
    for (int v = 0; v < n; ++v) {
      if (diagonal[v] > 0) visit(input_index[v], input_index[v], diagonal[v]);
      for (int i = upper.begin(v); i < upper.end(v); ++i) {
        const auto [column, weight] = upper.rows.entries[i];
        if (weight == 0) continue;
        visit(input_index[v], input_index[column], -weight);
        visit(input_index[column], input_index[v], -weight);
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
void lumpAreas(const IntrinsicTriangulation& cover, const Buffer<double>& areas, const Buffer<int>& input_index,
               int size, double scale, VectorXd& M, Report& report) {
  M.setZero(size);
  for (int f = 0; f < cover.size(); ++f) {
    const double area = areas[f];
    report.degenerate_faces += area > 0 ? 0 : 1;
    for (const int corner : cover.faces[f]) M[input_index[corner]] += scale * area / 3;
  }
}

}  // namespace

void assembleLaplacian(const IntrinsicTriangulation& cover, const Buffer<int>& input_index, int size, double scale,
                       const Workers& workers, Laplacian& result) {
  Report& report = result.report;
  const Buffer<double> areas = faceAreas(cover, workers);
  UpperRows upper = sumWeights(cover, areas, scale, workers);
  const auto entries = 2 * std::accumulate(upper.size.begin(), upper.size.end(), std::int64_t{0}) + cover.vertices;
  requireAtMost(INT32_MAX, entries, "pointCloudLaplacian and meshLaplacian", "entries of L");
  clampNegative(upper, sumDiagonal(upper), report);
  toInputOrder(upper, sumDiagonal(upper), input_index, size, result.L);
  upper = {};
  sortColumns(result.L, workers);
  lumpAreas(cover, areas, input_index, size, scale, result.M, report);
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
