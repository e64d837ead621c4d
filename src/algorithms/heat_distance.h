#pragma once

#include <memory>
#include <vector>

#include "algorithms/place_in_cover.h"
#include "tufted/distance.h"

namespace tufted {

struct Components;

/// Distances by the heat method (Crane, Weischedel, Wardetzky 2013, 2017), as DistanceSolver says.
class HeatDistance {
 public:
  /// @param laplacian with a cover that was checked
  /// @param components of the Laplacian, borrowed as long as this lives
  HeatDistance(const Laplacian& laplacian, const Components& components, const DistanceOptions& options);
  ~HeatDistance();

  /// @param places of which all corners are representatives, at least one on a component
  /// @param report a new one
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
