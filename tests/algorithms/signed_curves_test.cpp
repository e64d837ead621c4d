// Signed distances from several curves, from curves through triangles and from points, by heat and by marching.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "shapes/shapes.h"
#include "shapes/slices.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::signed_curves_test {
namespace {

using shapes::slices;
using support::refusal;

/// A mesh with solvers of both methods.
struct Case {
  shapes::Mesh mesh;
  Laplacian laplacian;
  SignedDistanceSolver heat, marching;
  double edge;  ///< length, root mean square
};

Case made(shapes::Mesh mesh) {
  Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
  const Frames frames = meshFrames(mesh.points, mesh.triangles);
  SignedDistanceSolver heat(laplacian, frames), marching(laplacian, frames, {.method = DistanceMethod::marching});
  const double edge = std::sqrt(laplacian.report.mean_squared_edge);
  return {std::move(mesh), std::move(laplacian), std::move(heat), std::move(marching), edge};
}

SurfaceCurve through(const std::vector<int>& points) {
  SurfaceCurve curve;
  for (const int point : points) curve.push_back(SurfacePoint::vertex(point));
  return curve;
}

std::vector<SurfaceCurve> reversed(std::vector<SurfaceCurve> curves) {
  for (SurfaceCurve& curve : curves) std::reverse(curve.begin(), curve.end());
  return curves;
}

template <class Function>
VectorXd valuesOf(const Points& points, const Function& function) {
  VectorXd values(points.rows());
  for (Eigen::Index i = 0; i < points.rows(); ++i) values[i] = function(Eigen::RowVector3d(points.row(i)));
  return values;
}

/// The vertices of a square grid on the row of a height, by x.
std::vector<int> rowOf(const Points& points, double y, double from = 0, double to = 1) {
  std::vector<int> row;
  for (int i = 0; i < points.rows(); ++i)
    if (std::abs(points(i, 1) - y) < 1e-9 && points(i, 0) > from - 1e-9 && points(i, 0) < to + 1e-9) row.push_back(i);
  std::sort(row.begin(), row.end(), [&](int a, int b) { return points(a, 0) < points(b, 0); });
  return row;
}

double fromAxis(const Eigen::RowVector3d& p, double angle) {
  const Eigen::RowVector3d axis = Eigen::RowVector3d(0.3, 0.5, 0.8).normalized();
  return angle - std::acos(std::clamp(p.dot(axis), -1.0, 1.0));
}

TEST(SignedCurves, OfCirclesOnSpheresAndSquaresConverge) {
  // A great circle, a small circle, and two circles in a square with the ring between them on their left.
  double last[3] = {1, 1, 1};
  for (const int level : {0, 1}) {
    const Case sphere = made(shapes::icosphere(3 + level)), square = made(shapes::gridSquare(20 << level));
    const auto ring = [](const Eigen::RowVector3d& p) {
      const double r = std::hypot(p.x() - 0.5, p.y() - 0.5);
      return std::min(0.42 - r, r - 0.17);
    };
    const std::pair<const Case&, VectorXd> cases[] = {
        {sphere, valuesOf(sphere.mesh.points, [](const auto& p) { return fromAxis(p, M_PI / 2); })},
        {sphere, valuesOf(sphere.mesh.points, [](const auto& p) { return fromAxis(p, M_PI / 5); })},
        {square, valuesOf(square.mesh.points, ring)}};
    for (int c = 0; c < 3; ++c) {
      const auto& [on, exact] = cases[c];
      const std::vector<SurfaceCurve> curves = slices(on.mesh.points, on.mesh.triangles, exact);
      ASSERT_EQ(curves.size(), c == 2 ? 2u : 1u);
      SignedDistanceReport report;
      const VectorXd by_marching = on.marching.queryAt(curves), by_heat = on.heat.queryAt(curves, {}, &report);
      EXPECT_LE((by_marching - exact).cwiseAbs().maxCoeff(), 0.1 * on.edge) << c;
      const double error = (by_marching - exact).cwiseAbs().mean();
      EXPECT_LE(error, 0.03 * on.edge) << c;
      EXPECT_LE(error, last[c] / 1.7) << c;
      last[c] = error;
      EXPECT_LE((by_heat - exact).cwiseAbs().mean(), (c == 2 ? 0.15 : 0.05) * on.edge) << c;
      EXPECT_LE(report.residual, 1e-10) << c;
      for (Eigen::Index i = 0; i < exact.size(); ++i) {
        EXPECT_GT(by_marching[i] * exact[i], 0) << c << ", " << i;
        if (std::abs(exact[i]) > 0.8 * on.edge) {
          EXPECT_GT(by_heat[i] * exact[i], 0) << c << ", " << i;
        }
      }
    }
  }
}

TEST(SignedCurves, ReversedChangeTheSign) {
  const Case sphere = made(shapes::icosphere(3));
  std::vector<SurfaceCurve> curves;
  for (const double angle : {0.5, 2.4})
    for (const SurfaceCurve& curve :
         slices(sphere.mesh.points, sphere.mesh.triangles,
                valuesOf(sphere.mesh.points, [&](const auto& p) { return fromAxis(p, angle); })))
      curves.push_back(curve);
  for (const SignedDistanceSolver* solver : {&sphere.heat, &sphere.marching})
    EXPECT_LE((solver->queryAt(curves) + solver->queryAt(reversed(curves))).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(SignedCurves, ByMarchingAreTheLeastByMagnitudeOfSingleOnes) {
  // The left sides of two of the lines agree, that of the third does not.
  const Case square = made(shapes::gridSquare(16));
  const Points& points = square.mesh.points;
  std::vector<int> back = rowOf(points, 0.75, 0.25, 0.75);
  std::reverse(back.begin(), back.end());
  const std::vector<SurfaceCurve> curves = {through(rowOf(points, 0.125)), through(rowOf(points, 0.5, 0, 0.5)),
                                            through(back)};
  const VectorXd all = square.marching.queryAt(curves);
  VectorXd expected = VectorXd::Constant(all.size(), INFINITY), second = expected;
  for (const SurfaceCurve& curve : curves) {
    const VectorXd one = square.marching.queryAt({curve});
    for (Eigen::Index i = 0; i < one.size(); ++i) {
      if (std::abs(one[i]) < std::abs(expected[i]))
        std::swap(expected[i], second[i]), expected[i] = one[i];
      else if (std::abs(one[i]) < std::abs(second[i]))
        second[i] = one[i];
    }
  }
  for (Eigen::Index i = 0; i < all.size(); ++i) {
    // A march goes on with few of several sources, which costs the last digits.
    EXPECT_NEAR(std::abs(all[i]), std::abs(expected[i]), 1e-6) << i;
    // Within an edge of where paths from two curves meet, the sign is that of either.
    if (std::abs(second[i]) - std::abs(expected[i]) > square.edge) {
      EXPECT_NEAR(all[i], expected[i], 1e-6) << i;
    }
  }
}

TEST(SignedCurves, ByHeatHaveTheMeanZeroOverEach) {
  const Case square = made(shapes::gridSquare(16));
  const std::vector<int> low = rowOf(square.mesh.points, 0.25), high = rowOf(square.mesh.points, 0.75, 0.25, 1);
  // Equal ones add nothing.
  const VectorXd distance = square.heat.queryAt({through(low), through(high), through(low)});
  for (const std::vector<int>& row : {low, high}) {
    double sum = 0;
    for (std::size_t k = 1; k < row.size(); ++k) sum += distance[row[k - 1]] + distance[row[k]];
    EXPECT_NEAR(sum, 0, 1e-9);
  }
}

TEST(SignedCurves, ByHeatOfOneCurveInOtherPiecesAddNothing) {
  const Case square = made(shapes::gridSquare(16));
  const auto inside = [](const Eigen::RowVector3d& p) { return 0.3 - std::hypot(p.x() - 0.47, p.y() - 0.52); };
  const std::vector<SurfaceCurve> whole =
      slices(square.mesh.points, square.mesh.triangles, valuesOf(square.mesh.points, inside));
  ASSERT_EQ(whole.size(), 1u);
  // The same circle from another place on.
  SurfaceCurve turned(whole[0].begin() + 5, whole[0].end());
  turned.insert(turned.end(), whole[0].begin() + 1, whole[0].begin() + 6);
  const VectorXd alone = square.heat.queryAt(whole), both = square.heat.queryAt({whole[0], turned});
  EXPECT_LT((alone - both).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(SignedCurves, OnABoxHaveTheirSideAcrossItsEdges) {
  const Case box = made(shapes::cubeMesh(6, shapes::Quality::good));
  // The rim of the top, seen from above against the clock: the top is on its left.
  const Points& points = box.mesh.points;
  const double top = points.col(2).maxCoeff();
  std::vector<std::pair<double, int>> rim;
  for (int i = 0; i < points.rows(); ++i) {
    const Eigen::RowVector3d p = points.row(i) - Eigen::RowVector3d::Constant(0.5);
    if (points(i, 2) > top - 1e-9 && std::max(std::abs(p.x()), std::abs(p.y())) > 0.5 - 1e-9)
      rim.emplace_back(std::atan2(p.y(), p.x()), i);
  }
  std::sort(rim.begin(), rim.end());
  std::vector<int> loop;
  for (const auto& [angle, i] : rim) loop.push_back(i);
  loop.push_back(loop[0]);
  const VectorXd distance = box.marching.query(loop);
  for (int i = 0; i < points.rows(); ++i) {
    if (std::find(loop.begin(), loop.end(), i) != loop.end()) continue;
    EXPECT_EQ(distance[i] > 0, points(i, 2) > top - 1e-9) << points.row(i);
  }
}

TEST(SignedCurves, ThroughTheMiddlesOfEdgesAreThoseOfTheirEnds) {
  const Case square = made(shapes::gridSquare(12));
  const Triangles& triangles = square.mesh.triangles;
  const std::vector<int> row = rowOf(square.mesh.points, 0.5);
  SurfaceCurve halves = through({row[0]});
  for (std::size_t k = 1; k < row.size(); ++k) {
    const auto halfOf = [&](int corner) { return corner == row[k - 1] || corner == row[k] ? 0.5 : 0; };
    int f = 0;
    while (halfOf(triangles(f, 0)) + halfOf(triangles(f, 1)) + halfOf(triangles(f, 2)) < 1) ++f;
    halves.push_back(SurfacePoint::inFace(square.mesh.points, triangles, f,
                                          {halfOf(triangles(f, 0)), halfOf(triangles(f, 1)), halfOf(triangles(f, 2))}));
    halves.push_back(SurfacePoint::vertex(row[k]));
  }
  for (const SignedDistanceSolver* solver : {&square.heat, &square.marching})
    EXPECT_LE((solver->queryAt({halves}) - solver->query(row)).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(SignedCurves, PointsHaveTheDistanceWithoutSign) {
  const Case sphere = made(shapes::icosphere(3));
  const std::vector<SurfacePoint> points = {
      SurfacePoint::vertex(5), SurfacePoint::inFace(sphere.mesh.points, sphere.mesh.triangles, 700, {0.2, 0.3, 0.5})};
  const VectorXd alone = sphere.marching.queryAt({}, points);
  EXPECT_EQ(alone, DistanceSolver(sphere.laplacian).queryAt(points));
  const auto curves = slices(sphere.mesh.points, sphere.mesh.triangles,
                             valuesOf(sphere.mesh.points, [](const auto& p) { return fromAxis(p, M_PI / 3); }));
  const VectorXd curve = sphere.marching.queryAt(curves), both = sphere.marching.queryAt(curves, points);
  for (Eigen::Index i = 0; i < both.size(); ++i) {
    // A march goes on with few of several sources, which costs the last digits.
    EXPECT_NEAR(std::abs(both[i]), std::min(std::abs(curve[i]), alone[i]), 1e-6) << i;
    if (std::abs(std::abs(curve[i]) - alone[i]) < sphere.edge) continue;
    EXPECT_EQ(both[i] < 0, curve[i] < 0 && -curve[i] < alone[i]) << i;
  }
}

TEST(SignedCurves, BeyondTheEndsOfOpenOnesTheSideIsThatOfTheLineThroughThem) {
  const Case square = made(shapes::gridSquare(16));
  const Points& points = square.mesh.points;
  const VectorXd distance = square.marching.query(rowOf(points, 0.5, 0.25, 0.75));
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const double across = points(i, 1) - 0.5;
    const double expected = std::hypot(points(i, 0) - std::clamp(points(i, 0), 0.25, 0.75), across);
    EXPECT_NEAR(std::abs(distance[i]), expected, 0.1 * square.edge) << i;
    if (std::abs(across) > 0.1 * expected) {
      EXPECT_EQ(distance[i] > 0, across > 0) << i;
    }
  }
}

TEST(SignedCurves, ThatBoundNothingHaveTheSideOnWhichPathsLeave) {
  // A circle around the tube of a torus: heat cannot have a slope of 1 everywhere, paths from both sides meet opposite.
  const int around = 64, tube = 32;
  shapes::Mesh mesh;
  mesh.points.resize(around * tube, 3);
  mesh.triangles.resize(2 * around * tube, 3);
  for (int i = 0, f = 0; i < around; ++i) {
    for (int j = 0; j < tube; ++j) {
      const double u = 2 * M_PI * i / around, v = 2 * M_PI * j / tube;
      mesh.points.row(tube * i + j) << (1 + 0.4 * std::cos(v)) * std::cos(u), (1 + 0.4 * std::cos(v)) * std::sin(u),
          0.4 * std::sin(v);
      const int next = (i + 1) % around, up = (j + 1) % tube;
      mesh.triangles.row(f++) << tube * i + j, tube * next + j, tube * next + up;
      mesh.triangles.row(f++) << tube * i + j, tube * next + up, tube * i + up;
    }
  }
  const Case torus = made(mesh);
  std::vector<int> circle;
  for (int j = 0; j <= tube; ++j) circle.push_back(j % tube);
  const VectorXd distance = torus.marching.query(circle);
  for (int i = 1; i < around; ++i) {
    if (i == around / 2) continue;
    for (int j = 0; j < tube; ++j) EXPECT_EQ(distance[tube * i + j] < 0, i < around / 2) << i << ", " << j;
  }
}

TEST(SignedCurves, OnPagesThatMeetAtASpineTheSideIsThatOfTheCurve) {
  // A curve on one page: the spine and the other pages lie on one side of it.
  const Case book = made(shapes::book(3, 8));
  const Points& points = book.mesh.points;
  std::vector<int> spine;
  const VectorXd from_spine = valuesOf(points, [](const auto& p) { return std::hypot(p.x(), p.y()); });
  for (int i = 0; i < points.rows(); ++i)
    if (from_spine[i] < 1e-9) spine.push_back(i);
  ASSERT_GE(spine.size(), 3u) << "the spine is not along z";
  std::sort(spine.begin(), spine.end(), [&](int a, int b) { return points(a, 2) < points(b, 2); });
  const double width = from_spine.maxCoeff();
  // Along the spine itself each page has the distance from the spine, and one sign.
  const VectorXd along = book.marching.query(spine);
  EXPECT_LE((along.cwiseAbs() - from_spine).cwiseAbs().maxCoeff(), 0.1 * book.edge);
  const auto pageOf = [&](int i) { return std::lround(std::atan2(points(i, 1), points(i, 0)) / (2 * M_PI / 3)); };
  std::map<long, double> side_of;
  for (int i = 0; i < points.rows(); ++i)
    if (from_spine[i] > 1e-9) {
      EXPECT_GT(side_of.try_emplace(pageOf(i), along[i]).first->second * along[i], 0) << i;
    }
  ASSERT_EQ(side_of.size(), 3u);
  // The line in the middle of the first page.
  std::vector<int> line;
  int first = 0;
  while (!(from_spine[first] > 0.49 * width)) ++first;
  for (int i = 0; i < points.rows(); ++i)
    if (std::abs(from_spine[i] - from_spine[first]) < 1e-9 && pageOf(i) == pageOf(first)) line.push_back(i);
  std::sort(line.begin(), line.end(), [&](int a, int b) { return points(a, 2) < points(b, 2); });
  const VectorXd distance = book.marching.query(line);
  const double side = distance[spine[0]] > 0 ? 1 : -1;
  for (int i = 0; i < points.rows(); ++i) {
    const double expected =
        pageOf(i) == pageOf(first) ? from_spine[first] - from_spine[i] : from_spine[first] + from_spine[i];
    EXPECT_NEAR(side * distance[i], expected, 0.1 * book.edge) << i;
  }
}

TEST(SignedCurves, OnComponentsWithoutASourceAreNaN) {
  const Case several = made(shapes::severalComponents());
  const std::vector<int> part = componentLabels(several.laplacian);
  const auto& triangles = several.mesh.triangles;
  const auto last = triangles.rows() - 1;
  const SurfaceCurve curve = through({triangles(0, 0), triangles(0, 1)});
  const SurfaceCurve other = through({triangles(last, 0), triangles(last, 1)});
  const VectorXd marched = several.marching.queryAt({curve}), heat = several.heat.queryAt({curve});
  const VectorXd both = several.heat.queryAt({curve, other});
  for (Eigen::Index i = 0; i < both.size(); ++i) {
    const bool has_curve = part[i] == part[triangles(0, 0)], has_other = part[i] == part[triangles(last, 0)];
    EXPECT_EQ(std::isfinite(marched[i]), has_curve) << i;
    EXPECT_EQ(std::isfinite(heat[i]), has_curve) << i;
    EXPECT_EQ(std::isfinite(both[i]), has_curve || has_other) << i;
    if (has_curve) {
      EXPECT_NEAR(both[i], heat[i], 1e-9) << i;
    }
  }
}

TEST(SignedCurves, NameWhatACallerGotWrong) {
  const Case square = made(shapes::gridSquare(4));
  const SurfaceCurve line = through({0, 1, 2});
  const auto says = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  EXPECT_EQ(refusal([&] { square.heat.queryAt({line}, line); }),
            "SignedDistanceSolver::query: points has 3 places, must be empty unless method is marching");
  for (const SignedDistanceSolver* solver : {&square.heat, &square.marching}) {
    EXPECT_EQ(refusal([&] { solver->queryAt({}); }),
              "SignedDistanceSolver::query: no curve and no point is given, must be at least one");
    EXPECT_TRUE(says(refusal([&] { solver->queryAt({line, through({0, 25})}); }), "source 25, must lie in [0, 25)"));
    EXPECT_TRUE(says(refusal([&] { solver->queryAt({through({3})}); }), "must have at least two on one component"));
    EXPECT_THROW(solver->queryAt({line}, {}, nullptr, [](std::string_view, double) { return false; }), Cancelled);
  }
  SurfacePoint elsewhere = SurfacePoint::inFace(square.mesh.points, square.mesh.triangles, 0, {1, 1, 1});
  elsewhere.corners = {0, 12, 24};
  EXPECT_TRUE(
      says(refusal([&] { square.marching.queryAt({}, {elsewhere}); }), "must lie in a triangle of the surface"));
  Laplacian bare = square.laplacian;
  bare.cover_source = nullptr;
  const Frames frames = meshFrames(square.mesh.points, square.mesh.triangles);
  const auto make = [&] { SignedDistanceSolver(bare, frames, {.method = DistanceMethod::marching}); };
  EXPECT_TRUE(says(refusal(make), "cover"));
}

}  // namespace
}  // namespace tufted::signed_curves_test
