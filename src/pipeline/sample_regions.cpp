#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/scaling.h"
#include "base/sort_unique.h"
#include "tufted/describe.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// A cloud may differ from place to place, but each ball has a rim, where builds do other work than inside. Of 12,500
/// points, one of eight shares of 100,000, less than 4 % lie on the rim.
constexpr int ball_count = 8;
constexpr int least_sample = 1000;  ///< balls of 125 points have more than one neighbourhood of 30 points

/// A ball of the sample, and its points.
struct Region {
  Eigen::RowVector3d center;
  PowerOfTwo scale;  ///< of distances, so that their squares do not underflow, and overflow only at outliers
  double squared_radius = 0;
  std::vector<std::pair<double, int>> inside;  ///< squared distances and indices

  double squaredDistance(const Eigen::RowVector3d& point) const {
    const Eigen::RowVector3d way = point - center;
    return Eigen::RowVector3d(scale.times(way[0]), scale.times(way[1]), scale.times(way[2])).squaredNorm();
  }
  void keepNearest(std::size_t count) {
    if (inside.size() <= count) return;
    std::nth_element(inside.begin(), inside.begin() + static_cast<std::ptrdiff_t>(count), inside.end());
    inside.resize(count);
  }
};

/// Every `stride`-th point, if it is finite.
std::vector<int> everyNth(const Points& points, Eigen::Index stride) {
  std::vector<int> some;
  for (Eigen::Index i = 0; i < points.rows(); i += stride)
    if (points.row(i).allFinite()) some.push_back(static_cast<int>(i));
  return some;
}

/// Chooses the radius of a ball so that it holds a little more than `share` points, by `some` of the points.
void chooseRadius(const Points& points, const std::vector<int>& some, Eigen::Index stride, std::size_t share,
                  Region& ball) {
  std::vector<double> squared;
  squared.reserve(some.size());
  for (const int i : some) squared.push_back(ball.squaredDistance(points.row(i)));
  // At least 8 points and half as many again, against the chance in counting few.
  const auto place = std::max<std::size_t>(8, 3 * share / (2 * static_cast<std::size_t>(stride)));
  ball.squared_radius = std::numeric_limits<double>::infinity();
  if (place >= squared.size()) return;
  std::nth_element(squared.begin(), squared.begin() + static_cast<std::ptrdiff_t>(place), squared.end());
  ball.squared_radius = squared[place];
}

}  // namespace

std::vector<int> sampleRegions(const Points& points, int most) {
  if (most < least_sample)
    throw InvalidInput("sampleRegions: most = " + std::to_string(most) + ", must be at least " +
                       std::to_string(least_sample));
  std::vector<int> sample;
  if (points.rows() <= most) {
    sample.resize(points.rows());
    std::iota(sample.begin(), sample.end(), 0);
    return sample;
  }
  const Eigen::Index stride = (points.rows() + most - 1) / most;
  const std::vector<int> some = everyNth(points, stride);
  if (some.empty()) return sample;
  const std::size_t share = static_cast<std::size_t>(most) / ball_count;
  std::vector<PointStatus> status;
  const PowerOfTwo scale = measureScaling(Points(points(some, Eigen::all)), status, Workers(1, {})).toScaled();
  std::vector<Region> balls;
  for (std::size_t b = 0; b < ball_count; ++b) {
    balls.push_back({points.row(some[(2 * b + 1) * some.size() / (2 * ball_count)]), scale, 0, {}});
    chooseRadius(points, some, stride, share, balls.back());
  }
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    for (Region& ball : balls) {
      const double squared = ball.squaredDistance(points.row(i));
      if (!(squared <= ball.squared_radius) || std::isinf(squared)) continue;
      ball.inside.emplace_back(squared, static_cast<int>(i));
      // Bounds the memory if most points lie at few places.
      if (ball.inside.size() >= 16 * share) ball.keepNearest(share);
    }
  }
  for (Region& ball : balls) {
    ball.keepNearest(share);
    for (const auto& [squared, i] : ball.inside) sample.push_back(i);
  }
  sortUnique(sample);
  return sample;
}

}  // namespace tufted
