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
  std::array<int, 3> corners;        ///< indices of the triangle's corners; of a vertex three times its own index
  std::array<double, 3> weights;     ///< barycentric coordinates, >= 0, sum 1; of a vertex 1, 0, 0
  std::array<double, 3> distances;   ///< straight distances from the point to the corners, in the points' unit
  std::array<double, 3> sides = {};  ///< lengths of the triangle's sides, each opposite its corner; of a vertex 0

  /// The point or vertex with an index.
  static SurfacePoint vertex(int index) { return {{index, index, index}, {1, 0, 0}, {0, 0, 0}, {0, 0, 0}}; }

  /// A point inside a triangle.
  /// @param points N x 3, of the mesh that the Laplacian was built from
  /// @param triangles F x 3, of the mesh that the Laplacian was built from
  /// @param face row of `triangles`
  /// @param barycentric coordinates by corner, finite, each >= 0, not all 0; they are divided by their sum
  /// @throws InvalidInput for indices or coordinates out of range, or a corner that is not finite
  static SurfacePoint inFace(const Points& points, const Triangles& triangles, int face,
                             const std::array<double, 3>& barycentric);
};

/// Unit of the time step of the heat equation, on each component separately.
enum class TimeUnit {
  mean_edge,     ///< the mean squared length of the cover's edges
  adapted_edge,  ///< the same with each face weighted by its area: for very uneven density, where many short edges say
                 ///< nothing about the gaps that heat has to cross elsewhere
};

/// How distances are computed.
enum class DistanceMethod : std::uint8_t {
  marching,  ///< fast marching from triangle to triangle: more accurate, and without a factor
  heat,      ///< the heat method: smooth where fronts from different sides meet
};

/// Options of DistanceSolver.
struct DistanceOptions {
  DistanceMethod method = DistanceMethod::marching;  ///< how distances are computed
  /// Marching: how often each triangle is cut into four, 0 to 2. Each time the mean error falls to a factor of 0.6 (the
  /// median on CGAL's meshes), and a query takes three to four times as long; on clouds of 64,000 points and more the
  /// second time gains nothing. Empty: 2 on surfaces of up to 5,000 points, whose triangles are few and coarse,
  /// otherwise 1.
  std::optional<int> split = {};
  /// Greatest distance of interest, > 0, in the points' unit: beyond it distances are infinite, and marching does not
  /// go there.
  double maximum = std::numeric_limits<double>::infinity();
  /// Heat: time step t in units of `unit`, in [1e-4, 1e12]. Larger values smooth the distance and round off its
  /// creases. The mean error is least at 0.25 to 0.5 on CGAL's meshes and near 1 for two sources on a sphere; for one
  /// source it falls up to 8.
  double time_step = 0.5;
  TimeUnit unit = TimeUnit::mean_edge;  ///< unit of `time_step`
  /// Heat: true averages heat that cannot leave across the boundary (Neumann) and heat that is lost there (Dirichlet),
  /// as if the surface went on (Section 3.2 of the paper on the heat method). False uses Neumann only, which takes one
  /// factorisation less.
  bool open_boundary = true;
  /// How systems are solved; marching uses `threads` and `progress` only. The heat method makes three factors if the
  /// surface has a boundary and two otherwise, and `memory_limit` bounds all of them together. With multigrid, or if
  /// not all factors fit, `tolerance` is that of L d = div X and so about the accuracy of d. Heat is then solved in
  /// windows of some 130 edges, each by its own factor, as far as `memory_limit` allows, otherwise in windows of some
  /// 30 edges by conjugate gradients, to 1e-12.
  SolverOptions solver = {};
};

/// Work, accuracy and time of a query.
struct DistanceReport {
  int split = 0;  ///< marching: how often each triangle was cut into four
  /// Marching: number of times that a point, or a midpoint from cutting triangles, was reached, counted for each source
  /// that came near it.
  std::int64_t visits = 0;
  /// Marching: of these visits, how many found a distance above that of a neighbour plus their edge, and reduced it.
  std::int64_t lowered = 0;
  int rounds = 0;             ///< heat: rounds, one per some 500 edge lengths, in windows one per 100 or 10
  int iterations = 0;         ///< most conjugate gradient iterations of any solve; 0 with Cholesky
  double residual = 0;        ///< greatest residual of any solve, see SolveReport
  double backward_error = 0;  ///< greatest backward error of any solve, see SolveReport
  double seconds = 0;         ///< wall-clock
  std::optional<WeakJoint> weak_joint = {};  ///< where the system is nearly disconnected, see SolveReport

  /// Adds the report of another query: sums of visits, lowered, rounds and seconds, the greater of the other numbers,
  /// and its weak joint if it has one.
  void add(const DistanceReport& other);
};

/// Distances with the source that each is measured from.
struct NearestSources {
  VectorXd distance;        ///< N, see DistanceSolver::query()
  std::vector<int> source;  ///< N; number of the nearest source in the list, of equal ones the first; -1: none
};

/// Points within a radius of some sources, and their distances.
struct NearbyPoints {
  std::vector<int> points;        ///< indices, ascending
  std::vector<double> distances;  ///< of each, at most the radius, in the points' unit
};

/// Finds all points whose geodesic distance from the nearest source is at most a radius, with the distances that
/// DistanceSolver marches to. Only the surface around the sources is visited, and no solver is made: on a cloud, whose
/// cover is not built, the time is in proportion to the number of points found, after the first call, which bounds runs
/// of points by boxes. With coincident points all points are visited, and on a mesh all faces. Only the components of
/// the sources are searched: those of Laplacian::component or, if it is empty, of componentLabels(), which also join by
/// weights so small that DistanceSolver ignores them.
/// @param sources indices of points; isolated and non-finite ones are ignored
/// @param radius > 0, finite, in the points' unit
/// @param split see DistanceOptions::split
/// @throws InvalidInput for no source, an index out of range, no source on any component, a radius or split out of
/// range, or a Laplacian without cover or positions, or whose `component` is neither empty nor of size N
/// @throws Cancelled when `progress` returns false
NearbyPoints pointsWithin(const Laplacian& laplacian, const std::vector<int>& sources, double radius,
                          std::optional<int> split = {}, const Progress& progress = {});

/// Geodesic distances on the distinct faces of the tufted cover. Prepared once, queried often; queries may run in
/// parallel.
///
/// Marching (Kimmel, Sethian: "Computing geodesic paths on manifolds", 1998): points become final in the order of their
/// distance, and give their neighbours a distance along the edge or, if that is less, through a triangle, from the
/// source unfolded into its plane by the distances of two corners. In the end no distance exceeds that of a neighbour
/// by more than the length of their edge, and none is below the straight line between `Laplacian::positions`, if
/// stored. Distances from several sources are the least of those from each, up to 0.5 % where many lie side by side.
///
/// Heat (Crane, Weischedel, Wardetzky: "The heat method for distance computation", 2017): (M + t L) u = delta is the
/// heat that spreads from the sources, X = -grad u / |grad u| its direction, and L d = div X gives the function d whose
/// gradient fits X best. Two things differ from that paper. X is computed from log u, which is nearly linear in a face
/// where u is not: with the same t the error on a sphere is a third. And u, which falls to a third with every edge and
/// would soon underflow, is computed in rounds, each starting where the last one is still accurate, so distances are
/// right at any number of edges. With factors of the whole matrix a round covers some 500 edges and costs one or two
/// solves. In windows (see `DistanceOptions::solver`) a round covers 100 edges, or 10 by conjugate gradients, and costs
/// in proportion to its window; all rounds of a query together cost as much as some factorisations of the whole matrix.
class DistanceSolver {
 public:
  /// Prepares the faces of the cover for marching, or factors the systems of the heat method.
  /// @param laplacian with its cover; not needed after construction
  /// @throws InvalidInput for options out of range, arrays of the wrong size, or a Laplacian without cover
  /// @throws SolverFailure when a matrix cannot be factorised
  /// @throws Cancelled when `options.solver.progress` returns false
  explicit DistanceSolver(const Laplacian& laplacian, const DistanceOptions& options = {});

  /// Computes the distance from the nearest of some points or vertices.
  ///
  /// It is 0 at sources, and infinite where no path leads: on components without a source and at isolated and
  /// non-finite points. Coincident points have the value of their representative. Where sources fill a region,
  /// distances are those from its boundary.
  /// @param sources indices; repeated, isolated and non-finite ones are ignored
  /// @return N values >= 0, in the points' unit
  /// @throws InvalidInput for no source, an index out of range, or no source on any component
  /// @throws SolverFailure for the same reasons as Solver::solve()
  /// @throws Cancelled when `progress` returns false
  VectorXd query(const std::vector<int>& sources, DistanceReport* report = nullptr,
                 const Progress& progress = {}) const;
  /// Computes the distance from the nearest of some points of the surface; values and errors are those of query(). The
  /// corners of the triangle around a source have their straight distance, also where flips removed the triangle from
  /// the cover.
  /// @throws InvalidInput also for a source inside a triangle that is not one of the surface
  VectorXd queryAt(const std::vector<SurfacePoint>& sources, DistanceReport* report = nullptr,
                   const Progress& progress = {}) const;
  /// Computes which source is nearest to each point, and its distance: the geodesic Voronoi cells of the sources.
  /// Marching takes one query, the heat method one for each source. Errors are those of queryAt().
  NearestSources nearest(const std::vector<SurfacePoint>& sources, DistanceReport* report = nullptr,
                         const Progress& progress = {}) const;

  /// Computes the distances from each of some sources, as many at once as there are threads.
  /// @param symmetric whether the distances between sources, found from either end, are replaced by the mean of both.
  /// They differ by some thousandths of the largest distance on smooth surfaces, on coarse meshes by up to 6 %.
  /// @return N x S, a column for each source; infinite for a source on no component. Values and errors are otherwise
  /// those of queryAt().
  /// @throws InvalidInput also for a source inside a triangle if `symmetric`
  Eigen::MatrixXd matrix(const std::vector<SurfacePoint>& sources, bool symmetric = false,
                         DistanceReport* report = nullptr, const Progress& progress = {}) const;

  /// The time step t, in the points' unit squared, of the component with the most points; 0 for marching.
  double timeStep() const;

  /// How the constructor made the systems, summed over them, and its seconds; for marching only `method`, `unknowns`
  /// (points, and midpoints from cutting triangles), `bytes` and `seconds`. `method` names both ways if only some
  /// systems are solved by multigrid.
  const SolverReport& report() const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace tufted
