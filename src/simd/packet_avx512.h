#pragma once

// Packets in registers of AVX-512; see packet.h.

namespace tufted {
namespace {

using Packet = __m512d;
using Mask = __mmask8;  // bit i is that of number i
using Part = Packet;
using PartMask = Mask;
constexpr int part_size = packet_size;

TUFTED_INLINE Packet broadcast(double value) {
  return _mm512_set1_pd(value);
}
TUFTED_INLINE Packet load(const double* values) {
  return _mm512_loadu_pd(values);
}
TUFTED_INLINE Part loadPart(const double* values) {
  return load(values);
}
TUFTED_INLINE Part broadcastPart(double value) {
  return broadcast(value);
}
TUFTED_INLINE void store(Packet a, double* values) {
  _mm512_storeu_pd(values, a);
}
TUFTED_INLINE Packet select(Mask mask, Packet a, Packet b) {
  return _mm512_mask_blend_pd(mask, b, a);
}
TUFTED_INLINE Packet absolute(Packet a) {
  return _mm512_abs_pd(a);
}
TUFTED_INLINE Packet squareRoot(Packet a) {
  return _mm512_sqrt_pd(a);
}
TUFTED_INLINE Packet min(Packet a, Packet b) {
  return _mm512_min_pd(a, b);
}
TUFTED_INLINE Packet max(Packet a, Packet b) {
  return _mm512_max_pd(a, b);
}
TUFTED_INLINE double reduceMin(Packet a) {
  return _mm512_reduce_min_pd(a);
}
TUFTED_INLINE double reduceMax(Packet a) {
  return _mm512_reduce_max_pd(a);
}
TUFTED_INLINE Mask isLess(Packet a, Packet b) {
  return _mm512_cmp_pd_mask(a, b, _CMP_LT_OQ);
}
TUFTED_INLINE Mask isAtMost(Packet a, Packet b) {
  return _mm512_cmp_pd_mask(a, b, _CMP_LE_OQ);
}
TUFTED_INLINE Mask logicalAnd(Mask a, Mask b) {
  return static_cast<Mask>(a & b);
}
TUFTED_INLINE Mask logicalOr(Mask a, Mask b) {
  return static_cast<Mask>(a | b);
}
TUFTED_INLINE bool any(Mask mask) {
  return mask != 0;
}
TUFTED_INLINE unsigned bitsOf(Mask mask) {
  return mask;
}
/// The inverse of bitsOf() for the numbers of a part.
TUFTED_INLINE PartMask maskOf(unsigned bits) {
  return static_cast<PartMask>(bits);
}
TUFTED_INLINE Mask none() {
  return 0;
}
/// The first `count` numbers, at most all.
TUFTED_INLINE Mask firstOf(int count) {
  return static_cast<Mask>(count < packet_size ? (1U << count) - 1 : 0xFF);
}
TUFTED_INLINE Mask differ(const int* values, int value) {
  return _mm256_cmpneq_epi32_mask(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(values)),
                                  _mm256_set1_epi32(value));
}
TUFTED_INLINE int countOf(Mask mask) {
  return __builtin_popcount(mask);
}

/// Writes the chosen numbers to the front of a whole packet, followed by arbitrary values.
TUFTED_INLINE void compress(Mask chosen, Packet a, double* to) {
  // Compresses in the register, because compressing stores are slow on some processors.
  _mm512_storeu_pd(to, _mm512_maskz_compress_pd(chosen, a));
}
TUFTED_INLINE void compress(Mask chosen, const int* a, int* to) {
  const __m256i values = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(a));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_maskz_compress_epi32(chosen, values));
}

/// Rounds each number to the nearest float.
TUFTED_INLINE void storeFloats(Packet a, float* to) {
  _mm256_storeu_ps(to, _mm512_cvtpd_ps(a));
}

/// For each number in `some`, `packets` packets of floats, how many of the values are less.
template <int packets>
TUFTED_INLINE void rankFloats(const float* some, const float* values, int count, int* rank) {
  __m512 mine[packets];
  __m512i less[packets];
  for (int l = 0; l < packets; ++l) mine[l] = _mm512_loadu_ps(some + l * float_packet_size);
  for (int l = 0; l < packets; ++l) less[l] = _mm512_setzero_si512();
  const __m512i one = _mm512_set1_epi32(1);
  for (int j = 0; j < count; ++j) {
    const __m512 value = _mm512_set1_ps(values[j]);
    for (int l = 0; l < packets; ++l)
      less[l] = _mm512_mask_add_epi32(less[l], _mm512_cmp_ps_mask(value, mine[l], _CMP_LT_OQ), less[l], one);
  }
  for (int l = 0; l < packets; ++l) _mm512_storeu_si512(rank + l * float_packet_size, less[l]);
}

}  // namespace
}  // namespace tufted
