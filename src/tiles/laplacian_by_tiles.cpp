#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/number_text.h"
#include "base/require.h"
#include "base/sort_unique.h"
#include "pipeline/cloud_options.h"
#include "tiles/passes_scaling.h"
#include "tiles/sorted_points.h"
#include "tiles/tile.h"
#include "tufted/errors.h"
#include "tufted/report.h"
#include "tufted/tiles.h"

namespace tufted {
namespace {

constexpr const char* laplacian_by_tiles_name = "laplacianByTiles";
/// Bytes per point that a build takes with its rows: 500 to 650 were measured on terrains of 1 and 5 million points.
constexpr double point_bytes = 700;
/// Bytes per point that faces take on top: 405 were measured on a sphere of a million points.
constexpr double face_bytes = 450;
/// Bytes that are taken whatever the number of points in a tile: the program, batches of points and the cells.
constexpr double fixed_bytes = 250e6;
/// Share of the points in memory that a tile owns; the others are its margin.
constexpr double own_share = 0.6;

void checkOptions(const TileOptions& options) {
  const CloudOptions& cloud = options.cloud;
  checkCloudOptions(
      laplacian_by_tiles_name, Points(0, 3),
      {.neighbors = cloud.neighbors, .mollify = cloud.mollify, .threads = cloud.threads, .paper = cloud.paper});
  if (options.tiles < 0) refuse(laplacian_by_tiles_name, "tiles = " + std::to_string(options.tiles) + ", must be >= 0");
  if (!(options.memory > fixed_bytes))
    refuse(laplacian_by_tiles_name,
           "memory = " + numberText(options.memory) + " bytes, must be more than " + numberText(fixed_bytes));
  const TileProcesses& processes = options.processes;
  if (!(0 <= processes.number && processes.number < processes.count))
    refuse(laplacian_by_tiles_name, "processes.number = " + std::to_string(processes.number) +
                                        ", must be in [0, processes.count = " + std::to_string(processes.count) + ")");
  if (processes.count > 1 && !processes.share)
    refuse(laplacian_by_tiles_name, "processes.share is empty, must be set for several processes");
  if (cloud.normals != nullptr || cloud.neighborhoods != nullptr || cloud.structure != nullptr ||
      cloud.viewpoint != nullptr)
    refuse(laplacian_by_tiles_name, "normals, neighborhoods, structure and viewpoint must be null");
  if (cloud.steps.denoise)
    refuse(laplacian_by_tiles_name, "denoise = true, must be false: noise is not yet found by tiles");
  if (cloud.paper.gluing != Gluing::star || cloud.paper.order != FaceOrder::angle)
    refuse(laplacian_by_tiles_name, "gluing and order of the paper must be star and angle: others need a whole cover");
}

void ask(const TileOptions& options, const char* stage, double share) {
  if (options.progress && !options.progress(stage, share))
    throw Cancelled(std::string(laplacian_by_tiles_name) + ": cancelled");
}

/// The points of a source, whose passes ask whether to go on.
PointSource watched(const PointSource& source, const TileOptions& options) {
  return {source.size, [&](const std::function<void(const PointsRef& batch)>& take) {
            std::int64_t done = 0;
            source.pass([&](const PointsRef& batch) {
              ask(options, "sort", static_cast<double>(done) / static_cast<double>(source.size));
              take(batch);
              done += batch.rows();
            });
          }};
}

/// The last cell of each tile, for tiles of about equally many points.
std::vector<int> planTiles(const Cells& cells, std::int64_t tiles) {
  std::vector<int> ends;
  const std::int64_t all = cells.begin(cells.size());
  for (int cell = 0; cell < cells.size(); ++cell) {
    const auto tile = std::ssize(ends) + 1;
    if (cells.begin(cell + 1) >= all / tiles * tile + std::min(tile, all % tiles)) ends.push_back(cell + 1);
  }
  return ends;
}

/// The share of a build's time that has gone when a stage has come to `fraction`, between terrains of a million points
/// with and without noise and a scan with trees; 0 for short stages.
double shareOfBuild(std::string_view stage, double fraction) {
  if (stage == "stars") return 0.05 + 0.35 * fraction;
  if (stage == "boundary") return 0.4 + 0.4 * fraction;
  return stage == "assemble" ? 0.8 + 0.2 * fraction : 0;
}

/// Builds tiles and hands out their rows.
class TileBuilds {
 public:
  TileBuilds(const SortedPoints& points, const Scaling& scaling, const TileOptions& options,
             const std::function<void(const TileRows&)>& take)
      : points_(points), scaling_(scaling), options_(options), take_(take) {
    const std::int64_t all = points.cells().begin(points.cells().size());
    constexpr double much = 1e18;  // the points of so much memory can still be counted
    const double most =
        (std::min(options.memory, much) - fixed_bytes) / (point_bytes + (options.faces ? face_bytes : 0));
    most_points_ = std::max<std::int64_t>(1, static_cast<std::int64_t>(most));
    const double own = static_cast<double>(most_points_) * (all <= most_points_ ? 1 : own_share);
    const auto fitting = static_cast<std::int64_t>(std::ceil(static_cast<double>(all) / own));
    const std::int64_t tiles = options.tiles > 0 ? options.tiles : fitting;
    const std::int64_t processes = options.processes.count;
    ends_ = planTiles(points.cells(), std::max<std::int64_t>((tiles + processes - 1) / processes, 1) * processes);
  }

  TileReport buildAll() {
    const auto firstOf = [&](int process) { return ends_.size() * process / options_.processes.count; };
    const std::size_t first = firstOf(options_.processes.number), last = firstOf(options_.processes.number + 1);
    const auto beginOf = [&](std::size_t number) { return number == 0 ? 0 : ends_[number - 1]; };
    own_points_ = static_cast<double>(points_.cells().begin(beginOf(last)) - points_.cells().begin(beginOf(first)));
    for (std::size_t number = first; number < last; ++number) {
      TileTask task;
      for (int cell = beginOf(number); cell < ends_[number]; ++cell) task.own.push_back(cell);
      build(std::move(task));
    }
    // A star far away, such as that of an outlier, may have triangles with points of a tile that cannot know that. All
    // processes end once none of them has found more such stars.
    std::vector<std::pair<int, int>> shared, before;
    do {
      before = std::move(shared);
      if (options_.processes.share) far_pairs_ = options_.processes.share(far_pairs_);
      sortUnique(far_pairs_);
      shared = far_pairs_;
      while (requireMore()) {
      }
    } while (shared != before);
    return report();
  }

 private:
  /// Rows that were built.
  struct Built {
    TileTask task;            ///< of building them again
    std::vector<int> needed;  ///< see Tile::neededCells()
    TileReport counts;
  };

  /// Builds rows again that depend on stars of which their tile did not know. Returns whether there were any.
  bool requireMore() {
    sortUnique(far_pairs_);
    std::vector<TileTask> again;
    for (std::size_t i = 0; i < built_.size();) {
      Built& built = built_[i];
      const auto needs = [&](int cell) { return std::binary_search(built.needed.begin(), built.needed.end(), cell); };
      std::vector<int>& required = built.task.required;
      const std::size_t before = required.size();
      for (const auto& [from, to] : far_pairs_) {
        const bool is_known = needs(from) || std::find(required.begin(), required.end(), from) != required.end();
        if (needs(to) && !is_known) required.push_back(from);
      }
      if (required.size() == before) {
        ++i;
        continue;
      }
      again.push_back(std::move(built.task));
      built = std::move(built_.back());
      built_.pop_back();
    }
    for (TileTask& task : again) build(std::move(task));
    return !again.empty();
  }

  void build(TileTask first) {
    std::vector<TileTask> open = {std::move(first)};
    while (!open.empty()) {
      const TileTask task = std::move(open.back());
      open.pop_back();
      if (task.own.empty()) continue;
      CloudOptions cloud = options_.cloud;
      cloud.progress = progressOf(task);
      if (!cloud.progress("tiles", 0)) throw Cancelled(std::string(laplacian_by_tiles_name) + ": cancelled");
      Tile tile(points_, scaling_, task);
      tile.holdMargin(cloud);
      if (tile.heldPoints() > most_points_) {
        if (task.own.size() == 1) refuseLarge(tile.heldPoints());
        // Parts of a tile need fewer points around them.
        const auto middle = task.own.begin() + std::ssize(task.own) / 2;
        open.push_back({{middle, task.own.end()}, task.required});
        open.push_back({{task.own.begin(), middle}, task.required});
        continue;
      }
      most_held_ = std::max(most_held_, tile.heldPoints());
      all_held_ += tile.heldPoints();
      ++builds_;
      tile.build(cloud);
      for (const auto& pair : tile.farPairs())
        if (std::binary_search(tile.complete().begin(), tile.complete().end(), pair.first)) far_pairs_.push_back(pair);
      asked_points_ += pointsOf(task);
      if (const TileRows rows = tile.rows(options_.faces); !rows.point.empty()) {
        built_points_ += static_cast<double>(rows.point.size());
        built_.push_back({{tile.complete(), task.required}, tile.neededCells(), countsOf(rows)});
        take_(rows);
      }
      open.push_back(tile.rest());
    }
  }

  double pointsOf(const TileTask& task) const {
    std::int64_t points = 0;
    for (const int cell : task.own) points += points_.cells().points(cell);
    return static_cast<double>(points);
  }

  /// Reports the share of rows that are built while a task is carried out, which never falls. Of its rows so many are
  /// expected to be complete as were of those before.
  Progress progressOf(const TileTask& task) {
    const double expected = pointsOf(task) * (asked_points_ > 0 ? built_points_ / asked_points_ : 1);
    return [this, expected](std::string_view stage, double fraction) {
      const double rows = built_points_ + shareOfBuild(stage, fraction) * expected;
      share_ = std::max(share_, std::min(1., rows / own_points_));
      return !options_.progress || options_.progress("tiles", share_);
    };
  }

  [[noreturn]] void refuseLarge(std::int64_t held) const {
    refuse(laplacian_by_tiles_name, "a tile holds " + std::to_string(held) +
                                        " points with its margin, must be at most " + std::to_string(most_points_) +
                                        ": give more memory, or leave out points far from the surface");
  }

  static TileReport countsOf(const TileRows& rows) {
    TileReport counts;
    for (const PointStatus status : rows.status) {
      counts.active += status == PointStatus::active ? 1 : 0;
      counts.coincident += status == PointStatus::coincident ? 1 : 0;
      counts.isolated += status == PointStatus::isolated ? 1 : 0;
    }
    counts.nonzeros = std::ssize(rows.column);
    counts.area = rows.M.sum();
    return counts;
  }

  TileReport report() const {
    TileReport report;
    for (const Built& built : built_) {
      report.active += built.counts.active;
      report.coincident += built.counts.coincident;
      report.isolated += built.counts.isolated;
      report.nonzeros += built.counts.nonzeros;
      report.area += built.counts.area;
    }
    const std::int64_t sorted = points_.cells().begin(points_.cells().size());
    report.cells = points_.cells().size();
    report.tiles = static_cast<int>(ends_.size());
    report.builds = builds_;
    report.most_points = most_held_;
    report.margin = sorted > 0 ? static_cast<double>(all_held_) / static_cast<double>(sorted) - 1 : 0;
    return report;
  }

  const SortedPoints& points_;
  const Scaling& scaling_;
  const TileOptions& options_;
  const std::function<void(const TileRows&)>& take_;
  std::int64_t most_points_ = 0, most_held_ = 0, all_held_ = 0;
  int builds_ = 0;
  double own_points_ = 0, asked_points_ = 0, built_points_ = 0;  ///< for progressOf(); of builds again as well
  double share_ = 0;                                             ///< that was reported last
  std::vector<int> ends_;
  std::vector<Built> built_;
  std::vector<std::pair<int, int>> far_pairs_;  ///< see Tile::farPairs(), of all tiles known here
};

}  // namespace

PointSource sourceOf(const PointsRef& points) {
  return {points.rows(), [points](const auto& take) {
            constexpr Eigen::Index most = 1 << 20;  // a fraction of a second between batches
            for (Eigen::Index first = 0; first < points.rows(); first += most)
              take(points.middleRows(first, std::min(most, points.rows() - first)));
          }};
}

std::vector<std::string> warnings(const TileReport& report) {
  Report counts;
  counts.points = report.points;
  counts.active = report.active;
  counts.not_finite = report.not_finite;
  counts.coincident = report.coincident;
  counts.isolated = report.isolated;
  return warnings(counts);
}

TileReport laplacianByTiles(const PointSource& source, const TileOptions& options,
                            const std::function<void(const TileRows&)>& take) {
  checkOptions(options);
  const PointSource asking = watched(source, options);
  const Scaling scaling = measureScaling(asking);
  const SortedPoints points(asking, scaling, options.folder);
  TileReport report = TileBuilds(points, scaling, options, take).buildAll();
  report.points = source.size;
  report.not_finite = source.size - points.cells().begin(points.cells().size());
  return report;
}

}  // namespace tufted
