"""The part of Surface that solves equations with L, and has matrices for others."""
import numpy as np

from . import _arguments as check
from . import _tufted
from ._results import Gradients
from ._tufted import InvalidInput


def frames_of(normals, tangents):
    """N x 3 x 3: of each point the x axis, the y axis and the normal."""
    return np.stack([tangents, np.cross(normals, tangents), normals], axis=1)


class Equations:
    def harmonic(self, pins, values=None, *, progress=None):
        """The smoothest function with given values: L u = 0 at all other points.

        pins: {index: value, ...}, or P indices with `values`, P or P x c.
        Returns N or N x c, within the range of the pinned values; NaN in components without a pin.
        """
        return self._interpolate("harmonic", pins, values, progress)

    def biharmonic(self, pins, values=None, *, progress=None):
        """The function of least bending with given values: smooth at the pins, but not bounded by them.

        Arguments and result are those of harmonic().
        """
        return self._interpolate("biharmonic", pins, values, progress)

    def weights(self, handles, *, progress=None):
        """Bounded biharmonic weights, for skinning and blending.

        handles: H points, or H lists of points. Each handle's weight is 1 at its points, 0 at those of the others,
        between 0 and 1 elsewhere, and bends the least; those of a point are divided by their sum.
        Returns N x H; NaN on components without a handle.
        """
        if not hasattr(handles, "__len__") or isinstance(handles, (str, bytes)):
            raise InvalidInput("weights: handles must be a list of points, or of lists of points")
        sets = [check.indices("weights", "handles", handle, len(self)).tolist() for handle in handles]
        return _tufted.weights(self._laplacian, sets, self._solver(), check.callback("weights", progress))

    def poisson(self, f, pins=None, values=None, *, progress=None):
        """Solves L u = M f: minus the Laplacian of u is f.

        f: N or N x c, finite at active points; its mean over each component is subtracted.
        pins, values: as in harmonic(), with as many columns as f: then f keeps its mean, and u has the values given.
        Returns the shape of f, with mean 0 over each component unless pinned; NaN at points that take no part.
        """
        table, flat = check.columns("poisson", "f", f, len(self))
        progress = check.callback("poisson", progress)
        if pins is None:
            result = self._poisson_solver(progress).poisson(table, progress)
        else:
            where, given, _ = check.pins("poisson", pins, values, len(self))
            solver = self._interpolation_solver("poisson", "harmonic", where, progress)
            result = solver.poisson(table, given, progress)
        return result[:, 0] if flat else result

    def green(self, points, *, progress=None):
        """Green's function of points: L g = delta - M / area, with mean 0 over the component.

        points: an index, or c of them.
        Returns N for one index, N x c for several; 0 in other components, NaN at points that take no part.
        """
        where = check.indices("green", "points", points, len(self))
        progress = check.callback("green", progress)
        result = self._poisson_solver(progress).green(where, progress)
        return result[:, 0] if np.ndim(points) == 0 else result

    def gradients(self, *, neighbors=None, regularization=0.0, progress=None):
        """Matrices that give the slopes of functions on the points, by least squares over neighbours.

        neighbors: in each fit; None: 30 for clouds, those in L for meshes.
        regularization: length^2 added to the fits, which DiffusionNet does with 1e-5.
        Returns X and Y (N x N csc_matrix, 1/length), and the frames (N x 3 x 3) along whose first two axes they are.
        """
        found = self._gradients(neighbors, regularization, progress)
        return Gradients(check.sparse(found.X, len(self)), check.sparse(found.Y, len(self)),
                         frames_of(found.normals, found.tangents))

    def divergence(self, vectors, *, neighbors=None, regularization=0.0, progress=None):
        """The divergence of tangent vectors, minus the adjoint of gradients() with the same options.

        vectors: N x 2, along the first two axes of the frames of gradients().
        Returns N.
        """
        table, _ = check.columns("divergence", "vectors", vectors, len(self))
        if table.shape[1] != 2:
            raise InvalidInput(f"divergence: vectors has {table.shape[1]} columns, must have 2")
        return _tufted.divergence(self._laplacian, self._gradients(neighbors, regularization, progress), table)

    def operators(self, k=None, *, neighbors=None, regularization=0.0, progress=None):
        """What networks such as DiffusionNet take, as `tufted operators` writes it.

        k: number of eigenvalues, those that are 0 among them; None: 128, or as many as there are.
        Returns a dict of frames (N x 3 x 3), mass (N), L, gradX, gradY (N x N csc_matrix), evals (k), evecs (N x k).
        """
        slopes = self.gradients(neighbors=neighbors, regularization=regularization, progress=progress)
        pairs = self.spectrum(self._count(k, 128, True), progress=progress)
        return {"frames": slopes.frames, "mass": self.M, "L": self.L, "evals": pairs.values, "evecs": pairs.vectors,
                "gradX": slopes.X, "gradY": slopes.Y}

    def _poisson_solver(self, progress):
        return self._keep("poisson", lambda: _tufted.PoissonSolver(self._laplacian, self._solver(), progress))

    def _interpolate(self, function, pins, values, progress):
        where, table, flat = check.pins(function, pins, values, len(self))
        progress = check.callback(function, progress)
        result = self._interpolation_solver(function, function, where, progress).interpolate(table, progress)
        return result[:, 0] if flat else result

    def _interpolation_solver(self, function, kind, where, progress):
        with check.named(function):
            return self._keep(kind, lambda: _tufted.InterpolationSolver(
                self._laplacian, where, kind, self._solver(), progress), where.tobytes())

    def _gradients(self, neighbors, regularization, progress):
        if neighbors is not None:
            neighbors = check.whole("gradients", "neighbors", neighbors, 0)
        regularization = check.number("gradients", "regularization", regularization)
        # Older folders do not have the positions, where noisy points were moved.
        points = self.positions if len(self.positions) == len(self) else self._points
        return self._keep("gradients", lambda: _tufted.gradients(
            self._laplacian, points, self._fitted_frames(), neighbors, regularization,
            self._solving["threads"], check.callback("gradients", progress)), (neighbors, regularization))

    def _fitted_frames(self):
        """Planes in which gradients are taken; None: fitted ones."""
        return None
