#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "heap/heap_count.h"
#include "shapes/shapes.h"
#include "tufted/laplacian_builder.h"

namespace tufted::builder_heap_test {
namespace {

/// The memory that `frame()` takes from the heap.
template <class Frame>
heap::Count countDuring(const Frame& frame) {
  const heap::Count before = heap::countSoFar();
  frame();
  const heap::Count after = heap::countSoFar();
  return {after.blocks - before.blocks, after.foreign_blocks - before.foreign_blocks};
}

TEST(Heap, CountSeesEveryWayToTakeMemory) {
  EXPECT_EQ(countDuring([] {}).blocks, 0);
  EXPECT_EQ(countDuring([] { std::make_unique<std::string>(100, 'x'); }).blocks, 2);
  EXPECT_EQ(countDuring([] { Eigen::VectorXd::Zero(100).eval(); }).blocks, 1);
  void* volatile kept = nullptr;  // or the compiler would spare itself the trouble
  EXPECT_EQ(countDuring([&] { kept = std::calloc(1, 100); }).blocks, 1);
  EXPECT_EQ(countDuring([&] { kept = std::realloc(kept, 1 << 20); }).blocks, 1);
  std::free(kept);
}

struct HeapCase {
  std::string name;
  Points points;
  CloudOptions options = {};
  bool is_image = false;
};

std::vector<HeapCase> heapCases() {
  const Points sphere = shapes::sphere(5000).points, depth = shapes::depthCamera({.width = 96, .height = 72}).points;
  const Points noisy = shapes::withNoise(shapes::sphere(5000), 0.02).points;
  Points lattice(2500, 3);
  for (int i = 0; i < lattice.rows(); ++i) {
    const int row = i / 50;
    lattice.row(i) << i % 50, row, 0;
  }
  CloudOptions pairs = {};
  pairs.paper.gluing = Gluing::vertex_pair;
  CloudOptions forgetful = {};
  forgetful.keep_cover = false;
  return {{"sphere", sphere},
          {"clean_sphere", sphere, cloudOptions(Preset::clean)},
          {"noisy_sphere", noisy},
          {"noisy_sphere_without_cover", noisy, forgetful},
          {"noisy_sphere_by_vertex_pairs", noisy, pairs},
          {"depth_image_by_tree", depth},
          {"depth_image_by_pixels", depth, {}, true},
          {"lattice", lattice}};
}

class HeapOfFrames : public testing::TestWithParam<HeapCase> {};

TEST_P(HeapOfFrames, SecondFrameOfTheSameSizeTakesNothing) {
  const HeapCase& c = GetParam();
  CloudOptions options = c.options;
  options.threads = 1;
  const ScanStructure structure = imageStructure(96, 72);
  if (c.is_image) options.structure = &structure;
  LaplacianBuilder builder;
  const heap::Count first = countDuring([&] { builder.pointCloud(c.points, options); });
  EXPECT_GT(first.blocks, 100);
  const std::size_t held = builder.bytes();
  const Points moved = c.points * 2;  // the same arithmetic
  const heap::Count second = countDuring([&] { builder.pointCloud(moved, options); });
  EXPECT_EQ(second.blocks, 0);
  EXPECT_LE(builder.bytes(), held);  // nor did Buffers grow while a library ran
  EXPECT_EQ(countDuring([&] { builder.pointCloud(c.points, options); }).blocks, 0) << "what was held is still there";
}

INSTANTIATE_TEST_SUITE_P(Clouds, HeapOfFrames, testing::ValuesIn(heapCases()),
                         [](const auto& tested) { return tested.param.name; });

TEST(Heap, SecondFrameOfAMeshTakesNothing) {
  const shapes::Mesh mesh = shapes::icosphere(3);
  MeshOptions options;
  options.threads = 1;
  LaplacianBuilder builder;
  builder.mesh(mesh.points, mesh.triangles, options);
  EXPECT_EQ(countDuring([&] { builder.mesh(mesh.points, mesh.triangles, options); }).blocks, 0);
}

TEST(Heap, MemoryThatSomebodyElseHoldsIsNotCopied) {
  const shapes::Mesh mesh = shapes::icosphere(3);
  const std::vector<double> coordinates(mesh.points.data(), mesh.points.data() + mesh.points.size());
  const std::vector<int> corners(mesh.triangles.data(), mesh.triangles.data() + mesh.triangles.size());
  const Eigen::Map<const Points> points(coordinates.data(), mesh.points.rows(), 3);
  const Eigen::Map<const Triangles> triangles(corners.data(), mesh.triangles.rows(), 3);
  const Eigen::MatrixX3d by_columns = mesh.points;
  CloudOptions of_cloud;
  MeshOptions of_mesh;
  of_cloud.threads = of_mesh.threads = 1;
  LaplacianBuilder builder;
  builder.pointCloud(points, of_cloud);
  EXPECT_EQ(countDuring([&] { builder.pointCloud(points, of_cloud); }).blocks, 0);
  EXPECT_EQ(countDuring([&] { builder.pointCloud(points.topRows(642), of_cloud); }).blocks, 0);
  EXPECT_EQ(countDuring([&] { builder.pointCloud(by_columns, of_cloud); }).blocks, 1);  // a copy would be seen
  builder.mesh(points, triangles, of_mesh);
  EXPECT_EQ(countDuring([&] { builder.mesh(points, triangles, of_mesh); }).blocks, 0);
}

}  // namespace
}  // namespace tufted::builder_heap_test
