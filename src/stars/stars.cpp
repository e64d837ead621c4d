// Section 5.7 of the paper: the local Delaunay triangulation of each point in its tangent plane.
#include "stars/stars.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/buffer.h"
#include "base/point_buffer.h"
#include "base/power_of_two.h"
#include "stars/blocks_in_order.h"
#include "stars/neighborhood.h"
#include "stars/offsets.h"
#include "stars/star_gap.h"
#include "stars/star_widening.h"
#include "stars/star_wrapping.h"
#include "stars/tangent_frame.h"

namespace tufted {
namespace {

constexpr int group_size = NeighborhoodFinder::most_planes;  // points whose frames, and then stars, are found together
/// How often the neighbours of an open star are doubled: points on rings around a pole see only their own ring among 60
/// (error at anisotropy 20: 1.9e-2 to 7.9e-3).
constexpr int most_doublings = 2;
/// A widened search takes at most this many times k neighbours, 1,920 by default. At steps of density of 1 to 1,000
/// more (256) change the area by .1 %, at smaller ones nothing; 32 lose .4 % of it at 1 to 100.
constexpr int most_widened = 64;

/// Memory, counts and times of one worker.
struct StarWorker {
  Buffer<Neighborhood> neighborhoods;
  std::array<OffsetBuffer, group_size> offsets;
  NeighborhoodScratch neighborhood;
  Neighborhood saved_neighborhood;
  DelaunayStar saved_star;
  StarMemory memory;
  std::int64_t grown_neighborhoods = 0, split_neighborhoods = 0, thick = 0, isolated = 0, grown_stars = 0,
               closed_stars = 0;
  std::array<double, 3> seconds = {};  // of neighbours, frames, stars
};

class StarBuilder {
 public:
  StarBuilder(const RankedCloud& cloud, const NeighborSource& source, const CloudOptions& options, BuiltStars& built,
              Buffer<Certainty>& certainty)
      : points_(cloud.points),
        source_(source),
        options_(options),
        finder_(cloud.points, source, options),
        wrapping_(options.paper.delaunay),
        stars_(built.stars),
        support_(built.support),
        certainty_(certainty) {}

  /// Builds the stars of [begin, end) in state.memory.block.
  void build(std::int64_t begin, std::int64_t end, StarWorker& state) const {
    const int count = static_cast<int>(end - begin);
    const int first = static_cast<int>(begin);
    state.neighborhoods.resize(std::max<std::size_t>(state.neighborhoods.size(), count));
    state.memory.block.reserve(count);
    Stopwatch watch;
    finder_.find(first, count, state.neighborhood, state.neighborhoods.data());
    state.seconds[0] += watch.restart();
    for (int group = 0; group < count; group += group_size) {
      const int group_end = std::min(count, group + group_size);
      const std::span neighborhoods(state.neighborhoods.data() + group, state.neighborhoods.data() + group_end);
      for (int i = group; i < group_end; ++i)
        state.offsets[i - group].take(points_, first + i, state.neighborhoods[i].neighbors);
      finder_.fitPlanes(neighborhoods, state.offsets);
      for (int i = group; i < group_end; ++i)
        takeFrame(first + i, state.neighborhoods[i], state.offsets[i - group], state);
      state.seconds[1] += watch.restart();
      for (int i = group; i < group_end; ++i)
        wrapStar(first + i, state.neighborhoods[i], state.offsets[i - group], state);
      state.seconds[2] += watch.restart();
    }
  }

  /// Builds the stars of [begin, end) in `wanted` from wider searches, in state.memory.block: empty ones if they are
  /// not certain then either.
  void widen(std::span<const Widening> wanted, std::int64_t begin, std::int64_t end, StarWorker& state,
             Stars& widened) const {
    state.neighborhoods.resize(std::max<std::size_t>(state.neighborhoods.size(), 1));
    Neighborhood& neighborhood = state.neighborhoods[0];
    OffsetBuffer& offsets = state.offsets[0];
    DelaunayStar& star = state.memory.star;
    for (std::int64_t i = begin; i < end; ++i) {
      const auto& [p, radius] = wanted[i];
      finder_.find(p, 1, state.neighborhood, &neighborhood);
      offsets.take(points_, p, neighborhood.neighbors);
      finder_.fitPlanes({&neighborhood, 1}, state.offsets);
      findFrame(p, neighborhood, offsets, state);
      while (neighborhood.radius < radius &&
             finder_.grow(p, most_widened * source_.k, neighborhood, offsets, state.neighborhood)) {
      }
      support_.reach[p] = std::max(support_.reach[p], neighborhood.radius);
      const double unit = magnitudeOf(neighborhood.fit_radius);
      wrap(p, neighborhood, 1 / unit, offsets.view(), state);
      if (!isCertain(star, neighborhood, 1 / unit)) star.link.clear();
      storeStar(static_cast<int>(i), unit, anyTriangle, state.memory, widened);
    }
  }

 private:
  static bool anyTriangle(int /*a*/, int /*b*/) { return true; }

  void findFrame(int p, Neighborhood& neighborhood, OffsetBuffer& offsets, StarWorker& state) const {
    finder_.refine(p, neighborhood, offsets, state.neighborhood);
    if (source_.normals.rows() > 0 && !source_.normals.row(p).isZero(0))
      neighborhood.axes.normal = source_.normals.row(p);
  }

  void takeFrame(int p, Neighborhood& neighborhood, OffsetBuffer& offsets, StarWorker& state) const {
    findFrame(p, neighborhood, offsets, state);
    state.grown_neighborhoods += neighborhood.grown ? 1 : 0;
    state.split_neighborhoods += neighborhood.split ? 1 : 0;
    state.isolated += neighborhood.isolated ? 1 : 0;
    state.thick += (neighborhood.thick || neighborhood.cable) && !neighborhood.split ? 1 : 0;
    support_.normals.row(p) = neighborhood.axes.normal;
    support_.fit_radius[p] = neighborhood.fit_radius;
    support_.reach[p] = neighborhood.radius;
    support_.isolated[p] = neighborhood.isolated ? 1 : 0;
  }

  /// Finds the star among the neighbours.
  void wrap(int p, const Neighborhood& neighborhood, double unit, const Offsets& offsets, StarWorker& state) const {
    wrapping_.wrap(p, neighborhood.axes.normal, unit, offsets, neighborhood.neighbors, state.memory);
  }

  /// Whether the star is still open among the grown neighbours, without building it.
  bool staysOpen(const Eigen::Vector2d& gap, const Neighborhood& neighborhood, double unit, const Offsets& offsets,
                 StarWorker& state) const {
    state.memory.planar.clear();
    projectParts(neighborhood.axes.normal, unit, offsets, neighborhood.neighbors,
                 [&](const PlanarOffsets& planar, std::span<const Neighbor> neighbors) {
                   append(planar, neighbors, state.memory.planar);
                   return true;
                 });
    return leaveGap(state.memory.planar, gap);
  }

  /// Finds the star, and takes more neighbours if it is not certain: a circle of a closed star leaves the ball that was
  /// searched, or an open star might close among more neighbours (*The certificate* in section 6 of docs/algorithm.md).
  void wrapUntilCertain(int p, Neighborhood& neighborhood, double unit, OffsetBuffer& offsets,
                        StarWorker& state) const {
    const bool is_thorough = options_.steps.star_search == StarSearch::thorough;
    const bool has_grown_most = is_thorough && neighborhood.k >= finder_.mostNeighbors();
    const int most = has_grown_most ? neighborhood.k : 2 * neighborhood.k;
    wrap(p, neighborhood, unit, offsets.view(), state);
    coverCircles(p, most, neighborhood, unit, offsets, state);
    // Neighbours on rings already reach far beyond the star.
    if (state.memory.star.closed || !is_thorough || source_.isGraded()) return;
    if (closesAmongMore(p, neighborhood, unit, offsets, state))
      coverCircles(p, std::max(most, 2 * neighborhood.k), neighborhood, unit, offsets, state);
  }

  /// Whether the star is closed and all its circles lie in the ball that was searched.
  static bool isCertain(const DelaunayStar& star, const Neighborhood& neighborhood, double unit) {
    return star.closed && 2 * star.largestCircumradius() <= neighborhood.radius * unit;
  }

  /// Takes more neighbours, at most `most`, while a circle of the closed star leaves the ball that was searched: a
  /// point within the circle but outside of the ball would change the star.
  void coverCircles(int p, int most, Neighborhood& neighborhood, double unit, OffsetBuffer& offsets,
                    StarWorker& state) const {
    const DelaunayStar& star = state.memory.star;
    while (star.closed && !isCertain(star, neighborhood, unit) &&
           finder_.grow(p, most, neighborhood, offsets, state.neighborhood)) {
      ++state.grown_stars;
      wrap(p, neighborhood, unit, offsets.view(), state);
    }
  }

  /// Whether the open star closes among twice or four times as many neighbours. If not, it is restored.
  bool closesAmongMore(int p, Neighborhood& neighborhood, double unit, OffsetBuffer& offsets, StarWorker& state) const {
    state.saved_star = state.memory.star;
    state.saved_neighborhood = neighborhood;
    const Eigen::Vector2d gap = middleOfGap(state.memory.star);
    for (int i = 0; i < most_doublings; ++i) {
      if (!finder_.grow(p, 2 * neighborhood.k, neighborhood, offsets, state.neighborhood)) break;
      if (staysOpen(gap, neighborhood, unit, offsets.view(), state)) continue;
      wrap(p, neighborhood, unit, offsets.view(), state);
      if (state.memory.star.closed) {
        ++state.closed_stars;
        return true;
      }
    }
    state.memory.star = state.saved_star;
    neighborhood = state.saved_neighborhood;
    return false;
  }

  void wrapStar(int p, Neighborhood& neighborhood, OffsetBuffer& offsets, StarWorker& state) const {
    // A power of two near the fit radius: the predicates get numbers near 1, and scaling is exact.
    const double unit = magnitudeOf(neighborhood.fit_radius);
    DelaunayStar& star = state.memory.star;
    if (neighborhood.isolated) {
      star.link.clear();
      star.closed = false;
    } else {
      wrapUntilCertain(p, neighborhood, 1 / unit, offsets, state);
      const SearchBefore& last = state.neighborhood.before;  // also of a growth that was undone
      if (last.k > 0 && last.p == p) support_.reach[p] = std::max(support_.reach[p], last.radius);
    }

    if (!certainty_.empty())
      certainty_[p] = !star.closed                              ? Certainty::open
                      : isCertain(star, neighborhood, 1 / unit) ? Certainty::certain
                                                                : Certainty::uncertain;
    storeStar(p, unit, anyTriangle, state.memory, stars_);
  }

  PointsView points_;
  const NeighborSource& source_;
  const CloudOptions& options_;
  NeighborhoodFinder finder_;
  StarWrapping wrapping_;
  Stars& stars_;
  StarSupport& support_;
  Buffer<Certainty>& certainty_;
};

void widenStars(const StarBuilder& builder, std::span<const Widening> wanted, const Workers& workers,
                Buffer<StarWorker>& states, BuiltStars& built, Buffer<Certainty>& certainty, Report& report) {
  constexpr std::int64_t block = 16;  // a search takes up to a millisecond
  const auto count = std::ssize(wanted);
  if (count == 0) return;
  BuiltStars widened;
  makeRoom(static_cast<int>(count), widened);
  BlocksInOrder in_order((count + block - 1) / block, widened);
  workers.forBlocks("stars", count, block, [&](std::int64_t begin, std::int64_t end, int worker) {
    builder.widen(wanted, begin, end, states[worker], widened.stars);
    in_order.take(begin / block, states[worker].memory.block);
  });
  finishOffsets(widened.stars);
  replaceStars(wanted, widened, built, certainty, report);
}

}  // namespace

std::int64_t Stars::triangles() const {
  return std::count(triangle.begin(), triangle.end(), 1);
}

std::size_t Stars::bytes() const {
  return bytesOf(triangle) + bytesOf(offset) + bytesOf(link) + bytesOf(ends);
}

std::size_t StarSupport::bytes() const {
  return bytesOf(radius) + bytesOf(fit_radius) + bytesOf(reach) + bytesOf(isolated) + normals.bytes();
}

BuiltStars buildStars(const RankedCloud& cloud, const NeighborSource& source, const CloudOptions& options,
                      const Workers& workers, Report& report) {
  const int n = cloud.size();
  BuiltStars built;
  Stars& stars = built.stars;
  StarSupport& support = built.support;
  makeRoom(n, built);
  Buffer<Certainty> certainty;  // empty if no search is widened
  if (options.steps.star_search == StarSearch::thorough && !source.isGraded() && !source.isFixed()) certainty.resize(n);

  Stopwatch wall;
  const std::int64_t blocks = (n + star_block - 1) / star_block;
  Buffer<StarWorker> states(workers.count());
  const StarBuilder builder(cloud, source, options, built, certainty);
  BlocksInOrder in_order(blocks, built);
  workers.forBlocks("stars", n, star_block, [&](std::int64_t begin, std::int64_t end, int worker) {
    builder.build(begin, end, states[worker]);
    in_order.take(begin / star_block, states[worker].memory.block);
  });
  finishOffsets(stars);

  std::array<double, 3> seconds = {};
  for (const StarWorker& state : states) {
    report.grown_neighborhoods += state.grown_neighborhoods;
    report.split_neighborhoods += state.split_neighborhoods;
    report.thick_neighborhoods += state.thick;
    report.isolated_by_sheets += state.isolated;
    report.grown_stars += state.grown_stars;
    report.closed_stars += state.closed_stars;
    report.open_stars += state.memory.open_stars;
    report.dropped_triangles += state.memory.unusable_triangles;
    for (int i = 0; i < 3; ++i) seconds[i] += state.seconds[i];
  }
  for (int round = 0; round < widening_rounds && !certainty.empty(); ++round) {
    const Certainty by = round == 0 ? Certainty::certain : Certainty::widened;
    widenStars(builder, neededWidenings(built, certainty, by), workers, states, built, certainty, report);
  }
  const double cpu = seconds[0] + seconds[1] + seconds[2];
  const double share = cpu > 0 ? wall.seconds() / cpu : 0;
  report.stages.push_back({"neighbors", seconds[0] * share, 0});
  report.stages.push_back({"frames", seconds[1] * share, 0});
  report.stages.push_back({"stars", seconds[2] * share, stars.bytes() + support.bytes()});
  return built;
}

}  // namespace tufted
