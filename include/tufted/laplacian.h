#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "tufted/intrinsic_triangulation.h"
#include "tufted/options.h"
#include "tufted/report.h"
#include "tufted/types.h"

namespace tufted {

/// How the signs of normals were chosen.
enum class Orientation : std::uint8_t {
  arbitrary,   ///< each by itself, as a fitted plane has no front: neighbours may disagree
  given,       ///< by the caller: those of CloudOptions::normals, or of a mesh's triangles
  viewpoint,   ///< towards the sensor
  consistent,  ///< as their neighbours', and outwards, see orientedFrames()
};

/// Tangent frame of every point. Rows of points that are not active may be zero. The second tangent is
/// cross(normal, tangent).
struct Frames {
  Points normals;                                    ///< N x 3, unit length
  Points tangents;                                   ///< N x 3, unit length
  Orientation orientation = Orientation::arbitrary;  ///< of the normals
};

/// The sides of the triangles of one connected component, before mollification. Each triangle counts its three sides.
struct ComponentEdges {
  std::int64_t sides = 0;  ///< how many there are, those of all copies of a triangle
  double mean = 0;         ///< mean length
  double mean_square = 0;  ///< mean squared length, the unit of smoothing's time step
};

/// A closed ball.
struct Ball {
  Eigen::Vector3d center;  ///< in the caller's unit
  double radius;           ///< in the caller's unit, >= 0
};

/// Builds a cover when it is asked for.
class CoverSource {
 public:
  virtual ~CoverSource() = default;
  /// The tufted cover, which is built by the first call. Any number of threads may call.
  virtual const IntrinsicTriangulation& cover() const = 0;
  /// The mixed area in its own star of each point where the surface ends, N values in length^2, 0 elsewhere: Mass::star
  /// takes it for M wherever it is positive. Size 0 with Mass::cover. Measured again with each call, by all threads of
  /// the build.
  virtual VectorXd starAreas() const { return {}; }
  /// The faces that points in some balls have found, without building the cover: all of them, if the balls are a little
  /// larger than the part of the surface that is asked about. A face that is there more often is appended more often.
  /// @param balls in the caller's unit, of the positions that lengths are measured between
  /// @param[in,out] faces corners are appended, numbered as the caller's points
  /// @param[in,out] length three for each face: from each corner to the next, in the caller's unit
  /// @return false: this source cannot, and nothing was appended
  virtual bool appendFacesNear(const std::vector<Ball>& balls, std::vector<std::array<int, 3>>& faces,
                               std::vector<double>& length) const {
    (void)balls, (void)faces, (void)length;
    return false;
  }
};

/// The Laplacian of a point cloud or a mesh, with what is known about each point.
///
/// L is the weak (integrated) Laplacian: symmetric, positive semidefinite, off-diagonals <= 0, rows sum to 0.
/// L is -Delta integrated: libigl and PMP use the opposite sign. M holds lumped areas.
///   Poisson        L u = M f
///   eigenproblem   L x = lambda M x
/// The faces of the cover count 1/2 (it has a front and a back), on clouds times 1/3 (each triangle is found by its
/// three corners).
struct Laplacian {
  /// What the Laplacian is of. Set by the builds, and by readLaplacian() from the file. A Laplacian that is put
  /// together by hand is taken for a mesh's unless it says otherwise. Frames do not tell: a mesh may have some, and a
  /// cloud none.
  Kind kind = Kind::mesh;
  SparseMatrix L;                   ///< N x N, column-major, compressed, rows ascending; no unit (lengths cancel)
  VectorXd M;                       ///< N areas in length^2, see Mass; their sum approximates the surface area
  VectorXd cover_areas;             ///< N; areas lumped from the faces of the cover, equal to M with Mass::cover
  std::vector<PointStatus> status;  ///< N
  std::vector<int> representative;  ///< N; the point itself unless coincident, then the lowest equal index
  std::vector<Boundary> boundary;   ///< N; why the surface ends at a point, if it does
  /// N; the connected component of L that a point belongs to, 0 for the one of the most active points, then 1, ...; of
  /// equal ones that of the lowest index first. Coincident points have that of their representative, points that are
  /// isolated or not finite -1. Empty where nobody has stored them; see componentLabels().
  std::vector<int> component;
  Frames frames;  ///< set on clouds; 0 x 3 on meshes, where those of meshFrames() may be stored
  /// N x 3, in the caller's unit: where the lengths of edges are measured. The caller's points, bit for bit, but for
  /// noisy ones of a cloud, which are put back onto the surface (CloudSteps::denoise). A point that coincides with
  /// another lies where that one does. 0 x 3 where nobody has stored them.
  Points positions;
  /// N; the standard deviation of the noise around each point that was moved onto the surface (CloudSteps::denoise, or
  /// the smoothing of a depth image), along the normal or the ray, in the caller's unit; 0 at points that stay. Size 0
  /// where no point was moved.
  VectorXd noise;
  /// By component, in the order of `component`, which must be stored with them. Empty where nobody has stored them.
  std::vector<ComponentEdges> component_edges;
  Report report;  ///< what happened in the build, for people: no algorithm looks at it

  /// The tufted cover after flips to intrinsic Delaunay, vertices numbered as the caller's points. On clouds the first
  /// call builds it, which takes at most half as long as the build of L and M, but as long for five million points. Any
  /// number of threads may call.
  /// @throws InvalidInput after `keep_cover = false`
  const IntrinsicTriangulation& cover() const;
  /// Whether cover() has one to give.
  bool hasCover() const { return stored_cover != nullptr || cover_source != nullptr; }

  std::shared_ptr<const IntrinsicTriangulation> stored_cover;  ///< the cover, if it is stored; use cover()
  std::shared_ptr<const CoverSource> cover_source;             ///< builds the cover on demand; use cover()
};

/// Builds the point cloud Laplacian (Sharp and Crane 2020, Section 5.7).
/// @param points N x 3; NaN and infinite rows keep their index and are skipped.
/// @throws InvalidInput for options out of range, arrays of the wrong size, indices of neighbours out of range, a
/// structure beside neighborhoods or one that is not valid (see ScanStructure), Delaunay::cgal without TUFTED_WITH_GPL,
/// more than about 58 million points
/// @throws Cancelled when `options.progress` returns false
Laplacian pointCloudLaplacian(const PointsRef& points, const CloudOptions& options = {});

/// Builds the mesh Laplacian (Sharp and Crane 2020, Algorithm 3), for triangles of any connectivity.
/// @param points V x 3; coincident vertices stay separate unless MeshOptions::weld joins them.
/// @param triangles F x 3 indices into `points`; triangles with a repeated vertex are dropped and counted.
/// @throws InvalidInput for indices or options out of range, more than 357 million triangles or 2^31 entries of L
/// @throws Cancelled when `options.progress` returns false
Laplacian meshLaplacian(const PointsRef& points, const TrianglesRef& triangles, const MeshOptions& options = {});

}  // namespace tufted
