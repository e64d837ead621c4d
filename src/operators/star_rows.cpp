#include "operators/star_rows.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "base/buffer.h"
#include "base/disjoint_sets.h"
#include "intrinsic/geometry.h"
#include "operators/column.h"
#include "operators/face_areas.h"
#include "operators/rows.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

constexpr std::int64_t block_size = 8192;

class StarAssembler {
 public:
  StarAssembler(const GluedStars& glued, Buffer<double> side_length, double scale, const Workers& workers)
      : stars_(glued.stars),
        metric_(glued.metric),
        cover_(glued.cover),
        length_(glued.length),
        scale_(scale),
        workers_(workers),
        side_cotan_(std::move(side_length)) {}

  /// Points whose edges among each other are summed over faces.
  void setMixed() {
    mixed_ = stars_.disagrees;
    workers_.forBlocks("assemble", stars_.size(), block_size, [&](std::int64_t begin, std::int64_t end, int) {
      for (int p = static_cast<int>(begin); p < end; ++p)
        mixed_[p] |= metric_.is_flat[p] | static_cast<std::uint8_t>(cover_.isFlipped(p));
    });
    absent_ = numbersWhere("assemble", stars_.size(), workers_, [this](int p) {
      if (cover_.isPresent(p)) return false;
      return mixed_[p] != 0 ||
             std::any_of(stars_.link.begin() + stars_.offset[p], stars_.link.begin() + stars_.offset[p + 1],
                         [this](int q) { return mixed_[q] != 0; });
    });
  }

  /// The weights of edges between mixed points. Forgets the cotangents.
  void weighFaces() {
    Rows terms = collectTerms();
    release(side_cotan_);
    const Buffer<int> edges = mergeTerms(terms);
    const auto forBoth = [&](const auto& visit) {
      for (int p = 0; p < stars_.size(); ++p) {
        for (int i = terms.offset[p]; i < terms.offset[p] + edges[p]; ++i) {
          visit(p, terms.entries[i].column, terms.entries[i].weight);
          visit(terms.entries[i].column, p, terms.entries[i].weight);
        }
      }
    };
    mixed_rows_.offset.assign(terms.offset.size(), 0);
    forBoth([&](int p, int, double) { ++mixed_rows_.offset[p + 1]; });
    std::partial_sum(mixed_rows_.offset.begin(), mixed_rows_.offset.end(), mixed_rows_.offset.begin());
    mixed_rows_.entries.resize(static_cast<std::size_t>(mixed_rows_.offset.back()));
    Buffer<int> fill(mixed_rows_.offset.begin(), mixed_rows_.offset.end() - 1);
    forBoth([&](int p, int q, double weight) { mixed_rows_.entries[fill[p]++] = {q, weight}; });
  }

  /// No fewer than the edges of p.
  int mostInRow(int p) const {
    const int own = stars_.offset[p + 1] - stars_.offset[p];
    return mixed_[p] == 0 ? own : own + mixed_rows_.offset[p + 1] - mixed_rows_.offset[p];
  }

  /// Calls visit(q, weight) for every edge of p. Where both ends are unmixed, their stars have the same two triangles
  /// there, and the weight has the same bits from either.
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
    for (int i = mixed_rows_.offset[p]; i < mixed_rows_.offset[p + 1]; ++i)
      visit(mixed_rows_.entries[i].column, mixed_rows_.entries[i].weight);
  }

  /// The sum of all weights of p, the negative ones too.
  double diagonal(int p) const {
    double sum = 0;
    forEachInRow(p, [&sum](int, double weight) { sum += weight; });
    return sum;
  }

  /// A third of each face's area to each corner (Section 3.3), by rank. Finds the cotangents for weighFaces() too.
  RawBuffer<double> lumpAreas(Report& report) {
    const RawBuffer<double> face_area = toCotans(side_cotan_, workers_);
    RawBuffer<double> mass(static_cast<std::size_t>(stars_.size()));
    workers_.forBlocks("assemble", stars_.size(), block_size, [&](std::int64_t begin, std::int64_t end, int) {
      for (int p = static_cast<int>(begin); p < end; ++p)
        mass[p] = mixed_[p] == 0 ? 2 * scale_ * metric_.area[p] : 0;  // 2 sheets, 3 stars, a third
    });
    const auto add = [&](int p, double share) {
      if (mixed_[p] != 0) mass[p] += share;
    };
    forEachAbsentTriangle([&](int p, int a, int b) {
      const double area = triangleArea(length_(p, a), length_(p, b), length_(a, b));
      report.degenerate_faces += area > 0 ? 0 : 2;
      for (const int corner : {p, a, b}) add(corner, 2 * scale_ * area / 3);
    });
    const CoverBuffer& faces = cover_.faces();
    for (int f = 0; f < static_cast<int>(faces.size()); ++f) {
      const double area = face_area[f];
      report.degenerate_faces += area > 0 ? 0 : 1;
      for (const int corner : faces.faces[f]) add(corner, scale_ * area / 3);
    }
    return mass;
  }

 private:
  /// Visits the triangles that have a mixed corner, in stars that are absent from the cover.
  template <class Visit>
  void forEachAbsentTriangle(const Visit& visit) const {
    for (const int p : absent_) {
      for (int i = stars_.offset[p]; i < stars_.offset[p + 1]; ++i) {
        if (!stars_.hasTriangle(i)) continue;
        const int a = stars_.link[i], b = stars_.link[stars_.after(p, i)];
        if ((mixed_[p] | mixed_[a] | mixed_[b]) != 0) visit(p, a, b);
      }
    }
  }

  /// Calls visit(low, high, weight) for each copy of an edge between mixed points, in the order of the faces; weight()
  /// is what it adds to the edge's.
  template <class Visit>
  void forEachTerm(const Visit& visit) const {
    const auto term = [&](int a, int b, const auto& cotans) {
      if (a != b && mixed_[a] != 0 && mixed_[b] != 0)
        visit(std::min(a, b), std::max(a, b), [&] { return scale_ * cotans() / 2; });
    };
    forEachAbsentTriangle([&](int p, int a, int b) {
      if (mixed_[p] + mixed_[a] + mixed_[b] < 2) return;
      const auto onBothSheets = [&](int from, int to, int opposite) {
        return 2 * finiteCotan(oppositeCotan(length_(from, to), length_(to, opposite), length_(opposite, from)));
      };
      term(p, a, [&] { return onBothSheets(p, a, b); });
      term(p, b, [&] { return onBothSheets(b, p, a); });
      term(a, b, [&] { return onBothSheets(a, b, p); });
    });
    const CoverBuffer& faces = cover_.faces();
    for (int side = 0; side < static_cast<int>(3 * faces.size()); ++side) {
      const int mate = faces.glue[side];
      if (mate != unglued && mate < side) continue;
      term(tail(faces, side), head(faces, side),
           [&] { return side_cotan_[side] + (mate == unglued ? 0 : side_cotan_[mate]); });
    }
  }

  /// All terms, filed under the smaller vertex.
  Rows collectTerms() const {
    Rows terms;
    terms.offset.assign(static_cast<std::size_t>(stars_.size()) + 1, 0);
    forEachTerm([&](int low, int, const auto&) { ++terms.offset[low + 1]; });
    std::partial_sum(terms.offset.begin(), terms.offset.end(), terms.offset.begin());
    terms.entries.resize(static_cast<std::size_t>(terms.offset.back()));
    Buffer<int> fill(terms.offset.begin(), terms.offset.end() - 1);
    forEachTerm([&](int low, int high, const auto& weight) { terms.entries[fill[low]++] = {high, weight()}; });
    return terms;
  }

  /// Sums the terms of each edge, in their order, to the front of the row. Returns the number of edges in each.
  Buffer<int> mergeTerms(Rows& terms) const {
    Buffer<int> edges(static_cast<std::size_t>(stars_.size()));
    workers_.forBlocks("assemble", stars_.size(), block_size, [&](std::int64_t begin, std::int64_t end, int) {
      Buffer<Entry> scratch;
      for (int p = static_cast<int>(begin); p < end; ++p) {
        Entry* const first = terms.entries.data() + terms.offset[p];
        Entry* const last = terms.entries.data() + terms.offset[p + 1];
        edges[p] = static_cast<int>(mergeColumns(first, last, scratch) - first);
      }
    });
    return edges;
  }

  /// Of the spoke to link vertex i of an unmixed star.
  double spokeWeight(int i) const { return 3 * scale_ * metric_.cotan_sum[i]; }  // 2 sheets, 3 stars, 1/2

  const Stars& stars_;
  const StarMetric& metric_;
  const PartialCover& cover_;
  const EdgeLengths& length_;
  const double scale_;
  const Workers& workers_;
  Buffer<std::uint8_t> mixed_;
  Buffer<int> absent_;         ///< stars that are absent from the cover, of mixed points and next to them
  Buffer<double> side_cotan_;  ///< of the angles opposite the sides of the cover, first their lengths
  Rows mixed_rows_;            ///< edges between mixed points, from both ends
};

constexpr int ahead = 16;  // columns

/// What is counted in one block of rows.
struct RowBlock {
  std::int64_t clamped_small = 0, clamped_large = 0;
  double largest_clamped = 0;
  std::int64_t components = 0;                 ///< of the edges within the block
  Buffer<std::pair<int, int>> edges_to_other;  ///< to points of earlier blocks
};

}  // namespace

void assembleStars(const GluedStars& glued, Buffer<double> side_length, const Buffer<int>& caller, int size,
                   double scale, const Workers& workers, Laplacian& result) {
  Report& report = result.report;
  const int n = glued.stars.size();
  StarAssembler assembler(glued, std::move(side_length), scale, workers);
  assembler.setMixed();
  const RawBuffer<double> mass = assembler.lumpAreas(report);
  assembler.weighFaces();

  // Columns of L in the caller's numbering: their sizes, then what is in them.
  Buffer<int> count(static_cast<std::size_t>(size));
  Buffer<RowBlock> blocks((n + block_size - 1) / block_size);
  workers.forBlocks("assemble", n, block_size, [&](std::int64_t begin, std::int64_t end, int) {
    for (int p = static_cast<int>(begin); p < end; ++p) {
      int positive = 0;
      assembler.forEachInRow(p, [&](int, double weight) { positive += weight > 0 ? 1 : 0; });
      count[caller[p]] = positive > 0 ? positive + 1 : 0;
    }
  });
  const std::int64_t entries = std::accumulate(count.begin(), count.end(), std::int64_t{0});
  if (entries > INT32_MAX) {
    throw InvalidInput("assembleStars: " + std::to_string(entries) + " entries of L, must be at most " +
                       std::to_string(INT32_MAX) + ", what an int can number");
  }
  SparseMatrix& L = result.L;
  L.resize(size, size);
  resizeEntries(L, entries);
  L.outerIndexPtr()[0] = 0;
  std::partial_sum(count.begin(), count.end(), L.outerIndexPtr() + 1);
  release(count);
  result.M.setZero(size);
  DisjointSets sets(n);  // those of one block are united by one thread
  workers.forBlocks("assemble", n, block_size, [&](std::int64_t begin, std::int64_t end, int) {
    RowBlock& block = blocks[begin / block_size];
    Column column;
    for (int p = static_cast<int>(begin); p < end; ++p) {
      if (p + 2 * ahead < n) prefetchColumns(L, caller[p + 2 * ahead], caller[p + ahead]);
      column.start(assembler.mostInRow(p) + 1);
      double sum = 0;
      assembler.forEachInRow(p, [&](int q, double weight) {
        if (weight > 0) {
          sum += weight;
          column.add(caller[q], -weight);
          if (q >= begin && q < p)
            block.components -= sets.unite(p, q) ? 1 : 0;
          else if (q < begin)
            block.edges_to_other.emplace_back(p, q);
        } else if (weight < 0 && p < q) {
          // Negative weights within 1e-9 of the larger diagonal are rounding; all are left out.
          const double larger = std::max(assembler.diagonal(p), assembler.diagonal(q));
          const double relative = larger > 0 ? -weight / larger : INFINITY;
          ++(relative <= weight_rounding ? block.clamped_small : block.clamped_large);
          block.largest_clamped = std::max(block.largest_clamped, relative);
        }
      });
      if (column.isEmpty()) continue;  // no row, no mass: the point takes no part
      ++block.components;
      result.M[caller[p]] = mass[p];
      column.add(caller[p], sum);
      const int place = L.outerIndexPtr()[caller[p]];
      column.sortInto(L.innerIndexPtr() + place, L.valuePtr() + place);
    }
  });

  for (const RowBlock& block : blocks) {
    report.clamped_weights += block.clamped_small;
    report.clamped_large += block.clamped_large;
    report.largest_clamped = std::max(report.largest_clamped, block.largest_clamped);
    report.components += block.components;
    for (const auto& [p, q] : block.edges_to_other) report.components -= sets.unite(p, q) ? 1 : 0;
  }
  report.nonzeros = entries;
}

}  // namespace tufted
