// Algorithm 3 of the paper, lines 6 to 15: cotan weights and lumped areas (Section 3.3) of a cover.
#include "cover/assemble.h"

#include <algorithm>
#include <numeric>

#include "base/buffer.h"
#include "base/disjoint_sets.h"
#include "cover/face_areas.h"
#include "cover/geometry.h"
#include "cover/matrix_columns.h"
#include "cover/rows.h"

namespace tufted {
namespace {

/// The summed weights of the edges of each vertex, and its mass.
class CoverRows {
 public:
  CoverRows(const IntrinsicTriangulation& cover, double scale, const Workers& workers, Report& report) {
    const Buffer<double> areas = faceAreas(cover, workers);
    sumWeights(cover, areas, scale, workers);
    lumpAreas(cover, areas, scale, report);
  }

  int size() const { return static_cast<int>(mass_.size()); }
  int mostInRow(int v) const { return rows_.offset[v + 1] - rows_.offset[v]; }
  double mass(int v) const { return mass_[v]; }

  template <class Visit>
  void forEachInRow(int v, const Visit& visit) const {
    for (int i = rows_.offset[v]; i < rows_.offset[v + 1]; ++i) visit(rows_.entries[i].column, rows_.entries[i].weight);
  }

 private:
  /// Edges from a vertex to itself are left out.
  void sumWeights(const IntrinsicTriangulation& cover, const Buffer<double>& areas, double scale,
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
    // First in the row of the lower vertex alone, where an edge of the front and one of the back become one.
    Rows upper;
    upper.offset.assign(static_cast<std::size_t>(cover.vertices) + 1, 0);
    forEachEdge([&](int low, int, int, int) { ++upper.offset[low + 1]; });
    std::partial_sum(upper.offset.begin(), upper.offset.end(), upper.offset.begin());
    upper.entries.resize(static_cast<std::size_t>(upper.offset.back()));
    Buffer<int> fill(upper.offset.begin(), upper.offset.end() - 1);
    forEachEdge([&](int low, int high, int f, int s) {
      const double* const length = cover.length.data() + 3 * std::ptrdiff_t{f};
      const double cotan =
          finiteCotan(cotanNumerator(length[s], length[(s + 1) % 3], length[(s + 2) % 3]) / (4 * areas[f]));
      const double opposite = finiteCotan(cover, areas, cover.glue[3 * f + s]);
      upper.entries[fill[low]++] = {high, scale * (cotan + opposite) / 2};  // Section 3.3
    });
    setRows(upper, mergeRows(upper, workers));
  }

  /// Both ends of each edge, ascending: of a row, those to lower vertices come first, in the order of these.
  void setRows(const Rows& upper, const Buffer<int>& edges) {
    const int n = static_cast<int>(edges.size());
    const auto forEachEdge = [&](const auto& visit) {
      for (int low = 0; low < n; ++low) {
        const Entry* const row = upper.entries.data() + upper.offset[low];
        for (int i = 0; i < edges[low]; ++i) visit(low, row[i]);
      }
    };
    rows_.offset.assign(edges.size() + 1, 0);
    forEachEdge([&](int low, const Entry& entry) {
      ++rows_.offset[low + 1];
      ++rows_.offset[entry.column + 1];
    });
    std::partial_sum(rows_.offset.begin(), rows_.offset.end(), rows_.offset.begin());
    rows_.entries.resize(static_cast<std::size_t>(rows_.offset.back()));
    Buffer<int> fill(rows_.offset.begin(), rows_.offset.end() - 1);
    forEachEdge([&](int low, const Entry& entry) {
      rows_.entries[fill[low]++] = entry;
      rows_.entries[fill[entry.column]++] = {low, entry.weight};
    });
  }

  /// A third of each face's area to each corner (Section 3.3), summed in the order of the faces.
  void lumpAreas(const IntrinsicTriangulation& cover, const Buffer<double>& areas, double scale, Report& report) {
    mass_.assign(static_cast<std::size_t>(cover.vertices), 0);
    for (int f = 0; f < cover.size(); ++f) {
      report.degenerate_faces += areas[f] > 0 ? 0 : 1;
      for (const int corner : cover.faces[f]) mass_[corner] += scale * areas[f] / 3;
    }
  }

  Rows rows_;
  Buffer<double> mass_;
};

}  // namespace

void assembleLaplacian(const IntrinsicTriangulation& cover, const Buffer<int>& input_index, int size, double scale,
                       const Workers& workers, Laplacian& result) {
  const CoverRows rows(cover, scale, workers, result.report);
  MatrixColumns(rows, input_index, workers, result).write(size, "pointCloudLaplacian and meshLaplacian");
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
