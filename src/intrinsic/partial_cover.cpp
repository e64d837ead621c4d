#include "intrinsic/partial_cover.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/buffer.h"
#include "intrinsic/flip_edges.h"
#include "intrinsic/geometry.h"

namespace tufted {
namespace {

constexpr std::int64_t block_size = 8192;

/// Triangles of star p before link entry i.
int trianglesBefore(const Stars& stars, int p, int i) {
  int count = 0;
  for (int j = stars.offset[p]; j < i; ++j) count += stars.hasTriangle(j) ? 1 : 0;
  return count;
}

/// Calls glue(before, after) for each spoke of star p between two triangles, numbered from `first` on.
template <class Glue>
void forEachSpoke(const Stars& stars, int p, int first, const Glue& glue) {
  int t = first, previous = -1, at_begin = -1;
  for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i) {
    if (!stars.hasTriangle(i)) {
      previous = -1;
      continue;
    }
    if (i == stars.offset[p]) at_begin = t;
    if (previous >= 0) glue(previous, t);
    previous = t++;
  }
  if (previous >= 0 && at_begin >= 0) glue(previous, at_begin);
}

/// Triangle (p, a, v) ends on the spoke v p with side 2, triangle (p, v, b) begins on it with side 0.
template <class Triangulation>
void glueSpoke(Triangulation& cover, int before, int after) {
  glueSides(cover, frontSide(before, 2), frontSide(after, 0));
  glueSides(cover, backSide(before, 2), backSide(after, 0));
}

/// @param side_length of the sides 0, 1 and 2 of the front
template <class Triangulation>
void setLengths(Triangulation& cover, int t, const std::array<double, 3>& side_length) {
  for (int s = 0; s < 3; ++s) cover.length[frontSide(t, s)] = cover.length[backSide(t, s)] = side_length[s];
}

}  // namespace

/// What flipEdges() works on.
class Flipping {
 public:
  explicit Flipping(PartialCover& cover) : cover_(cover) {}
  CoverBuffer& triangulation() { return cover_.cover_; }
  void resolve(int side) { cover_.resolve(side); }
  void flipped(int side, int mate) {
    for (const int face : {side / 3, mate / 3}) {
      cover_.moved_[face / 2] = 1;
      for (const int corner : cover_.cover_.faces[face]) cover_.flipped_[corner] = 1;
    }
  }

 private:
  PartialCover& cover_;
};

PartialCover::PartialCover(const Stars& stars, const EdgeLengths& length, const StarPools& pools)
    : stars_(stars),
      length_(length),
      pools_(pools),
      first_(static_cast<std::size_t>(stars.size()), -1),
      flipped_(static_cast<std::size_t>(stars.size())) {
  cover_.vertices = stars.size();
}

void PartialCover::add(int p) {
  const int first = static_cast<int>(entry_of_.size());
  first_[p] = first;
  for (int i = stars_.offset[p]; i < stars_.offset[p + 1]; ++i)
    if (stars_.hasTriangle(i)) entry_of_.push_back(i);
  const auto triangles = entry_of_.size();
  moved_.resize(triangles);
  cover_.faces.resize(2 * triangles);
  cover_.glue.resize(6 * triangles, unglued);
  cover_.length.resize(6 * triangles);
  int measured = -1;  // link entry of a spoke, and its length
  double spoke = 0;
  for (int t = first; t < static_cast<int>(triangles); ++t) {
    const int i = entry_of_[t], next = stars_.after(p, i), a = stars_.link[i], b = stars_.link[next];
    const double from_p = measured == i ? spoke : length_(p, a);
    spoke = length_(b, p);
    measured = next;
    addTriangle(cover_, t, p, a, b);
    setLengths(cover_, t, {from_p, length_(a, b), spoke});
  }
  forEachSpoke(stars_, p, first, [&](int before, int after) { glueSpoke(cover_, before, after); });
}

StarSide PartialCover::starSide(int side) const {
  const int t = side / 6, s = side % 6;
  // A side that is not glued yet has not moved, nor has its face been flipped: its first corner is the star's centre.
  return {cover_.faces[side / 3][0], entry_of_[t], s < 3 ? s : 5 - s};
}

StarSide PartialCover::mateOf(const StarSide& side, bool is_plus) const {
  return is_plus ? pools_.next(side) : pools_.previous(side);
}

int PartialCover::sideNumber(const StarSide& side, bool is_front, const Buffer<int>& first) const {
  const int t = first[side.star] + trianglesBefore(stars_, side.star, side.entry);
  return is_front ? frontSide(t, side.side) : backSide(t, side.side);
}

void PartialCover::resolve(int side) {
  if (cover_.glue[side] != unglued) return;
  const StarSide here = starSide(side);
  // The plus copy is the front where the front runs up.
  const bool is_plus = runsUp(here) == (side % 6 < 3);
  const StarSide there = mateOf(here, is_plus);
  if (!isPresent(there.star)) add(there.star);
  glueSides(cover_, side, sideNumber(there, runsUp(there) != is_plus, first_));
}

double PartialCover::cotanAt(const StarSide& side) const {
  const int a = tail(stars_, side), b = head(stars_, side), c = apex(stars_, side);
  return oppositeCotan(length_(a, b), length_(b, c), length_(c, a));
}

double PartialCover::roughCotan(const StarSide& side) const {
  if (length_.added > 0) return cotanAt(side);
  const auto [ux, uy, uz] = length_.offset(tail(stars_, side), apex(stars_, side));
  const auto [vx, vy, vz] = length_.offset(head(stars_, side), apex(stars_, side));
  const double x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
  const double sine = x * x + y * y + z * z;  // times both lengths, squared
  const double longer = std::max(ux * ux + uy * uy + uz * uz, vx * vx + vy * vy + vz * vz);
  return sine > 1e-8 * longer * longer ? (ux * vx + uy * vy + uz * vz) / std::sqrt(sine) : cotanAt(side);
}

Buffer<int> PartialCover::findSeeds(const StarMetric& metric, const Workers& workers) {
  struct Seed {
    StarSide side;
    bool is_plus, is_minus;
  };
  Buffer<Buffer<Seed>> found((stars_.size() + block_size - 1) / block_size);
  workers.forBlocks("flips", stars_.size(), block_size, [&](std::int64_t begin, std::int64_t end, int) {
    Buffer<Seed>& seeds = found[begin / block_size];
    for (int p = static_cast<int>(begin); p < end; ++p) {
      for (int i = stars_.offset[p]; i < stars_.offset[p + 1]; ++i) {
        if (!(metric.cotan_sum[i] < flip_below)) continue;
        const StarSide spoke{p, i, 0};
        seeds.push_back({spoke, true, true});
        // The copy between the links of the two neighbours, which is in no pool.
        if (pools_.isPooled(spoke)) continue;
        const int x = stars_.link[before(stars_, p, i)], j = entryOf(stars_, x, p);
        const bool follows = stars_.link[stars_.after(x, j)] == stars_.link[i];
        seeds.push_back({{x, follows ? j : before(stars_, x, j), 1}, true, true});
      }
    }
    pools_.forEachPool(static_cast<int>(begin), static_cast<int>(end), [&](const auto& pool) {
      // The plus copy of each faces the minus copy of the next.
      const double first = roughCotan(pool[0].side);
      double here = first;
      for (std::size_t i = 0; i < pool.size(); ++i) {
        const StarSide &side = pool[i].side, &facing = pool[i + 1 == pool.size() ? 0 : i + 1].side;
        const double next = i + 1 == pool.size() ? first : roughCotan(facing);
        if (!(here + next > flip_below / 2) && cotanAt(side) + cotanAt(facing) < flip_below)
          seeds.push_back({side, true, false});
        here = next;
      }
    });
  });
  Buffer<int> sides;
  for (const auto& part : found) {
    for (const Seed& seed : part) {
      if (!isPresent(seed.side.star)) add(seed.side.star);
      const bool up = runsUp(seed.side);
      if (seed.is_plus) sides.push_back(sideNumber(seed.side, up, first_));
      if (seed.is_minus) sides.push_back(sideNumber(seed.side, !up, first_));
    }
  }
  return sides;
}

void PartialCover::reserve() {
  // Flips stay near the points that disagree, and what is reserved but not used costs no memory. Growing by doubling
  // would.
  std::int64_t triangles = 0;
  for (int p = 0; p < stars_.size(); ++p)
    if (stars_.disagrees[p] != 0) triangles += stars_.offset[p + 1] - stars_.offset[p];
  triangles = std::min(stars_.triangles(), 2 * triangles);
  entry_of_.reserve(static_cast<std::size_t>(triangles));
  moved_.reserve(static_cast<std::size_t>(triangles));
  cover_.faces.reserve(static_cast<std::size_t>(2 * triangles));
  cover_.glue.reserve(static_cast<std::size_t>(6 * triangles));
  cover_.length.reserve(static_cast<std::size_t>(6 * triangles));
}

FlipCounts PartialCover::flipToDelaunay(const StarMetric& metric, const Workers& workers) {
  reserve();
  const Buffer<int> seeds = findSeeds(metric, workers);
  Flipping flipping(*this);
  return flipEdges(flipping, seeds, workers);
}

void PartialCover::keepMovedFaces() {
  release(cover_.glue);
  std::size_t kept = 0;
  for (std::size_t f = 0; f < cover_.faces.size(); ++f) {
    if (moved_[f / 2] == 0) continue;
    cover_.faces[kept] = cover_.faces[f];
    std::copy_n(cover_.length.begin() + 3 * f, 3, cover_.length.begin() + 3 * kept++);
  }
  cover_.faces.resize(kept);
  cover_.faces.shrink_to_fit();
  cover_.length.resize(3 * kept);
  cover_.length.shrink_to_fit();
  only_moved_ = true;
}

void PartialCover::dropFaces() {
  release(cover_.faces);
  release(cover_.length);
}

void PartialCover::fillStar(int p, const Buffer<int>& first, IntrinsicTriangulation& whole) const {
  int t = first[p];
  for (int i = stars_.offset[p]; i < stars_.offset[p + 1]; ++i) {
    if (!stars_.hasTriangle(i)) continue;
    addTriangle(whole, t, p, stars_.link[i], stars_.link[stars_.after(p, i)]);
    const auto& [a, b, c] = whole.faces[2 * t];
    setLengths(whole, t, {length_(a, b), length_(b, c), length_(c, a)});
    for (int s = 0; s < 3; ++s) {
      const StarSide side{p, i, s};
      const int neighbor = s == 0 ? before(stars_, p, i) : stars_.after(p, i);
      if (s != 1 && stars_.hasTriangle(neighbor)) continue;  // a spoke between two triangles
      for (const bool is_front : {true, false}) {
        const bool is_plus = runsUp(side) == is_front;
        const StarSide mate = mateOf(side, is_plus);
        whole.glue[is_front ? frontSide(t, s) : backSide(t, s)] = sideNumber(mate, runsUp(mate) != is_plus, first);
      }
    }
    ++t;
  }
  forEachSpoke(stars_, p, first[p], [&](int before, int after) { glueSpoke(whole, before, after); });
}

void PartialCover::copyStar(int p, const Buffer<int>& first, const Buffer<int>& triangle,
                            IntrinsicTriangulation& whole) const {
  const int from = 6 * first_[p], to = 6 * first[p];
  for (int s = 0; s < 6 * (first[p + 1] - first[p]); ++s) {
    whole.length[to + s] = cover_.length[from + s];
    if (s % 3 == 0) whole.faces[(to + s) / 3] = cover_.faces[(from + s) / 3];
    // What is not glued here has not moved and is glued as fillStar() said.
    const int mate = cover_.glue[from + s];
    if (mate != unglued) whole.glue[to + s] = 6 * triangle[mate / 6] + mate % 6;
  }
}

IntrinsicTriangulation PartialCover::complete(const Workers& workers) const {
  const int n = stars_.size();
  Buffer<int> first(static_cast<std::size_t>(n) + 1);  // triangle of each star
  for (int p = 0; p < n; ++p) first[p + 1] = first[p] + trianglesBefore(stars_, p, stars_.offset[p + 1]);
  Buffer<int> triangle(entry_of_.size());  // number in the whole of each that is present
  for (int p = 0; p < n; ++p) {
    if (isPresent(p))
      std::iota(triangle.begin() + first_[p], triangle.begin() + first_[p] + first[p + 1] - first[p], first[p]);
  }
  IntrinsicTriangulation whole;
  resizeCover(whole, n, first[n]);
  workers.forBlocks("cover", n, block_size, [&](std::int64_t begin, std::int64_t end, int) {
    for (int p = static_cast<int>(begin); p < end; ++p) {
      fillStar(p, first, whole);
      if (isPresent(p)) copyStar(p, first, triangle, whole);
    }
  });
  return whole;
}

}  // namespace tufted
