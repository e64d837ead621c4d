#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <queue>
#include <unordered_map>
#include <vector>

#include "algorithms/line_windows.h"
#include "algorithms/place_in_cover.h"
#include "tufted/intrinsic_triangulation.h"

namespace tufted {

/// A triangle as seen from the corner that is nearest to a point inside it.
struct Wedge {
  /// Two vertices match the triangle if they lie where its lengths place them, up to this part of the longer side; the
  /// best match is taken. Mollification moves them by far less.
  static constexpr double same_triangle = 1e-2;

  int corner;                    ///< the corner nearest to the point
  std::array<int, 2> others;     ///< the other corners, the farther one first
  std::array<double, 2> length;  ///< of the sides to `others`, in `unit`
  std::array<double, 2> weight;  ///< barycentric weights of the point at `others`
  double angle;                  ///< between these sides, radians
  double unit;                   ///< a power of two near the longer side
  double on_line;                ///< a vertex no farther from a line than this, in `unit`, counts as on it

  /// @param source with three different corners
  /// @param on_line in parts of the longer side
  static Wedge of(const SurfacePoint& source, double on_line);
};

/// One fan of faces around a vertex of a cover, and the surface beyond as far as a triangle reaches (docs/algorithm.md,
/// section 18). Directions are angles from the first side, growing to the left.
///
/// Straight lines are followed through the faces in windows (Chen and Han 1990): ranges of directions that leave a face
/// through one side. Sides of triangles are straight in space, so no path is shorter, and windows that a shorter path
/// leads around are dropped (Xin and Wang 2009).
class VertexView {
 public:
  /// Two vertices that match the triangle, and the place of the point.
  struct Match {
    double misfit =
        std::numeric_limits<double>::infinity();  ///< of the vertices from their expected places, in the wedge's unit
    double distance = 0, angle = 0;               ///< of the point from the vertex
    /// Vertices on the line to the point count as to its left (1) or right (-1), outside of the triangle.
    int vertices_on_line = 0;
  };

  /// `cover` and `wedge` are borrowed.
  /// @param side a side of the cover that starts at the vertex
  VertexView(const IntrinsicTriangulation& cover, const Wedge& wedge, int side);

  /// Visits the sides of this fan that start at the vertex.
  template <class Visit>
  void forSides(const Visit& visit) const {
    for (const Sector& sector : sectors_) visit(sector.side);
  }
  /// Searches for the corners beyond the faces at the vertex.
  void lookFarther();
  /// The best match so far.
  /// @param turn 1: the nearer corner lies to the left of the farther one, -1: to the right
  Match match(int turn) const;
  /// Follows the straight line to the point of a match.
  /// @returns its place; face -1 if the line does not end
  PlaceInCover follow(const Match& match) const;

 private:
  /// A face at the vertex.
  struct Sector {
    int side;      ///< side from the vertex, the right one of the face
    double angle;  ///< direction of that side
  };
  /// Where a corner of the triangle is seen from the vertex.
  struct Image {
    double distance, angle;
  };
  /// Directions that lead through a door, in the plane with the vertex at the origin and the first side of a sector
  /// along x.
  struct Window {
    double distance;
    double angle;  ///< direction of the sector's side
    Door door;
    Eigen::Vector2d low, high;  ///< rightmost and leftmost direction

    friend bool operator<(const Window& a, const Window& b) { return a.distance > b.distance; }
  };

  double lengthOf(int side) const { return cover_.length[side] / wedge_.unit; }
  Door doorOf(const Sector& sector) const;
  void addImage(int vertex, const Image& image);
  void shorten(int vertex, double distance);
  double nearest(int vertex) const;
  void add(Window window);
  void cross(const Window& window);
  PlaceInCover placeIn(int side, const std::array<Eigen::Vector2d, 3>& corners, const Eigen::Vector2d& seen) const;

  const IntrinsicTriangulation& cover_;
  const Wedge& wedge_;
  std::vector<Sector> sectors_;
  double total_ = 0;                          ///< total angle around the vertex
  std::array<std::vector<Image>, 2> images_;  ///< of the triangle's two other corners
  std::unordered_map<int, double> nearest_;   ///< upper bounds of the distances of vertices
  std::priority_queue<Window> windows_;
  std::unordered_map<int, std::vector<Window>> seen_;  ///< by side
};

}  // namespace tufted
