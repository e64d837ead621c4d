#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/solver.h"
#include "tufted/types.h"

namespace tufted {

/// Points with given values. A pin at a coincident point is one at its representative; several pins at one place count
/// as one with their mean.
struct Pins {
  std::vector<int> points;  ///< P indices
  Eigen::MatrixXd values;   ///< P x c, finite, c >= 1
};

/// Computes the harmonic function with given values at the pins: L u = 0 at all other points, for each of the c columns
/// (Sharp and Crane 2020, Section 5.5).
///
/// Every value lies within the range of the pinned values of its component, also at boundaries, because L is an
/// M-matrix. Rounding takes it outside by at most 1e-12 of that range, or by the last digit of values that are large
/// compared with the range; nothing is clamped. With a single pin the component is constant.
///
/// The solution is corrected until only rounding is left, whatever `options.tolerance`: a last correction of more than
/// 1e-12 of the range is a SolverFailure. Parts that are nearly disconnected from all pins (see WeakJoint) are solved
/// separately. In the report, iterations are those of all these solves, and the residual is relative to that of a
/// constant function, the mean of the pins.
/// @return N x c. NaN on components without a pin and, unless pinned, at isolated and non-finite points; coincident
/// points as their representative
/// @throws InvalidInput for an index or option out of range, arrays of different sizes, no column, values that are not
/// finite, or no pin on any component
/// @throws SolverFailure when the system cannot be solved with this accuracy, or sums of values overflow
/// @throws Cancelled when `options.progress` returns false
Eigen::MatrixXd harmonic(const Laplacian& laplacian, const Pins& pins, const SolverOptions& options = {},
                         SolveReport* report = nullptr);

/// Computes the biharmonic function with given values at the pins: it minimises the integral of the squared Laplacian,
/// sum of M (M^-1 L u)^2, so L M^-1 L u = 0 at all other points. Unlike harmonic functions it has no peaks at the pins,
/// but it is not bounded by their values. At a boundary it meets the rim at a right angle, because L has no data
/// beyond. Here a last correction of more than 1e-3 of the range is a SolverFailure.
///
/// Multigrid is not fit for this system: a factor that exceeds `options.memory_limit` is a SolverFailure. Result,
/// report and errors are otherwise those of harmonic().
Eigen::MatrixXd biharmonic(const Laplacian& laplacian, const Pins& pins, const SolverOptions& options = {},
                           SolveReport* report = nullptr);

/// Which function InterpolationSolver computes.
enum class Interpolation {
  harmonic,    ///< harmonic(): within the range of the pins, with peaks at them
  biharmonic,  ///< biharmonic(): smooth at the pins, not bounded by them
};

/// Computes the mean of `values` over the connected component of each point, weighted by M; poisson() subtracts it from
/// f.
/// @param values N x c; those of points that are not active are ignored
/// @return N x c; 0 at isolated and non-finite points
/// @throws InvalidInput for a wrong number of rows
Eigen::MatrixXd componentMeans(const Laplacian& laplacian, const Eigen::MatrixXd& values);

/// Solves L u = M f, that is, -Delta u = f. On a component this has a solution only if f has mean 0, so the mean of f
/// (weighted by M) is subtracted there, and u has mean 0. The solution is corrected as in harmonic().
/// @param f N x c, finite at active points
/// @return N x c, NaN at isolated and non-finite points; coincident points as their representative
/// @throws InvalidInput for a wrong number of rows, values that are not finite, or options out of range
/// @throws SolverFailure when the system cannot be solved
/// @throws Cancelled when `options.progress` returns false
Eigen::MatrixXd poisson(const Laplacian& laplacian, const Eigen::MatrixXd& f, const SolverOptions& options = {},
                        SolveReport* report = nullptr);

/// Solves L u = M f at all points that are not pinned, with given values at the pins. Result and errors are those of
/// harmonic().
/// @param f N x c, finite at active points, with as many columns as `pins.values`
Eigen::MatrixXd poisson(const Laplacian& laplacian, const Eigen::MatrixXd& f, const Pins& pins,
                        const SolverOptions& options = {}, SolveReport* report = nullptr);

/// harmonic(), biharmonic() and poisson() for one set of pinned points: factored once, queried often with other values;
/// queries may run in parallel. The results have the same bits as those functions'.
class InterpolationSolver {
 public:
  /// @param laplacian not needed after construction
  /// @param points P indices, see Pins, in the order in which queries give values
  /// @throws InvalidInput for an index out of range, no point on any component, options out of range or
  ///         arrays of the wrong size
  /// @throws SolverFailure when the system cannot be factorised
  /// @throws Cancelled when `options.progress` returns false
  explicit InterpolationSolver(const Laplacian& laplacian, std::vector<int> points,
                               Interpolation kind = Interpolation::harmonic, const SolverOptions& options = {});

  /// Computes the harmonic or biharmonic function with these values at the pins, for each of the c columns.
  /// @param values P x c, finite
  /// @return N x c; results and errors are those of harmonic() or biharmonic()
  Eigen::MatrixXd query(const Eigen::MatrixXd& values, SolveReport* report = nullptr,
                        const Progress& progress = {}) const;
  /// Solves L u = M f at all points that are not pinned, with these values at the pins. With Interpolation::biharmonic
  /// it computes the function whose Laplacian M^-1 L u is nearest to f in the norm of M: L M^-1 L u = L f there.
  /// @param f N x c, finite at active points
  /// @param values P x c, finite
  /// @return N x c; results and errors are those of poisson() with pins
  Eigen::MatrixXd queryPoisson(const Eigen::MatrixXd& f, const Eigen::MatrixXd& values, SolveReport* report = nullptr,
                               const Progress& progress = {}) const;

  /// How the constructor factored its system.
  const SolverReport& report() const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

/// Computes Green's functions of points (Sharp and Crane 2020, Figure 19), one column for each: L g = delta - M / area,
/// with mean 0 over the component. On a sphere of radius 1 g approximates -(ln((1 - cos angle) / 2) + 1) / (4 pi).
/// @param points c indices
/// @return N x c, no unit; 0 on other components, NaN at isolated and non-finite points; coincident points as their
/// representative
/// @throws InvalidInput for no point, an index out of range, a point on no component, or options out of range
/// @throws SolverFailure when the system cannot be solved
/// @throws Cancelled when `options.progress` returns false
Eigen::MatrixXd greensFunction(const Laplacian& laplacian, const std::vector<int>& points,
                               const SolverOptions& options = {}, SolveReport* report = nullptr);

/// poisson() without pins and greensFunction(): factored once, queried often; queries may run in parallel. The results
/// have the same bits as those functions'.
class PoissonSolver {
 public:
  /// @param laplacian not needed after construction
  /// @throws InvalidInput for options out of range or arrays of the wrong size
  /// @throws SolverFailure when L cannot be factorised
  /// @throws Cancelled when `options.progress` returns false
  explicit PoissonSolver(const Laplacian& laplacian, const SolverOptions& options = {});

  /// Solves L u = M f for one or several f; results and errors are those of poisson().
  Eigen::MatrixXd query(const Eigen::MatrixXd& f, SolveReport* report = nullptr, const Progress& progress = {}) const;
  /// Computes a Green's function for each point; results and errors are those of greensFunction().
  Eigen::MatrixXd queryGreen(const std::vector<int>& points, SolveReport* report = nullptr,
                             const Progress& progress = {}) const;

  /// How the constructor factored its system.
  const SolverReport& report() const;

 private:
  struct State;
  std::shared_ptr<const State> state_;
};

}  // namespace tufted
