#pragma once

// The steps of a cloud's build that a Preset chooses. Most users call cloudOptions(preset) instead of setting them.
namespace tufted {

/// When the k nearest neighbours of a point are doubled, up to 8 k, before a plane is fitted to them.
enum class Growth {
  line,    ///< when they lie on one line, as on one ring of a scanner
  uneven,  ///< when they lie on one line, or more than 40 % of them within half the radius, as where rings look like
           ///< lines or density changes abruptly
};

/// When a star is computed again from more neighbours.
enum class StarSearch {
  once,      ///< once, from twice as many, if it is closed but a circumcircle leaves the ball that was searched
  thorough,  ///< until all circumcircles of a closed star lie in the ball that was searched, from up to twice as many;
             ///< an open star up to two times, in case it closes; both from more where other stars show the need
};

/// Which triangles of the stars are dropped, by their circumradius compared with the neighbourhoods of their corners.
enum class Filter {
  radius,  ///< slivers along a rim and bridges to outliers
  votes,   ///< triangles far larger than their neighbourhood, and large ones that no other corner's star has
};

/// Which area is the mass of a point in M.
enum class Mass {
  cover,  ///< the areas of the faces of the cover around the point, a third each, with the scale of L
  /// Where the surface ends at a point, the mixed area (Meyer et al. 2003) in the point's own star, otherwise as
  /// `cover`. Where the surface ends the stars of neighbours lack triangles, so areas of the cover are too small.
  star,
};

/// Steps for clouds that are not exact samples of one surface. The defaults are those of Preset::scan. Some have no
/// effect on some input: with the caller's neighborhoods nothing is grown, split, moved or searched again, and outliers
/// stay. On the rings of a scanner outliers stay, sheets are not split, points not moved, only lines grow, and open
/// stars are not searched again. In a depth image, and with rings that lie close together (see ScanStructure),
/// `growth`, `split_sheets`, `star_search` and `isolate_outliers` have no effect.
struct CloudSteps {
  Growth growth = Growth::line;  ///< when neighbourhoods grow
  bool split_sheets = true;      ///< whether neighbours beyond a gap along the normal, on other sheets, are left out
  StarSearch star_search = StarSearch::thorough;  ///< when a star is computed again from more neighbours
  bool isolate_outliers = true;  ///< whether points that hover over a surface which does not reach them lose their star
  Filter filter = Filter::votes;  ///< which triangles are dropped
  /// Whether the four stars of a quadrilateral that disagree about its diagonal, as on grids on curved surfaces, all
  /// take the diagonal that is Delaunay in space.
  bool settle_diagonals = true;
  /// Whether noisy points are first moved onto the surface, as by denoise(), and everything is built from there. In a
  /// depth image points move along their rays, and stars are those of the points as given.
  bool denoise = true;
  Mass mass = Mass::star;  ///< which area is the mass of a point
};

}  // namespace tufted
