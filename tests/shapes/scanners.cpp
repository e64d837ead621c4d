#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "shapes/random.h"
#include "shapes/shapes.h"

namespace tufted::shapes {
namespace {

using Eigen::Vector3d;
constexpr double degree = std::numbers::pi / 180;

struct Hit {
  double range = std::numeric_limits<double>::infinity();
  RoomSurface surface = RoomSurface::floor;
  Vector3d normal = Vector3d::Zero();
};

// A rectangle perpendicular to one axis.
struct Panel {
  int axis;
  double place;
  Vector3d low, high;
  RoomSurface surface;
};

// The room in the scanner's frame. The scanner is not in the centre, so that the distances of all walls differ.
const Vector3d room_low(-9, -6, -1.8), room_high(11, 9, 2.2);
const Vector3d box_low(3, -3, -1.8), box_high(5, -1, -0.3);
constexpr double pole_x = -2.5, pole_y = 3, pole_radius = 0.2;

const std::array<Panel, 11>& panels() {
  static const std::array<Panel, 11> all{{
      {2, room_low.z(), room_low, room_high, RoomSurface::floor},
      {2, room_high.z(), room_low, room_high, RoomSurface::ceiling},
      {0, room_low.x(), room_low, room_high, RoomSurface::wall_west},
      {0, room_high.x(), room_low, room_high, RoomSurface::wall_east},
      {1, room_low.y(), room_low, room_high, RoomSurface::wall_south},
      {1, room_high.y(), room_low, room_high, RoomSurface::wall_north},
      {0, box_low.x(), box_low, box_high, RoomSurface::box_west},
      {0, box_high.x(), box_low, box_high, RoomSurface::box_east},
      {1, box_low.y(), box_low, box_high, RoomSurface::box_south},
      {1, box_high.y(), box_low, box_high, RoomSurface::box_north},
      {2, box_high.z(), box_low, box_high, RoomSurface::box_top},
  }};
  return all;
}

Hit castRay(const Vector3d& direction) {
  Hit hit;
  for (const Panel& panel : panels()) {
    const double range = panel.place / direction[panel.axis];
    if (!(range > 0) || range >= hit.range) continue;
    bool inside = true;
    for (int axis = 0; axis < 3; ++axis) {
      const double x = range * direction[axis];
      inside = inside && (axis == panel.axis || (x >= panel.low[axis] && x <= panel.high[axis]));
    }
    if (!inside) continue;
    hit = {range, panel.surface, Vector3d::Zero()};
    hit.normal[panel.axis] = direction[panel.axis] > 0 ? -1 : 1;
  }
  // The pole reaches from floor to ceiling: |range d - c| = radius in the plane.
  const double dd = direction.x() * direction.x() + direction.y() * direction.y();
  const double dc = direction.x() * pole_x + direction.y() * pole_y;
  const double cc = pole_x * pole_x + pole_y * pole_y - pole_radius * pole_radius;
  const double discriminant = dc * dc - dd * cc;
  if (dc > 0 && discriminant > 0) {
    const double range = (dc - std::sqrt(discriminant)) / dd;
    if (range < hit.range) {
      const Vector3d p = range * direction;
      hit = {range, RoomSurface::pole, Vector3d((p.x() - pole_x) / pole_radius, (p.y() - pole_y) / pole_radius, 0)};
    }
  }
  return hit;
}

Vector3d beam(double azimuth, double elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

// A beam of solid angle w covers the area w range^2 / cos(angle of incidence).
double visibleArea(double low, double high) {
  constexpr int rows = 256, columns = 360;
  const double row_step = (high - low) / rows, column_step = 2 * std::numbers::pi / columns;
  double area = 0;
  for (int row = 0; row < rows; ++row) {
    const double elevation = low + (row + 0.5) * row_step;
    for (int column = 0; column < columns; ++column) {
      const Vector3d direction = beam((column + 0.5) * column_step, elevation);
      const Hit hit = castRay(direction);
      area += std::cos(elevation) * row_step * column_step * hit.range * hit.range / -hit.normal.dot(direction);
    }
  }
  return area;
}

// Elevations of the lowest and the highest ring of common scanners with this many rings, rad.
std::pair<double, double> elevations(int rings) {
  if (rings == 16) return {-15 * degree, 15 * degree};
  if (rings == 32) return {-30.67 * degree, 10.67 * degree};
  return {-24.8 * degree, 2 * degree};
}

Cloud emptyScan(int width, int height) {
  const int n = width * height;
  return {.points = Points(n, 3),
          .normals = Points(n, 3),
          .boundary = true,
          .labels = std::vector<int>(n),
          .width = width,
          .height = height};
}

}  // namespace

Cloud lidar(const LidarOptions& options, std::uint64_t seed) {
  const auto [low, high] = elevations(options.rings);
  const int columns = static_cast<int>(std::lround(360 / options.azimuth_step));
  Random random(seed);
  Cloud cloud = emptyScan(columns, options.rings);
  cloud.shape = "room";
  cloud.sampling = "lidar_" + std::to_string(options.rings);
  cloud.name = cloud.sampling + (options.noise > 0 ? "_noise" : "");
  cloud.seed = seed;
  cloud.noise = options.noise;
  cloud.area = visibleArea(low, high);
  for (int row = 0; row < options.rings; ++row) {
    const double elevation = low + (high - low) * row / (options.rings - 1);
    for (int column = 0; column < columns; ++column) {
      const int i = row * columns + column;
      const Vector3d direction = beam(2 * std::numbers::pi * (column + options.first_azimuth) / columns, elevation);
      const Hit hit = castRay(direction);
      const double range = hit.range + (options.noise > 0 ? options.noise * random.normal() : 0);
      cloud.points.row(i) = (range * direction).transpose();
      cloud.normals.row(i) = hit.normal.transpose();
      cloud.labels[i] = static_cast<int>(hit.surface);
    }
  }
  return cloud;
}

bool crossesJump(const Vector3d& a, const Vector3d& b) {
  constexpr int rays = 64, halvings = 40;
  const Vector3d from = a.normalized(), to = b.normalized();
  const auto cast = [&](double t) { return castRay(((1 - t) * from + t * to).normalized()); };
  Hit previous = cast(0);
  for (int i = 1; i <= rays; ++i) {
    double low = (i - 1.0) / rays, high = static_cast<double>(i) / rays;
    Hit before = previous, after = cast(high);
    previous = after;
    for (int j = 0; j < halvings && before.surface != after.surface; ++j) {
      const double middle = (low + high) / 2;
      const Hit hit = cast(middle);
      (hit.surface == before.surface ? before : after) = hit;
      (hit.surface == before.surface ? low : high) = middle;
    }
    if (std::abs(after.range - before.range) > 1e-6 * before.range && before.surface != after.surface) return true;
  }
  return false;
}

Cloud depthCamera(const DepthCameraOptions& options, std::uint64_t seed) {
  // The camera's axes in the room's frame: it looks past the box into a corner, 20 degrees down.
  const double yaw = -25 * degree, pitch = -20 * degree;
  const Vector3d forward = beam(yaw, pitch), right(std::sin(yaw), -std::cos(yaw), 0), down = forward.cross(right);
  Eigen::Matrix3d to_camera;
  to_camera << right.transpose(), down.transpose(), forward.transpose();

  const double focal = 525.0 * options.width / 640;
  Random random(seed);
  Cloud cloud = emptyScan(options.width, options.height);
  cloud.name = cloud.sampling = "depth_camera";
  cloud.shape = "room";
  cloud.seed = seed;
  for (int i = 0; i < options.width * options.height; ++i) {
    const double u = (i % options.width - (options.width - 1) / 2.0) / focal;
    const double v = (i / options.width - (options.height - 1) / 2.0) / focal;
    const Vector3d direction = forward + u * right + v * down;  // has depth 1, so its factor is the depth
    const Hit hit = castRay(direction);
    const double step = options.depth_step;
    const double depth = step > 0 ? std::round(hit.range / step) * step : hit.range;
    const bool grazing = -hit.normal.dot(direction) < std::sin(5 * degree) * direction.norm();
    const bool dropped = random.uniform() < options.dropouts;
    const bool seen = !grazing && !dropped && depth <= options.max_depth;
    cloud.points.row(i) =
        seen ? Eigen::RowVector3d(u * depth, v * depth, depth) : Eigen::RowVector3d::Constant(unknown);
    cloud.normals.row(i) = (to_camera * hit.normal).transpose();
    cloud.labels[i] = static_cast<int>(hit.surface);
  }
  return cloud;
}

}  // namespace tufted::shapes
