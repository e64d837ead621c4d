#pragma once

#include <array>
#include <cstdint>
#include <iterator>

#include "base/buffer.h"
#include "cover/edge_lengths.h"
#include "simd/kernels.h"
#include "stars/stars.h"

namespace tufted {

/// Owns the arrays of TriangleFans.
class TriangleFanBuffer {
 public:
  void clear() { fans_.count = 0; }
  int count() const { return fans_.count; }
  const TriangleFans& fans() const { return fans_; }

  /// Appends the triangles of star p, then its first spoke again, which starts a triangle that is not read.
  void add(const Stars& stars, const EdgeLengths& length, int p) {
    const int begin = stars.offset[p], end = stars.offset[p + 1];
    if (begin == end) return;
    reserve(fans_.count + end - begin + 1);
    int at = fans_.count;
    const auto put = [this, &at](const std::array<double, 3>& spoke, const std::array<double, 3>& rim) {
      for (int c = 0; c < 3; ++c) {
        given_[c][at] = spoke[c];
        given_[3 + c][at] = rim[c];
      }
      ++at;
    };
    const std::array<double, 3> first = length.offset(stars.link[begin], p);
    for (int i = begin; i < end; ++i) {
      const int q = stars.link[i], next = stars.link[stars.after(p, i)];
      put(length.offset(q, p), length.offset(next, q));
    }
    put(first, {});
    fans_.count = at;
  }

 private:
  void reserve(int count) {
    const auto room = static_cast<std::size_t>(toPackets(count)) + kernel_packet;
    if (given_[0].size() >= room) return;
    for (auto& values : given_) values.resize(2 * room);
    for (auto& values : found_) values.resize(2 * room);
    fans_ = {fans_.count,      given_[0].data(), given_[1].data(), given_[2].data(), given_[3].data(),
             given_[4].data(), given_[5].data(), found_[0].data(), found_[1].data(), found_[2].data(),
             found_[3].data(), found_[4].data(), found_[5].data()};
  }

  std::array<Buffer<double>, 6> given_, found_;
  TriangleFans fans_{};
};

/// The numbers [first, last); clang 14 cannot compile std::views::iota.
struct Numbers {
  std::int64_t first, last;

  std::int64_t size() const { return last - first; }
  int operator[](std::int64_t i) const { return static_cast<int>(first + i); }
};

/// Calls visit(p, fans, at) for each star p in `numbers`, with its triangles measured; the first is number `at`.
template <class Sequence, class Visit>
void forEachTriangleFan(const Stars& stars, const EdgeLengths& length, const Sequence& numbers,
                        TriangleFanBuffer& buffer, const Visit& visit) {
  constexpr int batch = 128;  // triangles measured at once, in the first-level cache
  const Kernels& kernel = kernels();
  const auto size = std::ssize(numbers);
  for (std::int64_t i = 0; i < size;) {
    const auto first = i;
    buffer.clear();
    for (; i < size && buffer.count() < batch; ++i) buffer.add(stars, length, numbers[i]);
    if (buffer.count() > 0) kernel.measureTriangleFans(buffer.fans());
    int at = 0;
    for (auto j = first; j < i; ++j) {
      const int p = numbers[j];
      visit(p, buffer.fans(), at);
      const int spokes = stars.offset[p + 1] - stars.offset[p];
      at += spokes > 0 ? spokes + 1 : 0;
    }
  }
}

}  // namespace tufted
