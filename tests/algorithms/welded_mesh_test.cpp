// A mesh of which every triangle has its own vertices, joined by MeshOptions::weld: all algorithms take and give the
// indices of the caller, and their values are those of the mesh whose vertices were shared from the start.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <vector>

#include "shapes/shapes.h"
#include "support/defined_values.h"
#include "support/joined_meshes.h"
#include "tufted/tufted.h"

namespace tufted::welded_mesh_test {
namespace {

using Eigen::MatrixXd;

/// A sphere and a bent square beside it: one component is closed, one has a rim.
shapes::Mesh sharedMesh() {
  shapes::Mesh square = shapes::gridSquare(6);
  for (Eigen::Index i = 0; i < square.points.rows(); ++i) {
    const double x = square.points(i, 0), y = square.points(i, 1);
    square.points.row(i) << x + 0.1 * y * y + 3, y + 0.07 * x, 0.3 * x * y + 0.2 * x * x;
  }
  return support::joined(shapes::icosphere(2), square);
}

class WeldedMesh : public testing::Test {
 protected:
  WeldedMesh() {
    const shapes::Mesh mesh = sharedMesh();
    const auto corners = static_cast<int>(mesh.triangles.size());
    // Corner c has the index (c * 577) mod the number of corners, so the first of a position may be any of its copies.
    points_.resize(corners + 1, 3);
    triangles_.resize(mesh.triangles.rows(), 3);
    for (int c = 0; c < corners; ++c) {
      const int i = static_cast<int>(577LL * c % corners);
      points_.row(i) = mesh.points.row(mesh.triangles(c / 3, c % 3));
      triangles_(c / 3, c % 3) = i;
    }
    points_.row(corners).setConstant(NAN);
    // The same mesh with shared vertices, numbered in the order in which they come.
    std::map<std::array<double, 3>, int> number;
    std::vector<int> first;
    for (int i = 0; i < corners; ++i) {
      const auto [entry, is_new] =
          number.try_emplace({points_(i, 0), points_(i, 1), points_(i, 2)}, static_cast<int>(first.size()));
      if (is_new) first.push_back(i);
      shared_of_.push_back(entry->second);
    }
    first.push_back(corners);
    shared_of_.push_back(static_cast<int>(first.size()) - 1);
    first_ = first;
    shared_points_ = points_(first, Eigen::all);
    shared_triangles_ = triangles_;
    for (int& corner : shared_triangles_.reshaped()) corner = shared_of_[corner];
    welded_ = std::make_shared<Laplacian>(meshLaplacian(points_, triangles_, {.weld = true}));
    shared_ = std::make_shared<Laplacian>(meshLaplacian(shared_points_, shared_triangles_));
    // Two copies on the sphere and two on the square, each not the first of its position, at four positions.
    for (const int start : {0, 3 * 320})
      for (int c = start, found = 0; found < 2; c += 97) {
        const int i = triangles_(c / 3, c % 3);
        const bool is_new =
            std::none_of(copies_.begin(), copies_.end(), [&](int copy) { return shared_of_[copy] == shared_of_[i]; });
        if (is_new && welded_->status[i] == PointStatus::coincident) copies_.push_back(i), ++found;
      }
  }

  std::vector<int> sharedOf(const std::vector<int>& points) const {
    std::vector<int> result;
    for (const int i : points) result.push_back(shared_of_[i]);
    return result;
  }

  /// Expects the values of each point to be those that the shared mesh has at its position.
  void expectSame(const MatrixXd& welded, const MatrixXd& shared, double tolerance = 1e-9) const {
    ASSERT_EQ(welded.rows(), points_.rows());
    ASSERT_EQ(shared.rows(), shared_points_.rows());
    support::expectCopies(*welded_, welded);
    for (Eigen::Index i = 0; i < welded.rows(); ++i)
      for (Eigen::Index c = 0; c < welded.cols(); ++c) {
        const double a = welded(i, c), b = shared(shared_of_[i], c);
        ASSERT_TRUE(std::isnan(b) ? std::isnan(a) : a == b || std::abs(a - b) <= tolerance)
            << "row " << i << " column " << c << ": " << a << " and " << b;
      }
  }

  Points points_, shared_points_;
  Triangles triangles_, shared_triangles_;
  std::vector<int> shared_of_;  ///< by vertex, its number in the shared mesh
  std::vector<int> first_;      ///< by vertex of the shared mesh, the first of its position
  std::vector<int> copies_;     ///< two on the sphere, two on the square
  std::shared_ptr<const Laplacian> welded_, shared_;
};

TEST_F(WeldedMesh, KeepsItsRowsAndHasTheSharedMeshsLaplacianAtTheFirstOfEachPosition) {
  const Laplacian& built = *welded_;
  EXPECT_EQ(built.report.points, points_.rows());
  EXPECT_EQ(built.report.coincident, points_.rows() - shared_points_.rows());
  EXPECT_EQ(built.report.not_finite, 1);
  EXPECT_EQ(built.report.components, 2);
  EXPECT_EQ(built.report.boundary_edges, shared_->report.boundary_edges);
  EXPECT_TRUE(validate(built).ok());
  EXPECT_EQ(built.L.nonZeros(), shared_->L.nonZeros());
  for (int j = 0; j < built.L.cols(); ++j)
    for (SparseMatrix::InnerIterator entry(built.L, j); entry; ++entry)
      ASSERT_EQ(entry.value(), shared_->L.coeff(shared_of_[entry.row()], shared_of_[j]));
  for (Eigen::Index i = 0; i < points_.rows(); ++i) {
    ASSERT_EQ(built.representative[i], first_[shared_of_[i]]);
    ASSERT_EQ(built.M[i], built.representative[i] == i ? shared_->M[shared_of_[i]] : 0);
    ASSERT_EQ(built.boundary[i], shared_->boundary[shared_of_[i]]);
    ASSERT_EQ(built.component[i], shared_->component[shared_of_[i]]);
  }
}

TEST_F(WeldedMesh, StaysApartWithoutTheOption) {
  const Laplacian apart = meshLaplacian(points_, triangles_);
  EXPECT_EQ(apart.report.coincident, 0);
  EXPECT_EQ(apart.report.components, triangles_.rows());
}

TEST_F(WeldedMesh, DropsTrianglesWhoseCornersAreJoined) {
  Triangles more(triangles_.rows() + 1, 3);
  more << triangles_, Eigen::RowVector3i(copies_[0], welded_->representative[copies_[0]], copies_[1]);
  const Laplacian built = meshLaplacian(points_, more, {.weld = true});
  EXPECT_EQ(built.report.repeated_vertex_triangles, 1);
  EXPECT_EQ(built.M, welded_->M);
}

TEST_F(WeldedMesh, HasDistancesFromCopiesAndFromPlacesInTriangles) {
  const std::vector<int> sources = {copies_[0], copies_[2]};
  for (const DistanceOptions& options :
       std::initializer_list<DistanceOptions>{{}, {.split = 0}, {.method = DistanceMethod::heat}}) {
    const DistanceSolver welded(*welded_, options), shared(*shared_, options);
    expectSame(welded.query(sources), shared.query(sharedOf(sources)));
    for (const int face : {1, 330})
      expectSame(welded.queryAt({SurfacePoint::inFace(points_, triangles_, face, {0.2, 0.3, 0.5})}),
                 shared.queryAt({SurfacePoint::inFace(shared_points_, shared_triangles_, face, {0.2, 0.3, 0.5})}));
  }
  const auto near = pointsWithin(*welded_, {copies_[0]}, 0.4);
  const auto shared_near = pointsWithin(*shared_, {shared_of_[copies_[0]]}, 0.4);
  std::map<int, double> expected;
  for (std::size_t k = 0; k < shared_near.points.size(); ++k)
    expected[shared_near.points[k]] = shared_near.distances[static_cast<Eigen::Index>(k)];
  std::size_t count = 0;
  for (const int number : shared_of_) count += expected.count(number);
  ASSERT_EQ(near.points.size(), count);
  for (std::size_t k = 0; k < near.points.size(); ++k)
    ASSERT_NEAR(near.distances[static_cast<Eigen::Index>(k)], expected.at(shared_of_[near.points[k]]), 1e-12);
}

TEST_F(WeldedMesh, HasPathsBetweenCopies) {
  for (const auto& [from, to] : {std::pair(copies_[0], copies_[1]), std::pair(copies_[3], copies_[2])})
    EXPECT_NEAR(PathSolver(*welded_).query(from, to).length,
                PathSolver(*shared_).query(shared_of_[from], shared_of_[to]).length, 1e-12);
}

TEST_F(WeldedMesh, IsInterpolatedBetweenCopies) {
  const Pins pins{copies_, VectorXd{{1, 5, 2, 3}}}, shared_pins{sharedOf(copies_), pins.values};
  expectSame(harmonic(*welded_, pins), harmonic(*shared_, shared_pins));
  expectSame(biharmonic(*welded_, pins), biharmonic(*shared_, shared_pins));
  expectSame(greensFunction(*welded_, {copies_[1], copies_[3]}),
             greensFunction(*shared_, sharedOf({copies_[1], copies_[3]})));
  const std::vector<std::vector<int>> handles = {{copies_[0]}, {copies_[1]}, {copies_[2], copies_[3]}};
  expectSame(boundedBiharmonicWeights(*welded_, handles),
             boundedBiharmonicWeights(*shared_, {sharedOf(handles[0]), sharedOf(handles[1]), sharedOf(handles[2])}),
             1e-6);
  expectSame(poisson(*welded_, points_.col(0).array().isNaN().select(0, points_.col(0)).matrix()),
             poisson(*shared_, shared_points_.col(0).array().isNaN().select(0, shared_points_.col(0)).matrix()));
}

TEST_F(WeldedMesh, HasVectorsAndCurvesAtCopies) {
  const Frames frames = meshFrames(*welded_, points_, triangles_);
  const Frames shared_frames = meshFrames(shared_points_, shared_triangles_);
  expectSame(frames.normals, shared_frames.normals);
  expectSame(frames.tangents, shared_frames.tangents);
  EXPECT_EQ(frames.orientation, shared_frames.orientation);
  const Frames outwards = orientedFrames(*welded_, frames), shared_outwards = orientedFrames(*shared_, shared_frames);
  expectSame(outwards.normals, shared_outwards.normals);
  const Curvatures bent = curvatures(*welded_, outwards), shared_bent = curvatures(*shared_, shared_outwards);
  expectSame(bent.mean, shared_bent.mean);
  expectSame(bent.gaussian, shared_bent.gaussian);

  const std::vector<int> sources = {copies_[1], copies_[2]};
  const Points vectors{{1, 0.5, 0}, {0, 1, 0.2}};
  expectSame(ExtensionSolver(*welded_).query(sources, vectors),
             ExtensionSolver(*shared_).query(sharedOf(sources), vectors));
  expectSame(TransportSolver(*welded_, frames).query(sources, vectors),
             TransportSolver(*shared_, shared_frames).query(sharedOf(sources), vectors));
  expectSame(LogMapSolver(*welded_, frames).query(copies_[2]).coordinates,
             LogMapSolver(*shared_, shared_frames).query(shared_of_[copies_[2]]).coordinates);
  std::vector<int> curve;  // three corners of the square's middle, each by another copy than its neighbours' triangles
  for (const int k : {0, 1, 2}) curve.push_back(triangles_(340, k));
  expectSame(SignedDistanceSolver(*welded_, frames).query(curve),
             SignedDistanceSolver(*shared_, shared_frames).query(sharedOf(curve)));

  const Gradients slopes = gradients(*welded_, points_, frames);
  const Gradients shared_slopes = gradients(*shared_, shared_points_, shared_frames);
  const VectorXd u = points_.col(1).array().isNaN().select(0, points_.col(1));
  const VectorXd shared_u = shared_points_.col(1).array().isNaN().select(0, shared_points_.col(1));
  expectSame(slopes.X * u, shared_slopes.X * shared_u);
  expectSame(slopes.Y * u, shared_slopes.Y * shared_u);
}

TEST_F(WeldedMesh, IsMovedByCopies) {
  Points targets = points_(copies_, Eigen::all);
  targets.row(0) += Eigen::RowVector3d(0, 0, 0.3);
  targets.row(3) += Eigen::RowVector3d(0.1, 0, 0.2);
  expectSame(deform(*welded_, copies_, targets), deform(*shared_, sharedOf(copies_), targets), 1e-6);
  // Two of three positions: few points span no area.
  std::vector<int> spread;
  for (int i = 0; i + 1 < static_cast<int>(points_.rows()); ++i)
    if (welded_->status[i] == PointStatus::coincident && shared_of_[i] % 3 != 0 &&
        std::none_of(spread.begin(), spread.end(), [&](int other) { return shared_of_[other] == shared_of_[i]; }))
      spread.push_back(i);
  expectSame(minimalSurface(*welded_, triangles_, {.fixed = spread}),
             minimalSurface(*shared_, shared_triangles_, {.fixed = sharedOf(spread)}), 1e-6);
  std::vector<std::uint8_t> fixed(points_.rows(), 0), shared_fixed(shared_points_.rows(), 0);
  for (const int i : copies_) fixed[i] = shared_fixed[shared_of_[i]] = 1;
  expectSame(smooth(*welded_, points_, {.fixed = &fixed}), smooth(*shared_, shared_points_, {.fixed = &shared_fixed}));
  const Laplacian ball = restrictedTo(*welded_, {0}), shared_ball = restrictedTo(*shared_, {0});
  expectSame(smooth(ball, points_, {.volume_of = &triangles_}),
             smooth(shared_ball, shared_points_, {.volume_of = &shared_triangles_}));
}

TEST_F(WeldedMesh, IsFlattenedAlongARimThatNamesCopies) {
  const Laplacian square = restrictedTo(*welded_, {1}), shared_square = restrictedTo(*shared_, {1});
  // A conformal map would be fixed only up to a turn.
  const ParameterizationOptions means{.method = ParameterizationMethod::harmonic,
                                      .weights = HarmonicWeights::mean_value};
  expectSame(parameterize(square, triangles_, means), parameterize(shared_square, shared_triangles_, means));
  const std::vector<int> rim = {triangles_(340, 0), triangles_(340, 1), triangles_(340, 2)};
  ParameterizationOptions given{.method = ParameterizationMethod::harmonic, .rim = rim};
  ParameterizationOptions shared_given{.method = ParameterizationMethod::harmonic, .rim = sharedOf(rim)};
  expectSame(parameterize(square, triangles_, given), parameterize(shared_square, shared_triangles_, shared_given));
}

TEST_F(WeldedMesh, HasTheSpectrumAndTheSegmentsOfTheSharedMesh) {
  const Spectrum found = spectrum(*welded_, 20), shared_found = spectrum(*shared_, 20);
  EXPECT_LE((found.values - shared_found.values).cwiseAbs().maxCoeff(), 1e-8);
  support::expectDefined(*welded_, found.vectors, 0);
  const SegmentOptions seeded{.method = SegmentMethod::voronoi, .seeds = copies_};
  SegmentOptions shared_seeded = seeded;
  shared_seeded.seeds = sharedOf(copies_);
  const Segments cells = segments(*welded_, seeded), shared_cells = segments(*shared_, shared_seeded);
  for (Eigen::Index i = 0; i < points_.rows(); ++i) ASSERT_EQ(cells.labels[i], shared_cells.labels[shared_of_[i]]);
}

}  // namespace
}  // namespace tufted::welded_mesh_test
