#include "tufted/polygons.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "tufted/errors.h"

namespace tufted {
namespace {

/// One polygon in the plane of its Newell normal.
class EarClipper {
 public:
  EarClipper(const Points& points, const std::vector<int>& polygon) : corners_(polygon) {
    const Eigen::RowVector3d origin = points.row(polygon[0]);  // differences only
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Eigen::Vector3d a = points.row(polygon[i]) - origin;
      const Eigen::Vector3d b = points.row(polygon[(i + 1) % polygon.size()]) - origin;
      normal += a.cross(b);
    }
    int dropped = 0;  // the axis along the normal; projecting along it keeps the turn of every corner
    normal.cwiseAbs().maxCoeff(&dropped);
    const int x = (dropped + 1) % 3, y = (dropped + 2) % 3;
    const double sign = normal[dropped] < 0 ? -1 : 1;
    for (const int vertex : polygon) {
      const Eigen::RowVector3d d = points.row(vertex) - origin;
      planar_.emplace_back(sign * d[x], d[y]);
    }
  }

  template <class Emit>
  void run(Emit emit) {
    while (corners_.size() > 3) {
      const std::size_t ear = bestEar();
      const std::size_t m = corners_.size();
      emit(corners_[(ear + m - 1) % m], corners_[ear], corners_[(ear + 1) % m]);
      corners_.erase(corners_.begin() + static_cast<std::ptrdiff_t>(ear));
      planar_.erase(planar_.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    emit(corners_[0], corners_[1], corners_[2]);
  }

 private:
  using Point2 = Eigen::Vector2d;

  static double turn(const Point2& a, const Point2& b, const Point2& c) {
    return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
  }

  bool isEmpty(std::size_t before, std::size_t ear, std::size_t after) const {
    for (std::size_t i = 0; i < planar_.size(); ++i) {
      const Point2& q = planar_[i];
      if (i == before || i == ear || i == after) continue;
      if (q == planar_[before] || q == planar_[ear] || q == planar_[after]) continue;
      if (turn(planar_[before], planar_[ear], q) >= 0 && turn(planar_[ear], planar_[after], q) >= 0 &&
          turn(planar_[after], planar_[before], q) >= 0) {
        return false;
      }
    }
    return true;
  }

  /// The convex, empty corner whose triangle is best shaped; failing that (degenerate or crossing polygons) the most
  /// convex corner, so that clipping always ends.
  std::size_t bestEar() const {
    const std::size_t m = planar_.size();
    std::size_t best = 0;
    double best_quality = -INFINITY;
    for (std::size_t i = 0; i < m; ++i) {
      const std::size_t before = (i + m - 1) % m, after = (i + 1) % m;
      const Point2 &a = planar_[before], &b = planar_[i], &c = planar_[after];
      const double edges = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
      double quality = edges > 0 ? turn(a, b, c) / edges : 0;
      if (!(quality > best_quality)) continue;                        // it can only fall from here
      if (!(quality > 0 && isEmpty(before, i, after))) quality -= 1;  // |quality| < 1/2, so any true ear wins
      if (quality > best_quality) {
        best_quality = quality;
        best = i;
      }
    }
    return best;
  }

  std::vector<int> corners_;
  std::vector<Point2> planar_;
};

}  // namespace

Triangles triangulate(const Points& points, const Polygons& polygons) {
  std::vector<int> corners;
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    for (const int vertex : polygons[p]) {
      if (vertex < 0 || vertex >= points.rows()) {
        throw InvalidInput("triangulate: polygon " + std::to_string(p) + " names vertex " + std::to_string(vertex) +
                           ", must lie in [0, " + std::to_string(points.rows()) + ")");
      }
    }
    if (polygons[p].size() < 3) continue;
    const auto emit = [&](int a, int b, int c) { corners.insert(corners.end(), {a, b, c}); };
    if (polygons[p].size() == 3) {
      emit(polygons[p][0], polygons[p][1], polygons[p][2]);
    } else {
      EarClipper(points, polygons[p]).run(emit);
    }
  }
  return Eigen::Map<const Triangles>(corners.data(), static_cast<Eigen::Index>(corners.size() / 3), 3);
}

}  // namespace tufted
