// Eigenpairs of L x = lambda M x (Sharp and Crane 2020, Section 5.3), by block_lanczos.h or dense_pairs.h.
#include "tufted/spectrum.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/block_lanczos.h"
#include "algorithms/dense_pairs.h"
#include "algorithms/eigenproblem.h"
#include "algorithms/greater.h"
#include "algorithms/inertia.h"
#include "algorithms/linear_system.h"
#include "algorithms/memory_limit.h"
#include "algorithms/nearly_disconnected.h"
#include "algorithms/refine_pairs.h"
#include "algorithms/tall_matrix.h"
#include "base/number_text.h"
#include "base/parallel.h"
#include "base/stage_clock.h"
#include "tufted/check.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Up to this many points dense matrices are always used: at 100 points they are faster for any number of pairs.
constexpr Index small_space = 150;
/// Dense matrices are also used if more than this share of all pairs is wanted. On tori they are faster from 0.15 at
/// 200 points, 0.25 at 500 and 0.35 at 2,000.
constexpr double large_share = 0.3;
/// Dense matrices take about this many seconds times the cube of the points: 1.6e-9 to 7.7e-9 on tori of 600 to 2,400
/// points.
constexpr double dense_seconds = 4e-9;

void checkLaplacian(const std::string& function, const Laplacian& laplacian) {
  checkSizes(function, laplacian);
  if (!laplacian.M.allFinite() || (laplacian.M.array() < 0).any())
    throw InvalidInput(function + ": M has values that are negative or not finite, must have none");
}

void checkOptions(const SpectrumOptions& options) {
  if (!(options.tolerance > 0 && options.tolerance < 1))
    throw InvalidInput("spectrum: tolerance = " + numberText(options.tolerance) + ", must lie in (0, 1)");
  if (options.max_iterations < 1)
    throw InvalidInput("spectrum: max_iterations = " + std::to_string(options.max_iterations) + ", must be at least 1");
  if (options.dense_limit < 0)
    throw InvalidInput("spectrum: dense_limit = " + std::to_string(options.dense_limit) + ", must be >= 0");
  if (options.threads < 0)
    throw InvalidInput("spectrum: threads = " + std::to_string(options.threads) + ", must be >= 0");
}

void fixSign(Eigen::Ref<VectorXd> x) {
  const double bound = (1 - 1e-6) * x.cwiseAbs().maxCoeff();
  for (Index i = 0; i < x.size(); ++i) {
    if (std::abs(x[i]) < bound) continue;
    if (x[i] < 0) x = -x;
    return;
  }
}

/// Whether no eigenvalue is missing, by counting those below the last gap among the values found: they must be as many
/// as were found below it. The values above the gap are equal, so none between them can be missing. Nullopt if unknown.
/// @param values ascending
std::optional<bool> isComplete(const Eigenproblem& problem, const VectorXd& values, std::size_t memory_limit) {
  Index below = values.size() - 1;
  while (below > 0 && values[below] - values[below - 1] <= 1e-6 * values[below]) --below;
  const double bound = ((below > 0 ? values[below - 1] : 0) + values[below]) / 2;
  std::vector<int> points;
  for (const int i : problem.components.points)
    if (problem.area[problem.components.of[i]] > 0) points.push_back(i);
  const std::optional<Index> count = eigenvaluesBelow(problem.L, problem.mass, bound, points, memory_limit);
  if (!count) return std::nullopt;
  return *count == below + problem.nulls();
}

/// Whether dense matrices are faster and fit into memory.
bool isForDense(const Eigenproblem& problem, Index wanted, const SpectrumOptions& options) {
  const Index points = problem.usable + std::ssize(problem.massless);
  if (points > options.dense_limit) return false;
  if (static_cast<std::size_t>(24 * points * points) > memoryLimit(options.memory_limit)) return false;
  return points <= small_space || static_cast<double>(wanted) > large_share * static_cast<double>(points);
}

/// Finds pairs by Lanczos' method.
/// @param is_complete see LanczosProblem
/// @return see LanczosResult::converged
bool searchPairs(const Eigenproblem& problem, const InverseTimes& inverse, Index wanted,
                 const std::function<std::optional<bool>(const VectorXd&)>& is_complete, const SpectrumOptions& options,
                 const Workers& workers, Eigenpairs& pairs, SpectrumReport& report) {
  const LanczosProblem lanczos = {.apply = inverse,
                                  .deflate = [&](Eigen::Ref<MatrixXd> x) { problem.deflate(x); },
                                  .mass = problem.mass,
                                  .dimension = problem.usable - problem.nulls(),
                                  .wanted = wanted,
                                  .is_complete = is_complete};
  LanczosResult found =
      largestEigenpairs(lanczos, {.tolerance = options.tolerance, .max_iterations = options.max_iterations}, workers);
  report.iterations = found.iterations;
  if (found.values.size() == 0 && found.iterations < options.max_iterations)
    throw SolverFailure("spectrum: eigenvalues are missing among the " + std::to_string(wanted) +
                        " found, though the space is used up; L is too close to singular, ask for fewer");
  if (found.values.size() == 0)
    throw SolverFailure("spectrum: max_iterations = " + std::to_string(options.max_iterations) +
                        " do not suffice for " + std::to_string(wanted) + " eigenvalues to a tolerance of " +
                        numberText(options.tolerance) + "; raise either");
  pairs = {found.values.cwiseInverse(), std::move(found.vectors), std::move(found.images)};
  return found.converged;
}

/// Whether parts of L are joined so weakly that solves without corrections are inaccurate, tested on vectors of small
/// eigenvalues.
bool isWeak(const Eigenproblem& problem, const InverseTimes& inverse) {
  std::mt19937_64 random(1);
  VectorXd x(problem.mass.size()), before;
  for (double& value : x) value = static_cast<double>(random() >> 11) * 0x1p-52 - 1;  // in [-1, 1)
  for (int step = 0; step < 3; ++step) {
    before = x / x.cwiseAbs().maxCoeff();
    if (step == 0) problem.deflate(before);
    x = inverse(before);
  }
  const VectorXd weighted = problem.mass.cwiseProduct(before);
  return !((problem.L * x - weighted).norm() <= large_residual * weighted.norm());
}

/// Finds the pairs of positive eigenvalues, mass-orthonormal.
void findVibrations(const Laplacian& laplacian, const Eigenproblem& problem, Index wanted,
                    const SpectrumOptions& options, Spectrum& spectrum) {
  const std::size_t limit = memoryLimit(options.memory_limit);
  const SystemNames names = {.function = "spectrum", .matrix = "L", .if_slow = "set method to SolverMethod::cholesky"};
  const LinearSystem system = LinearSystem::laplacian(
      names, laplacian,
      {.method = options.method, .memory_limit = limit, .threads = options.threads, .progress = options.progress});
  spectrum.report.solver = system.report();

  // Solves can be cancelled, but report the share of pairs found so far as their progress.
  double found_share = 0;
  const Progress progress = [&](std::string_view stage, double fraction) {
    if (stage == "eigenpairs") found_share = fraction;
    if (!options.progress) return true;
    return stage == "solve" ? options.progress("eigenpairs", found_share) : options.progress(stage, fraction);
  };
  const Workers workers(options.threads, progress);
  const Progress silent;
  const Workers quiet(options.threads, silent);
  // Errors of single solves are not checked: vectors that are 0 on parts of the surface are only rounding there. The
  // residual of each pair is checked in the end.
  const InverseTimes inverse = [&](const Eigen::Ref<const MatrixXd>& x) {
    return system.solve("spectrum", problem.mass.asDiagonal() * x, nullptr, progress, Refine::never);
  };
  // If parts are joined weakly, every solve needs corrections; if these fail, the residuals of pairs show it.
  const InverseTimes corrected = [&](const Eigen::Ref<const MatrixXd>& x) {
    try {
      return system.solve("spectrum", problem.mass.asDiagonal() * x, nullptr, progress, Refine::always);
    } catch (const SolverFailure&) {
      return inverse(x);
    }
  };
  // Counting eigenvalues takes a second factor.
  const std::size_t held = system.report().bytes;
  std::function<std::optional<bool>(const VectorXd&)> is_complete;
  if (!system.report().iterative && held < limit) {
    is_complete = [&](const VectorXd& values) {
      workers.report("count", 0);
      const std::optional<bool> complete = isComplete(problem, values.cwiseInverse(), limit - held);
      spectrum.report.counted = complete.value_or(false);
      return complete;
    };
  }
  std::optional<Eigenpairs> pairs;
  if (isForDense(problem, wanted, options)) {
    const double points = static_cast<double>(problem.usable + std::ssize(problem.massless));
    const long seconds = std::lround(dense_seconds * points * points * points);
    workers.report(seconds > 0 ? "dense, about " + std::to_string(seconds) + " s" : "dense", 0);
    pairs = densePairs(problem, wanted);
    spectrum.report.counted = pairs.has_value();
  }
  bool mixed = true;
  spectrum.report.method = pairs ? "dense" : "block Lanczos";
  const InverseTimes& exact = isWeak(problem, inverse) ? corrected : inverse;
  if (!pairs)
    mixed = !searchPairs(problem, exact, wanted, is_complete, options, workers, pairs.emplace(), spectrum.report);
  if (!refinePairs(problem, exact, mixed, quiet, *pairs))
    throw SolverFailure(
        "spectrum: the eigenvectors found are not independent, so digits are wrong; L is too close to "
        "singular, ask for fewer eigenvalues or set method to SolverMethod::cholesky");
  spectrum.values.tail(wanted) = pairs->values;
  spectrum.vectors.rightCols(wanted) = pairs->vectors;
}

/// The Rayleigh quotient x^T L x / x^T diag(mass) x from differences, accurate even if L x is only rounding.
double rayleighQuotient(const Eigenproblem& problem, const VectorXd& x) {
  double energy = 0;
  for (int j = 0; j < problem.L.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator entry(problem.L, j); entry; ++entry)
      if (entry.row() > j) energy -= entry.value() * std::pow(x[entry.row()] - x[j], 2);
  }
  return energy / problem.mass.cwiseProduct(x).dot(x);
}

/// Measures the accuracy of the pairs and fills in the report.
/// @throws SolverFailure for the first pair that is not accurate enough
void measure(const Eigenproblem& problem, const SpectrumOptions& options, Spectrum& spectrum) {
  SpectrumReport& report = spectrum.report;
  const Progress silent;
  const Workers workers(1, silent);
  const auto measureOrthogonality = [&] {
    const MatrixXd gram = innerProducts(spectrum.vectors, problem.mass, spectrum.vectors, workers);
    report.orthogonality =
        (gram - MatrixXd::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  };
  measureOrthogonality();
  // Weights of very different sizes, as on a thin plate, cost digits; Gram-Schmidt restores orthogonality.
  if (report.orthogonality > large_residual && report.orthogonality < 1e-3) {
    orthonormalize(problem.mass, workers, spectrum.vectors);
    measureOrthogonality();
  }
  if (!(report.orthogonality <= large_residual))
    throw SolverFailure("spectrum: X^T M X differs from the identity by " + numberText(report.orthogonality) +
                        ", must be at most " + numberText(large_residual) + "; ask for fewer eigenvalues");
  const SparseMatrix magnitude = problem.L.cwiseAbs();
  for (Index c = report.null_space; c < spectrum.values.size(); ++c) {
    double& lambda = spectrum.values[c];
    const VectorXd x = spectrum.vectors.col(c), Lx = problem.L * x, terms = magnitude * x.cwiseAbs();
    VectorXd weighted = lambda * problem.mass.cwiseProduct(x), rest = Lx - weighted;
    double residual = rest.norm() / weighted.norm();
    if (residual > std::max(10 * options.tolerance, large_residual)) {
      lambda = rayleighQuotient(problem, x);
      weighted = lambda * problem.mass.cwiseProduct(x), rest = Lx - weighted;
      residual = rest.norm() / weighted.norm();
      if (report.weak_pair < 0) report.weak_pair = static_cast<int>(c);
    }
    const double rounding = 16 * std::numeric_limits<double>::epsilon() * terms.norm() / weighted.norm();
    const double most = 10 * options.tolerance + rounding, before = c > 0 ? spectrum.values[c - 1] : 0;
    if (!(residual <= most && lambda > 0 && lambda >= before))
      throw SolverFailure("spectrum: of pair " + std::to_string(c) + ", eigenvalue " +
                          numberText(lambda / problem.total) + " after " + numberText(before / problem.total) +
                          ", |L x - lambda M x| / (lambda |M x|) is " + numberText(residual) + ", must be at most " +
                          numberText(most) + "; ask for fewer eigenvalues or set method to SolverMethod::cholesky");
    report.residual = greater(report.residual, residual);
    report.backward_error = greater(report.backward_error, rest.norm() / (terms.norm() + weighted.norm()));
  }
}

}  // namespace

Spectrum spectrum(const Laplacian& laplacian, int k, const SpectrumOptions& options) {
  checkLaplacian("spectrum", laplacian);
  checkOptions(options);
  const Stopwatch watch;
  const Eigenproblem problem(laplacian);
  const Index most = problem.count(options.null_space);
  const std::string counted =
      std::string("active points of positive area") + (options.null_space ? "" : " without one per component");
  if (most < 1)
    throw InvalidInput("spectrum: k = " + std::to_string(k) + ", and there are no " + counted +
                       ", must be at least one");
  if (k < 1 || k > most)
    throw InvalidInput("spectrum: k = " + std::to_string(k) + ", must be at least 1 and at most " +
                       std::to_string(most) + ", the number of " + counted);
  Spectrum result{VectorXd::Zero(k), MatrixXd(problem.mass.size(), k), {}};
  const Index nulls = options.null_space ? std::min<Index>(k, problem.nulls()) : 0;
  result.report.null_space = static_cast<int>(nulls);
  result.vectors.leftCols(nulls) = problem.constants(nulls);
  if (nulls < k) findVibrations(laplacian, problem, k - nulls, options, result);
  measure(problem, options, result);

  for (Index c = 0; c < k; ++c) fixSign(result.vectors.col(c));
  for (std::size_t i = 0; i < laplacian.status.size(); ++i) {
    if (laplacian.status[i] != PointStatus::coincident) continue;
    result.vectors.row(static_cast<Index>(i)) = result.vectors.row(laplacian.representative[i]);
  }
  result.values /= problem.total;
  if (!result.values.allFinite())
    throw SolverFailure("spectrum: an eigenvalue has the unit of 1 / area, the whole area is " +
                        numberText(problem.total) + ", must be large enough for the eigenvalue to be finite; scale " +
                        "the points up");
  result.vectors /= std::sqrt(problem.total);
  result.report.seconds = watch.seconds();
  return result;
}

int mostEigenpairs(const Laplacian& laplacian, bool null_space) {
  checkLaplacian("mostEigenpairs", laplacian);
  return static_cast<int>(Eigenproblem(laplacian).count(null_space));
}

}  // namespace tufted
