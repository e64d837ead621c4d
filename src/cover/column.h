#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>

#include "base/buffer.h"
#include "tufted/types.h"

namespace tufted {

/// One column of L, in the order that its entries come in.
class Column {
 public:
  /// Empties it and makes room.
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
  /// Puts each entry where the number of smaller rows says: faster than sorting, whose branches cannot be predicted.
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

/// Columns in the caller's order lie anywhere in memory, so they are fetched before their turn: first where they are.
inline void prefetchColumns(SparseMatrix& L, int soon, int next) {
  __builtin_prefetch(L.outerIndexPtr() + soon);
  const int place = L.outerIndexPtr()[next];
  __builtin_prefetch(L.innerIndexPtr() + place, 1);
  __builtin_prefetch(L.valuePtr() + place, 1);
  __builtin_prefetch(L.valuePtr() + place + 6, 1);
}

}  // namespace tufted
