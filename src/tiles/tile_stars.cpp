// What a tile learns from its stars: which of them are those of the whole cloud, and how far its rows depend on others.
#include <algorithm>
#include <utility>

#include "base/sort_unique.h"
#include "stars/gaps.h"
#include "stars/surface_stars.h"
#include "tiles/tile.h"

namespace tufted {
namespace {

CellBox boxOf(const RankedCloud& cloud, int p) {
  return CellBox::of(cloud.points.row(p).transpose().array());
}

}  // namespace

bool Tile::holdsAround(const CellBox& box, double radius) const {
  bool holds = true;
  cells_.visit(box, radius, [&](int cell) { holds = holds && is_held_[cell] != 0; });
  return holds;
}

void Tile::takeStars(const SurfaceStars& built, const RankedCloud& cloud) {
  cell_by_rank_.resize(static_cast<std::size_t>(cloud.size()));
  for (int p = 0; p < cloud.size(); ++p) cell_by_rank_[p] = cell_of_[cloud.input_index[p]];
  is_sure_ = is_held_;
  if (!is_whole_) {
    findCertainStars(built, cloud);
    findSureCells(built, cloud);
    measureDependence(built, cloud);
  }
  findPairs(built);
}

void Tile::findCertainStars(const SurfaceStars& built, const RankedCloud& cloud) {
  is_certain_.assign(cell_by_rank_.size(), 1);
  reach_.assign(is_held_.size(), 0);
  for (int p = 0, end = 0; p < cloud.size(); p = end) {
    double& reach = reach_[cell_by_rank_[p]];
    for (end = p; end < cloud.size() && cell_by_rank_[end] == cell_by_rank_[p]; ++end)
      reach = std::max(reach, built.support.reach[end]);
    if (holdsAround(cells_.box(cell_by_rank_[p]), reach)) continue;
    for (int q = p; q < end; ++q) is_certain_[q] = holdsAround(boxOf(cloud, q), built.support.reach[q]) ? 1 : 0;
  }
}

void Tile::findSureCells(const SurfaceStars& built, const RankedCloud& cloud) {
  const Stars& stars = built.stars;
  std::vector<std::uint8_t> has_certain = is_held_;
  for (int p = 0; p < cloud.size(); ++p)
    if (is_certain_[p] == 0) has_certain[cell_by_rank_[p]] = 0;
  needs_.assign(is_held_.size(), {});
  std::vector<int> needed_for(is_held_.size(), -1);  // the last cell in whose list each cell was put
  for (int p = 0, end = 0; p < cloud.size(); p = end) {
    const int cell = cell_by_rank_[p];
    const auto need = [&](int other) {
      if (std::exchange(needed_for[other], cell) != cell) needs_[cell].push_back(other);
    };
    // A filtered star depends on the neighbourhoods of its link vertices, and whether these are isolated on those of
    // their neighbours.
    const auto needNeighbors = [&](int q) {
      need(cell_by_rank_[q]);
      if (is_certain_[q] == 0) is_sure_[cell] = 0;
      if (!isolates_) return;
      cells_.visit(boxOf(cloud, q), built.support.fit_radius[q], [&](int other) {
        need(other);
        if (has_certain[other] == 0) is_sure_[cell] = 0;
      });
    };
    for (end = p; end < cloud.size() && cell_by_rank_[end] == cell; ++end) {
      needNeighbors(end);
      for (int i = stars.offset[end]; i < stars.offset[end + 1]; ++i) needNeighbors(stars.link[i]);
    }
  }
}

void Tile::measureDependence(const SurfaceStars& built, const RankedCloud& cloud) {
  const Stars& stars = built.stars;
  std::vector<double> reach(static_cast<std::size_t>(cloud.size())), farther;
  for (int hop = 0; hop < hops_; ++hop) {
    farther = reach;
    for (int p = 0; p < cloud.size(); ++p) {
      forEachTriangle(stars, p, [&](int a, int b) {
        for (const int q : {a, b}) {
          const double length = (cloud.points.row(q) - cloud.points.row(p)).norm();
          farther[p] = std::max(farther[p], length + reach[q]);
          farther[q] = std::max(farther[q], length + reach[p]);
        }
      });
    }
    reach.swap(farther);
  }
  dependence_.assign(is_own_.size(), 0);
  for (int p = 0; p < cloud.size(); ++p) {
    const int cell = cell_by_rank_[p];
    if (is_own_[cell] == 0) continue;
    // The label of the boundary depends on the stars in the gap.
    dependence_[cell] = std::max({dependence_[cell], reach[p], built.support.boundary_reach[p]});
  }
}

void Tile::findPairs(const SurfaceStars& built) {
  far_pairs_.clear();
  doubtful_pairs_.clear();
  const auto add = [&](int p, int q) {
    const int from = cell_by_rank_[p], to = cell_by_rank_[q];
    if (from == to || cells_.areNear(from, to)) return;
    if (is_own_[from] != 0) far_pairs_.emplace_back(from, to);
    if (is_sure_[from] == 0) doubtful_pairs_.emplace_back(to, from);
  };
  for (int p = 0; p < built.stars.size(); ++p)
    forEachTriangle(built.stars, p, [&](int a, int b) { add(p, a), add(p, b); });
  sortUnique(far_pairs_);
  sortUnique(doubtful_pairs_);
}

}  // namespace tufted
