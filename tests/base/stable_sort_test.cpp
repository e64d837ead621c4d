#include "base/stable_sort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>

#include "base/buffer.h"

namespace tufted::stable_sort_test {
namespace {

TEST(StableSort, AgreesWithTheStandardLibrary) {
  std::mt19937_64 random(1);
  for (const int size : {0, 1, 31, 32, 33, 64, 65, 1000, 4097}) {
    Buffer<std::pair<int, int>> values, scratch;
    for (int i = 0; i < size; ++i) values.emplace_back(static_cast<int>(random() % 20), i);
    Buffer<std::pair<int, int>> expected = values;
    const auto less = [](const auto& a, const auto& b) { return a.first < b.first; };
    std::stable_sort(expected.begin(), expected.end(), less);
    stableSort(values.data(), values.data() + values.size(), scratch, less);
    EXPECT_EQ(values, expected) << size;
  }
}

}  // namespace
}  // namespace tufted::stable_sort_test
