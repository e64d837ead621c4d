#include "attacks/failing_malloc.h"

#include <dlfcn.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstring>

#include "support/libc_malloc.h"

namespace {

std::atomic<std::int64_t> live{0}, left{0};
std::atomic<std::size_t> least_size{0};
std::atomic<bool> goes_on{false}, failed{false};  // all fail once both are set

/// Whether OpenMP's library asks, which CHOLMOD uses: it ends the process if it gets none.
bool diesWithout(const void* caller) {
  Dl_info info;
  if (dladdr(caller, &info) == 0) return false;
  return std::strstr(info.dli_fname, "libgomp") != nullptr;
}

/// Counts a request down. False if it is to fail.
bool mayTake(std::size_t size, const void* caller) {
  std::int64_t now = left;
  const bool fails_always = goes_on && failed;
  if ((now == 0 && !fails_always) || size < least_size || diesWithout(caller)) return true;
  if (fails_always) return false;
  while (now > 0 && !left.compare_exchange_weak(now, now - 1)) {
  }
  if (now != 1) return true;
  failed = true;
  return false;
}

void* counted(void* block) {
  if (block != nullptr) ++live;
  return block;
}

void* refused() {
  errno = ENOMEM;
  return nullptr;
}

}  // namespace

// These replace the functions of the C library.
extern "C" {
void* malloc(std::size_t size) {
  return mayTake(size, __builtin_return_address(0)) ? counted(__libc_malloc(size)) : refused();
}
void* calloc(std::size_t number, std::size_t size) {
  return mayTake(number * size, __builtin_return_address(0)) ? counted(__libc_calloc(number, size)) : refused();
}
void* realloc(void* memory, std::size_t size) {
  if (size > 0 && !mayTake(size, __builtin_return_address(0))) return refused();
  void* const block = __libc_realloc(memory, size);
  if (memory == nullptr) return counted(block);
  if (size == 0) --live;
  return block;
}
void* memalign(std::size_t alignment, std::size_t size) {
  return mayTake(size, __builtin_return_address(0)) ? counted(__libc_memalign(alignment, size)) : refused();
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return mayTake(size, __builtin_return_address(0)) ? counted(__libc_memalign(alignment, size)) : refused();
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  if (!mayTake(size, __builtin_return_address(0))) return ENOMEM;
  void* const block = counted(__libc_memalign(alignment, size));
  if (block == nullptr) return ENOMEM;
  *memory = block;
  return 0;
}
void free(void* memory) {
  if (memory != nullptr) --live;
  __libc_free(memory);
}
}

namespace tufted::attacks {

void failRequest(std::int64_t nth, bool from_then_on, std::size_t least) {
  left = 0;
  failed = false;
  goes_on = from_then_on;
  least_size = least;
  left = nth;
}

bool hasFailed() {
  return failed;
}

std::int64_t liveBlocks() {
  return live;
}

}  // namespace tufted::attacks
