"""Distances from curves, and lines on meshes, by potpourri3d's names and arguments."""
import numpy as np

from . import _arguments as check
from . import _tufted
from ._clouds import Mesh, PointCloud
from ._drop_in import VECTOR_STEP, OnSurface, checked_coefficient, nearest_of, require_zero_set
from ._drop_in_files import edges
from ._tufted import InvalidInput

# Coordinates below this count as 0: the caller has computed them.
_ROUNDING = 1e-12
# Begins messages about places; @check.public replaces it by the name of the method.
_PLACES = "places"


class _MeshPlaces(OnSurface):
    """A mesh on which places are given as (vertex, []), (edge, [t]), t from the lower to the higher index of the rows
    of edges(), or (face, [a, b]) and (face, [a, b, c]), barycentric coordinates.
    """

    def __init__(self, V, F):
        super().__init__(Mesh(V, F))
        self._edges = edges(V, self._surface.faces)

    def _position(self, place, name):
        """The vertices of its edge or face that a place lies between, and their weights; of a vertex it alone. `name`
        is the argument that has the place.
        """
        if not isinstance(place, (tuple, list)) or len(place) not in (1, 2):
            raise InvalidInput(f"{_PLACES}: {name} has the place {place!r}, must be a tuple as (index, [])")
        index, given = place[0], check.values(_PLACES, name, place[1] if len(place) == 2 else [])
        if given.size == 0:
            return check.indices(_PLACES, name, index, len(self._surface)), np.ones(1)
        corners = self._edges if given.size == 1 else self._surface.faces
        index = check.indices(_PLACES, name, index, len(corners))[0]
        weights = {1: lambda: np.append(1 - given, given), 2: lambda: np.append(given, 1 - given.sum())}.get(
            given.size, lambda: given)()
        if weights.size > 3 or not (weights >= -_ROUNDING).all() or not weights.sum() > 0:
            raise InvalidInput(f"{_PLACES}: {name} has the coordinates {given}, must be one to three in [0, 1]")
        used = weights > _ROUNDING
        return corners[index][used], weights[used]

    def _face_around(self, vertices):
        """A face that has all these vertices, or -1."""
        has = np.logical_and.reduce([(self._surface.faces == vertex).any(axis=1) for vertex in vertices])
        return int(has.argmax()) if has.any() else -1

    def _in_face(self, face, vertices, weights):
        corners = self._surface.faces[face]
        return np.array([weights[vertices == corner].sum() for corner in corners])

    def _along(self, curve, name):
        """The places of a curve for Surface.signed_distance(), each in a face that also has the next one, if any has. A
        vertex stays one.
        """
        places = [self._position(place, name) for place in check.items(_PLACES, name, curve)]
        found = []
        for (vertices, weights), (ahead, _) in zip(places, places[1:] + places[-1:]):
            face = self._face_around(np.union1d(vertices, ahead))
            face = face if face >= 0 else self._face_around(vertices)
            if face < 0:
                raise InvalidInput(f"{_PLACES}: {name} has the vertex {vertices[0]}, must be a corner of a face")
            found.append((face, self._in_face(face, vertices, weights)))
        return found

    def _marched(self, curves, points=()):
        """The signed distances by marching from curves and points; a curve of one place is a point."""
        along = [self._along(curve, "curves") for curve in check.items(_PLACES, "curves", curves)]
        inside = [places[0] for places in along if len(places) == 1]
        inside += [place for point in points for place in self._along([point], "points")]
        curves = [places for places in along if len(places) > 1]
        if not curves and not inside:
            raise InvalidInput(f"{_PLACES}: curves has no place, must have at least one")
        faces, weights = zip(*inside) if inside else (None, None)
        return self._surface.signed_distance(curves, faces=faces, barycentric=weights, method="marching")


@check.public
class MeshFastMarchingDistanceSolver(_MeshPlaces):
    """Distances from curves on a mesh by marching, as potpourri3d.MeshFastMarchingDistanceSolver.

    V: N x 3. F: F x 3.
    """

    def __init__(self, V, F):
        super().__init__(V, F)

    def compute_distance(self, curves, distances=(), sign=False):
        """Distances from the nearest of some curves: N values; infinite where no path leads.

        curves: lists of places: (vertex, []), (edge, [t]), (face, [a, b]) or (face, [a, b, c]). Neighbours in a list
        are joined by a straight segment if they lie in one face.
        distances: those at the places, which must be 0 or left out.
        sign: whether distances to the right of the curves are negative.
        """
        distances = check.items("compute_distance", "distances", distances)
        if any(np.any(check.values("compute_distance", "distances", values) != 0) for values in distances):
            raise InvalidInput("compute_distance: distances has values, must be 0 or empty")
        found = nearest_of([self._marched(curves)])
        return found if check.flag("compute_distance", "sign", sign) else abs(found)


@check.public
class MeshSignedHeatSolver(_MeshPlaces):
    """Signed distances from curves on a mesh by heat, as potpourri3d.MeshSignedHeatSolver.

    V: N x 3. F: F x 3. t_coef: factor of the time step; 1: the library's own.
    """

    def __init__(self, V, F, t_coef=1.0):
        super().__init__(V, F)
        self._time_step = VECTOR_STEP * checked_coefficient("MeshSignedHeatSolver", t_coef)

    def compute_distance(self, curves, curve_signs=(), points=(), preserve_source_normals=False,
                         level_set_constraint="ZeroSet", soft_level_set_weight=-1):
        """Signed distances from curves, which count as pieces of one, or the distances from points and curves without
        sign where these are less: N values, positive to the left of curves; infinite where no path leads.

        curves: lists of places as in MeshFastMarchingDistanceSolver; all with a sign count as pieces of one.
        curve_signs: a boolean for each curve, False for distances without sign; empty: all have one.
        points: places, or indices of vertices, from which distances have no sign; these are by marching.
        level_set_constraint: must be "ZeroSet". preserve_source_normals, soft_level_set_weight: ignored.
        """
        require_zero_set(level_set_constraint)
        curves = check.items("compute_distance", "curves", curves)
        signs = check.items("compute_distance", "curve_signs", curve_signs) or [True] * len(curves)
        signs = [check.flag("compute_distance", "curve_signs", sign) for sign in signs]
        if len(signs) != len(curves):
            raise InvalidInput(f"compute_distance: curve_signs has {len(signs)} values, must have {len(curves)}")
        signed = [self._along(curve, "curves") for curve, sign in zip(curves, signs) if sign]
        unsigned = [curve for curve, sign in zip(curves, signs) if not sign]
        points = [point if isinstance(point, (tuple, list)) else (point, [])
                  for point in check.items("compute_distance", "points", points)]
        found = [self._surface.signed_distance(signed, time_step=self._time_step)] if signed else []
        return nearest_of(found + ([abs(self._marched(unsigned, points))] if unsigned or points else []))


@check.public
class MeshMarchingTrianglesSolver(_MeshPlaces):
    """Lines on which a field has a value, as potpourri3d.MeshMarchingTrianglesSolver.

    V: N x 3. F: F x 3.
    """

    def __init__(self, V, F):
        super().__init__(V, F)

    def marching_triangles(self, u, isoval=0.0):
        """The lines on which u, N values, equals isoval: a list of lists of (edge, [t]), rows of edges() and how far
        along. A closed line ends with its first place. Where u reaches isoval at a vertex, or triangles coincide, one
        of the edges there is given.
        """
        isoval = check.number("marching_triangles", "isoval", isoval)
        lines = self._surface.isolines(u, isoval)
        values = np.asarray(u, np.float64).reshape(-1)[self._edges] - isoval
        finite = np.isfinite(values).all(axis=1)
        crossed = np.flatnonzero(finite & ((values[:, 0] >= 0) != (values[:, 1] >= 0)))
        if not crossed.size:
            return []
        t = values[crossed, 0] / (values[crossed, 0] - values[crossed, 1])
        ends = self._surface.positions[self._edges[crossed]]
        from scipy.spatial import cKDTree  # slow to import
        tree = cKDTree(ends[:, 0] + t[:, None] * (ends[:, 1] - ends[:, 0]))
        found = []
        for line in lines:
            _, nearest = tree.query(line.points)
            places = [(int(crossed[k]), [float(t[k])]) for k in nearest]
            found.append(places + places[:1] if line.closed else places)
        return found


@check.public
def marching_triangles(V, F, u, isoval=0.0):
    """The lines on which u, N values at V (N x 3), equals isoval, on the triangles F: as
    MeshMarchingTrianglesSolver.marching_triangles().
    """
    return MeshMarchingTrianglesSolver(V, F).marching_triangles(u, isoval)


@check.public
class _MeshLines(OnSurface):
    """Base of the classes below. t_coef is ignored, as it is in potpourri3d."""

    def __init__(self, V, F, t_coef=1.0):
        super().__init__(Mesh(V, F))


@check.public
class EdgeFlipGeodesicSolver(_MeshLines):
    """Straight paths and loops on a mesh, as potpourri3d.EdgeFlipGeodesicSolver.

    V: N x 3. F: F x 3. t_coef: ignored.
    """

    def find_geodesic_path(self, v_start, v_end, max_iterations=None, max_relative_length_decrease=None):
        """A shortest path between the vertices v_start and v_end: K x 3 points. max_iterations and
        max_relative_length_decrease are ignored: paths are always straightened to the end.
        """
        return self._surface.path(v_start, v_end).points

    def find_geodesic_path_poly(self, v_list, max_iterations=None, max_relative_length_decrease=None):
        """The way through the vertices v_list, straightened: K x 3 points from the first to the last. max_iterations
        and max_relative_length_decrease are ignored.
        """
        return self._surface.path_through(v_list).points

    def find_geodesic_loop(self, v_list, max_iterations=None, max_relative_length_decrease=None):
        """The closed way through the vertices v_list, straightened: K x 3 points, the first one not repeated; a single
        one where the loop contracts. max_iterations and max_relative_length_decrease are ignored.
        """
        return self._surface.path_through(v_list, closed=True).points


@check.public
class GeodesicTracer(_MeshLines):
    """Straight lines on a mesh, as potpourri3d.GeodesicTracer.

    V: N x 3. F: F x 3. t_coef: ignored.
    """

    def trace_geodesic_from_vertex(self, start_vert, direction_xyz, max_iterations=None):
        """Follows a straight line from vertex start_vert along direction_xyz, 3 values projected into the tangent plane
        of the vertex, as far as this projection is long: K x 3 points. max_iterations: most edges that are crossed.
        """
        where = check.indices("trace_geodesic_from_vertex", "start_vert", start_vert, len(self._surface))
        normal = self._surface.frames[where[0], 2]
        return self._traced("trace_geodesic_from_vertex", where, direction_xyz, normal, max_iterations)

    def trace_geodesic_from_face(self, start_face, bary_coords, direction_xyz, max_iterations=None):
        """The same from a place in face start_face, bary_coords: 3 barycentric coordinates. direction_xyz is projected
        into the plane of the face. max_iterations: most edges that are crossed.
        """
        name, faces = "trace_geodesic_from_face", self._surface.faces
        where = check.indices(name, "start_face", start_face, len(faces))
        a, b, c = self._surface.positions[faces[where[0]]]
        return self._traced(name, where, direction_xyz, np.cross(b - a, c - a), max_iterations, bary_coords)

    def _traced(self, function, where, direction, normal, most, barycentric=None):
        direction = check.vector_of_three(function, "direction_xyz", direction)
        size = np.linalg.norm(normal)
        normal = normal / size if size > 0 else normal
        length = np.linalg.norm(direction - (direction @ normal) * normal)
        points = self._surface.trace(where, direction, length, barycentric=barycentric).points
        return points if most is None else points[:check.whole(function, "max_iterations", most, 0) + 1]


@check.public
class PointCloudLocalTriangulation:
    """The triangles around each point of a cloud, as potpourri3d.PointCloudLocalTriangulation.

    P: N x 3. with_degeneracy_heuristic: ignored. options: those of PointCloud.
    """

    def __init__(self, P, with_degeneracy_heuristic=True, **options):
        self._surface = PointCloud(P, **options)

    def get_local_triangulation(self):
        """The triangles with each point as a corner, of the union of all stars after flips: N x K x 3 indices, the
        point itself first, counterclockwise as seen from its normal; rows of -1 fill the rest.
        """
        faces = np.unique(np.sort(_tufted.cover_faces(self._surface._laplacian), axis=1), axis=0)
        faces = faces[(faces[:, 0] < faces[:, 1]) & (faces[:, 1] < faces[:, 2])]
        around = np.concatenate([np.roll(faces, -k, axis=1) for k in range(3)])
        around = around[np.argsort(around[:, 0], kind="stable")]
        positions, normals = self._surface.positions, self._surface.frames[:, 2]
        a, b, c = (positions[around[:, k]] for k in range(3))
        back = np.einsum("ij,ij->i", np.cross(b - a, c - a), normals[around[:, 0]]) < 0
        around[back] = around[back][:, [0, 2, 1]]
        counts = np.bincount(around[:, 0], minlength=len(positions))
        result = np.full((len(positions), counts.max(initial=0), 3), -1, np.int32)
        result[around[:, 0], np.arange(len(around)) - (np.cumsum(counts) - counts)[around[:, 0]]] = around
        return result
