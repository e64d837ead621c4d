#include "heap/heap_count.h"

#include <dlfcn.h>
#include <execinfo.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <string_view>

#include "support/libc_malloc.h"

namespace {

std::atomic<std::int64_t> blocks{0}, foreign_blocks{0};

/// Whether an address lies in FLANN or CGAL, or in one of our functions that do nothing but call them, into which the
/// compiler may have put their code. Needs the program's symbols, so it is linked with -rdynamic.
bool isForeign(const void* address) {
  constexpr std::array<std::string_view, 5> foreign = {"flann", "CGAL", "KdForest6search", "11orientation",
                                                       "12sideOfCircle"};
  Dl_info info;
  if (dladdr(address, &info) == 0 || info.dli_sname == nullptr) return false;
  const std::string_view name = info.dli_sname;
  return std::any_of(foreign.begin(), foreign.end(), [&](auto part) { return name.find(part) != name.npos; });
}

/// Whether a library is asking, by the functions that are being run.
bool isAskedByLibrary() {
  std::array<void*, 64> frames;
  const int count = backtrace(frames.data(), static_cast<int>(frames.size()));
  return std::any_of(frames.begin(), frames.begin() + count, isForeign);
}

void count() {
  thread_local bool is_counting = false;  // backtrace() may ask for memory itself
  if (is_counting) return;
  is_counting = true;
  ++(isAskedByLibrary() ? foreign_blocks : blocks);
  is_counting = false;
}

}  // namespace

// These replace the functions of the C library.
extern "C" {
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
