#include "neighbors/run_boxes.h"

#include <algorithm>

namespace tufted {
namespace {

/// Points per run. A million points have 3,907 runs, of which a ball of 1,000 points meets about 20.
constexpr std::int64_t run_size = 256;

}  // namespace

RunBoxes::RunBoxes(const PointsView& points, const Workers& workers)
    : points_(points), boxes_(static_cast<std::size_t>((points.rows() + run_size - 1) / run_size)) {
  workers.forBlocks("boxes", points.rows(), run_size, [this](std::int64_t begin, std::int64_t end, int) {
    Box box = {points_.row(begin).transpose(), points_.row(begin).transpose()};
    for (int p = static_cast<int>(begin) + 1; p < end; ++p) {
      const Eigen::Vector3d at = points_.row(p).transpose();
      box.least = box.least.cwiseMin(at);
      box.greatest = box.greatest.cwiseMax(at);
    }
    boxes_[begin / run_size] = box;
  });
}

int RunBoxes::first(std::size_t run) const {
  return static_cast<int>(std::min<std::int64_t>(static_cast<std::int64_t>(run) * run_size, points_.rows()));
}

}  // namespace tufted
