"""Results of methods that return several values."""
from typing import NamedTuple

import numpy as np
import scipy.sparse


class TuftedWarning(UserWarning):
    """Something about the data or a result that a user should know. Warnings of a build are also in
    report["warnings"].
    """


class Spectrum(NamedTuple):
    """The first eigenpairs of L x = lambda M x, see Surface.spectrum()."""
    values: np.ndarray
    vectors: np.ndarray


class Gradients(NamedTuple):
    """Slopes of functions on the points: X @ u along the first axis of `frames`, Y @ u along the second."""
    X: scipy.sparse.csc_matrix
    Y: scipy.sparse.csc_matrix
    frames: np.ndarray


class Curvature(NamedTuple):
    """Curvature of the surface at each point, positive where it bends away from the normal."""
    mean: np.ndarray
    gaussian: np.ndarray
    principal: np.ndarray
    directions: np.ndarray


class Segments(NamedTuple):
    """Segments of a surface, see Surface.segments()."""
    labels: np.ndarray
    areas: np.ndarray
    seeds: np.ndarray


class Denoised(NamedTuple):
    """Points moved onto the surface, and the noise that they had, see denoise()."""
    points: np.ndarray
    noise: np.ndarray
    moved: int
    outliers: int
    median_noise: float


class Parameterization(NamedTuple):
    """A surface laid out in the plane, see Surface.parameterize()."""
    uv: np.ndarray
    quasi_conformal_error: float
    triangles: int
    flipped: int
    collapsed: int
    not_mapped: int


class MinimalSurface(NamedTuple):
    """A surface of least area, see Surface.minimal_surface()."""
    points: np.ndarray
    area: float
    converged: bool


class Deformation(NamedTuple):
    """A deformed surface, see Surface.deform()."""
    points: np.ndarray
    stretch: float
    converged: bool


class Path(NamedTuple):
    """A path on the surface, see Surface.path()."""
    points: np.ndarray
    length: float


class Trace(NamedTuple):
    """A straight line on the surface, see Surface.trace()."""
    points: np.ndarray
    length: float
    ended_by: str
    direction: np.ndarray
    corners: np.ndarray
    barycentric: np.ndarray


class Isoline(NamedTuple):
    """A line on which a field has one value, see Surface.isolines()."""
    points: np.ndarray
    value: float
    length: float
    closed: bool


class LogMap(NamedTuple):
    """Coordinates around a point, see Surface.log_map()."""
    coordinates: np.ndarray
    axes: np.ndarray
