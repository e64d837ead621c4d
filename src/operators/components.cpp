// The connected components of a surface, and the Laplacian of some of them.
#include "tufted/components.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/buffer.h"
#include "base/disjoint_sets.h"
#include "base/median.h"
#include "base/parallel.h"
#include "cover/component_edges.h"
#include "cover/components.h"
#include "tufted/check.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

constexpr const char* stage = "restrict";
/// Faces between two calls of `progress`.
constexpr std::int64_t faces_per_block = 1 << 16;

/// The faces of a cover that are connected to a point that stays, glued as before.
/// @param workers one thread, for progress
IntrinsicTriangulation restrictedCover(const IntrinsicTriangulation& cover, const std::vector<std::uint8_t>& stays,
                                       const Workers& workers) {
  DisjointSets parts(cover.vertices);
  workers.forBlocks(stage, cover.size(), faces_per_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t f = begin; f < end; ++f) {
      const auto& [a, b, c] = cover.faces[f];
      parts.unite(a, b);
      parts.unite(a, c);
    }
  });
  std::vector<std::uint8_t> part_stays(stays.size(), 0);
  for (int i = 0; i < cover.vertices; ++i)
    if (stays[i] != 0) part_stays[parts.root(i)] = 1;
  std::vector<int> number(cover.faces.size(), -1);
  IntrinsicTriangulation result;
  result.vertices = cover.vertices;
  workers.forBlocks(stage, cover.size(), faces_per_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t f = begin; f < end; ++f) {
      if (part_stays[parts.root(cover.faces[f][0])] == 0) continue;
      number[f] = static_cast<int>(result.faces.size());
      result.faces.push_back(cover.faces[f]);
    }
  });
  workers.forBlocks(stage, cover.size(), faces_per_block, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t f = begin; f < end; ++f) {
      if (number[f] < 0) continue;
      for (std::int64_t side = 3 * f; side < 3 * f + 3; ++side) {
        // A side and its mate lie in one part.
        result.glue.push_back(3 * number[cover.glue[side] / 3] + cover.glue[side] % 3);
        result.length.push_back(cover.length[side]);
      }
    }
  });
  return result;
}

/// Recomputes the counts and means of the report for the remaining points and edges.
void recount(Laplacian& laplacian) {
  Report& report = laplacian.report;
  report.active = report.isolated = report.coincident = 0;
  report.rim_points = report.jump_points = report.lost_points = 0;
  for (std::size_t i = 0; i < laplacian.status.size(); ++i) {
    const PointStatus status = laplacian.status[i];
    report.active += status == PointStatus::active ? 1 : 0;
    report.isolated += status == PointStatus::isolated ? 1 : 0;
    report.coincident += status == PointStatus::coincident ? 1 : 0;
    if (status != PointStatus::active) continue;
    report.rim_points += laplacian.boundary[i] == Boundary::rim ? 1 : 0;
    report.jump_points += laplacian.boundary[i] == Boundary::jump ? 1 : 0;
    report.lost_points += laplacian.boundary[i] == Boundary::lost ? 1 : 0;
  }
  SideSums sides;
  for (const ComponentEdges& edges : laplacian.component_edges) {
    const auto count = static_cast<double>(edges.sides);
    sides.add({edges.sides, count * edges.mean, count * edges.mean_square});
  }
  if (sides.sides > 0) {
    report.mean_edge = sides.length / static_cast<double>(sides.sides);
    report.mean_squared_edge = sides.square / static_cast<double>(sides.sides);
  }
  if (laplacian.noise.size() > 0) {
    Buffer<double> noise;
    for (std::size_t i = 0; i < laplacian.status.size(); ++i)
      if (laplacian.status[i] == PointStatus::active && laplacian.noise[i] > 0) noise.push_back(laplacian.noise[i]);
    report.denoised = std::ssize(noise);
    report.noise = medianOf(std::move(noise));
  }
  report.nonzeros = laplacian.L.nonZeros();
  report.area = laplacian.M.sum();
  if (laplacian.cover_areas.size() > 0) report.cover_area = laplacian.cover_areas.sum();
}

}  // namespace

std::vector<int> componentLabels(const Laplacian& laplacian) {
  checkSizes("componentLabels", laplacian);
  std::vector<int> label = componentsOf(laplacian.L);
  for (std::size_t i = 0; i < label.size(); ++i)
    if (laplacian.status[i] == PointStatus::coincident) label[i] = label[laplacian.representative[i]];
  return label;
}

std::vector<std::int64_t> componentSizes(const std::vector<int>& labels) {
  std::vector<std::int64_t> sizes;
  for (const int label : labels) {
    if (label < 0) continue;
    if (label >= std::ssize(sizes)) sizes.resize(static_cast<std::size_t>(label) + 1, 0);
    ++sizes[label];
  }
  return sizes;
}

Laplacian restrictedTo(const Laplacian& laplacian, const std::vector<int>& components, const Progress& progress) {
  const Workers workers(1, progress);
  workers.report(stage, 0);
  const std::vector<int> labels = componentLabels(laplacian);
  const auto count = std::ssize(componentSizes(labels));
  std::vector<std::uint8_t> chosen(static_cast<std::size_t>(count), 0);
  for (const int component : components) {
    if (component < 0 || component >= count)
      throw InvalidInput("restrictedTo: component " + std::to_string(component) + ", must lie in [0, " +
                         std::to_string(count) + ")");
    chosen[component] = 1;
  }
  std::vector<int> number(chosen.size(), -1);
  int kept = 0;
  for (std::size_t c = 0; c < chosen.size(); ++c)
    if (chosen[c] != 0) number[c] = kept++;

  workers.report(stage, 0);
  Laplacian result = laplacian;
  workers.report(stage, 0);
  result.component = labels;
  std::vector<std::uint8_t> stays(labels.size(), 0);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] < 0) continue;
    result.component[i] = number[labels[i]];
    stays[i] = result.component[i] >= 0 ? 1 : 0;
    if (stays[i] != 0) continue;
    const auto row = static_cast<Eigen::Index>(i);
    result.M[row] = 0;
    if (result.cover_areas.size() > 0) result.cover_areas[row] = 0;
    if (result.noise.size() > 0) result.noise[row] = 0;
    result.boundary[i] = Boundary::none;
    result.representative[i] = static_cast<int>(i);
    result.status[i] = PointStatus::isolated;
  }
  result.L.prune([&](Eigen::Index i, Eigen::Index, double) { return stays[i] != 0; });
  result.component_edges.clear();
  for (std::size_t c = 0; c < std::min(chosen.size(), laplacian.component_edges.size()); ++c)
    if (chosen[c] != 0) result.component_edges.push_back(laplacian.component_edges[c]);
  workers.report(stage, 0);
  recount(result);
  result.report.components = kept;
  if (laplacian.hasCover()) {
    IntrinsicTriangulation cover = restrictedCover(laplacian.cover(), stays, workers);
    result.report.triangles = cover.size() / 2;
    result.setCover(std::move(cover));
  }
  return result;
}

}  // namespace tufted
