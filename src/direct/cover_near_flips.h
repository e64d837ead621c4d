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

/// The tufted cover of a union of stars, of which only stars near flips are present as faces; all others are as the
/// stars have them. Sides that leave a present star are glued when they are first needed.
///
/// Triangles are numbered in the order in which stars are added, within a range for each block of stars, so that
/// threads can add stars of different blocks.
class CoverNearFlips {
 public:
  static constexpr int block_size = 4096;  // stars per block

  /// All arguments are borrowed for the life of the cover.
  CoverNearFlips(const Stars& stars, const EdgeLengths& length, const RadialCycles& cycles);

  /// Algorithm 2 (section 11 of docs/algorithm.md).
  FlipCounts flipToDelaunay(const StarMetric& metric, const Workers& workers);

  /// The bytes of the faces that are present.
  std::size_t bytes() const;
  /// Frees the memory of all faces that were not flipped, and of gluing. Ends the use of bytes() and complete().
  void keepMovedFaces();
  /// Frees the remaining faces.
  void dropFaces();

  bool isPresent(int p) const { return first_[p] >= 0; }
  /// The first triangle of a present star; the others follow in the order of its link.
  int firstTriangle(int p) const { return first_[p]; }
  /// Whether the front or the back of triangle t was flipped.
  bool isMoved(int t) const { return moved_[t] != 0; }
  /// Calls visit(corners, lengths of sides) for front and back of each triangle with isMoved() in the range of a block;
  /// the last block also has the triangles behind all ranges.
  template <class Visit>
  void forEachMovedFace(std::size_t block, const Visit& visit) const {
    if (faces_begin_.empty()) return;
    for (std::size_t f = faces_begin_[block]; f < faces_begin_[block + 1]; ++f)
      if (only_moved_ || moved_[f / 2] != 0) visit(cover_.faces[f], cover_.length.data() + 3 * f);
  }
  /// Whether a face at p was flipped.
  bool isFlipped(int p) const { return flipped_[p] != 0; }

  /// Appends front and back of each triangle of a star, as flips have left them: corners by rank, and lengths of sides
  /// in the unit of the points.
  void appendFaces(int p, std::vector<std::array<int, 3>>& faces, std::vector<double>& length) const;

  /// The whole cover: vertices by rank, lengths in the unit of the points.
  IntrinsicTriangulation complete(const Workers& workers) const;

 private:
  friend class Flipping;
  /// Sets the ranges of triangles of the blocks.
  void reserve(const Buffer<Buffer<FlipSeed>>& seeds, const Workers& workers);
  void makeRoom(std::size_t triangles);
  /// Adds a star in the range of its block. If it does not fit, appends it behind all ranges if `may_grow`, else
  /// returns false.
  bool add(int p, bool may_grow);
  /// Glues the side if it is not glued yet. Returns false if that needs a star of a block outside of `range`, or one
  /// that does not fit into the range of its block.
  bool resolve(int side, const SideRange& range);
  void findFlippedPoints();

  StarSide starSide(int side) const;
  /// The side whose minus copy is glued to the plus copy of `side`, or, without `is_plus`, the reverse. The plus copy
  /// runs from the smaller to the larger vertex.
  StarSide mateOf(const StarSide& side, bool is_plus) const;
  int sideNumber(const StarSide& side, bool is_front, const Buffer<int>& first) const;
  bool runsUp(const StarSide& side) const { return tail(stars_, side) < head(stars_, side); }
  /// Writes the star of p into the whole cover as the stars have it; copyStar() as flips have left it.
  /// @param first first triangle of each star in `whole`
  void fillStar(int p, const Buffer<int>& first, IntrinsicTriangulation& whole) const;
  void copyStar(int p, const Buffer<int>& first, const RawBuffer<int>& triangle, IntrinsicTriangulation& whole) const;

  const Stars& stars_;
  const EdgeLengths& length_;
  const RadialCycles& cycles_;
  CoverBuffer cover_;
  Buffer<int> first_;                ///< n, first triangle of each star; -1: absent
  Buffer<int> block_begin_;          ///< start of the range of each block of stars, and the end
  Buffer<int> next_;                 ///< next free triangle of each block
  Buffer<std::size_t> faces_begin_;  ///< starts of the faces of each block, and the end; empty before flips
  RawBuffer<int> entry_of_;          ///< link entry of each triangle that is present
  RawBuffer<std::uint8_t> state_;    ///< by side, see flipEdges()
  Buffer<std::uint8_t> moved_;       ///< by triangle, see isMoved()
  Buffer<std::uint8_t> flipped_;     ///< n
  bool only_moved_ = false;          ///< after keepMovedFaces(): only flipped faces are left
};

}  // namespace tufted
