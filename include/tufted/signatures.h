#pragma once

#include <Eigen/Core>
#include <functional>

#include "tufted/laplacian.h"
#include "tufted/spectrum.h"
#include "tufted/types.h"

namespace tufted {

// Signatures, embeddings and filters from a few eigenpairs, values lambda_i and vectors phi_i. Signatures and
// embeddings are 0 at points that take no part, as eigenvectors are; coincident points have those of their
// representative.

/// Times at which the pairs of a spectrum suffice for heatKernelSignature(), evenly spaced on a logarithmic scale as in
/// Sun et al. (2009): from 4 ln 10 / (the largest eigenvalue) to 4 ln 10 / (the smallest positive one).
/// @param count >= 1; a single time is the geometric mean of these two
/// @return `count` times, ascending, length^2
/// @throws InvalidInput for count < 1 or a spectrum without a positive eigenvalue
VectorXd heatTimes(const Spectrum& spectrum, int count = 16);

/// The heat kernel signature of J. Sun, M. Ovsjanikov and L. Guibas, "A concise and provably informative multi-scale
/// signature based on heat diffusion" (2009): sum over i of exp(-lambda_i t) phi_i(x)^2, the heat that is left at x
/// after a time t. Terms of eigenvalues beyond the spectrum are missing, which matters at times below those of
/// heatTimes().
/// @param times T values >= 0, length^2
/// @return N x T, 1 / length^2
/// @throws InvalidInput for times that are negative or not finite
Eigen::MatrixXd heatKernelSignature(const Spectrum& spectrum, const VectorXd& times);
/// The heat kernel signature from a spectrum of positive eigenvalues alone (SpectrumOptions::null_space = false): adds
/// the term of the null space, 1 / area of the point's connected component at all times.
/// @param spectrum of `laplacian`
/// @param times T values >= 0, length^2
/// @return N x T, 1 / length^2
/// @throws InvalidInput for times that are negative or not finite, arrays of the wrong size, or a spectrum with the
/// eigenvalue 0
Eigen::MatrixXd heatKernelSignature(const Laplacian& laplacian, const Spectrum& spectrum, const VectorXd& times);

/// Energies for waveKernelSignature(), evenly spaced from log(smallest positive eigenvalue) to log(largest).
/// @param count >= 2
/// @return `count` natural logarithms of eigenvalues, ascending
/// @throws InvalidInput for count < 2 or a spectrum without a positive eigenvalue
VectorXd waveEnergies(const Spectrum& spectrum, int count = 100);

/// The wave kernel signature of M. Aubry, U. Schlickewei and D. Cremers, "The wave kernel signature: a quantum
/// mechanical approach to shape analysis" (2011): the mean of phi_i(x)^2 over positive eigenvalues with the weights
/// exp(-(e - log lambda_i)^2 / (2 width^2)).
/// @param energies E natural logarithms of eigenvalues
/// @param width standard deviation of the energy, > 0; Aubry et al. take seven times the distance between energies
/// @return N x E, 1 / length^2
/// @throws InvalidInput for energies that are not finite, a width out of range, or a spectrum without a positive
/// eigenvalue
Eigen::MatrixXd waveKernelSignature(const Spectrum& spectrum, const VectorXd& energies, double width);

/// The wave kernel signature at waveEnergies(spectrum, count), with a width of seven times the distance between these,
/// and at least 1e-8.
/// @return N x count, 1 / length^2
/// @throws InvalidInput for count < 2 or a spectrum without a positive eigenvalue
Eigen::MatrixXd waveKernelSignature(const Spectrum& spectrum, int count = 100);

/// Coordinates between which Euclidean distances are a spectral distance; one column per positive eigenvalue.
enum class Embedding {
  commute,    ///< phi_i / sqrt(lambda_i): commute times, and the global point signature of Rustamov (2007)
  biharmonic  ///< phi_i / lambda_i: the biharmonic distance of Lipman et al. (2010)
};

/// Places each point in space so that Euclidean distances are spectral distances, one coordinate per positive
/// eigenvalue.
/// @return N x (number of positive eigenvalues); no unit with `commute`, length with `biharmonic`
Eigen::MatrixXd spectralEmbedding(const Spectrum& spectrum, Embedding embedding = Embedding::commute);

/// Filters signals by their frequencies: sum over i of gain(lambda_i) phi_i (phi_i^T M f). Frequencies beyond the
/// spectrum are removed. Points that are not finite or isolated keep their value; coincident points get that of their
/// representative.
/// @param signals N x c; values of points that are not active are ignored
/// @param gain factor for an eigenvalue in 1 / length^2; empty: 1 for all, a low-pass filter
/// @return N x c
/// @throws InvalidInput for arrays of the wrong size, signals that are not finite at active points, or a gain that is
/// not finite
/// @throws SolverFailure when sums of signals overflow
Eigen::MatrixXd filterSignals(const Laplacian& laplacian, const Spectrum& spectrum,
                              const Eigen::Ref<const Eigen::MatrixXd>& signals,
                              const std::function<double(double)>& gain = {});

}  // namespace tufted
