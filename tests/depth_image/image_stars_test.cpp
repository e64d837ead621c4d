// Stars of images, most of which are found eight at a time.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "depth_image/image.h"
#include "shapes/random.h"
#include "stars/tangent_frame.h"
#include "tufted/options.h"

namespace tufted::image_stars_test {
namespace {

using namespace image_tests;

/// A curved surface with a step, holes and some noise, so that windows are whole, cut and open.
Points scene(bool is_mirrored) {
  shapes::Random random(11);
  Points points = imageOf([&](int column, int row) {
    const double u = (column - width / 2) / 100.0, v = (row - height / 2) / 100.0;
    if (column % 17 == 3 && row % 13 == 5) return std::nan("");
    const double smooth = 1 / (1 - 0.9 * u + 0.4 * v + 2 * u * v);
    return (row > 40 ? 1.5 : 1) * smooth * (1 + 2e-4 * random.normal());
  });
  if (is_mirrored) points.col(0) = -points.col(0);
  return points;
}

BuiltStars starsOf(const Image& image, const CloudOptions& options, Report& report) {
  const Progress silent;
  return buildImageStars(image.view(), {}, options, Workers(2, silent), report);
}

TEST(ImageStars, RunCounterclockwiseAndKnowTheCirclesOfTheirTriangles) {
  for (const bool is_mirrored : {false, true}) {
    const Image image(scene(is_mirrored));
    Report report;
    const BuiltStars built = starsOf(image, {}, report);
    const DepthImage view = image.view();
    std::int64_t closed = 0;
    for (int p = 0; p < built.stars.size(); ++p) {
      const Eigen::Vector3d normal = built.support.normals.row(p).transpose();
      const Eigen::Vector3d x = tangentOf(normal), y = normal.cross(x);
      closed += built.stars.ends[p] == 0 ? 1 : 0;
      EXPECT_LT(normal.dot(view.points.row(p)), 0);
      for (int i = built.stars.offset[p]; i < built.stars.offset[p + 1]; ++i) {
        if (!built.stars.hasTriangle(i)) continue;
        const auto planar = [&](int q) -> Eigen::Vector2d {
          const Eigen::Vector3d d = (view.moved.row(q) - view.moved.row(p)).transpose();
          return {d.dot(x), d.dot(y)};
        };
        const Eigen::Vector2d a = planar(built.stars.link[i]);
        const Eigen::Vector2d b = planar(built.stars.link[built.stars.after(p, i)]);
        const double twice_area = a[0] * b[1] - a[1] * b[0];
        ASSERT_GT(twice_area, 0) << p;
        const double radius = a.norm() * b.norm() * (a - b).norm() / (2 * twice_area);
        ASSERT_NEAR(built.support.radius[i], radius, 1e-6 * radius) << p;
      }
    }
    EXPECT_GT(closed, 0.8 * built.stars.size());
  }
}

#ifdef TUFTED_WITH_GPL
/// The link vertices from the smallest rank on.
std::vector<int> turned(const Stars& stars, int p) {
  std::vector<int> link(stars.link.begin() + stars.offset[p], stars.link.begin() + stars.offset[p + 1]);
  std::rotate(link.begin(), std::min_element(link.begin(), link.end()), link.end());
  return link;
}

TEST(ImageStars, AreThoseOfCgal) {
  for (const bool smooths : {false, true}) {
    const Image image(scene(false), smooths ? 1e-3 : 0, smooths);
    CloudOptions by_cgal;
    by_cgal.paper.delaunay = Delaunay::cgal;
    Report report, report_of_cgal;
    const BuiltStars ours = starsOf(image, {}, report), expected = starsOf(image, by_cgal, report_of_cgal);
    EXPECT_EQ(report.open_stars, report_of_cgal.open_stars);
    ASSERT_EQ(ours.stars.offset, expected.stars.offset);
    for (int p = 0; p < ours.stars.size(); ++p) {
      ASSERT_EQ(ours.stars.ends[p], expected.stars.ends[p]);
      EXPECT_EQ(turned(ours.stars, p), turned(expected.stars, p)) << p;
    }
  }
}
#endif

}  // namespace
}  // namespace tufted::image_stars_test
