"""Reading and writing files, and properties of meshes, by potpourri3d's names and arguments."""
import os

import numpy as np
import scipy.sparse

from . import _arguments as check
from . import _tufted
from ._tufted import InvalidInput


def scaled(points):
    """Points divided by a power of two, so that their coordinates lie in [-1, 1] and squares of them neither overflow
    nor vanish, and this power. The division rounds nothing.
    """
    _, exponent = np.frexp(abs(points[np.isfinite(points)]).max(initial=0))
    return np.ldexp(points, -exponent), np.ldexp(1.0, exponent)


def triangle_areas(points, faces):
    """The areas of F triangles."""
    a, b, c = (points[faces[:, k]] for k in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def lumped_areas(points, faces):
    """A third of the area of each triangle at each of its corners: N values."""
    return np.bincount(faces.ravel(), np.repeat(triangle_areas(points, faces) / 3, 3), minlength=len(points))


@check.public
def read_mesh(filename):
    """Reads the vertices, V x 3 float64, and the faces, F x 3 int32, of the file filename; polygons are cut into
    triangles.
    """
    geometry = _tufted.read_file(check.path("read_mesh", "filename", filename), "mesh", False, None)
    return np.array(geometry.points), np.array(geometry.triangles)


@check.public
def read_polygon_mesh(filename):
    """Reads the vertices, V x 3 float64, and the faces, a list of lists of indices, of the file filename; polygons
    of more than three corners are cut into triangles.
    """
    points, triangles = read_mesh(filename)
    return points, triangles.tolist()


@check.public
def read_point_cloud(filename):
    """Reads the points of the file filename, N x 3 float64; faces are ignored."""
    filename = check.path("read_point_cloud", "filename", filename)
    return np.array(_tufted.read_file(filename, "cloud", False, None).points)


@check.public
def write_mesh(V, F, filename, UV_coords=None, UV_type=None):
    """Writes a mesh to an OBJ, PLY or OFF file, by the ending of its name.

    V: N x 3. F: F x D, or a list of lists of indices. filename: an existing file is replaced.
    UV_coords: U x 2 texture coordinates, for OBJ only. UV_type: whose they are: "per-vertex", "per-face", "per-corner".
    Raises IoError if the file cannot be written.
    """
    points = check.rows_of_three("write_mesh", "V", V)
    polygons = [polygon.tolist() for polygon in check.lists_of_indices("write_mesh", "F", F, len(points))]
    uv, corners = np.zeros((0, 2)), None
    if UV_coords is not None and UV_type is None:  # potpourri3d would leave them out without a word
        raise InvalidInput("write_mesh: UV_coords is given, must be None without UV_type")
    if UV_type is not None:
        counts = {"per-vertex": len(points), "per-face": len(polygons), "per-corner": sum(map(len, polygons))}
        if check.text("write_mesh", "UV_type", UV_type) not in counts:
            raise InvalidInput(f"write_mesh: UV_type = {UV_type!r}, must be None, 'per-vertex', 'per-face' or "
                               "'per-corner'")
        uv, _ = check.columns("write_mesh", "UV_coords", UV_coords, counts[UV_type])
        starts = np.cumsum([0, *map(len, polygons)])
        corners = {"per-vertex": lambda face, corner: polygons[face][corner], "per-face": lambda face, corner: face,
                   "per-corner": lambda face, corner: starts[face] + corner}[UV_type]
    _write(filename, points, polygons, uv, corners)


@check.public
def write_point_cloud(V, filename):
    """Writes points, N x 3, to an OBJ, PLY or OFF file, by the ending of its name filename; a file of that name is
    replaced. Raises IoError if it cannot be written.
    """
    _write(filename, check.rows_of_three("write_point_cloud", "V", V), [], np.zeros((0, 2)), None)


def _write(filename, points, polygons, uv, corners):
    filename = check.path("write", "filename", filename)
    ending = os.path.splitext(filename)[1].lower()
    rows = [f"{x!r} {y!r} {z!r}" for x, y, z in points.tolist()]
    if ending == ".obj":
        def corner(face, k, vertex):
            return f"{vertex + 1}/{corners(face, k) + 1}" if corners else f"{vertex + 1}"
        lines = [*(f"v {row}" for row in rows), *(f"vt {u!r} {v!r}" for u, v in uv.tolist()),
                 *("f " + " ".join(corner(face, k, vertex) for k, vertex in enumerate(polygon))
                   for face, polygon in enumerate(polygons))]
    elif ending in (".ply", ".off") and not corners:
        faces = [f"{len(polygon)} " + " ".join(map(str, polygon)) for polygon in polygons]
        axes = [f"property double {axis}" for axis in "xyz"]
        head = (["OFF", f"{len(rows)} {len(faces)} 0"] if ending == ".off" else
                ["ply", "format ascii 1.0", f"element vertex {len(rows)}", *axes, f"element face {len(faces)}",
                 "property list int int vertex_indices", "end_header"])
        lines = [*head, *rows, *faces]
    else:
        raise InvalidInput(f"write: filename = {filename!r}, must end in .obj"
                           + (" to hold UV_coords" if corners else ", .ply or .off"))
    check.write(filename, "\n".join([*lines, ""]).encode("ascii"))


@check.public
def face_areas(V, F):
    """The areas of triangles F (F x 3) with the corners V (N x 3): F values."""
    points, faces, unit = _triangles("face_areas", V, F)
    return triangle_areas(points, faces) * unit * unit


@check.public
def vertex_areas(V, F):
    """A third of the areas of the triangles F (F x 3) at each vertex of V (N x 3): N values."""
    points, faces, unit = _triangles("vertex_areas", V, F)
    return lumped_areas(points, faces) * unit * unit


@check.public
def cotan_laplacian(V, F, denom_eps=0.0):
    """The cotan Laplacian of the triangles as they are: N x N csr_matrix, positive semidefinite, without the guarantees
    of mesh_laplacian(). V: N x 3. F: F x 3. denom_eps: added to twice the area of a triangle where it is divided by.
    """
    points, faces, unit = _triangles("cotan_laplacian", V, F)
    denom_eps = check.number("cotan_laplacian", "denom_eps", denom_eps)
    corners = [points[faces[:, k]] for k in range(3)]
    rows, columns, weights = [], [], []
    for k in range(3):
        first, second = (k + 1) % 3, (k + 2) % 3
        u, v = corners[first] - corners[k], corners[second] - corners[k]
        sine = np.linalg.norm(np.cross(u, v), axis=1) + denom_eps / unit / unit
        rows.append(faces[:, first])
        columns.append(faces[:, second])
        weights.append(np.einsum("ij,ij->i", u, v) / sine / 2)
    i, j, w = map(np.concatenate, (rows, columns, weights))
    half = scipy.sparse.coo_matrix((w, (i, j)), shape=(len(points), len(points))).tocsr()
    adjacency = half + half.T
    return (scipy.sparse.diags(np.asarray(adjacency.sum(axis=1)).ravel()) - adjacency).tocsr()


@check.public
def edges(V, F):
    """The edges of polygons F, each once with its lower index first, in ascending order: E x 2 int32. V: N x 3."""
    count = len(check.rows_of_three("edges", "V", V))
    if isinstance(F, np.ndarray) and F.ndim == 2:
        polygons = [check.indices("edges", "F", F.reshape(-1), count, empty=True).reshape(F.shape)]
    else:
        polygons = check.lists_of_indices("edges", "F", F, count)
    pairs = [np.stack([each, np.roll(each, -1, axis=-1)], axis=-1).reshape(-1, 2) for each in polygons]
    pairs = np.sort(np.concatenate([np.zeros((0, 2), np.int32), *pairs]), axis=1).astype(np.int64)
    # A number for each pair, as numbers are sorted much faster than rows.
    numbers = np.unique(pairs[:, 0] * count + pairs[:, 1])
    return np.stack(np.divmod(numbers, max(count, 1)), axis=1).astype(np.int32)


def _triangles(function, V, F):
    """Points in [-1, 1], triangles, and the unit of length of the points."""
    points = check.rows_of_three(function, "V", V)
    faces = check.triangles(function, "F", F)
    check.indices(function, "F", faces.reshape(-1), len(points), empty=True)
    points, unit = scaled(points)
    return points, faces, unit
