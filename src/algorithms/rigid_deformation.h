#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "algorithms/linear_system.h"
#include "algorithms/pinned_solver.h"
#include "base/parallel.h"

namespace tufted {

/// A deformed surface.
struct Pose {
  Eigen::MatrixXd places;                  ///< N x 3; positions
  std::vector<Eigen::Matrix3d> rotations;  ///< N; of the neighbourhoods
};

/// Deformation as rigid as possible with smooth rotations (Levi and Gotsman 2015; docs/algorithm.md, section 24): the
/// least energy
///   1/2 sum over points i and neighbours j of w_ij (|(x'_i - x'_j) - R_i (x_i - x_j)|^2 + s_i |R_i - R_j|^2)
/// over the free positions x' and all rotations R, found by L-BFGS from second derivatives of each of the two, factored
/// once (Liu, Bouaziz, Kavan: "Quasi-Newton methods for real-time simulation of hyperelastic materials", 2017).
class RigidDeformation {
 public:
  /// @param function named in errors
  /// @param laplacian must outlive it
  /// @param x N x 3, positions before
  /// @param smoothing s, N, equal on a component; 0: no smoothing of rotations (Sorkine and Alexa 2007)
  RigidDeformation(const std::string& function, const Laplacian& laplacian, const PinnedPoints& pinned,
                   Eigen::MatrixXd x, VectorXd smoothing, const SolverOptions& options);

  struct Result {
    int iterations = 0;
    double last_move = 0;  ///< of the last iteration: the largest move or, if that is more, the largest rotation angle
    bool converged = false;
  };
  /// Moves the free points to follow the pinned ones.
  /// @param[in,out] pose with pinned points at their targets; its rotations are ignored
  /// @param tolerance on `last_move`
  /// @throws SolverFailure if a position overflows
  Result run(const std::string& function, Pose& pose, double tolerance, int max_iterations, int threads,
             const Progress& progress) const;

 private:
  /// Energy and force at a pose. Rows of N x 6 are a move, and a rotation as its axis times its angle.
  struct Evaluation {
    double energy;
    Eigen::MatrixXd force;  ///< minus the gradient
  };
  /// The first pose: the harmonic displacement and, for all neighbourhoods of a component, the rotation of the whole
  /// component. With equal first rotations, neighbours do not rotate to different sides in large deformations.
  /// @return the largest move
  double start(const std::string& function, Pose& pose, const Workers& workers, const Progress& progress) const;
  Evaluation evaluate(const Pose& pose, const Workers& workers) const;
  /// The step after which the force would be 0 if positions and rotations were independent of each other.
  Eigen::MatrixXd solve(const std::string& function, const Eigen::MatrixXd& force, const Progress& progress) const;

  const SparseMatrix& L_;
  Eigen::MatrixXd x_;
  VectorXd smoothing_;  ///< s
  PinnedSolver places_;
  LinearSystem turns_;
};

}  // namespace tufted
