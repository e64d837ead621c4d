#pragma once

#include "bench/scan_case.h"

namespace tufted::bench {

/// Mean relative error of the first `count` eigenvalues of L x = lambda M x after the first zero.
double spectrumError(const Build& build, int count);
/// Mean relative error of the first `count` eigenvalues after the first zero, of the cotan Laplacian of the convex hull
/// of the sample's points.
double hullSpectrumError(const Sample& sample, int count);

/// |u - f / 12| / |f / 12| in the norm of M, for L u = M f on the unit sphere with the spherical harmonic f = x y z of
/// degree 3, whose eigenvalue is 12; u and f without their means.
double poissonError(const Build& build);
double hullPoissonError(const Sample& sample);

double areaError(const Build& build);      ///< sum(M) / the surface's area - 1
double gridAreaError(const Build& build);  ///< sum(M) / the area between the noise-free rays - 1

/// Components of L without the entries between rays that hit different surfaces, so that a surface in pieces counts
/// several times even if other surfaces connect the pieces.
double componentsOfSurfaces(const Build& build);
/// Share of the inner rays whose star is closed and complete.
double closedInnerStars(const Build& build);
/// For rooms of lidar(): share of the area of the union of stars in triangles between bodies that the scanner sees one
/// behind the other, see shapes::crossesJump().
double areaAcrossJumps(const Build& build);
/// Share of the area of the union of stars in triangles whose corners do not all belong to the room's shell, to the box
/// or to the pole.
double mixedBodies(const Build& build);
/// Triangles of the union of stars, all copies counted, whose corners do not all have one label.
double bridges(const Build& build);
/// Triangles of the union of stars, all copies counted, that have a corner more than a twentieth farther along z than
/// another, and an edge along which pixels jump, see shapes::jumpsBetween(), so that it is not just a slanted surface.
double trianglesAcrossJumps(const Build& build);

double boundaryRecall(const Build& build);     ///< share of rim points that are tagged
double boundaryPrecision(const Build& build);  ///< share of tagged points that are rim points

/// Share of the pixels beside edges of a depth image that have a tag of one kind, or touch a pixel with it: at the
/// steps of a slanted edge not every pixel is tagged.
/// @param kind rim or jump
double imageRecall(const Build& build, Boundary kind);
/// Share of the tags of one kind in a depth image that are at most two pixels from an edge.
/// @param kind rim or jump
double imagePrecision(const Build& build, Boundary kind);

/// Share of the points active in the core's build whose row of L equals the core's up to 1e-6 of its diagonal.
double equalRows(const Build& build);
/// Share of the points active in the core's build whose row of L has the same columns as the core's.
double equalColumns(const Build& build);

/// Number of broken guarantees, lines of brokenGuarantees().
double brokenPromises(const Build& build);

}  // namespace tufted::bench
