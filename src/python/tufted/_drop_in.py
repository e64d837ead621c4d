"""Functions and classes with the names and arguments of robust_laplacian and potpourri3d."""
import numpy as np
import scipy.sparse

from . import _arguments as check
from . import _tufted
from ._clouds import Mesh, PointCloud
from ._tufted import InvalidInput

# Default time steps of the library's solvers: for distances in mean squared edge lengths, for vectors in mean squared
# distances of neighbours.
_DISTANCE_STEP, _VECTOR_STEP = 0.5, 4.0


def _matrices(surface, dummy, return_mass):
    (data, indices, indptr), areas = surface._laplacian.take_matrices(bool(dummy))
    L = check.sparse((data, indices, indptr), len(surface))
    return (L, scipy.sparse.diags(areas, format="csc")) if return_mass else L


def point_cloud_laplacian(points, mollify_factor=_tufted.default_mollify, n_neighbors=30, return_mass=True, *, preset="scan", dummy=True,
                          threads=0, progress=None):
    """Builds L and M of a point cloud, as robust_laplacian.point_cloud_laplacian.

    points: N x 3. mollify_factor: `mollify` of PointCloud. n_neighbors: k >= 3. return_mass: False returns L only.
    preset: "scan", "clean" or "lidar", see PointCloud.
    dummy: whether points that take no part get 1 on the diagonal of L and a small mass, so that solvers never meet a
    singular matrix; otherwise they have zeros.
    threads: at most this many; 0: one per processor.
    Returns L and M, N x N csc_matrix: L positive semidefinite, minus the Laplacian; M diagonal, length^2.
    """
    with check.named("point_cloud_laplacian", mollify="mollify_factor", neighbors="n_neighbors"):
        cloud = PointCloud(points, preset, n_neighbors, mollify=mollify_factor, threads=threads, progress=progress)
    return _matrices(cloud, dummy, return_mass)


def mesh_laplacian(verts, faces, mollify_factor=_tufted.default_mollify, return_mass=True, *, dummy=True, threads=0, progress=None):
    """Builds L and M of a triangle mesh, as robust_laplacian.mesh_laplacian.

    verts: V x 3. faces: F x 3. All else as in point_cloud_laplacian().
    """
    with check.named("mesh_laplacian", mollify="mollify_factor", points="verts"):
        mesh = Mesh(verts, faces, mollify=mollify_factor, threads=threads, progress=progress)
    return _matrices(mesh, dummy, return_mass)


class _HeatSolver:
    """Base of the classes below. Their indices are those of points or vertices."""

    def __init__(self, surface, t_coef):
        t_coef = check.number(type(self).__name__, "t_coef", t_coef)
        if not (t_coef > 0 and np.isfinite(t_coef)):
            raise InvalidInput(f"{type(self).__name__}: t_coef = {t_coef:g}, must be finite and above 0")
        self._surface, self._t_coef = surface, t_coef

    @property
    def surface(self):
        """The PointCloud or Mesh that is solved on, with all other methods."""
        return self._surface


class _Distances(_HeatSolver):
    def compute_distance(self, source_ind):
        """Geodesic distances from one point by the heat method: N values; infinite where no path leads."""
        return self.compute_distance_multisource([source_ind])

    def compute_distance_multisource(self, source_inds):
        """Geodesic distances from the nearest of several points: N values; infinite where no path leads."""
        return self._surface.distance(source_inds, method="heat", time_step=_DISTANCE_STEP * self._t_coef)


class _Vectors(_HeatSolver):
    def extend_scalar(self, source_inds, values):
        """Extends values from some points to all: N values, nearly those of the nearest source."""
        return self._surface.extend(source_inds, values, time_step=_VECTOR_STEP * self._t_coef)

    def get_tangent_frames(self):
        """The x axes, the y axes and the normals of the points: three arrays of N x 3."""
        frames = self._surface.frames
        return frames[:, 0], frames[:, 1], frames[:, 2]

    def transport_tangent_vector(self, source_ind, vector):
        """Transports a tangent vector of one point, 2 coordinates in its frame, to all: N x 2 in their frames."""
        return self.transport_tangent_vectors([source_ind], [vector])

    def transport_tangent_vectors(self, source_inds, vectors):
        """Transports tangent vectors of S points, S x 2 in their frames, to all points: N x 2 in their frames."""
        surface = self._surface
        where = check.indices("transport_tangent_vectors", "source_inds", source_inds, len(surface))
        table, _ = check.columns("transport_tangent_vectors", "vectors", vectors, where.size)
        if table.shape[1] != 2:
            raise InvalidInput(f"transport_tangent_vectors: vectors has {table.shape[1]} columns, must have 2")
        tangents = surface.frames[:, :2]
        carried = surface.transport(where, np.einsum("si,sij->sj", table, tangents[where]),
                                    time_step=_VECTOR_STEP * self._t_coef)
        return np.einsum("nj,nij->ni", carried, tangents)

    def compute_log_map(self, source_ind):
        """The logarithmic map around one point: N x 2, along the first two axes of its frame."""
        surface = self._surface
        source = check.indices("compute_log_map", "source_ind", source_ind, len(surface))[0]
        x, y = surface.frames[source, :2]
        coordinates, axes = surface.log_map(source, axis=x, time_step=_VECTOR_STEP * self._t_coef)
        return coordinates * [1.0, np.sign(axes[1] @ y)]  # negated where log_map() turned the normal


class PointCloudHeatSolver(_Distances, _Vectors):
    """Distances, vectors and log map on a cloud, as potpourri3d.PointCloudHeatSolver.

    P: N x 3. t_coef: factor of the time steps; 1: the library's own. options: those of PointCloud.
    """

    def __init__(self, P, t_coef=1.0, **options):
        with check.named("PointCloudHeatSolver", points="P"):
            super().__init__(PointCloud(P, **options), t_coef)


class MeshHeatMethodDistanceSolver(_Distances):
    """Distances on a mesh, as potpourri3d.MeshHeatMethodDistanceSolver.

    V: N x 3. F: F x 3. t_coef: factor of the time step; 1: the library's own. use_robust: ignored, the tufted Laplacian
    is always used. options: those of Mesh.
    """

    def __init__(self, V, F, t_coef=1.0, use_robust=True, **options):
        with check.named("MeshHeatMethodDistanceSolver", points="V", faces="F"):
            super().__init__(Mesh(V, F, **options), t_coef)


class MeshVectorHeatSolver(_Vectors):
    """Extension, vector transport and log map on a mesh, as potpourri3d.MeshVectorHeatSolver.

    V: N x 3. F: F x 3. t_coef: factor of the time step; 1: the library's own. options: those of Mesh.
    """

    def __init__(self, V, F, t_coef=1.0, **options):
        with check.named("MeshVectorHeatSolver", points="V", faces="F"):
            super().__init__(Mesh(V, F, **options), t_coef)


def compute_distance(V, F, v_ind):
    """Geodesic distances from one vertex of a mesh, N values. For several queries MeshHeatMethodDistanceSolver is
    faster.
    """
    return MeshHeatMethodDistanceSolver(V, F).compute_distance(v_ind)


def compute_distance_multisource(V, F, v_inds):
    """Geodesic distances from the nearest of several vertices of a mesh, N values."""
    return MeshHeatMethodDistanceSolver(V, F).compute_distance_multisource(v_inds)


def read_mesh(path):
    """Reads the vertices, V x 3 float64, and the faces, F x 3 int32, of a file."""
    geometry = _tufted.read_file(path, "mesh", False, None)
    return np.array(geometry.points), np.array(geometry.triangles)


def read_point_cloud(path):
    """Reads the points of a file, N x 3 float64; faces are ignored."""
    return np.array(_tufted.read_file(path, "cloud", False, None).points)
