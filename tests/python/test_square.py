"""Parameterisation, editing and signed distances of a square."""
import numpy as np
import pytest

import tufted


def grid(n):
    """n x n points of the unit square and its triangles."""
    x, y = np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n), indexing="ij")
    corners = np.arange(n * n).reshape(n, n)
    a, b, c, d = corners[:-1, :-1].ravel(), corners[1:, :-1].ravel(), corners[1:, 1:].ravel(), corners[:-1, 1:].ravel()
    return (np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1),
            np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)]))


def test_a_plane_is_laid_out_as_it_is():
    points, faces = grid(12)
    mesh = tufted.Mesh(points, faces)
    uv, error, triangles, flipped, collapsed, not_mapped = mesh.parameterize()
    assert error == pytest.approx(1, abs=1e-8) and triangles == len(faces) and flipped == collapsed == not_mapped == 0
    with_others = tufted.Mesh(np.vstack([points, [[9, 9, 9], [np.nan] * 3]]), faces).parameterize()
    assert with_others.not_mapped == 2 and np.isnan(with_others.uv[-2:]).all()
    lengths = np.linalg.norm(np.diff(points[::12], axis=0), axis=1)
    np.testing.assert_allclose(np.linalg.norm(np.diff(uv[::12], axis=0), axis=1), lengths, rtol=1e-7)
    rim = np.concatenate([np.arange(0, 144, 12), 132 + np.arange(1, 12), np.arange(131, 0, -12), np.arange(10, 0, -1)])
    for weights in ("laplacian", "mean-value"):
        found = mesh.parameterize(method="harmonic", weights=weights, rim=rim, rim_positions=points[rim, :2])
        np.testing.assert_allclose(found.uv, points[:, :2], atol=1e-12)
    assert np.linalg.norm(mesh.parameterize(method="harmonic").uv, axis=1).max() == pytest.approx(1)


def test_a_plane_that_is_cut_has_two_places_along_the_cut():
    points, faces = grid(12)
    found = tufted.Mesh(points, faces).parameterize(cuts=[range(72, 78)])
    assert found.uv.shape == (len(faces), 3, 2) and found.quasi_conformal_error == pytest.approx(1, abs=1e-8)
    places = [len(np.unique(found.uv[faces == i], axis=0)) for i in range(144)]
    assert places == [2 if 72 <= i < 77 else 1 for i in range(144)]


def test_a_bump_becomes_flat_and_handles_lift_a_plane():
    points, faces = grid(12)
    bump = points + [0, 0, 1] * (np.sin(np.pi * points[:, :1]) * np.sin(np.pi * points[:, 1:2]))
    found = tufted.Mesh(bump, faces).minimal_surface()
    assert found.converged and found.area == pytest.approx(1, abs=1e-6) and abs(found.points[:, 2]).max() < 1e-3
    mesh = tufted.Mesh(points, faces)
    held = np.flatnonzero((points[:, 0] == 0) | (points[:, 0] == 1))
    targets = points[held] + [0, 0, 0.3] * (points[held, :1] == 1)
    for method in ("rigid", "linear"):
        moved = mesh.deform(held, targets, method=method)
        assert moved.converged and moved.stretch < 0.2
        np.testing.assert_array_equal(moved.points[held], targets)
        heights = moved.points[:, 2].reshape(12, 12).mean(axis=1)
        assert (np.diff(heights) > -1e-9).all()
    with pytest.raises(tufted.InvalidInput, match="smoothness"):
        mesh.deform(held, targets, smoothness=-1)


def test_weights_are_shares():
    points, faces = grid(9)
    weights = tufted.Mesh(points, faces).weights([0, [8, 72], 80])
    assert weights.shape == (81, 3) and weights.min() >= 0
    np.testing.assert_allclose(weights.sum(axis=1), 1, rtol=1e-14)
    np.testing.assert_array_equal(weights[[0, 8, 72, 80]], [[1, 0, 0], [0, 1, 0], [0, 1, 0], [0, 0, 1]])


def test_signed_distance_from_a_line():
    points, faces = grid(12)
    line = np.arange(6 * 12, 7 * 12)
    found = tufted.Mesh(points, faces).signed_distance(line)
    np.testing.assert_allclose(found, points[line[0], 0] - points[:, 0], atol=1e-6)


def test_signed_distances_from_several_curves_places_and_points():
    points, faces = grid(12)
    mesh = tufted.Mesh(points, faces)
    x, lines = points[:, 0], [np.arange(12 * i, 12 * (i + 1)) for i in (2, 9)]
    low, high = x[lines[0][0]], x[lines[1][0]]
    for method in ("heat", "marching"):
        # The strip between the lines is to the right of the first and, turned, to the right of the second.
        between = mesh.signed_distance([lines[0], lines[1][::-1]], method=method)
        np.testing.assert_allclose(between, np.maximum(low - x, x - high), atol=1e-6 if method == "marching" else 0.06)
        # Places at corners of faces are the vertices themselves.
        places = [(int(np.flatnonzero((faces == v).any(axis=1))[0]), v) for v in lines[0]]
        places = [(face, (faces[face] == v).astype(float)) for face, v in places]
        one = mesh.signed_distance(lines[0], method=method)
        np.testing.assert_array_equal(mesh.signed_distance(places, method=method), one)
        np.testing.assert_array_equal(mesh.signed_distance([*lines[0][:5], *places[5:]], method=method), one)
        np.testing.assert_array_equal(mesh.signed_distance([places], method=method), one)
        # Two curves of an index and a place each are not one curve of an index and a place.
        short = [[int(lines[0][0]), places[3]], [int(lines[0][3]), places[7]]]
        with pytest.warns(tufted.TuftedWarning, match="2 of the 2 segments of the curves are longer"):
            assert np.isfinite(mesh.signed_distance(short, method=method)).all()
    alone = mesh.signed_distance(sources=[5], faces=[7], barycentric=[[1, 1, 1]], method="marching")
    np.testing.assert_array_equal(alone, mesh.distance([5], faces=[7], barycentric=[[1, 1, 1]]))
    corner = mesh.signed_distance(lines[1], sources=0, method="marching")
    assert corner[0] == 0 and corner[1] > 0 and corner[-1] < 0


def test_distances_between_landmarks_are_symmetric_on_request():
    points = np.random.default_rng(4).normal(size=(800, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    points[31] = points[30]  # coincides
    cloud = tufted.PointCloud(points)
    landmarks = [3, 31, 500, 3]
    found, plain = cloud.distance_matrix(landmarks, symmetric=True), cloud.distance_matrix(landmarks)
    between = found[landmarks]
    assert 0 < abs(plain[landmarks] - plain[landmarks].T).max() < 0.003 * plain.max()
    np.testing.assert_array_equal(between, between.T)
    np.testing.assert_allclose(between, (plain[landmarks] + plain[landmarks].T) / 2, rtol=1e-15)
    np.testing.assert_array_equal(found[30], found[31])
    others = np.setdiff1d(np.arange(800), [*landmarks, 30])
    np.testing.assert_array_equal(found[others], plain[others])
