// Algorithm 3 of the paper, lines 6 to 15, on stars; cover/assemble.cpp is the reference.
#include "direct/star_rows.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/buffer.h"
#include "base/disjoint_sets.h"
#include "base/require.h"
#include "cover/column.h"
#include "direct/summed_rows.h"

namespace tufted {
namespace {

constexpr std::int64_t block_size = 8192;

class StarAssembler {
 public:
  /// The faces of the cover are dropped unless they are kept.
  StarAssembler(const GluedStars& glued, bool keep_cover, double scale, const Workers& workers, Report& report)
      : stars_(glued.stars),
        metric_(glued.metric),
        scale_(scale),
        mixed_(glued.disagrees),
        mass_(static_cast<std::size_t>(stars_.size())) {
    workers.forBlocks("assemble", stars_.size(), block_size, [&](std::int64_t begin, std::int64_t end, int) {
      for (int p = static_cast<int>(begin); p < end; ++p) {
        mixed_[p] |= metric_.is_flat[p] | static_cast<std::uint8_t>(glued.cover.isFlipped(p));
        mass_[p] = mixed_[p] == 0 ? 2 * scale_ * metric_.area[p] : 0;  // front and back, 3 stars, a third
      }
    });
    summed_rows_ = summedRows(glued, mixed_, keep_cover, scale_, mass_, workers, report);
  }

  double mass(int p) const { return mass_[p]; }

  /// At least the number of edges of p.
  int mostInRow(int p) const {
    const int own = stars_.offset[p + 1] - stars_.offset[p];
    return mixed_[p] == 0 ? own : own + summed_rows_.offset[p + 1] - summed_rows_.offset[p];
  }

  /// Calls visit(q, weight) for every edge of p. Where both ends are unmixed, their stars have the same two triangles
  /// there, and the weight has the same bits from either.
  template <class Visit>
  void forEachInRow(int p, const Visit& visit) const {
    const bool is_mixed = mixed_[p] != 0;
    for (int i = stars_.offset[p]; i < stars_.offset[p + 1]; ++i) {
      const int q = stars_.link[i];
      if (!is_mixed) {
        visit(q, spokeWeight(i));
      } else if (mixed_[q] == 0) {
        visit(q, spokeWeight(entryOf(stars_, q, p)));
      }
    }
    if (!is_mixed) return;
    for (int i = summed_rows_.offset[p]; i < summed_rows_.offset[p + 1]; ++i)
      visit(summed_rows_.entries[i].column, summed_rows_.entries[i].weight);
  }

  /// The sum of all weights of p, the negative ones too.
  double diagonal(int p) const {
    double sum = 0;
    forEachInRow(p, [&sum](int, double weight) { sum += weight; });
    return sum;
  }

 private:
  /// The weight of the spoke to link vertex i of an unmixed star.
  double spokeWeight(int i) const { return 3 * scale_ * metric_.cotan_sum[i]; }  // front and back, 3 stars, 1/2

  const Stars& stars_;
  const StarMetric& metric_;
  const double scale_;
  Buffer<std::uint8_t> mixed_;  ///< n, 1 for points whose edges among each other are summed over faces
  RawBuffer<double> mass_;
  Rows summed_rows_;  ///< edges between mixed points, from both ends
};

constexpr int ahead = 16;  // columns

/// What is counted in one block of rows.
struct RowBlock {
  std::int64_t clamped_small = 0, clamped_large = 0;
  double largest_clamped = 0;
  std::int64_t components = 0;                 ///< of the edges within the block
  Buffer<std::pair<int, int>> edges_to_other;  ///< to points of earlier blocks
};

}  // namespace

void assembleStars(const GluedStars& glued, bool keep_cover, const Buffer<int>& input_index, int size, double scale,
                   const Workers& workers, Laplacian& result) {
  Report& report = result.report;
  const int n = glued.stars.size();
  const StarAssembler assembler(glued, keep_cover, scale, workers, report);

  // Columns of L in the caller's numbering: their sizes, then what is in them.
  Buffer<int> count(static_cast<std::size_t>(size));
  Buffer<RowBlock> blocks((n + block_size - 1) / block_size);
  workers.forBlocks("assemble", n, block_size, [&](std::int64_t begin, std::int64_t end, int) {
    for (int p = static_cast<int>(begin); p < end; ++p) {
      int positive = 0;
      assembler.forEachInRow(p, [&](int, double weight) { positive += weight > 0 ? 1 : 0; });
      count[input_index[p]] = positive > 0 ? positive + 1 : 0;
    }
  });
  const std::int64_t entries = std::accumulate(count.begin(), count.end(), std::int64_t{0});
  requireAtMost(INT32_MAX, entries, "pointCloudLaplacian", "entries of L");
  SparseMatrix& L = result.L;
  L.resize(size, size);
  resizeEntries(L, entries);
  L.outerIndexPtr()[0] = 0;
  std::partial_sum(count.begin(), count.end(), L.outerIndexPtr() + 1);
  release(count);
  result.M.setZero(size);
  DisjointSets sets(n);  // those of one block are united by one thread
  workers.forBlocks("assemble", n, block_size, [&](std::int64_t begin, std::int64_t end, int) {
    RowBlock& block = blocks[begin / block_size];
    Column column;
    for (int p = static_cast<int>(begin); p < end; ++p) {
      if (p + 2 * ahead < n) prefetchColumns(L, input_index[p + 2 * ahead], input_index[p + ahead]);
      column.start(assembler.mostInRow(p) + 1);
      double sum = 0;
      assembler.forEachInRow(p, [&](int q, double weight) {
        if (weight > 0) {
          sum += weight;
          column.add(input_index[q], -weight);
          if (q >= begin && q < p)
            block.components -= sets.unite(p, q) ? 1 : 0;
          else if (q < begin)
            block.edges_to_other.emplace_back(p, q);
        } else if (weight < 0 && p < q) {
          // Negative weights within 1e-9 of the larger diagonal are rounding; all are left out.
          const double larger = std::max(assembler.diagonal(p), assembler.diagonal(q));
          const double relative = larger > 0 ? -weight / larger : INFINITY;
          ++(relative <= weight_rounding ? block.clamped_small : block.clamped_large);
          block.largest_clamped = std::max(block.largest_clamped, relative);
        }
      });
      if (column.isEmpty()) continue;  // no row, no mass: the point takes no part
      ++block.components;
      result.M[input_index[p]] = assembler.mass(p);
      column.add(input_index[p], sum);
      const int place = L.outerIndexPtr()[input_index[p]];
      column.sortInto(L.innerIndexPtr() + place, L.valuePtr() + place);
    }
  });

  for (const RowBlock& block : blocks) {
    report.clamped_weights += block.clamped_small;
    report.clamped_large += block.clamped_large;
    report.largest_clamped = std::max(report.largest_clamped, block.largest_clamped);
    report.components += block.components;
    for (const auto& [p, q] : block.edges_to_other) report.components -= sets.unite(p, q) ? 1 : 0;
  }
  report.nonzeros = entries;
}

}  // namespace tufted
