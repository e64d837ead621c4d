#pragma once

#include <memory>
#include <string>

#include "algorithms/connected.h"
#include "algorithms/linear_system.h"
#include "operators/surface_faces.h"
#include "tufted/distance.h"
#include "tufted/types.h"

namespace tufted {

/// To which conjugate gradients must solve for heat, as it is looked at far below its largest value.
constexpr double heat_tolerance = 1e-12;

/// What heat needs, all in the unit of `surface`.
struct HeatProblem {
  const SurfaceFaces& surface;
  const SparseMatrix& L;
  const Components& components;
  const LinearSystem* closed;   ///< a factor of M / t + L; null: rounds are solved in windows of `matrix`
  const LinearSystem* open;     ///< the same without rows and columns where the surface ends; null: not asked for
  const SparseMatrix& matrix;   ///< M / t + L, where `closed` is null
  const VectorXd& interior;     ///< N; 0 where the surface ends, 1 elsewhere
  bool ends;                    ///< whether the mean of closed and open is asked for
  const SolverOptions& window;  ///< how windows are solved
};

/// Heat that starts again and again where it could no longer be seen.
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

/// @param heat N, >= 0, what the first round starts from
/// @param report gets rounds, iterations, the residual and the backward error
/// All are borrowed; next() throws SolverFailure and Cancelled in the name of `function`.
std::unique_ptr<HeatRounds> makeHeatRounds(const std::string& function, const HeatProblem& problem,
                                           const VectorXd& heat, const Progress& progress, DistanceReport& report);

}  // namespace tufted
