#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "shapes/random.h"
#include "shapes/surface.h"

namespace tufted::shapes {
namespace {

struct Parameters {
  double t, s;
};
using Places = std::vector<Parameters>;

// The density at row t relative to that of the densest row; 16^-sin^2 is smooth on closed and open surfaces.
double densityAt(const Surface& surface, const Sampling& sampling, double t) {
  if (sampling.kind == Sampling::Kind::nonuniform) {
    return std::exp2(-4 * std::pow(std::sin(std::numbers::pi * t / surface.span), 2));
  }
  return sampling.kind == Sampling::Kind::density_step && t > surface.span / 2 ? 1 / sampling.density_ratio : 1;
}

// Adds independent points by rejection sampling.
void addRandom(const Surface& surface, int n, const Sampling& sampling, Random& random, Places& places) {
  for (int found = 0; found < n;) {
    const double t = surface.span * random.uniform();
    const double s = random.uniform();
    const double accept = surface.at(t, s).stretch / surface.max_stretch * densityAt(surface, sampling, t);
    if (random.uniform() >= accept) continue;
    places.push_back({t, s});
    ++found;
  }
}

// Adds exactly n points: rows are joined to one long line, which is divided into n equal steps.
void addRows(const Surface& surface, int n, double anisotropy, double jitter, Random& random, Places& places) {
  const double step = std::sqrt(surface.area / (n * anisotropy));
  const int rows = std::max(1, static_cast<int>(std::lround(surface.span / (anisotropy * step))));
  const double height = surface.span / rows;
  std::vector<double> ends(rows);
  double total = 0;
  for (int row = 0; row < rows; ++row) ends[row] = total += surface.at((row + 0.5) * height, 0.5).stretch;
  for (int i = 0, row = 0; i < n; ++i) {
    const double place = (i + 0.5) * total / n;
    while (row + 1 < rows && place > ends[row]) ++row;
    const double start = row == 0 ? 0 : ends[row - 1], length = ends[row] - start;
    double t = (row + 0.5) * height;
    double s = (place - start) / length;
    if (jitter > 0) {
      t += random.uniform(-jitter, jitter) * height;
      s += random.uniform(-jitter, jitter) * total / (n * length);
      if (surface.rim_sides) s = s < 0 ? -s : s > 1 ? 2 - s : s;
    }
    places.push_back({t, s});
  }
}

void addLattice(const Surface& surface, int n, Places& places) {
  const double step = std::sqrt(surface.area / n);
  const int rows = std::max(1, static_cast<int>(std::lround(surface.span / step)));
  for (int row = 0; row < rows; ++row) {
    const double t = (row + 0.5) * surface.span / rows;
    const int count = std::max(1, static_cast<int>(std::lround(surface.at(t, 0.5).stretch / step)));
    for (int i = 0; i < count; ++i) places.push_back({t, (i + 0.5) / count});
  }
}

void addRim(const Surface& surface, int n, Places& places) {
  const double step = std::sqrt(surface.area / n);
  for (const double t : {0.0, surface.span}) {
    if (!(t == 0 ? surface.rim_first : surface.rim_last)) continue;
    const int count = std::max(3, static_cast<int>(std::ceil(surface.at(t, 0.5).stretch / step)));
    for (int i = 0; i < count + (surface.rim_sides ? 1 : 0); ++i) places.push_back({t, i / double(count)});
  }
  if (!surface.rim_sides) return;
  const int count = std::max(3, static_cast<int>(std::ceil(surface.span / step)));
  for (const double s : {0.0, 1.0}) {
    for (int i = 1; i < count; ++i) places.push_back({surface.span * i / count, s});
  }
}

std::string nameOf(Sampling sampling) {
  switch (sampling.kind) {
    case Sampling::Kind::uniform:
      return "uniform";
    case Sampling::Kind::jittered:
      return "jittered";
    case Sampling::Kind::lattice:
      return "lattice";
    case Sampling::Kind::nonuniform:
      return "nonuniform";
    case Sampling::Kind::density_step:
      return "density_step_" + std::to_string(std::lround(sampling.density_ratio));
    case Sampling::Kind::scan_lines:
      break;
  }
  return "scan_lines_" + std::to_string(std::lround(sampling.anisotropy));
}

}  // namespace

Cloud sampleSurface(const Surface& surface, int n, Sampling sampling, Rim rim, std::uint64_t seed) {
  Random random(seed);
  Places places;
  if (rim == Rim::included) addRim(surface, n, places);
  const int rim_points = static_cast<int>(places.size()), inner = std::max(0, n - rim_points);
  switch (sampling.kind) {
    case Sampling::Kind::uniform:
    case Sampling::Kind::nonuniform:
    case Sampling::Kind::density_step:
      addRandom(surface, inner, sampling, random, places);
      break;
    case Sampling::Kind::jittered:
      addRows(surface, inner, 1, 0.35, random, places);
      break;
    case Sampling::Kind::scan_lines:
      addRows(surface, inner, sampling.anisotropy, 0, random, places);
      break;
    case Sampling::Kind::lattice:
      addLattice(surface, inner, places);
      break;
  }

  const bool boundary = surface.rim_first || surface.rim_last || surface.rim_sides;
  Cloud cloud{.name = surface.name + (rim == Rim::included ? "_rim_" : "_") + nameOf(sampling),
              .shape = surface.name,
              .sampling = nameOf(sampling),
              .seed = seed,
              .points = Points(places.size(), 3),
              .normals = Points(places.size(), 3),
              .area = surface.area,
              .boundary = boundary,
              .eigenvalues = surface.eigenvalues,
              .rim_points = rim_points};
  for (std::size_t i = 0; i < places.size(); ++i) {
    const SurfacePoint point = surface.at(places[i].t, places[i].s);
    cloud.points.row(i) = point.point.transpose();
    cloud.normals.row(i) = point.normal.transpose();
  }
  return cloud;
}

}  // namespace tufted::shapes
