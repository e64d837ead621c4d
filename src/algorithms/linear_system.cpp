#include "algorithms/linear_system.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <utility>
#include <vector>

#include "algorithms/greater.h"
#include "algorithms/memory_limit.h"
#include "base/number_text.h"
#include "base/stage_clock.h"
#include "tufted/check.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// So many right sides are solved together, on however many threads: each takes as long as among 16, and half as long
/// as alone.
constexpr Eigen::Index columns_per_block = 8;

void checkOptions(const std::string& function, const SolverOptions& options) {
  if (!(options.tolerance > 0 && options.tolerance < 1))
    throw InvalidInput(function + ": tolerance = " + numberText(options.tolerance) + ", must lie in (0, 1)");
  if (options.max_iterations < 1)
    throw InvalidInput(function + ": max_iterations = " + std::to_string(options.max_iterations) +
                       ", must be at least 1");
  if (options.threads < 0)
    throw InvalidInput(function + ": threads = " + std::to_string(options.threads) + ", must be >= 0");
}

std::string bytesText(std::size_t bytes) {
  return numberText(static_cast<double>(bytes) / 1e6) + " MB";
}

void checkFinite(const SystemNames& names, const SparseMatrix& A) {
  for (int j = 0; j < A.cols(); ++j) {
    for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry)
      if (!std::isfinite(entry.value()))
        throw SolverFailure(names.function + ": " + names.matrix +
                            " has entries that are not finite, the first in column " + std::to_string(j) + "; " +
                            names.if_indefinite);
  }
}

}  // namespace

LinearSystem::LinearSystem(const SystemNames& names, const SolverOptions& options, std::size_t points)
    : names_(names), unknowns_(points), tolerance_(options.tolerance), threads_(options.threads) {}

/// By the method chosen, or by what fits.
void LinearSystem::prepare(const SolverOptions& options, const Workers& workers) {
  report_.unknowns = lower_.rows();
  if (report_.unknowns == 0) return;
  const std::string& function = names_.function;
  if (options.method == SolverMethod::multigrid && names_.factor_only)
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
      if (!fits && names_.factor_only)
        throw SolverFailure(function + ": a factor of " + names_.matrix + " takes " + bytesText(report_.factor_bytes) +
                            ", above memory_limit (" + bytesText(limit) + "), and multigrid is not fit for it; raise " +
                            "memory_limit or set method to SolverMethod::cholesky");
      workers.report("factor", 0);
      if (fits) backend_ = cholesky.factor();
    }
    if (!fits) {
      backend_ = makeMultigrid(lower_, {options.tolerance, options.max_iterations}, workers);
      if (backend_) report_.bytes = backend_->bytes;
      report_.iterative = true;
    }
  } catch (const std::bad_alloc&) {
    if (!fits) throw SolverFailure(function + ": memory does not suffice even for multigrid; take fewer points");
    throw SolverFailure(function + ": memory does not suffice for a factor of " + names_.matrix + " (" +
                        bytesText(report_.factor_bytes) + "); " + names_.if_large);
  }
  if (!backend_)
    throw SolverFailure(function + ": " + names_.matrix + " is not positive " +
                        (components_ ? "semidefinite; " : "definite; ") + names_.if_indefinite);
  report_.method = backend_->name;
  report_.nonzeros = backend_->nonzeros;
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
  system.weights_ = components.weights(laplacian.M);
  // The first point of each component is pinned: it stays out.
  std::vector<bool> pinned(components.count, false);
  for (const int i : components.points) {
    if (pinned[components.of[i]]) system.unknowns_.add(i);
    pinned[components.of[i]] = true;
  }
  system.lower_ = lowerTriangle(laplacian.L, system.unknowns_, [](int, int, double value) { return value; });
  system.L_ = laplacian.L;
  system.prepare(options, workers);
  system.lower_ = {};
  system.report_.components = components.count;
  system.report_.seconds = watch.seconds();
  return system;
}

// Column by column and in one pass each, for these take as long as some solves.

Eigen::MatrixXd LinearSystem::gathered(const Eigen::Ref<const Eigen::MatrixXd>& b) const {
  const auto size = static_cast<Eigen::Index>(unknowns_.point.size());
  Eigen::MatrixXd right(size, b.cols());
  for (Eigen::Index c = 0; c < b.cols(); ++c) {
    const VectorXd sums = components_ ? components_->sums(b.col(c)) : VectorXd();
    for (Eigen::Index k = 0; k < size; ++k) {
      const int i = unknowns_.point[k];
      right(k, c) = components_ ? b(i, c) - weights_[i] * sums[components_->of[i]] : b(i, c);
    }
  }
  return right;
}

void LinearSystem::scatter(const Eigen::MatrixXd& solution, Eigen::Ref<Eigen::MatrixXd> x) const {
  for (Eigen::Index c = 0; c < x.cols(); ++c) {
    for (Eigen::Index k = 0; k < solution.rows(); ++k) x(unknowns_.point[k], c) = solution(k, c);
    if (!components_) continue;
    VectorXd means = VectorXd::Zero(components_->count);
    for (const int i : components_->points) means[components_->of[i]] += weights_[i] * x(i, c);
    for (const int i : components_->points) x(i, c) -= means[components_->of[i]];
  }
}

double LinearSystem::residualOf(const Eigen::Ref<const Eigen::MatrixXd>& b,
                                const Eigen::Ref<const Eigen::MatrixXd>& x) const {
  const Eigen::MatrixXd right = gathered(b);
  Eigen::MatrixXd rest = right;
  if (components_)
    rest -= Eigen::MatrixXd(L_ * x)(unknowns_.point, Eigen::all);
  else
    rest -= lower_.selfadjointView<Eigen::Lower>() * Eigen::MatrixXd(x(unknowns_.point, Eigen::all));
  double greatest = 0;
  for (Eigen::Index c = 0; c < b.cols(); ++c) {
    const double size = right.col(c).norm();
    if (size > 0) greatest = greater(greatest, rest.col(c).norm() / size);
  }
  return greatest;
}

Eigen::MatrixXd LinearSystem::solve(const std::string& function, const Eigen::Ref<const Eigen::MatrixXd>& b,
                                    SolveReport* report, const Progress& progress) const try {
  const auto n = static_cast<Eigen::Index>(unknowns_.number.size());
  if (b.rows() != n)
    throw InvalidInput(function + ": b has " + std::to_string(b.rows()) + " rows, must have " + std::to_string(n));
  const Stopwatch watch;
  const Eigen::Index blocks = (b.cols() + columns_per_block - 1) / columns_per_block;
  std::vector<SolveReport> done(static_cast<std::size_t>(blocks));
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(n, b.cols());
  const Workers workers(threads_, progress);
  workers.forBlocks("solve", b.cols(), columns_per_block, [&](std::int64_t begin, std::int64_t end, int worker) {
    if (!backend_) return;
    SolveReport& result = done[begin / columns_per_block];
    const auto right = b.middleCols(begin, end - begin);
    auto left = x.middleCols(begin, end - begin);
    Eigen::MatrixXd solution = gathered(right);
    if (!solution.allFinite()) throw InvalidInput(function + ": b has values that are not finite, must have none");
    const auto total = static_cast<double>(b.cols()), columns = static_cast<double>(end - begin);
    result.iterations = backend_->solve(solution, [&](double done_here) {
      // Only the caller's own thread talks to the caller.
      if (worker == 0) workers.report("solve", (static_cast<double>(begin) + done_here * columns) / total);
    });
    scatter(solution, left);
    if (report != nullptr) result.residual = residualOf(right, left);
  });
  if (report != nullptr) {
    *report = {.method = report_.method};
    for (const SolveReport& block : done) {
      report->iterations = std::max(report->iterations, block.iterations);
      report->residual = greater(report->residual, block.residual);
    }
    report->seconds = watch.seconds();
  }
  return x;
} catch (const NotConverged& failure) {
  const std::string bytes =
      report_.factor_bytes > 0 ? " (a factor would take " + bytesText(report_.factor_bytes) + ")" : "";
  throw SolverFailure(function + ": |b - A x| / |b| is " + numberText(failure.residual) + " after " +
                      std::to_string(failure.iterations) + " iterations of multigrid on " + names_.matrix +
                      ", must be " + numberText(tolerance_) + "; " + names_.if_slow + bytes);
} catch (const std::bad_alloc&) {
  throw SolverFailure(function + ": memory does not suffice to solve for " + std::to_string(b.cols()) +
                      " right sides; solve for fewer at once, or free what else takes memory");
}

}  // namespace tufted
