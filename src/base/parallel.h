#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#include "tufted/options.h"

namespace tufted {

/// The one place that decides about threads, progress and cancellation of a build.
///
/// Work is cut into blocks whose size does not depend on the number of threads, and every block writes only its
/// own part of the output. So the result has the same bits for any number of threads.
class Workers {
 public:
  /// @param threads at most this many, and at most four per processor (16 if that is more); 0 for what OpenMP offers
  Workers(int threads, const Progress& progress);

  int count() const { return count_; }

  /// Calls `work(begin, end, worker)` for consecutive ranges that cover [0, size), `worker` in [0, count()).
  /// The first exception thrown by `work` is rethrown here.
  /// @throws Cancelled when the progress callback says so
  void forBlocks(std::string_view stage, std::int64_t size, std::int64_t block,
                 const std::function<void(std::int64_t, std::int64_t, int)>& work) const;

  /// Reports progress from a serial stage; throws Cancelled when told to stop.
  void report(std::string_view stage, double fraction) const;

 private:
  int count_;
  const Progress& progress_;
};

}  // namespace tufted
