// Maps of surfaces that are cut open along given edges.
#include <algorithm>
#include <limits>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "algorithms/charts.h"
#include "algorithms/check_positions.h"
#include "base/disjoint_sets.h"
#include "base/require.h"
#include "tufted/parameterization.h"

namespace tufted {
namespace {

constexpr const char* cut_parameterization_name = "parameterize";

using CutEdge = std::pair<int, int>;  ///< of two points, the smaller first

CutEdge edgeOf(int a, int b) {
  return std::minmax({a, b});
}

/// Triangles whose corners are points of the cut surface.
struct CutSurface {
  Laplacian points;         ///< without L; the points of the uncut surface come first
  Triangles corners;        ///< F x 3, the points of all given triangles; -1 for those that take no part
  Triangles triangles;      ///< `corners` of those that take part
  std::vector<int> origin;  ///< the point of the uncut surface of each point
};

/// The edges of cuts, between representatives.
std::set<CutEdge> edgesOf(const Laplacian& laplacian, const std::vector<std::vector<int>>& cuts) {
  const int n = static_cast<int>(laplacian.status.size());
  std::set<CutEdge> edges;
  for (const std::vector<int>& cut : cuts) {
    if (cut.size() < 2)
      refuse(cut_parameterization_name, "a cut has " + std::to_string(cut.size()) + " points, must have at least 2");
    for (const int point : cut)
      if (point < 0 || point >= n)
        refuse(cut_parameterization_name,
               "a cut has " + std::to_string(point) + ", must lie in [0, " + std::to_string(n) + ")");
    for (std::size_t k = 1; k < cut.size(); ++k)
      edges.insert(edgeOf(laplacian.representative[cut[k - 1]], laplacian.representative[cut[k]]));
  }
  return edges;
}

/// Joins the corners of triangles on both sides of all edges but those of cuts; each set of corners is a point.
CutSurface cutOpen(const Laplacian& laplacian, const TrianglesRef& triangles, const std::set<CutEdge>& cuts) {
  CutSurface cut;
  const auto n = std::ssize(laplacian.status);
  cut.corners.resize(triangles.rows(), 3);
  std::vector<std::tuple<CutEdge, int>> sides;  // with their numbers 3 t + s
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int s = 0; s < 3; ++s) {
      const int corner = triangles(t, s);
      if (corner < 0 || corner >= n)
        refuse(cut_parameterization_name, "triangle " + std::to_string(t) + " has the corner " +
                                              std::to_string(corner) + ", must lie in [0, " + std::to_string(n) + ")");
      cut.corners(t, s) = laplacian.representative[corner];
    }
    const Eigen::RowVector3i at = cut.corners.row(t);
    const bool takes_part =
        at[0] != at[1] && at[1] != at[2] && at[2] != at[0] &&
        std::all_of(at.begin(), at.end(), [&](int i) { return laplacian.status[i] == PointStatus::active; });
    if (!takes_part) cut.corners.row(t).setConstant(-1);
    for (int s = 0; s < 3 && takes_part; ++s)
      sides.emplace_back(edgeOf(cut.corners(t, s), cut.corners(t, (s + 1) % 3)), static_cast<int>(3 * t + s));
  }
  std::sort(sides.begin(), sides.end());
  const auto hasEdge = [&](const CutEdge& edge) {
    const auto at = std::lower_bound(sides.begin(), sides.end(), std::tuple(edge, 0));
    return at != sides.end() && std::get<0>(*at) == edge;
  };
  for (const auto& [a, b] : cuts)
    if (a == b || !hasEdge({a, b}))
      refuse(cut_parameterization_name, "a cut goes from point " + std::to_string(a) + " to " + std::to_string(b) +
                                            ", which no edge of the triangles joins");
  DisjointSets corners(3 * triangles.rows());
  const auto cornerAt = [&](int side, int point) {  // of the two ends of a side
    const int next = side - side % 3 + (side + 1) % 3;
    return cut.corners(side / 3, side % 3) == point ? side : next;
  };
  for (std::size_t k = 1; k < sides.size(); ++k) {
    const auto& [edge, side] = sides[k];
    const auto& [other_edge, other] = sides[k - 1];
    if (edge != other_edge || cuts.count(edge) > 0) continue;
    for (const int point : {edge.first, edge.second}) corners.unite(cornerAt(side, point), cornerAt(other, point));
  }
  // The first set of corners at a point keeps its index.
  std::vector<int> index(static_cast<std::size_t>(3 * triangles.rows()), -1);
  std::vector<std::uint8_t> is_taken(static_cast<std::size_t>(n), 0);
  for (int i = 0; i < n; ++i) cut.origin.push_back(i);
  for (int c = 0; c < 3 * triangles.rows(); ++c) {
    const int root = corners.root(c);
    int& corner = cut.corners(c / 3, c % 3);
    if (corner < 0) continue;
    if (index[root] < 0) {
      index[root] = is_taken[corner] == 0 ? corner : static_cast<int>(cut.origin.size());
      if (is_taken[corner] != 0) cut.origin.push_back(corner);
      is_taken[corner] = 1;
    }
    corner = index[root];
  }
  std::vector<Eigen::Index> used;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t)
    if (cut.corners(t, 0) >= 0) used.push_back(t);
  cut.triangles = cut.corners(used, Eigen::all);
  return cut;
}

/// The points of a cut surface, each on its own but for coincident points of the uncut surface.
void addPoints(const Laplacian& laplacian, CutSurface& cut) {
  const auto size = std::ssize(cut.origin), n = std::ssize(laplacian.status);
  cut.points.positions.resize(size, 3);
  cut.points.status.resize(static_cast<std::size_t>(size));
  cut.points.boundary.resize(static_cast<std::size_t>(size));
  cut.points.L.resize(size, size);
  cut.points.M = VectorXd::Zero(size);
  for (int i = 0; i < size; ++i) {
    cut.points.positions.row(i) = laplacian.positions.row(cut.origin[i]);
    cut.points.status[i] = laplacian.status[cut.origin[i]];
    cut.points.representative.push_back(i < n ? laplacian.representative[i] : i);
  }
}

void requireDisks(const CutSurface& cut, const std::set<CutEdge>& cuts) {
  std::set<int> ends;
  for (const auto& [a, b] : cuts) ends.insert({a, b});
  for (const Chart& chart : findCharts(cut_parameterization_name, cut.points, cut.triangles)) {
    const bool is_touched = std::any_of(chart.triangles.begin(), chart.triangles.end(), [&](const auto& corners) {
      return std::any_of(corners.begin(), corners.end(), [&](int i) { return ends.count(cut.origin[i]) > 0; });
    });
    if (!is_touched || !chart.is_manifold || !chart.is_orientable) continue;  // parameterize() refuses the latter
    if (chart.rims.size() == 1 && chart.eulerCharacteristic() == 1) continue;
    refuse(cut_parameterization_name,
           "a part of " + std::to_string(chart.triangles.size()) + " triangles with a cut has " +
               std::to_string(chart.rims.size()) + " rims and Euler characteristic " +
               std::to_string(chart.eulerCharacteristic()) + ", must be a disk, with 1 and 1");
  }
}

}  // namespace

Eigen::MatrixX2d parameterizeCut(const Laplacian& laplacian, const TrianglesRef& triangles,
                                 const std::vector<std::vector<int>>& cuts, const ParameterizationOptions& options,
                                 ParameterizationReport* report) {
  checkPositions(cut_parameterization_name, laplacian);
  if (!options.rim.empty()) refuse(cut_parameterization_name, "a rim is given with cuts, must not be");
  if (options.method == ParameterizationMethod::harmonic && options.weights == HarmonicWeights::laplacian)
    refuse(cut_parameterization_name, "weights are those of L, which has no cuts, must be mean-value weights");
  const std::set<CutEdge> edges = edgesOf(laplacian, cuts);
  CutSurface cut = cutOpen(laplacian, triangles, edges);
  addPoints(laplacian, cut);
  requireDisks(cut, edges);
  const Eigen::MatrixX2d uv = parameterize(cut.points, cut.triangles, options, report);
  Eigen::MatrixX2d corners(3 * triangles.rows(), 2);
  for (Eigen::Index c = 0; c < corners.rows(); ++c) {
    const int point = cut.corners(c / 3, c % 3);
    if (point < 0)
      corners.row(c).setConstant(std::numeric_limits<double>::quiet_NaN());
    else
      corners.row(c) = uv.row(point);
  }
  return corners;
}

}  // namespace tufted
