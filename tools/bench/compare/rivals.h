#pragma once

#include <functional>
#include <string>
#include <vector>

#include "oracles/oracles.h"
#include "tufted/options.h"
#include "tufted/types.h"

/// Other Laplacians of clouds and meshes, written plainly, to compare ours with. All have our sign and scale: L is
/// integrated, so that L u approximates -Delta u times the area of each point, and M holds areas. Rows of points at
/// which a method gives nothing are empty.
namespace tufted::bench {

using oracles::Operators;

/// Mixed areas (Meyer et al. 2003) of points in their Delaunay stars in the tangent plane: of the Voronoi cell, but not
/// beyond the triangles of the star.
VectorXd starAreas(const Points& points);

/// Belkin, Sun and Wang 2009 (for meshes 2008): row p is the integral of exp(-d^2 / 4t) / (4 pi t^2) (u(p) - u(q)) over
/// a Delaunay triangulation of the k neighbours in the tangent plane of p. Not symmetric, as each row has its own
/// areas.
Operators belkinLaplacian(const Points& points, int k);

/// Liu, Prabhakaran and Guo 2012: the same kernel times the areas of both points, which makes it symmetric.
Operators liuLaplacian(const Points& points, int k);

/// The graph Laplacian of the k nearest neighbours, joined if either names the other, with heat weights (Belkin and
/// Niyogi 2003). M is uniform, the sum of starAreas() over N. L has the scale at which the three coordinates have
/// together their Dirichlet energy on a surface, twice its area.
Operators graphLaplacian(const Points& points, int k);

/// Cotan weights of each point from its own Delaunay star only (Clarenz et al. 2004, Cao et al. 2010). Not symmetric.
Operators localCotanLaplacian(const Points& points, int k);

/// The mean of the two weights that localCotanLaplacian() has for a pair.
Operators meanCotanLaplacian(const Points& points, int k);

/// Moving least squares of order 2 (Liang and Zhao 2013): the surface and the function are quadratics over the tangent
/// plane, through the point itself. Not symmetric.
Operators leastSquaresLaplacian(const Points& points, int k);

/// Ours, by one thread.
Operators tuftedLaplacian(const Points& points, CloudOptions options, int k);

/// A Laplacian of clouds.
struct CloudRival {
  std::string name;
  int k;  ///< the number of neighbours with the least error, see cloudRivals()
  bool symmetric;
  std::function<Operators(const Points&, int k)> build;
};
/// All of the above, the paper's union, and ours.
std::vector<CloudRival> cloudRivals();

/// A Laplacian of meshes.
struct MeshRival {
  std::string name;
  /// @throws std::runtime_error where the method does not apply
  std::function<Operators(const Points&, const Triangles&)> build;
};
/// Cotan weights, intrinsic Delaunay (Bobenko and Springborn 2007) and ours.
std::vector<MeshRival> meshRivals();

}  // namespace tufted::bench
