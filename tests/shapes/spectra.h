#pragma once

#include "tufted/types.h"

namespace tufted::shapes {

/// Known eigenvalues of the Laplacian on surfaces, ascending, with multiplicity and zeros. Boundary conditions are
/// Neumann unless stated otherwise.

VectorXd sphereSpectrum(int count);                                  ///< radius 1: l (l + 1), 2l + 1 times
VectorXd rectangleSpectrum(double width, double height, int count);  ///< pi^2 (i^2 / width^2 + j^2 / height^2)
VectorXd diskSpectrum(int count);                                    ///< radius 1: squared zeros of J'_m
/// Torus of revolution; numeric (Galerkin with Fourier functions), accurate to 1e-10.
VectorXd torusSpectrum(double major_radius, double minor_radius, int count);
/// Unit cube's surface; numeric, relative accuracy 1e-5. 50 values are known.
VectorXd cubeSpectrum(int count);
/// `pages` rectangles of width `width` that meet at one spine of length `height`: functions agree on the spine and
/// their normal derivatives sum to 0. So one copy has Neumann conditions there, pages - 1 copies have Dirichlet
/// conditions.
VectorXd bookSpectrum(int pages, double width, double height, int count);
/// The spectrum of `copies` separate surfaces, each with the given spectrum.
VectorXd repeatedSpectrum(const VectorXd& spectrum, int copies);

struct PoissonProblem {
  VectorXd u, f;  ///< N; -Delta u = f on the surface; u has no particular mean
};
/// On the sphere of radius 1: u = z exp(x), which is no finite sum of eigenfunctions.
PoissonProblem spherePoisson(const Points& points);

}  // namespace tufted::shapes
