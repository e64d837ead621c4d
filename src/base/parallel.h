#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "base/buffer.h"
#include "tufted/options.h"

namespace tufted {

/// Points or faces per block of a loop, by the work that each takes: enough to outweigh the cost of fetching a block,
/// few enough to give many threads a block each.
constexpr std::int64_t costly_block = 256;      ///< each may take 0.1 ms
constexpr std::int64_t star_block = 1024;       ///< the lists of neighbours of these points fit the second-level cache
constexpr std::int64_t usual_block = 4096;      ///< for work between costly and cheap
constexpr std::int64_t cheap_block = 8192;      ///< each takes little work
constexpr std::int64_t cheapest_block = 16384;  ///< each takes a few operations

/// The one place that decides about threads, progress and cancellation of a build.
///
/// Work is cut into blocks whose size does not depend on the number of threads, and every block writes only its own
/// part of the output. So the result has the same bits for any number of threads. All threads use the caller's
/// workspace. An object serves one calling thread, which runs one loop at a time.
class Workers {
 public:
  /// @param threads at most this many, and at most four per processor (16 if that is more); 0 for one per processor
  ///   that this process may use
  Workers(int threads, const Progress& progress);
  ~Workers();

  int count() const { return count_; }

  /// Calls `work(begin, end, worker)` for consecutive ranges that cover [0, size), `worker` in [0, count()).
  /// The first exception thrown by `work` is rethrown here.
  /// @throws Cancelled when the progress callback returns false
  template <class Work>
  void forBlocks(std::string_view stage, std::int64_t size, std::int64_t block, const Work& work) const {
    // A std::function would allocate memory.
    runBlocks(
        stage, size, block,
        [](const void* any, std::int64_t begin, std::int64_t end, int worker) {
          (*static_cast<const Work*>(any))(begin, end, worker);
        },
        &work);
  }

  /// Reports progress from a serial stage; throws Cancelled when the callback returns false.
  void report(std::string_view stage, double fraction) const;

 private:
  using RunBlock = void (*)(const void* work, std::int64_t begin, std::int64_t end, int worker);
  void runBlocks(std::string_view stage, std::int64_t size, std::int64_t block, RunBlock run_block,
                 const void* work) const;

  struct Team;

  int count_;
  const Progress& progress_;
  std::unique_ptr<Team> team_;  ///< null if count() is 1
};

/// All numbers i in [0, size) for which test(i) holds, ascending.
template <class Test>
Buffer<int> numbersWhere(std::string_view stage, int size, const Workers& workers, const Test& test) {
  Buffer<Buffer<int>> parts(static_cast<std::size_t>((size + cheap_block - 1) / cheap_block));
  workers.forBlocks(stage, size, cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (int i = static_cast<int>(begin); i < end; ++i)
      if (test(i)) parts[begin / cheap_block].push_back(i);
  });
  Buffer<int> numbers;
  for (const Buffer<int>& part : parts) numbers.insert(numbers.end(), part.begin(), part.end());
  return numbers;
}

}  // namespace tufted
