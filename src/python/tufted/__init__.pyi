from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import Any, Literal, NamedTuple, TypeVar

import numpy as np
import numpy.typing as npt
import scipy.sparse

_Self = TypeVar("_Self", bound="Surface")
_Floats = npt.NDArray[np.float64]
_Integers = npt.NDArray[np.int32]
_Bytes = npt.NDArray[np.uint8]
_Progress = Callable[[str, float], Any] | None
_Path = str | PathLike[str]

__version__: str

class InvalidInput(ValueError): ...
class TuftedWarning(UserWarning): ...
class IoError(OSError): ...
class FileTooLarge(IoError): ...
class SolverFailure(RuntimeError): ...
class Cancelled(RuntimeError): ...

class Spectrum(NamedTuple):
    values: _Floats
    vectors: _Floats

class Gradients(NamedTuple):
    X: scipy.sparse.csc_matrix
    Y: scipy.sparse.csc_matrix
    frames: _Floats

class Curvature(NamedTuple):
    mean: _Floats
    gaussian: _Floats
    principal: _Floats
    directions: _Floats

class Segments(NamedTuple):
    labels: _Integers
    areas: _Floats
    seeds: _Integers

class Denoised(NamedTuple):
    points: _Floats
    noise: _Floats
    moved: int
    outliers: int
    median_noise: float

class Parameterization(NamedTuple):
    uv: _Floats
    quasi_conformal_error: float
    triangles: int
    flipped: int
    collapsed: int
    not_mapped: int

class MinimalSurface(NamedTuple):
    points: _Floats
    area: float
    converged: bool

class Deformation(NamedTuple):
    points: _Floats
    stretch: float
    converged: bool

class Path(NamedTuple):
    points: _Floats
    length: float


class Trace(NamedTuple):
    points: _Floats
    length: float
    ended_by: str
    direction: _Floats
    corners: _Integers
    barycentric: _Floats


class Isoline(NamedTuple):
    points: _Floats
    value: float
    length: float
    closed: bool


class LogMap(NamedTuple):
    coordinates: _Floats
    axes: _Floats

class Surface:
    @property
    def points(self) -> _Floats: ...
    @property
    def L(self) -> scipy.sparse.csc_matrix: ...
    @property
    def M(self) -> _Floats: ...
    @property
    def status(self) -> _Bytes: ...
    @property
    def representative(self) -> _Integers: ...
    @property
    def components(self) -> _Integers: ...
    @property
    def boundary(self) -> _Bytes: ...
    @property
    def positions(self) -> _Floats: ...
    @property
    def frames(self) -> _Floats: ...
    @property
    def report(self) -> dict[str, Any]: ...
    def __len__(self) -> int: ...
    def spectrum(self, k: int | None = None, *, null_space: bool = True, tolerance: float = 1e-10,
                 progress: _Progress = None) -> Spectrum: ...
    def hks(self, times: npt.ArrayLike | None = None, *, k: int = 100, samples: int = 16,
            spectrum: Spectrum | tuple[npt.ArrayLike, npt.ArrayLike] | None = None,
            progress: _Progress = None) -> _Floats: ...
    def wks(self, energies: npt.ArrayLike | None = None, *, width: float | None = None, k: int = 100,
            samples: int = 100, spectrum: Spectrum | tuple[npt.ArrayLike, npt.ArrayLike] | None = None,
            progress: _Progress = None) -> _Floats: ...
    def embed(self, dimension: int | None = None, *, distance: Literal["commute", "biharmonic"] = "commute",
              progress: _Progress = None) -> _Floats: ...
    def filter(self, values: npt.ArrayLike, *, k: int = 100, gain: Callable[[float], float] | None = None,
               spectrum: Spectrum | tuple[npt.ArrayLike, npt.ArrayLike] | None = None,
               progress: _Progress = None) -> _Floats: ...
    def distance(self, sources: npt.ArrayLike = (), *, faces: npt.ArrayLike | None = None,
                 barycentric: npt.ArrayLike | None = None, method: Literal["marching", "heat"] = "marching",
                 split: int | None = None, maximum: float | None = None, time_step: float | None = None,
                 unit: Literal["mean", "adapted"] | None = None, open_boundary: bool | None = None,
                 progress: _Progress = None) -> _Floats: ...
    def nearest_source(self, sources: npt.ArrayLike = (), *, faces: npt.ArrayLike | None = None,
                       barycentric: npt.ArrayLike | None = None, method: Literal["marching", "heat"] = "marching",
                       split: int | None = None, maximum: float | None = None, time_step: float | None = None,
                       unit: Literal["mean", "adapted"] | None = None, open_boundary: bool | None = None,
                       progress: _Progress = None) -> tuple[_Floats, npt.NDArray[np.int32]]: ...
    def points_within(self, sources: npt.ArrayLike, radius: float, *, split: int | None = None,
                      progress: _Progress = None) -> tuple[npt.NDArray[np.int32], _Floats]: ...
    def path(self, start: int, end: int, *, progress: _Progress = None) -> Path: ...
    def trace(self, source: int, direction: npt.ArrayLike, length: float, *, barycentric: npt.ArrayLike | None = None,
              progress: _Progress = None) -> Trace: ...
    def isolines(self, field: npt.ArrayLike, values: npt.ArrayLike, *, progress: _Progress = None) -> list[Isoline]: ...
    def extend(self, sources: npt.ArrayLike, values: npt.ArrayLike, *, time_step: float = 4.0,
               progress: _Progress = None) -> _Floats: ...
    def transport(self, sources: npt.ArrayLike, vectors: npt.ArrayLike, *, time_step: float = 4.0,
                  progress: _Progress = None) -> _Floats: ...
    def log_map(self, source: int, *, axis: npt.ArrayLike | None = None, time_step: float = 4.0,
                progress: _Progress = None) -> LogMap: ...
    def signed_distance(self, curve: npt.ArrayLike, *, time_step: float = 4.0,
                        progress: _Progress = None) -> _Floats: ...
    def harmonic(self, pins: Mapping[int, Any] | npt.ArrayLike, values: npt.ArrayLike | None = None, *,
                 progress: _Progress = None) -> _Floats: ...
    def biharmonic(self, pins: Mapping[int, Any] | npt.ArrayLike, values: npt.ArrayLike | None = None, *,
                   progress: _Progress = None) -> _Floats: ...
    def weights(self, handles: Sequence[npt.ArrayLike], *, progress: _Progress = None) -> _Floats: ...
    def poisson(self, f: npt.ArrayLike, pins: Mapping[int, Any] | npt.ArrayLike | None = None,
                values: npt.ArrayLike | None = None, *, progress: _Progress = None) -> _Floats: ...
    def green(self, points: npt.ArrayLike, *, progress: _Progress = None) -> _Floats: ...
    def gradients(self, *, neighbors: int | None = None, regularization: float = 0.0,
                  progress: _Progress = None) -> Gradients: ...
    def divergence(self, vectors: npt.ArrayLike, *, neighbors: int | None = None, regularization: float = 0.0,
                   progress: _Progress = None) -> _Floats: ...
    def operators(self, k: int | None = None, *, neighbors: int | None = None, regularization: float = 0.0,
                  progress: _Progress = None) -> dict[str, Any]: ...
    def normals(self, *, viewpoint: npt.ArrayLike | None = None, up: npt.ArrayLike | None = None,
                progress: _Progress = None) -> _Floats: ...
    def curvature(self, *, method: Literal["fit", "laplacian"] = "fit", rings: int | None = None,
                  progress: _Progress = None) -> Curvature: ...
    def segments(self, count: int | None = None, *, method: Literal["voronoi", "spectral", "parts"] = "voronoi",
                 seeds: npt.ArrayLike | None = None, crease: float = 0.08, least_points: int = 100,
                 progress: _Progress = None) -> Segments: ...
    def smooth(self, points: npt.ArrayLike | None = None, *, method: Literal["implicit", "taubin"] = "implicit",
               time_step: float = 1.0, lambda_: float = 0.5, mu: float = -0.53, iterations: int = 1,
               fixed: npt.ArrayLike | None = None, keep_volume: bool = False,
               progress: _Progress = None) -> _Floats: ...
    def smooth_values(self, values: npt.ArrayLike, *, method: Literal["implicit", "taubin"] = "implicit",
                      time_step: float = 1.0, lambda_: float = 0.5, mu: float = -0.53, iterations: int = 1,
                      fixed: npt.ArrayLike | None = None, progress: _Progress = None) -> _Floats: ...
    def parameterize(self, *, method: Literal["conformal", "harmonic"] = "conformal",
                     weights: Literal["laplacian", "mean-value"] = "laplacian", rim: npt.ArrayLike | None = None,
                     rim_positions: npt.ArrayLike | None = None, progress: _Progress = None) -> Parameterization: ...
    def minimal_surface(self, fixed: npt.ArrayLike | None = None, *, tolerance: float = 1e-4,
                        max_iterations: int = 300, progress: _Progress = None) -> MinimalSurface: ...
    def deform(self, handles: npt.ArrayLike, targets: npt.ArrayLike, *,
               method: Literal["rigid", "linear"] = "rigid", smoothness: float = 1e-3, tolerance: float = 1e-3,
               max_iterations: int = 500, progress: _Progress = None) -> Deformation: ...
    def nearest(self, positions: npt.ArrayLike, *, progress: _Progress = None) -> Any: ...
    def validate(self, *, progress: _Progress = None) -> dict[str, Any]: ...
    def restricted_to(self: _Self, components: str | npt.ArrayLike = "largest", *,
                      progress: _Progress = None) -> _Self: ...
    def save(self, directory: _Path, *, formats: str | Sequence[str] | None = None,
             sign: Literal["psd", "igl"] = "psd", dummy: bool = False, progress: _Progress = None) -> None: ...

class PointCloud(Surface):
    def __init__(self, points: npt.ArrayLike, preset: Literal["scan", "clean", "lidar"] = "scan", neighbors: int = 30,
                 normals: npt.ArrayLike | None = None, *, viewpoint: npt.ArrayLike | None = None,
                 image: tuple[int, int] | None = None, rings: npt.ArrayLike | Literal["find"] | None = None,
                 neighborhoods: npt.ArrayLike | None = None, mollify: float = 1e-06,
                 gluing: Literal["star", "vertex-pair"] = "star", order: Literal["angle", "area", "random"] = "angle",
                 seed: int = 0, delaunay: Literal["star", "cgal"] = "star", threads: int = 0,
                 solver: Literal["automatic", "cholesky", "multigrid"] = "automatic", memory_limit: int = 0,
                 progress: _Progress = None) -> None: ...
    def triangles(self, *, progress: _Progress = None) -> _Integers: ...

class Mesh(Surface):
    def __init__(self, points: npt.ArrayLike, faces: npt.ArrayLike, *, mollify: float = 1e-06,
                 order: Literal["angle", "area", "random"] = "angle", seed: int = 0, weld: bool = False,
                 threads: int = 0, solver: Literal["automatic", "cholesky", "multigrid"] = "automatic",
                 memory_limit: int = 0, progress: _Progress = None) -> None: ...
    @property
    def faces(self) -> _Integers: ...
    def triangles(self) -> _Integers: ...

def read(path: _Path, *, kind: Literal["automatic", "cloud", "mesh"] = "automatic", weld: bool = False,
         image: bool | None = None, rings: npt.ArrayLike | bool | Literal["find"] | None = None, normals: bool = False,
         progress: _Progress = None, **options: Any) -> Any: ...
def denoise(points: npt.ArrayLike, *, image: tuple[int, int] | None = None, viewpoint: npt.ArrayLike | None = None,
            threads: int = 0, progress: _Progress = None) -> Denoised: ...
def load(directory: _Path, *, threads: int = 0, solver: Literal["automatic", "cholesky", "multigrid"] = "automatic",
         memory_limit: int = 0, progress: _Progress = None) -> Any: ...
def point_cloud_laplacian(points: npt.ArrayLike, mollify_factor: float = 1e-06, n_neighbors: int = 30,
                          return_mass: bool = True, *, preset: Literal["scan", "clean", "lidar"] = "scan",
                          dummy: bool = True, threads: int = 0, progress: _Progress = None) -> Any: ...
def mesh_laplacian(verts: npt.ArrayLike, faces: npt.ArrayLike, mollify_factor: float = 1e-06, return_mass: bool = True,
                   *, dummy: bool = True, threads: int = 0, progress: _Progress = None) -> Any: ...

class _HeatSolver:
    @property
    def surface(self) -> Surface: ...

class _Distances(_HeatSolver):
    def compute_distance(self, source_ind: int) -> _Floats: ...
    def compute_distance_multisource(self, source_inds: npt.ArrayLike) -> _Floats: ...

class _Vectors(_HeatSolver):
    def extend_scalar(self, source_inds: npt.ArrayLike, values: npt.ArrayLike) -> _Floats: ...
    def get_tangent_frames(self) -> tuple[_Floats, _Floats, _Floats]: ...
    def transport_tangent_vector(self, source_ind: int, vector: npt.ArrayLike) -> _Floats: ...
    def transport_tangent_vectors(self, source_inds: npt.ArrayLike, vectors: npt.ArrayLike) -> _Floats: ...
    def compute_log_map(self, source_ind: int) -> _Floats: ...

class PointCloudHeatSolver(_Distances, _Vectors):
    def __init__(self, P: npt.ArrayLike, t_coef: float = 1.0, **options: Any) -> None: ...

class MeshHeatMethodDistanceSolver(_Distances):
    def __init__(self, V: npt.ArrayLike, F: npt.ArrayLike, t_coef: float = 1.0, use_robust: bool = True,
                 **options: Any) -> None: ...

class MeshVectorHeatSolver(_Vectors):
    def __init__(self, V: npt.ArrayLike, F: npt.ArrayLike, t_coef: float = 1.0, **options: Any) -> None: ...

def compute_distance(V: npt.ArrayLike, F: npt.ArrayLike, v_ind: int) -> _Floats: ...
def compute_distance_multisource(V: npt.ArrayLike, F: npt.ArrayLike, v_inds: npt.ArrayLike) -> _Floats: ...
def read_mesh(path: _Path) -> tuple[_Floats, _Integers]: ...
def read_point_cloud(path: _Path) -> _Floats: ...
