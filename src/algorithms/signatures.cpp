// Heat kernel signature (Sun, Ovsjanikov, Guibas 2009), wave kernel signature (Aubry, Schlickewei, Cremers 2011),
// global point signature (Rustamov 2007), biharmonic distance (Lipman et al. 2010) and spectral filters.
#include "tufted/signatures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "algorithms/connected.h"
#include "base/number_text.h"
#include "base/power_of_two.h"
#include "base/require.h"
#include "tufted/check.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Index of the first positive eigenvalue.
Index firstPositive(const Spectrum& spectrum, const char* function) {
  const double* const begin = spectrum.values.data();
  const Index first = std::upper_bound(begin, begin + spectrum.values.size(), 0.0) - begin;
  if (first == spectrum.values.size())
    throw InvalidInput(std::string(function) + ": spectrum has no positive eigenvalue, must have one");
  return first;
}

/// Weighted sums over i of phi_i(x)^2 at each point x, one per column of weights.
MatrixXd sumSquares(const Eigen::Ref<const MatrixXd>& vectors, const MatrixXd& weights) {
  // Rows that are treated together, so that they stay in cache.
  constexpr Index rows_per_block = 1024;
  MatrixXd result(vectors.rows(), weights.cols());
  for (Index begin = 0; begin < vectors.rows(); begin += rows_per_block) {
    const Index size = std::min(rows_per_block, vectors.rows() - begin);
    result.middleRows(begin, size).noalias() = vectors.middleRows(begin, size).cwiseAbs2() * weights;
  }
  return result;
}

/// The exponent of the least power of two above a value; 0 for 0.
int exponentOf(double value) {
  int exponent = 0;
  std::frexp(value, &exponent);
  return exponent;
}

/// The least width of the wave kernel, far above the rounding of logarithms, so that equal eigenvalues get equal
/// weights.
constexpr double least_width = 1e-8;

VectorXd logarithmic(double low, double high, int count) {
  if (count == 1) return VectorXd::Constant(1, std::exp((std::log(low) + std::log(high)) / 2));
  return VectorXd::LinSpaced(count, std::log(low), std::log(high)).array().exp();
}

}  // namespace

VectorXd heatTimes(const Spectrum& spectrum, int count) {
  if (count < 1) throw InvalidInput("heatTimes: count = " + std::to_string(count) + ", must be at least 1");
  const Index first = firstPositive(spectrum, "heatTimes");
  // Times run from where the wave of the last eigenvalue has decayed to 1e-4 to where that of the first positive one
  // has.
  constexpr double decay = 4 * std::numbers::ln10;
  return logarithmic(decay / spectrum.values[spectrum.values.size() - 1], decay / spectrum.values[first], count);
}

MatrixXd heatKernelSignature(const Spectrum& spectrum, const VectorXd& times) {
  for (const double t : times)
    if (!(t >= 0 && std::isfinite(t)))
      throw InvalidInput("heatKernelSignature: a time is " + numberText(t) + ", must be finite and at least 0");
  const MatrixXd weights = (-spectrum.values * times.transpose()).array().exp();
  return sumSquares(spectrum.vectors, weights);
}

MatrixXd heatKernelSignature(const Laplacian& laplacian, const Spectrum& spectrum, const VectorXd& times) {
  const std::string function = "heatKernelSignature";
  checkSizes(function, laplacian);
  if (spectrum.vectors.rows() != std::ssize(laplacian.status))
    throw InvalidInput(function + ": spectrum has " + std::to_string(spectrum.vectors.rows()) + " rows, must have " +
                       std::to_string(laplacian.status.size()) + ", one per point of the Laplacian");
  if (spectrum.values.size() > 0 && !(spectrum.values[0] > 0))
    throw InvalidInput(function + ": spectrum has the eigenvalue 0, must have positive ones alone");
  MatrixXd result = heatKernelSignature(spectrum, times);
  const Components components = findComponents(laplacian);
  const VectorXd areas = components.sums(laplacian.M);
  for (Index i = 0; i < result.rows(); ++i) {
    const int component = components.of[laplacian.representative[i]];
    if (component >= 0 && areas[component] > 0) result.row(i).array() += 1 / areas[component];
  }
  return result;
}

VectorXd waveEnergies(const Spectrum& spectrum, int count) {
  if (count < 2) throw InvalidInput("waveEnergies: count = " + std::to_string(count) + ", must be at least 2");
  const Index first = firstPositive(spectrum, "waveEnergies");
  const double low = std::log(spectrum.values[first]), high = std::log(spectrum.values[spectrum.values.size() - 1]);
  return VectorXd::LinSpaced(count, low, high);
}

MatrixXd waveKernelSignature(const Spectrum& spectrum, const VectorXd& energies, double width) {
  if (!(width > 0 && std::isfinite(width)))
    throw InvalidInput("waveKernelSignature: width = " + numberText(width) + ", must be finite and above 0");
  if (!energies.allFinite()) throw InvalidInput("waveKernelSignature: an energy is not finite, must be");
  const Index first = firstPositive(spectrum, "waveKernelSignature");
  const Index count = spectrum.values.size() - first;
  const VectorXd logarithms = spectrum.values.tail(count).array().log();
  MatrixXd weights(count, energies.size());
  for (Index e = 0; e < energies.size(); ++e) {
    const VectorXd exponents = -((logarithms.array() - energies[e]) / width).square() / 2;
    weights.col(e) =
        (exponents.array() - exponents.maxCoeff()).exp();  // far from all eigenvalues, the nearest one counts
    weights.col(e) /= weights.col(e).sum();
  }
  return sumSquares(spectrum.vectors.rightCols(count), weights);
}

MatrixXd waveKernelSignature(const Spectrum& spectrum, int count) {
  const VectorXd energies = waveEnergies(spectrum, count);
  return waveKernelSignature(spectrum, energies, std::max(7 * (energies[1] - energies[0]), least_width));
}

MatrixXd spectralEmbedding(const Spectrum& spectrum, Embedding embedding) {
  requireChoice(embedding, Embedding::biharmonic, "spectralEmbedding", "embedding");
  const double* const begin = spectrum.values.data();
  const Index first = std::upper_bound(begin, begin + spectrum.values.size(), 0.0) - begin;
  const Index count = spectrum.values.size() - first;
  VectorXd scale = spectrum.values.tail(count).cwiseInverse();
  if (embedding == Embedding::commute) scale = scale.cwiseSqrt().eval();
  return spectrum.vectors.rightCols(count) * scale.asDiagonal();
}

MatrixXd filterSignals(const Laplacian& laplacian, const Spectrum& spectrum, const Eigen::Ref<const MatrixXd>& signals,
                       const std::function<double(double)>& gain) {
  checkSizes("filterSignals", laplacian);
  const auto n = static_cast<Index>(laplacian.status.size());
  const auto require = [n](const char* what, Index rows) {
    if (rows != n)
      throw InvalidInput(std::string("filterSignals: ") + what + " has " + std::to_string(rows) + " rows, must have " +
                         std::to_string(n) + ", one per point of the Laplacian");
  };
  require("spectrum", spectrum.vectors.rows());
  require("signals", signals.rows());
  MatrixXd weighted = MatrixXd::Zero(n, signals.cols());
  for (Index i = 0; i < n; ++i) {
    if (laplacian.status[i] != PointStatus::active) continue;
    weighted.row(i) = signals.row(i);
    if (!signals.row(i).allFinite())
      throw InvalidInput("filterSignals: signals of point " + std::to_string(i) + " are not finite, must be");
  }
  // Signals and areas are scaled near 1 by powers of two, as their products may overflow or underflow.
  const int length = exponentOf(std::sqrt(laplacian.M.sum()));
  const PowerOfTwo per_area(-2 * length);
  std::vector<int> exponent;
  for (Index k = 0; n > 0 && k < weighted.cols(); ++k) {
    exponent.push_back(exponentOf(weighted.col(k).cwiseAbs().maxCoeff()));
    const PowerOfTwo per_signal(-exponent.back());
    for (Index i = 0; i < n; ++i) weighted(i, k) = per_area.times(laplacian.M[i]) * per_signal.times(weighted(i, k));
  }
  MatrixXd coefficients = spectrum.vectors.transpose() * weighted;
  for (Index k = 0; gain && k < coefficients.rows(); ++k) {
    const double factor = gain(spectrum.values[k]);
    if (!std::isfinite(factor))
      throw InvalidInput("filterSignals: gain is " + numberText(factor) + " at the eigenvalue " +
                         numberText(spectrum.values[k]) + ", must be finite");
    coefficients.row(k) *= factor;
  }
  const PowerOfTwo per_length(length);
  for (double& value : coefficients.reshaped()) value = per_length.times(value);
  MatrixXd result = spectrum.vectors * coefficients;
  for (Index k = 0; n > 0 && k < result.cols(); ++k) {
    const PowerOfTwo signal(length + exponent[static_cast<std::size_t>(k)]);
    for (double& value : result.col(k)) value = signal.times(value);
    if (!result.col(k).allFinite()) throw SolverFailure("filterSignals: sums of signals overflow; scale them down");
  }
  for (Index i = 0; i < n; ++i) {
    const PointStatus status = laplacian.status[i];
    if (status == PointStatus::not_finite || status == PointStatus::isolated) result.row(i) = signals.row(i);
    if (status == PointStatus::coincident) result.row(i) = result.row(laplacian.representative[i]);
  }
  return result;
}

}  // namespace tufted
