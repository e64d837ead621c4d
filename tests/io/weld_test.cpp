#include <gtest/gtest.h>

#include "field_values.h"
#include "tufted/io/read.h"

namespace weld_test {
namespace {

TEST(Weld, EqualVerticesBecomeTheFirstOfThem) {
  auto mesh = tufted::parse(
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty double x\nproperty double y\nproperty double z\n"
      "property uchar red\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0 1\n1 0 0 2\n0 1 0 3\n1 0 -0 4\n1 1 0 5\n0 1 0 6\n3 0 1 2\n3 3 4 5\n",
      "a.ply");
  tufted::weld(mesh);
  EXPECT_EQ(mesh.points.rows(), 4);
  EXPECT_EQ(mesh.width, 4);
  EXPECT_EQ(mesh.merged_vertices, 2);
  EXPECT_EQ(mesh.triangles.row(0), Eigen::RowVector3i(0, 1, 2));
  EXPECT_EQ(mesh.triangles.row(1), Eigen::RowVector3i(1, 3, 2));
  EXPECT_EQ(mesh.points.row(3), Eigen::RowVector3d(1, 1, 0));
  EXPECT_EQ(valuesOf<std::uint8_t>(mesh.fields[0]), (std::vector<std::uint8_t>{1, 2, 3, 5}));
}

TEST(Weld, WhatIsNotFiniteStaysApartAndNothingToDoChangesNothing) {
  auto mesh = tufted::parse("v nan 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", "a.obj");
  tufted::weld(mesh);
  EXPECT_EQ(mesh.points.rows(), 3);
  EXPECT_EQ(mesh.merged_vertices, 0);
}

TEST(Weld, NormalsOfDroppedVerticesAreDropped) {
  auto mesh = tufted::parse("NOFF\n4 1 0\n0 0 0 0 0 1\n0 0 0 1 0 0\n1 0 0 0 1 0\n0 1 0 0 0 1\n3 0 2 3\n", "a.off");
  tufted::weld(mesh);
  ASSERT_EQ(mesh.normals.rows(), 3);
  EXPECT_EQ(mesh.normals.row(1), Eigen::RowVector3d(0, 1, 0));
}

}  // namespace
}  // namespace weld_test
