#include "tufted/memory_layout.h"

const char TUFTED_MEMORY_LAYOUT = 0;
