#pragma once

#include <memory>
#include <vector>

#include "algorithms/place_in_cover.h"
#include "tufted/distance.h"

namespace tufted {

struct Components;

/// Distances by the heat method (Crane, Weischedel, Wardetzky 2013, 2017), see DistanceSolver.
class HeatDistance {
 public:
  /// @param laplacian with a valid cover
  /// @param components of the Laplacian; borrowed as long as this lives
  HeatDistance(const Laplacian& laplacian, const Components& components, const DistanceOptions& options);
  ~HeatDistance();

  /// Computes the distance from the nearest of some places.
  /// @param places whose corners are representatives, at least one on a component
  /// @param report newly made; gets rounds, iterations, the residual and the backward error
  /// @return N distances in the points' unit; those of coincident points are not set
  VectorXd query(const char* function, const std::vector<PlaceInCover>& places, const Progress& progress,
                 DistanceReport& report) const;
  double timeStep() const;
  const SolverReport& report() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace tufted
