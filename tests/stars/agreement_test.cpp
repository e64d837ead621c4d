#include "stars/agreement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "base/buffer.h"
#include "base/parallel.h"
#include "shapes/shapes.h"
#include "support/cloud_stars.h"
#include "tufted/laplacian.h"

namespace tufted::agreement_test {
namespace {

const Progress silent;

/// The third corners of the triangles of star p that have the spoke to q; ascending, -1 for none.
std::pair<int, int> cornersBeside(const Stars& stars, int p, int q) {
  std::pair<int, int> corners = {-1, -1};
  for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i) {
    if (!stars.hasTriangle(i)) continue;
    const int a = stars.link[i], b = stars.link[stars.after(p, i)];
    if (a != q && b != q) continue;
    corners.first = std::exchange(corners.second, a == q ? b : a);
  }
  return std::minmax(corners.first, corners.second);
}

TEST(Agreement, IsThatOfEveryStarWithEachOfItsLinkVertices) {
  // Several blocks; ends, noise, ties.
  const Points noisy = shapes::withNoise(shapes::sphere(20000), 0.005).points;
  const Points square = shapes::square(20000, shapes::Sampling::uniform, shapes::Rim::none, 1).points;
  for (const Points& points : {noisy, square, shapes::squareLattice(130).points}) {
    const SurfaceStars built = support::starsOf(points, cloudOptions(Preset::clean)).built;
    const Stars& stars = built.stars;
    Buffer<std::uint8_t> expected(stars.size());
    for (int p = 0; p < stars.size(); ++p) {
      for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i) {
        const int q = stars.link[i];
        const auto here = cornersBeside(stars, p, q);
        if (here.first < 0 || here != cornersBeside(stars, q, p)) expected[p] = expected[q] = 1;
      }
    }
    EXPECT_EQ(built.disagrees, expected);
    EXPECT_EQ(findDisagreement(stars, Workers(2, silent)), expected);
    const auto disagreeing = std::count(expected.begin(), expected.end(), 1);
    EXPECT_GT(disagreeing, 0);
    EXPECT_LT(disagreeing, stars.size());
  }
}

}  // namespace
}  // namespace tufted::agreement_test
