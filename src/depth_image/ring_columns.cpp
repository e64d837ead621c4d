#include "depth_image/ring_columns.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <tuple>
#include <utility>

#include "base/buffer.h"
#include "base/median.h"

namespace tufted {
namespace {

/// Least number of rings; with fewer the image is hardly more than its margins.
constexpr int least_rings = 16;
/// Bound on the numbers of rings; no scanner has as many.
constexpr int most_rows = 4096;
/// Greatest number of pixels per point: rings that cover less than a sixteenth of a turn would leave the rest of the
/// image empty.
constexpr int most_pixels_per_point = 16;
/// Least number of columns: the widest window has 49 and must not meet itself.
constexpr int least_columns = 64;
/// Greatest angle between rings, in rad: wider windows reach around the corners of a room. With noise of 2 cm normals
/// at 0.69 degrees are better than by search, at 0.84 not.
constexpr double most_ring_step = 0.75 * std::numbers::pi / 180;
/// Greatest ratio of the angle between rings to that between points of a ring: 64 rings at 0.1 degrees, with 4.25,
/// still gain.
constexpr double most_stretch = 4.5;
/// Number of sampled steps along rings.
constexpr std::int64_t step_samples = 20000;
/// Number of points of a ring whose median elevation is that of the ring.
constexpr int elevation_samples = 16;
/// Steps that differ from the median by more than this share of it are gaps or jitter.
constexpr double same_step = 0.25;
/// Half of the steps must agree with those of the points around z within this share of a step; otherwise the scan was
/// moved or turned.
constexpr double most_step_error = 0.5;
/// Greatest number of columns that a point may be moved from its azimuth: the reach of a window; a speed that varies by
/// 0.5 % stays below.
constexpr int most_shift = 3;
/// Longest gap, in columns, within a surface; longer ones are sky or doors.
constexpr int longest_gap = 8;
/// Greatest share of columns in such gaps. With 9 % of the points left out at random the area of 64 exact rings grows
/// by 1.3 %, with 30 % by more than 8 %.
constexpr double most_gaps = 0.1;

/// A point of a ring.
struct Shot {
  double azimuth;
  int rank;
};

/// The points of all rings, ring by ring.
class RingShots {
 public:
  RingShots(const RankedScan& scan, int rows) {
    Buffer<int> end(static_cast<std::size_t>(rows) + 1, 0);
    for (const int row : scan.row)
      if (row >= 0) ++end[row + 1];
    begin_.push_back(0);
    for (int row = 0; row < rows; ++row) {
      if (end[row + 1] > 0) begin_.push_back(begin_.back() + end[row + 1]);
      end[row + 1] += end[row];
    }
    shots_.resize(static_cast<std::size_t>(end[rows]));
    for (int p = 0; p < static_cast<int>(scan.row.size()); ++p)
      if (scan.row[p] >= 0) shots_[end[scan.row[p]]++] = {scan.position[p], p};
  }

  void sortByAzimuth(const Workers& workers) {
    workers.forBlocks("windows", rings(), 1, [this](std::int64_t from, std::int64_t to, int) {
      for (std::int64_t ring = from; ring < to; ++ring)
        std::sort(shots_.begin() + begin_[ring], shots_.begin() + begin_[ring + 1], [](const Shot& a, const Shot& b) {
          return std::tie(a.azimuth, a.rank) < std::tie(b.azimuth, b.rank);
        });
    });
  }

  int rings() const { return static_cast<int>(begin_.size()) - 1; }
  int size() const { return begin_.back(); }
  int begin(int ring) const { return begin_[ring]; }
  int end(int ring) const { return begin_[ring + 1]; }
  const Shot& operator[](int i) const { return shots_[i]; }

 private:
  RawBuffer<Shot> shots_;
  Buffer<int> begin_;  ///< first point of each ring that has any, and the number of points
};

/// The mean step of the azimuth along rings, without gaps; 0 if there is none.
/// @param shots sorted by azimuth
double azimuthStep(const RingShots& shots) {
  Buffer<double> steps;
  const int stride = static_cast<int>(std::max<std::int64_t>(1, shots.size() / step_samples)) | 1;
  for (int ring = 0; ring < shots.rings(); ++ring)
    for (int i = shots.begin(ring) + 1; i < shots.end(ring); i += stride)
      steps.push_back(shots[i].azimuth - shots[i - 1].azimuth);
  const double median = medianOf(steps);
  double sum = 0;
  std::int64_t count = 0;
  for (const double step : steps) {
    if (std::abs(step - median) > same_step * median) continue;
    sum += step;
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

/// Whether azimuths are those of the points around z, up to their zero and direction. If not, the scan was moved or
/// turned and has no image around this axis.
bool areSeen(const RankedScan& scan, const PointsView& points, const RingShots& shots) {
  const auto seenAt = [&](int i) {
    const Eigen::RowVector3d ray = points.row(shots[i].rank) - scan.origin.transpose();
    return std::atan2(ray.y(), ray.x());
  };
  std::int64_t steps = 0, same_way = 0, other_way = 0;
  const int stride = static_cast<int>(std::max<std::int64_t>(1, shots.size() / step_samples)) | 1;
  for (int ring = 0; ring < shots.rings(); ++ring)
    for (int i = shots.begin(ring) + 1; i < shots.end(ring); i += stride) {
      const double step = shots[i].azimuth - shots[i - 1].azimuth;
      const double seen = std::remainder(seenAt(i) - seenAt(i - 1), 2 * std::numbers::pi);
      ++steps;
      same_way += std::abs(seen - step) <= most_step_error * step ? 1 : 0;
      other_way += std::abs(seen + step) <= most_step_error * step ? 1 : 0;
    }
  return 2 * std::max(same_way, other_way) >= steps;
}

/// The median angle between consecutive rings.
double ringStep(const RankedScan& scan, const PointsView& points, const RingShots& shots) {
  Buffer<double> steps;
  double before = 0;
  for (int ring = 0; ring < shots.rings(); ++ring) {
    Buffer<double> elevations;
    const int stride = std::max(1, (shots.end(ring) - shots.begin(ring)) / elevation_samples);
    for (int i = shots.begin(ring); i < shots.end(ring); i += stride) {
      const Eigen::RowVector3d ray = points.row(shots[i].rank) - scan.origin.transpose();
      elevations.push_back(std::atan2(ray.z(), std::hypot(ray.x(), ray.y())));
    }
    const double here = medianOf(std::move(elevations));
    if (ring > 0) steps.push_back(std::abs(here - before));
    before = here;
  }
  return medianOf(std::move(steps));
}

/// The columns that the points of a ring have got.
struct RingFit {
  int first = INT32_MAX, end = 0;  ///< range of columns with points
  int shift = 0;                   ///< greatest shift from an azimuth, in columns
  int gaps = 0;                    ///< columns missing in gaps
};

/// Gives the points of a ring their columns: that of the azimuth, or the one after the previous point if it is taken,
/// so that points keep their order if azimuths are halfway between two columns.
/// @param shots sorted by azimuth
RingFit placeRing(const RingShots& shots, int ring, double step, RankedScan& scan) {
  RingFit fit;
  int last = -1;
  for (int i = shots.begin(ring); i < shots.end(ring); ++i) {
    const auto wanted = static_cast<int>(std::lround(shots[i].azimuth / step));
    const int gap = wanted - last - 1;
    if (i > shots.begin(ring) && gap > 0 && gap <= longest_gap) fit.gaps += gap;
    last = std::max(last + 1, wanted);
    fit.first = std::min(fit.first, last);
    fit.shift = std::max(fit.shift, last - wanted);
    scan.position[shots[i].rank] = last;
  }
  fit.end = last + 1;
  return fit;
}

}  // namespace

std::optional<RingImage> columnsOfRings(RankedScan scan, const PointsView& points, const Workers& workers) {
  const int last_row = scan.row.empty() ? -1 : *std::max_element(scan.row.begin(), scan.row.end());
  if (last_row >= most_rows) return std::nullopt;
  const int rows = last_row + 1;
  RingShots shots(scan, rows);
  if (shots.rings() < least_rings) return std::nullopt;
  const double ring_step = ringStep(scan, points, shots);
  if (!(ring_step <= most_ring_step)) return std::nullopt;
  shots.sortByAzimuth(workers);
  const double step = azimuthStep(shots);
  if (!(step > 0) || ring_step > most_stretch * step || !areSeen(scan, points, shots)) return std::nullopt;
  const double columns = 2 * std::numbers::pi / step;
  if (columns < least_columns || columns * rows > most_pixels_per_point * static_cast<double>(shots.size()))
    return std::nullopt;
  Buffer<RingFit> fits(static_cast<std::size_t>(shots.rings()));
  workers.forBlocks("windows", shots.rings(), 1, [&](std::int64_t begin, std::int64_t end, int) {
    for (int ring = static_cast<int>(begin); ring < end; ++ring) fits[ring] = placeRing(shots, ring, step, scan);
  });
  RingFit all;
  for (const RingFit& fit : fits)
    all = {std::min(all.first, fit.first), std::max(all.end, fit.end), std::max(all.shift, fit.shift),
           all.gaps + fit.gaps};
  if (all.shift > most_shift || all.gaps > most_gaps * (shots.size() + all.gaps)) return std::nullopt;
  // Columns are counted from the first one with a point, so that none is empty beside the seam if azimuths begin late.
  for (int i = 0; i < shots.size(); ++i) scan.position[shots[i].rank] -= all.first;
  return RingImage{std::move(scan), std::max(all.end - all.first, static_cast<int>(std::lround(columns)))};
}

}  // namespace tufted
