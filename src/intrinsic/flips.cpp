#include "base/buffer.h"
#include "intrinsic/flip_edges.h"

namespace tufted {
namespace {

constexpr std::int64_t block_size = 16384;

/// A cover that is all there.
class WholeCover {
 public:
  explicit WholeCover(IntrinsicTriangulation& cover) : cover_(cover) {}
  IntrinsicTriangulation& triangulation() { return cover_; }
  void resolve(int) {}
  void flipped(int, int) {}

 private:
  IntrinsicTriangulation& cover_;
};

/// The sides, one per edge, that are not Delaunay at the start, in order.
Buffer<int> findSeeds(const IntrinsicTriangulation& cover, const Workers& workers) {
  Buffer<Buffer<int>> found((cover.size() + block_size - 1) / block_size);
  workers.forBlocks("flips", cover.size(), block_size, [&](std::int64_t begin, std::int64_t end, int) {
    for (int side = static_cast<int>(3 * begin); side < 3 * end; ++side) {
      const int mate = cover.glue[side];
      // An edge that is not Delaunay has an obtuse angle on at least one side.
      if (isOppositeObtuse(cover, side) && oppositeCotan(cover, side) + oppositeCotan(cover, mate) < flip_below)
        found[begin / block_size].push_back(std::min(side, mate));
    }
  });
  Buffer<int> seeds;
  for (const auto& part : found) seeds.insert(seeds.end(), part.begin(), part.end());
  return seeds;
}

}  // namespace

FlipCounts flipToDelaunay(IntrinsicTriangulation& cover, const Workers& workers) {
  WholeCover whole(cover);
  return flipEdges(whole, findSeeds(cover, workers), workers);
}

}  // namespace tufted
