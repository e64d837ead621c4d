#include "algorithms/charts.h"

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include "tufted/errors.h"

namespace tufted {
namespace {

using Corners = std::array<int, 3>;

/// In place of a mate: the edge has one triangle, or more than two.
constexpr int open_side = -1, crowded_side = -2;

/// The sides of triangles: side s of triangle t is 3 t + s, from corner s to the next.
class Sides {
 public:
  explicit Sides(const std::vector<Corners>& triangles) : triangles_(triangles), mate_(3 * triangles.size()) {
    std::vector<std::tuple<int, int, int>> edges;
    edges.reserve(mate_.size());
    for (int side = 0; side < static_cast<int>(mate_.size()); ++side)
      edges.emplace_back(std::min(from(side), to(side)), std::max(from(side), to(side)), side);
    std::sort(edges.begin(), edges.end());
    const auto areSame = [&](std::size_t a, std::size_t b) {
      return std::get<0>(edges[a]) == std::get<0>(edges[b]) && std::get<1>(edges[a]) == std::get<1>(edges[b]);
    };
    for (std::size_t first = 0, last = 0; first < edges.size(); first = last) {
      while (last < edges.size() && areSame(first, last)) ++last;
      const auto side = [&](std::size_t k) { return std::get<2>(edges[k]); };
      if (last - first == 1) {
        mate_[side(first)] = open_side;
      } else if (last - first == 2) {
        mate_[side(first)] = side(first + 1);
        mate_[side(first + 1)] = side(first);
      } else {
        for (std::size_t k = first; k < last; ++k) mate_[side(k)] = crowded_side;
        crowds_.emplace_back();
        for (std::size_t k = first; k < last; ++k) crowds_.back().push_back(side(k));
      }
    }
  }

  int from(int side) const { return triangles_[side / 3][side % 3]; }
  int to(int side) const { return triangles_[side / 3][(side + 1) % 3]; }
  int mate(int side) const { return mate_[side]; }
  /// The sides of each edge that has more than two triangles.
  const std::vector<std::vector<int>>& crowds() const { return crowds_; }

 private:
  const std::vector<Corners>& triangles_;
  std::vector<int> mate_;
  std::vector<std::vector<int>> crowds_;
};

/// The rims of an oriented manifold chart, see Chart::rims.
std::vector<std::vector<int>> rimsOf(const std::vector<Corners>& triangles) {
  const Sides sides(triangles);
  std::vector<std::vector<int>> rims;
  std::vector<std::uint8_t> seen(3 * triangles.size(), 0);
  for (int first = 0; first < static_cast<int>(seen.size()); ++first) {
    if (sides.mate(first) != open_side || seen[first] != 0) continue;
    rims.emplace_back();
    for (int side = first; seen[side] == 0;) {
      seen[side] = 1;
      rims.back().push_back(sides.from(side));
      // Goes around the end of the side, through its fan, to the next open side.
      side = nextSide(side);
      while (sides.mate(side) != open_side) side = nextSide(sides.mate(side));
    }
  }
  return rims;
}

/// Collects the chart of triangle `first`, marks its triangles in `seen`, and orients them consistently.
/// @param crowd_of for each side its index in Sides::crowds(); -1: none
/// @param[out] triangles those of the chart, oriented
/// @param[in,out] disagreeing gets the later triangle at each edge where orientations do not agree
Chart chartOf(int first, const Sides& sides, const std::vector<int>& crowd_of, std::vector<Corners>& triangles,
              const std::vector<Corners>& given, std::vector<std::uint8_t>& seen, std::vector<int>& disagreeing) {
  Chart chart;
  std::vector<int> members = {first};
  std::vector<std::uint8_t>& turned = seen;  // 0: not seen, 1: as given, 2: reversed
  seen[first] = 1;
  std::int64_t twice_edges = 0;
  for (std::size_t k = 0; k < members.size(); ++k) {
    const int t = members[k];
    for (int side = 3 * t; side < 3 * t + 3; ++side) {
      const int mate = sides.mate(side);
      twice_edges += mate == open_side ? 2 : 1;
      if (mate == open_side) continue;
      if (mate == crowded_side) {
        chart.is_manifold = false;
        for (const int other : sides.crowds()[crowd_of[side]]) {
          if (seen[other / 3] != 0) continue;
          seen[other / 3] = 1;
          members.push_back(other / 3);
        }
        continue;
      }
      const bool agrees = sides.from(side) == sides.to(mate);
      const std::uint8_t wanted = agrees ? turned[t] : static_cast<std::uint8_t>(3 - turned[t]);
      if (seen[mate / 3] == 0) {
        turned[mate / 3] = wanted;
        members.push_back(mate / 3);
      } else if (turned[mate / 3] != wanted) {
        chart.is_orientable = false;
        disagreeing.push_back(t);
      }
    }
  }
  std::sort(members.begin(), members.end());
  const auto as_given = std::count_if(members.begin(), members.end(), [&](int t) { return turned[t] == 1; });
  const std::uint8_t front = 2 * as_given >= std::ssize(members) ? 1 : 2;
  std::vector<int> points;
  for (const int t : members) {
    Corners corners = given[t];
    if (turned[t] != front) std::swap(corners[1], corners[2]);
    triangles.push_back(corners);
    points.insert(points.end(), corners.begin(), corners.end());
  }
  std::sort(points.begin(), points.end());
  chart.vertices = static_cast<int>(std::unique(points.begin(), points.end()) - points.begin());
  chart.edges = static_cast<int>(twice_edges / 2);
  return chart;
}

/// All charts of some triangles, those of more triangles first.
/// @param disagreeing see chartOf()
std::vector<Chart> chartsOf(const std::vector<Corners>& given, std::vector<int>& disagreeing) {
  const Sides sides(given);
  std::vector<int> crowd_of(3 * given.size(), -1);
  for (std::size_t c = 0; c < sides.crowds().size(); ++c)
    for (const int side : sides.crowds()[c]) crowd_of[side] = static_cast<int>(c);
  std::vector<std::uint8_t> seen(given.size(), 0);
  std::vector<Chart> charts;
  for (int t = 0; t < static_cast<int>(given.size()); ++t) {
    if (seen[t] != 0) continue;
    std::vector<Corners> members;
    Chart chart = chartOf(t, sides, crowd_of, members, given, seen, disagreeing);
    chart.triangles = std::move(members);
    if (chart.is_manifold && chart.is_orientable) chart.rims = rimsOf(chart.triangles);
    charts.push_back(std::move(chart));
  }
  std::stable_sort(charts.begin(), charts.end(),
                   [](const Chart& a, const Chart& b) { return a.triangles.size() > b.triangles.size(); });
  return charts;
}

}  // namespace

std::vector<Corners> usableTriangles(const char* function, const Laplacian& laplacian, const TrianglesRef& triangles) {
  const int n = static_cast<int>(laplacian.status.size());
  std::vector<std::pair<Corners, int>> sorted;
  std::vector<Corners> usable;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    Corners corners{};
    bool is_usable = true;
    for (int k = 0; k < 3; ++k) {
      const int i = triangles(t, k);
      if (i < 0 || i >= n)
        throw InvalidInput(std::string(function) + ": triangle " + std::to_string(t) + " names point " +
                           std::to_string(i) + ", must lie in [0, " + std::to_string(n) + ")");
      corners[k] = laplacian.representative[i];
      is_usable = is_usable && laplacian.status[corners[k]] == PointStatus::active;
    }
    if (!is_usable || corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    Corners key = corners;
    std::sort(key.begin(), key.end());
    sorted.emplace_back(key, static_cast<int>(usable.size()));
    usable.push_back(corners);
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::uint8_t> is_copy(usable.size(), 0);
  for (std::size_t k = 1; k < sorted.size(); ++k)
    if (sorted[k].first == sorted[k - 1].first) is_copy[sorted[k].second] = 1;
  std::size_t kept = 0;
  for (std::size_t t = 0; t < usable.size(); ++t)
    if (is_copy[t] == 0) usable[kept++] = usable[t];
  usable.resize(kept);
  return usable;
}

std::vector<Chart> findCharts(const char* function, const Laplacian& laplacian, const TrianglesRef& triangles,
                              std::int64_t* cut) {
  std::vector<Corners> given = usableTriangles(function, laplacian, triangles);
  std::vector<int> disagreeing;
  std::vector<Chart> charts = chartsOf(given, disagreeing);
  while (cut != nullptr && laplacian.kind == Kind::cloud && !disagreeing.empty()) {
    std::vector<std::uint8_t> is_left_out(given.size(), 0);
    for (const int t : disagreeing) is_left_out[t] = 1;
    std::size_t kept = 0;
    for (std::size_t t = 0; t < given.size(); ++t)
      if (is_left_out[t] == 0) given[kept++] = given[t];
    *cut += static_cast<std::int64_t>(given.size() - kept);
    given.resize(kept);
    disagreeing.clear();
    charts = chartsOf(given, disagreeing);
  }
  return charts;
}

}  // namespace tufted
