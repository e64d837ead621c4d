#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "bench/real_shapes.h"
#include "bench/tables.h"
#include "oracles/planar.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "tufted/distance.h"
#include "tufted/errors.h"
#include "tufted/io/read.h"

namespace tufted::bench {
namespace {

/// Consistency of the distances from several points.
struct Consistency {
  double mean_gap = 0, greatest_gap = 0;  ///< |d(a, b) - d(b, a)| over the greatest distance
  double slope = 0;                       ///< greatest |difference of distances along an edge| / length of the edge
  long long differing = 0;                ///< distances that are finite by only one of the methods
  int unreached = 0;                      ///< pairs without a path
};

Consistency consistencyOf(const Laplacian& laplacian, const std::vector<int>& sources) {
  const DistanceSolver marching(laplacian), heat(laplacian, {.method = DistanceMethod::heat});
  const auto& cover = laplacian.cover();
  const auto count = std::ssize(sources);
  Eigen::MatrixXd between(count, count);
  Consistency result;
  for (Eigen::Index s = 0; s < count; ++s) {
    const VectorXd d = marching.query({sources[s]});
    result.differing += (d.array().isFinite() != heat.query({sources[s]}).array().isFinite()).count();
    for (Eigen::Index t = 0; t < count; ++t) between(s, t) = d[sources[t]];
    for (std::size_t f = 0; f < cover.faces.size(); ++f) {
      for (int k = 0; k < 3; ++k) {
        const double rise = std::abs(d[cover.faces[f][k]] - d[cover.faces[f][(k + 1) % 3]]);
        if (rise > 0 && std::isfinite(rise)) result.slope = std::max(result.slope, rise / cover.length[3 * f + k]);
      }
    }
  }
  double farthest = 0;
  int pairs = 0;
  for (Eigen::Index s = 0; s < count; ++s) {
    for (Eigen::Index t = 0; t < s; ++t) {
      if (!std::isfinite(between(s, t)) || !std::isfinite(between(t, s))) {
        ++result.unreached;
        continue;
      }
      const double gap = std::abs(between(s, t) - between(t, s));
      result.mean_gap += gap, ++pairs;
      result.greatest_gap = std::max(result.greatest_gap, gap);
      farthest = std::max(farthest, between(s, t));
    }
  }
  if (pairs > 0) result.mean_gap /= pairs * farthest, result.greatest_gap /= farthest;
  return result;
}

/// Sources are drawn from the largest component with a fixed seed.
void printConsistency(const std::string& name, const Laplacian& laplacian) {
  constexpr int count = 8;
  shapes::Random random(101);
  std::vector<int> sources, largest;
  for (int i = 0; i < std::ssize(laplacian.component); ++i)
    if (laplacian.component[i] == 0 && laplacian.status[i] == PointStatus::active) largest.push_back(i);
  if (largest.empty()) return;
  while (std::ssize(sources) < count)
    sources.push_back(largest[static_cast<std::size_t>(random.uniform() * static_cast<double>(largest.size()))]);
  const Consistency c = consistencyOf(laplacian, sources);
  std::printf("| %s | %d | %.3f %% | %.2f %% | %.17g | %lld |\n", name.c_str(),
              static_cast<int>(laplacian.status.size()), 100 * c.mean_gap, 100 * c.greatest_gap, c.slope,
              c.differing + c.unreached);
  std::fflush(stdout);
}

}  // namespace

void printSymmetry() {
  std::printf(
      "| surface | points | d(a, b) - d(b, a), mean | max | greatest slope | finite by one method alone |\n"
      "|---|---|---|---|---|---|\n");
  const auto print = [](const std::string& name, const Points& points, const Triangles& triangles) {
    printConsistency(name, meshLaplacian(points, triangles));
  };
  for (const int pages : {3, 5}) {
    const shapes::Mesh book = shapes::book(pages, 24);
    print("book of " + std::to_string(pages) + " pages", book.points, book.triangles);
  }
  const oracles::Book bad = oracles::badBook(3, 40, 16, 1);
  print("three pages of slivers", bad.points, bad.triangles);
  for (const auto& [name, mesh] : {std::pair("Moebius strip", shapes::moebius(24)),
                                   {"Klein bottle", shapes::kleinBottle(48)},
                                   {"slivers", shapes::slivers(24)}})
    print(name, mesh.points, mesh.triangles);
  for (const auto& file : filesIn({TUFTED_DATA_DIR "/clouds", TUFTED_DATA_DIR "/meshes"})) {
    try {
      const Geometry geometry = read(file);
      if (geometry.is_mesh)
        print(file.filename(), geometry.points, geometry.triangles);
      else
        printConsistency(file.filename(), pointCloudLaplacian(geometry.points));
    } catch (const IoError&) {
      continue;
    }
  }
}

}  // namespace tufted::bench
