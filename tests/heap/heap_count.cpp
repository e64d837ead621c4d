#include "heap/heap_count.h"

#include <atomic>
#include <cerrno>
#include <cstddef>

#include "base/foreign_memory.h"

namespace {

std::atomic<std::int64_t> blocks{0}, foreign_blocks{0};

void count() {
  ++(tufted::ForeignMemory::isBeingTaken() ? foreign_blocks : blocks);
}

}  // namespace

// In place of the C library's, which has them under these names too.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) {
  count();
  return __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size) {
  count();
  return __libc_calloc(number, size);
}
void* realloc(void* memory, std::size_t size) {
  count();
  return __libc_realloc(memory, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  count();
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  *memory = memalign(alignment, size);
  return *memory != nullptr ? 0 : ENOMEM;
}
}

namespace tufted::heap {

Count countSoFar() {
  return {blocks, foreign_blocks};
}

}  // namespace tufted::heap
