"""The part of Surface about distances, and what is carried along the surface."""
import numpy as np

from . import _arguments as check
from . import _tufted
from ._results import LogMap, Path
from ._tufted import InvalidInput


class Distances:
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
        solver = self._keep("extend", lambda: _tufted.ExtensionSolver(
            self._laplacian, time_step, self._solver(), progress), time_step)
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
        solver = self._keep("transport", lambda: _tufted.TransportSolver(
            self._laplacian, *self._frame_parts(), time_step, self._solver(), progress), time_step)
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
        solver = self._keep("log_map", lambda: _tufted.LogMapSolver(
            self._laplacian, *self._signed_frames(), time_step, self._solver(), progress), time_step)
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
        solver = self._keep("signed_distance", lambda: _tufted.SignedDistanceSolver(
            self._laplacian, *self._signed_frames(), time_step, self._solver(), progress), time_step)
        return solver.query(where, progress)

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
        return self._keep("distance", lambda: _tufted.DistanceSolver(
            self._laplacian, *settings, self._solver(), check.callback("distance", progress)), settings)
