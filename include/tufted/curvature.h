#pragma once

#include <cstdint>

#include "tufted/laplacian.h"
#include "tufted/options.h"
#include "tufted/types.h"

namespace tufted {

/// How curvature is found.
enum class CurvatureMethod {
  fit,        ///< of a surface fitted over the tangent plane to as many rings of neighbours as the noise asks for
  laplacian,  ///< mean curvature alone, from L x = 2 H n M; does not converge at single points of a random cloud: it
              ///< stays 7 to 10 % of the greatest curvature off on a torus and on half a cylinder, however many points
              ///< there are
};

/// Options of curvatures().
struct CurvatureOptions {
  CurvatureMethod method = CurvatureMethod::fit;  ///< how curvature is found
  int threads = 0;                                ///< at most this many; 0: one per processor
  Progress progress = {};                         ///< called with the fraction of the points that are begun
};

/// What curvatures() did.
struct CurvatureReport {
  /// Active points whose neighbours lie on a line or a conic, so that no quadric is determined; all of theirs is 0.
  std::int64_t undetermined = 0;
  double mean_rings = 0;  ///< rings of neighbours in the fits, on average over the active points
  double seconds = 0;     ///< wall-clock
};

/// Curvature of the surface at each point; 0 at points that are not active, coincident ones as their representative.
/// A curvature is positive where the surface bends away from the normal, as a sphere does with outward normals.
struct Curvatures {
  VectorXd mean;      ///< N; H = (k1 + k2) / 2, 1 / length
  VectorXd gaussian;  ///< N; K = k1 k2, 1 / length^2; size 0 with CurvatureMethod::laplacian
  Eigen::MatrixX2d
      principal;           ///< N x 2; principal curvatures k1 >= k2, 1 / length; 0 rows with CurvatureMethod::laplacian
  Points first;            ///< N x 3; unit direction of k1, of any sign; 0 x 3 with CurvatureMethod::laplacian
  Points second;           ///< N x 3; that of k2, perpendicular to the first; 0 x 3 with CurvatureMethod::laplacian
  CurvatureReport report;  ///< what happened
};

/// Curvature from Laplacian::positions and the neighbours in L, so that nothing of another sheet is taken.
///
/// At each point heights over its tangent plane are fitted with weights that fall with the distance, first to two rings
/// of neighbours (four where there is noise), then to more, as long as what they say lies within the errors of what
/// fewer rings have said: wide enough for the noise, narrow enough for the surface (intersection of confidence
/// intervals; Goldenshluger and Nemirovski 1997). Where fits leave over rounding alone, the first window is taken.
/// Heights are quadratic in coordinates as long as the distance in space, so that a sphere is fitted exactly by a
/// window of any width. Curvatures are those of the fitted surface.
/// @param laplacian with positions, and frames, as that of a cloud has; orientedFrames() makes the signs consistent
/// @throws InvalidInput for arrays of the wrong size, a Laplacian without positions or frames, positions or frames of
/// active points that are not finite, or options out of range
/// @throws Cancelled when `options.progress` returns false
Curvatures curvatures(const Laplacian& laplacian, const CurvatureOptions& options = {});
/// Curvature with the caller's frames, otherwise as above: for meshes those of meshFrames().
Curvatures curvatures(const Laplacian& laplacian, const Frames& frames, const CurvatureOptions& options = {});

}  // namespace tufted
