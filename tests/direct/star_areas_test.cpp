// The area that a point has in its own star.
#include "direct/star_areas.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "shapes/shapes.h"
#include "support/cloud_stars.h"
#include "tufted/laplacian.h"

namespace tufted::star_areas_test {
namespace {

const Progress silent;

TEST(StarAreas, ArePartsOfTheTrianglesWhereTheSurfaceEnds) {
  Points ribbon = shapes::square(3000).points, line = shapes::square(30).points;
  ribbon.col(1) *= 1e-3;
  line.col(1) *= 1e-15;
  const Points noisy = shapes::withNoise(shapes::sphere(3000), 0.02).points;
  const Points steps = shapes::sphere(3000, shapes::Sampling::densityStep(100)).points;
  for (const Points& points : {ribbon, line, noisy, steps}) {
    const auto [cloud, built] = support::starsOf(points);
    const Stars& stars = built.stars;
    const RawBuffer<double> own = ownAreas(stars, cloud.points, Workers(2, silent));
    for (int p = 0; p < stars.size(); ++p) {
      double triangles = 0;
      for (int i = stars.offset[p]; i < stars.offset[p + 1]; ++i) {
        if (!stars.hasTriangle(i)) continue;
        const Eigen::Vector3d a = cloud.points.row(stars.link[i]) - cloud.points.row(p);
        const Eigen::Vector3d b = cloud.points.row(stars.link[stars.after(p, i)]) - cloud.points.row(p);
        triangles += a.cross(b).norm() / 2;
      }
      if (stars.ends[p] == 0) {
        EXPECT_EQ(own[p], 0) << "point " << p;
        continue;
      }
      // A needle's area is known up to the rounding of its lengths.
      EXPECT_GE(own[p], 0) << "point " << p;
      EXPECT_LE(own[p], triangles + 1e-7) << "point " << p;
    }
  }
}

}  // namespace
}  // namespace tufted::star_areas_test
