#include "tufted/detail/memory_layout.h"

const char TUFTED_MEMORY_LAYOUT = 0;
