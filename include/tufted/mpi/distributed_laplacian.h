#pragma once

#include <petscmat.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "tufted/options.h"
#include "tufted/tiles.h"
#include "tufted/types.h"

namespace tufted {

/// Owns a PETSc object, which must end before PetscFinalize().
template <class Object, PetscErrorCode (*destroy)(Object*)>
class PetscHandle {
 public:
  PetscHandle() = default;
  /// Takes the object of another handle, which has none then.
  PetscHandle(PetscHandle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  /// Exchanges the objects of two handles.
  PetscHandle& operator=(PetscHandle&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~PetscHandle() {
    if (object_ != nullptr) destroy(&object_);
  }

  /// The object, which this handle keeps.
  Object get() const { return object_; }
  /// The place for a function of PETSc that makes the object.
  Object* make() { return &object_; }
  /// Hands the object over to the caller.
  Object release() { return std::exchange(object_, nullptr); }

 private:
  Object object_ = nullptr;
};

using PetscMatrix = PetscHandle<Mat, MatDestroy>;  ///< a matrix
using PetscVector = PetscHandle<Vec, VecDestroy>;  ///< a vector

/// L and M of a cloud, spread over the processes of a communicator. Row i is that of an active point; the rows of a
/// process are consecutive, and those of points near each other.
struct DistributedLaplacian {
  PetscMatrix L;  ///< n x n, positive semidefinite, MATAIJ; L_ij and L_ji may differ in their last bits
  PetscVector M;  ///< n, area of each point, in length^2
  /// By point of the source, its row, or -1 if the point is not active; N values, spread by blocks of points.
  PetscVector row;
  std::vector<std::int64_t> point;  ///< of each row of this process
  std::vector<Boundary> boundary;   ///< of each row of this process
  Points normals;                   ///< of each row of this process, rows x 3, of arbitrary sign
  /// The connected component of each row of this process, from 0 to components - 1; larger areas come first.
  std::vector<PetscInt> component;
  PetscInt components = 0;  ///< number of connected components
  /// With TileOptions::faces: of each row of this process its first face in `faces`; and the end. Otherwise empty.
  std::vector<std::size_t> face_begin;
  std::vector<TileFace> faces;  ///< with TileOptions::faces: those around each row; their corners are rows of L
  /// Pairs (point, representative) of the coincident points that this process has found.
  std::vector<std::pair<std::int64_t, std::int64_t>> coincident;
  TileReport report;  ///< of all processes together; `most_points` is the greatest
};

/// Points of which each process of a communicator has some, as a source that gives all of them to every process. They
/// are counted process by process. A pass is collective.
/// @param points of this process, n x 3, borrowed for the life of the result
PointSource sourceOf(MPI_Comm comm, const PointsRef& points);

/// Builds L and M of a cloud on the processes of a communicator, by tiles: the rows that pointCloudLaplacian() gives,
/// up to rounding. No process holds all points: each writes them to a file of its own and reads its own part of them.
/// Collective. PETSc must be initialised.
/// @param source gives the same points in every process
/// @param options `memory` is that of a build of tiles in each process; the rows of the process come on top, some 200
/// bytes each, and then L. `processes` is not used
/// @throws as laplacianByTiles(), possibly in one process while others wait: end all with MPI_Abort() then
/// @throws InvalidInput for more points than an index of PETSc can count
DistributedLaplacian distributedLaplacian(MPI_Comm comm, const PointSource& source, const TileOptions& options);

/// The values of a vector with one value per row, by point of the source: coincident points have that of their
/// representative, others that are not active `absent`. N values, spread by blocks of points. Collective.
PetscVector valuesByPoint(const DistributedLaplacian& laplacian, Vec values,
                          double absent = std::numeric_limits<double>::quiet_NaN());

/// The values of the rows, from a vector with one value per point of the source. Collective.
PetscVector valuesByRow(const DistributedLaplacian& laplacian, Vec by_point);

/// The rows of some points of the source, -1 for those that are not active; coincident points have that of their
/// representative. Collective.
/// @throws InvalidInput for points outside [0, N)
std::vector<PetscInt> rowsOf(const DistributedLaplacian& laplacian, const std::vector<std::int64_t>& points);

}  // namespace tufted
