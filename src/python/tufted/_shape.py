"""The methods of Surface about its shape, and those that move its points."""
import warnings

import numpy as np

from . import _arguments as check
from . import _tufted
from ._results import Curvature, Deformation, MinimalSurface, Parameterization, Segments, TuftedWarning
from ._tufted import InvalidInput


@check.public
class Shape:
    def normals(self, *, viewpoint=None, up=None, progress=None):
        """Normals of one sign on each component: they agree with their neighbours' and point outwards, or face a
        viewpoint.

        viewpoint: position that normals face, 3 values; None: the one that the cloud was built with, if any.
        up: direction that the mean normal of an open sheet has, 3 values, as such a sheet has no outside; None: it
        faces the way it bulges. With `up`, the viewpoint of the build is ignored.
        Returns N x 3, unit length.
        """
        return self._signed_frames(viewpoint, progress, up)[0]

    def curvature(self, *, method="fit", rings=None, progress=None):
        """Curvature at each point, positive where the surface bends away from the normal of normals().

        method: "fit" of a quadratic to rings of neighbours, or "laplacian": mean curvature only.
        rings: of neighbours in each "fit", 1 to 100; None: two, and more where denoising moved the points. A noisy
            mesh, or a noisy cloud built without denoising, wants 5 to 12.
        Returns mean (N, 1/length), gaussian (N, 1/length^2), principal (N x 2, k1 >= k2, 1/length) and directions (N x
        2 x 3, of k1 and k2); all but the first are empty with "laplacian".
        """
        rings = 0 if rings is None else check.whole("curvature", "rings", rings, 1)
        method, progress = check.text("curvature", "method", method), check.callback("curvature", progress)
        mean, gaussian, principal, first, second = _tufted.curvature(
            self._laplacian, *self._signed_frames(None, progress), method, rings,
            self._solving["threads"], progress)
        return Curvature(mean, gaussian, principal, np.stack([first, second], axis=1))

    def segments(self, count=None, *, method="voronoi", seeds=None, crease=0.08, least_points=100, progress=None):
        """Cuts the surface into segments.

        count: number of segments, >= 1; None: 8, or as many as possible. Ignored with seeds; not for "parts".
        method: "voronoi": geodesic cells of points far from each other; "spectral": parts that narrow necks join;
        "parts": parts between concave creases, as of things on a table, as many as there are.
        seeds: active points whose Voronoi cells are the segments.
        crease, least_points: for "parts": by how many radians over one spacing a normal turns inwards at a crease, > 0;
        sets of fewer points between creases, >= 1, go to the parts around them.
        Returns labels (N int32, 0 for the segment of the largest area, -1 in none), areas (length^2) and seeds (empty
        but with "voronoi").
        """
        count = None if count is None else check.whole("segments", "count", count, 1)
        where = np.zeros(0, np.int32) if seeds is None else check.indices("segments", "seeds", seeds, len(self))
        crease = check.number("segments", "crease", crease)
        least_points = check.whole("segments", "least_points", least_points, 1)
        method, progress = check.text("segments", "method", method), check.callback("segments", progress)
        if method == "voronoi":
            self._need_cover("segments")
        frames = self._signed_frames(None, progress) if method == "parts" else self._frame_parts()
        return Segments(*_tufted.segments(self._laplacian, *frames, method, count, where, crease, least_points,
                                          self._solver(), progress))

    def smooth(self, points=None, *, method="implicit", time_step=1.0, lambda_=0.5, mu=-0.53, iterations=1, fixed=None,
               keep_volume=False, progress=None):
        """Smooths positions.

        points: N x 3; None: those of this surface.
        method: "implicit" steps of the heat equation, in which shapes shrink, or "taubin": steps towards the mean of
        the neighbours, by lambda_, and back, by mu, in which they hardly shrink.
        time_step: of "implicit", >= 0, in mean squared edge lengths of each component. lambda_: in (0, 1]; mu: in [-1,
        0].
        iterations: number of steps, >= 1. fixed: N booleans; points with True stay in place.
        keep_volume: whether each component, which must be closed, is scaled to the volume it had; not with fixed.
        Returns N x 3.
        """
        points = self._points if points is None else check.rows_of_three("smooth", "points", points, len(self))
        fixed = self._marks("smooth", fixed)
        time_step = check.number("smooth", "time_step", time_step)
        iterations = check.whole("smooth", "iterations", iterations, 1)
        method, progress = check.text("smooth", "method", method), check.callback("smooth", progress)
        keep_volume = check.flag("smooth", "keep_volume", keep_volume)
        if method == "implicit" and not keep_volume:
            solver = self._keep("smooth", lambda: _tufted.SmoothingSolver(
                self._laplacian, time_step, fixed, self._solver(), progress),
                (time_step, None if fixed is None else fixed.tobytes()))
            return solver.smooth(points, iterations, progress)
        return _tufted.smooth(
            self._laplacian, points, method, time_step, check.number("smooth", "lambda_", lambda_),
            check.number("smooth", "mu", mu), iterations, fixed, self._surface_faces("smooth") if keep_volume else None,
            self._solving["threads"], progress)

    def smooth_values(self, values, *, method="implicit", time_step=1.0, lambda_=0.5, mu=-0.53, iterations=1,
                      fixed=None, progress=None):
        """Smooths functions on the points.

        values: N or N x c, finite at active points. method, time_step, lambda_, mu, iterations: as in smooth().
        fixed: N booleans; points with True keep their values.
        Returns the shape of values.
        """
        table, flat = check.columns("smooth_values", "values", values, len(self))
        result = _tufted.smooth_values(
            self._laplacian, table, check.text("smooth_values", "method", method),
            check.number("smooth_values", "time_step", time_step),
            check.number("smooth_values", "lambda_", lambda_), check.number("smooth_values", "mu", mu),
            check.whole("smooth_values", "iterations", iterations, 1), self._marks("smooth_values", fixed),
            self._solving["threads"], check.callback("smooth_values", progress))
        return result[:, 0] if flat else result

    def mean_curvature_flow(self, *, steps=10, time_step=0.01, progress=None):
        """Moves the points by the conformalised mean curvature flow (Kazhdan, Solomon, Ben-Chen 2012), which turns a
        closed surface without handles into a sphere and, unlike the flow itself, pinches no necks. Each step solves
        (M + t L) x = M x_old with the areas M of the moved triangles and the L of this surface.

        steps: number of steps, >= 1. Coarse samples drift away from the sphere again after tens of steps, so stop
        when a step changes little. time_step: t, > 0, as a share of the area of each connected component.
        Returns N x 3, each component scaled about its middle so that its area stays; isolated and non-finite points,
        and components without area, keep their place. Raises SolverFailure if a step cannot be solved.

        >>> egg = tufted.PointCloud(points * [2, 1, 1])
        >>> ball = egg.mean_curvature_flow(steps=30, time_step=0.05)
        >>> radius = np.linalg.norm(ball, axis=1)
        >>> bool(radius.std() < 0.02 * radius.mean())
        True
        """
        steps = check.whole("mean_curvature_flow", "steps", steps, 1)
        time_step = check.number("mean_curvature_flow", "time_step", time_step)
        progress = check.callback("mean_curvature_flow", progress)
        return _tufted.mean_curvature_flow(self._laplacian, self._surface_faces("mean_curvature_flow"), time_step, steps,
                                           self._solver(), progress)

    def parameterize(self, *, method="conformal", weights="laplacian", rim=None, rim_positions=None, cuts=None,
                     progress=None):
        """Lays the surface out in the plane.

        method: "conformal" preserves angles as well as possible and leaves the rim free; "harmonic" has the rim on a
        circle of radius 1 or at rim_positions, and each other point is a mean of its neighbours.
        weights: of harmonic maps: those of the "laplacian", or "mean-value", which flip no triangle.
        rim: of harmonic maps: the points of the rim in order; None: that of the triangles. rim_positions: one row u, v
        for each.
        cuts: paths along edges, a list of points for each, along which the surface is cut open to a disk. A point on a
        cut has several places, so uv then is F x 3 x 2, for the corners of faces or of triangles(). Not with rim, and
        for harmonic maps with mean-value weights alone.
        Returns uv (N x 2, NaN where a point has no place), quasi_conformal_error (1: angles are preserved), triangles
        (how many were laid out), flipped and collapsed (how many of these are flipped, or lower than 1e-7 of the map)
        and not_mapped (points where uv is NaN).
        Raises InvalidInput also where a conformal map collapses more than a thousandth of the area, as of long tubes.
        """
        where = np.zeros(0, np.int32) if rim is None else check.indices("parameterize", "rim", rim, len(self))
        places = np.zeros((0, 2))
        if rim_positions is not None:
            places, _ = check.columns("parameterize", "rim_positions", rim_positions, where.size)
            if places.shape[1] != 2:
                raise InvalidInput(f"parameterize: rim_positions has {places.shape[1]} columns, must have 2")
        if cuts is not None:
            cuts = check.lists_of_indices("parameterize", "cuts", cuts, len(self))
        result = Parameterization(*_tufted.parameterize(
            self._laplacian, self._surface_faces("parameterize"), check.text("parameterize", "method", method),
            check.text("parameterize", "weights", weights), where, places, cuts,
            self._solver(), check.callback("parameterize", progress)))
        if cuts is not None:
            result = result._replace(uv=result.uv.reshape(-1, 3, 2))
        if result.collapsed > 0:
            warnings.warn(f"parameterize: {result.collapsed} triangles are lower in the plane than 1e-7 of the map",
                          TuftedWarning, stacklevel=3)
        return result

    def minimal_surface(self, fixed=None, *, tolerance=1e-4, max_iterations=300, progress=None):
        """The surface of least area that its rim, or given points, span.

        fixed: the points that stay in place; None: those of the rim.
        tolerance: iterations stop when no point moves off the surface by more than this part of its extent, or after
        max_iterations.
        Returns points (N x 3), their area, and whether iterations converged.
        """
        where = np.zeros(0, np.int32) if fixed is None else check.indices("minimal_surface", "fixed", fixed, len(self))
        return MinimalSurface(*_tufted.minimal_surface(
            self._laplacian, self._surface_faces("minimal_surface"), where,
            check.number("minimal_surface", "tolerance", tolerance),
            check.whole("minimal_surface", "max_iterations", max_iterations, 1), self._solver(),
            check.callback("minimal_surface", progress)))

    def deform(self, handles, targets, *, method="rigid", smoothness=1e-3, tolerance=1e-3, max_iterations=500,
               progress=None):
        """Moves some points to given places, and lets all others follow.

        handles: P indices. targets: P x 3, the new places of the handles.
        method: "rigid", as rigid as possible: neighbourhoods rotate smoothly and hardly stretch; "linear": two solves,
        for small rotations.
        smoothness: of "rigid", >= 0: cost of bending, as a share of the area; 0: none.
        tolerance: of "rigid": iterations stop when no point moves by more than this part of the longest way of a
        handle, or after max_iterations.
        Returns points (N x 3), stretch (root mean square change of edges, relative to their lengths), and whether
        iterations converged.
        """
        where = check.indices("deform", "handles", handles, len(self))
        places = check.rows_of_three("deform", "targets", targets, where.size)
        smoothness = check.number("deform", "smoothness", smoothness)
        tolerance = check.number("deform", "tolerance", tolerance)
        max_iterations = check.whole("deform", "max_iterations", max_iterations, 1)
        progress = check.callback("deform", progress)
        settings = check.text("deform", "method", method), smoothness, tolerance, max_iterations
        solver = self._keep("deform", lambda: _tufted.DeformationSolver(
            self._laplacian, where, *settings, self._solver(), progress), (where.tobytes(), *settings))
        return Deformation(*solver.deform(places, progress))

    def _marks(self, function, fixed):
        """`fixed`, N booleans, as bytes; None stays None."""
        if fixed is None:
            return None
        fixed = check.array(function, "fixed", fixed)
        if fixed.shape != (len(self),):
            raise InvalidInput(f"{function}: fixed has {fixed.size} values, must have {len(self)}, one per point")
        return np.ascontiguousarray(fixed.astype(bool), dtype=np.uint8)
