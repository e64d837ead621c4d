#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "tufted/signed_distance.h"

namespace tufted::shapes {

/// The curves through triangles on which a field changes its sign, with positive values on the left, closed or from rim
/// to rim.
/// @param triangles consistently oriented
inline std::vector<SurfaceCurve> slices(const Points& points, const Triangles& triangles, const VectorXd& field) {
  using Edge = std::pair<int, int>;
  struct Step {
    Edge to;
    int face;
  };
  std::map<Edge, Step> steps;  // by the edge where a curve enters a triangle
  std::map<Edge, int> entered;
  for (int f = 0; f < triangles.rows(); ++f) {
    Edge from, to;
    bool is_crossed = false;
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(f, k), b = triangles(f, (k + 1) % 3);
      const Edge edge(std::min(a, b), std::max(a, b));
      if (field[a] > 0 && field[b] <= 0) from = edge, is_crossed = true;
      if (field[a] <= 0 && field[b] > 0) to = edge;
    }
    if (!is_crossed) continue;
    steps[from] = {to, f};
    ++entered[to];
  }
  const auto placeOn = [&](const Edge& edge, int face) {
    const double part = field[edge.first] / (field[edge.first] - field[edge.second]);
    std::array<double, 3> weights = {0, 0, 0};
    for (int k = 0; k < 3; ++k)
      weights[k] = triangles(face, k) == edge.first ? 1 - part : triangles(face, k) == edge.second ? part : 0;
    return SurfacePoint::inFace(points, triangles, face, weights);
  };
  std::vector<SurfaceCurve> curves;
  while (!steps.empty()) {
    const auto atRim = [&](const auto& step) { return entered.count(step.first) == 0; };
    auto step = std::find_if(steps.begin(), steps.end(), atRim);
    if (step == steps.end()) step = steps.begin();
    SurfaceCurve& curve = curves.emplace_back();
    curve.push_back(placeOn(step->first, step->second.face));
    while (step != steps.end()) {
      const auto [to, face] = step->second;
      curve.push_back(placeOn(to, face));
      steps.erase(step);
      step = steps.find(to);
    }
  }
  return curves;
}

}  // namespace tufted::shapes
