#define TUFTED_KERNELS portable_kernels
#include "cloud/kernels_source.h"
