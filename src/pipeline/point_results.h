#pragma once

#include "base/buffer.h"
#include "base/parallel.h"
#include "base/point_buffer.h"
#include "neighbors/morton.h"
#include "tufted/laplacian.h"

namespace tufted {

// Sets what the result of a cloud has per point besides L and M, in the caller's order.

/// Sets boundary and normals; coincident points take the normal of their representative.
/// @param boundary by rank
/// @param normals n x 3, by rank
void setBoundaryAndNormals(const Buffer<Boundary>& boundary, const PointsView& normals, const RankedCloud& cloud,
                           const Workers& workers, Laplacian& result);

/// Sets Laplacian::positions: the caller's points, or where they were moved.
void setPositions(const PointsRef& points, const RankedCloud& cloud, const Workers& workers, Laplacian& result);

/// Sets the noise around moved points.
/// @param noise by rank, see CloudSurface::noise
void setNoise(const RawBuffer<double>& noise, const RankedCloud& cloud, Laplacian& result);

/// Turns normals towards the viewpoint.
void faceViewpoint(const Eigen::Vector3d& viewpoint, const Workers& workers, Laplacian& result);

/// Sets the tangents; zero where the normal is zero.
void setTangents(const Workers& workers, Laplacian& result);

/// Replaces M by the own areas where these are positive and the point has a row.
/// @param own by rank, in units of 4^exponent of the caller's; may be empty
/// @param input_index the caller's index of each rank
void setOwnAreas(const RawBuffer<double>& own, const Buffer<int>& input_index, int exponent, Laplacian& result);

}  // namespace tufted
