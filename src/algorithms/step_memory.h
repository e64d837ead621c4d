#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <deque>
#include <utility>
#include <vector>

namespace tufted {

/// Descent directions of L-BFGS (Nocedal and Wright: "Numerical Optimization", Algorithm 7.4): the last steps correct a
/// fixed guess of the second derivatives.
class StepMemory {
 public:
  /// The next step.
  /// @param force minus the gradient
  /// @param solve returns for a force the step after which it would be 0, by the guess
  template <class Solve>
  Eigen::MatrixXd direction(Eigen::MatrixXd force, const Solve& solve) const {
    std::vector<double> shares(steps_.size());
    for (std::size_t k = steps_.size(); k-- > 0;) {
      shares[k] = product(steps_[k].step, force) / steps_[k].product;
      force -= shares[k] * steps_[k].change;
    }
    Eigen::MatrixXd found = solve(force);
    for (std::size_t k = 0; k < steps_.size(); ++k)
      found += (shares[k] - product(steps_[k].change, found) / steps_[k].product) * steps_[k].step;
    return found;
  }

  /// Stores a step, unless the force does not fall along it.
  /// @param change the force before the step minus that after it
  void add(Eigen::MatrixXd step, Eigen::MatrixXd change) {
    const double fall = product(step, change);
    if (!(fall > least_fall * step.norm() * change.norm())) return;
    if (steps_.size() == most_steps) steps_.pop_front();
    steps_.push_back({std::move(step), std::move(change), fall});
  }

  bool empty() const { return steps_.empty(); }
  void clear() { steps_.clear(); }

  static double product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) { return a.cwiseProduct(b).sum(); }

 private:
  /// Steps that are stored, about a kilobyte per point. With 5 a twisted tube took 56 iterations instead of 31.
  static constexpr std::size_t most_steps = 10;
  /// A step whose cosine with `change` is below this is not stored: the product is rounding, and a divisor later.
  static constexpr double least_fall = 1e-12;

  struct Step {
    Eigen::MatrixXd step, change;
    double product;
  };
  std::deque<Step> steps_;  ///< oldest first
};

}  // namespace tufted
