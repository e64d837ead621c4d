#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/solver.h"
#include "tufted/types.h"

namespace tufted {

/// Points whose values are given. A pin at a coincident point counts as one at its representative; several pins at one
/// place count as one with their mean.
struct Pins {
  std::vector<int> points;  ///< P indices
  Eigen::MatrixXd values;   ///< P x c, finite
};

/// The smoothest function with given values: L u = 0 at all other points, for each of the c columns (Sharp and Crane
/// 2020, Section 5.5).
///
/// Every value lies within the range of the pinned values of its component, also at boundaries, as L is an M-matrix.
/// Rounding takes it outside by at most 1e-12 of that range, or by the last digit of values that are large compared
/// with the range; nothing is clamped. With a single pin the component is constant.
///
/// The solution is corrected until only rounding is left, whatever `options.tolerance`: a last correction of more than
/// 1e-12 of the range is a SolverFailure. Parts that are nearly disconnected from all pins (see WeakJoint) are solved
/// for as parts. The report's iterations are those of all these solves, and its residual is the final one over that of
/// the constant which is the mean of the pins.
/// @return N x c. NaN in components without a pin and, unless pinned, at points that are isolated or not finite; a
///         coincident point has its representative's values
/// @throws InvalidInput for an index out of range, arrays of different sizes, values that are not finite, or no pin on
///         any component
/// @throws SolverFailure when the system cannot be solved to these digits, or sums of values overflow
/// @throws Cancelled when `options.progress` returns false
Eigen::MatrixXd harmonic(const Laplacian& laplacian, const Pins& pins, const SolverOptions& options = {},
                         SolveReport* report = nullptr);

/// The function of least bending with given values: the least sum over M of the squared Laplacian, so L M^-1 L u = 0 at
/// all other points. It is smooth at the pins, where harmonic functions have peaks, but not bounded by their values; at
/// a boundary it meets the rim at a right angle, as L does not see beyond. The report is as that of harmonic(), but
/// only a last correction of more than 1e-3 of the range is a SolverFailure.
///
/// Multigrid is not fit for this system: a factor that exceeds `options.memory_limit` is a SolverFailure.
/// The result and the errors are otherwise those of harmonic().
Eigen::MatrixXd biharmonic(const Laplacian& laplacian, const Pins& pins, const SolverOptions& options = {},
                           SolveReport* report = nullptr);

/// Which function InterpolationSolver finds.
enum class Interpolation {
  harmonic,    ///< that of harmonic(): within the range of the pins, with peaks at them
  biharmonic,  ///< that of biharmonic(): smooth at the pins, not bounded by them
};

/// The mean of `values` over the connected component of each point, weighted by M; poisson() subtracts it from f.
/// @param values N x c; those of points that are not active are ignored
/// @return N x c; 0 at points that are isolated or not finite
/// @throws InvalidInput for a wrong number of rows
Eigen::MatrixXd componentMeans(const Laplacian& laplacian, const Eigen::MatrixXd& values);

/// Solves L u = M f: minus the Laplacian of u is f. On a component this is only possible if f has mean 0, so the mean
/// of f (weighted by M) is subtracted; and u is made to have mean 0. The solution is corrected as in harmonic().
/// @param f N x c, finite at active points
/// @return N x c, NaN at points that are isolated or not finite
/// @throws InvalidInput for a wrong number of rows, values that are not finite, or options out of range
/// @throws SolverFailure when the system cannot be solved; Cancelled when `options.progress` returns false
Eigen::MatrixXd poisson(const Laplacian& laplacian, const Eigen::MatrixXd& f, const SolverOptions& options = {},
                        SolveReport* report = nullptr);

/// Solves L u = M f at all points that are not pinned, with given values at the pins. The result and the errors are as
/// those of harmonic().
Eigen::MatrixXd poisson(const Laplacian& laplacian, const Eigen::MatrixXd& f, const Pins& pins,
                        const SolverOptions& options = {}, SolveReport* report = nullptr);

/// harmonic(), biharmonic() and poisson() with pins at one set of points, factored once and queried often with other
/// values; queries may run side by side. The results are theirs bit for bit.
class InterpolationSolver {
 public:
  /// @param laplacian shared, as every query looks at it; it must not change
  /// @param points P indices: those of Pins, in the order of the values
  /// @throws InvalidInput for a null pointer, an index out of range, no point on any component, options out of range or
  ///         arrays of the wrong size
  /// @throws SolverFailure when the system cannot be factorised
  /// @throws Cancelled when `options.progress` returns false
  explicit InterpolationSolver(std::shared_ptr<const Laplacian> laplacian, std::vector<int> points,
                               Interpolation kind = Interpolation::harmonic, const SolverOptions& options = {});

  /// The function with these values at the pins, for each of the c columns.
  /// @param values P x c, finite
  /// @return as harmonic() or biharmonic(), whose errors it throws
  Eigen::MatrixXd interpolate(const Eigen::MatrixXd& values, SolveReport* report = nullptr,
                              const Progress& progress = {}) const;
  /// Solves L u = M f at all points that are not pinned, with these values at the pins. Of Interpolation::biharmonic
  /// the function whose Laplacian M^-1 L u is nearest to f, in the norm of M: L M^-1 L u = L f there.
  /// @param f N x c, finite at active points
  /// @param values P x c, finite
  /// @return as poisson() with pins, whose errors it throws
  Eigen::MatrixXd poisson(const Eigen::MatrixXd& f, const Eigen::MatrixXd& values, SolveReport* report = nullptr,
                          const Progress& progress = {}) const;

  /// What the constructor did.
  const SolverReport& report() const;

  /// A moved-from solver may only be destroyed or assigned to.
  InterpolationSolver(InterpolationSolver&&) noexcept;
  /// A moved-from solver may only be destroyed or assigned to.
  InterpolationSolver& operator=(InterpolationSolver&&) noexcept;
  ~InterpolationSolver();

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

/// Green's function of points (Sharp and Crane 2020, Figure 19), one column for each point: L g = delta - M / area,
/// with mean 0 over the component.
/// On a sphere of radius 1 g approximates -(ln((1 - cos angle) / 2) + 1) / (4 pi).
/// @return N x c; 0 in other components, NaN at points that are isolated or not finite
/// @throws InvalidInput for no point, an index out of range, a point on no component, or options out of range
/// @throws SolverFailure when the system cannot be solved; Cancelled when `options.progress` returns false
Eigen::MatrixXd greensFunction(const Laplacian& laplacian, const std::vector<int>& points,
                               const SolverOptions& options = {}, SolveReport* report = nullptr);

/// poisson() without pins and greensFunction(), factored once and queried often; queries may run side by side. The
/// results are theirs bit for bit.
class PoissonSolver {
 public:
  /// @param laplacian shared, as every query looks at its masses; it must not change
  /// @throws InvalidInput for a null pointer, options out of range or arrays of the wrong size
  /// @throws SolverFailure when L cannot be factorised
  /// @throws Cancelled when `options.progress` returns false
  explicit PoissonSolver(std::shared_ptr<const Laplacian> laplacian, const SolverOptions& options = {});

  /// Solves for one or several f; values and errors are those of poisson().
  Eigen::MatrixXd poisson(const Eigen::MatrixXd& f, SolveReport* report = nullptr, const Progress& progress = {}) const;
  /// A column for each point; values and errors are those of greensFunction().
  Eigen::MatrixXd green(const std::vector<int>& points, SolveReport* report = nullptr,
                        const Progress& progress = {}) const;

  /// What the constructor did.
  const SolverReport& report() const;

  /// A moved-from solver may only be destroyed or assigned to.
  PoissonSolver(PoissonSolver&&) noexcept;
  /// A moved-from solver may only be destroyed or assigned to.
  PoissonSolver& operator=(PoissonSolver&&) noexcept;
  ~PoissonSolver();

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

}  // namespace tufted
