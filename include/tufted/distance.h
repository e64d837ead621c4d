#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/options.h"
#include "tufted/solver.h"
#include "tufted/types.h"

namespace tufted {

/// A point of the surface, as a source of distances: a vertex, or a point inside a triangle of a mesh.
struct SurfacePoint {
  std::array<int, 3> corners;        ///< points of the Laplacian; a vertex has its own index thrice
  std::array<double, 3> weights;     ///< barycentric coordinates, >= 0, sum 1; a vertex has 1, 0, 0
  std::array<double, 3> distances;   ///< distances of the point from the corners, along the triangle
  std::array<double, 3> sides = {};  ///< lengths of the triangle's sides, each opposite the corner; a vertex has 0

  /// The point of that index.
  static SurfacePoint vertex(int index) { return {{index, index, index}, {1, 0, 0}, {0, 0, 0}, {0, 0, 0}}; }

  /// A point inside a triangle.
  /// @param points N x 3, of the mesh that the Laplacian was built from
  /// @param triangles F x 3, of the mesh that the Laplacian was built from
  /// @param face row of `triangles`
  /// @param barycentric coordinates by corner, each >= 0, not all 0; they are divided by their sum
  /// @throws InvalidInput for indices out of range, other coordinates, or a corner that is not finite
  static SurfacePoint inFace(const Points& points, const Triangles& triangles, int face,
                             const std::array<double, 3>& barycentric);
};

/// The unit of the time step of the heat equation, on each component by itself.
enum class TimeUnit {
  mean_edge,     ///< the mean squared length of the cover's edges
  adapted_edge,  ///< the mean squared length of the cover's edges, each face weighted by its area: for very uneven
                 ///< density, where many short edges say nothing about the gaps that heat has to cross elsewhere
};

/// How distances are found.
enum class DistanceMethod : std::uint8_t {
  marching,  ///< from triangle to triangle, with the source unfolded into each: the more accurate one, without a factor
  heat,      ///< by the heat method: smooth across the shocks where fronts meet
};

/// Options of DistanceSolver.
struct DistanceOptions {
  DistanceMethod method = DistanceMethod::marching;  ///< how distances are found
  /// Marching: how often each triangle is cut into four, 0 to 2. Each time the mean error falls to 0.6 of what it was
  /// (the median of CGAL's meshes), and a query takes three to four times as long. On clouds of 64,000 points and more
  /// the second time brings nothing. By default twice on surfaces of up to 5,000 points, whose triangles are coarse and
  /// few, else once.
  std::optional<int> split = {};
  /// Farthest distance, in the points' unit, > 0: greater ones are infinite. Marching then visits no more of the
  /// surface than it must.
  double maximum = std::numeric_limits<double>::infinity();
  /// Heat: time step t > 0, in `unit`. Larger values smooth the distance and round off its creases. The mean error is
  /// least at 1/4 to 1/2 on CGAL's meshes and near 1 for two sources on a sphere; for one source it falls up to t = 8.
  double time_step = 0.5;
  TimeUnit unit = TimeUnit::mean_edge;  ///< of `time_step`
  /// Heat: if true, heat at boundaries is the mean of heat that cannot leave (Neumann) and heat that is lost
  /// (Dirichlet), as if the surface went on (Section 3.2 of the paper on the heat method). If false, heat cannot leave,
  /// which takes one factorisation less.
  bool open_boundary = true;
  /// How systems are solved; marching uses `threads` and `progress` alone. The heat method makes three factors if the
  /// surface has a boundary and two otherwise, and `memory_limit` bounds all of them together. With multigrid, or if
  /// not all factors fit, `tolerance` is that of L d = div X, so d is accurate to about as much. Heat is then solved in
  /// windows: some 130 edges wide, each by a factor of its own, as far as `memory_limit` allows; otherwise some 30
  /// edges wide, to 1e-12.
  SolverOptions solver = {};
};

/// What a query did.
struct DistanceReport {
  int split = 0;  ///< marching: how often each triangle was cut into four
  /// Marching: points and middles of edges that were reached, from each source that came near; see
  /// DistanceOptions::split.
  std::int64_t visits = 0;
  std::int64_t lowered = 0;   ///< marching: of these, how many lay farther than a neighbour by more than their edge
  int rounds = 0;             ///< rounds of heat: one per some 500 edge lengths, in windows per 100 or 10
  int iterations = 0;         ///< most conjugate gradient iterations of any solve; 0 with Cholesky
  double residual = 0;        ///< greatest residual of any solve, see SolveReport
  double backward_error = 0;  ///< greatest backward error of any solve, see SolveReport
  double seconds = 0;         ///< wall-clock
  std::optional<WeakJoint> weak_joint = {};  ///< where the system is nearly disconnected, see SolveReport

  /// Takes in what another query did: sums of visits, lowered, rounds and seconds, the greater of the other numbers,
  /// and its weak joint if it has one.
  void add(const DistanceReport& other);
};

/// Distances with the source that each is measured from.
struct NearestSources {
  VectorXd distance;        ///< N, as query() gives them
  std::vector<int> source;  ///< N; which of the sources is nearest, of equally near ones the first; -1: none
};

/// Points near others, and how far away they are.
struct NearbyPoints {
  std::vector<int> points;        ///< ascending
  std::vector<double> distances;  ///< of each, at most the radius, in the points' unit
};

/// All points whose geodesic distance from the nearest of some points is at most a radius, with the distances that
/// DistanceSolver marches to. Only the surface around the sources is looked at, and no solver is made. On a cloud,
/// whose cover is not built for it, that takes time in proportion to the points that are found; the first call bounds
/// runs of points by boxes. Where there are coincident points, all are passed over, and on a mesh all faces. Other
/// components than those of the sources are left out: those of Laplacian::component or, if it is empty, of
/// componentLabels(), which also join by weights so small that DistanceSolver takes them for none.
/// @param sources indices of points; those that are isolated or not finite are ignored
/// @param radius > 0, finite, in the points' unit
/// @param split how often each triangle is cut into four, 0 to 2, see DistanceOptions::split
/// @throws InvalidInput for no source, an index out of range, no source on any component, another radius or split, or
/// a Laplacian without cover or positions, or with other than N components
/// @throws Cancelled when `progress` returns false
NearbyPoints pointsWithin(const Laplacian& laplacian, const std::vector<int>& sources, double radius,
                          std::optional<int> split = {}, const Progress& progress = {});

/// Geodesic distance on the distinct faces of the tufted cover. Prepared once, queried often; queries may run side by
/// side.
///
/// Marching (Kimmel, Sethian: "Computing geodesic paths on manifolds", 1998): the nearest point that is not done is
/// done, and gives its neighbours their distance along an edge or, if that is less, through a triangle, from the source
/// unfolded into its plane by the distances of two corners. In the end no distance exceeds that of a neighbour by more
/// than the length of their edge. None is shorter than the straight line between `Laplacian::positions`, if there are
/// any. Distances from several sources are the least of those from each. Each face is cut into four first, by default
/// once or twice (see `DistanceOptions::split`).
///
/// Heat (Crane, Weischedel, Wardetzky: "The heat method for distance computation", 2017): u is the heat that spreads
/// from the sources, (M + t L) u = delta; X = -grad u / |grad u| its direction; and the distance the function whose
/// gradient fits X best, L d = div X. Two things differ from that paper. X is taken from log u, which is nearly linear
/// in a face where u is not: at the same t the error on a sphere is a third. And u, which falls to a third with every
/// edge and would soon underflow, is started again in rounds from where it is still accurate, so distances are right at
/// any number of edges. With factors of the whole matrix a round covers some 500 edges and costs one or two solves. In
/// windows (see `DistanceOptions::solver`) it covers 100 edges, or 10 by conjugate gradients, and costs in proportion
/// to its window, so that for every query all rounds together cost as much as some factorisations of the whole matrix.
class DistanceSolver {
 public:
  /// Prepares the faces of a Laplacian's cover, or its systems, for queries.
  /// @param laplacian must have its cover; not needed after construction
  /// @throws InvalidInput for options out of range, arrays of the wrong size, or where there is no cover
  /// @throws SolverFailure when a matrix cannot be factorised
  /// @throws Cancelled when `options.solver.progress` returns false
  explicit DistanceSolver(const Laplacian& laplacian, const DistanceOptions& options = {});

  /// Distance from the nearest of the sources, points of the cloud or vertices of the mesh: N values >= 0, in the
  /// points' unit.
  ///
  /// The distance is 0 at sources, and infinity where no path leads: in components without a source, at isolated points
  /// and at those that are not finite. Coincident points have the value of their representative. A source given twice
  /// counts once. Where sources fill a region, distances are those from its boundary. Sources that are isolated or not
  /// finite are ignored.
  /// @throws InvalidInput for no source, an index out of range, or no source on any component
  /// @throws SolverFailure as Solver::solve
  /// @throws Cancelled when `progress` returns false
  VectorXd query(const std::vector<int>& sources, DistanceReport* report = nullptr,
                 const Progress& progress = {}) const;
  /// Distance from the nearest of the sources, any points of the surface; values and errors are as in query(). The
  /// corners around a source have their distance along the triangle. Flips may have removed that from the cover.
  /// @throws InvalidInput also for a source inside a triangle that the surface does not have
  VectorXd queryAt(const std::vector<SurfacePoint>& sources, DistanceReport* report = nullptr,
                   const Progress& progress = {}) const;
  /// The nearest of the sources, and how far away it is: the geodesic Voronoi cells of the sources. Marching finds both
  /// at once, the heat method takes a query for each source. Errors are as in query().
  NearestSources nearest(const std::vector<SurfacePoint>& sources, DistanceReport* report = nullptr,
                         const Progress& progress = {}) const;

  /// The time step t in use, in the points' unit squared, on the component that has the most points; 0 for marching.
  double timeStep() const;

  /// What the constructor did: all systems together, and its seconds; of marching `method`, `unknowns` (points and
  /// middles of edges), `bytes` and `seconds` alone. If only some systems are solved by multigrid,
  /// `method` names both ways.
  const SolverReport& report() const;

  /// A moved-from solver may only be destroyed or assigned to.
  DistanceSolver(DistanceSolver&&) noexcept;
  /// A moved-from solver may only be destroyed or assigned to.
  DistanceSolver& operator=(DistanceSolver&&) noexcept;
  ~DistanceSolver();

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

}  // namespace tufted
