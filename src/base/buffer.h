#pragma once

#include <cstddef>
#include <limits>
#include <new>
#include <vector>

#include "base/workspace.h"

namespace tufted {

/// Takes memory where takeBlock() does.
template <class T>
struct WorkspaceAllocator {
  static_assert(alignof(T) <= __STDCPP_DEFAULT_NEW_ALIGNMENT__);
  using value_type = T;

  WorkspaceAllocator() = default;
  template <class U>
  WorkspaceAllocator(const WorkspaceAllocator<U>&) {}  // NOLINT(google-explicit-constructor): allocators convert

  T* allocate(std::size_t count) {
    if (count > std::numeric_limits<std::size_t>::max() / 2 / sizeof(T)) throw std::bad_array_new_length();
    return static_cast<T*>(takeBlock(count * sizeof(T)));
  }
  void deallocate(T* memory, std::size_t) noexcept { giveBlock(memory); }

  friend bool operator==(const WorkspaceAllocator&, const WorkspaceAllocator&) { return true; }
};

/// The arrays of the stages of a build: vectors whose memory a LaplacianBuilder keeps for its next frame.
template <class T>
using Buffer = std::vector<T, WorkspaceAllocator<T>>;

/// Gives the memory back, which `values = {}` and clear() keep.
template <class Array>
void release(Array& values) {
  Array().swap(values);
}

}  // namespace tufted
