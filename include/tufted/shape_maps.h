#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "tufted/laplacian.h"
#include "tufted/options.h"
#include "tufted/spectrum.h"

namespace tufted {

/// A shape of maps between two shapes. Both parts are borrowed.
struct MappedShape {
  const Laplacian& laplacian;  ///< of the shape, with its positions
  const Spectrum& spectrum;    ///< its first eigenpairs, eigenvalues 0 included
};

/// Options of functionalMap().
struct FunctionalMapOptions {
  int k = 30;  ///< number of eigenpairs, zeros included, >= 1; fewer if a spectrum has fewer
  /// >= 0; larger values ask more for a map that commutes with the Laplacians. On samples of the pairs in
  /// tests/python/test_maps.py with the seeds 1 to 7, maps are best from 0.01 to 0.1; with less they follow differences
  /// of the samples, with more they lose the descriptors.
  double commutativity = 3e-2;
  /// Functions on the source, N x D, in any unit, such as signatures at times in proportion to the areas; without
  /// columns: wave kernel signatures at energies that both spectra have.
  Eigen::MatrixXd source_descriptors = {};
  Eigen::MatrixXd target_descriptors = {};  ///< the corresponding functions on the target, N' x D
  VectorXd weights = {};                    ///< D factors >= 0 of the misfits of descriptors; empty: ones
  /// Pairs of a point of the source and the corresponding one of the target, which take part: adds wave kernels around
  /// them.
  std::vector<std::array<int, 2>> landmarks = {};
  Progress progress = {};  ///< called for each row of the map
};

/// Finds the functional map from one shape to another (Ovsjanikov, Ben-Chen, Solomon, Butscher, Guibas 2012): C that
/// minimises |C A - B|^2 / D + commutativity |C E - E' C|^2 / e^2. A and B are the coefficients of the D descriptors,
/// scaled to norm 1, E and E' the diagonal matrices of the eigenvalues, e the largest of them. Each row of C solves a
/// system of its own. Both shapes are scaled to area 1, so they may have different units.
///
/// A shape that is its own mirror image has two maps of equal cost, and the one found may be the mirrored one, or a
/// mixture: some landmarks off the plane of symmetry decide.
/// @return C, k x k: from the coefficients of a function on the source to those on the target, in bases of norm 1
/// @throws InvalidInput for arrays of the wrong size, options out of range, an area of 0, fewer than two positive
/// eigenvalues, descriptors that are not finite at points that take part or that are all 0, or landmarks out of range
/// or that take no part
/// @throws Cancelled when `options.progress` returns false
Eigen::MatrixXd functionalMap(const MappedShape& source, const MappedShape& target,
                              const FunctionalMapOptions& options = {});

/// Options of zoomOut().
struct ZoomOutOptions {
  int k = 100;   ///< number of eigenpairs at the end; fewer if a spectrum has fewer
  int step = 1;  ///< eigenpairs that each turn adds, >= 1; larger values are faster
  /// At most so many points of the target, or 2 k if that is more, evenly spread, take part in the turns, and ten times
  /// as many of the source, a third of whose spacing is near enough; fewer where points are uneven; 0: all.
  int samples = 1000;
  int threads = 0;         ///< at most this many threads; 0: one per processor
  Progress progress = {};  ///< called in each turn
};

/// Refines a map between two shapes by ZoomOut (Melzi, Ren, Rodola, Sharma, Wonka, Ovsjanikov 2019): in turn the map
/// from point to point of a functional map, and the functional map with more eigenpairs of that.
/// @param C of functionalMap(); one of options.k rows or more is returned as it is
/// @return k x k
/// @throws InvalidInput for arrays of the wrong size, no positions, options out of range, area 0 or an infinite C
/// @throws Cancelled when `options.progress` returns false
Eigen::MatrixXd zoomOut(const MappedShape& source, const MappedShape& target, const Eigen::MatrixXd& C,
                        const ZoomOutOptions& options = {});
/// Refines a map that is given from point to point.
/// @param to_source for each point of the target one of the source, negative for none; at least one is given
Eigen::MatrixXd zoomOut(const MappedShape& source, const MappedShape& target, const std::vector<int>& to_source,
                        const ZoomOutOptions& options = {});

/// Maps from point to point in both directions, -1 at points that take no part.
struct PointMaps {
  std::vector<int> to_target;  ///< N, a point of the target for each of the source
  std::vector<int> to_source;  ///< N', a point of the source for each of the target
};

/// The maps from point to point that a functional map stands for: C carries points of the source into the space
/// of the target's coefficients, and the nearest ones there correspond (Ovsjanikov et al. 2012, Section 6.1). Values on
/// the source are carried to the target by `to_source`.
/// @param C k x k, of functionalMap() or zoomOut()
/// @param threads at most this many; 0: one per processor
/// @throws InvalidInput for arrays of the wrong size, an area of 0, or a C that is not finite
/// @throws Cancelled when `progress` returns false
PointMaps pointMaps(const MappedShape& source, const MappedShape& target, const Eigen::MatrixXd& C, int threads = 0,
                    const Progress& progress = {});

}  // namespace tufted
