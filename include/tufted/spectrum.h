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
  /// theta = 1 / lambda. The relative error of an eigenvalue is about its square. The residual of every pair returned
  /// (see SpectrumReport) is at most ten times this plus 16 times what rounding of L x explains, eps ||L| |x|| /
  /// (lambda |M x|). Where rounding leaves a residual above both 1e-8 and ten times this, SpectrumReport::weak_pair
  /// says so, and the eigenvalue is x^T L x summed up by differences.
  double tolerance = 1e-10;
  /// Up to this many points, >= 0, dense matrices replace the iterative search if k is above 0.3 times the number of
  /// points, or if there are at most 150 points. Dense matrices take 24 bytes per pair of points, which `memory_limit`
  /// bounds as well, and time that grows with the cube of the points and cannot be cancelled (3,000 points take 220 MB
  /// and one to two minutes). Before they start, `progress` gets a stage such as "dense, about 108 s".
  int dense_limit = 3000;
  bool null_space = true;     ///< false: leaves out the eigenvalues 0 and returns the k smallest positive ones
  int max_iterations = 1000;  ///< iterations of eight solves each, >= 1; SolverFailure if they do not suffice
  SolverMethod method = SolverMethod::automatic;  ///< how systems with L are solved
  std::size_t memory_limit = 0;                   ///< bytes that a factor may take, see SolverOptions
  int threads = 0;                                ///< at most this many threads; 0: one per processor
  Progress progress = {};                         ///< called while eigenpairs are found
};

/// Accuracy and cost of a spectrum.
struct SpectrumReport {
  std::string method;         ///< "block Lanczos" or "dense"; empty if only constants were asked for
  int null_space = 0;         ///< eigenvalues returned that are exactly 0, one per connected component that has an area
  int iterations = 0;         ///< iterations of block Lanczos, eight solves each; 0 with dense matrices
  bool counted = false;       ///< whether it is certain that no eigenvalue is missing, by Sylvester's law of inertia or
                              ///< by dense matrices
  double residual = 0;        ///< greatest |L x - lambda M x| / (lambda |M x|) of any lambda > 0, Euclidean norms
  double backward_error = 0;  ///< greatest |L x - lambda M x| / (||L| |x|| + lambda |M x|) of any lambda > 0
  /// Index of the first pair whose residual is above 1e-8 by rounding alone; -1: none. L is then nearly disconnected
  /// between the points where the vector of that pair is positive and those where it is negative: no vector of doubles
  /// has a smaller residual.
  int weak_pair = -1;
  double orthogonality = 0;  ///< greatest |entry| of the Gram matrix X^T M X minus the identity
  double seconds = 0;        ///< wall-clock, including the time to make the solver
  SolverReport solver;       ///< how systems with L were solved
};

/// The k smallest eigenvalues of L x = lambda M x and their eigenvectors.
struct Spectrum {
  VectorXd values;          ///< k eigenvalues, ascending; 1 / length^2
  Eigen::MatrixXd vectors;  ///< N x k, one per column, X^T M X = I; 1 / length
  SpectrumReport report;    ///< accuracy and cost
};

/// Finds the k smallest eigenpairs of L x = lambda M x (Sharp and Crane 2020, Section 5.3), by Lanczos' method on the
/// inverse with blocks of vectors or, if a large share of all pairs is asked for, by dense matrices.
///
/// The null space is exact: eigenvalue 0, and for each connected component the function that is constant there and 0
/// elsewhere, components of larger area first. All other vectors have sum(M x) = 0 on each component. The sign of a
/// vector is such that its largest entry is positive; of entries within a part in 10^6 of it, the first decides.
/// Multiple eigenvalues come with their multiplicity and some basis of their eigenspace. The result has the same bits
/// for any number of threads.
///
/// Coincident points have the values of their representative; points that are not finite or isolated, and components
/// whose areas all underflow, have 0.
/// @param k >= 1, at most mostEigenpairs(): the number of active points of positive area, without the null space less
/// the number of components of positive area
/// @throws InvalidInput for k or options out of range, arrays of the wrong size, or an M that is negative or not finite
/// @throws SolverFailure when L cannot be factorised, the iterations do not suffice, a pair, which the message names,
/// keeps a residual above what SpectrumOptions::tolerance allows, or areas are so small that an eigenvalue exceeds the
/// largest double
/// @throws Cancelled when `options.progress` returns false
Spectrum spectrum(const Laplacian& laplacian, int k, const SpectrumOptions& options = {});

/// The largest k that spectrum() takes; 0 if there is none.
/// @param null_space see SpectrumOptions::null_space
/// @throws InvalidInput for arrays of the wrong size, or an M that is negative or not finite
int mostEigenpairs(const Laplacian& laplacian, bool null_space = true);

}  // namespace tufted
