#include "denoise/pooling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "shapes/random.h"

namespace tufted::pooling_test {
namespace {

/// A pool that holds each of some windows several times, one after the other.
Windows::Pool poolOf(const std::vector<int>& windows) {
  Windows::Pool pool;
  for (std::size_t i = 0; i < pool.size(); ++i) pool[i] = windows[i * windows.size() / pool.size()];
  return pool;
}

TEST(Pooled, AreThoseOfAPlainList) {
  shapes::Random random(1);
  for (const std::vector<int>& windows : {std::vector<int>{7}, std::vector<int>{3, 7, 9}, std::vector<int>{7, 3},
                                          std::vector<int>{1, 2, 3, 4, 5, 6, 8}}) {
    const Windows::Pool pool = poolOf(windows);
    std::vector<double> values(10);
    for (double& value : values) value = std::floor(4 * random.uniform());  // some are equal
    const auto valueOf = [&](int q) { return values[q]; };
    std::vector<double> all = {values[7]};
    double sum = values[7];
    for (const int q : pool) {
      all.push_back(values[q]);
      sum += values[q];
    }
    std::sort(all.begin(), all.end());
    EXPECT_DOUBLE_EQ(pooledMean(7, pool, valueOf), sum / static_cast<double>(all.size()));
    for (const int rank : {0, 3, 16, 32}) EXPECT_EQ(pooledQuantile(7, pool, rank, valueOf), all[rank]) << rank;
  }
}

}  // namespace
}  // namespace tufted::pooling_test
