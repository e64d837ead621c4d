"""The methods of Surface that solve equations with L, and its gradients."""
import numpy as np

from . import _arguments as check
from . import _tufted
from ._results import Gradients
from ._tufted import InvalidInput


def frames_of(normals, tangents):
    """Frames as N x 3 x 3: the x axis (tangent), the y axis (cross(normal, tangent)) and the normal of each point."""
    return np.stack([tangents, np.cross(normals, tangents), normals], axis=1)


@check.public
class Equations:
    def harmonic(self, pins, values=None, *, progress=None):
        """The harmonic function with given values: L u = 0 at all other points.

        pins: {index: value, ...}, or P indices with `values`, P or P x c.
        Returns N or N x c, within the range of the pinned values; NaN on components without a pin.

        >>> cloud = tufted.PointCloud(points)
        >>> u = cloud.harmonic({0: 1, 5: 3})
        >>> bool(u[0] == 1 and u[5] == 3 and u.max() <= 3)
        True
        """
        return self._interpolate("harmonic", pins, values, progress)

    def biharmonic(self, pins, values=None, *, progress=None):
        """The biharmonic function with given values: it bends least, is smooth at the pins, and may leave their range.

        Arguments and result are those of harmonic().
        """
        return self._interpolate("biharmonic", pins, values, progress)

    def weights(self, handles, *, progress=None):
        """Bounded biharmonic weights, for skinning and blending.

        The weight of a handle is 1 at its points, 0 at those of the others, in [0, 1] elsewhere, and bends least. Then
        the weights of each point are divided by their sum.

        handles: H indices, or H lists of indices.
        Returns N x H, rows of sum 1; NaN on components without a handle.
        """
        sets = [each.tolist() for each in check.lists_of_indices("weights", "handles", handles, len(self))]
        return _tufted.weights(self._laplacian, sets, self._solver(), check.callback("weights", progress))

    def poisson(self, f, pins=None, values=None, *, progress=None):
        """Solves L u = M f: minus the Laplacian of u is f.

        f: N or N x c, finite at active points. Without pins its mean over each component is subtracted.
        pins, values: as in harmonic(), with as many columns as f: there u has the values given.
        Returns the shape of f, without pins with mean 0 over each component; NaN at isolated and non-finite points.
        """
        table, flat = check.columns("poisson", "f", f, len(self))
        progress = check.callback("poisson", progress)
        if pins is None:
            result = self._poisson_solver(progress).poisson(table, progress)
        else:
            where, given, _ = check.pins("poisson", pins, values, len(self))
            solver = self._interpolation_solver("harmonic", where, progress)
            result = solver.poisson(table, given, progress)
        return result[:, 0] if flat else result

    def green(self, points, *, progress=None):
        """Green's functions of points: L g = delta - M / area, with mean 0 over the component.

        points: an index, or c of them.
        Returns N for one index, N x c for several, no unit; 0 on other components, NaN at isolated and non-finite
        points.
        """
        where = check.indices("green", "points", points, len(self))
        progress = check.callback("green", progress)
        result = self._poisson_solver(progress).green(where, progress)
        return result[:, 0] if np.ndim(points) == 0 else result

    def gradients(self, *, neighbors=None, regularization=0.0, progress=None):
        """Matrices that give the slopes of functions on the points, by least squares over neighbours.

        neighbors: number in each fit, >= 3; 0: those in L; None: 30 for clouds, 0 for meshes.
        regularization: >= 0, length^2, added to each fit, as DiffusionNet does with 1e-5; 0: off.
        Returns X and Y (N x N csc_matrix, 1/length), and the frames (N x 3 x 3) along whose first two axes they give
        slopes.
        """
        found = self._gradients(neighbors, regularization, progress)
        return Gradients(check.sparse(found.X, len(self)), check.sparse(found.Y, len(self)),
                         frames_of(found.normals, found.tangents))

    def divergence(self, vectors, *, neighbors=None, regularization=0.0, progress=None):
        """The divergence of tangent vectors, the negative adjoint of gradients() with the same options.

        vectors: N x 2, along the first two axes of the frames of gradients().
        Returns N values, in the unit of the vectors per length.
        """
        table, _ = check.columns("divergence", "vectors", vectors, len(self))
        if table.shape[1] != 2:
            raise InvalidInput(f"divergence: vectors has {table.shape[1]} columns, must have 2")
        return _tufted.divergence(self._laplacian, self._gradients(neighbors, regularization, progress), table)

    def operators(self, k=None, *, neighbors=None, regularization=0.0, progress=None):
        """The operators that networks such as DiffusionNet take, as `tufted operators` writes them.

        k: number of eigenvalues, zeros included; None: 128, or as many as there are. Other arguments as in gradients().
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
        result = self._interpolation_solver(function, where, progress).interpolate(table, progress)
        return result[:, 0] if flat else result

    def _interpolation_solver(self, kind, where, progress):
        return self._keep(kind, lambda: _tufted.InterpolationSolver(
            self._laplacian, where, kind, self._solver(), progress), where.tobytes())

    def _gradients(self, neighbors, regularization, progress):
        if neighbors is not None:
            neighbors = check.whole("gradients", "neighbors", neighbors, 0)
        regularization = check.number("gradients", "regularization", regularization)
        # Folders of older versions have no positions; slopes are then measured between the points.
        points = self.positions if len(self.positions) == len(self) else self._points
        return self._keep("gradients", lambda: _tufted.gradients(
            self._laplacian, points, self._fitted_frames(), neighbors, regularization,
            self._solving["threads"], check.callback("gradients", progress)), (neighbors, regularization))

    def _fitted_frames(self):
        """Frames in whose planes gradients are taken; None: planes are fitted."""
        return None
