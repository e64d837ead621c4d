// Points within a radius: those of a solver bit for bit, without the whole cover, and typed errors.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "base/cover_source.h"
#include "shapes/shapes.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::points_within_test {
namespace {

/// Expects the points within a radius to be those that a solver finds, bit for bit.
void expectPart(const Laplacian& laplacian, const std::vector<int>& sources, double radius, int split) {
  const VectorXd whole = DistanceSolver(laplacian, {.split = split}).query(sources);
  const NearbyPoints near = pointsWithin(laplacian, sources, radius, split);
  std::vector<int> expected;
  for (Eigen::Index i = 0; i < whole.size(); ++i)
    if (whole[i] <= radius) expected.push_back(static_cast<int>(i));
  ASSERT_EQ(near.points, expected);
  for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_EQ(near.distances[i], whole[expected[i]]) << expected[i];
}

TEST(PointsWithin, AreThoseOfASolverOnClouds) {
  Points copies = shapes::sphere(3000).points;
  copies.row(17) = copies.row(4);
  const Points clouds[] = {shapes::sphere(6000, shapes::Sampling::uniform, 101).points,
                           shapes::withNoise(shapes::torus(4000), 0.01).points, shapes::disk(3000).points, copies};
  for (const Points& points : clouds) {
    const Laplacian laplacian = pointCloudLaplacian(points);
    for (const int split : {0, 1, 2}) {
      expectPart(laplacian, {4}, 0.2, split);
      expectPart(laplacian, {1, 900, 2999}, 0.1, split);
    }
    expectPart(laplacian, {4}, 100, 1);
    expectPart(laplacian, {4}, 1e-9, 1);
  }
}

TEST(PointsWithin, AreThoseOfASolverOnMeshes) {
  for (const shapes::Mesh& mesh : shapes::allMeshes()) {
    const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
    const auto active = std::find(laplacian.status.begin(), laplacian.status.end(), PointStatus::active);
    if (active == laplacian.status.end()) continue;
    SCOPED_TRACE(mesh.name);
    expectPart(laplacian, {static_cast<int>(active - laplacian.status.begin())}, 0.3, 1);
  }
}

TEST(PointsWithin, StayOnTheComponentsOfTheSources) {
  const Points points = shapes::twoSpheres(0.1);
  Laplacian laplacian = pointCloudLaplacian(points);
  ASSERT_EQ(componentSizes(laplacian.component).size(), 2u);
  const auto stays = [&](const NearbyPoints& near) {
    return std::all_of(near.points.begin(), near.points.end(),
                       [&](int point) { return laplacian.component[point] == laplacian.component[0]; });
  };
  EXPECT_TRUE(stays(pointsWithin(laplacian, {0}, 100)));
  expectPart(laplacian, {0}, 100, 1);
  // A copy goes with its point.
  Points with_copies(points.rows() + 2, 3);
  with_copies << points, points.row(1), points.row(1500);
  Laplacian copied = pointCloudLaplacian(with_copies);
  ASSERT_EQ(copied.report.coincident, 2);
  for (int i = 0; i < 1000; ++i)
    if (i % 2 == 1) copied.component[i] = 7;
  EXPECT_EQ(std::ranges::count(pointsWithin(copied, {0}, 100).points, 2000), 0);
  // The same faces, and labels that part one of the spheres by themselves.
  const NearbyPoints all = pointsWithin(laplacian, {0}, 100);
  for (int i = 1; i < std::ssize(laplacian.component); i += 2) laplacian.component[i] = 7;
  EXPECT_LT(pointsWithin(laplacian, {0}, 100).points.size(), all.points.size());
  EXPECT_TRUE(stays(pointsWithin(laplacian, {0}, 100)));
}

TEST(PointsWithin, DoNotBuildTheCoverOfAClearCloud) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::sphere(20000, shapes::Sampling::uniform, 101).points);
  struct Refusing : CoverSource {
    explicit Refusing(std::shared_ptr<const CoverSource> source) : source_(std::move(source)) {}
    const IntrinsicTriangulation& cover() const override { throw std::logic_error("the cover is asked for"); }
    bool appendFacesNear(const std::vector<Ball>& balls, std::vector<std::array<int, 3>>& faces,
                         std::vector<double>& length) const override {
      return source_->appendFacesNear(balls, faces, length);
    }
    std::shared_ptr<const CoverSource> source_;
  };
  Laplacian refusing = laplacian;
  refusing.cover_source = std::make_shared<Refusing>(laplacian.cover_source);
  for (const int source : {0, 77, 9000}) EXPECT_GE(pointsWithin(refusing, {source}, 0.3).points.size(), 200u);
}

TEST(PointsWithin, NameWhatACallerGotWrong) {
  const Laplacian laplacian = pointCloudLaplacian(shapes::sphere(500).points);
  using support::refusal;
  EXPECT_EQ(refusal([&] { pointsWithin(laplacian, {}, 1); }), "pointsWithin: sources is empty, must name at least one");
  EXPECT_EQ(refusal([&] { pointsWithin(laplacian, {500}, 1); }), "pointsWithin: source 500, must lie in [0, 500)");
  EXPECT_EQ(refusal([&] { pointsWithin(laplacian, {0}, 0); }), "pointsWithin: radius = 0, must be finite and above 0");
  EXPECT_EQ(refusal([&] { pointsWithin(laplacian, {0}, 1, 3); }), "pointsWithin: split = 3, must lie in [0, 2]");
  EXPECT_THROW(pointsWithin(laplacian, {0}, 1, {}, [](std::string_view, double) { return false; }), Cancelled);
  Laplacian labelled = laplacian;
  labelled.component.pop_back();
  EXPECT_EQ(refusal([&] { pointsWithin(labelled, {0}, 1); }), "pointsWithin: component has 499 values, must have 500");
}

}  // namespace
}  // namespace tufted::points_within_test
