#include "cloud/selection.h"

#include <bit>
#include <cstring>

#include "base/pair.h"

#if defined(__x86_64__) && defined(__GNUC__)
#include <immintrin.h>
#define TUFTED_AVX512 __attribute__((target("avx512f,avx512vl")))
#endif

namespace tufted {
namespace {

int takeWithinPortable(const Candidates& candidates, const double* point, int p, double bound, double* squared_distance,
                       int* index) {
  const double *x = candidates.x.data(), *y = candidates.y.data(), *z = candidates.z.data();
  const int* ranks = candidates.index.data();
  const auto count = candidates.index.size();
  int found = 0;
  for (std::size_t i = 0; i < count; i += 2) {
    const Pair dx = point[0] - loadPair(x + i), dy = point[1] - loadPair(y + i), dz = point[2] - loadPair(z + i);
    const Pair squares = dx * dx + dy * dy + dz * dz;
    for (int j = 0; j < 2; ++j) {  // without a branch: which are near cannot be foreseen
      squared_distance[found] = squares[j];
      index[found] = ranks[i + j];
      found += static_cast<int>(squares[j] <= bound) & static_cast<int>(ranks[i + j] != p);
    }
  }
  return found;
}

void rankValuesPortable(const double* values, int count, std::int64_t* rank) {
  constexpr int pairs = selection_lane / 2;
  for (int i = 0; i < count; i += selection_lane) {
    const Pair a = loadPair(values + i), b = loadPair(values + i + 2), c = loadPair(values + i + 4),
               d = loadPair(values + i + 6);
    PairCounts less[pairs] = {};
    for (int j = 0; j < count; ++j) {
      const Pair value = {values[j], values[j]};
      less[0] -= value < a;  // true is -1
      less[1] -= value < b;
      less[2] -= value < c;
      less[3] -= value < d;
    }
    std::memcpy(rank + i, less, sizeof(less));
  }
}

#ifdef TUFTED_AVX512
TUFTED_AVX512 int takeWithinAvx512(const Candidates& candidates, const double* point, int p, double bound,
                                   double* squared_distance, int* index) {
  const double *x = candidates.x.data(), *y = candidates.y.data(), *z = candidates.z.data();
  const __m512d px = _mm512_set1_pd(point[0]), py = _mm512_set1_pd(point[1]), pz = _mm512_set1_pd(point[2]);
  const __m512d limit = _mm512_set1_pd(bound);
  const __m256i self = _mm256_set1_epi32(p);
  int found = 0;
  for (std::size_t i = 0; i < candidates.index.size(); i += selection_lane) {
    const __m512d dx = px - _mm512_loadu_pd(x + i), dy = py - _mm512_loadu_pd(y + i), dz = pz - _mm512_loadu_pd(z + i);
    const __m512d squares = dx * dx + dy * dy + dz * dz;
    const __m256i ranks = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(candidates.index.data() + i));
    const auto taken =
        static_cast<__mmask8>(_mm512_cmp_pd_mask(squares, limit, _CMP_LE_OQ) & _mm256_cmpneq_epi32_mask(ranks, self));
    // Compressed in the register: compressing stores are slow on some processors.
    _mm512_storeu_pd(squared_distance + found, _mm512_maskz_compress_pd(taken, squares));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(index + found), _mm256_maskz_compress_epi32(taken, ranks));
    found += std::popcount(static_cast<unsigned>(taken));
  }
  return found;
}

TUFTED_AVX512 void rankValuesAvx512(const double* values, int count, std::int64_t* rank) {
  for (int i = 0; i < count; i += selection_lane) {
    const __m512d lane = _mm512_loadu_pd(values + i);
    __m512i less = _mm512_setzero_si512();
    const __m512i one = _mm512_set1_epi64(1);
    for (int j = 0; j < count; ++j)
      less = _mm512_mask_add_epi64(less, _mm512_cmp_pd_mask(_mm512_set1_pd(values[j]), lane, _CMP_LT_OQ), less, one);
    _mm512_storeu_si512(rank + i, less);
  }
}
#endif

}  // namespace

const SelectionKernels& portableKernels() {
  static constexpr SelectionKernels kernels{takeWithinPortable, rankValuesPortable};
  return kernels;
}

const SelectionKernels& fastestKernels() {
#ifdef TUFTED_AVX512
  static constexpr SelectionKernels wide{takeWithinAvx512, rankValuesAvx512};
  static const bool has_wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl");
  if (has_wide) return wide;
#endif
  return portableKernels();
}

}  // namespace tufted
