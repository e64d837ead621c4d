#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/workspace.h"

namespace tufted {

/// Allocator of takeBlock() memory for standard containers.
template <class T>
class WorkspaceAllocator {
 public:
  using value_type = T;

  WorkspaceAllocator() = default;
  template <class U>
  WorkspaceAllocator(const WorkspaceAllocator<U>&) {}  // NOLINT(google-explicit-constructor): allocators convert

  T* allocate(std::size_t count) {
    if (count > std::numeric_limits<std::size_t>::max() / 2 / sizeof(T)) throw std::bad_array_new_length();
    void* const block = takeBlock(count * sizeof(T) + (is_wide ? alignof(T) : 0));
    if constexpr (!is_wide) return static_cast<T*>(block);
    // Blocks are aligned for pointers, so the block's address fits in front of the aligned array.
    const auto place = (reinterpret_cast<std::uintptr_t>(block) / alignof(T) + 1) * alignof(T);
    *(reinterpret_cast<void**>(place) - 1) = block;
    return reinterpret_cast<T*>(place);
  }
  void deallocate(T* memory, std::size_t) noexcept {
    giveBlock(is_wide ? *(reinterpret_cast<void**>(memory) - 1) : static_cast<void*>(memory));
  }

  friend bool operator==(const WorkspaceAllocator&, const WorkspaceAllocator&) { return true; }

 private:
  static constexpr bool is_wide = alignof(T) > alignof(void*);
};

/// The arrays of the stages of a build: vectors whose memory a LaplacianBuilder keeps for its next frame.
template <class T>
using Buffer = std::vector<T, WorkspaceAllocator<T>>;

/// Allocator that leaves new values uninitialised, so that each thread is the first to touch the values that it writes.
template <class T>
class UninitializedAllocator : public WorkspaceAllocator<T> {
 public:
  template <class U>
  struct rebind {  // NOLINT(readability-identifier-naming): the name that allocators must have
    using other = UninitializedAllocator<U>;
  };

  UninitializedAllocator() = default;
  template <class U>
  UninitializedAllocator(const UninitializedAllocator<U>&) {}  // NOLINT: allocators convert

  template <class U, class... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    if constexpr (sizeof...(Arguments) > 0)
      ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
    else if constexpr (!std::is_aggregate_v<U> || !std::is_trivially_destructible_v<U>)
      // the lifetime of an aggregate starts by itself, with its members uninitialised
      ::new (static_cast<void*>(place)) U;
  }
};

/// A Buffer that is resized without setting anything to 0: for large arrays that are written as a whole.
template <class T>
using RawBuffer = std::vector<T, UninitializedAllocator<T>>;

/// Empties an array and frees its memory, which `values = {}` and clear() keep.
template <class Array>
void release(Array& values) {
  Array().swap(values);
}

}  // namespace tufted
