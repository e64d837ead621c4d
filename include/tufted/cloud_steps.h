#pragma once

// The single steps that a Preset chooses between. Most users set none of them: cloudOptions(preset) does.
namespace tufted {

/// When the k nearest neighbours of a point are doubled, up to 8 k, before a plane is fitted to them.
enum class Growth {
  line,    ///< when they lie on one line, as on one ring of a scanner
  uneven,  ///< when they lie on one line or 40 % of them within half the radius: rings close to lines, density steps
};

/// When a star is wrapped again from twice as many neighbours.
enum class StarSearch {
  once,      ///< once, when it is closed but a circumcircle leaves the ball that was searched
  thorough,  ///< again and again, up to twice the neighbourhood, when a closed star's circumcircle leaves the ball that
             ///< was searched; and up to two times when the star is open
};

/// Which triangles of the stars are dropped.
enum class Filter {
  radius,  ///< by their circumradius: slivers along a rim, bridges to outliers
  votes,   ///< by circumradius, more strictly where no other corner's star has the triangle
};

/// What M holds.
enum class Mass {
  cover,  ///< a third of the area of each face of the cover around the point
  /// The same, but where the surface ends at a point the mixed area (Meyer et al. 2003) in the point's own star: there
  /// neighbours' stars lack triangles, and the areas of the cover are too small.
  star,
};

/// What is done about clouds that are not exact samples of one surface. The defaults are those of Preset::scan. With
/// the caller's neighborhoods nothing is grown, split, moved or searched again and outliers stay. On rings outliers
/// stay, no sheets are split, no points moved, only lines are grown, and open stars are not searched again. In a depth
/// image nothing is grown, split or searched, whatever these say, and neither among rings that lie close together: see
/// ScanStructure.
struct CloudSteps {
  Growth growth = Growth::line;  ///< when neighbourhoods grow
  bool split_sheets = true;  ///< neighbours beyond a gap along the normal belong to another surface and are left out
  StarSearch star_search = StarSearch::thorough;  ///< when stars are wrapped again
  bool isolate_outliers = true;   ///< points that hover over a surface that does not reach to them lose their stars
  Filter filter = Filter::votes;  ///< which triangles are dropped
  /// Where the stars of a quadrilateral of points disagree about its diagonal, as on grids that lie on curved surfaces,
  /// they all take the one that is Delaunay in space.
  bool settle_diagonals = true;
  /// Where there is noise, points are moved onto the surface first, as by denoise(), and everything is built from
  /// there. In a depth image they are moved along their rays, and stars are those of the points as they were.
  bool denoise = true;
  Mass mass = Mass::star;  ///< what M holds
};

}  // namespace tufted
