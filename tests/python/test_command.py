"""The same bits as the command's, and files in and out."""
import json
import subprocess

import numpy as np
import pytest
import scipy.sparse

import tufted
from support import COMMAND, DATASETS, same, sphere, torus_mesh


def run(*arguments):
    subprocess.run([COMMAND, *map(str, arguments), "--quiet"], check=True, timeout=300)


@pytest.mark.parametrize("name", ["sphere_uniform.ply", "square_scan_lines_10.ply", "fins.obj", "klein_bottle.off",
                                  "slivers.ply", "depth_camera.ply"])
def test_l_and_m(name, tmp_path):
    run("laplacian", DATASETS / name, "--out", tmp_path)
    surface = tufted.read(DATASETS / name)
    assert same(scipy.sparse.load_npz(tmp_path / "L.npz"), surface.L)
    for array, file in ((surface.M, "M"), (surface.status, "status"), (surface.boundary, "boundary"),
                        (surface.components, "components"), (surface.positions, "measured_positions"),
                        (surface.representative, "representative")):
        np.testing.assert_array_equal(np.load(tmp_path / f"{file}.npy"), array)
    if isinstance(surface, tufted.PointCloud):
        np.testing.assert_array_equal(np.load(tmp_path / "frames.npy"), surface.frames)
    written = json.loads((tmp_path / "report.json").read_text())["report"]
    assert set(written) == set(surface.report)
    for key in set(written) - {"stages"}:
        assert written[key] == surface.report[key], key


def test_dummy_values(tmp_path):
    run("laplacian", DATASETS / "unreferenced_vertices.obj", "--out", tmp_path, "--dummy", "--mollify", "1e-5")
    V, F = tufted.read_mesh(DATASETS / "unreferenced_vertices.obj")
    L, M = tufted.mesh_laplacian(V, F)
    assert same(scipy.sparse.load_npz(tmp_path / "L.npz"), L)
    np.testing.assert_array_equal(np.load(tmp_path / "M.npy"), M.diagonal())


@pytest.mark.parametrize("name", ["torus_uniform.ply", "fins.obj"])
def test_algorithms(name, tmp_path):
    surface = tufted.read(DATASETS / name)
    cases = [
        (["spectrum", "--count", "12"], "evecs", lambda: surface.spectrum(12, null_space=False).vectors),
        (["distance", "--source", "3"], "distance", lambda: surface.distance(3)),
        (["hks", "--count", "20"], "hks", lambda: surface.hks(k=20)),
        (["hks", "--wave", "--count", "20"], "wks", lambda: surface.wks(k=20)),
        (["embed", "--distance", "biharmonic"], "embedding", lambda: surface.embed(distance="biharmonic")),
        (["green", "--source", "3"], "green", lambda: surface.green(3)),
        (["interpolate", "--pin", "3=1", "--pin", "90=2"], "values", lambda: surface.harmonic({3: 1.0, 90: 2.0})),
        (["extend", "--pin", "3=1", "--pin", "90=2"], "values", lambda: surface.extend([3, 90], [1.0, 2.0])),
        (["transport", "--source", "3", "--vector", "1,2,3"], "vectors", lambda: surface.transport(3, [1, 2, 3])),
        (["logmap", "--source", "3"], "logmap", lambda: surface.log_map(3).coordinates),
        (["normals"], "normals", lambda: surface.normals()),
        (["segment", "--count", "4"], "labels", lambda: surface.segments(4).labels),
        (["filter", "--field", "x", "--count", "20"], "filtered",
         lambda: surface.filter(surface.points[:, 0], k=20)),
    ]
    for arguments, file, compute in cases:
        out = tmp_path / "-".join(arguments[:2]).replace("/", "_")
        run(arguments[0], DATASETS / name, *arguments[1:], "--out", out)
        np.testing.assert_array_equal(np.load(out / f"{file}.npy"), compute(), err_msg=" ".join(arguments))


def test_curvature_and_operators(tmp_path):
    surface = tufted.read(DATASETS / "torus_uniform.ply")
    run("curvature", DATASETS / "torus_uniform.ply", "--out", tmp_path / "curvature")
    found = surface.curvature()
    np.testing.assert_array_equal(np.load(tmp_path / "curvature/curvature.npy"),
                                  np.column_stack([found.mean, found.gaussian, found.principal]))
    np.testing.assert_array_equal(np.load(tmp_path / "curvature/principal_directions.npy"),
                                  found.directions.reshape(-1, 6))
    run("operators", DATASETS / "torus_uniform.ply", "--count", "16", "--out", tmp_path / "operators")
    written, operators = np.load(tmp_path / "operators/operators.npz"), surface.operators(16)
    for name in ("frames", "mass", "evals", "evecs"):
        np.testing.assert_array_equal(written[name], operators[name])
    for name in ("L", "gradX", "gradY"):
        np.testing.assert_array_equal(written[f"{name}_data"], operators[name].data)
        np.testing.assert_array_equal(written[f"{name}_indices"], operators[name].indices)


@pytest.mark.parametrize("surface", [tufted.PointCloud(sphere(500)), tufted.Mesh(*torus_mesh(20, 10))])
def test_what_is_saved_is_loaded(surface, tmp_path):
    surface.save(tmp_path, formats=["npz", "ply", "cover"])
    again = tufted.load(tmp_path)
    assert type(again) is type(surface) and len(again) == len(surface)
    assert same(again.L, surface.L) and np.array_equal(again.M, surface.M)
    np.testing.assert_array_equal(again.distance(0), surface.distance(0))
    np.testing.assert_array_equal(again.points, surface.points)
    run("spectrum", "--operator", tmp_path, "--count", "5", "--out", tmp_path / "spectrum")
    np.testing.assert_array_equal(np.load(tmp_path / "spectrum/evecs.npy"),
                                  surface.spectrum(5, null_space=False).vectors)


def test_without_the_cover_distances_are_refused(tmp_path):
    tufted.PointCloud(sphere(300)).save(tmp_path)
    loaded = tufted.load(tmp_path)
    assert len(loaded.spectrum(3).values) == 3
    for call in (lambda: loaded.distance(0), lambda: loaded.log_map(0), lambda: loaded.triangles()):
        with pytest.raises(tufted.InvalidInput, match="the cover is missing, must be saved"):
            call()


def test_files_that_are_bad_are_named(tmp_path):
    with pytest.raises(tufted.IoError, match="nowhere.ply"):
        tufted.read(tmp_path / "nowhere.ply")
    (tmp_path / "bad.ply").write_text("ply\nformat ascii 1.0\nelement vertex x\n")
    with pytest.raises(OSError, match="bad.ply: line 3"):
        tufted.read(tmp_path / "bad.ply")
    with pytest.raises(tufted.IoError):
        tufted.load(tmp_path)
    with pytest.raises(tufted.IoError):
        tufted.PointCloud(sphere(50)).save("/proc/nowhere")
    with pytest.raises(tufted.IoError):
        tufted.read(DATASETS / "sphere_uniform.ply", kind="mesh")
    assert isinstance(tufted.read(DATASETS / "fins.obj", kind="cloud"), tufted.PointCloud)
    with pytest.raises(tufted.InvalidInput, match="kind = 'volume', must be one of"):
        tufted.read(DATASETS / "fins.obj", kind="volume")
