#include "tufted/laplacian_builder.h"

#include <gtest/gtest.h>

#include <limits>

#include "shapes/shapes.h"
#include "support/compare.h"
#include "tufted/errors.h"

namespace tufted::laplacian_builder_test {
namespace {

using support::sameBits;

void expectSameCover(const IntrinsicTriangulation& a, const IntrinsicTriangulation& b) {
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.faces, b.faces);
  EXPECT_EQ(a.glue, b.glue);
  EXPECT_EQ(a.length, b.length);
}

void expectSameReport(const Report& a, const Report& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.active, b.active);
  EXPECT_EQ(a.not_finite, b.not_finite);
  EXPECT_EQ(a.coincident, b.coincident);
  EXPECT_EQ(a.votes, b.votes);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.flips, b.flips);
  EXPECT_EQ(a.area, b.area);
  EXPECT_EQ(a.components, b.components);
  EXPECT_EQ(a.boundary_edges, b.boundary_edges);
  ASSERT_EQ(a.stages.size(), b.stages.size());
  for (std::size_t i = 0; i < a.stages.size(); ++i) EXPECT_EQ(a.stages[i].name, b.stages[i].name);
}

void expectSame(const Laplacian& a, const Laplacian& b) {
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_TRUE(sameBits(a.L, b.L));
  EXPECT_TRUE(sameBits(a.M, b.M));
  EXPECT_TRUE(sameBits(a.cover_areas, b.cover_areas));
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.representative, b.representative);
  EXPECT_EQ(a.boundary, b.boundary);
  EXPECT_EQ(a.frames.normals, b.frames.normals);
  EXPECT_EQ(a.frames.tangents, b.frames.tangents);
  expectSameReport(a.report, b.report);
  ASSERT_EQ(a.hasCover(), b.hasCover());
  if (a.hasCover()) expectSameCover(a.cover(), b.cover());
}

struct Frame {
  Points points;
  CloudOptions options = {};
};

/// Growing, shrinking and odd ones.
std::vector<Frame> frames() {
  std::vector<Frame> frames;
  for (const int size : {500, 2000, 1999, 3000, 400})
    frames.push_back({shapes::withNoise(shapes::sphere(size), 0.01).points});
  frames.push_back({shapes::sphere(1500).points, cloudOptions(Preset::clean)});
  frames.push_back({Points(0, 3)});
  frames.push_back({Points::Constant(300, 3, std::numeric_limits<double>::quiet_NaN())});
  frames.push_back({Points::Constant(300, 3, 4)});
  frames.push_back({shapes::depthCamera({.width = 64, .height = 48}).points});
  Points holes = shapes::sphere(2000).points;
  for (int i = 0; i < 500; ++i) holes(3 * i, 1) = std::numeric_limits<double>::infinity();
  frames.push_back({holes});
  frames.push_back({shapes::square(1000).points, {.paper = {.gluing = Gluing::vertex_pair}}});
  frames.push_back({shapes::sphere(1000).points, {.keep_cover = false}});
  frames.push_back({shapes::sphere(1000).points, {.keep_cover = false, .paper = {.gluing = Gluing::vertex_pair}}});
  frames.push_back({frames[1]});
  return frames;
}

TEST(LaplacianBuilder, FramesHaveTheBitsOfSingleBuilds) {
  for (const int threads : {1, 2}) {
    LaplacianBuilder builder;
    int number = 0;
    for (Frame& frame : frames()) {
      SCOPED_TRACE("frame " + std::to_string(number++) + ", threads " + std::to_string(threads));
      frame.options.threads = threads;
      expectSame(builder.pointCloud(frame.points, frame.options), pointCloudLaplacian(frame.points, frame.options));
    }
  }
}

TEST(LaplacianBuilder, MeshesAndCloudsTakeTurns) {
  LaplacianBuilder builder;
  const Points cloud = shapes::sphere(1000).points;
  for (const shapes::Mesh& mesh : {shapes::icosphere(3), shapes::moebius(8), shapes::icosphere(2)}) {
    expectSame(builder.mesh(mesh.points, mesh.triangles), meshLaplacian(mesh.points, mesh.triangles));
    expectSame(builder.pointCloud(cloud), pointCloudLaplacian(cloud));
  }
}

TEST(LaplacianBuilder, ExceptionsLeaveItUsable) {
  LaplacianBuilder builder;
  const Points points = shapes::withNoise(shapes::sphere(2000), 0.01).points;
  const Laplacian expected = pointCloudLaplacian(points);
  for (const std::string_view stopped : {"order", "stars", "glue", "flips", "assemble"}) {
    builder.pointCloud(points);
    CloudOptions options;
    options.progress = [stopped](std::string_view stage, double) { return stage != stopped; };
    EXPECT_THROW(builder.pointCloud(points, options), Cancelled) << stopped;
    EXPECT_THROW(builder.pointCloud(points, {.neighbors = 2}), InvalidInput);
    expectSame(builder.pointCloud(points), expected);
  }
}

TEST(LaplacianBuilder, CopiesAndTheirCoversOutliveIt) {
  const Points points = shapes::withNoise(shapes::sphere(1000), 0.01).points;
  const shapes::Mesh mesh = shapes::icosphere(2);
  Laplacian cloud_copy, mesh_copy;
  {
    LaplacianBuilder builder;
    cloud_copy = builder.pointCloud(points);
    mesh_copy = builder.mesh(mesh.points, mesh.triangles);
    builder.mesh(mesh.points * 3, mesh.triangles);
    builder.pointCloud(shapes::sphere(1000, shapes::Sampling::uniform, 7).points);
  }
  expectSame(cloud_copy, pointCloudLaplacian(points));
  expectSame(mesh_copy, meshLaplacian(mesh.points, mesh.triangles));
}

TEST(LaplacianBuilder, FramesLikeOneAnotherHoldNoMoreAndMore) {
  LaplacianBuilder builder;
  std::size_t held = 0;  // after a few frames, whose arrays differ in size
  for (std::uint64_t frame = 0; frame < 60; ++frame) {
    builder.pointCloud(shapes::withNoise(shapes::sphere(1000, shapes::Sampling::uniform, frame), 0.01, frame).points,
                       {.threads = 2});
    if (frame == 4) held = builder.bytes();
  }
  EXPECT_GT(held, 0);
  EXPECT_LT(builder.bytes(), held + held / 4);
  builder.release();
  EXPECT_EQ(builder.bytes(), 0);
}

TEST(LaplacianBuilder, FramesThatFailHoldNothing) {
  LaplacianBuilder builder;
  builder.pointCloud(shapes::sphere(5000).points);
  for (int frame = 0; frame < 2; ++frame)
    EXPECT_THROW(builder.pointCloud(shapes::sphere(100).points, {.neighbors = 2}), InvalidInput);
  EXPECT_EQ(builder.bytes(), 0);
}

TEST(LaplacianBuilder, FramesThatGrowLeaveLittleBehind) {
  LaplacianBuilder builder;
  for (int points = 300; points <= 3000; points += 90) builder.pointCloud(shapes::sphere(points).points);
  const std::size_t held = builder.bytes();
  LaplacianBuilder other;
  other.pointCloud(shapes::sphere(3000).points);
  EXPECT_LE(held, 2 * other.bytes());
}

}  // namespace
}  // namespace tufted::laplacian_builder_test
