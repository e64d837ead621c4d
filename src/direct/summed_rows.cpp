#include "direct/summed_rows.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "cover/face_areas.h"
#include "cover/geometry.h"
#include "direct/block_exchange.h"
#include "direct/triangle_fans.h"
#include "stars/agreement.h"

namespace tufted {
namespace {

constexpr int block_size = CoverNearFlips::block_size;

/// A part of the weight of an edge, or of the mass of a point if `low` equals `high`.
struct Term {
  int low, high;
  double value;
};

std::size_t blockOf(int p) {
  return static_cast<std::size_t>(p / block_size);
}

struct SumScratch {
  Buffer<int> fill;
  RawBuffer<Entry> entries;
  Buffer<Entry> sorted;
};

/// Sorts terms of edges by their ends and sums those of each edge, in the given order.
/// @param begin first point of the block; every `low` is in the block
void sumTerms(Buffer<Term>& terms, int begin, SumScratch& scratch) {
  Buffer<int>& fill = scratch.fill;
  fill.assign(block_size + 1, 0);
  for (const Term& term : terms) ++fill[term.low - begin + 1];
  std::partial_sum(fill.begin(), fill.end(), fill.begin());
  scratch.entries.resize(terms.size());
  for (const Term& term : terms) scratch.entries[fill[term.low - begin]++] = {term.high, term.value};
  terms.clear();
  Entry* first = scratch.entries.data();
  for (int i = 0; i < block_size; ++i) {  // fill[i] is now the end of row i
    Entry* const last = scratch.entries.data() + fill[i];
    const Entry* const end = mergeColumns(first, last, scratch.sorted);
    for (; first != end; ++first) terms.push_back({begin + i, first->column, first->weight});
    first = last;
  }
}

/// Memory of one worker.
struct RowWorker {
  Buffer<int> numbers;   ///< the mixed points of a block
  Buffer<double> count;  ///< weight of each triangle of a star, by entry
  TriangleFanBuffer fans;
  Buffer<Term> own, others;
  Buffer<int> fill;
  SumScratch sums;
  std::int64_t degenerate_faces = 0;
};

/// Collects the terms of one block of points.
///
/// Front and back of a triangle that no flip has touched have equal lengths and are read off the stars of mixed points;
/// all other faces are in the cover.
class TermReader {
 public:
  /// @param mass by rank; masses of the block's points are added to
  TermReader(const GluedStars& glued, const Buffer<std::uint8_t>& mixed, double scale, std::size_t block,
             RawBuffer<double>& mass, RowWorker& state)
      : stars_(glued.stars),
        length_(glued.length),
        cover_(glued.cover),
        mixed_(mixed),
        scale_(scale),
        block_(block),
        mass_(mass),
        state_(state) {}

  /// Collects the terms of edges and masses of the block in `own` and of other blocks in `others`.
  void read() {
    state_.own.clear();
    state_.others.clear();
    state_.numbers.clear();
    const int begin = static_cast<int>(block_) * block_size, end = std::min(begin + block_size, stars_.size());
    for (int p = begin; p < end; ++p)
      if (mixed_[p] != 0) state_.numbers.push_back(p);
    forEachTriangleFan(stars_, length_, state_.numbers, state_.fans,
                       [this](int p, const TriangleFans& fans, int at) { takeStar(p, fans, at); });
    cover_.forEachMovedFace(block_, [this](const auto& corners, const double* side) { takeFace(corners, side); });
  }

 private:
  /// Sets the weight of each triangle of the star: 0 if a flip has touched it, else 3 over the number of mixed corners,
  /// because each of three corners has a copy but only the stars of mixed points are read.
  void weighTriangles(int p) {
    const int begin = stars_.offset[p], end = stars_.offset[p + 1];
    state_.count.resize(end - begin);
    int t = cover_.isPresent(p) ? cover_.firstTriangle(p) : -1;
    for (int i = begin; i < end; ++i) {
      const bool is_triangle = stars_.hasTriangle(i), is_whole = is_triangle && (t < 0 || !cover_.isMoved(t));
      const int mixed_corners = 1 + mixed_[stars_.link[i]] + mixed_[stars_.link[stars_.after(p, i)]];
      state_.count[i - begin] = is_whole ? 3.0 / mixed_corners : 0;
      if (t >= 0) t += is_triangle ? 1 : 0;
    }
  }

  /// @param at the first triangle of star p in the fans
  void takeStar(int p, const TriangleFans& fans, int at) {
    weighTriangles(p);
    const Buffer<double>& counts = state_.count;
    const int begin = stars_.offset[p], count = stars_.offset[p + 1] - begin;
    for (int i = 0; i < count; ++i) {
      const int last = before(stars_, p, begin + i) - begin;
      const int q = stars_.link[begin + i], next = stars_.link[stars_.after(p, begin + i)];
      if (counts[i] > 0) {
        state_.degenerate_faces += fans.area[at + i] > 0 ? 0 : 2;
        addArea({p, q, next}, 2 * counts[i] * fans.area[at + i]);
      }
      if (mixed_[q] == 0) continue;
      if (counts[i] + counts[last] > 0) {
        put(p, q,
            counts[i] * finiteCotan(fans.cotan_at_next[at + i]) +
                counts[last] * finiteCotan(fans.cotan_at_own[at + last]));
      }
      if (mixed_[next] == 0 || counts[i] == 0) continue;
      const double numerator = cotanNumerator(fans.rim[at + i], fans.spoke[at + i], fans.spoke[at + i + 1]);
      put(q, next, finiteCotan(numerator / (4 * fans.area[at + i])));
    }
  }

  void takeFace(const std::array<int, 3>& corners, const double* side) {
    const double area = triangleArea(side[0], side[1], side[2]);
    state_.degenerate_faces += area > 0 ? 0 : 1;
    addArea(corners, area);
    for (int s = 0; s < 3; ++s) {
      const int a = corners[s], b = corners[(s + 1) % 3];
      if (a == b || mixed_[a] == 0 || mixed_[b] == 0) continue;
      put(a, b, finiteCotan(cotanNumerator(side[s], side[(s + 1) % 3], side[(s + 2) % 3]) / (4 * area)) / 2);
    }
  }

  /// @param cotans sum over front and back, halved (Section 3.3)
  void put(int a, int b, double cotans) {
    const Term term{std::min(a, b), std::max(a, b), scale_ * cotans};
    (blockOf(term.low) == block_ ? state_.own : state_.others).push_back(term);
  }

  void addArea(const std::array<int, 3>& corners, double area) {
    for (const int corner : corners) {
      if (mixed_[corner] == 0) continue;
      if (blockOf(corner) == block_)
        mass_[corner] += scale_ * area / 3;
      else
        state_.others.push_back({corner, corner, scale_ * area / 3});
    }
  }

  const Stars& stars_;
  const EdgeLengths& length_;
  const CoverNearFlips& cover_;
  const Buffer<std::uint8_t>& mixed_;
  const double scale_;
  const std::size_t block_;
  RawBuffer<double>& mass_;
  RowWorker& state_;
};

/// Stores edges at both ends.
/// @param edges by block, at the smaller end
/// @param reversed edges to points of other blocks
Rows fileEdges(int n, const Buffer<Buffer<Term>>& edges, const BlockExchange<Term>& reversed, const Workers& workers) {
  const auto forEachEntry = [&](std::size_t block, const auto& visit) {
    for (const Term& edge : edges[block]) {
      visit(edge.low, edge.high, edge.value);
      if (blockOf(edge.high) == block) visit(edge.high, edge.low, edge.value);
    }
    reversed.receive(block, [&](const Term& edge) { visit(edge.high, edge.low, edge.value); });
  };
  Rows rows;
  rows.offset.assign(static_cast<std::size_t>(n) + 1, 0);
  workers.forBlocks("assemble", std::ssize(edges), 1, [&](std::int64_t block, std::int64_t, int) {
    forEachEntry(block, [&](int p, int, double) { ++rows.offset[p + 1]; });
  });
  std::partial_sum(rows.offset.begin(), rows.offset.end(), rows.offset.begin());
  rows.entries.resize(static_cast<std::size_t>(rows.offset.back()));
  Buffer<int> fill(rows.offset.begin(), rows.offset.end() - 1);
  workers.forBlocks("assemble", std::ssize(edges), 1, [&](std::int64_t block, std::int64_t, int) {
    forEachEntry(block, [&](int p, int q, double weight) { rows.entries[fill[p]++] = {q, weight}; });
  });
  return rows;
}

}  // namespace

Rows summedRows(const GluedStars& glued, const Buffer<std::uint8_t>& mixed, bool keep_cover, double scale,
                RawBuffer<double>& mass, const Workers& workers, Report& report) {
  const int n = glued.stars.size();
  const std::size_t blocks = blockOf(n + block_size - 1);
  Buffer<RowWorker> states(workers.count());
  Buffer<Buffer<Term>> edges(blocks);  // each at its smaller end
  BlockExchange<Term> terms(blocks), reversed(blocks);

  workers.forBlocks("assemble", std::ssize(edges), 1, [&](std::int64_t block, std::int64_t, int worker) {
    RowWorker& state = states[worker];
    TermReader(glued, mixed, scale, block, mass, state).read();
    sumTerms(state.own, static_cast<int>(block) * block_size, state.sums);
    edges[block].assign(state.own.begin(), state.own.end());
    terms.send(
        block, state.others, [](const Term& term) { return blockOf(term.low); }, state.fill);
  });
  terms.deliver();
  if (!keep_cover) glued.cover.dropFaces();

  workers.forBlocks("assemble", std::ssize(edges), 1, [&](std::int64_t block, std::int64_t, int worker) {
    RowWorker& state = states[worker];
    state.own.assign(edges[block].begin(), edges[block].end());
    terms.receive(block, [&](const Term& term) {
      if (term.low == term.high)
        mass[term.low] += term.value;
      else
        state.own.push_back(term);
    });
    sumTerms(state.own, static_cast<int>(block) * block_size, state.sums);
    edges[block].assign(state.own.begin(), state.own.end());
    state.others.clear();
    for (const Term& edge : state.own)
      if (blockOf(edge.high) != static_cast<std::size_t>(block)) state.others.push_back(edge);
    reversed.send(
        block, state.others, [](const Term& edge) { return blockOf(edge.high); }, state.fill);
  });
  reversed.deliver();

  for (const RowWorker& state : states) report.degenerate_faces += state.degenerate_faces;
  return fileEdges(n, edges, reversed, workers);
}

}  // namespace tufted
