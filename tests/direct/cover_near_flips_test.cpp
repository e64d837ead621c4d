#include "direct/cover_near_flips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "shapes/shapes.h"
#include "support/cloud_stars.h"
#include "tufted/tufted.h"

namespace tufted::cover_near_flips_test {
namespace {

const Progress silent;

/// A sphere on which nearly all stars agree, so that hardly any room is kept, but lengths are those of a sheared one:
/// once an edge is flipped, those around it are to be flipped, too.
class ShearedSphere : public testing::Test {
 protected:
  ShearedSphere() {
    auto [cloud, built] = support::starsOf(shapes::sphere(20000).points, cloudOptions(Preset::clean));
    cloud_ = std::move(cloud);
    stars_ = std::move(built.stars);
    disagrees_ = std::move(built.disagrees);
    for (int p = 0; p < cloud_.size(); ++p) cloud_.points.row(p)[0] += 3 * cloud_.points.row(p)[2];
  }

  /// Whether a star of a later block has a smaller number: then not all fitted into the range of their block.
  static bool hasStarsBehindAllRanges(const CoverNearFlips& cover, int stars) {
    int largest = -1, largest_before = -1;  // of all stars so far, of those of earlier blocks
    for (int p = 0; p < stars; ++p) {
      if (p % CoverNearFlips::block_size == 0) largest_before = largest;
      if (!cover.isPresent(p)) continue;
      if (cover.firstTriangle(p) < largest_before) return true;
      largest = std::max(largest, cover.firstTriangle(p));
    }
    return false;
  }

  RankedCloud cloud_;
  Stars stars_;
  Buffer<std::uint8_t> disagrees_;
};

TEST_F(ShearedSphere, AddsStarsBehindAllRangesWhereTheyDoNotFit) {
  const EdgeLengths length{cloud_.points};
  IntrinsicTriangulation reference;
  for (const int threads : {1, 3}) {
    const Workers workers(threads, silent);
    const RadialCycles cycles(stars_, disagrees_, cloud_.points, workers);
    CoverNearFlips cover(stars_, length, cycles);
    StarMetric metric = measureStars(stars_, length, {}, workers);
    for (std::size_t i = 0; i < metric.cotan_sum.size(); ++i)
      if (i % 1000 != 0) metric.cotan_sum[i] = 1;  // as if few edges were to be flipped at the start
    const FlipCounts counts = cover.flipToDelaunay(metric, workers);
    EXPECT_GT(counts.flips, 300);
    EXPECT_EQ(counts.failures, 0);
    EXPECT_TRUE(hasStarsBehindAllRanges(cover, stars_.size()));
    const IntrinsicTriangulation whole = cover.complete(workers);
    CoverCheck check = validate(whole);
    check.not_delaunay = 0;  // what no flip has come near
    EXPECT_TRUE(check.ok());
    if (threads == 1) reference = whole;
    EXPECT_EQ(whole.glue, reference.glue);
    EXPECT_EQ(whole.length, reference.length);

    const std::size_t blocks = (stars_.size() + CoverNearFlips::block_size - 1) / CoverNearFlips::block_size;
    const auto movedFaces = [&] {
      std::vector<std::pair<std::array<int, 3>, double>> faces;
      for (std::size_t b = 0; b < blocks; ++b) {
        cover.forEachMovedFace(b, [&](const auto& corners, const double* side) {
          faces.emplace_back(corners, side[0] + side[1] + side[2]);
          for (const int corner : corners) EXPECT_TRUE(cover.isFlipped(corner));
        });
      }
      return faces;
    };
    const auto moved = movedFaces();
    EXPECT_GT(moved.size(), 300);
    cover.keepMovedFaces();
    EXPECT_EQ(movedFaces(), moved);
  }
}

}  // namespace
}  // namespace tufted::cover_near_flips_test
