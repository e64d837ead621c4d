#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <queue>
#include <unordered_map>
#include <vector>

#include "algorithms/place_in_cover.h"
#include "tufted/intrinsic_triangulation.h"

namespace tufted {

/// A triangle as seen from the corner that is nearest to a point inside it.
struct Wedge {
  /// Corners that are seen from another are those of the triangle if they lie where its lengths put them, up to this
  /// part of the longer side; the best of several is taken. Mollification moves them by far less.
  static constexpr double same_triangle = 1e-2;

  int corner;                    ///< the one it is seen from
  std::array<int, 2> others;     ///< the farther one first
  std::array<double, 2> length;  ///< of the sides to them, in `unit`
  std::array<double, 2> weight;  ///< of the point at them
  double angle;                  ///< between the sides
  double unit;                   ///< a power of two near the longer side
  double on_line;                ///< a vertex that is no farther from a line may lie on it

  /// @param source of three different corners
  /// @param on_line in parts of the longer side
  static Wedge of(const SurfacePoint& source, double on_line);
};

/// The surface around a vertex of a cover, as far as a triangle there reaches. The cover may have several such parts
/// around one vertex, with faces of their own. Directions are angles from the first side, growing to the left.
///
/// Straight lines are followed through the faces as by Chen and Han (1990): a window is a range of directions that
/// leave a face through one side. Sides of triangles are straight in space, so no path is shorter, and windows with a
/// shorter way round are dropped (Xin and Wang 2009).
class VertexView {
 public:
  /// How well what is seen fits the triangle, and where the point lies then.
  struct Match {
    double misfit = std::numeric_limits<double>::infinity();  ///< in the wedge's unit
    double distance = 0, angle = 0;                           ///< of the point
    /// Vertices on the line to the point are taken to lie to its left (1) or right (-1): outside of the triangle.
    int vertices_on_line = 0;
  };

  /// Both arguments are borrowed.
  /// @param side of the cover, starts at the vertex
  VertexView(const IntrinsicTriangulation& cover, const Wedge& wedge, int side);

  /// The sides of the cover that start here.
  template <class Visit>
  void forSides(const Visit& visit) const {
    for (const Sector& sector : sectors_) visit(sector.side);
  }
  /// Looks for the corners beyond the faces at the vertex.
  void lookFarther();
  /// @param turn 1: the nearer corner lies to the left of the farther one, -1: to the right
  Match match(int turn) const;
  /// Follows the line to a point.
  /// @returns the face that it lies in, and where; face -1 where the line does not come to an end
  PlaceInCover follow(const Match& match) const;

 private:
  /// A face at the vertex.
  struct Sector {
    int side;      ///< runs from the vertex along the right of the face
    double angle;  ///< of that side
  };
  /// Where a corner of the triangle is seen.
  struct Image {
    double distance, angle;
  };
  /// A face beyond a side, in the plane with the vertex at the origin and the first side of a sector along x.
  struct Door {
    int side;  ///< from `left` to `right`, in the face
    Eigen::Vector2d left, right;
  };
  /// Directions that lead through a door.
  struct Window {
    double distance;
    double angle;  ///< of the sector
    Door door;
    Eigen::Vector2d low, high;  ///< farthest to the right and to the left

    friend bool operator<(const Window& a, const Window& b) { return a.distance > b.distance; }
  };

  double lengthOf(int side) const { return cover_.length[side] / wedge_.unit; }
  Door doorOf(const Sector& sector) const;
  Eigen::Vector2d apexOf(const Door& door) const;
  void addImage(int vertex, const Image& image);
  void shorten(int vertex, double distance);
  double nearest(int vertex) const;
  void add(Window window);
  void cross(const Window& window);
  PlaceInCover placeIn(int side, const std::array<Eigen::Vector2d, 3>& corners, const Eigen::Vector2d& seen) const;

  const IntrinsicTriangulation& cover_;
  const Wedge& wedge_;
  std::vector<Sector> sectors_;
  double total_ = 0;                          ///< the angle around the vertex
  std::array<std::vector<Image>, 2> images_;  ///< of the two other corners
  std::unordered_map<int, double> nearest_;   ///< upper bounds of the distances of vertices
  std::priority_queue<Window> windows_;
  std::unordered_map<int, std::vector<Window>> seen_;  ///< by side
};

}  // namespace tufted
