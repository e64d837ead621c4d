// A point type of the user's own: the classes are compiled from impl/, as PCL's are.
#define PCL_NO_PRECOMPILE
#include <gtest/gtest.h>
#include <pcl/register_point_struct.h>

#include "pcl/clouds.h"
#include "shapes/shapes.h"
#include "support/compare.h"
#include "tufted/pcl/laplacian_estimation.h"
#include "tufted/pcl/laplacian_smoothing.h"
#include "tufted/pcl/spectral_signature_estimation.h"
#include "tufted/signatures.h"

namespace tufted::pcl_tests {

struct EIGEN_ALIGN16 Echo {
  PCL_ADD_POINT4D;
  float strength = 0;
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

}  // namespace tufted::pcl_tests

POINT_CLOUD_REGISTER_POINT_STRUCT(tufted::pcl_tests::Echo,
                                  (float, x, x)(float, y, y)(float, z, z)(float, strength, strength))

namespace tufted {
namespace {

using namespace pcl_tests;

TEST(OwnPointType, GivesTheCoresResult) {
  const auto cloud = cloudOf<Echo>(shapes::torus(600).points);
  (*cloud)[5].strength = 17;
  const Points points = pointsOf(*cloud);
  const Laplacian core = pointCloudLaplacian(points);
  LaplacianEstimation<Echo> estimation;
  estimation.setInputCloud(cloud);
  Laplacian result;
  estimation.compute(result);
  EXPECT_TRUE(support::sameBits(result.L, core.L));

  LaplacianSmoothing<Echo> smoothing;
  smoothing.setInputCloud(cloud);
  smoothing.filter(*cloud);
  EXPECT_TRUE(samePositions(pointsOf(*cloud), rounded(smooth(core, points))));
  EXPECT_EQ((*cloud)[5].strength, 17);

  // Also an output that the library is not compiled for.
  SpectralSignatureEstimation<Echo, pcl::Histogram<5>> signature;
  signature.setInputCloud(cloudOf<Echo>(points));
  pcl::PointCloud<pcl::Histogram<5>> output;
  signature.compute(output);
  const Spectrum pairs = spectrum(core, 100, {.null_space = false});
  const Eigen::MatrixXd expected = heatKernelSignature(core, pairs, heatTimes(pairs, 5));
  ASSERT_EQ(output.size(), 600U);
  for (int time = 0; time < 5; ++time) EXPECT_EQ(output[9].histogram[time], static_cast<float>(expected(9, time)));
}

}  // namespace
}  // namespace tufted
