// Step 1 of the heat method (Crane, Weischedel, Wardetzky 2013, 2017), the spread of heat, on several processes.
#include "mpi/heat_spread.h"

#include <petscksp.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/infinity.h"
#include "mpi/petsc.h"
#include "mpi/point_values.h"
#include "mpi/rows.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// First width of a window in edges.
constexpr int first_layers = 32;
/// Tolerance of conjugate gradients, and the part of a window's greatest heat above which heat is kept.
constexpr double tolerance = 1e-13, least_kept = 1e-5;
/// Beyond a window heat is taken for 0. Heat is kept above this many times the greatest at the window's rim: the
/// relative error is the square of their ratio.
constexpr double above_rim = 1e6;
/// A window from which only heat above this part of the greatest could be kept is widened.
constexpr double highest_kept = 1e-3;

/// The sum over all processes.
std::int64_t sumOf(const DistributedLaplacian& laplacian, std::int64_t number) {
  MPI_Allreduce(MPI_IN_PLACE, &number, 1, MPI_INT64_T, MPI_SUM, commOf(laplacian));
  return number;
}

class HeatSpread {
 public:
  HeatSpread(const DistributedLaplacian& laplacian, const Ghosts& rows, const std::vector<double>& diagonal,
             const std::vector<std::uint8_t>& is_source, const std::vector<std::uint8_t>& is_cold)
      : laplacian_(laplacian),
        rows_(rows),
        is_source_(is_source),
        is_cold_(is_cold),
        log_u_(static_cast<std::size_t>(rows.size()), -infinity) {
    check(VecGetOwnershipRange(laplacian.M.get(), &first_, nullptr));
    for (int i = 0; i < rows.own(); ++i) {
      PetscInt count = 0;
      const PetscInt* columns = nullptr;
      const PetscScalar* values = nullptr;
      check(MatGetRow(laplacian.L.get(), first_ + i, &count, &columns, &values));
      for (PetscInt e = 0; e < count; ++e) {
        if (columns[e] == first_ + i || !(values[e] < 0)) continue;
        from_.push_back(rows.numberOf(columns[e]));
        weight_.push_back(-values[e]);
      }
      begin_.push_back(from_.size());
      check(MatRestoreRow(laplacian.L.get(), first_ + i, &count, &columns, &values));
    }
    check(MatDuplicate(laplacian.L.get(), MAT_COPY_VALUES, matrix_.make()));
    PetscVector added = like(laplacian.M.get());
    setLocal(added.get(), diagonal);
    check(MatDiagonalSet(matrix_.get(), added.get(), ADD_VALUES));
  }

  std::vector<double> run() {
    for (int layers = first_layers; findInflow(); layers = std::max(first_layers, layers / 2)) {
      window_size_ = 0;
      while (!solveWindow(layers)) layers *= 2;
      rows_.update(log_u_);
    }
    return log_u_;
  }

 private:
  bool isFound(int row) const { return log_u_[row] > -infinity; }
  bool isAhead(int row) const { return is_cold_[row] == 0 && !isFound(row); }

  /// Finds the heat that flows into rows ahead from those that are found, and whether there is any.
  bool findInflow() {
    entry_.clear();
    inflow_.clear();
    for (int i = 0; i < rows_.own(); ++i) {
      if (!isAhead(i)) continue;
      double top = is_source_[i] != 0 ? 0 : -infinity;
      for (std::size_t e = begin_[i]; e < begin_[i + 1]; ++e) top = std::max(top, log_u_[from_[e]]);
      if (top == -infinity) continue;
      double sum = is_source_[i] != 0 ? std::exp(-top) : 0;
      for (std::size_t e = begin_[i]; e < begin_[i + 1]; ++e) sum += weight_[e] * std::exp(log_u_[from_[e]] - top);
      entry_.push_back(i);
      inflow_.push_back(top + std::log(sum));
    }
    unit_ = greatestOfComponents(laplacian_, entry_, inflow_, -infinity);
    return std::any_of(unit_.begin(), unit_.end(), [](double unit) { return unit > -infinity; });
  }

  /// The rows ahead that are at most some edges from an inflow.
  std::vector<int> windowOf(int layers) const {
    std::vector<double> depth(static_cast<std::size_t>(rows_.size()), infinity);
    std::vector<int> next = entry_, now;
    for (const int row : entry_) depth[row] = 0;
    std::vector<int> window = entry_;
    for (int goes_on = 1; goes_on != 0;) {
      while (!next.empty()) {
        now.swap(next);
        next.clear();
        for (const int i : now)
          for (std::size_t e = begin_[i]; e < begin_[i + 1]; ++e) {
            const int j = from_[e];
            if (j >= rows_.own() || depth[i] + 1 >= std::min<double>(depth[j], layers) || !isAhead(j)) continue;
            if (depth[j] == infinity) window.push_back(j);
            depth[j] = depth[i] + 1;
            next.push_back(j);
          }
      }
      rows_.update(depth);
      for (int i = 0; i < rows_.own(); ++i) {
        if (!isAhead(i)) continue;
        const double before = depth[i];
        for (std::size_t e = begin_[i]; e < begin_[i + 1]; ++e)
          if (from_[e] >= rows_.own() && depth[from_[e]] + 1 < std::min<double>(depth[i], layers))
            depth[i] = depth[from_[e]] + 1;
        if (depth[i] == before) continue;
        if (before == infinity) window.push_back(i);
        next.push_back(i);
      }
      goes_on = next.empty() ? 0 : 1;
      MPI_Allreduce(MPI_IN_PLACE, &goes_on, 1, MPI_INT, MPI_MAX, commOf(laplacian_));
    }
    std::sort(window.begin(), window.end());
    return window;
  }

  /// Solves for the heat of a window, in units of the inflow of each component.
  std::vector<double> heatOf(const std::vector<int>& window) const {
    const MPI_Comm comm = commOf(laplacian_);
    std::vector<double> inflow(static_cast<std::size_t>(rows_.own()));
    for (std::size_t k = 0; k < entry_.size(); ++k)
      inflow[entry_[k]] = std::exp(inflow_[k] - unit_[laplacian_.component[entry_[k]]]);
    std::vector<PetscInt> numbers;
    std::vector<double> right;
    for (const int row : window) {
      numbers.push_back(first_ + row);
      right.push_back(inflow[row]);
    }
    PetscHandle<IS, ISDestroy> chosen;
    check(
        ISCreateGeneral(comm, static_cast<PetscInt>(numbers.size()), numbers.data(), PETSC_USE_POINTER, chosen.make()));
    PetscMatrix A;
    check(MatCreateSubMatrix(matrix_.get(), chosen.get(), chosen.get(), MAT_INITIAL_MATRIX, A.make()));
    PetscVector b, u;
    check(MatCreateVecs(A.get(), u.make(), b.make()));
    setLocal(b.get(), right);
    PetscHandle<KSP, KSPDestroy> solver;
    PC preconditioner = nullptr;
    check(KSPCreate(comm, solver.make()));
    check(KSPSetOperators(solver.get(), A.get(), A.get()));
    check(KSPSetType(solver.get(), KSPCG));
    check(KSPGetPC(solver.get(), &preconditioner));
    check(PCSetType(preconditioner, PCJACOBI));
    check(KSPSetTolerances(solver.get(), tolerance, PETSC_DEFAULT, PETSC_DEFAULT, 100000));
    check(KSPSolve(solver.get(), b.get(), u.get()));
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    check(KSPGetConvergedReason(solver.get(), &reason));
    if (reason < 0) throw SolverFailure("distance: conjugate gradients for heat did not converge");
    return localOf(u.get());
  }

  /// The window's rows beside rows ahead that are not in it.
  std::vector<double> isAtRim(const std::vector<int>& window) const {
    // By row, whether a neighbour of it must be in the window.
    std::vector<double> is_outside(static_cast<std::size_t>(rows_.size()));
    for (int i = 0; i < rows_.own(); ++i) is_outside[i] = isAhead(i) ? 1 : 0;
    for (const int row : window) is_outside[row] = 0;
    rows_.update(is_outside);
    std::vector<double> is_at_rim;
    for (const int row : window) {
      const auto begin = from_.begin() + static_cast<std::ptrdiff_t>(begin_[row]);
      const auto end = from_.begin() + static_cast<std::ptrdiff_t>(begin_[row + 1]);
      is_at_rim.push_back(std::any_of(begin, end, [&](int j) { return is_outside[j] != 0; }) ? 1 : 0);
    }
    return is_at_rim;
  }

  /// Finds rows of a window. Returns false if it must be wider for that.
  bool solveWindow(int layers) {
    const std::vector<int> window = windowOf(layers);
    const std::int64_t size = sumOf(laplacian_, std::ssize(window));
    const bool may_widen = size > window_size_;  // false: all that can be reached is in the window
    window_size_ = size;
    const std::vector<double> u = heatOf(window);
    std::vector<double> at_rim = isAtRim(window);
    for (std::size_t k = 0; k < u.size(); ++k) at_rim[k] *= u[k];
    const std::vector<double> top = greatestOfComponents(laplacian_, window, u, 0);
    std::vector<double> kept = greatestOfComponents(laplacian_, window, at_rim, 0);
    for (std::size_t c = 0; c < top.size(); ++c) {
      kept[c] = std::max(least_kept * top[c], above_rim * kept[c]);
      if (kept[c] > highest_kept * top[c] && may_widen) return false;
    }
    std::int64_t found = 0;
    for (std::size_t k = 0; k < u.size(); ++k) {
      const PetscInt c = laplacian_.component[window[k]];
      if (!(u[k] >= std::min(kept[c], top[c]) && u[k] > 0)) continue;
      log_u_[window[k]] = unit_[c] + std::log(u[k]);
      ++found;
    }
    if (sumOf(laplacian_, found) == 0) throw SolverFailure("distance: no heat leaves the rows that are known");
    return true;
  }

  const DistributedLaplacian& laplacian_;
  const Ghosts& rows_;
  const std::vector<std::uint8_t>& is_source_;
  const std::vector<std::uint8_t>& is_cold_;
  PetscInt first_ = 0;
  PetscMatrix matrix_;  ///< D + L
  // Entries of L in the rows of this process off the diagonal, without their sign.
  std::vector<std::size_t> begin_ = {0};
  std::vector<int> from_;
  std::vector<double> weight_;
  std::vector<double> log_u_;
  std::vector<int> entry_;        ///< rows ahead with an inflow
  std::vector<double> inflow_;    ///< its logarithm
  std::vector<double> unit_;      ///< by component, its greatest
  std::int64_t window_size_ = 0;  ///< of the last window of this round, in all processes
};

}  // namespace

std::vector<double> logOfHeat(const DistributedLaplacian& laplacian, const Ghosts& rows,
                              const std::vector<double>& diagonal, const std::vector<std::uint8_t>& is_source,
                              const std::vector<std::uint8_t>& is_cold) {
  return HeatSpread(laplacian, rows, diagonal, is_source, is_cold).run();
}

}  // namespace tufted
