#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "base/buffer.h"
#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "base/require.h"
#include "base/workspace.h"
#include "cover/clamped_weights.h"
#include "cover/components.h"
#include "tufted/laplacian.h"
#include "tufted/types.h"

namespace tufted {

/// The entries of one column of L, in the order in which they are added.
class Column {
 public:
  /// Empties it, with room for `most` entries.
  void start(int most) {
    size_ = 0;
    if (std::ssize(row_) >= most) return;
    row_.resize(most);
    value_.resize(most);
  }
  void add(int row, double value) {
    row_[size_] = row;
    value_[size_++] = value;
  }
  bool isEmpty() const { return size_ == 0; }

  /// Writes all entries by ascending row.
  void sortInto(int* row, double* value) {
    if (size_ <= 8)
      place<8>(row, value);
    else if (size_ <= 16)
      place<16>(row, value);
    else
      sort(row, value);
  }

 private:
  /// Puts each entry at the number of smaller rows: faster than sorting, whose branches are hard to predict.
  template <int most>
  void place(int* row, double* value) const {
    std::array<int, most> rows, before{};
    rows.fill(INT32_MAX);
    std::copy_n(row_.begin(), size_, rows.begin());
    for (int j = 0; j < most; ++j)
      for (int i = 0; i < most; ++i) before[i] += rows[j] < rows[i] ? 1 : 0;
    for (int i = 0; i < size_; ++i) {
      row[before[i]] = row_[i];
      value[before[i]] = value_[i];
    }
  }

  void sort(int* row, double* value) {
    order_.resize(size_);
    std::iota(order_.begin(), order_.end(), 0);
    std::sort(order_.begin(), order_.end(), [this](int a, int b) { return row_[a] < row_[b]; });
    for (const int i : order_) {
      *row++ = row_[i];
      *value++ = value_[i];
    }
  }

  int size_ = 0;
  Buffer<int> row_, order_;
  Buffer<double> value_;
};

/// Writes the columns of L in the caller's numbering, each sorted, and M. The diagonal is minus the sum of the other
/// entries, in the order of the row. A vertex without positive weights has no row and no mass.
/// @tparam WeightRows the weights of the edges of each vertex p, by size(), the number of vertices; forEachInRow(p,
/// visit), which calls visit(q, weight) for each edge, with the same weight from both ends; mostInRow(p), at least the
/// number of its edges; and mass(p)
template <class WeightRows>
class MatrixColumns {
 public:
  /// @param input_index the caller's index of each vertex
  MatrixColumns(const WeightRows& rows, const Buffer<int>& input_index, const Workers& workers, Laplacian& result)
      : rows_(rows),
        input_index_(input_index),
        workers_(workers),
        L_(result.L),
        M_(result.M),
        component_(result.component),
        report_(result.report) {}

  /// @param size N, the number of the caller's points
  /// @param function the public function that was called, for messages
  void write(int size, const char* function) {
    setSizes(size, function);
    M_.setZero(size);
    Buffer<Block> blocks((rows_.size() + cheap_block - 1) / cheap_block);
    DisjointSets sets(rows_.size());  // vertices of one block are united by one thread
    workers_.forBlocks("assemble", rows_.size(), cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
      writeBlock(static_cast<int>(begin), static_cast<int>(end), blocks[begin / cheap_block], sets);
    });
    for (const Block& block : blocks) {
      report_.clamped_weights += block.clamped.small;
      report_.clamped_large += block.clamped.large;
      report_.largest_clamped = std::max(report_.largest_clamped, block.clamped.largest);
      report_.components += block.components;
      for (const auto& [p, q] : block.edges_to_other) report_.components -= sets.unite(p, q) ? 1 : 0;
    }
    report_.nonzeros = L_.nonZeros();
    component_.assign(static_cast<std::size_t>(size), -1);
    for (int p = 0; p < static_cast<int>(rows_.size()); ++p) {
      const int i = input_index_[p];
      if (L_.outerIndexPtr()[i] < L_.outerIndexPtr()[i + 1]) component_[i] = input_index_[sets.root(p)];
    }
    numberComponents(component_);
  }

 private:
  /// How many columns ahead memory is prefetched (matrices of a million points: 0.5 to 0.4 s).
  static constexpr int ahead = 16;

  /// Results of one block of vertices.
  struct Block {
    ClampedWeights clamped;
    std::int64_t components = 0;                 ///< of the graph of edges within the block
    Buffer<std::pair<int, int>> edges_to_other;  ///< to vertices of earlier blocks
  };

  /// Sets the number of entries of each column.
  void setSizes(int size, const char* function) {
    Buffer<int> count(static_cast<std::size_t>(size));
    workers_.forBlocks("assemble", rows_.size(), cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
      for (int p = static_cast<int>(begin); p < end; ++p) {
        int positive = 0;
        rows_.forEachInRow(p, [&](int, double weight) { positive += weight > 0 ? 1 : 0; });
        count[input_index_[p]] = positive > 0 ? positive + 1 : 0;
      }
    });
    const std::int64_t entries = std::accumulate(count.begin(), count.end(), std::int64_t{0});
    requireAtMost(INT32_MAX, entries, function, "entries of L");
    L_.resize(size, size);
    // With room to spare in a workspace, because the next frame may have a few more entries.
    L_.data().resize(entries, Workspace::current() != nullptr ? 0.125 : 0);
    L_.outerIndexPtr()[0] = 0;
    std::partial_sum(count.begin(), count.end(), L_.outerIndexPtr() + 1);
  }

  void writeBlock(int begin, int end, Block& block, DisjointSets& sets) {
    Column column;
    const int last_ahead = L_.nonZeros() > 0 ? rows_.size() - 2 * ahead : 0;
    for (int p = begin; p < end; ++p) {
      if (p < last_ahead) prefetch(input_index_[p + 2 * ahead], input_index_[p + ahead]);
      column.start(rows_.mostInRow(p) + 1);
      double sum = 0;
      rows_.forEachInRow(p, [&](int q, double weight) {
        if (weight > 0) {
          sum += weight;
          column.add(input_index_[q], -weight);
          if (q >= begin && q < p)
            block.components -= sets.unite(p, q) ? 1 : 0;
          else if (q < begin)
            block.edges_to_other.emplace_back(p, q);
        } else if (weight < 0 && p < q) {
          block.clamped.add(weight, std::max(diagonal(p), diagonal(q)));
        }
      });
      if (column.isEmpty()) continue;
      ++block.components;
      M_[input_index_[p]] = rows_.mass(p);
      column.add(input_index_[p], sum);
      const int place = L_.outerIndexPtr()[input_index_[p]];
      column.sortInto(L_.innerIndexPtr() + place, L_.valuePtr() + place);
    }
  }

  /// The sum of all weights of p, negative ones included.
  double diagonal(int p) const {
    double sum = 0;
    rows_.forEachInRow(p, [&sum](int, double weight) { sum += weight; });
    return sum;
  }

  /// Columns in the caller's order lie anywhere in memory, so they are prefetched: first their offsets, then their
  /// entries. Always inlined, because GCC removes calls of a function that only prefetches as having no effect.
  [[gnu::always_inline]] void prefetch(int soon, int next) {
    __builtin_prefetch(L_.outerIndexPtr() + soon);
    const int place = L_.outerIndexPtr()[next];
    __builtin_prefetch(L_.innerIndexPtr() + place, 1);
    __builtin_prefetch(L_.valuePtr() + place, 1);
    __builtin_prefetch(L_.valuePtr() + place + 6, 1);
  }

  const WeightRows& rows_;
  const Buffer<int>& input_index_;
  const Workers& workers_;
  SparseMatrix& L_;
  VectorXd& M_;
  std::vector<int>& component_;
  Report& report_;
};

}  // namespace tufted
