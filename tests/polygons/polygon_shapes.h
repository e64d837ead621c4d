#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <ostream>
#include <string>
#include <vector>

#include "shapes/random.h"
#include "tufted/types.h"

namespace tufted {

/// The corners of polygons of `n` corners and of many kinds, most of them simple, turning left.
using PlanarPolygon = std::vector<std::array<double, 2>>;

struct PolygonKind {
  std::string name;
  bool is_simple;
  PlanarPolygon (*corners)(int n, shapes::Random& random);
};

inline void PrintTo(const PolygonKind& kind, std::ostream* stream) {
  *stream << kind.name;
}

/// A polygon of the form r(angle) around the origin.
template <class Radius>
PlanarPolygon around(int n, const Radius& radius) {
  PlanarPolygon corners;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n, r = radius(i);
    corners.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return corners;
}

/// A band of 20 turns: outwards along its right side, back along its left.
inline PlanarPolygon spiral(int n, double width) {
  PlanarPolygon corners;
  const auto add = [&](int i, int count, double shift) {
    const double turns = 20.0 * i / count, angle = 2 * std::numbers::pi * turns, r = 1 + turns + shift;
    corners.push_back({r * std::cos(angle), r * std::sin(angle)});
  };
  for (int i = 0; i < n / 2; ++i) add(i, n / 2, width);
  for (int i = n - n / 2 - 1; i >= 0; --i) add(i, n - n / 2, 0);
  return corners;
}

inline std::vector<PolygonKind> polygonKinds() {
  using shapes::Random;
  return {
      {"circle", true, [](int n, Random&) { return around(n, [](int) { return 1.0; }); }},
      {"star", true, [](int n, Random& random) { return around(n, [&](int) { return random.uniform(0.2, 1.2); }); }},
      {"comb", true,
       [](int n, Random&) {  // teeth upwards
         PlanarPolygon corners = {{0, -1}, {1, -1}};
         for (int i = n - 3; i >= 0; --i) corners.push_back({1.0 * i / n, i % 4 == 1 || i % 4 == 2 ? 1.0 : 0.0});
         return corners;
       }},
      {"spiral", true, [](int n, Random&) { return spiral(n, 0.5); }},
      {"thin_spiral", true, [](int n, Random&) { return spiral(n, 1e-6); }},
      {"needle", true,  // of the aspect 1e6
       [](int n, Random&) {
         PlanarPolygon corners;
         for (int i = 0; i < n; ++i)
           corners.push_back(i < n / 2 ? std::array{i / (0.5 * n), 0.0} : std::array{(n - 1 - i) / (0.5 * n), 1e-6});
         return corners;
       }},
      {"plate", true,  // many corners on four straight sides
       [](int n, Random&) {
         PlanarPolygon corners;
         for (int i = 0; i < n; ++i) {
           const int side = static_cast<int>(4LL * i / n), first = (n * side + 3) / 4, next = (n * (side + 1) + 3) / 4;
           const double t = static_cast<double>(i - first) / (next - first);
           corners.push_back(side == 0   ? std::array{t, 0.0}
                             : side == 1 ? std::array{1.0, t}
                             : side == 2 ? std::array{1 - t, 1.0}
                                         : std::array{0.0, 1 - t});
         }
         return corners;
       }},
      {"cluster", true,  // half of the corners in a billionth of the width
       [](int n, Random& random) {
         return around(n, [&](int i) { return i < n / 2 ? 1e-9 * random.uniform(1, 1.5) : 1.0; });
       }},
      {"crossing", false,
       [](int n, Random& random) {
         PlanarPolygon corners(n);
         for (auto& corner : corners) corner = {random.uniform(), random.uniform()};
         return corners;
       }},
      {"lattice", false,
       [](int n, Random& random) {
         PlanarPolygon corners(n);
         for (auto& corner : corners) corner = {1.0 * random.below(20), 1.0 * random.below(20)};
         return corners;
       }},
      {"chevrons", false,  // each holds all that come before
       [](int n, Random&) {
         PlanarPolygon corners;
         for (int i = 0; i < n; ++i) {
           const double r = 1 + i / 4;
           const PlanarPolygon chevron = {{-r, 0}, {0, 0.01 * r}, {r, 0}, {r + 0.5, 0}};
           corners.push_back(chevron[i % 4]);
         }
         return corners;
       }},
      {"pentagram", false,
       [](int n, Random&) {
         int step = (n - 1) / 2;
         while (std::gcd(step, n) != 1) --step;
         const PlanarPolygon circle = around(n, [](int) { return 1.0; });
         PlanarPolygon corners;
         for (int i = 0; i < n; ++i) corners.push_back(circle[static_cast<std::int64_t>(i) * step % n]);
         return corners;
       }},
      {"collinear", false,
       [](int n, Random& random) {
         PlanarPolygon corners(n);
         for (auto& corner : corners) corner = {random.uniform(), 0};
         return corners;
       }},
      {"repeated", false,
       [](int n, Random&) {
         const PlanarPolygon circle = around(100, [](int) { return 1.0; });
         PlanarPolygon corners;
         for (int i = 0; i < n; ++i) corners.push_back(circle[100LL * i / n]);
         return corners;
       }},
      {"seven_places", false,
       [](int n, Random& random) {
         PlanarPolygon places(7), corners;
         for (auto& place : places) place = {random.uniform(), random.uniform()};
         for (int i = 0; i < n; ++i) corners.push_back(places[random.below(7)]);
         return corners;
       }},
  };
}

/// The corners of a polygon in the plane z = 0, turned there by an angle.
inline Points placed(const PlanarPolygon& corners, double angle) {
  Points points(corners.size(), 3);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto [x, y] = corners[i];
    points.row(i) << std::cos(angle) * x - std::sin(angle) * y, std::sin(angle) * x + std::cos(angle) * y, 0;
  }
  return points;
}

}  // namespace tufted
