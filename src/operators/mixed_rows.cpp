#include "operators/mixed_rows.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "cloud/agreement.h"
#include "intrinsic/fan_buffer.h"
#include "intrinsic/geometry.h"
#include "operators/face_areas.h"

namespace tufted {
namespace {

/// Faces come in two kinds: front and back of a triangle that no flip has touched have the same lengths and are read
/// off the stars of mixed points, twice; the others are in the cover.
class TermCollector {
 public:
  TermCollector(const GluedStars& glued, const Buffer<std::uint8_t>& mixed, double scale, RawBuffer<double>& mass,
                const Workers& workers)
      : stars_(glued.stars),
        length_(glued.length),
        cover_(glued.cover),
        mixed_(mixed),
        scale_(scale),
        mass_(mass),
        numbers_(numbersWhere("assemble", stars_.size(), workers, [this](int p) { return mixed_[p] != 0; })) {}

  Rows collect() {
    terms_.offset.assign(static_cast<std::size_t>(stars_.size()) + 1, 0);
    for (const int p : numbers_) {
      weighTriangles(p);
      forEachStarTerm(p, [this](int low, int, const auto&) { ++terms_.offset[low + 1]; });
    }
    cover_.forEachMovedFace([this](const auto& corners, const double*) {
      forEachFaceTerm(corners, [this](int low, int, int) { ++terms_.offset[low + 1]; });
    });
    std::partial_sum(terms_.offset.begin(), terms_.offset.end(), terms_.offset.begin());
    terms_.entries.resize(static_cast<std::size_t>(terms_.offset.back()));
    fill_.assign(terms_.offset.begin(), terms_.offset.end() - 1);
    FanBuffer buffer;
    forEachFan(stars_, length_, numbers_, buffer, [this](int p, const Fans& fans, int at) { takeStar(p, fans, at); });
    cover_.forEachMovedFace([this](const auto& corners, const double* side) { takeFace(corners, side); });
    return std::move(terms_);
  }

  std::int64_t degenerateFaces() const { return degenerate_faces_; }

 private:
  /// How often each triangle of star p counts, by entry: not where a flip has touched it, and three times in all where
  /// a corner is not mixed, whose agreement says that each of the three stars has a copy.
  void weighTriangles(int p) {
    constexpr std::array<double, 3> share = {3, 1.5, 1};  // among the mixed corners
    const int begin = stars_.offset[p], end = stars_.offset[p + 1];
    count_.resize(end - begin);
    int t = cover_.isPresent(p) ? cover_.firstTriangle(p) : -1;
    for (int i = begin; i < end; ++i) {
      const bool is_triangle = stars_.hasTriangle(i), is_whole = is_triangle && (t < 0 || !cover_.isMoved(t));
      count_[i - begin] = is_whole ? share[mixed_[stars_.link[i]] + mixed_[stars_.link[stars_.after(p, i)]]] : 0;
      if (t >= 0) t += is_triangle ? 1 : 0;
    }
  }

  /// Calls visit(low, high, cotans) for the spokes of star p and the sides in its link that are terms; cotans(fans, at)
  /// is the sum of what the triangles have opposite.
  template <class Visit>
  void forEachStarTerm(int p, const Visit& visit) const {
    const int begin = stars_.offset[p], count = stars_.offset[p + 1] - begin;
    for (int i = 0; i < count; ++i) {
      const int last = before(stars_, p, begin + i) - begin;
      const int q = stars_.link[begin + i], next = stars_.link[stars_.after(p, begin + i)];
      if (mixed_[q] == 0) continue;
      if (count_[i] + count_[last] > 0) {
        visit(std::min(p, q), std::max(p, q), [this, i, last](const Fans& fans, int at) {
          return count_[i] * finiteCotan(fans.cotan_at_next[at + i]) +
                 count_[last] * finiteCotan(fans.cotan_at_own[at + last]);
        });
      }
      if (mixed_[next] == 0 || count_[i] == 0) continue;
      visit(std::min(q, next), std::max(q, next), [i](const Fans& fans, int at) {
        const double numerator = cotanNumerator(fans.rim[at + i], fans.spoke[at + i], fans.spoke[at + i + 1]);
        return finiteCotan(numerator / (4 * fans.area[at + i]));
      });
    }
  }

  /// Calls visit(low, high, side) for those of the sides 0, 1 and 2 of a face that are terms.
  template <class Visit>
  void forEachFaceTerm(const std::array<int, 3>& corner, const Visit& visit) const {
    for (int s = 0; s < 3; ++s) {
      const int a = corner[s], b = corner[(s + 1) % 3];
      if (a != b && mixed_[a] != 0 && mixed_[b] != 0) visit(std::min(a, b), std::max(a, b), s);
    }
  }

  void put(int low, int high, double weight) { terms_.entries[fill_[low]++] = {high, weight}; }

  /// @param at the first triangle of star p in the fans
  void takeStar(int p, const Fans& fans, int at) {
    weighTriangles(p);
    const int begin = stars_.offset[p], count = stars_.offset[p + 1] - begin;
    for (int i = 0; i < count; ++i) {
      if (count_[i] == 0) continue;
      degenerate_faces_ += fans.area[at + i] > 0 ? 0 : 2;
      addArea({p, stars_.link[begin + i], stars_.link[stars_.after(p, begin + i)]}, 2 * count_[i] * fans.area[at + i]);
    }
    forEachStarTerm(p, [&](int low, int high, const auto& cotans) {
      put(low, high, scale_ * cotans(fans, at));  // 2 sheets, 1/2
    });
  }

  void takeFace(const std::array<int, 3>& corners, const double* side) {
    const double area = triangleArea(side[0], side[1], side[2]);
    degenerate_faces_ += area > 0 ? 0 : 1;
    addArea(corners, area);
    forEachFaceTerm(corners, [&](int low, int high, int s) {
      const double cotan = finiteCotan(cotanNumerator(side[s], side[(s + 1) % 3], side[(s + 2) % 3]) / (4 * area));
      put(low, high, scale_ * cotan / 2);
    });
  }

  void addArea(const std::array<int, 3>& corners, double area) {
    for (const int corner : corners) mass_[corner] += mixed_[corner] != 0 ? scale_ * area / 3 : 0;
  }

  const Stars& stars_;
  const EdgeLengths& length_;
  const PartialCover& cover_;
  const Buffer<std::uint8_t>& mixed_;
  const double scale_;
  RawBuffer<double>& mass_;
  const Buffer<int> numbers_;  ///< of the mixed points
  Buffer<double> count_;       ///< see weighTriangles()
  Rows terms_;
  Buffer<int> fill_;  ///< n, where the next term goes
  std::int64_t degenerate_faces_ = 0;
};

}  // namespace

Rows collectTerms(const GluedStars& glued, const Buffer<std::uint8_t>& mixed, double scale, RawBuffer<double>& mass,
                  const Workers& workers, Report& report) {
  TermCollector collector(glued, mixed, scale, mass, workers);
  Rows terms = collector.collect();
  report.degenerate_faces += collector.degenerateFaces();
  return terms;
}

Rows mergeTerms(Rows terms, const Workers& workers) {
  const int n = static_cast<int>(terms.offset.size()) - 1;
  const Buffer<int> edges = mergeRows(terms, workers);
  const auto forBoth = [&](const auto& visit) {
    for (int p = 0; p < n; ++p) {
      for (int i = terms.offset[p]; i < terms.offset[p] + edges[p]; ++i) {
        visit(p, terms.entries[i].column, terms.entries[i].weight);
        visit(terms.entries[i].column, p, terms.entries[i].weight);
      }
    }
  };
  Rows rows;
  rows.offset.assign(terms.offset.size(), 0);
  forBoth([&](int p, int, double) { ++rows.offset[p + 1]; });
  std::partial_sum(rows.offset.begin(), rows.offset.end(), rows.offset.begin());
  rows.entries.resize(static_cast<std::size_t>(rows.offset.back()));
  Buffer<int> fill(rows.offset.begin(), rows.offset.end() - 1);
  forBoth([&](int p, int q, double weight) { rows.entries[fill[p]++] = {q, weight}; });
  return rows;
}

}  // namespace tufted
