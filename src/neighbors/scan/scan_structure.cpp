#include "tufted/scan_structure.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "base/number_text.h"
#include "tufted/errors.h"

namespace tufted {
namespace {

/// Rings are separated by elevation if the gaps between rings exceed those within rings by this factor.
constexpr double least_contrast = 4;
/// Fewer groups of elevations are no scanner.
constexpr int least_scan_rings = 4;
/// Mean number of points of a ring at least: in a random cloud a few gaps are tiny by chance, so that nearly each point
/// would be a ring; real rings have hundreds.
constexpr std::size_t least_per_ring = 16;
constexpr double rounded_gap = 1e-9;  // gaps below this, in rad, are rounding of coordinates

void checkOrigin(const char* function, const Eigen::Vector3d& origin) {
  if (!origin.allFinite()) throw InvalidInput(std::string(function) + ": origin is not finite, must be");
}

double azimuthOf(const Eigen::Vector3d& ray) {
  return ray.x() == 0 && ray.y() == 0 ? 0 : std::atan2(ray.y(), ray.x());
}

double elevationOf(const Eigen::Vector3d& ray) {
  return std::atan2(ray.z(), std::hypot(ray.x(), ray.y()));
}

/// The widest gap of elevations within a ring; those between rings are wider. From the widest gap down, gaps fall by
/// the largest factor there, among the places that leave enough rings of enough points.
double widestInnerGap(std::vector<double> gaps) {
  std::sort(gaps.begin(), gaps.end(), std::greater<>());
  const std::size_t most_rings = (gaps.size() + 1) / least_per_ring;
  double contrast = 0, inner = 0;
  for (std::size_t i = least_scan_rings - 1; i < most_rings && gaps[i - 1] > rounded_gap; ++i) {
    const double here = gaps[i - 1] / std::max(gaps[i], rounded_gap);
    if (here > contrast) contrast = here, inner = gaps[i];
  }
  if (!(contrast >= least_contrast)) {
    throw InvalidInput("findRings: the gaps between elevations fall by a factor of " + numberText(contrast) +
                       " at most where they leave 4 rings or more of 16 points or more in the mean, must be at least "
                       "4 for rings to show (is `origin` the sensor's?)");
  }
  return inner;
}

}  // namespace

ScanStructure imageStructure(int width, int height, const Eigen::Vector3d& origin) {
  if (width < 0 || height < 0 || static_cast<std::int64_t>(width) * height > INT32_MAX) {
    throw InvalidInput("imageStructure: " + std::to_string(width) + " x " + std::to_string(height) +
                       " pixels, must be at least 0 each and at most 2^31 - 1 together");
  }
  ScanStructure structure;
  structure.origin = origin;
  structure.row.reserve(static_cast<std::size_t>(width) * height);
  structure.position.reserve(static_cast<std::size_t>(width) * height);
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      structure.row.push_back(row);
      structure.position.push_back(column);
    }
  }
  return structure;
}

ScanStructure ringStructure(const Points& points, std::vector<int> ring, const Eigen::Vector3d& origin) {
  checkOrigin("ringStructure", origin);
  if (static_cast<Eigen::Index>(ring.size()) != points.rows()) {
    throw InvalidInput("ringStructure: ring has " + std::to_string(ring.size()) + " entries, must have " +
                       std::to_string(points.rows()) + ", one per point");
  }
  ScanStructure structure{.row = std::move(ring), .position = {}, .has_rings = true, .origin = origin};
  structure.position.reserve(structure.row.size());
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Eigen::Vector3d ray = points.row(i).transpose() - origin;
    structure.position.push_back(ray.allFinite() ? azimuthOf(ray) : std::nan(""));
  }
  return structure;
}

ScanStructure findRings(const Points& points, const Eigen::Vector3d& origin) {
  checkOrigin("findRings", origin);
  struct Ray {
    double elevation;
    int index;
  };
  std::vector<Ray> rays;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Eigen::Vector3d ray = points.row(i).transpose() - origin;
    if (ray.allFinite() && !ray.isZero(0)) rays.push_back({elevationOf(ray), static_cast<int>(i)});
  }
  std::sort(rays.begin(), rays.end(), [](const Ray& a, const Ray& b) { return a.elevation < b.elevation; });
  std::vector<int> ring(static_cast<std::size_t>(points.rows()), -1);
  if (!rays.empty()) {
    std::vector<double> gaps;
    for (std::size_t i = 1; i < rays.size(); ++i) gaps.push_back(rays[i].elevation - rays[i - 1].elevation);
    const double inner = widestInnerGap(gaps);
    int number = 0;
    double start = rays.front().elevation, widest = 0, narrowest = std::numbers::pi;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (i > 0 && gaps[i - 1] > std::max(inner, rounded_gap)) {
        ++number;
        narrowest = std::min(narrowest, gaps[i - 1]);
        start = rays[i].elevation;
      }
      widest = std::max(widest, rays[i].elevation - start);
      ring[rays[i].index] = number;
    }
    if (widest > narrowest || number + 1 < least_scan_rings) {
      throw InvalidInput("findRings: " + std::to_string(number + 1) + " rings of up to " + numberText(widest) +
                         " rad with gaps down to " + numberText(narrowest) +
                         " rad, must be at least 4 and narrower than the gaps (is `origin` the sensor's?)");
    }
  }
  return ringStructure(points, std::move(ring), origin);
}

}  // namespace tufted
