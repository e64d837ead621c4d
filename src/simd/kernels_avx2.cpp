// Compiled with AVX2 where the compiler can.
#define TUFTED_KERNELS avx2_kernels
#include "simd/kernels_source.h"
