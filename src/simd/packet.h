#pragma once

// Arithmetic on eight numbers at once, a Packet, for the sources of kernels only. A Part is as much of a packet as one
// register holds; loops that treat each number alone go by parts, since whole packets would fill all registers. This
// header includes none with functions of others: a copy of one that is compiled for one kind of processor could be
// linked into code for another.
#include <cstdint>
#if defined(TUFTED_WIDE_PACKETS) || defined(__SSE2__)
#include <immintrin.h>
#endif

#define TUFTED_INLINE static inline __attribute__((always_inline))

namespace tufted {
namespace {

constexpr int packet_size = 8, float_packet_size = 16;

#ifdef TUFTED_WIDE_PACKETS

using Packet = __m512d;
using Mask = __mmask8;  // a bit for each number
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
/// Bit i is number i's.
TUFTED_INLINE unsigned bitsOf(Mask mask) {
  return mask;
}
/// The inverse of bitsOf(), for as many numbers as a part has.
TUFTED_INLINE PartMask maskOf(unsigned bits) {
  return static_cast<PartMask>(bits);
}
TUFTED_INLINE Mask none() {
  return 0;
}
/// The first `count` numbers, all of them for more.
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

/// Writes the chosen numbers to the front and anything behind them, a whole packet.
TUFTED_INLINE void compress(Mask chosen, Packet a, double* to) {
  // In the register: compressing stores are slow on some processors.
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

/// How many of the values are less than each of `some`, which are so many packets of floats.
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

#else

// Pairs are what every processor has. Larger vectors are left to the compiler, which takes them apart badly.
using Pair = double __attribute__((vector_size(16)));
using PairMask = std::int64_t __attribute__((vector_size(16)));  // 0 or -1
constexpr int pairs = packet_size / 2;

struct Packet {
  Pair of[pairs];
};
struct Mask {
  PairMask of[pairs];
};
using Part = Pair;
using PartMask = PairMask;
constexpr int part_size = 2;

template <class Result, class A, class Each>
TUFTED_INLINE Result forPairs(const A& a, const Each& each) {
  return {each(a.of[0]), each(a.of[1]), each(a.of[2]), each(a.of[3])};
}
template <class Result, class A, class B, class Each>
TUFTED_INLINE Result forPairs(const A& a, const B& b, const Each& each) {
  return {each(a.of[0], b.of[0]), each(a.of[1], b.of[1]), each(a.of[2], b.of[2]), each(a.of[3], b.of[3])};
}

TUFTED_INLINE Packet operator+(Packet a, Packet b) {
  return forPairs<Packet>(a, b, [](Pair x, Pair y) { return x + y; });
}
TUFTED_INLINE Packet operator-(Packet a, Packet b) {
  return forPairs<Packet>(a, b, [](Pair x, Pair y) { return x - y; });
}
TUFTED_INLINE Packet operator*(Packet a, Packet b) {
  return forPairs<Packet>(a, b, [](Pair x, Pair y) { return x * y; });
}
TUFTED_INLINE Packet operator/(Packet a, Packet b) {
  return forPairs<Packet>(a, b, [](Pair x, Pair y) { return x / y; });
}
TUFTED_INLINE Packet operator-(Packet a) {
  return forPairs<Packet>(a, [](Pair x) { return -x; });
}

TUFTED_INLINE Packet broadcast(double value) {
  const Pair pair{value, value};
  return {pair, pair, pair, pair};
}
TUFTED_INLINE Part loadPart(const double* values) {
  Part part;
  __builtin_memcpy(&part, values, sizeof(part));
  return part;
}
TUFTED_INLINE void store(Part a, double* values) {
  __builtin_memcpy(values, &a, sizeof(a));
}
TUFTED_INLINE Part broadcastPart(double value) {
  return Part{value, value};
}
TUFTED_INLINE PairMask isLess(Part a, Part b) {
  return a < b;
}
TUFTED_INLINE PairMask isAtMost(Part a, Part b) {
  return a <= b;
}
TUFTED_INLINE PairMask logicalAnd(PairMask a, PairMask b) {
  return a & b;
}
TUFTED_INLINE PairMask maskOf(unsigned bits) {
  return -PairMask{bits & 1, bits >> 1 & 1};
}
TUFTED_INLINE Part select(PairMask mask, Part a, Part b) {
  return mask ? a : b;
}
TUFTED_INLINE Packet load(const double* values) {
  return {loadPart(values), loadPart(values + 2), loadPart(values + 4), loadPart(values + 6)};
}
TUFTED_INLINE void store(const Packet& a, double* values) {
  store(a.of[0], values);
  store(a.of[1], values + 2);
  store(a.of[2], values + 4);
  store(a.of[3], values + 6);
}
#ifdef __SSE2__  // what the compiler makes of the generic ones below takes longer
TUFTED_INLINE Pair squareRoot(Pair x) {
  return _mm_sqrt_pd(x);
}
TUFTED_INLINE Pair min(Pair x, Pair y) {
  return _mm_min_pd(x, y);
}
TUFTED_INLINE Pair max(Pair x, Pair y) {
  return _mm_max_pd(x, y);
}
TUFTED_INLINE Pair absolute(Pair x) {
  return _mm_andnot_pd(Pair{-0.0, -0.0}, x);
}
/// Bit i is number i's.
TUFTED_INLINE unsigned bitsOf(PairMask mask) {
  return static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<Pair>(mask)));
}
#else
TUFTED_INLINE Pair squareRoot(Pair x) {
  return Pair{__builtin_sqrt(x[0]), __builtin_sqrt(x[1])};
}
TUFTED_INLINE Pair min(Pair x, Pair y) {
  return x < y ? x : y;
}
TUFTED_INLINE Pair max(Pair x, Pair y) {
  return x > y ? x : y;
}
TUFTED_INLINE Pair absolute(Pair x) {
  return Pair{__builtin_fabs(x[0]), __builtin_fabs(x[1])};
}
TUFTED_INLINE unsigned bitsOf(PairMask mask) {
  return static_cast<unsigned>(mask[0] & 1) | static_cast<unsigned>(mask[1] & 2);
}
#endif

TUFTED_INLINE Packet absolute(Packet a) {
  return forPairs<Packet>(a, [](Pair x) { return absolute(x); });
}
TUFTED_INLINE Packet squareRoot(Packet a) {
  return forPairs<Packet>(a, [](Pair x) { return squareRoot(x); });
}
TUFTED_INLINE Packet min(Packet a, Packet b) {
  return forPairs<Packet>(a, b, [](Pair x, Pair y) { return min(x, y); });
}
TUFTED_INLINE Packet max(Packet a, Packet b) {
  return forPairs<Packet>(a, b, [](Pair x, Pair y) { return max(x, y); });
}
TUFTED_INLINE double reduceMin(Packet a) {
  double value = a.of[0][0];
  for (const Pair& pair : a.of)
    for (int i = 0; i < 2; ++i) value = pair[i] < value ? pair[i] : value;
  return value;
}
TUFTED_INLINE double reduceMax(Packet a) {
  return -reduceMin(-a);
}
TUFTED_INLINE Mask isLess(Packet a, Packet b) {
  return forPairs<Mask>(a, b, [](Pair x, Pair y) { return x < y; });
}
TUFTED_INLINE Mask isAtMost(Packet a, Packet b) {
  return forPairs<Mask>(a, b, [](Pair x, Pair y) { return x <= y; });
}
TUFTED_INLINE Mask logicalAnd(Mask a, Mask b) {
  return forPairs<Mask>(a, b, [](PairMask x, PairMask y) { return x & y; });
}
TUFTED_INLINE Mask logicalOr(Mask a, Mask b) {
  return forPairs<Mask>(a, b, [](PairMask x, PairMask y) { return x | y; });
}
TUFTED_INLINE Mask none() {
  return {};
}
TUFTED_INLINE unsigned bitsOf(const Mask& mask) {
  return bitsOf(mask.of[0]) | bitsOf(mask.of[1]) << 2 | bitsOf(mask.of[2]) << 4 | bitsOf(mask.of[3]) << 6;
}
TUFTED_INLINE bool any(const Mask& mask) {
  return bitsOf((mask.of[0] | mask.of[1]) | (mask.of[2] | mask.of[3])) != 0;
}
TUFTED_INLINE Packet select(Mask mask, Packet a, Packet b) {
  return {mask.of[0] ? a.of[0] : b.of[0], mask.of[1] ? a.of[1] : b.of[1], mask.of[2] ? a.of[2] : b.of[2],
          mask.of[3] ? a.of[3] : b.of[3]};
}
TUFTED_INLINE Mask firstOf(int count) {
  Mask mask;
  for (int i = 0; i < pairs; ++i) mask.of[i] = PairMask{2 * i, 2 * i + 1} < PairMask{count, count};
  return mask;
}
TUFTED_INLINE Mask differ(const int* values, int value) {
  const auto differs = [&](int i) { return values[i] != value ? std::int64_t{-1} : std::int64_t{0}; };
  Mask mask;
  for (int i = 0; i < pairs; ++i) mask.of[i] = PairMask{differs(2 * i), differs(2 * i + 1)};
  return mask;
}
TUFTED_INLINE int countOf(const Mask& mask) {
  const PairMask count = -(mask.of[0] + mask.of[1] + mask.of[2] + mask.of[3]);
  return static_cast<int>(count[0] + count[1]);
}

template <class Value>
TUFTED_INLINE void compressEach(unsigned chosen, const Value* values, Value* to) {
  for (int i = 0; i < packet_size; ++i) {  // without a branch: which are chosen cannot be foreseen
    *to = values[i];
    to += chosen >> i & 1U;
  }
}
TUFTED_INLINE void compress(const Mask& chosen, const Packet& a, double* to) {
  double values[packet_size];
  store(a, values);
  compressEach(bitsOf(chosen), values, to);
}
TUFTED_INLINE void compress(const Mask& chosen, const int* a, int* to) {
  compressEach(bitsOf(chosen), a, to);
}

TUFTED_INLINE void storeFloats(const Packet& a, float* to) {
  double values[packet_size];
  store(a, values);
  for (int i = 0; i < packet_size; ++i) to[i] = static_cast<float>(values[i]);
}

template <int packets>
TUFTED_INLINE void rankFloats(const float* some, const float* values, int count, int* rank) {
  using Four = float __attribute__((vector_size(16)));
  using FourCounts = int __attribute__((vector_size(16)));
  constexpr int fours = float_packet_size / 4;
  for (int l = 0; l < packets; ++l, rank += float_packet_size) {
    Four mine[fours];
    FourCounts less[fours] = {};
    __builtin_memcpy(mine, some + l * float_packet_size, sizeof(mine));
    for (int j = 0; j < count; ++j) {
      const Four value = {values[j], values[j], values[j], values[j]};
      for (int i = 0; i < fours; ++i) less[i] -= value < mine[i];  // true is -1
    }
    __builtin_memcpy(rank, less, sizeof(less));
  }
}

#endif

}  // namespace
}  // namespace tufted
