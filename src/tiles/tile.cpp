#include "tiles/tile.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/cover_source.h"
#include "base/parallel.h"
#include "base/power_of_two.h"
#include "base/sort_unique.h"
#include "cover/geometry.h"
#include "operators/distinct_faces.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// At the corner of a rim 8 k points are searched in a quarter of the plane.
constexpr double points_at_corner = 32;
/// Triangles between a point and the farthest one whose star may change its row, if no edge flips: the stars of its
/// link vertices have triangles with it, and triangles are glued by all stars that have their edge.
constexpr int usual_hops = 2;
/// The triangles of a star depend further on the corners of the quadrilaterals whose diagonals are settled, and whether
/// these are settled on the corners of the quadrilaterals beside them.
constexpr int hops_of_settled = 2;
/// Points per asked neighbour that a tile holds at least: neighbourhoods grow to 8 k, stars to 8 times these. A search
/// that found fewer points than it asked for would not know what it missed.
constexpr std::int64_t most_asked = 64;

double circumradiusOfSides(double a, double b, double c) {
  return a * b * c / (4 * triangleArea(a, b, c));
}

/// The cells that are marked, ascending.
std::vector<int> marked(const std::vector<std::uint8_t>& is_marked) {
  std::vector<int> cells;
  for (std::size_t cell = 0; cell < is_marked.size(); ++cell)
    if (is_marked[cell] != 0) cells.push_back(static_cast<int>(cell));
  return cells;
}

}  // namespace

Tile::Tile(const SortedPoints& points, const Scaling& whole, TileTask task)
    : CloudPart(whole),
      points_(points),
      cells_(points.cells()),
      task_(std::move(task)),
      is_own_(static_cast<std::size_t>(cells_.size())),
      is_held_(static_cast<std::size_t>(cells_.size())) {
  for (const int cell : task_.own) is_own_[cell] = 1;
}

void Tile::holdMargin(const CloudOptions& options) {
  std::vector<int> wanted = task_.own;
  wanted.insert(wanted.end(), task_.required.begin(), task_.required.end());
  const double mean = static_cast<double>(cells_.begin(cells_.size())) / cells_.size();
  const double corner = std::sqrt(points_at_corner * options.neighbors / std::numbers::pi / mean);
  // One more for stars that have triangles with the points of these cells, and one because cells are not cut.
  int margin = 2 + static_cast<int>(std::min(std::ceil(corner), 1.0 * options.neighbors));
  margin += (options.steps.settle_diagonals ? 1 : 0) + (options.steps.isolate_outliers ? 1 : 0);
  holdAround(std::move(wanted), margin);
  holdAround(task_.lacking, margin);
  for (const int cell : task_.kept) hold(cell);
  is_whole_ = held_points_ == cells_.begin(cells_.size());
}

void Tile::hold(int cell) {
  if (is_held_[cell] != 0) return;
  is_held_[cell] = 1;
  held_points_ += cells_.points(cell);
}

void Tile::holdAround(std::vector<int> cells, int width) {
  for (const int cell : cells) hold(cell);
  for (int ring = 0; ring < width && !cells.empty(); ++ring) {
    std::vector<int> next;
    for (const int cell : cells) {
      cells_.visitNear(cell, [&](int near) {
        if (is_held_[near] == 0) next.push_back(near);
        hold(near);
      });
    }
    cells.swap(next);
  }
}

void Tile::readPoints() {
  std::vector<StoredPoint> stored;
  stored.reserve(static_cast<std::size_t>(held_points_));
  cell_of_.clear();
  for (int cell = 0; cell < cells_.size();) {
    int end = cell;
    for (; end < cells_.size() && is_held_[end] != 0; ++end)
      cell_of_.insert(cell_of_.end(), static_cast<std::size_t>(cells_.points(end)), end);
    points_.read(cell, end, stored);
    cell = end + 1;
  }
  positions_.resize(std::ssize(stored), 3);
  number_.resize(stored.size());
  for (std::size_t i = 0; i < stored.size(); ++i) {
    positions_.row(static_cast<Eigen::Index>(i)) = Eigen::Map<const Eigen::RowVector3d>(stored[i].position);
    number_[i] = stored[i].number;
  }
}

void Tile::build(const CloudOptions& options) {
  readPoints();
  isolates_ = options.steps.isolate_outliers;
  hops_ = usual_hops + (options.steps.settle_diagonals ? hops_of_settled : 0);
  CloudOptions used = options;
  used.keep_cover = true;  // for the radii of its faces
  result_ = {};
  buildCloudLaplacian(positions_, used, CloudBuild::automatic, result_, this);
  complete_.clear();
  incomplete_.clear();
  needed_.clear();
  lacking_.clear();
  kept_.clear();
  if (is_whole_) {
    complete_ = task_.own;
  } else if (result_.report.active + result_.report.isolated <= most_asked * options.neighbors) {
    incomplete_ = task_.own;
  } else {
    addFaceRadii();
    findComplete(options.progress);
  }
  if (!incomplete_.empty()) lackMore();
}

void Tile::lackMore() {
  std::vector<std::uint8_t> is_known = is_held_;
  const auto is_new = [&](int cell) { return is_known[cell] == 0; };
  if (std::any_of(kept_.begin(), kept_.end(), is_new) || std::any_of(lacking_.begin(), lacking_.end(), is_new)) return;
  for (double radius = cells_.edge(); lacking_.empty() || is_held_[lacking_.back()] != 0; radius *= 2)
    for (const int own : incomplete_)
      cells_.visit(cells_.box(own), radius, [&](int cell) {
        if (std::exchange(is_known[cell], 1) == 0) lacking_.push_back(cell);
      });
}

void Tile::addFaceRadii() {
  std::vector<double> radius(dependence_.size());
  const PowerOfTwo unit = scaling().toScaled();
  const CoverSource& cover = *result_.cover_source;
  cover.visitFaces(0, cover.parts(), [&](const std::array<int, 3>& corners, const double* length) {
    const double r = circumradiusOfSides(unit.times(length[0]), unit.times(length[1]), unit.times(length[2]));
    for (const int i : corners) radius[cell_of_[i]] = std::max(radius[cell_of_[i]], r);
  });
  // An empty circle lies within its diameter of each corner.
  for (std::size_t i = 0; i < radius.size(); ++i) dependence_[i] += 2 * radius[i];
}

std::vector<int> Tile::nearMarked(const std::vector<std::uint8_t>& is_marked) const {
  std::vector<std::uint8_t> is_near(is_marked.size());
  for (int cell = 0; cell < cells_.size(); ++cell)
    if (is_marked[cell] != 0) cells_.visitNear(cell, [&](int near) { is_near[near] = 1; });
  return marked(is_near);
}

void Tile::findComplete(const Progress& progress) {
  std::vector<std::uint8_t> is_fit = is_sure_;
  for (const auto& [to, from] : doubtful_pairs_) is_fit[to] = 0;
  // Any star may have triangles with points of the cells beside its own.
  std::vector<std::int8_t> around(is_fit.size(), -1);  // by cell, whether all cells near it are fit; -1: not known yet
  const auto isFitAround = [&](int cell) {
    if (around[cell] >= 0) return around[cell] != 0;
    around[cell] = 1;
    cells_.visitNear(cell, [&](int near) {
      if (is_fit[near] == 0) around[cell] = 0;
    });
    return around[cell] != 0;
  };
  const bool has_required =
      std::all_of(task_.required.begin(), task_.required.end(), [&](int cell) { return is_sure_[cell] != 0; });
  std::vector<std::uint8_t> by_complete(is_fit.size()), by_other(is_fit.size());  // cells on which own ones depend
  std::vector<int> reached;
  for (std::size_t i = 0; i < task_.own.size(); ++i) {
    if (progress && !progress("tiles", static_cast<double>(i) / static_cast<double>(task_.own.size())))
      throw Cancelled("a tile was cancelled");
    const int own = task_.own[i];
    reached.clear();
    cells_.visit(cells_.box(own), dependence_[own], [&](int cell) { reached.push_back(cell); });
    const bool is_complete = has_required && std::all_of(reached.begin(), reached.end(), isFitAround);
    (is_complete ? complete_ : incomplete_).push_back(own);
    for (const int cell : reached) (is_complete ? by_complete : by_other)[cell] = 1;
  }
  needed_ = nearMarked(by_complete);
  std::vector<int> wanted = nearMarked(by_other);
  if (!has_required) wanted.insert(wanted.end(), task_.required.begin(), task_.required.end());
  findLacking(std::move(wanted));
}

void Tile::findLacking(std::vector<int> cells) {
  sortUnique(cells);
  std::vector<std::uint8_t> is_asked(is_held_.size()), is_kept(is_held_.size());
  const auto ask = [&](int cell) {
    is_asked[cell] = 1;
    for (const int needed : needs_[cell]) is_asked[needed] = 1;
  };
  for (const int cell : cells) {
    ask(cell);
    auto pair = std::lower_bound(doubtful_pairs_.begin(), doubtful_pairs_.end(), std::pair(cell, 0));
    for (; pair != doubtful_pairs_.end() && pair->first == cell; ++pair) ask(pair->second);
  }
  for (int cell = 0; cell < cells_.size(); ++cell) {
    if (is_asked[cell] == 0) continue;
    if (is_held_[cell] == 0) lacking_.push_back(cell);
    cells_.visit(cells_.box(cell), reach_[cell], [&](int near) { is_kept[near] = 1; });
  }
  kept_ = marked(is_kept);
}

TileTask Tile::rest() const {
  TileTask task = {incomplete_, task_.required, lacking_, kept_};
  if (complete_.empty()) {  // then what is held must grow, or tiles would be built for ever
    task.lacking.insert(task.lacking.end(), task_.lacking.begin(), task_.lacking.end());
    task.kept.insert(task.kept.end(), task_.kept.begin(), task_.kept.end());
    sortUnique(task.lacking);
    sortUnique(task.kept);
  }
  return task;
}

TileRows Tile::rows(bool has_faces) const {
  TileRows rows;
  std::vector<Eigen::Index> own;
  for (std::size_t i = 0; i < cell_of_.size(); ++i)
    if (std::binary_search(complete_.begin(), complete_.end(), cell_of_[i]))
      own.push_back(static_cast<Eigen::Index>(i));
  rows.M = result_.M(own);
  rows.normals = result_.frames.normals(own, Eigen::all);
  rows.begin.push_back(0);
  std::vector<std::pair<std::int64_t, double>> entries;
  for (const Eigen::Index i : own) {
    rows.point.push_back(number_[i]);
    rows.representative.push_back(number_[result_.representative[i]]);
    rows.status.push_back(result_.status[i]);
    rows.boundary.push_back(result_.boundary[i]);
    entries.clear();
    for (SparseMatrix::InnerIterator entry(result_.L, i); entry; ++entry)
      entries.emplace_back(number_[entry.row()], entry.value());
    std::sort(entries.begin(), entries.end());
    for (const auto& [column, value] : entries) {
      rows.column.push_back(column);
      rows.value.push_back(value);
    }
    rows.begin.push_back(std::ssize(rows.column));
  }
  if (has_faces) addFaces(own, rows);
  return rows;
}

/// @param own the points of the rows, ascending
void Tile::addFaces(const std::vector<Eigen::Index>& own, TileRows& rows) const {
  const int size = static_cast<int>(number_.size());
  const std::vector<DistinctFace> faces = distinctFaces(*result_.cover_source, size, Workers(1, {}));
  std::vector<std::pair<int, int>> around;  // a point and a face around it
  for (int f = 0; f < std::ssize(faces); ++f)
    for (const int corner : faces[f].corners) around.emplace_back(corner, f);
  sortUnique(around);
  rows.face_begin.push_back(0);
  for (const Eigen::Index i : own) {
    auto place = std::lower_bound(around.begin(), around.end(), std::pair(static_cast<int>(i), 0));
    for (; place != around.end() && place->first == i; ++place) {
      const DistinctFace& face = faces[place->second];
      const auto& [a, b, c] = face.corners;
      rows.faces.push_back({{number_[a], number_[b], number_[c]}, face.opposite, face.copies});
    }
    rows.face_begin.push_back(std::ssize(rows.faces));
  }
}

}  // namespace tufted
