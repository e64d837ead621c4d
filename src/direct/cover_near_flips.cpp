// Algorithm 2 of the paper on stars; cover/flips.cpp is the reference.
#include "direct/cover_near_flips.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "base/buffer.h"
#include "cover/flip_edges.h"
#include "direct/flip_seeds.h"
#include "direct/star_triangles.h"

namespace tufted {
namespace {

/// Triangles for which there is room besides those expected: one per this many.
constexpr std::size_t spare = 8;

/// Calls visit(i, a, b, {|pa|, |ab|, |bp|}) for each triangle (p, a, b); i is the link entry of a.
template <class Visit>
void forEachTriangle(const Stars& stars, const EdgeLengths& length, int p, const Visit& visit) {
  int measured = -1;  // link entry of the last measured spoke, and its length
  double spoke = 0;
  for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i) {
    if (!stars.hasTriangle(i)) continue;
    const int next = stars.after(p, i), a = stars.link[i], b = stars.link[next];
    const double from_p = measured == i ? spoke : length(p, a);
    spoke = length(b, p);
    measured = next;
    visit(i, a, b, std::array{from_p, length(a, b), spoke});
  }
}

/// @param side_length lengths of the sides 0, 1 and 2 of the front
template <class Triangulation>
void setLengths(Triangulation& cover, int t, const std::array<double, 3>& side_length) {
  for (int s = 0; s < 3; ++s) cover.length[frontSide(t, s)] = cover.length[backSide(t, s)] = side_length[s];
}

}  // namespace

/// A CoverNearFlips as flipEdges() takes it.
class Flipping {
 public:
  Flipping(CoverNearFlips& cover, Buffer<Buffer<FlipSeed>> seeds) : cover_(cover), seeds_(std::move(seeds)) {}

  CoverBuffer& triangulation() { return cover_.cover_; }
  std::int64_t blocks() const { return std::ssize(seeds_); }
  SideRange sidesOf(std::int64_t first, std::int64_t last) const {
    return {6 * cover_.block_begin_[first], 6 * cover_.block_begin_[last]};
  }
  template <class Push>
  void start(std::int64_t block, const Push& push) {
    for (const FlipSeed& seed : seeds_[block])
      if (!cover_.isPresent(seed.side.star)) cover_.add(seed.side.star, false);  // before others take their room
    for (const FlipSeed& seed : seeds_[block]) {
      const bool up = cover_.runsUp(seed.side);
      if (seed.is_plus) push(cover_.sideNumber(seed.side, up, cover_.first_));
      if (seed.is_minus) push(cover_.sideNumber(seed.side, !up, cover_.first_));
    }
    release(seeds_[block]);
  }
  bool resolve(int side, const SideRange& range) { return cover_.resolve(side, range); }
  std::uint8_t& state(int side) { return cover_.state_[side]; }
  void flipped(int side, int mate) { cover_.moved_[side / 6] = cover_.moved_[mate / 6] = 1; }

 private:
  CoverNearFlips& cover_;
  Buffer<Buffer<FlipSeed>> seeds_;
};

CoverNearFlips::CoverNearFlips(const Stars& stars, const EdgeLengths& length, const RadialCycles& cycles)
    : stars_(stars),
      length_(length),
      cycles_(cycles),
      first_(static_cast<std::size_t>(stars.size()), -1),
      flipped_(static_cast<std::size_t>(stars.size())) {
  cover_.vertices = stars.size();
}

void CoverNearFlips::makeRoom(std::size_t triangles) {
  entry_of_.resize(triangles);
  state_.resize(6 * triangles);
  moved_.resize(triangles);
  cover_.faces.resize(2 * triangles);
  cover_.glue.resize(6 * triangles);
  cover_.length.resize(6 * triangles);
}

bool CoverNearFlips::add(int p, bool may_grow) {
  const int block = p / block_size, count = triangleCount(stars_, p);
  if (next_[block] + count <= block_begin_[block + 1]) {
    first_[p] = std::exchange(next_[block], next_[block] + count);
  } else {
    if (!may_grow) return false;
    first_[p] = static_cast<int>(entry_of_.size());
    makeRoom(entry_of_.size() + count);
  }
  int t = first_[p];
  forEachTriangle(stars_, length_, p, [&](int i, int a, int b, const std::array<double, 3>& side_length) {
    entry_of_[t] = i;
    addTriangle(cover_, t, p, a, b);
    setLengths(cover_, t, side_length);
    std::fill_n(cover_.glue.begin() + 6 * t, 6, unglued);
    std::fill_n(state_.begin() + 6 * t, 6, std::uint8_t{0});
    ++t;
  });
  glueSpokes(stars_, p, first_[p], cover_);
  return true;
}

StarSide CoverNearFlips::starSide(int side) const {
  const int t = side / 6, s = side % 6;
  // A side that is not glued yet is where it was, and its face was not flipped: its first corner is the star's centre.
  return {cover_.faces[side / 3][0], entry_of_[t], s < 3 ? s : 5 - s};
}

StarSide CoverNearFlips::mateOf(const StarSide& side, bool is_plus) const {
  return is_plus ? cycles_.next(side) : cycles_.previous(side);
}

int CoverNearFlips::sideNumber(const StarSide& side, bool is_front, const Buffer<int>& first) const {
  const int t = first[side.star] + trianglesBefore(stars_, side.star, side.entry);
  return is_front ? frontSide(t, side.side) : backSide(t, side.side);
}

bool CoverNearFlips::resolve(int side, const SideRange& range) {
  if (cover_.glue[side] != unglued) return true;
  const StarSide here = starSide(side);
  // The plus copy is the front if the front runs from the smaller to the larger vertex.
  const bool is_plus = runsUp(here) == (side % 6 < 3);
  const StarSide there = mateOf(here, is_plus);
  if (!range.contains(6 * block_begin_[there.star / block_size])) return false;
  if (!isPresent(there.star) && !add(there.star, range.isWhole())) return false;
  glueSides(cover_, side, sideNumber(there, runsUp(there) != is_plus, first_));
  return true;
}

void CoverNearFlips::reserve(const Buffer<Buffer<FlipSeed>>& seeds, const Workers& workers) {
  // Flips stay near points that disagree. Unused room costs next to no memory; growing would.
  block_begin_.assign(seeds.size() + 1, 0);
  workers.forBlocks("flips", stars_.size(), block_size, [&](std::int64_t begin, std::int64_t end, int) {
    const auto degree = [this](std::int64_t p) { return std::int64_t{stars_.offset[p + 1]} - stars_.offset[p]; };
    std::int64_t room = 1;  // at least 1, so that blocks have different ranges
    for (const FlipSeed& seed : seeds[begin / block_size]) room += degree(seed.side.star);
    for (std::int64_t p = begin; p < end; ++p) room += cycles_.disagrees(static_cast<int>(p)) ? 2 * degree(p) : 0;
    const std::int64_t all = std::int64_t{stars_.offset[end]} - stars_.offset[begin] + 1;
    block_begin_[begin / block_size + 1] = static_cast<int>(std::min(room, all));
  });
  std::partial_sum(block_begin_.begin(), block_begin_.end(), block_begin_.begin());
  next_.assign(block_begin_.begin(), block_begin_.end() - 1);
  const std::size_t triangles = block_begin_.back(), others = stars_.link.size() + next_.size() - triangles;
  makeRoom(triangles + std::min(others, triangles / spare));
  makeRoom(triangles);
}

void CoverNearFlips::findFlippedPoints() {
  for (int p = 0; p < stars_.size(); ++p) {
    if (!isPresent(p)) continue;
    int t = first_[p];
    for (int i = stars_.offset[p]; i < stars_.offset[p + 1]; ++i) {
      if (!stars_.hasTriangle(i) || !isMoved(t++)) continue;
      // All corners that a flipped face ever had are corners of flipped triangles.
      flipped_[p] = flipped_[stars_.link[i]] = flipped_[stars_.link[stars_.after(p, i)]] = 1;
    }
  }
}

FlipCounts CoverNearFlips::flipToDelaunay(const StarMetric& metric, const Workers& workers) {
  Buffer<Buffer<FlipSeed>> seeds = findFlipSeeds(stars_, length_, cycles_, metric, block_size, workers);
  if (std::all_of(seeds.begin(), seeds.end(), [](const auto& part) { return part.empty(); })) return {};
  reserve(seeds, workers);
  Flipping flipping(*this, std::move(seeds));
  const FlipCounts counts = flipEdges(flipping, workers);
  findFlippedPoints();
  for (const int begin : block_begin_) faces_begin_.push_back(2 * static_cast<std::size_t>(begin));
  faces_begin_.back() = cover_.faces.size();
  return counts;
}

std::size_t CoverNearFlips::bytes() const {
  constexpr std::size_t of_triangle = 2 * sizeof(cover_.faces[0]) + 6 * sizeof(cover_.glue[0]) +
                                      6 * sizeof(cover_.length[0]) + sizeof(entry_of_[0]) + 6 * sizeof(state_[0]);
  if (next_.empty()) return 0;
  std::size_t triangles = entry_of_.size() - block_begin_.back();  // those behind the ranges
  for (std::size_t b = 0; b < next_.size(); ++b) triangles += next_[b] - block_begin_[b];
  return of_triangle * triangles;
}

void CoverNearFlips::keepMovedFaces() {
  release(cover_.glue);
  release(state_);
  release(entry_of_);
  std::size_t kept = 0, f = 0;
  for (std::size_t& end : faces_begin_) {
    for (; f < end; ++f) {
      if (moved_[f / 2] == 0) continue;
      cover_.faces[kept] = cover_.faces[f];
      std::copy_n(cover_.length.begin() + 3 * f, 3, cover_.length.begin() + 3 * kept++);
    }
    end = kept;
  }
  cover_.faces.resize(kept);
  cover_.length.resize(3 * kept);
  only_moved_ = true;
  if (Workspace::current() != nullptr) return;  // the workspace keeps the memory anyway
  cover_.faces.shrink_to_fit();
  cover_.length.shrink_to_fit();
}

void CoverNearFlips::dropFaces() {
  release(cover_.faces);
  release(cover_.length);
}

void CoverNearFlips::fillStar(int p, const Buffer<int>& first, IntrinsicTriangulation& whole) const {
  int t = first[p];
  forEachTriangle(stars_, length_, p, [&](int i, int a, int b, const std::array<double, 3>& side_length) {
    addTriangle(whole, t, p, a, b);
    setLengths(whole, t, side_length);
    for (int s = 0; s < 3; ++s) {
      const StarSide side{p, i, s};
      const int neighbor = s == 0 ? before(stars_, p, i) : stars_.after(p, i);
      if (s != 1 && stars_.hasTriangle(neighbor)) continue;  // glued by glueSpokes()
      const bool is_up = runsUp(side);
      const StarSide at_front = mateOf(side, is_up);
      const StarSide at_back = cycles_.isInCycle(side) ? mateOf(side, !is_up) : at_front;  // an edge of two triangles
      whole.glue[frontSide(t, s)] = sideNumber(at_front, runsUp(at_front) != is_up, first);
      whole.glue[backSide(t, s)] = sideNumber(at_back, runsUp(at_back) == is_up, first);
    }
    ++t;
  });
  glueSpokes(stars_, p, first[p], whole);
}

void CoverNearFlips::copyStar(int p, const Buffer<int>& first, const RawBuffer<int>& triangle,
                              IntrinsicTriangulation& whole) const {
  const int from = 6 * first_[p], to = 6 * first[p];
  for (int s = 0; s < 6 * (first[p + 1] - first[p]); ++s) {
    whole.length[to + s] = cover_.length[from + s];
    if (s % 3 == 0) whole.faces[(to + s) / 3] = cover_.faces[(from + s) / 3];
    // Sides that are not glued here did not change and are glued by fillStar().
    const int mate = cover_.glue[from + s];
    if (mate != unglued) whole.glue[to + s] = 6 * triangle[mate / 6] + mate % 6;
  }
}

void CoverNearFlips::appendFaces(int p, std::vector<std::array<int, 3>>& faces, std::vector<double>& length) const {
  if (isPresent(p)) {
    const std::size_t first = 2 * static_cast<std::size_t>(first_[p]);
    for (std::size_t f = first; f < first + 2 * static_cast<std::size_t>(triangleCount(stars_, p)); ++f) {
      faces.push_back(cover_.faces[f]);
      length.insert(length.end(), cover_.length.begin() + 3 * f, cover_.length.begin() + 3 * f + 3);
    }
    return;
  }
  forEachTriangle(stars_, length_, p, [&](int, int a, int b, const std::array<double, 3>& side_length) {
    faces.push_back({p, a, b});
    faces.push_back({p, b, a});
    length.insert(length.end(), side_length.begin(), side_length.end());
    length.insert(length.end(), side_length.rbegin(), side_length.rend());
  });
}

IntrinsicTriangulation CoverNearFlips::complete(const Workers& workers) const {
  const int n = stars_.size();
  const Buffer<int> first = firstTriangles(stars_);
  RawBuffer<int> triangle(entry_of_.size());  // of each present triangle, its number in `whole`
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
