#pragma once

#include <Eigen/Core>

// How Eigen allocates depends on compiler flags: with -mavx2 or -march=native its matrices lie at multiples of 32 or 64
// bytes, otherwise of 16, and under the address sanitizer they are freed in another way. A program compiled with other
// flags than the library would crash. To make it fail at link time instead, every file that includes a header with
// functions refers to a symbol named after its own flags, and the library defines one such symbol only.
#if EIGEN_DEFAULT_ALIGN_BYTES > 32
#define TUFTED_MEMORY_LAYOUT \
  tufted_is_not_built_with_the_mavx512f_or_march_native_of_this_file__give_both_the_same_CMAKE_CXX_FLAGS
#elif EIGEN_DEFAULT_ALIGN_BYTES > 16
#define TUFTED_MEMORY_LAYOUT \
  tufted_is_not_built_with_the_mavx_mavx2_or_march_native_of_this_file__give_both_the_same_CMAKE_CXX_FLAGS
#elif !EIGEN_MALLOC_ALREADY_ALIGNED && EIGEN_DEFAULT_ALIGN_BYTES > 0
#define TUFTED_MEMORY_LAYOUT \
  tufted_is_not_built_with_the_fsanitize_address_of_this_file__define_EIGEN_MALLOC_ALREADY_ALIGNED_as_1
#else
#define TUFTED_MEMORY_LAYOUT \
  tufted_is_built_with_an_mavx_march_native_or_fsanitize_that_this_file_lacks__give_both_the_same_CMAKE_CXX_FLAGS
#endif

extern "C" const char TUFTED_MEMORY_LAYOUT;

#if defined(__GNUC__)
namespace tufted {
[[gnu::used]] static const char* const memory_layout = &TUFTED_MEMORY_LAYOUT;
}  // namespace tufted
#endif
