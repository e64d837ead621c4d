#include "tufted/spectrum.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/block_lanczos.h"
#include "algorithms/connected.h"
#include "algorithms/greater.h"
#include "algorithms/inertia.h"
#include "algorithms/linear_system.h"
#include "algorithms/memory_limit.h"
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
  if (options.threads < 0)
    throw InvalidInput("spectrum: threads = " + std::to_string(options.threads) + ", must be >= 0");
}

/// The problem without unit, so that tiny and huge clouds neither underflow nor overflow: areas are parts of `total`.
struct Problem {
  Components components;
  double total;            ///< area of the active points
  VectorXd mass;           ///< N
  VectorXd area;           ///< of each component
  std::vector<int> order;  ///< components of positive area, larger ones first
  Index usable = 0;        ///< points of positive mass

  explicit Problem(const Laplacian& laplacian) : components(findComponents(laplacian)) {
    mass = VectorXd::Zero(laplacian.M.size());
    const double largest = std::max(laplacian.M.size() > 0 ? laplacian.M.maxCoeff() : 0.0, 0.0);
    for (const int i : components.points) mass[i] = largest > 0 ? laplacian.M[i] / largest : 0;
    total = mass.sum();
    if (total > 0) mass /= total;
    total *= largest;
    area = components.sums(mass);
    for (int c = 0; c < components.count; ++c)
      if (area[c] > 0) order.push_back(c);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return area[a] > area[b]; });
    usable = (mass.array() > 0).count();
  }

  /// Above the largest number of pairs that can be asked for.
  Index bound(bool null_space) const { return usable - (null_space ? 0 : std::ssize(order)); }
};

/// Columns `first` to the end: the constants of the components.
MatrixXd constants(const Problem& problem, Index count) {
  MatrixXd result = MatrixXd::Zero(problem.mass.size(), count);
  std::vector<Index> column(problem.components.count, count);
  for (Index c = 0; c < count; ++c) column[problem.order[c]] = c;
  for (const int i : problem.components.points) {
    const int component = problem.components.of[i];
    if (column[component] < count) result(i, column[component]) = 1 / std::sqrt(problem.area[component]);
  }
  return result;
}

void fixSign(Eigen::Ref<VectorXd> x) {
  const double bound = (1 - 1e-6) * x.cwiseAbs().maxCoeff();
  for (Index i = 0; i < x.size(); ++i) {
    if (std::abs(x[i]) < bound) continue;
    if (x[i] < 0) x = -x;
    return;
  }
}

/// Counts the eigenvalues below the last wide gap among those found (ascending): they must be as many. Values behind
/// that gap are equal, so none between them can be missing. Nothing where it cannot be told.
std::optional<bool> isComplete(const SparseMatrix& L, const Problem& problem, const VectorXd& values,
                               std::size_t memory_limit) {
  Index below = values.size() - 1;
  while (below > 0 && values[below] - values[below - 1] <= 1e-6 * values[below]) --below;
  const double bound = ((below > 0 ? values[below - 1] : 0) + values[below]) / 2;
  std::vector<int> points;
  for (const int i : problem.components.points)
    if (problem.area[problem.components.of[i]] > 0) points.push_back(i);
  const std::optional<Index> count = eigenvaluesBelow(L, problem.mass, bound, points, memory_limit);
  if (!count) return std::nullopt;
  return *count == below + std::ssize(problem.order);
}

/// The pairs of positive eigenvalue, M-orthonormal.
void findVibrations(const Laplacian& laplacian, const Problem& problem, Index wanted, const SpectrumOptions& options,
                    Spectrum& spectrum) {
  const std::size_t limit = memoryLimit(options.memory_limit);
  const SystemNames names = {.function = "spectrum", .matrix = "L", .if_slow = "set method to SolverMethod::cholesky"};
  const LinearSystem system = LinearSystem::laplacian(
      names, laplacian,
      {.method = options.method, .memory_limit = limit, .threads = options.threads, .progress = options.progress});
  spectrum.report.solver = system.report();

  // Solves can be cancelled, but what they show is how many pairs have been found.
  double found_share = 0;
  const Progress progress = [&](std::string_view stage, double fraction) {
    if (stage == "eigenpairs") found_share = fraction;
    if (!options.progress) return true;
    return stage == "solve" ? options.progress("eigenpairs", found_share) : options.progress(stage, fraction);
  };
  const Workers workers(options.threads, progress);
  const Progress silent;
  const Workers quiet(options.threads, silent);
  const auto apply = [&](const Eigen::Ref<const MatrixXd>& x) {
    return system.solve("spectrum", problem.mass.asDiagonal() * x, nullptr, progress);
  };
  const auto deflate = [&](Eigen::Ref<MatrixXd> x) {
    for (Index c = 0; c < x.cols(); ++c) {
      const VectorXd sums = problem.components.sums(x.col(c).cwiseProduct(problem.mass));
      for (const int i : problem.components.points) {
        const int component = problem.components.of[i];
        if (problem.area[component] > 0) x(i, c) -= sums[component] / problem.area[component];
      }
    }
  };
  const Index nulls = std::ssize(problem.order);
  LanczosProblem inverse = {.apply = apply,
                            .deflate = deflate,
                            .mass = problem.mass,
                            .dimension = problem.usable - nulls,
                            .wanted = wanted,
                            .is_complete = {}};
  // Counting takes a factor beside the one that is held.
  const std::size_t held = system.report().bytes;
  if (!system.report().iterative && held < limit) {
    inverse.is_complete = [&](const VectorXd& values) {
      workers.report("count", 0);
      const std::optional<bool> complete = isComplete(laplacian.L, problem, values.cwiseInverse(), limit - held);
      spectrum.report.counted = complete.value_or(false);
      return complete;
    };
  }
  const LanczosResult found =
      largestEigenpairs(inverse, {.tolerance = options.tolerance, .max_iterations = options.max_iterations}, workers);
  spectrum.report.iterations = found.iterations;
  if (!found.converged)
    throw SolverFailure("spectrum: max_iterations = " + std::to_string(options.max_iterations) +
                        " do not suffice for " + std::to_string(wanted) + " eigenvalues to a tolerance of " +
                        numberText(options.tolerance) + "; raise either");

  // Another step of the inverse takes out what rounding left of high frequencies, and fills in points without mass.
  MatrixXd x = apply(found.vectors) * found.values.cwiseInverse().asDiagonal();
  const Eigen::LLT<MatrixXd> gram(innerProducts(x, problem.mass, x, quiet));
  if (gram.info() != Eigen::Success)
    throw SolverFailure(
        "spectrum: the eigenvectors found are not independent, so digits are wrong; L is too close to "
        "singular, ask for fewer eigenvalues or set method to SolverMethod::cholesky");
  const MatrixXd combination = gram.matrixU().solve(MatrixXd::Identity(wanted, wanted));
  multiplyInPlace(x, combination, quiet);
  spectrum.values.tail(wanted) = found.values.cwiseInverse();
  spectrum.vectors.rightCols(wanted) = x;
}

/// What was reached, in units without unit.
void measure(const Laplacian& laplacian, const Problem& problem, Spectrum& spectrum) {
  const Progress silent;
  const Workers workers(1, silent);
  const MatrixXd gram = innerProducts(spectrum.vectors, problem.mass, spectrum.vectors, workers);
  spectrum.report.orthogonality =
      (gram - MatrixXd::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  for (Index c = 0; c < spectrum.values.size(); ++c) {
    if (spectrum.values[c] == 0) continue;
    const VectorXd weighted = spectrum.values[c] * problem.mass.cwiseProduct(spectrum.vectors.col(c));
    const double residual = (laplacian.L * spectrum.vectors.col(c) - weighted).norm() / weighted.norm();
    spectrum.report.residual = greater(spectrum.report.residual, residual);
  }
}

}  // namespace

Spectrum spectrum(const Laplacian& laplacian, int k, const SpectrumOptions& options) {
  checkLaplacian("spectrum", laplacian);
  checkOptions(options);
  const Stopwatch watch;
  const Problem problem(laplacian);
  const Index components = std::ssize(problem.order), bound = problem.bound(options.null_space);
  if (k < 1 || k >= bound)
    throw InvalidInput("spectrum: k = " + std::to_string(k) + ", must be at least 1 and less than " +
                       std::to_string(bound) + ", the number of active points of positive area" +
                       (options.null_space ? "" : " without one per component"));
  Spectrum result{VectorXd::Zero(k), MatrixXd(problem.mass.size(), k), {}};
  const Index nulls = options.null_space ? std::min<Index>(k, components) : 0;
  result.report.null_space = static_cast<int>(nulls);
  result.vectors.leftCols(nulls) = constants(problem, nulls);
  if (nulls < k) findVibrations(laplacian, problem, k - nulls, options, result);
  measure(laplacian, problem, result);

  for (Index c = 0; c < k; ++c) fixSign(result.vectors.col(c));
  for (std::size_t i = 0; i < laplacian.status.size(); ++i) {
    if (laplacian.status[i] != PointStatus::coincident) continue;
    result.vectors.row(static_cast<Index>(i)) = result.vectors.row(laplacian.representative[i]);
  }
  result.values /= problem.total;
  result.vectors /= std::sqrt(problem.total);
  result.report.seconds = watch.seconds();
  return result;
}

int mostEigenpairs(const Laplacian& laplacian, bool null_space) {
  checkLaplacian("mostEigenpairs", laplacian);
  return static_cast<int>(std::max<Index>(Problem(laplacian).bound(null_space) - 1, 0));
}

}  // namespace tufted
