#include <slepceps.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/number_text.h"
#include "mpi/petsc.h"
#include "mpi/point_values.h"
#include "mpi/rows.h"
#include "tufted/mpi/solves.h"

namespace tufted {
namespace {

using EigenSolver = PetscHandle<EPS, EPSDestroy>;

/// Each component takes a vector that all others are made orthogonal to.
constexpr PetscInt most_components = 100;

/// The functions that are constant on one component and 0 on the others.
std::vector<PetscVector> constants(const DistributedLaplacian& laplacian) {
  std::vector<PetscVector> result;
  for (PetscInt c = 0; c < laplacian.components; ++c) {
    std::vector<double> values(laplacian.component.size());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = laplacian.component[i] == c ? 1 : 0;
    result.push_back(like(laplacian.M.get()));
    setLocal(result.back().get(), values);
  }
  return result;
}

/// |L x - lambda M x| / (lambda |M x|)
double residualOf(const DistributedLaplacian& laplacian, double value, Vec x) {
  PetscVector left = like(x), right = like(x);
  check(MatMult(laplacian.L.get(), x, left.get()));
  check(VecPointwiseMult(right.get(), laplacian.M.get(), x));
  check(VecAXPY(left.get(), -value, right.get()));
  return normOf(left.get()) / (value * normOf(right.get()));
}

}  // namespace

DistributedSpectrum spectrum(const DistributedLaplacian& laplacian, int k, double tolerance) {
  PetscInt size = 0, own = 0;
  check(VecGetSize(laplacian.M.get(), &size));
  check(VecGetLocalSize(laplacian.M.get(), &own));
  if (k < 1 || k > size / 3)
    throw InvalidInput("spectrum: k = " + std::to_string(k) + ", must be in [1, " + std::to_string(size / 3) +
                       "], a third of the points");
  if (!(tolerance > 0 && tolerance < 1))
    throw InvalidInput("spectrum: tolerance = " + numberText(tolerance) + ", must be in (0, 1)");
  if (laplacian.components > most_components)
    throw InvalidInput("spectrum: the surface has " + std::to_string(laplacian.components) +
                       " components, must have at most " + std::to_string(most_components) +
                       ": leave out points far from the surface");
  DistributedSpectrum result;
  const MPI_Comm comm = commOf(laplacian);
  // With masses of mean 1 the residual that SLEPc looks at is that of DistributedSolve, about.
  const double mean = laplacian.report.area / size;
  PetscMatrix masses;
  check(MatCreateAIJ(comm, own, own, PETSC_DETERMINE, PETSC_DETERMINE, 1, nullptr, 0, nullptr, masses.make()));
  check(MatDiagonalSet(masses.get(), laplacian.M.get(), INSERT_VALUES));
  check(MatScale(masses.get(), 1 / mean));
  EigenSolver solver;
  check(EPSCreate(comm, solver.make()));
  check(EPSSetOperators(solver.get(), laplacian.L.get(), masses.get()));
  check(EPSSetProblemType(solver.get(), EPS_GHEP));
  check(EPSSetType(solver.get(), EPSLOBPCG));
  check(EPSSetWhichEigenpairs(solver.get(), EPS_SMALLEST_REAL));
  check(EPSSetDimensions(solver.get(), k, PETSC_DEFAULT, PETSC_DEFAULT));
  check(EPSSetTolerances(solver.get(), tolerance, 1000));
  const std::vector<PetscVector> null_space = constants(laplacian);
  std::vector<Vec> deflated;
  for (const PetscVector& vector : null_space) deflated.push_back(vector.get());
  check(EPSSetDeflationSpace(solver.get(), static_cast<PetscInt>(deflated.size()), deflated.data()));
  ST transformation = nullptr;
  KSP inner = nullptr;
  PC preconditioner = nullptr;
  const PetscMatrix definite = definiteOf(laplacian);
  check(EPSGetST(solver.get(), &transformation));
  check(STSetType(transformation, STPRECOND));
  check(STSetPreconditionerMat(transformation, definite.get()));
  check(STGetKSP(transformation, &inner));
  check(KSPSetType(inner, KSPPREONLY));  // one multigrid cycle; a whole solve takes three times as long in all
  check(KSPGetPC(inner, &preconditioner));
  check(PCSetType(preconditioner, PCHYPRE));
  check(EPSSetFromOptions(solver.get()));
  check(EPSSolve(solver.get()));

  PetscInt converged = 0, iterations = 0;
  check(EPSGetConverged(solver.get(), &converged));
  check(EPSGetIterationNumber(solver.get(), &iterations));
  result.report.iterations = static_cast<int>(iterations);
  if (converged < k)
    throw SolverFailure("spectrum: " + std::to_string(converged) + " of " + std::to_string(k) +
                        " positive eigenvalues were found in " + std::to_string(result.report.iterations) +
                        " iterations");
  for (PetscInt i = 0; i < k; ++i) {
    PetscScalar value = 0;
    PetscVector x = like(laplacian.M.get());
    check(EPSGetEigenpair(solver.get(), i, &value, nullptr, x.get(), nullptr));
    value /= mean;
    check(VecScale(x.get(), 1 / std::sqrt(mean)));
    const double residual = residualOf(laplacian, value, x.get());
    if (!(residual <= 10 * tolerance))
      throw SolverFailure("spectrum: the residual of eigenvalue " + numberText(value) + " is " + numberText(residual) +
                          ", must be at most " + numberText(10 * tolerance));
    result.report.residual = std::max(result.report.residual, residual);
    result.values.push_back(value);
    result.vectors.push_back(std::move(x));
  }
  return result;
}

}  // namespace tufted
