"""The same bits as the command's, and files in and out."""
import json
import pickle
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


def test_chosen_points(tmp_path):
    corners = [(-0.9, -0.9), (0.4, -0.9), (0.3, 0.9), (-0.9, 0.8)]
    (tmp_path / "outline.txt").write_text("".join(f"{x} {y}\n" for x, y in corners))
    run("laplacian", DATASETS / "two_sheets.ply", "--where", "label=0", "--where", "x!=-0.05..0", "--crop",
        "-0.4,-1,-1,1,0.35,1", "--polygon", tmp_path / "outline.txt", "--thin", "0.03", "--out", tmp_path / "out")
    surface = tufted.read(DATASETS / "two_sheets.ply", where=["label=0", "x!=-0.05..0"],
                          crop=[-0.4, -1, -1, 1, 0.35, 1], polygon=corners, thin=0.03)
    assert same(scipy.sparse.load_npz(tmp_path / "out/L.npz"), surface.L)
    np.testing.assert_array_equal(np.load(tmp_path / "out/file_row.npy"), surface.file_row)
    whole = tufted.read(DATASETS / "two_sheets.ply")
    assert whole.file_row is None and 0 < len(surface) < len(whole)
    np.testing.assert_array_equal(whole.points[surface.file_row], surface.points)
    surface.save(tmp_path / "saved")
    np.testing.assert_array_equal(np.load(tmp_path / "saved/file_row.npy"), surface.file_row)
    np.testing.assert_array_equal(tufted.load(tmp_path / "saved").file_row, surface.file_row)
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(surface)).file_row, surface.file_row)


def test_thin_is_what_read_thins():
    cloud = tufted.read(DATASETS / "sphere_uniform.ply")
    np.testing.assert_array_equal(tufted.thin(cloud.points, 0.2),
                                  tufted.read(DATASETS / "sphere_uniform.ply", thin=0.2).file_row)


@pytest.mark.parametrize("choice, fault", [
    ({"where": "lable=0"}, "read: where = 'lable=0': 'lable' is no field"), ({"where": "label=7"}, "none of the"),
    ({"crop": [0, 1, 2]}, "crop has the shape"), ({"crop": [1, 0, 0, 0, 1, 1]}, "read: the lower corner of crop"),
    ({"polygon": [(0, 0), (1, 1)]}, "at least 3"), ({"polygon": np.zeros((4, 3))}, "polygon has rows of 3"),
    ({"thin": -1}, "read: thin = -1"), ({"thin": "1"}, "read: thin = '1', must be a number")])
def test_choices_that_are_refused(choice, fault):
    with pytest.raises(tufted.InvalidInput, match=fault):
        tufted.read(DATASETS / "two_sheets.ply", **choice)


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
        (["trace", "--source", "3", "--direction", "1,2,3", "--length", "2"], "path",
         lambda: surface.trace(3, [1, 2, 3], 2).points),
        (["isolines", "--field", "x", "--at", "0.1,0.3"], "isolines",
         lambda: np.vstack([np.column_stack([np.full(len(line.points), k), np.full(len(line.points), line.value),
                                             line.points])
                            for k, line in enumerate(surface.isolines(surface.points[:, 0], [0.1, 0.3]))])),
        (["logmap", "--source", "3"], "logmap", lambda: surface.log_map(3).coordinates),
        (["smooth", "--time-step", "3"], "positions", lambda: surface.smooth(time_step=3)),
        (["smooth", "--method", "taubin", "--field", "x"], "smoothed",
         lambda: surface.smooth_values(surface.points[:, 0], method="taubin")),
        (["normals"], "normals", lambda: surface.normals()),
        (["segment", "--count", "4"], "labels", lambda: surface.segments(4).labels),
        (["filter", "--field", "x", "--count", "20"], "filtered",
         lambda: surface.filter(surface.points[:, 0], k=20)),
    ]
    for arguments, file, compute in cases:
        out = tmp_path / "-".join(arguments[:2]).replace("/", "_")
        run(arguments[0], DATASETS / name, *arguments[1:], "--out", out)
        np.testing.assert_array_equal(np.load(out / f"{file}.npy"), compute(), err_msg=" ".join(arguments))


def test_signed_distance(tmp_path):
    file = DATASETS / "torus_uniform.ply"
    surface = tufted.read(file)
    curve = surface.path(0, 500).points
    curve = [int(i) for i in dict.fromkeys(surface.nearest(curve).tolist())]
    (tmp_path / "curve.txt").write_text("\n".join(map(str, curve)))
    run("signed-distance", file, "--curve", tmp_path / "curve.txt", "--out", tmp_path)
    np.testing.assert_array_equal(np.load(tmp_path / "distance.npy"), surface.signed_distance(curve))
    run("signed-distance", file, "--curve", tmp_path / "curve.txt", "--method", "marching", "--source", "1", "--out",
        tmp_path)
    np.testing.assert_array_equal(np.load(tmp_path / "distance.npy"),
                                  surface.signed_distance(curve, sources=1, method="marching"))


@pytest.mark.parametrize("name", ["torus_uniform.ply", "icosphere.ply"])
def test_ways_through_points(name, tmp_path):
    surface = tufted.read(DATASETS / name)
    for closed in (False, True):
        run("path", DATASETS / name, "--from", "0", "--via", "20", "--via", "70", "--to", "99",
            *["--closed"] * closed, "--out", tmp_path)
        expected = surface.path_through([0, 20, 70, 99], closed=closed).points
        np.testing.assert_array_equal(np.load(tmp_path / "path.npy"),
                                      np.vstack([expected, expected[:1]]) if closed else expected)


def test_weights(tmp_path):
    (tmp_path / "handles.txt").write_text("3 0\n90 1\n4 0\n")
    run("weights", DATASETS / "fins.obj", "--handles", tmp_path / "handles.txt", "--out", tmp_path)
    np.testing.assert_array_equal(np.load(tmp_path / "weights.npy"),
                                  tufted.read(DATASETS / "fins.obj").weights([[3, 4], 90]))


def test_maps_and_moved_points(tmp_path):
    file = DATASETS / "saddle_uniform.ply"
    surface = tufted.read(file)
    (tmp_path / "handles.txt").write_text("0\n5 0.1 0.2 0.9\n9\n")
    targets = surface.points[[0, 5, 9]].copy()
    targets[1] = [0.1, 0.2, 0.9]
    handles = ["deform", "--handles", tmp_path / "handles.txt"]
    cases = [(["parameterize"], "uv", lambda: surface.parameterize().uv),
             (["minimal"], "positions", lambda: surface.minimal_surface().points),
             (handles, "positions", lambda: surface.deform([0, 5, 9], targets).points),
             ([*handles, "--method", "linear"], "positions",
              lambda: surface.deform([0, 5, 9], targets, method="linear").points)]
    for words, name, compute in cases:
        run(words[0], file, *words[1:], "--out", tmp_path / "out")
        np.testing.assert_array_equal(np.load(tmp_path / "out" / f"{name}.npy"), compute())


def test_curvature_and_operators(tmp_path):
    surface = tufted.read(DATASETS / "torus_uniform.ply")
    run("curvature", DATASETS / "torus_uniform.ply", "--rings", "5", "--out", tmp_path / "curvature")
    found = surface.curvature(rings=5)
    assert (found.mean != surface.curvature().mean).any()
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


def without_times(path):
    """A report without what differs from run to run."""
    report = json.loads(path.read_text())
    for stage in report["report"]["stages"]:
        del stage["seconds"], stage["bytes"]
    return report


EVERY_FORMAT = "npz,mtx,mat,spmat,petsc,ply,pcd,cover,triangles"


@pytest.mark.parametrize("name, words, options, written", [
    ("sphere_uniform.ply", [], {}, {}),
    ("sphere_uniform.ply", ["--normals", "--preset", "clean"], {"normals": True, "preset": "clean"}, {}),
    ("torus_uniform.ply", ["--neighbors", "25", "--gluing", "vertex-pair", "--order", "random", "--seed", "7",
                           "--mollify", "1e-4", "--threads", "2", "--viewpoint", "1,2,3"],
     {"neighbors": 25, "gluing": "vertex-pair", "order": "random", "seed": 7, "mollify": 1e-4, "threads": 2,
      "viewpoint": [1, 2, 3]}, {}),
    ("depth_camera.ply", ["--delaunay", "cgal"], {"delaunay": "cgal"}, {}),
    ("fins.obj", ["--order", "area", "--sign", "igl", "--dummy"], {"order": "area"}, {"sign": "igl", "dummy": True}),
    ("slivers.ply", ["--mollify", "1e-3"], {"mollify": 1e-3}, {}),
    ("slivers.ply", ["--as", "cloud"], {"kind": "cloud"}, {}),
    ("depth_camera.ply", ["--structure", "image"], {"image": True}, {}),
    ("depth_camera.ply", ["--structure", "image", "--viewpoint", "0,1,0"], {"image": True, "viewpoint": [0, 1, 0]}, {}),
    ("lidar_64_noise.ply", ["--structure", "rings", "--preset", "lidar"], {"rings": True, "preset": "lidar"}, {}),
])
def test_save_writes_the_files_of_the_command(name, words, options, written, tmp_path):
    commands, ours = tmp_path / "command", tmp_path / "python"
    run("laplacian", DATASETS / name, "--out", commands, "--format", EVERY_FORMAT, *words)
    surface = tufted.read(DATASETS / name, **options)
    surface.save(ours, formats=EVERY_FORMAT.split(","), **written)
    names = sorted(path.name for path in commands.iterdir())
    assert sorted(path.name for path in ours.iterdir()) == names and len(names) == 22
    for file in names:
        if file == "report.json":
            assert without_times(ours / file) == without_times(commands / file)
        else:
            assert (ours / file).read_bytes() == (commands / file).read_bytes(), file


def scan_with_rings(path, fields="ring azimuth", turn=360.0, pose="2 0 0 1 0 0 0"):
    """A cylinder of ten rings of 60 points around (2, 0, 0), as a driver writes it."""
    i = np.arange(600)
    angle = 2 * np.pi * (i % 60) / 60
    columns = {"x": 2 + np.cos(angle), "y": np.sin(angle), "z": i // 60 * 0.1, "ring": i // 60,
               "azimuth": i % 60 / 60 * turn}
    names = ["x", "y", "z", *fields.split()]
    size = len(names)
    path.write_text(f"VERSION .7\nFIELDS {' '.join(names)}\nSIZE {'4 ' * size}\nTYPE {'F ' * size}\n"
                    f"COUNT {'1 ' * size}\nWIDTH 600\nHEIGHT 1\nVIEWPOINT {pose}\nPOINTS 600\nDATA ascii\n"
                    + "".join(" ".join(f"{columns[name][k]:.6g}" for name in names) + "\n" for k in i))
    return path


@pytest.mark.parametrize("fields, turn, pose", [
    ("ring azimuth", 360.0, "2 0 0 1 0 0 0"), ("ring azimuth", 36000.0, "0 0 0 1 0 0 0"),
    ("ring", 1.0, "2 0 0 1 0 0 0"), ("azimuth", 6.2831, "2 0 0.3 1 0 0 0"), ("ring", 1.0, "2 0 0 2 0 0 2")])
def test_rings_of_a_file_are_those_of_the_command(fields, turn, pose, tmp_path):
    file = scan_with_rings(tmp_path / "rings.pcd", fields, turn, pose)
    run("laplacian", file, "--out", tmp_path / "command", "--structure", "rings")
    by_rings, by_tree = tufted.read(file, rings=True), tufted.read(file)
    by_rings.save(tmp_path / "python")
    assert without_times(tmp_path / "python/report.json") == without_times(tmp_path / "command/report.json")
    assert (tmp_path / "python/L.npz").read_bytes() == (tmp_path / "command/L.npz").read_bytes()
    assert not same(by_rings.L, by_tree.L)  # the field alone asks for nothing, as in the command
    assert same(tufted.read(file, rings=False).L, by_tree.L)


def test_structures_that_a_file_does_not_have(tmp_path):
    file = tmp_path / "loose.npy"
    np.save(file, sphere(500))
    with pytest.raises(tufted.IoError, match="loose.npy: has no field `ring`, and its elevations show no rings"):
        tufted.read(file, rings=True)
    with pytest.raises(tufted.IoError, match="loose.npy: is one row of points, no organized cloud"):
        tufted.read(file, image=True)
    with pytest.raises(tufted.IoError, match="has a field `azimuth` up to"):
        tufted.read(scan_with_rings(tmp_path / "odd.pcd", turn=360000.0), rings=True)
    for name in ("image", "rings", "normals"):
        with pytest.raises(tufted.InvalidInput, match=f"read: {name} is asked for, must not be for a mesh"):
            tufted.read(DATASETS / "fins.obj", **{name: True})
    with pytest.raises(tufted.InvalidInput, match="image and rings are both given"):
        tufted.read(DATASETS / "depth_camera.ply", image=True, rings=True)


def test_the_options_that_a_report_has_outlive_a_pickle(tmp_path):
    cloud = tufted.PointCloud(sphere(500), "lidar", 20, normals=sphere(500), viewpoint=[0, 0, 9], order="area")
    for surface, folder in ((cloud, "made"), (pickle.loads(pickle.dumps(cloud)), "pickled"),
                            (cloud.restricted_to(), "restricted")):
        surface.save(tmp_path / folder)
        options = without_times(tmp_path / folder / "report.json")["cloud_options"]
        assert (options["neighbors"], options["order"], options["viewpoint"]) == (20, "area", [0, 0, 9])
        assert options["given_normals"] and not options["given_neighborhoods"] and options["structure"] == "none"
    lists = np.argsort(np.linalg.norm(sphere(60)[:, None] - sphere(60)[None], axis=2), axis=1)[:, 1:20]
    tufted.PointCloud(sphere(60), neighborhoods=lists).save(tmp_path / "lists")
    assert without_times(tmp_path / "lists" / "report.json")["cloud_options"]["given_neighborhoods"]


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


def noisy_spheres():
    """A noisy sphere, the first 2,000 points, and a coarse exact one."""
    return np.concatenate([sphere(2000, noise=0.015), 8 * sphere(600, seed=12) + [20, 0, 0]])


def test_from_a_folder_all_results_are_the_same(tmp_path):
    whole = tufted.PointCloud(noisy_spheres())
    assert whole.report["noise"] > 0 and whole.report["components"] == 2
    whole.save(tmp_path, formats=["npz", "ply", "cover"])
    loaded = tufted.load(tmp_path)
    pins = {3: 1.0, 90: 2.0}
    calls = [lambda s: s.smooth(), lambda s: s.smooth(time_step=5), lambda s: s.smooth_values(s.points[:, 0]),
             lambda s: s.curvature().mean, lambda s: s.curvature().principal, lambda s: s.distance(3),
             lambda s: s.distance(3, method="heat"), lambda s: s.harmonic(pins), lambda s: s.biharmonic(pins),
             lambda s: s.poisson(s.points[:, 0]), lambda s: s.green(3), lambda s: s.extend([3, 90], [1.0, 2.0]),
             lambda s: s.transport(3, [1, 2, 3]), lambda s: s.log_map(3).coordinates, lambda s: s.normals(),
             lambda s: s.gradients().X.data, lambda s: s.spectrum(8, null_space=False).vectors, lambda s: s.hks(k=10),
             lambda s: s.segments(4).labels, lambda s: s.triangles(), lambda s: s.report["noise"],
             lambda s: s.report["denoised"]]
    for one, other in ((whole, loaded), (whole.restricted_to(), loaded.restricted_to()),
                       (whole, pickle.loads(pickle.dumps(whole))), (loaded, pickle.loads(pickle.dumps(loaded)))):
        for number, call in enumerate(calls):
            np.testing.assert_array_equal(call(one), call(other), err_msg=str(number))


def test_gradients_are_those_of_the_moved_points(tmp_path):
    np.save(tmp_path / "noisy.npy", sphere(3000, noise=0.01))
    cloud = tufted.read(tmp_path / "noisy.npy")
    assert cloud.report["denoised"] > 2900
    run("operators", tmp_path / "noisy.npy", "--count", "4", "--out", tmp_path / "out")
    written = np.load(tmp_path / "out/operators.npz")

    def matrix(name):
        return scipy.sparse.csc_matrix(tuple(written[f"{name}_{part}"] for part in ("data", "indices", "indptr")),
                                       shape=written[f"{name}_shape"])

    for X, Y in (cloud.gradients()[:2], (matrix("gradX"), matrix("gradY"))):
        # The parts of the three axes that lie in a plane.
        squares = (X @ cloud.positions) ** 2 + (Y @ cloud.positions) ** 2
        np.testing.assert_allclose(squares.sum(axis=1), 2, rtol=1e-9)


def test_a_part_is_smoothed_as_if_it_were_alone():
    fine, coarse = sphere(2000), 300 * sphere(1000, seed=12) + [1000, 0, 0]
    whole = tufted.PointCloud(np.concatenate([fine, coarse]))
    alone = tufted.PointCloud(fine).smooth()
    for surface in (whole, whole.restricted_to(), pickle.loads(pickle.dumps(whole)).restricted_to()):
        np.testing.assert_allclose(surface.smooth()[:2000], alone, atol=1e-4)


def test_without_the_cover_distances_are_refused(tmp_path):
    tufted.PointCloud(sphere(300)).save(tmp_path)
    loaded = tufted.load(tmp_path)
    assert len(loaded.spectrum(3).values) == 3
    for call in (lambda: loaded.distance(0), lambda: loaded.log_map(0), lambda: loaded.triangles()):
        with pytest.raises(tufted.InvalidInput, match="the cover is missing, must be saved"):
            call()
