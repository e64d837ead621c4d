#include "denoise/rim_moves.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <tuple>

#include "denoise/listed_search.h"
#include "denoise/rim_profile.h"
#include "denoise/window_surface.h"

namespace tufted {
namespace {

constexpr double least_blur = 0.2;       // of the spacing: less noise hardly widens a surface
constexpr double least_one_sided = 0.2;  // of Windows::one_sided: it is .42 on a straight rim
constexpr int judged = 2;                // windows next to a rim by those that say whether it is blurred
constexpr int seen = 8;                  // times the base window: the neighbours that make a strip
constexpr double half_length = 0.7;      // of their radius, that of a strip
constexpr double depth = 0.55;           // of their radius
constexpr int least_deep = 12;           // points in the deeper half of a strip
constexpr double first_line = 0.3;       // points on the rim by those a spacing apart, where the search for more starts
constexpr double left_in_place = 0.25;   // of the noise: the blur of a rim that has no noise along the surface
constexpr double most_slope = 0.5;       // of a rim in its strip
constexpr double most_beyond = 4;        // sigmas: a point farther outside says that the surface goes on there
constexpr double from_inside = 2;        // sigmas: from there on inwards the surface is whole
constexpr int parts = 6;                 // of a strip along the rim
constexpr double least_share = 0.35;     // of the mean, of the points in each part: less is a corner or a hole
constexpr int least_strips = 8;          // judged ones
// The gains are those of the logarithm of the likelihood, in the mean over all strips.
constexpr double least_blurred = -1.2;       // gain by a rim that is blurred
constexpr double least_line = 0.7;           // gain by points on the rim
constexpr double line_by_blur = 0.6;         // the same, times the blur in spacings
constexpr double least_without_line = 0.35;  // spacings of blur
constexpr double most_uneven = 1.4;          // variance of counts in stripes by that of points thrown at random
constexpr double reach = 1.5;                // sigmas inside of the rim, up to where points count
constexpr double same_rim = 0.77;            // cosine of 40 degrees

/// A point next to a rim, in the plane of its strip.
struct PlaceInStrip {
  int point;
  Eigen::Vector2d at;
};

/// A stretch of the rim, seen from a window.
struct Stretch {
  bool is_rim = false, is_judged = false;
  Eigen::Vector3d inward, along;
  double half = 0, blur = 0;
  RimProfile sharp, blurred, with_line;
  std::array<double, 2> unevenness;  ///< across the rim and along it
  Buffer<PlaceInStrip> places;       ///< near the rim
};

/// Memory of one worker.
struct RimScratch {
  WindowNeighbors around;
  RimStrip strip;
  Buffer<PlaceInStrip> places;  ///< all neighbours of a window
};

/// What one stretch says about one point.
struct RimVote {
  int point;
  double weight, inside;
  Eigen::Vector3d inward;
};

/// Counts points in stripes.
class Stripes {
 public:
  Stripes(double begin, double end, double width)
      : begin_(begin), width_(width), counts_(static_cast<std::size_t>(std::max(0.0, (end - begin) / width)), 0) {}
  void add(double x) {
    const double i = std::floor((x - begin_) / width_);
    if (i >= 0 && i < static_cast<double>(counts_.size())) ++counts_[static_cast<std::size_t>(i)];
  }
  /// The variance of the counts by their mean, 1 where points are thrown at random.
  double unevenness() const {
    double sum = 0, squares = 0;
    for (const int count : counts_) sum += count;
    if (counts_.size() < 2 || !(sum > 0)) return 1;
    const double mean = sum / static_cast<double>(counts_.size());
    for (const int count : counts_) squares += (count - mean) * (count - mean);
    return squares / mean / static_cast<double>(counts_.size() - 1);
  }

 private:
  double begin_, width_;
  Buffer<int> counts_;
};

/// Whether the surface goes on inside along all of the strip and nowhere beyond it.
bool isRim(const RimStrip& strip, double blur, const RimCurve& curve) {
  if (!(std::abs(curve.edge) < strip.depth / 2)) return false;
  if (!(std::abs(curve.tilt) + 2 * std::abs(curve.bend) < most_slope * strip.half)) return false;
  std::array<int, parts> counts{};
  int all = 0;
  for (const Eigen::Vector2d& at : strip.points) {
    const double inside = curve.insideOf(strip.half, at);
    if (inside < -most_beyond * blur) return false;
    if (inside < from_inside * blur) continue;
    ++counts[std::clamp(static_cast<int>((at.y() / strip.half + 1) / 2 * parts), 0, parts - 1)];
    ++all;
  }
  return std::ranges::all_of(counts, [&](int count) { return count * parts > least_share * all; });
}

class RimFinder {
 public:
  /// All arguments are borrowed.
  RimFinder(const PointsView& points, const Windows& windows, const NoiseLevel& noise, const WindowChoice& choice,
            const PointBuffer& move)
      : points_(points), windows_(windows), noise_(noise), choice_(choice), move_(move) {}

  bool maySeeRim(int w) const {
    const double least = least_blur * windows_.spacing(w);
    return windows_.is_copy[w] == 0 && noise_.noisy[w] != 0 && choice_.window[w] >= Windows::base_size &&
           windows_.split[w] == 0 && windows_.one_sided[w] > least_one_sided && noise_.variance[w] > least * least;
  }

  /// Looks for a rim near window w.
  /// @param scratch with the neighbours
  void look(int w, RimScratch& scratch, Stretch& stretch) const {
    if (!takeStrip(w, scratch, stretch)) return;
    const RimStrip& strip = scratch.strip;
    const double blur = stretch.blur;
    RimProfile from = firstProfile(strip);
    stretch.blurred = fitRimProfile(strip, blur, RimLine::none, from);
    if (!isRim(strip, blur, stretch.blurred.curve)) return;
    from = stretch.blurred;
    from.line = first_line * std::sqrt(from.density);
    stretch.with_line = fitRimProfile(strip, blur, RimLine::some, from);
    if (!isRim(strip, blur, stretch.with_line.curve)) return;
    stretch.is_rim = true;
    if (stretch.is_judged) {
      stretch.sharp = fitRimProfile(strip, left_in_place * blur, RimLine::some, from);
      from.curve.edge -= blur;
      const RimProfile farther_out = fitRimProfile(strip, left_in_place * blur, RimLine::some, from);
      if (farther_out.likelihood > stretch.sharp.likelihood) stretch.sharp = farther_out;
    }
    measureStripes(strip, stretch);
    for (const PlaceInStrip& place : scratch.places) {
      const double inside = std::min(stretch.blurred.curve.insideOf(stretch.half, place.at),
                                     stretch.with_line.curve.insideOf(stretch.half, place.at));
      if (std::abs(place.at.y()) <= stretch.half && inside <= 2 * reach * blur) stretch.places.push_back(place);
    }
  }

 private:
  /// Puts the neighbours, where they have moved to, into the tangent plane of the window.
  bool takeStrip(int w, RimScratch& scratch, Stretch& stretch) const {
    const WindowNeighbors& around = scratch.around;
    RimStrip& strip = scratch.strip;
    const int p = windows_.pointOf(w);
    const std::size_t n = around.all.size();
    const Eigen::Vector3d normal = surfaceAt(windows_, w, choice_.window[w], Eigen::Vector3d::Zero()).normal;
    const auto offset = [&](int q) -> Eigen::Vector3d {
      return (points_.row(q) - points_.row(p) + move_.row(q) - move_.row(p)).transpose();
    };
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < n / 4; ++i)
      if (around.skipped[i] == 0) middle += offset(around.all[i].index);
    middle -= middle.dot(normal) * normal;
    if (!(middle.norm() > 0)) return false;
    stretch.inward = middle.normalized();
    stretch.along = normal.cross(stretch.inward);
    stretch.blur = std::sqrt(noise_.variance[w]);
    const double radius = std::sqrt(around.all.back().squared_distance);
    strip.half = stretch.half = half_length * radius;
    strip.depth = depth * radius;
    strip.points.clear();
    scratch.places.clear();
    scratch.places.push_back({p, Eigen::Vector2d::Zero()});
    for (std::size_t i = 0; i < n; ++i) {
      if (around.skipped[i] != 0) continue;
      const int q = around.all[i].index;
      const Eigen::Vector3d d = offset(q);
      scratch.places.push_back({q, {d.dot(stretch.inward), d.dot(stretch.along)}});
    }
    for (const PlaceInStrip& place : scratch.places)
      if (std::abs(place.at.y()) < strip.half && place.at.x() < strip.depth) strip.points.push_back(place.at);
    return deepPoints(strip) > least_deep;
  }

  /// How many points lie in the deeper half of a strip.
  static std::ptrdiff_t deepPoints(const RimStrip& strip) {
    return std::ranges::count_if(strip.points, [&](const auto& at) { return at.x() > strip.depth / 2; });
  }

  static RimProfile firstProfile(const RimStrip& strip) {
    RimProfile first;
    first.density = static_cast<double>(deepPoints(strip)) / (strip.half * strip.depth);
    first.line = first_line * std::sqrt(first.density);
    first.curve.edge = strip.depth - static_cast<double>(strip.points.size()) / (first.density * 2 * strip.half);
    return first;
  }

  /// Measures how unevenly points lie in stripes across the rim and along it. The stripes are a spacing wide.
  static void measureStripes(const RimStrip& strip, Stretch& stretch) {
    const RimCurve& curve = stretch.blurred.curve;
    const double width = 1 / std::sqrt(stretch.blurred.density), begin = from_inside * stretch.blur;
    Stripes across(begin, strip.depth - curve.edge, width), along(-strip.half, strip.half, width);
    for (const Eigen::Vector2d& at : strip.points) {
      const double inside = curve.insideOf(strip.half, at);
      if (inside < begin) continue;
      across.add(inside);
      along.add(at.y());
    }
    stretch.unevenness = {across.unevenness(), along.unevenness()};
  }

  PointsView points_;
  const Windows& windows_;
  const NoiseLevel& noise_;
  const WindowChoice& choice_;
  const PointBuffer& move_;
};

/// Which profile of all stretches says where the rim is; none where noise has left the rim in its place, or nothing
/// says where it is.
RimProfile Stretch::*profileOf(const Buffer<Stretch>& stretches) {
  int count = 0, judged_count = 0;
  double blurred = 0, line = 0, blur = 0, across = 0, along = 0;
  for (const Stretch& stretch : stretches) {
    if (!stretch.is_rim) continue;
    ++count;
    if (stretch.is_judged) {
      ++judged_count;
      blurred += std::max(stretch.blurred.likelihood, stretch.with_line.likelihood) - stretch.sharp.likelihood;
    }
    line += stretch.with_line.likelihood - stretch.blurred.likelihood;
    blur += stretch.blur * std::sqrt(stretch.blurred.density);
    across += stretch.unevenness[0];
    along += stretch.unevenness[1];
  }
  if (judged_count < least_strips || blurred < least_blurred * judged_count) return nullptr;
  if (std::max(across, along) > most_uneven * count) return nullptr;
  blur /= count;
  if (line > std::max(least_line, line_by_blur / blur) * count) return &Stretch::with_line;
  return blur > least_without_line ? &Stretch::blurred : nullptr;
}

void vote(const Stretch& stretch, const RimCurve& curve, Buffer<RimVote>& votes) {
  for (const PlaceInStrip& place : stretch.places) {
    const double y = place.at.y() / stretch.half, slope = curve.slopeAt(stretch.half, place.at.y());
    const double length = std::sqrt(1 + slope * slope), inside = curve.insideOf(stretch.half, place.at) / length;
    if (inside > reach * stretch.blur) continue;
    votes.push_back(
        {place.point, (1 - y * y) * (1 - y * y), inside, (stretch.inward - slope * stretch.along) / length});
  }
}

/// The way of a point onto the rim, and where two meet onto both.
/// @param votes about one point; those that were taken get a weight of 0
Eigen::Vector3d wayOntoRims(std::span<RimVote> votes) {
  Eigen::Vector3d way = Eigen::Vector3d::Zero();
  for (const RimVote& first : votes) {
    if (!(first.weight > 0)) continue;
    const Eigen::Vector3d direction = first.inward;
    double weight = 0, inside = 0;
    Eigen::Vector3d inward = Eigen::Vector3d::Zero();
    for (RimVote& other : votes) {
      if (!(other.weight > 0 && other.inward.dot(direction) > same_rim)) continue;
      weight += other.weight;
      inside += other.weight * other.inside;
      inward += other.weight * other.inward;
      other.weight = 0;
    }
    if (inside < 0) way -= inside / weight * inward.normalized();
  }
  return way;
}

}  // namespace

void moveOntoRims(const PointsView& points, const NeighborSource& source, const Windows& windows,
                  const NoiseLevel& noise, const WindowChoice& choice, const Workers& workers, PointBuffer& move) {
  const RimFinder finder(points, windows, noise, choice, move);
  const Buffer<int> which = numbersWhere("noise", windows.size(), workers, [&](int w) { return finder.maySeeRim(w); });
  Buffer<Stretch> stretches(which.size());
  for (std::size_t i = 0; i < stretches.size(); i += judged) stretches[i].is_judged = true;
  workers.forBlocks("noise", std::ssize(which), costly_block, [&](std::int64_t begin, std::int64_t end, int) {
    RimScratch scratch;
    ListedSearch search(points, *source.search);
    Stretch* stretch = &stretches[begin];
    const auto count = [&](int w) { return seen * windows.base[w]; };
    const auto rank = [&](int w) { return windows.pointOf(w); };
    search.forEach(std::span<const int>(which).subspan(begin, end - begin), rank, count,
                   [&](int w, std::span<const Neighbor> neighbors) {
                     scratch.around.take(points, windows, w, neighbors, {});
                     finder.look(w, scratch, *stretch++);
                   });
  });
  RimProfile Stretch::*const profile = profileOf(stretches);
  if (profile == nullptr) return;
  Buffer<RimVote> votes;
  for (const Stretch& stretch : stretches)
    if (stretch.is_rim) vote(stretch, (stretch.*profile).curve, votes);
  std::ranges::sort(votes, [](const RimVote& a, const RimVote& b) {
    return std::tie(a.point, b.weight, a.inside) < std::tie(b.point, a.weight, b.inside);
  });
  for (std::size_t begin = 0, end = 0; begin < votes.size(); begin = end) {
    const int p = votes[begin].point;
    while (end < votes.size() && votes[end].point == p) ++end;
    if (!move.row(p).isZero(0)) move.row(p) += wayOntoRims(std::span(votes).subspan(begin, end - begin)).transpose();
  }
}

}  // namespace tufted
