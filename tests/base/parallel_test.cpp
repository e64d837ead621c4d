#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "tufted/errors.h"

namespace tufted::parallel_test {
namespace {

TEST(Workers, VisitEveryItemOnce) {
  const Progress silent;
  for (const int threads : {1, 2, 5}) {
    for (const int size : {0, 1, 99, 100, 101}) {
      std::vector<std::atomic<int>> visits(size);
      Workers(threads, silent).forBlocks("", size, 10, [&](std::int64_t begin, std::int64_t end, int worker) {
        EXPECT_LT(worker, threads);
        for (std::int64_t i = begin; i < end; ++i) ++visits[i];
      });
      for (const auto& count : visits) EXPECT_EQ(count, 1);
    }
  }
}

TEST(Workers, PassOnTheFirstException) {
  const Progress silent;
  for (const int threads : {1, 3}) {
    EXPECT_THROW(Workers(threads, silent)
                     .forBlocks("", 1000, 1, [](std::int64_t, std::int64_t, int) { throw InvalidInput("stop"); }),
                 InvalidInput);
  }
}

TEST(Workers, GoOnAfterALoopThatThrew) {
  const Progress silent;
  const Workers workers(3, silent);
  for (int loop = 0; loop < 50; ++loop) {
    EXPECT_THROW(workers.forBlocks("", 20, 1, [](std::int64_t, std::int64_t, int) { throw InvalidInput("stop"); }),
                 InvalidInput);
    std::atomic<int> visits{0};
    workers.forBlocks("", 100, 1, [&](std::int64_t, std::int64_t, int) { ++visits; });
    EXPECT_EQ(visits, 100);
  }
}

TEST(Workers, StopWhenTheCallerSaysSo) {
  const Progress stop = [](std::string_view, double fraction) { return fraction < 0.1; };
  for (const int threads : {1, 2}) {
    std::atomic<int> blocks{0};
    const Workers workers(threads, stop);
    EXPECT_THROW(workers.forBlocks("", 1000, 1, [&](std::int64_t, std::int64_t, int) { ++blocks; }), Cancelled);
    EXPECT_LE(blocks, threads == 1 ? 100 : 1000);
  }
}

}  // namespace
}  // namespace tufted::parallel_test
