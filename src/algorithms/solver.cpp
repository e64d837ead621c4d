#include "tufted/solver.h"

#include <utility>

#include "algorithms/linear_system.h"

namespace tufted {

struct Solver::State {
  LinearSystem system;
};

Solver::Solver(std::unique_ptr<State> state) : state_(std::move(state)) {}
Solver::Solver(Solver&&) noexcept = default;
Solver& Solver::operator=(Solver&&) noexcept = default;
Solver::~Solver() = default;

const SolverReport& Solver::report() const {
  return state_->system.report();
}

Solver Solver::positiveDefinite(const SparseMatrix& A, const SolverOptions& options) {
  const SystemNames names = {.function = "Solver::positiveDefinite",
                             .matrix = "A",
                             .if_indefinite = "of M + t L take a smaller t, and ask validate() about L"};
  return Solver(std::make_unique<State>(State{LinearSystem::positiveDefinite(names, A, options)}));
}

Solver Solver::laplacian(const Laplacian& laplacian, const SolverOptions& options) {
  const SystemNames names = {.function = "Solver::laplacian", .matrix = "L"};
  return Solver(std::make_unique<State>(State{LinearSystem::laplacian(names, laplacian, options)}));
}

Eigen::MatrixXd Solver::solve(const Eigen::Ref<const Eigen::MatrixXd>& b, SolveReport* report,
                              const Progress& progress) const {
  return state_->system.solve("Solver::solve", b, report, progress);
}

}  // namespace tufted
