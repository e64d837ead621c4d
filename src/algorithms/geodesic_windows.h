#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <queue>
#include <vector>

#include "algorithms/line_windows.h"
#include "base/parallel.h"
#include "tufted/intrinsic_triangulation.h"

namespace tufted {

/// A corner of a face at a vertex.
struct Sector {
  int side;      ///< starts at the vertex, in the face
  double begin;  ///< turn of that side: the sum of the angles of all sectors before
  double angle;  ///< of the corner, radians
  int fan;       ///< number of the set of sectors that are glued to each other
};

/// The shortest paths from a vertex to all others, exact for the metric of the triangles (docs/algorithm.md, section
/// 22): how they leave the vertex, and their lengths. Straight lines are followed through the faces in windows (Chen
/// and Han 1990): ranges of directions that leave a face through one side. Windows that a shorter path leads around are
/// dropped (Xin and Wang 2009). Paths bend at saddles and where the surface ends, so windows start there as well.
class GeodesicWindows {
 public:
  /// Follows all windows.
  /// @param surface is borrowed; sides may have no mate, -1
  /// @param exponent lengths are computed in units of 2^exponent
  /// @throws SolverFailure where windows do not end
  /// @throws Cancelled when the workers' progress returns false
  GeodesicWindows(const IntrinsicTriangulation& surface, int exponent, int source, const Workers& workers);

  /// Sectors at the source by growing turn, fan after fan.
  const std::vector<Sector>& sectors() const { return sectors_; }
  /// The direction in which the path to a vertex leaves the source, as in Sector::begin; not set where none leads.
  double turn(int vertex) const { return turn_[vertex]; }
  /// Length of the path in the caller's unit; infinite where none leads.
  double distance(int vertex) const { return distance_[vertex] * unit_; }

 private:
  /// Straight lines from the last bend of their path, or from the source, which is the origin.
  struct Window {
    double key = 0;         ///< length of the shortest path through it
    double before = 0;      ///< length of the path to its last bend
    double turn = 0;        ///< of the path; of the x axis if it has not bent
    bool has_bent = false;  ///< whether the path has bent
    Door door = {};
    Eigen::Vector2d low = {}, high = {};  ///< rightmost and leftmost direction

    friend bool operator<(const Window& a, const Window& b) { return a.key > b.key; }
  };
  /// How the path comes to a vertex: the way back has an angle from a side that starts there, in its face.
  struct Arrival {
    int side = -1;
    double angle = 0;
  };
  /// A vertex where the path may bend.
  struct Bend {
    double key;
    int vertex;

    friend bool operator<(const Bend& a, const Bend& b) { return a.key > b.key; }
  };
  /// The window through a side from which the vertex behind it is nearest.
  struct Nearest {
    double distance = std::numeric_limits<double>::infinity();
    double place = 0;  ///< where the line to the vertex crosses the side: 0 at its left end, 1 at the right one
  };
  /// The third corner of the face before a window, and the end of the window that is farther from it.
  struct Behind {
    int vertex;
    Eigen::Vector2d at;
    bool is_low_far;
  };

  double lengthOf(int side) const { return surface_.length[side] / unit_; }
  std::vector<Sector> sectorsAt(int vertex) const;
  bool isManifold() const;
  std::vector<std::uint8_t> mirrorsOf(const std::vector<Sector>& sectors, int fan) const;
  void leave(const Sector& sector, double low, double high, const Window& window);
  void leaveSource();
  void bend(int vertex);
  void reach(int vertex, double distance, double turn, const Arrival& arrival);
  void add(Window window, const Behind* behind);
  void cross(const Window& window);

  const IntrinsicTriangulation& surface_;
  const double unit_;
  std::vector<double> distance_;  ///< the shortest known
  std::vector<double> turn_;
  std::vector<Arrival> arrival_;
  std::vector<int> offset_, sides_;  ///< the sides by the vertex where they start
  std::vector<Nearest> nearest_;     ///< of each side
  std::vector<Sector> sectors_;
  bool is_manifold_ = true;
  std::priority_queue<Window> windows_;
  std::priority_queue<Bend> bends_;
};

}  // namespace tufted
