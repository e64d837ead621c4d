// Compiled with AVX-512 where the compiler can.
#define TUFTED_WIDE_LANES
#define TUFTED_KERNELS avx512_kernels
#include "cloud/kernels_source.h"
