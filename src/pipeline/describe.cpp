#include "tufted/describe.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "base/buffer.h"
#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "base/stage_clock.h"
#include "neighbors/morton.h"
#include "neighbors/neighbors.h"
#include "stars/tangent_frame.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// `tufted info` counts a point as an outlier if its nearest neighbour is this many times as far as usual; on a random
/// surface by chance once in 3e7.
constexpr double outlier_ratio = 5;

/// The k nearest neighbours of every point, with derived values.
struct NeighborGraph {
  int k = 0;
  Buffer<int> nearest;      ///< n * k ranks
  Buffer<double> distance;  ///< n, distance to the nearest
  Buffer<std::uint8_t> on_line;
};

NeighborGraph findNeighbors(const RankedCloud& cloud, int k, const Workers& workers) {
  NeighborGraph graph;
  graph.k = std::min(k, std::max(0, cloud.size() - 1));
  graph.nearest.resize(static_cast<std::size_t>(cloud.size()) * graph.k);
  graph.distance.resize(cloud.size());
  graph.on_line.resize(cloud.size());
  if (graph.k == 0) return graph;
  const NeighborSearch search(cloud.points, workers);
  Buffer<Buffer<Neighbor>> found(workers.count());
  workers.forBlocks("neighbours", cloud.size(), usual_block, [&](std::int64_t begin, std::int64_t end, int worker) {
    Buffer<Neighbor>& neighbors = found[worker];
    for (std::int64_t p = begin; p < end; ++p) {
      search.nearest(static_cast<int>(p), graph.k, neighbors);
      for (int j = 0; j < graph.k; ++j) graph.nearest[p * graph.k + j] = neighbors[j].index;
      graph.distance[p] = std::sqrt(neighbors[0].squared_distance);
      // Two points always lie on a line.
      graph.on_line[p] = graph.k > 2 && liesOnOneLine(principalAxes(cloud.points, static_cast<int>(p), neighbors));
    }
  });
  return graph;
}

double quantile(Buffer<double> values, double q) {
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Counts points whose nearest neighbour is much farther away than those of its neighbours.
std::int64_t countOutliers(const NeighborGraph& graph, const Workers& workers) {
  Buffer<std::int64_t> counts(workers.count());
  workers.forBlocks("outliers", static_cast<std::int64_t>(graph.distance.size()), usual_block,
                    [&](std::int64_t begin, std::int64_t end, int worker) {
                      Buffer<double> around(graph.k);
                      std::int64_t here = 0;
                      for (std::int64_t p = begin; p < end; ++p) {
                        for (int j = 0; j < graph.k; ++j) around[j] = graph.distance[graph.nearest[p * graph.k + j]];
                        const auto middle = around.begin() + graph.k / 2;
                        std::nth_element(around.begin(), middle, around.end());
                        here += graph.distance[p] > outlier_ratio * *middle ? 1 : 0;
                      }
                      counts[worker] += here;
                    });
  return std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
}

std::int64_t countComponents(const NeighborGraph& graph) {
  auto components = std::ssize(graph.distance);
  DisjointSets sets(components);
  for (std::size_t i = 0; i < graph.nearest.size(); ++i)
    if (sets.unite(static_cast<int>(i / graph.k), graph.nearest[i])) --components;
  return components;
}

/// Distance from the float nearest to |x| to the next larger one; infinite if there is none.
double floatStep(double x) {
  if (std::abs(x) >= std::numeric_limits<float>::max()) return std::numeric_limits<double>::infinity();
  const float value = std::abs(static_cast<float>(x));
  return static_cast<double>(std::nextafter(value, std::numeric_limits<float>::infinity())) -
         static_cast<double>(value);
}

/// Sets the members that follow from the coordinates alone.
void measureExtent(const Points& points, CloudDescription& description) {
  description.points = points.rows();
  description.not_finite = 0;
  Eigen::RowVector3d lowest = Eigen::RowVector3d::Constant(std::numeric_limits<double>::infinity()), highest = -lowest;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    if (!points.row(i).allFinite()) {
      ++description.not_finite;
      continue;
    }
    lowest = lowest.cwiseMin(points.row(i));
    highest = highest.cwiseMax(points.row(i));
  }
  if (description.not_finite == description.points) return;
  description.lowest = lowest;
  description.highest = highest;
  description.float_step = floatStep(std::max(lowest.cwiseAbs().maxCoeff(), highest.cwiseAbs().maxCoeff()));
}

}  // namespace

CloudDescription describeSample(const Points& points, const std::vector<int>& sample, const CloudOptions& options) {
  Points some(static_cast<Eigen::Index>(sample.size()), 3);
  for (std::size_t s = 0; s < sample.size(); ++s) {
    if (sample[s] < 0 || sample[s] >= points.rows())
      throw InvalidInput("describeSample: sample[" + std::to_string(s) + "] = " + std::to_string(sample[s]) +
                         ", must be in [0, " + std::to_string(points.rows()) + ")");
    some.row(static_cast<Eigen::Index>(s)) = points.row(sample[s]);
  }
  CloudDescription description = describeCloud(some, options);
  measureExtent(points, description);
  return description;
}

CloudDescription describeCloud(const Points& points, const CloudOptions& options) {
  const auto require = [](const char* what, int value, int least) {
    if (value < least)
      throw InvalidInput(std::string("describeCloud: ") + what + " = " + std::to_string(value) + ", must be at least " +
                         std::to_string(least));
  };
  require("neighbors", options.neighbors, 3);
  require("threads", options.threads, 0);
  const Workers workers(options.threads, options.progress);
  const Stopwatch watch;
  std::vector<PointStatus> status;
  std::vector<int> representative;
  const RankedCloud cloud = rankPoints(points, status, representative, workers);
  workers.report("tree", 0);
  const NeighborGraph graph = findNeighbors(cloud, options.neighbors, workers);

  CloudDescription description;
  description.coincident = std::count(status.begin(), status.end(), PointStatus::coincident);
  description.neighbors = graph.k;
  description.seconds = watch.seconds();
  description.sampled = points.rows();
  measureExtent(points, description);
  if (cloud.size() == 0) return description;
  const auto length = [&](double q) { return std::ldexp(quantile(graph.distance, q), cloud.exponent); };
  description.spacing = length(0.5);
  description.spacing_low = length(0.05);
  description.spacing_high = length(0.95);
  description.on_lines = std::count(graph.on_line.begin(), graph.on_line.end(), 1);
  if (graph.k > 0) description.outliers = countOutliers(graph, workers);
  description.components = countComponents(graph);
  return description;
}

}  // namespace tufted
