// Algorithm 3 of the paper, lines 6 to 15: cotan weights and lumped areas (Section 3.3) of a cover.
#include "cover/assemble.h"

#include <algorithm>
#include <numeric>

#include "base/buffer.h"
#include "cover/face_areas.h"
#include "cover/geometry.h"
#include "cover/matrix_columns.h"
#include "cover/rows.h"

namespace tufted {
namespace {

/// The summed weight of each edge, by vertex, and the mass of each vertex.
class CoverRows {
 public:
  CoverRows(const IntrinsicTriangulation& cover, double scale, const Workers& workers, Report& report) {
    const Buffer<double> areas = faceAreas(cover, workers);
    sumWeights(cover, areas, scale, workers);
    lumpAreas(cover, areas, scale, report);
  }

  int size() const { return static_cast<int>(edges_.size()); }
  int mostInRow(int v) const { return lower_.offset[v + 1] - lower_.offset[v] + edges_[v]; }
  double mass(int v) const { return mass_[v]; }

  /// Calls visit(neighbour, weight), in ascending order.
  template <class Visit>
  void forEachInRow(int v, const Visit& visit) const {
    for (int i = lower_.offset[v]; i < lower_.offset[v + 1]; ++i)
      visit(lower_.entries[i].column, lower_.entries[i].weight);
    forEachAbove(v, visit);
  }

 private:
  /// Sums the weights of all edges but those from a vertex to itself.
  void sumWeights(const IntrinsicTriangulation& cover, const Buffer<double>& areas, double scale,
                  const Workers& workers) {
    // In the order of the faces, whose vertices are close in memory.
    const auto forEachEdge = [&](const auto& visit) {
      for (int f = 0; f < static_cast<int>(cover.size()); ++f) {
        const auto& corner = cover.faces[f];
        for (int s = 0; s < 3; ++s) {
          const int side = 3 * f + s, from = corner[s], to = corner[(s + 1) % 3];
          if (side < cover.glue[side] && from != to) visit(std::min(from, to), std::max(from, to), f, s);
        }
      }
    };
    // Each edge is stored at its lower vertex first, where copies of it, as on front and back, are merged.
    upper_.offset.assign(static_cast<std::size_t>(cover.vertices) + 1, 0);
    forEachEdge([&](int low, int, int, int) { ++upper_.offset[low + 1]; });
    std::partial_sum(upper_.offset.begin(), upper_.offset.end(), upper_.offset.begin());
    upper_.entries.resize(static_cast<std::size_t>(upper_.offset.back()));
    Buffer<int> fill(upper_.offset.begin(), upper_.offset.end() - 1);
    forEachEdge([&](int low, int high, int f, int s) {
      const double* const length = cover.length.data() + 3 * std::ptrdiff_t{f};
      const double cotan =
          finiteCotan(cotanNumerator(length[s], length[(s + 1) % 3], length[(s + 2) % 3]) / (4 * areas[f]));
      const double opposite = finiteCotan(cover, areas, cover.glue[3 * f + s]);
      upper_.entries[fill[low]++] = {high, scale * (cotan + opposite) / 2};  // Section 3.3
    });
    edges_ = mergeRows(upper_, workers);
    setLowerRows();
  }

  /// Fills lower_: each edge of upper_, stored at its higher vertex.
  void setLowerRows() {
    const int n = size();
    lower_.offset.assign(upper_.offset.size(), 0);
    for (int v = 0; v < n; ++v) forEachAbove(v, [&](int high, double) { ++lower_.offset[high + 1]; });
    std::partial_sum(lower_.offset.begin(), lower_.offset.end(), lower_.offset.begin());
    lower_.entries.resize(static_cast<std::size_t>(lower_.offset.back()));
    Buffer<int> fill(lower_.offset.begin(), lower_.offset.end() - 1);
    for (int v = 0; v < n; ++v)
      forEachAbove(v, [&](int high, double weight) { lower_.entries[fill[high]++] = {v, weight}; });
  }

  template <class Visit>
  void forEachAbove(int v, const Visit& visit) const {
    const Entry* const row = upper_.entries.data() + upper_.offset[v];
    for (int i = 0; i < edges_[v]; ++i) visit(row[i].column, row[i].weight);
  }

  /// Adds a third of each face's area to each corner (Section 3.3), in the order of the faces.
  void lumpAreas(const IntrinsicTriangulation& cover, const Buffer<double>& areas, double scale, Report& report) {
    mass_.assign(static_cast<std::size_t>(cover.vertices), 0);
    for (int f = 0; f < cover.size(); ++f) {
      report.degenerate_faces += areas[f] > 0 ? 0 : 1;
      for (const int corner : cover.faces[f]) mass_[corner] += scale * areas[f] / 3;
    }
  }

  Rows upper_, lower_;  ///< the edges of each vertex to higher and to lower vertices
  Buffer<int> edges_;   ///< number of edges in each row of upper_
  Buffer<double> mass_;
};

}  // namespace

void assembleLaplacian(const IntrinsicTriangulation& cover, const Buffer<int>& input_index, int size, double scale,
                       const Workers& workers, Laplacian& result) {
  const CoverRows rows(cover, scale, workers, result.report);
  MatrixColumns(rows, input_index, workers, result).write(size, "pointCloudLaplacian and meshLaplacian");
}

}  // namespace tufted
