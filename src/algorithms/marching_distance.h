#pragma once

#include <vector>

#include "algorithms/march.h"
#include "algorithms/march_faces.h"
#include "algorithms/place_in_cover.h"
#include "tufted/distance.h"

namespace tufted {

/// Distances by fast marching, see DistanceSolver.
class MarchingDistance {
 public:
  /// @param laplacian with a valid cover
  /// @param split see checkedSplit()
  MarchingDistance(const Laplacian& laplacian, int split, const DistanceOptions& options);

  /// Computes the nearest of some sources to each point.
  /// @param sources whose corners are representatives
  /// @param places of the sources in the cover
  /// @param component N; corners without a component, -1, are ignored
  /// @return distances in the points' unit and their sources; not set for coincident points
  NearestSources query(const std::vector<SurfacePoint>& sources, const std::vector<PlaceInCover>& places,
                       const std::vector<int>& component, const Progress& progress, DistanceReport& report) const;
  const SolverReport& report() const { return report_; }

 private:
  SourcePositions positionsOf(const std::vector<SurfacePoint>& sources) const;
  void startAt(const PlaceInCover& place, const std::vector<int>& component, std::vector<MarchStart>& starts) const;
  void startInFaces(const PlaceInCover& place, std::vector<MarchStart>& starts) const;
  struct CoverFace;
  void startIn(const CoverFace& whole, const std::array<double, 3>& weights, int source,
               std::vector<MarchStart>& starts) const;
  CoverFace coverFace(int face) const;

  std::vector<int> number_;  ///< number of each point in `faces_`
  MarchFaces faces_;
  int vertices_;
  int split_;
  double maximum_;
  int threads_;
  SolverReport report_;
};

}  // namespace tufted
