#pragma once

#include <array>
#include <vector>

#include "tufted/types.h"

/// Answers from other people's code, or from the simplest code there is, to compare the library with. Tests only.
namespace tufted::oracles {

/// Convex hull as triangles over the rows of `points`, outwards (CGAL::convex_hull_3). For points on a convex surface
/// it is their intrinsic Delaunay triangulation up to second order.
Triangles convexHullMesh(const Points& points);

struct Operators {
  SparseMatrix L;
  VectorXd M;
};
/// The plain cotan matrix (negative weights kept) and a third of the area per corner. Triangles without area are
/// skipped.
Operators cotanLaplacian(const Points& points, const Triangles& triangles);

/// The cotan matrix and areas after plain intrinsic flips: one edge after the other, first in, first out, with no end
/// but that all are Delaunay, in long doubles. Without lengthening, so triangles must have areas at the end.
/// @param triangles closed, oriented and manifold; else std::runtime_error is thrown
Operators flippedLaplacian(const Points& points, const Triangles& triangles);

struct Spectrum {
  VectorXd values;          ///< ascending
  Eigen::MatrixXd vectors;  ///< N x k, M-orthonormal; zero on inactive points
};
/// The k smallest eigenvalues of L x = lambda M x by shift and invert with Spectra. Rows with L = 0 and M = 0 do not
/// take part. The number below the largest one is checked by Sylvester's law, so no multiple eigenvalue is missed;
/// residuals are checked too, and std::runtime_error tells when a check fails.
Spectrum smallestEigenpairs(const SparseMatrix& L, const VectorXd& M, int k);
VectorXd smallestEigenvalues(const SparseMatrix& L, const VectorXd& M, int k);

enum class Precision { usual, extended };
/// All eigenvalues of L x = lambda M x by dense matrices of doubles or of long doubles, ascending. Points without mass
/// are eliminated; rows with L = 0 and M = 0 do not take part.
VectorXd denseEigenvalues(const SparseMatrix& L, const VectorXd& M, Precision precision = Precision::usual);

/// Mean of |computed - analytic| / analytic over the first min(sizes) values, analytic zeros left out.
double meanRelativeError(const VectorXd& computed, const VectorXd& analytic);

struct PlanarStar {
  std::vector<std::array<int, 2>> triangles;  ///< (i, j): the triangle origin, row i, row j; in order, counterclockwise
  bool closed = false;                        ///< the origin is not on the convex hull
};
/// Star of the origin in the Delaunay triangulation of the origin and the rows of `points` (CGAL). Rows that equal the
/// origin or an earlier row do not occur.
PlanarStar delaunayStarOracle(const Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>& points);

struct Topology {
  int components = 0;            ///< of the triangles, connected through vertices
  int boundary_edges = 0;        ///< edges of one triangle
  int nonmanifold_edges = 0;     ///< edges of three or more
  int nonmanifold_vertices = 0;  ///< several fans of triangles
  bool orientable = true;        ///< at the edges of two triangles
  int euler = 0;                 ///< referenced vertices - edges + triangles
};
/// Triangles with a repeated vertex are left out.
Topology topology(const Triangles& triangles);

/// Sum of the triangles' areas.
double surfaceArea(const Points& points, const Triangles& triangles);

}  // namespace tufted::oracles
