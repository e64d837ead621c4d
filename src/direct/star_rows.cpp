// Algorithm 3 of the paper, lines 6 to 15, on stars; cover/assemble.cpp is the reference.
#include "direct/star_rows.h"

#include "base/buffer.h"
#include "cover/matrix_columns.h"
#include "direct/summed_rows.h"

namespace tufted {
namespace {

class StarRows {
 public:
  StarRows(const GluedStars& glued, bool keep_cover, double scale, const Workers& workers, Report& report)
      : stars_(glued.stars),
        metric_(glued.metric),
        scale_(scale),
        mixed_(glued.disagrees),
        mass_(static_cast<std::size_t>(stars_.size())) {
    workers.forBlocks("assemble", stars_.size(), cheap_block, [&](std::int64_t begin, std::int64_t end, int) {
      for (int p = static_cast<int>(begin); p < end; ++p) {
        mixed_[p] |= metric_.is_flat[p] | static_cast<std::uint8_t>(glued.cover.isFlipped(p));
        mass_[p] = mixed_[p] == 0 ? 2 * scale_ * metric_.area[p] : 0;  // 2 faces x 3 stars x 1/3 of the area
      }
    });
    summed_rows_ = summedRows(glued, mixed_, keep_cover, scale_, mass_, workers, report);
  }

  int size() const { return stars_.size(); }
  double mass(int p) const { return mass_[p]; }

  /// At least the number of edges of p.
  int mostInRow(int p) const {
    const int own = stars_.offset[p + 1] - stars_.offset[p];
    return mixed_[p] == 0 ? own : own + summed_rows_.offset[p + 1] - summed_rows_.offset[p];
  }

  /// Calls visit(q, weight) for every edge of p. If neither end is mixed both stars have the same two triangles there,
  /// and the weight has the same bits from either.
  template <class Visit>
  void forEachInRow(int p, const Visit& visit) const {
    const bool is_mixed = mixed_[p] != 0;
    for (int i = stars_.offset[p]; i < stars_.offset[p + 1]; ++i) {
      const int q = stars_.link[i];
      if (!is_mixed) {
        visit(q, spokeWeight(i));
      } else if (mixed_[q] == 0) {
        visit(q, spokeWeight(entryOf(stars_, q, p)));
      }
    }
    if (!is_mixed) return;
    for (int i = summed_rows_.offset[p]; i < summed_rows_.offset[p + 1]; ++i)
      visit(summed_rows_.entries[i].column, summed_rows_.entries[i].weight);
  }

 private:
  /// The weight of the spoke to link vertex i of a star that is not mixed.
  double spokeWeight(int i) const { return 3 * scale_ * metric_.cotan_sum[i]; }  // 2 faces x 3 stars x 1/2

  const Stars& stars_;
  const StarMetric& metric_;
  const double scale_;
  Buffer<std::uint8_t> mixed_;  ///< n, 1 for mixed points; edges between these are summed over faces
  RawBuffer<double> mass_;
  Rows summed_rows_;  ///< edges between mixed points, at both ends
};

}  // namespace

void assembleStars(const GluedStars& glued, bool keep_cover, const Buffer<int>& input_index, int size, double scale,
                   const Workers& workers, Laplacian& result) {
  const StarRows rows(glued, keep_cover, scale, workers, result.report);
  MatrixColumns(rows, input_index, workers, result).write(size, "pointCloudLaplacian");
}

}  // namespace tufted
