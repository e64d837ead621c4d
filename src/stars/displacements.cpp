#include "stars/displacements.h"

#include <algorithm>

#include "stars/tangent_frame.h"

namespace tufted {
void takeMoved(const PointsView& points, const PointBuffer& moved, int p, std::span<const int> neighbors,
               OffsetBuffer& offsets) {
  offsets.fill(static_cast<int>(neighbors.size()), [&](int i) -> Eigen::RowVector3d {
    const int q = neighbors[i];
    return points.row(q) - points.row(p) + moved.row(q) - moved.row(p);
  });
}

void displaceNoisyPoints(const PointBuffer& moved, int first, std::span<const Neighborhood> neighborhoods,
                         std::span<const OffsetBuffer> offsets, FitScratch& scratch, PointBuffer& displacement,
                         NoisyPoints& noisy) {
  for (std::size_t i = 0; i < neighborhoods.size(); ++i)
    scratch.moments[i] = heightMoments(offsets[i].view(), neighborhoods[i].axes.normal, neighborhoods[i].fit_radius);
  fitHeights(std::span(scratch.moments).first(neighborhoods.size()), scratch.fits);
  for (std::size_t i = 0; i < neighborhoods.size(); ++i) {
    const PrincipalAxes& axes = neighborhoods[i].axes;
    const int p = first + static_cast<int>(i);
    if (moved.rows() > 0 && !moved.row(p).isZero(0)) continue;
    if (!isNoisy(scratch.fits[i], axes.variance[0] * axes.extent * axes.extent, neighborhoods[i].fit_radius)) continue;
    displacement.row(p) = scratch.fits[i].height * axes.normal.transpose();
    noisy.rank.push_back(p);
    const std::size_t begin = noisy.neighbors.size();
    noisy.neighbors.resize(begin + neighborhoods[i].neighbors.size());
    std::ranges::transform(neighborhoods[i].neighbors, noisy.neighbors.begin() + begin, &Neighbor::index);
    noisy.end.push_back(noisy.neighbors.size());
  }
}

void displaceOnceMore(const PointsView& points, const PointBuffer& moved, const NoisyPoints& noisy,
                      const RawBuffer<double>& fit_radius, std::span<OffsetBuffer> offsets, FitScratch& scratch,
                      PointBuffer& displacement) {
  std::array<Covariance, FitScratch::most> covariances;
  std::array<PrincipalAxes, FitScratch::most> axes;
  std::size_t begin = 0;  // of the neighbours of each
  for (std::size_t group = 0; group < noisy.rank.size(); group += FitScratch::most) {
    const std::size_t count = std::min<std::size_t>(FitScratch::most, noisy.rank.size() - group);
    const auto ranks = std::span<const int>(noisy.rank).subspan(group, count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t end = noisy.end[group + i];
      takeMoved(points, moved, ranks[i], std::span<const int>(noisy.neighbors).subspan(begin, end - begin), offsets[i]);
      covariances[i] = covarianceOf(offsets[i].view(), fit_radius[ranks[i]]);
      begin = end;
    }
    principalAxes(std::span(covariances).first(count), axes);
    for (std::size_t i = 0; i < count; ++i)
      scratch.moments[i] = heightMoments(offsets[i].view(), axes[i].normal, fit_radius[ranks[i]]);
    fitHeights(std::span(scratch.moments).first(count), scratch.fits);
    for (std::size_t i = 0; i < count; ++i)
      if (scratch.fits[i].is_valid) displacement.row(ranks[i]) += scratch.fits[i].height * axes[i].normal.transpose();
  }
}

}  // namespace tufted
