#pragma once

#include <Eigen/Core>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/solver.h"
#include "tufted/types.h"

namespace tufted {

/// Points whose values are given. A pin at a coincident point is one at its representative; several at one place give
/// their mean.
struct Pins {
  std::vector<int> points;  ///< P
  Eigen::MatrixXd values;   ///< P x c, finite
};

/// The smoothest function with given values: L u = 0 at all other points, for each of the c columns (Section 5.5).
///
/// Each value lies within the range of the pinned values of its component, and so it does at boundaries, as L is an
/// M-matrix. Rounding takes it at most 1e-12 of that range outside, or by the last digit of values that are large
/// beside it; nothing is clamped. With a single pin the component is constant.
///
/// What a first solve leaves is solved for again until rounding is all that is left, whatever `options.tolerance`: a
/// last correction of more than 1e-12 of the range is a SolverFailure. Parts that next to nothing joins to a pin (see
/// WeakJoint) are solved for as parts. The report's iterations are those of all these solves, and its residual is what
/// is missing in the end, over what was missing of the constant that is the mean of the pins.
/// @return N x c. NaN in components without a pin and, unless pinned, at points that are isolated or not finite; a
///         coincident point has its representative's values
/// @throws InvalidInput for an index out of range, arrays of different sizes, values that are not finite, or no pin on
///         any component
/// @throws SolverFailure when the system cannot be solved to these digits, or sums of values overflow
/// @throws Cancelled when `options.progress` returns false
Eigen::MatrixXd harmonic(const Laplacian& laplacian, const Pins& pins, const SolverOptions& options = {},
                         SolveReport* report = nullptr);

/// The function of least bending with given values: the least sum over M of the squared Laplacian, so L M^-1 L u = 0 at
/// all other points. Smooth at the pins, where harmonic functions have peaks, but not bounded by their values; at a
/// boundary it meets the rim at a right angle, as L does not see beyond. The report is that of harmonic(); here a last
/// correction of more than 1e-3 of the range is a SolverFailure.
///
/// Multigrid is not fit for this: where a factor exceeds `options.memory_limit` it is a SolverFailure.
/// @return, @throws as harmonic()
Eigen::MatrixXd biharmonic(const Laplacian& laplacian, const Pins& pins, const SolverOptions& options = {},
                           SolveReport* report = nullptr);

/// The mean over the connected component of each point, weighted by M: what poisson() takes out of f.
/// @param values N x c; those of points that are not active are not looked at
/// @return N x c; 0 at points that are isolated or not finite
/// @throws InvalidInput for a wrong number of rows
Eigen::MatrixXd componentMeans(const Laplacian& laplacian, const Eigen::MatrixXd& values);

/// Solves L u = M f: minus the Laplacian of u is f. On a component that is only possible where f has mean 0, so its
/// mean (weighted by M) is taken out; and u is made to have mean 0. Refined as harmonic() is.
/// @param f N x c, finite at active points
/// @return N x c, NaN at points that are isolated or not finite
/// @throws InvalidInput for a wrong number of rows, values that are not finite, or options out of range
/// @throws SolverFailure when the system cannot be solved; Cancelled when `options.progress` returns false
Eigen::MatrixXd poisson(const Laplacian& laplacian, const Eigen::MatrixXd& f, const SolverOptions& options = {},
                        SolveReport* report = nullptr);

/// The same with given values: L u = M f at all points that are not pinned.
/// @return, @throws as harmonic()
Eigen::MatrixXd poisson(const Laplacian& laplacian, const Eigen::MatrixXd& f, const Pins& pins,
                        const SolverOptions& options = {}, SolveReport* report = nullptr);

/// Green's function of points (Figure 19), a column for each: L g = delta - M / area, with mean 0 over the component.
/// On a sphere of radius 1 g approximates -(ln((1 - cos angle) / 2) + 1) / (4 pi).
/// @return N x c; 0 in other components, NaN at points that are isolated or not finite
/// @throws InvalidInput for no point, an index out of range or of a point on no component, or options out of range
/// @throws SolverFailure when the system cannot be solved; Cancelled when `options.progress` returns false
Eigen::MatrixXd greensFunction(const Laplacian& laplacian, const std::vector<int>& points,
                               const SolverOptions& options = {}, SolveReport* report = nullptr);

}  // namespace tufted
