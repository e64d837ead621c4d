#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "algorithms/connected.h"
#include "algorithms/geodesic_windows.h"
#include "base/cover_source.h"
#include "tufted/laplacian.h"
#include "tufted/types.h"

namespace tufted {

/// Directions and lengths of the shortest paths from a point, see LogMapSolver.
class ExactLogMap {
 public:
  struct Result {
    VectorXd distance;  ///< infinite where no path leads
    VectorXd angle;     ///< of the direction at the source, from the tangent of its frame
  };

  /// @param laplacian with positions and a valid cover
  /// @throws Cancelled when `progress` returns false
  ExactLogMap(const Laplacian& laplacian, const Frames& frames, const Progress& progress);
  /// @param source an active representative
  /// @return of the representatives
  Result query(int source, const Progress& progress) const;
  /// Memory without the cover of a mesh, which is shared with the Laplacian.
  std::size_t bytes() const;

 private:
  const IntrinsicTriangulation& surface() const { return cover_ ? cover_->cover() : triangles_; }
  Eigen::Vector2d inPlane(int source, const Eigen::RowVector3d& offset) const;
  double angleAlong(int source, const Sector& sector, double angle) const;
  std::vector<double> anglesOf(int source, const GeodesicWindows& windows) const;
  void extend(int source, Result& result) const;

  SparseMatrix L_;
  Points positions_;
  Frames frames_;
  Components components_;
  int exponent_;
  std::shared_ptr<const CoverSource> cover_;  ///< of a mesh
  IntrinsicTriangulation triangles_;          ///< of a cloud
};

}  // namespace tufted
