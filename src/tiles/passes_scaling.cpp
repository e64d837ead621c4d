#include "tiles/passes_scaling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/infinity.h"

namespace tufted {
namespace {

constexpr std::int64_t samples = 65536;  // 512 kB per coordinate, and then 2 % of all values lie between the bounds
/// The median of all is first searched between the samples so many places beside their median: four standard
/// deviations.
constexpr std::ptrdiff_t beside = 512;

/// The exact median of values that are given in passes: only those near the median of a sample are kept.
class MedianSearch {
 public:
  explicit MedianSearch(std::vector<double> sample) : sample_(std::move(sample)) {
    std::sort(sample_.begin(), sample_.end());
    bound();
  }

  void take(double value) {
    if (is_done_) return;
    if (value < least_)
      ++below_;
    else if (value > most_)
      ++above_;
    else if (value == least_)  // many values may equal a bound, as on a lattice
      ++at_least_;
    else if (value == most_)
      ++at_most_;
    else
      between_.push_back(value);
  }

  /// Ends a pass. Of an even number the median is the upper one of the two in the middle, and of no values it is 0.
  /// @returns false if another pass is needed, with wider bounds
  bool finish(double& median) {
    if (is_done_) return true;
    const auto kept = std::ssize(between_);
    std::int64_t rank = (below_ + at_least_ + kept + at_most_ + above_) / 2 - below_;
    if (below_ + at_least_ + kept + at_most_ + above_ == 0) {
      median = 0;
    } else if (rank < 0 || rank >= at_least_ + kept + at_most_) {
      beside_ *= 8;
      bound();
      return false;
    } else if (rank < at_least_) {
      median = least_;
    } else if ((rank -= at_least_) >= kept) {
      median = most_;
    } else {
      std::nth_element(between_.begin(), between_.begin() + rank, between_.end());
      median = between_[rank];
    }
    return is_done_ = true;
  }

 private:
  void bound() {
    const std::ptrdiff_t size = std::ssize(sample_), middle = size / 2;
    least_ = middle - beside_ > 0 ? sample_[middle - beside_] : -infinity;
    most_ = middle + beside_ < size ? sample_[middle + beside_] : infinity;
    below_ = above_ = at_least_ = at_most_ = 0;
    between_.clear();
  }

  std::vector<double> sample_, between_;
  std::ptrdiff_t beside_ = beside;
  double least_ = 0, most_ = 0;
  bool is_done_ = false;
  std::int64_t below_ = 0, above_ = 0, at_least_ = 0, at_most_ = 0;
};

/// Calls visit(row) for all finite points, in a pass.
template <class Visit>
void forFinite(const PointSource& source, const Visit& visit) {
  source.pass([&](const PointsRef& batch) {
    for (Eigen::Index i = 0; i < batch.rows(); ++i)
      if (const Eigen::RowVector3d row = batch.row(i); row.allFinite()) visit(row);
  });
}

double deviationOf(const Scaling& scaling, const Eigen::RowVector3d& point) {
  return (point - scaling.center.transpose()).cwiseAbs().maxCoeff();
}

}  // namespace

bool takesPart(const Scaling& scaling, const Eigen::RowVector3d& point) {
  return point.allFinite() && isWithinReach(scaling, deviationOf(scaling, point));
}

Scaling measureScaling(const PointSource& source) {
  const std::int64_t stride = std::max<std::int64_t>(1, source.size / samples);
  std::vector<Eigen::RowVector3d> sample;
  std::int64_t number = 0;
  source.pass([&](const PointsRef& batch) {
    for (Eigen::Index i = 0; i < batch.rows(); ++i)
      if (number++ % stride == 0 && batch.row(i).allFinite()) sample.push_back(batch.row(i));
  });
  const auto sampled = [&](const auto& valueOf) {
    std::vector<double> values;
    for (const Eigen::RowVector3d& point : sample) values.push_back(valueOf(point));
    return values;
  };

  Scaling scaling;
  std::array<MedianSearch, 3> axes = {MedianSearch(sampled([](const auto& p) { return p.x(); })),
                                      MedianSearch(sampled([](const auto& p) { return p.y(); })),
                                      MedianSearch(sampled([](const auto& p) { return p.z(); }))};
  for (bool done = false; !done;) {
    forFinite(source, [&](const Eigen::RowVector3d& point) {
      for (int axis = 0; axis < 3; ++axis) axes[axis].take(point[axis]);
    });
    done = true;
    for (int axis = 0; axis < 3; ++axis) done = axes[axis].finish(scaling.center[axis]) && done;
  }

  std::vector<double> deviations = sampled([&](const auto& p) { return deviationOf(scaling, p); });
  std::erase_if(deviations, [](double deviation) { return !(deviation > 0); });
  MedianSearch spreads(std::move(deviations));
  double spread = 0;
  do {
    forFinite(source, [&](const Eigen::RowVector3d& point) {
      if (const double deviation = deviationOf(scaling, point); deviation > 0) spreads.take(deviation);
    });
  } while (!spreads.finish(spread));
  if (spread > 0 && std::isfinite(spread)) std::frexp(spread, &scaling.exponent);

  double largest = 0;
  Eigen::Array3d lowest = Eigen::Array3d::Constant(infinity);
  forFinite(source, [&](const Eigen::RowVector3d& point) {
    if (!isWithinReach(scaling, deviationOf(scaling, point))) return;
    largest = std::max(largest, point.cwiseAbs().maxCoeff());
    lowest = lowest.min(point.transpose().array());
  });
  scaling.lowest = lowest;
  widenUnit(scaling, largest);
  return scaling;
}

}  // namespace tufted
