#include "simd/kernels.h"

#include <atomic>

namespace tufted {

extern const Kernels portable_kernels;
#ifdef TUFTED_X86_KERNELS
extern const Kernels avx2_kernels, avx512_kernels;
#endif

namespace {

std::atomic<const Kernels*> chosen_kernels = nullptr;

const Kernels& fastestKernels() {
#ifdef TUFTED_X86_KERNELS
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq"))
    return avx512_kernels;
  if (__builtin_cpu_supports("avx2")) return avx2_kernels;
#endif
  return portable_kernels;
}

}  // namespace

const Kernels& portableKernels() {
  return portable_kernels;
}

const Kernels& kernels() {
  static const Kernels& fastest = fastestKernels();
  const Kernels* chosen = chosen_kernels.load(std::memory_order_relaxed);
  return chosen != nullptr ? *chosen : fastest;
}

void chooseKernels(const Kernels* chosen) {
  chosen_kernels = chosen;
}

}  // namespace tufted
