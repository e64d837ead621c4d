"""The Laplacians of robust_laplacian and the heat solvers of potpourri3d, by their names and arguments."""
import numpy as np
import scipy.sparse

from . import _arguments as check
from . import _tufted
from ._clouds import Mesh, PointCloud
from ._distances import signed_distances
from ._tufted import InvalidInput

# The defaults of `time_step` that `t_coef` multiplies: of Surface.distance(), in mean squared edge lengths, and of
# extend(), transport() and signed_distance(), in mean squared distances of neighbours.
_DISTANCE_STEP, VECTOR_STEP = 0.5, 4.0


def _matrices(surface, dummy, return_mass):
    dummy, return_mass = check.flag("laplacian", "dummy", dummy), check.flag("laplacian", "return_mass", return_mass)
    (data, indices, indptr), areas = surface._laplacian.take_matrices(dummy)
    L = check.sparse((data, indices, indptr), len(surface))
    return (L, scipy.sparse.diags(areas, format="csc")) if return_mass else L


@check.public
def point_cloud_laplacian(points, mollify_factor=_tufted.default_mollify, n_neighbors=30, return_mass=True, *,
                          preset="scan", dummy=True, threads=0, progress=None):
    """Builds L and M of a point cloud, as robust_laplacian.point_cloud_laplacian.

    points: N x 3. mollify_factor: `mollify` of PointCloud. n_neighbors: k >= 3. return_mass: False returns L only.
    preset: "scan", "clean" or "lidar", see PointCloud.
    dummy: whether points that take no part get 1 on the diagonal of L and a small mass, so that solvers never meet a
    singular matrix; otherwise they have zeros.
    threads: at most this many; 0: one per processor.
    Returns L and M, N x N csc_matrix: L positive semidefinite, minus the Laplacian; M diagonal, length^2.
    """
    cloud = PointCloud(points, preset, n_neighbors, mollify=mollify_factor, threads=threads, progress=progress)
    return _matrices(cloud, dummy, return_mass)


@check.public
def mesh_laplacian(verts, faces, mollify_factor=_tufted.default_mollify, return_mass=True, *, dummy=True, threads=0,
                   progress=None):
    """Builds L and M of a triangle mesh, as robust_laplacian.mesh_laplacian.

    verts: V x 3. faces: F x 3. All else as in point_cloud_laplacian().
    """
    mesh = Mesh(verts, faces, mollify=mollify_factor, threads=threads, progress=progress)
    return _matrices(mesh, dummy, return_mass)


class OnSurface:
    """Base of the solvers that keep a surface."""

    def __init__(self, surface):
        self._surface = surface

    @property
    def surface(self):
        """The PointCloud or Mesh that is solved on, with all other methods."""
        return self._surface


def checked_coefficient(function, t_coef):
    t_coef = check.number(function, "t_coef", t_coef)
    if not (t_coef > 0 and np.isfinite(t_coef)):
        raise InvalidInput(f"{function}: t_coef = {t_coef:g}, must be finite and above 0")
    return t_coef


class _HeatSolver(OnSurface):
    """Base of the classes below. Their indices are those of points or vertices."""

    def __init__(self, surface, t_coef):
        super().__init__(surface)
        self._t_coef = checked_coefficient(type(self).__name__, t_coef)

    def _distances(self, sources):
        return self._surface.distance(sources, method="heat", time_step=_DISTANCE_STEP * self._t_coef)

    def _signed(self, curves, level_set_constraint, solver=None):
        """The signed distance from curves, each a list of indices; infinite where no path leads."""
        require_zero_set(level_set_constraint)
        name = "compute_signed_distance"
        checked = check.lists_of_indices(name, "curves", curves, len(self._surface))
        if not checked:
            raise InvalidInput(f"{name}: curves is empty, must have at least one")
        if solver is None:
            return nearest_of([self._surface.signed_distance(checked, time_step=VECTOR_STEP * self._t_coef)])
        return nearest_of([signed_distances(solver, [self._surface._curve(name, curve) for curve in checked])])


def require_zero_set(level_set_constraint):
    if check.text("signed_distance", "level_set_constraint", level_set_constraint) != "ZeroSet":
        raise InvalidInput(f"signed_distance: level_set_constraint = {level_set_constraint!r}, must be 'ZeroSet': each "
                           "curve has the distance 0")


def nearest_of(distances):
    """Of several signed distances at each point the one of least size; infinite where all are NaN."""
    if not len(distances):
        raise InvalidInput("compute_distance: curves and points are empty, must have at least one source")
    table = np.where(np.isnan(distances), np.inf, distances)
    return np.take_along_axis(table, abs(table).argmin(axis=0)[None], axis=0)[0]


@check.public
class _Vectors(_HeatSolver):
    def get_tangent_frames(self):
        """The x axes, the y axes and the normals of the points: three arrays of N x 3."""
        frames = self._surface.frames
        return frames[:, 0], frames[:, 1], frames[:, 2]

    def _extended(self, sources, values):
        return self._surface.extend(sources, values, time_step=VECTOR_STEP * self._t_coef)

    def _transported(self, sources, vectors):
        surface = self._surface
        where = check.indices("transport_tangent_vectors", "sources", sources, len(surface))
        table, _ = check.columns("transport_tangent_vectors", "vectors", vectors, where.size)
        if table.shape[1] != 2:
            raise InvalidInput(f"transport_tangent_vectors: vectors has {table.shape[1]} columns, must have 2")
        tangents = surface.frames[:, :2]
        carried = surface.transport(where, np.einsum("si,sij->sj", table, tangents[where]),
                                    time_step=VECTOR_STEP * self._t_coef)
        return np.einsum("nj,nij->ni", carried, tangents)

    def _log_map(self, source):
        surface = self._surface
        where = check.indices("compute_log_map", "source", source, len(surface))
        if where.size != 1:
            raise InvalidInput(f"compute_log_map: source has {where.size} indices, must be one")
        source = where[0]
        x, y = surface.frames[source, :2]
        coordinates, axes = surface.log_map(source, axis=x)
        return coordinates * [1.0, np.sign(axes[1] @ y)]  # negated where log_map() turned the normal


@check.public
class PointCloudHeatSolver(_Vectors):
    """Distances, vectors and log map on a cloud, as potpourri3d.PointCloudHeatSolver.

    P: N x 3. t_coef: factor of the time steps; 1: the library's own. options: those of PointCloud.
    """

    def __init__(self, P, t_coef=1.0, **options):
        super().__init__(PointCloud(P, **options), t_coef)

    def compute_distance(self, p_ind):
        """Geodesic distances from point p_ind by the heat method: N values; infinite where no path leads."""
        return self._distances([p_ind])

    def compute_distance_multisource(self, p_inds):
        """Geodesic distances from the nearest of the points p_inds: N values; infinite where no path leads."""
        return self._distances(p_inds)

    def extend_scalar(self, p_inds, values):
        """Extends values from the points p_inds to all: N values, nearly those of the nearest source."""
        return self._extended(p_inds, values)

    def transport_tangent_vector(self, p_ind, vector):
        """Transports a tangent vector of point p_ind, 2 coordinates in its frame, to all: N x 2 in their frames."""
        return self._transported([p_ind], [vector])

    def transport_tangent_vectors(self, p_inds, vectors):
        """Transports tangent vectors, S x 2 in the frames of p_inds, to all points: N x 2 in their frames."""
        return self._transported(p_inds, vectors)

    def compute_log_map(self, p_ind):
        """The logarithmic map around point p_ind: N x 2, along the first two axes of its frame."""
        return self._log_map(p_ind)

    def compute_signed_distance(self, curves, cloud_normals, preserve_source_normals=False,
                                level_set_constraint="ZeroSet", soft_level_set_weight=-1):
        """Signed distances from curves, lists of indices, positive to their left as seen from the side that
        cloud_normals (N x 3) point to. Every curve has the distance 0 on average: level_set_constraint must be
        "ZeroSet", and preserve_source_normals and soft_level_set_weight are ignored.
        """
        surface = self._surface
        given = check.rows_of_three("compute_signed_distance", "cloud_normals", cloud_normals, len(surface))
        normals, tangents = surface._frame_parts()
        side = np.where(np.einsum("ij,ij->i", normals, given) < 0, -1.0, 1.0)[:, None]
        solver = _tufted.SignedDistanceSolver(surface._laplacian, normals * side, tangents, "heat", None,
                                              VECTOR_STEP * self._t_coef, surface._solver(), None)
        return self._signed(curves, level_set_constraint, solver)


@check.public
class MeshHeatMethodDistanceSolver(_HeatSolver):
    """Distances on a mesh, as potpourri3d.MeshHeatMethodDistanceSolver.

    V: N x 3. F: F x 3. t_coef: factor of the time step; 1: the library's own. use_robust: ignored, the tufted Laplacian
    is always used. options: those of Mesh.
    """

    def __init__(self, V, F, t_coef=1.0, use_robust=True, **options):
        super().__init__(Mesh(V, F, **options), t_coef)

    def compute_distance(self, v_ind):
        """Geodesic distances from vertex v_ind by the heat method: N values; infinite where no path leads."""
        return self._distances([v_ind])

    def compute_distance_multisource(self, v_inds):
        """Geodesic distances from the nearest of the vertices v_inds: N values; infinite where no path leads."""
        return self._distances(v_inds)


@check.public
class _MeshVectors(_Vectors):
    def extend_scalar(self, v_inds, values):
        """Extends values from the vertices v_inds to all: N values, nearly those of the nearest source."""
        return self._extended(v_inds, values)

    def transport_tangent_vector(self, v_ind, vector):
        """Transports a tangent vector of vertex v_ind, 2 coordinates in its frame, to all: N x 2 in their frames."""
        return self._transported([v_ind], [vector])

    def transport_tangent_vectors(self, v_inds, vectors):
        """Transports tangent vectors, S x 2 in the frames of v_inds, to all vertices: N x 2 in their frames."""
        return self._transported(v_inds, vectors)


@check.public
class MeshVectorHeatSolver(_MeshVectors):
    """Extension, vector transport and log map on a mesh, as potpourri3d.MeshVectorHeatSolver.

    V: N x 3. F: F x 3. t_coef: factor of the time step; 1: the library's own. use_intrinsic_delaunay: ignored, the
    tufted Laplacian is always intrinsic Delaunay. options: those of Mesh.
    """

    def __init__(self, V, F, t_coef=1.0, use_intrinsic_delaunay=True, **options):
        options.pop("useIntrinsicDelaunay", None)  # the name in potpourri3d's README
        super().__init__(Mesh(V, F, **options), t_coef)

    def get_connection_laplacian(self):
        """The connection Laplacian, N x N complex csc_matrix, Hermitian: L with each off-diagonal multiplied by the
        smallest rotation between the frames of its vertices, as a complex number.
        """
        surface = self._surface
        entries = surface.L.tocoo()
        i, j = entries.row, entries.col
        x, y, normal = np.moveaxis(surface.frames, 1, 0)
        cosine = np.einsum("ij,ij->i", normal[i], normal[j])
        # The x axis of j after the smallest rotation that takes its normal to that of i; opposite normals have none.
        part = np.einsum("ij,ij->i", x[j], normal[i]) / np.where(cosine > -1, 1 + cosine, np.inf)
        turned = x[j] - part[:, None] * (normal[i] + normal[j])
        rotation = np.einsum("ij,ij->i", turned, x[i]) + 1j * np.einsum("ij,ij->i", turned, y[i])
        size = abs(rotation)
        rotation = np.where(i == j, 1, rotation / np.where(size > 0, size, 1))
        return scipy.sparse.csc_matrix((entries.data * rotation, (i, j)), shape=entries.shape)

    def compute_log_map(self, v_ind, strategy="AffineLocal"):
        """The logarithmic map around vertex v_ind: N x 2, along the first two axes of its frame. strategy:
        "VectorHeat", "AffineLocal" or "AffineAdaptive", which all give Surface.log_map().
        """
        if check.text("compute_log_map", "strategy", strategy) not in ("VectorHeat", "AffineLocal", "AffineAdaptive"):
            raise InvalidInput(f"compute_log_map: strategy = {strategy!r}, must be one of 'VectorHeat', 'AffineLocal', "
                               "'AffineAdaptive'")
        return self._log_map(v_ind)


@check.public
class PolygonMeshHeatSolver(_MeshVectors):
    """Distances and vectors on a mesh of polygons, as potpourri3d.PolygonMeshHeatSolver; each polygon of more than
    three corners is cut into triangles.

    V: N x 3. F: a list of lists of indices, or F x D. t_coef: factor of the time steps; 1: the library's own.
    """

    def __init__(self, V, F, t_coef=1.0):
        super().__init__(Mesh(V, triangulated("PolygonMeshHeatSolver", V, F)), t_coef)

    def compute_distance(self, v_inds):
        """Geodesic distances from the nearest of the vertices v_inds: N values; infinite where no path leads."""
        return self._distances(v_inds)

    def compute_signed_distance(self, curves, level_set_constraint="ZeroSet"):
        """Signed distances from curves, lists of vertices, positive to their left. Every curve has the distance 0 on
        average: level_set_constraint must be "ZeroSet".
        """
        return self._signed(curves, level_set_constraint)


def triangulated(function, V, F):
    """The triangles of polygons, F x 3 int32."""
    points = check.rows_of_three(function, "V", V)
    polygons = check.lists_of_indices(function, "F", F, len(points))
    corners = np.concatenate([np.zeros(0, np.int32), *polygons])
    return _tufted.triangulate(points, corners, np.array([len(each) for each in polygons], np.int32))


@check.public
def compute_distance(V, F, v_ind):
    """Geodesic distances from one vertex of a mesh, N values. For several queries MeshHeatMethodDistanceSolver is
    faster.
    """
    return MeshHeatMethodDistanceSolver(V, F).compute_distance(v_ind)


@check.public
def compute_distance_multisource(V, F, v_inds):
    """Geodesic distances from the nearest of several vertices of a mesh, N values."""
    return MeshHeatMethodDistanceSolver(V, F).compute_distance_multisource(v_inds)
