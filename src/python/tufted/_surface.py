"""What clouds and meshes have in common: L and M, and all that is computed from them."""
import html
import warnings

import numpy as np

from . import _arguments as check
from . import _tufted
from ._distances import Distances
from ._equations import Equations, frames_of
from ._results import TuftedWarning
from ._shape import Shape
from ._spectral import Spectral
from ._tufted import InvalidInput

# Points that a notebook shows: a page of more would make its file larger than some ten megabytes.
_LARGEST_PAGE = 500_000


class Surface(Spectral, Distances, Equations, Shape):
    """L and M of a cloud or a mesh, and all that is computed from them. Made by PointCloud, Mesh, read and load.

    Arrays that show the library's own memory (L, M, status, ...) cannot be written to; take a copy to change one.
    What is costly to make, a factor or a spectrum, is kept, so a second call with the same options is quick; of each
    method the last one. Methods may run in several threads at once. All take `progress`, a function of a stage's name
    and the fraction of it that is done, which stops the computation by returning False; Ctrl-C stops it as well.
    """

    def __init__(self, laplacian, points, faces, solving, options=None, geometry=None, source="",
                 formats=("npz", "ply")):
        self._laplacian = laplacian
        self._points = points
        self._faces = faces
        self._solving = solving  # solver, memory_limit, threads
        self._options = options  # of the build: a dict, or as the JSON of the folder that it was loaded from
        self._geometry = geometry  # all that a file holds; points and faces are its own
        self._source = source
        self._formats = formats  # that save() writes unless it is told
        self._kept = {}

    # What is known

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
        """The area of each point, N float64, length^2. scipy.sparse.diags(M) is the matrix."""
        return self._laplacian.M

    @property
    def status(self):
        """Why a point takes part or not, N uint8: 0 active, 1 not finite, 2 coincident, 3 isolated."""
        return self._laplacian.status

    @property
    def representative(self):
        """The point that stands for a coincident one, else the point itself; N int32."""
        return self._laplacian.representative

    @property
    def components(self):
        """The connected component of each point, N int32; 0 has the most points, -1: takes no part."""
        return self._laplacian.component

    @property
    def boundary(self):
        """Why the surface ends at a point, N uint8: 0 it does not, 1 rim, 2 depth jump, 3 triangles are missing."""
        return self._laplacian.boundary

    @property
    def positions(self):
        """Where lengths are measured, N x 3 float64: the points, noisy ones of a cloud put back onto the surface."""
        return self._laplacian.positions

    @property
    def frames(self):
        """Tangent frames, N x 3 x 3 float64: of each point the x axis, the y axis and the normal."""
        return self._keep("frames", lambda: frames_of(*self._frame_parts()))

    @property
    def report(self):
        """What happened in the build: counts, lengths, areas and stages, as a dict."""
        return self._laplacian.report

    def _warn(self):
        """Warns of what a user must know of the build, once it is made or loaded."""
        for sentence in self.report["warnings"]:
            warnings.warn(f"{self._source or type(self).__name__}: {sentence}", TuftedWarning, stacklevel=3)

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

    def _repr_html_(self):
        if len(self) > _LARGEST_PAGE:
            return f"<pre>{html.escape(repr(self))}</pre>"
        labels = self.components.astype(np.float64).reshape(-1, 1)
        boundary = self.boundary.astype(np.float64).reshape(-1, 1) - 1  # none is grey
        fields = [("area of a point", "positive", self.M.reshape(-1, 1), "", [], ""),
                  ("component", "label", labels, "", [], ""),
                  ("boundary", "label", boundary, "", ["rim", "jump", "lost"], "none")]
        faces = np.zeros((0, 3), np.int32) if self._faces is None else self._faces
        page = _tufted.page(self._source or f"tufted.{type(self).__name__}", self._points, faces,
                            self._frame_parts()[0], fields)
        # The page runs by itself: what it may do in a notebook ends at its frame.
        return (f'<iframe srcdoc="{html.escape(page)}" sandbox="allow-scripts allow-downloads" width="100%" '
                f'height="480" style="border: 0" title="{html.escape(repr(self))}"></iframe>')

    def __getstate__(self):
        arrays = (self._points, self._faces) if self._geometry is None else None  # otherwise of the geometry
        return {"laplacian": _tufted.state_of(self._laplacian), "arrays": arrays, "geometry": self._geometry,
                "solving": self._solving, "options": self._options, "source": self._source, "formats": self._formats}

    def __setstate__(self, state):
        geometry = state["geometry"]
        points, faces = state["arrays"] or (geometry.points, geometry.triangles if geometry.is_mesh else None)
        Surface.__init__(self, _tufted.from_state(state["laplacian"]), points, faces, state["solving"],
                         state["options"], geometry, state["source"], state["formats"])

    # Points, checks and files

    def nearest(self, positions, *, progress=None):
        """The active points nearest to positions.

        positions: P x 3, or 3 values for one.
        Returns P indices, or one.
        """
        single = np.ndim(positions) == 1
        found = _tufted.nearest(self._laplacian, self._points,
                                check.rows_of_three("nearest", "positions", np.atleast_2d(positions)),
                                check.callback("nearest", progress))
        return int(found[0]) if single else found

    def validate(self, *, progress=None):
        """Checks what is promised of L and M: symmetry, signs, sums, definiteness, and every weight against the cover.

        Returns a dict: ok, faults (a sentence for each broken promise), not_checked, and what was measured.
        """
        return _tufted.validate(self._laplacian, check.callback("validate", progress))

    def restricted_to(self, components="largest", *, progress=None):
        """The surface of some components alone; all other points are isolated, and keep their index.

        components: "largest", a label of `components`, or several.
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
        """Writes what `tufted laplacian` writes with the same options, all files or none.

        formats: of npz, mtx, mat, spmat, ply, pcd, cover, triangles; None: npz and ply, or what load() has taken.
        "cover" lets load() compute distances, too.
        sign: of L in the files: "psd" as here, or "igl", negated.
        dummy: whether points that take no part get values on the diagonals, for full rank.
        """
        formats = [formats] if isinstance(formats, str) else list(self._formats if formats is None else formats)
        geometry = self._geometry or _tufted.Geometry(self._points, self._faces)
        _tufted.save(directory, self._laplacian, geometry, formats, self._source, sign, bool(dummy), self._options,
                     check.callback("save", progress))

    # What its parts share

    def _keep(self, name, make, settings=None):
        """What `make` returns, made by the first call and by those whose settings are not those of the last one. Only
        the last is kept, as others would fill the memory. Threads that come at once may make it twice."""
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
        """The triangles of a mesh, or those found on a cloud."""
        if self._faces is None:
            self._need_cover(function)
        return self._keep("faces", self.triangles)

    def _frame_parts(self):
        """Normals and tangents."""
        return self._laplacian.normals, self._laplacian.tangents

    def _signed_frames(self, viewpoint=None, progress=None, up=None):
        """Normals and tangents whose signs agree."""
        orientation = self._orientation()
        if viewpoint is not None and up is not None:
            raise InvalidInput("normals: viewpoint and up are both given, must be one at most")
        if viewpoint is None and up is None and orientation == 2:  # towards the sensor
            return self._frame_parts()
        progress = check.callback("normals", progress)
        if viewpoint is not None:
            viewpoint = check.vector_of_three("normals", "viewpoint", viewpoint)
        if up is not None:
            up = check.vector_of_three("normals", "up", up)

        def oriented():
            return _tufted.oriented_frames(self._laplacian, *self._frame_parts(), orientation, viewpoint, up, progress)

        return self._keep("signed frames", oriented) if viewpoint is None and up is None else oriented()

    def _orientation(self):
        return self._laplacian.orientation
