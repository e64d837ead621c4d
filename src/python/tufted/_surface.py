"""What clouds and meshes have in common: L and M, and all that is computed from them."""
import html

import numpy as np

from . import _arguments as check
from . import _tufted
from ._results import (Curvature, Deformation, Gradients, LogMap, MinimalSurface, Parameterization, Path, Segments,
                       Spectrum)
from ._tufted import InvalidInput

# Points that a notebook shows: a page of more would make its file larger than some ten megabytes.
_LARGEST_PAGE = 500_000


def _frames(normals, tangents):
    """N x 3 x 3: of each point the x axis, the y axis and the normal."""
    return np.stack([tangents, np.cross(normals, tangents), normals], axis=1)


class Surface:
    """L and M of a cloud or a mesh, and all that is computed from them. Made by PointCloud, Mesh, read and load.

    Arrays that show the library's own memory (L, M, status, ...) cannot be written to; take a copy to change one.
    What is costly to make, a factor or a spectrum, is kept, so a second call with the same options is quick; of the
    factors for given pins, and for smoothing, the last one. Methods may run in several threads at once. All take
    `progress`, a function of a stage's name and the fraction of it that is done, which stops the computation by
    returning False; Ctrl-C stops it as well.
    """

    def __init__(self, laplacian, points, faces, solving, options=None, geometry=None, source=""):
        self._laplacian = laplacian
        self._points = points
        self._faces = faces
        self._solving = solving  # solver, memory_limit, threads
        self._options = options  # of the build, where they are known; report.json has them
        self._geometry = geometry
        self._source = source
        self._kept = {}

    # What is known

    @property
    def points(self):
        """The points, N x 3 float64, in the caller's unit of length."""
        return self._points

    @property
    def L(self):
        """Minus the Laplacian, integrated: N x N csc_matrix, symmetric, positive semidefinite, off-diagonals <= 0."""
        return self._keep("L", lambda: check.sparse(self._laplacian.L, len(self)))

    @property
    def M(self):
        """The area of each point, N float64, length^2. scipy.sparse.diags(M) is the matrix."""
        return self._laplacian.M

    @property
    def status(self):
        """Why a point takes part or not, N uint8: 0 active, 1 not finite, 2 coincident, 3 isolated."""
        return self._laplacian.status

    @property
    def representative(self):
        """The point that stands for a coincident one, else the point itself; N int32."""
        return self._laplacian.representative

    @property
    def components(self):
        """The connected component of each point, N int32; 0 has the most points, -1: takes no part."""
        return self._laplacian.component

    @property
    def boundary(self):
        """Why the surface ends at a point, N uint8: 0 it does not, 1 rim, 2 depth jump, 3 triangles are missing."""
        return self._laplacian.boundary

    @property
    def positions(self):
        """Where lengths are measured, N x 3 float64: the points, noisy ones of a cloud put back onto the surface."""
        return self._laplacian.positions

    @property
    def frames(self):
        """Tangent frames, N x 3 x 3 float64: of each point the x axis, the y axis and the normal."""
        return self._keep("frames", lambda: _frames(*self._frame_parts()))

    @property
    def report(self):
        """What happened in the build: counts, lengths, areas and stages, as a dict."""
        return self._laplacian.report

    def __len__(self):
        return len(self._points)

    def __repr__(self):
        report = self.report
        size = f"{len(self):,} points"
        if self._faces is not None:
            size += f", {len(self._faces):,} faces"
        if report["active"] != len(self):
            size += f" ({report['active']:,} take part)"
        count = report["components"]
        return (f"<tufted.{type(self).__name__}: {size}, {count:,} component{'' if count == 1 else 's'}, "
                f"area {report['area']:.6g}>")

    def _repr_html_(self):
        if len(self) > _LARGEST_PAGE:
            return f"<pre>{html.escape(repr(self))}</pre>"
        labels = self.components.astype(np.float64).reshape(-1, 1)
        boundary = self.boundary.astype(np.float64).reshape(-1, 1) - 1  # none is grey
        fields = [("area of a point", "positive", self.M.reshape(-1, 1), "", [], ""),
                  ("component", "label", labels, "", [], ""),
                  ("boundary", "label", boundary, "", ["rim", "jump", "lost"], "none")]
        faces = np.zeros((0, 3), np.int32) if self._faces is None else self._faces
        page = _tufted.page(self._source or f"tufted.{type(self).__name__}", self._points, faces,
                            self._frame_parts()[0], fields)
        # The page runs by itself: what it may do in a notebook ends at its frame.
        return (f'<iframe srcdoc="{html.escape(page)}" sandbox="allow-scripts allow-downloads" width="100%" '
                f'height="480" style="border: 0" title="{html.escape(repr(self))}"></iframe>')

    def __getstate__(self):
        return {"laplacian": _tufted.state_of(self._laplacian), "points": self._points, "faces": self._faces,
                "solving": self._solving, "options": self._options, "source": self._source}

    def __setstate__(self, state):
        Surface.__init__(self, _tufted.from_state(state["laplacian"]), state["points"], state["faces"],
                         state["solving"], state["options"], None, state["source"])

    # Spectrum

    def spectrum(self, k=32, *, null_space=True, tolerance=1e-10, progress=None):
        """The k smallest eigenvalues of L x = lambda M x, with their vectors.

        The null space is exact: the eigenvalue 0 for each component. Vectors are M-orthonormal, and their largest entry
        is positive.

        k: number of pairs, less than the number of active points.
        null_space: False leaves out the eigenvalues 0.
        tolerance: relative accuracy of vectors, in (0, 1).
        Returns values (k, ascending, 1/length^2) and vectors (N x k, 1/length; 0 at points that take no part).
        """
        pairs = self._pairs(k, null_space, tolerance, progress)
        return Spectrum(pairs.values, pairs.vectors)

    def hks(self, times=None, *, k=100, samples=16, spectrum=None, progress=None):
        """The heat kernel signature of every point: sum of exp(-lambda t) phi(x)^2 over the pairs of a spectrum.

        times: T times, length^2; None: `samples` of them, for which k pairs suffice.
        k: number of positive eigenvalues to take; at most as many as there are.
        spectrum: what spectrum() returned, to be used instead of k.
        Returns N x T, 1/length^2.
        """
        pairs = self._positive("hks", k, spectrum, progress)
        if times is None:
            times = _tufted.heat_times(pairs, check.whole("hks", "samples", samples, 1))
        else:
            times = check.columns("hks", "times", times, np.size(times))[0].reshape(-1)
        return _tufted.hks(self._laplacian, pairs, times)

    def wks(self, energies=None, *, width=None, k=100, samples=100, spectrum=None, progress=None):
        """The wave kernel signature of every point.

        energies: E logarithms of eigenvalues; None: `samples` of them between those of the spectrum.
        width: standard deviation of the energy; None: seven times the distance between the first two energies.
        k, spectrum: as in hks().
        Returns N x E, 1/length^2.
        """
        pairs = self._positive("wks", k, spectrum, progress)
        if energies is None:
            return _tufted.wks(pairs, check.whole("wks", "samples", samples, 2))
        energies = check.columns("wks", "energies", energies, np.size(energies))[0].reshape(-1)
        if width is None:
            if energies.size < 2:
                raise InvalidInput("wks: width = None, must be given for fewer than two energies")
            width = 7 * abs(energies[1] - energies[0])
        return _tufted.wks_at(pairs, energies, check.number("wks", "width", width))

    def embed(self, dimension=3, *, distance="commute", progress=None):
        """Coordinates of every point between which Euclidean distances are spectral distances.

        dimension: number of coordinates, one per positive eigenvalue.
        distance: "commute" (commute times, no unit) or "biharmonic" (length).
        Returns N x dimension.
        """
        pairs = self._pairs(check.whole("embed", "dimension", dimension, 1), False, 1e-10, progress)
        return _tufted.embed(pairs, distance)

    def filter(self, values, *, k=100, gain=None, spectrum=None, progress=None):
        """A low-pass filter: keeps what the means over components and the first k eigenvectors hold.

        values: N or N x c, finite at active points.
        gain: a function of an eigenvalue (1/length^2), the factor of its vector; None: 1.
        k, spectrum: as in hks().
        Returns the shape of values; points that are not finite or isolated keep theirs.
        """
        table, flat = check.columns("filter", "values", values, len(self))
        if gain is not None and not callable(gain):
            raise InvalidInput(f"filter: gain = {gain!r}, must be None or a function of an eigenvalue")
        result = _tufted.filter(self._laplacian, self._positive("filter", k, spectrum, progress), table, gain)
        return result[:, 0] if flat else result

    # Distances and what is carried along the surface

    def distance(self, sources=(), *, faces=None, barycentric=None, method="marching", split=None, maximum=None,
                 time_step=None, unit=None, open_boundary=None, progress=None):
        """Geodesic distance from the nearest of some points.

        sources: an index or several.
        faces, barycentric: S faces of a mesh and S x 3 coordinates by corner: points inside triangles, as sources too.
        method: "marching" through the triangles, the more accurate one, or "heat", smooth where fronts meet.
        split: of marching, how often each triangle is cut into four, 0 to 2; None: twice up to 5,000 points, else once.
        maximum: greater distances are infinite; None: no limit.
        time_step: of heat, in `unit`; larger ones smooth; None: 0.5. unit: of heat, "mean" squared edge (None) or
        "adapted" to uneven density. open_boundary: of heat, whether it passes the boundary as if the surface went on;
        None: True.
        Returns N values >= 0, length; infinite where no path leads.
        """
        places = self._places("distance", sources, faces, barycentric)
        solver = self._distance_solver(method, split, maximum, time_step, unit, open_boundary, progress)
        return solver.query(places, check.callback("distance", progress))

    def nearest_source(self, sources=(), *, faces=None, barycentric=None, method="marching", split=None, maximum=None,
                       time_step=None, unit=None, open_boundary=None, progress=None):
        """The nearest of some points along the surface: their geodesic Voronoi cells.

        Arguments are those of `distance`: sources, faces and barycentric; method, split, maximum, and time_step, unit and
        open_boundary of heat.
        Returns N distances and N numbers: which of the sources is nearest, first `sources`, then `faces`, counted from
        0; -1 where none leads.
        """
        places = self._places("nearest_source", sources, faces, barycentric)
        solver = self._distance_solver(method, split, maximum, time_step, unit, open_boundary, progress)
        return solver.nearest(places, check.callback("nearest_source", progress))

    def points_within(self, sources, radius, *, split=None, progress=None):
        """The points whose distance along the surface from the nearest of some points is at most a radius.

        sources: an index or several. radius: length.
        split: as in `distance`, whose values by marching these are.
        Returns (points, distances): K indices, ascending, and K values, length. On a cloud nothing but the surface
        around the sources is looked at.
        """
        self._need_cover("points_within")
        where = check.indices("points_within", "sources", sources, len(self))
        return _tufted.points_within(self._laplacian, where, check.number("points_within", "radius", radius),
                                     None if split is None else check.whole("points_within", "split", split, 0),
                                     check.callback("points_within", progress))

    def path(self, start, end, *, progress=None):
        """The shortest path between two points, straight across the triangles.

        start, end: indices.
        Returns (points, length): K x 3, from start to end, and the length along the surface. Points on different
        components are refused.
        """
        self._need_cover("path")
        ends = [check.indices("path", name, point, len(self)) for name, point in (("start", start), ("end", end))]
        for name, point in zip(("start", "end"), ends):
            if point.size != 1:
                raise InvalidInput(f"path: {name} has {point.size} indices, must be one")
        solver = self._keep("path", lambda: _tufted.PathSolver(
            self._laplacian, self._solver(), check.callback("path", progress)))
        return Path(*solver.path(int(ends[0][0]), int(ends[1][0]), check.callback("path", progress)))

    def extend(self, sources, values, *, time_step=4.0, progress=None):
        """Values of some points carried to all: nearly those of the nearest source.

        sources: S indices. values: S or S x c, finite.
        time_step: in squared mean edges; larger ones mix more.
        Returns N or N x c; NaN where no path leads.
        """
        where = check.indices("extend", "sources", sources, len(self))
        table, flat = check.columns("extend", "values", values, where.size)
        time_step = check.number("extend", "time_step", time_step)
        progress = check.callback("extend", progress)
        solver = self._keep(("extend", time_step), lambda: _tufted.ExtensionSolver(
            self._laplacian, time_step, self._solver(), progress))
        result = solver.query(where, table, progress)
        return result[:, 0] if flat else result

    def transport(self, sources, vectors, *, time_step=4.0, progress=None):
        """Tangent vectors of some points carried to all, parallel along the shortest paths.

        sources: S indices. vectors: S x 3, projected into the tangent planes of their points.
        Returns N x 3 tangent vectors; 0 where no path leads.
        """
        where = check.indices("transport", "sources", sources, len(self))
        vectors = check.rows_of_three("transport", "vectors", np.atleast_2d(vectors), where.size)
        time_step = check.number("transport", "time_step", time_step)
        progress = check.callback("transport", progress)
        solver = self._keep(("transport", time_step), lambda: _tufted.TransportSolver(
            self._laplacian, *self._frame_parts(), time_step, self._solver(), progress))
        return solver.query(where, vectors, progress)

    def log_map(self, source, *, axis=None, time_step=4.0, progress=None):
        """The logarithmic map: in which direction, and how far, each point lies from one.

        source: index of an active point.
        axis: direction of the first coordinate, 3 values; None: the x axis of the point's frame.
        Returns coordinates (N x 2, length; NaN where no path leads) and axes (2 x 3, their directions at the source).
        """
        where = check.indices("log_map", "source", source, len(self))
        if where.size != 1:
            raise InvalidInput(f"log_map: source has {where.size} indices, must be one")
        self._need_cover("log_map")
        time_step = check.number("log_map", "time_step", time_step)
        progress = check.callback("log_map", progress)
        axis = np.zeros(3) if axis is None else check.vector_of_three("log_map", "axis", axis)
        solver = self._keep(("log_map", time_step), lambda: _tufted.LogMapSolver(
            self._laplacian, *self._signed_frames(), time_step, self._solver(), progress))
        coordinates, first, second = solver.query(int(where[0]), axis, progress)
        return LogMap(coordinates, np.vstack([first, second]))

    def signed_distance(self, curve, *, time_step=4.0, progress=None):
        """Distance from a curve on the surface, positive to its left seen from the side of the normals.

        curve: indices of the points along it, in order; the last is the first again where it is closed. It may have
        gaps, across which the distance goes on smoothly.
        time_step: of the heat that carries directions, in mean squared distances of neighbours.
        Returns N values in the points' unit; NaN on components without a part of the curve.
        """
        where = check.indices("signed_distance", "curve", curve, len(self))
        time_step = check.number("signed_distance", "time_step", time_step)
        progress = check.callback("signed_distance", progress)
        solver = self._keep(("signed_distance", time_step), lambda: _tufted.SignedDistanceSolver(
            self._laplacian, *self._signed_frames(), time_step, self._solver(), progress))
        return solver.query(where, progress)

    # Equations

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
                         _frames(found.normals, found.tangents))

    def divergence(self, vectors, *, neighbors=None, regularization=0.0, progress=None):
        """The divergence of tangent vectors, minus the adjoint of gradients() with the same options.

        vectors: N x 2, along the first two axes of the frames of gradients().
        Returns N.
        """
        table, _ = check.columns("divergence", "vectors", vectors, len(self))
        if table.shape[1] != 2:
            raise InvalidInput(f"divergence: vectors has {table.shape[1]} columns, must have 2")
        return _tufted.divergence(self._laplacian, self._gradients(neighbors, regularization, progress), table)

    def operators(self, k=128, *, neighbors=None, regularization=0.0, progress=None):
        """What networks such as DiffusionNet take, as `tufted operators` writes it.

        Returns a dict of frames (N x 3 x 3), mass (N), L, gradX, gradY (N x N csc_matrix), evals (k), evecs (N x k).
        """
        slopes = self.gradients(neighbors=neighbors, regularization=regularization, progress=progress)
        pairs = self.spectrum(k, progress=progress)
        return {"frames": slopes.frames, "mass": self.M, "L": self.L, "evals": pairs.values, "evecs": pairs.vectors,
                "gradX": slopes.X, "gradY": slopes.Y}

    # Shape

    def normals(self, *, viewpoint=None, progress=None):
        """Normals of one sign on each component: as their neighbours' and outwards, or towards a viewpoint.

        viewpoint: 3 values; None: the one that the cloud was built with, if any.
        Returns N x 3, unit length.
        """
        return self._signed_frames(viewpoint, progress)[0]

    def curvature(self, *, method="fit", progress=None):
        """Curvature at each point, with the normals of normals().

        method: "fit" of a surface to as many neighbours as the noise asks for, or "laplacian", mean curvature alone.
        Returns mean (N, 1/length), gaussian (N, 1/length^2), principal (N x 2, k1 >= k2, 1/length) and directions
        (N x 2 x 3, of k1 and of k2); all but the first are empty with "laplacian".
        """
        progress = check.callback("curvature", progress)
        mean, gaussian, principal, first, second = _tufted.curvature(
            self._laplacian, *self._signed_frames(None, progress), method, self._solving["threads"], progress)
        return Curvature(mean, gaussian, principal, np.stack([first, second], axis=1))

    def segments(self, count=8, *, method="voronoi", seeds=None, progress=None):
        """Cuts the surface into segments.

        count: how many, >= 1; not used with seeds.
        method: "voronoi" cells of points far from each other, or "spectral" parts that narrow necks join.
        seeds: points whose Voronoi cells are the segments.
        Returns labels (N int32, 0 for the largest segment, -1: none), areas (length^2) and seeds (empty with
        "spectral").
        """
        count = check.whole("segments", "count", count, 1)
        where = np.zeros(0, np.int32) if seeds is None else check.indices("segments", "seeds", seeds, len(self))
        if method != "spectral":
            self._need_cover("segments")
        return Segments(*_tufted.segments(self._laplacian, method, count, where, self._solver(),
                                          check.callback("segments", progress)))

    # New places of the points

    def smooth(self, points=None, *, method="implicit", time_step=1.0, lambda_=0.5, mu=-0.53, iterations=1, fixed=None,
               keep_volume=False, progress=None):
        """Smooths positions.

        points: N x 3; None: the own ones. method: "implicit" steps of the heat equation, which shrink, or "taubin": a
        step towards the mean of the neighbours, by lambda_, then one away from it, by mu, which hardly shrink.
        time_step: of implicit steps, >= 0, in mean squared edges. lambda_: in (0, 1]; mu: in [-1, 0].
        iterations: steps >= 1. fixed: N booleans; points with True stay in place.
        keep_volume: scale each component, which must be closed, to the volume it had.
        Returns N x 3.
        """
        points = self._points if points is None else check.rows_of_three("smooth", "points", points, len(self))
        fixed = self._marks("smooth", fixed)
        time_step = check.number("smooth", "time_step", time_step)
        iterations = check.whole("smooth", "iterations", iterations, 1)
        progress = check.callback("smooth", progress)
        if method == "implicit" and not keep_volume:
            key = time_step, None if fixed is None else fixed.tobytes()
            solver = self._keep_last("smooth", key, lambda: _tufted.SmoothingSolver(
                self._laplacian, time_step, fixed, self._solver(), progress))
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
            self._laplacian, table, method, check.number("smooth_values", "time_step", time_step),
            check.number("smooth_values", "lambda_", lambda_), check.number("smooth_values", "mu", mu),
            check.whole("smooth_values", "iterations", iterations, 1), self._marks("smooth_values", fixed),
            self._solving["threads"], check.callback("smooth_values", progress))
        return result[:, 0] if flat else result

    def parameterize(self, *, method="conformal", weights="laplacian", rim=None, rim_positions=None, progress=None):
        """Lays the surface out in the plane.

        method: "conformal" keeps angles as well as can be, with a free rim; "harmonic" has the rim on a circle of
        radius 1 or where rim_positions puts it, and each other point is a mean of its neighbours.
        weights: of harmonic maps: of the "laplacian", or "mean-value", which flip no triangle.
        rim: of harmonic maps: the points of the rim in order; None: found. rim_positions: one row u, v for each.
        Returns uv (N x 2, NaN where a point has no place), quasi_conformal_error (1: angles are kept), and how many
        triangles were laid out and how many of them are flipped.
        """
        where = np.zeros(0, np.int32) if rim is None else check.indices("parameterize", "rim", rim, len(self))
        places = np.zeros((0, 2))
        if rim_positions is not None:
            places, _ = check.columns("parameterize", "rim_positions", rim_positions, where.size)
            if places.shape[1] != 2:
                raise InvalidInput(f"parameterize: rim_positions has {places.shape[1]} columns, must have 2")
        return Parameterization(*_tufted.parameterize(
            self._laplacian, self._surface_faces("parameterize"), method, weights, where, places, self._solver(),
            check.callback("parameterize", progress)))

    def minimal_surface(self, fixed=None, *, tolerance=1e-4, max_iterations=300, progress=None):
        """The surface of the least area that its rim, or given points, span.

        fixed: the points that stay in place; None: those of the rim. tolerance: iterations end where no point moves off
        the surface by more than this part of its extent, or after max_iterations.
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

        handles: P indices. targets: P x 3, where they shall lie.
        method: "rigid", as rigid as possible: neighbourhoods turn smoothly and hardly stretch; or "linear", for small
        turns.
        smoothness: of "rigid": how much bending costs, as part of the area; 0: nothing.
        tolerance: of "rigid": iterations end where no point moves by more than this part of the longest way of a
        handle, or after max_iterations. The factor for the last handles is kept.
        Returns points (N x 3), by how much edges stretch in their length, and whether iterations converged.
        """
        where = check.indices("deform", "handles", handles, len(self))
        places = check.rows_of_three("deform", "targets", targets, where.size)
        smoothness = check.number("deform", "smoothness", smoothness)
        tolerance = check.number("deform", "tolerance", tolerance)
        max_iterations = check.whole("deform", "max_iterations", max_iterations, 1)
        progress = check.callback("deform", progress)
        solver = self._keep_last("deform", (where.tobytes(), method, smoothness, tolerance, max_iterations),
                                 lambda: _tufted.DeformationSolver(self._laplacian, where, method, smoothness,
                                                                   tolerance, max_iterations, self._solver(),
                                                                   progress))
        return Deformation(*solver.deform(places, progress))

    def nearest(self, positions, *, progress=None):
        """The active points nearest to positions.

        positions: P x 3, or 3 values for one.
        Returns P indices, or one.
        """
        single = np.ndim(positions) == 1
        found = _tufted.nearest(self._laplacian, self._points,
                                check.rows_of_three("nearest", "positions", np.atleast_2d(positions)),
                                check.callback("nearest", progress))
        return int(found[0]) if single else found

    def validate(self, *, progress=None):
        """Checks what is promised of L and M: symmetry, signs, sums, definiteness, and every weight against the cover.

        Returns a dict: ok, faults (a sentence for each broken promise), not_checked, and what was measured.
        """
        return _tufted.validate(self._laplacian, check.callback("validate", progress))

    def restricted_to(self, components="largest", *, progress=None):
        """The surface of some components alone; all other points are isolated, and keep their index.

        components: "largest", a label of `components`, or several.
        """
        if isinstance(components, str):
            if components != "largest":
                raise InvalidInput(f"restricted_to: components = '{components}', must be 'largest' or labels")
            components = 0
        labels = check.integers("restricted_to", "components", components).reshape(-1)
        restricted = type(self).__new__(type(self))
        laplacian = self._laplacian.restricted_to(labels.tolist(), check.callback("restricted_to", progress))
        Surface.__init__(restricted, laplacian, self._points, self._faces, self._solving, self._options,
                         self._geometry, self._source)
        return restricted

    def save(self, directory, *, formats=("npz", "ply"), sign="psd", dummy=False, progress=None):
        """Writes what `tufted laplacian` writes with the same options, all files or none.

        formats: of npz, mtx, mat, spmat, ply, pcd, cover, triangles. "cover" lets load() compute distances, too.
        sign: of L in the files: "psd" as here, or "igl", negated.
        dummy: whether points that take no part get values on the diagonals, for full rank.
        """
        formats = [formats] if isinstance(formats, str) else list(formats)
        geometry = self._geometry or _tufted.Geometry(self._points, self._faces)
        _tufted.save(directory, self._laplacian, geometry, formats, self._source, sign, bool(dummy), self._options,
                     check.callback("save", progress))

    # Helpers

    def _keep(self, key, make):
        """What `make` returns, made by the first call with this key. Threads that come at once may make it twice."""
        if key not in self._kept:
            self._kept[key] = make()
        return self._kept[key]

    def _keep_last(self, name, key, make):
        """What `make` returns, made anew where `key` is not that of the last call. For factors of which every key has
        another one, and which would fill the memory."""
        kept = self._kept.get(name)
        if kept is None or kept[0] != key:
            kept = self._kept[name] = key, make()
        return kept[1]

    def _solver(self):
        return _tufted.Solving(**self._solving)

    def _need_cover(self, function):
        if not self._laplacian.has_cover:
            raise InvalidInput(f"{function}: the cover is missing, must be saved: formats=('npz', 'ply', 'cover')")

    def _surface_faces(self, function):
        """The triangles of a mesh, or those found on a cloud."""
        if self._faces is None:
            self._need_cover(function)
        return self._keep("faces", self.triangles)

    def _marks(self, function, fixed):
        """N booleans as bytes, or None."""
        if fixed is None:
            return None
        fixed = np.asarray(fixed)
        if fixed.shape != (len(self),):
            raise InvalidInput(f"{function}: fixed has {fixed.size} values, must have {len(self)}, one per point")
        return np.ascontiguousarray(fixed.astype(bool), dtype=np.uint8)

    def _frame_parts(self):
        """Normals and tangents."""
        return self._laplacian.normals, self._laplacian.tangents

    def _signed_frames(self, viewpoint=None, progress=None):
        """Normals and tangents whose signs agree."""
        orientation = self._orientation()
        if viewpoint is None and orientation == 2:  # towards the sensor
            return self._frame_parts()
        progress = check.callback("normals", progress)
        if viewpoint is not None:
            viewpoint = check.vector_of_three("normals", "viewpoint", viewpoint)
            return _tufted.oriented_frames(self._laplacian, *self._frame_parts(), orientation, viewpoint, progress)
        return self._keep("signed frames", lambda: _tufted.oriented_frames(
            self._laplacian, *self._frame_parts(), orientation, None, progress))

    def _orientation(self):
        return self._laplacian.orientation

    def _pairs(self, k, null_space, tolerance, progress):
        k = check.whole("spectrum", "k", k, 1)
        tolerance = check.number("spectrum", "tolerance", tolerance)
        return self._keep(("spectrum", k, bool(null_space), tolerance), lambda: _tufted.spectrum(
            self._laplacian, k, bool(null_space), tolerance, self._solver(), check.callback("spectrum", progress)))

    def _positive(self, function, k, spectrum, progress):
        """Pairs of positive eigenvalues: the caller's, or the first k."""
        if spectrum is None:
            most = _tufted.most_eigenpairs(self._laplacian, False)
            if most < 1:
                raise InvalidInput(f"{function}: no eigenvalue is positive, must be one: too few points take part")
            return self._pairs(min(check.whole(function, "k", k, 1), most), False, 1e-10, progress)
        values, vectors = spectrum
        vectors, _ = check.columns(function, "spectrum", vectors, len(self))
        return _tufted.Spectrum(np.asarray(values, np.float64), vectors).positive()

    def _places(self, function, sources, faces, barycentric):
        where = check.indices(function, "sources", sources, len(self), empty=faces is not None)
        inside, coordinates = np.zeros(0, np.int32), np.zeros((0, 3))
        if faces is not None:
            if self._faces is None:
                raise InvalidInput(f"{function}: faces is given, must be None for a cloud")
            inside = check.indices(function, "faces", faces, len(self._faces))
            coordinates = check.rows_of_three(function, "barycentric",
                                              np.atleast_2d(() if barycentric is None else barycentric), inside.size)
        corners = self._faces if self._faces is not None else np.zeros((0, 3), np.int32)
        return _tufted.surface_points(where, self._points, corners, inside, coordinates)

    def _distance_solver(self, method, split, maximum, time_step, unit, open_boundary, progress):
        self._need_cover("distance")
        if method == "marching":
            for name, value in (("time_step", time_step), ("unit", unit), ("open_boundary", open_boundary)):
                if value is not None:
                    raise InvalidInput(f'distance: {name} = {value!r}, must be None unless method is "heat"')
        settings = (method, None if split is None else check.whole("distance", "split", split, 0),
                    np.inf if maximum is None else check.number("distance", "maximum", maximum),
                    0.5 if time_step is None else check.number("distance", "time_step", time_step),
                    "mean" if unit is None else unit, True if open_boundary is None else bool(open_boundary))
        return self._keep(("distance", *settings), lambda: _tufted.DistanceSolver(
            self._laplacian, *settings, self._solver(), check.callback("distance", progress)))

    def _poisson_solver(self, progress):
        return self._keep("poisson", lambda: _tufted.PoissonSolver(self._laplacian, self._solver(), progress))

    def _interpolate(self, function, pins, values, progress):
        where, table, flat = check.pins(function, pins, values, len(self))
        progress = check.callback(function, progress)
        result = self._interpolation_solver(function, function, where, progress).interpolate(table, progress)
        return result[:, 0] if flat else result

    def _interpolation_solver(self, function, kind, where, progress):
        with check.named(function):
            return self._keep_last(kind, where.tobytes(), lambda: _tufted.InterpolationSolver(
                self._laplacian, where, kind, self._solver(), progress))

    def _gradients(self, neighbors, regularization, progress):
        if neighbors is not None:
            neighbors = check.whole("gradients", "neighbors", neighbors, 0)
        regularization = check.number("gradients", "regularization", regularization)
        return self._keep(("gradients", neighbors, regularization), lambda: _tufted.gradients(
            self._laplacian, self._points, self._fitted_frames(), neighbors, regularization,
            self._solving["threads"], check.callback("gradients", progress)))

    def _fitted_frames(self):
        """Planes in which gradients are taken; None: fitted ones."""
        return None
