#include <bit>
#include <cstdint>
#include <cstdio>

#include "tufted/io/results.h"

namespace {

/// The 64-bit hash FNV-1a (Fowler, Noll and Vo), fed with words instead of bytes.
class Hash {
 public:
  void add(std::uint64_t word) { state_ = (state_ ^ word) * prime; }
  /// Adds a number; 0 and -0 count as equal.
  void add(double value) { add(std::bit_cast<std::uint64_t>(value + 0.0)); }
  std::uint64_t value() const { return state_; }

 private:
  /// The prime of FNV-1a with 64 bits.
  static constexpr std::uint64_t prime = 0x100000001b3;
  std::uint64_t state_ = 0xcbf29ce484222325;
};

}  // namespace

std::string tufted::checksum(const Laplacian& laplacian) {
  Hash hash;
  for (int column = 0; column < laplacian.L.outerSize(); ++column) {
    hash.add(static_cast<std::uint64_t>(column));
    for (SparseMatrix::InnerIterator entry(laplacian.L, column); entry; ++entry) {
      hash.add(static_cast<std::uint64_t>(entry.row()));
      hash.add(entry.value());
    }
  }
  for (const double mass : laplacian.M) hash.add(mass);
  char text[17] = {};
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash.value()));
  return text;
}
