#include "mpi/linear_solve.h"

#include <petscksp.h>

#include <string>

#include "base/number_text.h"
#include "mpi/petsc.h"
#include "mpi/point_values.h"
#include "mpi/rows.h"

namespace tufted {
namespace {

using LinearSolver = PetscHandle<KSP, KSPDestroy>;

/// Greatest relative residual of a system that counts as solved.
constexpr double most_residual = 1e-8;

/// Tells PETSc, while it lives, that the functions that are constant on each component are the null space of L:
/// conjugate gradients then remove what rounding adds there in every iteration, and would fail otherwise.
class NullSpace {
 public:
  explicit NullSpace(const DistributedLaplacian& laplacian)
      : laplacian_(laplacian), rows_(sumsOf(laplacian, std::vector<double>(laplacian.point.size(), 1))) {
    check(MatNullSpaceCreate(commOf(laplacian), PETSC_FALSE, 0, nullptr, space_.make()));
    check(MatNullSpaceSetFunction(space_.get(), remove, this));
    check(MatSetNullSpace(laplacian.L.get(), space_.get()));
  }
  ~NullSpace() { MatSetNullSpace(laplacian_.L.get(), nullptr); }
  NullSpace(const NullSpace&) = delete;
  NullSpace& operator=(const NullSpace&) = delete;

 private:
  static PetscErrorCode remove(MatNullSpace, Vec vector, void* self) {
    const auto& [laplacian, rows, space] = *static_cast<const NullSpace*>(self);
    std::vector<double> values = localOf(vector);
    const std::vector<double> sums = sumsOf(laplacian, values);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const PetscInt c = laplacian.component[i];
      values[i] -= sums[c] / rows[c];
    }
    setLocal(vector, values);
    return 0;
  }

  const DistributedLaplacian& laplacian_;
  const std::vector<double> rows_;  ///< of each component
  PetscHandle<MatNullSpace, MatNullSpaceDestroy> space_;
};

/// Solves A u = b and checks the residual.
void solve(const char* function, Mat A, Mat preconditioned, Vec b, Vec u, DistributedSolve* report) {
  MPI_Comm comm = MPI_COMM_NULL;
  check(PetscObjectGetComm(reinterpret_cast<PetscObject>(A), &comm));
  LinearSolver solver;
  check(KSPCreate(comm, solver.make()));
  check(KSPSetOperators(solver.get(), A, preconditioned));
  check(KSPSetType(solver.get(), KSPCG));
  check(KSPSetNormType(solver.get(), KSP_NORM_UNPRECONDITIONED));
  check(KSPSetTolerances(solver.get(), 1e-10, PETSC_DEFAULT, PETSC_DEFAULT, 500));
  PC preconditioner = nullptr;
  check(KSPGetPC(solver.get(), &preconditioner));
  check(PCSetType(preconditioner, PCHYPRE));
  check(KSPSetFromOptions(solver.get()));
  check(KSPSolve(solver.get(), b, u));

  PetscVector rest = like(b);
  check(MatMult(A, u, rest.get()));
  check(VecAYPX(rest.get(), -1, b));
  const double norm = normOf(b);
  PetscInt iterations = 0;
  check(KSPGetIterationNumber(solver.get(), &iterations));
  DistributedSolve made;
  made.iterations = static_cast<int>(iterations);
  made.residual = norm == 0 ? 0 : normOf(rest.get()) / norm;
  if (!(made.residual <= most_residual))
    throw SolverFailure(std::string(function) + ": the residual is " + numberText(made.residual) + " after " +
                        std::to_string(made.iterations) + " iterations, must be at most " + numberText(most_residual));
  if (report != nullptr) *report = made;
}

}  // namespace

double greatestOf(Vec vector) {
  PetscReal greatest = 0;
  check(VecNorm(vector, NORM_INFINITY, &greatest));
  return greatest;
}

void subtractMeans(const DistributedLaplacian& laplacian, Vec vector) {
  const std::vector<double> areas = localOf(laplacian.M.get());
  std::vector<double> values = localOf(vector), products(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) products[i] = areas[i] * values[i];
  const std::vector<double> all_areas = sumsOf(laplacian, areas), sums = sumsOf(laplacian, products);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const PetscInt c = laplacian.component[i];
    if (all_areas[c] > 0) values[i] -= sums[c] / all_areas[c];
  }
  setLocal(vector, values);
}

void solveDefinite(const char* function, Mat A, Vec b, Vec u, DistributedSolve* report) {
  solve(function, A, A, b, u, report);
}

void solveLaplacian(const char* function, const DistributedLaplacian& laplacian, Vec b, Vec u,
                    DistributedSolve* report) {
  const NullSpace null_space(laplacian);
  solve(function, laplacian.L.get(), definiteOf(laplacian).get(), b, u, report);
  subtractMeans(laplacian, u);
}

}  // namespace tufted
