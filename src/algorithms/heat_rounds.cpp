// Step 1 of the heat method (Crane, Weischedel, Wardetzky 2013, 2017), the spread of heat, in rounds.
#include "algorithms/heat_rounds.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "algorithms/greater.h"
#include "algorithms/heat_windows.h"

namespace tufted {
namespace {

/// Heat solved for by a factor has a small relative error above this, where the largest heat is 1: with an M-matrix and
/// sources >= 0 only numbers of one sign are added, so accuracy lasts down to underflow.
constexpr double valid = 1e-285;
/// The next round starts where heat falls below this, but is used only beyond `valid`, where the error of its start has
/// evened out.
constexpr double front = 1e-245;

/// The factor of a matrix; null if it takes more memory than the options allow.
std::unique_ptr<const LinearSystem> factorise(const std::string& function, const SparseMatrix& matrix,
                                              const SolverOptions& options) {
  auto system = std::make_unique<const LinearSystem>(LinearSystem::positiveDefinite(
      {.function = function, .matrix = "M + t L", .if_too_large = IfTooLarge::nothing}, matrix, options));
  if (system->report().iterative) return nullptr;
  return system;
}

/// Rounds of heat that are solved with the factors of the whole matrix.
class RoundsByFactor : public HeatRounds {
 public:
  RoundsByFactor(const std::string& function, const HeatProblem& problem, const VectorXd& heat,
                 const Progress& progress, DistanceReport& report)
      : function_(function),
        problem_(problem),
        progress_(progress),
        heat_(heat),
        passed_(static_cast<std::size_t>(heat.size()), 0),
        report_(report) {
    log_valid_ = std::log(valid);
  }

  bool next() override {
    if (report_.rounds > 0 && !restart()) return false;
    ++report_.rounds;
    problem_.components.normalise(heat_);
    const HeatSystem& system = problem_.system;
    u_ = solve(*system.closed, heat_);
    if (system.ends()) u_ = (u_ + solve(*system.open, heat_.cwiseProduct(system.interior))) / 2;
    problem_.components.normalise(u_);
    log_heat_ = u_.array().max(0).log();  // -infinity without heat
    return true;
  }

 private:
  VectorXd solve(const LinearSystem& system, const VectorXd& heat) {
    SolveReport solved;
    VectorXd u = system.solve(function_, heat, &solved, progress_);
    report_.residual = greater(report_.residual, solved.residual);
    report_.backward_error = greater(report_.backward_error, solved.backward_error);
    return u;
  }

  /// Prepares the next round, which starts from the flow out of points that heat has reached into the others. Beyond
  /// the front its heat is nearly that without a restart, up to a factor (Huygens). Returns whether anything flows.
  bool restart() {
    const auto reached = [&](Eigen::Index i) { return u_[i] >= front; };
    bool advanced = false, flows = false;
    for (const int i : problem_.components.points) {
      if (!reached(i) || passed_[i] != 0) continue;
      passed_[i] = 1;
      advanced = true;
    }
    heat_.setZero();
    if (!advanced) return false;
    for (const int i : problem_.components.points) {
      if (passed_[i] != 0) continue;
      for (SparseMatrix::InnerIterator entry(problem_.L, i); entry; ++entry) {
        if (entry.row() != i && reached(entry.row())) heat_[i] -= entry.value() * (u_[entry.row()] / front);
      }
      flows |= heat_[i] > 0;
    }
    return flows;
  }

  const std::string& function_;
  const HeatProblem& problem_;
  const Progress& progress_;
  VectorXd heat_, u_;
  std::vector<std::uint8_t> passed_;
  DistanceReport& report_;
};

}  // namespace

// NOLINTNEXTLINE(performance-unnecessary-value-param): moved from, where Eigen can
HeatSystem makeHeatSystem(const std::string& function, SparseMatrix matrix, VectorXd interior,
                          const SolverOptions& options) {
  HeatSystem system;
  system.window = options;
  system.interior = std::move(interior);
  if (options.method != SolverMethod::multigrid) system.closed = factorise(function, matrix, options);
  if (system.closed && system.ends()) {
    SparseMatrix inner = matrix;
    inner.prune(
        [&](Eigen::Index i, Eigen::Index j, double) { return system.interior[i] != 0 && system.interior[j] != 0; });
    system.open = factorise(function, inner, options);
    if (!system.open) system.closed.reset();
  }
  if (!system.closed) {
    system.matrix = std::move(matrix);
    system.window.method = SolverMethod::automatic;
    system.window.tolerance = std::min(options.tolerance, heat_tolerance);
  }
  return system;
}

std::unique_ptr<HeatRounds> makeHeatRounds(const std::string& function, const HeatProblem& problem,
                                           const VectorXd& heat, const Progress& progress, DistanceReport& report) {
  if (problem.system.closed) return std::make_unique<RoundsByFactor>(function, problem, heat, progress, report);
  return std::make_unique<HeatWindows>(function, problem, heat, progress, report);
}

}  // namespace tufted
