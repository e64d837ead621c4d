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
    if solver not in ("automatic", "cholesky", "multigrid"):
        raise InvalidInput(f"{function}: solver = {solver!r}, must be one of 'automatic', 'cholesky', 'multigrid'")
    return {"solver": solver, "memory_limit": check.whole(function, "memory_limit", memory_limit, 0),
            "threads": check.whole(function, "threads", threads, 0)}


def _pixels(function, points, image, origin):
    size = check.integers(function, "image", image)
    if size.shape != (2,) or size.min() < 0 or size[0] * size[1] != len(points):
        raise InvalidInput(f"{function}: image = {image!r}, must be (width, height) of {len(points)} points")
    return _tufted.image_structure(int(size[0]), int(size[1]), origin)


class PointCloud(Surface):
    """The Laplacian of a point cloud, which is built at once.

    points: N x 3, float32 or float64 (not copied if contiguous); rows with NaN keep their index and are skipped.
    preset: "scan" for real scans, "clean" for exact samples, "lidar" for spinning scanners.
    neighbors: k >= 3, of each point.
    normals: N x 3, used for the tangent planes, of any length; None: planes are fitted.
    viewpoint: where the sensor stood, 3 values; normals then face it.
    image: (width, height) of a depth image: pixels take the place of neighbours, noise is smoothed along the rays.
    rings: N numbers of the scanner's ring that a point lies on, or "find"; the rings then give the neighbours.
    neighborhoods: N x k indices used as they are; negative ones are padding.
    mollify: no edge is shorter than this times the longest side of the smaller of its triangles, 0 to 1; 0: flat
    triangles stay flat.
    gluing: "star" or "vertex-pair". order: "angle", "area" or "random" (by seed). delaunay: "star" or "cgal".
    threads: at most this many; 0: all. solver: "automatic", "cholesky" or "multigrid". memory_limit: bytes for factors,
    0: half of what is available. These three are for all methods, too.
    progress: a function of stage and fraction.
    """

    def __init__(self, points, preset="scan", neighbors=30, normals=None, *, viewpoint=None, image=None, rings=None,
                 neighborhoods=None, mollify=_tufted.default_mollify, gluing="star", order="angle", seed=0, delaunay="star", threads=0,
                 solver="automatic", memory_limit=0, progress=None):
        name = "PointCloud"
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
            "preset": preset, "neighbors": check.whole(name, "neighbors", neighbors, 3), "gluing": gluing,
            "delaunay": delaunay, "order": order, "seed": check.whole(name, "seed", seed, 0),
            "mollify": check.number(name, "mollify", mollify), "threads": solving["threads"],
            "viewpoint": None if viewpoint is None else viewpoint.copy(),
            "structure": "none" if structure is None else "image" if rings is None else "rings",
            "given_normals": normals is not None, "given_neighborhoods": neighborhoods is not None}
        laplacian = _tufted.build_cloud(points, options, normals, neighborhoods, structure,
                                        check.callback(name, progress))
        super().__init__(laplacian, points, None, solving, options)
        self._warn()

    @staticmethod
    def _structure(name, points, image, rings, viewpoint):
        origin = np.zeros(3) if viewpoint is None else viewpoint
        if image is not None and rings is not None:
            raise InvalidInput(f"{name}: image and rings are both given, must be one at most")
        for structure in (image, rings):
            if isinstance(structure, _tufted.ScanStructure):  # of a file, see read()
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
        """Triangles of the surface to look at, and for programs that take meshes; their corners lie at `positions`.

        Returns F x 3 int32; every edge has one or two triangles, which are oriented alike.
        """
        self._need_cover("triangles")
        return _tufted.triangles(self._laplacian, check.callback("triangles", progress))


class Mesh(Surface):
    """The Laplacian of a triangle mesh of any connectivity, which is built at once.

    points: V x 3, float32 or float64 (not copied if contiguous). faces: F x 3, integers of any type.
    mollify, order, seed, threads, solver, memory_limit, progress: as in PointCloud.
    weld: whether vertices of equal position are joined; all keep their index and row, and the first of each position
    stands for them.
    """

    def __init__(self, points, faces, *, mollify=_tufted.default_mollify, order="angle", seed=0, weld=False, threads=0,
                 solver="automatic", memory_limit=0, progress=None):
        name = "Mesh"
        solving = _solving(name, threads, solver, memory_limit)
        points = check.rows_of_three(name, "points", points)
        faces = check.triangles(name, "faces", faces)
        options = {"order": order, "seed": check.whole(name, "seed", seed, 0),
                   "mollify": check.number(name, "mollify", mollify), "weld": bool(weld),
                   "threads": solving["threads"]}
        laplacian = _tufted.build_mesh(points, faces, options, check.callback(name, progress))
        super().__init__(laplacian, points, faces, solving, options)
        self._warn()

    @property
    def faces(self):
        """The triangles, F x 3 int32."""
        return self._faces

    def triangles(self):
        """The triangles of the mesh, F x 3 int32, as those of a cloud."""
        return self._faces

    def _mesh_frames(self):
        """Normals and tangents, and whether the triangles say which side they are on."""
        return self._keep("mesh frames", lambda: _tufted.mesh_frames(self._laplacian, self._points, self._faces))

    def _frame_parts(self):
        return self._mesh_frames()[0]

    def _orientation(self):
        return self._mesh_frames()[1]

    def _fitted_frames(self):
        return self._frame_parts()


def denoise(points, *, image=None, viewpoint=None, threads=0, progress=None):
    """Moves the points of a noisy scan onto the surface, without a radius to choose.

    points: N x 3, float32 or float64; rows with NaN stay as they are.
    image: (width, height) of a depth image, whose points then move along their rays. viewpoint: where its camera stood,
    3 values; None: at the origin.
    threads: at most this many; 0: all. progress: a function of stage and fraction.
    Returns points (N x 3), noise (N: its standard deviation around each point that moved, 0 where it stayed), how many
    moved, how many stayed as outliers, and median_noise over those that moved.
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
    for sentence in sentences:
        warnings.warn(f"denoise: {sentence}", TuftedWarning, stacklevel=2)
    return Denoised(*denoised)


def _set_geometry(surface, geometry, source):
    surface._geometry = geometry
    surface._source = source
    return surface


def read(path, *, kind="automatic", weld=False, image=None, rings=None, normals=False, progress=None, **options):
    """Reads a cloud or a mesh from a file and builds its Laplacian, as `tufted laplacian` does.

    path: PCD, PLY, LAS, text in columns, NPY, OBJ, OFF, STL or VTK. What the file holds but is not read is a warning.
    kind: "automatic", "cloud" (faces are ignored) or "mesh" (a file without faces is an error).
    weld: as in Mesh; clouds join equal points in any case.
    image: whether the pixels of an organized cloud give the neighbours; None: where a pinhole camera saw it from the
    file's viewpoint, unless neighbors, neighborhoods, rings or preset="lidar" is given.
    rings: True: the rings of a spinning scanner give the neighbours, by the file's fields `ring` and `azimuth`, or for
    either that it lacks by the directions seen from its viewpoint. Otherwise as in PointCloud.
    normals: whether the file's normals are used for the tangent planes.
    options: those of PointCloud or Mesh.
    """
    path = os.fspath(path)
    has_rings = rings is not None and rings is not False
    if image and has_rings:
        raise InvalidInput("read: image and rings are both given, must be one at most")
    geometry = _tufted.read_file(path, kind, bool(weld), check.callback("read", progress))
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


# The formats that load() takes, each with a file of its own.
_LOADED = {"npz": "L.npz", "ply": "points.ply", "pcd": "points.pcd", "cover": "cover.npz"}


def load(directory, *, threads=0, solver="automatic", memory_limit=0, progress=None):
    """Loads what `save` or `tufted laplacian` wrote last: npz with ply or pcd, and the cover where it is among that.

    Files that an earlier result has left in the directory are not taken. Without the cover, distances, log_map, Voronoi segments and triangles are refused.
    """
    directory = os.fspath(directory)
    solving = _solving("load", threads, solver, memory_limit)
    laplacian = _tufted.load(directory, True)
    files = _tufted.files_of_result(directory)
    if "points.ply" not in files and "points.pcd" not in files:
        raise _tufted.IoError(f"{directory}: has no points.ply and no points.pcd, must have one of them")
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
    Surface.__init__(surface, laplacian, geometry.points, faces, solving, None if options is None else json.dumps(options), geometry,
                     report.get("source", ""), [name for name, file in _LOADED.items() if file in files])
    surface._warn()
    return surface
