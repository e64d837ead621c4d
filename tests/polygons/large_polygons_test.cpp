// Polygons of 100,000 corners are triangulated in seconds, and small ones as if every corner were looked at.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <limits>

#include "polygons/polygon_shapes.h"
#include "tufted/errors.h"
#include "tufted/polygons.h"

namespace tufted::large_polygons_test {
namespace {

using Eigen::Vector2d;

std::vector<int> upTo(Eigen::Index n) {
  std::vector<int> all(n);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

double turn(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// Clips the best shaped empty ear, else the most convex corner, in O(n^3): the oracle.
class SlowClipper {
 public:
  explicit SlowClipper(const Points& points) {
    const Eigen::RowVector3d origin = points.row(0);
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      const Eigen::Vector3d a = points.row(i) - origin, b = points.row((i + 1) % points.rows()) - origin;
      normal += a.cross(b);
    }
    int dropped = 0;
    normal.cwiseAbs().maxCoeff(&dropped);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      const Eigen::RowVector3d d = points.row(i) - origin;
      planar_.emplace_back((normal[dropped] < 0 ? -1 : 1) * d[(dropped + 1) % 3], d[(dropped + 2) % 3]);
      left_.push_back(static_cast<int>(i));
    }
  }

  Triangles run() {
    Triangles triangles(static_cast<Eigen::Index>(left_.size()) - 2, 3);
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
      const std::size_t ear = left_.size() == 3 ? 1 : bestEar(), m = left_.size();
      triangles.row(t) << left_[(ear + m - 1) % m], left_[ear], left_[(ear + 1) % m];
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    return triangles;
  }

 private:
  std::size_t bestEar() const {
    const std::size_t m = left_.size();
    std::size_t best = 0;
    double best_quality = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < m; ++i) {
      const Vector2d &a = planar_[left_[(i + m - 1) % m]], &b = planar_[left_[i]], &c = planar_[left_[(i + 1) % m]];
      const double edges = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
      double quality = edges > 0 ? turn(a, b, c) / edges : 0;
      if (!(quality > 0 && isEmpty(a, b, c))) quality -= 1;
      if (quality > best_quality) {
        best_quality = quality;
        best = i;
      }
    }
    return best;
  }

  bool isEmpty(const Vector2d& a, const Vector2d& b, const Vector2d& c) const {
    return std::none_of(left_.begin(), left_.end(), [&](int corner) {
      const Vector2d& q = planar_[corner];
      return q != a && q != b && q != c && turn(a, b, q) >= 0 && turn(b, c, q) >= 0 && turn(c, a, q) >= 0;
    });
  }

  std::vector<Vector2d> planar_;
  std::vector<int> left_;
};

class PolygonsOf : public testing::TestWithParam<PolygonKind> {};

TEST_P(PolygonsOf, AFewCornersAreSplitAsIfEveryCornerWereLookedAt) {
  shapes::Random random(1);
  for (int round = 0; round < 400; ++round) {
    const int n = 4 + random.below(round % 40 == 0 ? 150 : 30);
    PlanarPolygon corners = GetParam().corners(n, random);
    const double scale = round % 7 == 1 ? 1e-160 : round % 7 == 2 ? 1e153 : 1;
    for (auto& corner : corners)
      for (double& c : corner) c = (c + (round % 3 == 0 ? 1e-15 * random.uniform() : 0)) * scale;
    if (round % 7 == 3) corners[random.below(n)][0] = std::numeric_limits<double>::quiet_NaN();
    if (round % 7 == 4) corners[1 + random.below(n - 1)][1] = std::numeric_limits<double>::infinity();
    const Points points = placed(corners, round % 5 == 0 ? 0 : random.uniform(0, 6));
    ASSERT_EQ(triangulate(points, {upTo(n)}), SlowClipper(points).run()) << "round " << round << ", n " << n;
  }
}

TEST_P(PolygonsOf, HundredThousandCornersKeepTheirArea) {
  shapes::Random random(2);
  for (const double angle : {0.0, 0.7}) {
    const Points points = placed(GetParam().corners(100'000, random), angle);
    const Triangles triangles = triangulate(points, {upTo(points.rows())});
    ASSERT_EQ(triangles.rows(), 99'998);
    const auto area = [&](int a, int b, int c) {
      const Eigen::RowVector3d u = points.row(b) - points.row(a), v = points.row(c) - points.row(a);
      return (u[0] * v[1] - u[1] * v[0]) / 2;
    };
    double polygon = 0, sum = 0, least = 0, size = 1;
    for (int i = 2; i < points.rows(); ++i) {
      polygon += area(0, i - 1, i);
      size += std::abs(area(0, i - 1, i));
    }
    for (const auto& t : triangles.rowwise()) {
      sum += area(t[0], t[1], t[2]);
      size += std::abs(area(t[0], t[1], t[2]));
      least = std::min(least, area(t[0], t[1], t[2]));
    }
    EXPECT_NEAR(sum, polygon, 1e-12 * size);
    if (!GetParam().is_simple) continue;
    EXPECT_GT(polygon, 0);
    EXPECT_GE(least, -1e-15) << "a triangle is turned over";
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, PolygonsOf, testing::ValuesIn(polygonKinds()),
                         [](const auto& tested) { return tested.param.name; });

TEST(LargePolygon, ReportsProgressAndIsCancelled) {
  shapes::Random random(3);
  const Points points = placed(polygonKinds()[0].corners(50'000, random), 0);
  double last = -1;
  int calls = 0;
  triangulate(points, {upTo(points.rows())}, [&](std::string_view stage, double fraction) {
    EXPECT_EQ(stage, "triangulate");
    EXPECT_GT(fraction, last);
    EXPECT_LT(fraction, 1);
    last = fraction;
    return ++calls > 0;
  });
  EXPECT_GT(calls, 10);
  EXPECT_GT(last, 0.9);
  for (int stop = 1; stop <= calls; ++stop) {
    int left = stop;
    const auto progress = [&](std::string_view, double) { return --left > 0; };
    EXPECT_THROW(triangulate(points, {upTo(points.rows())}, progress), Cancelled) << stop;
  }
}

}  // namespace
}  // namespace tufted::large_polygons_test
