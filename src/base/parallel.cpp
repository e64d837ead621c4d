#include "base/parallel.h"

#include <pthread.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <exception>

#include "base/workspace.h"
#include "tufted/errors.h"

// Tells ThreadSanitizer how work passes between threads, which it cannot see in TBB, a library not compiled for it.
#ifdef __has_feature
#define TUFTED_HAS_TSAN __has_feature(thread_sanitizer)
#else
#define TUFTED_HAS_TSAN 0
#endif
#if TUFTED_HAS_TSAN
#include <sanitizer/tsan_interface.h>
#endif

namespace tufted {
namespace {

/// A thread that takes work over sees all that was written before it was handed over.
void handOver([[maybe_unused]] void* work) {
#if TUFTED_HAS_TSAN
  __tsan_release(work);
#endif
}
void takeOver([[maybe_unused]] void* work) {
#if TUFTED_HAS_TSAN
  __tsan_acquire(work);
#endif
}

/// One per processor that this process may use, or fewer if the program limits TBB.
int offeredThreads() {
  return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

/// Whether this process was forked after TBB had started threads. A fork inherits no threads but the state of their
/// locks, some locked for ever, so it must not use TBB.
bool has_lost_threads = false;

/// More threads than this do not help, and each needs working memory of its own.
int mostThreads() {
  return std::max(16, 4 * offeredThreads());
}

int countFor(int threads) {
  if (threads == 1 || has_lost_threads) return 1;
  return std::max(1, std::min(threads > 0 ? threads : offeredThreads(), mostThreads()));
}

}  // namespace

/// The threads of a build. Idle threads of TBB sleep, and if other programs leave them no processor the calling thread
/// does all the work; those of OpenMP would spin while they wait for each other. The threads stay in the arena for a
/// while between two loops: with a new arena for each loop it takes 0.1 ms until they have come.
struct Workers::Team : InWorkspace {
  explicit Team(int count) : arena(std::min(count, offeredThreads())) {  // TBB would warn on stderr about more
    static const int watched = pthread_atfork(nullptr, nullptr, [] { has_lost_threads = true; });
    static_cast<void>(watched);
  }

  /// Calls run(0) to run(count - 1), the first on this thread.
  template <class Run>
  void run(int count, const Run& run) {
    arena.execute([&] {
      tbb::task_group others;
      handOver(&others);
      for (int worker = 1; worker < count; ++worker) {
        others.run([&run, &others, worker] {
          takeOver(&others);
          run(worker);
          handOver(&others);
        });
      }
      run(0);
      others.wait();
      takeOver(&others);
    });
  }

  tbb::task_arena arena;
};

Workers::Workers(int threads, const Progress& progress)
    : count_(countFor(threads)), progress_(progress), team_(count_ > 1 ? std::make_unique<Team>(count_) : nullptr) {}

Workers::~Workers() = default;

void Workers::report(std::string_view stage, double fraction) const {
  if (progress_ && !progress_(stage, fraction)) {
    throw Cancelled("cancelled during " + std::string(stage));
  }
}

void Workers::runBlocks(std::string_view stage, std::int64_t size, std::int64_t block, RunBlock run_block,
                        const void* work) const {
  const std::int64_t blocks = (size + block - 1) / block;
  std::atomic<std::int64_t> next{0};
  std::atomic<bool> stop{false};
  std::exception_ptr error;
  report(stage, 0);
  const int team = static_cast<int>(std::min<std::int64_t>(count_, blocks));
  Workspace* const workspace = Workspace::current();
  const auto run = [&](int worker) {
    const Workspace::Scope scope(workspace);
    try {
      for (std::int64_t b = next++; b < blocks && !stop; b = next++) {
        run_block(work, b * block, std::min(size, (b + 1) * block), worker);
        // Only worker 0, which is the calling thread, reports progress.
        if (worker == 0)
          report(stage, static_cast<double>(std::min(next.load(), blocks)) / static_cast<double>(blocks));
      }
    } catch (...) {
      if (!stop.exchange(true)) error = std::current_exception();
    }
  };
  if (team <= 1) {
    run(0);
  } else {
    team_->run(team, run);
  }
  if (error) std::rethrow_exception(error);
  report(stage, 1);  // worker 0 may not have run any block
}

}  // namespace tufted
