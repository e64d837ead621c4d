#include "tufted/solver.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "algorithms/connected.h"
#include "algorithms/linear_backend.h"
#include "algorithms/memory_limit.h"
#include "base/stage_clock.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// So many right sides are solved together, on however many threads.
constexpr Eigen::Index columns_per_block = 16;

void checkOptions(const std::string& function, const SolverOptions& options) {
  if (!(options.tolerance > 0 && options.tolerance < 1))
    throw InvalidInput(function + ": tolerance = " + std::to_string(options.tolerance) + ", must lie in (0, 1)");
  if (options.max_iterations < 1)
    throw InvalidInput(function + ": max_iterations = " + std::to_string(options.max_iterations) +
                       ", must be at least 1");
  if (options.threads < 0)
    throw InvalidInput(function + ": threads = " + std::to_string(options.threads) + ", must be >= 0");
}

[[noreturn]] void failIndefinite(const std::string& function, const char* what) {
  throw SolverFailure(function + ": the matrix is not " + what +
                      "; validate() tells what is wrong with a Laplacian, and to M + t L more M has to be added");
}

void checkFinite(const std::string& function, const SparseMatrix& A) {
  for (int j = 0; j < A.cols(); ++j) {
    for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry)
      if (!std::isfinite(entry.value()))
        throw SolverFailure(function + ": the matrix has entries that are not finite, the first in column " +
                            std::to_string(j));
  }
}

/// Prepares the system by the method chosen, or by what fits.
std::unique_ptr<LinearBackend> prepare(const std::string& function, const LongMatrix& lower, const char* what,
                                       const SolverOptions& options, const Workers& workers, SolverReport& report) {
  std::unique_ptr<LinearBackend> backend;
  try {
    bool fits = options.method == SolverMethod::cholesky;
    if (options.method != SolverMethod::multigrid) {
      workers.report("analyse", 0);
      const std::size_t limit = memoryLimit(options.memory_limit);
      Cholesky cholesky(lower, limit);
      report.factor_bytes = cholesky.bytes();
      fits = fits || report.factor_bytes <= limit;
      workers.report("factor", 0);
      if (fits) backend = cholesky.factor();
    }
    if (!fits) backend = makeMultigrid(lower, {options.tolerance, options.max_iterations}, workers);
  } catch (const std::bad_alloc&) {
    throw SolverFailure(function + ": a factor takes more memory than there is; SolverMethod::multigrid takes less");
  }
  if (!backend) failIndefinite(function, what);
  report.method = backend->name;
  report.nonzeros = backend->nonzeros;
  report.bytes = options.method == SolverMethod::multigrid || backend->bytes > 0 ? backend->bytes : report.factor_bytes;
  return backend;
}

}  // namespace

struct Solver::State {
  explicit State(std::size_t points) : unknowns(points) {}

  LongMatrix lower;                        ///< over the unknowns
  Selection unknowns;                      ///< of all points
  std::optional<Components> components;    ///< of a Laplacian
  VectorXd weights;                        ///< N; of a Laplacian: M over its sum per component
  SparseMatrix L;                          ///< of a Laplacian, for the residual
  std::unique_ptr<LinearBackend> backend;  ///< none: no unknowns
  SolverReport report;
  int threads = 0;

  /// The right sides of the unknowns; of a Laplacian without their means.
  Eigen::MatrixXd gathered(const Eigen::Ref<const Eigen::MatrixXd>& b) const;
  /// Solutions into rows of points; of a Laplacian with sum(M x) = 0 on each component. Other rows are left as they
  /// are.
  void scatter(const Eigen::MatrixXd& solution, Eigen::Ref<Eigen::MatrixXd> x) const;
  /// Greatest |b - A x| / |b|, of a Laplacian for b without its means.
  double residualOf(const Eigen::Ref<const Eigen::MatrixXd>& b, const Eigen::Ref<const Eigen::MatrixXd>& x) const;
};

// Column by column and in one pass each, for these take as long as some solves.

Eigen::MatrixXd Solver::State::gathered(const Eigen::Ref<const Eigen::MatrixXd>& b) const {
  const auto size = static_cast<Eigen::Index>(unknowns.point.size());
  Eigen::MatrixXd right(size, b.cols());
  for (Eigen::Index c = 0; c < b.cols(); ++c) {
    const VectorXd sums = components ? components->sums(b.col(c)) : VectorXd();
    for (Eigen::Index k = 0; k < size; ++k) {
      const int i = unknowns.point[k];
      right(k, c) = components ? b(i, c) - weights[i] * sums[components->of[i]] : b(i, c);
    }
  }
  return right;
}

void Solver::State::scatter(const Eigen::MatrixXd& solution, Eigen::Ref<Eigen::MatrixXd> x) const {
  for (Eigen::Index c = 0; c < x.cols(); ++c) {
    for (Eigen::Index k = 0; k < solution.rows(); ++k) x(unknowns.point[k], c) = solution(k, c);
    if (!components) continue;
    VectorXd means = VectorXd::Zero(components->count);
    for (const int i : components->points) means[components->of[i]] += weights[i] * x(i, c);
    for (const int i : components->points) x(i, c) -= means[components->of[i]];
  }
}

double Solver::State::residualOf(const Eigen::Ref<const Eigen::MatrixXd>& b,
                                 const Eigen::Ref<const Eigen::MatrixXd>& x) const {
  const Eigen::MatrixXd right = gathered(b);
  Eigen::MatrixXd rest = right;
  if (components)
    rest -= Eigen::MatrixXd(L * x)(unknowns.point, Eigen::all);
  else
    rest -= lower.selfadjointView<Eigen::Lower>() * Eigen::MatrixXd(x(unknowns.point, Eigen::all));
  double greatest = 0;
  for (Eigen::Index c = 0; c < b.cols(); ++c) {
    const double size = right.col(c).norm();
    if (size > 0) greatest = std::max(greatest, rest.col(c).norm() / size);
  }
  return greatest;
}

Solver::Solver(std::unique_ptr<State> state) : state_(std::move(state)) {}
Solver::Solver(Solver&&) noexcept = default;
Solver& Solver::operator=(Solver&&) noexcept = default;
Solver::~Solver() = default;

const SolverReport& Solver::report() const {
  return state_->report;
}

Solver Solver::positiveDefinite(const SparseMatrix& A, const SolverOptions& options) {
  const std::string function = "Solver::positiveDefinite";
  checkOptions(function, options);
  if (A.rows() != A.cols())
    throw InvalidInput(function + ": A is " + std::to_string(A.rows()) + " x " + std::to_string(A.cols()) +
                       ", must be square");
  const Stopwatch watch;
  const Workers workers(options.threads, options.progress);
  checkFinite(function, A);
  std::vector<bool> used(A.cols(), false);
  for (int j = 0; j < A.cols(); ++j) {
    for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry)
      if (entry.row() >= j && entry.value() != 0) used[j] = used[entry.row()] = true;
  }
  auto state = std::make_unique<State>(used.size());
  for (int i = 0; i < A.cols(); ++i)
    if (used[i]) state->unknowns.add(i);
  state->lower = lowerTriangle(A, state->unknowns, [](int, int, double value) { return value; });
  state->threads = options.threads;
  SolverReport& report = state->report;
  report.unknowns = state->lower.rows();
  if (report.unknowns > 0)
    state->backend = prepare(function, state->lower, "positive definite", options, workers, report);
  report.seconds = watch.seconds();
  return Solver(std::move(state));
}

Solver Solver::laplacian(const Laplacian& laplacian, const SolverOptions& options) {
  const std::string function = "Solver::laplacian";
  checkOptions(function, options);
  const auto n = static_cast<Eigen::Index>(laplacian.status.size());
  if (laplacian.L.rows() != n || laplacian.L.cols() != n || laplacian.M.size() != n)
    throw InvalidInput(function + ": L, M and status differ in their number of points, must be the same");
  const Stopwatch watch;
  const Workers workers(options.threads, options.progress);
  checkFinite(function, laplacian.L);
  auto state = std::make_unique<State>(laplacian.status.size());
  state->components = findComponents(laplacian);
  const Components& components = *state->components;
  state->weights = components.weights(laplacian.M);
  // The first point of each component is pinned: it stays out.
  std::vector<bool> pinned(components.count, false);
  for (const int i : components.points) {
    if (pinned[components.of[i]]) state->unknowns.add(i);
    pinned[components.of[i]] = true;
  }
  state->lower = lowerTriangle(laplacian.L, state->unknowns, [](int, int, double value) { return value; });
  state->L = laplacian.L;
  state->threads = options.threads;
  SolverReport& report = state->report;
  report.unknowns = state->lower.rows();
  report.components = components.count;
  if (report.unknowns > 0)
    state->backend = prepare(function, state->lower, "positive semidefinite", options, workers, report);
  state->lower = {};
  report.seconds = watch.seconds();
  return Solver(std::move(state));
}

Eigen::MatrixXd Solver::solve(const Eigen::Ref<const Eigen::MatrixXd>& b, SolveReport* report) const {
  const State& state = *state_;
  const auto n = static_cast<Eigen::Index>(state.unknowns.number.size());
  if (b.rows() != n)
    throw InvalidInput("Solver::solve: b has " + std::to_string(b.rows()) + " rows, must have " + std::to_string(n));
  const Stopwatch watch;
  const Eigen::Index blocks = (b.cols() + columns_per_block - 1) / columns_per_block;
  std::vector<SolveReport> done(static_cast<std::size_t>(blocks));
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(n, b.cols());
  const Progress silent;
  const Workers workers(state.threads, silent);
  workers.forBlocks("solve", b.cols(), columns_per_block, [&](std::int64_t begin, std::int64_t end, int) {
    if (!state.backend) return;
    SolveReport& result = done[begin / columns_per_block];
    const auto right = b.middleCols(begin, end - begin);
    auto left = x.middleCols(begin, end - begin);
    Eigen::MatrixXd solution = state.gathered(right);
    if (!solution.allFinite()) throw InvalidInput("Solver::solve: b has values that are not finite, must have none");
    result.iterations = state.backend->solve(solution);
    state.scatter(solution, left);
    if (report != nullptr) result.residual = state.residualOf(right, left);
  });
  if (report != nullptr) {
    *report = {};
    for (const SolveReport& block : done) {
      report->iterations = std::max(report->iterations, block.iterations);
      report->residual = std::max(report->residual, block.residual);
    }
    report->seconds = watch.seconds();
  }
  return x;
}

}  // namespace tufted
