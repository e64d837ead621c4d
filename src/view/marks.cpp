#include "view/marks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "view/shading.h"

namespace tufted::view {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// The width of the line, in letter sizes: five pixels if the picture has 900, wider than an isoline.
constexpr double line_width = 0.24;
/// The width of the line with its rim, in letter sizes: two pixels more on each side.
constexpr double rim_width = 0.46;
/// The width of dashes, in letter sizes: thinner than the line, as for something farther away.
constexpr double dash_width = 0.14;
/// The length of dashes and of the gaps between them, in letter sizes: three widths.
constexpr double dash_length = 0.45;
/// The diameter of the discs at the ends, in letter sizes: three times the width of the line.
constexpr double end_width = 0.75;
/// The diameter of the discs at the ends with their rims, in letter sizes.
constexpr double end_rim_width = 1;
/// The diameter of the hole of the ring, in letter sizes: half of the disc.
constexpr double ring_hole = 0.35;
/// The size of a ring that the surface hides, relative to one in front.
constexpr double hidden_share = 0.6;
/// A path behind a triangle by up to this share of its longest side still counts as on it: paths run straight between
/// edges of the cover, which need not be those of the mesh.
constexpr double sunk_share = 0.05;
/// Coordinates in pixels are clamped to this, so that they fit into integers.
constexpr double farthest = 1e6;

/// A place of the path in the picture.
struct Step {
  Vector2d place;
  bool is_hidden = false;
  bool is_joined = false;  ///< whether a line leads to it from the step before
  double length = 0;       ///< length from the beginning, in pixels
};

/// How far behind a disc or triangle a path counts as on it: by a disc's radius, because its middle bulges to the eye.
double toleranceAt(const SeenScene& seen, std::uint32_t number) {
  const auto n = static_cast<std::uint32_t>(seen.scene.positions.rows());
  if (number < n) return seen.radii[number];
  double longest = 0;
  const auto corner = [&](int k) -> const Eigen::Vector3f& {
    return seen.views[static_cast<std::size_t>(seen.scene.triangles(number - n, k))];
  };
  for (int k = 0; k < 3; ++k) longest = std::max<double>(longest, (corner((k + 1) % 3) - corner(k)).norm());
  return sunk_share * longest;
}

bool isHidden(const SeenScene& seen, const Vector3d& view) {
  const double x = seen.projection.screenX(view);
  const double y = seen.projection.screenY(view);
  if (!(x >= 0 && y >= 0 && x < seen.width && y < seen.height)) return false;
  const Sample sample = seen.samples[static_cast<std::size_t>(y) * seen.width + static_cast<std::size_t>(x)];
  return sample != nothing && view.z() > depthOf(sample) + toleranceAt(seen, numberOf(sample));
}

Vector2d placeOf(const SeenScene& seen, const Vector3d& view) {
  const Vector2d place(seen.projection.screenX(view), seen.projection.screenY(view));
  return (place / samples_per_pixel).cwiseMax(-farthest).cwiseMin(farthest);
}

/// The path in steps of about a pixel, without corners that are not finite or too near to the eye.
std::vector<Step> stepsOf(const SeenScene& seen) {
  const int most_steps = seen.width + seen.height;  // per segment; longer segments leave the picture
  std::vector<Step> steps;
  Vector3d before = Vector3d::Zero();
  bool is_joined = false;
  for (Eigen::Index i = 0; i < seen.scene.path.rows(); ++i) {
    const Vector3d view = seen.projection.toView(seen.points.at(seen.scene.path.row(i).transpose()));
    const bool is_drawn = view.allFinite() && view.z() > nearest_depth;
    if (is_drawn) {
      const double pixels = is_joined ? (placeOf(seen, view) - steps.back().place).norm() : 0;
      const int count = std::clamp(static_cast<int>(pixels) + 1, 1, most_steps);
      for (int k = 1; k <= count; ++k) {
        const Vector3d at = is_joined ? Vector3d(before + (static_cast<double>(k) / count) * (view - before)) : view;
        Step step = {placeOf(seen, at), isHidden(seen, at), is_joined, 0};
        if (is_joined) step.length = steps.back().length + (step.place - steps.back().place).norm();
        steps.push_back(step);
        if (!is_joined) break;
      }
      before = view;
    }
    is_joined = is_drawn;
  }
  return steps;
}

void drawDot(const Vector2d& place, double width, const Rgb& color, Canvas& canvas) {
  canvas.line(place.x(), place.y(), place.x(), place.y(), width, color);
}

}  // namespace

void drawPath(const SeenScene& seen, double text_size, Canvas& canvas) {
  const std::vector<Step> steps = stepsOf(seen);
  if (steps.empty()) return;
  const auto draw = [&](bool hidden, double width, const Rgb& color) {
    for (std::size_t k = 1; k < steps.size(); ++k) {
      const Step& from = steps[k - 1];
      const Step& to = steps[k];
      if (!to.is_joined || to.is_hidden != hidden) continue;
      if (hidden && std::fmod(to.length / text_size, 2 * dash_length) > dash_length) continue;
      canvas.line(from.place.x(), from.place.y(), to.place.x(), to.place.y(), width * text_size, color);
    }
  };
  draw(true, dash_width, path_color);
  draw(false, rim_width, path_rim_color);
  draw(false, line_width, path_color);
  drawRing(steps.front().place, text_size, canvas);
  drawDot(steps.back().place, end_rim_width * text_size, path_rim_color, canvas);
  drawDot(steps.back().place, end_width * text_size, path_color, canvas);
}

void drawRing(const Vector2d& place, double text_size, Canvas& canvas) {
  drawDot(place, end_rim_width * text_size, path_rim_color, canvas);
  drawDot(place, end_width * text_size, path_color, canvas);
  drawDot(place, ring_hole * text_size, path_rim_color, canvas);
}

void drawSources(const SeenScene& seen, const std::vector<int>& sources, double text_size, Canvas& canvas) {
  for (const int source : sources) {
    const Vector3d view = seen.views[static_cast<std::size_t>(source)].cast<double>();
    if (!(view.z() > nearest_depth)) continue;  // also where a position is not finite
    drawRing(placeOf(seen, view), (isHidden(seen, view) ? hidden_share : 1) * text_size, canvas);
  }
}

namespace {

/// Cells, each with at most one arrow, in the height of a picture; with more of them arrows would touch.
constexpr int cells = 34;
/// The arrow of a vector as long as the legend's greatest value, in cells: it does not reach the next cell.
constexpr double longest = 0.95;
/// Arrows shorter than this, in cells, are not drawn, as their direction would not be visible.
constexpr double shortest = 0.12;

/// The visible point nearest to the middle of a cell; -1: none.
int pointIn(const SeenScene& seen, const FieldColors& colors, int left, int top, int size) {
  int best = -1;
  int least = size * size;
  for (int y = top; y < std::min(top + size, seen.height); ++y)
    for (int x = left; x < std::min(left + size, seen.width); ++x) {
      const Sample sample = seen.samples[static_cast<std::size_t>(y) * seen.width + x];
      if (sample == nothing) continue;
      std::uint32_t number = numberOf(sample);
      const auto n = static_cast<std::uint32_t>(seen.scene.positions.rows());
      if (number >= n) number = static_cast<std::uint32_t>(seen.scene.triangles(number - n, 0));
      const int dx = x - left - size / 2;
      const int dy = y - top - size / 2;
      if (dx * dx + dy * dy >= least || !std::isfinite(colors.channels[0][number])) continue;
      least = dx * dx + dy * dy;
      best = static_cast<int>(number);
    }
  return best;
}

}  // namespace

void drawArrows(const SeenScene& seen, const FieldColors& colors, Canvas& canvas) {
  const int size = std::max(seen.height / cells, 8);
  const double cell = static_cast<double>(size) / samples_per_pixel;
  for (int top = 0; top < seen.height; top += size)
    for (int left = 0; left < seen.width; left += size) {
      const int point = pointIn(seen, colors, left, top, size);
      if (point < 0 || !(colors.high > 0)) continue;
      const Eigen::Vector3d vector = colors.field->values.row(point);
      const Eigen::Vector3d seen_vector = seen.projection.turn(vector) / colors.high;
      const Eigen::Vector2d along = longest * cell * Eigen::Vector2d(seen_vector.x(), -seen_vector.y());
      const double length = std::min(along.norm(), 2 * cell);
      if (length < shortest * cell) continue;
      const Eigen::Vector3d view = seen.views[static_cast<std::size_t>(point)].cast<double>();
      const Eigen::Vector2d middle(seen.projection.screenX(view) / samples_per_pixel,
                                   seen.projection.screenY(view) / samples_per_pixel);
      const Eigen::Vector2d unit = along.normalized();
      const Eigen::Vector2d aside(-unit.y(), unit.x());
      const Eigen::Vector2d start = middle - 0.5 * length * unit;
      const Eigen::Vector2d tip = middle + 0.5 * length * unit;
      const double head = std::min(0.4 * cell, 0.55 * length);
      const Eigen::Vector2d neck = tip - head * unit;
      const Rgb color = colors.colorOf({colors.channels[0][static_cast<std::size_t>(point)], 0});
      canvas.line(start.x(), start.y(), neck.x(), neck.y(), std::max(1.2, 0.09 * cell), color);
      canvas.triangle({tip, neck + 0.42 * head * aside, neck - 0.42 * head * aside}, color);
    }
}

}  // namespace tufted::view
