"""Shapes, types and orders of arrays, and what mistakes say."""
import numpy as np
import pytest

import tufted
from support import same, sphere, torus_mesh

CLOUD = sphere(400)


@pytest.mark.parametrize("points", [
    np.asfortranarray(CLOUD), np.hstack([CLOUD, CLOUD])[:, :3], CLOUD.tolist(), CLOUD.astype(">f8"),
    np.ma.array(CLOUD), CLOUD[::-1][::-1]])
def test_any_order_of_doubles_gives_the_same_bits(points):
    expected = tufted.PointCloud(CLOUD)
    cloud = tufted.PointCloud(points)
    assert same(cloud.L, expected.L) and np.array_equal(cloud.M, expected.M)


def test_floats_are_doubles_first():
    single = CLOUD.astype(np.float32)
    assert same(tufted.PointCloud(single).L, tufted.PointCloud(single.astype(np.float64)).L)


def test_contiguous_doubles_are_not_copied():
    assert tufted.PointCloud(CLOUD).points is CLOUD
    read_only = CLOUD.copy()
    read_only.flags.writeable = False
    assert tufted.PointCloud(read_only).points is read_only


@pytest.mark.parametrize("dtype", [np.int32, np.int64, np.uint32, np.uint8, np.int16])
def test_faces_of_any_integers(dtype):
    points, faces = torus_mesh(10, 8)
    assert same(tufted.Mesh(points, faces.astype(dtype)).L, tufted.Mesh(points, faces).L)
    assert same(tufted.Mesh(points, np.asfortranarray(faces.astype(dtype))).L, tufted.Mesh(points, faces).L)


def test_rows_of_nan_keep_their_index():
    points = CLOUD.copy()
    points[[3, 7]] = np.nan
    cloud = tufted.PointCloud(points)
    assert np.flatnonzero(cloud.status == 1).tolist() == [3, 7]
    assert cloud.M[3] == 0 and cloud.L[[3, 7]].nnz == 0
    assert np.isinf(cloud.distance(0)[[3, 7]]).all()
    assert np.isnan(cloud.poisson(np.arange(400.0))[[3, 7]]).all()
    assert (cloud.spectrum(4).vectors[[3, 7]] == 0).all()
    assert "398 take part" in repr(cloud)


@pytest.mark.parametrize("points", [np.zeros((0, 3)), [], np.full((5, 3), np.nan), np.zeros((5, 3)), [[1.0, 2, 3]]])
def test_clouds_without_a_surface_have_zeros(points):
    cloud = tufted.PointCloud(points)
    assert cloud.L.nnz == 0 and cloud.M.sum() == 0 and cloud.report["active"] == 0
    with pytest.raises(tufted.InvalidInput):
        cloud.spectrum(1)


MESH = torus_mesh(10, 8)


@pytest.mark.parametrize("call, words", [
    (lambda: tufted.PointCloud(CLOUD[:, :2]), "PointCloud: points has the shape 400 x 2, must be N x 3"),
    (lambda: tufted.PointCloud(CLOUD.ravel()), "points has the shape 1200, must be N x 3"),
    (lambda: tufted.PointCloud(CLOUD + 1j), "points has dtype complex128, must be real numbers"),
    (lambda: tufted.PointCloud([["a"] * 3]), "points has dtype <U1"),
    (lambda: tufted.PointCloud([[1, 2, 3], [4]]), "points"),
    (lambda: tufted.PointCloud(CLOUD, neighbors=2), "PointCloud: neighbors = 2, must be at least 3"),
    (lambda: tufted.PointCloud(CLOUD, neighbors=5.5), "neighbors = 5.5, must be an integer"),
    (lambda: tufted.PointCloud(CLOUD, "smooth"), "preset = 'smooth', must be one of 'clean', 'lidar', 'scan'"),
    (lambda: tufted.PointCloud(CLOUD, 30), "PointCloud: preset is a int, must be 'scan', 'clean' or 'lidar'; a number"),
    (lambda: tufted.PointCloud(*MESH), "preset is a ndarray, must be 'scan', 'clean' or 'lidar'; a number of neigh"),
    (lambda: tufted.PointCloud(CLOUD, normals=CLOUD[:9]), "normals has the shape 9 x 3, must be 400 x 3"),
    (lambda: tufted.PointCloud(CLOUD, viewpoint=[1, 2]), "viewpoint has the shape 2, must be 3"),
    (lambda: tufted.PointCloud(CLOUD, mollify=2), "PointCloud: mollify = 2, must lie in [0, 1]"),
    (lambda: tufted.PointCloud(CLOUD, threads=-1), "threads = -1, must be at least 0"),
    (lambda: tufted.PointCloud(CLOUD, image=(20, 21)), "image = (20, 21), must be (width, height) of 400 points"),
    (lambda: tufted.PointCloud(CLOUD, solver="lu"), "solver = 'lu', must be one of"),
    (lambda: tufted.PointCloud(CLOUD, progress=3), "progress = 3, must be None or a function"),
    (lambda: tufted.Mesh(MESH[0], MESH[1] * 1.0), "Mesh: faces has dtype float64, must be integers"),
    (lambda: tufted.Mesh(MESH[0], MESH[1][:, :2]), "faces has the shape 160 x 2, must be F x 3"),
    (lambda: tufted.Mesh(MESH[0], MESH[1] + 2**40), "faces has 1099511627"),
    (lambda: tufted.Mesh(MESH[0], MESH[1] - 1), "Mesh: triangle"),
    (lambda: tufted.PointCloud(CLOUD).distance(400), "distance: sources has 400, must lie in [0, 400)"),
    (lambda: tufted.PointCloud(CLOUD).distance([]), "distance: sources is empty, must name at least one point"),
    (lambda: tufted.PointCloud(CLOUD).distance(True), "sources has dtype bool, must be integers"),
    (lambda: tufted.PointCloud(CLOUD).distance(0, method="heat", time_step=0),
     "distance: time_step = 0, must be finite and above 0"),
    (lambda: tufted.PointCloud(CLOUD).distance(0, method="heat", unit="metre"),
     "distance: unit = 'metre', must be one of"),
    (lambda: tufted.PointCloud(CLOUD).distance(0, time_step=1), 'time_step = 1, must be None unless method is "heat"'),
    (lambda: tufted.PointCloud(CLOUD).distance(0, method="fast"), "distance: method = 'fast', must be one of"),
    (lambda: tufted.PointCloud(CLOUD).distance(0, split=3), "split = 3, must lie in [0, 2]"),
    (lambda: tufted.PointCloud(CLOUD).points_within(0, 0), "points_within: radius = 0, must be finite and above 0"),
    (lambda: tufted.PointCloud(CLOUD).points_within(400, 1), "points_within: sources has 400, must lie in [0, 400)"),
    (lambda: tufted.PointCloud(CLOUD).points_within(0, 1, split=3), "points_within: split = 3, must lie in [0, 2]"),
    (lambda: tufted.PointCloud(CLOUD).distance(0, maximum=0), "maximum = 0, must be above 0"),
    (lambda: tufted.PointCloud(CLOUD).distance(faces=[0], barycentric=[1, 0, 0]), "faces is given, must be None"),
    (lambda: tufted.PointCloud(CLOUD).spectrum(0), "spectrum: k = 0, must be at least 1"),
    (lambda: tufted.PointCloud(CLOUD).spectrum(401), "spectrum: k = 401, must be"),
    (lambda: tufted.PointCloud(CLOUD).harmonic([0, 1]), "harmonic: values is None, must be given"),
    (lambda: tufted.PointCloud(CLOUD).harmonic([0, 1], [1.0]), "harmonic: values has the shape 1, must be 2 or 2 x c"),
    (lambda: tufted.PointCloud(CLOUD).harmonic({0: np.nan}), "harmonic: values of point 0 are not finite"),
    (lambda: tufted.PointCloud(CLOUD).poisson(np.zeros(3)), "poisson: f has the shape 3, must be 400 or 400 x c"),
    (lambda: tufted.PointCloud(CLOUD).divergence(np.zeros((400, 3))), "divergence: vectors has 3 columns, must have 2"),
    (lambda: tufted.denoise(np.zeros((4, 2))), "denoise: points has the shape 4 x 2, must be N x 3"),
    (lambda: tufted.denoise(CLOUD, threads=-1), "denoise: threads = -1, must be at least 0"),
    (lambda: tufted.denoise(CLOUD, image=(20, 21)), "denoise: image = (20, 21), must be (width, height) of 400 points"),
    (lambda: tufted.denoise(CLOUD, image=(-20, -20)), "denoise: image = (-20, -20), must be (width, height)"),
    (lambda: tufted.denoise(CLOUD, viewpoint=(0, 0, 1)), "denoise: viewpoint is given, must be None without image"),
    (lambda: tufted.denoise(CLOUD, image=(20, 20), viewpoint=(0, np.nan, 1)),
     "denoise: viewpoint is not finite, must be"),
    (lambda: tufted.PointCloud(CLOUD).smooth(iterations=0), "smooth: iterations = 0, must be at least 1"),
    (lambda: tufted.PointCloud(CLOUD).smooth(method="box"), "smooth: method = 'box', must be one of"),
    (lambda: tufted.PointCloud(CLOUD).smooth(method="taubin", mu=1), "smooth: mu = 1, must lie in [-1, 0]"),
    (lambda: tufted.PointCloud(CLOUD).smooth(fixed=[True]), "smooth: fixed has 1 values, must have 400, one per point"),
    (lambda: tufted.PointCloud(CLOUD).smooth_values([1.0]), "smooth_values: values has the shape 1, must be 400"),
    (lambda: tufted.PointCloud(CLOUD).parameterize(method="flat"), "parameterize: method = 'flat', must be one of"),
    (lambda: tufted.PointCloud(CLOUD).parameterize(), "is closed, must have a rim: cut it open"),
    (lambda: tufted.PointCloud(CLOUD).parameterize(rim=[1, 2, 3]), "must be with method 'harmonic' alone"),
    (lambda: tufted.PointCloud(CLOUD).parameterize(cuts=[[0, 400]]), "cuts has 400, must lie in [0, 400)"),
    (lambda: tufted.PointCloud(CLOUD).parameterize(cuts=[[0]]), "parameterize: a cut has 1 points, must have at least"),
    (lambda: tufted.PointCloud(CLOUD).minimal_surface(), "minimal_surface: the surface has no rim"),
    (lambda: tufted.PointCloud(CLOUD).minimal_surface([400]), "minimal_surface: fixed has 400, must lie in [0, 400)"),
    (lambda: tufted.PointCloud(CLOUD).deform([0, 1], [[0, 0, 0]]),
     "deform: targets has the shape 1 x 3, must be 2 x 3"),
    (lambda: tufted.PointCloud(CLOUD).deform([0], [[0, 0, np.inf]]), "deform: the target of point 0 is not finite"),
    (lambda: tufted.PointCloud(CLOUD).deform(0, [[0, 0, 1]], tolerance=0), "deform: tolerance = 0, must be finite"),
    (lambda: tufted.PointCloud(CLOUD).signed_distance([3]), "signed_distance: curve has 1 places that take part"),
    (lambda: tufted.PointCloud(CLOUD).signed_distance(), "signed_distance: no curve and no point is given, must be"),
    (lambda: tufted.PointCloud(CLOUD).signed_distance([3, 5], sources=7), "signed_distance: sources has 1 places, must"),
    (lambda: tufted.PointCloud(CLOUD).signed_distance([3, 5], method="marching", time_step=2),
     'signed_distance: time_step = 2, must be None unless method is "heat"'),
    (lambda: tufted.PointCloud(CLOUD).signed_distance([3, 5], split=2),
     'signed_distance: split = 2, must be None unless method is "marching"'),
    (lambda: tufted.PointCloud(CLOUD).signed_distance([3, 5], method="exact"), "signed_distance: method = 'exact'"),
    (lambda: tufted.PointCloud(CLOUD).signed_distance([3, (5, (1, 0, 0))]),
     "signed_distance: curve is given, must be None for a cloud"),
    (lambda: tufted.PointCloud(CLOUD).signed_distance([[3, 5], [7, 400]]),
     "signed_distance: curve has 400, must lie in [0, 400)"),
    (lambda: tufted.PointCloud(CLOUD).signed_distance([3, 400]),
     "signed_distance: curve has 400, must lie in [0, 400)"),
    (lambda: tufted.PointCloud(CLOUD).weights(3), "weights: handles = 3, must be a list"),
    (lambda: tufted.PointCloud(CLOUD).weights([3, 400]), "weights: handles has 400, must lie in [0, 400)"),
    (lambda: tufted.PointCloud(CLOUD).weights([3, [3, 4]]), "weights: point 3 is of handle 0 and of handle 1"),
    (lambda: tufted.PointCloud(CLOUD).segments(method="cut"), "segments: method = 'cut', must be one of"),
    (lambda: tufted.PointCloud(CLOUD).restricted_to([5]), "restricted_to: component 5, must lie in [0, 1)"),
    (lambda: tufted.PointCloud(CLOUD).restricted_to("small"), "components = 'small', must be 'largest' or labels"),
    (lambda: tufted.PointCloud(CLOUD).trace([0, 1], [1, 0, 0], 1), "trace: source has 2 indices, must be one"),
    (lambda: tufted.PointCloud(CLOUD).trace(-1, [1, 0, 0], 1), "trace: source has -1, must lie in"),
    (lambda: tufted.PointCloud(CLOUD).trace(0, [1, 0], 1), "trace: direction has the shape 2, must be 3"),
    (lambda: tufted.PointCloud(CLOUD).trace(0, [0, 0, 0], 1), "trace: direction is not finite or 0"),
    (lambda: tufted.PointCloud(CLOUD).trace(0, [1, 0, 0], -1), "trace: length = -1"),
    (lambda: tufted.PointCloud(CLOUD).trace(0, [1, 0, 0], 1, barycentric=[1, 1, 1]),
     "trace: barycentric is given, must be None for a cloud"),
    (lambda: tufted.PointCloud(CLOUD).isolines(CLOUD, 0), "isolines: field has 3 columns, must have one"),
    (lambda: tufted.PointCloud(CLOUD).isolines(CLOUD[:, 0], [np.nan]), "isolines: value 0 is not finite"),
    (lambda: tufted.PointCloud(CLOUD).log_map([0, 1]), "log_map: source has 2 indices, must be one"),
    (lambda: tufted.PointCloud(CLOUD).save("x", formats="docx"), "save: formats = 'docx', must be one of"),
])
def test_mistakes_are_named(call, words):
    with pytest.raises(tufted.InvalidInput) as caught:
        call()
    assert words in str(caught.value)


def test_errors_are_pythons_as_well():
    assert issubclass(tufted.InvalidInput, ValueError)
    assert issubclass(tufted.IoError, OSError) and issubclass(tufted.FileTooLarge, tufted.IoError)
    assert issubclass(tufted.SolverFailure, RuntimeError) and issubclass(tufted.Cancelled, RuntimeError)
    assert tufted.IoError.__module__ == "tufted"


def test_the_librarys_memory_is_read_only():
    cloud = tufted.PointCloud(CLOUD)
    for array in (cloud.M, cloud.status, cloud.positions, cloud.L.data):
        with pytest.raises(ValueError):
            array[0] = 1
    M = cloud.M
    del cloud
    assert M.sum() > 12  # the array keeps it alive


def test_masked_points_take_no_part_and_masked_indices_are_refused():
    mask = np.zeros((400, 3), bool)
    mask[7, 1] = True
    expected = CLOUD.copy()
    expected[7] = np.nan
    masked = tufted.PointCloud(np.ma.array(CLOUD, mask=mask))
    assert np.flatnonzero(masked.status == 1).tolist() == [7]
    assert same(masked.L, tufted.PointCloud(expected).L)
    whole = tufted.PointCloud(np.ma.array(np.round(100 * CLOUD).astype(int), mask=mask))
    assert np.flatnonzero(whole.status == 1).tolist() == [7]
    points, faces = torus_mesh(10, 8)
    with pytest.raises(tufted.InvalidInput, match="faces is masked at 3 places"):
        tufted.Mesh(points, np.ma.array(faces, mask=np.arange(len(faces))[:, None] == [[2, 2, 2]]))
    with pytest.raises(tufted.InvalidInput, match="masked at 1 places"):
        masked.distance(np.ma.array([0, 1], mask=[False, True]))
