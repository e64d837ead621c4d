#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/buffer.h"
#include "base/parallel.h"
#include "cover/cover.h"
#include "cover/edge_lengths.h"
#include "cover/flip_edges.h"
#include "direct/flip_seeds.h"
#include "direct/radial_cycles.h"
#include "direct/star_metric.h"
#include "stars/agreement.h"

namespace tufted {

/// The tufted cover of a union of stars, with only those stars present as faces whose edges were flipped or looked at.
/// What is absent is as the stars say: the sides of a star that leave it are glued as soon as somebody asks.
///
/// Triangles are numbered as their stars are added, but within a range for each block of stars, so that threads can add
/// stars of different blocks.
class CoverNearFlips {
 public:
  static constexpr int block_size = 4096;  // stars

  /// All arguments are borrowed for the life of the cover.
  CoverNearFlips(const Stars& stars, const EdgeLengths& length, const RadialCycles& cycles);

  /// Algorithm 2.
  FlipCounts flipToDelaunay(const StarMetric& metric, const Workers& workers);

  /// The bytes of the faces that are present.
  std::size_t bytes() const;
  /// Gives the memory of all faces back but the moved ones, of how they are glued too. There is no bytes()
  /// and no complete() any more.
  void keepMovedFaces();
  /// Gives back what keepMovedFaces() left.
  void dropFaces();

  bool isPresent(int p) const { return first_[p] >= 0; }
  /// The first triangle of a star that is present; the others follow in the order of its link.
  int firstTriangle(int p) const { return first_[p]; }
  /// Whether the front or the back of triangle t was flipped.
  bool isMoved(int t) const { return moved_[t] != 0; }
  /// Calls visit(corners, lengths of sides) for front and back of each triangle that isMoved(), of one block of stars;
  /// the last has those that did not fit into theirs.
  template <class Visit>
  void forEachMovedFace(std::size_t block, const Visit& visit) const {
    if (faces_begin_.empty()) return;
    for (std::size_t f = faces_begin_[block]; f < faces_begin_[block + 1]; ++f)
      if (only_moved_ || moved_[f / 2] != 0) visit(cover_.faces[f], cover_.length.data() + 3 * f);
  }
  /// Whether a face at p was flipped.
  bool isFlipped(int p) const { return flipped_[p] != 0; }

  /// Appends front and back of each triangle of a star as flips have left them: corners by rank, and the lengths of the
  /// sides from each to the next, in the unit of the points.
  void appendFaces(int p, std::vector<std::array<int, 3>>& faces, std::vector<double>& length) const;

  /// The whole cover: vertices by rank, lengths in the unit of the points.
  IntrinsicTriangulation complete(const Workers& workers) const;

 private:
  friend class Flipping;
  /// Sets the ranges of the blocks.
  void reserve(const Buffer<Buffer<FlipSeed>>& seeds, const Workers& workers);
  void makeRoom(std::size_t triangles);
  /// Adds a star. Where it does not fit into the range of its block it goes behind all if that `may_grow`, else false.
  bool add(int p, bool may_grow);
  /// Whether the side is glued; if not it is, unless that takes a star of a block outside the range, or one that does
  /// not fit into the range of its block.
  bool resolve(int side, const SideRange& range);
  void findFlippedPoints();

  StarSide starSide(int side) const;
  /// The side whose minus copy the plus copy of this one is glued to, or the other way round. The plus copy runs from
  /// the smaller to the larger vertex.
  StarSide mateOf(const StarSide& side, bool is_plus) const;
  int sideNumber(const StarSide& side, bool is_front, const Buffer<int>& first) const;
  bool runsUp(const StarSide& side) const { return tail(stars_, side) < head(stars_, side); }
  /// Writes the star of p into the whole cover as the stars have it, then as flips have left it.
  /// @param first the first triangle of each star in the whole
  void fillStar(int p, const Buffer<int>& first, IntrinsicTriangulation& whole) const;
  void copyStar(int p, const Buffer<int>& first, const RawBuffer<int>& triangle, IntrinsicTriangulation& whole) const;

  const Stars& stars_;
  const EdgeLengths& length_;
  const RadialCycles& cycles_;
  CoverBuffer cover_;
  Buffer<int> first_;                ///< n, the first triangle of a star, -1 where absent
  Buffer<int> block_begin_;          ///< where the range of each block of stars begins, and the last one ends
  Buffer<int> next_;                 ///< the next number of each block
  Buffer<std::size_t> faces_begin_;  ///< those of the faces of each block, and the end of all; empty before flips
  RawBuffer<int> entry_of_;          ///< link entry of each triangle that is present
  RawBuffer<std::uint8_t> state_;    ///< of each side that is present, see flipEdges()
  Buffer<std::uint8_t> moved_;       ///< of each triangle
  Buffer<std::uint8_t> flipped_;     ///< n
  bool only_moved_ = false;          ///< faces, without numbers
};

}  // namespace tufted
