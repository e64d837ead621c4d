"""What methods return beside plain arrays."""
from typing import NamedTuple

import numpy as np
import scipy.sparse


class TuftedWarning(UserWarning):
    """Something about the data or the build that a user must know; the report's "warnings" have it as well."""


class Spectrum(NamedTuple):
    """The first eigenpairs of L x = lambda M x."""
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
    """Segments of a surface."""
    labels: np.ndarray
    areas: np.ndarray
    seeds: np.ndarray


class Denoised(NamedTuple):
    """Points on the surface that noisy ones lie around, and the standard deviation of the noise: at each point, 0 where
    it stayed, and in the median over those that moved."""
    points: np.ndarray
    noise: np.ndarray
    moved: int
    outliers: int
    median_noise: float


class Parameterization(NamedTuple):
    """A surface laid out in the plane."""
    uv: np.ndarray
    quasi_conformal_error: float
    triangles: int
    flipped: int
    collapsed: int
    not_mapped: int


class MinimalSurface(NamedTuple):
    """A surface of least area."""
    points: np.ndarray
    area: float
    converged: bool


class Deformation(NamedTuple):
    """A surface that has followed its handles."""
    points: np.ndarray
    stretch: float
    converged: bool


class Path(NamedTuple):
    """A path over the surface."""
    points: np.ndarray
    length: float


class LogMap(NamedTuple):
    """Coordinates around a point."""
    coordinates: np.ndarray
    axes: np.ndarray
