"""Clouds and meshes, from arrays and from files."""
import json
import os
import warnings

import numpy as np

from . import _arguments as check
from . import _tufted
from ._results import Denoised, TuftedWarning
from ._surface import Surface
from ._tufted import InvalidInput


def _solving(function, threads, solver, memory_limit):
    if check.text(function, "solver", solver) not in ("automatic", "cholesky", "multigrid"):
        raise InvalidInput(f"{function}: solver = {solver!r}, must be one of 'automatic', 'cholesky', 'multigrid'")
    return {"solver": solver, "memory_limit": check.whole(function, "memory_limit", memory_limit, 0),
            "threads": check.whole(function, "threads", threads, 0)}


def _pixels(function, points, image, origin):
    size = check.integers(function, "image", image)
    if size.shape != (2,) or size.min() < 0 or size[0] * size[1] != len(points):
        raise InvalidInput(f"{function}: image = {image!r}, must be (width, height) of {len(points)} points")
    return _tufted.image_structure(int(size[0]), int(size[1]), origin)


@check.public
class PointCloud(Surface):
    """The Laplacian of a point cloud, built by the constructor.

    points: N x 3, float32 or float64 (float64 in C order is not copied), in any unit of length; rows that are not
    finite keep their index and take no part.
    preset: "scan" for real scans, "clean" for exact samples, "lidar" for spinning scanners.
    neighbors: number k >= 3 of nearest neighbours of each point.
    normals: N x 3, any length, used with their sign for the tangent planes, and to tell the two sides of thin parts
        apart, where they are opposed; None: planes are fitted.
    viewpoint: position of the sensor, 3 values; normals then face it.
    image: (width, height) of a depth image, whose pixels are the N points row by row: the pixels around a point are its
    neighbours, and noise is smoothed along the rays.
    rings: N numbers of the rings of a spinning scanner, negative where unknown, or "find" to find them; neighbours are
    then taken from the rings.
    neighborhoods: N x k indices used as they are; negative ones are padding.
    mollify: no edge is shorter than this times the longest side of the smaller of its triangles, in [0, 1]; 0: no edge
    is lengthened.
    gluing: "star" or "vertex-pair". order: of the faces around an edge: by "angle", "area" or "random" with `seed`.
    delaunay: "star" or "cgal" finds the Delaunay stars.
    threads: at most this many; 0: one per processor. solver: "automatic", "cholesky" or "multigrid". memory_limit: most
    bytes for factors; 0: half of the available memory. All methods use these three.
    progress: see Surface.

    >>> cloud = tufted.PointCloud(points)
    >>> cloud.L.shape == (len(points), len(points))
    True
    >>> values, vectors = cloud.spectrum(4)
    >>> print(values.round(1))  # of a sphere
    [0. 2. 2. 2.]
    """

    def __init__(self, points, preset="scan", neighbors=30, normals=None, *, viewpoint=None, image=None, rings=None,
                 neighborhoods=None, mollify=_tufted.default_mollify, gluing="star", order="angle", seed=0,
                 delaunay="star", threads=0, solver="automatic", memory_limit=0, progress=None):
        name = "PointCloud"
        if not isinstance(preset, str):  # the second argument of other packages
            raise InvalidInput(f"{name}: preset is a {type(preset).__name__}, must be 'scan', 'clean' or 'lidar'; a "
                               "number of neighbours is given as neighbors=30, and triangles to Mesh")
        solving = _solving(name, threads, solver, memory_limit)
        points = check.rows_of_three(name, "points", points)
        if normals is not None:
            normals = check.rows_of_three(name, "normals", normals, len(points))
        if viewpoint is not None:
            viewpoint = check.vector_of_three(name, "viewpoint", viewpoint)
        if neighborhoods is not None:
            neighborhoods = check.integers(name, "neighborhoods", neighborhoods)
            if neighborhoods.ndim != 2 or len(neighborhoods) != len(points):
                raise InvalidInput(f"{name}: neighborhoods must be {len(points)} x k, one row per point")
        structure = self._structure(name, points, image, rings, viewpoint)
        options = {
            "preset": preset, "neighbors": check.whole(name, "neighbors", neighbors, 3),
            "gluing": check.text(name, "gluing", gluing), "delaunay": check.text(name, "delaunay", delaunay),
            "order": check.text(name, "order", order), "seed": check.whole(name, "seed", seed, 0),
            "mollify": check.number(name, "mollify", mollify), "threads": solving["threads"],
            "viewpoint": None if viewpoint is None else viewpoint.copy(),
            "structure": "none" if structure is None else "image" if rings is None else "rings",
            "given_normals": normals is not None, "given_neighborhoods": neighborhoods is not None}
        laplacian = _tufted.build_cloud(points, options, normals, neighborhoods, structure,
                                        check.callback(name, progress))
        super().__init__(laplacian, points, None, solving, options)
        self._warn(_tufted.hovering_warning(points) if structure is None else "")

    @staticmethod
    def _structure(name, points, image, rings, viewpoint):
        origin = np.zeros(3) if viewpoint is None else viewpoint
        if image is not None and rings is not None:
            raise InvalidInput(f"{name}: image and rings are both given, must be one at most")
        for structure in (image, rings):
            if isinstance(structure, _tufted.ScanStructure):  # made by read() from a file
                return structure
        if image is not None:
            return _pixels(name, points, image, origin)
        if isinstance(rings, str):
            if rings != "find":
                raise InvalidInput(f"{name}: rings = '{rings}', must be numbers or 'find'")
            return _tufted.find_rings(points, origin)
        if rings is not None:
            return _tufted.ring_structure(points, check.integers(name, "rings", rings), origin)
        return None

    def triangles(self, *, progress=None):
        """Selects triangles that form a surface, for display and for programs that take meshes. Their corners lie at
        `positions`.

        Returns F x 3 int32: every edge has one or two triangles, and triangles joined by edges are oriented
        consistently.
        """
        self._need_cover("triangles")
        return _tufted.triangles(self._laplacian, check.callback("triangles", progress))


@check.public
class Mesh(Surface):
    """The Laplacian of a triangle mesh of any connectivity, built by the constructor.

    points: V x 3, as in PointCloud.
    faces: F x 3 indices of any integer type; those with a repeated or non-finite vertex are dropped and counted in
    `report`.
    mollify, order, seed, threads, solver, memory_limit, progress: as in PointCloud.
    weld: whether vertices of equal position are joined; all keep their index, and the first of each position represents
    the others.

    >>> mesh = tufted.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]])
    >>> mesh
    <tufted.Mesh: 4 points, 2 faces, 1 component, area 1>
    """

    def __init__(self, points, faces, *, mollify=_tufted.default_mollify, order="angle", seed=0, weld=False, threads=0,
                 solver="automatic", memory_limit=0, progress=None):
        name = "Mesh"
        solving = _solving(name, threads, solver, memory_limit)
        points = check.rows_of_three(name, "points", points)
        faces = check.triangles(name, "faces", faces)
        options = {"order": check.text(name, "order", order), "seed": check.whole(name, "seed", seed, 0),
                   "mollify": check.number(name, "mollify", mollify), "weld": check.flag(name, "weld", weld),
                   "threads": solving["threads"]}
        laplacian = _tufted.build_mesh(points, faces, options, check.callback(name, progress))
        super().__init__(laplacian, points, faces, solving, options)
        self._warn()

    @property
    def faces(self):
        """The triangles, F x 3 int32."""
        return self._faces

    def triangles(self):
        """The same as `faces`."""
        return self._faces

    def _mesh_frames(self):
        """Normals and tangents, and their Orientation as a number."""
        return self._keep("mesh frames", lambda: _tufted.mesh_frames(self._laplacian, self._points, self._faces))

    def _frame_parts(self):
        return self._mesh_frames()[0]

    def _orientation(self):
        return self._mesh_frames()[1]

    def _fitted_frames(self):
        return self._frame_parts()


@check.public
def denoise(points, *, image=None, viewpoint=None, threads=0, progress=None):
    """Moves the points of a noisy scan onto the surface, without a radius to choose.

    points: N x 3, float32 or float64; rows that are not finite stay as they are.
    image: (width, height) of a depth image, whose points then move along their rays. viewpoint: position of its camera,
    3 values; None: the origin. Only with image.
    threads: at most this many; 0: one per processor. progress: see Surface.
    Returns points (N x 3), noise (N: standard deviation of the noise around each point that moved, 0 at others), moved
    (how many points moved), outliers (how many stayed because they hover over the surface), and median_noise over the
    points that moved.
    """
    name = "denoise"
    points = check.rows_of_three(name, "points", points)
    structure = None
    if image is not None:
        origin = np.zeros(3) if viewpoint is None else check.vector_of_three(name, "viewpoint", viewpoint)
        structure = _pixels(name, points, image, origin)
    elif viewpoint is not None:
        raise InvalidInput("denoise: viewpoint is given, must be None without image")
    *denoised, sentences = _tufted.denoise(points, structure, check.whole(name, "threads", threads, 0),
                                           check.callback(name, progress))
    for sentence in filter(None, [*sentences, _tufted.hovering_warning(points) if structure is None else ""]):
        warnings.warn(f"denoise: {sentence}", TuftedWarning, stacklevel=3)
    return Denoised(*denoised)


@check.public
def thin(points, spacing):
    """Thins points to a Poisson disk sample: no two of the chosen points are closer than `spacing`, and every other
    point is closer than that to a chosen one. The same positions are chosen in whatever order the points are given.

    points: N x 3; rows that are not finite are not chosen. spacing: in the unit of the points, > 0.
    Returns the indices of the chosen points, int32, ascending; of equal points the first.
    """
    return _tufted.thin(check.rows_of_three("thin", "points", points), check.number("thin", "spacing", spacing))


def selection_of(where, crop, polygon, spacing):
    box = [] if crop is None else check.columns("read", "crop", crop, 6)[0].ravel()
    corners = np.zeros((0, 2))
    if polygon is not None:
        polygon = check.items("read", "polygon", polygon)
        corners, _ = check.columns("read", "polygon", polygon, len(polygon))
    if corners.shape[1] != 2:
        raise InvalidInput(f"read: polygon has rows of {corners.shape[1]} numbers, must be x, y")
    where = [where] if isinstance(where, str) else check.items("read", "where", where)
    return _tufted.Selection([check.text("read", "where", each) for each in where], box, corners,
                             check.number("read", "thin", spacing))


def _set_geometry(surface, geometry, source):
    surface._geometry = geometry
    surface._source = source
    return surface


@check.public
def read(path, *, kind="automatic", weld=False, where=(), crop=None, polygon=None, thin=0, image=None, rings=None,
         normals=False, progress=None, **options):
    """Reads a cloud or a mesh from a file and builds its Laplacian, as `tufted laplacian` does.

    path: PCD, PLY, LAS, text in columns, NPY, OBJ, OFF, STL or VTK. A warning says what of the file is skipped or
    changed.
    kind: "automatic", "cloud" (faces are ignored) or "mesh" (a file without faces is an error).
    weld: as in Mesh; False for clouds, whose equal points are always merged.
    where, crop, polygon, thin: which points of a cloud are kept, all if none of the four is given. where: comparisons
    of fields that must all hold, such as "classification=2,6", "z=10..20" or "return_number=number_of_returns". crop:
    six numbers, the lower and the upper corner of a box, sides included. polygon: P x 2, corners in x and y. thin: the
    spacing of thin(), applied last; 0: no thinning. `file_row` of the result says which points of the file are kept;
    the points that an organized cloud loses become NaN instead.
    image: whether the pixels of an organized cloud give the neighbours; None: if a pinhole camera at the file's
    viewpoint saw them, and neither neighbors, neighborhoods, rings nor preset="lidar" is given.
    rings: True: the rings of a spinning scanner give the neighbours, by the file's fields `ring` and `azimuth`;
    directions seen from its viewpoint replace a field that is missing. Other values as in PointCloud.
    normals: whether the file's normals are used for the tangent planes.
    options: those of PointCloud or Mesh; the default for viewpoint is that of the file.
    Returns a PointCloud or a Mesh. Raises IoError if the file cannot be read.
    """
    path = check.path("read", "path", path)
    has_rings = rings is not None and rings is not False
    image = None if image is None else check.flag("read", "image", image)
    normals = check.flag("read", "normals", normals)
    if image and has_rings:
        raise InvalidInput("read: image and rings are both given, must be one at most")
    geometry = _tufted.read_file(path, check.text("read", "kind", kind), check.flag("read", "weld", weld),
                                 check.callback("read", progress),
                                 selection_of(where, crop, polygon, thin))
    if geometry.is_mesh:
        for name, value in (("image", image), ("rings", has_rings), ("normals", normals)):
            if value:
                raise InvalidInput(f"read: {name} is asked for, must not be for a mesh")
        return _set_geometry(Mesh(geometry.points, geometry.triangles, weld=weld, progress=progress, **options),
                             geometry, path)
    position = np.array(geometry.viewpoint[:3])
    if geometry.height > 1 or position.any():
        options.setdefault("viewpoint", position)
    if image is None:
        wants_search = has_rings or options.get("preset") == "lidar" or not options.keys().isdisjoint(
            ("neighbors", "neighborhoods", "image"))
        image = not wants_search and geometry.height > 1 and _tufted.is_depth_image(
            geometry.points, geometry.width, geometry.height, position)
    if image:
        if geometry.height <= 1:
            raise _tufted.IoError(f"{path}: is one row of points, no organized cloud, which image=True asks for")
        options["image"] = _tufted.image_structure(geometry.width, geometry.height, position)
    if has_rings:
        options["rings"] = _tufted.rings_of(geometry, path) if rings is True else rings
    if normals:
        if len(geometry.normals) == 0 and len(geometry.points) > 0:
            raise _tufted.IoError(f"{path}: has no normals, which normals=True asks for")
        options["normals"] = geometry.normals
    return _set_geometry(PointCloud(geometry.points, progress=progress, **options), geometry, path)


# The formats that load() reads, each with the file by which it is recognised.
_LOADED = {"npz": "L.npz", "ply": "points.ply", "pcd": "points.pcd", "las": "points.las", "cover": "cover.npz"}


@check.public
def load(directory, *, threads=0, solver="automatic", memory_limit=0, progress=None):
    """Loads the last result that save() or `tufted laplacian` wrote into a directory, which needs formats npz and ply,
    pcd or las.

    Files of earlier results are ignored. Without the cover (format "cover"), distances, paths, log_map, Voronoi
    segments and triangles of clouds raise InvalidInput.
    threads, solver, memory_limit, progress: as in PointCloud.
    Returns a PointCloud or a Mesh. Raises IoError for a file that is missing, damaged or does not fit the others.
    """
    directory = check.path("load", "directory", directory)
    solving = _solving("load", threads, solver, memory_limit)
    laplacian = _tufted.load(directory, True)
    files = _tufted.files_of_result(directory)
    if not {"points.ply", "points.pcd", "points.las"} & set(files):
        raise _tufted.IoError(f"{directory}: has no points.ply, points.pcd or points.las, must have one of them")
    geometry = _tufted.read_points(directory, check.callback("load", progress))
    if len(geometry.points) != len(laplacian.status):
        raise _tufted.IoError(f"{directory}: the points are {len(geometry.points)}, and L has "
                              f"{len(laplacian.status)} rows")
    if geometry.is_mesh == laplacian.is_cloud:
        raise _tufted.IoError(f"{directory}: has no faces, which points.ply of a mesh has")
    with open(os.path.join(directory, "report.json"), encoding="utf-8") as file:
        report = json.load(file)
    options = report.get("cloud_options" if laplacian.is_cloud else "mesh_options")
    surface = PointCloud.__new__(PointCloud) if laplacian.is_cloud else Mesh.__new__(Mesh)
    faces = None if laplacian.is_cloud else geometry.triangles
    Surface.__init__(surface, laplacian, geometry.points, faces, solving,
                     None if options is None else json.dumps(options), geometry, report.get("source", ""),
                     [name for name, file in _LOADED.items() if file in files])
    surface._warn()
    return surface
