#pragma once

#include <memory>
#include <string>

#include "algorithms/connected.h"
#include "algorithms/linear_system.h"
#include "operators/surface_faces.h"
#include "tufted/distance.h"
#include "tufted/types.h"

namespace tufted {

/// The system M / t + L: factors of the whole matrix if they fit into memory, otherwise the matrix, for windows.
struct HeatSystem {
  std::unique_ptr<const LinearSystem> closed;  ///< factor in which heat cannot leave (Neumann); null: windows are used
  std::unique_ptr<const LinearSystem>
      open;              ///< factor without the points where the surface ends (Dirichlet); null if it ends nowhere
  SparseMatrix matrix;   ///< M / t + L where there is no factor, otherwise empty
  VectorXd interior;     ///< N; 0 where the surface ends, 1 elsewhere; size 0: it ends nowhere
  SolverOptions window;  ///< how windows are solved

  /// Whether the surface ends somewhere. Heat is then the mean of two solutions.
  bool ends() const { return interior.size() > 0; }
};

/// Factors the system, or keeps its matrix for windows.
/// @param function named in errors
/// @param matrix M / t + L
/// @param interior see HeatSystem
/// @param options `memory_limit` is that of one factor; multigrid means windows
HeatSystem makeHeatSystem(const std::string& function, SparseMatrix matrix, VectorXd interior,
                          const SolverOptions& options);

/// The input of a query for heat, in the unit of `surface`. All members are borrowed.
struct HeatProblem {
  const SurfaceFaces& surface;
  const SparseMatrix& L;
  const Components& components;
  const HeatSystem& system;
};

/// Heat that spreads in rounds, each of which starts where the heat of the last one became too small to be accurate.
class HeatRounds {
 public:
  virtual ~HeatRounds() = default;
  /// Computes the heat of the next round; false if heat reaches no further point.
  virtual bool next() = 0;

  /// N; the logarithm of this round's heat, up to a constant per component; -infinity without heat.
  const VectorXd& logHeat() const { return log_heat_; }
  /// Heat is accurate where its logarithm is at least this.
  double logValid() const { return log_valid_; }

 protected:
  VectorXd log_heat_;
  double log_valid_ = 0;
};

/// Makes the rounds of heat for one query, by the factors of `problem` or in windows. All arguments are borrowed;
/// next() throws SolverFailure and Cancelled in the name of `function`.
/// @param heat N, >= 0; the heat that the first round starts from
/// @param report gets rounds, iterations, the residual and the backward error
std::unique_ptr<HeatRounds> makeHeatRounds(const std::string& function, const HeatProblem& problem,
                                           const VectorXd& heat, const Progress& progress, DistanceReport& report);

}  // namespace tufted
