#include "mpi/rows.h"

#include <algorithm>

#include "mpi/petsc.h"
#include "mpi/point_values.h"

namespace tufted {
namespace {

/// Share of 1 / area, which has the unit of an eigenvalue, that is added to a singular matrix for its preconditioner.
constexpr double shift_share = 1e-3;

}  // namespace

MPI_Comm commOf(const DistributedLaplacian& laplacian) {
  MPI_Comm comm = MPI_COMM_NULL;
  check(PetscObjectGetComm(reinterpret_cast<PetscObject>(laplacian.M.get()), &comm));
  return comm;
}

PetscVector like(Vec vector) {
  PetscVector result;
  check(VecDuplicate(vector, result.make()));
  return result;
}

double normOf(Vec vector) {
  PetscReal norm = 0;
  check(VecNorm(vector, NORM_2, &norm));
  return norm;
}

std::vector<double> sumsOf(const DistributedLaplacian& laplacian, const std::vector<double>& values) {
  std::vector<double> sums(static_cast<std::size_t>(laplacian.components));
  for (std::size_t i = 0; i < values.size(); ++i) sums[laplacian.component[i]] += values[i];
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, commOf(laplacian));
  return sums;
}

std::vector<double> greatestOfComponents(const DistributedLaplacian& laplacian, const std::vector<int>& rows,
                                         const std::vector<double>& values, double none) {
  std::vector<double> greatest(static_cast<std::size_t>(laplacian.components), none);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    double& value = greatest[laplacian.component[rows[k]]];
    value = std::max(value, values[k]);
  }
  MPI_Allreduce(MPI_IN_PLACE, greatest.data(), static_cast<int>(greatest.size()), MPI_DOUBLE, MPI_MAX,
                commOf(laplacian));
  return greatest;
}

PetscMatrix definiteOf(const DistributedLaplacian& laplacian) {
  PetscMatrix result;
  check(MatDuplicate(laplacian.L.get(), MAT_COPY_VALUES, result.make()));
  PetscVector diagonal = like(laplacian.M.get());
  check(MatGetDiagonal(laplacian.L.get(), diagonal.get()));
  const std::vector<double> areas = localOf(laplacian.M.get());
  std::vector<double> values = localOf(diagonal.get());
  const double shift = shift_share / laplacian.report.area;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = values[i] > 0 ? values[i] + shift * areas[i] : 1;
  setLocal(diagonal.get(), values);
  check(MatDiagonalSet(result.get(), diagonal.get(), INSERT_VALUES));
  return result;
}

}  // namespace tufted
