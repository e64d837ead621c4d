#pragma once

// Arithmetic on eight numbers at once, a Packet, only for the sources of kernels. A Part is as much of a packet as one
// register holds; loops without operations across lanes go by parts, since whole packets would fill all registers. This
// header includes none that defines functions: a copy of one that is compiled for one kind of processor could be linked
// into code for another.
#include <cstdint>
#if defined(TUFTED_WIDE_PACKETS) || defined(__SSE2__)
#include <immintrin.h>
#endif

#define TUFTED_INLINE static inline __attribute__((always_inline))

namespace tufted {
namespace {

/// Doubles and floats in an AVX-512 register.
constexpr int packet_size = 8, float_packet_size = 16;

}  // namespace
}  // namespace tufted

#ifdef TUFTED_WIDE_PACKETS
#include "simd/packet_avx512.h"
#else
#include "simd/packet_parts.h"
#endif
