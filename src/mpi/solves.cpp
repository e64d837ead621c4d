#include "tufted/mpi/solves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/number_text.h"
#include "mpi/linear_solve.h"
#include "mpi/petsc.h"
#include "mpi/point_values.h"
#include "mpi/rows.h"

namespace tufted {
namespace {

void requireFinite(const DistributedLaplacian& laplacian, const char* function, const char* name, Vec vector) {
  const std::vector<double> values = localOf(vector);
  int is_finite = std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); }) ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &is_finite, 1, MPI_INT, MPI_MIN, commOf(laplacian));
  if (is_finite == 0) throw InvalidInput(std::string(function) + ": " + name + " must be finite");
}

}  // namespace

PetscVector poisson(const DistributedLaplacian& laplacian, Vec f, DistributedSolve* report) {
  PetscInt given = 0, size = 0;
  check(VecGetLocalSize(f, &given));
  check(VecGetLocalSize(laplacian.M.get(), &size));
  if (given != size)
    throw InvalidInput("poisson: f has " + std::to_string(given) + " values on a process, must have " +
                       std::to_string(size));
  requireFinite(laplacian, "poisson", "f", f);
  PetscVector b = like(f), u = like(f);
  check(VecSet(u.get(), 0));
  check(VecCopy(f, b.get()));
  subtractMeans(laplacian, b.get());
  subtractMeans(laplacian, b.get());  // what rounding has left of the first means
  const double greatest = greatestOf(b.get());
  if (report != nullptr) *report = {};
  if (greatest <= std::numeric_limits<double>::epsilon() * greatestOf(f)) return u;  // f is constant

  // With a right side of size 1 neither squares nor products under- or overflow in any unit.
  const double area = laplacian.report.area / static_cast<double>(laplacian.report.active);
  check(VecScale(b.get(), 1 / greatest));
  check(VecPointwiseMult(b.get(), laplacian.M.get(), b.get()));
  check(VecScale(b.get(), 1 / area));
  solveLaplacian("poisson", laplacian, b.get(), u.get(), report);
  check(VecScale(u.get(), greatest * area));
  return u;
}

PetscVector harmonic(const DistributedLaplacian& laplacian, const std::vector<PetscInt>& rows,
                     const std::vector<double>& values, DistributedSolve* report) {
  PetscInt first = 0, size = 0;
  check(VecGetSize(laplacian.M.get(), &size));
  check(VecGetOwnershipRange(laplacian.M.get(), &first, nullptr));
  if (values.size() != rows.size())
    throw InvalidInput("harmonic: " + std::to_string(values.size()) + " values, must be " +
                       std::to_string(rows.size()) + ", one per row");
  for (const PetscInt row : rows)
    if (row < 0 || row >= size)
      throw InvalidInput("harmonic: row " + std::to_string(row) + ", must be in [0, " + std::to_string(size) + ")");
  // How many values each row has, and their sum, which travel to the process of the row.
  PetscVector counts = like(laplacian.M.get()), u = like(laplacian.M.get()), b = like(laplacian.M.get());
  const std::vector<std::int64_t> numbers(rows.begin(), rows.end());
  check(VecSet(counts.get(), 0));
  setAt(counts.get(), numbers, std::vector<double>(rows.size(), 1), ADD_VALUES);
  check(VecSet(u.get(), 0));
  setAt(u.get(), numbers, values, ADD_VALUES);
  requireFinite(laplacian, "harmonic", "values", u.get());
  const std::vector<double> is_given = localOf(counts.get());
  const std::vector<double> given = sumsOf(laplacian, is_given);
  if (std::none_of(given.begin(), given.end(), [](double count) { return count > 0; }))
    throw InvalidInput("harmonic: no row has a given value, must be at least one");
  std::vector<double> means = localOf(u.get());
  for (std::size_t i = 0; i < means.size(); ++i) means[i] /= std::max(1.0, is_given[i]);
  setLocal(u.get(), means);
  const double greatest = greatestOf(u.get());
  if (greatest > 0) check(VecScale(u.get(), 1 / greatest));  // squares do not underflow

  std::vector<PetscInt> fixed;
  for (std::size_t i = 0; i < is_given.size(); ++i)
    if (is_given[i] > 0 || given[laplacian.component[i]] == 0) fixed.push_back(first + static_cast<PetscInt>(i));
  PetscMatrix A;
  check(MatDuplicate(laplacian.L.get(), MAT_COPY_VALUES, A.make()));
  check(VecSet(b.get(), 0));
  check(MatZeroRowsColumns(A.get(), static_cast<PetscInt>(fixed.size()), fixed.data(), 1, u.get(), b.get()));
  solveDefinite("harmonic", A.get(), b.get(), u.get(), report);
  std::vector<double> result = localOf(u.get());
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = given[laplacian.component[i]] == 0 ? std::nan("") : result[i] * greatest;
  setLocal(u.get(), result);
  return u;
}

}  // namespace tufted
