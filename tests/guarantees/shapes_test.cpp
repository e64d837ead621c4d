// The guarantees hold on every fixture, in every way to glue and to order.
#include "shapes/shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "guarantees/guarantees.h"

namespace tufted::guarantees::shapes_test {
namespace {

using testing::IsEmpty;
using testing::ValuesIn;

#ifdef TUFTED_SANITIZED
constexpr int point_count = 200;  // 1500 take minutes there
constexpr bool is_sanitized = true;
#else
constexpr int point_count = 1500;
constexpr bool is_sanitized = false;
#endif

const std::vector<shapes::Cloud>& clouds() {
  static const std::vector<shapes::Cloud> all = shapes::allClouds(point_count);
  return all;
}

const std::vector<shapes::Mesh>& meshes() {
  static const std::vector<shapes::Mesh> all = shapes::allMeshes();
  return all;
}

template <class Shape>
std::vector<const Shape*> pointersTo(const std::vector<Shape>& all) {
  std::vector<const Shape*> pointers;
  for (const Shape& shape : all) pointers.push_back(&shape);
  return pointers;
}

constexpr std::array face_orders = {FaceOrder::angle, FaceOrder::area, FaceOrder::random};

class GuaranteesOfCloud : public testing::TestWithParam<const shapes::Cloud*> {
 protected:
  const Points& points() const { return GetParam()->points; }
};

TEST_P(GuaranteesOfCloud, InAnyGluingAndOrder) {
  for (const Gluing gluing : {Gluing::star, Gluing::vertex_pair}) {
    for (const FaceOrder order : face_orders) {
      if (is_sanitized && gluing == Gluing::vertex_pair && order != FaceOrder::angle) continue;
      SCOPED_TRACE(std::to_string(static_cast<int>(gluing)) + " " + std::to_string(static_cast<int>(order)));
      const CloudOptions options{.paper = {.gluing = gluing, .order = order, .seed = 3}};
      EXPECT_THAT(brokenGuarantees(pointCloudLaplacian(points(), options), points()), IsEmpty());
    }
  }
}

TEST_P(GuaranteesOfCloud, OfEveryPreset) {
  for (const Preset preset : {Preset::clean, Preset::scan, Preset::lidar}) {
    SCOPED_TRACE(static_cast<int>(preset));
    EXPECT_THAT(brokenGuarantees(pointCloudLaplacian(points(), cloudOptions(preset)), points()), IsEmpty());
  }
}

TEST_P(GuaranteesOfCloud, OfFewNeighbors) {
  EXPECT_THAT(brokenGuarantees(pointCloudLaplacian(points(), {.neighbors = 6}), points()), IsEmpty());
}

TEST_P(GuaranteesOfCloud, NotMollified) {
  EXPECT_THAT(brokenGuarantees(pointCloudLaplacian(points(), {.mollify = 0}), points()), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Shapes, GuaranteesOfCloud, ValuesIn(pointersTo(clouds())),
                         [](const auto& shape) { return shape.param->name; });

class GuaranteesOfMesh : public testing::TestWithParam<const shapes::Mesh*> {};

TEST_P(GuaranteesOfMesh, InAnyOrder) {
  const shapes::Mesh& mesh = *GetParam();
  for (const FaceOrder order : face_orders) {
    SCOPED_TRACE(static_cast<int>(order));
    const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles, {.paper = {.order = order, .seed = 3}});
    EXPECT_THAT(brokenGuarantees(laplacian, mesh.points), IsEmpty());
  }
}

TEST_P(GuaranteesOfMesh, NotMollified) {
  const shapes::Mesh& mesh = *GetParam();
  EXPECT_THAT(brokenGuarantees(meshLaplacian(mesh.points, mesh.triangles, {.mollify = 0}), mesh.points), IsEmpty());
}

TEST_P(GuaranteesOfMesh, ItsVerticesAsCloud) {
  const Points& points = GetParam()->points;
  for (const Gluing gluing : {Gluing::star, Gluing::vertex_pair}) {
    SCOPED_TRACE(static_cast<int>(gluing));
    EXPECT_THAT(brokenGuarantees(pointCloudLaplacian(points, {.paper = {.gluing = gluing}}), points), IsEmpty());
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, GuaranteesOfMesh, ValuesIn(pointersTo(meshes())),
                         [](const auto& shape) { return shape.param->name; });

}  // namespace
}  // namespace tufted::guarantees::shapes_test
