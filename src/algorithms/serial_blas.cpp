#include "algorithms/serial_blas.h"

#include <dlfcn.h>

#include <mutex>

namespace tufted {
namespace {

/// OpenBLAS keeps one number of threads for the whole process; it is put back when the last user leaves.
struct Setting {
  // Looked up at run time, as Debian's alternatives decide which BLAS is used when the program starts.
  int (*get)() = reinterpret_cast<int (*)()>(dlsym(RTLD_DEFAULT, "openblas_get_num_threads"));
  void (*set)(int) = reinterpret_cast<void (*)(int)>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads"));
  std::mutex mutex;
  int users = 0;
  int before = 1;
};

Setting& setting() {
  static Setting instance;
  return instance;
}

}  // namespace

SerialBlas::SerialBlas() {
  Setting& blas = setting();
  if (blas.get == nullptr || blas.set == nullptr) return;
  const std::lock_guard lock(blas.mutex);
  if (blas.users++ > 0) return;
  blas.before = blas.get();
  if (blas.before != 1) blas.set(1);
}

SerialBlas::~SerialBlas() {
  Setting& blas = setting();
  if (blas.get == nullptr || blas.set == nullptr) return;
  const std::lock_guard lock(blas.mutex);
  if (--blas.users == 0 && blas.before != 1) blas.set(blas.before);
}

}  // namespace tufted
