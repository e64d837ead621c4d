#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>

#include "base/parallel.h"
#include "denoise/windows.h"

namespace tufted {

/// Calls visit(p) for every point, which may write what belongs to p alone.
template <class Visit>
void forEachPoint(const Windows& windows, const Workers& workers, const Visit& visit) {
  workers.forBlocks("noise", windows.size(), star_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (int p = static_cast<int>(begin); p < end; ++p) visit(p);
  });
}

/// The numbers of all windows.
inline Buffer<int> allOf(const Windows& windows) {
  Buffer<int> all(windows.base.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// Takes from a list the numbers that pass the test, in their order.
template <class Test>
Buffer<int> listedWhere(std::span<const int> list, const Workers& workers, const Test& test) {
  Buffer<int> found =
      numbersWhere("noise", static_cast<int>(list.size()), workers, [&](int i) { return test(list[i]); });
  for (int& i : found) i = list[i];
  return found;
}

/// The variance of a fit's residuals, 0 where there is no fit.
inline double residualOf(const WindowFit& fit) {
  return std::isfinite(fit.variance) ? fit.variance : 0;
}

/// Calls visit(q, times) for p and its pool. A pool of few windows holds each several times, one after the other.
template <class Visit>
void forEachPooled(int p, const Windows::Pool& pool, const Visit& visit) {
  int last = p, times = 1;
  for (const int q : pool) {
    if (q == last) {
      ++times;
      continue;
    }
    visit(last, times);
    last = q;
    times = 1;
  }
  visit(last, times);
}

/// The mean of value(q) over p and its pool.
template <class Value>
double pooledMean(int p, const Windows::Pool& pool, const Value& value) {
  double sum = 0;
  forEachPooled(p, pool, [&](int q, int times) { sum += times * value(q); });
  return sum / (Windows::pooled + 1);
}

/// The value(q) over p and its pool that has `rank` smaller ones.
template <class Value>
double pooledQuantile(int p, const Windows::Pool& pool, int rank, const Value& value) {
  std::array<std::pair<double, int>, Windows::pooled + 1> values;  // with how often each is there
  auto end = values.begin();
  forEachPooled(p, pool, [&](int q, int times) { *end++ = {value(q), times}; });
  std::sort(values.begin(), end);
  auto found = values.begin();
  for (int up_to_found = found->second; up_to_found <= rank; up_to_found += found->second) ++found;
  return found->first;
}

template <class Value>
double pooledMedian(int p, const Windows::Pool& pool, const Value& value) {
  return pooledQuantile(p, pool, Windows::pooled / 2, value);
}

}  // namespace tufted
