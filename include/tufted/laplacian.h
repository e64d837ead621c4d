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
  arbitrary,   ///< each sign by itself, as a fitted plane has no front: neighbours may disagree
  given,       ///< by the caller: as in CloudOptions::normals, or as a mesh's triangles are oriented
  viewpoint,   ///< each normal faces the sensor
  consistent,  ///< neighbours agree and components face outwards, see orientedFrames()
};

/// An orthonormal frame at every point: tangent, cross(normal, tangent), normal. Rows of points that are not active may
/// be zero.
struct Frames {
  Points normals;                                    ///< N x 3, unit length
  Points tangents;                                   ///< N x 3, unit length
  Orientation orientation = Orientation::arbitrary;  ///< how the signs of the normals were chosen
};

/// Lengths of the triangle sides of one connected component, before mollification. Each triangle, and each copy of it
/// on a cloud, counts its three sides.
struct ComponentEdges {
  std::int64_t sides = 0;  ///< number of sides
  double mean = 0;         ///< mean length, in the caller's unit
  double mean_square = 0;  ///< mean squared length; the unit of SmoothingOptions::time_step
};

class CoverSource;

/// The Laplacian of a point cloud or a mesh, with what is known about each point.
///
/// L is the weak (integrated) Laplacian: symmetric, positive semidefinite, off-diagonals <= 0, rows sum to 0.
/// L integrates -Delta: libigl and PMP use the opposite sign. M holds lumped areas.
///   Poisson        L u = M f
///   eigenproblem   L x = lambda M x
/// Each face of the cover counts 1/2, as the cover has a front and a back; on clouds 1/6, as three stars find each
/// triangle.
struct Laplacian {
  /// Whether L is that of a cloud or of a mesh. The builds set it, and readLaplacian() from the file; for a cloud's
  /// Laplacian assembled by hand it must be set. Frames do not decide: a mesh may have some, and a cloud none.
  Kind kind = Kind::mesh;
  SparseMatrix L;                   ///< N x N, column-major, compressed, rows ascending; no unit (lengths cancel)
  VectorXd M;                       ///< N areas in length^2, see Mass; their sum approximates the surface area
  VectorXd cover_areas;             ///< N areas lumped from the faces of the cover; equal to M with Mass::cover
  std::vector<PointStatus> status;  ///< N; why a point does or does not take part
  std::vector<int> representative;  ///< N; the point itself, or of a coincident point the lowest equal index
  std::vector<Boundary> boundary;   ///< N; why the surface ends at a point, if it does
  /// N; label of the connected component of L. Components are numbered from 0 by decreasing number of active points,
  /// equal ones by their lowest index. Coincident points have the label of their representative, isolated and
  /// non-finite points -1. Empty if not stored, see componentLabels().
  std::vector<int> component;
  Frames frames;  ///< set on clouds; 0 x 3 on meshes, where those of meshFrames() may be stored
  /// N x 3, in the caller's unit: the positions between which edge lengths are measured. These are the caller's points
  /// bit for bit, except noisy points of a cloud, which are moved onto the surface (CloudSteps::denoise), and points
  /// that coincide with them. 0 x 3 if not stored.
  Points positions;
  /// N; standard deviation of the noise around each point that was moved onto the surface, along its normal (in a depth
  /// image along its ray), in the caller's unit; 0 at points that were not moved. Size 0 if no point was moved.
  VectorXd noise;
  /// One entry per component, in the order of the labels in `component`, which must be stored too. Empty if not stored.
  std::vector<ComponentEdges> component_edges;
  Report report;  ///< counts and timings of the build, for people: no algorithm reads it

  /// The tufted cover after flips to intrinsic Delaunay; its vertices are the caller's points. On clouds the first call
  /// builds it, in at most half the time of the build of L and M (as long for five million points). Any number of
  /// threads may call.
  /// @throws InvalidInput if there is none, as after `keep_cover = false`
  const IntrinsicTriangulation& cover() const;
  /// Whether cover() can return a cover.
  bool hasCover() const { return cover_source != nullptr; }
  /// Makes cover() return this one, for Laplacians assembled by hand.
  void setCover(IntrinsicTriangulation cover);

  std::shared_ptr<const CoverSource> cover_source;  ///< what cover() returns or builds; null: there is none
};

/// Builds the Laplacian of a point cloud (Sharp and Crane 2020, Section 5.7).
/// @param points N x 3, in any unit of length; points that are not finite keep their index and take no part
/// @return L and M of N points, frames, positions and report; cover() on demand
/// @throws InvalidInput for options out of range, arrays of the wrong size, indices of neighbours out of range, both a
/// structure and neighborhoods, a structure that is not valid (see ScanStructure), Delaunay::cgal without
/// TUFTED_WITH_GPL, or more than about 58 million points
/// @throws Cancelled when `options.progress` returns false
Laplacian pointCloudLaplacian(const PointsRef& points, const CloudOptions& options = {});

/// Builds the Laplacian of a triangle mesh of any connectivity (Sharp and Crane 2020, Algorithm 3).
/// @param points V x 3, in any unit of length; coincident vertices stay separate unless MeshOptions::weld joins them
/// @param triangles F x 3 indices into `points`; those with a repeated or non-finite vertex are dropped and counted
/// @return L and M of V points, positions and report, without frames; see meshFrames()
/// @throws InvalidInput for indices or options out of range, more than 357 million triangles or 2^31 entries of L
/// @throws Cancelled when `options.progress` returns false
Laplacian meshLaplacian(const PointsRef& points, const TrianglesRef& triangles, const MeshOptions& options = {});

}  // namespace tufted
