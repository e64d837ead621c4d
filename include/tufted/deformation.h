#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/solver.h"
#include "tufted/types.h"

namespace tufted {

/// How the rest of a surface follows its handles.
enum class DeformationMethod : std::uint8_t {
  as_rigid_as_possible,  ///< neighbourhoods rotate smoothly and hardly stretch; iterates (Levi and Gotsman 2015)
  linear,                ///< two linear solves that keep the rotated Laplacian of the positions (Lipman et al. 2004)
};

/// Options of deform().
struct DeformationOptions {
  DeformationMethod method = DeformationMethod::as_rigid_as_possible;  ///< how the rest of the surface follows
  /// For as_rigid_as_possible, in [0, 1e6]: cost of different rotations of neighbours, as a share of the area of the
  /// component. The surface bends like a plate whose thickness is proportional to its square root. With 0 it does not
  /// resist bending (Sorkine and Alexa 2007), and how it bends depends on the triangles.
  double smoothness = 1e-3;
  /// For as_rigid_as_possible, > 0: iterations stop when no point moves by more than this part of the longest way of a
  /// handle. A rotation counts as the way of a point at the distance of the surface's extent from the axis.
  double tolerance = 1e-3;
  /// Most iterations, >= 1; if they do not suffice, DeformationReport::converged is false.
  int max_iterations = 500;
  SolverOptions solver = {};  ///< how systems are solved
};

/// Counts, accuracy and time of a call of deform().
struct DeformationReport {
  std::int64_t handles = 0;   ///< active points with a given place
  std::int64_t moved = 0;     ///< other points that could move
  std::int64_t floating = 0;  ///< active points on components without a handle; they stay in place
  double longest_way = 0;     ///< longest way of a handle to its target, in the caller's unit
  int iterations = 0;         ///< iterations done; 2 solves with DeformationMethod::linear
  double last_move = 0;       ///< greatest move or rotation of a point in the last iteration, in the caller's unit
  bool converged = true;      ///< whether `last_move` is within the tolerance
  /// How much edges are stretched: the root mean square, over all edges with their weights in L, of the difference
  /// between an edge and its original rotated as its two neighbourhoods, relative to their lengths; 0 for a rigid
  /// motion.
  double stretch = 0;
  double seconds = 0;  ///< wall-clock
};

/// Moves points of a surface to given places, and lets all others follow (Sharp and Crane 2020, Figure 17). Edge
/// weights w are those of L, which are positive, so thin or uneven triangles do not bend the result.
///
/// DeformationMethod::as_rigid_as_possible (Levi, Gotsman: "Smooth rotation enhanced as-rigid-as-possible mesh
/// animation", 2015) minimises the sum over all points i and their neighbours j of
/// w_ij (|(x'_i - x'_j) - R_i (x_i - x_j)|^2 + s |R_i - R_j|^2), with a rotation R_i for each point, and s the
/// smoothness times the area of the component. Linear (Lipman et al.: "Differential coordinates for interactive mesh
/// editing", 2004) minimises the sum over M of |M^-1 L x' - R_i M^-1 L x|^2, where R_i are the rotations of the surface
/// when its displacement is the biharmonic interpolation of that of the handles.
/// @param laplacian with its positions, from which the points start
/// @param handles P indices; a coincident one counts as its representative, several at one place as their mean
/// @param targets P x 3, the new places of the handles, in the caller's unit
/// @return N x 3. Points on components without a handle, and isolated and non-finite points, stay at
/// Laplacian::positions; coincident points as their representative
/// @throws InvalidInput for arrays of the wrong size, indices or options out of range, targets or positions that are
/// not finite, targets too far away to be finite in units of the surface's size, or no handle on any component
/// @throws SolverFailure when a system cannot be solved
/// @throws Cancelled when `options.solver.progress` returns false
Points deform(const Laplacian& laplacian, const std::vector<int>& handles, const PointsRef& targets,
              const DeformationOptions& options = {}, DeformationReport* report = nullptr);

/// deform() for one set of handles: factored once, queried often with other targets; queries may run in parallel. The
/// results have the same bits as those of deform().
class DeformationSolver {
 public:
  /// @param laplacian with its positions; not needed after construction
  /// @param handles P indices
  /// @throws InvalidInput, SolverFailure and Cancelled as deform()
  explicit DeformationSolver(const Laplacian& laplacian, std::vector<int> handles,
                             const DeformationOptions& options = {});

  /// Moves the handles to `targets`, P x 3 in the caller's unit; result and errors are those of deform().
  Points query(const PointsRef& targets, DeformationReport* report = nullptr, const Progress& progress = {}) const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace tufted
