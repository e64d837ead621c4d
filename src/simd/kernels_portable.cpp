#define TUFTED_KERNELS portable_kernels
#include "simd/kernels_source.h"
