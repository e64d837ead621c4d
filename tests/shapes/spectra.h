#pragma once

#include "tufted/types.h"

namespace tufted::shapes {

/// Eigenvalues of the Laplacian on surfaces where they are known, ascending, each as often as its multiplicity, the
/// zeros included. Boundaries are free (Neumann) unless said otherwise.

VectorXd sphereSpectrum(int count);                                  ///< radius 1: l (l + 1), 2l + 1 times
VectorXd rectangleSpectrum(double width, double height, int count);  ///< pi^2 (i^2 / width^2 + j^2 / height^2)
VectorXd diskSpectrum(int count);                                    ///< radius 1: squared zeros of J'_m
/// Torus of revolution; numeric (Galerkin with Fourier functions), accurate to 1e-10.
VectorXd torusSpectrum(double major_radius, double minor_radius, int count);
/// Unit cube's surface; numeric, relative accuracy 1e-5. 50 values are known.
VectorXd cubeSpectrum(int count);
/// `pages` rectangles, each `width` wide, that meet at one spine of length `height`: functions agree along the spine
/// and their derivatives sum to 0 there. So one copy is free at the spine, pages - 1 copies vanish there.
VectorXd bookSpectrum(int pages, double width, double height, int count);
/// The spectrum of `copies` separate surfaces, each with the given spectrum.
VectorXd repeatedSpectrum(const VectorXd& spectrum, int copies);

struct PoissonProblem {
  VectorXd u, f;  ///< N; -Delta u = f on the surface; u has no particular mean
};
/// Radius 1: u = z exp(x), which no finite number of eigenfunctions adds up to.
PoissonProblem spherePoisson(const Points& points);

}  // namespace tufted::shapes
