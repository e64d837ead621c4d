#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdint>

namespace tufted::view {

/// Calls `work(begin, end)` on several threads for ranges of `block` numbers that cover [0, size).
/// @param threads at most this many; 0: one per processor
template <class Work>
void forBlocks(int threads, std::int64_t size, std::int64_t block, const Work& work) {
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::int64_t>(0, (size + block - 1) / block, 1),
                      [&](const tbb::blocked_range<std::int64_t>& blocks) {
                        for (std::int64_t b = blocks.begin(); b < blocks.end(); ++b)
                          work(b * block, std::min(size, (b + 1) * block));
                      });
  });
}

}  // namespace tufted::view
