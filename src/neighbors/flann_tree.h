#pragma once

#include <stdlib.h>  // FLANN includes it, and its `using std::malloc` must come before the macro below

#include <cstdio>
#include <cstdlib>
#include <new>

// FLANN's tree in memory that throws. FLANN writes its nodes to whatever malloc() returns, null as well, so its
// allocator gets one that throws. It and the tree that holds it also get other names, because the linker keeps one copy
// of an inline function, and other files include FLANN as it is.
namespace tufted {
inline void* mallocOrThrow(std::size_t bytes) {
  void* const memory = std::malloc(bytes);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
}  // namespace tufted
#define malloc tufted::mallocOrThrow
#define PooledAllocator TuftedPooledAllocator
#define KDTreeSingleIndex TuftedKDTreeSingleIndex
#include <flann/util/allocator.h>
#undef malloc

#include <flann/algorithms/dist.h>
#include <flann/algorithms/kdtree_single_index.h>
