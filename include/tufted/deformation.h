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
  as_rigid_as_possible,  ///< neighbourhoods turn smoothly and hardly stretch; iterates (Levi and Gotsman 2015)
  linear,                ///< two linear solves that keep the turned Laplacian of the positions (Lipman et al. 2004)
};

/// Options of deform().
struct DeformationOptions {
  DeformationMethod method = DeformationMethod::as_rigid_as_possible;  ///< how the rest follows
  /// How much it costs that neighbours turn in different ways, as part of the area of a component; >= 0, for
  /// DeformationMethod::as_rigid_as_possible. The surface bends like a plate whose thickness grows with the root. With
  /// 0 it does not resist bending (Sorkine and Alexa 2007), and how it bends depends on the triangles.
  double smoothness = 1e-3;
  /// Iterations of DeformationMethod::as_rigid_as_possible end where no point moves by more than this part of the
  /// longest way of a handle, or turns by as much about an axis at the distance of the surface's extent; > 0.
  double tolerance = 1e-3;
  /// There are at most so many iterations, >= 1; where they do not suffice, DeformationReport::converged is false.
  int max_iterations = 500;
  SolverOptions solver = {};  ///< how systems are solved
};

/// What deform() did.
struct DeformationReport {
  std::int64_t handles = 0;   ///< places that were given
  std::int64_t moved = 0;     ///< other points that could move
  std::int64_t floating = 0;  ///< active points of components without a handle, which stayed in place
  double longest_way = 0;     ///< of a handle, in the caller's unit
  int iterations = 0;         ///< systems that were solved
  double last_move = 0;       ///< the farthest that a point moved or turned in the last iteration, in the caller's unit
  bool converged = true;      ///< whether that is within the tolerance
  /// Root of the mean, over all edges by their weights in L, of how far an edge is from the one that its two turned
  /// neighbourhoods want, squared, in their length: 0 for a rigid motion.
  double stretch = 0;
  double seconds = 0;  ///< wall-clock
};

/// Moves points of a surface to given places, and lets all others follow (Sharp and Crane 2020, Figure 17). Weights are
/// those of L, which are positive, so thin or uneven triangles do not bend the result.
///
/// As rigid as possible (Levi, Gotsman: "Smooth rotation enhanced as-rigid-as-possible mesh animation", 2015): the
/// least sum over all points i and their neighbours j of w_ij (|(x'_i - x'_j) - R_i (x_i - x_j)|^2 + s |R_i - R_j|^2),
/// R_i a rotation for each point, s the smoothness times the component's area. Linear (Lipman et al.: "Differential
/// coordinates for interactive mesh editing", 2004): the least sum over M of |M^-1 L x' - R_i M^-1 L x|^2, where the
/// R_i are those of the surface that follows without turning.
/// @param laplacian with its positions, from which the points start
/// @param handles P indices; a coincident one counts as its representative, several at one place as their mean
/// @param targets P x 3, where the handles shall lie
/// @return N x 3. Points of components without a handle, and those that are isolated or not finite, stay at
///         Laplacian::positions; a coincident point lies where its representative does
/// @throws InvalidInput for arrays of the wrong size, indices or options out of range, targets or positions that are
///         not finite, or no handle on any component
/// @throws SolverFailure when a system cannot be solved
/// @throws Cancelled when `options.solver.progress` returns false
Points deform(const Laplacian& laplacian, const std::vector<int>& handles, const PointsRef& targets,
              const DeformationOptions& options = {}, DeformationReport* report = nullptr);

/// deform() for one set of handles, factored once and queried often with other targets; queries may run side by side.
/// The results are its bit for bit.
class DeformationSolver {
 public:
  /// @param laplacian shared, as every query looks at it; it must not change
  /// @param handles P indices
  /// @throws as deform(), and InvalidInput for a null pointer
  explicit DeformationSolver(std::shared_ptr<const Laplacian> laplacian, std::vector<int> handles,
                             const DeformationOptions& options = {});

  /// @param targets P x 3
  /// @return as deform(), whose errors it throws
  Points deform(const PointsRef& targets, DeformationReport* report = nullptr, const Progress& progress = {}) const;

  /// A moved-from solver may only be destroyed or assigned to.
  DeformationSolver(DeformationSolver&&) noexcept;
  /// A moved-from solver may only be destroyed or assigned to.
  DeformationSolver& operator=(DeformationSolver&&) noexcept;
  ~DeformationSolver();

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

}  // namespace tufted
