// The library holds the classes for every point type of PCL's that has a position.
#include <gtest/gtest.h>

#include <boost/preprocessor/seq/enum.hpp>
#include <pcl/impl/point_types.hpp>

#include "pcl/clouds.h"
#include "shapes/shapes.h"
#include "support/compare.h"
#include "tufted/pcl/laplacian_estimation.h"
#include "tufted/pcl/laplacian_smoothing.h"
#include "tufted/pcl/surface_denoising.h"

namespace tufted::point_types_test {
namespace {

using namespace pcl_tests;

template <typename PointT>
class PointTypes : public testing::Test {};

using XyzPointTypes = testing::Types<BOOST_PP_SEQ_ENUM(PCL_XYZ_POINT_TYPES)>;
TYPED_TEST_SUITE(PointTypes, XyzPointTypes);

TYPED_TEST(PointTypes, GiveTheCoresResult) {
  const auto cloud = cloudOf<TypeParam>(shapes::torus(600).points);
  const Points points = pointsOf(*cloud);
  const Laplacian core = pointCloudLaplacian(points);

  LaplacianEstimation<TypeParam> estimation;
  estimation.setInputCloud(cloud);
  Laplacian result;
  estimation.compute(result);
  EXPECT_TRUE(support::sameBits(result.L, core.L));

  LaplacianSmoothing<TypeParam> smoothing;
  smoothing.setInputCloud(cloud);
  pcl::PointCloud<TypeParam> output;
  smoothing.filter(output);
  EXPECT_TRUE(samePositions(pointsOf(output), rounded(smooth(core, points))));

  SurfaceDenoising<TypeParam> denoising;
  denoising.setInputCloud(cloud);
  denoising.filter(output);
  EXPECT_TRUE(samePositions(pointsOf(output), points));  // exact points stay
}

}  // namespace
}  // namespace tufted::point_types_test
