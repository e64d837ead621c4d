"""Folders, pickles and copies hold all that a file and an object hold, and a folder is what its last result is."""
import copy
import json
import pickle

import numpy as np
import pytest

import tufted
from support import sphere, torus_mesh

PLY_TYPES = {"i1": "char", "u1": "uchar", "i2": "short", "u2": "ushort", "i4": "int", "u4": "uint", "f4": "float",
             "f8": "double"}


def organized(width=24, height=18):
    """Points of a bent sheet in rows, one of them missing."""
    x, y = np.meshgrid(np.linspace(-1, 1, width), np.linspace(-1, 1, height))
    points = np.stack([x, y, 3 + 0.1 * x * y], axis=-1).reshape(-1, 3)
    points[width + 3] = np.nan
    return points


def columns(count, wide):
    """A field of every type: name, type, values per point, values."""
    generator = np.random.default_rng(3)
    fields = [(f"field_{kind}_x", kind, 1, generator.integers(0, 100, (count, 1)).astype(kind)) for kind in PLY_TYPES]
    fields.append(("time", "f8", 1, 3.2e8 + generator.random((count, 1))))
    fields.append(("label", "i4", 1, generator.integers(-5, 5, (count, 1)).astype("i4")))
    fields.append(("intensity", "f4", 1, generator.random((count, 1)).astype("f4")))
    if wide:  # which PCD alone can hold
        fields.append(("stamp", "i8", 1, (1 << 60) + generator.integers(0, 1000, (count, 1))))
        fields.append(("histogram", "f4", 5, generator.random((count, 5)).astype("f4")))
    return fields


def write_pcd(path, points, fields, size=None, viewpoint="0 0 0 1 0 0 0"):
    fields = [(name, "f8", 1, points[:, k:k + 1]) for k, name in enumerate("xyz")] + fields
    table = np.zeros(len(points), [(name, "<" + kind, (n,)) for name, kind, n, _ in fields])
    for name, _, _, values in fields:
        table[name] = values
    width, height = size or (len(points), 1)
    header = ["VERSION 0.7", "FIELDS " + " ".join(f[0] for f in fields),
              "SIZE " + " ".join(f[1][1] for f in fields), "TYPE " + " ".join(f[1][0].upper() for f in fields),
              "COUNT " + " ".join(str(f[2]) for f in fields), f"WIDTH {width}", f"HEIGHT {height}",
              f"VIEWPOINT {viewpoint}", f"POINTS {len(points)}", "DATA binary", ""]
    path.write_bytes("\n".join(header).encode() + table.tobytes())
    return path


def write_ply(path, points, fields, polygons=(), info=()):
    fields = [(name, "f8", 1, points[:, k:k + 1]) for k, name in enumerate("xyz")] + fields
    header = ["ply", "format ascii 1.0", *info, f"element vertex {len(points)}"]
    header += [f"property {PLY_TYPES[kind]} {name}" for name, kind, _, _ in fields]
    header += [f"element face {len(polygons)}", "property list uchar int vertex_indices", "end_header"]
    rows = [" ".join(repr(values[i, 0].item()) for _, _, _, values in fields) for i in range(len(points))]
    rows += [" ".join(map(str, [len(p), *p])) for p in polygons]
    path.write_text("\n".join(header + rows) + "\n")
    return path


COLOR = [("red", "u1", 1), ("green", "u1", 1), ("blue", "u1", 1), ("alpha", "u1", 1)]


def colors(count, channels):
    values = np.random.default_rng(4).integers(0, 256, (count, channels)).astype("u1")
    return [(*COLOR[k], values[:, k:k + 1]) for k in range(channels)]


def normals(points, names=("nx", "ny", "nz")):
    unit = points / np.linalg.norm(points, axis=1, keepdims=True)
    return [(name, "f8", 1, unit[:, k:k + 1]) for k, name in enumerate(names)]


def organized_pcd(folder):
    points = organized()
    packed = [("rgb", "u4", 1, np.arange(len(points), dtype="u4").reshape(-1, 1) * 38183)]
    return write_pcd(folder / "a.pcd", points, columns(len(points), True) + packed, (24, 18),
                     "0.1234567890123 2 -3 0.5 0.5 0.5 0.5")


def organized_ply(folder):
    points = organized()
    return write_ply(folder / "a.ply", points, columns(len(points), False) + colors(len(points), 4),
                     info=["obj_info num_cols 24", "obj_info num_rows 18", "obj_info viewpoint 1 2 3 1 0 0 0"])


def cloud_ply(folder):
    points = sphere(300) + [5e5, 5.4e6, 0]
    return write_ply(folder / "a.ply", points, normals(sphere(300)) + columns(300, False) + colors(300, 3))


def mesh_ply(folder):
    points, faces = torus_mesh(20, 10)
    quads = [[*f] for f in faces[2:]] + [[0, 10, 11, 1]]
    return write_ply(folder / "a.ply", points, normals(points) + columns(len(points), False) + colors(len(points), 3),
                     quads)


def stl(folder):
    points, faces = torus_mesh(12, 8)
    lines = ["solid a"]
    for f in faces:
        lines += ["facet normal 0 0 0", "outer loop",
                  *("vertex " + " ".join(map(repr, map(float, points[v]))) for v in f),
                  "endloop", "endfacet"]
    (folder / "a.stl").write_text("\n".join(lines + ["endsolid"]))
    return folder / "a.stl"


FILES = {"organized pcd": organized_pcd, "organized ply": organized_ply, "cloud": cloud_ply, "mesh": mesh_ply,
         "stl": stl}


def made(kind, folder):
    if kind == "points":
        return tufted.PointCloud(sphere(200), "lidar", 20, viewpoint=[0, 0, 9])
    if kind == "arrays":
        return tufted.Mesh(*torus_mesh(12, 8))
    if kind == "no faces":
        return tufted.Mesh(sphere(5), np.zeros((0, 3), int))
    if kind == "nothing":
        return tufted.PointCloud(np.zeros((0, 3)))
    options = {"neighbors": 12} if kind == "cloud" else {}
    return tufted.read(FILES[kind](folder), **options)


def content(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


KINDS = [*FILES, "points", "arrays", "no faces", "nothing"]


@pytest.mark.parametrize("formats", [("npz", "ply"), ("npz", "ply", "pcd", "cover"), ("npz", "pcd")])
@pytest.mark.parametrize("kind", KINDS)
def test_what_is_loaded_is_saved_again_bit_for_bit(kind, formats, tmp_path):
    surface = made(kind, tmp_path)
    if formats == ("npz", "pcd") and isinstance(surface, tufted.Mesh):
        formats = ("npz", "ply", "pcd")  # PCD has no triangles
    surface.save(tmp_path / "first", formats=formats)
    loaded = tufted.load(tmp_path / "first")
    assert type(loaded) is type(surface) and repr(loaded) == repr(surface)
    assert loaded.report == surface.report
    loaded.save(tmp_path / "second")
    first, second = content(tmp_path / "first"), content(tmp_path / "second")
    assert first.keys() == second.keys()
    assert [name for name in first if first[name] != second[name]] == []


@pytest.mark.parametrize("restricted", [False, True])
@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, lambda s: pickle.loads(pickle.dumps(s)),
                                    lambda s: pickle.loads(pickle.dumps(s, protocol=2))])
@pytest.mark.parametrize("kind", KINDS)
def test_copies_and_pickles_are_saved_bit_for_bit(kind, copied, restricted, tmp_path):
    surface = made(kind, tmp_path)
    if restricted and kind not in ("no faces", "nothing"):
        surface = surface.restricted_to()
    again = copied(surface)
    assert again.report == surface.report
    assert (again._faces is None) == (surface._faces is None)
    np.testing.assert_array_equal(again.points, surface.points)
    for other, name in ((surface, "first"), (again, "second")):
        other.save(tmp_path / name, formats=("npz", "ply", "pcd", "cover"))
    assert content(tmp_path / "first") == content(tmp_path / "second")
    tufted.load(tmp_path / "first").save(tmp_path / "third")
    copied(tufted.load(tmp_path / "first")).save(tmp_path / "fourth")
    assert content(tmp_path / "third") == content(tmp_path / "fourth")


def test_all_fields_of_a_file_come_back(tmp_path):
    file = organized_pcd(tmp_path)
    tufted.read(file).save(tmp_path / "out", formats=("npz", "pcd"))
    before = tufted._tufted.read_file(str(file), "automatic", False, None)
    after = pickle.loads(pickle.dumps(tufted.load(tmp_path / "out")))._geometry
    for name, values in before.fields.items():
        assert values.dtype == after.fields[name].dtype
        np.testing.assert_array_equal(after.fields[name], values)
    assert {*after.fields} - {*before.fields} == {"mass", "boundary", "status", "representative"}
    assert (after.width, after.height, after.viewpoint) == (24, 18, before.viewpoint)
    np.testing.assert_array_equal(after.points, before.points)


def test_files_of_an_earlier_result_are_never_taken(tmp_path):
    first, second = tufted.PointCloud(sphere(300)), tufted.PointCloud(2 * sphere(300, seed=12))
    first.save(tmp_path, formats=("npz", "ply", "pcd", "cover"))
    second.save(tmp_path, formats=("npz", "pcd"))
    np.testing.assert_array_equal(tufted.load(tmp_path).points, second.points)
    with pytest.raises(tufted.InvalidInput, match="the cover is missing"):
        tufted.load(tmp_path).distance(0)
    second.save(tmp_path, formats="npz")
    with pytest.raises(tufted.IoError, match="has no points.ply, points.pcd or points.las"):
        tufted.load(tmp_path)
    first.save(tmp_path, formats="ply")
    with pytest.raises(tufted.IoError, match="is of a run that did not write"):
        tufted.load(tmp_path)
    report = json.loads((tmp_path / "report.json").read_text())
    del report["files"]
    (tmp_path / "report.json").write_text(json.dumps(report))
    with pytest.raises(tufted.IoError, match="does not list the files"):
        tufted.load(tmp_path)


def test_a_mesh_is_not_loaded_without_its_faces(tmp_path):
    tufted.Mesh(*torus_mesh(12, 8)).save(tmp_path, formats=("npz", "pcd"))
    with pytest.raises(tufted.IoError, match="has no faces"):
        tufted.load(tmp_path)
