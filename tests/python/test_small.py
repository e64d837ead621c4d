"""Methods with their defaults on the smallest clouds and meshes."""
import numpy as np
import pytest

import tufted
from support import sphere

SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
REGULAR = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], float)
TETRAHEDRON = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]

SURFACES = {
    "square mesh": lambda: tufted.Mesh(SQUARE, [[0, 1, 2], [0, 2, 3]]),
    "regular tetrahedron": lambda: tufted.Mesh(REGULAR, TETRAHEDRON),
    "square cloud": lambda: tufted.PointCloud(SQUARE),
    "tetrahedron cloud": lambda: tufted.PointCloud(REGULAR),
    **{f"{n} points": lambda n=n: tufted.PointCloud(sphere(n)) for n in (5, 6, 7, 9, 12, 20, 40, 99, 127)},
}

METHODS = {
    "spectrum": lambda s: s.spectrum().vectors,
    "positive spectrum": lambda s: s.spectrum(null_space=False).vectors,
    "hks": lambda s: s.hks(),
    "wks": lambda s: s.wks(),
    "embed": lambda s: s.embed(),
    "filter": lambda s: s.filter(s.points),
    "operators": lambda s: s.operators()["evecs"],
    "gradients": lambda s: s.gradients().frames,
    "segments": lambda s: s.segments().areas,
    "spectral segments": lambda s: s.segments(method="spectral").areas,
    "parts": lambda s: s.segments(method="parts").areas,
    "distance": lambda s: s.distance(0),
    "heat": lambda s: s.distance(0, method="heat"),
    "path": lambda s: s.path(0, 1).points,
    "trace": lambda s: s.trace(0, [1, 2, 3], 1).points,
    "isolines": lambda s: np.array([line.length for line in s.isolines(s.points[:, 0], s.points[:, 0].mean())]),
    "log_map": lambda s: s.log_map(0).coordinates,
    "extend": lambda s: s.extend(0, 1.0),
    "transport": lambda s: s.transport(0, [1, 2, 3]),
    "harmonic": lambda s: s.harmonic({0: 1.0}),
    "biharmonic": lambda s: s.biharmonic({0: 1.0, 1: 2.0}),
    "weights": lambda s: s.weights([0, 1]),
    "poisson": lambda s: s.poisson(s.points[:, 0]),
    "green": lambda s: s.green(0),
    "smooth": lambda s: s.smooth(),
    "taubin": lambda s: s.smooth(method="taubin"),
    "smooth_values": lambda s: s.smooth_values(s.points),
    "normals": lambda s: s.normals(),
    "mean curvature": lambda s: s.curvature(method="laplacian").mean,
    "deform": lambda s: s.deform([0, 1], s.points[:2] + 0.1).points,
    "denoise": lambda s: tufted.denoise(s.points).points,
}


@pytest.fixture(scope="module")
def made():
    return {name: make() for name, make in SURFACES.items()}


@pytest.mark.parametrize("surface", SURFACES)
@pytest.mark.parametrize("method", METHODS)
def test_defaults_give_results(made, surface, method):
    assert (made[surface].status == 0).all()
    values = METHODS[method](made[surface])
    assert values.size > 0 and np.isfinite(values).all()


def test_all_pairs_that_there_are_can_be_asked_for():
    cloud = tufted.PointCloud(sphere(300))
    assert len(cloud.spectrum(300).values) == 300
    values = cloud.spectrum(299, null_space=False).values
    assert values.min() > 0
    np.testing.assert_allclose(values.sum(), (cloud.L.diagonal() / cloud.M).sum(), rtol=1e-9)  # the trace
    for call in (lambda: cloud.spectrum(301), lambda: cloud.spectrum(300, null_space=False)):
        with pytest.raises(tufted.InvalidInput, match="^spectrum: k = 30., must be at least 1 and at most"):
            call()
    with pytest.raises(tufted.InvalidInput, match="^embed: dimension = 300, must be at least 1 and at most 299"):
        cloud.embed(300)


def test_default_counts_are_the_usual_ones_where_there_are_as_many():
    cloud = tufted.PointCloud(sphere(300))
    assert len(cloud.spectrum().values) == 32 and cloud.embed().shape[1] == 3
    assert len(cloud.operators()["evals"]) == 128 and len(cloud.segments().areas) == 8
    np.testing.assert_array_equal(cloud.spectrum().values, cloud.spectrum(32).values)
