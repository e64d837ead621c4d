"""Results of methods that return several values, or something to look at."""
import html
from typing import NamedTuple

import numpy as np
import scipy.sparse

from . import _arguments as check


class TuftedWarning(UserWarning):
    """Something about the data or a result that a user should know. Warnings of a build are also in
    report["warnings"].
    """


class Spectrum(NamedTuple):
    """The first eigenpairs of L x = lambda M x, see Surface.spectrum()."""
    values: np.ndarray
    vectors: np.ndarray


class Signature(np.ndarray):
    """The N x T array of Surface.hks() or Surface.wks(), which knows where its columns were computed.

    times: T times of hks(), length^2. energies, width: T energies of wks() and their width, natural logarithms of
    eigenvalues. Those of the other kind are None, and all are None on parts. Copies and pickles lose the times and
    energies, too, and results of arithmetic, sums and maxima are plain arrays and numbers.
    """
    times = energies = width = None

    def __array_wrap__(self, array, context=None, return_scalar=False):
        return np.asarray(array)[()]


def signature(values, **where):
    """`values` as a Signature computed at these times, or at these energies with this width."""
    found = values.view(Signature)
    vars(found).update(where)
    return found


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


class PointMaps(NamedTuple):
    """Maps between the points of two shapes, see point_maps()."""
    to_target: np.ndarray
    to_source: np.ndarray


class LogMap(NamedTuple):
    """Coordinates around a point, see Surface.log_map()."""
    coordinates: np.ndarray
    axes: np.ndarray


@check.public
class Picture(NamedTuple):
    """A picture of a surface, see Surface.picture(). A notebook shows it.

    png: the bytes of a PNG file.
    """
    png: bytes

    def save(self, path):
        """Writes the picture to a file. path: its name, which should end in .png. Raises IoError if it cannot."""
        check.write(check.path("save", "path", path), self.png)

    def _repr_png_(self):
        return self.png

    def __repr__(self):
        width, height = (int.from_bytes(self.png[at:at + 4], "big") for at in (16, 20))  # in the header of a PNG file
        return f"<tufted.Picture: {width} x {height} pixels, {len(self.png):,} bytes>"


class Page(str):
    """The text of an HTML page that shows a surface, see Surface.page(). A notebook shows the page itself."""

    def _repr_html_(self, title="tufted"):
        # The sandbox keeps the page's scripts out of the notebook.
        return (f'<iframe srcdoc="{html.escape(self)}" sandbox="allow-scripts allow-downloads" width="100%" '
                f'height="480" style="border: 0" title="{html.escape(title)}"></iframe>')

    def __repr__(self):
        return f"<tufted.Page: {len(self):,} characters>"
