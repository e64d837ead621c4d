#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "shapes/random.h"
#include "tufted/types.h"

namespace tufted::attacks {

/// How often a loop runs: the environment variable TUFTED_ATTACKS multiplies `usual`.
inline int rounds(int usual) {
  const char* const factor = std::getenv("TUFTED_ATTACKS");
  return factor == nullptr ? usual : usual * std::max(1, std::atoi(factor));
}

/// 3 to `most` points: random, on grids, with copies, on lines, thin, far away, tiny, huge, with NaN.
inline Points oddCloud(std::uint64_t seed, int most = 60) {
  shapes::Random random(seed);
  const int n = 3 + random.below(most - 2), kind = random.below(8);
  const int side = most <= 60 ? 7 : static_cast<int>(std::sqrt(n)) + 1;
  Points points(n, 3);
  for (int i = 0; i < n; ++i) {
    const double u = random.uniform(-1, 1), v = random.uniform(-1, 1), w = random.uniform(-1, 1);
    switch (kind) {
      case 0:  // a bumpy sheet
        points.row(i) << u, v, 0.2 * u * v + 0.02 * w;
        break;
      case 1:  // a flat grid
        points.row(i) << i % side, i / side, 0;
        break;
      case 2:  // a volume
        points.row(i) << u, v, w;
        break;
      case 3:  // some positions of a small grid, with copies
        points.row(i) << random.below(5), random.below(5), random.below(2);
        break;
      case 4:  // a line with a few points beside it
        points.row(i) << i, (random.below(4) == 0 ? v : 0), (random.below(8) == 0 ? w : 0);
        break;
      case 5:  // a thin strip
        points.row(i) << 100 * u, v, 0.01 * w;
        break;
      case 6:  // a sphere
        points.row(i) = Eigen::RowVector3d(u, v, w).stableNormalized();
        break;
      default: {  // a grid bent to a hill
        const int x = i % side, y = i / side;
        points.row(i) << x, y, -0.05 * (x * x + y * y);
      }
    }
  }
  if (random.below(4) == 0)
    points *= std::ldexp(1.0, random.below(2) == 0 ? -300 : 300);
  else if (random.below(4) == 0)
    points.rowwise() += Eigen::RowVector3d(1e6, -3e6, 2e5);
  if (random.below(5) == 0) points.row(random.below(n)) = points.row(random.below(n));
  if (random.below(6) == 0) points(random.below(n), random.below(3)) = std::numeric_limits<double>::quiet_NaN();
  return points;
}

struct Soup {
  Points points;
  Triangles triangles;
};

/// 4 to 24 vertices and up to 60 triangles: around few edges, repeated, turned over, degenerate, with corners on lines.
inline Soup oddSoup(std::uint64_t seed) {
  shapes::Random random(seed);
  const int n = 4 + random.below(21), faces = 1 + random.below(60), kind = random.below(4);
  Soup soup{Points(n, 3), Triangles(faces, 3)};
  for (int i = 0; i < n; ++i) {
    const double u = random.uniform(-1, 1), v = random.uniform(-1, 1), w = random.uniform(-1, 1);
    switch (kind) {
      case 0:
        soup.points.row(i) << u, v, w;
        break;
      case 1:  // different positions of a grid, so that triangles are flat or lie in one plane
        soup.points.row(i) << i % 3, (i / 3) % 3, i / 9;
        break;
      case 2:  // a thin plate
        soup.points.row(i) << 10 * u, v, 0.01 * w;
        break;
      default:  // a plane
        soup.points.row(i) << u, v, 0;
    }
  }
  const int reach = random.below(2) == 0 ? n : std::min(n, 5);
  for (int f = 0; f < faces; ++f) {
    const int earlier = f == 0 ? 0 : random.below(f);
    if (f > 0 && random.below(8) == 0)
      soup.triangles.row(f) = soup.triangles.row(earlier);
    else if (f > 0 && random.below(8) == 0)
      soup.triangles.row(f) = soup.triangles.row(earlier).reverse();
    else
      for (int s = 0; s < 3; ++s) soup.triangles(f, s) = random.below(reach);
  }
  if (random.below(4) == 0) soup.points *= std::ldexp(1.0, random.below(2) == 0 ? -200 : 200);
  return soup;
}

}  // namespace tufted::attacks
