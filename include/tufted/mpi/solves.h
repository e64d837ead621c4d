#pragma once

#include <petscvec.h>

#include <vector>

#include "tufted/mpi/distributed_laplacian.h"

// A mistake that one process alone makes, such as a row out of range, throws in that process alone, while others wait:
// end all with MPI_Abort() then.

namespace tufted {

/// How systems or eigenpairs of a DistributedLaplacian were solved.
struct DistributedSolve {
  int iterations = 0;   ///< of conjugate gradients, or of the eigensolver
  double residual = 0;  ///< |L u - b| / |b|; of eigenpairs the greatest |L x - lambda M x| / (lambda |M x|), lambda > 0
};

/// Solves Poisson's equation L u = M f, see poisson(): the mean of f on each component, weighted by M, is subtracted,
/// and u has mean 0 there. By conjugate gradients with hypre's algebraic multigrid; options of PETSc's KSP and PC
/// change that. Collective.
/// @param f one value per row
/// @throws InvalidInput for an f of another size, or that is not finite
/// @throws SolverFailure if the residual ends above 1e-8
PetscVector poisson(const DistributedLaplacian& laplacian, Vec f, DistributedSolve* report = nullptr);

/// The harmonic function with given values at some rows, see harmonic(). Components without a given value are NaN. By
/// conjugate gradients with hypre's algebraic multigrid. Collective.
/// @param rows rows of L with a given value, from any process; several values of one row count as their mean
/// @param values one per entry of `rows`
/// @throws InvalidInput if no process gives a value, for rows out of range, and for values that are not finite or not
/// as many as rows
/// @throws SolverFailure if the residual ends above 1e-8
PetscVector harmonic(const DistributedLaplacian& laplacian, const std::vector<PetscInt>& rows,
                     const std::vector<double>& values, DistributedSolve* report = nullptr);

/// The geodesic distance from the nearest of some rows by the heat method, see DistanceSolver: infinite on components
/// without a source. Heat is solved for in windows by conjugate gradients, some 10 edges in a round, and L d = div X by
/// conjugate gradients with hypre's algebraic multigrid. Collective.
/// @param laplacian built with TileOptions::faces
/// @param sources rows of L, from any process
/// @return one value >= 0 per row, in the points' unit
/// @throws InvalidInput for a Laplacian without faces, if no process gives a source, and for rows out of range
/// @throws SolverFailure if the residual ends above 1e-8
PetscVector distance(const DistributedLaplacian& laplacian, const std::vector<PetscInt>& sources,
                     DistributedSolve* report = nullptr);

/// Eigenpairs of L x = lambda M x.
struct DistributedSpectrum {
  std::vector<double> values;        ///< ascending, in 1 / length^2
  std::vector<PetscVector> vectors;  ///< one value per row each, X^T M X = I
  DistributedSolve report;           ///< accuracy and cost
};

/// The eigenpairs of the k smallest positive eigenvalues, see spectrum(). By SLEPc's LOBPCG with hypre's algebraic
/// multigrid; options of SLEPc's EPS change that. SLEPc must be initialised. Collective.
/// @param k in [1, n / 3]
/// @param tolerance in (0, 1), on the residual of DistributedSolve
/// @throws InvalidInput for k or tolerance out of range, and for more than 100 components
/// @throws SolverFailure if a residual ends above ten times the tolerance
DistributedSpectrum spectrum(const DistributedLaplacian& laplacian, int k, double tolerance = 1e-9);

}  // namespace tufted
