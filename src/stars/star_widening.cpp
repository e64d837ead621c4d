#include "stars/star_widening.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "stars/star_wrapping.h"

namespace tufted {
namespace {

bool names(const Stars& stars, int p, int q) {
  const auto link = stars.link.begin();
  return std::find(link + stars.offset[p], link + stars.offset[p + 1], q) != link + stars.offset[p + 1];
}

/// Replaces stars in one array with an entry per link entry.
/// @param offset, widened_offset of the stars in `array` and in `from`
template <class Array>
void splice(std::span<const Widening> wanted, const Buffer<int>& offset, const Buffer<int>& widened_offset,
            const Array& from, Array& array) {
  Array result;
  result.reserve(array.size() + from.size());
  auto next = array.begin();
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (widened_offset[i] == widened_offset[i + 1]) continue;
    const int p = wanted[i].p;
    result.insert(result.end(), next, array.begin() + offset[p]);
    result.insert(result.end(), from.begin() + widened_offset[i], from.begin() + widened_offset[i + 1]);
    next = array.begin() + offset[p + 1];
  }
  result.insert(result.end(), next, array.end());
  array.swap(result);
}

}  // namespace

Buffer<Widening> neededWidenings(const BuiltStars& built, const Buffer<Certainty>& certainty, Certainty by) {
  const auto& [stars, support] = built;
  Buffer<Widening> all;
  for (int q = 0; q < stars.size(); ++q) {
    if (certainty[q] != by) continue;
    for (int i = stars.offset[q], before = stars.offset[q + 1] - 1; i < stars.offset[q + 1]; before = i++) {
      const int p = stars.link[i];
      if (certainty[p] < Certainty::uncertain || support.isolated[p] != 0 || names(stars, p, q)) continue;
      all.push_back({p, 2 * std::max(support.radius[i], support.radius[before])});
    }
  }
  std::sort(all.begin(), all.end(),
            [](const Widening& a, const Widening& b) { return std::pair(a.p, -a.radius) < std::pair(b.p, -b.radius); });
  const auto isSame = [](const Widening& a, const Widening& b) { return a.p == b.p; };
  all.erase(std::unique(all.begin(), all.end(), isSame), all.end());
  return all;
}

void replaceStars(std::span<const Widening> wanted, const BuiltStars& widened, BuiltStars& built,
                  Buffer<Certainty>& certainty, Report& report) {
  if (widened.stars.link.empty()) return;
  auto& [stars, support] = built;
  const Buffer<int>& widened_offset = widened.stars.offset;
  splice(wanted, stars.offset, widened_offset, widened.support.radius, support.radius);
  splice(wanted, stars.offset, widened_offset, widened.stars.triangle, stars.triangle);
  splice(wanted, stars.offset, widened_offset, widened.stars.link, stars.link);
  std::adjacent_difference(stars.offset.begin(), stars.offset.end(), stars.offset.begin());  // sizes again
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const int p = wanted[i].p, size = widened_offset[i + 1] - widened_offset[i];
    if (size == 0) continue;
    if (std::exchange(certainty[p], Certainty::widened) == Certainty::open) {
      ++report.closed_stars;
      --report.open_stars;
    }
    stars.offset[p + 1] = size;
    stars.ends[p] = 0;
  }
  finishOffsets(stars);
}

}  // namespace tufted
