// Compiled with AVX-512 where the compiler can.
#define TUFTED_WIDE_PACKETS
#define TUFTED_KERNELS avx512_kernels
#include "simd/kernels_source.h"
