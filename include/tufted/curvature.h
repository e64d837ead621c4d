#pragma once

#include <cstdint>

#include "tufted/laplacian.h"
#include "tufted/options.h"
#include "tufted/types.h"

namespace tufted {

/// How curvature is computed.
enum class CurvatureMethod {
  fit,        ///< from a quadratic fitted over the tangent plane to some rings of neighbours
  laplacian,  ///< mean curvature only, from L x = 2 H n M; does not converge at single points of a random cloud: on a
              ///< torus and half a cylinder its error stays at 7 to 10 % of the greatest curvature however large N is
};

/// Options of curvatures().
struct CurvatureOptions {
  CurvatureMethod method = CurvatureMethod::fit;  ///< how curvature is computed
  /// Rings of neighbours that every quadratic is fitted to, 0 to 100; 0: two, and more where denoising moved the
  /// points, as the noise requires. A noisy mesh, or a noisy cloud built without denoising, wants 5 to 12.
  int rings = 0;
  int threads = 0;         ///< at most this many threads; 0: one per processor
  Progress progress = {};  ///< called with the fraction of the points that are begun
};

/// Counts and timing of a call of curvatures().
struct CurvatureReport {
  /// Active points whose neighbours lie on a line or a conic, so that no quadratic is determined; all their values are
  /// 0.
  std::int64_t undetermined = 0;
  double mean_rings = 0;  ///< rings of neighbours in the fits, on average over the active points
  double seconds = 0;     ///< wall-clock
};

/// Curvature of the surface at each point; 0 at points that are not active, and coincident points have that of their
/// representative. A curvature is positive where the surface bends away from the normal, as on a sphere with outward
/// normals.
struct Curvatures {
  VectorXd mean;      ///< N; mean curvature H = (k1 + k2) / 2, 1 / length
  VectorXd gaussian;  ///< N; Gaussian curvature K = k1 k2, 1 / length^2; size 0 with CurvatureMethod::laplacian
  Eigen::MatrixX2d
      principal;           ///< N x 2; principal curvatures k1 >= k2, 1 / length; 0 rows with CurvatureMethod::laplacian
  Points first;            ///< N x 3; unit direction of k1, of any sign; 0 x 3 with CurvatureMethod::laplacian
  Points second;           ///< N x 3; unit direction of k2, perpendicular to `first`; 0 x 3 if that is
  CurvatureReport report;  ///< counts and timing
};

/// Computes curvatures from Laplacian::positions and the neighbours in L, so that points of other sheets are not used.
///
/// At each point heights over its tangent plane are fitted to two rings of neighbours, with weights that fall with
/// distance. Where denoising moved the points (Laplacian::noise), windows of three to twelve rings are tried, and the
/// widest is used whose result is within the confidence intervals of all smaller ones: wide enough for the noise,
/// narrow enough for the surface (intersection of confidence intervals; Goldenshluger and Nemirovski 1997). Heights are
/// changed in the fourth order, so that a window of any width fits a sphere exactly. Curvatures are those of the fitted
/// surface.
/// @param laplacian with positions, and with frames, as a cloud's, whose normals give curvatures their sign; see
/// orientedFrames()
/// @throws InvalidInput for arrays of the wrong size, a Laplacian without positions or frames, active points whose
/// positions or frames are not finite, or options out of range
/// @throws SolverFailure when the Gaussian curvature overflows, at extents below 1e-150 or so
/// @throws Cancelled when `options.progress` returns false
Curvatures curvatures(const Laplacian& laplacian, const CurvatureOptions& options = {});
/// Computes curvatures with the caller's frames, for meshes those of meshFrames(); otherwise as without.
/// @param frames N x 3 each, orthonormal at active points
Curvatures curvatures(const Laplacian& laplacian, const Frames& frames, const CurvatureOptions& options = {});

}  // namespace tufted
