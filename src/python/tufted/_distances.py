"""The methods of Surface that measure distances, or carry values and vectors along the surface."""
import warnings

import numpy as np

from . import _arguments as check
from . import _tufted
from ._results import Isoline, LogMap, Path, Trace, TuftedWarning
from ._tufted import InvalidInput


def signed_distances(solver, curves, points=(), progress=None):
    """The distances that a _tufted.SignedDistanceSolver finds, with its warning."""
    values, sentence = solver.query(curves, list(points), progress)
    if sentence:
        warnings.warn(sentence, TuftedWarning, stacklevel=4)
    return values


def _is_place(item):
    """Whether an item of a curve is a place, an index or (face, barycentric coordinates), and not a curve."""
    return not hasattr(item, "__len__") or (
        len(item) == 2 and not hasattr(item[0], "__len__") and hasattr(item[1], "__len__") and len(item[1]) == 3)


@check.public
class Distances:
    def distance(self, sources=(), *, faces=None, barycentric=None, method="marching", split=None, maximum=None,
                 time_step=None, unit=None, open_boundary=None, progress=None):
        """The geodesic distance of every point from the nearest of some sources.

        sources: an index or several.
        faces, barycentric: S faces of a mesh and S x 3 barycentric coordinates by corner, >= 0: further sources, inside
        triangles.
        method: "marching" through the triangles, which is more accurate, or "heat", smooth where fronts from different
        sides meet.
        split: of marching: how often each triangle is cut into four, 0 to 2; None: 2 up to 5,000 points, otherwise 1.
        maximum: greater distances are infinite; None: no limit.
        time_step: of heat, in units of `unit`; larger values smooth more; None: 0.5. unit: of heat: "mean" (None), the
        mean squared length of edges, or "adapted", the same for very uneven density. open_boundary: of heat: whether it
        passes the boundary as if the surface went on; None: True.
        Returns N values >= 0, length; infinite where no path leads.

        >>> cloud = tufted.PointCloud(points)
        >>> from_one, from_either = cloud.distance(0), cloud.distance([0, 5])
        >>> bool(from_either[5] == 0 and from_one[5] > 0)
        True
        """
        places = self._places("distance", sources, faces, barycentric)
        solver = self._distance_solver(method, split, maximum, time_step, unit, open_boundary, progress)
        return solver.query(places, check.callback("distance", progress))

    def nearest_source(self, sources=(), *, faces=None, barycentric=None, method="marching", split=None, maximum=None,
                       time_step=None, unit=None, open_boundary=None, progress=None):
        """Finds the nearest source of every point along the surface: the geodesic Voronoi cells of the sources.

        sources, faces, barycentric, method, split, maximum, time_step, unit, open_boundary: as in distance().
        Returns N distances, and N numbers of the nearest source, counted from 0 through `sources`, then `faces`; -1
        where no path leads.
        """
        places = self._places("nearest_source", sources, faces, barycentric)
        solver = self._distance_solver(method, split, maximum, time_step, unit, open_boundary, progress)
        return solver.nearest(places, check.callback("nearest_source", progress))

    def distance_matrix(self, sources=(), *, faces=None, barycentric=None, symmetric=False, method="marching",
                        split=None, maximum=None, time_step=None, unit=None, open_boundary=None, progress=None):
        """The geodesic distance of every point from each of some sources, as `tufted distance --matrix`, with as many
        sources at once as the surface may use threads.

        sources, faces, barycentric, method, split, maximum, time_step, unit, open_boundary: as in distance().
        symmetric: whether the distances between sources, found from either end, are replaced by the mean of both. They
        differ by some thousandths of the largest distance on smooth surfaces, on coarse meshes by up to 6 %. All
        sources then must be points.
        Returns N x S, length, a column for each of `sources`, then of `faces`; infinite where no path leads.
        """
        places = self._places("distance_matrix", sources, faces, barycentric)
        symmetric = check.flag("distance_matrix", "symmetric", symmetric)
        solver = self._distance_solver(method, split, maximum, time_step, unit, open_boundary, progress)
        return solver.matrix(places, symmetric, check.callback("distance_matrix", progress))

    def points_within(self, sources, radius, *, split=None, progress=None):
        """Finds the points whose geodesic distance from the nearest of some sources is at most a radius. On a cloud
        only the surface around the sources is visited.

        sources: an index or several. radius: length, > 0. split: as in distance().
        Returns K indices, ascending, and their K distances by marching.
        """
        self._need_cover("points_within")
        where = check.indices("points_within", "sources", sources, len(self))
        return _tufted.points_within(self._laplacian, where, check.number("points_within", "radius", radius),
                                     None if split is None else check.whole("points_within", "split", split, 0),
                                     check.callback("points_within", progress))

    def path(self, start, end, *, progress=None):
        """A shortest path between two points, straight across the triangles; no path near it is shorter.

        start, end: indices.
        Returns points (K x 3, from start to end) and the length along the surface. Raises InvalidInput if no path
        leads.
        """
        self._need_cover("path")
        ends = [check.indices("path", name, point, len(self)) for name, point in (("start", start), ("end", end))]
        for name, point in zip(("start", "end"), ends):
            if point.size != 1:
                raise InvalidInput(f"path: {name} has {point.size} indices, must be one")
        progress = check.callback("path", progress)
        solver = self._keep("path", lambda: self._path_solver("path", progress))
        return Path(*solver.path(int(ends[0][0]), int(ends[1][0]), progress))

    def path_through(self, points, *, closed=False, progress=None):
        """Straightens a way through several points, which says on which side of handles and hills the path passes: no
        path near it is shorter. It need not pass the inner points. On a cloud it runs over triangles().

        points: at least two indices, on a cloud of corners of triangles(). closed: whether the way leads back from the
        last to the first: a geodesic loop, which keeps none of the points, and contracts to a single one where nothing
        holds it.
        Returns points (K x 3; of a loop without the first one again) and the length along the surface. Raises
        InvalidInput if no path leads.
        """
        stops = check.indices("path_through", "points", points, len(self))
        self._need_cover("path_through")
        progress = check.callback("path_through", progress)
        stops = self.representative[stops]
        if self._faces is None:
            outside = stops[~np.isin(stops, self._joined_faces("path_through"))]
            if outside.size:
                raise InvalidInput(f"path_through: points has {outside[0]}, must be corners of triangles()")
        solver = self._keep("path through", lambda: self._path_solver("path_through", progress))
        return Path(*solver.through(stops, check.flag("path_through", "closed", closed), progress))

    def _path_solver(self, function, progress):
        """The solver of path(); for path_through() on a cloud, one on triangles(), which do not overlap."""
        laplacian = self._laplacian
        if function == "path_through" and self._faces is None:
            options = {"order": "angle", "seed": 0, "mollify": 0.0, "weld": False, "threads": self._solving["threads"]}
            laplacian = _tufted.build_mesh(self.positions, self._joined_faces(function), options, progress)
        return _tufted.PathSolver(laplacian, self._solver(), progress)

    def trace(self, source, direction, length, *, barycentric=None, progress=None):
        """Follows a straight line over the triangles of a mesh, or those of triangles(): the exponential map.

        source: index of a point or, with barycentric (3 coordinates by corner, >= 0), of a triangle of a mesh.
        direction: 3 values, of any length, projected into the tangent plane of the point or the plane of the triangle.
        length: >= 0. A vertex that the line meets is left with equal angles on both sides.
        Returns points (K x 3, from the start over all edges that the line crosses to the end), length, ended_by
        ("length"; "rim": the surface ends; "branch": more than two triangles meet; "crossings": after a million),
        direction (3, at the end), corners and barycentric (3 each, the place of the end).

        >>> mesh = tufted.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]])
        >>> mesh.trace(0, [1, 1, 0], 1).ended_by
        'length'
        """
        direction = check.vector_of_three("trace", "direction", direction)
        length = check.number("trace", "length", length)
        tracer = self._keep("trace", lambda: _tufted.GeodesicTracer(
            self._laplacian.positions, self._joined_faces("trace"), *self._frame_parts()))
        if barycentric is not None and self._faces is None:
            raise InvalidInput("trace: barycentric is given, must be None for a cloud")
        with check.named("trace", start="source", sources="source", faces="source"):
            places = self._places("trace", *((source, None) if barycentric is None else ((), source)), barycentric)
            if len(places) != 1:
                raise InvalidInput(f"trace: source has {len(places)} indices, must be one")
            points, length, ended_by, *end = tracer.query(places[0], direction, length,
                                                          check.callback("trace", progress))
        return Trace(points, length, ended_by, *map(np.array, end))

    def isolines(self, field, values, *, progress=None):
        """Finds the lines on which a field, linear within the triangles of a mesh or those of triangles(), has some
        values.

        field: N values; NaN and infinite values end lines. values: a value or several.
        Returns a list, in the order of `values`: of each line points (K x 3, in order; a closed line does not repeat
        its first point), value, length, closed. Larger values lie to the left, seen from the front of the triangles.
        Lines end where the surface ends and where more than two triangles meet; on a closed surface all are closed.

        >>> mesh = tufted.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]])
        >>> [line.length for line in mesh.isolines([0, 1, 1, 0], 0.5)]
        [1.0]
        """
        field, _ = check.columns("isolines", "field", field, len(self))
        values = check.values("isolines", "values", values)
        if field.shape[1] != 1:
            raise InvalidInput(f"isolines: field has {field.shape[1]} columns, must have one")
        found = _tufted.isolines(self._laplacian.positions, self._joined_faces("isolines"), field[:, 0],
                                 values, check.callback("isolines", progress))
        return [Isoline(*line) for line in found]

    def extend(self, sources, values, *, time_step=4.0, progress=None):
        """Extends values from some points to all: nearly those of the nearest source.

        sources: S indices. values: S or S x c, finite.
        time_step: in mean squared distances of neighbours; larger values mix more.
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
        """Transports tangent vectors from some points to all, parallel along the shortest paths.

        sources: S indices. vectors: S x 3, projected into the tangent planes of their points. time_step: as in
        extend().
        Returns N x 3 tangent vectors; 0 where no path leads.
        """
        where = check.indices("transport", "sources", sources, len(self))
        vectors = check.rows_of_three("transport", "vectors", vectors, where.size, or_one=True)
        time_step = check.number("transport", "time_step", time_step)
        progress = check.callback("transport", progress)
        solver = self._keep("transport", lambda: _tufted.TransportSolver(
            self._laplacian, *self._frame_parts(), time_step, self._solver(), progress), time_step)
        return solver.query(where, vectors, progress)

    def log_map(self, source, *, axis=None, method="exact", time_step=None, progress=None):
        """The logarithmic map: the direction at a source, and the distance from it, in which every point lies.

        source: index of an active point.
        axis: direction of the first coordinate, 3 values; None: the tangent at the source, of frames with the normals
        of normals().
        method: "exact", shortest paths over the triangles, in a time that grows with N^1.5, refused where triangles are
        so thin that lines wind without an end, or "heat", the vector heat method: fast queries on millions of points,
        but angles are off by some degrees.
        time_step: of heat, as in extend(); None: 4.
        Returns coordinates (N x 2, distance times cosine and sine of the angle; NaN where no path leads) and axes (2 x
        3, the directions of the coordinates at the source).
        """
        where = check.indices("log_map", "source", source, len(self))
        if where.size != 1:
            raise InvalidInput(f"log_map: source has {where.size} indices, must be one")
        self._need_cover("log_map")
        method = check.text("log_map", "method", method)
        if method == "exact" and time_step is not None:
            raise InvalidInput(f'log_map: time_step = {time_step!r}, must be None unless method is "heat"')
        time_step = 4.0 if time_step is None else check.number("log_map", "time_step", time_step)
        progress = check.callback("log_map", progress)
        axis = np.zeros(3) if axis is None else check.vector_of_three("log_map", "axis", axis)
        solver = self._keep("log_map", lambda: _tufted.LogMapSolver(
            self._laplacian, *self._signed_frames(), method, time_step, self._solver(), progress), (method, time_step))
        coordinates, first, second = solver.query(int(where[0]), axis, progress)
        return LogMap(coordinates, np.vstack([first, second]))

    def signed_distance(self, curve=(), *, sources=(), faces=None, barycentric=None, method="heat", split=None,
                        time_step=None, progress=None):
        """The distance from curves on the surface, positive to their left as seen from the side that normals point to.

        curve: places in order, the first one again at the end if the curve is closed; or several such curves. A place
        is an index or, inside a triangle of a mesh, a pair (face, (a, b, c)) with barycentric coordinates. Neighbours
        are joined by an edge, or lie about a spacing apart; longer steps are warned of, and path() finds the way between.
        method: "heat": all curves count as pieces of one, whose left sides should agree. Across gaps and beyond ends
        the distance continues smoothly. "marching": the length of a shortest path to the nearest curve, negative if it
        leaves the curve to the right.
        sources, faces, barycentric: of marching: further sources, as in distance(). Distances from them are positive.
        split: of marching, as in distance(). time_step: of heat, as in extend(); None: 4.
        Returns N values, length; NaN on components without a source.

        >>> mesh = tufted.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]])
        >>> middle = [(1, (0.5, 0, 0.5)), (0, (0.5, 0, 0.5)), (0, (0, 0.5, 0.5))]
        >>> mesh.signed_distance(middle, method="marching")
        array([-0.5, -0.5,  0.5,  0.5])
        """
        name = "signed_distance"
        method = check.text(name, "method", method)
        if method == "marching" and time_step is not None:
            raise InvalidInput(f'{name}: time_step = {time_step!r}, must be None unless method is "heat"')
        if method == "heat" and split is not None:
            raise InvalidInput(f'{name}: split = {split!r}, must be None unless method is "marching"')
        if method == "marching":
            self._need_cover(name)
        settings = (method, None if split is None else check.whole(name, "split", split, 0),
                    4.0 if time_step is None else check.number(name, "time_step", time_step))
        progress = check.callback(name, progress)
        curve = [curve] if isinstance(curve, (int, np.integer)) else check.items(name, "curve", curve)
        several = [curve] if all(map(_is_place, curve)) else curve
        with check.named(name, sources="curve", faces="curve", points="sources"):
            curves = [self._curve(name, check.items(name, "curve", one)) for one in several] if curve else []
        with check.named(name, points="sources"):
            sources = check.array(name, "sources", sources)
            points = self._places(name, sources, faces, barycentric) if faces is not None or sources.size else []
            solver = self._keep(name, lambda: _tufted.SignedDistanceSolver(
                self._laplacian, *self._signed_frames(), *settings, self._solver(), progress), settings)
            return signed_distances(solver, curves, points, progress)

    def _curve(self, function, places):
        """The places of a curve, in order."""
        if not all(map(_is_place, places)):
            raise InvalidInput(f"{function}: curve has a place that is none, must be indices and (face, (a, b, c))")
        in_face = [hasattr(place, "__len__") for place in places]
        inside = [place for place, has_face in zip(places, in_face) if has_face]
        found = self._places(function, [place for place, has_face in zip(places, in_face) if not has_face],
                             [face for face, _ in inside] if inside else None, [weights for _, weights in inside])
        order = np.argsort(in_face, kind="stable")  # vertices come first
        return [found[k] for k in np.argsort(order)]

    def _joined_faces(self, function):
        """_surface_faces() with coincident points replaced by their representatives."""
        return self.representative[self._surface_faces(function)]

    def _places(self, function, sources, faces, barycentric):
        where = check.indices(function, "sources", sources, len(self), empty=faces is not None)
        inside, coordinates = np.zeros(0, np.int32), np.zeros((0, 3))
        if faces is not None:
            if self._faces is None:
                raise InvalidInput(f"{function}: faces is given, must be None for a cloud")
            inside = check.indices(function, "faces", faces, len(self._faces))
            coordinates = check.rows_of_three(function, "barycentric",
                                              () if barycentric is None else barycentric, inside.size, or_one=True)
        corners = self.representative[self._faces] if inside.size else np.zeros((0, 3), np.int32)
        return _tufted.surface_points(self.representative[where], self._points, corners, inside, coordinates)

    def _distance_solver(self, method, split, maximum, time_step, unit, open_boundary, progress):
        self._need_cover("distance")
        method = check.text("distance", "method", method)
        if method == "marching":
            for name, value in (("time_step", time_step), ("unit", unit), ("open_boundary", open_boundary)):
                if value is not None:
                    raise InvalidInput(f'distance: {name} = {value!r}, must be None unless method is "heat"')
        settings = (method, None if split is None else check.whole("distance", "split", split, 0),
                    np.inf if maximum is None else check.number("distance", "maximum", maximum),
                    0.5 if time_step is None else check.number("distance", "time_step", time_step),
                    "mean" if unit is None else check.text("distance", "unit", unit),
                    open_boundary is None or check.flag("distance", "open_boundary", open_boundary))
        return self._keep("distance", lambda: _tufted.DistanceSolver(
            self._laplacian, *settings, self._solver(), check.callback("distance", progress)), settings)
