// Geodesic Voronoi cells, spectral clustering (Ng, Jordan, Weiss 2002), and parts between concave creases.
#include "tufted/segments.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>

#include "algorithms/check_positions.h"
#include "algorithms/clusters.h"
#include "algorithms/connected.h"
#include "algorithms/crease_parts.h"
#include "algorithms/march.h"
#include "algorithms/march_faces.h"
#include "base/infinity.h"
#include "base/number_text.h"
#include "base/parallel.h"
#include "base/require.h"
#include "base/stage_clock.h"
#include "operators/check_cover.h"
#include "tufted/check.h"
#include "tufted/distance.h"
#include "tufted/errors.h"
#include "tufted/spectrum.h"

namespace tufted {
namespace {

constexpr const char* segments_name = "segments";
/// Number of segments by default, if there are as many points.
constexpr int usual_count = 8;

void checkArguments(const Laplacian& laplacian, const SegmentOptions& options, const Components& components) {
  const std::string name = std::string(segments_name) + ": ";
  if (components.points.empty()) throw InvalidInput(name + "no point is active, must be at least one");
  requireChoice(options.method, SegmentMethod::parts, segments_name, "method");
  if (options.method != SegmentMethod::voronoi) {
    const bool is_parts = options.method == SegmentMethod::parts;
    const std::string none = std::string(", must be none with SegmentMethod::") + (is_parts ? "parts" : "spectral");
    if (!options.seeds.empty()) throw InvalidInput(name + "seeds are given" + none);
    if (is_parts && options.count) throw InvalidInput(name + "count = " + std::to_string(*options.count) + none);
  } else if (laplacian.positions.rows() != std::ssize(laplacian.status)) {
    throw InvalidInput(name + "Laplacian::positions has " + std::to_string(laplacian.positions.rows()) +
                       " rows, must have " + std::to_string(laplacian.status.size()) + ", one per point");
  }
  if (options.count && *options.count < 1)
    throw InvalidInput(name + "count = " + std::to_string(*options.count) + ", must be at least 1");
  if (!(options.crease > 0) || !std::isfinite(options.crease))
    throw InvalidInput(name + "crease = " + numberText(options.crease) + ", must be positive and finite");
  if (options.least_points < 1)
    throw InvalidInput(name + "least_points = " + std::to_string(options.least_points) + ", must be at least 1");
  std::vector<int> seen;
  for (const int seed : options.seeds) {
    if (seed < 0 || seed >= std::ssize(laplacian.status))
      throw InvalidInput(name + "seed " + std::to_string(seed) + ", must lie in [0, " +
                         std::to_string(laplacian.status.size()) + ")");
    const int point = laplacian.representative[seed];
    if (components.of[point] < 0)
      throw InvalidInput(name + whyOnNone("seed", seed, laplacian.status[point]) +
                         ", lies on no component, must be active");
    if (std::find(seen.begin(), seen.end(), point) != seen.end())
      throw InvalidInput(name + "seed " + std::to_string(seed) + " is given twice, must be given once");
    seen.push_back(point);
  }
}

/// Voronoi cells of seeds that are added one by one. Distances on the triangles as they are find the places of seeds;
/// for the cells the triangles are cut, as for any distance.
class Cells {
 public:
  Cells(const Laplacian& laplacian, const Components& components, const SolverOptions& options)
      : laplacian_(laplacian),
        components_(components),
        workers_(1, options.progress),
        number_(numbersByFaces(laplacian)),
        split_(checkedSplit(segments_name, std::nullopt, laplacian)),
        faces_(marchFaces(laplacian, split_, workers_, number_)),
        area_(components.sums(laplacian.M)),
        has_seed_(static_cast<std::size_t>(components.count), false),
        nearest_(unreached(faces_)) {}

  void addSeed(int seed) {
    const int start = number_[seed], cell = static_cast<int>(seeds_.size());
    places_.push_back(faces_.positions[start]);
    starts_.push_back({start, 0, cell});
    marchWhereNearer(faces_, {starts_.back()}, workers_, places_, nearest_);
    has_seed_[components_.of[seed]] = true;
    seeds_.push_back(seed);
  }

  /// The point that is farthest from all seeds; a component without a seed counts with the diameter of a disc of its
  /// area. -1 if all points are seeds.
  int farthest() const {
    int best = -1;
    double best_distance = 0;
    for (const int i : components_.points) {
      const double distance = nearest_.distance[number_[i]];
      if (!has_seed_[components_.of[i]] || !(distance > best_distance)) continue;
      best = i;
      best_distance = distance;
    }
    int component = -1;
    for (int c = 0; c < components_.count; ++c)
      if (!has_seed_[c] && (component < 0 || area_[c] > area_[component])) component = c;
    if (component < 0) return best;
    const double diameter = 2 * std::sqrt(area_[component] / std::numbers::pi);
    return best < 0 || diameter > std::ldexp(best_distance, faces_.exponent) ? outermost(component) : best;
  }

  const std::vector<int>& seeds() const { return seeds_; }
  /// The number of the nearest seed of each point; -1 on components without one.
  std::vector<int> cells() const {
    std::vector<int> cell(static_cast<std::size_t>(laplacian_.M.size()), -1);
    const std::vector<int> nearest = march(faces_, split_ > 0, starts_, infinity, workers_, places_).source;
    for (const int i : components_.points)
      if (has_seed_[components_.of[i]]) cell[i] = nearest.empty() ? 0 : nearest[number_[i]];
    return cell;
  }

 private:
  /// The point of a component that is farthest from its centre of mass.
  int outermost(int component) const {
    const Points& positions = laplacian_.positions;
    int first = -1;
    double weights = 0;
    Eigen::RowVector3d centre = Eigen::RowVector3d::Zero();  // relative to the first point
    const auto forPoints = [&](const auto& visit) {
      for (const int i : components_.points)
        if (components_.of[i] == component) visit(i);
    };
    const bool has_area = area_[component] > 0;
    forPoints([&](int i) {
      if (first < 0) first = i;
      const double weight = has_area ? laplacian_.M[i] / area_[component] : 1;
      centre += weight * (positions.row(i) - positions.row(first));
      weights += weight;
    });
    centre /= weights;
    int best = first;
    double farthest = -1;
    forPoints([&](int i) {
      const double distance = (positions.row(i) - positions.row(first) - centre).stableNorm();
      if (!(distance > farthest)) return;
      best = i;
      farthest = distance;
    });
    return best;
  }

  const Laplacian& laplacian_;
  const Components& components_;
  const Workers workers_;
  const std::vector<int> number_;  ///< of each point in the faces
  const int split_;                ///< see checkedSplit()
  const MarchFaces faces_;
  const VectorXd area_;  ///< of each component
  std::vector<bool> has_seed_;
  MarchResult nearest_;  ///< of each vertex, on triangles that are not cut
  std::vector<int> seeds_;
  std::vector<MarchStart> starts_;
  SourcePositions places_;  ///< of the seeds
};

Segments voronoi(const Laplacian& laplacian, const SegmentOptions& options, const Components& components) {
  if (!options.seeds.empty()) {
    std::vector<SurfacePoint> sources;
    Segments result;
    for (const int seed : options.seeds) {
      result.seeds.push_back(laplacian.representative[seed]);
      sources.push_back(SurfacePoint::vertex(result.seeds.back()));
    }
    const DistanceSolver solver(laplacian, {.solver = options.solver});
    result.labels = solver.nearest(sources, nullptr, options.solver.progress).source;
    return result;
  }
  checkCover(segments_name, laplacian);
  Cells cells(laplacian, components, options.solver);
  while (std::ssize(cells.seeds()) < options.count.value_or(usual_count)) {
    const int seed = cells.farthest();
    if (seed < 0 && !options.count) break;
    if (seed < 0)
      throw InvalidInput(std::string(segments_name) + ": count = " + std::to_string(*options.count) +
                         ", must be at most " + std::to_string(cells.seeds().size()) +
                         ", the number of different places");
    cells.addSeed(seed);
  }
  return {.labels = cells.cells(), .areas = {}, .seeds = cells.seeds()};
}

Segments spectral(const Laplacian& laplacian, int count, const SolverOptions& solver, const Components& components) {
  Segments result;
  result.labels.assign(laplacian.status.size(), -1);
  if (count == 1) {
    for (const int i : components.points) result.labels[i] = 0;
    return result;
  }
  const Spectrum found = spectrum(laplacian, count,
                                  {.method = solver.method,
                                   .memory_limit = solver.memory_limit,
                                   .threads = solver.threads,
                                   .progress = solver.progress});
  // Points of components beyond the `count` largest have rows of zeros.
  std::vector<int> points;
  for (const int i : components.points)
    if (found.vectors.row(i).norm() > 0) points.push_back(i);
  Eigen::MatrixXd rows = found.vectors(points, Eigen::all);
  rows.rowwise().normalize();
  const std::vector<int> cluster = clusters(rows, laplacian.M(points), count);
  for (std::size_t k = 0; k < points.size(); ++k) result.labels[points[k]] = cluster[k];
  return result;
}

/// Numbers segments by falling area, and copies labels to coincident points.
void finish(const Laplacian& laplacian, int count, Segments& result) {
  VectorXd areas = VectorXd::Zero(count);
  for (std::size_t i = 0; i < result.labels.size(); ++i)
    if (result.labels[i] >= 0) areas[result.labels[i]] += laplacian.M[static_cast<Eigen::Index>(i)];
  std::vector<int> order(static_cast<std::size_t>(count)), number(order.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return areas[a] > areas[b]; });
  for (int k = 0; k < count; ++k) number[order[k]] = k;
  for (int& label : result.labels)
    if (label >= 0) label = number[label];
  for (std::size_t i = 0; i < result.labels.size(); ++i) result.labels[i] = result.labels[laplacian.representative[i]];
  result.areas = areas(order);
  if (result.seeds.empty()) return;
  std::vector<int> seeds;
  seeds.reserve(order.size());
  for (const int k : order) seeds.push_back(result.seeds[k]);
  result.seeds = std::move(seeds);
}

}  // namespace

Segments segments(const Laplacian& laplacian, const SegmentOptions& options) {
  return segments(laplacian, laplacian.frames, options);
}

Segments segments(const Laplacian& laplacian, const Frames& frames, const SegmentOptions& options) {
  checkSizes(segments_name, laplacian);
  const Stopwatch watch;
  const Components components = findComponents(laplacian);
  checkArguments(laplacian, options, components);
  Segments result;
  int count = 0;
  switch (options.method) {
    case SegmentMethod::voronoi:
      result = voronoi(laplacian, options, components);
      count = static_cast<int>(result.seeds.size());
      break;
    case SegmentMethod::spectral:
      count = options.count ? *options.count : std::clamp(mostEigenpairs(laplacian), 1, usual_count);
      result = spectral(laplacian, count, options.solver, components);
      break;
    case SegmentMethod::parts:
      checkFrames(segments_name, laplacian, frames);
      result.labels = creaseParts(laplacian, frames, options);
      count = 1 + *std::max_element(result.labels.begin(), result.labels.end());
      break;
  }
  finish(laplacian, count, result);
  result.seconds = watch.seconds();
  return result;
}

}  // namespace tufted
