#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>

#include "tufted/laplacian.h"
#include "tufted/options.h"
#include "tufted/solver.h"
#include "tufted/types.h"

namespace tufted {

/// Options of spectrum().
struct SpectrumOptions {
  /// Tolerance in (0, 1) on |A x - theta x| / theta in the norm of M, where A is the inverse of L applied after M and
  /// theta = 1 / lambda. The error of an eigenvalue is about its square. spectrum() returns no pair whose residual, as
  /// in SpectrumReport, is above ten times this plus 16 times what rounding of L x leaves, eps ||L| |x|| /
  /// (lambda |M x|). If a residual is above both 1e-8 and ten times this, the report says so, and the eigenvalue is
  /// x^T L x summed up by differences.
  double tolerance = 1e-10;
  /// Most points, >= 0, for which dense matrices replace the iterative search. They do so for k above three tenths of
  /// the points, and for up to 150 points. They take 24 bytes per pair of points, which `memory_limit` bounds as well,
  /// and a time that grows with the cube of the points and cannot be interrupted (3,000 points take 220 MB and about a
  /// minute).
  int dense_limit = 3000;
  bool null_space = true;     ///< false: only positive eigenvalues, the k smallest
  int max_iterations = 1000;  ///< iterations of eight solves each, >= 1; SolverFailure if they do not suffice
  SolverMethod method = SolverMethod::automatic;  ///< how systems with L are solved
  std::size_t memory_limit = 0;                   ///< bytes that a factor may take, as in SolverOptions
  int threads = 0;                                ///< at most this many; 0: one per processor
  Progress progress = {};                         ///< called while pairs are found
};

/// What finding a spectrum did.
struct SpectrumReport {
  std::string method;         ///< "block Lanczos" or "dense"; empty if only constants were asked for
  int null_space = 0;         ///< eigenvalues that are exactly 0: one for each connected component that has an area
  int iterations = 0;         ///< iterations of block Lanczos, eight solves each; 0 with dense matrices
  bool counted = false;       ///< certainly no eigenvalue is missing: counted by Sylvester's law of inertia, or dense
  double residual = 0;        ///< greatest |L x - lambda M x| / (lambda |M x|), Euclidean norms, of lambda > 0
  double backward_error = 0;  ///< greatest |L x - lambda M x| / (||L| |x|| + lambda |M x|), of lambda > 0
  /// The first pair whose residual is above 1e-8 by rounding alone; -1: none. L is nearly disconnected between the
  /// points where the vector of that pair is above 0 and those where it is below: no vector of doubles has a smaller
  /// residual.
  int weak_pair = -1;
  double orthogonality = 0;  ///< greatest |entry| of the Gram matrix X^T M X minus the identity
  double seconds = 0;        ///< wall-clock, including the time to make the solver
  SolverReport solver;       ///< the solver of the systems with L
};

/// The k smallest eigenvalues of L x = lambda M x, which have the unit of 1 / area.
struct Spectrum {
  VectorXd values;          ///< k, ascending; 1 / length^2
  Eigen::MatrixXd vectors;  ///< N x k, X^T M X = I; 1 / length
  SpectrumReport report;    ///< how they were found
};

/// Finds the first k eigenpairs of L x = lambda M x (Sharp and Crane 2020, Section 5.3), by Lanczos' method on the
/// inverse with blocks of vectors or, if most pairs are wanted, by dense matrices.
///
/// The null space is exact: eigenvalue 0, and for each connected component the function that is constant there and 0
/// elsewhere, components of larger area first. All other vectors have sum(M x) = 0 on each component. The sign of a
/// vector is such that its largest entry is positive; among entries within a part in 10^6 of it, the first decides.
/// Multiple eigenvalues come as often as they occur, with some basis of their space. The same bits result for any
/// number of threads.
///
/// Coincident points have the values of their representative; points that are not finite or isolated, and components
/// whose areas all underflow, have 0.
/// @param k >= 1, at most the number of active points of positive area; without the null space, at most that minus the
///        number of components of positive area
/// @throws InvalidInput for k or options out of range, arrays of the wrong size, or an M that is negative or not finite
/// @throws SolverFailure when L cannot be factorised, the iterations do not suffice, or a pair, which it names, keeps a
///         residual above what SpectrumOptions::tolerance says, or areas are so small that an eigenvalue is above the
///         largest double
/// @throws Cancelled when `options.progress` returns false
Spectrum spectrum(const Laplacian& laplacian, int k, const SpectrumOptions& options = {});

/// The largest k that spectrum() takes, 0 if it takes none.
/// @param null_space as SpectrumOptions::null_space
/// @throws InvalidInput for arrays of the wrong size, or an M that spectrum() refuses
int mostEigenpairs(const Laplacian& laplacian, bool null_space = true);

}  // namespace tufted
