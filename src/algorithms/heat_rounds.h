#pragma once

#include <memory>
#include <string>

#include "algorithms/connected.h"
#include "algorithms/linear_system.h"
#include "operators/surface_faces.h"
#include "tufted/distance.h"
#include "tufted/types.h"

namespace tufted {

/// The system M / t + L: a factor of the whole matrix if that fits, otherwise the matrix to take windows of.
struct HeatSystem {
  std::unique_ptr<const LinearSystem> closed;  ///< the factor; null: rounds are solved in windows
  std::unique_ptr<const LinearSystem> open;    ///< the factor without the points where the surface ends, if it does
  SparseMatrix matrix;                         ///< M / t + L where there is no factor, otherwise empty
  VectorXd interior;                           ///< N, 0 where the surface ends and 1 elsewhere; size 0: it ends nowhere
  SolverOptions window;                        ///< how windows are solved

  /// Whether the surface ends somewhere. Heat is then the mean of two solutions.
  bool ends() const { return interior.size() > 0; }
};

/// @param function the public function to name in errors
/// @param matrix M / t + L
/// @param interior see HeatSystem
/// @param options with the memory that one factor may take; multigrid asks for windows
HeatSystem makeHeatSystem(const std::string& function, SparseMatrix matrix, VectorXd interior,
                          const SolverOptions& options);

/// The data that a query for heat uses, all in the unit of `surface`. Everything is borrowed.
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
  /// Finds the heat of the next round; false when it has gone as far as it can.
  virtual bool next() = 0;

  /// N; the logarithm of this round's heat, up to a constant per component. -infinity where there is none.
  const VectorXd& logHeat() const { return log_heat_; }
  /// Heat is right where its logarithm is at least this.
  double logValid() const { return log_valid_; }

 protected:
  VectorXd log_heat_;
  double log_valid_ = 0;
};

/// Makes the rounds of heat for one query, by the factors of `problem` or in windows. All arguments are borrowed;
/// next() throws SolverFailure and Cancelled in the name of `function`.
/// @param heat N, >= 0, what the first round starts from
/// @param report gets rounds, iterations, the residual and the backward error
std::unique_ptr<HeatRounds> makeHeatRounds(const std::string& function, const HeatProblem& problem,
                                           const VectorXd& heat, const Progress& progress, DistanceReport& report);

}  // namespace tufted
