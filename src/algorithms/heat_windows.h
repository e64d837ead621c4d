#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algorithms/heat_rounds.h"

namespace tufted {

/// Rounds of heat for systems that are too large for a factor. Each round solves only a window: the points within a
/// number of edges beyond those that heat has passed. As heat falls to a third with every edge, what lies farther away
/// does not matter, and as the points behind keep their heat, the wave goes on as if it had never stopped. All windows
/// together cost as much as a few solves of the whole system.
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
  double log_front_ = 0;              ///< logarithm of the heat below which the next round starts
  VectorXd heat_;                     ///< N; what flows into the points ahead
  VectorXd u_;                        ///< N; the heat of the window, 0 elsewhere
  std::vector<std::uint8_t> passed_;  ///< N; whether heat has been here in an earlier round
  std::vector<int> rim_;              ///< points passed that have neighbours ahead
  std::vector<int> window_;           ///< points ahead, layer by layer
  std::vector<int> number_;           ///< N; a point's place in the system being solved, -1: none
  std::size_t outer_ = 0;             ///< place in `window_` where its last layer begins
  bool by_factor_ = false;            ///< how the window was solved
};

}  // namespace tufted
