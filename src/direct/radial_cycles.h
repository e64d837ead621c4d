#pragma once

#include <cstdint>
#include <span>

#include "base/buffer.h"
#include "base/parallel.h"
#include "base/point_buffer.h"
#include "stars/stars.h"

namespace tufted {

/// A side of a triangle (p, a, b) of the star of p: 0 runs from p to a, 1 from a to b, 2 from b to p.
struct StarSide {
  int star;
  int entry;  ///< link entry of a
  int side;

  friend bool operator==(const StarSide&, const StarSide&) = default;
};

inline int tail(const Stars& stars, const StarSide& s) {
  return s.side == 0 ? s.star : stars.link[s.side == 1 ? s.entry : stars.after(s.star, s.entry)];
}
inline int head(const Stars& stars, const StarSide& s) {
  return s.side == 2 ? s.star : stars.link[s.side == 0 ? s.entry : stars.after(s.star, s.entry)];
}
/// The corner opposite the side.
inline int apex(const Stars& stars, const StarSide& s) {
  return s.side == 1 ? s.star : stars.link[s.side == 2 ? s.entry : stars.after(s.star, s.entry)];
}

/// The circular order of the triangles around each edge of the union of stars with Gluing::star and FaceOrder::angle,
/// as sides: those in links, and spokes where a star ends. All other spokes are glued within their star.
///
/// Only edges between two points that disagree need a cycle; all others have two triangles, which the link of an end
/// that agrees names.
class RadialCycles {
 public:
  /// @param stars borrowed
  /// @param disagreement see findDisagreement(); borrowed
  RadialCycles(const Stars& stars, const Buffer<std::uint8_t>& disagreement, const PointsView& points,
               const Workers& workers);

  bool disagrees(int p) const { return disagrees_[p] != 0; }

  /// The sides after and before this one around its edge; itself if it is the only one.
  StarSide next(const StarSide& side) const { return neighbor(side, 1); }
  StarSide previous(const StarSide& side) const { return neighbor(side, -1); }

  /// Frees the memory; ends the use of the object.
  void drop() {
    release(offset_);
    release(sides_);
  }

  /// Whether the side lies in a cycle.
  bool isInCycle(const StarSide& side) const { return disagrees(tail(stars_, side)) && disagrees(head(stars_, side)); }

  /// Calls visit(sides) for each cycle whose smaller vertex is in [begin, end).
  template <class Visit>
  void forEachCycle(int begin, int end, const Visit& visit) const {
    for (int i = offset_[begin]; i < offset_[end];) {
      const int stop = endOfCycle(i);
      visit(std::span<const CycleSide>(sides_).subspan(i, stop - i));
      i = stop;
    }
  }

  struct CycleSide {
    int high;  ///< the larger vertex
    StarSide side;
  };

 private:
  StarSide neighbor(const StarSide& side, int step) const;
  StarSide acrossAgreeing(const StarSide& side, int agreeing, int other) const;
  void collect(const Workers& workers);
  void sort(const PointsView& points, const Workers& workers);
  int endOfCycle(int i) const;

  const Stars& stars_;
  const Buffer<std::uint8_t>& disagrees_;
  Buffer<int> offset_;  ///< n + 1, by smaller vertex
  RawBuffer<CycleSide> sides_;
};

}  // namespace tufted
