#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "base/ball.h"
#include "base/buffer.h"
#include "base/parallel.h"
#include "base/point_buffer.h"
#include "tufted/types.h"

namespace tufted {

/// Bounding boxes of runs of points along the Morton curve, so that a search for the points in a few balls visits few
/// runs.
class RunBoxes {
 public:
  /// @param points n x 3, borrowed for the life of this object
  RunBoxes(const PointsView& points, const Workers& workers);

  /// Calls visit(p) for the points in any of the balls, each once, ascending.
  template <class Visit>
  void visitBalls(const std::vector<Ball>& balls, const Visit& visit) const {
    std::vector<Ball> near;
    for (std::size_t run = 0; run < boxes_.size(); ++run) {
      near.clear();
      for (const Ball& ball : balls)
        if (gapTo(boxes_[run], ball.center) <= ball.radius) near.push_back(ball);
      if (near.empty()) continue;
      for (int p = first(run), end = first(run + 1); p < end; ++p) {
        const Eigen::Vector3d at = points_.row(p).transpose();
        if (std::any_of(near.begin(), near.end(),
                        [&at](const Ball& ball) { return (at - ball.center).norm() <= ball.radius; }))
          visit(p);
      }
    }
  }

 private:
  struct Box {
    Eigen::Vector3d least, greatest;
  };

  /// The distance from a position to a box; 0 within it.
  static double gapTo(const Box& box, const Eigen::Vector3d& place) {
    return (box.least - place).cwiseMax(place - box.greatest).cwiseMax(0).norm();
  }
  int first(std::size_t run) const;

  const PointsView points_;
  Buffer<Box> boxes_;
};

}  // namespace tufted
