// The library holds the classes for every point type of PCL's that has a position.
#include <gtest/gtest.h>

#include <boost/preprocessor/seq/enum.hpp>
#include <pcl/impl/point_types.hpp>

#include "pcl/clouds.h"
#include "shapes/shapes.h"
#include "support/compare.h"
#include "tufted/normals.h"
#include "tufted/pcl/geodesic_distance.h"
#include "tufted/pcl/laplacian_estimation.h"
#include "tufted/pcl/laplacian_smoothing.h"
#include "tufted/pcl/oriented_normal_estimation.h"
#include "tufted/pcl/principal_curvature_estimation.h"
#include "tufted/pcl/spectral_signature_estimation.h"
#include "tufted/pcl/surface_boundary_estimation.h"
#include "tufted/pcl/surface_denoising.h"
#include "tufted/pcl/surface_segmentation.h"
#include "tufted/pcl/surface_triangulation.h"
#include "tufted/surface_triangles.h"

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

TYPED_TEST(PointTypes, HaveEveryClassOfASurface) {
  const auto cloud = cloudOf<TypeParam>(shapes::torus(600).points);
  const auto surface = std::make_shared<Laplacian>(pointCloudLaplacian(pointsOf(*cloud)));
  const auto computed = [&](auto feature) {
    feature.setInputCloud(cloud);
    feature.setSurface(surface);
    typename decltype(feature)::PointCloudOut output;
    feature.compute(output);
    EXPECT_EQ(output.size(), 600U) << feature.getClassName();
    return output;
  };
  const Frames frames = orientedFrames(*surface);
  const auto normals = computed(OrientedNormalEstimation<TypeParam>());
  const auto with_positions = computed(OrientedNormalEstimation<TypeParam, pcl::PointNormal>());
  const auto curvatures = computed(PrincipalCurvatureEstimation<TypeParam>());
  const auto boundary = computed(SurfaceBoundaryEstimation<TypeParam>());
  computed(SpectralSignatureEstimation<TypeParam>());
  for (int i = 0; i < 600; ++i) {
    ASSERT_EQ(normals[i].normal_x, static_cast<float>(frames.normals(i, 0))) << i;
    ASSERT_EQ(with_positions[i].x, (*cloud)[i].x) << i;
    ASSERT_EQ(with_positions[i].normal_z, normals[i].normal_z) << i;
    ASSERT_NEAR((curvatures[i].pc1 + curvatures[i].pc2) / 2, normals[i].curvature, 1e-5) << i;
    ASSERT_EQ(boundary[i].boundary_point, static_cast<int>(surface->boundary[i])) << i;
  }

  const auto share = [&](auto& object) {
    object.setInputCloud(cloud);
    object.setSurface(surface);
  };
  GeodesicDistance<TypeParam> distance;
  share(distance);
  distance.setSources({0});
  pcl::PointCloud<pcl::PointXYZI> distances;
  distance.compute(distances);
  ASSERT_EQ(distances.size(), 600U);
  EXPECT_EQ(distances[0].intensity, 0);
  SurfaceSegmentation<TypeParam> segmentation;
  share(segmentation);
  std::vector<pcl::PointIndices> segments;
  segmentation.segment(segments);
  EXPECT_EQ(static_cast<int>(segments.size()), surface->report.components);
  SurfaceTriangulation<TypeParam> triangulation;
  share(triangulation);
  pcl::PolygonMesh mesh;
  triangulation.reconstruct(mesh);
  EXPECT_EQ(static_cast<Eigen::Index>(mesh.polygons.size()), surfaceTriangles(*surface).rows());
  EXPECT_EQ(mesh.cloud.width, 600U);
}

}  // namespace
}  // namespace tufted::point_types_test
