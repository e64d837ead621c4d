#include "mpi/point_values.h"

#include <petscis.h>

#include <algorithm>

#include "mpi/petsc.h"
#include "tufted/mpi/distributed_laplacian.h"

namespace tufted {

std::vector<double> localOf(Vec vector) {
  PetscInt size = 0;
  const PetscScalar* values = nullptr;
  check(VecGetLocalSize(vector, &size));
  check(VecGetArrayRead(vector, &values));
  std::vector<double> result(values, values + size);
  check(VecRestoreArrayRead(vector, &values));
  return result;
}

void setLocal(Vec vector, const std::vector<double>& values) {
  PetscScalar* entries = nullptr;
  check(VecGetArray(vector, &entries));
  std::copy(values.begin(), values.end(), entries);
  check(VecRestoreArray(vector, &entries));
}

std::vector<double> valuesAt(Vec vector, const std::vector<std::int64_t>& numbers) {
  const std::vector<PetscInt> wanted(numbers.begin(), numbers.end());
  PetscVector result;
  check(VecCreateSeq(PETSC_COMM_SELF, static_cast<PetscInt>(wanted.size()), result.make()));
  PetscHandle<IS, ISDestroy> from;
  check(ISCreateGeneral(PETSC_COMM_SELF, static_cast<PetscInt>(wanted.size()), wanted.data(), PETSC_USE_POINTER,
                        from.make()));
  PetscHandle<VecScatter, VecScatterDestroy> scatter;
  check(VecScatterCreate(vector, from.get(), result.get(), nullptr, scatter.make()));
  check(VecScatterBegin(scatter.get(), vector, result.get(), INSERT_VALUES, SCATTER_FORWARD));
  check(VecScatterEnd(scatter.get(), vector, result.get(), INSERT_VALUES, SCATTER_FORWARD));
  return localOf(result.get());
}

void setAt(Vec vector, const std::vector<std::int64_t>& numbers, const std::vector<double>& values, InsertMode mode) {
  const std::vector<PetscInt> places(numbers.begin(), numbers.end());
  check(VecSetValues(vector, static_cast<PetscInt>(places.size()), places.data(), values.data(), mode));
  check(VecAssemblyBegin(vector));
  check(VecAssemblyEnd(vector));
}

}  // namespace tufted
