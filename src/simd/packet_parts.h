#pragma once

// Packets in several registers, as vectors of GCC and Clang; see packet.h.

namespace tufted {
namespace {

// Compilers generate slow code for vectors wider than a register, so a packet is an array of parts.
#ifdef __AVX2__
/// Doubles in an AVX2 register.
constexpr int part_size = 4;
#else
constexpr int part_size = 2;  // doubles in an SSE register, which every processor has
#endif
constexpr int parts = packet_size / part_size;
using Part = double __attribute__((vector_size(part_size * sizeof(double))));
using PartMask = std::int64_t __attribute__((vector_size(part_size * sizeof(double))));  // 0 or -1

struct Packet {
  Part of[parts];
};
struct Mask {
  PartMask of[parts];
};

template <class Result, class A, class Each>
TUFTED_INLINE Result forParts(const A& a, const Each& each) {
  if constexpr (parts == 2)
    return {each(a.of[0]), each(a.of[1])};
  else
    return {each(a.of[0]), each(a.of[1]), each(a.of[2]), each(a.of[3])};
}
template <class Result, class A, class B, class Each>
TUFTED_INLINE Result forParts(const A& a, const B& b, const Each& each) {
  if constexpr (parts == 2)
    return {each(a.of[0], b.of[0]), each(a.of[1], b.of[1])};
  else
    return {each(a.of[0], b.of[0]), each(a.of[1], b.of[1]), each(a.of[2], b.of[2]), each(a.of[3], b.of[3])};
}

TUFTED_INLINE Packet operator+(Packet a, Packet b) {
  return forParts<Packet>(a, b, [](Part x, Part y) { return x + y; });
}
TUFTED_INLINE Packet operator-(Packet a, Packet b) {
  return forParts<Packet>(a, b, [](Part x, Part y) { return x - y; });
}
TUFTED_INLINE Packet operator*(Packet a, Packet b) {
  return forParts<Packet>(a, b, [](Part x, Part y) { return x * y; });
}
TUFTED_INLINE Packet operator/(Packet a, Packet b) {
  return forParts<Packet>(a, b, [](Part x, Part y) { return x / y; });
}
TUFTED_INLINE Packet operator-(Packet a) {
  return forParts<Packet>(a, [](Part x) { return -x; });
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
  Part part;
  for (int i = 0; i < part_size; ++i) part[i] = value;
  return part;
}
TUFTED_INLINE PartMask isLess(Part a, Part b) {
  return a < b;
}
TUFTED_INLINE PartMask isAtMost(Part a, Part b) {
  return a <= b;
}
TUFTED_INLINE PartMask logicalAnd(PartMask a, PartMask b) {
  return a & b;
}
TUFTED_INLINE PartMask maskOf(unsigned bits) {
  PartMask mask;
  for (int i = 0; i < part_size; ++i) mask[i] = -static_cast<std::int64_t>(bits >> i & 1U);
  return mask;
}
TUFTED_INLINE Part select(PartMask mask, Part a, Part b) {
  return mask ? a : b;
}
#ifdef __AVX2__  // faster than what the compiler makes of the generic functions below
TUFTED_INLINE Part squareRoot(Part x) {
  return _mm256_sqrt_pd(x);
}
TUFTED_INLINE Part min(Part x, Part y) {
  return _mm256_min_pd(x, y);
}
TUFTED_INLINE Part max(Part x, Part y) {
  return _mm256_max_pd(x, y);
}
TUFTED_INLINE Part absolute(Part x) {
  return _mm256_andnot_pd(broadcastPart(-0.0), x);
}
/// Bit i is that of number i.
TUFTED_INLINE unsigned bitsOf(PartMask mask) {
  return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<Part>(mask)));
}
#elif defined(__SSE2__)
TUFTED_INLINE Part squareRoot(Part x) {
  return _mm_sqrt_pd(x);
}
TUFTED_INLINE Part min(Part x, Part y) {
  return _mm_min_pd(x, y);
}
TUFTED_INLINE Part max(Part x, Part y) {
  return _mm_max_pd(x, y);
}
TUFTED_INLINE Part absolute(Part x) {
  return _mm_andnot_pd(broadcastPart(-0.0), x);
}
TUFTED_INLINE unsigned bitsOf(PartMask mask) {
  return static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<Part>(mask)));
}
#else
TUFTED_INLINE Part squareRoot(Part x) {
  return Part{__builtin_sqrt(x[0]), __builtin_sqrt(x[1])};
}
TUFTED_INLINE Part min(Part x, Part y) {
  return x < y ? x : y;
}
TUFTED_INLINE Part max(Part x, Part y) {
  return x > y ? x : y;
}
TUFTED_INLINE Part absolute(Part x) {
  return Part{__builtin_fabs(x[0]), __builtin_fabs(x[1])};
}
TUFTED_INLINE unsigned bitsOf(PartMask mask) {
  return static_cast<unsigned>(mask[0] & 1) | static_cast<unsigned>(mask[1] & 2);
}
#endif

TUFTED_INLINE Packet broadcast(double value) {
  Packet packet;
  for (Part& part : packet.of) part = broadcastPart(value);
  return packet;
}
TUFTED_INLINE Packet load(const double* values) {
  Packet packet;
  for (int i = 0; i < parts; ++i) packet.of[i] = loadPart(values + i * part_size);
  return packet;
}
TUFTED_INLINE void store(const Packet& a, double* values) {
  for (int i = 0; i < parts; ++i) store(a.of[i], values + i * part_size);
}
TUFTED_INLINE Packet absolute(Packet a) {
  return forParts<Packet>(a, [](Part x) { return absolute(x); });
}
TUFTED_INLINE Packet squareRoot(Packet a) {
  return forParts<Packet>(a, [](Part x) { return squareRoot(x); });
}
TUFTED_INLINE Packet min(Packet a, Packet b) {
  return forParts<Packet>(a, b, [](Part x, Part y) { return min(x, y); });
}
TUFTED_INLINE Packet max(Packet a, Packet b) {
  return forParts<Packet>(a, b, [](Part x, Part y) { return max(x, y); });
}
TUFTED_INLINE double reduceMin(Packet a) {
  double value = a.of[0][0];
  for (const Part& part : a.of)
    for (int i = 0; i < part_size; ++i) value = part[i] < value ? part[i] : value;
  return value;
}
TUFTED_INLINE double reduceMax(Packet a) {
  return -reduceMin(-a);
}
TUFTED_INLINE Mask isLess(Packet a, Packet b) {
  return forParts<Mask>(a, b, [](Part x, Part y) { return x < y; });
}
TUFTED_INLINE Mask isAtMost(Packet a, Packet b) {
  return forParts<Mask>(a, b, [](Part x, Part y) { return x <= y; });
}
TUFTED_INLINE Mask logicalAnd(Mask a, Mask b) {
  return forParts<Mask>(a, b, [](PartMask x, PartMask y) { return x & y; });
}
TUFTED_INLINE Mask logicalOr(Mask a, Mask b) {
  return forParts<Mask>(a, b, [](PartMask x, PartMask y) { return x | y; });
}
TUFTED_INLINE Mask none() {
  return {};
}
TUFTED_INLINE unsigned bitsOf(const Mask& mask) {
  unsigned bits = 0;
  for (int i = 0; i < parts; ++i) bits |= bitsOf(mask.of[i]) << i * part_size;
  return bits;
}
TUFTED_INLINE bool any(const Mask& mask) {
  PartMask some = mask.of[0];
  for (int i = 1; i < parts; ++i) some |= mask.of[i];
  return bitsOf(some) != 0;
}
TUFTED_INLINE Packet select(Mask mask, Packet a, Packet b) {
  Packet packet;
  for (int i = 0; i < parts; ++i) packet.of[i] = mask.of[i] ? a.of[i] : b.of[i];
  return packet;
}
TUFTED_INLINE Mask firstOf(int count) {
  Mask mask;
  for (int i = 0; i < packet_size; ++i) mask.of[i / part_size][i % part_size] = i < count ? -1 : 0;
  return mask;
}
TUFTED_INLINE Mask differ(const int* values, int value) {
  Mask mask;
  for (int i = 0; i < packet_size; ++i) mask.of[i / part_size][i % part_size] = values[i] != value ? -1 : 0;
  return mask;
}
TUFTED_INLINE int countOf(const Mask& mask) {
  return __builtin_popcount(bitsOf(mask));
}

template <class Value>
TUFTED_INLINE void compressEach(unsigned chosen, const Value* values, Value* to) {
  for (int i = 0; i < packet_size; ++i) {  // without a branch, which would be hard to predict
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
  constexpr int floats = 2 * part_size, float_parts = float_packet_size / floats;
  using FloatPart = float __attribute__((vector_size(floats * sizeof(float))));
  using Counts = int __attribute__((vector_size(floats * sizeof(float))));
  for (int l = 0; l < packets; ++l, rank += float_packet_size) {
    FloatPart mine[float_parts];
    Counts less[float_parts] = {};
    __builtin_memcpy(mine, some + l * float_packet_size, sizeof(mine));
    for (int j = 0; j < count; ++j) {
      FloatPart value;
      for (int i = 0; i < floats; ++i) value[i] = values[j];
      for (int i = 0; i < float_parts; ++i) less[i] -= value < mine[i];  // true is -1
    }
    __builtin_memcpy(rank, less, sizeof(less));
  }
}

}  // namespace
}  // namespace tufted
