#include "algorithms/linear_system.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>
#include <vector>

#include "algorithms/memory_limit.h"
#include "base/number_text.h"
#include "base/require.h"
#include "base/stage_clock.h"
#include "tufted/check.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

void checkOptions(const std::string& function, const SolverOptions& options) {
  if (!(options.tolerance > 0 && options.tolerance < 1))
    throw InvalidInput(function + ": tolerance = " + numberText(options.tolerance) + ", must lie in (0, 1)");
  if (options.max_iterations < 1)
    throw InvalidInput(function + ": max_iterations = " + std::to_string(options.max_iterations) +
                       ", must be at least 1");
  if (options.threads < 0)
    throw InvalidInput(function + ": threads = " + std::to_string(options.threads) + ", must be >= 0");
}

void checkFinite(const SystemNames& names, double value, int column) {
  if (!std::isfinite(value))
    throw SolverFailure(names.function + ": " + names.matrix +
                        " has entries that are not finite, the first in column " + std::to_string(column) + "; " +
                        names.if_indefinite);
}

void checkFinite(const SystemNames& names, const SparseMatrix& A) {
  for (int j = 0; j < A.cols(); ++j)
    for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry) checkFinite(names, entry.value(), j);
}

}  // namespace

std::string bytesText(std::size_t bytes) {
  return numberText(static_cast<double>(bytes) / 1e6) + " MB";
}

LinearSystem::LinearSystem(const SystemNames& names, const SolverOptions& options, std::size_t points)
    : names_(names), unknowns_(points), tolerance_(options.tolerance), threads_(options.threads) {}

/// Prepares the backend by the method chosen, or by the one that fits into memory.
void LinearSystem::prepare(const SolverOptions& options, const Workers& workers) {
  const std::string& function = names_.function;
  requireChoice(options.method, SolverMethod::multigrid, function, "method");
  report_.unknowns = lower_.rows();
  if (report_.unknowns == 0) return;
  if (options.method == SolverMethod::multigrid && names_.if_too_large == IfTooLarge::refuse)
    throw SolverFailure(function + ": multigrid is not fit for " + names_.matrix +
                        "; set method to SolverMethod::cholesky");
  bool fits = options.method == SolverMethod::cholesky;
  try {
    if (options.method != SolverMethod::multigrid) {
      workers.report("analyse", 0);
      const std::size_t limit = memoryLimit(options.memory_limit);
      Cholesky cholesky(lower_, limit);
      report_.factor_bytes = report_.bytes = cholesky.bytes();
      fits = fits || report_.factor_bytes <= limit;
      if (!fits && names_.if_too_large == IfTooLarge::refuse)
        throw SolverFailure(function + ": a factor of " + names_.matrix + " takes " + bytesText(report_.factor_bytes) +
                            ", above memory_limit (" + bytesText(limit) + "), and multigrid is not fit for it; raise " +
                            "memory_limit or set method to SolverMethod::cholesky");
      workers.report("factor", 0);
      if (fits) backend_ = cholesky.factor();
    }
    if (!fits && names_.if_too_large == IfTooLarge::nothing) {
      report_.iterative = true;
      return;
    }
    if (!fits) {
      backend_ = makeMultigrid(lower_, {options.tolerance, options.max_iterations}, workers);
      if (backend_) report_.bytes = backend_->bytes;
      report_.iterative = true;
    }
  } catch (const std::bad_alloc&) {
    if (!fits) throw SolverFailure(function + ": memory does not suffice even for multigrid; take fewer points");
    failForMemory();
  }
  if (!backend_) failAsIndefinite();
  report_.method = backend_->name;
  report_.nonzeros = backend_->nonzeros;
}

void LinearSystem::failForMemory() const {
  throw SolverFailure(names_.function + ": memory does not suffice for a factor of " + names_.matrix + " (" +
                      bytesText(report_.factor_bytes) + "); " + names_.if_large);
}

void LinearSystem::failAsIndefinite() const {
  throw SolverFailure(names_.function + ": " + names_.matrix + " is not positive " +
                      (components_ ? "semidefinite; " : "definite; ") + names_.if_indefinite);
}

void LinearSystem::setDiagonal(const Eigen::Ref<const VectorXd>& diagonal) try {
  for (Eigen::Index k = 0; k < lower_.cols(); ++k) {
    const int i = unknowns_.point[k];
    checkFinite(names_, diagonal[i], i);
    lower_.coeffRef(k, k) = diagonal[i];
  }
  if (backend_ && !backend_->refactor(lower_)) failAsIndefinite();
} catch (const std::bad_alloc&) {
  failForMemory();
}

LinearSystem LinearSystem::positiveDefinite(const SystemNames& names, const SparseMatrix& A,
                                            const SolverOptions& options) {
  checkOptions(names.function, options);
  if (A.rows() != A.cols())
    throw InvalidInput(names.function + ": " + names.matrix + " is " + std::to_string(A.rows()) + " x " +
                       std::to_string(A.cols()) + ", must be square");
  const Stopwatch watch;
  const Workers workers(options.threads, options.progress);
  checkFinite(names, A);
  LinearSystem system(names, options, static_cast<std::size_t>(A.cols()));
  std::vector<bool> used(A.cols(), false);
  for (int j = 0; j < A.cols(); ++j) {
    for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry)
      if (entry.row() >= j && entry.value() != 0) used[j] = used[entry.row()] = true;
  }
  for (int i = 0; i < A.cols(); ++i)
    if (used[i]) system.unknowns_.add(i);
  system.lower_ = lowerTriangle(A, system.unknowns_, [](int, int, double value) { return value; });
  system.prepare(options, workers);
  system.report_.seconds = watch.seconds();
  return system;
}

LinearSystem LinearSystem::laplacian(const SystemNames& names, const Laplacian& laplacian,
                                     const SolverOptions& options) {
  checkOptions(names.function, options);
  checkSizes(names.function, laplacian);
  const Stopwatch watch;
  const Workers workers(options.threads, options.progress);
  checkFinite(names, laplacian.L);
  LinearSystem system(names, options, laplacian.status.size());
  system.components_ = findComponents(laplacian);
  const Components& components = *system.components_;
  const Components parts = findParts(laplacian);
  system.weights_ = components.weights(laplacian.M);
  // The first point of each part is pinned and no unknown. In each component the first part is not floating.
  std::vector<bool> pinned(parts.count, false), begun(components.count, false);
  std::vector<std::uint8_t> floating(parts.count, 0);
  for (const int i : components.points) {
    const int part = parts.of[i];
    if (pinned[part]) {
      system.unknowns_.add(i);
      continue;
    }
    pinned[part] = true;
    floating[part] = begun[components.of[i]] ? 1 : 0;
    if (!begun[components.of[i]]) system.pinned_.push_back(i);
    begun[components.of[i]] = true;
  }
  system.L_ = laplacian.L;
  system.L_.prune([&](Eigen::Index i, Eigen::Index j, double) { return components.of[i] == components.of[j]; });
  system.lower_ = lowerTriangle(system.L_, system.unknowns_, [](int, int, double value) { return value; });
  system.prepare(options, workers);
  system.lower_ = {};
  if (parts.count > components.count) system.separate(parts, floating);
  if (system.backend_ && !system.report_.iterative && !system.joints_) {
    // L z = (1 at the pinned points) - weights.
    Eigen::MatrixXd right = -system.weights_;
    for (const int i : system.pinned_) right(i, 0) += 1;
    int iterations = 0;
    system.spread_ = system.approximate(
        right, [](double) {}, iterations);
  }
  system.report_.components = components.count;
  system.report_.seconds = watch.seconds();
  return system;
}

void LinearSystem::separate(const Components& parts, const std::vector<std::uint8_t>& floating) try {
  int iterations = 0;
  const auto inner = [&](const Eigen::MatrixXd& rest) {
    return withinParts(
        rest, [](double) {}, iterations);
  };
  joints_ = std::make_unique<PartConstants>(L_, components_->points, parts, floating, inner);
  if (!joints_->isDefinite())
    throw SolverFailure(names_.function + ": " + names_.matrix + " is not positive semidefinite; " +
                        names_.if_indefinite);
} catch (const NotConverged& failure) {
  fail(names_.function, failure);
}

void addReport(const SolverReport& added, SolverReport& all) {
  if (all.method.empty())
    all.method = added.method;
  else if (all.method.find(added.method) == std::string::npos)
    all.method += " and " + added.method;
  all.unknowns += added.unknowns;
  all.nonzeros += added.nonzeros;
  all.bytes += added.bytes;
  all.factor_bytes += added.factor_bytes;
  all.components = std::max(all.components, added.components);
  all.iterative |= added.iterative;
}

}  // namespace tufted
