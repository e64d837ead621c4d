#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "algorithms/linear_system.h"
#include "algorithms/pinned_solver.h"
#include "base/parallel.h"

namespace tufted {

/// A surface as it is deformed.
struct Pose {
  Eigen::MatrixXd places;                  ///< N x 3
  std::vector<Eigen::Matrix3d> rotations;  ///< N, of the neighbourhoods
};

/// Surfaces whose neighbourhoods turn smoothly and hardly stretch (Levi and Gotsman 2015). They have the least energy
///   1/2 sum over points i and neighbours j of w_ij (|(x'_i - x'_j) - R_i (x_i - x_j)|^2 + s_i |R_i - R_j|^2)
/// over the free places x' and all rotations R, which L-BFGS finds from second derivatives of both apart, factored once
/// (Liu, Bouaziz, Kavan: "Quasi-Newton methods for real-time simulation of hyperelastic materials", 2017).
class RigidDeformation {
 public:
  /// @param function to be named in errors
  /// @param laplacian must outlive it
  /// @param x N x 3, the surface before
  /// @param smoothing s, N, equal on a component; 0: neighbourhoods turn each for itself (Sorkine and Alexa 2007)
  RigidDeformation(const std::string& function, const Laplacian& laplacian, const PinnedPoints& pinned,
                   Eigen::MatrixXd x, VectorXd smoothing, const SolverOptions& options);

  struct Result {
    int iterations = 0;
    double last_move = 0;  ///< the farthest that a point moved or, if that is more, the largest angle of a turn
    bool converged = false;
  };
  /// Lets all others follow the pinned points, which are where they shall be.
  /// @param pose its rotations do not matter
  /// @param tolerance of the last move
  Result run(const std::string& function, Pose& pose, double tolerance, int max_iterations, int threads,
             const Progress& progress) const;

 private:
  /// Rows of N x 6: a move of the place, and a turn as its axis times its angle.
  struct Evaluation {
    double energy;
    Eigen::MatrixXd force;  ///< minus the gradient
  };
  /// Takes the harmonic displacement, and for all neighbourhoods of a component the rotation that it makes as a whole:
  /// as no neighbourhood turns another way than its neighbours, large turns find a way that they agree on.
  /// @return how far a point moved
  double start(const std::string& function, Pose& pose, const Workers& workers, const Progress& progress) const;
  Evaluation evaluate(const Pose& pose, const Workers& workers) const;
  /// The step after which there would be no force if places and rotations did not depend on each other.
  Eigen::MatrixXd solve(const std::string& function, const Eigen::MatrixXd& force, const Progress& progress) const;

  const SparseMatrix& L_;
  Eigen::MatrixXd x_;
  VectorXd smoothing_;  ///< s
  PinnedSolver places_;
  LinearSystem turns_;
};

}  // namespace tufted
