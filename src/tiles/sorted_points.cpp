#include "tiles/sorted_points.h"

#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <string>
#include <unordered_map>
#include <utility>

#include "neighbors/morton.h"
#include "tiles/passes_scaling.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// Mean number of points per cell at least. A margin is some cells wide, and searches look as far as 30 points or more.
constexpr std::int64_t least_mean = 16;
/// Each cell takes 100 bytes of memory; a billion points then have 1,000 per cell.
constexpr std::int64_t most_cells = 1 << 20;
constexpr int finest_level = 16;                          // cells of 2^-11 spreads, more than most_cells on a surface
constexpr std::size_t batch_size = std::size_t{1} << 20;  // points that are sorted in memory, 50 MB

[[noreturn]] void failTo(const std::filesystem::path& folder, const char* what) {
  throw IoError(folder.string() + ": cannot " + what + " the file of sorted points: " + std::strerror(errno));
}

/// Calls visit(point, scaled point, its place on the curve, its number) for all points that take part.
template <class Visit>
void forPlaced(const PointSource& source, const Scaling& scaling, const Visit& visit) {
  const MortonGrid grid(scaling);
  std::int64_t number = 0;
  source.pass([&](const PointsRef& batch) {
    for (Eigen::Index i = 0; i < batch.rows(); ++i, ++number) {
      const Eigen::RowVector3d point = batch.row(i);
      if (!takesPart(scaling, point)) continue;
      const Eigen::Array3d scaled = grid.scaled(point);
      visit(point, scaled, grid.codeOf(scaled), number);
    }
  });
}

/// How many points lie in the cells of the finest grid whose cells hold enough points on average.
struct CellCounts {
  int level = finest_level;
  std::unordered_map<std::uint64_t, std::int64_t> points;

  int shift() const { return 3 * (MortonGrid::axis_bits - level); }
  void coarsen() {
    --level;
    std::unordered_map<std::uint64_t, std::int64_t> coarser;
    for (const auto& [key, count] : points) coarser[key >> 3] += count;
    points = std::move(coarser);
  }
};

CellCounts countCells(const PointSource& source, const Scaling& scaling) {
  CellCounts counts;
  std::int64_t all = 0;
  const auto mostOf = [](std::int64_t points) {
    return static_cast<std::size_t>(std::clamp<std::int64_t>(points / least_mean, 1, most_cells));
  };
  const std::size_t most = mostOf(source.size);
  forPlaced(source, scaling, [&](const auto&, const auto&, std::uint64_t code, std::int64_t) {
    ++counts.points[code >> counts.shift()];
    while (counts.points.size() > most && counts.level > 0) counts.coarsen();
    ++all;
  });
  while (counts.points.size() > mostOf(all) && counts.level > 0) counts.coarsen();
  return counts;
}

void writeAt(int file, const std::filesystem::path& folder, const StoredPoint* points, std::size_t count,
             std::int64_t place) {
  const char* bytes = reinterpret_cast<const char*>(points);
  std::size_t left = count * sizeof(StoredPoint);
  auto offset = static_cast<off_t>(place * static_cast<std::int64_t>(sizeof(StoredPoint)));
  while (left > 0) {
    const ssize_t written = ::pwrite(file, bytes, left, offset);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) failTo(folder, "write");
    bytes += written, offset += written, left -= static_cast<std::size_t>(written);
  }
}

}  // namespace

SortedPoints::SortedPoints(const PointSource& source, const Scaling& scaling, const std::filesystem::path& folder)
    : folder_(folder), file_(folder), cells_(write(source, scaling)) {}

SortedPoints::File::File(const std::filesystem::path& folder) {
  std::string name = (folder / ".tufted-points-XXXXXX").string();
  number_ = ::mkstemp(name.data());
  if (number_ < 0) failTo(folder, "create");
  ::unlink(name.c_str());
}

SortedPoints::File::~File() {
  ::close(number_);
}

Cells SortedPoints::write(const PointSource& source, const Scaling& scaling) {
  const CellCounts counts = countCells(source, scaling);
  std::vector<std::uint64_t> keys;
  for (const auto& [key, count] : counts.points) keys.push_back(key);
  std::sort(keys.begin(), keys.end());
  std::vector<std::int64_t> begin = {0};
  for (const std::uint64_t key : keys) begin.push_back(begin.back() + counts.points.at(key));

  std::vector<CellBox> boxes(keys.size());
  std::vector<std::int64_t> next = begin;
  std::vector<std::pair<int, StoredPoint>> batch;
  std::vector<StoredPoint> run;
  const auto writeBatch = [&] {
    std::stable_sort(batch.begin(), batch.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 0; i < batch.size();) {
      const int cell = batch[i].first;
      run.clear();
      for (; i < batch.size() && batch[i].first == cell; ++i) run.push_back(batch[i].second);
      writeAt(file_.number(), folder_, run.data(), run.size(), next[cell]);
      next[cell] += std::ssize(run);
    }
    batch.clear();
  };
  forPlaced(
      source, scaling,
      [&](const Eigen::RowVector3d& point, const Eigen::Array3d& scaled, std::uint64_t code, std::int64_t number) {
        const auto key = std::lower_bound(keys.begin(), keys.end(), code >> counts.shift());
        const int cell = static_cast<int>(key - keys.begin());
        boxes[cell].widen(CellBox::of(scaled));
        batch.push_back({cell, {{point.x(), point.y(), point.z()}, number}});
        if (batch.size() == batch_size) writeBatch();
      });
  writeBatch();
  return {std::ldexp(1.0, MortonGrid::axis_bits - MortonGrid::spread_bits - counts.level), std::move(begin),
          std::move(boxes)};
}

void SortedPoints::read(int first, int last, std::vector<StoredPoint>& points) const {
  const std::size_t before = points.size();
  points.resize(before + static_cast<std::size_t>(cells_.begin(last) - cells_.begin(first)));
  char* bytes = reinterpret_cast<char*>(points.data() + before);
  std::size_t left = (points.size() - before) * sizeof(StoredPoint);
  auto offset = static_cast<off_t>(cells_.begin(first) * static_cast<std::int64_t>(sizeof(StoredPoint)));
  while (left > 0) {
    const ssize_t got = ::pread(file_.number(), bytes, left, offset);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) failTo(folder_, "read");
    bytes += got, offset += got, left -= static_cast<std::size_t>(got);
  }
}

}  // namespace tufted
