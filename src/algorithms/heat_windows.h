#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algorithms/heat_rounds.h"

namespace tufted {

/// Rounds of heat for systems that are too large for a factor. Each round solves only a window: the points within some
/// edges beyond those that heat has passed. Heat falls to a third with every edge, so farther points do not matter.
/// Passed points keep their heat, so that it continues as in one large solve. All windows cost as much as a few solves
/// of the whole system.
class HeatWindows : public HeatRounds {
 public:
  HeatWindows(const std::string& function, const HeatProblem& problem, const VectorXd& heat, const Progress& progress,
              DistanceReport& report);

  bool next() override;

 private:
  bool restart();
  void scalePassed(const Eigen::VectorXd& factors);
  void findWindow();
  VectorXd solve();
  void solveSystem(bool open);

  const std::string& function_;
  const HeatProblem& problem_;
  const Progress& progress_;
  DistanceReport& report_;
  int layers_;
  double log_front_ = 0;              ///< logarithm of the heat where the next round starts
  VectorXd heat_;                     ///< N; the flow into the points ahead
  VectorXd u_;                        ///< N; the heat of the window, 0 elsewhere
  std::vector<std::uint8_t> passed_;  ///< N; whether heat has been here in an earlier round
  std::vector<int> rim_;              ///< passed points that have neighbours ahead
  std::vector<int> window_;           ///< points ahead, layer by layer
  std::vector<int> number_;           ///< N; row of each point in the system being solved, -1: none
  std::size_t outer_ = 0;             ///< place in `window_` where its last layer begins
  bool by_factor_ = false;            ///< whether the window was solved with a factor
};

}  // namespace tufted
