#pragma once

namespace tufted {

/// While it lasts, the calling thread runs a library that takes memory by itself. What counts a build's use of the heap
/// counts that apart.
class ForeignMemory {
 public:
  ForeignMemory() { ++depth; }
  ~ForeignMemory() { --depth; }
  ForeignMemory(const ForeignMemory&) = delete;
  ForeignMemory& operator=(const ForeignMemory&) = delete;

  static bool isBeingTaken() { return depth > 0; }

 private:
  static inline thread_local int depth = 0;
};

}  // namespace tufted
