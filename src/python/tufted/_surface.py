"""The class Surface: L and M, and all algorithms on them, which clouds and meshes share."""
import warnings

import numpy as np

from . import _arguments as check
from . import _tufted
from ._distances import Distances
from ._equations import Equations, frames_of
from ._figures import Figures
from ._results import TuftedWarning
from ._shape import Shape
from ._spectral import Spectral
from ._tufted import InvalidInput


@check.public
class Surface(Spectral, Distances, Equations, Shape, Figures):
    """L and M of a cloud or a mesh, and the algorithms on them. Made by PointCloud, Mesh, read and load.

    N is the number of points. Lengths are in the points' unit. Results at a coincident point are those of its
    representative. Arrays that show the library's own memory (L, M, status, ...) are read-only; copy one to change it.
    What is costly to make, such as a factor or a spectrum, is kept, of each kind the last one, so that a second call
    with the same options is fast. Several threads may call methods at once.

    All long computations take `progress`, a function of a stage's name and the fraction of it that is begun, in [0, 1].
    If it returns False the method raises Cancelled; Ctrl-C raises KeyboardInterrupt. Arguments of a wrong shape or out
    of range raise InvalidInput, systems that cannot be solved SolverFailure.
    """

    def __init__(self, laplacian, points, faces, solving, options=None, geometry=None, source="",
                 formats=("npz", "ply")):
        self._laplacian = laplacian
        self._points = points
        self._faces = faces
        self._solving = solving  # solver, memory_limit, threads
        self._options = options  # of the build: a dict or, after load(), JSON text of the folder's report
        self._geometry = geometry  # content of the file that was read, whose points and faces are used; None: no file
        self._source = source
        self._formats = formats  # that save() writes by default
        self._kept = {}

    # Properties

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
        """The lumped area of each point, N float64, length^2; the mass matrix is scipy.sparse.diags(M)."""
        return self._laplacian.M

    @property
    def status(self):
        """Why a point does or does not take part, N uint8: 0 active, 1 not finite, 2 coincident, 3 isolated."""
        return self._laplacian.status

    @property
    def file_row(self):
        """The row of each point in the file, N int32, if read() kept some of its points; otherwise None."""
        return None if self._geometry is None else self._geometry.fields.get("file_row")

    @property
    def representative(self):
        """The point itself or, for a coincident point, the lowest index of an equal point; N int32."""
        return self._laplacian.representative

    @property
    def components(self):
        """The label of each point's connected component, N int32: 0 has the most active points; -1 at isolated and
        non-finite points.
        """
        return self._laplacian.component

    @property
    def boundary(self):
        """Why the surface ends at a point, N uint8: 0 it does not, 1 rim (nothing lies beyond), 2 jump (another
        surface lies beyond), 3 lost (triangles are missing).
        """
        return self._laplacian.boundary

    @property
    def positions(self):
        """The positions between which lengths are measured, N x 3 float64: the points, but noisy ones of a cloud are
        moved onto the surface.
        """
        return self._laplacian.positions

    @property
    def frames(self):
        """Tangent frames, N x 3 x 3 float64: the x axis, the y axis and the normal of each point."""
        return self._keep("frames", lambda: frames_of(*self._frame_parts()))

    @property
    def report(self):
        """Counts, lengths, areas, warnings and stages of the build, as a dict."""
        return self._laplacian.report

    def _warn(self, more=""):
        """Issues the warnings of the build's report, after building or loading, and one more if it is not empty."""
        for sentence in filter(None, [*self.report["warnings"], more]):
            warnings.warn(f"{self._source or type(self).__name__}: {sentence}", TuftedWarning, stacklevel=4)

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

    def __getstate__(self):
        arrays = (self._points, self._faces) if self._geometry is None else None  # None: the geometry has them
        return {"laplacian": _tufted.state_of(self._laplacian), "arrays": arrays, "geometry": self._geometry,
                "solving": self._solving, "options": self._options, "source": self._source, "formats": self._formats}

    def __setstate__(self, state):
        geometry = state["geometry"]
        points, faces = state["arrays"] or (geometry.points, geometry.triangles if geometry.is_mesh else None)
        Surface.__init__(self, _tufted.from_state(state["laplacian"]), points, faces, state["solving"],
                         state["options"], geometry, state["source"], state["formats"])

    # Points, checks and files

    def nearest(self, positions, *, progress=None):
        """Finds the active points nearest to positions.

        positions: P x 3, or 3 values for a single one.
        Returns P indices, or a single one.
        """
        positions = check.array("nearest", "positions", positions)
        found = _tufted.nearest(self._laplacian, self._points,
                                check.rows_of_three("nearest", "positions", positions, or_one=True),
                                check.callback("nearest", progress))
        return int(found[0]) if positions.shape == (3,) else found

    def validate(self, *, progress=None):
        """Checks what L and M promise: symmetry, signs, row sums, definiteness, and equality with values assembled anew
        from the cover.

        Returns a dict: ok, faults (a sentence for each broken promise), not_checked (a sentence for each check that
        could not be made), and the measurements.
        """
        return _tufted.validate(self._laplacian, check.callback("validate", progress))

    def restricted_to(self, components="largest", *, progress=None):
        """Restricts the surface to some of its connected components. All other points become isolated and keep their
        index.

        components: "largest" (that of the most active points), a label of `components`, or several.
        Returns a surface of the same class.
        """
        if isinstance(components, str):
            if components != "largest":
                raise InvalidInput(f"restricted_to: components = '{components}', must be 'largest' or labels")
            components = 0
        labels = check.integers("restricted_to", "components", components).reshape(-1)
        restricted = type(self).__new__(type(self))
        laplacian = self._laplacian.restricted_to(labels.tolist(), check.callback("restricted_to", progress))
        Surface.__init__(restricted, laplacian, self._points, self._faces, self._solving, self._options,
                         self._geometry, self._source, self._formats)
        return restricted

    def save(self, directory, *, formats=None, sign="psd", dummy=False, progress=None):
        """Writes the files that `tufted laplacian` writes with the same options, all of them or none.

        directory: created if missing.
        formats: of npz, mtx, mat, spmat, petsc, ply, pcd, las, cover, triangles; None: npz and ply or, after load(), the
        formats loaded. Only with "cover" can distances and paths be computed after load().
        sign: of L in the files: "psd", positive semidefinite as here, or "igl", negated.
        dummy: whether points that take no part get values on the diagonals of L and M, for programs that expect full
        rank.
        Raises IoError if a file cannot be written.
        """
        formats = [formats] if isinstance(formats, str) else check.items(
            "save", "formats", self._formats if formats is None else formats)
        formats = [check.text("save", "formats", each) for each in formats]
        directory = check.path("save", "directory", directory)
        geometry = self._geometry or _tufted.Geometry(self._points, self._faces)
        _tufted.save(directory, self._laplacian, geometry, formats, self._source, check.text("save", "sign", sign),
                     check.flag("save", "dummy", dummy), self._options,
                     check.callback("save", progress))

    # Shared by the base classes

    def _keep(self, name, make, settings=None):
        """Returns the last result of `make` under this name if it was made with the same settings, otherwise calls
        `make`. Keeps one result per name, to bound the memory. Threads that call at once may each make it.
        """
        kept = self._kept.get(name)
        if kept is None or kept[0] != settings:
            self._kept.pop(name, None)  # before the new one takes memory
            kept = self._kept[name] = settings, make()
        return kept[1]

    def _solver(self):
        return _tufted.Solving(**self._solving)

    def _need_cover(self, function):
        if not self._laplacian.has_cover:
            raise InvalidInput(f"{function}: the cover is missing, must be saved: formats=('npz', 'ply', 'cover')")

    def _surface_faces(self, function):
        """The triangles of a mesh, or triangles() of a cloud."""
        if self._faces is None:
            self._need_cover(function)
        return self._keep("faces", self.triangles)

    def _frame_parts(self):
        """Normals and tangents, N x 3 each."""
        return self._laplacian.normals, self._laplacian.tangents

    def _signed_frames(self, viewpoint=None, progress=None, up=None):
        """Frames whose normals have one sign on each component, see normals(), as normals and tangents."""
        orientation = self._orientation()
        if viewpoint is not None and up is not None:
            raise InvalidInput("normals: viewpoint and up are both given, must be one at most")
        if viewpoint is None and up is None and orientation == 2:  # Orientation::viewpoint
            return self._frame_parts()
        progress = check.callback("normals", progress)
        if viewpoint is not None:
            viewpoint = check.vector_of_three("normals", "viewpoint", viewpoint)
        if up is not None:
            up = check.vector_of_three("normals", "up", up)

        def oriented():
            return _tufted.oriented_frames(self._laplacian, *self._frame_parts(), orientation, viewpoint, up,
                                           self._solving["threads"], progress)

        return self._keep("signed frames", oriented) if viewpoint is None and up is None else oriented()

    def _orientation(self):
        return self._laplacian.orientation
