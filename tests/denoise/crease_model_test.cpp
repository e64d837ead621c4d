#include "denoise/crease_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace tufted::crease_model_test {
namespace {

constexpr double variance = 1e-6;

/// Adds a square grid of points around the origin, bent by a right angle at x = `crease`.
void addBent(double crease, bool normals_are_known, CreaseModel& model) {
  struct Given {
    Eigen::RowVector3d position, normal;
  };
  std::vector<Given> all;
  for (int i = -6; i <= 6; ++i)
    for (int j = -6; j <= 6; ++j) {
      const double x = 0.1 * i, y = 0.1 * j;
      if (x <= crease)
        all.push_back({{x, y, 0}, {0, 0, 1}});
      else
        all.push_back({{crease, y, x - crease}, {-1, 0, 0}});
    }
  std::ranges::sort(all, {}, [](const Given& given) { return given.position.squaredNorm(); });
  model.start(static_cast<int>(all.size()), variance, 1);
  for (const Given& given : all)
    model.add(given.position, normals_are_known ? given.normal : Eigen::RowVector3d::Zero());
  model.group();
}

TEST(CreaseModel, FindsTheTwoFacesOfACrease) {
  CreaseModel model;
  addBent(0.15, true, model);
  ASSERT_TRUE(model.fit(169));
  EXPECT_NEAR(model.nearest().position.norm(), 0, 1e-9);
  EXPECT_NEAR(std::abs(model.nearest().normal[2]), 1, 1e-9);
}

TEST(CreaseModel, FindsNoFacesOnAPlane) {
  CreaseModel model;
  addBent(9, true, model);
  EXPECT_FALSE(model.fit(169));
}

TEST(CreaseModel, NeedsNormals) {
  CreaseModel model;
  addBent(0.15, false, model);
  EXPECT_FALSE(model.fit(169));
}

TEST(CreaseModel, LooksAtTheFirstPointsOnly) {
  CreaseModel model;
  addBent(0.55, true, model);
  EXPECT_TRUE(model.fit(169));
  addBent(0.55, true, model);
  EXPECT_FALSE(model.fit(60));  // all of one face
}

TEST(CreaseModel, ForgetsPointsOfBefore) {
  CreaseModel model;
  addBent(0.15, true, model);
  ASSERT_TRUE(model.fit(169));
  addBent(9, true, model);
  EXPECT_FALSE(model.fit(169));
}

}  // namespace
}  // namespace tufted::crease_model_test
