#include "algorithms/serial_blas.h"

#include <dlfcn.h>

#include <mutex>

namespace tufted {
namespace {

template <class Function>
Function* found(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, name));
}

/// OpenBLAS's number of threads, one for the whole process. It is restored when the last SerialBlas ends.
struct Setting {
  // Looked up at run time, as Debian's alternatives choose the BLAS when the program starts.
  int (*get)() = found<int()>("openblas_get_num_threads");
  void (*set)(int) = found<void(int)>("openblas_set_num_threads");
  std::mutex mutex;
  int users = 0;
  int before = 1;
};

Setting& setting() {
  static Setting instance;
  return instance;
}

/// OpenMP's limit on nested parallel regions, one per thread. With 0 it starts no threads, whatever number a region
/// asks for; CHOLMOD asks for four.
struct Nesting {
  int (*get)() = found<int()>("omp_get_max_active_levels");
  void (*set)(int) = found<void(int)>("omp_set_max_active_levels");
};
// Looked up when the library is loaded, as CHOLMOD's calls are bound then; later, another OpenMP may be found first.
const Nesting nesting;

/// Sets the limit, and returns the one before.
int changeNesting(int levels) {
  if (nesting.get == nullptr || nesting.set == nullptr) return levels;
  const int before = nesting.get();
  if (before != levels) nesting.set(levels);
  return before;
}

}  // namespace

SerialBlas::SerialBlas() : nesting_(changeNesting(0)) {
  Setting& blas = setting();
  if (blas.get == nullptr || blas.set == nullptr) return;
  const std::lock_guard lock(blas.mutex);
  if (blas.users++ > 0) return;
  blas.before = blas.get();
  if (blas.before != 1) blas.set(1);
}

SerialBlas::~SerialBlas() {
  changeNesting(nesting_);
  Setting& blas = setting();
  if (blas.get == nullptr || blas.set == nullptr) return;
  const std::lock_guard lock(blas.mutex);
  if (--blas.users == 0 && blas.before != 1) blas.set(blas.before);
}

}  // namespace tufted
