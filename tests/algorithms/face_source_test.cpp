// Sources inside triangles of a mesh, where flips have removed most of the triangles from the cover.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "algorithms/place_in_cover.h"
#include "oracles/geodesics.h"
#include "oracles/planar.h"
#include "shapes/random.h"
#include "shapes/shapes.h"
#include "support/compare.h"
#include "support/refusal.h"
#include "tufted/tufted.h"

namespace tufted::face_source_test {
namespace {

using support::meanError;
using Weights = std::array<double, 3>;

constexpr std::array<DistanceMethod, 2> methods = {DistanceMethod::marching, DistanceMethod::heat};

Weights randomWeights(shapes::Random& random) {
  Weights weights;
  double sum = 0;
  for (double& weight : weights) sum += weight = random.uniform(0.02, 1);
  for (double& weight : weights) weight /= sum;
  return weights;
}

Eigen::RowVector3d placeOf(const Points& points, const SurfacePoint& at) {
  Eigen::RowVector3d place = Eigen::RowVector3d::Zero();
  for (int k = 0; k < 3; ++k) place += at.weights[k] * points.row(at.corners[k]);
  return place;
}

VectorXd straight(const Points& points, const Eigen::RowVector3d& from) {
  return (points.rowwise() - from).rowwise().norm();
}

/// A plate whose lower side is cut by points and whose triangles fan out from one of its corners.
/// @param corner 0 and 1: left below and above
shapes::Mesh fan(double length, double height, int cuts, int corner) {
  shapes::Mesh mesh;
  mesh.points.resize(cuts + 4, 3);
  for (int i = 0; i <= cuts + 1; ++i) mesh.points.row(i) << length * i / (cuts + 1), 0, 0;
  const int right = cuts + 2, left = cuts + 3;  // above
  mesh.points.row(right) << length, height, 0;
  mesh.points.row(left) << 0, height, 0;
  std::vector<std::array<int, 3>> found;
  if (corner == 1) {
    for (int i = 0; i <= cuts; ++i) found.push_back({left, i, i + 1});
    found.push_back({left, cuts + 1, right});
  } else {
    // Triangles without area along the lower side, and two for the plate.
    for (int i = 1; i <= cuts; ++i) found.push_back({0, i, i + 1});
    found.push_back({0, cuts + 1, right});
    found.push_back({0, right, left});
  }
  mesh.triangles.resize(std::ssize(found), 3);
  for (int f = 0; f < std::ssize(found); ++f) mesh.triangles.row(f) << found[f][0], found[f][1], found[f][2];
  return mesh;
}

/// The mesh with one of its triangles cut into three at a point, the last one.
shapes::Mesh cutAt(const shapes::Mesh& mesh, int face, const Weights& weights) {
  const auto n = mesh.points.rows(), f = mesh.triangles.rows();
  shapes::Mesh cut;
  cut.points.resize(n + 1, 3);
  cut.points.topRows(n) = mesh.points;
  cut.points.row(n) = placeOf(mesh.points, SurfacePoint::inFace(mesh.points, mesh.triangles, face, weights));
  cut.triangles.resize(f + 2, 3);
  cut.triangles.topRows(f) = mesh.triangles;
  const Eigen::RowVector3i corner = mesh.triangles.row(face);
  cut.triangles.row(face) << corner[0], corner[1], n;
  cut.triangles.row(f) << corner[1], corner[2], n;
  cut.triangles.row(f + 1) << corner[2], corner[0], n;
  return cut;
}

bool hasThreeCorners(const Triangles& triangles, Eigen::Index face) {
  const auto corner = triangles.row(face);
  return corner[0] != corner[1] && corner[1] != corner[2] && corner[2] != corner[0];
}

TEST(FaceSource, IsFoundInTheTrianglesThatFlipsLeave) {
  for (const double height : {1e-1, 1e-3, 1e-5}) {
    const Points points{{0, 0, 0}, {10, 0, 0}, {5, height, 0}, {5, -height, 0}};
    const Triangles triangles{{0, 1, 2}, {1, 0, 3}};
    const SurfacePoint source = SurfacePoint::inFace(points, triangles, 0, {.45, .45, .1});
    const VectorXd exact = straight(points, placeOf(points, source));
    for (const DistanceMethod method : methods) {
      const Laplacian laplacian = meshLaplacian(points, triangles, {.mollify = 0});
      const VectorXd distance = DistanceSolver(laplacian, {.method = method}).queryAt({source});
      // Rounding of the lengths moves corners of slivers across them.
      const double off = method == DistanceMethod::heat ? 0.02 * exact.maxCoeff() : 1e-14 / height;
      for (int i = 0; i < 4; ++i) EXPECT_NEAR(distance[i], exact[i], off) << height << " " << i;
      for (int i = 2; i < 4; ++i) EXPECT_NEAR(distance[i], exact[i], 1e-14 / height) << height << " " << i;
    }
  }
}

TEST(FaceSource, OnAnEdgeStartsInAllItsTriangles) {
  for (const int pages : {1, 2, 3, 5}) {
    const shapes::Mesh mesh = shapes::book(pages, 6);
    const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles, {.mollify = 0});
    for (int face = 0; face < 12; ++face) {
      for (int k = 0; k < 3; ++k) {
        Weights weights = {.3, .3, .3};
        weights[k] = 0;
        weights[(k + 1) % 3] = .7;
        const SurfacePoint source = SurfacePoint::inFace(mesh.points, mesh.triangles, face, weights);
        const Eigen::RowVector3d place = placeOf(mesh.points, source);
        const int first = source.corners[(k + 1) % 3], second = source.corners[(k + 2) % 3];
        for (const int split : {0, 1, 2}) {
          const VectorXd distance = DistanceSolver(laplacian, {.split = split}).queryAt({source});
          for (int other = 0; other < mesh.triangles.rows(); ++other) {
            const Eigen::RowVector3i corners = mesh.triangles.row(other);
            if ((corners.array() == first).count() + (corners.array() == second).count() < 2) continue;
            for (const int corner : corners)
              ASSERT_NEAR(distance[corner], (mesh.points.row(corner) - place).norm(), 1e-12)
                  << pages << " " << face << " " << k << " " << split;
          }
        }
      }
    }
  }
}

TEST(FaceSource, LiesAtItsPlaceOnPagesOfSlivers) {
  for (const double stretch : {1., 4., 20., 100., 1000.}) {
    const oracles::Book book = oracles::badBook(3, 20, stretch, 101);
    const Laplacian laplacian = meshLaplacian(book.points, book.triangles, {.mollify = 0});
    shapes::Random random(102);
    std::vector<SurfacePoint> sources;
    for (int face = 0; face < book.triangles.rows(); ++face)
      sources.push_back(SurfacePoint::inFace(book.points, book.triangles, face, randomWeights(random)));
    const std::vector<PlaceInCover> places = placesInCover("test", *laplacian.cover_source, sources);
    ASSERT_EQ(std::ssize(places), 2 * std::ssize(sources));  // front and back
    int on_page = 0;
    for (const auto& [source, face, point] : places) {
      const SurfacePoint& given = sources[source];
      const Eigen::RowVector3d place = placeOf(book.points, given);
      const int page = book.page[*std::max_element(given.corners.begin(), given.corners.end())];
      bool is_on_page = true;
      for (int k = 0; k < 3; ++k) {
        const int other = book.page[point.corners[k]];
        is_on_page &= other < 0 || other == page;
        // No straight line through triangles is shorter than that through space.
        ASSERT_GE(point.distances[k], (book.points.row(point.corners[k]) - place).norm() - 1e-9) << stretch;
      }
      const Eigen::RowVector3d found = placeOf(book.points, point);
      if (!is_on_page || (found - place).norm() > 1e-7) continue;
      ++on_page;
    }
    EXPECT_GT(on_page, .95 * static_cast<double>(places.size())) << stretch;
  }
}

TEST(FaceSource, IsExactOnPagesOfSlivers) {
  for (const double stretch : {4., 20., 100.}) {
    const oracles::Book book = oracles::badBook(3, 40, stretch, 101);
    const Laplacian laplacian = meshLaplacian(book.points, book.triangles);
    const DistanceSolver marching(laplacian), heat(laplacian, {.method = DistanceMethod::heat});
    shapes::Random random(102);
    for (int times = 0; times < 10; ++times) {
      const int face = static_cast<int>(random.uniform(0, static_cast<double>(book.triangles.rows())));
      const SurfacePoint source = SurfacePoint::inFace(book.points, book.triangles, face, randomWeights(random));
      const double height = placeOf(book.points, source)[2];
      double outward = 0;
      int page = -1;
      for (int k = 0; k < 3; ++k) {
        outward += source.weights[k] * book.outward[source.corners[k]];
        page = std::max(page, book.page[source.corners[k]]);
      }
      VectorXd exact(book.points.rows());
      for (Eigen::Index i = 0; i < exact.size(); ++i) {
        const bool same = book.page[i] == page || book.page[i] < 0;
        exact[i] = std::hypot(book.outward[i] - (same ? outward : -outward), book.points(i, 2) - height);
      }
      EXPECT_LE(meanError(marching.queryAt({source}), exact), 0.002) << stretch;
      EXPECT_LE(meanError(heat.queryAt({source}), exact), 0.02) << stretch;
    }
  }
}

TEST(FaceSource, IsNearlyExactInFansAndInTrianglesWithoutArea) {
  shapes::Random random(103);
  for (const int corner : {0, 1}) {
    for (const double height : {2., 2e-2}) {
      const shapes::Mesh mesh = fan(9000, height, 61, corner);
      const DistanceSolver solver(meshLaplacian(mesh.points, mesh.triangles, {.mollify = 0}));
      for (int face = 0; face < mesh.triangles.rows(); ++face) {
        const SurfacePoint source = SurfacePoint::inFace(mesh.points, mesh.triangles, face, randomWeights(random));
        const VectorXd exact = straight(mesh.points, placeOf(mesh.points, source));
        const VectorXd error = solver.queryAt({source}) - exact;
        for (Eigen::Index i = 0; i < error.size(); ++i) {
          ASSERT_LE(error[i], 0.01 * std::max(exact[i], height)) << corner << " " << height << " " << face;
          ASSERT_GE(error[i], -1e-7 * exact[i]) << corner << " " << height << " " << face;  // no shorter than straight
        }
      }
    }
  }
}

TEST(FaceSource, MeetsExactPathsOnSlivers) {
  for (const shapes::Mesh& mesh :
       {shapes::cubeMesh(8, shapes::Quality::bad), shapes::prismMesh(8, shapes::Quality::bad)}) {
    const Laplacian laplacian = meshLaplacian(mesh.points, mesh.triangles);
    const DistanceSolver marching(laplacian), heat(laplacian, {.method = DistanceMethod::heat});
    shapes::Random random(104);
    for (int times = 0; times < 10; ++times) {
      const int face = static_cast<int>(random.uniform(0, static_cast<double>(mesh.triangles.rows())));
      const Weights weights = randomWeights(random);
      const SurfacePoint source = SurfacePoint::inFace(mesh.points, mesh.triangles, face, weights);
      const VectorXd exact = *oracles::exactDistances(mesh.points, mesh.triangles, face, weights);
      EXPECT_LE(meanError(marching.queryAt({source}), exact), 0.01) << mesh.shape;
      EXPECT_LE(meanError(heat.queryAt({source}), exact), 0.06) << mesh.shape;
    }
  }
}

TEST(FaceSource, IsThatOfAVertexPutThere) {
  shapes::Random random(105);
  for (const shapes::Mesh& mesh : shapes::allMeshes()) {
    const DistanceSolver solver(meshLaplacian(mesh.points, mesh.triangles));
    for (int times = 0; times < 5; ++times) {
      const int face = static_cast<int>(random.uniform(0, static_cast<double>(mesh.triangles.rows())));
      if (!hasThreeCorners(mesh.triangles, face)) continue;
      const Weights weights = randomWeights(random);
      const shapes::Mesh cut = cutAt(mesh, face, weights);
      const auto n = mesh.points.rows();
      const VectorXd distance = solver.queryAt({SurfacePoint::inFace(mesh.points, mesh.triangles, face, weights)});
      const VectorXd expected =
          DistanceSolver(meshLaplacian(cut.points, cut.triangles)).query({static_cast<int>(n)}).head(n);
      double off = 0, sum = 0;
      for (Eigen::Index i = 0; i < n; ++i) {
        ASSERT_EQ(std::isfinite(distance[i]), std::isfinite(expected[i])) << mesh.shape << " " << face;
        if (!std::isfinite(distance[i])) continue;
        off += std::abs(distance[i] - expected[i]);
        sum += expected[i];
      }
      // The cut leads to other triangles.
      EXPECT_LE(off, (n > 20 ? 0.03 : 0.1) * sum) << mesh.shape << " " << face;
    }
  }
}

TEST(FaceSource, MustLieInATriangleOfTheSurface) {
  const shapes::Mesh mesh = shapes::icosphere(2);
  const DistanceSolver solver(meshLaplacian(mesh.points, mesh.triangles));
  const Triangles across{{0, 1, 2}}, twice{{0, 0, 1}};
  for (const Triangles& triangles : {across, twice}) {
    const SurfacePoint source = SurfacePoint::inFace(mesh.points, triangles, 0, {.2, .3, .5});
    EXPECT_NE(support::refusal([&] { solver.queryAt({source}); }).find("must lie in a triangle of the surface"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace tufted::face_source_test
