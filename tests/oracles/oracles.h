#pragma once

#include <array>
#include <vector>

#include "tufted/types.h"

/// Results of other libraries, or of the simplest code possible, to compare the library with. For tests only.
namespace tufted::oracles {

/// Convex hull as triangles of points, oriented outwards (CGAL::convex_hull_3). For points on a convex surface it is
/// their intrinsic Delaunay triangulation up to second order.
Triangles convexHullMesh(const Points& points);

struct Operators {
  SparseMatrix L;
  VectorXd M;
};
/// The plain cotan matrix, with negative weights, and a third of the triangles' areas per corner. Triangles without
/// area are skipped.
Operators cotanLaplacian(const Points& points, const Triangles& triangles);

/// The cotan matrix and areas after intrinsic flips in long double, one edge after the other until all are Delaunay.
/// There is no mollification, so triangles must have areas in the end.
/// @param triangles closed, oriented and manifold
/// @throws std::runtime_error if they are not
Operators flippedLaplacian(const Points& points, const Triangles& triangles);

struct Spectrum {
  VectorXd values;          ///< ascending
  Eigen::MatrixXd vectors;  ///< N x k, M-orthonormal; zero on inactive points
};
/// The k smallest eigenvalues of L x = lambda M x by shift-and-invert with Spectra. Points with empty rows in L and no
/// mass are left out. Sylvester's law checks that none is missing.
/// @throws std::runtime_error if an eigenvalue is missing or a residual is too large
Spectrum smallestEigenpairs(const SparseMatrix& L, const VectorXd& M, int k);
VectorXd smallestEigenvalues(const SparseMatrix& L, const VectorXd& M, int k);

enum class Precision { usual, extended };
/// All eigenvalues of L x = lambda M x, ascending, by dense matrices of double or long double. Points without mass are
/// eliminated; those with empty rows in L and no mass are left out.
VectorXd denseEigenvalues(const SparseMatrix& L, const VectorXd& M, Precision precision = Precision::usual);

/// Mean of |computed - analytic| / analytic over as many first values as both have, without analytic zeros.
double meanRelativeError(const VectorXd& computed, const VectorXd& analytic);

struct PlanarStar {
  std::vector<std::array<int, 2>> triangles;  ///< (i, j): the triangle of the origin and rows i and j; counterclockwise
  bool closed = false;                        ///< whether the origin is inside of the convex hull
};
/// The star of the origin in the Delaunay triangulation of the origin and `points` (CGAL), without rows that equal the
/// origin or an earlier row.
PlanarStar delaunayStarOracle(const Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>& points);

struct Topology {
  int components = 0;            ///< sets of triangles connected by vertices
  int boundary_edges = 0;        ///< edges of one triangle
  int nonmanifold_edges = 0;     ///< edges of three or more triangles
  int nonmanifold_vertices = 0;  ///< vertices around which triangles form several fans
  bool orientable = true;        ///< whether triangles can be oriented consistently across edges of two
  int euler = 0;                 ///< referenced vertices - edges + triangles
};
/// Triangles with a repeated vertex are left out.
Topology topology(const Triangles& triangles);

double surfaceArea(const Points& points, const Triangles& triangles);

}  // namespace tufted::oracles
