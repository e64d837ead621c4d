#include "direct/flip_seeds.h"

#include <algorithm>
#include <cmath>

#include "cover/flip_edges.h"
#include "cover/geometry.h"
#include "stars/agreement.h"

namespace tufted {
namespace {

/// The cotangent of an angle whose squared sine exceeds this is accurate to 1e-11 by vectors; others are computed from
/// lengths.
constexpr double sure_squared_sine = 1e-4;

class SeedFinder {
 public:
  SeedFinder(const Stars& stars, const EdgeLengths& length, const RadialCycles& cycles, const StarMetric& metric)
      : stars_(stars), length_(length), cycles_(cycles), metric_(metric) {}

  /// Adds edges within the star of p, and their copies at neighbours that agree.
  template <class Add>
  void findAt(int p, const Add& add) const {
    for (int i = stars_.offset[p]; i < stars_.offset[p + 1]; ++i) {
      if (!(metric_.cotan_sum[i] < flip_below)) continue;
      const StarSide spoke{p, i, 0};
      add({spoke, true, true});
      // The copy of the edge in links of the neighbours, which is in no radial cycle.
      if (cycles_.isInCycle(spoke)) continue;
      const int x = stars_.link[before(stars_, p, i)], j = entryOf(stars_, x, p);
      const bool follows = stars_.link[stars_.after(x, j)] == stars_.link[i];
      add({{x, follows ? j : before(stars_, x, j), 1}, true, true});
    }
  }

  /// Adds edges in radial cycles whose smaller vertex is in [begin, end).
  template <class Add>
  void findInCycles(int begin, int end, const Add& add) const {
    cycles_.forEachCycle(begin, end, [&](const auto& cycle) {
      // The plus copy of each side is glued to the minus copy of the next.
      const double first = roughCotan(cycle[0].side);
      double here = first;
      for (std::size_t i = 0; i < cycle.size(); ++i) {
        const double next = i + 1 == cycle.size() ? first : roughCotan(cycle[i + 1].side);
        if (!(here + next > flip_below / 2)) add({cycle[i].side, true, false});
        here = next;
      }
    });
  }

 private:
  double cotanAt(const StarSide& side) const {
    const int a = tail(stars_, side), b = head(stars_, side), c = apex(stars_, side);
    return oppositeCotan(length_(a, b), length_(b, c), length_(c, a));
  }

  /// cotanAt() within 1e-11, with fewer square roots for most triangles.
  double roughCotan(const StarSide& side) const {
    const auto [ux, uy, uz] = length_.offset(tail(stars_, side), apex(stars_, side));
    const auto [vx, vy, vz] = length_.offset(head(stars_, side), apex(stars_, side));
    const double x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    const double sine = x * x + y * y + z * z;  // squared sine times both squared lengths
    const double longer = std::max(ux * ux + uy * uy + uz * uz, vx * vx + vy * vy + vz * vz);
    return sine > sure_squared_sine * longer * longer ? (ux * vx + uy * vy + uz * vz) / std::sqrt(sine) : cotanAt(side);
  }

  const Stars& stars_;
  const EdgeLengths& length_;
  const RadialCycles& cycles_;
  const StarMetric& metric_;
};

}  // namespace

Buffer<Buffer<FlipSeed>> findFlipSeeds(const Stars& stars, const EdgeLengths& length, const RadialCycles& cycles,
                                       const StarMetric& metric, std::int64_t block_size, const Workers& workers) {
  const SeedFinder finder(stars, length, cycles, metric);
  const std::int64_t blocks = (stars.size() + block_size - 1) / block_size;
  Buffer<Buffer<FlipSeed>> seeds(blocks), elsewhere(blocks);  // seeds at stars of the block, and at others
  workers.forBlocks("flips", stars.size(), block_size, [&](std::int64_t begin, std::int64_t end, int) {
    const std::size_t block = begin / block_size;
    const auto add = [&](const FlipSeed& seed) {
      const bool is_own = begin <= seed.side.star && seed.side.star < end;
      (is_own ? seeds : elsewhere)[block].push_back(seed);
    };
    for (int p = static_cast<int>(begin); p < end; ++p) finder.findAt(p, add);
    finder.findInCycles(static_cast<int>(begin), static_cast<int>(end), add);
  });
  for (const auto& part : elsewhere)
    for (const FlipSeed& seed : part) seeds[seed.side.star / block_size].push_back(seed);
  return seeds;
}

}  // namespace tufted
